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
use lumen::trial::wire::Wire;

/// Segmented, scanned or printed surfaces with open lumens, and the wire for each.
const FILES: [(&str, &str); 5] = [
    ("aorta-surface-open-ends.stl", "workhorse"),
    ("aorta-surface-segment-2.stl", "workhorse"),
    ("beamadapter_carotids.stl", "035-angled"),
    ("beamadapter_carotids.stl", "workhorse"),
    ("beamadapter_phantom.obj", "workhorse-j"),
];
const SEEDS: u64 = 10;

fn arrives(file: &Path, wire: &str) -> Result<(), Failed> {
    let bytes = std::fs::read(file)?;
    let name = file.to_string_lossy();
    let mesh = Arc::new(io::read(&bytes, &name, &io::ImportOptions::default())?.mesh);
    let wire = Wire::preset(wire).ok_or("no such wire")?;
    let mut setup = Setup { wire, ..Setup::default() };
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
    eprintln!("{name} by {}: {arrived} of {SEEDS} arrive {failures:?}", setup.wire.name);
    if failures.is_empty() { Ok(()) } else { Err(format!("{arrived} of {SEEDS} arrive: {failures:?}").into()) }
}

fn main() {
    common::run("trial_real", |folder| {
        let test = |(file, wire): (&'static str, &'static str)| {
            let path = folder.join("real").join(file);
            Test::test(format!("the autopilot arrives in {file} by {wire}"), move || arrives(&path, wire))
        };
        FILES.into_iter().map(test).collect()
    });
}
