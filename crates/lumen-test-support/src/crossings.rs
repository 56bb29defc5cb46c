//! Faces that pass through others, counted in a way of its own: slow, plain and exact, every pair of triangles whose
//! boxes share a cell of a grid.
//!
//! Two triangles cross when an edge of one passes through the inside of the other. Edges at a shared vertex are left
//! out, and so are triangles with a common edge. Touching counts for nothing. What decides are signs of determinants of
//! 32-bit coordinates, and those are exact: where f64 is in doubt the terms are summed without loss (Shewchuk, "Adaptive
//! precision floating-point arithmetic and fast robust geometric predicates", 1997).

use std::collections::HashMap;

use glam::DVec3;
use lumen_mesh::{TriMesh, Vec3};

/// Of a determinant above this part of the cube of the lengths in it f64 knows the sign.
const SURE: f64 = 1e-11;

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
    let mut does = vec![false; corners.len()];
    for list in cells.values() {
        for (i, &s) in list.iter().enumerate() {
            for &t in &list[i + 1..] {
                let (s, t) = (s as usize, t as usize);
                let is_known = does[s] && does[t];
                if !is_known && crosses(mesh.triangles[s], &corners[s], mesh.triangles[t], &corners[t]) {
                    (does[s], does[t]) = (true, true);
                }
            }
        }
    }
    does.into_iter().filter(|&does| does).count()
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

/// Whether two triangles cross, by their vertices and corners.
fn crosses(one: [u32; 3], p: &[DVec3; 3], other: [u32; 3], q: &[DVec3; 3]) -> bool {
    if one.iter().filter(|v| other.contains(v)).count() > 1 {
        return false;
    }
    let pierces = |edges: ([u32; 3], &[DVec3; 3]), face: ([u32; 3], &[DVec3; 3])| {
        (0..3).any(|i| {
            let j = (i + 1) % 3;
            !face.0.contains(&edges.0[i]) && !face.0.contains(&edges.0[j]) && through(edges.1[i], edges.1[j], face.1)
        })
    };
    pierces((one, p), (other, q)) || pierces((other, q), (one, p))
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

/// On which side of the plane through `b`, `c` and `d` the point `a` lies: the sign, or 0 in the plane. All coordinates fit
/// into f32.
fn side(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    let (x, y, z) = (b - a, c - a, d - a);
    let volume = x.dot(y.cross(z));
    let scale = x.length().max(y.length()).max(z.length());
    if volume.abs() > SURE * scale * scale * scale {
        return volume.signum();
    }
    let mut sum = ExactSum::default();
    for (sign, [u, v, w]) in [(1.0, [b, c, d]), (-1.0, [a, c, d]), (1.0, [a, b, d]), (-1.0, [a, b, c])] {
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            sum.add_product(sign * u[i], v[j], w[k]);
            sum.add_product(-sign * u[k], v[j], w[i]);
        }
    }
    sum.sign()
}

/// A sum without rounding: parts that do not overlap, ascending.
#[derive(Default)]
struct ExactSum(Vec<f64>);

impl ExactSum {
    /// Adds a product of three f32: that of two of them has no more bits than f64.
    fn add_product(&mut self, x: f64, y: f64, z: f64) {
        let product = x * y * z;
        self.add((x * y).mul_add(z, -product));
        self.add(product);
    }

    fn add(&mut self, term: f64) {
        let mut carry = term;
        for part in &mut self.0 {
            let sum = carry + *part;
            let of_part = sum - carry;
            *part = (carry - (sum - of_part)) + (*part - of_part);
            carry = sum;
        }
        self.0.push(carry);
    }

    /// The sign of the largest part that is not 0.
    fn sign(&self) -> f64 {
        self.0.iter().rev().find(|&&part| part != 0.0).map_or(0.0, |part| part.signum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_of_a_determinant_is_exact() {
        let p = |x: f32, y: f32, z: f32| Vec3::new(x, y, z).as_dvec3();
        let next = |x: f32| f32::from_bits(x.to_bits() + 1);
        // A plane aslant far from the origin, and a point in it, a last bit above and below.
        let [b, c, d] = [p(8192.0, 1.0, 0.0), p(8193.0, 3.0, 1.0), p(8192.5, 0.0, 7.0)];
        let at = |z: f32| side(p(8193.5, 2.0, z), b, c, d);
        assert_eq!(at(8.0), 0.0);
        assert_eq!(at(next(8.0)), -at(f32::from_bits(8.0f32.to_bits() - 1)));
        assert_ne!(at(next(8.0)), 0.0);
    }
}
