//! Trees of surfaces whose centrelines are known.

use glam::{DVec3, Vec3};

use super::*;
use lumen_mesh::TriMesh;
use lumen_mesh::shapes::{fork, icosphere, square, tube};

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
    assert_eq!(says(&one), "the surface has no inside: of its 1 triangles none faces another");
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
