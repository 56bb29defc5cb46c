use std::f64::consts::{PI, TAU};

use lumen_mesh::mending::{Mending, mend};
use lumen_mesh::shapes::{fork, icosphere, joined, sagitta, tube};
use lumen_mesh::split_mix::SplitMix64;
use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{SurfaceIndex, Topology, boundary_loops, surface_area, volume};

use super::*;
use crate::{Patch, PatchKind};

/// Surfaces that a test makes by chance.
const CASES: usize = 40;

fn uniform(mm: f64) -> Sizing {
    Sizing { least_mm: mm, largest_mm: mm, ..Sizing::default() }
}

fn euler(mesh: &TriMesh) -> i64 {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    mesh.positions.len() as i64 - topology.edge_counts().edges as i64 + mesh.triangles.len() as i64
}

fn assert_good(found: &Remeshed) {
    let Quality { mean, below_30_deg, .. } = found.quality();
    assert!(mean >= 0.95 && below_30_deg <= 0.001, "{:?}", found.quality());
    assert!(found.crossing.is_empty(), "{:?}", found.crossing);
}

#[test]
fn a_sphere_gets_even_triangles_of_the_wanted_length_on_itself() {
    let sphere = icosphere(5, 10.0, Vec3::ONE);
    let deep = sagitta(&sphere, 10.0, Vec3::ONE);
    for mm in [0.4, 1.0, 2.0] {
        let found = remesh(&Patched::wall(sphere.clone()), &vec![10.0; sphere.positions.len()], &uniform(mm)).unwrap();
        let mesh = &found.surface.mesh;
        for p in &mesh.positions {
            let radius = p.distance(Vec3::ONE);
            assert!(radius <= 10.0 + 1e-5 && radius >= 10.0 - deep - 1e-5, "{radius}");
        }
        assert_good(&found);
        assert_eq!(euler(mesh), 2);
        // Of that many equilateral triangles.
        let side = (surface_area(mesh) / mesh.triangles.len() as f64 * 4.0 / 3.0f64.sqrt()).sqrt();
        assert!((side / mm - 1.0).abs() < 0.15, "{side}");
    }
}

#[test]
fn walls_that_nearly_touch_stay_each_where_it_is() {
    // A ball in a hollow, and edges so long that their middles lie beyond the other wall.
    let (radius, gap) = (10.0, 0.02);
    let ball = icosphere(5, radius, Vec3::ZERO);
    let deep = sagitta(&ball, radius, Vec3::ZERO);
    assert!(deep < gap / 4.0);
    let mut hollow = icosphere(5, radius + gap, Vec3::ZERO);
    hollow.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let both = joined(&[ball, hollow]);
    let found = remesh(&Patched::wall(both.clone()), &vec![10.0; both.positions.len()], &uniform(2.0)).unwrap();
    let mesh = &found.surface.mesh;
    let mut walls = [0, 0];
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        let is_hollow = doubled(corners).dot(corners[0]) < 0.0;
        walls[usize::from(is_hollow)] += 1;
        let own = if is_hollow { radius + gap } else { radius };
        for r in corners.map(Vec3::length) {
            assert!((own - deep - 1e-5..=own + 1e-5).contains(&r), "{r} for {own}");
        }
    }
    assert!(walls.iter().all(|&count| count > 100), "{walls:?}");
}

#[test]
fn edges_follow_the_radius_of_a_tube_and_its_rims_stay() {
    let radius = |z: f32| 2.0 + (z / 30.0) * 2.0;
    let mesh = tube(60, 150, 30.0, radius);
    let radii: Vec<f32> = mesh.positions.iter().map(|p| radius(p.z)).collect();
    let found = remesh(&Patched::wall(mesh.clone()), &radii, &Sizing::default()).unwrap();
    assert_good(&found);
    let new = &found.surface.mesh;
    let topology = Topology::new(new.positions.len(), &new.triangles);
    let mut ratios = Vec::new();
    for (a, b, _) in topology.edges() {
        let [p, q] = [a, b].map(|v| new.positions[v as usize]);
        let wanted = TAU * f64::from(radius(f32::midpoint(p.z, q.z))) / 12.0;
        ratios.push(f64::from(p.distance(q)) / wanted);
    }
    let near = ratios.iter().filter(|ratio| (0.65..1.35).contains(*ratio)).count();
    assert!(near as f64 >= 0.97 * ratios.len() as f64);
    assert!(ratios.iter().all(|ratio| (0.6..1.5).contains(ratio)), "{ratios:?}");
    let loops = boundary_loops(&topology);
    assert_eq!(loops.len(), 2);
    for rim in loops {
        let z = new.positions[rim[0] as usize].z;
        assert!(z == 0.0 || z == 30.0);
        for v in rim {
            let p = new.positions[v as usize];
            // The rim of 60 sides lies within its own sagitta of the circle.
            let deep = radius(z) * (1.0 - libm::cosf(std::f32::consts::PI / 60.0));
            assert!(p.z == z && p.truncate().length() > radius(z) - deep - 1e-4);
        }
    }
}

/// A closed cylinder: wall, inlet at z = 0, outlet at z = `length`.
fn capped(sides: u32, rings: u32, length: f32, radius: f32) -> Patched {
    let mut mesh = tube(sides, rings, length, |_| radius);
    let mut of_triangle = vec![0; mesh.triangles.len()];
    let last = sides * rings;
    for (patch, first, z) in [(1, 0, 0.0), (2, last, length)] {
        let hub = mesh.positions.len() as u32;
        mesh.positions.push(Vec3::new(0.0, 0.0, z));
        for side in 0..sides {
            let (a, b) = (first + side, first + (side + 1) % sides);
            mesh.triangles.push(if patch == 1 { [hub, b, a] } else { [hub, a, b] });
            of_triangle.push(patch);
        }
    }
    let cap = |id: u32, kind: PatchKind| Patch { id, kind, ..Patch::wall() };
    Patched { mesh, of_triangle, patches: vec![Patch::wall(), cap(2, PatchKind::Inlet), cap(3, PatchKind::Outlet)] }
}

#[test]
fn the_calibre_of_a_tube_stays() {
    let mesh = tube(120, 200, 40.0, |_| 2.0);
    let measured = |mesh: &TriMesh| volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles)) / 40.0;
    let before = (measured(&mesh) / PI).sqrt();
    for (around, part) in [(12.0, 0.03), (24.0, 0.01)] {
        let radii = vec![2.0; mesh.positions.len()];
        let found = remesh(&Patched::wall(mesh.clone()), &radii, &Sizing { around, ..Sizing::default() }).unwrap();
        let after = (measured(&found.surface.mesh) / PI).sqrt();
        assert!((after / before - 1.0).abs() < part);
    }
}

#[test]
fn caps_stay_flat_round_and_watertight() {
    let surface = capped(96, 60, 20.0, 3.0);
    let radii = vec![3.0; surface.mesh.positions.len()];
    let found = remesh(&surface, &radii, &Sizing { around: 60.0, ..Sizing::default() }).unwrap();
    assert_good(&found);
    let Patched { mesh, of_triangle, .. } = &found.surface;
    let edges = Topology::new(mesh.positions.len(), &mesh.triangles).edge_counts();
    assert_eq!((edges.boundary, edges.non_manifold, edges.flipped), (0, 0, 0));
    assert_eq!(euler(mesh), 2);
    for (patch, z) in [(1, 0.0f32), (2, 20.0)] {
        let mut area = 0.0;
        for t in (0..mesh.triangles.len()).filter(|&t| of_triangle[t] == patch) {
            area += triangle_area(mesh.corners(t));
            assert!(mesh.corners(t).iter().all(|p| (p.z - z).abs() < 1e-4));
        }
        assert!((area / (PI * 9.0) - 1.0).abs() < 0.005, "{area}");
    }
    for (&from, &patch) in found.triangle_sources().iter().zip(of_triangle) {
        assert_eq!(surface.of_triangle[from as usize], patch);
    }
}

fn cube(size: f32) -> TriMesh {
    let positions = (0..8u32).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * size);
    let quads = [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriMesh { positions: positions.collect(), triangles }
}

#[test]
fn a_cube_keeps_its_edges_corners_and_volume() {
    let mesh = cube(10.0);
    let found = remesh(&Patched::wall(mesh), &[f32::INFINITY; 8], &uniform(0.9)).unwrap();
    let new = &found.surface.mesh;
    assert_eq!((found.curves, found.corners), (12, 8));
    let topology = Topology::new(new.positions.len(), &new.triangles);
    assert!((volume(new, &topology) - 1000.0).abs() < 1e-2);
    assert!((surface_area(new) - 600.0).abs() < 1e-2);
    assert!(found.deviation().to_new_mm < 1e-5 && found.deviation().to_old_mm < 1e-5);
    assert_good(&found);
}

#[test]
fn neighbouring_triangles_are_of_like_size() {
    let mesh = tube(60, 150, 40.0, |_| 5.0);
    // A narrow mark at one place, the rest unknown.
    let radii: Vec<f32> = mesh.positions.iter().map(|p| if p.z < 1.0 { 0.5 } else { f32::INFINITY }).collect();
    let found = remesh(&Patched::wall(mesh), &radii, &Sizing { largest_mm: 2.5, ..Sizing::default() }).unwrap();
    assert_good(&found);
    let new = &found.surface.mesh;
    let side = |t: usize| {
        let [a, b, c] = new.corners(t);
        f64::from(a.distance(b) + b.distance(c) + c.distance(a)) / 3.0
    };
    let topology = Topology::new(new.positions.len(), &new.triangles);
    let mut ratios = Vec::new();
    for (a, b, edge) in topology.edges() {
        let beside: Vec<u32> = topology.triangles_on(&new.triangles, a, b).collect();
        if edge.triangles() == 2 {
            let [one, other] = [beside[0], beside[1]].map(|t| side(t as usize));
            ratios.push(one.max(other) / one.min(other));
        }
    }
    ratios.sort_by(f64::total_cmp);
    let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize];
    assert!(at(0.99) <= 1.3);
    let largest = (0..new.triangles.len()).map(side).fold(0.0, f64::max);
    assert!(largest > 2.0, "sizes grow away from the mark: {largest}");
}

#[test]
fn a_fork_of_three_calibres_is_remeshed() {
    // The isosurface has slivers that face inwards.
    let mending = Mending { weld_mm: None, split: true, fill_mm: None, lumen: false };
    let mesh = at_once(mend(fork().0, Vec::new(), mending, &Yielder::never())).mesh;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
    let radii = lumen_mesh::inner_radii(&mesh, &topology, &index).radii;
    let before = volume(&mesh, &topology);
    let found = remesh(&Patched::wall(mesh), &radii, &Sizing::default()).unwrap();
    assert_good(&found);
    let new = &found.surface.mesh;
    assert_eq!(euler(new), 2);
    let after = volume(new, &Topology::new(new.positions.len(), &new.triangles));
    assert!((after / before - 1.0).abs() < 0.05, "{before} {after}");
}

#[test]
fn the_deviation_keeps_to_its_bound_on_both_sides() {
    let sphere = icosphere(5, 10.0, Vec3::ONE);
    let sizing = Sizing { largest_mm: 8.0, max_deviation_mm: Some(0.05), ..Sizing::default() };
    let found = remesh(&Patched::wall(sphere.clone()), &vec![f32::INFINITY; sphere.positions.len()], &sizing).unwrap();
    assert_good(&found);
    assert!(found.deviation().to_old_mm <= 0.05 && found.deviation().to_new_mm <= 0.05, "{:?}", found.deviation());
    // A triangle whose middle lies 0.05 mm below the sphere has sides of 1.73 mm: there are 967 of them.
    let count = found.surface.mesh.triangles.len();
    assert!((900..3000).contains(&count), "{count}");
}

#[test]
fn deviations_are_those_of_each_sample_by_itself() {
    // Rims, curvature, and edges long enough to cut corners.
    let mesh = tube(40, 30, 20.0, |z| 2.0 + (z - 10.0) * (z - 10.0) / 60.0);
    let found = remesh(&Patched::wall(mesh.clone()), &vec![2.0; mesh.positions.len()], &uniform(1.5)).unwrap();
    let farthest = |of: &TriMesh, from: &TriMesh| {
        let index = SurfaceIndex::new(&from.positions, &from.triangles);
        let all = (0..of.triangles.len()).flat_map(|t| samples(of.corners(t)));
        all.map(|p| f64::from(index.nearest(p).unwrap().distance)).fold(0.0, f64::max)
    };
    let new = &found.surface.mesh;
    assert!((found.deviation().to_old_mm - farthest(new, &mesh)).abs() < 1e-6);
    assert!((found.deviation().to_new_mm - farthest(&mesh, new)).abs() < 1e-6);
    assert!(found.deviation().to_new_mm > 0.1);
}

#[test]
fn of_creases_without_room_between_one_is_kept() {
    let plate = |thick: f32| {
        let mut mesh = cube(10.0);
        mesh.positions.iter_mut().for_each(|p| p.z *= thick / 10.0);
        remesh(&Patched::wall(mesh), &[f32::INFINITY; 8], &uniform(1.0)).unwrap()
    };
    let thick = plate(2.0);
    assert_eq!((thick.curves, thick.corners), (12, 8));
    assert!(thick.quality().below_30_deg <= 0.001, "{:?}", thick.quality());
    // Without the creases of one side this plate would cross itself: they are kept at the cost of angles.
    let thin = plate(0.3);
    for found in [&thick, &thin] {
        assert!(found.crossing.is_empty(), "{:?}", found.crossing);
        assert_eq!(euler(&found.surface.mesh), 2);
    }
    assert_eq!((thin.curves, thin.corners), (8, 8));
    let thin = plate(0.39);
    assert_eq!((thin.curves, thin.corners), (4, 4));
    assert!(thin.crossing.is_empty() && thin.quality().below_30_deg <= 0.001, "{:?}", thin.quality());
}

#[test]
fn a_spike_narrower_than_a_triangle_goes() {
    let mut mesh = icosphere(4, 10.0, Vec3::ZERO);
    let base = mesh.triangles[100];
    let middle = base.map(|v| mesh.positions[v as usize]).iter().sum::<Vec3>() / 3.0;
    let first = mesh.positions.len() as u32;
    // A neck, and a tip that is turned and shifted against it, so that its sides are slivers of every direction.
    for (part, out, turn) in [(0.1, 0.2, 0), (0.03, 0.4, 1)] {
        for i in 0..3 {
            let corner = mesh.positions[base[(i + turn) % 3] as usize];
            mesh.positions.push(middle.lerp(corner, part) * (1.0 + out / 10.0));
        }
    }
    mesh.triangles.swap_remove(100);
    let mut sides = |low: [u32; 3], high: [u32; 3]| {
        for i in 0..3 {
            let j = (i + 1) % 3;
            mesh.triangles.extend([[low[i], low[j], high[j]], [low[i], high[j], high[i]]]);
        }
    };
    let [neck, tip] = [0, 3].map(|from| [first + from, first + from + 1, first + from + 2]);
    sides(base, neck);
    sides(neck, tip);
    mesh.triangles.push(tip);
    let radii = vec![10.0; mesh.positions.len()];
    let found = remesh(&Patched::wall(mesh), &radii, &uniform(2.0)).unwrap();
    assert_good(&found);
    assert_eq!(euler(&found.surface.mesh), 2);
}

#[test]
fn vertices_blend_linear_values_of_the_old_ones() {
    let surface = capped(96, 60, 20.0, 3.0);
    let radii = vec![3.0; surface.mesh.positions.len()];
    let found = remesh(&surface, &radii, &Sizing { around: 20.0, ..Sizing::default() }).unwrap();
    let heights: Vec<f32> = surface.mesh.positions.iter().map(|p| p.z).collect();
    let array = lumen_mesh::Array::new(
        "z",
        lumen_mesh::arrays::Association::Point,
        1,
        lumen_mesh::arrays::Values::from_floats(&heights),
    );
    let blended =
        lumen_mesh::blended(&[array], &found.vertex_sources(), &Blend::of_rows(found.triangle_sources().into_iter()));
    for (v, p) in found.surface.mesh.positions.iter().enumerate() {
        assert!((blended[0].values.get(v) as f32 - p.z).abs() < 1e-4);
    }
}

#[test]
fn the_same_surface_comes_out_with_any_number_of_threads() {
    let mesh = tube(40, 60, 20.0, |z| 2.0 + z / 20.0);
    let radii = vec![2.0; mesh.positions.len()];
    let of = |threads| {
        let surface = Patched::wall(mesh.clone());
        lumen_mesh::parallel::with_threads(threads, || remesh(&surface, &radii, &Sizing::default()).unwrap().surface)
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn rough_surfaces_keep_their_topology() {
    let mut sphere = icosphere(4, 10.0, Vec3::ZERO);
    // Noise of 0.3 mm, about the length of an edge.
    for (i, p) in sphere.positions.iter_mut().enumerate() {
        let part = |step: u32| ((i as u32 + 1).wrapping_mul(step) >> 8) as f32 / (1 << 23) as f32 - 1.0;
        *p += Vec3::new(part(3_518_319_155), part(2_882_110_345), part(2_360_945_575)) * 0.3;
    }
    for mm in [0.3, 1.0, 4.0, 50.0] {
        let radii = vec![10.0; sphere.positions.len()];
        let found = remesh(&Patched::wall(sphere.clone()), &radii, &uniform(mm)).unwrap();
        let mesh = &found.surface.mesh;
        let edges = Topology::new(mesh.positions.len(), &mesh.triangles).edge_counts();
        assert_eq!((edges.boundary, edges.non_manifold, edges.flipped), (0, 0, 0), "{mm}");
        assert_eq!(euler(mesh), 2, "{mm}");
        assert!(mesh.positions.iter().all(|p| p.is_finite()));
    }
}

#[test]
fn triangles_that_face_inwards_stay_so() {
    let mut sphere = icosphere(3, 5.0, Vec3::ZERO);
    sphere.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let radii = vec![5.0; sphere.positions.len()];
    let found = remesh(&Patched::wall(sphere), &radii, &uniform(1.0)).unwrap();
    let mesh = &found.surface.mesh;
    assert!(volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles)) < -480.0);
    assert_good(&found);
}

#[test]
fn one_triangle_is_remeshed_within_itself() {
    let positions = vec![Vec3::ZERO, Vec3::X * 10.0, Vec3::Y * 10.0];
    let mesh = TriMesh { positions, triangles: vec![[0, 1, 2]] };
    let found = remesh(&Patched::wall(mesh.clone()), &[f32::INFINITY; 3], &uniform(1.0)).unwrap();
    assert!((surface_area(&found.surface.mesh) - 50.0).abs() < 1e-4);
    assert_eq!(found.corners, 3);
    // Larger triangles than there is room for: it stays.
    let found = remesh(&Patched::wall(mesh), &[f32::INFINITY; 3], &uniform(100.0)).unwrap();
    assert_eq!(found.surface.mesh.triangles.len(), 1);
}

#[test]
fn fans_that_touch_in_a_vertex_still_do() {
    let positions = vec![
        Vec3::ZERO,
        Vec3::new(4.0, 1.0, 0.0),
        Vec3::new(4.0, -1.0, 1.0),
        Vec3::new(-4.0, 1.0, 0.0),
        Vec3::new(-4.0, -1.0, 1.0),
    ];
    let mesh = TriMesh { positions, triangles: vec![[0, 2, 1], [0, 3, 4]] };
    let found = remesh(&Patched::wall(mesh), &[f32::INFINITY; 5], &uniform(0.5)).unwrap();
    let mesh = &found.surface.mesh;
    assert_eq!(mesh.positions.iter().filter(|&&p| p == Vec3::ZERO).count(), 1);
    assert!(mesh.triangles.len() > 40);
}

#[test]
fn degenerate_triangles_do_no_harm() {
    let mut mesh = icosphere(3, 5.0, Vec3::ZERO);
    // A triangle that repeats a vertex, and vertices moved onto their neighbours.
    mesh.triangles.push([0, 0, 1]);
    for t in [10, 50, 90] {
        let [a, b, _] = mesh.triangles[t];
        mesh.positions[a as usize] = mesh.positions[b as usize];
    }
    let radii = vec![5.0; mesh.positions.len()];
    for mm in [0.3, 1.0] {
        let found = remesh(&Patched::wall(mesh.clone()), &radii, &uniform(mm)).unwrap();
        assert_good(&found);
        assert_eq!(euler(&found.surface.mesh), 2);
        assert!(found.triangle_sources().iter().all(|&t| t < 1280));
    }
}

#[test]
fn what_cannot_be_remeshed_is_refused_with_its_reason() {
    let tetrahedron = || {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        Patched::wall(TriMesh { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] })
    };
    let refused = |surface: &Patched, radii: &[f32], sizing: &Sizing| remesh(surface, radii, sizing).unwrap_err();
    let (radii, sizing) = ([1.0; 4], Sizing::default());
    assert_eq!(refused(&Patched::default(), &[], &sizing), RemeshError::Empty);
    assert!(matches!(refused(&tetrahedron(), &[1.0; 3], &sizing), RemeshError::Length { found: 3, expected: 4, .. }));
    assert_eq!(
        refused(&tetrahedron(), &[1.0, -1.0, 1.0, 1.0], &sizing),
        RemeshError::Radius { vertex: 1, radius: -1.0 }
    );
    let mut surface = tetrahedron();
    surface.mesh.positions[2].y = f32::NAN;
    assert_eq!(refused(&surface, &radii, &sizing), RemeshError::OutOfRange { vertex: 2 });
    surface.mesh.positions[2].y = 1e30;
    assert_eq!(refused(&surface, &radii, &sizing), RemeshError::OutOfRange { vertex: 2 });
    let mut surface = tetrahedron();
    surface.mesh.triangles[1][2] = 9;
    assert!(matches!(refused(&surface, &radii, &sizing), RemeshError::Index { triangle: 1, index: 9, .. }));
    let mut surface = tetrahedron();
    surface.of_triangle[3] = 1;
    assert!(matches!(refused(&surface, &radii, &sizing), RemeshError::Index { triangle: 3, index: 1, .. }));
    let mut surface = tetrahedron();
    surface.of_triangle.pop();
    assert!(matches!(refused(&surface, &radii, &sizing), RemeshError::Length { found: 3, expected: 4, .. }));
    let mut surface = tetrahedron();
    surface.mesh.triangles.push([0, 1, 2]);
    surface.of_triangle.push(0);
    assert_eq!(refused(&surface, &radii, &sizing), RemeshError::NonManifold { edges: 3 });
    let mut surface = tetrahedron();
    surface.mesh.triangles[0].swap(0, 1);
    assert_eq!(refused(&surface, &radii, &sizing), RemeshError::Flipped { edges: 3 });
    for wrong in [
        Sizing { around: f64::NAN, ..sizing },
        Sizing { around: 2.0, ..sizing },
        Sizing { least_mm: 0.0, ..sizing },
        Sizing { largest_mm: 0.01, ..sizing },
        Sizing { growth: 1.0, ..sizing },
        Sizing { max_deviation_mm: Some(0.0), ..sizing },
    ] {
        assert!(matches!(refused(&tetrahedron(), &radii, &wrong), RemeshError::Sizing(_)));
    }
    let huge = Sizing { least_mm: 1e-5, largest_mm: 1e-5, ..sizing };
    assert!(matches!(refused(&tetrahedron(), &radii, &huge), RemeshError::TooMany { .. }));
}

#[test]
fn whatever_enters_comes_out_with_its_topology_or_an_error() {
    let mut random = SplitMix64::new(7);
    for _ in 0..CASES {
        let mut below = |n: u64| random.bits() % n;
        let mut mesh = if below(2) == 0 { icosphere(2, 3.0, Vec3::ZERO) } else { tube(9, 8, 10.0, |_| 2.0) };
        let before = (euler(&mesh), boundary_loops(&Topology::new(mesh.positions.len(), &mesh.triangles)).len());
        let count = mesh.positions.len() as u64;
        let (spread, least_mm) = [(0.0, 0.3), (0.1, 0.5), (1.0, 2.0), (3.0, 10.0), (1e5, 1e5)][below(5) as usize];
        for p in &mut mesh.positions {
            *p += Vec3::new(below(2001) as f32 - 1000.0, below(2001) as f32 - 1000.0, below(2001) as f32 - 1000.0)
                * (spread / 1000.0);
        }
        for _ in 0..[0, 3, 60][below(3) as usize] {
            mesh.positions[below(count) as usize] = mesh.positions[below(count) as usize];
        }
        let patches = 1 + below(3);
        let of_triangle =
            mesh.triangles.iter().map(|_| if below(4) == 0 { below(patches) as u32 } else { 0 }).collect();
        let radii: Vec<f32> = (0..count).map(|_| [0.0, 1e-3, 1.0, 5.0, f32::INFINITY][below(5) as usize]).collect();
        let sizing = Sizing {
            least_mm,
            largest_mm: least_mm * [1.0, 3.0, 100.0][below(3) as usize],
            growth: [1.01, 1.3, 10.0][below(3) as usize],
            max_deviation_mm: [None, Some(0.1)][below(2) as usize],
            ..Sizing::default()
        };
        let surface = Patched { mesh, of_triangle, patches: vec![Patch::wall(); patches as usize] };
        let Ok(found) = remesh(&surface, &radii, &sizing) else { continue };
        let new = &found.surface.mesh;
        let topology = Topology::new(new.positions.len(), &new.triangles);
        assert_eq!(topology.edge_counts().non_manifold + topology.edge_counts().flipped, 0);
        assert_eq!((euler(new), boundary_loops(&topology).len()), before);
        assert!(new.positions.iter().all(|p| p.is_finite()));
        assert_eq!(
            (found.triangle_sources().len(), found.vertex_sources().len()),
            (new.triangles.len(), new.positions.len())
        );
    }
}
