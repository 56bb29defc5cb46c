//! Tubes along curves, to steer wires through.

use std::f64::consts::TAU;

use glam::DVec3;
use lumen_mesh::{TriMesh, Vec3};

/// A place on a curve: where, and its direction.
pub type Place = (DVec3, DVec3);

/// An open tube of `radius` mm around `curve`, its triangles looking out.
pub fn tube(curve: &[Place], radius: impl Fn(usize) -> f64, sides: usize) -> TriMesh {
    let mut across = curve[0].1.any_orthonormal_vector();
    let mut positions: Vec<Vec3> = Vec::new();
    for (i, &(centre, direction)) in curve.iter().enumerate() {
        across = across.reject_from(direction).normalize();
        let up = direction.cross(across);
        for side in 0..sides {
            let angle = (side as f64 + (i % 2) as f64 / 2.0) / sides as f64 * TAU;
            positions.push((centre + (across * angle.cos() + up * angle.sin()) * radius(i)).as_vec3());
        }
    }
    let at = |ring: usize, side: usize| (ring * sides + side % sides) as u32;
    let mut triangles = Vec::new();
    for ring in 0..curve.len() - 1 {
        for side in 0..sides {
            let (a, b, c, d) = (at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1));
            // Odd rings are turned by half a side.
            if ring % 2 == 0 {
                triangles.extend([[a, b, c], [b, d, c]]);
            } else {
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    TriMesh { positions, triangles }
}

/// A curve of straight parts and arcs in the xy plane, from the origin along x: each part is a length in mm and the
/// radius of the bend to the left, infinite for none. Places are `step` mm apart.
pub fn curve(parts: &[(f64, f64)], step: f64) -> Vec<Place> {
    let (mut at, mut heading) = (DVec3::ZERO, 0.0f64);
    let mut places = vec![(at, DVec3::X)];
    for &(length, bend) in parts {
        let count = (length / step).ceil() as usize;
        let h = length / count as f64;
        for _ in 0..count {
            // A step along a circle is a chord at the mean heading.
            let turn = h / bend;
            let middle = heading + turn / 2.0;
            let chord = if turn == 0.0 { h } else { 2.0 * bend * (turn / 2.0).sin() };
            at += DVec3::new(middle.cos(), middle.sin(), 0.0) * chord;
            heading += turn;
            places.push((at, DVec3::new(heading.cos(), heading.sin(), 0.0)));
        }
    }
    places
}
