//! Stretches of surfaces whose diameters are known at every place.

use std::sync::Arc;

use glam::DVec3;

use super::Subject;
use super::certificate::{BranchCalibre, Certificate, TOLERANCE_PERCENT};
use super::variation::{Kind, Variation};
use lumen_mesh::TriMesh;
use lumen_mesh::shapes::{isosurface, tube};
use lumen_mesh::task::{Yielder, at_once};

fn branches(mesh: &TriMesh) -> Vec<BranchCalibre> {
    let subjects = [0, 1, 2].map(|_| Subject::new(&Arc::new(mesh.clone())));
    at_once(Certificate::of(subjects, TOLERANCE_PERCENT, &Yielder::never())).unwrap().branches
}

fn found(mesh: &TriMesh) -> Vec<Variation> {
    branches(mesh).into_iter().flat_map(|branch| branch.variations).collect()
}

/// What a mask of voxels of `spacing` mm has of a vessel along z, 60 mm long, with its stair-steps.
fn masked(spacing: f64, radius: impl Fn(f64) -> f64) -> TriMesh {
    let (low, high) = (DVec3::new(-6.0, -6.0, -1.0), DVec3::new(6.0, 6.0, 61.0));
    let inside = |p: DVec3| if (0.0..=60.0).contains(&p.z) { radius(p.z) - p.truncate().length() } else { -1.0 };
    isosurface(low, high, spacing, |p| inside(p).signum())
}

/// A bell of this height in parts of the radius, at z = 30 mm of a vessel of 6 mm: where it is a twentieth is known.
fn bell(height: f64) -> (impl Fn(f64) -> f64, f64) {
    let half = (32.0 * libm::log(height.abs() / 0.05)).sqrt();
    (move |z: f64| 3.0 * (1.0 + height * libm::exp(-(z - 30.0) * (z - 30.0) / 32.0)), 2.0 * half)
}

/// The degree is within two points, the length within two stations, the place within one.
fn check(mesh: &TriMesh, kind: Kind, degree: f64, length: f64) {
    check_within(mesh, kind, degree, length, 2.0);
}

fn check_within(mesh: &TriMesh, kind: Kind, degree: f64, length: f64, points: f64) {
    let branches = branches(mesh);
    let all: Vec<&Variation> = branches.iter().flat_map(|branch| &branch.variations).collect();
    let lengths: Vec<f64> = branches.iter().map(|branch| branch.length_mm).collect();
    let [one] = all[..] else { panic!("{all:?} on branches of {lengths:?} mm") };
    assert_eq!(one.kind, kind);
    assert!((one.degree_percent - degree).abs() <= points, "{one:?}");
    let part = if kind == Kind::Narrower { 1.0 - degree / 100.0 } else { 1.0 + degree / 100.0 };
    assert!((one.area_percent - 100.0 * (1.0 - part * part).abs()).abs() <= 3.5 * points, "{one:?}");
    assert!((one.length_mm - length).abs() <= 1.8, "{one:?} is not {length} mm long");
    // A throat of voxels is as wide over several of them.
    assert!((f64::from(one.at_mm[2]) - 30.0).abs() <= 3.0, "{one:?}");
    assert!((one.reference_mm - 6.0).abs() <= 0.15, "{one:?}");
    // The reduced surface is the same one.
    assert!((one.reduced_degree_percent.unwrap() - one.degree_percent).abs() < 1e-6);
}

#[test]
fn a_stenosis_has_its_degree_length_and_place() {
    let (radius, length) = bell(-0.7);
    check(&tube(64, 240, 60.0, |z| radius(f64::from(z)) as f32), Kind::Narrower, 70.0, length);
    check(&masked(0.5, &radius), Kind::Narrower, 70.0, length);
    let (radius, length) = bell(-0.4);
    check(&tube(64, 240, 60.0, |z| radius(f64::from(z)) as f32), Kind::Narrower, 40.0, length);
}

#[test]
fn a_widening_has_its_degree_length_and_place() {
    let (radius, length) = bell(0.6);
    check(&tube(64, 240, 60.0, |z| radius(f64::from(z)) as f32), Kind::Wider, 60.0, length);
    // Of so few voxels the top of a bulge is blunt.
    check_within(&masked(0.4, &radius), Kind::Wider, 60.0, length, 3.5);
}

#[test]
fn a_stenosis_of_a_taper_is_measured_beside_the_taper() {
    let (bell, _) = bell(-0.5);
    let taper = |z: f64| 4.0 - 0.04 * z;
    let all = found(&tube(64, 240, 60.0, |z| (bell(f64::from(z)) / 3.0 * taper(f64::from(z))) as f32));
    let [one] = &all[..] else { panic!("{all:?}") };
    assert!((one.degree_percent - 50.0).abs() <= 2.0, "{one:?}");
    assert!((one.reference_mm / 2.0 - taper(f64::from(one.at_mm[2]))).abs() <= 0.1, "{one:?}");
}

#[test]
fn cones_and_rough_walls_have_none() {
    assert_eq!(found(&tube(64, 240, 60.0, |z| 5.0 - 0.06 * z)), []);
    assert_eq!(found(&masked(0.5, |z| 5.0 - 0.06 * z)), []);
    assert_eq!(found(&masked(0.5, |_| 3.0)), []);
    assert_eq!(found(&masked(0.5, |_| 1.2)), []);
    // A tenth of the radius up and down, from ring to ring and side to side.
    let mut rough = tube(48, 200, 60.0, |_| 3.0);
    let mut state = 1u64;
    for p in &mut rough.positions {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = 1.0 + 0.1 * ((state >> 40) as f32 / (1u64 << 24) as f32 * 2.0 - 1.0);
        (p.x, p.y) = (p.x * part, p.y * part);
    }
    assert_eq!(found(&rough), []);
}

#[test]
fn a_coarctation_is_told_by_its_narrowing_first() {
    // An aorta of 20 mm that a coarctation narrows by 45 % at 70 mm, and that is half as wide again at 170 mm.
    let bell = |z: f64, at: f64, wide: f64| libm::exp(-(z - at) * (z - at) / (2.0 * wide * wide));
    let radius = |z: f32| 10.0 * (1.0 - 0.45 * bell(f64::from(z), 70.0, 10.0) + 0.5 * bell(f64::from(z), 170.0, 10.0));
    let branches = branches(&tube(64, 480, 240.0, |z| radius(z) as f32));
    let [branch] = &branches[..] else { panic!("{} branches", branches.len()) };
    let [Some(narrower), Some(wider)] = branch.uneven() else { panic!("{:?}", branch.variations) };
    assert_eq!((narrower.kind, wider.kind), (Kind::Narrower, Kind::Wider));
    assert!((narrower.degree_percent - 45.0).abs() <= 2.0, "{narrower:?}");
    assert!((wider.degree_percent - 50.0).abs() <= 3.5, "{wider:?}");
    assert!(narrower.degree_percent < wider.degree_percent, "the greater degree is not told first");
    // Where the bell is a twentieth; a radius is a mean over as long as the vessel is wide, which draws that out a little.
    let length = 2.0 * 10.0 * (2.0 * libm::log(0.45 / 0.05)).sqrt();
    assert!((narrower.length_mm - length).abs() <= 2.5, "{narrower:?} is not {length} mm long");
    let [Some(before), Some(after)] = narrower.sides else { panic!("{narrower:?}") };
    assert!(before.abscissa_mm < narrower.from_mm && after.abscissa_mm > narrower.to_mm, "{narrower:?}");
    for side in [before, after] {
        assert!((side.diameter_mm - 20.0).abs() <= 0.1, "{side:?}");
    }
    let text = branch.uneven_text().unwrap().to_string();
    let (first, second) = text.split_once("; ").unwrap();
    assert!(first.contains("% narrower over") && second.contains("% wider over"), "{text}");
    let reference = narrower.reference().to_string();
    assert!(reference.starts_with("11.2") && reference.contains(" of 19.99 mm"), "{reference}");
}

#[test]
fn the_narrowest_place_is_measured_beside_a_chosen_one() {
    // From 8 mm at one end to 3.2 mm at the other, which no side tells as a narrowing, with a stenosis of 50 % at 30 mm.
    let (bell, _) = bell(-0.5);
    let taper = |z: f64| 4.0 - 0.04 * z;
    let plain = branches(&tube(64, 240, 60.0, |z| taper(f64::from(z)) as f32));
    let stenosed = branches(&tube(64, 240, 60.0, |z| (bell(f64::from(z)) / 3.0 * taper(f64::from(z))) as f32));
    let ([plain], [stenosed]) = (&plain[..], &stenosed[..]) else { panic!("one vessel each") };
    assert_eq!(plain.uneven(), [None, None]);
    for (branch, is_stenosed) in [(plain, false), (stenosed, true)] {
        for at in [10.0, 50.0] {
            let found = branch.narrowest_beside(at).unwrap();
            // The branch may begin at either end.
            let z = |at: f64| {
                let i = branch.abscissas_mm.iter().position(|&other| f64::from(other) >= at).unwrap();
                f64::from(branch.at_mm[i][2])
            };
            let reference = 2.0 * taper(z(at)) * if is_stenosed { bell(z(at)) / 3.0 } else { 1.0 };
            assert!((found.reference_mm - reference).abs() <= 0.1, "{found:?} beside {reference} mm");
            assert!((found.sides[0].unwrap().abscissa_mm - at).abs() <= 1.0, "{found:?}");
            if is_stenosed {
                assert!((found.diameter_mm - taper(30.0)).abs() <= 0.15, "{found:?}");
                assert!((f64::from(found.at_mm[2]) - 30.0).abs() <= 3.0, "{found:?}");
            }
            let part = found.diameter_mm / found.reference_mm;
            assert!((found.degree_percent - 100.0 * (1.0 - part)).abs() < 1e-9 && found.degree_percent >= 0.0);
            assert!((found.area_percent - 100.0 * (1.0 - part * part)).abs() < 1e-9);
            assert!((found.reduced_degree_percent.unwrap() - found.degree_percent).abs() < 1e-4, "the same surface");
        }
    }
    // Beyond the end it is the last place that is one vessel; beside itself it is not narrower.
    let narrowest = stenosed.narrowest_beside(0.0).unwrap();
    assert_eq!(stenosed.narrowest_beside(-5.0), Some(narrowest.clone()));
    assert_eq!(stenosed.narrowest_beside(narrowest.abscissa_mm).unwrap().degree_percent, 0.0);
}
