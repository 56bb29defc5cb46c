//! What verdicts on real vessels rest on: the part of the length that is measured, added up here from gap to gap, and the lengths
//! that `data/INDEX.md` leads one to expect.

use std::path::Path;
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, read};
use lumen::pipeline::report::Report;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::Settings;
use lumen::pipeline::verdict::{Head, Verdict};
use lumen::vessel::certificate::{BranchCalibre, StationStatus};

/// Files, and the least and the greatest length in mm of all their centrelines by their bounds in the index: of a segment that is
/// nearly straight, of a fork whose legs run beside each other, of a fork of carotids.
const FILES: [(&str, [f64; 2]); 3] = [
    ("real/aorta-surface-segment-2.stl", [135.0, 190.0]),
    ("real/aorta-surface-open-ends.stl", [78.0, 170.0]),
    ("real/beamadapter_carotids.stl", [84.0, 250.0]),
];

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let trial = |(file, length): (&'static str, [f64; 2])| {
        let path = data.join(file);
        Trial::test(format!("{file}: the verdict says what it rests on"), move || check(&path, length))
    };
    FILES.into_iter().map(trial).collect()
}

/// Length in mm, and how much of it is measured: a gap between two stations counts half for each of them.
fn lengths(branch: &BranchCalibre) -> (f64, f64) {
    let counted = |i: usize| if branch.standings[i] == StationStatus::Counts { 0.5 } else { 0.0 };
    let gaps = branch.abscissas_mm.windows(2).map(|pair| f64::from(pair[1]) - f64::from(pair[0]));
    gaps.enumerate().fold((0.0, 0.0), |(all, part), (i, gap)| (all + gap, part + gap * (counted(i) + counted(i + 1))))
}

fn check(path: &Path, [least, most]: [f64; 2]) -> Result<(), Failed> {
    let imported = read(&std::fs::read(path)?, &path.to_string_lossy(), &ImportOptions::default())?;
    let mut pipeline = Pipeline::new(Arc::new(imported.mesh), Settings::default()).with_certificate();
    pipeline.finish()?;
    let report = Report::new("a.stl", &pipeline).ok_or("no result")?;
    let verdict = Verdict::of_run(&pipeline, &report, &imported.report, true);
    let branches = report.branches.as_deref().ok_or("no vessels")?;
    let (all, measured) = branches.iter().map(lengths).fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
    let found = verdict.coverage.ok_or("no coverage")?;
    println!("{}: {}", path.display(), verdict.in_short(|message| message.to_string()));
    if !(least..=most).contains(&found.length_mm) {
        return Err(format!("{} mm of centrelines", found.length_mm).into());
    }
    if (found.length_mm - all).abs() > 1e-3 || (found.measured_mm - measured).abs() > 1e-3 {
        return Err(format!("{measured} of {all} mm are measured, not {found:?}").into());
    }
    let parts = found.measured_mm + found.ends_mm + found.forks_mm + found.thin_mm + found.unclear_mm;
    if (parts - all).abs() > 1e-3 || found.vessels != branches.len() {
        return Err(format!("the parts are not the whole: {found:?}").into());
    }
    let vessels = branches.iter().filter(|branch| branch.stations_counted > 0).count();
    let is_enough = measured >= 0.75 * (all - found.forks_mm) && 2 * vessels >= branches.len();
    match verdict.head {
        Head::Safe if is_enough && verdict.is_safe == Some(true) => Ok(()),
        Head::KeptWhereMeasured if !is_enough && verdict.is_safe.is_none() => Ok(()),
        Head::ToLookAt { .. } if verdict.is_safe == Some(false) => Ok(()),
        head => Err(format!("{head:?} where {measured} of {all} mm are measured").into()),
    }
}
