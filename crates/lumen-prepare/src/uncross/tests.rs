use glam::Vec3;

use lumen_mesh::shapes::{icosphere, joined, tube, vertices_are_manifold};
use lumen_mesh::{self_intersections, volume};

use super::*;
use crate::folds::folds;
use crate::folds::tests::folded_box;

/// Numbers between -1 and 1 that look like none.
fn noise(i: usize) -> f32 {
    let wild = (i as f32 * 12.9898 + 1.0).rem_euclid(7.31) * 43.758;
    wild.rem_euclid(2.0) - 1.0
}

/// Two tubes of 2 mm that pass each other at a right angle, whose walls overlap by `overlap` mm, with noise of 0.002 mm.
fn two_tubes(overlap: f32) -> TriMesh {
    let mut other = tube(48, 60, 20.0, |_| 2.0);
    other.positions.iter_mut().for_each(|p| *p = Vec3::new(p.x + 4.0 - overlap, p.z - 10.0, 10.0 - p.y));
    let mut both = joined(&[tube(48, 60, 20.0, |_| 2.0), other]);
    for (i, p) in both.positions.iter_mut().enumerate() {
        *p += Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)) * 0.002;
    }
    both
}

/// A sphere of 5 mm with a vertex pulled through the opposite wall.
fn spiked() -> TriMesh {
    let mut mesh = icosphere(4, 5.0, Vec3::ZERO);
    mesh.positions[0] *= -1.3;
    mesh
}

/// A sphere of 5 mm with a vertex pushed along the wall and a little off it, beyond its neighbours: triangles turn over.
fn folded() -> TriMesh {
    let mut mesh = icosphere(4, 5.0, Vec3::ZERO);
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let v = 300;
    let beside = mesh.positions[topology.neighbours(v)[0] as usize];
    let own = mesh.positions[v as usize];
    let beyond = own + (beside - own) * 2.2;
    mesh.positions[v as usize] = beyond.normalize() * 5.02;
    mesh
}

/// Vertices that `uncross` has to leave alone: more than two edges from every triangle that crosses, and from every vertex
/// that `is_wrong`.
fn far_vertices(mesh: &TriMesh, is_wrong: impl Fn(Vec3) -> bool) -> Vec<bool> {
    let mut is_near = vec![false; mesh.positions.len()];
    let crossing = self_intersections(mesh);
    crossing.iter().flat_map(|&t| mesh.triangles[t as usize]).for_each(|v| is_near[v as usize] = true);
    is_near.iter_mut().zip(&mesh.positions).for_each(|(near, &p)| *near |= is_wrong(p));
    for _ in 0..2 {
        let before = is_near.clone();
        for t in mesh.triangles.iter().filter(|t| t.iter().any(|&v| before[v as usize])) {
            t.iter().for_each(|&v| is_near[v as usize] = true);
        }
    }
    is_near.into_iter().map(|near| !near).collect()
}

/// The corners of triangles, by their bits, ascending.
fn bits(mesh: &TriMesh, keep: impl Fn(&[u32; 3]) -> bool) -> Vec<[[u32; 3]; 3]> {
    let kept = mesh.triangles.iter().filter(|t| keep(t));
    let mut all: Vec<_> = kept.map(|t| t.map(|v| mesh.positions[v as usize].to_array().map(f32::to_bits))).collect();
    all.sort_unstable();
    all
}

/// Asserts that nothing crosses any more, that the surface is as closed as it was, and that what was far is as it was.
fn assert_mended(mesh: &TriMesh, found: &Uncrossed, is_wrong: impl Fn(Vec3) -> bool) {
    assert!(found.crossing_before > 0);
    assert_eq!(found.crossing_after, 0, "{:?}", found.places);
    assert!(self_intersections(&found.mesh).is_empty());
    let edges = |mesh: &TriMesh| {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let counts = topology.edge_counts();
        assert!(vertices_are_manifold(mesh, &topology));
        (counts.boundary, counts.non_manifold, counts.flipped)
    };
    assert_eq!(edges(&found.mesh), edges(mesh));
    let far = far_vertices(mesh, is_wrong);
    let untouched = bits(mesh, |t| t.iter().all(|&v| far[v as usize]));
    assert!(!untouched.is_empty());
    let now = bits(&found.mesh, |_| true);
    assert!(untouched.iter().all(|t| now.binary_search(t).is_ok()));
    assert_eq!(found.triangle_of.len(), found.mesh.triangles.len());
    let own = (0..).zip(&found.triangle_of).filter(|&(t, &of)| found.mesh.corners(t) == mesh.corners(of as usize));
    assert!(own.count() >= untouched.len(), "what stayed is said to be itself");
}

#[test]
fn a_fold_that_crosses_nothing_is_laid_flat_and_the_wall_stays_where_it_is() {
    let mesh = folded_box();
    let found = uncross(&mesh).unwrap();
    assert_eq!((found.crossing_before, found.crossing_after), (4, 0));
    assert!(folds(&found.mesh).is_empty() && self_intersections(&found.mesh).is_empty());
    assert_eq!((found.places.len(), found.places[0].remedy), (1, Remedy::PushedApart));
    // Within a hundredth of the radius.
    assert!(found.mesh.positions.iter().all(|p| (p.abs().max_element() - 5.0).abs() < 0.05));
}

fn in_either_tube(p: Vec3, overlap: f32) -> bool {
    // A vertex of one wall is within the other alone where they overlap.
    libm::hypotf(p.x, p.y) < 1.995 || libm::hypotf(p.x + overlap - 4.0, p.z - 10.0) < 1.995
}

#[test]
fn walls_that_overlap_a_little_are_pushed_apart() {
    let mesh = two_tubes(0.02);
    let found = uncross(&mesh).unwrap();
    assert_mended(&mesh, &found, |p| in_either_tube(p, 0.02));
    assert!(found.places.iter().all(|place| place.remedy == Remedy::PushedApart), "{:?}", found.places);
    // A hundredth of the radius, which the ball measures from facets to a few percent.
    assert!(found.places.iter().all(|place| place.moved_mm > 0.0 && place.moved_mm < 0.021), "{:?}", found.places);
    assert_eq!(found.mesh.triangles, mesh.triangles);
    assert!(found.places.iter().all(|place| (place.centre[0] - 1.99).abs() < 0.1));
}

#[test]
fn walls_that_overlap_much_part() {
    let spheres = joined(&[icosphere(4, 5.0, Vec3::ZERO), icosphere(4, 5.0, Vec3::new(9.0, 0.3, 0.2))]);
    let found = uncross(&spheres).unwrap();
    let other = Vec3::new(9.0, 0.3, 0.2);
    assert_mended(&spheres, &found, |p| p.length() < 4.999 || p.distance(other) < 4.999);
    let topology = Topology::new(found.mesh.positions.len(), &found.mesh.triangles);
    assert_eq!(lumen_mesh::components(found.mesh.positions.len(), &found.mesh.triangles).count(), 2);
    assert!(found.places.iter().all(|place| place.moved_mm > 0.4 && place.moved_mm < 2.0), "{:?}", found.places);
    // Each lost a cap at least as deep as the overlap's half, 0.5 mm, and at most three times that.
    let cap = |depth: f64| std::f64::consts::PI * depth * depth * (15.0 - depth) / 3.0;
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 125.0;
    let lost = 2.0 * ball - volume(&found.mesh, &topology);
    assert!((2.0 * cap(0.4)..2.0 * cap(1.5) + 0.02 * ball).contains(&lost), "{lost}");
}

#[test]
fn a_vertex_pulled_through_the_opposite_wall_is_cut_out() {
    let mesh = spiked();
    let found = uncross(&mesh).unwrap();
    assert_mended(&mesh, &found, |_| false);
    assert_eq!(found.places.len(), 1);
    assert_eq!(found.places[0].remedy, Remedy::Recut);
    // The tip stood 1.5 mm before the wall.
    assert!((1.2..2.0).contains(&found.places[0].moved_mm), "{}", found.places[0].moved_mm);
    let topology = Topology::new(found.mesh.positions.len(), &found.mesh.triangles);
    let sphere = icosphere(4, 5.0, Vec3::ZERO);
    let whole = volume(&sphere, &Topology::new(sphere.positions.len(), &sphere.triangles));
    assert!((volume(&found.mesh, &topology) / whole - 1.0).abs() < 0.01);
}

#[test]
fn a_fold_is_laid_flat_where_it_is() {
    let mesh = folded();
    let found = uncross(&mesh).unwrap();
    assert_mended(&mesh, &found, |_| false);
    assert!(found.mesh.positions.iter().all(|p| (4.9..5.02).contains(&p.length())));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for mesh in [two_tubes(0.02), spiked(), folded()] {
        let alone = lumen_mesh::parallel::with_threads(1, || uncross(&mesh));
        assert_eq!(lumen_mesh::parallel::with_threads(3, || uncross(&mesh)), alone);
    }
}

#[test]
fn walls_far_through_each_other_are_not_dragged_along() {
    // Half of either sphere is in the other: no patch or membrane within half a radius parts them.
    let mesh = joined(&[icosphere(3, 5.0, Vec3::ZERO), icosphere(3, 5.0, Vec3::new(2.0, 0.3, 0.2))]);
    let found = uncross(&mesh).unwrap();
    assert!(found.places.iter().all(|place| place.remedy != Remedy::PushedApart || place.moved_mm <= 2.6));
    assert!(found.crossing_after <= found.crossing_before);
}

#[test]
fn a_surface_without_crossings_keeps_every_bit() {
    let mesh = icosphere(3, 5.0, Vec3::ONE);
    let found = uncross(&mesh).unwrap();
    assert_eq!((&found.mesh, found.places.len(), found.crossing_before), (&mesh, 0, 0));
    assert_eq!(uncross(&TriMesh::default()).unwrap().mesh, TriMesh::default());
}

#[test]
fn a_place_without_a_remedy_is_told_and_stays() {
    // Two open squares that cross in the middle, each of two triangles: there is no wall to fill a hole in.
    let square = |turned: bool| {
        let at = |x: f32, y: f32| if turned { Vec3::new(0.1 + 0.1 * x, x, y) } else { Vec3::new(x, 0.2 * y, y) };
        let positions = vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
        TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] }
    };
    let mesh = joined(&[square(false), square(true)]);
    let found = uncross(&mesh).unwrap();
    assert_eq!((&found.mesh, found.crossing_after), (&mesh, found.crossing_before));
    assert!(found.places.iter().all(|place| place.remedy == Remedy::Failed) && !found.places.is_empty());
}

#[test]
fn what_is_no_surface_is_refused() {
    let mut mesh = spiked();
    mesh.triangles[7] = [0, 1, 9_000_000];
    assert!(matches!(uncross(&mesh), Err(SurfaceError::MissingVertex { triangle: 7 })));
    mesh.triangles[7] = [5, 1, 5];
    assert_eq!(uncross(&mesh), Err(SurfaceError::RepeatedVertex { triangle: 7 }));
    mesh.positions[2].z = f32::INFINITY;
    assert_eq!(uncross(&mesh), Err(SurfaceError::NotFinite { vertex: 2 }));
}

#[test]
fn surfaces_that_are_nothing_but_crossings_end() {
    // A soup over few vertices, windings at random; and coordinates near the end of f32.
    for scale in [1.0, 1e30] {
        let positions = (0..60).map(|i| Vec3::new(noise(i), noise(i + 100), noise(i + 200)) * scale).collect();
        let corner = |i: u32| (i * 7919 + i * i * 31) % 60;
        let triangles = (0..200).map(|i| [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)]);
        let triangles = triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let soup = TriMesh { positions, triangles };
        // Alone, and through the wall of a sphere.
        for mesh in [soup.clone(), joined(&[icosphere(3, 0.8 * scale, Vec3::ZERO), soup])] {
            let found = uncross(&mesh).unwrap();
            assert!(found.crossing_after <= found.crossing_before);
            assert!(!found.mesh.triangles.is_empty(), "nothing that large disappears");
            assert!(found.mesh.positions.iter().all(|p| p.is_finite()));
        }
    }
}
