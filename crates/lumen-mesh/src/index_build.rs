//! Builds a [`SurfaceIndex`] in slices.
//!
//! Top-down by the surface-area heuristic over at most 16 bins of the longest axis of the centroids' box (Wald, "On fast
//! construction of SAH-based bounding volume hierarchies", 2007). Two binary splits make one four-wide node. Where the
//! bins cannot separate the centroids, or a branch has grown too deep, the range is split at its median instead, which
//! bounds the depth for any input.
//!
//! First triangles are put in the cells of a grid, some dozens in each: the upper levels split cells, the lower ones the
//! triangles of a cell, which the processor has at hand (after Pantaleoni and Luebke, "HLBVH: hierarchical LBVH construction
//! for real-time ray tracing of dynamic geometry", 2010). So a triangle is moved five to seven times and not as often as the
//! tree is deep.
//!
//! Slivers have several boxes (`split_boxes.rs`).
//!
//! The result does not depend on how the work was sliced.

use std::sync::Arc;
use std::task::Poll;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec3A, Vec4};

use super::closest_point::is_sliver;
use super::nearest::{Leaf, Node, SurfaceIndex};
use super::split_boxes::boxes;
use super::{Bounds, TriMesh};
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
/// The bits of a grid are such that four to their power are triangles over this: of a surface some dozens are in a cell then.
const FULL: usize = 64;
/// Most of them: two million cells.
const MOST_BITS: u32 = 7;
/// Empty cells that are passed over in the time of a triangle.
const CELLS_A_UNIT: usize = 8;

/// An index that is being built.
///
/// The cost of [`Self::advance`] is proportional to the `work` it is given: about 10 ns for each unit. Where a grid is laid out or a
/// cell is closed it takes up to 5 ns a triangle of the surface, or of the cell, more.
#[derive(Debug, Default)]
pub struct IndexBuild {
    stage: Stage,
    next: usize,
    grid: Grid,
    /// Of each cell first how many triangles it has, then where its next item goes.
    cells: Vec<u32>,
    items: Vec<Item>,
    /// The cells that have items: their boxes, with their numbers for triangles.
    filled: Vec<Item>,
    /// Items in these.
    filled_items: usize,
    /// Of each of these the items and the box of their centroids.
    contents: Vec<Contents>,
    all: Region,
    nodes: Vec<Node>,
    pending: Vec<Pending>,
    active: Option<Pending>,
    split: Box<Split>,
    leaves: Vec<Leaf>,
    /// The cell whose items become leaves next, and how many of them are.
    cell: usize,
    of_cell: usize,
    /// Triangles, each of which has one item or more.
    triangles: usize,
    split_triangles: usize,
}

#[derive(Debug, Default, Clone, Copy, PartialEq)]
enum Stage {
    #[default]
    Cells,
    Boxes,
    Filling,
    Splits,
    Leaves,
}

/// A grid of cubes over a surface.
#[derive(Debug, Default, Clone, Copy)]
struct Grid {
    least: Vec3,
    /// Cells a mm.
    scale: f32,
    /// Two to this power are the cells along an axis.
    bits: u32,
}

impl Grid {
    /// Over `points`, strays left out.
    fn over(points: &[Vec3], bits: u32) -> Self {
        let bounds = Bounds::of_most(points);
        let size = bounds.longest_side();
        let scale = if size > 0.0 { ((1 << bits) as f32 - 0.5) / size } else { 0.0 };
        Self { least: bounds.min.into(), scale, bits }
    }

    /// The number of the cell that the middle of a box is in.
    #[inline]
    fn cell(&self, min: Vec3, max: Vec3) -> usize {
        // That of a stray is the first or the last along an axis.
        let most = ((1 << self.bits) - 1) as f32;
        let middle = (min + max) * 0.5;
        let cell = ((middle - self.least) * self.scale).clamp(Vec3::ZERO, Vec3::splat(most)).as_uvec3();
        (((cell.z << self.bits | cell.y) << self.bits) | cell.x) as usize
    }
}

/// A triangle's box, or that of a cell, as two vectors of four to load at once.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C, align(16))]
struct Item {
    min: [f32; 3],
    triangle: u32,
    max: [f32; 3],
    /// Triangles in it.
    count: u32,
}

impl Item {
    fn new(min: Vec3, max: Vec3, triangle: u32) -> Self {
        Self { min: min.to_array(), triangle, max: max.to_array(), count: 1 }
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

/// The items of a cell.
#[derive(Debug, Clone, Copy)]
struct Contents {
    start: usize,
    end: usize,
    centroids: Region,
}

/// A range of items, or of cells, with the box of its triangles and that of the centroids.
#[derive(Debug, Clone, Copy)]
struct Range {
    start: usize,
    end: usize,
    is_of_cells: bool,
    /// Slot of the first triangle; the others follow.
    slot: usize,
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
                bin.count += item.count as usize;
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
        let part = |start, end, bins: &[Bin], centroids, slot| {
            let bounds = union(bins.iter().map(|bin| bin.bounds));
            Range { start, end, slot, depth: range.depth + 1, bounds, centroids, ..*range }
        };
        let [below, above] = [&self.bins[..plane], &self.bins[plane..by.bins]];
        let middle = range.slot + below.iter().map(|bin| bin.count).sum::<usize>();
        Some([
            part(range.start, left, below, centroids[0], range.slot),
            part(left, range.end, above, centroids[1], middle),
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
    let slot = range.slot + items[range.start..middle].iter().map(|item| item.count as usize).sum::<usize>();
    [(range.start, middle, range.slot), (middle, range.end, slot)].map(|(start, end, slot)| {
        let part = &items[start..end];
        let bounds = union(part.iter().map(Item::region));
        let centroids = union(part.iter().map(|item| Region { min: item.centroid(), max: item.centroid() }));
        Range { start, end, slot, depth: range.depth + 1, bounds, centroids, ..*range }
    })
}

/// The corners of a triangle, unless one is not finite.
fn finite(corners: &[u32; 3], positions: &[Vec3]) -> Option<[Vec3; 3]> {
    let corners = corners.map(|v| positions[v as usize]);
    corners.iter().all(|corner| corner.is_finite()).then_some(corners)
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
            Stage::Cells | Stage::Boxes | Stage::Filling => 0.0,
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
                Stage::Cells => self.count(positions, triangles, left),
                Stage::Boxes => self.add_boxes(positions, triangles, left),
                Stage::Filling => self.fill(left),
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

    /// Counts the boxes of each cell.
    fn count(&mut self, positions: &[Vec3], triangles: &[[u32; 3]], work: usize) -> usize {
        if self.next == 0 {
            let bits = ((triangles.len() / FULL).max(1).ilog2() / 2).min(MOST_BITS);
            self.grid = Grid::over(positions, bits);
            self.cells = vec![0; 1 << (3 * bits)];
            self.triangles = 0;
        }
        let end = triangles.len().min(self.next.saturating_add(work));
        for corners in &triangles[self.next..end] {
            if let Some(corners) = finite(corners, positions) {
                boxes(corners, triangles.len(), |min, max| self.cells[self.grid.cell(min, max)] += 1);
                self.triangles += 1;
            }
        }
        let used = end - self.next;
        self.next = end;
        if end == triangles.len() {
            (self.next, self.stage) = (0, Stage::Boxes);
            let mut before = 0;
            for cell in &mut self.cells {
                before += std::mem::replace(cell, before);
            }
            self.items = bytemuck::zeroed_vec(before as usize);
        }
        used
    }

    /// Puts the boxes of each triangle in their cells.
    fn add_boxes(&mut self, positions: &[Vec3], triangles: &[[u32; 3]], work: usize) -> usize {
        let end = triangles.len().min(self.next.saturating_add(work));
        for (t, corners) in triangles[self.next..end].iter().enumerate() {
            let Some(corners) = finite(corners, positions) else { continue };
            let t = (self.next + t) as u32;
            boxes(corners, triangles.len(), |min, max| {
                let next = &mut self.cells[self.grid.cell(min, max)];
                self.items[*next as usize] = Item::new(min, max, t);
                *next += 1;
            });
        }
        let used = end - self.next;
        self.next = end;
        if end == triangles.len() {
            (self.next, self.stage) = (0, Stage::Filling);
        }
        used
    }

    /// Finds the boxes of the cells, as many of them as there is work.
    fn fill(&mut self, work: usize) -> usize {
        let end = self.cells.len().min(self.next.saturating_add(work));
        let before = self.filled_items;
        for c in self.next..end {
            // A cell is full where the next one begins.
            self.add_cell(self.cells[c] as usize);
        }
        let used = (end - self.next) / CELLS_A_UNIT + self.filled_items - before;
        self.next = end;
        if end == self.cells.len() {
            self.cells = Vec::new();
            self.begin_splits();
        }
        used
    }

    /// Adds the cell of the next items, up to `end`, if there are any.
    fn add_cell(&mut self, end: usize) {
        let start = std::mem::replace(&mut self.filled_items, end);
        let items = &self.items[start..end];
        if items.is_empty() {
            return;
        }
        let Region { min, max } = union(items.iter().map(Item::region));
        let cell = self.contents.len() as u32;
        let item = Item { count: items.len() as u32, ..Item::new(min.into(), max.into(), cell) };
        let centroid = item.centroid();
        self.all.include(centroid, centroid);
        self.filled.push(item);
        let centroids = union(items.iter().map(|item| Region { min: item.centroid(), max: item.centroid() }));
        self.contents.push(Contents { start, end, centroids });
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
        let (bounds, centroids) = (Region::default(), self.all);
        let range = Range { start: 0, end: self.filled.len(), is_of_cells: true, slot: 0, depth: 0, bounds, centroids };
        self.pending.push(Pending { range: self.opened(range), node: 0, is_root: true });
    }

    /// A range of one cell as the range of its items.
    fn opened(&self, range: Range) -> Range {
        if !range.is_of_cells || range.len() != 1 {
            return range;
        }
        let Contents { start, end, centroids } = self.contents[self.filled[range.start].triangle as usize];
        Range { start, end, centroids, is_of_cells: false, ..range }
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
        let items = if pending.range.is_of_cells { &mut self.filled } else { &mut self.items };
        match self.split.advance(&pending.range, items, work) {
            None => self.active = Some(pending),
            Some(parts) => parts.into_iter().for_each(|range| self.place(self.opened(range), &pending)),
        }
        used
    }

    /// Gives a part of a split range its place in the tree.
    fn place(&mut self, range: Range, parent: &Pending) {
        let Range { slot, bounds: Region { min, max }, .. } = range;
        let items = if range.is_of_cells { &self.filled } else { &self.items };
        // None is empty.
        let count: usize = items[range.start..range.end].iter().take(LEAF + 1).map(|item| item.count as usize).sum();
        if count <= LEAF {
            self.nodes[parent.node as usize].add(min.into(), max.into(), slot as u32, count as u8);
            self.split_triangles += count;
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
        let before = self.next;
        // Cells stand in the order of the tree now.
        while let Some(cell) = self.filled.get(self.cell).filter(|_| self.next - before < work) {
            let Contents { start, end, .. } = self.contents[cell.triangle as usize];
            let last = end.min((start + self.of_cell).saturating_add(work));
            for &Item { triangle, .. } in &self.items[start + self.of_cell..last] {
                let corners = triangles[triangle as usize].map(|v| positions[v as usize]);
                self.leaves.push(Leaf { corners, triangle, is_sliver: is_sliver(corners), sides: Leaf::ALL_SIDES });
            }
            self.next += last - start - self.of_cell;
            (self.cell, self.of_cell) = if last == end { (self.cell + 1, 0) } else { (self.cell, last - start) };
        }
        self.next - before
    }
}
