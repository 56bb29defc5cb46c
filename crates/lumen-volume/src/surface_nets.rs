//! Surface nets, slice by slice: the surface of a mask whose vertices relax within their voxel cells.
//!
//! Gibson 1998, *Constrained elastic surface nets*: each cell between eight neighbouring voxels that are not all alike has a
//! vertex in its middle, and each pair of neighbouring voxels that differ has a quadrilateral between the vertices of the four
//! cells around it. Then every vertex moves by `factor` of the way to the mean of the vertices that it shares an edge with, by
//! `back` of the way from it, and back into its cell if it left that, `iterations` times:
//!
//! ```text
//! x <- clamp(x + factor (mean of the neighbours - x), cell)
//! x <- clamp(x - back (mean of the neighbours - x), cell)
//! ```
//!
//! So stair-steps go, and the surface stays between the voxels that it separates. Gibson and VTK have the first step alone, by
//! which a vessel of six voxels across loses 11 % and more of its radius; the second gives that back (Taubin 1995). All labels
//! of a map are done at once and share their borders (Frisken 2022, whose method VTK has as `vtkSurfaceNets3D`). A vertex where
//! three labels and more meet moves along such edges alone, one on a rim along the rim.
//!
//! Where a cell has two labels it has a vertex for each loop of [`super::cube_cases`] (Nielson 2004, *Dual marching cubes*), in
//! place of one that non-manifold fans would share. Two cells can be joined twice through a face whose voxels of one label
//! touch diagonally; one of these edges gets a vertex at its middle, so that the surface of one label is a manifold.
//!
//! The volume is open at its faces, as with marching cubes: the outermost cells have no extent across the face.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use super::cube_cases::CubeLoops;
use super::error::VolumeError;
use super::geometry::Region;
use super::grid::Grid;
use super::selection::{Selected, Selection};
use super::surface::{Cut, MAX_TRIANGLES, none_found};
use lumen_mesh::TriMesh;
use lumen_mesh::task::{Yielder, at_once, blocks};

/// Vertices and quadrilaterals between two looks at the clock.
const BLOCK: usize = 1 << 15;
/// The part of the work that is the way over the grid.
const NETS_PART: f32 = 0.6;

/// How the vertices of a surface net are relaxed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    /// How often each vertex moves to and fro; 0 leaves the stair-steps.
    pub iterations: u32,
    /// The part of the way to the mean of its neighbours, 0 to 1.
    pub factor: f32,
    /// The part of the way back from it, 0 or somewhat more than `factor`.
    pub back: f32,
}

impl Default for Relaxation {
    /// Waves longer than ten voxels pass: 1 / factor - 1 / back is 0.1 (Taubin 1995). More iterations make the surface smoother
    /// and vessels of two voxels narrower (docs/scans.md).
    fn default() -> Self {
        Self { iterations: 10, factor: 0.5, back: 0.526 }
    }
}

impl Relaxation {
    /// VTK's: 16 times half the way, and none of it back.
    pub const VTK: Self = Self { iterations: 16, factor: 0.5, back: 0.0 };
}

/// The borders between labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LabelledSurface {
    /// In mm, counter-clockwise seen from the outside.
    pub mesh: TriMesh,
    /// The labels inside and outside of each triangle: outside is 0 or, between two labels, the larger. Of a selection that is
    /// one body they are 1 and 0.
    pub sides: Vec<[u16; 2]>,
}

/// The surface of a selection of a mask by surface nets: LPS millimetres, open where the selection meets the faces of the volume
/// or of the box. Of [`Selection::EachLabel`] it has the borders of all labels, else it is a manifold. A threshold is taken
/// without interpolation.
///
/// # Errors
/// As [`surface`](super::surface()).
pub fn surface_nets(
    grid: &Arc<Grid>,
    selection: Selection,
    region: Option<Region>,
    relaxation: Relaxation,
) -> Result<LabelledSurface, VolumeError> {
    at_once(surface_nets_in_slices(grid, Cut { region, ..Cut::new(selection) }, relaxation, &Yielder::never()))
}

/// As [`surface_nets`], of any cut, resting after each layer of cells.
///
/// # Errors
/// As [`surface_in_slices`](super::surface_in_slices).
pub async fn surface_nets_in_slices(
    grid: &Arc<Grid>,
    cut: Cut,
    relaxation: Relaxation,
    yielder: &Yielder,
) -> Result<LabelledSurface, VolumeError> {
    let (mut selected, region) = cut.selected(grid, yielder).await?;
    let mut nets = Nets::new(region.size());
    for layer in 0..=region.size()[2] {
        nets.advance(layer, &mut selected);
        if 2 * nets.quads.len() > MAX_TRIANGLES {
            return Err(VolumeError::TooManyTriangles { limit: MAX_TRIANGLES });
        }
        yielder.rest(NETS_PART * layer as f32 / region.size()[2] as f32).await;
    }
    if nets.quads.is_empty() {
        return Err(none_found(grid, region));
    }
    let neighbours = Neighbours::new(nets.positions.len(), &nets.quads, yielder).await;
    nets.relax(&neighbours, relaxation, yielder).await;
    let geometry = grid.geometry().cropped(&region);
    for block in blocks(nets.positions.len(), BLOCK) {
        for position in &mut nets.positions[block] {
            let [i, j, k] = position.as_dvec3().to_array();
            *position = geometry.at(i, j, k).as_vec3();
        }
        yielder.rest(1.0).await;
    }
    let mut surface = nets.triangulated(&neighbours.double, yielder).await;
    if geometry.is_left_handed() {
        for triangle in &mut surface.mesh.triangles {
            triangle.swap(1, 2);
        }
    }
    Ok(surface)
}

/// Which of two labels counts as inside: one that is not 0, or the smaller.
fn sides(a: u16, b: u16) -> [u16; 2] {
    let (low, high) = (a.min(b), a.max(b));
    if low == 0 { [high, low] } else { [low, high] }
}

/// A slice of labels.
struct Labels {
    of_voxel: Vec<u16>,
    /// For each row, from the first voxel that is not 0 to the last.
    extents: Vec<Range<usize>>,
}

/// The vertices of a layer of cells. Only entries of cells that have one are meaningful.
struct Layer {
    /// The first vertex of a cell.
    first: Vec<u32>,
    /// The case of a cell of two labels; 0 where there are more, which all share one vertex.
    case: Vec<u8>,
}

/// Cell (i, j, k) lies between voxel (i - 1, j - 1, k - 1) and voxel (i, j, k), of which those beyond the grid are like the
/// outermost.
struct Nets {
    /// Voxels along the axes.
    size: [usize; 3],
    loops: CubeLoops,
    lower: Labels,
    upper: Labels,
    /// The layer of cells below, and this one.
    layers: [Layer; 2],
    /// The cell of each vertex.
    cells: Vec<[u32; 3]>,
    /// In voxels, later in mm.
    positions: Vec<Vec3>,
    /// Counter-clockwise seen from outside; the first is the farthest of the four cells from the origin.
    quads: Vec<[u32; 4]>,
    sides: Vec<[u16; 2]>,
}

impl Nets {
    fn new(size: [usize; 3]) -> Self {
        let [nx, ny, _] = size;
        let labels = || Labels { of_voxel: vec![0; nx * ny], extents: vec![0..0; ny] };
        let cells = (nx + 1) * (ny + 1);
        let layer = || Layer { first: vec![0; cells], case: vec![0; cells] };
        Self {
            size,
            loops: CubeLoops::new(),
            lower: labels(),
            upper: labels(),
            layers: [layer(), layer()],
            cells: Vec::new(),
            positions: Vec::new(),
            quads: Vec::new(),
            sides: Vec::new(),
        }
    }

    /// Does the next layer of cells.
    fn advance(&mut self, k: usize, selected: &mut Selected) {
        let [nx, ny, nz] = self.size;
        std::mem::swap(&mut self.lower, &mut self.upper);
        self.layers.swap(0, 1);
        let Labels { of_voxel, extents } = &mut self.upper;
        selected.labels(k.min(nz - 1), of_voxel);
        for (row, extent) in of_voxel.chunks_exact(nx).zip(extents) {
            let first = row.iter().position(|&label| label != 0);
            *extent = first.map_or(0..0, |first| first..nx - row.iter().rev().take_while(|&&label| label == 0).count());
        }
        if k == 0 {
            self.lower.of_voxel.copy_from_slice(&self.upper.of_voxel);
            self.lower.extents.clone_from(&self.upper.extents);
        }
        for j in 0..=ny {
            let [near, far] = [j.saturating_sub(1), j.min(ny - 1)];
            let extents =
                [&self.lower, &self.upper].into_iter().flat_map(|slice| [&slice.extents[near], &slice.extents[far]]);
            let touched = extents.filter(|extent| !extent.is_empty());
            let Some(touched) = touched.cloned().reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)) else {
                continue;
            };
            let column = |nets: &Self, i: usize| {
                let [near, far] = [near * nx + i, far * nx + i];
                let (lower, upper) = (&nets.lower.of_voxel, &nets.upper.of_voxel);
                [lower[near], lower[far], upper[near], upper[far]]
            };
            let mut left = column(self, touched.start.saturating_sub(1));
            for i in touched.start..=touched.end {
                let right = column(self, i.min(nx - 1));
                if left != right || left[1..].iter().any(|&label| label != left[0]) {
                    let [a, b, c, d] = left;
                    let [e, f, g, h] = right;
                    self.cell([i, j, k], [a, e, b, f, c, g, d, h]);
                }
                left = right;
            }
        }
    }

    /// Makes the vertices of a cell that is not all alike, and the quadrilaterals of which it is the last cell.
    fn cell(&mut self, cell: [usize; 3], corners: [u16; 8]) {
        let (low, high) = corners.iter().fold((u16::MAX, 0), |(low, high), &label| (low.min(label), high.max(label)));
        let inside = sides(low, high)[0];
        let has_two = corners.iter().all(|&label| label == low || label == high);
        let bits = (0..8).filter(|&corner| corners[corner] == inside).fold(0, |bits, corner| bits | 1 << corner);
        let case = if has_two { bits } else { 0 };
        let at = cell[1] * (self.size[0] + 1) + cell[0];
        self.layers[1].first[at] = self.positions.len() as u32;
        self.layers[1].case[at] = case;
        let least = Vec3::from_array(cell.map(|along| along as f32 - 1.0));
        let [low, high] = self.extent(cell.map(|along| along as u32));
        let middles = self.loops.middles(case);
        for &middle in middles {
            self.cells.push(cell.map(|along| along as u32));
            // The middle of a loop lies too far in where the wall bends outwards: it only tells several apart.
            let start = if middles.len() == 1 { Vec3::splat(0.5) } else { middle };
            self.positions.push((least + start).clamp(low, high));
        }
        if cell.contains(&0) {
            return;
        }
        for axis in 0..3 {
            let two = [corners[0], corners[1 << axis]];
            if two[0] == two[1] {
                continue;
            }
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            // An edge's place on the other two axes has the lower of them in the lower bit.
            let (of_u, of_v) = if u < v { (1, 2) } else { (2, 1) };
            let mut quad =
                [(0, 0, 0), (1, 0, of_u), (1, 1, of_u | of_v), (0, 1, of_v)].map(|(back_u, back_v, place)| {
                    let mut other = cell;
                    other[u] -= back_u;
                    other[v] -= back_v;
                    let layer = &self.layers[usize::from(other[2] == cell[2])];
                    let at = other[1] * (self.size[0] + 1) + other[0];
                    layer.first[at] + u32::from(self.loops.of_edge(layer.case[at], 4 * axis + place))
                });
            let sides = sides(two[0], two[1]);
            if sides[0] != two[0] {
                quad.swap(1, 3);
            }
            self.quads.push(quad);
            self.sides.push(sides);
        }
    }

    /// The least and the largest place in a cell.
    fn extent(&self, cell: [u32; 3]) -> [Vec3; 2] {
        let low = cell.map(|along| along.saturating_sub(1) as f32);
        let high = std::array::from_fn(|axis| (cell[axis] as f32).min(self.size[axis] as f32 - 1.0));
        [Vec3::from_array(low), Vec3::from_array(high)]
    }

    /// Relaxes the vertices, all from where they were before at once.
    async fn relax(&mut self, neighbours: &Neighbours, relaxation: Relaxation, yielder: &Yielder) {
        let mut moved = self.positions.clone();
        let Relaxation { iterations, factor, back } = relaxation;
        let steps: &[f32] = if back == 0.0 { &[factor] } else { &[factor, -back] };
        let count = iterations as usize * steps.len();
        for (n, part) in steps.iter().cycle().take(count).enumerate() {
            for block in blocks(self.positions.len(), BLOCK) {
                for v in block {
                    let around = neighbours.of(v);
                    let sum: Vec3 = around.iter().map(|&other| self.positions[other as usize]).sum();
                    let [low, high] = self.extent(self.cells[v]);
                    let here = self.positions[v];
                    let mean = sum / around.len().max(1) as f32;
                    moved[v] = (here + *part * (mean - here)).clamp(low, high);
                }
                let done = (n + 1) as f32 / count as f32;
                yielder.rest(NETS_PART + (1.0 - NETS_PART) * done).await;
            }
            std::mem::swap(&mut self.positions, &mut moved);
        }
    }

    /// The voxel of the inside label that a quadrilateral lies at.
    fn inside_voxel(&self, quad: [u32; 4]) -> [u32; 3] {
        let [last, next, opposite, _] = quad.map(|v| self.cells[v as usize]);
        let axis = (0..3).find(|&axis| last[axis] == opposite[axis]).unwrap_or(0);
        let mut voxel = last.map(|along| along - 1);
        // Turned over, it goes on along the other of its axes.
        voxel[axis] += u32::from(next[(axis + 1) % 3] == last[(axis + 1) % 3]);
        voxel
    }

    /// Two triangles for each quadrilateral, along its shorter diagonal; `double` edges, which two sheets of one surface share,
    /// come apart.
    async fn triangulated(self, double: &[[u32; 2]], yielder: &Yielder) -> LabelledSurface {
        let mut triangles = Vec::with_capacity(2 * self.quads.len());
        let mut sides = Vec::with_capacity(2 * self.quads.len());
        // The quadrilaterals at each double edge.
        let mut at_double: BTreeMap<[u32; 2], Vec<usize>> = double.iter().map(|&edge| (edge, Vec::new())).collect();
        for block in blocks(self.quads.len(), BLOCK) {
            for q in block {
                let [a, b, c, d] = self.quads[q];
                let length = |a: u32, b: u32| self.positions[a as usize].distance_squared(self.positions[b as usize]);
                triangles.extend(if length(a, c) <= length(b, d) {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                });
                sides.extend([self.sides[q]; 2]);
                for [a, b] in [[a, b], [b, c], [c, d], [d, a]] {
                    if let Some(quads) = at_double.get_mut(&[a.min(b), a.max(b)]) {
                        quads.push(q);
                    }
                }
            }
            yielder.rest(1.0).await;
        }
        let mut positions = self.positions.clone();
        let mut added: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for ([a, b], quads) in at_double {
            // Other borders meet there as they are.
            if quads.iter().any(|&q| self.sides[q] != self.sides[quads[0]]) {
                continue;
            }
            let kept = self.inside_voxel(self.quads[quads[0]]);
            let middle = positions.len() as u32;
            positions.push(positions[a as usize].midpoint(positions[b as usize]));
            for q in quads.into_iter().filter(|&q| self.inside_voxel(self.quads[q]) != kept) {
                let own = added.entry(q).or_default();
                let mut of_quad = [2 * q, 2 * q + 1].into_iter().chain(own.iter().copied());
                let Some(t) = of_quad.find(|&t| triangles[t].contains(&a) && triangles[t].contains(&b)) else {
                    continue;
                };
                let halves = [a, b].map(|end| triangles[t].map(|corner| if corner == end { middle } else { corner }));
                triangles[t] = halves[0];
                own.push(triangles.len());
                triangles.push(halves[1]);
                sides.push(self.sides[q]);
            }
        }
        LabelledSurface { mesh: TriMesh { positions, triangles }, sides }
    }
}

/// The vertices that each vertex relaxes towards.
struct Neighbours {
    /// Those of vertex `v` begin at `starts[v]`.
    starts: Vec<u32>,
    ends: Vec<u32>,
    all: Vec<u32>,
    /// Edges of four quadrilaterals.
    double: Vec<[u32; 2]>,
}

impl Neighbours {
    async fn new(vertices: usize, quads: &[[u32; 4]], yielder: &Yielder) -> Self {
        // A corner of a quadrilateral is next to two others; one of a surface without rim is named twice.
        let mut ends = vec![0u32; vertices];
        for block in blocks(quads.len(), BLOCK) {
            for &corner in quads[block].as_flattened() {
                ends[corner as usize] += 2;
            }
            yielder.rest(NETS_PART).await;
        }
        let mut total = 0;
        let starts: Vec<u32> = ends
            .iter()
            .map(|count| {
                total += count;
                total - count
            })
            .collect();
        ends.copy_from_slice(&starts);
        let mut all = vec![0u32; total as usize];
        for block in blocks(quads.len(), BLOCK) {
            for &[a, b, c, d] in &quads[block] {
                for (v, others) in [(a, [b, d]), (b, [a, c]), (c, [b, d]), (d, [a, c])] {
                    let end = &mut ends[v as usize];
                    all[*end as usize..*end as usize + 2].copy_from_slice(&others);
                    *end += 2;
                }
            }
            yielder.rest(NETS_PART).await;
        }
        let mut found = Self { starts, ends, all, double: Vec::new() };
        for block in blocks(vertices, BLOCK) {
            for v in block {
                found.choose(v);
            }
            yielder.rest(NETS_PART).await;
        }
        found
    }

    /// Leaves each neighbour of `v` once: those along edges where sheets meet or end, else all.
    fn choose(&mut self, v: usize) {
        let range = self.starts[v] as usize..self.ends[v] as usize;
        let own = &mut self.all[range.clone()];
        own.sort_unstable();
        let is_plain = |run: &[u32]| run.len() == 2;
        let along = own.chunk_by(|a, b| a == b).filter(|run| !is_plain(run)).count();
        for run in own.chunk_by(|a, b| a == b).filter(|run| run.len() == 4 && run[0] > v as u32) {
            self.double.push([v as u32, run[0]]);
        }
        let mut kept = range.start;
        let mut next = range.start;
        while next < range.end {
            let other = self.all[next];
            let run = self.all[next..range.end].iter().take_while(|&&same| same == other).count();
            if along < 2 || run != 2 {
                self.all[kept] = other;
                kept += 1;
            }
            next += run;
        }
        self.ends[v] = kept as u32;
    }

    fn of(&self, v: usize) -> &[u32] {
        &self.all[self.starts[v] as usize..self.ends[v] as usize]
    }
}

#[cfg(test)]
mod tests;
