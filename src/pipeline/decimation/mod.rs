//! Decimation to a progressive mesh, by one of two methods ([`Method`](super::settings::Method)): `schroeder.rs` and
//! `quadric.rs`.
//!
//! A method judges each vertex: by what distance the surface would suffer without it, and where it could go. Vertices
//! go in rounds of a threshold that grows, as in Schroeder, Zarge and Lorensen, "Decimation of triangle meshes" (1992):
//! in each round those whose distance is below it, the smallest distances first while they are few, along a
//! space-filling curve while they are many. (The paper's text has the test the wrong way round; Schroeder's own deletes
//! when the distance is *less* than the threshold, and so does this.) Deleting a vertex and patching the hole is
//! expressed as a collapse onto one of its neighbours, so that the run is a progressive mesh (Hoppe 1996): one run to
//! the last vertex that can go has every reduction rate in it.
//!
//! Every collapse, by whichever method,
//!
//! - passes the link condition (Dey, Edelsbrunner, Guha and Nekhayev 1999): no topology changes, no open end falls
//!   below three edges (`rings.rs`);
//! - folds no triangle over and makes no sliver; for a vertex that does not meet the strict limits they are eased, step by
//!   step, at the price of waiting longer, down to "does not fold" (`star.rs`);
//! - makes no triangle run into another (`guard/`).
//!
//! Where thin vessels are spared, the distance of a vertex counts by the width of its vessel, for the order alone
//! (`weights.rs`).
//!
//! The error of a step is the method's measure, no bound of the true deviation: measure that (`super::deviation`).

mod collapse;
mod fan;
mod guard;
mod method;
mod order;
mod quadric;
mod rings;
mod schedule;
mod schroeder;
mod star;
mod weights;

use std::ops::Deref;
use std::sync::Arc;

use self::collapse::{LAST, Refusal, Surface};
use self::method::{Candidate, Judged};
use self::quadric::Quadric;
use self::rings::neighbour;
use self::schedule::{Schedule, Stuck};
use self::schroeder::Schroeder;
use self::weights::ratios;
use super::progressive::{Limit, Merge, ProgressiveMesh};
use super::settings::{Decimation, Method};
use super::task::{Budget, Progress, Task};
use crate::mesh::{Topology, TriMesh, components};

/// Vertices between two looks at the clock.
const CHUNK: usize = 64;

/// Tests of the guard between two looks at the clock.
const EFFORT: usize = 1 << 15;

/// Slots that get their rings between two looks at the clock before the first vertex is met.
const LINKED: usize = 1 << 15;

/// How far a run is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
enum Phase {
    /// Slots get their rings.
    Linking,
    /// Slots without a ring are dropped.
    Numbering,
    /// Pieces are counted.
    Counting,
    /// Feature edges are found and the method sees each slot; the next one.
    Meeting(u32),
    /// Each slot is judged for the first time; the next one.
    Judging(u32),
    /// Rounds.
    Collapsing,
}

/// A decimation run in slices; `M` is any pointer to a mesh, `T` any to its topology.
pub struct DecimationTask<M, T> {
    mesh: M,
    topology: T,
    surface: Surface,
    schedule: Schedule,
    phase: Phase,
    /// Radius of the vessel at each vertex of the mesh in mm, where thin vessels are spared.
    widths: Option<Arc<[f32]>>,
    /// Cosine of the feature angle.
    crease: f32,
    merges: Vec<Merge>,
    errors: Vec<f32>,
    /// Slots that there were.
    total: usize,
}

impl<M: Deref<Target = TriMesh>, T: Deref<Target = Topology>> DecimationTask<M, T> {
    /// Starts decimating `mesh`, whose topology is `topology`.
    pub fn new(mesh: M, topology: T, settings: &Decimation) -> Self {
        let method: Box<dyn method::Method + Send> = match settings.method {
            Method::Schroeder => Box::new(Schroeder::default()),
            Method::Quadric => Box::new(Quadric::default()),
        };
        Self {
            surface: Surface::new(&mesh, method),
            mesh,
            topology,
            schedule: Schedule::default(),
            phase: Phase::Linking,
            widths: None,
            crease: libm::cos(settings.feature_angle.to_radians()) as f32,
            merges: Vec::new(),
            errors: Vec::new(),
            total: 0,
        }
    }

    /// Spares thin vessels (`weights.rs`): `widths` has the radius of the vessel at each vertex of the mesh in mm, infinite
    /// where it is in none.
    #[must_use]
    pub fn with_widths(self, widths: Arc<[f32]>) -> Self {
        Self { widths: Some(widths), ..self }
    }

    /// The next piece of what comes before the first vertex is met; at most some 20 ms at a million triangles.
    fn prepare(&mut self) {
        let rings = &mut self.surface.rings;
        match self.phase {
            Phase::Linking => {
                if rings.link(&self.mesh, &self.topology, LINKED) {
                    self.phase = Phase::Numbering;
                }
            }
            Phase::Numbering => {
                rings.compact();
                let count = rings.len();
                self.surface.method.start(count);
                if let Some(widths) = self.widths.take() {
                    self.surface.weigh(&ratios(&widths));
                }
                self.schedule = Schedule::new(count);
                self.merges.reserve(count);
                self.errors.reserve(count);
                self.total = count;
                self.phase = Phase::Counting;
            }
            Phase::Counting => {
                let count = components(self.mesh.positions.len(), &self.mesh.triangles).count();
                self.surface.guard.start(rings, count == 1 && rings.is_closed());
                self.phase = Phase::Meeting(0);
            }
            Phase::Meeting(_) | Phase::Judging(_) | Phase::Collapsing => {}
        }
    }

    /// Puts `v` into its place for the first time.
    fn begin(&mut self, v: u32) {
        let stuck = self.surface.barred(v);
        let state = &mut self.schedule.states[v as usize];
        state.stuck = stuck;
        if stuck.is_none() {
            let strictness = state.strictness;
            let price = self.surface.limits(v, strictness).price;
            self.schedule.keys[v as usize] = self.surface.judge(v, strictness).priority * price;
        }
    }

    /// Collapses `v` if its distance is below the threshold and there is a way.
    fn visit(&mut self, v: u32) {
        if self.surface.rings.is_gone(v) {
            return;
        }
        if let Some(stuck) = self.surface.barred(v) {
            self.schedule.set_stuck(v, stuck);
            return;
        }
        let state = &mut self.schedule.states[v as usize];
        if state.is_stale {
            state.strictness = 0;
            state.is_stale = false;
        }
        let judged = self.surface.judge(v, state.strictness);
        let limits = self.surface.limits(v, state.strictness);
        let (key, threshold) = (judged.priority * limits.price, self.schedule.threshold);
        if key > threshold {
            self.schedule.keys[v as usize] = key;
            return;
        }
        match self.surface.way(&self.mesh, v, &judged, limits, threshold) {
            Ok((candidate, tip)) => self.collapse(v, &candidate, tip),
            Err(Refusal::Later(key)) => self.schedule.keys[v as usize] = key,
            Err(Refusal::Stuck(stuck)) => match self.eased(v, &judged, stuck) {
                Some(strictness) => {
                    self.schedule.keys[v as usize] = judged.priority * self.surface.limits(v, strictness).price;
                }
                None => self.schedule.set_stuck(v, stuck),
            },
        }
    }

    /// Holds `v` to less, if that can help: what is stuck by topology is helped only where a feature edge holds it. The
    /// number of the limits then.
    fn eased(&mut self, v: u32, judged: &Judged, stuck: Stuck) -> Option<u8> {
        let strictness = &mut self.schedule.states[v as usize].strictness;
        if *strictness == LAST || (stuck == Stuck::Topology && !judged.is_held) {
            return None;
        }
        *strictness = if stuck == Stuck::Topology { LAST } else { *strictness + 1 };
        Some(*strictness)
    }

    fn collapse(&mut self, v: u32, candidate: &Candidate, tip: f32) {
        let surface = &mut self.surface;
        let u = neighbour(surface.star.entries()[candidate.to]);
        let (gone, kept) = (surface.rings.nodes[v as usize], surface.rings.nodes[u as usize]);
        let made = surface.collapse(v, candidate, tip);
        self.merges.push(Merge { gone, kept, made });
        self.errors.push(candidate.distance.max(tip) * surface.rings.unit);
        self.schedule.remove(v);
        let around_v = surface.star.entries().iter();
        let around_u = surface.rings.around(u).iter().filter(|_| made.is_some());
        for n in around_v.chain(around_u).map(|&entry| neighbour(entry)) {
            if !surface.rings.stays(n) {
                self.schedule.set_stale(n);
            }
        }
    }

    fn result(&mut self) -> ProgressiveMesh {
        let mut limit = Limit::default();
        for state in &self.schedule.states {
            match state.stuck {
                Some(Stuck::Topology) => limit.topology += 1,
                Some(Stuck::Geometry) => limit.geometry += 1,
                Some(Stuck::Complex) => limit.complex += 1,
                None => {}
            }
        }
        let errors = std::mem::take(&mut self.errors);
        ProgressiveMesh::from_merges(&self.mesh, &self.merges, &self.surface.rings.made, errors, limit)
    }

    /// For each node of the result the vertex of the surface that entered, or `MADE`.
    pub fn vertices_of_nodes(&self) -> Vec<u32> {
        let (vertices, made) = (self.mesh.positions.len(), self.surface.rings.made.len());
        ProgressiveMesh::vertices_of_nodes(vertices, made, &self.merges)
    }

    /// The next piece of work. Returns false when there is none.
    fn step(&mut self) -> bool {
        let count = self.surface.rings.len() as u32;
        match self.phase {
            Phase::Linking | Phase::Numbering | Phase::Counting => self.prepare(),
            _ if !self.surface.guard.is_ready() => {
                self.surface.guard.advance(&self.surface.rings, &mut self.surface.star);
            }
            Phase::Meeting(v) if v < count => {
                self.surface.meet(v, self.crease);
                self.phase = Phase::Meeting(v + 1);
            }
            Phase::Meeting(_) => self.phase = Phase::Judging(0),
            Phase::Judging(v) if v < count => {
                self.begin(v);
                self.phase = Phase::Judging(v + 1);
            }
            Phase::Judging(_) => self.phase = Phase::Collapsing,
            Phase::Collapsing => match self.schedule.pop() {
                Some(v) => self.visit(v),
                None => return self.next_round(),
            },
        }
        true
    }

    fn next_round(&mut self) -> bool {
        if self.schedule.is_sparse() {
            let kept = self.surface.compact();
            self.schedule.compact(&kept);
        }
        self.schedule.next_round()
    }

    fn fraction(&self) -> f32 {
        let total = self.total.max(1) as f32;
        // Seeing and judging all vertices once takes about a tenth of the run.
        match self.phase {
            Phase::Linking | Phase::Numbering | Phase::Counting => 0.0,
            Phase::Meeting(v) => 0.05 * v as f32 / total,
            Phase::Judging(v) => 0.05 + 0.05 * v as f32 / total,
            Phase::Collapsing => 0.1 + 0.9 * (1.0 - self.schedule.alive as f32 / total),
        }
    }
}

impl<M: Deref<Target = TriMesh>, T: Deref<Target = Topology>> Task for DecimationTask<M, T> {
    type Output = ProgressiveMesh;

    fn advance(&mut self, budget: Budget) -> Progress<ProgressiveMesh> {
        loop {
            // A step may be long before the guard is ready, and among very many triangles.
            let mut effort = 0;
            for _ in 0..CHUNK {
                if !self.step() {
                    return Progress::Done(self.result());
                }
                effort += self.surface.guard.take_effort();
                if effort > EFFORT || self.phase < Phase::Meeting(0) || !self.surface.guard.is_ready() {
                    break;
                }
            }
            if budget.is_spent() {
                return Progress::Working(self.fraction());
            }
        }
    }
}

/// Decimates `mesh` as far as it goes.
pub fn decimate(mesh: &TriMesh, topology: &Topology, settings: &Decimation) -> ProgressiveMesh {
    DecimationTask::new(mesh, topology, settings).finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::self_intersections;
    use crate::mesh::shapes::{icosphere, joined, tube};
    use crate::pipeline::settings::Target;
    use glam::Vec3;

    fn levels_of(mesh: &TriMesh, method: Method) -> ProgressiveMesh {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let levels = decimate(mesh, &topology, &Decimation { method, ..Decimation::default() });
        levels.assert_well_formed();
        levels
    }

    #[test]
    fn the_two_faces_of_a_thin_wall_never_cross() {
        let outer = icosphere(5, 10.0, Vec3::ZERO);
        let mut inner = icosphere(5, 9.8, Vec3::ZERO);
        inner.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let wall = joined(&[outer.clone(), inner.clone()]);
        for method in Method::ALL {
            let together = levels_of(&wall, method);
            let alone = [&outer, &inner].map(|mesh| levels_of(mesh, method));
            for rate in [500, 900, 950, 980, 995] {
                let target = Target::Reduction(rate);
                let level = together.extract(&together.level(target).triangles);
                assert!(self_intersections(&level).is_empty(), "{method:?} at {rate}");
            }
            // Reduced apart they do: chords of the outer sphere lie farther inside than the wall is thick.
            let apart = alone.map(|levels| levels.extract(&levels.level(Target::Reduction(995)).triangles));
            assert!(!self_intersections(&joined(&apart)).is_empty(), "{method:?} has nothing to keep apart");
        }
    }

    #[test]
    fn a_sphere_of_quadrics_keeps_its_volume_and_that_of_vertices_shrinks() {
        let sphere = icosphere(5, 10.0, Vec3::ZERO);
        let volume = |mesh: &TriMesh| crate::mesh::volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
        let [schroeder, quadric] = Method::ALL.map(|method| {
            let levels = levels_of(&sphere, method);
            let level = levels.extract(&levels.level(Target::Reduction(900)).triangles);
            volume(&level) / volume(&sphere) - 1.0
        });
        // Points of a sphere make a polyhedron inside of it.
        assert!(schroeder < -1e-3, "{schroeder}");
        assert!(quadric.abs() < 1e-4, "{quadric}");
    }

    /// `mesh` with vessels of these widths.
    fn spared(mesh: &TriMesh, method: Method, widths: Vec<f32>) -> ProgressiveMesh {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let settings = Decimation { method, ..Decimation::default() };
        let levels = DecimationTask::new(mesh, &topology, &settings).with_widths(widths.into()).finish();
        levels.assert_well_formed();
        levels
    }

    #[test]
    fn thin_vessels_are_spared_by_the_root_of_the_ratio_for_each_length() {
        // Errors on a sphere of radius r with edges h grow with h^2 / r, and priorities of quadrics with h^3 / r. So of
        // two spheres at one threshold the number of triangles is as r for Schroeder and as r^(4/3) for quadrics; spared,
        // as r^(1/2) and r^(2/3).
        let radii = [8.0f32, 1.0];
        let spheres = radii.map(|radius| icosphere(6, radius, Vec3::X * 3.0 * radius));
        let (mesh, half) = (joined(&spheres), spheres[0].positions.len());
        let widths: Vec<f32> = (0..mesh.positions.len()).map(|v| radii[usize::from(v >= half)]).collect();
        for (method, plain, root) in [(Method::Schroeder, 1.0, 0.5), (Method::Quadric, 4.0 / 3.0, 2.0 / 3.0)] {
            let exponent = |levels: &ProgressiveMesh| {
                let level = levels.extract(&levels.level(Target::Triangles(4000)).triangles);
                assert!((3999..=4000).contains(&level.triangles.len()), "{method:?}");
                let thick = level.triangles.iter().filter(|t| level.positions[t[0] as usize].x > 10.0).count();
                (thick as f64 / (level.triangles.len() - thick) as f64).ln() / 8f64.ln()
            };
            let found = [exponent(&levels_of(&mesh, method)), exponent(&spared(&mesh, method, widths.clone()))];
            assert!((found[0] - plain).abs() < 0.08 && (found[1] - root).abs() < 0.08, "{method:?}: {found:?}");
        }
    }

    #[test]
    fn where_all_vessels_are_equally_wide_or_none_is_the_order_is_the_plain_one() {
        let mesh = joined(&[icosphere(4, 3.0, Vec3::ZERO), tube(24, 60, 40.0, |z| 2.0 + 0.1 * libm::sinf(z))]);
        for method in Method::ALL {
            let plain = levels_of(&mesh, method);
            for width in [0.7, f32::INFINITY, f32::NAN, 0.0] {
                assert!(spared(&mesh, method, vec![width; mesh.positions.len()]) == plain, "{method:?}, {width}");
            }
        }
    }

    #[test]
    fn what_is_spared_does_not_depend_on_the_scale() {
        let mesh = joined(&[icosphere(4, 3.0, Vec3::ZERO), tube(24, 60, 40.0, |z| 1.0 + 0.05 * z)]);
        let widths: Vec<f32> = mesh.positions.iter().map(|p| 1.0 + 0.05 * p.z.max(0.0)).collect();
        for method in Method::ALL {
            let here = spared(&mesh, method, widths.clone());
            for scale in [1024.0, 1.0 / 1024.0] {
                let mut scaled = mesh.clone();
                scaled.positions.iter_mut().for_each(|p| *p *= scale);
                let there = spared(&scaled, method, widths.iter().map(|width| width * scale).collect());
                assert!(there.triangles == here.triangles && there.parents == here.parents, "{method:?} at {scale}");
                let errors: Vec<f32> = here.errors.iter().map(|error| error * scale).collect();
                assert!(there.errors == errors, "what is told is in mm");
            }
        }
    }

    #[test]
    fn a_stray_leaves_the_rest_as_it_would_be_without_it() {
        let sphere = icosphere(4, 10.0, Vec3::new(3.0, 2.0, 1.0));
        let stray = |far: f32| {
            let positions = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * far + Vec3::splat(far)).to_vec();
            joined(&[sphere.clone(), TriMesh { positions, triangles: vec![[0, 1, 2]] }])
        };
        let spike = |far: f32| {
            let mut mesh = sphere.clone();
            mesh.positions[77] *= far;
            mesh
        };
        // The root mean square distance of the vertices of the sphere from it, and how many there are.
        let off = |mesh: &TriMesh, method: Method| {
            let levels = levels_of(mesh, method);
            let level = levels.extract(&levels.level(Target::Triangles(500)).triangles);
            let radii = level.positions.iter().map(|p| (p.as_dvec3() - glam::DVec3::new(3.0, 2.0, 1.0)).length());
            let near: Vec<f64> =
                radii.filter(|radius| *radius < 12.0).map(|radius| (radius - 10.0) * (radius - 10.0)).collect();
            ((near.iter().sum::<f64>() / near.len() as f64).sqrt(), near.len())
        };
        for method in Method::ALL {
            let (alone, _) = off(&sphere, method);
            for far in [1e6, 1e8] {
                for (name, mesh) in [("stray", stray(far)), ("spike", spike(far))] {
                    let (rest, count) = off(&mesh, method);
                    assert!(
                        rest < 1.5 * alone + 1e-4,
                        "{method:?}, {name} at {far}: {rest} mm off, {alone} without it"
                    );
                    assert!((235..=253).contains(&count), "{method:?}, {name} at {far}: {count} vertices");
                }
            }
        }
    }

    #[test]
    fn the_order_of_the_file_does_not_matter() {
        let sphere = icosphere(4, 10.0, Vec3::new(3.0, 2.0, 1.0));
        let mut turned = sphere.clone();
        turned.triangles.reverse();
        turned.triangles.iter_mut().step_by(3).for_each(|t| t.rotate_left(1));
        for method in Method::ALL {
            let [a, b] = [&sphere, &turned].map(|mesh| levels_of(mesh, method));
            assert_eq!(a.triangles_after(2000), b.triangles_after(2000));
            let [worst_a, worst_b] = [a, b].map(|levels| levels.errors[2000]);
            assert!((worst_a / worst_b - 1.0).abs() < 0.05, "{method:?}: {worst_a} {worst_b}");
        }
    }

    /// A cylinder of `n` sides, each end a fan around its middle.
    fn cylinder(n: u32) -> TriMesh {
        let at = |i: u32, z: f32| {
            let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
            Vec3::new(50.0 * libm::cos(angle) as f32, 50.0 * libm::sin(angle) as f32, z)
        };
        let mut positions: Vec<Vec3> = [0.0, 100.0].iter().flat_map(|&z| (0..n).map(move |i| at(i, z))).collect();
        positions.extend([Vec3::ZERO, Vec3::Z * 100.0]);
        let around = |i: u32| {
            let j = (i + 1) % n;
            [[i, j, n + j], [i, n + j, n + i], [2 * n, j, i], [2 * n + 1, n + i, n + j]]
        };
        TriMesh { positions, triangles: (0..n).flat_map(around).collect() }
    }

    #[test]
    fn beside_a_hundred_thousand_triangles_around_one_vertex_everything_stays_and_it_says_so() {
        let mesh = cylinder(100_000);
        let levels = levels_of(&mesh, Method::Schroeder);
        assert!(levels.errors.is_empty());
        assert_eq!(levels.limit.geometry as usize, mesh.positions.len());
    }

    #[test]
    fn caps_with_thousands_of_triangles_around_one_vertex_go_as_far_as_any() {
        let mesh = cylinder(3000);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        for method in Method::ALL {
            let settings = Decimation { method, ..Decimation::default() };
            let levels = decimate(&mesh, &topology, &settings);
            levels.assert_well_formed();
            assert_eq!(levels.triangles_after(levels.errors.len() as u32), 4, "{method:?}");
        }
    }
}
