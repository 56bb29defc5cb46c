//! Reduction that spares thin vessels, on trees made here: what it keeps of them, and what it leaves as it is.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use glam::DVec3;
use lumen::mesh::{Topology, TriMesh, volume};
use lumen::pipeline::progressive::ProgressiveMesh;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Decimation, Keep, Method, Settings, Smoothing, Target};

/// A wide and a thin vessel side by side, each a round tube along an arc, closed at both ends: radii in mm.
const RADII: [f64; 2] = [8.0, 1.0];

/// A closed tube of that radius along a quarter of a circle ten radii wide, on edges of `edge`.
fn bent(radius: f64, edge: f64, shift: DVec3) -> TriMesh {
    let around = (2.0 * PI * radius / edge).ceil() as u32;
    let length = 10.0 * radius * FRAC_PI_2;
    let rings = (length / edge).ceil() as u32;
    let mut mesh = TriMesh::default();
    for ring in 0..=rings {
        let turn = FRAC_PI_2 * f64::from(ring) / f64::from(rings);
        let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
        for i in 0..around {
            let angle = 2.0 * PI * (f64::from(i) + f64::from(ring % 2) / 2.0) / f64::from(around);
            let p = out * radius * (10.0 + angle.cos()) + DVec3::Z * radius * angle.sin();
            mesh.positions.push((p + shift).as_vec3());
        }
    }
    for ring in 0..rings {
        for i in 0..around {
            let (a, b) = (ring * around, (ring + 1) * around);
            let j = (i + 1) % around;
            let quad = if ring % 2 == 0 {
                [[a + i, b + i, a + j], [a + j, b + i, b + j]]
            } else {
                [[a + i, b + i, b + j], [a + i, b + j, a + j]]
            };
            mesh.triangles.extend(quad);
        }
    }
    for (first, turn) in [(0, 0.0), (rings * around, FRAC_PI_2)] {
        let middle = mesh.positions.len() as u32;
        mesh.positions.push((DVec3::new(turn.cos(), turn.sin(), 0.0) * 10.0 * radius + shift).as_vec3());
        for i in 0..around {
            let (a, b) = (first + i, first + (i + 1) % around);
            mesh.triangles.push(if first == 0 { [a, b, middle] } else { [b, a, middle] });
        }
    }
    mesh
}

fn pair() -> Arc<TriMesh> {
    let mut mesh = bent(RADII[0], 0.5, DVec3::ZERO);
    let thin = bent(RADII[1], 0.1, DVec3::X * 200.0);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(thin.positions);
    mesh.triangles.extend(thin.triangles.iter().map(|t| t.map(|v| v + first)));
    Arc::new(mesh)
}

fn settings(method: Method, spare_thin: bool, target: Target) -> Settings {
    let decimation = Decimation { method, spare_thin, ..Decimation::default() };
    Settings { keep: Keep::All, smoothing: Smoothing::NONE, decimation, target, ..Settings::default() }
}

fn levels(mesh: &Arc<TriMesh>, settings: Settings) -> Arc<ProgressiveMesh> {
    let mut pipeline = Pipeline::new(mesh.clone(), settings).without_measures();
    pipeline.finish().unwrap();
    pipeline.progressive().unwrap().clone()
}

/// Of the wide and the thin vessel: triangles left, and by what part the radius has changed, as half of the volume.
fn left(levels: &ProgressiveMesh, target: Target) -> [(usize, f64); 2] {
    let level = levels.extract(&levels.level(target).triangles);
    let finest = levels.extract(&levels.level(Target::Reduction(0)).triangles);
    let part = |mesh: &TriMesh, is_thin: bool| {
        let triangles = mesh.triangles.iter().filter(|t| (mesh.positions[t[0] as usize].x > 150.0) == is_thin).copied();
        TriMesh { triangles: triangles.collect(), ..mesh.clone() }
    };
    let size = |mesh: &TriMesh| volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles)).abs();
    [false, true].map(|is_thin| {
        let (before, after) = (part(&finest, is_thin), part(&level, is_thin));
        (after.triangles.len(), (size(&after) / size(&before) - 1.0) / 2.0)
    })
}

#[test]
fn a_thin_vessel_keeps_more_triangles_and_its_calibre_better_at_the_same_count() {
    let mesh = pair();
    let total = mesh.triangles.len();
    for method in Method::ALL {
        let [plain, spared] = [false, true].map(|spare| levels(&mesh, settings(method, spare, Target::default())));
        for rate in [800, 900] {
            let target = Target::Reduction(rate);
            let wanted = target.triangles(total);
            for levels in [&plain, &spared] {
                let found = levels.level(target).triangles.len();
                assert!(found <= wanted && found + 2 > wanted, "{method:?} at {rate}: {found} of {wanted}");
            }
            let ([wide, thin], [wide_spared, thin_spared]) = (left(&plain, target), left(&spared, target));
            let text = format!("{method:?} at {rate}: {wide:?} {thin:?}, spared {wide_spared:?} {thin_spared:?}");
            assert!(thin_spared.0 as f64 > 1.5 * thin.0 as f64 && wide_spared.0 < wide.0, "{text}");
            // Chords of a tube lie inside by a part of the radius that is as the error over the radius: at one error the
            // ratio of the radii, with the geometric mean its root.
            if method == Method::Schroeder {
                let ratio = |[wide, thin]: [(usize, f64); 2]| thin.1 / wide.1;
                let (before, after) = (ratio([wide, thin]), ratio([wide_spared, thin_spared]));
                let expected = RADII[0] / RADII[1];
                assert!((before / expected - 1.0).abs() < 0.35, "{text}");
                assert!((after / expected.sqrt() - 1.0).abs() < 0.35, "{text}");
            }
        }
    }
}

#[test]
fn the_widths_are_the_same_whoever_finds_them() {
    let mesh = pair();
    let spared = settings(Method::Schroeder, true, Target::default());
    let fresh = levels(&mesh, spared.clone());
    let adapted = Settings { smoothing: Smoothing::AUTO, ..spared.clone() };
    let mut pipeline = Pipeline::new(mesh.clone(), adapted.clone()).without_measures();
    pipeline.finish().unwrap();
    let smoothed = pipeline.progressive().unwrap().clone();
    pipeline.set(spared).unwrap();
    pipeline.finish().unwrap();
    assert!(*pipeline.progressive().unwrap() == fresh, "found by smoothing");
    pipeline.set(adapted).unwrap();
    pipeline.finish().unwrap();
    assert!(*pipeline.progressive().unwrap() == smoothed, "found by decimation");
}

#[test]
fn what_has_no_width_is_reduced_as_it_is_without() {
    let corners = (0..900u16).map(|i| glam::Vec3::new(f32::from(i % 30), f32::from(i / 30), f32::from(i % 7) / 50.0));
    let square = |i: u32| [[i, i + 1, i + 31], [i, i + 31, i + 30]];
    let triangles = (0..870u32).filter(|i| i % 30 < 29).flat_map(square).collect();
    let sheet = Arc::new(TriMesh { positions: corners.collect(), triangles });
    for method in Method::ALL {
        let [plain, spared] = [false, true].map(|spare| levels(&sheet, settings(method, spare, Target::default())));
        assert!(plain == spared, "{method:?}");
    }
}

#[test]
fn a_bound_on_the_deviation_is_met_in_mm() {
    let mesh = Arc::new(bent(2.0, 0.4, DVec3::ZERO));
    for method in Method::ALL {
        let mut pipeline = Pipeline::new(mesh.clone(), settings(method, true, Target::Deviation(50)));
        pipeline.finish().unwrap();
        let found = pipeline.deviations().unwrap().from_smoothed.clone().unwrap().deviation;
        assert!(found.max <= 0.05, "{method:?}: {found:?}");
        assert!(pipeline.bound().unwrap().next_coarser_mm.is_some_and(|mm| mm > 0.05 * 0.999), "{method:?}");
    }
}
