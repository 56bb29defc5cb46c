//! The shape of a surface in numbers: roughness, the angles of its triangles, triangles that run into each other, and
//! how narrow its lumen gets.
//!
//! What the smallest lumen is, `lumen_vessel::width` says.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::task::{Yielder, at_once, blocks};
use lumen_mesh::parallel;
use lumen_mesh::{
    AngleCounts, Angles, Crossing, Indexed, InnerRadii, Roughness, SurfaceIndex, Topology, TriMesh, bends,
    inner_radii_in_slices, summarise_bends,
};
use lumen_vessel::width::{Narrowest, narrowest};

/// The shape of a surface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// Dihedral deviation over the inner edges; null where there is none.
    pub roughness: Option<Roughness>,
    /// Angles of the triangles; null without a triangle.
    pub angles: Option<Angles>,
    /// Triangles that run into others, as MeshLab counts them.
    pub self_intersecting_faces: usize,
    /// Where the vessel is narrowest; null where no wall faces another.
    pub smallest_lumen: Option<Narrowest>,
}

/// A shape, and what else was found on the way.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The shape.
    pub shape: Shape,
    /// The inner balls.
    pub balls: InnerRadii,
    /// The index that was used.
    pub index: Arc<SurfaceIndex>,
}

/// What is known of a surface before its shape is measured.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// An index of the surface.
    pub index: Option<Arc<SurfaceIndex>>,
    /// Whether no triangle runs into another.
    pub crosses_nothing: bool,
}

/// The shape of `mesh`, whose triangles must not repeat a vertex.
///
/// # Panics
/// When an index of a triangle is out of range.
pub fn shape(mesh: &TriMesh) -> Shape {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    at_once(shape_in_slices(mesh, &topology, Known::default(), &Yielder::never())).shape
}

/// Pieces of work that are given out at once, for each thread; and the size of each, in triangles or vertices.
const PIECES: usize = 2;
const LIGHT: usize = 4096;
const HEAVY: usize = 512;
/// Pairs of triangles that are looked at in one piece of work, about: where many lie in one place the pieces become
/// smaller, down to a triangle.
const LOOKS: usize = 1 << 16;

/// As [`shape`], of a surface whose adjacency is `topology`. Rests about every millisecond; of the sums at the end sorting is
/// one piece, of up to 50 ns a triangle.
///
/// # Panics
/// When an index of a triangle is out of range.
pub async fn shape_in_slices(mesh: &TriMesh, topology: &Topology, known: Known, yielder: &Yielder) -> Measured {
    let index = SurfaceIndex::known_or_built(known.index, mesh, &yielder.part(0.0..0.1)).await;
    let block = LIGHT * PIECES * parallel::threads();
    let (mut angles, triangles) = (AngleCounts::default(), mesh.triangles.len());
    for block in blocks(triangles, block) {
        let first = block.start;
        let counts = parallel::map_ranges(block.len(), LIGHT, |piece| {
            AngleCounts::of(mesh, first + piece.start..first + piece.end)
        });
        counts.into_iter().for_each(|counts| angles.add(counts));
        yielder.rest(0.1 + 0.1 * block.end as f32 / triangles as f32).await;
    }
    let (mut all_bends, vertices) = (Vec::new(), topology.vertex_count());
    for block in blocks(vertices, block) {
        let first = block.start;
        let pieces = parallel::map_ranges(block.len(), LIGHT, |piece| {
            bends(mesh, topology, first + piece.start..first + piece.end)
        });
        pieces.into_iter().for_each(|piece| all_bends.extend(piece));
        yielder.rest(0.2 + 0.1 * block.end as f32 / vertices as f32).await;
    }
    let crossing = if known.crosses_nothing {
        Vec::new()
    } else {
        crossing_triangles(Indexed { mesh, topology: Some(topology) }, &index, &yielder.part(0.3..0.65)).await
    };
    let balls = inner_radii_in_slices(mesh, topology, &index, &yielder.part(0.65..0.95)).await;
    let roughness = summarise_bends(all_bends);
    yielder.rest(0.96).await;
    let angles = angles.finish();
    yielder.rest(0.97).await;
    let smallest_lumen = narrowest(mesh, topology, &balls, &index, &yielder.part(0.97..1.0)).await;
    let shape = Shape { roughness, angles, self_intersecting_faces: crossing.len(), smallest_lumen };
    Measured { shape, balls, index }
}

/// The triangles of a surface that run into others of it; ascending.
pub(super) async fn crossing_triangles(surface: Indexed<'_>, index: &SurfaceIndex, yielder: &Yielder) -> Vec<u32> {
    let crossing = Crossing::none(index, &surface.mesh.triangles);
    let (mut next, slots, mut piece) = (0, index.slots(), HEAVY / 8);
    while next < slots {
        let (first, end) = (next, slots.min(next + piece * PIECES * parallel::threads()));
        let looks = parallel::map_ranges(end - first, piece, |part| {
            index.mark_crossings(surface, first + part.start..first + part.end, &crossing)
        });
        let most = looks.into_iter().max().unwrap_or(0);
        piece = if most > LOOKS { (piece / 2).max(1) } else { (2 * piece).min(HEAVY) };
        next = end;
        yielder.rest(next as f32 / slots as f32).await;
    }
    crossing.triangles().collect()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use proptest::prelude::*;

    use super::*;
    use crate::task::{Budget, Progress, Running};
    use lumen_mesh::shapes::{icosphere, square, tube};
    use lumen_mesh::{Vec3, refitted};

    fn waisted() -> TriMesh {
        tube(24, 120, 40.0, |z| 3.0 - 1.5 * (-(z - 14.0) * (z - 14.0) / 9.0).exp())
    }

    #[test]
    fn the_smallest_lumen_is_the_waist_of_a_tube() {
        let found = shape(&waisted()).smallest_lumen.unwrap();
        // The wall is in facets of 15 degrees, up to 0.9 % nearer than its vertices.
        assert!((found.diameter_mm / 3.0 - 1.0).abs() < 0.015, "{found:?}");
        let [x, y, z] = found.at_mm;
        assert!((z - 14.0).abs() < 0.5 && x.hypot(y) < 0.1, "{found:?}");
    }

    #[test]
    fn dents_and_spikes_of_single_vertices_do_not_make_the_smallest_lumen() {
        let (mut mesh, clean) = (waisted(), shape(&waisted()).smallest_lumen.unwrap());
        for v in (200..mesh.positions.len() - 200).step_by(131) {
            let p = mesh.positions[v];
            mesh.positions[v] = (p.truncate() * if v % 2 == 0 { 0.8 } else { 1.2 }).extend(p.z);
        }
        let found = shape(&mesh).smallest_lumen.unwrap();
        assert!((found.diameter_mm / clean.diameter_mm - 1.0).abs() < 0.15, "{found:?} {clean:?}");
    }

    #[test]
    fn what_is_hardly_a_surface_has_hardly_a_shape() {
        let empty = shape(&TriMesh::default());
        assert_eq!((empty.roughness, &empty.angles, empty.smallest_lumen), (None, &None, None));
        let one = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
        assert_eq!(shape(&one).angles.unwrap().min_deg, 45.0);
        let line = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0], triangles: vec![[0, 1, 2]] };
        assert_eq!(shape(&line).angles.unwrap().below_10_percent, 100.0);
        let mut broken = icosphere(2, 5.0, Vec3::ZERO);
        broken.positions[4] = Vec3::splat(f32::NAN);
        broken.positions[9].x = f32::INFINITY;
        assert_eq!(shape(&broken).self_intersecting_faces, 0);
    }

    #[test]
    fn thousands_of_pieces_slivers_and_a_fan_of_one_edge_end_in_good_time() {
        let mut many = TriMesh::default();
        for i in 0..5594u32 {
            let corner = Vec3::new((i % 80) as f32, (i / 80) as f32, 0.0) * 3.0;
            let first = many.positions.len() as u32;
            many.positions.extend([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|p| p + corner));
            let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
            many.triangles.extend(faces.map(|t| t.map(|v| v + first)));
        }
        assert_eq!(shape(&many).self_intersecting_faces, 0);
        // Six thousand triangles over one edge: every edge in the middle is non-manifold, so there is no roughness.
        let around = (0..6000).map(|i| {
            let angle = f64::from(i) / 6000.0 * std::f64::consts::TAU;
            Vec3::new(libm::cos(angle) as f32, libm::sin(angle) as f32, 0.5)
        });
        let positions: Vec<Vec3> = [Vec3::ZERO, Vec3::Z].into_iter().chain(around).collect();
        let book = TriMesh { positions, triangles: (0..6000).map(|i| [0, 1, i + 2]).collect() };
        let found = shape(&book);
        assert_eq!((found.roughness, found.self_intersecting_faces), (None, 0));
        let strip = square(200, 1.0, 0.0);
        let flat = TriMesh {
            positions: strip.positions.iter().map(|p| Vec3::new(p.x, p.y * 1e-6, p.x * 0.5)).collect(),
            ..strip
        };
        assert_eq!(shape(&flat).angles.unwrap().below_10_percent, 100.0);
    }

    #[test]
    fn slices_threads_and_a_given_index_change_nothing() {
        let mesh = waisted();
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let whole = shape(&mesh);
        let (surface, adjacency) = (&mesh, &topology);
        let mut running =
            Running::new(
                |yielder| async move { shape_in_slices(surface, adjacency, Known::default(), &yielder).await },
            );
        let mut fraction = 0.0;
        let sliced = loop {
            match running.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(now) => {
                    assert!((fraction..=1.0).contains(&now), "{fraction} then {now}");
                    fraction = now;
                }
                Progress::Done(found) => break found.shape,
            }
        };
        assert_eq!(sliced, whole);
        for threads in [1, 2, 7] {
            assert_eq!(parallel::with_threads(threads, || shape(&mesh)), whole);
        }
        // By the boxes of another surface of the same triangles.
        let mut other = mesh.clone();
        other.positions.iter_mut().for_each(|p| *p += (0.3 * p.z).sin() * Vec3::X);
        let index = SurfaceIndex::new(&other.positions, &other.triangles);
        let index = Some(Arc::new(at_once(refitted(&index, &mesh, &Yielder::never()))));
        let known = Known { index, ..Known::default() };
        assert_eq!(at_once(shape_in_slices(&mesh, &topology, known, &Yielder::never())).shape, whole);
    }

    /// All numbers of a shape.
    fn numbers(shape: &Shape) -> [f64; 7] {
        let (roughness, angles) = (shape.roughness.unwrap(), shape.angles.as_ref().unwrap());
        let lumen = shape.smallest_lumen.unwrap().diameter_mm;
        let faces = shape.self_intersecting_faces as f64;
        [roughness.rms_deg, roughness.p95_deg, angles.min_deg, angles.p1_deg, angles.mean_min_deg, lumen, faces]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn a_rigid_motion_changes_nothing(
            axis in prop::array::uniform3(-1.0f32..1.0), angle in 0.0f32..6.0, shift in prop::array::uniform3(-50.0f32..50.0),
        ) {
            let axis = Vec3::from(axis).try_normalize().unwrap_or(Vec3::X);
            let turn = glam::Quat::from_axis_angle(axis, angle);
            let (mesh, mut moved) = (waisted(), waisted());
            moved.positions.iter_mut().for_each(|p| *p = turn * *p + Vec3::from(shift));
            for (a, b) in numbers(&shape(&mesh)).into_iter().zip(numbers(&shape(&moved))) {
                prop_assert!((a - b).abs() <= 2e-3 * a.abs().max(1.0), "{} {}", a, b);
            }
        }

        #[test]
        fn the_order_of_triangles_and_corners_changes_nothing(turn in 1usize..5000, corner in 0usize..3) {
            let (mesh, mut other) = (waisted(), waisted());
            let count = other.triangles.len();
            other.triangles.rotate_left(turn % count);
            other.triangles.iter_mut().for_each(|t| t.rotate_left(corner));
            for (a, b) in numbers(&shape(&mesh)).into_iter().zip(numbers(&shape(&other))) {
                prop_assert!((a - b).abs() <= 1e-6 * a.abs().max(1.0), "{} {}", a, b);
            }
        }
    }
}
