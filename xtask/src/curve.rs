//! `cargo xtask curve`: what `cargo bench` measured as a picture of cost against size, and as a table.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use serde::Deserialize;

use crate::document;
use crate::step::{root, target};

/// What is drawn, in the order of the method, with its colour.
const STAGES: [(&str, &str); 13] = [
    ("connectivity", "#4477aa"),
    ("topology", "#66ccee"),
    ("filter-plain", "#88ccaa"),
    ("filter-adapted", "#44aa99"),
    ("smoothing-paper", "#117733"),
    ("smoothing-unguarded", "#999933"),
    ("smoothing-auto", "#228833"),
    ("normals", "#ccbb44"),
    ("decimation", "#ee6677"),
    ("level-90", "#aa3377"),
    ("areas", "#999999"),
    ("deviation", "#555555"),
    ("measures", "#222222"),
];

/// Milliseconds by triangles.
type Curve = BTreeMap<u64, f64>;

#[derive(Deserialize)]
struct Estimates {
    median: Estimate,
}

#[derive(Deserialize)]
struct Estimate {
    /// Nanoseconds.
    point_estimate: f64,
}

/// Draws and tabulates.
pub(crate) fn curve() -> Result<()> {
    let folder = target().join("criterion");
    let curves: Vec<(&str, &str, Curve)> =
        STAGES.iter().map(|&(stage, colour)| Ok((stage, colour, read(&folder.join(stage))?))).collect::<Result<_>>()?;
    ensure!(
        curves.iter().any(|(.., curve)| !curve.is_empty()),
        "there are no measurements: cargo bench --bench stages"
    );
    let picture = root().join("docs/images/cost-curve.svg");
    std::fs::write(&picture, drawn(&curves)).with_context(|| format!("{} cannot be written", picture.display()))?;
    document::replace("docs/benchmarks/stages.md", "curve", &table(&curves))
}

/// The medians of one stage; empty where it was not measured.
fn read(folder: &Path) -> Result<Curve> {
    let mut curve = Curve::new();
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(curve) };
    for entry in entries {
        let entry = entry?;
        let Some(triangles) = entry.file_name().to_str().and_then(|name| name.parse().ok()) else { continue };
        let file = entry.path().join("new/estimates.json");
        let text = std::fs::read_to_string(&file).with_context(|| format!("{} cannot be read", file.display()))?;
        let found: Estimates =
            serde_json::from_str(&text).with_context(|| format!("{} is not criterion's", file.display()))?;
        curve.insert(triangles, found.median.point_estimate / 1e6);
    }
    Ok(curve)
}

fn sizes(curves: &[(&str, &str, Curve)]) -> Vec<u64> {
    let mut sizes: Vec<u64> = curves.iter().flat_map(|(.., curve)| curve.keys().copied()).collect();
    sizes.sort_unstable();
    sizes.dedup();
    sizes
}

fn table(curves: &[(&str, &str, Curve)]) -> String {
    let sizes = sizes(curves);
    let heads: Vec<String> = sizes.iter().map(|&size| counted(size)).collect();
    let mut text = format!("| ms | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(sizes.len()));
    for (stage, _, curve) in curves {
        let cells: Vec<String> =
            sizes.iter().map(|size| curve.get(size).map_or_else(String::new, |&ms| rounded(ms))).collect();
        let _ = writeln!(text, "| {stage} | {} |", cells.join(" | "));
    }
    text
}

/// Three significant digits.
fn rounded(ms: f64) -> String {
    let decimals = (2 - ms.max(1e-9).log10().floor() as i32).clamp(0, 4) as usize;
    format!("{ms:.decimals$}")
}

/// "10k", "4M".
fn counted(triangles: u64) -> String {
    match triangles {
        n if n >= 1_000_000 && n % 1_000_000 == 0 => format!("{}M", n / 1_000_000),
        n if n >= 1_000 && n % 1_000 == 0 => format!("{}k", n / 1_000),
        n => n.to_string(),
    }
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 460.0;
/// Left, top, right and bottom of the plot.
const PLOT: [f64; 4] = [70.0, 20.0, 610.0, 405.0];

/// A logarithmic axis from one power of ten to another, and where it lies in the picture.
#[derive(Clone, Copy)]
struct Axis {
    from: f64,
    to: f64,
    place: [f64; 2],
}

impl Axis {
    fn around(values: impl Iterator<Item = f64>, place: [f64; 2]) -> Self {
        let (least, most) =
            values.fold((f64::MAX, f64::MIN), |(least, most), value| (least.min(value), most.max(value)));
        Self { from: least.log10().floor(), to: most.log10().ceil().max(least.log10().floor() + 1.0), place }
    }

    fn at(self, value: f64) -> f64 {
        let [start, end] = self.place;
        start + (value.log10() - self.from) / (self.to - self.from) * (end - start)
    }

    fn decades(self) -> impl Iterator<Item = f64> {
        (self.from as i32..=self.to as i32).map(|power| 10f64.powi(power))
    }
}

/// The picture. Its colours hold on light and on dark ground.
fn drawn(curves: &[(&str, &str, Curve)]) -> String {
    let [left, top, right, bottom] = PLOT;
    let points = || curves.iter().flat_map(|(.., curve)| curve.iter());
    let x = Axis::around(points().map(|(&size, _)| size as f64), [left, right]);
    let y = Axis::around(points().map(|(_, &ms)| ms), [bottom, top]);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" \
         aria-label=\"Milliseconds of each stage against the number of triangles, both axes logarithmic\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#6b7280\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" rx=\"8\" fill=\"#fbfbfc\"/>\n"
    );
    for value in x.decades() {
        let at = x.at(value);
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"#e2e4e8\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            bottom + 18.0,
            counted(value as u64)
        );
    }
    for value in y.decades() {
        let at = y.at(value);
        let _ = writeln!(
            svg,
            "<path d=\"M{left} {at:.1}H{right}\" stroke=\"#e2e4e8\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{value}</text>",
            left - 8.0,
            at + 4.0
        );
    }
    let (middle, low) = ((left + right) / 2.0, bottom + 42.0);
    let _ = writeln!(svg, "<text x=\"{middle}\" y=\"{low}\" text-anchor=\"middle\">triangles</text>");
    let height = (top + bottom) / 2.0;
    let _ = writeln!(
        svg,
        "<text transform=\"translate(20 {height}) rotate(-90)\" text-anchor=\"middle\">milliseconds</text>"
    );
    for (stage, colour, curve) in curves.iter().filter(|(.., curve)| !curve.is_empty()) {
        let line: Vec<String> =
            curve.iter().map(|(&size, &ms)| format!("{:.1},{:.1}", x.at(size as f64), y.at(ms))).collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"><title>{stage}</title></polyline>",
            line.join(" ")
        );
        for point in &line {
            let (cx, cy) = point.split_once(',').unwrap_or((point, "0"));
            let _ = writeln!(svg, "<circle cx=\"{cx}\" cy=\"{cy}\" r=\"3\" fill=\"{colour}\"/>");
        }
    }
    for (label, at) in labels(curves, y) {
        let (stage, colour) = label;
        let _ = writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"{colour}\">{stage}</text>", right + 10.0, at + 4.0);
    }
    svg + "</svg>\n"
}

/// Each stage's name beside the end of its curve, moved down where it would lie on another.
fn labels<'a>(curves: &[(&'a str, &'a str, Curve)], y: Axis) -> Vec<((&'a str, &'a str), f64)> {
    const LINE: f64 = 16.0;
    let ends =
        curves.iter().filter_map(|(stage, colour, curve)| Some(((*stage, *colour), y.at(*curve.values().last()?))));
    let mut ends: Vec<_> = ends.collect();
    ends.sort_by(|a, b| a.1.total_cmp(&b.1));
    for i in 1..ends.len() {
        ends[i].1 = ends[i].1.max(ends[i - 1].1 + LINE);
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cost_that_grows_with_the_size_is_a_straight_line() {
        let linear: Curve = [(10_000, 0.5), (100_000, 5.0), (1_000_000, 50.0)].into();
        let svg = drawn(&[("smoothing-100", "#228833", linear)]);
        let line = svg.split("points=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
        let points: Vec<[f64; 2]> = line
            .split(' ')
            .map(|point| point.split_once(',').map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()]).unwrap())
            .collect();
        let slope = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
        assert!((slope(points[0], points[1]) - slope(points[1], points[2])).abs() < 1e-3, "{line}");
        assert!(points[0][1] > points[2][1], "more lies higher");
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0123, 0.5, 7.25, 123.4, 45_678.9].map(rounded), ["0.0123", "0.500", "7.25", "123", "45679"]);
        assert_eq!([10_000, 74_307, 4_000_000].map(counted), ["10k", "74307", "4M"]);
    }

    #[test]
    fn names_do_not_lie_on_each_other() {
        let curve: Curve = [(10_000, 1.0)].into();
        let y = Axis { from: 0.0, to: 1.0, place: [400.0, 20.0] };
        let found = labels(&[("a", "red", curve.clone()), ("b", "blue", curve)], y);
        assert!(found[1].1 - found[0].1 >= 16.0);
    }
}
