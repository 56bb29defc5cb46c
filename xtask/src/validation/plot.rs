//! A plot of points beside lines, as a picture whose colours hold on light and on dark ground.

use std::fmt::Write as _;

/// What is plotted.
pub(super) struct Plot {
    pub(super) title: &'static str,
    /// What x and y are.
    pub(super) axes: [&'static str; 2],
    pub(super) is_logarithmic: bool,
    pub(super) series: Vec<Series>,
}

/// How a series is drawn.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// What was found.
    Points,
    /// The analytic answer.
    Line,
    /// Single points of it.
    Mark,
}

/// One series.
pub(super) struct Series {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) points: Vec<[f64; 2]>,
}

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 360.0;
/// Left, top, right and bottom of the plot.
const FRAME: [f64; 4] = [80.0, 40.0, 500.0, 305.0];
const COLOURS: [&str; 6] = ["#4477aa", "#ee6677", "#228833", "#aa3377", "#997700", "#007788"];

/// An axis from one value to another, and where it lies in the picture.
#[derive(Clone, Copy)]
struct Axis {
    is_logarithmic: bool,
    from: f64,
    to: f64,
    place: [f64; 2],
}

impl Axis {
    fn around(values: impl Iterator<Item = f64>, is_logarithmic: bool, place: [f64; 2]) -> Self {
        let (least, most) =
            values.fold((f64::MAX, f64::MIN), |(least, most), value| (least.min(value), most.max(value)));
        if is_logarithmic {
            let (from, to) = (least.max(1e-300).log10().floor(), most.max(1e-300).log10().ceil());
            return Self { is_logarithmic, from, to: to.max(from + 1.0), place };
        }
        let unit = step_for(most - least);
        let (from, to) = ((least / unit).floor() * unit, (most / unit).ceil() * unit);
        Self { is_logarithmic, from, to: to.max(from + unit), place }
    }

    fn at(self, value: f64) -> f64 {
        let [start, end] = self.place;
        let value = if self.is_logarithmic { value.max(1e-300).log10() } else { value };
        start + (value - self.from) / (self.to - self.from) * (end - start)
    }

    /// Where it has marks, and what they say.
    fn marks(self) -> Vec<(f64, String)> {
        if self.is_logarithmic {
            let powers = self.from as i32..=self.to as i32;
            return powers.map(|power| (10f64.powi(power), short(10f64.powi(power)))).collect();
        }
        let unit = step_for(self.to - self.from);
        let count = ((self.to - self.from) / unit).round() as i64;
        (0..=count).map(|i| ((self.from / unit).round() + i as f64) * unit).map(|value| (value, short(value))).collect()
    }
}

/// A round distance of marks, so that there are about five.
fn step_for(range: f64) -> f64 {
    let rough = range.max(1e-12) / 5.0;
    let power = 10f64.powf(rough.log10().floor());
    let times = [1.0, 2.0, 5.0, 10.0].into_iter().find(|times| times * power >= rough * 0.999);
    times.unwrap_or(10.0) * power
}

/// A number at a mark.
fn short(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.0e}");
    }
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Five significant digits.
pub(super) fn rounded(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.abs() < 1e-4 {
        return format!("{value:.2e}");
    }
    let decimals = (4 - value.abs().log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

impl Plot {
    /// The picture.
    pub(super) fn drawn(&self) -> String {
        let [left, top, right, bottom] = FRAME;
        let values = |k: usize| self.series.iter().flat_map(move |series| series.points.iter().map(move |p| p[k]));
        let x = Axis::around(values(0), self.is_logarithmic, [left, right]);
        let y = Axis::around(values(1), self.is_logarithmic, [bottom, top]);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{}\" \
             font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#6b7280\">\n\
             <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" rx=\"8\" fill=\"#fbfbfc\"/>\n\
             <text x=\"{left}\" y=\"24\" font-size=\"14\" fill=\"#374151\">{}</text>\n",
            self.title, self.title
        );
        for (value, text) in x.marks() {
            let at = x.at(value);
            let _ = writeln!(
                svg,
                "<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"#e2e4e8\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                bottom + 18.0
            );
        }
        for (value, text) in y.marks() {
            let at = y.at(value);
            let _ = writeln!(
                svg,
                "<path d=\"M{left} {at:.1}H{right}\" stroke=\"#e2e4e8\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
                left - 8.0,
                at + 4.0
            );
        }
        let [along, up] = self.axes;
        let (middle, low, height) = ((left + right) / 2.0, bottom + 42.0, (top + bottom) / 2.0);
        let _ = writeln!(svg, "<text x=\"{middle}\" y=\"{low}\" text-anchor=\"middle\">{along}</text>");
        let _ =
            writeln!(svg, "<text transform=\"translate(20 {height}) rotate(-90)\" text-anchor=\"middle\">{up}</text>");
        for (i, (series, colour)) in self.series.iter().zip(COLOURS.iter().cycle()).enumerate() {
            let at = |p: &[f64; 2]| (x.at(p[0]), y.at(p[1]));
            let is_line = series.kind == Kind::Line;
            if is_line {
                let line: Vec<String> = series.points.iter().map(at).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
                let _ = writeln!(
                    svg,
                    "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"/>",
                    line.join(" ")
                );
            } else {
                for (x, y) in series.points.iter().map(at) {
                    let fill = if series.kind == Kind::Mark { "none" } else { colour };
                    let _ = writeln!(
                        svg,
                        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{fill}\" stroke=\"{colour}\"/>"
                    );
                }
            }
            let (from, beside) = (right + 14.0, top + 10.0 + 18.0 * i as f64);
            let sign = if is_line {
                format!("<path d=\"M{from} {beside}h16\" stroke=\"{colour}\" stroke-width=\"1.5\"/>")
            } else {
                let fill = if series.kind == Kind::Mark { "none" } else { colour };
                format!("<circle cx=\"{}\" cy=\"{beside}\" r=\"3\" fill=\"{fill}\" stroke=\"{colour}\"/>", from + 8.0)
            };
            let _ =
                writeln!(svg, "{sign}<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", from + 22.0, beside + 4.0, series.name);
        }
        svg + "</svg>\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_hold_all_values() {
        let axis = Axis::around([0.13, 9.4].into_iter(), false, [0.0, 100.0]);
        let marks: Vec<String> = axis.marks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(marks, ["0", "2", "4", "6", "8", "10"]);
        let axis = Axis::around([3e-4, 0.02].into_iter(), true, [0.0, 300.0]);
        assert_eq!(axis.at(1e-2), 200.0);
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0, 1.5, 1e-4, 250.0, -0.2].map(short), ["0", "1.5", "1e-4", "250", "-0.2"]);
        assert_eq!([0.0, std::f64::consts::PI, 39.4784, 1.2e-6].map(rounded), ["0", "3.1416", "39.478", "1.20e-6"]);
    }
}
