//! Curves over axes. [`Plot::drawn`] lays out lines and letters once; both formats draw those.

use super::letters::{encoded, width};
use crate::language::{decimal, exact, grouped, tell};
use crate::pipeline::filter::Filter;
use crate::pipeline::response::{SmoothingResponse, eigenvalue};
use crate::pipeline::settings::Smoothing;
use crate::say;
use crate::trial::sweep::{Spread, SweepRow};
use crate::vessel::certificate::{BranchCalibre, OnSurface, StationStatus};

/// What a line or a letter is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The one colour.
    Accent,
    /// That of text.
    Text,
    /// That of what stands back.
    Weak,
    /// That of axes.
    Line,
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What it is, for the legend; empty for none.
    pub name: String,
    /// Its points, in the axes' numbers.
    pub points: Vec<[f64; 2]>,
    /// What it is drawn in.
    pub ink: Ink,
    /// Whether it is dashed.
    pub is_dashed: bool,
}

/// An axis: what it is of, from where to where, and its marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it is of, with its unit.
    pub label: String,
    /// From where to where.
    pub range: [f64; 2],
    /// Where it has marks, and what they are called.
    pub marks: Vec<(f64, String)>,
}

impl Axis {
    /// With a mark at each round number, some four of them.
    fn round(label: String, range: [f64; 2]) -> Self {
        let rough = ((range[1] - range[0]) / 4.0).max(1e-6);
        let power = libm::pow(10.0, libm::log10(rough).floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|&step| step >= rough);
        let step = step.unwrap_or(rough);
        let digits = if step < 0.1 { 2 } else { usize::from(step < 1.0) };
        let (first, last) = ((range[0] / step).ceil() as i64, (range[1] / step).floor() as i64);
        let mark = |i: i64| (i as f64 * step, decimal(i as f64 * step, digits));
        Self { label, range, marks: (first..=last).take(20).map(mark).collect() }
    }

    /// Where a number is, 0 to 1.
    fn part(&self, value: f64) -> f64 {
        ((value - self.range[0]) / (self.range[1] - self.range[0]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
    }
}

/// Curves over one pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Up.
    pub y: Axis,
    /// The curves, the first below the others.
    pub curves: Vec<Curve>,
}

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// Across, the same for all panels.
    pub x: Axis,
    /// From above to below; those after the first are half as high.
    pub panels: Vec<Panel>,
}

/// Width of a drawn plot, and the size of its letters.
pub(super) const WIDE: f64 = 420.0;
pub(super) const LETTERS: f64 = 11.5;
/// Where its axes begin and end.
const LEFT: f64 = 48.0;
const RIGHT: f64 = 412.0;
/// Heights of the first panel and of the others, of the line above each, and of marks and label of the axis across.
const PANEL: f64 = 96.0;
const LOWER: f64 = 46.0;
const HEAD: f64 = 20.0;
const FOOT: f64 = 38.0;

/// What a plot is drawn of, in a picture that is [`WIDE`], from its upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Mark {
    /// A line through points.
    Line { points: Vec<[f64; 2]>, ink: Ink, is_dashed: bool },
    /// Letters on a base line, of which the part `pull` is left of the place: 0 to begin there, 1 to end there.
    Text { at: [f64; 2], pull: f64, text: String, ink: Ink },
}

impl Plot {
    /// Height of the drawn plot.
    pub(super) fn height(&self) -> f64 {
        HEAD + PANEL + (self.panels.len().max(1) - 1) as f64 * (HEAD + LOWER) + FOOT
    }

    /// What it is drawn of, what lies below first.
    pub(super) fn drawn(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        let x = |value: f64| LEFT + (RIGHT - LEFT) * self.x.part(value);
        let text = |at: [f64; 2], pull: f64, text: &str| Mark::Text { at, pull, text: text.to_owned(), ink: Ink::Weak };
        let mut bottom = 0.0;
        for (i, panel) in self.panels.iter().enumerate() {
            let top = bottom + HEAD;
            bottom = top + if i == 0 { PANEL } else { LOWER };
            let y = |value: f64| bottom - (bottom - top) * panel.y.part(value);
            let axes = vec![[LEFT, top], [LEFT, bottom], [RIGHT, bottom]];
            marks.push(Mark::Line { points: axes, ink: Ink::Line, is_dashed: false });
            marks.extend(panel.y.marks.iter().map(|(at, name)| text([LEFT - 6.0, y(*at) + 4.0], 1.0, name)));
            marks.push(text([2.0, top - 7.0], 0.0, &panel.y.label));
            let mut legend = RIGHT;
            for Curve { name, points, ink, is_dashed } in &panel.curves {
                let points = points.iter().map(|&[a, b]| [x(a), y(b)]).collect();
                marks.push(Mark::Line { points, ink: *ink, is_dashed: *is_dashed });
                if !name.is_empty() {
                    marks.push(Mark::Text { at: [legend, top - 7.0], pull: 1.0, text: name.clone(), ink: *ink });
                    // The letters of a browser may be wider.
                    legend -= 1.1 * f64::from(width(&encoded(name), LETTERS as f32, false)) + 8.0;
                }
            }
        }
        marks.extend(self.x.marks.iter().map(|(at, name)| text([x(*at), bottom + 14.0], 0.5, name)));
        marks.push(text([f64::midpoint(LEFT, RIGHT), bottom + 32.0], 0.5, &self.x.label));
        marks
    }
}

/// What is shown of the eigenvalues, as powers of ten.
const RANGE: [f64; 2] = [-3.3, 0.301];
/// Lengths of waves that the axis names, in mm.
const LENGTHS: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];

/// How much of a wave smoothing leaves, by its length; `None` where nothing is smoothed.
pub(super) fn response(smoothing: &Smoothing, found: Option<&SmoothingResponse>) -> Option<Plot> {
    let found = found.filter(|_| smoothing.iterations > 0)?;
    let filter = Filter::new(smoothing);
    let at = |step: u32| RANGE[0] + (RANGE[1] - RANGE[0]) * f64::from(step) / 160.0;
    let curve = (0..=160).map(|step| [at(step), filter.response(libm::exp10(at(step)))]).collect();
    let band = libm::log10(smoothing.pass_band);
    let edge = found.edge_length_mm;
    let (label, marks) = if edge > 0.0 {
        let carried = LENGTHS.iter().filter(|&&length| length >= 2.0 * edge);
        let marks = carried.map(|&length| (libm::log10(eigenvalue(length, edge)), format!("{length}")));
        (say!("report-wave-length"), marks.filter(|(at, _)| (RANGE[0]..=RANGE[1]).contains(at)).collect())
    } else {
        (say!("report-eigenvalue"), [-3.0, -2.0, -1.0, 0.0].map(|at| (at, grouped(libm::exp10(at)))).to_vec())
    };
    let percent = [0.0, 0.5, 1.0].map(|part| (part, format!("{:.0} %", 100.0 * part))).to_vec();
    Some(Plot {
        title: say!("report-response"),
        x: Axis { label, range: RANGE, marks },
        panels: vec![Panel {
            y: Axis { label: say!("report-left"), range: [-0.1, 1.15], marks: percent },
            curves: vec![
                Curve {
                    name: say!("report-pass-band"),
                    points: vec![[band, -0.1], [band, 1.15]],
                    ink: Ink::Weak,
                    is_dashed: true,
                },
                Curve { name: say!("report-left-curve"), points: curve, ink: Ink::Accent, is_dashed: false },
            ],
        }],
    })
}

/// The radius along a branch on all surfaces, and below it by how much it is another than as opened, where curves of the
/// radius lie on each other; `None` where none is known.
pub(super) fn radius(branch: &BranchCalibre, tolerance_percent: f64) -> Option<Plot> {
    let smoothed = (say!("vessels-smoothed"), &branch.smoothed, Ink::Text);
    let reduced = (say!("vessels-reduced"), &branch.reduced, Ink::Accent);
    let opened = (say!("vessels-as-opened"), &branch.opened, Ink::Weak);
    let radii = [opened, smoothed.clone(), reduced.clone()];
    let curves: Vec<Curve> =
        radii.into_iter().flat_map(|(name, of, ink)| pieces(branch, &of.radii_mm, &name, ink)).collect();
    let (low, high) = range(&curves)?;
    let spare = (0.1 * high).max(1e-3);
    let x = Axis::round(say!("vessels-along"), [0.0, branch.length_mm.max(1e-3)]);
    let y = Axis::round(say!("vessels-radius"), [(low - spare).max(0.0), high + spare]);
    let mut panels = vec![Panel { y, curves }];
    panels.extend(change(branch, [smoothed, reduced], x.range, tolerance_percent));
    Some(Plot { title: say!("vessels-radius-along", name = tell(&branch.label())), x, panels })
}

/// What trials come to over the reduction rate: how many arrive, by how much the tip goes another way, how hard it presses.
/// The rates stand at equal distances.
pub fn sweep_plot(file: &str, rows: &[(f64, SweepRow)]) -> Plot {
    let curve = |name: String, ink: Ink, is_dashed: bool, value: &dyn Fn(&SweepRow) -> Option<f64>| Curve {
        name,
        points: (rows.iter().enumerate()).filter_map(|(i, (_, row))| Some([i as f64, value(row)?])).collect(),
        ink,
        is_dashed,
    };
    let panel = |label: String, curves: Vec<Curve>| {
        let most = range(&curves).map_or(1.0, |(_, high)| 1.1 * high.max(1e-3));
        Panel { y: Axis::round(label, [0.0, most]), curves }
    };
    let arrived = |row: &SweepRow| Some(100.0 * row.arrived as f64 / row.seeds.max(1) as f64);
    let largest = |spread: Option<Spread>| spread.map(|spread| spread.largest);
    let deviation = curve(say!("report-sweep-deviation"), Ink::Accent, false, &|row| largest(row.deviation_mm));
    let noise = curve(say!("report-sweep-noise"), Ink::Weak, true, &|row| largest(row.noise_mm));
    let median = |row: &SweepRow| Some(row.deviation_mm?.median);
    let median = curve(say!("report-sweep-median"), Ink::Accent, true, &median);
    let force = curve(String::new(), Ink::Accent, false, &|row| Some(1000.0 * largest(row.peak_force_n)?));
    let marks = rows.iter().enumerate().map(|(i, (rate, _))| (i as f64, exact(*rate))).collect();
    Plot {
        title: say!("report-sweep", file = file),
        x: Axis { label: say!("report-sweep-rate"), range: [-0.2, rows.len().max(2) as f64 - 0.8], marks },
        panels: vec![
            panel(say!("report-sweep-tip"), vec![noise, median, deviation]),
            panel(say!("report-sweep-arrived"), vec![curve(String::new(), Ink::Accent, false, &arrived)]),
            panel(say!("report-sweep-force"), vec![force]),
        ],
    }
}

/// The change of the radius from the surface as opened, in percent, between the bounds that are allowed; `None` where
/// none is known.
fn change(
    branch: &BranchCalibre,
    surfaces: [(String, &OnSurface, Ink); 2],
    along: [f64; 2],
    tolerance_percent: f64,
) -> Option<Panel> {
    let changes =
        surfaces.into_iter().flat_map(|(_, of, ink)| pieces(branch, &of.changes_percent, "", ink)).collect::<Vec<_>>();
    let (low, high) = range(&changes)?;
    let bound = |name: String, at: f64| Curve {
        name,
        points: along.map(|x| [x, at]).to_vec(),
        ink: Ink::Weak,
        is_dashed: true,
    };
    let allowed = bound(say!("report-change-allowed", percent = exact(tolerance_percent)), tolerance_percent);
    let mut curves = vec![allowed, bound(String::new(), -tolerance_percent)];
    curves.extend(changes);
    let most = 1.2 * tolerance_percent.max(high).max(-low).max(0.1);
    Some(Panel { y: Axis::round(say!("report-change"), [-most, most]), curves })
}

/// The least and the largest of what goes up; `None` of no points.
fn range(curves: &[Curve]) -> Option<(f64, f64)> {
    let all = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    low.is_finite().then_some((low, high))
}

/// A curve for each stretch where the vessel has values; the first has the name.
fn pieces(branch: &BranchCalibre, values: &[Option<f32>], name: &str, ink: Ink) -> Vec<Curve> {
    let point = |(i, value): (usize, &Option<f32>)| {
        let is_vessel = matches!(branch.standings[i], StationStatus::Counts | StationStatus::Thin);
        Some([f64::from(branch.abscissas_mm[i]), f64::from(value.filter(|_| is_vessel)?)])
    };
    let points: Vec<Option<[f64; 2]>> = values.iter().enumerate().map(point).collect();
    let runs = points.chunk_by(|a, b| a.is_some() == b.is_some()).filter(|run| run[0].is_some() && run.len() > 1);
    let curve = |(i, run): (usize, &[Option<[f64; 2]>])| Curve {
        name: if i == 0 { name.to_owned() } else { String::new() },
        points: run.iter().flatten().copied().collect(),
        ink,
        is_dashed: false,
    };
    runs.enumerate().map(curve).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TriMesh;
    use crate::phantom::{Sample, generate};
    use crate::pipeline::report::Report;
    use crate::pipeline::run::Pipeline;
    use crate::pipeline::settings::{Settings, Target};

    fn branches(mesh: TriMesh) -> Vec<BranchCalibre> {
        let settings = Settings { target: Target::Reduction(900), ..Settings::default() };
        let mut pipeline = Pipeline::new(mesh.into(), settings).with_certificate();
        pipeline.finish().unwrap();
        Report::new("a", &pipeline).unwrap().branches.unwrap()
    }

    #[test]
    fn the_change_that_is_drawn_is_that_of_the_numbers_and_stands_below_on_the_same_axis() {
        let branches = branches(generate(Sample::Aorta, 10_000).unwrap());
        let branch = branches.iter().max_by_key(|branch| branch.stations_counted).unwrap();
        let plot = radius(branch, 2.0).unwrap();
        let [_, change] = &plot.panels[..] else { panic!("{plot:?}") };
        let of = |ink: Ink| {
            let curves = change.curves.iter().filter(move |curve| curve.ink == ink);
            curves.flat_map(|curve| &curve.points).map(|point| point[1]).collect::<Vec<_>>()
        };
        for (surface, ink) in [(&branch.smoothed, Ink::Text), (&branch.reduced, Ink::Accent)] {
            let most = of(ink).into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
            assert!((most - surface.largest_change.unwrap().percent).abs() < 1e-4, "{most}");
            let drawn = of(ink).into_iter().map(|percent| percent as f32);
            let known = surface.changes_percent.iter().flatten().copied();
            assert!(drawn.eq(known), "every number, and no other");
        }
        assert_eq!(of(Ink::Weak), [2.0, 2.0, -2.0, -2.0]);
        // Below the radii, from where to where they go.
        let lines = plot.drawn().into_iter().filter_map(|mark| match mark {
            Mark::Line { points, ink: Ink::Line, .. } => Some(points),
            _ => None,
        });
        let [above, below] = &lines.collect::<Vec<_>>()[..] else { panic!("two pairs of axes") };
        let across = |axes: &[[f64; 2]]| [axes[1][0], axes[2][0]];
        assert!(across(above) == across(below) && below[0][1] > above[1][1]);
    }
}
