//! Up to four triangles of a leaf at once, lane by lane in f32: which of them can be near.
//!
//! Nearly all triangles that a search comes to are not the nearest. Here four are told apart in the time of one, with
//! allowances that make up for the rounding of f32, and without branches, which a processor cannot foresee in a search;
//! those that are left are measured in f64 (`closest_point.rs`, `capsule.rs`). So no answer depends on what is here.

use glam::{DVec3, Vec3, Vec4};

use super::nearest::{Leaf, Node};
use super::planes::Planes;

/// Four vectors.
type Lanes = [Vec4; 3];

/// By what a squared distance may be too large by rounding, beside [`rounding`].
const ALLOWANCE: f32 = 1.0 + 1e-3;
/// The same by the squares of the lengths that it is worked out from.
const OF_LENGTHS: f32 = 4e-10;
/// By what the plane of a triangle that is no sliver may be off: of the squares of the lengths.
const OF_PLANE: f32 = 1e-4;
/// Weights of corners below which a point is surely beside a triangle.
const BESIDE: f32 = -1e-3;
/// By what two segments may seem farther apart, in f32: of the shorter one's length.
const OF_SEGMENTS: f32 = 1e-2;
/// Keeps quotients finite.
const TINY: Vec4 = Vec4::splat(1e-30);

/// The square of what rounding its coordinates to f32 may add to a distance from `p`, with [`ALLOWANCE`].
pub(super) fn rounding(p: DVec3) -> f32 {
    (4e-11 * p.length_squared()) as f32
}

fn splat(v: Vec3) -> Lanes {
    v.to_array().map(Vec4::splat)
}

#[inline]
fn dot(a: &Lanes, b: &Lanes) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn minus(a: &Lanes, b: &Lanes) -> Lanes {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
fn cross(a: &Lanes, b: &Lanes) -> Lanes {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Of each lane: its bit, where `is` says so of its triangle.
#[inline]
fn lanes(leaves: &[Leaf], is: impl Fn(&Leaf) -> bool) -> u32 {
    leaves.iter().enumerate().fold(0, |lanes, (i, leaf)| lanes | u32::from(is(leaf)) << i)
}

/// The corners of one to four triangles; the last fills the lanes that are left.
#[inline]
fn corners(leaves: &[Leaf]) -> Option<[Lanes; 3]> {
    let last = leaves.len().checked_sub(1)?;
    let [a, b, c, d] = [0, 1, 2, 3].map(|i: usize| &leaves[i.min(last)].corners);
    Some([0, 1, 2].map(|k| [0, 1, 2].map(|axis| Vec4::new(a[k][axis], b[k][axis], c[k][axis], d[k][axis]))))
}

/// Squared distances of points from a segment, whose start they are `from` away from, and its squared length.
#[inline]
fn to_side(from: &Lanes, side: &Lanes) -> (Vec4, Vec4) {
    let size = dot(side, side);
    let along = (dot(from, side) / size.max(TINY)).max(Vec4::ZERO).min(Vec4::ONE);
    let off = [0, 1, 2].map(|axis| from[axis] - side[axis] * along);
    (dot(&off, &off), size)
}

/// A point beside four boxes or triangles.
pub(super) struct Point {
    at: Lanes,
    /// Distance from the origin.
    reach: Vec4,
}

impl Point {
    pub(super) fn new(p: Vec3) -> Self {
        Self { at: splat(p), reach: Vec4::splat(p.length()) }
    }

    /// Squared distances from the boxes.
    #[inline]
    pub(super) fn squared_distances(&self, node: &Node) -> [f32; 4] {
        node.squared_distances(&self.at)
    }

    /// Bits of the triangles whose planes are not too far for the root of `squared`.
    #[inline]
    pub(super) fn beside(&self, planes: &[Vec4; 4], squared: f32) -> u32 {
        Planes::new(planes).near_point(&self.at, self.reach, squared)
    }

    /// Bits of the triangles that may be as near as the root of `squared`. `rounding` is that of the point.
    #[inline]
    pub(super) fn nearer(&self, leaves: &[Leaf], squared: f32, rounding: f32) -> u32 {
        let Some([a, b, c]) = corners(leaves) else { return 0 };
        let from = [&a, &b, &c].map(|corner| minus(&self.at, corner));
        let sides = [minus(&b, &a), minus(&c, &b), minus(&a, &c)];
        let normal = cross(&sides[0], &sides[1]);
        // Where the point is above the inside or close to it, the plane counts, which f64 knows better.
        let weights = [0, 1, 2].map(|k| dot(&cross(&sides[k], &from[k]), &normal));
        let least = weights[0].min(weights[1]).min(weights[2]);
        let is_above = !least.cmplt(dot(&normal, &normal) * BESIDE);
        let [(d0, s0), (d1, s1), (d2, s2)] = [0, 1, 2].map(|k| to_side(&from[k], &sides[k]));
        let allowance = (dot(&from[0], &from[0]) + s0 + s1 + s2) * OF_LENGTHS;
        let is_near = !d0.min(d1).min(d2).cmpgt(allowance + Vec4::splat(squared * ALLOWANCE + rounding));
        ((is_above | is_near).bitmask() | lanes(leaves, |leaf| leaf.is_sliver)) & lanes(leaves, |_| true)
    }
}

/// A segment beside four boxes or triangles.
pub(super) struct Segment {
    min: Lanes,
    max: Lanes,
    start: Lanes,
    end: Lanes,
    direction: Lanes,
    length: Vec4,
    /// Distance of the farther end from the origin.
    reach: Vec4,
    /// What [`rounding`] is of its ends.
    pub(super) rounding: f32,
}

impl Segment {
    pub(super) fn new(a: DVec3, b: DVec3) -> Self {
        Self {
            min: splat(a.min(b).as_vec3()),
            max: splat(a.max(b).as_vec3()),
            start: splat(a.as_vec3()),
            end: splat(b.as_vec3()),
            reach: Vec4::splat(a.length().max(b.length()) as f32),
            direction: splat((b - a).normalize_or_zero().as_vec3()),
            length: Vec4::splat((b - a).length() as f32),
            rounding: rounding(a) + rounding(b),
        }
    }

    /// Lower bounds of the squared distances from the boxes: of the box around the segment.
    #[inline]
    pub(super) fn squared_distances(&self, node: &Node) -> [f32; 4] {
        let gap = |axis: usize| (node.min[axis] - self.max[axis]).max(self.min[axis] - node.max[axis]).max(Vec4::ZERO);
        let (x, y, z) = (gap(0), gap(1), gap(2));
        (x * x + y * y + z * z).to_array()
    }

    /// Bits of the triangles whose planes are not too far for the root of `squared`.
    #[inline]
    pub(super) fn beside(&self, planes: &[Vec4; 4], squared: f32) -> u32 {
        Planes::new(planes).near_segment([&self.start, &self.end], self.reach, squared)
    }

    /// Bits of the triangles that the inside may come nearer to than the root of `squared`: through the face, or past a
    /// side that is kept.
    #[inline]
    pub(super) fn nearer(&self, leaves: &[Leaf], squared: f32) -> u32 {
        let Some([a, b, c]) = corners(leaves) else { return 0 };
        let from = minus(&self.start, &a);
        let normal = cross(&minus(&b, &a), &minus(&c, &a));
        let size = dot(&normal, &normal);
        let lengths = dot(&from, &from) + self.length * self.length;
        let off = lengths * OF_PLANE + Vec4::splat(self.rounding);
        let start = dot(&normal, &from);
        let end = start + dot(&normal, &self.direction) * self.length;
        let is_one_side = (start * end).cmpgt(Vec4::ZERO);
        let nearest = (start * start).min(end * end);
        // As far as its plane.
        let is_far = is_one_side & nearest.cmpgt(size * (off + Vec4::splat(squared * ALLOWANCE)));
        let far = is_far.bitmask() & !lanes(leaves, |leaf| leaf.is_sliver);
        let mut near = !(is_one_side & nearest.cmpgt(size * off)).bitmask();
        let within = squared.sqrt() * ALLOWANCE + self.rounding.sqrt();
        for (k, from, to) in [(0, &a, &b), (1, &b, &c), (2, &c, &a)] {
            let open = lanes(leaves, |leaf| leaf.sides >> k & 1 > 0) & !far & !near;
            if open > 0 {
                near |= self.passes(from, &minus(to, from), within) & open;
            }
        }
        near & lanes(leaves, |_| true)
    }

    /// Bits of the sides, from their starts on, that the segment may pass nearer than `within` (Ericson, "Real-time
    /// collision detection", 2005, section 5.1.9).
    #[inline]
    fn passes(&self, start: &Lanes, side: &Lanes, within: f32) -> u32 {
        let offset = minus(&self.start, start);
        let (size, cosine) = (dot(side, side), dot(side, &self.direction));
        let (d, e) = (dot(&self.direction, &offset), dot(side, &offset));
        let on_line = |along: Vec4| along.max(Vec4::ZERO).min(self.length);
        let along = on_line((cosine * e - d * size) / (size - cosine * cosine).max(TINY));
        let on_side = ((cosine * along + e) / size.max(TINY)).max(Vec4::ZERO).min(Vec4::ONE);
        let along = on_line(cosine * on_side - d);
        let off = [0, 1, 2].map(|axis| offset[axis] + self.direction[axis] * along - side[axis] * on_side);
        let shorter = size.min(self.length * self.length);
        // At least the square of the sum of both.
        let limit = Vec4::splat(within * within * (1.0 + OF_SEGMENTS)) + shorter * (OF_SEGMENTS * (1.0 + OF_SEGMENTS));
        !dot(&off, &off).cmpgt(limit).bitmask()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::closest_point::{closest_point_on_sliver, is_sliver};
    use crate::planes::plane;

    fn leaf(corners: [Vec3; 3]) -> Leaf {
        Leaf { corners, triangle: 0, is_sliver: is_sliver(corners), sides: Leaf::ALL_SIDES }
    }

    /// The least distance of many points of a segment from a triangle.
    fn sampled(a: DVec3, b: DVec3, corners: [Vec3; 3]) -> f64 {
        let at = |i: i32| closest_point_on_sliver(a.lerp(b, f64::from(i) / 200.0), corners).squared.sqrt();
        (0..=200).map(at).fold(f64::INFINITY, f64::min)
    }

    fn point(half: f32) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-half..half).prop_map(Vec3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// However thin or small the triangles are, and however far from the origin.
        #[test]
        fn what_is_near_is_never_left_out(
            far in point(600.0), p in point(1.0), q in point(1.0), count in 1usize..5,
            triangles in prop::array::uniform4(prop::array::uniform3(point(1.0))),
            thin in prop::array::uniform4(-9i32..1), small in prop::array::uniform4(-4i32..2),
        ) {
            let leaves: Vec<Leaf> = (0..count).map(|i| {
                let [a, b, c] = triangles[i];
                let middle = (a + b) / 2.0;
                let third = middle + (c - middle) * 10f32.powi(thin[i]);
                leaf([a, b, third].map(|corner| far + corner * 10f32.powi(small[i])))
            }).collect();
            let (p, q) = (far.as_dvec3() + p.as_dvec3(), far.as_dvec3() + q.as_dvec3());
            let exact: Vec<f64> = leaves.iter().map(|leaf| leaf.project_point(p).squared).collect();
            let to_segment: Vec<f64> = leaves.iter().map(|leaf| sampled(p, q, leaf.corners)).collect();
            let planes: [Vec4; 4] = std::array::from_fn(|i| leaves.get(i).map_or(Vec4::ZERO, |leaf| plane(leaf.corners)));
            for i in 0..count {
                let beside = Point::new(p.as_vec3()).beside(&planes, exact[i] as f32);
                prop_assert!((0..count).all(|k| exact[k] > exact[i] || beside >> k & 1 > 0), "{i} {beside:b} {exact:?}");
                let within = (to_segment[i] * to_segment[i]) as f32;
                let beside = Segment::new(p, q).beside(&planes, within);
                prop_assert!((0..count).all(|k| to_segment[k] > to_segment[i] || beside >> k & 1 > 0), "{i} {beside:b}");
                let near = Point::new(p.as_vec3()).nearer(&leaves, exact[i] as f32, rounding(p));
                prop_assert!((0..count).all(|k| exact[k] > exact[i] || near >> k & 1 > 0), "{i} {near:b} {exact:?}");
                prop_assert!(near >> count == 0);
                let near = Segment::new(p, q).nearer(&leaves, (to_segment[i] * to_segment[i]) as f32);
                for (k, leaf) in leaves.iter().enumerate().filter(|&(k, _)| to_segment[k] <= to_segment[i]) {
                    // What is nearest to an end need not be found.
                    let of_ends = [p, q].map(|end| closest_point_on_sliver(end, leaf.corners).squared.sqrt());
                    let is_inside = to_segment[k] < of_ends[0].min(of_ends[1]) - 1e-6;
                    prop_assert!(!is_inside || near >> k & 1 > 0, "{i} {k} {near:b} {to_segment:?}");
                }
            }
        }
    }

    #[test]
    fn of_triangles_side_by_side_those_that_are_far_are_left_out() {
        let corners = |x: f32| [Vec3::new(x, 0.0, 0.0), Vec3::new(x + 0.1, 0.0, 0.0), Vec3::new(x, 0.1, 0.0)];
        let leaves = [0.0, 0.1, 0.2, 0.3].map(|x| leaf(corners(x)));
        let p = DVec3::new(0.02, 0.02, 0.2);
        assert_eq!(Point::new(p.as_vec3()).nearer(&leaves, 0.04, rounding(p)), 0b0001);
        assert_eq!(Point::new(p.as_vec3()).nearer(&leaves[2..], 0.04, rounding(p)), 0);
        // They lie in one plane.
        let planes = leaves.map(|leaf| plane(leaf.corners));
        assert_eq!(Point::new(p.as_vec3()).beside(&planes, 0.0401), 0b1111);
        assert_eq!(Point::new(p.as_vec3()).beside(&planes, 0.0399), 0);
        let segment = Segment::new(p, p + DVec3::X * 0.1);
        assert_eq!([0.0401, 0.0399].map(|squared| segment.beside(&planes, squared)), [0b1111, 0]);
        let through = Segment::new(p, DVec3::new(0.02, 0.02, -0.2));
        assert_eq!(through.beside(&planes, 1e-6), 0b1111);
        assert_eq!(segment.nearer(&leaves, 0.039), 0);
        // The third is 0.08 mm beyond the end.
        assert_eq!(segment.nearer(&leaves, 0.042), 0b0011);
    }
}
