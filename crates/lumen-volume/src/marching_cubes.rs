//! Marching cubes, slice by slice (Lorensen and Cline 1987).
//!
//! What is cut is a [`Mask`]: points that lie inside, and where on a grid edge between a point inside and a point outside
//! the surface runs. Of a binary mask that is the middle, so that the stair-steps of a segmentation are kept as they are;
//! of a scan it is where the samples, interpolated linearly, reach the threshold. Two slices of the mask are in memory at
//! a time. Vertices are shared by construction: the first cube in scan order that has a grid edge makes its vertex and
//! notes its index in the slice's edge map, where the other three cubes find it. Cases: [`super::cube_cases`].
//!
//! Triangles are wound counter-clockwise seen from outside in the coordinates of the patient, also where the grid's own
//! axes are those of a left hand.

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::cube_cases::{CubeCases, EDGES};
use super::geometry::Geometry;
use lumen_mesh::task::Yielder;
use lumen_mesh::{TriMesh, compacted};

/// What lies inside on a grid, asked for slice by slice in ascending order.
pub trait Mask {
    /// Whether the points on the grid's six faces count as outside whatever the mask says, so that the surface is closed.
    /// Otherwise it is open where it meets them.
    const CLOSED: bool;

    /// Readies slice `k` for [`Self::row`].
    fn begin_slice(&mut self, k: usize);

    /// Appends the runs of inside points of row `j` of the slice: ascending, disjoint, within `0..size[0]`. What
    /// `runs` holds already belongs to other rows.
    fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>);

    /// Where the surface crosses the edge from `point` to the next point along `axis`, one of which is inside: 0 at
    /// `point`, 1 at the next.
    fn crossing(&self, _point: [usize; 3], _axis: usize) -> f64 {
        0.5
    }

    /// Whether cubes between slice `k` and the next can be left out by [`Self::is_cut`].
    fn has_cuts(&mut self, _k: usize) -> bool {
        false
    }

    /// Whether the cube around `centre` (mm) is left out of the surface, which is then open there.
    fn is_cut(&self, _centre: DVec3) -> bool {
        false
    }
}

/// One slice of the mask, as points and as runs.
struct Slice {
    points: Vec<u8>,
    runs: Vec<Range<usize>>,
    /// The runs of row `j` are `runs[row_starts[j]..row_starts[j + 1]]`.
    row_starts: Vec<usize>,
}

impl Slice {
    fn new([nx, ny, _]: [usize; 3]) -> Self {
        Self { points: vec![0; nx * ny], runs: Vec::new(), row_starts: vec![0; ny + 1] }
    }

    /// Takes slice `k` from the mask.
    fn fill<M: Mask>(&mut self, mask: &mut M, k: usize, [nx, ny, nz]: [usize; 3]) {
        for j in 0..ny {
            for run in &self.runs[self.row_starts[j]..self.row_starts[j + 1]] {
                self.points[j * nx + run.start..j * nx + run.end].fill(0);
            }
        }
        self.runs.clear();
        self.row_starts.fill(0);
        let rim = usize::from(M::CLOSED);
        if k < rim || k + rim >= nz {
            return;
        }
        mask.begin_slice(k);
        for j in 0..ny {
            if j >= rim && j + rim < ny {
                let first = self.runs.len();
                mask.row(j, &mut self.runs);
                for run in &mut self.runs[first..] {
                    *run = run.start.max(rim)..run.end.min(nx - rim).max(run.start.max(rim));
                    self.points[j * nx + run.start..j * nx + run.end].fill(1);
                }
            }
            self.row_starts[j + 1] = self.runs.len();
        }
    }

    fn row_runs(&self, j: usize) -> &[Range<usize>] {
        &self.runs[self.row_starts[j]..self.row_starts[j + 1]]
    }
}

/// The vertices on the grid edges of one layer of cubes. Only entries of crossed edges are meaningful; the rest is
/// left from layers before.
struct EdgeMaps {
    /// Edges along x in the lower and the upper slice.
    along_x: [Vec<u32>; 2],
    /// Edges along y in the lower and the upper slice.
    along_y: [Vec<u32>; 2],
    /// Edges along z between the slices.
    along_z: Vec<u32>,
}

/// Makes the surface of a mask: triangles counter-clockwise seen from outside, every vertex used, no edge with more than
/// two triangles.
pub struct MarchingCubes<M> {
    mask: M,
    size: [usize; 3],
    origin: DVec3,
    /// The steps along i, j, k in mm.
    steps: DMat3,
    is_left_handed: bool,
    cases: CubeCases,
    maps: EdgeMaps,
    lower: Slice,
    upper: Slice,
    /// Layers of cubes that are done.
    layer: usize,
    any_cut: bool,
    spans: Vec<Range<usize>>,
    mesh: TriMesh,
}

impl<M: Mask> MarchingCubes<M> {
    /// Before the first layer. The mask must have the size of the grid.
    pub fn new(grid: &Geometry, mut mask: M) -> Self {
        // Between fewer than two points there is no cube.
        let size = if grid.size.iter().all(|&along| along > 1) { grid.size } else { [0; 3] };
        let map = || vec![0u32; size[0] * size[1]];
        let maps = EdgeMaps { along_x: [map(), map()], along_y: [map(), map()], along_z: map() };
        let mut lower = Slice::new(size);
        lower.fill(&mut mask, 0, size);
        Self {
            mask,
            size,
            origin: grid.origin,
            steps: grid.steps(),
            is_left_handed: grid.is_left_handed(),
            cases: CubeCases::new(),
            maps,
            lower,
            upper: Slice::new(size),
            layer: 0,
            any_cut: false,
            spans: Vec::new(),
            mesh: TriMesh::default(),
        }
    }

    /// Whether all layers are done.
    pub fn is_done(&self) -> bool {
        self.layer + 1 >= self.size[2]
    }

    /// The part that is done, 0 to 1.
    pub fn fraction(&self) -> f32 {
        if self.is_done() { 1.0 } else { self.layer as f32 / (self.size[2] - 1) as f32 }
    }

    /// The surface of the layers that are done.
    pub fn into_mesh(self) -> TriMesh {
        let mut mesh = self.mesh;
        if self.is_left_handed {
            for triangle in &mut mesh.triangles {
                triangle.swap(1, 2);
            }
        }
        // Cubes that were left out made vertices that nobody uses.
        if self.any_cut { compacted(&mesh.positions, mesh.triangles) } else { mesh }
    }

    /// The whole surface; `None` where it has more than `most` triangles. Rests after each layer of cubes.
    pub async fn surface(mut self, most: usize, yielder: &Yielder) -> Option<TriMesh> {
        loop {
            self.advance_layer();
            if self.mesh.triangles.len() > most {
                return None;
            }
            if self.is_done() {
                return Some(self.into_mesh());
            }
            yielder.rest(self.fraction()).await;
        }
    }

    /// Does the next layer of cubes.
    pub fn advance_layer(&mut self) {
        if self.is_done() {
            return;
        }
        let ([nx, ny, _], k) = (self.size, self.layer);
        self.upper.fill(&mut self.mask, k + 1, self.size);
        let has_cuts = self.mask.has_cuts(k);
        let (lower, upper) = (&self.lower, &self.upper);
        for j in 0..ny - 1 {
            let rows = [lower.row_runs(j), lower.row_runs(j + 1), upper.row_runs(j), upper.row_runs(j + 1)];
            cube_spans(rows, nx, &mut self.spans);
            for span in &self.spans {
                let column = |i: usize| {
                    let at = j * nx + i;
                    lower.points[at] | lower.points[at + nx] << 2 | upper.points[at] << 4 | upper.points[at + nx] << 6
                };
                let mut left = column(span.start);
                for i in span.clone() {
                    let right = column(i + 1);
                    let case = left | right << 1;
                    left = right;
                    if case == 0 || case == 255 {
                        continue;
                    }
                    let at = |x, y, z| self.origin + self.steps * DVec3::new(x, y, z);
                    let positions = &mut self.mesh.positions;
                    let mask = &self.mask;
                    let corners = self.maps.cube([i, j, k], nx, case, |point, axis| {
                        let mut place = point.map(|index| index as f64);
                        place[axis] += mask.crossing(point, axis);
                        let [x, y, z] = place;
                        positions.push(at(x, y, z).as_vec3());
                        (positions.len() - 1) as u32
                    });
                    if has_cuts && mask.is_cut(at(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5)) {
                        self.any_cut = true;
                        continue;
                    }
                    let triangles = self.cases.triangles(case);
                    self.mesh.triangles.extend(triangles.iter().map(|t| t.map(|edge| corners[usize::from(edge)])));
                }
            }
        }
        std::mem::swap(&mut self.lower, &mut self.upper);
        self.maps.along_x.swap(0, 1);
        self.maps.along_y.swap(0, 1);
        self.layer += 1;
    }
}

impl EdgeMaps {
    /// The vertices of the crossed edges of a cube; those that no earlier cube has are made, each from the lower point of
    /// its edge and the edge's axis. What is returned for an edge that is not crossed means nothing.
    fn cube(
        &mut self,
        [i, j, k]: [usize; 3],
        nx: usize,
        case: u8,
        mut make: impl FnMut([usize; 3], usize) -> u32,
    ) -> [u32; EDGES] {
        let at = j * nx + i;
        let crossed = |a: u8, b: u8| (case >> a ^ case >> b) & 1 == 1;
        if crossed(6, 7) {
            self.along_x[1][at + nx] = make([i, j + 1, k + 1], 0);
        }
        if crossed(5, 7) {
            self.along_y[1][at + 1] = make([i + 1, j, k + 1], 1);
        }
        if crossed(3, 7) {
            self.along_z[at + nx + 1] = make([i + 1, j + 1, k], 2);
        }
        // On the lower faces of the grid there is no earlier cube.
        let [first_i, first_j, first_k] = [i == 0, j == 0, k == 0];
        if first_j && crossed(4, 5) {
            self.along_x[1][at] = make([i, j, k + 1], 0);
        }
        if first_k && crossed(2, 3) {
            self.along_x[0][at + nx] = make([i, j + 1, k], 0);
        }
        if first_j && first_k && crossed(0, 1) {
            self.along_x[0][at] = make([i, j, k], 0);
        }
        if first_i && crossed(4, 6) {
            self.along_y[1][at] = make([i, j, k + 1], 1);
        }
        if first_k && crossed(1, 3) {
            self.along_y[0][at + 1] = make([i + 1, j, k], 1);
        }
        if first_i && first_k && crossed(0, 2) {
            self.along_y[0][at] = make([i, j, k], 1);
        }
        if first_i && crossed(2, 6) {
            self.along_z[at + nx] = make([i, j + 1, k], 2);
        }
        if first_j && crossed(1, 5) {
            self.along_z[at + 1] = make([i + 1, j, k], 2);
        }
        if first_i && first_j && crossed(0, 4) {
            self.along_z[at] = make([i, j, k], 2);
        }
        let ([x0, x1], [y0, y1], z0) = (&self.along_x, &self.along_y, &self.along_z);
        [
            x0[at],
            x0[at + nx],
            x1[at],
            x1[at + nx],
            y0[at],
            y0[at + 1],
            y1[at],
            y1[at + 1],
            z0[at],
            z0[at + 1],
            z0[at + nx],
            z0[at + nx + 1],
        ]
    }
}

/// The cubes of a row that touch one of four rows of points: ascending, disjoint.
fn cube_spans(rows: [&[Range<usize>]; 4], nx: usize, spans: &mut Vec<Range<usize>>) {
    spans.clear();
    // A point belongs to the cubes on both its sides.
    let cubes = |run: &Range<usize>| run.start.saturating_sub(1)..run.end.min(nx - 1);
    spans.extend(rows.into_iter().flatten().filter(|run| !run.is_empty()).map(cubes));
    spans.sort_unstable_by_key(|span| (span.start, span.end));
    let mut kept = 0;
    for s in 1..spans.len() {
        if spans[s].start <= spans[kept].end {
            spans[kept].end = spans[kept].end.max(spans[s].end);
        } else {
            kept += 1;
            spans[kept] = spans[s].clone();
        }
    }
    spans.truncate(if spans.is_empty() { 0 } else { kept + 1 });
}

#[cfg(test)]
mod tests;
