//! Trees of surfaces whose centrelines are known.

use glam::{DVec3, Vec3};

use super::*;
use lumen_mesh::TriMesh;
use lumen_mesh::shapes::{fork, icosphere, in_capsule, isosurface, square, tube};

fn near(found: f64, expected: f64, part: f64) {
    assert!((found - expected).abs() <= part * expected.abs(), "{found}, not {expected} to {part}");
}

#[test]
fn a_bent_tube_is_as_long_as_its_arc() {
    // A straight tube of the arc's length, bent to a half circle of 20 mm.
    let mut mesh = tube(48, 160, (20.0 * std::f64::consts::PI) as f32, |_| 2.0);
    for p in &mut mesh.positions {
        let (sin, cos) = libm::sincos(f64::from(p.z) / 20.0);
        let out = 20.0 + f64::from(p.x);
        *p = DVec3::new(out * cos, out * sin, -f64::from(p.y)).as_vec3();
    }
    let tree = Tree::new(&mesh).unwrap();
    assert_eq!(tree.branches().len(), 1);
    let branch = &tree.branches()[0];
    near(branch.length_mm(), 20.0 * std::f64::consts::PI, 0.01);
    for place in &branch.points {
        near(place.at.length(), 20.0, 0.01);
        near(place.radius, 2.0, 0.03);
    }
}

#[test]
fn what_is_no_vessel_is_refused_with_a_sentence() {
    let says = |mesh: &TriMesh| Tree::new(mesh).map(|tree| tree.branches().len()).unwrap_err().to_string();
    assert_eq!(says(&TriMesh::default()), "the surface has no triangles");
    let one = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
    assert_eq!(says(&one), "the surface has no inside: it is a single triangle");
    assert!(says(&square(6, 10.0, 0.0)).starts_with("the surface has no inside"));
    let mut turned = icosphere(3, 5.0, Vec3::ZERO);
    turned.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    assert!(says(&turned).starts_with("the surface is inside out"));
}

#[test]
fn the_tree_does_not_depend_on_threads() {
    let (mesh, _) = fork();
    let of = |threads| lumen_mesh::parallel::with_threads(threads, || Tree::new(&mesh).unwrap().branches().to_vec());
    assert_eq!(of(1), of(3));
}

/// The surface around some vessels: the ends of each and its radius.
fn vessels(all: &[(DVec3, DVec3, f64)]) -> TriMesh {
    let far = DVec3::new(26.0, 16.0, 6.0);
    isosurface(-far, far, 0.4, |p| {
        all.iter().map(|&(start, end, radius)| in_capsule(p, start, end, radius)).fold(f64::NEG_INFINITY, f64::max)
    })
}

#[test]
fn a_closed_branch_is_two_of_its_diameters_long() {
    let trunk = (DVec3::new(-20.0, 0.0, 0.0), DVec3::new(20.0, 0.0, 0.0), 3.0);
    // A side branch of 2 mm across, so long out of the trunk with the cap at its tip.
    for (out, branches, bumps) in [(2.0, 1, 1), (3.0, 1, 1), (5.0, 3, 0), (9.0, 3, 0)] {
        let side = (DVec3::ZERO, DVec3::new(0.0, 3.0 + out - 1.0, 0.0), 1.0);
        let tree = Tree::new(&vessels(&[trunk, side])).unwrap();
        assert_eq!((tree.branches().len(), tree.bumps), (branches, bumps), "{out} mm out");
    }
}

#[test]
fn the_corners_of_flat_caps_are_no_branches() {
    let box_of = DVec3::new(20.0, 4.0, 4.0);
    let mesh = isosurface(-box_of * 1.2, box_of * 1.2, 0.4, |p| (box_of - p.abs()).min_element());
    assert_eq!(Tree::new(&mesh).unwrap().branches().len(), 1);
}

/// A wall that drapes over what runs beside the vessel leaves a wedge at its side, which tapers to an edge.
#[test]
fn a_wedge_at_the_side_of_a_vessel_is_no_tree() {
    let wedge = |p: DVec3| (0.2 * (15.0 - p.x) - p.y.abs()).min(9.0 - p.z.abs()).min(p.x);
    let vessel = |p: DVec3| (5.0 - p.truncate().length()).min(30.0 - p.z.abs());
    let inside = |p: DVec3| wedge(p).max(vessel(p));
    let mesh = isosurface(DVec3::new(-7.0, -7.0, -32.0), DVec3::new(17.0, 7.0, 32.0), 0.5, inside);
    let tree = Tree::new(&mesh).unwrap();
    assert_eq!(tree.branches().len(), 1, "{:?}", tree.branches().iter().map(Branch::length_mm).collect::<Vec<_>>());
}

#[test]
fn a_short_bridge_between_two_vessels_is_a_branch() {
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let ring = [
        (corner(-20.0, -4.0), corner(20.0, -4.0), 1.5),
        (corner(-20.0, 4.0), corner(20.0, 4.0), 1.5),
        (corner(-20.0, -4.0), corner(-20.0, 4.0), 1.5),
    ];
    let has_bridge = |mesh: &TriMesh| {
        let tree = Tree::new(mesh).unwrap();
        let is_on_it = |place: &Place| place.at.y.abs() < 1.0 && place.at.x.abs() < 1.0;
        tree.branches().iter().any(|branch| branch.points.iter().any(is_on_it))
    };
    assert!(!has_bridge(&vessels(&ring)));
    // 5 mm long between the two lumens and 2 mm across: each half by itself is too short.
    let bridge = (corner(0.0, -4.0), corner(0.0, 4.0), 1.0);
    assert!(has_bridge(&vessels(&[&ring[..], &[bridge]].concat())));
}

#[test]
fn open_ends_without_a_branch_are_counted() {
    let open = Tree::new(&tube(48, 80, 40.0, |_| 2.0)).unwrap();
    assert_eq!((open.branches().len(), open.openings_without_branch()), (1, 0));
    assert_eq!(open.branches()[0].ends, [End::Open; 2]);
    // A window in the wall of a closed vessel: no branch leads there.
    let trunk = (DVec3::new(-20.0, 0.0, 0.0), DVec3::new(20.0, 0.0, 0.0), 3.0);
    let mut mesh = vessels(&[trunk]);
    let is_window = |mesh: &TriMesh, t: usize| {
        let middle = mesh.corners(t).iter().sum::<Vec3>() / 3.0;
        middle.y > 2.0 && middle.x.abs() < 1.5
    };
    let kept = (0..mesh.triangles.len()).filter(|&t| !is_window(&mesh, t)).map(|t| mesh.triangles[t]).collect();
    mesh.triangles = kept;
    let tree = Tree::new(&mesh).unwrap();
    assert_eq!((tree.branches().len(), tree.openings_without_branch()), (1, 1));
}

/// Flat at both ends.
fn in_cylinder(p: DVec3, start: DVec3, end: DVec3, radius: f64) -> f64 {
    let axis = (end - start).normalize();
    let along = (p - start).dot(axis);
    let across = (p - start).reject_from_normalized(axis).length();
    (radius - across).min(along).min(start.distance(end) - along)
}

/// A vessel along z of 6 mm across and 60 mm long, with thin branches to the side: how high each is, its radius, and how far
/// from the axis it reaches.
fn with_thin_branches(all: &[[f64; 3]]) -> TriMesh {
    isosurface(DVec3::new(-4.0, -4.0, -1.0), DVec3::new(24.0, 4.0, 61.0), 0.4, |p| {
        let branch =
            |&[z, radius, reach]: &[f64; 3]| in_cylinder(p, DVec3::new(0.0, 0.0, z), DVec3::new(reach, 0.0, z), radius);
        all.iter().map(branch).fold(in_cylinder(p, DVec3::ZERO, DVec3::Z * 60.0, 3.0), f64::max)
    })
}

/// The radii of the vessels at the free ends of a tree, the widest first.
fn widths_at_ends(mesh: &TriMesh) -> Vec<f64> {
    let tree = Tree::new(mesh).unwrap();
    let widest_near = |places: &[Place], tip: Place| {
        let near = places.iter().filter(|place| place.at.distance(tip.at) < 2.0 * tip.radius);
        near.map(|place| place.radius).fold(0.0, f64::max)
    };
    let mut widths = Vec::new();
    for branch in tree.branches() {
        let tips = [branch.points[0], branch.points[branch.points.len() - 1]];
        let free = tips.into_iter().zip(branch.ends).filter(|(_, end)| *end != End::Joint);
        widths.extend(free.map(|(tip, _)| widest_near(&branch.points, tip)));
    }
    widths.sort_by(|a, b| b.total_cmp(a));
    widths
}

#[test]
fn a_thin_branch_near_the_end_of_a_closed_vessel_leaves_its_end_in_the_tree() {
    // In the cap, a radius from it, and up to less than two diameters.
    for z in [2.0, 4.0, 8.0, 12.0] {
        let widths = widths_at_ends(&with_thin_branches(&[[z, 1.0, 22.0]]));
        assert_eq!(widths.len(), 3, "{z} mm: {widths:?}");
        assert!(widths[1] > 2.7 && widths[2] < 1.2, "{z} mm: {widths:?}");
    }
}

#[test]
fn thin_branches_near_both_ends_of_a_closed_vessel_leave_both_in_the_tree() {
    let widths = widths_at_ends(&with_thin_branches(&[[3.0, 0.8, 12.0], [57.0, 0.8, 12.0]]));
    assert_eq!(widths.len(), 4, "{widths:?}");
    assert!(widths[1] > 2.7 && widths[2] < 1.2, "{widths:?}");
}

#[test]
fn a_sac_that_is_wider_than_its_vessel_is_no_end_of_it() {
    let sac = |p: DVec3| 8.0 - p.distance(DVec3::Y * 8.0);
    let vessel = |p: DVec3| in_cylinder(p, DVec3::X * -24.0, DVec3::X * 24.0, 2.0);
    let mesh = isosurface(DVec3::new(-25.0, -4.0, -9.0), DVec3::new(25.0, 19.0, 9.0), 0.5, |p| sac(p).max(vessel(p)));
    let widths = widths_at_ends(&mesh);
    assert!(widths.len() == 2 && widths[0] < 2.2, "{widths:?}");
}
