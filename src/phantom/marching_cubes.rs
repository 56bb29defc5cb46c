//! Marching cubes on a binary mask, slice by slice (Lorensen and Cline 1987).
//!
//! The mask is cut at one half, so every vertex is the midpoint of a grid edge between a point inside and a point
//! outside: the stair-steps of a binary segmentation are kept as they are. Two slices of the mask are in memory at a
//! time. Vertices are shared by construction: the first cube in scan order that has a grid edge makes its vertex and
//! notes its index in the slice's edge map, where the other three cubes find it. Cases: [`super::cube_cases`].

use std::ops::{ControlFlow, Range};

use glam::DVec3;

use super::cube_cases::{CubeCases, EDGES};
use crate::mesh::{TriMesh, Vec3, compacted};

/// A regular grid of sample points. The points on its six faces count as outside whatever the mask says, so leave
/// one point of padding around what is to be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    /// Position of the first point in mm.
    pub(super) origin: DVec3,
    /// Distance between points along x, y, z in mm.
    pub(super) spacing: DVec3,
    /// Points along x, y, z.
    pub(super) size: [usize; 3],
}

impl Grid {
    /// The grid of the given spacing that holds the box from `min` to `max` with two points of padding.
    pub(super) fn around(min: DVec3, max: DVec3, spacing: DVec3) -> Self {
        let extent = (max - min) / spacing;
        Self {
            origin: min - spacing * 2.0,
            spacing,
            size: extent.to_array().map(|points| libm::ceil(points.max(0.0)) as usize + 5),
        }
    }

    /// The place of a point given in grid units, in mm.
    pub(super) fn at(&self, i: f64, j: f64, k: f64) -> DVec3 {
        self.origin + self.spacing * DVec3::new(i, j, k)
    }
}

/// A binary mask over a grid, asked for slice by slice in ascending order.
pub(super) trait Mask {
    /// Readies slice `k` for [`Self::row`].
    fn begin_slice(&mut self, k: usize);

    /// Appends the runs of inside points of row `j` of the slice: ascending, disjoint, within `0..size[0]`. What
    /// `runs` holds already belongs to other rows.
    fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>);

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
    fn fill(&mut self, mask: &mut impl Mask, k: usize, [nx, ny, nz]: [usize; 3]) {
        for j in 0..ny {
            for run in &self.runs[self.row_starts[j]..self.row_starts[j + 1]] {
                self.points[j * nx + run.start..j * nx + run.end].fill(0);
            }
        }
        self.runs.clear();
        self.row_starts.fill(0);
        if k == 0 || k + 1 == nz {
            return;
        }
        mask.begin_slice(k);
        for j in 0..ny {
            if j > 0 && j + 1 < ny {
                let first = self.runs.len();
                mask.row(j, &mut self.runs);
                for run in &mut self.runs[first..] {
                    *run = run.start.max(1)..run.end.min(nx - 1).max(run.start.max(1));
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

/// The surface of `mask`: triangles counter-clockwise seen from outside, every vertex used, no edge with more than
/// two triangles. `progress` hears the fraction done after each slice; `None` when it breaks off.
pub(super) fn marching_cubes(
    grid: &Grid,
    mask: &mut impl Mask,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Option<TriMesh> {
    let [nx, ny, nz] = grid.size;
    let cases = CubeCases::new();
    let mut mesh = TriMesh::default();
    let (mut lower, mut upper) = (Slice::new(grid.size), Slice::new(grid.size));
    let map = || vec![0u32; nx * ny];
    let mut maps = EdgeMaps { along_x: [map(), map()], along_y: [map(), map()], along_z: map() };
    let mut spans = Vec::new();
    let mut any_cut = false;
    lower.fill(mask, 0, grid.size);
    for k in 0..nz.saturating_sub(1) {
        upper.fill(mask, k + 1, grid.size);
        let has_cuts = mask.has_cuts(k);
        for j in 0..ny - 1 {
            let rows = [lower.row_runs(j), lower.row_runs(j + 1), upper.row_runs(j), upper.row_runs(j + 1)];
            cube_spans(rows, &mut spans);
            for span in &spans {
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
                    let corners = maps.cube([i, j, k], nx, case, grid, &mut mesh.positions);
                    if has_cuts && mask.is_cut(grid.at(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5)) {
                        any_cut = true;
                        continue;
                    }
                    let triangles = cases.triangles(case);
                    mesh.triangles.extend(triangles.iter().map(|t| t.map(|edge| corners[usize::from(edge)])));
                }
            }
        }
        std::mem::swap(&mut lower, &mut upper);
        maps.along_x.swap(0, 1);
        maps.along_y.swap(0, 1);
        if progress((k + 1) as f32 / (nz - 1) as f32).is_break() {
            return None;
        }
    }
    // Cubes that were left out made vertices that nobody uses.
    Some(if any_cut { compacted(&mesh.positions, mesh.triangles) } else { mesh })
}

impl EdgeMaps {
    /// The vertices of the crossed edges of a cube; those that no earlier cube has are made. What is returned for
    /// an edge that is not crossed means nothing.
    fn cube(
        &mut self,
        [i, j, k]: [usize; 3],
        nx: usize,
        case: u8,
        grid: &Grid,
        positions: &mut Vec<Vec3>,
    ) -> [u32; EDGES] {
        let at = j * nx + i;
        let crossed = |a: u8, b: u8| (case >> a ^ case >> b) & 1 == 1;
        let (x, y, z) = (i as f64, j as f64, k as f64);
        let mut make = |x, y, z| {
            positions.push(grid.at(x, y, z).as_vec3());
            (positions.len() - 1) as u32
        };
        if crossed(6, 7) {
            self.along_x[1][at + nx] = make(x + 0.5, y + 1.0, z + 1.0);
        }
        if crossed(5, 7) {
            self.along_y[1][at + 1] = make(x + 1.0, y + 0.5, z + 1.0);
        }
        if crossed(3, 7) {
            self.along_z[at + nx + 1] = make(x + 1.0, y + 1.0, z + 0.5);
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
fn cube_spans(rows: [&[Range<usize>]; 4], spans: &mut Vec<Range<usize>>) {
    spans.clear();
    // A point at 1..nx - 1 belongs to the cubes on both its sides.
    spans.extend(rows.into_iter().flatten().filter(|run| !run.is_empty()).map(|run| run.start - 1..run.end));
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
pub(super) mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::mesh::{Topology, boundary_loops, components, surface_area, volume};

    /// A mask from a function of the point in mm.
    struct Of<F> {
        grid: Grid,
        k: usize,
        inside: F,
    }

    impl<F: Fn(DVec3) -> bool> Mask for Of<F> {
        fn begin_slice(&mut self, k: usize) {
            self.k = k;
        }

        fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>) {
            let first = runs.len();
            for i in 0..self.grid.size[0] {
                if (self.inside)(self.grid.at(i as f64, j as f64, self.k as f64)) {
                    match runs[first..].last_mut() {
                        Some(last) if last.end == i => last.end = i + 1,
                        _ => runs.push(i..i + 1),
                    }
                }
            }
        }
    }

    fn surface_of(grid: Grid, inside: impl Fn(DVec3) -> bool) -> TriMesh {
        let mut mask = Of { grid, k: 0, inside };
        marching_cubes(&grid, &mut mask, &mut |_| ControlFlow::Continue(())).expect("not cancelled")
    }

    fn euler(mesh: &TriMesh, topology: &Topology) -> i64 {
        mesh.positions.len() as i64 - topology.edge_counts().edges as i64 + mesh.triangles.len() as i64
    }

    /// Whether the triangles around every vertex form one fan.
    pub(in crate::phantom) fn vertices_are_manifold(mesh: &TriMesh, topology: &Topology) -> bool {
        (0..mesh.positions.len() as u32).all(|v| {
            let around = topology.triangles(v);
            let links = around.iter().map(|&t| {
                let [a, b, c] = mesh.triangles[t as usize];
                if a == v {
                    (b, c)
                } else if b == v {
                    (c, a)
                } else {
                    (a, b)
                }
            });
            let links: Vec<(u32, u32)> = links.collect();
            let starts = links.iter().filter(|(a, _)| !links.iter().any(|(_, b)| a == b)).count();
            // One chain, or one cycle: walk it.
            let first = links.iter().position(|(a, _)| !links.iter().any(|(_, b)| a == b)).unwrap_or(0);
            let (mut seen, mut at) = (1, links[first].1);
            while seen < links.len() && at != links[first].0 {
                let Some(next) = links.iter().find(|(a, _)| *a == at) else { break };
                (at, seen) = (next.1, seen + 1);
            }
            starts <= 1 && seen == links.len()
        })
    }

    #[test]
    fn a_sphere_has_its_volume_within_the_voxel_bound_and_converges() {
        let radius = 10.0;
        let exact = 4.0 / 3.0 * PI * radius * radius * radius;
        let mut last = f64::INFINITY;
        for step in [1.6, 0.8, 0.4, 0.2] {
            let reach = DVec3::splat(radius);
            let spacing = DVec3::new(step, step, 1.25 * step);
            // Off-centre, so that no symmetry flatters the result.
            let grid = Grid::around(-reach - 0.37 * step, reach, spacing);
            let mesh = surface_of(grid, |p| p.length_squared() < radius * radius);
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            assert_eq!(euler(&mesh, &topology), 2);
            assert_eq!(topology.edge_counts().boundary, 0);
            assert!(vertices_are_manifold(&mesh, &topology));
            let error = (volume(&mesh, &topology) - exact).abs();
            // Half a voxel's diagonal all around is the most that a binary mask can be wrong by.
            assert!(error < 4.0 * PI * radius * radius * spacing.length() / 2.0);
            assert!(error / exact < 0.03 * step && error < last, "{error} at {step}");
            last = error;
            for &p in &mesh.positions {
                assert!((f64::from(p.length()) - radius).abs() <= 0.625 * step + 1e-5);
            }
            // Stair-steps cost area: more than the sphere, less than its voxel hull (3/2 of it on average).
            let ratio = surface_area(&mesh) / (4.0 * PI * radius * radius);
            assert!((1.0..1.5).contains(&ratio), "{ratio}");
        }
    }

    #[test]
    fn a_torus_has_a_hole() {
        let grid = Grid::around(DVec3::new(-8.11, -8.17, -3.13), DVec3::new(8.0, 8.0, 3.0), DVec3::splat(0.5));
        let mesh = surface_of(grid, |p| {
            let ring = p.truncate().length() - 6.0;
            ring * ring + p.z * p.z < 4.0
        });
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        assert_eq!(euler(&mesh, &topology), 0);
        let exact = 2.0 * PI * PI * 6.0 * 4.0;
        let ratio = volume(&mesh, &topology) / exact;
        assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    }

    #[test]
    fn a_cut_tube_has_two_loops_and_the_area_of_a_voxel_tube() {
        struct Tube {
            of: Of<fn(DVec3) -> bool>,
        }
        impl Mask for Tube {
            fn begin_slice(&mut self, k: usize) {
                self.of.begin_slice(k);
            }
            fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>) {
                self.of.row(j, runs);
            }
            fn has_cuts(&mut self, _k: usize) -> bool {
                true
            }
            fn is_cut(&self, centre: DVec3) -> bool {
                // Oblique at the top, square at the bottom.
                centre.z + 0.5 * centre.x > 10.0 || centre.z < -10.0
            }
        }
        let grid = Grid::around(DVec3::new(-5.11, -5.17, -18.0), DVec3::new(5.0, 5.0, 18.0), DVec3::splat(0.5));
        let inside: fn(DVec3) -> bool = |p| p.truncate().length_squared() < 25.0 && p.z.abs() < 17.0;
        let mut tube = Tube { of: Of { grid, k: 0, inside } };
        let mesh = marching_cubes(&grid, &mut tube, &mut |_| ControlFlow::Continue(())).expect("not cancelled");
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        assert_eq!(boundary_loops(&topology).len(), 2);
        assert_eq!(euler(&mesh, &topology), 0);
        assert!(vertices_are_manifold(&mesh, &topology));
        assert!((0..mesh.positions.len() as u32).all(|v| !topology.triangles(v).is_empty()));
        let ratio = volume(&mesh, &topology) / (PI * 25.0 * 20.0);
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }

    #[test]
    fn progress_can_break_off() {
        let grid = Grid::around(DVec3::splat(-2.0), DVec3::splat(2.0), DVec3::ONE);
        let mut mask = Of { grid, k: 0, inside: |p: DVec3| p.length() < 2.0 };
        let mut heard = 0;
        let mesh = marching_cubes(&grid, &mut mask, &mut |_| {
            heard += 1;
            if heard == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!((mesh, heard), (None, 2));
    }

    proptest! {
        #[test]
        fn any_mask_gives_a_closed_manifold_consistently_wound(bits in proptest::collection::vec(any::<bool>(), 216)) {
            let grid = Grid { origin: DVec3::ZERO, spacing: DVec3::ONE, size: [8; 3] };
            let inside = |p: DVec3| {
                let [i, j, k] = p.to_array().map(|c| c as usize);
                (1..7).contains(&i) && (1..7).contains(&j) && (1..7).contains(&k)
                    && bits[(i - 1) + 6 * (j - 1) + 36 * (k - 1)]
            };
            let mesh = surface_of(grid, inside);
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            let counts = topology.edge_counts();
            prop_assert_eq!((counts.boundary, counts.non_manifold, counts.flipped), (0, 0, 0));
            prop_assert!(vertices_are_manifold(&mesh, &topology));
            prop_assert!((0..mesh.positions.len() as u32).all(|v| !topology.triangles(v).is_empty()));
            let mut sorted: Vec<[u32; 3]> = mesh.triangles.clone();
            for t in &mut sorted {
                t.sort_unstable();
            }
            sorted.sort_unstable();
            prop_assert!(sorted.windows(2).all(|w| w[0] != w[1]));
            prop_assert_eq!(components(mesh.positions.len(), &mesh.triangles).of_triangle.len(), mesh.triangles.len());
        }
    }
}
