//! Masks of bodies whose volume and topology are known, of no body at all, and a map of labels whose borders VTK has counted.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};
use proptest::prelude::*;

use super::*;
use crate::{Geometry, Samples, surface};
use lumen_mesh::shapes::vertices_are_manifold;
use lumen_mesh::task::{Budget, Progress, Running};
use lumen_mesh::{Topology, boundary_loops, volume};

const RAW: Relaxation = Relaxation { iterations: 0, ..Relaxation::VTK };

fn grid_of(geometry: Geometry, label: impl Fn([usize; 3]) -> u8) -> Arc<Grid> {
    let [nx, ny, _] = geometry.size;
    let labels = (0..geometry.points()).map(|n| label([n % nx, n / nx % ny, n / (nx * ny)])).collect();
    Arc::new(Grid::new(geometry, Samples::U8(labels), 1.0, 0.0).unwrap())
}

fn mask_of(geometry: Geometry, inside: impl Fn(DVec3) -> bool) -> Arc<Grid> {
    grid_of(geometry, |[i, j, k]| u8::from(inside(geometry.at(i as f64, j as f64, k as f64))))
}

fn body(grid: &Arc<Grid>, relaxation: Relaxation) -> TriMesh {
    surface_nets(grid, Selection::AnyLabel, None, relaxation).unwrap().mesh
}

/// Three labels in a ball of labels, the way `benches/peers/nets.py` makes them.
fn map() -> Arc<Grid> {
    grid_of(Geometry::upright([40, 36, 32], DVec3::new(0.5, 0.5, 1.0), DVec3::ZERO), |[i, j, k]| {
        let [x, y, z] = [i as i32 - 19, j as i32 - 17, 2 * (k as i32 - 15)];
        let is_in = x * x + y * y + z * z < 225;
        match () {
            () if !is_in => 0,
            () if x + 2 * y + z > 8 => 1,
            () if x - y > 3 => 2,
            () => 5,
        }
    })
}

#[test]
fn a_ball_a_torus_and_a_tube_keep_their_volume() {
    let spacing = DVec3::new(0.5, 0.5, 0.6);
    let around = |reach: DVec3| Geometry::around(-reach - 0.11, reach, spacing);
    let ball = mask_of(around(DVec3::splat(5.0)), |p| p.length_squared() < 25.0);
    let torus = mask_of(around(DVec3::new(8.0, 8.0, 3.0)), |p| (p.truncate().length() - 6.0).powi(2) + p.z * p.z < 4.0);
    for (mask, exact, euler) in [(ball, 4.0 / 3.0 * PI * 125.0, 2), (torus, 2.0 * PI * PI * 6.0 * 4.0, 0)] {
        let spacing = mask.geometry().spacing;
        let [nx, ny, nz] = mask.geometry().size;
        let is_in = |n: &usize| mask.value([n % nx, n / nx % ny, n / nx / ny]) > 0.0;
        let voxels = (0..nx * ny * nz).filter(is_in).count() as f64 * spacing.element_product();
        assert!((0.98..1.02).contains(&(voxels / exact)), "{voxels} of {exact}");
        // With its vertices in the middle of their cells the surface holds the voxels. Without a way back walls are drawn
        // inwards, within their cells: by 7 % of a radius of four voxels.
        for (relaxation, range) in
            [(RAW, 0.99999..1.00001), (Relaxation::default(), 0.99..1.01), (Relaxation::VTK, 0.85..1.0)]
        {
            let mesh = body(&mask, relaxation);
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            let counts = topology.edge_counts();
            assert_eq!((counts.boundary, counts.non_manifold, counts.flipped), (0, 0, 0));
            let found = mesh.positions.len() as i64 - counts.edges as i64 + mesh.triangles.len() as i64;
            assert_eq!(found, euler);
            let ratio = volume(&mesh, &topology) / voxels;
            assert!(range.contains(&ratio), "{relaxation:?}: {ratio}");
        }
    }
}

/// A tube of six voxels across, oblique to all axes.
#[test]
fn a_thin_tube_keeps_its_radius_and_loses_steps() {
    let axis = DVec3::new(0.36, 0.21, 0.91).normalize();
    let geometry = Geometry::around(DVec3::splat(-12.03), DVec3::splat(12.0), DVec3::splat(0.5));
    let radius = 1.5;
    let mask = mask_of(geometry, |p| (p - axis * p.dot(axis)).length() < radius);
    // The mean distance from the axis and the angle from the radius, weighted by area, away from the faces.
    let measured = |mesh: &TriMesh| {
        let [mut area, mut distance, mut square] = [0.0; 3];
        for corners in (0..mesh.triangles.len()).map(|t| mesh.corners(t).map(DVec3::from)) {
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let out = middle - axis * middle.dot(axis);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            if middle.dot(axis).abs() < 8.0 && normal.length() > 1e-9 {
                area += normal.length();
                distance += normal.length() * out.length();
                square += normal.length() * normal.angle_between(out).to_degrees().powi(2);
            }
        }
        (distance / area / radius - 1.0, (square / area).sqrt())
    };
    let (error, angle) = measured(&body(&mask, Relaxation::default()));
    assert!(error.abs() < 0.02 && angle < 18.0, "{error}, {angle}");
    let (of_vtk, _) = measured(&body(&mask, Relaxation::VTK));
    assert!(of_vtk < -0.08, "{of_vtk}");
    let (_, of_cubes) = measured(&surface(&mask, Selection::AnyLabel, None).unwrap());
    assert!(of_cubes > 22.0, "{of_cubes}");
}

#[test]
fn a_surface_is_open_at_the_faces_and_at_a_box_and_reaches_them() {
    // An oblique tube through all slices, on axes of a left hand.
    let direction = DMat3::from_cols(DVec3::Y, DVec3::X, DVec3::Z);
    let geometry =
        Geometry { size: [30, 28, 20], spacing: DVec3::new(0.5, 0.6, 0.75), origin: DVec3::splat(3.0), direction };
    let mask = grid_of(geometry, |[i, j, k]| {
        let [x, y] = [2 * i as i32 - 25 - k as i32 / 2, 2 * j as i32 - 27];
        u8::from(x * x + y * y < 150)
    });
    let region = Region { first: [0, 0, 4], last: [29, 27, 15] };
    for (region, slices) in [(None, [0, 19]), (Some(region), [4, 15])] {
        let nets = surface_nets(&mask, Selection::Label(1), region, Relaxation::default()).unwrap().mesh;
        let cubes = surface(&mask, Selection::Label(1), region).unwrap();
        let topology = Topology::new(nets.positions.len(), &nets.triangles);
        assert_eq!((boundary_loops(&topology).len(), topology.edge_counts().non_manifold), (2, 0));
        assert!(vertices_are_manifold(&nets, &topology));
        let ends = slices.map(|k| geometry.at(0.0, 0.0, f64::from(k)).z as f32);
        let reached = nets.positions.iter().fold([f32::MAX, f32::MIN], |[low, high], p| [low.min(p.z), high.max(p.z)]);
        assert_eq!(reached, ends);
        let of_cubes = volume(&cubes, &Topology::new(cubes.positions.len(), &cubes.triangles));
        let ratio = volume(&nets, &topology) / of_cubes;
        assert!((0.99..1.01).contains(&ratio), "{ratio}");
    }
}

/// VTK 9.7.2, `python benches/peers/nets.py`: triangles, how many lie between which labels, and places of vertices.
#[test]
fn a_map_of_labels_has_the_borders_that_vtk_counts() {
    let surface = surface_nets(&map(), Selection::EachLabel, None, RAW).unwrap();
    let between = |sides| surface.sides.iter().filter(|&&found| found == sides).count();
    let found = [[1, 0], [2, 0], [5, 0], [1, 2], [1, 5], [2, 5]].map(between);
    assert_eq!((surface.mesh.triangles.len(), found), (7524, [2090, 1714, 1792, 440, 846, 642]));
    assert_eq!(surface.mesh.positions.len(), 3656);
}

#[test]
fn the_surface_of_every_label_of_a_map_is_closed_and_wound_outwards() {
    let map = map();
    let surface = surface_nets(&map, Selection::EachLabel, None, Relaxation::default()).unwrap();
    let voxel = map.geometry().spacing.element_product();
    let mut sum = 0.0;
    for label in [1, 2, 5] {
        let of_label = surface.mesh.triangles.iter().zip(&surface.sides);
        let triangles: Vec<[u32; 3]> = of_label
            .filter(|(_, sides)| sides.contains(&label))
            .map(|(&[a, b, c], sides)| if sides[0] == label { [a, b, c] } else { [a, c, b] })
            .collect();
        let alone = TriMesh { positions: surface.mesh.positions.clone(), triangles };
        let topology = Topology::new(alone.positions.len(), &alone.triangles);
        let counts = topology.edge_counts();
        assert_eq!((counts.boundary, counts.flipped), (0, 0), "label {label}");
        let own = volume(&alone, &topology);
        let voxels = (0..map.samples().len()).filter(|&n| map.samples().stored(n) == f64::from(label)).count();
        assert!((own / (voxels as f64 * voxel) - 1.0).abs() < 0.1, "label {label}: {own} mm3, {voxels} voxels");
        sum += own;
    }
    let whole = body(&map, Relaxation::default());
    let of_whole = volume(&whole, &Topology::new(whole.positions.len(), &whole.triangles));
    // Rims of borders on the outer wall relax along themselves.
    assert!((sum / of_whole - 1.0).abs() < 0.01, "{sum} of {of_whole} mm3");
}

#[test]
fn a_slice_of_work_leaves_the_surface_the_same() {
    let map = map();
    let (relaxation, own) = (Relaxation::default(), Arc::clone(&map));
    let mut running = Running::new(|yielder| async move {
        surface_nets_in_slices(&own, Cut::new(Selection::EachLabel), relaxation, &yielder).await.unwrap()
    });
    let mut rests = 0;
    let found = loop {
        match running.advance(Budget::new(std::time::Duration::ZERO)) {
            Progress::Working(fraction) => {
                assert!((0.0..=1.0).contains(&fraction));
                rests += 1;
            }
            Progress::Done(found) => break found,
        }
    };
    assert!(rests > 32 + 20, "{rests}");
    assert_eq!(found, surface_nets(&map, Selection::EachLabel, None, relaxation).unwrap());
}

#[test]
fn nothing_but_one_side_is_refused() {
    let empty = grid_of(Geometry::upright([4; 3], DVec3::ONE, DVec3::ZERO), |_| 0);
    assert_eq!(surface_nets(&empty, Selection::AnyLabel, None, RAW), Err(VolumeError::NothingThere));
}

proptest! {
    #[test]
    fn any_mask_gives_a_closed_manifold_within_the_cells(
        bits in proptest::collection::vec(any::<bool>(), 216),
        iterations in 0u32..20,
        relaxation in prop::sample::select(vec![Relaxation::VTK, Relaxation::default()]),
    ) {
        let geometry = Geometry::upright([8; 3], DVec3::ONE, DVec3::ZERO);
        let is_inner = |along| (1..7).contains(&along);
        let mask = grid_of(geometry, |[i, j, k]| {
            u8::from([i, j, k].into_iter().all(is_inner) && bits[(i - 1) + 6 * (j - 1) + 36 * (k - 1)])
        });
        prop_assume!(bits.contains(&true));
        let mesh = body(&mask, Relaxation { iterations, ..relaxation });
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let counts = topology.edge_counts();
        prop_assert_eq!((counts.boundary, counts.non_manifold, counts.flipped), (0, 0, 0));
        prop_assert!(vertices_are_manifold(&mesh, &topology));
        // One quadrilateral for each vertex of marching cubes, of which some edges are split.
        let cubes = surface(&mask, Selection::AnyLabel, None).unwrap();
        prop_assert!(mesh.triangles.len() >= 2 * cubes.positions.len());
        prop_assert_eq!(mesh.triangles.len() % 2, 0);
        for triangle in &mesh.triangles {
            let corners = triangle.map(|v| mesh.positions[v as usize]);
            // All lie in the four cells around an edge of the grid.
            let size = corners[0].max(corners[1]).max(corners[2]) - corners[0].min(corners[1]).min(corners[2]);
            prop_assert!(size.max_element() <= 2.0 && size.min_element() <= 1.0);
        }
    }

    #[test]
    fn any_map_of_labels_closes_around_each(labels in proptest::collection::vec(0u8..4, 64)) {
        let geometry = Geometry::upright([6; 3], DVec3::ONE, DVec3::ZERO);
        let is_inner = |along| (1..5).contains(&along);
        let map = grid_of(geometry, |[i, j, k]| {
            if [i, j, k].into_iter().all(is_inner) { labels[(i - 1) + 4 * (j - 1) + 16 * (k - 1)] } else { 0 }
        });
        prop_assume!(labels.iter().any(|&label| label > 0));
        let surface = surface_nets(&map, Selection::EachLabel, None, Relaxation::default()).unwrap();
        for label in 1..4 {
            // As often one way as the other along every edge.
            let mut along = std::collections::BTreeMap::new();
            for (&[a, b, c], sides) in surface.mesh.triangles.iter().zip(&surface.sides) {
                let sign = i32::from(sides[0] == label) - i32::from(sides[1] == label);
                for [a, b] in [[a, b], [b, c], [c, a]] {
                    *along.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { sign } else { -sign };
                }
            }
            prop_assert!(along.values().all(|&sum| sum == 0));
        }
    }
}
