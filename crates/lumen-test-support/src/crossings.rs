//! Faces that pass through others, counted in a way of its own: slow and plain, in f64, every pair of triangles whose
//! boxes share a cell of a grid.
//!
//! Two triangles cross when an edge of one passes through the inside of the other. Edges at a shared vertex are left
//! out, and so are triangles with a common edge. Touching counts for nothing.

use std::collections::HashMap;

use glam::DVec3;
use lumen_mesh::{TriMesh, Vec3};

/// A determinant below this part of the cube of the lengths in it has no sign.
const FLAT: f64 = 1e-11;

/// How many faces of `mesh` cross another.
pub fn crossing_faces(mesh: &TriMesh) -> usize {
    let corners: Vec<[DVec3; 3]> = (0..mesh.triangles.len()).map(|t| mesh.corners(t).map(Vec3::as_dvec3)).collect();
    let cell = cell(&corners);
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for (t, triangle) in (0..).zip(&corners) {
        let (low, high) = cell_range(triangle, cell);
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    cells.entry([x, y, z]).or_default().push(t);
                }
            }
        }
    }
    let mut crosses = vec![false; corners.len()];
    for list in cells.values() {
        for (i, &s) in list.iter().enumerate() {
            for &t in &list[i + 1..] {
                let (s, t) = (s as usize, t as usize);
                if !(crosses[s] && crosses[t]) && cross(mesh, &corners, s, t) {
                    (crosses[s], crosses[t]) = (true, true);
                }
            }
        }
    }
    crosses.into_iter().filter(|&crosses| crosses).count()
}

/// Side of the grid's cells: that of a triangle's box on average.
fn cell(corners: &[[DVec3; 3]]) -> f64 {
    let size = |[a, b, c]: &[DVec3; 3]| (a.max(*b).max(*c) - a.min(*b).min(*c)).max_element();
    (corners.iter().map(size).sum::<f64>() / corners.len().max(1) as f64).max(1e-9)
}

fn cell_range([a, b, c]: &[DVec3; 3], cell: f64) -> ([i64; 3], [i64; 3]) {
    let place = |p: DVec3| (p / cell).floor().to_array().map(|x| x as i64);
    (place(a.min(*b).min(*c)), place(a.max(*b).max(*c)))
}

fn cross(mesh: &TriMesh, corners: &[[DVec3; 3]], s: usize, t: usize) -> bool {
    let (one, other) = (mesh.triangles[s], mesh.triangles[t]);
    if one.iter().filter(|v| other.contains(v)).count() > 1 {
        return false;
    }
    let pierces = |edges: ([u32; 3], &[DVec3; 3]), face: ([u32; 3], &[DVec3; 3])| {
        (0..3).any(|i| {
            let j = (i + 1) % 3;
            !face.0.contains(&edges.0[i]) && !face.0.contains(&edges.0[j]) && through(edges.1[i], edges.1[j], face.1)
        })
    };
    pierces((one, &corners[s]), (other, &corners[t])) || pierces((other, &corners[t]), (one, &corners[s]))
}

/// Whether the segment from `p` to `q` passes through the inside of a triangle.
fn through(p: DVec3, q: DVec3, &[a, b, c]: &[DVec3; 3]) -> bool {
    let (above, below) = (side(p, a, b, c), side(q, a, b, c));
    if above * below >= 0.0 {
        return false;
    }
    let around = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
    around.iter().all(|&s| s > 0.0) || around.iter().all(|&s| s < 0.0)
}

/// On which side of the plane through `b`, `c` and `d` the point `a` lies: the sign, or 0 where it is too close to
/// call.
fn side(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    let (x, y, z) = (b - a, c - a, d - a);
    let volume = x.dot(y.cross(z));
    let scale = x.length().max(y.length()).max(z.length());
    if volume.abs() <= FLAT * scale * scale * scale { 0.0 } else { volume.signum() }
}
