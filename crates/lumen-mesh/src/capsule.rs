//! Where a thin round thing touches a surface: the nearest point to a point in f64, and the nearest point to the inside
//! of a segment. Both search the boxes of [`SurfaceIndex`] from a bound that an earlier answer gives, so that the cost
//! hardly depends on the number of triangles.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3, Vec4};

use super::closest_point::TriangleProjection;
use super::four::{Point, Segment, rounding};
use super::nearest::{Leaf, Node, STACK, SurfaceIndex};

/// The nearest point of a surface to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointProjection {
    /// Number of the triangle.
    pub triangle: u32,
    /// The nearest point in mm.
    pub point: DVec3,
    /// Distance in mm.
    pub distance: f64,
    /// Weights of the triangle's corners.
    pub barycentric: [f64; 3],
    /// A leaf that holds it, for the next search near by.
    pub slot: u32,
}

/// The nearest point of a surface to the inside of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentProjection {
    /// Where on the segment: 0 at its start, 1 at its end.
    pub along: f64,
    /// On the surface.
    pub projection: PointProjection,
}

/// Relative allowance for the rounding of coordinates to f32 when squared distances to boxes are compared.
const ALLOWANCE: f64 = 1.0 + 1e-3;
/// Leaves that are found before their triangles are looked at. Which box comes next is hard to foresee, for a processor
/// too, and what is done for each box in a row takes half the time.
const BATCH: usize = 8;

impl Leaf {
    /// The point at `v` and `w`, and the weights of the corners there.
    fn at(&self, v: f64, w: f64) -> (DVec3, [f64; 3]) {
        let [a, b, c] = self.corners.map(Vec3::as_dvec3);
        (a + (b - a) * v + (c - a) * w, [(1.0 - v - w).max(0.0), v, w])
    }
}

impl SurfaceIndex {
    /// The nearest point to `p` that is at most `within` mm away. `hint` is the slot of an answer near by.
    pub fn project_point(&self, p: DVec3, within: f64, hint: u32) -> Option<PointProjection> {
        let mut best: Option<(TriangleProjection, u32)> = None;
        let mut squared = within * within;
        let (point, rounding) = (Point::new(p.as_vec3()), rounding(p));
        let hint = if (hint as usize) < self.leaves.len() { hint } else { self.leaf_towards(&point) };
        let mut offer = |slot: u32, leaf: &Leaf, squared: &mut f64| {
            let projection = leaf.project_point(p);
            let is_first = |best: &(TriangleProjection, u32)| leaf.triangle < self.leaves[best.1 as usize].triangle;
            if projection.squared < *squared || (projection.squared == *squared && best.as_ref().is_none_or(is_first)) {
                *squared = projection.squared;
                best = Some((projection, slot));
            }
        };
        if let Some(leaf) = self.leaves.get(hint as usize) {
            offer(hint, leaf, &mut squared);
        }
        self.visit(
            |node| point.squared_distances(node),
            rounding,
            &mut squared,
            |first, leaves, squared| {
                let beside = |planes| point.beside(planes, *squared as f32);
                let beside = self.planes(first).map_or(u32::MAX, beside) & mask(leaves);
                if beside == 0 {
                    return;
                }
                let near = point.nearer(leaves, *squared as f32, rounding) & beside;
                for (slot, leaf) in (first..).zip(leaves) {
                    if near >> (slot - first) & 1 > 0 && slot != hint {
                        offer(slot, leaf, squared);
                    }
                }
            },
        );
        let (projection, slot) = best?;
        let leaf = &self.leaves[slot as usize];
        let (point, barycentric) = leaf.at(projection.v, projection.w);
        Some(PointProjection { triangle: leaf.triangle, point, distance: projection.squared.sqrt(), barycentric, slot })
    }

    /// The nearest point of one leaf's triangle to `p`; `slot` is that of an answer.
    pub fn project_point_in(&self, slot: u32, p: DVec3) -> Option<PointProjection> {
        let leaf = self.leaves.get(slot as usize)?;
        let projection = leaf.project_point(p);
        let (point, barycentric) = leaf.at(projection.v, projection.w);
        Some(PointProjection { triangle: leaf.triangle, point, distance: projection.squared.sqrt(), barycentric, slot })
    }

    /// The nearest point to the segment from `a` to `b` that is less than `within` mm from its inside. Points that are
    /// nearest to its ends may be missed: [`Self::project_point`] finds them.
    pub fn project_segment(&self, a: DVec3, b: DVec3, within: f64) -> Option<SegmentProjection> {
        let mut best: Option<(Approach, u32)> = None;
        let mut squared = within * within;
        let segment = Segment::new(a, b);
        self.visit(
            |node| segment.squared_distances(node),
            segment.rounding,
            &mut squared,
            |first, leaves, squared| {
                let beside = |planes| segment.beside(planes, *squared as f32);
                let beside = self.planes(first).map_or(u32::MAX, beside) & mask(leaves);
                if beside == 0 {
                    return;
                }
                let near = segment.nearer(leaves, *squared as f32) & beside;
                for (slot, leaf) in (first..).zip(leaves).filter(|(slot, _)| near >> (slot - first) & 1 > 0) {
                    if let Some(found) = approach(a, b, leaf, *squared) {
                        *squared = found.squared;
                        best = Some((found, slot));
                    }
                }
            },
        );
        let (Approach { along, squared, v, w }, slot) = best?;
        let leaf = &self.leaves[slot as usize];
        let (point, barycentric) = leaf.at(v, w);
        let projection =
            PointProjection { triangle: leaf.triangle, point, distance: squared.sqrt(), barycentric, slot };
        Some(SegmentProjection { along, projection })
    }

    /// The same for one leaf's triangle; `slot` is that of an answer.
    pub fn project_segment_in(&self, slot: u32, a: DVec3, b: DVec3, within: f64) -> Option<SegmentProjection> {
        let leaf = self.leaves.get(slot as usize)?;
        let Approach { along, squared, v, w } = approach(a, b, leaf, within * within)?;
        let (point, barycentric) = leaf.at(v, w);
        let projection =
            PointProjection { triangle: leaf.triangle, point, distance: squared.sqrt(), barycentric, slot };
        Some(SegmentProjection { along, projection })
    }

    /// The planes of up to four leaves, if there are any.
    #[inline]
    fn planes(&self, first: u32) -> Option<&[Vec4; 4]> {
        self.planes.get(first as usize..)?.first_chunk()
    }

    /// A leaf that is not far from a point.
    fn leaf_towards(&self, point: &Point) -> u32 {
        let mut node = self.nodes.first();
        while let Some(at) = node {
            let distances = point.squared_distances(at);
            let nearest = (1..usize::from(at.used)).fold(0, |a, b| if distances[b] < distances[a] { b } else { a });
            if at.count[nearest] > 0 {
                return at.child[nearest];
            }
            node = self.nodes.get(at.child[nearest] as usize);
        }
        u32::MAX
    }

    /// Visits the leaves whose boxes are nearer than the square root of `squared`, which the visits may lower; `rounding`
    /// is what a squared distance may be off by, beside [`ALLOWANCE`].
    #[inline]
    fn visit(
        &self,
        distances: impl Fn(&Node) -> [f32; 4],
        rounding: f32,
        squared: &mut f64,
        mut visit: impl FnMut(u32, &[Leaf], &mut f64),
    ) {
        // Beyond what f32 holds there are no answers.
        if self.nodes.is_empty() || squared.is_nan() || !rounding.is_finite() {
            return;
        }
        let cut_off = |squared: f64| (squared * ALLOWANCE).min(1e30) as f32 + rounding;
        let mut stack = ArrayVec::<(f32, u32), STACK>::new();
        stack.push((0.0, 0));
        // With room for the children of one node more.
        let mut leaves = [(0.0f32, 0u32, 0u8); BATCH + 4];
        while !stack.is_empty() {
            let limit = cut_off(*squared);
            let mut found = 0;
            while found < BATCH {
                let Some((nearest, child)) = stack.pop() else { break };
                if nearest > limit {
                    continue;
                }
                let node = &self.nodes[child as usize];
                for (lane, nearest) in distances(node).into_iter().enumerate() {
                    let (child, count) = (node.child[lane], node.count[lane]);
                    let (is_near, is_leaf) = (nearest <= limit, count > 0);
                    if is_near & !is_leaf {
                        stack.push((nearest, child));
                    }
                    leaves[found] = (nearest, child, count);
                    found += usize::from(is_near & is_leaf);
                }
            }
            for &(nearest, first, count) in &leaves[..found] {
                if nearest <= cut_off(*squared) {
                    visit(first, &self.leaves[first as usize..first as usize + usize::from(count)], squared);
                }
            }
        }
    }
}

/// The lanes of one to four leaves.
fn mask(leaves: &[Leaf]) -> u32 {
    (1 << leaves.len()) - 1
}

/// Where a segment comes nearest to a triangle.
#[derive(Clone, Copy)]
struct Approach {
    along: f64,
    squared: f64,
    v: f64,
    w: f64,
}

/// Where the inside of a segment comes nearer to a triangle than the square root of `within`, if it does: through the
/// face, or past one of the sides.
fn approach(a: DVec3, b: DVec3, leaf: &Leaf, within: f64) -> Option<Approach> {
    let [p, q, r] = leaf.corners.map(Vec3::as_dvec3);
    let (pq, pr, ab) = (q - p, r - p, b - a);
    let normal = pq.cross(pr);
    let (from, to) = (normal.dot(a - p), normal.dot(b - p));
    let size = normal.length_squared();
    if !leaf.is_sliver {
        let nearest = from.abs().min(to.abs());
        if from * to > 0.0 && nearest * nearest >= within * size {
            return None;
        }
        if from * to <= 0.0 && from != to {
            let along = from / (from - to);
            let offset = a + ab * along - p;
            let (v, w) = (normal.dot(offset.cross(pr)) / size, normal.dot(pq.cross(offset)) / size);
            if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
                return Some(Approach { along, squared: 0.0, v, w }).filter(|_| within > 0.0);
            }
        }
    }
    let mut best: Option<Approach> = None;
    let mut least = within;
    let sides = [(p, pq, 0), (q, r - q, 1), (r, -pr, 2)];
    for (start, side, corner) in sides.into_iter().filter(|side| leaf.sides >> side.2 & 1 > 0) {
        let (along, on, squared) = between(a, ab, start, side);
        if squared < least && along > 0.0 && along < 1.0 {
            least = squared;
            let (v, w) = match corner {
                0 => (on, 0.0),
                1 => (1.0 - on, on),
                _ => (0.0, 1.0 - on),
            };
            best = Some(Approach { along, squared, v, w });
        }
    }
    best
}

/// Where two segments `a + s ab` and `c + t cd` come nearest: `s`, `t` and the squared distance (Ericson, "Real-time
/// collision detection", 2005, section 5.1.9).
fn between(a: DVec3, ab: DVec3, c: DVec3, cd: DVec3) -> (f64, f64, f64) {
    let offset = a - c;
    let (aa, cc, ac) = (ab.length_squared(), cd.length_squared(), ab.dot(cd));
    let (d, e) = (ab.dot(offset), cd.dot(offset));
    let denominator = aa * cc - ac * ac;
    let s = if denominator > 0.0 { ((ac * e - d * cc) / denominator).clamp(0.0, 1.0) } else { 0.5 };
    let t = if cc > 0.0 { ((ac * s + e) / cc).clamp(0.0, 1.0) } else { 0.0 };
    let s = if aa > 0.0 { ((ac * t - d) / aa).clamp(0.0, 1.0) } else { 0.0 };
    (s, t, (offset + ab * s - cd * t).length_squared())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::TriMesh;
    use crate::closest_point::distance_to_triangle;
    use crate::shapes::{icosphere, tube};

    /// The least distance of many points of a segment from all triangles.
    fn sampled(mesh: &TriMesh, a: DVec3, b: DVec3) -> f64 {
        let at = |i: i32| (a + (b - a) * (f64::from(i) / 400.0)).as_vec3();
        let to = |p: Vec3| (0..mesh.triangles.len()).map(move |t| distance_to_triangle(p, mesh.corners(t)));
        (0..=400).flat_map(|i| to(at(i))).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn a_segment_is_as_far_as_its_nearest_point(
            a in prop::array::uniform3(-9.0..9.0), b in prop::array::uniform3(-9.0..9.0), level in 0u32..3,
        ) {
            let (a, b) = (DVec3::from_array(a), DVec3::from_array(b));
            let mesh = icosphere(level, 5.0, Vec3::new(1.0, 0.5, 0.0));
            let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
            let ends = [a, b].map(|p| index.project_point(p, f64::INFINITY, u32::MAX).unwrap().distance);
            for (p, d) in [a, b].into_iter().zip(ends) {
                prop_assert!((d - f64::from(index.nearest(p.as_vec3()).unwrap().distance)).abs() < 1e-5);
            }
            let nearer = index.project_segment(a, b, ends[0].min(ends[1]) - 1e-9);
            let found = nearer.map_or(ends[0].min(ends[1]), |found| found.projection.distance);
            let expected = sampled(&mesh, a, b);
            // Between two samples the distance falls by less than half of their distance.
            prop_assert!(found <= expected + 1e-5, "{found} {expected}");
            prop_assert!(found >= expected - (b - a).length() / 800.0 - 1e-5, "{found} {expected}");
            if let Some(SegmentProjection { along, projection }) = nearer {
                prop_assert!(((a + (b - a) * along).distance(projection.point) - projection.distance).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_chord_inside_a_tube_is_nearest_at_its_ends_and_beside_a_waist_in_its_middle() {
        let straight = tube(64, 100, 40.0, |_| 3.0);
        let index = SurfaceIndex::new(&straight.positions, &straight.triangles);
        let (a, b) = (DVec3::new(-2.7, 0.0, 20.0), DVec3::new(2.7, 0.0, 20.0));
        let end = index.project_point(a, f64::INFINITY, u32::MAX).unwrap().distance;
        assert!(index.project_segment(a, b, end - 1e-6).is_none());
        let waisted = tube(64, 100, 40.0, |z| 3.0 - (-(z - 20.0) * (z - 20.0) / 4.0).exp());
        let index = SurfaceIndex::new(&waisted.positions, &waisted.triangles);
        let found = index.project_segment(DVec3::new(1.5, 0.0, 15.0), DVec3::new(1.5, 0.0, 25.0), 2.0).unwrap();
        assert!((found.along - 0.5).abs() < 0.02 && (found.projection.distance - 0.5).abs() < 0.01, "{found:?}");
    }
}
