//! What became of the vessels, in words.

use lumen_message::{Signed, grouped, messages};

use super::BranchName;
use super::certificate::{BranchCalibre, CalibreError, Certificate, Change, Verdict, measured_percent};

/// The branches as they are listed: those that change first, the most changed before the others.
pub fn in_order(found: &Certificate) -> Vec<&BranchCalibre> {
    let mut rows: Vec<&BranchCalibre> = found.branches.iter().collect();
    let change = |branch: &BranchCalibre| {
        let change = branch.reduced.largest_change.filter(|_| branch.verdict == Verdict::Changed);
        change.map_or(0.0, |change| change.percent.abs())
    };
    rows.sort_by(|a, b| change(b).total_cmp(&change(a)));
    rows
}

/// Below this part of all vessels, in percent, a verdict is said to rest on little.
const LITTLE: f64 = 25.0;

messages! {
    /// What became of all vessels, in a sentence.
    #[derive(Clone, Debug, PartialEq)]
    pub enum CalibreFinding {
        /// There are none.
        "vessels-none" None {
            /// The reason.
            why: CalibreError,
        } => "There are no vessels to measure: {why}.",
        /// None can be measured.
        "vessels-none-measured" NoneMeasured => "No vessel can be measured.",
        /// All that are measured keep their calibre.
        "vessels-all-kept" AllKept {
            /// How many.
            count: usize,
            /// The change that is allowed, in percent.
            tolerance: f64,
        } => {
            match count {
                1 => format!("The vessel keeps its calibre to {tolerance} %."),
                _ => format!("All {} vessels keep their calibre to {tolerance} %.", grouped(count)),
            }
        },
        /// Some change; by how much at most is not known.
        "vessels-changed" Changed {
            /// How many change.
            changed: usize,
            /// How many are measured.
            all: usize,
            /// The change that is allowed, in percent.
            tolerance: f64,
        } => {
            let verb = if *changed == 1 { "changes" } else { "change" };
            format!("{} of {} vessels {verb} by more than {tolerance} %.", grouped(changed), grouped(all))
        },
        /// Some change.
        "vessels-changed-most" ChangedMost {
            /// How many change.
            changed: usize,
            /// How many are measured.
            all: usize,
            /// The change that is allowed, in percent.
            tolerance: f64,
            /// The one that changes the most.
            name: BranchName,
            /// Its change, in percent.
            by: Signed<1>,
        } => {
            let verb = if *changed == 1 { "changes" } else { "change" };
            let (changed, all) = (grouped(changed), grouped(all));
            format!("{changed} of {all} vessels {verb} by more than {tolerance} %, {name} the most: {by} %.")
        },
        /// The verdict rests on little.
        "vessels-little" Little {
            /// The part that is measured, in percent.
            percent: f64 [0],
        } => "That is said of {percent:.0} % of their length: the rest lies at ends or forks or is too coarse.",
        /// Smoothing alone changes some.
        "vessels-by-smoothing" BySmoothing {
            /// How many.
            count: usize,
        } => { format!("Smoothing itself changes {} of them so much.", grouped(count)) },
        /// Some cannot be measured.
        "vessels-unknown" Unknown {
            /// How many.
            count: usize,
        } => {
            match count {
                1 => "One is too short or too coarse to be measured.".to_owned(),
                _ => format!("{} are too short or too coarse to be measured.", grouped(count)),
            }
        },
    }
}

messages! {
    /// What became of all vessels, in one sentence or a few.
    #[derive(Clone, Debug, PartialEq)]
    pub enum CalibreSummary {
        /// A sentence and those that follow.
        "vessels-sentences" Sentences {
            /// The first.
            first: CalibreFinding,
            /// What follows.
            rest: Box<CalibreSummary>,
        } => "{first} {rest}",
    } or {
        /// One sentence.
        One(CalibreFinding),
    }
}

messages! {
    /// What there is to say of a place of a vessel.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum PlaceText {
        /// The change of its radius.
        "vessels-place" Changed {
            /// The vessel.
            name: BranchName,
            /// In percent.
            percent: Signed<1>,
        } => "{name}: {percent} %",
    }
}

/// What became of all of them.
pub fn summary(found: &Result<Certificate, CalibreError>) -> CalibreSummary {
    let found = match found {
        Ok(found) => found,
        Err(why) => return CalibreFinding::None { why: why.clone() }.into(),
    };
    let of = |verdict: Verdict| found.branches.iter().filter(move |branch| branch.verdict == verdict);
    let (kept, changed, unknown) =
        (of(Verdict::Kept).count(), of(Verdict::Changed).count(), of(Verdict::NotMeasured).count());
    let (all, tolerance) = (kept + changed, found.tolerance_percent);
    let largest = |branch: &&BranchCalibre| branch.reduced.largest_change.map_or(0.0, |change| change.percent.abs());
    let worst = of(Verdict::Changed).max_by(|a, b| largest(a).total_cmp(&largest(b)));
    let first = match (kept, changed, worst.and_then(|worst| Some((worst, worst.reduced.largest_change?)))) {
        (0, 0, _) => CalibreFinding::NoneMeasured,
        (_, 0, _) => CalibreFinding::AllKept { count: kept, tolerance },
        (_, _, Some((worst, change))) => {
            CalibreFinding::ChangedMost { changed, all, tolerance, name: worst.label(), by: Signed(change.percent) }
        }
        (_, _, None) => CalibreFinding::Changed { changed, all, tolerance },
    };
    let mut sentences = vec![first];
    if let Some(percent) = measured_percent(&found.branches).filter(|&part| part < LITTLE && all > 0) {
        sentences.push(CalibreFinding::Little { percent });
    }
    let by_smoothing = of(Verdict::Changed).filter(|branch| branch.verdict_smoothed == Verdict::Changed).count();
    if by_smoothing > 0 {
        sentences.push(CalibreFinding::BySmoothing { count: by_smoothing });
    }
    if unknown > 0 && all > 0 {
        sentences.push(CalibreFinding::Unknown { count: unknown });
    }
    let last = sentences.pop().map_or(CalibreSummary::One(CalibreFinding::NoneMeasured), CalibreSummary::One);
    sentences.into_iter().rev().fold(last, |rest, first| CalibreSummary::Sentences { first, rest: Box::new(rest) })
}

/// What there is to say of a place.
pub fn place(branch: &BranchCalibre, change: &Change) -> PlaceText {
    PlaceText::Changed { name: branch.label(), percent: Signed(change.percent) }
}

/// Made-up branches, for tests of what is said of certificates.
#[doc(hidden)]
pub mod fixtures {
    use super::*;
    use crate::certificate::{OnSurface, Spread};

    /// Branch `number`, whose calibre has changed by `percent`.
    pub fn branch(number: u32, percent: Option<f64>) -> BranchCalibre {
        let change = |percent| Change { percent, at_mm: [1.0, 2.0, 3.0], abscissa_mm: 4.0 };
        let on = |percent: Option<f64>| OnSurface { largest_change: percent.map(change), ..OnSurface::default() };
        BranchCalibre {
            number,
            name: format!("branch {number}"),
            parent: None,
            length_mm: 12.34,
            tortuosity: None,
            verdict: match percent {
                None => Verdict::NotMeasured,
                Some(percent) if percent.abs() <= 2.0 => Verdict::Kept,
                Some(_) => Verdict::Changed,
            },
            verdict_smoothed: Verdict::Kept,
            stations_counted: 0,
            abscissas_mm: Vec::new(),
            at_mm: Vec::new(),
            standings: Vec::new(),
            opened: OnSurface {
                radius_mm: Some(Spread { least: 1.0, mean: 1.5, largest: 2.0 }),
                ..OnSurface::default()
            },
            smoothed: on(Some(0.04)),
            reduced: on(percent),
            variations: Vec::new(),
        }
    }

    /// A certificate of such branches.
    pub fn certificate(percents: &[Option<f64>]) -> Result<Certificate, CalibreError> {
        let branches = (1..).zip(percents).map(|(number, &percent)| branch(number, percent)).collect();
        Ok(Certificate { tolerance_percent: 2.0, verdict: Verdict::Kept, branches })
    }
}

#[cfg(test)]
mod tests {
    use super::fixtures::certificate;
    use super::*;
    use crate::TreeError;
    use crate::certificate::StationStatus;

    fn sentence(found: &Result<Certificate, CalibreError>) -> String {
        summary(found).to_string()
    }

    #[test]
    fn the_sentence_says_how_many_and_which_is_worst() {
        assert_eq!(sentence(&certificate(&[Some(0.5)])), "The vessel keeps its calibre to 2 %.");
        assert_eq!(sentence(&certificate(&[Some(0.5), Some(-2.0)])), "All 2 vessels keep their calibre to 2 %.");
        let found = certificate(&[Some(2.5), Some(-9.04), None, Some(1.0)]);
        let order: Vec<u32> = in_order(found.as_ref().unwrap()).iter().map(|branch| branch.number).collect();
        assert_eq!(order, [2, 1, 3, 4]);
        let text = sentence(&found);
        assert_eq!(
            text,
            "2 of 3 vessels change by more than 2 %, branch 2 the most: -9.0 %. \
             One is too short or too coarse to be measured."
        );
        assert_eq!(sentence(&certificate(&[None])), "No vessel can be measured.");
        assert!(sentence(&Err(TreeError::NoTriangles.into())).ends_with("the surface has no triangles."));
    }

    #[test]
    fn a_branch_is_read_from_its_english_name() {
        let name = BranchName::read("branch 3").unwrap();
        assert_eq!((name, &*name.to_string()), (BranchName::Numbered { number: 3 }, "branch 3"));
        assert_eq!(BranchName::read("aorta"), None);
    }

    #[test]
    fn a_verdict_that_rests_on_little_says_so() {
        let mut found = certificate(&[Some(0.5)]).unwrap();
        found.branches[0].standings = vec![StationStatus::Thin; 10];
        found.branches[0].stations_counted = 2;
        assert!(sentence(&Ok(found.clone())).contains("That is said of 20 % of their length"));
        found.branches[0].stations_counted = 3;
        assert_eq!(sentence(&Ok(found)), "The vessel keeps its calibre to 2 %.");
    }
}
