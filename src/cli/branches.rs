//! The table of the branches of a vessel tree, and what became of the calibre of each.

use tabled::builder::Builder;
use tabled::settings::object::Columns;
use tabled::settings::{Alignment, Style};

use super::rows::row;
use crate::pipeline::report::Report;
use crate::vessel::certificate::{BranchCalibre, Change, OnSurface, Spread};
use lumen_message::signed;

/// Prints the table.
pub(super) fn print(report: &Report) {
    let Some(calibre) = &report.calibre else { return };
    if let Some(refused) = &calibre.refused {
        row("calibre of branches", refused);
        return;
    }
    let mut rows = Builder::new();
    rows.push_record(HEADS);
    report.branches.iter().flatten().for_each(|branch| rows.push_record(of(branch)));
    let mut table = rows.build();
    table.with(Style::blank()).modify(Columns::new(1..NUMBERS), Alignment::right());
    println!("\n{table}");
    let verdict = calibre.verdict.map_or_else(String::new, |verdict| verdict.to_string());
    let over = calibre.coverage.map_or_else(String::new, |found| format!(", measured over {}", found.text()));
    row("calibre", format!("{verdict}, at a tolerance of {} %{over}", calibre.tolerance_percent));
}

const HEADS: [&str; 12] = [
    "branch",
    "length mm",
    "tortuosity",
    "radius, opened mm",
    "smoothed",
    "output",
    "smoothed %",
    "output %",
    "measured %",
    "verdict",
    "largest change at",
    "uneven",
];
/// The columns before this one are numbers, but for the first.
const NUMBERS: usize = 9;

fn of(branch: &BranchCalibre) -> [String; HEADS.len()] {
    let none = || "-".to_owned();
    let mean = |of: &OnSurface| of.radius_mm.map_or_else(none, |radius| format!("{:.3}", radius.mean));
    let change = |of: &OnSurface| of.largest_change.map_or_else(none, |change| signed(change.percent, 2));
    let spread = |radius: Spread| format!("{:.3} ({:.2}-{:.2})", radius.mean, radius.least, radius.largest);
    let place = |change: Change| {
        let [x, y, z] = change.at_mm;
        format!("{:.1} mm ({x:.1}, {y:.1}, {z:.1})", change.abscissa_mm)
    };
    [
        branch.name.clone(),
        format!("{:.1}", branch.length_mm),
        branch.tortuosity.map_or_else(none, |tortuosity| format!("{tortuosity:.3}")),
        branch.opened.radius_mm.map_or_else(none, spread),
        mean(&branch.smoothed),
        mean(&branch.reduced),
        change(&branch.smoothed),
        change(&branch.reduced),
        format!("{:.0}", branch.coverage().percent().floor()),
        branch.verdict.to_string(),
        branch.reduced.largest_change.map_or_else(String::new, place),
        branch.uneven_text().map_or_else(String::new, |found| found.to_string()),
    ]
}
