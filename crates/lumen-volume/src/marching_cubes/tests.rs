//! Masks of bodies whose volume, area and topology are known, and of no body at all: what the surface of each has to be.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use lumen_mesh::shapes::vertices_are_manifold;
use lumen_mesh::task::{Budget, Progress, Running, at_once};
use lumen_mesh::{Topology, boundary_loops, components, surface_area, volume};

/// A mask from a function of the point in mm.
struct Of<F> {
    grid: Geometry,
    k: usize,
    inside: F,
}

impl<F: Fn(DVec3) -> bool> Mask for Of<F> {
    const CLOSED: bool = true;

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

fn whole<M: Mask>(cubes: MarchingCubes<M>) -> TriMesh {
    at_once(cubes.surface(usize::MAX, &Yielder::never())).unwrap()
}

fn surface_of(grid: Geometry, inside: impl Fn(DVec3) -> bool) -> TriMesh {
    whole(MarchingCubes::new(&grid, Of { grid, k: 0, inside }))
}

fn euler(mesh: &TriMesh, topology: &Topology) -> i64 {
    mesh.positions.len() as i64 - topology.edge_counts().edges as i64 + mesh.triangles.len() as i64
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
        let grid = Geometry::around(-reach - 0.37 * step, reach, spacing);
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
    let grid = Geometry::around(DVec3::new(-8.11, -8.17, -3.13), DVec3::new(8.0, 8.0, 3.0), DVec3::splat(0.5));
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
        const CLOSED: bool = true;

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
    let grid = Geometry::around(DVec3::new(-5.11, -5.17, -18.0), DVec3::new(5.0, 5.0, 18.0), DVec3::splat(0.5));
    let inside: fn(DVec3) -> bool = |p| p.truncate().length_squared() < 25.0 && p.z.abs() < 17.0;
    let mesh = whole(MarchingCubes::new(&grid, Tube { of: Of { grid, k: 0, inside } }));
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    assert_eq!(boundary_loops(&topology).len(), 2);
    assert_eq!(euler(&mesh, &topology), 0);
    assert!(vertices_are_manifold(&mesh, &topology));
    assert!((0..mesh.positions.len() as u32).all(|v| !topology.triangles(v).is_empty()));
    let ratio = volume(&mesh, &topology) / (PI * 25.0 * 20.0);
    assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
}

#[test]
fn a_slice_of_work_is_a_layer_and_the_surface_the_same() {
    let grid = Geometry::around(DVec3::splat(-2.0), DVec3::splat(2.0), DVec3::ONE);
    let inside = |p: DVec3| p.length() < 2.0;
    let cubes = MarchingCubes::new(&grid, Of { grid, k: 0, inside });
    let mut running = Running::new(|yielder| async move { cubes.surface(usize::MAX, &yielder).await.unwrap() });
    let mut fractions = Vec::new();
    let mesh = loop {
        match running.advance(Budget::new(std::time::Duration::ZERO)) {
            Progress::Working(fraction) => fractions.push(fraction),
            Progress::Done(mesh) => break mesh,
        }
    };
    assert_eq!(fractions.len(), grid.size[2] - 2);
    assert!(fractions.is_sorted() && fractions.iter().all(|fraction| (0.0..1.0).contains(fraction)));
    assert_eq!(mesh, surface_of(grid, inside));
}

proptest! {
    #[test]
    fn any_mask_gives_a_closed_manifold_consistently_wound(bits in proptest::collection::vec(any::<bool>(), 216)) {
        let grid = Geometry::upright([8; 3], DVec3::ONE, DVec3::ZERO);
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
