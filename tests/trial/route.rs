//! The vessel trees of the samples are those that they were made from, unreduced and reduced, and the way from entry to
//! target is found and open.

use std::sync::Arc;

use lumen::mesh::{TriMesh, Vec3};
use lumen::phantom::{Sample, generate, vessels};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Target};
use lumen::pipeline::task::Budget;
use lumen::trial::audit::Audit;
use lumen::trial::route::{Route, Routes as _, phantom_task};
use lumen::vessel::Tree;

/// What is left of the surface at a reduction of so many tenths of a percent, for each.
fn levels(mesh: TriMesh, rates: &[u32]) -> Vec<TriMesh> {
    let mut pipeline = Pipeline::new(Arc::new(mesh), Settings::default());
    while pipeline.progressive().is_none() {
        pipeline.advance(Budget::UNLIMITED).expect("the sample can be reduced");
    }
    let progressive = pipeline.progressive().expect("it was waited for").clone();
    let level = |&rate: &u32| progressive.extract(&progressive.level(Target::Reduction(rate)).triangles);
    rates.iter().map(level).collect()
}

/// Distances of the true centreline from the tree's, and the tree's radii over the true ones, for each vessel: between
/// two radii behind its ostium and one before its end.
fn compare(tree: &Tree, sample: Sample, mut check: impl FnMut(&str, f64, &[f64], &[f64])) {
    for vessel in vessels(sample) {
        let last = vessel.stations[vessel.stations.len() - 1];
        let ostium = vessel.stations[vessel.ostium];
        let (mut distances, mut ratios) = (Vec::new(), Vec::new());
        for station in &vessel.stations[vessel.ostium..] {
            let radius = station.diameter / 2.0;
            let from_ostium = station.position.distance(ostium.position);
            if from_ostium < 2.0 * radius || station.position.distance(last.position) < radius {
                continue;
            }
            let located = tree.locate(station.position, None).expect("there is a tree");
            distances.push(located.distance_mm);
            ratios.push(located.radius_mm / radius);
        }
        assert!(!distances.is_empty(), "{}", vessel.name);
        distances.sort_by(f64::total_cmp);
        ratios.sort_by(f64::total_cmp);
        check(vessel.name, ostium.diameter / 2.0, &distances, &ratios);
    }
}

fn task(tree: &Tree, sample: Sample) -> Route {
    let (entry, target) = phantom_task(sample);
    assert!(tree.is_inside(Vec3::from(entry.at)) && tree.is_inside(target));
    let route = tree.route(Vec3::from(entry.at), target).expect("the target can be reached");
    let start = route.points[0];
    assert!(start.direction.as_vec3().dot(Vec3::from(entry.direction)) > 0.9, "the entry points along the route");
    assert!(start.at.as_vec3().distance(Vec3::from(entry.at)) < 1.0);
    assert!(route.target.at.as_vec3().distance(target) < 1.5);
    route
}

/// The route is open for a wire by what the audit, which knows nothing of how it was found, says.
fn assert_open(route: &Route, mesh: &TriMesh, wire: f64) {
    let points: Vec<_> = route.points.iter().map(|point| point.at).collect();
    assert_eq!(route.clearance(wire), Ok(()));
    assert_eq!(Audit::new(mesh).is_open(&points, wire), Ok(()));
}

/// Distance between slices: the longer side of a voxel, in mm.
fn check_unreduced(sample: Sample, triangles: usize, voxel: f64, wire: f64) {
    let mesh = generate(sample, triangles).expect("the sample can be made");
    let tree = Tree::new(&mesh).expect("the sample has a tree");
    compare(&tree, sample, |name, radius, distances, ratios| {
        let nine_tenths = distances[distances.len() * 9 / 10];
        let most = distances[distances.len() - 1];
        // An aorta with sinuses and wide branches has no axis to a voxel.
        let slack = if radius > 7.0 { 0.2 * radius } else { voxel };
        assert!(nine_tenths < slack && most < slack + 0.4 * radius, "{name}: {nine_tenths} {most}");
        // The stairs of the mask stand in by up to half a voxel.
        let median = ratios[ratios.len() / 2];
        assert!(median > 0.95 - 0.5 * voxel / radius && median < 1.05, "{name}: {median}");
    });
    assert_open(&task(&tree, sample), &mesh, wire);
}

fn check_reduced(sample: Sample, triangles: usize, wire: f64) {
    let mesh = generate(sample, triangles).expect("the sample can be made");
    let rates = [0, 900, 950, 990];
    let mut length = None;
    for (level, rate) in levels(mesh, &rates).iter().zip(rates) {
        let tree = Tree::new(level).expect("the level has a tree");
        compare(&tree, sample, |name, radius, distances, _| {
            let nine_tenths = distances[distances.len() * 9 / 10];
            assert!(nine_tenths < (0.25 * radius).max(0.5), "{name} at {rate}: {nine_tenths}");
        });
        let route = task(&tree, sample);
        let whole = *length.get_or_insert(route.length_mm);
        assert!((route.length_mm / whole - 1.0).abs() < 0.02, "{} at {rate}, {whole} unreduced", route.length_mm);
        assert_open(&route, level, wire);
    }
}

#[test]
fn the_aorta_has_its_vessels() {
    check_unreduced(Sample::Aorta, Sample::Aorta.default_triangles(), 0.742, 0.889);
}

#[test]
fn the_coronary_arteries_have_their_vessels() {
    check_unreduced(Sample::Coronary, Sample::Coronary.default_triangles(), 0.498, 0.356);
}

#[test]
fn the_reduced_aorta_has_them_too() {
    check_reduced(Sample::Aorta, Sample::Aorta.default_triangles(), 0.889);
}

#[test]
fn the_reduced_coronary_arteries_have_them_too() {
    check_reduced(Sample::Coronary, 1_000_000, 0.356);
}
