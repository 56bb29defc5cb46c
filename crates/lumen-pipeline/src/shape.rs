//! The shape of a surface in numbers: roughness, the angles of its triangles, triangles that run into each other, and
//! how narrow its lumen gets.
//!
//! What the smallest lumen is, `narrowest.rs` says.

use std::ops::{Deref, Range};
use std::sync::Arc;
use std::task::Poll;

use serde::{Deserialize, Serialize};

use super::narrowest::{Narrowest, NarrowestSearch};
use super::task::{Budget, Progress, Task};
use lumen_mesh::parallel;
use lumen_mesh::{
    AngleCounts, Angles, Crossing, IndexBuild, Indexed, InnerRadii, Roughness, SurfaceIndex, Topology, TriMesh, bends,
    summarise_bends,
};

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
    /// The triangles that run into others, in the numbering of the index; ascending.
    pub crossing: Vec<u32>,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    All,
    /// All, and nothing runs into anything.
    AllButCrossings,
    Radii,
    Crossings,
}

/// The shape of `mesh`, whose triangles must not repeat a vertex.
///
/// # Panics
/// When an index of a triangle is out of range.
pub fn shape(mesh: &TriMesh) -> Shape {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    ShapeTask::new(mesh, &topology).finish().shape
}

/// Pieces of work that are given out at once, for each thread; and the size of each, in triangles or vertices.
const PIECES: usize = 2;
const LIGHT: usize = 4096;
const HEAVY: usize = 512;
/// Pairs of triangles that are looked at in one piece of work, about: where many lie in one place the pieces become
/// smaller, down to a triangle.
const LOOKS: usize = 1 << 16;
/// Inner balls between two looks at the clock.
const BALLS: usize = 64;

/// The measuring of a shape in slices; `M` and `T` are any pointers to a mesh and its topology.
#[derive(Debug)]
pub struct ShapeTask<M, T> {
    mesh: M,
    topology: T,
    /// The surface that the index is of, where it numbers its vertices and triangles in another way.
    indexed: Option<M>,
    index: Option<Arc<SurfaceIndex>>,
    build: IndexBuild,
    stage: Stage,
    wanted: Wanted,
    next: usize,
    angles: AngleCounts,
    bends: Vec<f32>,
    crossing: Crossing,
    /// Triangles in the next piece of the search for crossings.
    heavy: usize,
    balls: InnerRadii,
    narrowest: NarrowestSearch,
    /// The numbers that are there.
    found: Shape,
}

#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Stage {
    Index,
    Angles,
    Bends,
    Crossings,
    Balls,
    /// What was gathered is summed up, a number a step.
    Sums,
    Done,
}

impl<M: Deref<Target = TriMesh> + Sync, T: Deref<Target = Topology> + Sync> ShapeTask<M, T> {
    /// The shape of `mesh`, whose adjacency is `topology`.
    pub fn new(mesh: M, topology: T) -> Self {
        Self {
            mesh,
            topology,
            indexed: None,
            index: None,
            build: IndexBuild::new(),
            stage: Stage::Index,
            wanted: Wanted::All,
            next: 0,
            angles: AngleCounts::default(),
            bends: Vec::new(),
            crossing: Crossing::default(),
            heavy: HEAVY / 8,
            balls: InnerRadii::default(),
            narrowest: NarrowestSearch::default(),
            found: Shape::default(),
        }
    }

    /// The radii of the inner balls alone; the rest of the shape stays empty.
    #[must_use]
    pub(super) fn radii_only(mesh: M, topology: T) -> Self {
        Self { wanted: Wanted::Radii, ..Self::new(mesh, topology) }
    }

    /// The triangles that run into others alone; the rest of the shape stays empty.
    #[must_use]
    pub(super) fn crossings_only(mesh: M, topology: T) -> Self {
        Self { wanted: Wanted::Crossings, ..Self::new(mesh, topology) }
    }

    /// Takes it from the caller that no triangle runs into another.
    #[must_use]
    pub(super) fn without_crossings(self) -> Self {
        Self { wanted: Wanted::AllButCrossings, ..self }
    }

    /// Uses an index that is there already, of the same surface in the numbering of `indexed`.
    #[must_use]
    pub fn with_index(mut self, indexed: M, index: Arc<SurfaceIndex>) -> Self {
        (self.indexed, self.index) = (Some(indexed), Some(index));
        self
    }

    /// The index of the surface, once it is there.
    pub fn index(&self) -> Option<&Arc<SurfaceIndex>> {
        self.index.as_ref()
    }

    /// Number of things in the present stage, and how many are given out at once.
    fn extent(&self) -> (usize, usize) {
        match self.stage {
            Stage::Index | Stage::Balls | Stage::Sums | Stage::Done => (0, 1),
            Stage::Angles => (self.mesh.triangles.len(), LIGHT),
            Stage::Bends => (self.topology.vertex_count(), LIGHT),
            Stage::Crossings => (self.index.as_ref().map_or(0, |index| index.slots()), self.heavy),
        }
    }

    fn step(&mut self) {
        if self.stage == Stage::Index {
            if self.add_index() {
                self.stage = match self.wanted {
                    Wanted::All | Wanted::AllButCrossings => Stage::Angles,
                    Wanted::Radii => Stage::Balls,
                    Wanted::Crossings => Stage::Crossings,
                };
            }
            return;
        }
        if self.stage == Stage::Balls {
            if self.add_balls() {
                self.stage = if self.wanted == Wanted::Radii { Stage::Done } else { Stage::Sums };
            }
            return;
        }
        if self.stage == Stage::Sums {
            self.sum_up();
            return;
        }
        let (length, piece) = self.extent();
        let end = length.min(self.next + piece * PIECES * parallel::threads());
        self.work(self.next..end, piece);
        self.next = end;
        if end == length {
            self.next = 0;
            self.stage = match self.stage {
                Stage::Angles => Stage::Bends,
                Stage::Bends if self.wanted == Wanted::AllButCrossings => Stage::Balls,
                Stage::Bends => Stage::Crossings,
                Stage::Crossings if self.wanted == Wanted::All => Stage::Balls,
                _ => Stage::Done,
            };
        }
    }

    fn add_index(&mut self) -> bool {
        if self.index.is_none() {
            match self.build.advance(&self.mesh.positions, &self.mesh.triangles, LIGHT) {
                Poll::Ready(index) => self.index = Some(Arc::new(index)),
                Poll::Pending => return false,
            }
        }
        true
    }

    fn add_balls(&mut self) -> bool {
        let Some(index) = &self.index else { return true };
        self.balls.advance(&self.mesh, &self.topology, index, BALLS)
    }

    /// Works on a range of the present stage, on all cores.
    fn work(&mut self, range: Range<usize>, piece: usize) {
        let Some(index) = &self.index else { return };
        let (mesh, topology): (&TriMesh, &Topology) = (&self.mesh, &self.topology);
        let indexed: &TriMesh = self.indexed.as_ref().unwrap_or(&self.mesh);
        let part = |part: Range<usize>| range.start + part.start..range.start + part.end;
        match self.stage {
            Stage::Angles => parallel::map_ranges(range.len(), piece, |p| AngleCounts::of(mesh, part(p)))
                .into_iter()
                .for_each(|counts| self.angles.add(counts)),
            Stage::Bends => {
                self.bends
                    .extend(parallel::map_ranges(range.len(), piece, |p| bends(mesh, topology, part(p))).concat());
            }
            Stage::Crossings => {
                if range.start == 0 {
                    self.crossing = Crossing::none(index, &indexed.triangles);
                }
                let crossing = &self.crossing;
                let topology = std::ptr::eq(indexed, mesh).then_some(topology);
                let surface = Indexed { mesh: indexed, topology };
                let looks =
                    parallel::map_ranges(range.len(), piece, |p| index.mark_crossings(surface, part(p), crossing));
                let most = looks.into_iter().max().unwrap_or(0);
                self.heavy = if most > LOOKS { (piece / 2).max(1) } else { (2 * piece).min(HEAVY) };
            }
            Stage::Index | Stage::Balls | Stage::Sums | Stage::Done => {}
        }
    }

    /// The part that is done, 0 to 1, by estimated time.
    fn fraction(&self) -> f32 {
        let (length, _) = self.extent();
        let part = match self.stage {
            Stage::Index => self.build.fraction(),
            Stage::Sums => self.next as f32 / 3.0,
            Stage::Balls => self.balls.fraction(),
            _ => self.next as f32 / length.max(1) as f32,
        };
        let (before, share) = match self.stage {
            Stage::Index => (0.0, 0.1),
            Stage::Angles => (0.1, 0.1),
            Stage::Bends => (0.2, 0.1),
            Stage::Crossings => (0.3, 0.35),
            Stage::Balls => (0.65, 0.3),
            Stage::Sums => (0.95, 0.05),
            Stage::Done => (1.0, 0.0),
        };
        before + share * part
    }

    /// The next of the three numbers that need all that was gathered.
    fn sum_up(&mut self) {
        match self.next {
            0 => self.found.roughness = summarise_bends(std::mem::take(&mut self.bends)),
            1 => self.found.angles = std::mem::take(&mut self.angles).finish(),
            _ => {
                let (mesh, topology, balls) = (&self.mesh, &self.topology, &self.balls);
                let search = &mut self.narrowest;
                if self.index.as_ref().is_some_and(|index| !search.advance(mesh, topology, balls, index)) {
                    return;
                }
                self.found.smallest_lumen = search.found();
                self.stage = Stage::Done;
            }
        }
        self.next += 1;
    }

    fn result(&mut self) -> Measured {
        let crossing: Vec<u32> = std::mem::take(&mut self.crossing).triangles().collect();
        let shape = Shape { self_intersecting_faces: crossing.len(), ..self.found.clone() };
        Measured { shape, balls: std::mem::take(&mut self.balls), crossing }
    }
}

impl<M: Deref<Target = TriMesh> + Sync, T: Deref<Target = Topology> + Sync> Task for ShapeTask<M, T> {
    type Output = Measured;

    /// The clock is read about every millisecond; of the sums at the end sorting is one piece, of up to 50 ns a triangle.
    fn advance(&mut self, budget: Budget) -> Progress<Measured> {
        while self.stage != Stage::Done {
            self.step();
            if self.stage != Stage::Done && budget.is_spent() {
                return Progress::Working(self.fraction());
            }
        }
        Progress::Done(self.result())
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use proptest::prelude::*;

    use super::*;
    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::{icosphere, square, tube};

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
        let mut task = ShapeTask::new(&mesh, &topology);
        let mut fraction = 0.0;
        let sliced = loop {
            match task.advance(Budget::new(Duration::ZERO)) {
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
        // The same surface with its triangles in another order.
        let mut other = mesh.clone();
        other.triangles.reverse();
        let index = Arc::new(SurfaceIndex::new(&other.positions, &other.triangles));
        let found = ShapeTask::new(&mesh, &topology).with_index(&other, index).finish().shape;
        for (a, b) in numbers(&found).into_iter().zip(numbers(&whole)) {
            assert!((a - b).abs() < 1e-5, "{a} {b}");
        }
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
