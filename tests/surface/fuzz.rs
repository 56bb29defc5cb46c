//! Surfaces that are no manifolds, a thousand of them under any settings: every promise of decimation holds there too.
//! `LUMEN_FUZZ_SURFACES` asks for more (`cargo xtask fuzz-surfaces`: a hundred thousand), `LUMEN_FUZZ_SEED` for others. What
//! fails is told with the fewest faults that make it fail.

use std::sync::Arc;

use lumen::io::import_mesh;
use lumen::mesh::{TriMesh, self_intersections};
use lumen::pipeline::deviation::deviation;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Keep, Settings, Smoothing, Target, Window};
use lumen_test_support::crossings::crossing_faces;
use lumen_test_support::promises::{check, settings};
use lumen_test_support::tangles::{Fault, Tangle, tangles};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// Most faults of a surface.
const FAULTS: usize = 12;

fn number(name: &str, default: u32) -> u32 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// One part of so many surfaces, each with up to `faults` of them and with settings, all pieces kept or the largest.
fn try_all(part: u32, of: u32, faults: usize, promise: impl Fn(Arc<TriMesh>, Settings) -> Result<(), String>) {
    let rng_seed = RngSeed::Fixed(u64::from(number("LUMEN_FUZZ_SEED", 14)) << 8 | u64::from(part));
    let cases = number("LUMEN_FUZZ_SURFACES", 1000) / of;
    let mut runner = TestRunner::new(Config { cases, failure_persistence: None, rng_seed, ..Config::default() });
    let keep = prop::sample::select(vec![Keep::All, Keep::Largest]);
    let tried = runner.run(&(tangles(faults), settings(), keep), |(tangle, settings, keep)| {
        let imported = import_mesh(tangle.mesh(), "tangle");
        if imported.mesh.triangles.is_empty() {
            return Ok(());
        }
        promise(Arc::new(imported.mesh), Settings { keep, ..settings }).map_err(TestCaseError::fail)
    });
    if let Err(error) = tried {
        panic!("{error}");
    }
}

#[test]
fn any_level_keeps_count_and_topology() {
    try_all(0, 2, FAULTS, |mesh, settings| check(&mut Pipeline::new(mesh, settings).with_samples(1)));
}

#[test]
fn where_no_faces_cross_none_will() {
    // Many faults at once hardly leave a surface that does not cross itself.
    try_all(1, 4, 3, |mesh, settings| {
        let smoothing = Smoothing { preserve_volume: false, guard: false, ..settings.smoothing };
        let settings = Settings { smoothing, ..settings };
        let mut pipeline = Pipeline::new(mesh, settings.clone()).with_samples(1);
        for rate in [0, 500, 990] {
            pipeline
                .set(Settings { target: Target::Reduction(rate), ..settings.clone() })
                .map_err(|e| e.to_string())?;
            pipeline.finish().map_err(|error| error.to_string())?;
            let (Some(smoothed), Some(reduced)) = (pipeline.smoothed(), pipeline.reduced()) else {
                return Err("no result".to_owned());
            };
            // By the guard's own measure (`mesh::crossing`) touching counts too; by the other counter it does not.
            let after = crossing_faces(&reduced.mesh);
            if self_intersections(&smoothed.mesh).is_empty() && after > 0 {
                return Err(format!("{rate}: {after} faces cross, none before"));
            }
        }
        Ok(())
    });
}

#[test]
fn a_bound_on_the_deviation_is_kept() {
    try_all(2, 4, FAULTS, |mesh, settings| {
        let bound = 0.3f64;
        let settings = Settings { target: Target::Deviation((bound * 1e3) as u32), ..settings };
        let mut pipeline = Pipeline::new(mesh, settings).with_samples(1);
        pipeline.finish().map_err(|error| error.to_string())?;
        let (Some(smoothed), Some(reduced)) = (pipeline.smoothed(), pipeline.reduced()) else {
            return Err("no result".to_owned());
        };
        match deviation(&smoothed.mesh, &reduced.mesh, 2000) {
            Some(measured) if measured.max > bound + 1e-5 => Err(format!("{} mm, {bound} allowed", measured.max)),
            _ => Ok(()),
        }
    });
}

/// Two vertices of an open tube are welded, and its wall folds beside the cut: beyond the fold it looks the same way again
/// and hangs together with what is before the fold, the other way around. Found by seed 1.
#[test]
fn what_looks_the_same_way_beyond_a_fold_is_not_run_into() {
    let tangle = Tangle {
        rings: 10,
        sides: 4,
        is_closed: false,
        noise: 0.4,
        seed: 3_749_145_477,
        faults: vec![Fault::WeldVertices([1_306_669_233, 1_326_262_705])],
    };
    let mut settings = Settings { keep: Keep::All, ..Settings::default() };
    settings.smoothing = Smoothing {
        window: Window::Blackman,
        pass_band: 0.036_858_785_175_070_88,
        iterations: 10,
        adapt: false,
        guard: false,
        ..settings.smoothing
    };
    settings.decimation.feature_angle = 156.774_266_082_557_25;
    let mesh = Arc::new(import_mesh(tangle.mesh(), "tangle").mesh);
    let mut pipeline = Pipeline::new(mesh, settings.clone()).with_samples(1);
    for count in (14..=72).rev() {
        pipeline.set(Settings { target: Target::Triangles(count), ..settings.clone() }).unwrap();
        pipeline.finish().unwrap();
        let level = &pipeline.reduced().unwrap().mesh;
        assert_eq!(crossing_faces(level), 0, "at {} triangles", level.triangles.len());
    }
}
