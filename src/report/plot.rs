//! Curves over axes, as both formats draw them.

use crate::language::{decimal, grouped, tell};
use crate::pipeline::filter::Filter;
use crate::pipeline::response::{SmoothingResponse, eigenvalue};
use crate::pipeline::settings::Smoothing;
use crate::say;
use crate::vessel::certificate::{BranchCalibre, OnSurface, StationStatus};

/// What a curve is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The one colour.
    Accent,
    /// That of text.
    Text,
    /// That of what stands back.
    Weak,
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
    pub(super) fn part(&self, value: f64) -> f64 {
        ((value - self.range[0]) / (self.range[1] - self.range[0]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
    }
}

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// Across.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// The curves, the first below the others.
    pub curves: Vec<Curve>,
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
    })
}

/// The radius along a branch on all surfaces; `None` where none is known.
pub(super) fn radius(branch: &BranchCalibre) -> Option<Plot> {
    let surfaces = [
        (say!("vessels-as-opened"), &branch.opened, Ink::Weak),
        (say!("vessels-smoothed"), &branch.smoothed, Ink::Text),
        (say!("vessels-reduced"), &branch.reduced, Ink::Accent),
    ];
    let curves: Vec<Curve> = surfaces.into_iter().flat_map(|(name, of, ink)| pieces(branch, of, &name, ink)).collect();
    let all = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    let spare = (0.1 * high).max(1e-3);
    low.is_finite().then(|| Plot {
        title: say!("vessels-radius-along", name = tell(&branch.label())),
        x: Axis::round(say!("vessels-along"), [0.0, branch.length_mm.max(1e-3)]),
        y: Axis::round(say!("vessels-radius"), [(low - spare).max(0.0), high + spare]),
        curves,
    })
}

/// A curve for each stretch that is measured; the first has the name.
fn pieces(branch: &BranchCalibre, of: &OnSurface, name: &str, ink: Ink) -> Vec<Curve> {
    let point = |i: usize| {
        let is_vessel = matches!(branch.standings[i], StationStatus::Counts | StationStatus::Thin);
        Some([f64::from(branch.abscissas_mm[i]), f64::from(of.radii_mm[i].filter(|_| is_vessel)?)])
    };
    let points: Vec<Option<[f64; 2]>> = (0..branch.standings.len()).map(point).collect();
    let runs = points.chunk_by(|a, b| a.is_some() == b.is_some()).filter(|run| run[0].is_some() && run.len() > 1);
    let curve = |(i, run): (usize, &[Option<[f64; 2]>])| Curve {
        name: if i == 0 { name.to_owned() } else { String::new() },
        points: run.iter().flatten().copied().collect(),
        ink,
        is_dashed: false,
    };
    runs.enumerate().map(curve).collect()
}
