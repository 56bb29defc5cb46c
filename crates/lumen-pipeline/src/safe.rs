//! How far a reduction is safe: up to which rate every branch of the vessel tree keeps its calibre.
//!
//! A level is judged as the certificate of calibre judges it (`lumen_vessel::certificate`), at the stations of the
//! opened surface. Looked at are a row of rates, from 0 on, closer together where reductions are strong, and then,
//! between the last at which all vessels kept their calibre and the first at which one did not, halves of halves, down
//! to a tenth of a percent. So the rate that is marked was looked at, and so was the next one above, which is not safe;
//! a vessel that is changed at a rate in between the others and comes back is not seen. A rate at which a vessel is
//! pinched anywhere (`super::pinch`, which looks at every rate) is not safe either. That no triangles cross that did
//! not is so at every rate.
//!
//! Branches that smoothing itself has changed by more are told, and do not count: no rate would be safe for them, and the
//! surface as a whole is not called safe at any. A
//! branch of which a tenth can no longer be measured counts as changed, but for places where the plane has another loop
//! though the wall has not moved (`StationStatus::Ambiguous`): of these there is nothing to say, neither for nor against.
//!
//! What is said is said of what is measured (`lumen_vessel::certificate::Coverage`). Where enough of the length is measured at
//! first, a rate at which less is measured is not safe. Where it is not at first, the vessels are kept up to the rate as far as
//! they are measured, and the surface as a whole is not called safe at any.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::pinch::{Pinch, PinchMessage};
use super::progressive::ProgressiveMesh;
use super::results::LevelCalibres;
use super::settings::{Target, reduction_percent};
use super::task::Yielder;
use lumen_mesh::TriMesh;
use lumen_message::{Signed, messages};
use lumen_vessel::certificate::{Basis, BranchCalibre, CalibreError, Coverage, StationStatus, Verdict};
use lumen_vessel::{Asked, BranchName, Subject};

/// The rates that are looked at, in tenths of a percent; the first is the smoothed surface itself.
const RATES: [u32; 15] = [0, 750, 850, 900, 925, 950, 960, 970, 975, 980, 985, 990, 995, 998, 999];

/// The rate that is looked at first between the first two of the row.
const FIRST_BETWEEN: u32 = 500;

/// The part of a branch's stations that have to be measured still: where the surface is folded a cut does not close.
const MEASURED: f64 = 0.9;

/// How far a reduction is safe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Safe {
    /// The change of calibre in percent that is allowed.
    pub tolerance_percent: f64,
    /// The highest rate up to which every vessel keeps its calibre, as far as it is measured, in percent; `None` where no
    /// vessel can be measured.
    pub percent: Option<f64>,
    /// Triangles at that rate.
    pub triangles: Option<usize>,
    /// How much of the vessels is kept at that rate, those not that smoothing has changed; `None` where there is none.
    pub coverage: Option<Coverage>,
    /// Why it does not go further; `None` where nothing stops it.
    pub stopped_by: Option<Stop>,
    /// Each branch by itself.
    pub branches: Vec<BranchSafe>,
    /// Why there is no such rate; `None` where there is one.
    pub refused: Option<NoSafeRate>,
}

messages! {
    /// What stops a reduction, without a full stop.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum Stop {
        /// A branch is changed at the next rate.
        "verdict-safe-changed" Changed {
            /// The next rate, in percent.
            rate: f64 [1],
            /// The branch.
            name: BranchName,
            /// The change of its calibre, in percent.
            by: Signed<1>,
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
        } => "At {rate:.1} % {name} changes by {by} %, at ({x:.1}, {y:.1}, {z:.1})",
        /// A branch cannot be measured at the next rate.
        "verdict-safe-unmeasured" Unmeasured {
            /// The next rate, in percent.
            rate: f64 [1],
            /// The branch.
            name: BranchName,
        } => "At {rate:.1} % {name} can no longer be measured",
        /// Too little can be measured at the next rate.
        "verdict-safe-uncovered" Uncovered {
            /// The next rate, in percent.
            rate: f64 [1],
            /// The part of the length that can be measured, in percent.
            percent: f64 [0],
        } => "At {rate:.1} % no more than {percent:.0} % of the vessels' length can be measured",
    } or {
        /// A vessel is pinched at the next rate.
        Pinched(PinchMessage),
    }
}

messages! {
    /// Why no rate is safe, without a full stop.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum NoSafeRate {
        /// Smoothing leaves no branch its calibre.
        "verdict-safe-none-kept" NoneKept => "smoothing itself changes every vessel that can be measured",
        /// No branch is measured.
        "verdict-safe-none-measured" NoneMeasured => "no vessel can be measured",
    } or {
        /// There is no vessel tree.
        NoTree(CalibreError),
    }
}

messages! {
    /// A level is reduced further than is safe.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum PastSafe {
        /// There is a rate at which what is measured keeps its calibre.
        "verdict-safe-past" Past {
            /// The triangles of the level.
            triangles: usize,
            /// The highest such rate, in percent.
            rate: f64 [1],
            /// The triangles at that rate.
            kept: usize,
        } => "Reduced too far for the measured vessels to keep their calibre: {triangles} triangles are left, and they keep \
              it down to {kept}, at {rate:.1} %. Try that rate: a vessel may be too narrow for the wire by the reduction \
              alone.",
    }
}

/// How far a reduction is safe for a branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchSafe {
    /// Its number, from 1.
    pub number: u32,
    /// "branch 1" for the first.
    pub name: String,
    /// Whether smoothing alone has changed it by more than is allowed: then it does not count.
    pub changed_by_smoothing: bool,
    /// The highest rate that was looked at with all those below it keeping the branch, in percent; null where there is none.
    pub kept_to_percent: Option<f64>,
    /// The next rate that was looked at, at which it is changed; null where it is kept as far as was looked.
    pub changed_from_percent: Option<f64>,
}

/// What a rate stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// It is safe for the whole surface: enough is measured, and kept.
    Safe,
    /// Vessels are kept up to it where they are measured, which is not enough for the whole surface.
    KeptWhereMeasured,
    /// No vessel is pinched up to it; of their calibre nothing is known beyond it, or nothing at all.
    NotPinched,
}

impl Safe {
    /// What the rate stands for that it goes up to: by the coverage that the verdict on that level has.
    pub fn claim(&self) -> Claim {
        match (&self.stopped_by, self.percent) {
            _ if self.is_covered() => Claim::Safe,
            (Some(Stop::Pinched(_)), _) | (_, None) => Claim::NotPinched,
            _ => Claim::KeptWhereMeasured,
        }
    }

    /// The rate of [`Target::Auto`] in tenths of a percent: 90 %, or the highest that is safe where that is less. Where no
    /// vessel can be measured there is no such rate, and the first `pinch` alone stops it.
    pub fn auto(&self, pinch: Option<Pinch>) -> u32 {
        let in_tenths = |percent: f64| (10.0 * percent).round() as u32;
        let stop = match (self.percent, &self.stopped_by) {
            (Some(percent), Some(_)) => Some(in_tenths(percent)),
            // The surface goes no further, or nothing stops it.
            (Some(_), None) => None,
            (None, _) => pinch.map(|pinch| in_tenths(pinch.from_percent).saturating_sub(1)),
        };
        stop.map_or(Target::AUTO_PER_MILLE, |stop| stop.min(Target::AUTO_PER_MILLE))
    }

    /// Says that a level of so many triangles is past the highest rate; `None` where it is not, where nothing stops a reduction
    /// and where there is no such rate.
    pub fn past(&self, triangles: usize) -> Option<PastSafe> {
        let (rate, kept) = (self.percent?, self.triangles?);
        (self.stopped_by.is_some() && triangles < kept).then_some(PastSafe::Past { triangles, rate, kept })
    }

    /// No rate, for this reason.
    pub fn refused(tolerance_percent: f64, why: NoSafeRate) -> Self {
        let refused = Some(why);
        let (percent, triangles, coverage, stopped_by, branches) = (None, None, None, None, Vec::new());
        Self { tolerance_percent, percent, triangles, coverage, stopped_by, branches, refused }
    }

    /// Whether the rate is safe for the whole surface, and not only kept where it is measured: enough is measured, and
    /// smoothing has changed no vessel.
    pub fn is_covered(&self) -> bool {
        let is_changed = self.branches.iter().any(|branch| branch.changed_by_smoothing);
        !is_changed && self.coverage.is_some_and(|found| found.is_enough())
    }
}

/// How far the levels of `progressive`, which was made from the smoothed surface of `basis`, are safe, and the calibres at the
/// rate of [`Target::Auto`], if that is 90 %; `pinch` is the first, and `known` are the calibres of some level. To take a
/// level out is one piece.
pub(crate) async fn safe_in_slices(
    basis: &Basis,
    progressive: &ProgressiveMesh,
    pinch: Option<Pinch>,
    tolerance_percent: f64,
    known: Option<&LevelCalibres>,
    yielder: &Yielder,
) -> (Safe, Option<LevelCalibres>) {
    let (triangles, branches) = (progressive.triangles.len(), basis.of_smoothed(tolerance_percent));
    let looks = vec![Look { per_mille: 0, reached: None, steps: 0, triangles, branches }];
    let mut search = Search { pinch, tolerance_percent, looks };
    while let Some(rate) = search.next_rate() {
        let done = search.fraction();
        yielder.rest(done).await;
        let (look, mesh) = Look::at(progressive, rate);
        let branches = match known.and_then(|known| known.at(look.steps, tolerance_percent)) {
            Some(known) => known,
            None => {
                let (subject, part) = (Subject::new(&Arc::new(mesh)), yielder.part(done..done));
                // Of the level that is taken everything is told; the certificate has it then.
                let asked = if rate == Target::AUTO_PER_MILLE { Asked::SectionAndBall } else { Asked::Section };
                basis.measured(&subject, asked, tolerance_percent, &part).await
            }
        };
        search.add(Look { branches, ..look });
    }
    let safe = search.found();
    let is_taken = safe.auto(pinch) == Target::AUTO_PER_MILLE;
    let there = search.looks.into_iter().find(|look| is_taken && look.per_mille == Target::AUTO_PER_MILLE);
    let there = there.map(|Look { steps, branches, .. }| LevelCalibres { steps, tolerance_percent, branches });
    (safe, there)
}

/// The search for the highest rate that is safe.
struct Search {
    pinch: Option<Pinch>,
    tolerance_percent: f64,
    /// What was found at each rate that was looked at.
    looks: Vec<Look>,
}

/// A rate that was looked at.
struct Look {
    /// That was asked for.
    per_mille: u32,
    /// That was reached, where the surface goes no further: then no higher one is looked at.
    reached: Option<f64>,
    steps: u32,
    triangles: usize,
    branches: Vec<BranchCalibre>,
}

impl Look {
    /// The level for a rate, not judged yet, and its surface.
    fn at(progressive: &ProgressiveMesh, per_mille: u32) -> (Self, TriMesh) {
        let level = progressive.level(Target::Reduction(per_mille));
        let (count, triangles) = (progressive.triangles.len(), level.triangles.len());
        let reached = level.shortfall.is_some().then(|| (10.0 * reduction_percent(count, triangles)).floor() / 10.0);
        let look = Self { per_mille, reached, steps: level.steps, triangles, branches: Vec::new() };
        (look, progressive.extract(&level.triangles))
    }

    fn coverage(&self) -> Coverage {
        Coverage::of(&self.branches)
    }

    fn percent(&self) -> f64 {
        self.reached.unwrap_or(f64::from(self.per_mille) / 10.0)
    }
}

impl Search {
    /// Whether smoothing left branch `i` its calibre, as far as it can be measured.
    fn counts(&self, i: usize) -> bool {
        self.looks.first().is_some_and(|look| look.branches[i].verdict_smoothed != Verdict::Changed)
    }

    /// Whether branch `i` has changed there by more than it may, or can no longer be measured, as it could before.
    fn is_changed(&self, look: &Look, i: usize) -> bool {
        let Some(first) = self.looks.first().map(|first| &first.branches[i]) else { return false };
        let branch = &look.branches[i];
        match branch.verdict {
            Verdict::Changed => true,
            Verdict::Kept => is_lost(first, branch),
            Verdict::NotMeasured => first.verdict == Verdict::Kept && is_lost(first, branch),
        }
    }

    /// The first branch that counts and is changed there.
    fn changed<'a>(&self, look: &'a Look) -> Option<&'a BranchCalibre> {
        let changed = (0..look.branches.len()).find(|&i| self.counts(i) && self.is_changed(look, i));
        changed.map(|i| &look.branches[i])
    }

    fn is_pinched(&self, per_mille: u32) -> bool {
        self.pinch.is_some_and(|pinch| f64::from(per_mille) / 10.0 >= pinch.from_percent - 1e-6)
    }

    /// How much of the vessels is kept there, where it is safe.
    fn kept(&self, look: &Look) -> Coverage {
        let changed = look.branches.iter().enumerate().filter(|(i, _)| !self.counts(*i));
        changed.fold(look.coverage(), |coverage, (_, branch)| coverage.without(branch))
    }

    /// Whether too little is measured there, though at first it was enough.
    fn is_uncovered(&self, look: &Look) -> bool {
        let is_enough = |look: &Look| look.coverage().is_enough();
        self.looks.first().is_some_and(is_enough) && !is_enough(look)
    }

    fn is_safe(&self, look: &Look) -> bool {
        self.changed(look).is_none() && !self.is_pinched(look.per_mille) && !self.is_uncovered(look)
    }

    /// The last rate that is safe with all before it, and the first that is not.
    fn bounds(&self) -> (Option<&Look>, Option<&Look>) {
        let first_bad = self.looks.iter().find(|look| !self.is_safe(look));
        let last_good = self.looks.iter().take_while(|look| self.is_safe(look)).last();
        (last_good, first_bad)
    }

    /// The rate to look at next: of the row, as long as some branch is still kept, then halves.
    fn next_rate(&self) -> Option<u32> {
        let last_of_row = self.looks.iter().map(|look| look.per_mille).filter(|rate| RATES.contains(rate)).max();
        let is_any_kept = self.looks.last().is_none_or(|look| {
            let kept = |i: &usize| self.counts(*i) && look.branches[*i].verdict == Verdict::Kept;
            (0..look.branches.len()).any(|i| kept(&i))
        });
        let goes_on = self.looks.iter().all(|look| look.reached.is_none());
        let next_of_row = RATES.into_iter().find(|&rate| goes_on && last_of_row.is_none_or(|last| rate > last));
        // Beyond a pinch branches are still told apart, as long as the row goes.
        if let Some(rate) = next_of_row.filter(|_| is_any_kept) {
            return Some(rate);
        }
        let (good, bad) = self.bounds();
        let (good, bad) = (good?.per_mille, bad?.per_mille);
        // A level of many triangles takes longest to look at: 50 % costs less than the middle of the two, 37.5 %.
        if (good, bad) == (RATES[0], RATES[1]) {
            return Some(FIRST_BETWEEN);
        }
        (bad - good > 1).then(|| good.midpoint(bad))
    }

    fn add(&mut self, look: Look) {
        let at = self.looks.partition_point(|other| other.per_mille < look.per_mille);
        self.looks.insert(at, look);
    }

    /// The part that is done, 0 to 1.
    fn fraction(&self) -> f32 {
        (self.looks.len() as f32 / (RATES.len() + 6) as f32).min(1.0)
    }

    fn found(&self) -> Safe {
        let (good, bad) = self.bounds();
        let first = self.looks.first().map_or(&[][..], |look| &look.branches);
        let has = |verdict: Verdict| first.iter().any(|branch| branch.verdict == verdict);
        let can_measure = has(Verdict::Kept);
        let refused = match (can_measure, has(Verdict::Changed)) {
            (true, _) => None,
            (false, true) => Some(NoSafeRate::NoneKept),
            (false, false) => Some(NoSafeRate::NoneMeasured),
        };
        let good = good.filter(|_| can_measure);
        let stopped_by = bad.filter(|_| can_measure).and_then(|look| match self.changed(look) {
            Some(branch) => Some(match branch.reduced.largest_change {
                Some(change) if branch.verdict == Verdict::Changed => {
                    let ([x, y, z], by) = (change.at_mm, Signed(change.percent));
                    Stop::Changed { rate: look.percent(), name: branch.label(), by, x, y, z }
                }
                _ => Stop::Unmeasured { rate: look.percent(), name: branch.label() },
            }),
            None if self.is_uncovered(look) => {
                Some(Stop::Uncovered { rate: look.percent(), percent: look.coverage().percent().floor() })
            }
            None => self.pinch.map(|pinch| Stop::Pinched(pinch.message())),
        });
        Safe {
            tolerance_percent: self.tolerance_percent,
            percent: good.map(Look::percent),
            triangles: good.map(|look| look.triangles),
            coverage: good.map(|look| self.kept(look)),
            stopped_by,
            branches: first.iter().enumerate().map(|(i, branch)| self.branch(i, branch)).collect(),
            refused,
        }
    }

    fn branch(&self, i: usize, branch: &BranchCalibre) -> BranchSafe {
        let is_kept = |look: &&Look| look.branches[i].verdict == Verdict::Kept;
        BranchSafe {
            number: branch.number,
            name: branch.name.clone(),
            changed_by_smoothing: !self.counts(i),
            kept_to_percent: self.looks.iter().take_while(is_kept).last().map(Look::percent),
            changed_from_percent: self.looks.iter().find(|look| self.is_changed(look, i)).map(Look::percent),
        }
    }
}

/// Whether so much of what was measured of a branch is measured no more that there is no saying it is kept.
fn is_lost(first: &BranchCalibre, now: &BranchCalibre) -> bool {
    let was_counted = first.standings.iter().zip(&now.standings).filter(|of| *of.0 == StationStatus::Counts);
    let still = was_counted.filter(|of| matches!(of.1, StationStatus::Counts | StationStatus::Ambiguous)).count();
    (still as f64) < MEASURED * first.stations_counted as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_vessel::summary::fixtures::branch;

    #[test]
    fn auto_is_ninety_percent_or_as_far_as_is_safe_whichever_is_less() {
        let pinch = |from_percent: f64| Pinch {
            from_percent,
            triangles: 100,
            at_mm: [0.0; 3],
            diameter_before_mm: 2.0,
            diameter_after_mm: 0.0,
        };
        let stopped = |percent: f64| {
            let refused = Safe::refused(2.0, NoSafeRate::NoneMeasured);
            let stopped_by = Some(Stop::Pinched(pinch(percent + 0.1).message()));
            Safe { percent: Some(percent), stopped_by, refused: None, ..refused }
        };
        for (percent, auto) in [(97.5, 900), (90.0, 900), (89.9, 899), (67.1, 671), (0.0, 0)] {
            assert_eq!(stopped(percent).auto(Some(pinch(percent + 0.1))), auto, "{percent}");
        }
        // A surface that goes no further than 67.1 % has nothing against 90.
        assert_eq!(Safe { stopped_by: None, ..stopped(67.1) }.auto(None), 900);
        // No vessel is measured: a pinch is known all the same.
        let refused = Safe::refused(2.0, NoSafeRate::NoneMeasured);
        let pinched = [None, Some(50.0), Some(95.0), Some(0.0)].map(|from| refused.auto(from.map(pinch)));
        assert_eq!(pinched, [900, 499, 900, 0]);
    }

    #[test]
    fn a_level_is_past_the_safe_rate_with_fewer_triangles_where_something_stops_it() {
        let stopped_by = Some(Stop::Unmeasured { rate: 75.1, name: branch(1, None).label() });
        let refused = Safe::refused(2.0, NoSafeRate::NoneMeasured);
        let safe = Safe { percent: Some(75.0), triangles: Some(2500), stopped_by, refused: None, ..refused.clone() };
        assert_eq!([2500, 5000].map(|triangles| safe.past(triangles)), [None, None]);
        let said = safe.past(1000).unwrap().to_string();
        assert!(said.contains("1000 triangles are left, and they keep it down to 2500, at 75.0 %"), "{said}");
        // A surface that goes no further is safe all the way; where nothing is measured there is no rate.
        assert_eq!(Safe { stopped_by: None, ..safe }.past(1000), None);
        assert_eq!(refused.past(1000), None);
    }

    #[test]
    fn a_rate_is_called_safe_only_where_enough_is_measured() {
        let pinch = Pinch {
            from_percent: 60.0,
            triangles: 100,
            at_mm: [0.0; 3],
            diameter_before_mm: 2.0,
            diameter_after_mm: 0.0,
        };
        let changed = Stop::Unmeasured { rate: 56.0, name: branch(1, None).label() };
        let measured = |percent: f64| Coverage {
            length_mm: 100.0,
            measured_mm: percent,
            vessels: 2,
            vessels_measured: 2,
            ..Coverage::default()
        };
        let safe = |stopped_by: &Stop, measured_percent: f64| Safe {
            percent: Some(55.5),
            coverage: Some(measured(measured_percent)),
            stopped_by: Some(stopped_by.clone()),
            refused: None,
            ..Safe::refused(2.0, NoSafeRate::NoneMeasured)
        };
        assert_eq!(safe(&changed, 80.0).claim(), Claim::Safe);
        assert_eq!(safe(&changed, 74.0).claim(), Claim::KeptWhereMeasured);
        assert_eq!(safe(&Stop::Pinched(pinch.message()), 80.0).claim(), Claim::Safe);
        assert_eq!(safe(&Stop::Pinched(pinch.message()), 74.0).claim(), Claim::NotPinched);
        assert_eq!(Safe::refused(2.0, NoSafeRate::NoneMeasured).claim(), Claim::NotPinched);
    }

    #[test]
    fn what_can_no_longer_be_measured_is_lost_but_for_places_without_a_saying() {
        let with = |counts: usize, ambiguous: usize, open: usize| {
            let mut branch = branch(1, Some(0.5));
            branch.standings = vec![StationStatus::Counts; counts];
            branch.standings.extend(vec![StationStatus::Ambiguous; ambiguous]);
            branch.standings.extend(vec![StationStatus::NotClosed; open]);
            branch.stations_counted = counts;
            branch
        };
        let first = with(20, 0, 0);
        for (now, expected) in
            [(with(20, 0, 0), false), (with(18, 0, 2), false), (with(17, 0, 3), true), (with(2, 18, 0), false)]
        {
            assert_eq!(is_lost(&first, &now), expected, "{:?}", now.standings);
        }
    }
}
