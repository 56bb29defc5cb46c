//! The distance between a segment and a triangle, all cases.
//!
//! It is 0 where they cross. Else it is taken between the segment and a side, or between an end of the segment and the
//! face: the least of those is exact, whatever their position.

use glam::DVec3;

/// Distance in mm between the segment from `p` to `q` and a triangle. Either may be a point, the triangle a segment.
pub fn segment_to_triangle(p: DVec3, q: DVec3, triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle;
    let normal = (b - a).cross(c - a);
    if crosses(p, q, triangle, normal) {
        return 0.0;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| between_segments([p, q], [from, to]));
    let faces = [p, q].map(|end| to_face(end, triangle, normal));
    sides.into_iter().chain(faces).fold(f64::INFINITY, f64::min)
}

/// Whether the segment passes through the face from one side of its plane to the other.
fn crosses(p: DVec3, q: DVec3, triangle: [DVec3; 3], normal: DVec3) -> bool {
    let (above, below) = ((p - triangle[0]).dot(normal), (q - triangle[0]).dot(normal));
    if above == below || (above > 0.0) == (below > 0.0) && above != 0.0 && below != 0.0 {
        return false;
    }
    let at = p + (q - p) * (above / (above - below));
    is_over(at, triangle, normal)
}

/// Whether the foot of `at` on the triangle's plane lies in the triangle.
fn is_over(at: DVec3, [a, b, c]: [DVec3; 3], normal: DVec3) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| (to - from).cross(at - from).dot(normal) >= 0.0)
}

/// Distance of a point from its foot on the triangle's plane, if that lies in the triangle.
fn to_face(p: DVec3, triangle: [DVec3; 3], normal: DVec3) -> f64 {
    let length = normal.length();
    if length > 0.0 && is_over(p, triangle, normal) {
        ((p - triangle[0]).dot(normal) / length).abs()
    } else {
        f64::INFINITY
    }
}

/// Distance of a point from a segment.
fn to_segment(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let squared = along.length_squared();
    let part = if squared > 0.0 { ((p - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * part)
}

/// Distance between two segments: between an end and the other segment, or inside of both.
fn between_segments(one: [DVec3; 2], other: [DVec3; 2]) -> f64 {
    let ends =
        [to_segment(one[0], other), to_segment(one[1], other), to_segment(other[0], one), to_segment(other[1], one)];
    let least = ends.into_iter().fold(f64::INFINITY, f64::min);
    let (u, v, w) = (one[1] - one[0], other[1] - other[0], other[0] - one[0]);
    let normal = u.cross(v);
    let squared = normal.length_squared();
    if squared <= 0.0 {
        return least;
    }
    let (s, t) = (w.cross(v).dot(normal) / squared, w.cross(u).dot(normal) / squared);
    let is_inside = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    if is_inside { least.min((one[0] + u * s).distance(other[0] + v * t)) } else { least }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [DVec3; 3] = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];

    fn check(p: [f64; 3], q: [f64; 3], expected: f64) {
        let (p, q) = (DVec3::from(p), DVec3::from(q));
        let [a, b, c] = FLAT;
        for triangle in [[a, b, c], [b, c, a], [c, b, a]] {
            for (from, to) in [(p, q), (q, p)] {
                let found = segment_to_triangle(from, to, triangle);
                assert!((found - expected).abs() < 1e-12, "{from} {to} {triangle:?}: {found}, not {expected}");
            }
        }
    }

    #[test]
    fn through_the_face_it_is_nothing() {
        check([1.0, 1.0, -1.0], [1.0, 1.0, 1.0], 0.0);
        check([1.0, 1.0, 0.0], [1.0, 1.0, 1.0], 0.0);
        check([-1.0, 1.0, 0.0], [5.0, 1.0, 0.0], 0.0);
        check([1.0, 1.0, 0.0], [1.2, 1.0, 0.0], 0.0);
    }

    #[test]
    fn over_the_face_it_is_the_height_of_the_lower_end() {
        check([1.0, 1.0, 0.5], [1.0, 1.0, 2.0], 0.5);
        check([0.5, 0.5, 0.7], [1.0, 1.0, 0.7], 0.7);
        check([1.0, 1.0, 0.5], [1.0, 1.0, 0.5], 0.5);
    }

    #[test]
    fn beside_a_side_it_is_the_distance_between_the_lines() {
        // Across the side along x, a millimetre off and half a millimetre over it.
        check([2.0, -1.0, 0.0], [2.0, -1.0, 5.0], 1.0);
        check([2.0, -2.0, 1.0], [2.0, 0.0, -1.0], 0.5f64.sqrt());
        // Beside the slanted side: 4x + 3y... has its normal along (3, 4).
        check([2.0 + 3.0, 1.5 + 4.0, -1.0], [2.0 + 3.0, 1.5 + 4.0, 1.0], 5.0);
    }

    #[test]
    fn beyond_a_corner_it_is_the_distance_from_it() {
        check([-3.0, -4.0, 0.0], [-6.0, -8.0, 0.0], 5.0);
        check([-1.0, -2.0, 2.0], [-3.0, -4.0, 5.0], 3.0);
        check([7.0, 0.0, 4.0], [8.0, 0.0, 9.0], 5.0);
    }

    #[test]
    fn a_sliver_and_a_point_are_segments_and_points() {
        let sliver = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0];
        assert_eq!(segment_to_triangle(DVec3::new(1.5, 2.0, 0.0), DVec3::new(1.5, 3.0, 0.0), sliver), 2.0);
        assert_eq!(segment_to_triangle(DVec3::Y * 2.0, DVec3::Y * 3.0, [DVec3::ZERO; 3]), 2.0);
    }

    #[test]
    fn it_is_never_more_than_between_any_two_points_and_is_reached() {
        // Against dense samples of both, in positions without relation.
        let mut seed = 7u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
        };
        for _ in 0..200 {
            let mut point = || DVec3::new(next(), next(), next());
            let (p, q, triangle) = (point(), point(), [point(), point(), point()]);
            let found = segment_to_triangle(p, q, triangle);
            let mut sampled = f64::INFINITY;
            for i in 0..=40 {
                let on = p.lerp(q, f64::from(i) / 40.0);
                for j in 0..=40 {
                    for k in 0..=40 - j {
                        let (v, w) = (f64::from(j) / 40.0, f64::from(k) / 40.0);
                        let [a, b, c] = triangle;
                        sampled = sampled.min(on.distance(a + (b - a) * v + (c - a) * w));
                    }
                }
            }
            assert!(found <= sampled + 1e-12 && sampled - found < 0.1, "{found} {sampled}");
        }
    }
}
