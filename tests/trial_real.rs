//! The autopilot in real vessels: it arrives from ten seeds, in trees that the route finds by itself.

mod common;

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use libtest_mimic::{Failed, Trial as Test};
use lumen::io;
use lumen::trial::audit::Audit;
use lumen::trial::course::Course;
use lumen::trial::session::Trial;
use lumen::trial::setup::Setup;

/// Segmented or scanned surfaces with open lumens, and how many of ten seeds must arrive. In the carotids the way forks at
/// once behind the entry, and the autopilot misses the branch from about half of the seeds.
const FILES: [(&str, u64); 3] =
    [("aorta-surface-open-ends.stl", 9), ("aorta-surface-segment-2.stl", 9), ("beamadapter_carotids.stl", 4)];
const SEEDS: u64 = 10;

fn arrives(file: &Path, least: u64) -> Result<(), Failed> {
    let bytes = std::fs::read(file)?;
    let name = file.to_string_lossy();
    let mesh = Arc::new(io::read(&bytes, &name, &io::ImportOptions::default())?.mesh);
    let mut setup = Setup::default();
    let course = Arc::new(Course::new(&mesh, None, &mut setup)?);
    let middle: Vec<DVec3> = course.route.points.iter().map(|point| point.at).collect();
    if let Err(shut) = Audit::new(&mesh).is_open(&middle, setup.wire.diameter_mm) {
        return Err(format!("the lumen is not open: {shut:?}").into());
    }
    let mut failures = Vec::new();
    for seed in 0..SEEDS {
        let mut trial = Trial::new(course.clone(), Setup { seed, ..setup.clone() })?;
        trial.set_autopilot(true);
        trial.finish();
        let summary = trial.summary();
        if !summary.success {
            failures.push(format!("seed {seed}: {}", summary.reason));
        }
    }
    let arrived = SEEDS - failures.len() as u64;
    eprintln!("{name}: {arrived} of {SEEDS} arrive {failures:?}");
    if arrived < least { Err(format!("{arrived} arrive, not {least}: {failures:?}").into()) } else { Ok(()) }
}

fn main() {
    common::run("trial_real", |folder| {
        let test = |(file, least): (&str, u64)| {
            let path = folder.join("real").join(file);
            Test::test(format!("the autopilot arrives in {file}"), move || arrives(&path, least))
        };
        FILES.into_iter().map(test).collect()
    });
}
