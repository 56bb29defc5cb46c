//! The table of the branches of a vessel tree, and what became of the calibre of each.

use super::row;
use crate::pipeline::report::Report;
use crate::vessel::certificate::{BranchCalibre, OnSurface, Verdict};

/// Prints the table.
pub(super) fn print(report: &Report) {
    let Some(calibre) = &report.calibre else { return };
    if let Some(refused) = &calibre.refused {
        row("calibre of branches", refused);
        return;
    }
    let branches = report.branches.as_deref().unwrap_or_default();
    println!(
        "\n{:<12}{:>10}{:>11}{:>20}{:>9}{:>9}{:>11}{:>10}  {:<14}largest change at",
        "branch",
        "length mm",
        "tortuosity",
        "radius, opened mm",
        "smoothed",
        "output",
        "smoothed %",
        "output %",
        "verdict"
    );
    for branch in branches {
        print_branch(branch);
    }
    let verdict = calibre.verdict.map_or("", word);
    row("calibre", format!("{verdict}, at a tolerance of {} %", calibre.tolerance_percent));
}

fn print_branch(branch: &BranchCalibre) {
    let mean = |of: &OnSurface| of.radius_mm.map_or("-".to_owned(), |radius| format!("{:.3}", radius.mean));
    let change = |of: &OnSurface| of.largest_change.map_or("-".to_owned(), |change| format!("{:+.2}", change.percent));
    let place = branch.reduced.largest_change.map_or(String::new(), |change| {
        let [x, y, z] = change.at_mm;
        format!("{:.1} mm ({x:.1}, {y:.1}, {z:.1})", change.abscissa_mm)
    });
    let opened = branch
        .opened
        .radius_mm
        .map_or("-".to_owned(), |radius| format!("{:.3} ({:.2}-{:.2})", radius.mean, radius.least, radius.largest));
    println!(
        "{:<12}{:>10.1}{:>11}{:>20}{:>9}{:>9}{:>11}{:>10}  {:<14}{place}",
        branch.name,
        branch.length_mm,
        branch.tortuosity.map_or("-".to_owned(), |tortuosity| format!("{tortuosity:.3}")),
        opened,
        mean(&branch.smoothed),
        mean(&branch.reduced),
        change(&branch.smoothed),
        change(&branch.reduced),
        word(branch.verdict),
    );
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Kept => "kept",
        Verdict::Changed => "changed",
        Verdict::NotMeasured => "not measured",
    }
}
