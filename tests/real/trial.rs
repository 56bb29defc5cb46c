//! The autopilot in real vessels: it arrives from each seed, in trees that the route finds by itself.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use libtest_mimic::{Failed, Trial as Test};
use lumen::io;
use lumen::mesh::TriMesh;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::trial::audit::Audit;
use lumen::trial::course::Course;
use lumen::trial::session::Trial;
use lumen::trial::setup::Setup;
use lumen::trial::wire::Wire;
use lumen_test_support::is_long;

/// Segmented, scanned or printed surfaces with open lumens, and the wire for each.
const FILES: [(&str, &str); 5] = [
    ("aorta-surface-open-ends.stl", "workhorse"),
    ("aorta-surface-segment-2.stl", "workhorse"),
    ("beamadapter_carotids.stl", "035-angled"),
    ("beamadapter_carotids.stl", "workhorse"),
    ("beamadapter_phantom.obj", "workhorse-j"),
];
/// Those that are smoothed as `lumen trial` does it, with the wire, entry and target that are proposed.
const PROPOSED: [&str; 6] = [
    "aorta-surface-open-ends.stl",
    "aorta-surface-segment-2.stl",
    "beamadapter_carotids.stl",
    "beamadapter_phantom.obj",
    "steve_mechanical_thrombectomy.obj",
    "steve_vessel_architecture.obj",
];
/// Those in which the trial starts at the settings that the app begins with, 90 % of the triangles gone.
const AT_ONCE: [&str; 5] = [
    "aorta-surface-open-ends.stl",
    "aorta-surface-segment-2.stl",
    "beamadapter_carotids.stl",
    "beamadapter_phantom.obj",
    "steve_mechanical_thrombectomy.obj",
];
/// Trials of each: as many as docs/benchmarks/trial.md tells of, or a sample.
fn seeds() -> u64 {
    if is_long() { 10 } else { 2 }
}

fn read(file: &Path) -> Result<Arc<TriMesh>, Failed> {
    Ok(Arc::new(io::read(&std::fs::read(file)?, &file.to_string_lossy(), &io::ImportOptions::default())?.mesh))
}

fn smoothed(mesh: Arc<TriMesh>) -> Result<Arc<TriMesh>, Failed> {
    let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::PAPER };
    let settings = Settings { smoothing, target: Target::Reduction(0), ..Settings::default() };
    let mut pipeline = Pipeline::new(mesh, settings).without_measures();
    pipeline.finish()?;
    Ok(pipeline.reduced().ok_or("it was waited for")?.mesh.clone())
}

/// The level that the app shows first has a way for the wire that is proposed.
fn starts(mesh: Arc<TriMesh>) -> Result<(), Failed> {
    let mut pipeline = Pipeline::new(mesh, Settings::default()).without_measures();
    pipeline.finish()?;
    let reduced = pipeline.reduced().ok_or("it was waited for")?;
    Course::new(&reduced.mesh, None, &mut Setup { proposes_wire: true, ..Setup::default() })?;
    Ok(())
}

/// The autopilot arrives from every seed.
fn arrives(name: &str, mesh: &Arc<TriMesh>, mut setup: Setup) -> Result<(), Failed> {
    let course = Arc::new(Course::new(mesh, None, &mut setup)?);
    let middle: Vec<DVec3> = course.route.points.iter().map(|point| point.at).collect();
    if let Err(shut) = Audit::new(mesh).is_open(&middle, setup.wire.diameter_mm) {
        return Err(format!("the lumen is not open: {shut:?}").into());
    }
    let mut failures = Vec::new();
    for seed in 0..seeds() {
        let mut trial = Trial::new(course.clone(), Setup { seed, ..setup.clone() })?;
        trial.set_autopilot(true);
        trial.finish();
        let summary = trial.summary();
        if !summary.success || !summary.failed_wires.is_empty() {
            let failed = summary.failed_wires.join(", ");
            failures.push(format!("seed {seed}: {} ({failed} failed before)", summary.reason));
        }
    }
    let seeds = seeds();
    let arrived = seeds - failures.len() as u64;
    eprintln!("{name} by {}: {arrived} of {seeds} arrive {failures:?}", setup.wire.name);
    if failures.is_empty() { Ok(()) } else { Err(format!("{arrived} of {seeds} arrive: {failures:?}").into()) }
}

pub(crate) fn trials(data: &Path) -> Vec<Test> {
    let path = |file: &str| data.join("real").join(file);
    let by = |(file, wire): (&'static str, &'static str)| {
        let path = path(file);
        Test::test(format!("trial: the autopilot arrives in {file} by {wire}"), move || {
            let wire = Wire::preset(wire).ok_or("no such wire")?;
            arrives(file, &read(&path)?, Setup { wire, ..Setup::default() })
        })
    };
    let proposed = |file: &'static str| {
        let path = path(file);
        Test::test(format!("trial: the autopilot arrives in {file} by what is proposed"), move || {
            arrives(file, &smoothed(read(&path)?)?, Setup { proposes_wire: true, ..Setup::default() })
        })
    };
    let at_once = |file: &'static str| {
        let path = path(file);
        Test::test(format!("trial: it starts in {file} with no setting changed"), move || starts(read(&path)?))
    };
    let arrivals = FILES.into_iter().map(by).chain(PROPOSED.into_iter().map(proposed));
    arrivals.chain(AT_ONCE.into_iter().map(at_once)).collect()
}
