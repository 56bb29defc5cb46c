//! The calibre of the vessels in words and numbers.

use crate::app::state::State;
use crate::language::{Key, decimal, signed, tell};
use crate::pipeline::safe::Safe;
use crate::say;
use crate::vessel::certificate::{BranchCalibre, Certificate, OnSurface, StationStatus, Verdict};

/// Heads of the columns, and what they say.
pub(super) const COLUMNS: [(Key, Key); 10] = [
    (Key("vessels-column-vessel"), Key("vessels-column-vessel-help")),
    (Key("vessels-column-verdict"), Key("vessels-column-verdict-help")),
    (Key("vessels-column-measured"), Key("vessels-column-measured-help")),
    (Key("vessels-column-reduced"), Key("vessels-column-reduced-help")),
    (Key("vessels-column-smoothed"), Key("vessels-column-smoothed-help")),
    (Key("vessels-column-safe"), Key("vessels-column-safe-help")),
    (Key("vessels-radius"), Key("vessels-column-radius-help")),
    (Key("vessels-column-length"), Key("vessels-column-length-help")),
    (Key("vessels-column-tortuosity"), Key("vessels-column-tortuosity-help")),
    // Its words are the longest: what is cut off in a narrow window is cut off here.
    (Key("vessels-column-uneven"), Key("vessels-column-uneven-help")),
];

/// The verdict in a few words, for the panel.
pub(in crate::app) fn verdict(state: &State) -> String {
    match state.calibre().map(|calibre| &calibre.found) {
        None => "...".to_owned(),
        Some(Err(_)) => "–".to_owned(),
        Some(Ok(found)) => {
            let count = |verdict: Verdict| found.branches.iter().filter(|branch| branch.verdict == verdict).count();
            let (kept, changed) = (count(Verdict::Kept), count(Verdict::Changed));
            match (kept, changed) {
                (0, 0) => tell(&Verdict::NotMeasured),
                (_, 0) if !found.coverage.is_enough() => {
                    say!("vessels-kept-short", percent = decimal(found.coverage.percent().floor(), 0))
                }
                (_, 0) => say!("vessels-all-kept-short", tolerance = found.tolerance_percent),
                _ => say!("vessels-some-changed-short", changed = changed, all = kept + changed),
            }
        }
    }
}

/// What stands in the row of a branch; the place of its largest change goes with it.
pub(super) fn cells(branch: &BranchCalibre, safe: Option<&Safe>) -> [String; COLUMNS.len()] {
    let none = || "–".to_owned();
    let percent =
        |of: &OnSurface| of.largest_change.map_or_else(none, |change| format!("{} %", signed(change.percent, 1)));
    let radius = branch.opened.radius_mm;
    let safe = safe.and_then(|safe| safe.branches.iter().find(|of| of.number == branch.number));
    [
        tell(&branch.label()),
        tell(&branch.verdict),
        format!("{} %", decimal(branch.coverage().percent().floor(), 0)),
        percent(&branch.reduced),
        percent(&branch.smoothed),
        match safe.map(|of| (of.changed_by_smoothing, of.kept_to_percent)) {
            Some((false, Some(percent))) => format!("{} %", decimal(percent, 1)),
            _ => none(),
        },
        radius.map_or_else(none, |radius| tell(&radius.text())),
        decimal(branch.length_mm, 1),
        branch.tortuosity.map_or_else(none, |tortuosity| decimal(tortuosity, 2)),
        branch.uneven_text().map_or_else(none, |found| tell(&found)),
    ]
}

/// Where a branch is narrower or wider, by how much alone; `None` where it is neither.
pub(super) fn uneven_in_short(branch: &BranchCalibre) -> Option<String> {
    let found: Vec<String> = branch.uneven().into_iter().flatten().map(|stretch| tell(&stretch.degree())).collect();
    (!found.is_empty()).then(|| found.join(", "))
}

/// Why a branch can nowhere be measured; `None` where it can.
pub(super) fn why_not_measured(branch: &BranchCalibre) -> Option<Key> {
    if branch.verdict != Verdict::NotMeasured {
        return None;
    }
    let count = |standing: StationStatus| branch.standings.iter().filter(|&&other| other == standing).count();
    let reasons = [
        (StationStatus::Thin, Key("vessels-too-thin")),
        (StationStatus::NotClosed, Key("vessels-not-closed")),
        (StationStatus::Ambiguous, Key("vessels-ambiguous")),
        (StationStatus::Fork, Key("vessels-at-forks")),
        (StationStatus::End, Key("vessels-at-ends")),
    ];
    // What could have been measured first.
    reasons.into_iter().find(|&(standing, _)| count(standing) > 0).map(|(_, why)| why)
}

/// The table as text, a tab between columns.
pub(super) fn text(name: &str, found: &Certificate, safe: Option<&Safe>) -> String {
    let line = |cells: &[String]| format!("{}\n", cells.join("\t"));
    let heads: Vec<String> = COLUMNS.iter().map(|(head, _)| head.say()).collect();
    let rows: String = found.branches.iter().map(|branch| line(&cells(branch, safe))).collect();
    let first = say!("vessels-table", name = name, tolerance = found.tolerance_percent);
    let first = format!("{first}, {}", say!("vessels-table-measured", coverage = tell(&found.coverage.text())));
    format!("{first}\n{}{rows}{}\n", line(&heads), say!("report-not-clinical"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vessel::summary::fixtures::{branch, certificate};

    #[test]
    fn a_row_has_numbers_with_units_and_dashes_for_what_is_not_known() {
        let row = cells(&branch(3, None), None);
        let numbers = ["0 %", "–", "0.0 %", "–", "1.50 (1.00 to 2.00)", "12.3", "–", "–"];
        assert_eq!(
            (&row[..2], &row[2..]),
            (&["branch 3", "not measured"].map(str::to_owned)[..], &numbers.map(str::to_owned)[..])
        );
        let found = certificate(&[Some(-4.0)]).unwrap();
        let text = text("a.stl", &found, None);
        assert_eq!(text.lines().count(), 4);
        assert!(
            text.contains("branch 1\tchanged\t90 %\t-4.0 %") && text.contains("Not for clinical decisions"),
            "{text}"
        );
    }
}
