//! The autopilot in real vessels: it arrives from each seed, in trees that the route finds by itself.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use libtest_mimic::{Failed, Trial as Test};
use lumen::io;
use lumen::mesh::TriMesh;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Target};
use lumen::trial::audit::Audit;
use lumen::trial::course::Course;
use lumen::trial::session::Trial;
use lumen::trial::setup::Setup;
use lumen::trial::wire::Wire;

use crate::long::is_long;

/// Segmented, scanned or printed surfaces with open lumens, and the wire for each.
const FILES: [(&str, &str); 5] = [
    ("aorta-surface-open-ends.stl", "workhorse"),
    ("aorta-surface-segment-2.stl", "workhorse"),
    ("beamadapter_carotids.stl", "035-angled"),
    ("beamadapter_carotids.stl", "workhorse"),
    ("beamadapter_phantom.obj", "workhorse-j"),
];
/// Those that are smoothed as the app does it, with the wire, entry and target that are proposed.
const PROPOSED: [&str; 6] = [
    "aorta-surface-open-ends.stl",
    "aorta-surface-segment-2.stl",
    "beamadapter_carotids.stl",
    "beamadapter_phantom.obj",
    "steve_mechanical_thrombectomy.obj",
    "steve_vessel_architecture.obj",
];
/// Trials of each: as many as docs/guide.md tells of, or a sample.
fn seeds() -> u64 {
    if is_long() { 10 } else { 2 }
}

fn read(file: &Path) -> Result<Arc<TriMesh>, Failed> {
    Ok(Arc::new(io::read(&std::fs::read(file)?, &file.to_string_lossy(), &io::ImportOptions::default())?.mesh))
}

fn smoothed(mesh: Arc<TriMesh>) -> Result<Arc<TriMesh>, Failed> {
    let settings = Settings { target: Target::Reduction(0), ..Settings::default() };
    let mut pipeline = Pipeline::new(mesh, settings).without_measures();
    pipeline.finish()?;
    Ok(pipeline.reduced().ok_or("it was waited for")?.mesh.clone())
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
        if !summary.success {
            failures.push(format!("seed {seed}: {}", summary.reason));
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
    FILES.into_iter().map(by).chain(PROPOSED.into_iter().map(proposed)).collect()
}
