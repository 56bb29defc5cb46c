//! Surfaces and settings that make no sense: every stage answers clearly and in time, nothing panics.

use std::sync::Arc;
use std::sync::mpsc;
use std::time::Duration;

use lumen::mesh::{TriMesh, Vec3};
use lumen::pipeline::report::Report;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Boundary, Keep, Method, Settings, SettingsError, Smoothing, Target, Window};
use lumen_test_support::is_long;

/// What one surface may take through all stages under all settings tried; most take milliseconds.
const LIMIT: Duration = Duration::from_secs(120);

/// Runs every stage, up to a report that can be read back, under settings that between them reach every branch.
fn survive(name: &str, mesh: TriMesh) {
    let (label, mesh) = (name.to_owned(), Arc::new(mesh));
    in_time(name, move || all_settings().iter().for_each(|settings| check(&label, &mesh, settings)));
}

/// Runs `work` on a thread, which is left behind if it does not come to an end.
fn in_time(name: &str, work: impl FnOnce() + Send + 'static) {
    let (done, outcome) = mpsc::channel();
    let run = std::thread::spawn(move || {
        work();
        // Nobody listens any more once the limit has passed.
        done.send(()).ok();
    });
    let result = outcome.recv_timeout(LIMIT);
    assert_ne!(result, Err(mpsc::RecvTimeoutError::Timeout), "{name}: not done within {LIMIT:?}");
    if let Err(panic) = run.join() {
        std::panic::resume_unwind(panic);
    }
}

fn all_settings() -> Vec<Settings> {
    let mut list = Vec::new();
    for keep in [Keep::Largest, Keep::All] {
        for target in [Target::Reduction(0), Target::Reduction(900), Target::Triangles(1), Target::Deviation(100)] {
            let mut settings = Settings { keep, target, ..Settings::default() };
            settings.smoothing.iterations = if keep == Keep::All { 20 } else { 0 };
            settings.smoothing.boundary = if keep == Keep::All { Boundary::Vtk15 } else { Boundary::Loop };
            settings.smoothing.window = if target == Target::Reduction(0) { Window::Nuttall } else { Window::Hamming };
            for method in Method::ALL {
                settings.decimation.method = method;
                list.push(settings.clone());
            }
        }
    }
    list
}

fn check(name: &str, mesh: &Arc<TriMesh>, settings: &Settings) {
    let what = format!("{name}, {settings:?}");
    let mut pipeline = Pipeline::new(mesh.clone(), settings.clone()).with_samples(500);
    pipeline.finish().unwrap_or_else(|error| panic!("{what}: {error}"));
    let levels = pipeline.progressive().unwrap_or_else(|| panic!("{what}: no levels"));
    levels.assert_well_formed();
    let (kept, reduced) = (pipeline.kept().unwrap(), pipeline.reduced().unwrap());
    let (wanted, count) = (settings.target.triangles(kept.mesh.triangles.len()), reduced.mesh.triangles.len());
    assert!(count <= wanted || reduced.level.shortfall.is_some(), "{what}: {count} of {wanted} and no word on why");
    assert_eq!(reduced.normals.len(), reduced.mesh.positions.len(), "{what}");
    let report = Report::new(name, &pipeline).unwrap();
    // What is not a number cannot be read back.
    let json = serde_json::to_string(&report).unwrap();
    let read: Report = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{what}: {error} in {json}"));
    assert_eq!(read, report, "{what}");
}

fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> TriMesh {
    TriMesh { positions: positions.iter().copied().map(Vec3::from).collect(), triangles: triangles.to_vec() }
}

/// A tetrahedron, outward, with a corner at `at` and edges of `size` along the axes.
fn tetrahedron(at: Vec3, size: f32) -> TriMesh {
    let positions = vec![at, at + Vec3::X * size, at + Vec3::Y * size, at + Vec3::Z * size];
    TriMesh { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] }
}

fn joined(parts: impl IntoIterator<Item = TriMesh>) -> TriMesh {
    parts.into_iter().fold(TriMesh::default(), |mut all, part| {
        let first = all.positions.len() as u32;
        all.positions.extend(part.positions);
        all.triangles.extend(part.triangles.into_iter().map(|corners| corners.map(|v| v + first)));
        all
    })
}

/// A band of `n` cells that closes after `half_turns` half turns, with three rows of vertices.
fn band(n: u32, half_turns: u32) -> TriMesh {
    let at = |i: u32, row: i32| {
        let angle = i as f32 / n as f32 * std::f32::consts::TAU;
        let twist = angle * half_turns as f32 / 2.0;
        let across = row as f32 * 2.0;
        let radius = 10.0 + across * twist.cos();
        Vec3::new(radius * angle.cos(), radius * angle.sin(), across * twist.sin())
    };
    let positions = (0..n).flat_map(|i| (-1..=1).map(move |row| at(i, row))).collect();
    let corner = |i: u32, row: u32| {
        let is_turned = i == n && half_turns % 2 == 1;
        (i % n) * 3 + if is_turned { 2 - row } else { row }
    };
    let cells = (0..n).flat_map(|i| (0..2).map(move |row| (i, row)));
    let triangles = cells.flat_map(|(i, row)| {
        let [a, b, c, d] = [corner(i, row), corner(i + 1, row), corner(i + 1, row + 1), corner(i, row + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriMesh { positions, triangles: triangles.collect() }
}

fn torus(n: u32) -> TriMesh {
    let at = |i: u32| {
        let part = |i: u32| i as f32 / n as f32 * std::f32::consts::TAU;
        let (u, v) = (part(i / n), part(i % n));
        let ring = 10.0 + 3.0 * v.cos();
        Vec3::new(ring * u.cos(), ring * u.sin(), 3.0 * v.sin())
    };
    let corner = |u: u32, v: u32| (u % n) * n + v % n;
    let cells = (0..n * n).flat_map(|i| {
        let (u, v) = (i / n, i % n);
        let [a, b, c, d] = [corner(u, v), corner(u + 1, v), corner(u + 1, v + 1), corner(u, v + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriMesh { positions: (0..n * n).map(at).collect(), triangles: cells.collect() }
}

#[test]
fn nothing_and_next_to_nothing() {
    survive("no vertex", TriMesh::default());
    survive("isolated vertices", mesh(&[[0.0; 3], [1.0; 3], [2.0; 3]], &[]));
    survive("a triangle", mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]));
    survive("a triangle among isolated vertices", {
        mesh(&[[9.0; 3], [0.0; 3], [5.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[1, 3, 4]])
    });
    survive("two triangles back to back", {
        mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2], [0, 2, 1]])
    });
    survive("a tetrahedron", tetrahedron(Vec3::ZERO, 1.0));
}

#[test]
fn triangles_without_area() {
    survive("a line", mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], &[[0, 1, 2]]));
    survive("coincident corners", mesh(&[[1.0; 3], [1.0; 3], [1.0; 3], [1.0; 3]], &[[0, 1, 2], [2, 1, 3]]));
    // A strip of needles and caps: 100 mm long, a millionth of a millimetre to a tenth wide.
    for width in [0.0f32, 1e-6, 1e-3, 0.1] {
        let n = 200u32;
        let positions: Vec<[f32; 3]> =
            (0..2 * n).map(|i| [(i / 2) as f32 * 0.5, (i % 2) as f32 * width, 0.0]).collect();
        let cells = (0..n - 1).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 1], [2 * i + 1, 2 * i + 2, 2 * i + 3]]);
        survive("slivers", mesh(&positions, &cells.collect::<Vec<_>>()));
    }
    // A fan of needles around one vertex.
    let n = 500u32;
    let rim = (0..n).map(|i| [100.0, i as f32 * 1e-4, (i as f32 * 0.1).sin() * 1e-4]);
    let positions: Vec<[f32; 3]> = [[0.0; 3]].into_iter().chain(rim).collect();
    survive("a fan of needles", mesh(&positions, &(1..n).map(|i| [0, i, i + 1]).collect::<Vec<_>>()));
}

#[test]
fn many_pieces() {
    let places = (0..5_594).map(|i| Vec3::new((i % 20) as f32, (i / 20 % 20) as f32, (i / 400) as f32) * 3.0);
    survive("5,594 components", joined(places.map(|at| tetrahedron(at, 1.0))));
}

#[test]
fn non_manifold_edges_and_vertices() {
    for pages in [3u32, 4, 10] {
        let page = |i: u32| [(i as f32).cos() * 5.0, (i as f32).sin() * 5.0, 1.0];
        let positions: Vec<[f32; 3]> = [[0.0; 3], [0.0, 0.0, 2.0]].into_iter().chain((0..pages).map(page)).collect();
        survive("a book", mesh(&positions, &(2..2 + pages).map(|i| [0, 1, i]).collect::<Vec<_>>()));
    }
    let one = tetrahedron(Vec3::ZERO, 1.0);
    let mut at_a_vertex = joined([one.clone(), tetrahedron(Vec3::ZERO, -1.0)]);
    at_a_vertex.triangles.as_flattened_mut().iter_mut().filter(|v| **v == 4).for_each(|v| *v = 0);
    survive("two tetrahedra at a vertex", at_a_vertex);
    let mut other = tetrahedron(Vec3::ZERO, -1.0);
    other.positions[1] = Vec3::X;
    let mut at_an_edge = joined([one.clone(), other]);
    at_an_edge.triangles.as_flattened_mut().iter_mut().filter(|v| [4, 5].contains(*v)).for_each(|v| *v -= 4);
    survive("two tetrahedra at an edge", at_an_edge);
    // Every edge has six triangles, so that no vertex can move or go.
    let mut fixed = one.clone();
    fixed.triangles = fixed.triangles.repeat(3);
    survive("all vertices fixed", fixed);
    let mut torn = torus(12);
    torn.triangles.extend(torn.triangles.clone().into_iter().step_by(5));
    survive("duplicate triangles", torn);
    // Tori that share one vertex, and fans of several sheets.
    let mut chain = joined((0..4).map(|_| torus(8)));
    chain.triangles.as_flattened_mut().iter_mut().filter(|v| v.is_multiple_of(64)).for_each(|v| *v = 0);
    survive("tori at a vertex", chain);
}

#[test]
fn one_sided_and_holed_surfaces() {
    survive("a Möbius strip", band(60, 1));
    survive("a strip of two half turns", band(60, 2));
    survive("a small Möbius strip", band(5, 1));
    survive("a torus", torus(24));
    let mut disagreeing = torus(12);
    disagreeing.triangles.iter_mut().step_by(3).for_each(|t| t.swap(0, 1));
    survive("disagreeing windings", disagreeing);
}

#[test]
fn huge_and_tiny_coordinates() {
    for size in [1e-38f32, 1e-30, 1e-20, 1e-10, 1e10, 1e18, 1e30, 1e37] {
        let mut scaled = torus(16);
        scaled.positions.iter_mut().for_each(|p| *p *= size / 13.0);
        survive(&format!("a torus of {size:e} mm"), scaled);
    }
    let mut far = torus(16);
    far.positions.iter_mut().for_each(|p| *p += 1e7);
    survive("a torus far away", far);
    survive("from tiny to huge", joined([tetrahedron(Vec3::ZERO, 1e-30), tetrahedron(Vec3::ONE, 1e30), torus(8)]));
    let mut mixed = torus(16);
    mixed.positions.iter_mut().step_by(7).for_each(|p| *p *= 1e25);
    survive("a torus with spikes", mixed);
}

/// A reader refuses these; whoever uses the library gets no promise but that it ends.
#[test]
fn coordinates_that_are_no_numbers() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut broken = torus(16);
        broken.positions.iter_mut().step_by(17).for_each(|p| p.y = bad);
        let mut all = torus(4);
        all.positions.fill(Vec3::splat(bad));
        for mesh in [broken, all].map(Arc::new) {
            in_time(&format!("a torus with {bad}"), move || {
                for settings in all_settings() {
                    Pipeline::new(mesh.clone(), settings).with_samples(500).finish().unwrap();
                }
            });
        }
    }
}

#[test]
fn settings_that_are_no_numbers_are_refused_wherever_they_come_in() {
    let nan = f64::NAN;
    let mut bad = Vec::new();
    for pass_band in [nan, f64::INFINITY, 0.0, -1.0, 2.1] {
        let mut settings = Settings::default();
        settings.smoothing.pass_band = pass_band;
        bad.push(settings);
    }
    for angle in [nan, f64::NEG_INFINITY, -1.0, 181.0] {
        let mut settings = Settings::default();
        settings.decimation.feature_angle = angle;
        bad.push(settings);
    }
    let mut settings = Settings::default();
    settings.smoothing.iterations = u32::MAX;
    bad.push(settings);
    for target in [Target::Reduction(1_000), Target::Deviation(0), Target::Deviation(u32::MAX)] {
        bad.push(Settings { target, ..Settings::default() });
    }
    let surface = Arc::new(torus(8));
    for settings in bad {
        let what = format!("{settings:?}");
        let mut begun = Pipeline::new(surface.clone(), settings.clone());
        assert!(begun.finish().is_err() && begun.reduced().is_none(), "{what}");
        let mut pipeline = Pipeline::new(surface.clone(), Settings::default()).with_samples(100);
        pipeline.finish().unwrap();
        let error = pipeline.set(settings).unwrap_err();
        assert!(!error.to_string().is_empty());
        // What was there stays.
        assert_eq!(*pipeline.settings(), Settings::default(), "{what}");
        assert!(pipeline.reduced().is_some(), "{what}");
    }
    let mut none = Pipeline::new(surface, Settings { keep: Keep::Component(7), ..Settings::default() });
    assert!(matches!(none.finish(), Err(SettingsError::Component { wanted: 7, count: 1 })));
}

/// `count` triangles over as many random places of a box: nearly all run into each other.
fn tangle(count: u32) -> TriMesh {
    let mut state = 7u32;
    let mut next = |below: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((u64::from(state) * u64::from(below)) >> 32) as u32
    };
    let positions = (0..count).map(|_| Vec3::from([(); 3].map(|()| next(1 << 20) as f32 * 1e-4))).collect();
    let triangles = (0..count).map(|_| [(); 3].map(|()| next(count)));
    let is_whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    TriMesh { positions, triangles: triangles.filter(is_whole).collect() }
}

/// A cylinder of `sides`, each end a fan around its middle.
fn cylinder(sides: u32) -> TriMesh {
    let at = |i: u32, z: f32| {
        let angle = f64::from(i) / f64::from(sides) * std::f64::consts::TAU;
        Vec3::new(10.0 * angle.cos() as f32, 10.0 * angle.sin() as f32, z)
    };
    let mut positions: Vec<Vec3> = [0.0, 40.0].iter().flat_map(|&z| (0..sides).map(move |i| at(i, z))).collect();
    positions.extend([Vec3::ZERO, Vec3::Z * 40.0]);
    let around = |i: u32| {
        let j = (i + 1) % sides;
        [[i, j, sides + j], [i, sides + j, sides + i], [2 * sides, j, i], [2 * sides + 1, sides + i, sides + j]]
    };
    TriMesh { positions, triangles: (0..sides).flat_map(around).collect() }
}

/// What the files that ate the machine were: 20,000 random triangles asked for 17 GB, a fan of 30,000 sides did not end.
#[test]
fn tangles_and_hubs_go_through_every_stage() {
    let (triangles, sides) = if is_long() { (20_000, 100_000) } else { (3_000, 10_000) };
    let rough = Smoothing { iterations: 0, ..Smoothing::default() };
    for (name, mesh) in [("a tangle", tangle(triangles)), ("a hub", cylinder(sides))] {
        let count = mesh.triangles.len();
        in_time(name, move || {
            let settings = Settings { keep: Keep::All, smoothing: rough, ..Settings::default() };
            let mut pipeline = Pipeline::new(Arc::new(mesh), settings);
            pipeline.finish().unwrap();
            let report = Report::new("surface", &pipeline).unwrap();
            assert_eq!(report.after_connectivity.triangles, count);
            let faces = report.smoothed_shape.unwrap().self_intersecting_faces;
            assert!(if name == "a hub" { faces == 0 } else { faces > count * 9 / 10 }, "{name}: {faces} of {count}");
        });
    }
}
