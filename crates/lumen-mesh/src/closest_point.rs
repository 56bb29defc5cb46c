//! The point of a triangle that is closest to a given point.
//!
//! Ericson, "Real-time collision detection" (2005), section 5.1.5: the Voronoi region of the triangle in which the query
//! lies (a corner, an edge or the face) is found from six dot products, and the closest point is a combination
//! `a + v (b - a) + w (c - a)`. The arithmetic is f64 on the exact differences of f32 coordinates.
//!
//! The face's `v` and `w` are quotients by the squared doubled area, so their error grows with the inverse square of
//! the smallest angle. A sliver therefore goes another way: the least over its three edges and, where the projection
//! falls inside, its face, with edge functions whose error grows with the inverse alone. A triangle of no area is its
//! edges. Either way the answer is a point of the triangle: an error never makes the distance too small.

use glam::{DVec3, Vec3};

/// A triangle is a sliver when its doubled area is below this times its longest edge squared.
const SLIVER: f64 = 1e-3;
/// Below this times its longest edge squared a triangle has no face to speak of.
const NO_FACE: f64 = 1e-10;

/// Where on a triangle the closest point lies: at `a + v (b - a) + w (c - a)`. On a side or at a corner `v` is 0, `w` is 0, or
/// `v` is `1 - w`, to the bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleProjection {
    /// Squared distance in mm2.
    pub squared: f64,
    /// Barycentric coordinate of the second corner.
    pub v: f64,
    /// Barycentric coordinate of the third corner.
    pub w: f64,
}

impl TriangleProjection {
    fn at(ap: DVec3, ab: DVec3, ac: DVec3, v: f64, w: f64) -> Self {
        Self { squared: (ap - ab * v - ac * w).length_squared(), v, w }
    }
}

/// Distance of `p` from a triangle in mm.
pub fn distance_to_triangle(p: Vec3, corners: [Vec3; 3]) -> f64 {
    let projection =
        if is_sliver(corners) { closest_point_on_sliver(p, corners) } else { closest_point_on_triangle(p, corners) };
    projection.squared.sqrt()
}

/// Whether the triangle needs [`closest_point_on_sliver`].
pub(super) fn is_sliver(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    !is_wider(b - a, c - a, SLIVER)
}

/// The closest point of a triangle that is no sliver.
#[inline]
pub fn closest_point_on_triangle(p: impl Into<DVec3>, corners: [Vec3; 3]) -> TriangleProjection {
    let a = corners[0].as_dvec3();
    let (ap, ab, ac) = (p.into() - a, corners[1].as_dvec3() - a, corners[2].as_dvec3() - a);
    let (v, w) = region(ap, ab, ac);
    TriangleProjection::at(ap, ab, ac, v, w)
}

/// `v` and `w` by the region in which the query lies; the names are Ericson's.
#[inline]
fn region(ap: DVec3, ab: DVec3, ac: DVec3) -> (f64, f64) {
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (0.0, 0.0);
    }
    let bp = ap - ab;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (1.0, 0.0);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (d1 / (d1 - d3), 0.0);
    }
    let cp = ap - ac;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (0.0, 1.0);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (0.0, d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    let (to_c, to_b) = (d4 - d3, d5 - d6);
    if va <= 0.0 && to_c >= 0.0 && to_b >= 0.0 {
        let w = to_c / (to_c + to_b);
        return (1.0 - w, w);
    }
    let scale = 1.0 / (va + vb + vc);
    (vb * scale, vc * scale)
}

/// The closest point of any triangle, however thin, down to a single point.
#[cold]
pub(super) fn closest_point_on_sliver(p: impl Into<DVec3>, corners: [Vec3; 3]) -> TriangleProjection {
    let a = corners[0].as_dvec3();
    let (ap, ab, ac) = (p.into() - a, corners[1].as_dvec3() - a, corners[2].as_dvec3() - a);
    let t = along(ap - ab, ac - ab);
    let mut best = TriangleProjection::at(ap, ab, ac, along(ap, ab), 0.0);
    let mut consider = |v: f64, w: f64| {
        let projection = TriangleProjection::at(ap, ab, ac, v, w);
        if projection.squared < best.squared {
            best = projection;
        }
    };
    consider(0.0, along(ap, ac));
    consider(1.0 - t, t);
    if is_wider(ab, ac, NO_FACE) {
        let normal = ab.cross(ac);
        let scale = 1.0 / normal.length_squared();
        let (v, w) = (normal.dot(ap.cross(ac)) * scale, normal.dot(ab.cross(ap)) * scale);
        if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
            consider(v, w);
        }
    }
    best
}

/// Whether the doubled area is more than `ratio` times the longest edge squared.
fn is_wider(ab: DVec3, ac: DVec3, ratio: f64) -> bool {
    let longest = ab.length_squared().max(ac.length_squared()).max((ac - ab).length_squared());
    ab.cross(ac).length_squared() > (ratio * longest) * (ratio * longest)
}

/// The position in 0..=1 along `edge` that is closest to the point `offset` from its start.
fn along(offset: DVec3, edge: DVec3) -> f64 {
    let length_squared = edge.length_squared();
    if length_squared > 0.0 { (offset.dot(edge) / length_squared).clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 3.0, 0.0)];

    #[test]
    fn each_region_gives_its_corner_edge_or_face() {
        let cases = [
            (Vec3::new(-1.0, -1.0, 0.0), [0.0, 0.0], 2.0),
            (Vec3::new(6.0, -1.0, 0.0), [1.0, 0.0], 5.0),
            (Vec3::new(-1.0, 5.0, 2.0), [0.0, 1.0], 9.0),
            (Vec3::new(1.0, -2.0, 0.0), [0.25, 0.0], 4.0),
            (Vec3::new(-2.0, 1.5, 1.0), [0.0, 0.5], 5.0),
            (Vec3::new(2.0 + 3.0, 1.5 + 4.0, 0.0), [0.5, 0.5], 25.0),
            (Vec3::new(1.0, 1.0, -7.0), [0.25, 1.0 / 3.0], 49.0),
        ];
        for (p, [v, w], squared) in cases {
            for projection in [closest_point_on_triangle(p, TRIANGLE), closest_point_on_sliver(p, TRIANGLE)] {
                let error =
                    (projection.v - v).abs().max((projection.w - w).abs()).max((projection.squared - squared).abs());
                assert!(error < 1e-12, "{p}: {projection:?}");
            }
        }
    }

    #[test]
    fn a_triangle_of_no_area_is_a_segment_or_a_point() {
        let [a, b] = [Vec3::new(1.0, 1.0, 1.0), Vec3::new(3.0, 1.0, 1.0)];
        let middle = (a + b) / 2.0;
        for corners in [[a, b, middle], [middle, a, b], [b, middle, a], [a, a, b], [a, b, a], [b, a, a]] {
            assert!(is_sliver(corners));
            let over = closest_point_on_sliver(Vec3::new(2.5, 4.0, 1.0), corners);
            assert!((over.squared - 9.0).abs() < 1e-12, "{corners:?}: {over:?}");
            let beyond = closest_point_on_sliver(Vec3::new(7.0, 1.0, 4.0), corners);
            assert!((beyond.squared - 25.0).abs() < 1e-12, "{corners:?}: {beyond:?}");
        }
        assert!((closest_point_on_sliver(a + Vec3::Z, [a; 3]).squared - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_thin_triangle_is_answered_to_a_millionth_of_its_size() {
        for thinness in [1e-2f32, 1e-4, 1e-6, 1e-8, 1e-12] {
            let corners = [Vec3::ZERO, Vec3::X * 10.0, Vec3::new(5.0, 10.0 * thinness, 0.0)];
            let p = Vec3::new(5.0, 3.0 * thinness, 2.0);
            let projection = if is_sliver(corners) {
                closest_point_on_sliver(p, corners)
            } else {
                closest_point_on_triangle(p, corners)
            };
            assert!((projection.squared.sqrt() - 2.0).abs() < 1e-8, "{thinness}: {projection:?}");
        }
    }

    fn point() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-10.0f32..10.0).prop_map(Vec3::from)
    }

    proptest! {
        /// The two ways are independent of each other, and no point of the triangle is closer than the answer.
        #[test]
        fn both_ways_agree_and_nothing_is_closer(p in point(), corners in prop::array::uniform3(point()),
                                                 s in 0.0f64..1.0, t in 0.0f64..1.0) {
            prop_assume!(!is_sliver(corners));
            let (one, other) = (closest_point_on_triangle(p, corners), closest_point_on_sliver(p, corners));
            prop_assert!((one.squared.sqrt() - other.squared.sqrt()).abs() < 1e-9);
            let (v, w) = if s + t <= 1.0 { (s, t) } else { (1.0 - s, 1.0 - t) };
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let elsewhere = p.as_dvec3().distance(a + (b - a) * v + (c - a) * w);
            prop_assert!(one.squared.sqrt() <= elsewhere + 1e-9);
        }
    }
}
