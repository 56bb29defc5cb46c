//! Which triangle is under the cursor: every triangle against one ray (Möller and Trumbore, "Fast, minimum storage
//! ray-triangle intersection", 1997).
//!
//! Brute force, in f64: a click is rare, and a tree would have to be rebuilt for every level of the progressive mesh.
//! Edges belong to both of their triangles, so a ray does not slip between two of them.

use glam::Vec3;

/// A half-line in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: Vec3,
    /// Where it goes; of length 1 for distances in mm.
    pub direction: Vec3,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the triangle.
    pub triangle: usize,
    /// Distance from the ray's origin, in lengths of its direction (mm for a unit direction).
    pub distance: f32,
}

/// The nearest triangle that `ray` meets, from either side; of equals, the first. Triangles without an area and with
/// an index beyond `positions` are never met.
pub fn pick(ray: &Ray, positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Hit> {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let at = |v: u32| positions.get(v as usize).map(|p| p.as_dvec3() - origin);
    let mut nearest: Option<(usize, f64)> = None;
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        let (Some(a), Some(b), Some(c)) = (at(a), at(b), at(c)) else { continue };
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(ac);
        let determinant = ab.dot(p);
        // Compared before the division: most triangles end here. The signs of both are those of the determinant.
        let sign = determinant.signum();
        let size = determinant.abs();
        let u = -a.dot(p) * sign;
        if !(u >= 0.0 && u <= size && size > 0.0) {
            continue;
        }
        let q = ab.cross(a);
        let v = direction.dot(q) * sign;
        if !(v >= 0.0 && u + v <= size) {
            continue;
        }
        let distance = ac.dot(q) / determinant;
        if distance >= 0.0 && nearest.is_none_or(|(_, least)| distance < least) {
            nearest = Some((t, distance));
        }
    }
    nearest.map(|(triangle, distance)| Hit { triangle, distance: distance as f32 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(z: f32) -> [Vec3; 4] {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, z))
    }

    fn down(x: f32, y: f32) -> Ray {
        Ray { origin: Vec3::new(x, y, 10.0), direction: Vec3::NEG_Z }
    }

    #[test]
    fn the_nearest_of_two_squares_is_met() {
        let positions = [square(0.0), square(4.0)].concat();
        let triangles = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]];
        assert_eq!(pick(&down(0.7, 0.2), &positions, &triangles), Some(Hit { triangle: 2, distance: 6.0 }));
        assert_eq!(pick(&down(0.2, 0.7), &positions, &triangles), Some(Hit { triangle: 3, distance: 6.0 }));
        assert_eq!(pick(&down(0.2, 0.7), &positions, &triangles[..2]), Some(Hit { triangle: 1, distance: 10.0 }));
    }

    #[test]
    fn the_diagonal_and_the_corners_belong_to_the_square_and_nothing_outside_does() {
        let (positions, triangles) = (square(0.0), [[0, 1, 2], [0, 2, 3]]);
        for (x, y) in [(0.5, 0.5), (0.3, 0.3), (0.0, 0.0), (1.0, 1.0), (1.0, 0.25)] {
            assert!(pick(&down(x, y), &positions, &triangles).is_some(), "{x} {y}");
        }
        for (x, y) in [(-0.01, 0.5), (1.01, 0.5), (0.5, -0.01), (0.5, 1.01)] {
            assert!(pick(&down(x, y), &positions, &triangles).is_none(), "{x} {y}");
        }
    }

    #[test]
    fn nothing_behind_the_origin_degenerate_or_out_of_range_is_met() {
        let positions = square(0.0);
        let up = Ray { origin: Vec3::new(0.5, 0.4, 10.0), direction: Vec3::Z };
        assert_eq!(pick(&up, &positions, &[[0, 1, 2]]), None);
        assert_eq!(pick(&down(0.5, 0.0), &positions, &[[0, 1, 1], [0, 1, 9]]), None);
        assert_eq!(pick(&down(0.5, 0.5), &[], &[]), None);
        let nowhere = Ray { origin: Vec3::NAN, direction: Vec3::NAN };
        assert_eq!(pick(&nowhere, &positions, &[[0, 1, 2]]), None);
    }
}
