//! The triangles of a surface that run into others, found with the hierarchy of boxes of a [`SurfaceIndex`].
//!
//! What counts is said in `crossing.rs`; it is MeshLab's definition. Where the surface is smooth, hundreds of pairs are
//! answered at once by a patch that cannot run into itself (`patch.rs`).

use std::cmp::Ordering::{Equal, Greater, Less};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use arrayvec::ArrayVec;
use glam::{Vec3, Vec4};

use super::TriMesh;
use super::branches::{Branch, Branches};
use super::crossing::{Face, cross, touch};
use super::high_valence::{HighValenceVertices, half_way_box};
use super::nearest::{Leaf, Node, STACK, SurfaceIndex};
use super::patch::{Extent, Patch};
use super::topology::Topology;
use crate::parallel;

/// Slots that are searched in one piece.
const PIECE: usize = 1024;
/// Triangles in a branch, at most: for so many a patch is sought at first, and for its parts where there is none.
const GROUP: usize = 256;
/// Fewer triangles are looked at one by one.
const FEWEST: usize = 8;

/// The triangles of `mesh` that run into another one, ascending. Triangles with a coordinate that is not finite run
/// into nothing.
pub fn self_intersections(mesh: &TriMesh) -> Vec<u32> {
    let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
    // What repeats a vertex has no adjacency.
    let is_sound = mesh.triangles.iter().all(|[a, b, c]| a != b && b != c && c != a);
    let topology = is_sound.then(|| Topology::new(mesh.positions.len(), &mesh.triangles));
    self_intersections_in(mesh, &index, topology.as_ref())
}

/// As [`self_intersections`]; `index` and `topology` must be those of `mesh`.
pub fn self_intersections_in(mesh: &TriMesh, index: &SurfaceIndex, topology: Option<&Topology>) -> Vec<u32> {
    marked(mesh, index, topology, &Crossing::none(index, &mesh.triangles))
}

/// As [`self_intersections_in`], of triangles that [`touch`] another: what a volume mesher refuses.
pub fn touching_in(mesh: &TriMesh, index: &SurfaceIndex, topology: Option<&Topology>) -> Vec<u32> {
    marked(mesh, index, topology, &Crossing { is_exact: true, ..Crossing::none(index, &mesh.triangles) })
}

fn marked(mesh: &TriMesh, index: &SurfaceIndex, topology: Option<&Topology>, crossing: &Crossing) -> Vec<u32> {
    let surface = Indexed { mesh, topology };
    parallel::map_ranges(index.slots(), PIECE, |slots| index.mark_crossings(surface, slots, crossing));
    crossing.triangles().collect()
}

/// Which triangles run into another: a flag each, so that a surface that runs into itself everywhere takes no more room.
/// What is marked does not depend on the order of the marking.
#[derive(Debug, Default)]
pub struct Crossing {
    does: Vec<AtomicBool>,
    /// Whether a triangle was looked at: a sliver stands in several slots.
    was_asked: Vec<AtomicBool>,
    /// The search goes from one to the next.
    branches: Branches,
    high_valence: HighValenceVertices,
    /// Whether what only touches counts.
    is_exact: bool,
}

impl Crossing {
    /// None yet of the triangles of `index`.
    pub fn none(index: &SurfaceIndex, triangles: &[[u32; 3]]) -> Self {
        let none = || (0..triangles.len()).map(|_| AtomicBool::new(false)).collect();
        let branches = Branches::of(index, GROUP);
        let high_valence = HighValenceVertices::of(index, triangles);
        Self { does: none(), was_asked: none(), branches, high_valence, is_exact: false }
    }

    /// Those that do, ascending.
    pub fn triangles(&self) -> impl Iterator<Item = u32> + '_ {
        (0..).zip(&self.does).filter(|(_, flag)| flag.load(Ordering::Relaxed)).map(|(t, _)| t)
    }

    fn has(&self, triangle: u32) -> bool {
        self.does[triangle as usize].load(Ordering::Relaxed)
    }

    /// Whether this is the first time that `triangle` is asked for.
    fn is_new(&self, triangle: u32) -> bool {
        !self.was_asked[triangle as usize].swap(true, Ordering::Relaxed)
    }

    fn mark(&self, triangle: u32) {
        self.does[triangle as usize].store(true, Ordering::Relaxed);
    }
}

/// The surface that an index is of.
#[derive(Clone, Copy, Debug)]
pub struct Indexed<'a> {
    /// The surface.
    pub mesh: &'a TriMesh,
    /// Its adjacency: with it a smooth surface is searched several times faster.
    pub topology: Option<&'a Topology>,
}

/// A search for crossings at work.
struct Search<'a> {
    index: &'a SurfaceIndex,
    surface: Indexed<'a>,
    crossing: &'a Crossing,
    patch: Patch,
    /// How many triangles were looked at.
    looks: usize,
}

impl Search<'_> {
    /// Marks what triangles of a branch run into, and them; they stand in the slots `new`, ascending: all at once where they
    /// lie in a patch that cannot run into itself, else in its parts and at last one by one.
    fn mark_branch(&mut self, branch: &Branch, new: &[u32]) {
        let Indexed { mesh: TriMesh { positions, triangles }, topology } = self.surface;
        let (index, crossing) = (self.index, self.crossing);
        let leaves = new.iter().map(|&slot| &index.leaves[slot as usize]);
        let (Some(topology), Some(node)) = (topology.filter(|_| new.len() >= FEWEST), branch.node) else {
            leaves.for_each(|leaf| self.mark_one(leaf));
            return;
        };
        self.looks += new.len();
        let extent = Extent::of(leaves.clone());
        if self.patch.certify(leaves.clone(), &extent, positions, triangles, topology) {
            // Where all of the branch is certified, nothing in it is looked at again.
            let certified = (new.len() == branch.slots.len()).then_some(node);
            self.mark_away(&leaves, &extent, certified);
            return;
        }
        for part in crossing.branches.below(index, node) {
            let [start, end] = [part.slots.start, part.slots.end].map(|slot| new.partition_point(|&new| new < slot));
            self.mark_branch(&part, &new[start..end]);
        }
    }

    /// Marks what triangles run into outside of their patch, which has all that is below the node `certified`.
    fn mark_away<'b>(
        &mut self,
        leaves: &(impl Iterator<Item = &'b Leaf> + Clone),
        extent: &Extent,
        certified: Option<u32>,
    ) {
        let Self { index, surface, crossing, patch, looks } = self;
        index.overlapping(
            extent.min,
            extent.max,
            |node, lanes| if certified == Some(node) { 0 } else { lanes },
            |slots| {
                for other in &index.leaves[slots] {
                    *looks += 1;
                    if patch.has(surface.mesh.triangles[other.triangle as usize]) || patch.is_away(other.corners) {
                        continue;
                    }
                    for leaf in leaves.clone().filter(|leaf| other.triangle > leaf.triangle) {
                        *looks += 1;
                        mark_pair(surface.mesh, leaf, other, crossing);
                    }
                }
            },
        );
    }

    /// Marks what a triangle runs into, and itself.
    fn mark_one(&mut self, leaf: &Leaf) {
        let Self { index, surface, crossing, looks, .. } = self;
        let triangles = &surface.mesh.triangles;
        let [a, b, c] = leaf.corners;
        let vertices = triangles[leaf.triangle as usize];
        let mut look = |other: &Leaf| {
            *looks += 1;
            mark_pair(surface.mesh, leaf, other, crossing);
        };
        let high_valence = &crossing.high_valence;
        let of_no_hub_of_ours = |node, lanes: u32| lanes & !high_valence.shared(node, vertices);
        index.overlapping(a.min(b).min(c), a.max(b).max(c), of_no_hub_of_ours, |slots| {
            index.leaves[slots].iter().filter(|other| other.triangle > leaf.triangle).for_each(&mut look);
        });
        for corner in high_valence.corners(vertices) {
            let (min, max) = half_way_box(leaf.corners, corner);
            // What lacks the hub was found above, or finds this one.
            let is_of_it = |other: &&Leaf| triangles[other.triangle as usize].contains(&vertices[corner]);
            index.overlapping(
                min,
                max,
                |_, lanes| lanes,
                |slots| {
                    index.leaves[slots].iter().filter(is_of_it).for_each(&mut look);
                },
            );
        }
    }
}

/// Marks two triangles where they run into each other; their order does not matter.
fn mark_pair(mesh: &TriMesh, leaf: &Leaf, other: &Leaf, crossing: &Crossing) {
    if crossing.has(leaf.triangle) && crossing.has(other.triangle) {
        return;
    }
    let [face, other_face] =
        [leaf, other].map(|leaf| Face { vertices: mesh.triangles[leaf.triangle as usize], corners: leaf.corners });
    // By name, so that the plain question is answered in place.
    let meet = |a: &Face, b: &Face| if crossing.is_exact { touch(a, b) } else { cross(a, b) };
    let meets = match leaf.triangle.cmp(&other.triangle) {
        Less => meet(&face, &other_face),
        Equal => false,
        Greater => meet(&other_face, &face),
    };
    if meets {
        crossing.mark(leaf.triangle);
        crossing.mark(other.triangle);
    }
}

impl SurfaceIndex {
    /// The number of places that [`Self::mark_crossings`] can be asked about.
    pub fn slots(&self) -> usize {
        self.leaves.len()
    }

    /// Marks the triangles of `surface`, which this is the index of, that run into one another, where one of them is in
    /// `slots` and in no slot before; returns how many were looked at, about.
    pub fn mark_crossings(&self, surface: Indexed, slots: Range<usize>, crossing: &Crossing) -> usize {
        let mut search = Search { index: self, surface, crossing, patch: Patch::new(), looks: 0 };
        let mut new = Vec::with_capacity(GROUP);
        for (branch, slots) in crossing.branches.within(slots) {
            new.clear();
            new.extend(slots.filter(|&slot| crossing.is_new(self.leaves[slot as usize].triangle)));
            search.mark_branch(branch, &new);
        }
        search.looks
    }

    /// Calls `each` with the triangles that may come near the box from `min` to `max`, some more than once.
    pub fn for_each_near(&self, min: Vec3, max: Vec3, mut each: impl FnMut(u32)) {
        self.overlapping(
            min,
            max,
            |_, lanes| lanes,
            |slots| self.leaves[slots].iter().for_each(|leaf| each(leaf.triangle)),
        );
    }

    /// Visits the leaves whose boxes overlap the one from `min` to `max`, by those lanes of each node that `keep` leaves of
    /// the overlapping ones.
    fn overlapping(&self, min: Vec3, max: Vec3, keep: impl Fn(u32, u32) -> u32, mut visit: impl FnMut(Range<usize>)) {
        let (low, high) = (min.to_array().map(Vec4::splat), max.to_array().map(Vec4::splat));
        let mut stack = ArrayVec::<u32, STACK>::new();
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(number) = stack.pop() {
            let node = &self.nodes[number as usize];
            let mut lanes = keep(number, node.overlaps(&low, &high));
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let (child, count) = (node.child[lane], node.count[lane]);
                if count > 0 {
                    visit(child as usize..child as usize + usize::from(count));
                } else {
                    stack.push(child);
                }
            }
        }
    }
}

impl Node {
    /// A bit for each child whose box overlaps the given one.
    #[inline]
    fn overlaps(&self, low: &[Vec4; 3], high: &[Vec4; 3]) -> u32 {
        let apart = |axis: usize| self.min[axis].cmpgt(high[axis]) | self.max[axis].cmplt(low[axis]);
        let lanes = !(apart(0) | apart(1) | apart(2));
        // The box of a lane that is not used is empty.
        lanes.bitmask() & ((1 << self.used) - 1)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::shapes::{icosphere, joined, square};
    use crate::split_mix::SplitMix64;

    /// Sorts and drops what is there twice.
    fn distinct(mut faces: Vec<u32>) -> Vec<u32> {
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// Pair by pair.
    fn one_by_one(mesh: &TriMesh) -> Vec<u32> {
        pairs_that(cross, mesh)
    }

    fn pairs_that(meet: impl Fn(&Face, &Face) -> bool, mesh: &TriMesh) -> Vec<u32> {
        let face = |t: usize| Face { vertices: mesh.triangles[t], corners: mesh.corners(t) };
        let count = mesh.triangles.len();
        let pairs = (0..count).flat_map(|s| (s + 1..count).map(move |t| (s, t)));
        let crossing = pairs.filter(|&(s, t)| meet(&face(s), &face(t)));
        distinct(crossing.flat_map(|(s, t)| [s as u32, t as u32]).collect())
    }

    #[test]
    fn a_sphere_a_plane_and_nothing_do_not_run_into_themselves() {
        for mesh in [icosphere(4, 10.0, Vec3::ONE), square(20, 5.0, 1.0), TriMesh::default()] {
            assert!(self_intersections(&mesh).is_empty());
        }
    }

    #[test]
    fn two_spheres_run_into_each_other_along_their_common_circle() {
        let [a, b] = [Vec3::ZERO, Vec3::new(9.0, 1.0, 2.0)].map(|centre| icosphere(4, 8.0, centre));
        let both = joined(&[a, b]);
        let found = self_intersections(&both);
        assert_eq!(found, one_by_one(&both));
        assert!(found.len() > 60, "{}", found.len());
        // Each lies near the plane of the circle, in which points are as far from either centre.
        for &t in &found {
            let corner = both.corners(t as usize)[0];
            let [near, far] = [Vec3::ZERO, Vec3::new(9.0, 1.0, 2.0)].map(|centre| corner.distance(centre));
            assert!((near - far).abs() < 1.5, "{corner}");
        }
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let both = joined(&[icosphere(5, 8.0, Vec3::ZERO), icosphere(5, 8.0, Vec3::new(3.0, 4.0, 5.0))]);
        let alone = parallel::with_threads(1, || self_intersections(&both));
        for threads in [2, 7] {
            assert_eq!(parallel::with_threads(threads, || self_intersections(&both)), alone);
        }
    }

    #[test]
    fn broken_triangles_end_no_search() {
        let mut mesh = joined(&[icosphere(2, 8.0, Vec3::ZERO), icosphere(2, 8.0, Vec3::ONE)]);
        mesh.positions[3].y = f32::NAN;
        mesh.positions[7].z = f32::INFINITY;
        mesh.triangles.extend([[1, 1, 2], [4, 4, 4]]);
        assert!(!self_intersections(&mesh).is_empty());
    }

    /// Thousands of triangles over vertices of a box: half of all pairs overlap.
    #[test]
    fn triangles_that_all_run_into_each_other_take_a_flag_each() {
        let mut random = SplitMix64::new(1);
        let mut next = || (random.bits() >> 40) as u32;
        let positions: Vec<Vec3> =
            (0..2000).map(|_| Vec3::from([next(), next(), next()].map(|x| x as f32 * 1e-6))).collect();
        let triangles = (0..2000).map(|_| [next() % 2000, next() % 2000, next() % 2000]);
        let whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let mesh = TriMesh { positions, triangles: triangles.filter(whole).collect() };
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let crossing = Crossing::none(&index, &mesh.triangles);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let surface = Indexed { mesh: &mesh, topology: Some(&topology) };
        let looks: Vec<usize> =
            (0..index.slots()).map(|slot| index.mark_crossings(surface, slot..slot + 1, &crossing)).collect();
        assert!(looks.iter().all(|&looks| looks <= index.slots()));
        assert_eq!(crossing.triangles().collect::<Vec<_>>(), one_by_one(&mesh));
        assert!(crossing.triangles().count() > 1900);
    }

    /// Cones of `sides` triangles around one vertex, some of which stand in each other.
    fn cones(sides: u32) -> TriMesh {
        let mut mesh = TriMesh { positions: vec![Vec3::new(0.3, 0.2, 0.1)], triangles: Vec::new() };
        for (lean, tall) in [(0.4, 3.0), (0.55, 2.0), (3.0, 2.5)] {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend((0..sides).map(|i| {
                let angle = f64::from(i) / f64::from(sides) * std::f64::consts::TAU;
                let (x, y) = (libm::cos(angle) as f32, libm::sin(angle) as f32);
                // The middle cone leans to a side and so goes through the first.
                Vec3::new(lean * tall * x + if lean == 0.55 { 0.7 } else { 0.0 }, lean * tall * y, tall)
            }));
            mesh.triangles.extend((0..sides).map(|i| [0, first + i, first + (i + 1) % sides]));
        }
        // The same triangle a second time.
        mesh.triangles.push(mesh.triangles[5]);
        mesh
    }

    #[test]
    fn of_the_triangles_of_a_hub_those_that_run_into_each_other_are_found() {
        for sides in [30, 100, 300] {
            let mesh = cones(sides);
            let found = self_intersections(&mesh);
            assert_eq!(found, one_by_one(&mesh), "{sides}");
            assert!(found.len() > 4 && found.len() < mesh.triangles.len() / 2, "{sides}: {}", found.len());
        }
    }

    #[test]
    fn a_hub_of_a_hundred_thousand_triangles_is_not_asked_for_each_pair() {
        let sides = 100_000;
        let mesh = cones(sides / 3);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let crossing = Crossing::none(&index, &mesh.triangles);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let surface = Indexed { mesh: &mesh, topology: Some(&topology) };
        let looks = index.mark_crossings(surface, 0..index.slots(), &crossing);
        assert!(looks < 2000 * mesh.triangles.len(), "{looks}");
    }

    fn soup() -> impl Strategy<Value = TriMesh> {
        let positions = prop::collection::vec(prop::array::uniform3(-4.0f32..4.0).prop_map(Vec3::from), 6..30);
        positions.prop_flat_map(|positions| {
            let count = positions.len() as u32;
            let triangles = prop::collection::vec(prop::array::uniform3(0..count), 1..60);
            triangles.prop_map(move |triangles| {
                let whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
                TriMesh { positions: positions.clone(), triangles: triangles.into_iter().filter(whole).collect() }
            })
        })
    }

    /// Triangles around one of two hubs, over both, and over none; some twice, some thin.
    fn two_hubs() -> impl Strategy<Value = TriMesh> {
        let positions = prop::collection::vec(prop::array::uniform3(-4.0f32..4.0).prop_map(Vec3::from), 8..24);
        positions.prop_flat_map(|positions| {
            let count = positions.len() as u32;
            let triangle = (0u32..4, prop::array::uniform3(2..count)).prop_map(|(kind, [a, b, c])| match kind {
                0 => [0, a, b],
                1 => [1, b, c],
                2 => [0, 1, a],
                _ => [a, b, c],
            });
            prop::collection::vec(triangle, 20..120).prop_map(move |triangles| {
                let whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
                let mut triangles: Vec<_> = triangles.into_iter().filter(whole).collect();
                triangles.extend_from_within(..triangles.len() / 9);
                let mut positions = positions.clone();
                // The hubs near each other, so that triangles over both are slivers.
                positions[1] = positions[0] + Vec3::new(0.01, 0.002, 0.003);
                TriMesh { positions, triangles }
            })
        })
    }

    proptest! {
        #[test]
        fn the_boxes_miss_no_pair(mesh in soup()) {
            prop_assert_eq!(self_intersections(&mesh), one_by_one(&mesh));
        }

        #[test]
        fn around_two_hubs_no_pair_is_missed(mesh in two_hubs()) {
            prop_assert_eq!(self_intersections(&mesh), one_by_one(&mesh));
        }

        /// Rounded to a grid, much touches without crossing.
        #[test]
        fn of_what_only_touches_no_pair_is_missed(mesh in prop_oneof![soup(), two_hubs()], grid in 0.25f32..2.0) {
            let mut mesh = mesh;
            mesh.positions.iter_mut().for_each(|p| *p = (*p / grid).round() * grid);
            let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
            prop_assert_eq!(touching_in(&mesh, &index, None), pairs_that(touch, &mesh));
        }

        /// Halving all lengths and exchanging the axes is exact in floating point.
        #[test]
        fn the_order_of_triangles_axes_and_scale_do_not_matter(mesh in soup(), turn in 0usize..50) {
            let count = self_intersections(&mesh).len();
            let mut moved = mesh.clone();
            moved.positions.iter_mut().for_each(|p| *p = Vec3::new(p.y, p.z, p.x) * 2.0);
            let turn = turn % moved.triangles.len().max(1);
            moved.triangles.rotate_left(turn);
            moved.triangles.reverse();
            prop_assert_eq!(self_intersections(&moved).len(), count);
        }
    }
}
