//! What a ray passes of a surface: how deep it goes before it leaves, and how often the surface goes around a point.
//!
//! An edge against a triangle is Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997), the slabs
//! of boxes Kay and Kajiya, "Ray tracing complex scenes" (1986), four at once.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3, Vec4};

use super::nearest::{Leaf, STACK, SurfaceIndex};

impl SurfaceIndex {
    /// How often the surface goes around `p`, as counted along a ray: 1 inside of a closed surface, 0 outside. An open
    /// end that the ray leaves by is a miscount.
    pub fn winding(&self, p: Vec3, direction: Vec3) -> i32 {
        self.outward_less_inward(p.as_dvec3(), direction.as_dvec3(), f64::INFINITY)
    }

    /// How often the surface is passed outwards, less inwards, on the straight way between two points.
    pub fn passes(&self, from: Vec3, to: Vec3) -> i32 {
        let (p, way) = (from.as_dvec3(), to.as_dvec3() - from.as_dvec3());
        way.try_normalize().map_or(0, |direction| self.outward_less_inward(p, direction, way.length()))
    }

    fn outward_less_inward(&self, p: DVec3, direction: DVec3, length: f64) -> i32 {
        let mut hits = Vec::new();
        self.along(p, direction, length, |leaf, _| {
            if let Some(hit) = Hit::of(p, direction, leaf.corners).filter(|hit| hit.depth <= length) {
                hits.push((leaf.triangle, if hit.is_outward { 1 } else { -1 }));
            }
        });
        // A sliver stands in several leaves.
        hits.sort_unstable();
        hits.dedup();
        hits.into_iter().map(|(_, outward)| outward).sum()
    }

    /// How far it is from `p` along `direction` (of length 1) to where the surface is left, in mm.
    pub fn depth(&self, p: Vec3, direction: Vec3) -> Option<f32> {
        self.depth_within(p, direction, f32::INFINITY)
    }

    /// As [`Self::depth`], if it is at most `farthest` mm.
    pub fn depth_within(&self, p: Vec3, direction: Vec3, farthest: f32) -> Option<f32> {
        let (p, direction, farthest) = (p.as_dvec3(), direction.as_dvec3(), f64::from(farthest));
        let mut least = f64::INFINITY;
        self.along(p, direction, farthest, |leaf, farthest| {
            if let Some(hit) = Hit::of(p, direction, leaf.corners).filter(|hit| hit.is_outward) {
                least = least.min(hit.depth);
                *farthest = farthest.min(least);
            }
        });
        (least <= farthest && least.is_finite()).then_some(least as f32)
    }

    /// The triangle by which a ray from `p` along `direction` (of length 1) first leaves the surface, if it is at most
    /// `farthest` mm away; of several at the same depth that of the least number.
    pub fn outlet(&self, p: DVec3, direction: DVec3, farthest: f64) -> Option<u32> {
        let mut best = (farthest, u32::MAX);
        self.along(p, direction, farthest, |leaf, farthest| {
            if let Some(hit) = Hit::of(p, direction, leaf.corners).filter(|hit| hit.is_outward)
                && (hit.depth, leaf.triangle) < best
            {
                best = (hit.depth, leaf.triangle);
                *farthest = farthest.min(hit.depth);
            }
        });
        (best.1 != u32::MAX).then_some(best.1)
    }

    /// The first triangle, other than `own`, that a ray from `p` along `direction` (of length 1) meets from either side
    /// within `farthest` mm, and how far it is; of several at the same depth that of the least number.
    pub(super) fn first_met(&self, p: DVec3, direction: DVec3, farthest: f64, own: u32) -> Option<(f64, u32)> {
        let mut best = (farthest, u32::MAX);
        self.along(p, direction, farthest, |leaf, farthest| {
            if leaf.triangle != own
                && let Some(hit) = Hit::of(p, direction, leaf.corners)
                && (hit.depth, leaf.triangle) < best
            {
                best = (hit.depth, leaf.triangle);
                *farthest = farthest.min(hit.depth);
            }
        });
        (best.1 != u32::MAX).then_some(best)
    }

    /// Visits the leaves whose boxes a ray passes before `farthest`, which the visits may lower.
    pub(super) fn along(&self, p: DVec3, direction: DVec3, mut farthest: f64, mut visit: impl FnMut(&Leaf, &mut f64)) {
        let origin = p.as_vec3().to_array().map(Vec4::splat);
        let inverse = direction.to_array().map(|d| Vec4::splat((1.0 / d).clamp(-1e30, 1e30) as f32));
        let mut stack = ArrayVec::<u32, STACK>::new();
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(number) = stack.pop() {
            let node = &self.nodes[number as usize];
            // The slabs of all four boxes at once, a little too wide for the rounding.
            let (mut enter, mut leave) = (Vec4::ZERO, Vec4::splat(farthest.min(1e37) as f32 * 1.000_01));
            for axis in 0..3 {
                let one = (node.min[axis] - origin[axis]) * inverse[axis];
                let other = (node.max[axis] - origin[axis]) * inverse[axis];
                enter = enter.max(one.min(other) * 0.999_99);
                leave = leave.min(one.max(other) * 1.000_01);
            }
            let mut lanes = enter.cmple(leave).bitmask() & ((1 << node.used) - 1);
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let (child, count) = (node.child[lane], node.count[lane]);
                if count == 0 {
                    stack.push(child);
                } else {
                    for leaf in &self.leaves[child as usize..child as usize + usize::from(count)] {
                        visit(leaf, &mut farthest);
                    }
                }
            }
        }
    }
}

/// Where a ray meets a triangle.
pub(super) struct Hit {
    /// Along the ray, more than 0.
    pub(super) depth: f64,
    /// Whether the ray leaves the surface there.
    pub(super) is_outward: bool,
}

impl Hit {
    pub(super) fn of(p: DVec3, direction: DVec3, corners: [Vec3; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let (ab, ac, offset) = (b - a, c - a, p - a);
        let across = direction.cross(ac);
        // Positive where the ray leaves by the triangle.
        let determinant = -ab.dot(across);
        let turned = offset.cross(ab);
        let sign = determinant.signum();
        let (v, w) = (-offset.dot(across) * sign, -direction.dot(turned) * sign);
        let depth = -ac.dot(turned) / determinant;
        let size = determinant.abs();
        // Through an edge or a vertex, it must not slip between two triangles.
        let slack = 1e-9 * size;
        let is_hit = size > 0.0 && v >= -slack && w >= -slack && v + w <= size + slack && depth > 0.0;
        is_hit.then_some(Self { depth, is_outward: determinant > 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use glam::Vec2;

    use super::*;
    use crate::shapes::icosphere;

    #[test]
    fn a_ray_counts_how_often_the_surface_goes_around() {
        let centre = Vec3::new(3.0, 4.0, 5.0);
        let (sphere, other) = (icosphere(3, 6.0, centre), icosphere(2, 3.0, centre + Vec3::X * 5.0));
        let mut both = sphere.clone();
        both.positions.extend(&other.positions);
        let first = sphere.positions.len() as u32;
        both.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        let index = SurfaceIndex::new(&both.positions, &both.triangles);
        let direction = Vec3::new(0.3, 0.5, 0.81).normalize();
        for (offset, count) in [(0.0, 1), (4.5, 2), (7.0, 1), (8.5, 0), (-5.0, 1), (-7.0, 0)] {
            assert_eq!(index.winding(centre + Vec3::X * offset, direction), count, "{offset}");
        }
    }

    #[test]
    fn a_way_passes_a_thin_triangle_once() {
        // A fan of a thousand, each 10 mm long and at most 0.06 mm wide, in z = 0, looking up.
        let rim = (0..1000u32).map(|i| (Vec2::from_angle(TAU * i as f32 / 1000.0) * 10.0).extend(0.0));
        let positions: Vec<Vec3> = std::iter::once(Vec3::ZERO).chain(rim).collect();
        let triangles: Vec<[u32; 3]> = (0..1000).map(|i| [0, 1 + i, 1 + (i + 1) % 1000]).collect();
        let index = SurfaceIndex::new(&positions, &triangles);
        for &[a, b, c] in &triangles {
            let middle = (positions[a as usize] + positions[b as usize] + positions[c as usize]) / 3.0;
            assert_eq!(index.passes(middle - Vec3::Z, middle + Vec3::Z), 1);
            assert_eq!(index.passes(middle + Vec3::Z, middle - Vec3::Z), -1);
            assert_eq!(index.passes(middle + Vec3::Z, middle + Vec3::Z * 2.0), 0);
        }
    }
}
