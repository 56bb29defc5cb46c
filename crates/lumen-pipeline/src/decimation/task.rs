//! A run in slices: the rings, the feature edges, each vertex judged once, then rounds until no vertex can go.

use std::ops::Deref;
use std::sync::Arc;

use super::collapse::{LAST, Refusal, Surface};
use super::method::{self, Candidate, Judged};
use super::quadric::Quadric;
use super::rings::{CREASE, neighbour};
use super::schedule::{Schedule, Stuck};
use super::schroeder::Schroeder;
use super::weights::ratios;
use crate::classes::Lines;
use crate::progressive::{Limit, Merge, ProgressiveMesh};
use crate::settings::{Decimation, Method};
use lumen_mesh::task::{Budget, Progress, Task};
use lumen_mesh::{EdgeUse, Topology, TriMesh, components};

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
    /// For each triangle of the mesh a number, between different ones of which a border is held.
    labels: Option<Arc<[u32]>>,
    /// Cosine of the feature angle.
    crease: f32,
    /// What is found of the surface that entered, by its vertices.
    lines: Lines,
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
            labels: None,
            crease: libm::cos(settings.feature_angle.to_radians()) as f32,
            lines: Lines::default(),
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

    /// Holds the borders between labels (`borders.rs`): `labels` has a number for each triangle of the mesh.
    #[must_use]
    pub fn with_labels(self, labels: Arc<[u32]>) -> Self {
        Self { labels: Some(labels), ..self }
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

    /// Takes note of the feature edges and open edges around `v`, and whether it is complex.
    fn note_lines(&mut self, v: u32) {
        let (rings, lines) = (&self.surface.rings, &mut self.lines);
        let (ring, vertex) = (rings.around(v), rings.nodes[v as usize]);
        let other = |entry: u32| rings.nodes[neighbour(entry) as usize];
        lines.features.extend(ring.iter().filter(|entry| **entry & CREASE != 0).map(|&entry| [vertex, other(entry)]));
        if rings.is_open(v) {
            // Where a vertex was cut, its fan ends at edges of more triangles too.
            let ends = ring.first().into_iter().chain(ring.last()).map(|&entry| other(entry));
            let is_open = |&n: &u32| self.topology.edge(vertex, n).is_some_and(EdgeUse::is_boundary);
            lines.boundary.extend(ends.filter(is_open).map(|n| [vertex, n]));
        }
        if rings.stays(v) {
            lines.complex.push(vertex);
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
        let levels = ProgressiveMesh::from_merges(&self.mesh, &self.merges, &self.surface.rings.made, errors, limit);
        levels.with_lines(&std::mem::take(&mut self.lines), &self.vertices_of_nodes())
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
                if let Some(labels) = &self.labels {
                    self.surface.find_borders(v, &self.mesh, &self.topology, labels);
                }
                self.surface.meet(v, self.crease);
                self.note_lines(v);
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
