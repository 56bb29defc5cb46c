//! What became of the vessels, in words.

use lumen_message::{Signed, grouped, messages};

use super::BranchName;
use super::certificate::{BranchCalibre, CalibreError, Certificate, Change, Coverage, Verdict};

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

/// Parts of the length of less than so many percent are not told.
const PART: f64 = 0.5;

messages! {
    /// How much is measured, after a head or a colon.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum CoverageText {
        /// By length and by vessels.
        "vessels-coverage" Of {
            /// The part of the length, in percent: never more than it is.
            percent: f64 [0],
            /// Vessels that are measured somewhere.
            measured: usize,
            /// All vessels.
            all: usize,
        } => {
            let vessels = if *all == 1 { "vessel" } else { "vessels" };
            format!("{percent:.0} % of the length, {} of {} {vessels}", grouped(measured), grouped(all))
        },
    }
}

impl Coverage {
    /// As "52 % of the length, 4 of 17 vessels".
    pub fn text(&self) -> CoverageText {
        CoverageText::Of { percent: self.percent().floor(), measured: self.vessels_measured, all: self.vessels }
    }
}

messages! {
    /// Where the calibre is not measured.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum Unmeasured {
        /// At ends.
        "vessels-part-ends" Ends {
            /// The part of the length, in percent.
            percent: f64 [0],
        } => "{percent:.0} % at ends",
        /// At forks.
        "vessels-part-forks" Forks {
            /// The part of the length, in percent.
            percent: f64 [0],
        } => "{percent:.0} % at forks",
        /// Where the surface is too coarse.
        "vessels-part-thin" Thin {
            /// The part of the length, in percent.
            percent: f64 [0],
        } => "{percent:.0} % too coarse",
        /// Where a cross-section does not close, or is more than one.
        "vessels-part-unclear" Unclear {
            /// The part of the length, in percent.
            percent: f64 [0],
        } => "{percent:.0} % without one closed outline",
    }
}

messages! {
    /// Some of them.
    #[derive(Clone, Debug, PartialEq)]
    pub enum UnmeasuredParts {
        /// One and those that follow.
        "vessels-parts" More {
            /// The first.
            first: Unmeasured,
            /// What follows.
            rest: Box<UnmeasuredParts>,
        } => "{first}, {rest}",
    } or {
        /// One.
        One(Unmeasured),
    }
}

/// Where the calibre is not measured, the greatest part first.
fn unmeasured(found: &Coverage) -> Option<UnmeasuredParts> {
    type Part = fn(f64) -> Unmeasured;
    let mut parts: [(f64, Part); 4] = [
        (found.ends_mm, |percent| Unmeasured::Ends { percent }),
        (found.forks_mm, |percent| Unmeasured::Forks { percent }),
        (found.thin_mm, |percent| Unmeasured::Thin { percent }),
        (found.unclear_mm, |percent| Unmeasured::Unclear { percent }),
    ];
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let told = parts.into_iter().map(|(mm, part)| (found.percent_of(mm), part)).filter(|(percent, _)| *percent >= PART);
    told.rev().fold(None, |rest, (percent, part)| {
        let first = part(percent);
        Some(match rest {
            Some(rest) => UnmeasuredParts::More { first, rest: Box::new(rest) },
            None => UnmeasuredParts::One(first),
        })
    })
}

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
        /// Not all are measured; those that are keep their calibre.
        "vessels-kept-of" KeptOf {
            /// How many are measured.
            count: usize,
            /// How many there are.
            all: usize,
            /// The change that is allowed, in percent.
            tolerance: f64,
        } => {
            let (measured, all) = (grouped(count), grouped(all));
            match count {
                1 => format!("1 of {all} vessels was measured: it keeps its calibre to {tolerance} %."),
                _ => format!("{measured} of {all} vessels were measured: they keep their calibre to {tolerance} %."),
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
            format!("{} of {} measured vessels {verb} by more than {tolerance} %.", grouped(changed), grouped(all))
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
            format!("{changed} of {all} measured vessels {verb} by more than {tolerance} %, {name} the most: {by} %.")
        },
        /// What the verdict rests on.
        "vessels-measured-over" MeasuredOver {
            /// The part of the length that is measured, in percent: never more than it is.
            percent: f64 [0],
            /// Where it is not.
            parts: UnmeasuredParts,
        } => "Measured over {percent:.0} % of the length; not over {parts}.",
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
        /// No vessel was found at some open ends.
        "vessels-open-ends" OpenEnds {
            /// How many.
            count: usize,
        } => {
            match count {
                1 => "No vessel was found at one open end.".to_owned(),
                _ => format!("No vessel was found at {} open ends.", grouped(count)),
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
    let (measured, tolerance) = (kept + changed, found.tolerance_percent);
    let largest = |branch: &&BranchCalibre| branch.reduced.largest_change.map_or(0.0, |change| change.percent.abs());
    let worst = of(Verdict::Changed).max_by(|a, b| largest(a).total_cmp(&largest(b)));
    let first = match (kept, changed, worst.and_then(|worst| Some((worst, worst.reduced.largest_change?)))) {
        (0, 0, _) => CalibreFinding::NoneMeasured,
        (_, 0, _) if unknown > 0 => CalibreFinding::KeptOf { count: kept, all: kept + unknown, tolerance },
        (_, 0, _) => CalibreFinding::AllKept { count: kept, tolerance },
        (_, _, Some((worst, change))) => {
            let (name, by) = (worst.label(), Signed(change.percent));
            CalibreFinding::ChangedMost { changed, all: measured, tolerance, name, by }
        }
        (_, _, None) => CalibreFinding::Changed { changed, all: measured, tolerance },
    };
    let mut sentences = vec![first];
    let by_smoothing = of(Verdict::Changed).filter(|branch| branch.verdict_smoothed == Verdict::Changed).count();
    if by_smoothing > 0 {
        sentences.push(CalibreFinding::BySmoothing { count: by_smoothing });
    }
    if unknown > 0 && changed > 0 {
        sentences.push(CalibreFinding::Unknown { count: unknown });
    }
    if let Some(parts) = unmeasured(&found.coverage).filter(|_| measured > 0) {
        sentences.push(CalibreFinding::MeasuredOver { percent: found.coverage.percent().floor(), parts });
    }
    if found.openings_without_branch > 0 {
        sentences.push(CalibreFinding::OpenEnds { count: found.openings_without_branch });
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
    use crate::certificate::{OnSurface, Spread, StationStatus};

    /// Stations of a branch, 1 mm apart.
    const STATIONS: u8 = 11;

    /// Branch `number`, whose calibre has changed by `percent`: nine tenths of its length are measured, or nothing of it.
    pub fn branch(number: u32, percent: Option<f64>) -> BranchCalibre {
        let change = |percent| Change { percent, at_mm: [1.0, 2.0, 3.0], abscissa_mm: 4.0 };
        let on = |percent: Option<f64>| OnSurface { largest_change: percent.map(change), ..OnSurface::default() };
        let abscissas_mm: Vec<f32> = (0..STATIONS).map(f32::from).collect();
        let standing = |i: u8| match percent {
            Some(_) if 0 < i && i < STATIONS - 1 => StationStatus::Counts,
            Some(_) => StationStatus::End,
            None => StationStatus::Fork,
        };
        let standings: Vec<StationStatus> = (0..STATIONS).map(standing).collect();
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
            stations_counted: standings.iter().filter(|&&standing| standing == StationStatus::Counts).count(),
            at_mm: abscissas_mm.iter().map(|&mm| [1.0, 2.0, mm]).collect(),
            abscissas_mm,
            standings,
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
        Ok(Certificate::new(branches, 2.0, 0))
    }
}

#[cfg(test)]
mod tests {
    use super::fixtures::certificate;
    use super::*;
    use crate::TreeError;

    fn sentence(found: &Result<Certificate, CalibreError>) -> String {
        summary(found).to_string()
    }

    #[test]
    fn the_sentence_says_how_many_and_which_is_worst() {
        let rest = "Measured over 90 % of the length; not over 10 % at ends.";
        let with_rest = |text: &str| format!("{text} {rest}");
        assert_eq!(sentence(&certificate(&[Some(0.5)])), with_rest("The vessel keeps its calibre to 2 %."));
        let both = certificate(&[Some(0.5), Some(-2.0)]);
        assert_eq!(sentence(&both), with_rest("All 2 vessels keep their calibre to 2 %."));
        let found = certificate(&[Some(2.5), Some(-9.04), None, Some(1.0)]);
        let order: Vec<u32> = in_order(found.as_ref().unwrap()).iter().map(|branch| branch.number).collect();
        assert_eq!(order, [2, 1, 3, 4]);
        assert_eq!(
            sentence(&found),
            "2 of 3 measured vessels change by more than 2 %, branch 2 the most: -9.0 %. \
             One is too short or too coarse to be measured. \
             Measured over 67 % of the length; not over 25 % at forks, 8 % at ends."
        );
        assert_eq!(sentence(&certificate(&[None])), "No vessel can be measured.");
        let closed = certificate(&[Some(0.5)]).unwrap();
        for (count, told) in [(1, "one open end."), (1200, "1,200 open ends.")] {
            let text = sentence(&Ok(Certificate { openings_without_branch: count, ..closed.clone() }));
            assert!(text.ends_with(&format!("not over 10 % at ends. No vessel was found at {told}")), "{text}");
        }
        assert!(sentence(&Err(TreeError::NoTriangles.into())).ends_with("the surface has no triangles."));
    }

    #[test]
    fn all_is_said_of_no_more_than_was_measured() {
        let of = |measured: usize| {
            let mut percents = vec![None; 17];
            percents[..measured].fill(Some(0.5));
            certificate(&percents)
        };
        let found = of(4);
        assert_eq!(found.as_ref().unwrap().coverage.text().to_string(), "21 % of the length, 4 of 17 vessels");
        let text = sentence(&found);
        assert!(text.starts_with("4 of 17 vessels were measured: they keep their calibre to 2 %."), "{text}");
        assert!(sentence(&of(1)).starts_with("1 of 17 vessels was measured: it keeps its calibre"));
        assert!(sentence(&of(17)).starts_with("All 17 vessels keep their calibre"));
    }

    #[test]
    fn a_branch_is_read_from_its_english_name() {
        let name = BranchName::read("branch 3").unwrap();
        assert_eq!((name, &*name.to_string()), (BranchName::Numbered { number: 3 }, "branch 3"));
        assert_eq!(BranchName::read("aorta"), None);
    }
}
