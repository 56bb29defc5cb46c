//! Where a vessel is narrower or wider than it is on either side: a number for each stretch, as geometry alone.
//!
//! What a vessel has by itself is a line through its diameters that a minority of them does not move: the repeated median
//! (Siegel, "Robust regression using repeated medians", Biometrika 69, 1982), within eight diameters on either side, so
//! that a taper is none of it. Where the diameter leaves that by a quarter there is a stretch. Its reference is then
//! interpolated between what the vessel has on both sides of it (as in quantitative angiography: Reiber et al., Circulation
//! 71, 1985), and
//!
//! ```text
//! degree = 1 - d / D     by diameter; by area 1 - d^2 / D^2
//! ```
//!
//! with d the least (or largest) diameter of the stretch and D the reference there. It begins and ends where the diameter
//! is within a twentieth of the reference.
//!
//! It does not see what lies at forks and ends, or goes on to there, where no cross-section is that of one vessel, nor what
//! is longer than some eight diameters: that is the vessel's own calibre.

use serde::{Deserialize, Serialize};

use super::on_surface::{OnSurface, StationStatus};
use super::width::circle;
use lumen_message::messages;

/// The least degree by diameter of a stretch: below that a narrowing is called minimal (CAD-RADS 2.0, 2022).
pub const MIN_DEGREE: f64 = 0.25;
/// A stretch ends where the diameter is within this part of the reference.
const WITHIN: f64 = 0.05;
/// How far the line looks on either side, in diameters.
const WINDOW: f64 = 8.0;
/// The most stations that a line is laid through.
const MAX_STATIONS: usize = 33;
/// What stands for a side begins and ends so many diameters beyond the end of a stretch.
const SIDE: (f64, f64) = (0.5, 2.5);
/// The fewest stations of a side, and of a stretch.
const FEWEST: usize = 3;

/// Which way a stretch differs from what is on either side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename = "VariationKind", rename_all = "snake_case")]
pub enum Kind {
    /// It is narrower.
    Narrower,
    /// It is wider.
    Wider,
}

/// A stretch of a vessel that is narrower or wider than its neighbourhood.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variation {
    /// Which way.
    pub kind: Kind,
    /// Difference of the diameter from the reference, in percent of that: 70 where three tenths are left; 50 where it is half
    /// as wide again.
    pub degree_percent: f64,
    /// The same by area.
    pub area_percent: f64,
    /// The degree of the reduced surface at the same place, beside the same reference; null where it has no closed
    /// cross-section there.
    pub reduced_degree_percent: Option<f64>,
    /// The least or largest diameter, in mm.
    pub diameter_mm: f64,
    /// The reference there, in mm.
    pub reference_mm: f64,
    /// Where the reference comes from: the middle diameter before the stretch and behind it; null where a side is too short.
    #[serde(default)]
    pub sides: [Option<Side>; 2],
    /// Arc length at the beginning and end, from the first station of the branch, in mm.
    pub from_mm: f64,
    /// See `from_mm`.
    pub to_mm: f64,
    /// Arc length from the one to the other, in mm.
    pub length_mm: f64,
    /// Arc length at the least or largest diameter, in mm.
    pub abscissa_mm: f64,
    /// That place, in mm.
    pub at_mm: [f32; 3],
}

/// What a vessel has on one side of a stretch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Side {
    /// Arc length in its middle, in mm.
    pub abscissa_mm: f64,
    /// The middle diameter, in mm.
    pub diameter_mm: f64,
}

impl Variation {
    /// As "70 % narrower over 12.3 mm, at 34.5 mm".
    pub fn text(&self) -> VariationText {
        let (percent, length, at) = (self.degree_percent, self.length_mm, self.abscissa_mm);
        match self.kind {
            Kind::Narrower => VariationText::NarrowerOver { percent, length, at },
            Kind::Wider => VariationText::WiderOver { percent, length, at },
        }
    }

    /// As "1.80 in place of 6.00 mm, by the diameters at 18.0 and 51.0 mm".
    pub fn reference(&self) -> ReferenceText {
        let (diameter, reference) = (self.diameter_mm, self.reference_mm);
        match self.sides.map(|side| side.map(|side| side.abscissa_mm)) {
            [Some(from), Some(to)] => ReferenceText::Between { diameter, reference, from, to },
            [Some(at), None] | [None, Some(at)] => ReferenceText::At { diameter, reference, at },
            [None, None] => ReferenceText::Alone { diameter, reference },
        }
    }

    /// As "70 % narrower".
    pub fn degree(&self) -> VariationText {
        let percent = self.degree_percent;
        match self.kind {
            Kind::Narrower => VariationText::Narrower { percent },
            Kind::Wider => VariationText::Wider { percent },
        }
    }
}

messages! {
    /// A [`Variation`] as tables show it.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum VariationText {
        /// How much narrower.
        "vessels-narrower" Narrower {
            /// Degree by diameter, in percent.
            percent: f64 [0],
        } => "{percent:.0} % narrower",
        /// How much wider.
        "vessels-wider" Wider {
            /// Degree by diameter, in percent.
            percent: f64 [0],
        } => "{percent:.0} % wider",
        /// How much narrower, over which length and where.
        "vessels-narrower-over" NarrowerOver {
            /// Degree by diameter, in percent.
            percent: f64 [0],
            /// In mm.
            length: f64 [1],
            /// Arc length, in mm.
            at: f64 [1],
        } => "{percent:.0} % narrower over {length:.1} mm, at {at:.1} mm",
        /// How much wider, over which length and where.
        "vessels-wider-over" WiderOver {
            /// Degree by diameter, in percent.
            percent: f64 [0],
            /// In mm.
            length: f64 [1],
            /// Arc length, in mm.
            at: f64 [1],
        } => "{percent:.0} % wider over {length:.1} mm, at {at:.1} mm",
    }
}

messages! {
    /// A diameter, beside its reference and where that comes from.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum ReferenceText {
        /// From both sides.
        "vessels-reference-between" Between {
            /// The diameter, in mm.
            diameter: f64 [2],
            /// The reference, in mm.
            reference: f64 [2],
            /// Arc length before, in mm.
            from: f64 [1],
            /// Arc length behind, in mm.
            to: f64 [1],
        } => "{diameter:.2} in place of {reference:.2} mm, by the diameters at {from:.1} and {to:.1} mm",
        /// From one side.
        "vessels-reference-at" At {
            /// The diameter, in mm.
            diameter: f64 [2],
            /// The reference, in mm.
            reference: f64 [2],
            /// Arc length, in mm.
            at: f64 [1],
        } => "{diameter:.2} in place of {reference:.2} mm, by the diameter at {at:.1} mm",
        /// From the whole line.
        "vessels-reference" Alone {
            /// The diameter, in mm.
            diameter: f64 [2],
            /// The reference, in mm.
            reference: f64 [2],
        } => "{diameter:.2} in place of {reference:.2} mm",
    }
}

messages! {
    /// Stretches of a branch as tables show them.
    #[derive(Clone, Debug, PartialEq)]
    pub enum UnevenText {
        /// One that is narrower, and one that is wider.
        "vessels-uneven-both" Both {
            /// The narrower one.
            narrower: VariationText,
            /// The wider one.
            wider: VariationText,
        } => "{narrower}; {wider}",
    } or {
        /// One of them.
        One(VariationText),
    }
}

/// The greatest degree of that kind among these.
pub(super) fn greatest(found: &[Variation], kind: Kind) -> Option<&Variation> {
    let of_kind = found.iter().filter(|one| one.kind == kind);
    of_kind.reduce(|most, next| if next.degree_percent > most.degree_percent { next } else { most })
}

/// A branch at its stations, all lists of one length.
#[derive(Clone, Copy)]
pub(super) struct Along<'a> {
    pub(super) abscissas_mm: &'a [f32],
    pub(super) at_mm: &'a [[f32; 3]],
    pub(super) standings: &'a [StationStatus],
    pub(super) opened: &'a OnSurface,
    pub(super) reduced: &'a OnSurface,
}

/// The stretches of a branch, in its order.
pub(super) fn variations(along: Along<'_>) -> Vec<Variation> {
    let all: Vec<Sample> = (0..along.standings.len()).filter_map(|i| Sample::new(along, i)).collect();
    if all.len() < 2 * FEWEST {
        return Vec::new();
    }
    let usual = usual(&all);
    let ratio = |i: usize| all[i].diameter / usual[i].max(f64::MIN_POSITIVE);
    let mut found: Vec<Variation> = Vec::new();
    for kind in [Kind::Narrower, Kind::Wider] {
        let mut next = 0;
        while next < all.len() {
            if departure(kind, ratio(next)) < MIN_DEGREE / 2.0 {
                next += 1;
                continue;
            }
            let end = (next..all.len()).find(|&i| departure(kind, ratio(i)) < MIN_DEGREE / 2.0).unwrap_or(all.len());
            let most = |a: &usize, b: &usize| departure(kind, ratio(*a)).total_cmp(&departure(kind, ratio(*b)));
            if let Some(peak) = (next..end).max_by(most) {
                let stretch = stretch(&all, &usual, kind, peak);
                let is_new = |stretch: &Variation| {
                    found.last().is_none_or(|last| last.kind != kind || last.to_mm <= stretch.from_mm)
                };
                let stretch = stretch.filter(is_new).map(|stretch| stretch.reduced(along));
                found.extend(stretch);
            }
            next = end;
        }
    }
    found.sort_by(|a, b| a.abscissa_mm.total_cmp(&b.abscissa_mm));
    found
}

/// The narrowest place of a branch beside the diameter that it has at the arc length `reference_mm`; `None` where no place of
/// it is one vessel.
pub(super) fn narrowest_beside(along: Along<'_>, reference_mm: f64) -> Option<Variation> {
    let all: Vec<Sample> = (0..along.standings.len()).filter_map(|i| Sample::new(along, i)).collect();
    let peak = (0..all.len()).min_by(|&a, &b| all[a].diameter.total_cmp(&all[b].diameter))?;
    let reference = all.iter().min_by(|a, b| (a.at - reference_mm).abs().total_cmp(&(b.at - reference_mm).abs()))?;
    let (narrowest, part) = (all[peak], all[peak].diameter / reference.diameter);
    let mark = |_| reference.diameter;
    let (first, last) = ends(&all, Kind::Narrower, peak, mark);
    let from_mm = if first > 0 { crossing(&all, Kind::Narrower, [first, first - 1], mark) } else { all[first].at };
    let is_last = last + 1 == all.len();
    let to_mm = if is_last { all[last].at } else { crossing(&all, Kind::Narrower, [last, last + 1], mark) };
    let found = Variation {
        kind: Kind::Narrower,
        degree_percent: 100.0 * (1.0 - part),
        area_percent: 100.0 * (1.0 - part * part),
        reduced_degree_percent: None,
        diameter_mm: narrowest.diameter,
        reference_mm: reference.diameter,
        sides: [Some(Side { abscissa_mm: reference.at, diameter_mm: reference.diameter }), None],
        from_mm,
        to_mm,
        length_mm: to_mm - from_mm,
        abscissa_mm: narrowest.at,
        at_mm: narrowest.at_mm,
    };
    Some(found.reduced(along))
}

/// A station where the branch is one vessel.
#[derive(Clone, Copy)]
struct Sample {
    at: f64,
    diameter: f64,
    /// Of the circle of the area of the cross-section alone, without its neighbours.
    alone: f64,
    at_mm: [f32; 3],
}

impl Sample {
    fn new(along: Along<'_>, i: usize) -> Option<Self> {
        let is_vessel = matches!(along.standings[i], StationStatus::Counts | StationStatus::Thin);
        let radius = along.opened.radii_mm[i].filter(|_| is_vessel)?;
        let (at, diameter) = (f64::from(along.abscissas_mm[i]), 2.0 * f64::from(radius));
        let alone = alone(along.opened, i).unwrap_or(diameter);
        Some(Self { at, diameter, alone, at_mm: along.at_mm[i] })
    }
}

/// The diameter of the circle of the area of a cross-section, in mm.
fn alone(of: &OnSurface, i: usize) -> Option<f64> {
    Some(2.0 * circle(f64::from(of.areas_mm2[i]?)))
}

/// By which part a diameter differs, that way, from what it is usually.
fn departure(kind: Kind, ratio: f64) -> f64 {
    if kind == Kind::Narrower { 1.0 - ratio } else { ratio - 1.0 }
}

/// The diameter that the vessel has by itself at each station, in mm.
fn usual(all: &[Sample]) -> Vec<f64> {
    let diameter = median(all.iter().map(|sample| sample.diameter).collect());
    let reach = WINDOW * diameter;
    // Lines a diameter apart say enough.
    let mut usual = Vec::with_capacity(all.len());
    let mut line: Option<(f64, [f64; 2])> = None;
    for sample in all {
        let near = line.filter(|(at, _)| sample.at - at < diameter / 2.0);
        let (at, [height, slope]) = near.unwrap_or_else(|| {
            let from = all.partition_point(|other| other.at < sample.at - reach);
            let to = all.partition_point(|other| other.at <= sample.at + reach);
            (sample.at, repeated_median(&all[from..to], sample.at))
        });
        line = Some((at, [height, slope]));
        usual.push((height + slope * (sample.at - at)).max(0.0));
    }
    usual
}

/// Height at `at` and slope of the line through diameters by the repeated median.
fn repeated_median(near: &[Sample], at: f64) -> [f64; 2] {
    let count = near.len().min(MAX_STATIONS);
    let some: Vec<&Sample> = (0..count).map(|i| &near[i * near.len() / count]).collect();
    let slope_from = |a: &Sample| {
        let others = some.iter().filter(|b| b.at != a.at);
        median(others.map(|b| (b.diameter - a.diameter) / (b.at - a.at)).collect())
    };
    let slope = median(some.iter().map(|a| slope_from(a)).collect());
    [median(some.iter().map(|a| a.diameter - slope * (a.at - at)).collect()), slope]
}

/// The upper median; 0 of nothing.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// The stretch around the station that differs most; `None` where it does not differ so much from what
/// is on either side.
fn stretch(all: &[Sample], usual: &[f64], kind: Kind, peak: usize) -> Option<Variation> {
    let (mut first, mut last) = ends(all, kind, peak, |i| usual[i]);
    let (mut reference, mut beside) = ([usual[peak], 0.0], [None; 2]);
    // The reference says where it ends, and the ends where the reference is.
    for _ in 0..2 {
        beside = sides(all, first, last);
        reference = interpolated(beside, all[peak].at).unwrap_or([usual[peak], 0.0]);
        (first, last) = ends(all, kind, peak, |i| reference[0] + reference[1] * (all[i].at - all[peak].at));
    }
    let [expected, _] = reference;
    let diameter = extreme(all, kind, peak);
    let part = diameter / expected;
    let degree = departure(kind, part);
    // What goes on to where the vessel can no longer be measured may be its end or a fork.
    let is_between = first > 0 && last + 1 < all.len();
    if degree < MIN_DEGREE || last - first + 1 < FEWEST || !is_between {
        return None;
    }
    let mark = |i: usize| reference[0] + reference[1] * (all[i].at - all[peak].at);
    let (from_mm, to_mm) = (crossing(all, kind, [first, first - 1], mark), crossing(all, kind, [last, last + 1], mark));
    Some(Variation {
        kind,
        degree_percent: 100.0 * degree,
        area_percent: 100.0 * departure(kind, part * part),
        reduced_degree_percent: None,
        diameter_mm: diameter,
        reference_mm: expected,
        sides: beside,
        from_mm,
        to_mm,
        length_mm: to_mm - from_mm,
        abscissa_mm: all[peak].at,
        at_mm: all[peak].at_mm,
    })
}

/// The diameter at `peak`. A radius is a mean over a stretch as long as the vessel is wide, which flattens a bulge: of that
/// the middle one of three cross-sections is taken.
fn extreme(all: &[Sample], kind: Kind, peak: usize) -> f64 {
    match kind {
        Kind::Narrower => all[peak].diameter,
        Kind::Wider => {
            let near = &all[peak.saturating_sub(1)..(peak + 2).min(all.len())];
            median(near.iter().map(|sample| sample.alone).collect())
        }
    }
}

/// Where the diameter is within [`WITHIN`] of `expected`, between a station that is not and its neighbour that is: it goes
/// there in a straight line.
fn crossing(all: &[Sample], kind: Kind, [inner, outer]: [usize; 2], expected: impl Fn(usize) -> f64) -> f64 {
    let over = |i: usize| departure(kind, all[i].diameter / expected(i)) - WITHIN;
    let part = over(inner) / (over(inner) - over(outer));
    all[inner].at + (all[outer].at - all[inner].at) * part.clamp(0.0, 1.0)
}

/// The first and last station around `peak` that differ from `expected` by more than [`WITHIN`].
fn ends(all: &[Sample], kind: Kind, peak: usize, expected: impl Fn(usize) -> f64) -> (usize, usize) {
    let differs = |&i: &usize| departure(kind, all[i].diameter / expected(i).max(f64::MIN_POSITIVE)) > WITHIN;
    let first = (0..peak).rev().take_while(differs).last().unwrap_or(peak);
    let last = (peak + 1..all.len()).take_while(differs).last().unwrap_or(peak);
    (first, last)
}

/// What the vessel has before `first` and behind `last`; `None` of a side that is too short.
fn sides(all: &[Sample], first: usize, last: usize) -> [Option<Side>; 2] {
    let side = |samples: &[Sample], end: f64| {
        let wide = median(samples.iter().map(|sample| sample.diameter).collect());
        let is_beside = |sample: &&Sample| (SIDE.0 * wide..=SIDE.1 * wide).contains(&(sample.at - end).abs());
        let beside: Vec<&Sample> = samples.iter().filter(is_beside).collect();
        let abscissa_mm = beside.iter().map(|sample| sample.at).sum::<f64>() / beside.len() as f64;
        let diameter_mm = median(beside.iter().map(|sample| sample.diameter).collect());
        (beside.len() >= FEWEST).then_some(Side { abscissa_mm, diameter_mm })
    };
    [side(&all[..first], all[first].at), side(&all[last + 1..], all[last].at)]
}

/// Height at `at` and slope of the line from one side to the other; of one side where there is but one, `None` where there is
/// none.
fn interpolated(sides: [Option<Side>; 2], at: f64) -> Option<[f64; 2]> {
    match sides {
        [Some(before), Some(after)] => {
            let slope = (after.diameter_mm - before.diameter_mm) / (after.abscissa_mm - before.abscissa_mm);
            Some([before.diameter_mm + slope * (at - before.abscissa_mm), slope])
        }
        [Some(one), None] | [None, Some(one)] => Some([one.diameter_mm, 0.0]),
        [None, None] => None,
    }
}

impl Variation {
    /// With the degree of the reduced surface at the same place.
    fn reduced(self, along: Along<'_>) -> Self {
        let away = |i: usize| (f64::from(along.abscissas_mm[i]) - self.abscissa_mm).abs();
        let peak = (0..along.standings.len()).min_by(|&a, &b| away(a).total_cmp(&away(b)));
        let diameter = peak.and_then(|peak| match self.kind {
            Kind::Narrower => along.reduced.radii_mm[peak].map(|radius| 2.0 * f64::from(radius)),
            Kind::Wider => {
                let near = peak.saturating_sub(1)..(peak + 2).min(along.standings.len());
                near.map(|i| alone(along.reduced, i)).collect::<Option<Vec<f64>>>().map(median)
            }
        });
        let degree = diameter.map(|diameter| 100.0 * departure(self.kind, diameter / self.reference_mm));
        Self { reduced_degree_percent: degree, ..self }
    }
}
