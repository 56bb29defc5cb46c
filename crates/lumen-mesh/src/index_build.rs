//! Builds a [`SurfaceIndex`] in slices.
//!
//! Top-down by the surface-area heuristic over at most 16 bins of the longest axis of the centroids' box (Wald, "On fast
//! construction of SAH-based bounding volume hierarchies", 2007). Two binary splits make one four-wide node. Where the
//! bins cannot separate the centroids, or a branch has grown too deep, the range is split at its median instead, which
//! bounds the depth for any input.
//!
//! Slivers have several boxes (`split_boxes.rs`).
//!
//! The result does not depend on how the work was sliced.

use std::sync::Arc;
use std::task::Poll;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec3A, Vec4};

use super::TriMesh;
use super::closest_point::is_sliver;
use super::nearest::{Leaf, Node, SurfaceIndex};
use super::split_boxes::boxes;
use crate::task::Yielder;

/// Most triangles in a leaf.
const LEAF: usize = 4;
/// Units of work between two looks at the clock.
const WORK: usize = 8192;
const BINS: usize = 16;
/// Binary splits above a range after which it is only halved.
const DEEP: u8 = 32;
/// What a split costs beside its triangles, in triangles.
const SPLIT_COST: usize = 16;

/// An index that is being built.
///
/// The cost of [`Self::advance`] is proportional to the `work` it is given: about 10 ns for each unit.
#[derive(Debug, Default)]
pub struct IndexBuild {
    stage: Stage,
    next: usize,
    items: Vec<Item>,
    all: Region,
    nodes: Vec<Node>,
    pending: Vec<Pending>,
    active: Option<Pending>,
    split: Box<Split>,
    leaves: Vec<Leaf>,
    /// Triangles, each of which has one item or more.
    triangles: usize,
    split_triangles: usize,
}

#[derive(Debug, Default, Clone, Copy, PartialEq)]
enum Stage {
    #[default]
    Boxes,
    Splits,
    Leaves,
}

/// A triangle's box, as two vectors of four to load at once.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C, align(16))]
struct Item {
    min: [f32; 3],
    triangle: u32,
    max: [f32; 3],
    unused: u32,
}

impl Item {
    fn new(min: Vec3, max: Vec3, triangle: u32) -> Self {
        Self { min: min.to_array(), triangle, max: max.to_array(), unused: 0 }
    }

    #[inline]
    fn region(&self) -> Region {
        let [min, max] = bytemuck::cast::<Self, [Vec4; 2]>(*self).map(Vec3A::from_vec4);
        Region { min, max }
    }

    /// Twice the centre of the box.
    #[inline]
    fn centroid(&self) -> Vec3A {
        let Region { min, max } = self.region();
        min + max
    }
}

/// A box, or the box of no point.
#[derive(Debug, Clone, Copy)]
struct Region {
    min: Vec3A,
    max: Vec3A,
}

impl Default for Region {
    fn default() -> Self {
        Self { min: Vec3A::INFINITY, max: Vec3A::NEG_INFINITY }
    }
}

impl Region {
    #[inline]
    fn include(&mut self, min: Vec3A, max: Vec3A) {
        self.min = self.min.min(min);
        self.max = self.max.max(max);
    }

    fn half_area(&self) -> f32 {
        let size = (self.max - self.min).max(Vec3A::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

/// A range of items with the box of its triangles and that of their centroids.
#[derive(Debug, Clone, Copy)]
struct Range {
    start: usize,
    end: usize,
    depth: u8,
    bounds: Region,
    centroids: Region,
}

impl Range {
    fn len(&self) -> usize {
        self.end - self.start
    }
}

/// A range to split, and the node that takes its parts. `is_root` where the range is all the node holds.
#[derive(Debug, Clone, Copy)]
struct Pending {
    range: Range,
    node: u32,
    is_root: bool,
}

#[derive(Debug, Default, Clone, Copy)]
struct Bin {
    bounds: Region,
    count: usize,
}

/// A split under way: first every item is put in its bin, then the items are parted in place. One is used again and again.
#[derive(Debug, Default)]
struct Split {
    by: Binning,
    bins: [Bin; BINS],
    binned: usize,
    parting: Option<Parting>,
}

/// Which bin an item goes in.
#[derive(Debug, Default, Clone, Copy)]
struct Binning {
    axis: usize,
    origin: f32,
    scale: f32,
    /// How many there are.
    bins: usize,
}

impl Binning {
    #[inline]
    fn bin(&self, item: &Item) -> usize {
        let centroid = item.min[self.axis] + item.max[self.axis];
        (((centroid - self.origin) * self.scale) as usize).min(self.bins - 1)
    }
}

#[derive(Debug)]
struct Parting {
    /// Bins below this go left.
    plane: usize,
    /// Items before are left, items from `right` on are right.
    left: usize,
    right: usize,
    centroids: [Region; 2],
}

impl Split {
    fn begin(&mut self, range: &Range) {
        let size = range.centroids.max - range.centroids.min;
        let axis = (0..3).fold(0, |axis, i| if size[i] > size[axis] { i } else { axis });
        // For few items the costs of planes would be most of the work.
        let bins = (range.len() / 2).next_power_of_two().clamp(4, BINS);
        let scale = if range.depth < DEEP && size[axis] > 0.0 { bins as f32 / size[axis] } else { 0.0 };
        self.by = Binning { axis, origin: range.centroids.min[axis], scale, bins };
        self.bins[..bins].fill(Bin::default());
        (self.binned, self.parting) = (range.start, None);
    }

    /// Works on up to `work` items, and then on as many again; the two parts when they are ready.
    fn advance(&mut self, range: &Range, items: &mut [Item], work: usize) -> Option<[Range; 2]> {
        let by = self.by;
        if self.parting.is_none() {
            let end = range.end.min(self.binned.saturating_add(work));
            for item in &items[self.binned..end] {
                let bin = &mut self.bins[by.bin(item)];
                let Region { min, max } = item.region();
                bin.bounds.include(min, max);
                bin.count += 1;
            }
            self.binned = end;
            if end < range.end {
                return None;
            }
            let Some(plane) = best_plane(&self.bins[..by.bins]) else {
                return Some(halves(range, items, by.axis));
            };
            let centroids = [Region::default(); 2];
            self.parting = Some(Parting { plane, left: range.start, right: range.end, centroids });
        }
        let parting = self.parting.as_mut()?;
        let Parting { plane, mut left, mut right, mut centroids } = *parting;
        for _ in 0..work.min(right - left) {
            let centroid = items[left].centroid();
            if by.bin(&items[left]) < plane {
                centroids[0].include(centroid, centroid);
                left += 1;
            } else {
                centroids[1].include(centroid, centroid);
                right -= 1;
                items.swap(left, right);
            }
        }
        if left < right {
            *parting = Parting { plane, left, right, centroids };
            return None;
        }
        let part = |start, end, bins: &[Bin], centroids| {
            let bounds = union(bins.iter().map(|bin| bin.bounds));
            Range { start, end, depth: range.depth + 1, bounds, centroids }
        };
        Some([
            part(range.start, left, &self.bins[..plane], centroids[0]),
            part(left, range.end, &self.bins[plane..by.bins], centroids[1]),
        ])
    }
}

/// The plane of least cost with triangles on both sides.
fn best_plane(bins: &[Bin]) -> Option<usize> {
    let mut right_costs = [0.0f32; BINS];
    let (mut region, mut count) = (Region::default(), 0);
    for plane in (1..bins.len()).rev() {
        region.include(bins[plane].bounds.min, bins[plane].bounds.max);
        count += bins[plane].count;
        right_costs[plane] = if count > 0 { region.half_area() * count as f32 } else { f32::INFINITY };
    }
    let (mut region, mut count) = (Region::default(), 0);
    let mut best = (f32::INFINITY, None);
    for (below, (bin, right_cost)) in bins.iter().zip(&right_costs[1..bins.len()]).enumerate() {
        region.include(bin.bounds.min, bin.bounds.max);
        count += bin.count;
        let cost = region.half_area() * count as f32 + right_cost;
        if count > 0 && cost < best.0 {
            best = (cost, Some(below + 1));
        }
    }
    best.1
}

fn union(regions: impl Iterator<Item = Region>) -> Region {
    regions.fold(Region::default(), |mut all, region| {
        all.include(region.min, region.max);
        all
    })
}

/// Splits a range at the median of its centroids along `axis`.
fn halves(range: &Range, items: &mut [Item], axis: usize) -> [Range; 2] {
    let middle = range.start + range.len() / 2;
    let key = |item: &Item| item.min[axis] + item.max[axis];
    items[range.start..range.end]
        .select_nth_unstable_by(range.len() / 2, |a, b| key(a).total_cmp(&key(b)).then(a.triangle.cmp(&b.triangle)));
    [(range.start, middle), (middle, range.end)].map(|(start, end)| {
        let part = &items[start..end];
        let bounds = union(part.iter().map(Item::region));
        let centroids = union(part.iter().map(|item| Region { min: item.centroid(), max: item.centroid() }));
        Range { start, end, depth: range.depth + 1, bounds, centroids }
    })
}

impl SurfaceIndex {
    /// Builds the index in O(n log n). Triangles with a coordinate that is not finite are left out. To build in
    /// slices, use [`Self::build`].
    ///
    /// # Panics
    /// When an index of a triangle is out of range.
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let mut build = IndexBuild::new();
        loop {
            if let Poll::Ready(index) = build.advance(positions, triangles, usize::MAX) {
                return index;
            }
        }
    }

    /// As [`Self::new`], resting every fraction of a millisecond.
    ///
    /// # Panics
    /// When an index of a triangle is out of range.
    pub async fn build(positions: &[Vec3], triangles: &[[u32; 3]], yielder: &Yielder) -> Self {
        let mut build = IndexBuild::new();
        loop {
            if let Poll::Ready(index) = build.advance(positions, triangles, WORK) {
                return index;
            }
            yielder.rest(build.fraction()).await;
        }
    }

    /// The index of `mesh` that is known, or one that is built.
    pub async fn known_or_built(known: Option<Arc<Self>>, mesh: &TriMesh, yielder: &Yielder) -> Arc<Self> {
        match known {
            Some(index) => index,
            None => Arc::new(Self::build(&mesh.positions, &mesh.triangles, yielder).await),
        }
    }
}

impl IndexBuild {
    /// Nothing built yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The part that is done, 0-1.
    pub fn fraction(&self) -> f32 {
        let total = self.items.len().max(1) as f32;
        // Leaves are reached depth first, so the triangles in them grow evenly with the time.
        let tenths = match self.stage {
            Stage::Boxes => 0.0,
            Stage::Splits => 1.0 + 8.0 * (self.split_triangles as f32 / total),
            Stage::Leaves => 9.0 + self.next as f32 / total,
        };
        tenths / 10.0
    }

    /// Does about `work` units of work, and hands the index over when it is finished; after that the build is as new.
    /// `positions` and `triangles` must be the same at each call.
    ///
    /// # Panics
    /// When an index of a triangle is out of range.
    pub fn advance(&mut self, positions: &[Vec3], triangles: &[[u32; 3]], work: usize) -> Poll<SurfaceIndex> {
        let mut left = work.max(1);
        while left > 0 {
            let used = match self.stage {
                Stage::Boxes => self.add_boxes(positions, triangles, left),
                Stage::Splits => self.split(left),
                Stage::Leaves => self.add_leaves(positions, triangles, left),
            };
            if self.stage == Stage::Leaves && self.next == self.items.len() {
                let Self { nodes, leaves, triangles, .. } = std::mem::take(self);
                return Poll::Ready(SurfaceIndex { nodes, leaves, planes: Vec::new(), triangles });
            }
            left = left.saturating_sub(used.max(1));
        }
        Poll::Pending
    }

    fn add_boxes(&mut self, positions: &[Vec3], triangles: &[[u32; 3]], work: usize) -> usize {
        if self.next == 0 {
            self.items.reserve_exact(triangles.len());
            self.triangles = 0;
        }
        let end = triangles.len().min(self.next.saturating_add(work));
        for (offset, corners) in triangles[self.next..end].iter().enumerate() {
            let [a, b, c] = corners.map(|v| positions[v as usize]);
            if a.is_finite() && b.is_finite() && c.is_finite() {
                self.triangles += 1;
                boxes([a, b, c], triangles.len(), |min, max| {
                    let item = Item::new(min, max, (self.next + offset) as u32);
                    let centroid = item.centroid();
                    self.all.include(centroid, centroid);
                    self.items.push(item);
                });
            }
        }
        let used = end - self.next;
        self.next = end;
        if end == triangles.len() {
            self.begin_splits();
        }
        used
    }

    fn begin_splits(&mut self) {
        self.next = 0;
        self.stage = Stage::Leaves;
        let count = self.items.len();
        if count == 0 {
            return;
        }
        self.nodes.push(Node::EMPTY);
        if count <= LEAF {
            let bounds = union(self.items.iter().map(Item::region));
            self.nodes[0].add(bounds.min.into(), bounds.max.into(), 0, count as u8);
            return;
        }
        self.stage = Stage::Splits;
        // The box of the whole is never asked for.
        let range = Range { start: 0, end: count, depth: 0, bounds: Region::default(), centroids: self.all };
        self.pending.push(Pending { range, node: 0, is_root: true });
    }

    fn split(&mut self, work: usize) -> usize {
        let pending = match self.active.take() {
            Some(active) => active,
            None => match self.pending.pop() {
                Some(pending) => {
                    self.split.begin(&pending.range);
                    pending
                }
                None => {
                    self.stage = Stage::Leaves;
                    return 0;
                }
            },
        };
        // Each item is put in a bin and then parted.
        let used = 2 * work.min(pending.range.len()) + SPLIT_COST;
        match self.split.advance(&pending.range, &mut self.items, work) {
            None => self.active = Some(pending),
            Some(parts) => parts.into_iter().for_each(|range| self.place(range, &pending)),
        }
        used
    }

    /// Gives a part of a split range its place in the tree.
    fn place(&mut self, range: Range, parent: &Pending) {
        let Range { start, bounds: Region { min, max }, .. } = range;
        if range.len() <= LEAF {
            self.nodes[parent.node as usize].add(min.into(), max.into(), start as u32, range.len() as u8);
            self.split_triangles += range.len();
        } else if parent.is_root {
            self.pending.push(Pending { range, node: parent.node, is_root: false });
        } else {
            let node = self.nodes.len() as u32;
            self.nodes.push(Node::EMPTY);
            self.nodes[parent.node as usize].add(min.into(), max.into(), node, 0);
            self.pending.push(Pending { range, node, is_root: true });
        }
    }

    fn add_leaves(&mut self, positions: &[Vec3], triangles: &[[u32; 3]], work: usize) -> usize {
        if self.next == 0 {
            self.leaves.reserve_exact(self.items.len());
        }
        let end = self.items.len().min(self.next.saturating_add(work));
        for &Item { triangle, .. } in &self.items[self.next..end] {
            let corners = triangles[triangle as usize].map(|v| positions[v as usize]);
            self.leaves.push(Leaf { corners, triangle, is_sliver: is_sliver(corners), sides: Leaf::ALL_SIDES });
        }
        let used = end - self.next;
        self.next = end;
        used
    }
}
