//! Boxes around parts of a long thin triangle.
//!
//! A sliver that runs across the axes fills little of its box, and in a fan of thousands of them around one vertex all
//! boxes overlap: a search would look at each. So a sliver is cut into slabs along the longest side of its box, each
//! with a box of its own: early split clipping (Ernst and Greiner, "Early split clipping for bounding volume
//! hierarchies", 2007). The triangle then stands in several leaves.

use glam::{DVec3, Vec3};

/// Boxes that a surface may have at most, unless it has more triangles.
const MAX_BOXES: usize = 1_600_000;
/// Boxes of one triangle at most.
const PIECES: usize = 16;
/// A triangle is cut where its box has more than this times its area.
const LOOSE: f64 = 16.0;

/// Calls `add` with the box of each piece of a triangle of a surface of `triangles`. Its corners must be finite.
pub(super) fn boxes(corners: [Vec3; 3], triangles: usize, mut add: impl FnMut(Vec3, Vec3)) {
    let [a, b, c] = corners;
    let (min, max) = (a.min(b).min(c), a.max(b).max(c));
    let pieces = pieces(corners, max - min, triangles);
    if pieces < 2 {
        return add(min, max);
    }
    let size = (max - min).to_array();
    let axis = (0..3).fold(0, |axis, i| if size[i] > size[axis] { i } else { axis });
    let at = |i: usize| f64::from(min[axis]) + f64::from(size[axis]) * i as f64 / pieces as f64;
    let corners = corners.map(Vec3::as_dvec3);
    for piece in 0..pieces {
        let from = if piece == 0 { f64::NEG_INFINITY } else { at(piece) };
        let to = if piece + 1 == pieces { f64::INFINITY } else { at(piece + 1) };
        let (low, high) = slab(corners, axis, from, to);
        // Rounded outwards.
        add(
            Vec3::from(low.as_vec3().to_array().map(f32::next_down)),
            Vec3::from(high.as_vec3().to_array().map(f32::next_up)),
        );
    }
}

/// Into how many boxes a triangle goes: by how badly it fills its own.
fn pieces([a, b, c]: [Vec3; 3], size: Vec3, triangles: usize) -> usize {
    let size = size.as_dvec3();
    let half_area = size.x * size.y + size.y * size.z + size.z * size.x;
    let area = (b.as_dvec3() - a.as_dvec3()).cross(c.as_dvec3() - a.as_dvec3()).length() / 2.0;
    if half_area <= LOOSE * area {
        return 1;
    }
    let most = PIECES.min(MAX_BOXES / triangles.max(1)).max(1);
    // A half of the root: beyond that, more boxes cost what smaller ones save.
    ((half_area / area).sqrt() / 2.0).clamp(1.0, most as f64) as usize
}

/// The box of the part of a triangle between two planes across an axis.
fn slab(corners: [DVec3; 3], axis: usize, from: f64, to: f64) -> (DVec3, DVec3) {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut include = |p: DVec3| (low, high) = (low.min(p), high.max(p));
    for (i, &p) in corners.iter().enumerate() {
        if (from..=to).contains(&p[axis]) {
            include(p);
        }
        let q = corners[(i + 1) % 3];
        for plane in [from, to] {
            if (p[axis] < plane) != (q[axis] < plane) {
                let mut cut = p + (q - p) * ((plane - p[axis]) / (q[axis] - p[axis]));
                cut[axis] = plane;
                include(cut);
            }
        }
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn all(corners: [Vec3; 3], triangles: usize) -> Vec<(Vec3, Vec3)> {
        let mut found = Vec::new();
        boxes(corners, triangles, |min, max| found.push((min, max)));
        found
    }

    #[test]
    fn only_slivers_across_the_axes_of_surfaces_that_are_not_huge_are_cut() {
        let even = [Vec3::ZERO, Vec3::new(1.0, 0.9, 0.1), Vec3::new(0.2, 0.1, 1.0)];
        assert_eq!(all(even, 10).len(), 1);
        let sliver = [Vec3::ZERO, Vec3::new(9.0, 9.0, 1.0), Vec3::new(9.0, 9.1, 1.0)];
        let cut = all(sliver, 5000);
        assert!(cut.len() > 3, "{}", cut.len());
        assert!(cut.iter().all(|(min, max)| (*max - *min).y < 9.1 / cut.len() as f32 * 1.01));
        assert_eq!(all(sliver, 2_000_000).len(), 1);
        assert_eq!(all([Vec3::ONE; 3], 1).len(), 1);
        assert_eq!(all([Vec3::ZERO, Vec3::ONE, Vec3::splat(2.0)], 1).len(), PIECES);
    }

    proptest! {
        #[test]
        fn every_point_of_the_triangle_lies_in_a_box(
            corners in prop::array::uniform3(prop::array::uniform3(-9.0f32..9.0).prop_map(Vec3::from)),
            thin in 0.0f32..1.0, s in 0.0f32..1.0, t in 0.0f32..1.0,
        ) {
            let [a, b, c] = corners;
            let corners = [a, b, b + (c - b) * thin * thin * thin * thin];
            let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let p = a + (b - a) * f64::from(s) + (c - a) * f64::from(t);
            let holds = |(min, max): &(Vec3, Vec3)| {
                (min.as_dvec3() - 1e-9).cmple(p).all() && p.cmple(max.as_dvec3() + 1e-9).all()
            };
            prop_assert!(all(corners, 1).iter().any(holds));
        }
    }
}
