use lumen_mesh::shapes::{icosphere, joined, tube};

use super::*;
use crate::folds::tests::folded_box;

fn faults(mesh: TriMesh) -> Vec<Fault> {
    check(&Patched::wall(mesh)).findings.into_iter().map(|finding| finding.fault).collect()
}

#[test]
fn a_sphere_is_ready_and_its_volume_is_that_of_its_polyhedron() {
    let fate = check(&Patched::wall(icosphere(4, 10.0, Vec3::ONE)));
    assert!(fate.is_ready() && fate.findings.is_empty());
    // The inscribed polyhedron lacks less than a hundredth.
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 1000.0;
    assert!((0.99 * ball..ball).contains(&fate.volume_mm3.unwrap()));
}

#[test]
fn an_open_tube_has_two_rims_at_its_ends() {
    let fate = check(&Patched::wall(tube(16, 10, 12.0, |_| 2.0)));
    assert_eq!(fate.findings.len(), 1);
    assert_eq!(fate.findings[0].fault, Fault::OpenRims { count: 2 });
    let mut heights: Vec<f64> = fate.findings[0].places.iter().map(|place| place[2]).collect();
    heights.sort_by(f64::total_cmp);
    assert_eq!(heights, [0.0, 12.0]);
    assert!(!fate.is_ready() && fate.volume_mm3.is_none());
}

#[test]
fn crossing_spheres_are_two_pieces_that_cross_near_their_common_circle() {
    let both = joined(&[icosphere(3, 5.0, Vec3::ZERO), icosphere(3, 5.0, Vec3::new(8.0, 0.3, 0.2))]);
    let fate = check(&Patched::wall(both));
    assert!(matches!(
        fate.findings[..],
        [Finding { fault: Fault::Crossing { .. }, .. }, Finding { fault: Fault::Pieces { count: 2 }, .. }]
    ));
    assert!(fate.findings[0].places.iter().all(|place| (place[0] - 4.0).abs() < 1.0));
    assert!(!fate.is_ready());
}

#[test]
fn a_fold_crosses_nothing_and_stops_a_mesher_at_its_place() {
    let mesh = folded_box();
    let [one, other] = folds(&mesh)[0].map(|t| middle(&mesh.corners(t as usize)));
    let fate = check(&Patched::wall(mesh));
    assert_eq!(fate.findings[0].fault, Fault::Folds { count: 3 });
    assert!(!fate.is_ready());
    assert!(one.distance(DVec3::from_array(fate.findings[0].places[0])) < one.distance(other) + 1e-3);
}

/// TetGen 1.6 (`-pY`) refuses a wall whose edge lies in the plane of a cap, or above it, and fills it where it lies below.
#[test]
fn a_wall_that_touches_a_cap_stops_a_mesher_though_nothing_crosses() {
    for (height, is_refused) in [(0.0, true), (0.1, true), (-1e-6, false), (-0.1, false)] {
        let places = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, -3), (3, 3, -3)];
        let mut positions = places.map(|(x, y, z)| Vec3::new(x as f32, y as f32, z as f32)).to_vec();
        positions[1].z = height;
        // A cap of two triangles, and two pyramids below it with the cap's other diagonal as their common edge.
        let triangles = vec![[0, 1, 2], [0, 2, 3], [1, 0, 4], [0, 3, 4], [3, 1, 4], [3, 2, 5], [2, 1, 5], [1, 3, 5]];
        let found = faults(TriMesh { positions, triangles });
        assert_eq!(found.iter().any(Fault::stops), is_refused, "{height}: {found:?}");
        assert_eq!(found.contains(&Fault::Crossing { count: 4 }), is_refused, "{height}: {found:?}");
    }
}

#[test]
fn a_turned_triangle_disagrees_with_three_neighbours() {
    let mut mesh = icosphere(3, 5.0, Vec3::ZERO);
    mesh.triangles[7].swap(0, 1);
    assert_eq!(faults(mesh), [Fault::Windings { count: 3 }]);
}

#[test]
fn a_sphere_turned_over_faces_inwards() {
    let mut mesh = icosphere(3, 5.0, Vec3::ZERO);
    mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let fate = check(&Patched::wall(mesh));
    assert_eq!(fate.findings[0].fault, Fault::InsideOut { count: 1 });
    assert!(fate.volume_mm3.unwrap() < 0.0);
}

#[test]
fn a_triangle_there_twice_makes_its_edges_shared() {
    let mut mesh = icosphere(3, 5.0, Vec3::ZERO);
    mesh.triangles.push(mesh.triangles[9]);
    let found = faults(mesh);
    assert!(found.contains(&Fault::Duplicates { count: 1 }));
    assert!(found.contains(&Fault::SharedEdges { count: 3 }));
}

#[test]
fn a_triangle_that_repeats_a_vertex_or_lies_on_a_line_is_degenerate() {
    let mut mesh = icosphere(3, 5.0, Vec3::ZERO);
    mesh.triangles.push([4, 4, 5]);
    assert_eq!(faults(mesh), [Fault::Degenerate { count: 1 }]);
    let line = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 3.0], triangles: vec![[0, 1, 2]] };
    assert!(faults(line).contains(&Fault::Degenerate { count: 1 }));
}

#[test]
fn the_angle_of_a_sliver_is_that_of_its_sides() {
    // A long triangle: its least angle is atan(0.1 / 10).
    let sliver = vec![Vec3::ZERO, Vec3::X * 10.0, Vec3::new(10.0, 0.1, 0.0)];
    let found = faults(TriMesh { positions: sliver, triangles: vec![[0, 1, 2]] });
    let Some(Fault::Slivers { count: 1, least_degrees }) = found.last() else { panic!("{found:?}") };
    assert!((least_degrees - libm::atan(0.01).to_degrees()).abs() < 1e-6);
}

#[test]
fn vertices_at_one_place_are_told() {
    // Two tetrahedra that touch in a point which either has for itself.
    let tetrahedron = |sign: f32| {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|p| p * sign).to_vec();
        TriMesh { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] }
    };
    let mut other = tetrahedron(-1.0);
    other.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let found = faults(joined(&[tetrahedron(1.0), other]));
    assert!(found.contains(&Fault::Coincident { count: 1 }), "{found:?}");
}

#[test]
fn broken_numbers_end_the_look_without_a_panic() {
    let mut mesh = icosphere(1, 5.0, Vec3::ZERO);
    mesh.positions[0].x = f32::NAN;
    assert_eq!(faults(mesh.clone()), [Fault::Broken { count: 1 }]);
    mesh.triangles[3] = [0, 1, 4000];
    assert_eq!(faults(mesh), [Fault::Broken { count: 2 }]);
    assert_eq!(faults(TriMesh::default()), [Fault::Empty]);
    let mut patched = Patched::wall(icosphere(1, 5.0, Vec3::ZERO));
    patched.of_triangle[2] = 9;
    assert!(!check(&patched).is_ready());
}
