//! The nearest point of a surface, by a hierarchy of bounding boxes.
//!
//! The tree is four wide: a node holds the boxes of its four children lane by lane, so that the distances to all four
//! are found at once (Dammertz, Hanika and Keller, "Shallow bounding volume hierarchies for fast SIMD ray tracing
//! of incoherent rays", 2008), and the children are visited nearest first. `index_build.rs` builds it.
//!
//! Boxes are compared in f32 with a margin, triangles in f64 (`closest_point.rs`). Of triangles at the same distance
//! the one of the least number wins, so the answer depends neither on the order of the visit nor on a hint or bound.

use arrayvec::ArrayVec;
use glam::{Vec3, Vec4};

use super::closest_point::{TriangleProjection, closest_point_on_sliver, closest_point_on_triangle};
use super::planes::plane;

/// Room for the nodes still to visit: at most three per level, and one. [`IndexBuild`](super::IndexBuild) makes at most 32 levels, and
/// where two indices are joined there is one more.
pub(super) const STACK: usize = 100;

/// Relative allowance for the rounding of a squared distance to a box in f32.
const BOX_MARGIN: f64 = 1.0 + 1e-6;

/// The nearest point of a surface to a query.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// Number of the triangle in the list the index was built from.
    pub triangle: u32,
    /// The nearest point, in mm.
    pub point: Vec3,
    /// Distance of the query from it in mm.
    pub distance: f32,
    /// Weights of the triangle's corners at the point: each 0 or more, with sum 1.
    pub barycentric: [f32; 3],
    /// A leaf that holds the triangle; which of several depends on the way of the search.
    pub(super) slot: u32,
}

impl PartialEq for Nearest {
    fn eq(&self, other: &Self) -> bool {
        let all = |found: &Self| (found.triangle, found.point, found.distance, found.barycentric);
        all(self) == all(other)
    }
}

/// An index over the triangles of a surface that answers nearest-point queries. It holds its own copy of the corners.
#[derive(Clone, Debug, Default)]
pub struct SurfaceIndex {
    pub(super) nodes: Vec<Node>,
    /// A triangle may stand in several leaves.
    pub(super) leaves: Vec<Leaf>,
    /// The planes of the leaves' triangles, and three of none, so that four can be read from each leaf on; empty until
    /// [`Self::keep_planes`].
    pub(super) planes: Vec<Vec4>,
    pub(super) triangles: usize,
}

/// Four children and their boxes, lane by lane.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    pub(super) min: [Vec4; 3],
    pub(super) max: [Vec4; 3],
    /// First slot of a leaf, or number of a node.
    pub(super) child: [u32; 4],
    /// Triangles of a leaf; 0 for a node.
    pub(super) count: [u8; 4],
    pub(super) used: u8,
}

impl Node {
    pub(super) const EMPTY: Self =
        Self { min: [Vec4::INFINITY; 3], max: [Vec4::NEG_INFINITY; 3], child: [0; 4], count: [0; 4], used: 0 };

    /// Adds a child; `count` is 0 for a node.
    pub(super) fn add(&mut self, min: Vec3, max: Vec3, child: u32, count: u8) {
        let lane = usize::from(self.used);
        for axis in 0..3 {
            self.min[axis][lane] = min[axis];
            self.max[axis][lane] = max[axis];
        }
        self.child[lane] = child;
        self.count[lane] = count;
        self.used += 1;
    }

    /// Squared distances from `p` to the four boxes.
    #[inline]
    pub(super) fn squared_distances(&self, p: &[Vec4; 3]) -> [f32; 4] {
        let gap = |axis: usize| (self.min[axis] - p[axis]).max(p[axis] - self.max[axis]).max(Vec4::ZERO);
        let (x, y, z) = (gap(0), gap(1), gap(2));
        (x * x + y * y + z * z).to_array()
    }
}

/// A triangle as a leaf holds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub(super) corners: [Vec3; 3],
    pub(super) triangle: u32,
    pub(super) is_sliver: bool,
    /// Which sides a segment can come nearest to: bit 0 that from the first corner to the second, and so on.
    pub(super) sides: u8,
}

impl Leaf {
    /// Every side.
    pub(super) const ALL_SIDES: u8 = 0b111;

    #[inline]
    pub(super) fn project_point(&self, p: impl Into<glam::DVec3>) -> TriangleProjection {
        if self.is_sliver {
            closest_point_on_sliver(p, self.corners)
        } else {
            closest_point_on_triangle(p, self.corners)
        }
    }
}

/// The best answer so far.
#[derive(Clone, Copy)]
struct Best {
    projection: TriangleProjection,
    triangle: u32,
    slot: u32,
}

impl Best {
    const NO_SLOT: u32 = u32::MAX;

    /// Nothing yet; only what is at most as far will do.
    fn within(squared: f64) -> Self {
        Self { projection: TriangleProjection { squared, v: 0.0, w: 0.0 }, triangle: u32::MAX, slot: Self::NO_SLOT }
    }

    #[inline]
    fn offer(&mut self, projection: TriangleProjection, triangle: u32, slot: u32) {
        if projection.squared < self.projection.squared
            || (projection.squared == self.projection.squared && triangle < self.triangle)
        {
            *self = Self { projection, triangle, slot };
        }
    }

    #[inline]
    fn cut_off(&self) -> f32 {
        (self.projection.squared * BOX_MARGIN) as f32
    }
}

impl SurfaceIndex {
    /// Number of triangles in the index.
    pub fn len(&self) -> usize {
        self.triangles
    }

    /// Whether there is nothing to be near to.
    pub fn is_empty(&self) -> bool {
        self.leaves.is_empty()
    }

    /// Lets [`Self::project_segment`] look at fewer sides: `sides` has those of the first triangles, bit 0 that from the
    /// first corner to the second, and so on. A side of two triangles is enough in one of them.
    pub fn keep_sides(&mut self, sides: &[u8]) {
        for leaf in &mut self.leaves {
            leaf.sides = sides.get(leaf.triangle as usize).copied().unwrap_or(Leaf::ALL_SIDES);
        }
    }

    /// Lets [`Self::project_point`] and [`Self::project_segment`] look at planes before triangles: sooner where the surface is hollow
    /// about what is asked for, as a lumen is about a wire; 16 bytes a leaf.
    pub fn keep_planes(&mut self) {
        self.planes = self.leaves.iter().map(|leaf| plane(leaf.corners)).chain([Vec4::ZERO; 3]).collect();
    }

    /// Numbers of the triangles, each once, in the order of the tree, in which neighbours are mostly neighbours in space
    /// too.
    pub fn triangles(&self) -> impl Iterator<Item = u32> {
        let count = self.leaves.iter().map(|leaf| leaf.triangle as usize + 1).max().unwrap_or(0);
        let mut is_new = vec![true; count];
        let all = self.leaves.iter().map(|leaf| leaf.triangle);
        all.filter(move |&triangle| std::mem::take(&mut is_new[triangle as usize]))
    }

    /// The nearest point of the surface to `p`; `None` for an empty surface or a query that is not finite.
    pub fn nearest(&self, p: Vec3) -> Option<Nearest> {
        self.answer(self.search(p, Best::within(f64::INFINITY), -1.0, any))
    }

    /// The nearest point of the triangles that `accepts` takes, by their numbers; `None` where there is none, or for a query
    /// that is not finite.
    pub fn nearest_of(&self, p: Vec3, accepts: impl Fn(u32) -> bool) -> Option<Nearest> {
        self.answer(self.search(p, Best::within(f64::INFINITY), -1.0, accepts))
    }

    /// The same answer as [`Self::nearest`], found sooner when `p` is near an earlier query whose answer was `last`.
    /// Any answer will do, from another index too.
    pub fn nearest_from(&self, p: Vec3, last: &Nearest) -> Option<Nearest> {
        let mut best = Best::within(f64::INFINITY);
        if let Some(leaf) = self.leaves.get(last.slot as usize) {
            best.offer(leaf.project_point(p), leaf.triangle, last.slot);
        }
        self.answer(self.search(p, best, -1.0, any))
    }

    /// The nearest point of the surface to `p` if it is at most `distance` mm away: for an upper bound that is known,
    /// or where what is farther does not matter.
    pub fn nearest_within(&self, p: Vec3, distance: f32) -> Option<Nearest> {
        self.answer(self.search(p, bounded(distance)?, -1.0, any))
    }

    /// Whether some point of the surface is at most `distance` mm from `p`. Ends at the first one found.
    pub fn is_within(&self, p: Vec3, distance: f32) -> bool {
        bounded(distance)
            .is_some_and(|bound| self.search(p, bound, bound.projection.squared, any).slot != Best::NO_SLOT)
    }

    /// The same answer as [`Self::is_within`], found sooner when `p` is near an earlier query: `last` says where that
    /// ended, and then where this one did. It may begin with any number.
    pub fn is_within_from(&self, p: Vec3, distance: f32, last: &mut u32) -> bool {
        let Some(bound) = bounded(distance) else { return false };
        let enough = bound.projection.squared;
        let is_there = |leaf: &Leaf| p.is_finite() && leaf.project_point(p).squared <= enough;
        if self.leaves.get(*last as usize).is_some_and(is_there) {
            return true;
        }
        let found = self.search(p, bound, enough, any).slot;
        *last = found;
        found != Best::NO_SLOT
    }

    /// Lowers `best` to the nearest triangle that `accepts` takes, or stops at one whose squared distance is at most `enough`.
    fn search(&self, p: Vec3, mut best: Best, enough: f64, accepts: impl Fn(u32) -> bool) -> Best {
        if self.nodes.is_empty() || !p.is_finite() {
            return Best::within(0.0);
        }
        let lanes = [Vec4::splat(p.x), Vec4::splat(p.y), Vec4::splat(p.z)];
        let mut cut_off = best.cut_off();
        // Squared distance, child and count of what is still to visit, the nearest on top.
        let mut stack = ArrayVec::<(f32, u32, u8), STACK>::new();
        stack.push((0.0, 0, 0));
        while let Some((squared, child, count)) = stack.pop() {
            if squared > cut_off {
                continue;
            }
            if count > 0 {
                for slot in child..child + u32::from(count) {
                    let leaf = &self.leaves[slot as usize];
                    if accepts(leaf.triangle) {
                        best.offer(leaf.project_point(p), leaf.triangle, slot);
                    }
                }
                if best.projection.squared <= enough && best.slot != Best::NO_SLOT {
                    return best;
                }
                cut_off = best.cut_off();
                continue;
            }
            let node = &self.nodes[child as usize];
            let distances = node.squared_distances(&lanes);
            let bottom = stack.len();
            for (lane, &squared) in distances.iter().enumerate().take(usize::from(node.used)) {
                if squared <= cut_off {
                    let child = (squared, node.child[lane], node.count[lane]);
                    let mut at = stack.len();
                    stack.push(child);
                    while at > bottom && stack[at - 1].0 < squared {
                        stack[at] = stack[at - 1];
                        at -= 1;
                    }
                    stack[at] = child;
                }
            }
        }
        best
    }

    fn answer(&self, best: Best) -> Option<Nearest> {
        let leaf = self.leaves.get(best.slot as usize)?;
        let [a, b, c] = leaf.corners.map(Vec3::as_dvec3);
        let TriangleProjection { squared, v, w } = best.projection;
        let u = (1.0 - v - w).max(0.0);
        Some(Nearest {
            triangle: leaf.triangle,
            point: (a + (b - a) * v + (c - a) * w).as_vec3(),
            distance: squared.sqrt() as f32,
            barycentric: [u as f32, v as f32, w as f32],
            slot: best.slot,
        })
    }
}

/// Takes every triangle.
fn any(_: u32) -> bool {
    true
}

/// A search that accepts at most `distance`; `None` when that is negative or no number.
fn bounded(distance: f32) -> Option<Best> {
    (distance >= 0.0).then(|| Best::within(f64::from(distance) * f64::from(distance)))
}

#[cfg(test)]
mod tests {
    use std::task::Poll;

    use proptest::prelude::*;

    use super::*;
    use crate::closest_point::is_sliver;
    use crate::shapes::{icosphere, sagitta, square};
    use crate::{IndexBuild, TriMesh};

    fn index(mesh: &TriMesh) -> SurfaceIndex {
        SurfaceIndex::new(&mesh.positions, &mesh.triangles)
    }

    /// The least distance over all triangles, one by one.
    fn brute_force(mesh: &TriMesh, p: Vec3) -> (f64, u32) {
        let all = (0..mesh.triangles.len()).map(|t| {
            let corners = mesh.corners(t);
            let projection = if is_sliver(corners) {
                closest_point_on_sliver(p, corners)
            } else {
                closest_point_on_triangle(p, corners)
            };
            (projection.squared, t as u32)
        });
        all.fold((f64::INFINITY, u32::MAX), |least, next| if next.0 < least.0 { next } else { least })
    }

    /// Points spread over a cube around the origin by a fixed sequence.
    fn cloud(count: u32, half: f32) -> impl Iterator<Item = Vec3> {
        let part = |i: u32, step: u32| (i.wrapping_mul(step) >> 8) as f32 / (1 << 24) as f32 * 2.0 - 1.0;
        (1..=count)
            .map(move |i| Vec3::new(part(i, 3_518_319_155), part(i, 2_882_110_345), part(i, 2_360_945_575)) * half)
    }

    #[test]
    fn nothing_is_nearest_on_an_empty_surface_or_to_no_point() {
        let empty = SurfaceIndex::new(&[Vec3::ZERO], &[]);
        assert!(empty.is_empty() && empty.nearest(Vec3::ZERO).is_none() && !empty.is_within(Vec3::ZERO, f32::INFINITY));
        let plane = index(&square(3, 3.0, 0.0));
        for bad in [f32::NAN, f32::INFINITY] {
            assert_eq!(plane.nearest(Vec3::new(0.0, bad, 0.0)), None);
            assert!(!plane.is_within(Vec3::splat(bad), 1.0));
            assert_eq!(plane.nearest_of(Vec3::splat(bad), |_| true), None);
        }
        assert_eq!(plane.nearest_within(Vec3::Z, f32::NAN), None);
        assert_eq!(plane.nearest_within(Vec3::Z, -1.0), None);
        let mut broken = square(1, 1.0, 0.0);
        broken.positions[1].x = f32::NAN;
        assert_eq!(index(&broken).len(), 1);
    }

    #[test]
    fn over_a_plane_the_distance_is_the_height() {
        let plane = index(&square(50, 10.0, 2.0));
        for p in cloud(2000, 5.0) {
            let p = p + Vec3::new(5.0, 5.0, 0.0);
            let found = plane.nearest(p).unwrap();
            assert_eq!(found.distance, (p.z - 2.0).abs());
            assert!(found.point.distance(Vec3::new(p.x, p.y, 2.0)) < 2e-6);
        }
    }

    #[test]
    fn around_a_sphere_the_distance_is_that_to_the_radius_within_the_sagitta() {
        let centre = Vec3::new(100.0, -200.0, 300.0);
        let sphere = icosphere(4, 20.0, centre);
        let (index, sagitta) = (index(&sphere), sagitta(&sphere, 20.0, centre));
        for offset in cloud(4000, 40.0) {
            let found = index.nearest(centre + offset).unwrap();
            assert!((found.distance - (offset.length() - 20.0).abs()).abs() <= sagitta + 1e-4, "{offset}: {found:?}");
            let [a, b, c] = sphere.corners(found.triangle as usize);
            let [u, v, w] = found.barycentric;
            assert!((a * u + b * v + c * w).distance(found.point) < 1e-4);
            assert!(u >= 0.0 && v >= 0.0 && w >= 0.0 && (u + v + w - 1.0).abs() < 1e-6);
            assert!((found.point.distance(centre + offset) - found.distance).abs() < 1e-4);
        }
    }

    #[test]
    fn hints_and_bounds_change_nothing() {
        let index = index(&icosphere(3, 10.0, Vec3::ZERO));
        let (mut last, mut at) = (index.nearest(Vec3::X).unwrap(), u32::MAX);
        for p in cloud(3000, 15.0) {
            let plain = index.nearest(p).unwrap();
            last = index.nearest_from(p, &last).unwrap();
            assert_eq!(last, plain);
            assert_eq!(index.nearest_within(p, plain.distance * 1.001), Some(plain));
            assert_eq!(index.nearest_within(p, plain.distance * 0.999), None);
            for (part, is_near) in [(1.001, true), (0.999, false)] {
                assert_eq!(index.is_within(p, plain.distance * part), is_near);
                assert_eq!(index.is_within_from(p, plain.distance * part, &mut at), is_near);
            }
        }
        let other = SurfaceIndex::new(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]]);
        assert_eq!(other.nearest_from(Vec3::Z, &last), other.nearest(Vec3::Z));
    }

    #[test]
    fn among_slivers_strays_and_what_is_no_number_the_nearest_is_found() {
        let mut mesh = square(60, 60.0, 0.0);
        let first = mesh.positions.len() as u32;
        for i in 0..200 {
            let (x, z) = (i as f32 * 0.3, 1.0 + 0.01 * i as f32);
            mesh.positions.extend([Vec3::new(x, 0.0, z), Vec3::new(60.0 - x, 60.0, z), Vec3::new(x, 0.01, z)]);
        }
        mesh.positions.extend([Vec3::NAN, Vec3::splat(1e4), Vec3::splat(1.1e4), Vec3::new(1e4, 1.1e4, 0.0)]);
        mesh.triangles.extend((0..200).map(|i| [0, 1, 2].map(|k| first + 3 * i + k)));
        mesh.triangles.extend([[first + 600, 0, 1], [first + 601, first + 602, first + 603]]);
        let found = index(&mesh);
        assert!(found.len() == mesh.triangles.len() - 1 && found.slots() > mesh.triangles.len() + 200);
        mesh.triangles.retain(|triangle| !triangle.contains(&(first + 600)));
        for p in cloud(400, 40.0).map(|p| p + Vec3::new(30.0, 30.0, 1.5)).chain([Vec3::splat(9e3)]) {
            let (squared, _) = brute_force(&mesh, p);
            let distance = f64::from(found.nearest(p).unwrap().distance);
            assert!((distance - squared.sqrt()).abs() <= 1e-6 * squared.sqrt().max(1.0), "{p}");
        }
    }

    #[test]
    fn slices_of_any_size_build_the_same_index() {
        let mesh = icosphere(4, 10.0, Vec3::ONE);
        let whole = index(&mesh);
        for work in [1, 7, 1000] {
            let mut build = IndexBuild::new();
            let mut fraction = 0.0;
            let sliced = loop {
                match build.advance(&mesh.positions, &mesh.triangles, work) {
                    Poll::Ready(index) => break index,
                    Poll::Pending => assert!(build.fraction() >= fraction && build.fraction() <= 1.0),
                }
                fraction = build.fraction();
            };
            assert_eq!(format!("{sliced:?}"), format!("{whole:?}"));
        }
    }

    #[test]
    fn a_heap_of_coincident_or_hugely_spread_triangles_stays_shallow() {
        let mut positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let mut triangles = vec![[0, 1, 2]; 5000];
        for power in -140..125 {
            let x = (f64::from(power)).exp2() as f32;
            positions.push(Vec3::new(x, 0.0, 0.0));
            let v = positions.len() as u32 - 1;
            triangles.extend([[v, v, v]; 40]);
        }
        let mesh = TriMesh { positions, triangles };
        let index = index(&mesh);
        for p in [Vec3::ZERO, Vec3::ONE, Vec3::new(1e-30, 1.0, -3.0), Vec3::splat(1e30), Vec3::X * -1e10] {
            let found = index.nearest(p).unwrap();
            let (squared, triangle) = brute_force(&mesh, p);
            assert_eq!((found.distance, found.triangle), (squared.sqrt() as f32, triangle), "{p}");
        }
    }

    /// Coordinates on a coarse lattice, so that degenerate and coincident triangles are common.
    fn soup() -> impl Strategy<Value = TriMesh> {
        let coordinate = prop_oneof![(-4i8..=4).prop_map(f32::from), -4.0f32..4.0];
        let positions = prop::collection::vec(prop::array::uniform3(coordinate).prop_map(Vec3::from), 3..40);
        positions.prop_flat_map(|positions| {
            let count = positions.len() as u32;
            let triangles = prop::collection::vec(prop::array::uniform3(0..count), 1..200);
            triangles.prop_map(move |triangles| TriMesh { positions: positions.clone(), triangles })
        })
    }

    /// A cap of `count` slivers around its middle, tilted against the axes.
    fn fan(count: u32) -> TriMesh {
        let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.5, 0.8, 0.3);
        let rim = (0..count).map(|i| {
            let angle = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
            turn * Vec3::new(libm::cos(angle) as f32, libm::sin(angle) as f32, 0.0) * 20.0
        });
        let positions = std::iter::once(Vec3::ZERO).chain(rim).collect();
        TriMesh { positions, triangles: (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect() }
    }

    #[test]
    fn in_a_fan_of_thousands_of_slivers_the_answer_is_right_and_few_boxes_overlap() {
        let mesh = fan(4000);
        let index = index(&mesh);
        assert_eq!(index.len(), 4000);
        let normal = mesh.corners(0)[1].cross(mesh.corners(1000)[1]).normalize();
        let mut overlapping = 0;
        for offset in cloud(200, 12.0) {
            let p = offset + normal * (1.0 - offset.dot(normal));
            let found = index.nearest(p).unwrap();
            assert!((found.distance - 1.0).abs() < 1e-4, "{p}: {found:?}");
            let (squared, _) = brute_force(&mesh, p);
            assert_eq!(found.distance, squared.sqrt() as f32);
            let lanes = found.point.to_array().map(Vec4::splat);
            let children = index.nodes.iter().flat_map(|node| {
                node.squared_distances(&lanes).into_iter().zip(node.count).filter(|(squared, _)| *squared == 0.0)
            });
            overlapping += children.map(|(_, count)| usize::from(count)).sum::<usize>();
        }
        // Without cutting, a point lies in the boxes of some 600 of the slivers.
        assert!(overlapping / 200 < 150, "{}", overlapping / 200);
    }

    proptest! {
        #[test]
        fn the_answer_is_that_of_trying_every_triangle(mesh in soup(), p in prop::array::uniform3(-8.0f32..8.0)) {
            let p = Vec3::from(p);
            let found = index(&mesh).nearest(p).unwrap();
            let (squared, triangle) = brute_force(&mesh, p);
            prop_assert_eq!(found.distance, squared.sqrt() as f32);
            prop_assert_eq!(found.triangle, triangle);
        }

        #[test]
        fn of_some_triangles_the_answer_is_that_of_a_surface_of_them_alone(
            mesh in soup(),
            p in prop::array::uniform3(-8.0f32..8.0),
        ) {
            let p = Vec3::from(p);
            let odd = mesh.triangles.iter().skip(1).step_by(2).copied().collect();
            let alone = TriMesh { positions: mesh.positions.clone(), triangles: odd };
            let found = index(&mesh).nearest_of(p, |t| t % 2 == 1).map(|found| (found.distance, found.triangle / 2));
            prop_assert_eq!(found, index(&alone).nearest(p).map(|found| (found.distance, found.triangle)));
        }
    }
}
