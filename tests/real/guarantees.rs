//! What decimation promises, over random settings on phantoms and on surfaces of known shape, and at the paper's five
//! rates on real vessels: exact counts, the same topology, levels that nest, and no face through another that was not
//! through one before.

use std::path::Path;
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, read};
use lumen::mesh::{TriMesh, Vec3};
use lumen::phantom::{Sample, generate};
use lumen::pipeline::deviation::deviation;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Keep, Method, Settings, Smoothing, Target};
use lumen_test_support::crossings::crossing_faces;
use lumen_test_support::data::VESSELS;
use lumen_test_support::is_long;
use lumen_test_support::promises::{RATES, check, settings};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// Random settings tried on each surface.
fn cases() -> u32 {
    if is_long() { 12 } else { 4 }
}

/// On surfaces that are made here.
pub(crate) fn made() -> Vec<Trial> {
    let mut trials = vec![Trial::test("the counter of crossings counts", the_counter_counts)];
    for (name, mesh) in surfaces() {
        let mesh = Arc::new(mesh);
        let (for_settings, for_crossings, for_bounds) = (mesh.clone(), mesh.clone(), mesh);
        trials.push(Trial::test(format!("{name}: any settings"), move || any_settings(&for_settings)));
        trials.push(Trial::test(format!("{name}: a bound is kept"), move || any_bound(&for_bounds)));
        trials.push(Trial::test(format!("{name}: nothing new crosses"), move || no_crossings(&for_crossings)));
    }
    for (name, mesh) in layered() {
        let mesh = Arc::new(mesh);
        trials.push(Trial::test(format!("{name}: nothing crosses"), move || nothing_crosses(&mesh)));
    }
    trials
}

/// On real vessels.
pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let trial = |file: &str| {
        let path = data.join(file);
        Trial::test(format!("{file}: nothing new crosses"), move || no_crossings(&Arc::new(open(&path)?)))
    };
    VESSELS.into_iter().map(trial).collect()
}

fn open(path: &Path) -> Result<TriMesh, Failed> {
    Ok(read(&std::fs::read(path)?, &path.to_string_lossy(), &ImportOptions::default())?.mesh)
}

/// Phantoms, and surfaces whose topology is known.
fn surfaces() -> Vec<(&'static str, TriMesh)> {
    let turn = std::f32::consts::TAU;
    let torus = |u: f32, v: f32| {
        let (u, v) = (u * turn, v * turn);
        let ring = 20.0 + 6.0 * v.cos();
        Vec3::new(ring * u.cos(), ring * u.sin(), 6.0 * v.sin())
    };
    // A bent vessel of 1.5 mm that tapers, both ends open.
    let tube = |u: f32, v: f32| {
        let (angle, radius) = (v * turn, 0.75 - 0.35 * u);
        let around = 15.0 + radius * angle.cos();
        let bend = u * 3.0;
        Vec3::new(around * bend.cos(), around * bend.sin(), radius * angle.sin() + 3.0 * u)
    };
    // A square duct: four feature edges from end to end.
    let duct = |u: f32, v: f32| {
        let (side, along) = ((v * 4.0).floor(), (v * 4.0).fract() * 8.0 - 4.0);
        let (x, y) = [(along, -4.0), (4.0, along), (-along, 4.0), (-4.0, -along)][side as usize % 4];
        Vec3::new(x, y, 60.0 * u)
    };
    let made = |sample, triangles| generate(sample, triangles).expect("the count is one of those that can be made");
    vec![
        ("aorta", made(Sample::Aorta, 4_000)),
        ("coronary arteries", made(Sample::Coronary, 10_000)),
        ("torus", grid(60, 24, true, torus)),
        ("thin tube", grid(160, 16, false, tube)),
        ("square duct", grid(60, 32, false, duct)),
    ]
}

/// A surface over `around` cells in v, which closes, and `along` cells in u, which closes if `is_ring`.
fn grid(along: u32, around: u32, is_ring: bool, at: impl Fn(f32, f32) -> Vec3) -> TriMesh {
    let rows = if is_ring { along } else { along + 1 };
    let positions = (0..rows * around)
        .map(|i| at((i / around) as f32 / along as f32, (i % around) as f32 / around as f32))
        .collect();
    let triangles = (0..along * around).flat_map(|i| {
        let (row, column) = (i / around, i % around);
        let corner = |r: u32, c: u32| (r % rows) * around + c % around;
        let [a, b] = [corner(row, column), corner(row + 1, column)];
        let [c, d] = [corner(row + 1, column + 1), corner(row, column + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriMesh { positions, triangles: triangles.collect() }
}

/// Surfaces whose sheets lie upon each other and look the same way, as those of a wall and its lumen do once each piece
/// is turned outward.
fn layered() -> Vec<(&'static str, TriMesh)> {
    let turn = std::f32::consts::TAU;
    // Poles of 64 sides, and no vertex of the one above a vertex of the other.
    let sphere = |radius: f32, shift: f32| {
        capped(grid(48, 64, false, |u, v| {
            let (height, angle) = ((0.02 + 0.96 * u) * turn / 2.0, (v + shift) * turn);
            Vec3::new(height.sin() * angle.cos(), height.sin() * angle.sin(), height.cos()) * radius
        }))
    };
    let tube = |radius: f32, shift: f32| {
        grid(120, 48, false, move |u, v| {
            let angle = (v + shift) * turn;
            Vec3::new(radius * angle.cos(), radius * angle.sin(), 60.0 * u)
        })
    };
    // Three turns, 0.3 mm from one to the next: a ring of which one seam is left out.
    let scroll = |u: f32, v: f32| {
        let (angle, radius) = (3.0 * u * turn, 5.0 + 0.9 * u);
        Vec3::new(radius * angle.cos(), radius * angle.sin(), 10.0 * v)
    };
    vec![
        ("two spheres 0.2 mm apart", joined(&sphere(10.0, 0.0), &sphere(9.8, 0.3 / 64.0))),
        ("a tube in a tube 0.3 mm apart", joined(&tube(5.0, 0.0), &tube(4.7, 0.4 / 48.0))),
        ("an open scroll of one piece", cut_along(grid(300, 24, false, scroll), 24)),
    ]
}

/// The two rims of an open tube closed, each by a fan around its middle.
fn capped(mut mesh: TriMesh) -> TriMesh {
    const AROUND: u32 = 64;
    let last = mesh.positions.len() as u32 - AROUND;
    for first in [0, last] {
        let middle = (0..AROUND).map(|i| mesh.positions[(first + i) as usize]).sum::<Vec3>() / AROUND as f32;
        let centre = mesh.positions.len() as u32;
        mesh.positions.push(middle);
        mesh.triangles.extend((0..AROUND).map(|i| {
            let (a, b) = (first + i, first + (i + 1) % AROUND);
            if first == 0 { [centre, a, b] } else { [centre, b, a] }
        }));
    }
    mesh
}

/// Without the triangles between the last and the first of `around` columns.
fn cut_along(mesh: TriMesh, around: u32) -> TriMesh {
    let is_seam = |t: &[u32; 3]| {
        let columns = t.map(|v| v % around);
        columns.contains(&0) && columns.contains(&(around - 1))
    };
    TriMesh { triangles: mesh.triangles.into_iter().filter(|t| !is_seam(t)).collect(), ..mesh }
}

fn joined(one: &TriMesh, other: &TriMesh) -> TriMesh {
    let first = one.positions.len() as u32;
    TriMesh {
        positions: [&one.positions[..], &other.positions].concat(),
        triangles: one.triangles.iter().copied().chain(other.triangles.iter().map(|t| t.map(|v| v + first))).collect(),
    }
}

/// A runner that tries the same settings each time and keeps no files.
fn runner(cases: u32) -> TestRunner {
    TestRunner::new(Config { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(3), ..Config::default() })
}

fn any_settings(mesh: &Arc<TriMesh>) -> Result<(), Failed> {
    let tried = runner(cases()).run(&settings(), |settings| {
        let mut pipeline = Pipeline::new(mesh.clone(), settings).with_samples(1);
        check(&mut pipeline).map_err(TestCaseError::fail)
    });
    tried.map_err(|error| Failed::from(error.to_string()))
}

/// A bound that is asked for is kept by samples of both surfaces, and the next coarser level is said to break it.
fn any_bound(mesh: &Arc<TriMesh>) -> Result<(), Failed> {
    let mut pipeline =
        Pipeline::new(mesh.clone(), Settings { target: Target::Reduction(900), ..Settings::default() }).with_samples(1);
    let bounds = [5, 40, 220, 1_700, 9_000];
    for (method, micrometres) in Method::ALL.into_iter().flat_map(|method| bounds.map(|bound| (method, bound))) {
        let target = Target::Deviation(micrometres);
        let mut settings = Settings { target, ..Settings::default() };
        settings.decimation.method = method;
        pipeline.set(settings)?;
        pipeline.finish()?;
        let (Some(smoothed), Some(reduced), Some(found), Some(bound)) =
            (pipeline.smoothed(), pipeline.reduced(), pipeline.bound(), target.deviation_mm())
        else {
            return Err("no result".into());
        };
        let measured = deviation(&smoothed.mesh, &reduced.mesh, 100_000).ok_or("no area")?.max;
        // A sample is rounded to f32.
        if measured > bound + 1e-5 {
            return Err(format!("{bound} mm: {found:?} is {measured} mm away").into());
        }
        if found.next_coarser_mm.is_some_and(|next| next < 0.998 * bound) {
            return Err(format!("{bound} mm: {found:?} is not the coarsest").into());
        }
    }
    Ok(())
}

/// At the paper's rates no more faces cross others than did on the smoothed surface.
fn no_crossings(mesh: &Arc<TriMesh>) -> Result<(), Failed> {
    let mut pipeline =
        Pipeline::new(mesh.clone(), Settings { target: Target::Reduction(900), ..Settings::default() }).with_samples(1);
    let mut failures = Vec::new();
    let rates = if is_long() { &RATES[..] } else { &[900, 990] };
    for (method, &rate) in Method::ALL.into_iter().flat_map(|method| rates.iter().map(move |rate| (method, rate))) {
        let mut settings = Settings { target: Target::Reduction(rate), ..Settings::default() };
        settings.decimation.method = method;
        pipeline.set(settings)?;
        pipeline.finish()?;
        let (Some(smoothed), Some(reduced)) = (pipeline.smoothed(), pipeline.reduced()) else {
            return Err("no result".into());
        };
        let (before, after) = (crossing_faces(&smoothed.mesh), crossing_faces(&reduced.mesh));
        if after > before {
            failures.push(format!("{method:?}, {} %: {after} faces cross, {before} before", f64::from(rate) / 10.0));
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("; ").into()) }
}

/// With all pieces kept and nothing smoothed, no level has faces that cross.
fn nothing_crosses(mesh: &Arc<TriMesh>) -> Result<(), Failed> {
    let smoothing = Smoothing { iterations: 0, ..Smoothing::default() };
    let settings = Settings { keep: Keep::All, smoothing, target: Target::Reduction(900), ..Settings::default() };
    let mut pipeline = Pipeline::new(mesh.clone(), settings.clone()).without_measures();
    let mut failures = Vec::new();
    if crossing_faces(mesh) > 0 {
        return Err("faces cross before anything was done".into());
    }
    for (method, rate) in Method::ALL.into_iter().flat_map(|method| [900, 950, 980, 990].map(|rate| (method, rate))) {
        let mut settings = Settings { target: Target::Reduction(rate), ..settings.clone() };
        settings.decimation.method = method;
        pipeline.set(settings)?;
        pipeline.finish()?;
        let reduced = pipeline.reduced().ok_or("no result")?;
        let (count, crossing) = (reduced.mesh.triangles.len(), crossing_faces(&reduced.mesh));
        if crossing > 0 || reduced.level.shortfall.is_some() {
            failures.push(format!("{method:?}, {} %: {crossing} of {count} faces cross", f64::from(rate) / 10.0));
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("; ").into()) }
}

/// Counts that can be told by eye.
fn the_counter_counts() -> Result<(), Failed> {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let floor = [at(0.0, 0.0, 0.0), at(4.0, 0.0, 0.0), at(0.0, 4.0, 0.0)];
    // Through the floor, beside it, standing on it, and a fold that goes through it from a corner of its own.
    let through = [at(1.0, 1.0, -1.0), at(1.0, 1.0, 1.0), at(1.0, 2.0, 2.0)];
    let beside = through.map(|p| p + Vec3::X * 5.0);
    let standing = [at(1.0, 1.0, 0.0), at(1.0, 1.0, 1.0), at(1.0, 2.0, 2.0)];
    let fold = [at(2.0, 1.0, -1.0), at(0.5, 2.0, 1.0)];
    for (name, third, expected) in [("through", through, 2), ("beside", beside, 0), ("standing", standing, 0)] {
        let mesh = TriMesh { positions: [floor, third].concat(), triangles: vec![[0, 1, 2], [3, 4, 5]] };
        let count = crossing_faces(&mesh);
        if count != expected {
            return Err(format!("{name}: {count} faces, not {expected}").into());
        }
    }
    let shared = TriMesh { positions: [&floor[..], &fold].concat(), triangles: vec![[0, 1, 2], [0, 3, 4]] };
    let count = crossing_faces(&shared);
    if count == 2 { Ok(()) } else { Err(format!("the fold: {count} faces, not 2").into()) }
}
