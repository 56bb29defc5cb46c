//! The calibre of the vessels in words and numbers.

use crate::app::state::State;
use crate::pipeline::safe::Safe;
use crate::vessel::certificate::{BranchCalibre, Certificate, Change, OnSurface, Standing, Verdict, measured_percent};

/// Heads of the columns, and what they say.
pub(super) const COLUMNS: [(&str, &str); 8] = [
    ("Vessel", "Click to see the radius along it and to go where it changes most"),
    ("Verdict", "Whether it keeps its calibre as reduced, within the change that is allowed"),
    ("Reduced", "The largest change of its radius, as reduced, from the surface as opened"),
    ("Smoothed", "The largest change of its radius, as smoothed, from the surface as opened"),
    ("Safe to", "The reduction up to which it was seen to keep its calibre"),
    ("Radius, mm", "Of the circle of the same area, as opened: mean, and least to largest"),
    ("Length, mm", "Along its centreline"),
    ("Tortuosity", "Length over the distance of the ends"),
];

/// The branches as they are listed: those that change first, the most changed before the others.
pub(in crate::app) fn in_order(found: &Certificate) -> Vec<&BranchCalibre> {
    let mut rows: Vec<&BranchCalibre> = found.branches.iter().collect();
    let change = |branch: &BranchCalibre| {
        let change = branch.reduced.largest_change.filter(|_| branch.verdict == Verdict::Changed);
        change.map_or(0.0, |change| change.percent.abs())
    };
    rows.sort_by(|a, b| change(b).total_cmp(&change(a)));
    rows
}

/// The verdict in a few words, for the panel.
pub(in crate::app) fn verdict(state: &State) -> String {
    match state.calibre().map(|calibre| &calibre.found) {
        None => "...".to_owned(),
        Some(Err(_)) => "–".to_owned(),
        Some(Ok(found)) => {
            let count = |verdict: Verdict| found.branches.iter().filter(|branch| branch.verdict == verdict).count();
            let (kept, changed) = (count(Verdict::Kept), count(Verdict::Changed));
            match (kept, changed) {
                (0, 0) => "not measured".to_owned(),
                (_, 0) => format!("kept, to {} %", found.tolerance_percent),
                _ => format!("{changed} of {} changed", kept + changed),
            }
        }
    }
}

/// Below this part of all vessels, in percent, a verdict is said to rest on little.
const LITTLE: f64 = 25.0;

/// What became of all of them, in a sentence or two.
pub(in crate::app) fn sentence(found: &Result<Certificate, String>) -> String {
    let found = match found {
        Ok(found) => found,
        Err(why) => return format!("There are no vessels to measure: {why}."),
    };
    let of = |verdict: Verdict| found.branches.iter().filter(move |branch| branch.verdict == verdict);
    let (kept, changed, unknown) =
        (of(Verdict::Kept).count(), of(Verdict::Changed).count(), of(Verdict::NotMeasured).count());
    let tolerance = found.tolerance_percent;
    let largest = |branch: &&BranchCalibre| branch.reduced.largest_change.map_or(0.0, |change| change.percent.abs());
    let worst = of(Verdict::Changed).max_by(|a, b| largest(a).total_cmp(&largest(b)));
    let mut text = match (kept, changed, worst.and_then(|worst| Some((worst, worst.reduced.largest_change?)))) {
        (0, 0, _) => "No vessel can be measured.".to_owned(),
        (1, 0, _) => format!("The vessel keeps its calibre to {tolerance} %."),
        (_, 0, _) => format!("All {kept} vessels keep their calibre to {tolerance} %."),
        (_, _, Some((worst, change))) => format!(
            "{changed} of {} vessels {} by more than {tolerance} %, {} the most: {:+.1} %.",
            kept + changed,
            if changed == 1 { "changes" } else { "change" },
            worst.name,
            change.percent
        ),
        (_, _, None) => format!("{changed} of {} vessels change by more than {tolerance} %.", kept + changed),
    };
    if let Some(percent) = measured_percent(&found.branches).filter(|&part| part < LITTLE && kept + changed > 0) {
        text += &format!(
            " That is said of {percent:.0} % of their length: the rest lies at ends or forks or is too coarse."
        );
    }
    let by_smoothing = of(Verdict::Changed).filter(|branch| branch.verdict_smoothed == Verdict::Changed).count();
    if by_smoothing > 0 {
        text += &format!(" Smoothing itself changes {by_smoothing} of them so much.");
    }
    if unknown > 0 && kept + changed > 0 {
        text += &match unknown {
            1 => " One is too short or too coarse to be measured.".to_owned(),
            _ => format!(" {unknown} are too short or too coarse to be measured."),
        };
    }
    text
}

/// What stands in the row of a branch; the place of its largest change goes with it.
pub(super) fn cells(branch: &BranchCalibre, safe: Option<&Safe>) -> [String; COLUMNS.len()] {
    let none = || "–".to_owned();
    let percent = |of: &OnSurface| of.largest_change.map_or_else(none, |change| format!("{:+.1} %", change.percent));
    let radius = branch.opened.radius_mm;
    let safe = safe.and_then(|safe| safe.branches.iter().find(|of| of.number == branch.number));
    [
        branch.name.clone(),
        match branch.verdict {
            Verdict::Kept => "kept",
            Verdict::Changed => "changed",
            Verdict::NotMeasured => "not measured",
        }
        .to_owned(),
        percent(&branch.reduced),
        percent(&branch.smoothed),
        match safe.map(|of| (of.changed_by_smoothing, of.kept_to_percent)) {
            Some((false, Some(percent))) => format!("{percent:.1} %"),
            _ => none(),
        },
        radius.map_or_else(none, |r| format!("{:.2} ({:.2} to {:.2})", r.mean, r.least, r.largest)),
        format!("{:.1}", branch.length_mm),
        branch.tortuosity.map_or_else(none, |tortuosity| format!("{tortuosity:.2}")),
    ]
}

/// Why a branch can nowhere be measured; `None` where it can.
pub(super) fn why_not_measured(branch: &BranchCalibre) -> Option<&'static str> {
    if branch.verdict != Verdict::NotMeasured {
        return None;
    }
    let count = |standing: Standing| branch.standings.iter().filter(|&&other| other == standing).count();
    let reasons = [
        (Standing::Thin, "It is less than two edges wide: too coarse to say."),
        (Standing::NotClosed, "Its cross-sections do not close."),
        (Standing::Fork, "It is too short: all of it lies at forks or ends."),
        (Standing::End, "It is too short: all of it lies at ends or forks."),
    ];
    // What could have been measured first.
    reasons.into_iter().find(|&(standing, _)| count(standing) > 0).map(|(_, why)| why)
}

/// The table as text, a tab between columns.
pub(super) fn text(name: &str, found: &Certificate, safe: Option<&Safe>) -> String {
    let line = |cells: &[String]| format!("{}\n", cells.join("\t"));
    let heads: Vec<String> = COLUMNS.iter().map(|(head, _)| (*head).to_owned()).collect();
    let rows: String = found.branches.iter().map(|branch| line(&cells(branch, safe))).collect();
    let tolerance = found.tolerance_percent;
    let disclaimer = crate::pipeline::report::DISCLAIMER;
    format!("{name}, allowed change {tolerance} %\n{}{rows}{disclaimer}\n", line(&heads))
}

/// What there is to say of a place.
pub(super) fn place(branch: &BranchCalibre, change: &Change) -> String {
    format!("{}: {:+.1} %", branch.name, change.percent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vessel::certificate::Spread;

    fn branch(number: u32, percent: Option<f64>) -> BranchCalibre {
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
        }
    }

    fn certificate(percents: &[Option<f64>]) -> Result<Certificate, String> {
        let branches = (1..).zip(percents).map(|(number, &percent)| branch(number, percent)).collect();
        Ok(Certificate { tolerance_percent: 2.0, verdict: Verdict::Kept, branches })
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
        assert!(sentence(&Err("the surface has no inside".to_owned())).ends_with("the surface has no inside."));
    }

    #[test]
    fn a_verdict_that_rests_on_little_says_so() {
        let mut found = certificate(&[Some(0.5)]).unwrap();
        found.branches[0].standings = vec![Standing::Thin; 10];
        found.branches[0].stations_counted = 2;
        assert!(sentence(&Ok(found.clone())).contains("That is said of 20 % of their length"));
        found.branches[0].stations_counted = 3;
        assert_eq!(sentence(&Ok(found)), "The vessel keeps its calibre to 2 %.");
    }

    #[test]
    fn a_row_has_numbers_with_units_and_dashes_for_what_is_not_known() {
        let row = cells(&branch(3, None), None);
        assert_eq!(row, ["branch 3", "not measured", "–", "+0.0 %", "–", "1.50 (1.00 to 2.00)", "12.3", "–"]);
        let found = certificate(&[Some(-4.0)]).unwrap();
        let text = text("a.stl", &found, None);
        assert_eq!(text.lines().count(), 4);
        assert!(text.contains("branch 1\tchanged\t-4.0 %") && text.contains("Not for clinical decisions"), "{text}");
    }
}
