//! A run: the rings, the feature edges, each vertex judged once, then rounds until no vertex can go.

use super::cap_areas::CapAreas;
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
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{EdgeUse, FlatCap, Topology, TriMesh, components};

/// Vertices between two looks at the clock.
const CHUNK: usize = 64;

/// Tests of the guard between two looks at the clock.
const EFFORT: usize = 1 << 15;

/// Slots that get their rings between two looks at the clock before the first vertex is met.
const LINKED: usize = 1 << 15;

/// What a run leaves.
pub struct Decimated {
    /// Every level.
    pub progressive: ProgressiveMesh,
    /// For each node the vertex of the surface that entered, or `MADE`.
    pub vertex_of_node: Vec<u32>,
}

/// What a run holds on to besides the shape.
#[derive(Clone, Copy, Debug, Default)]
pub struct Holds<'a> {
    /// Thin vessels (`weights.rs`), where they are spared: the radius of the vessel at each vertex of the mesh in mm, infinite
    /// where it is in none.
    pub widths: Option<&'a [f32]>,
    /// The borders between labels (`borders.rs`): a number for each triangle of the mesh.
    pub labels: Option<&'a [u32]>,
    /// The caps whose areas are kept (`cap_areas.rs`); their rims have to be borders.
    pub caps: &'a [FlatCap],
}

/// Decimates `mesh`, whose topology is `topology`, as far as it goes. Rests about every millisecond; before the first vertex is
/// judged pieces take some 20 ms at a million triangles.
pub async fn decimate_in_slices(
    mesh: &TriMesh,
    topology: &Topology,
    settings: &Decimation,
    holds: Holds<'_>,
    yielder: &Yielder,
) -> Decimated {
    let mut run = Run::new(mesh, topology, settings);
    yielder.rest(0.0).await;
    // Slots get their rings, those without one are dropped, and pieces are counted.
    while !run.surface.rings.link(mesh, topology, LINKED) {
        yielder.rest(0.0).await;
    }
    yielder.rest(0.0).await;
    run.surface.rings.compact();
    yielder.rest(0.0).await;
    run.number(holds.widths);
    run.surface.caps = CapAreas::new(holds.caps, &run.surface.rings);
    yielder.rest(0.0).await;
    let count = components(mesh.positions.len(), &mesh.triangles).count();
    yielder.rest(0.0).await;
    run.surface.guard.start(&run.surface.rings, count == 1 && run.surface.rings.is_closed());
    yielder.rest(0.0).await;
    run.guard_ready(yielder, 0.0).await;

    // Feature edges are found and the method sees each slot, then each is judged for the first time. Both take about a tenth
    // of the run.
    let total = run.total as f32;
    for block in blocks(run.total, CHUNK) {
        let end = block.end;
        for v in block.start as u32..end as u32 {
            if let Some(labels) = holds.labels {
                run.surface.find_borders(v, mesh, topology, labels);
            }
            run.surface.meet(v, run.crease);
            run.note_lines(v);
        }
        yielder.rest(0.05 * end as f32 / total).await;
    }
    for block in blocks(run.total, CHUNK) {
        let end = block.end;
        (block.start as u32..end as u32).for_each(|v| run.begin(v));
        yielder.rest(0.05 + 0.05 * end as f32 / total).await;
    }
    while run.collapse_some() {
        let done = 0.1 + 0.9 * (1.0 - run.schedule.alive as f32 / total);
        yielder.rest(done).await;
        run.guard_ready(yielder, done).await;
    }
    yielder.rest(1.0).await;
    run.result(yielder).await
}

/// A run under way.
struct Run<'a> {
    mesh: &'a TriMesh,
    topology: &'a Topology,
    surface: Surface,
    schedule: Schedule,
    /// Cosine of the feature angle.
    crease: f32,
    /// What is found of the surface that entered, by its vertices.
    lines: Lines,
    merges: Vec<Merge>,
    errors: Vec<f32>,
    /// Slots that there were.
    total: usize,
}

impl<'a> Run<'a> {
    fn new(mesh: &'a TriMesh, topology: &'a Topology, settings: &Decimation) -> Self {
        let method: Box<dyn method::Method + Send> = match settings.method {
            Method::Schroeder => Box::new(Schroeder::default()),
            Method::Quadric => Box::new(Quadric::default()),
        };
        Self {
            surface: Surface::new(mesh, method),
            mesh,
            topology,
            schedule: Schedule::default(),
            crease: libm::cos(settings.feature_angle.to_radians()) as f32,
            lines: Lines::default(),
            merges: Vec::new(),
            errors: Vec::new(),
            total: 0,
        }
    }

    /// Gets ready for the slots that have a ring.
    fn number(&mut self, widths: Option<&[f32]>) {
        let count = self.surface.rings.len();
        self.surface.method.start(count);
        if let Some(widths) = widths {
            self.surface.weigh(&ratios(widths));
        }
        self.schedule = Schedule::new(count);
        self.merges.reserve(count);
        self.errors.reserve(count);
        self.total = count;
    }

    /// Goes on until the guard knows the surface, which it has to begin with again where the rings were compacted.
    async fn guard_ready(&mut self, yielder: &Yielder, done: f32) {
        while !self.surface.guard.is_ready() {
            self.surface.guard.advance(&self.surface.rings, &mut self.surface.star);
            yielder.rest(done).await;
        }
    }

    /// Visits the next vertices, fewer where the guard has much to do; whether there are more.
    fn collapse_some(&mut self) -> bool {
        let mut effort = 0;
        for _ in 0..CHUNK {
            let goes_on = match self.schedule.pop() {
                Some(v) => {
                    self.visit(v);
                    true
                }
                None => self.next_round(),
            };
            if !goes_on {
                return false;
            }
            effort += self.surface.guard.take_effort();
            if effort > EFFORT || !self.surface.guard.is_ready() {
                break;
            }
        }
        true
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
        match self.surface.way(self.mesh, v, &judged, limits, threshold) {
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

    fn next_round(&mut self) -> bool {
        if self.schedule.is_sparse() {
            let kept = self.surface.compact();
            self.schedule.compact(&kept);
        }
        self.schedule.next_round()
    }

    async fn result(self, yielder: &Yielder) -> Decimated {
        let mut limit = Limit::default();
        for state in &self.schedule.states {
            match state.stuck {
                Some(Stuck::Topology) => limit.topology += 1,
                Some(Stuck::Geometry) => limit.geometry += 1,
                Some(Stuck::Complex) => limit.complex += 1,
                None => {}
            }
        }
        let made = &self.surface.rings.made;
        let vertex_of_node = ProgressiveMesh::vertices_of_nodes(self.mesh.positions.len(), made.len(), &self.merges);
        yielder.rest(1.0).await;
        let levels = ProgressiveMesh::from_merges(self.mesh, &self.merges, made, self.errors, limit);
        yielder.rest(1.0).await;
        Decimated { progressive: levels.with_lines(&self.lines, &vertex_of_node), vertex_of_node }
    }
}
