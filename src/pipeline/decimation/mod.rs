//! Decimation to a progressive mesh: Schroeder, Zarge and Lorensen, "Decimation of triangle meshes" (1992).
//!
//! Each vertex has one of five classes and a distance from the plane or line that would take its place
//! (`vertex.rs`); the one with the smallest distance goes first. (The paper's text has the test the wrong way
//! round; Schroeder's own deletes when the distance is *less* than the threshold, and so does this.) Deleting the
//! vertex and patching the hole is expressed as a half-edge collapse onto one of its neighbours, so that the run is
//! a progressive mesh (Hoppe 1996): one run to the last vertex that can go has every reduction rate in it.
//!
//! - The distance of a vertex counts from what its surroundings have already lost: a collapse hands the distance it
//!   was made at to the ring it leaves behind.
//! - Of the neighbours that it may collapse onto, a vertex takes the one over which the surface sweeps the least
//!   volume, with a preference for well-shaped triangles. Boundary and interior-edge vertices move along their line.
//! - Every collapse passes the link condition (Dey, Edelsbrunner, Guha and Nekhayev 1999): no topology changes,
//!   no open end falls below three edges. None may fold a triangle over or make a sliver; for a vertex that does not
//!   meet the strict limits they are eased, step by step, at the price of waiting longer, down to "does not fold".
//!
//! It does not move vertices, does not bound the true deviation (measure it: `super::deviation`), and does not test
//! for triangles that meet without sharing a vertex.

mod surface;
mod vertex;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Deref;

use glam::DVec3;

use self::surface::{Ring, Surface};
pub use self::vertex::Class;
use self::vertex::Judged;
use super::progressive::{Limit, NEVER, ProgressiveMesh};
use super::settings::Decimation;
use super::task::{Budget, Progress, Task};
use crate::mesh::{Topology, TriMesh};

/// What a collapse may do to the triangles around it.
#[derive(Clone, Copy)]
struct Strictness {
    /// Smallest cosine between a triangle's normal before and after.
    turn: f64,
    /// Smallest quality of a triangle that gets worse: 1 is equilateral, 0 has no area.
    quality: f64,
    /// Whether feature edges hold their vertices.
    features: bool,
    /// By what the distance of a vertex counts that is held to no more than this: it waits until the others have come
    /// as far.
    price: f32,
}

/// A vertex that does not pass is tried again under the next, at its price. The last lets a triangle swing round as
/// the end of a branch does that is drawn in, but not fold over, and no longer heeds feature edges.
const STRICTNESS: [Strictness; 4] = [
    Strictness { turn: 0.5, quality: 0.15, features: true, price: 1.0 },
    Strictness { turn: 0.2, quality: 0.03, features: true, price: 2.0 },
    Strictness { turn: 0.0, quality: 1e-3, features: true, price: 8.0 },
    Strictness { turn: -0.8, quality: 1e-4, features: false, price: 64.0 },
];

/// What a poorly shaped triangle costs, as a part of its ring's size, beside the height swept.
const SHAPE_COST: f64 = 0.01;

/// Triangles around a vertex above which it waits for its neighbours to go first, and nothing collapses onto it: what
/// is asked of a ring takes the square of its size and more, and the middle of a flat cap may have thousands.
const MOST_AROUND: usize = 128;

/// Pops between two looks at the clock.
const CHUNK: usize = 64;

/// Why a vertex could not go when it was last tried.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stuck {
    Topology,
    Geometry,
    Complex,
}

/// A decimation run in slices; `M` is any pointer to a mesh.
pub struct DecimationTask<M> {
    mesh: M,
    surface: Surface,
    /// Vertices by distance, the smallest first, then by index; entries of vertices that changed are judged again
    /// when they come up.
    queue: BinaryHeap<Reverse<(u32, u32)>>,
    state: Vec<State>,
    /// Distance in mm that a vertex's surroundings have lost already.
    inherited: Vec<f32>,
    /// The index into [`STRICTNESS`] that each vertex is held to.
    strictness: Vec<u8>,
    /// Cosine of the feature angle.
    crease: f64,
    /// Triangles whose feature edges are found, and vertices that are judged, at the start of the run so far.
    creased: u32,
    begun: u32,
    collapses: Vec<[u32; 2]>,
    errors: Vec<f32>,
    triangle_ends: Vec<u32>,
    alive: usize,
    ring: Ring,
    ended: Vec<u32>,
    marks: Vec<u32>,
    mark: u32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// In the queue, judged since its surroundings last changed.
    Fresh,
    /// In the queue, its surroundings changed since.
    Stale,
    /// Tried and refused; comes back when its surroundings change.
    Stuck(Stuck),
    /// Collapsed, or in no triangle.
    Gone,
}

impl<M: Deref<Target = TriMesh>> DecimationTask<M> {
    /// Starts decimating `mesh`, whose topology is `topology`.
    pub fn new(mesh: M, topology: &Topology, settings: &Decimation) -> Self {
        let surface = Surface::new(&mesh, topology);
        let count = mesh.positions.len();
        Self {
            triangle_ends: vec![NEVER; mesh.triangles.len()],
            alive: mesh.triangles.len(),
            mesh,
            surface,
            queue: BinaryHeap::with_capacity(count),
            state: vec![State::Gone; count],
            inherited: vec![0.0; count],
            strictness: vec![0; count],
            crease: libm::cos(settings.feature_angle.to_radians()),
            creased: 0,
            begun: 0,
            collapses: Vec::with_capacity(count),
            errors: Vec::with_capacity(count),
            ring: Ring::default(),
            ended: Vec::new(),
            marks: vec![0; count],
            mark: 0,
        }
    }

    /// What `v` is held to.
    fn limits(&self, v: u32) -> Strictness {
        STRICTNESS[usize::from(self.strictness[v as usize])]
    }

    /// Whether too many triangles meet at `v`.
    fn is_hub(&self, v: u32) -> bool {
        self.surface.fan(v).len() > MOST_AROUND
    }

    /// Distance in mm at which `v` would go now; the ring is left in `self.ring`.
    fn judge(&mut self, v: u32) -> (Judged, f32) {
        let is_fan = self.surface.order_ring(v, &mut self.ring);
        let judged = Judged::new(&self.surface, v, &self.ring, is_fan, self.limits(v).features);
        let distance = judged.distance as f32 + self.inherited[v as usize];
        (judged, distance)
    }

    /// Judges `v`, held to the strictest limits, and puts it into the queue, unless it can never go.
    fn enqueue(&mut self, v: u32) {
        if self.is_hub(v) {
            self.state[v as usize] = State::Stuck(Stuck::Geometry);
            return;
        }
        self.strictness[v as usize] = 0;
        let (judged, distance) = self.judge(v);
        if judged.class == Class::Complex {
            self.state[v as usize] = State::Stuck(Stuck::Complex);
        } else {
            self.push(v, distance);
        }
    }

    fn push(&mut self, v: u32, distance: f32) {
        let price = distance * self.limits(v).price;
        self.queue.push(Reverse((price.to_bits(), v)));
        self.state[v as usize] = State::Fresh;
    }

    /// Tries the vertex at the head of the queue. Returns false when the queue is empty.
    fn step(&mut self) -> bool {
        let Some(Reverse((_, v))) = self.queue.pop() else { return false };
        let stale = match self.state[v as usize] {
            State::Fresh => false,
            State::Stale => true,
            State::Stuck(_) | State::Gone => return true,
        };
        if self.is_hub(v) {
            self.state[v as usize] = State::Stuck(Stuck::Geometry);
            return true;
        }
        if stale {
            self.strictness[v as usize] = 0;
        }
        let (judged, distance) = self.judge(v);
        if judged.class == Class::Complex {
            self.state[v as usize] = State::Stuck(Stuck::Complex);
            return true;
        }
        if stale && self.queue.peek().is_some_and(|Reverse((next, _))| distance.to_bits() > *next) {
            self.push(v, distance);
            return true;
        }
        match self.best_target(v, &judged) {
            Ok(kept) => self.collapse(v, kept, distance),
            Err(stuck) if self.is_eased(v, &judged, stuck) => self.push(v, distance),
            Err(stuck) => self.state[v as usize] = State::Stuck(stuck),
        }
        true
    }

    /// Holds `v` to less, if that can help: what is stuck by topology is helped only where a feature edge holds it.
    fn is_eased(&mut self, v: u32, judged: &Judged, stuck: Stuck) -> bool {
        let last = STRICTNESS.len() as u8 - 1;
        let strictness = &mut self.strictness[v as usize];
        if *strictness == last || (stuck == Stuck::Topology && judged.class != Class::InteriorEdge) {
            return false;
        }
        *strictness = if stuck == Stuck::Topology { last } else { *strictness + 1 };
        true
    }

    fn collapse(&mut self, v: u32, kept: u32, distance: f32) {
        let step = self.collapses.len() as u32;
        self.surface.collapse(v, kept, &mut self.ended);
        for &t in &self.ended {
            self.triangle_ends[t as usize] = step;
        }
        self.alive -= self.ended.len();
        self.collapses.push([v, kept]);
        self.errors.push(distance);
        self.state[v as usize] = State::Gone;
        let ring = std::mem::take(&mut self.ring);
        for (n, _) in ring.neighbours() {
            self.inherited[n as usize] = self.inherited[n as usize].max(distance);
            match self.state[n as usize] {
                State::Fresh => self.state[n as usize] = State::Stale,
                State::Stuck(_) => {
                    // `enqueue` writes to self.ring, which is empty here and is put back below.
                    self.enqueue(n);
                }
                State::Stale | State::Gone => {}
            }
        }
        self.ring = ring;
    }

    /// The neighbour that `v`, whose ring is in order, should collapse onto.
    fn best_target(&mut self, v: u32, judged: &Judged) -> Result<u32, Stuck> {
        let mut best: Option<(f64, u32)> = None;
        let mut stuck = Stuck::Topology;
        for i in 0..=self.ring.spokes.len() {
            let Some((target, _)) = self.ring.neighbours().nth(i) else { break };
            let is_off_line = judged.along.is_some_and(|along| !along.contains(&target));
            if is_off_line || self.is_hub(target) || !self.link_condition(v, target) {
                continue;
            }
            match self.cost(v, target) {
                None => stuck = Stuck::Geometry,
                Some(cost) if best.is_none_or(|(least, _)| cost < least) => best = Some((cost, target)),
                Some(_) => {}
            }
        }
        best.map(|(_, target)| target).ok_or(stuck)
    }

    /// Whether collapsing `v` onto `target` keeps the topology: the vertices that both touch are just the ones
    /// opposite their common edge, and no triangle closes over the one that would be left.
    fn link_condition(&mut self, v: u32, target: u32) -> bool {
        self.mark += 2;
        let (of_v, shared) = (self.mark, self.mark + 1);
        let mut opposite = 0;
        for (n, _) in self.ring.neighbours() {
            self.marks[n as usize] = of_v;
        }
        for spoke in &self.ring.spokes {
            opposite += u32::from(spoke.a == target || spoke.b == target);
        }
        let mut common = 0;
        for &t in self.surface.fan(target) {
            let corners = self.surface.triangles[t as usize];
            let mut touched = 0;
            for n in corners {
                if n == v || n == target {
                    continue;
                }
                let mark = &mut self.marks[n as usize];
                touched += u32::from(*mark >= of_v);
                if *mark == of_v {
                    *mark = shared;
                    common += 1;
                }
            }
            // A triangle (target, x, y) with x and y both around v: is (v, x, y) there as well?
            if touched == 2 && !corners.contains(&v) && self.ring_has_edge(corners) {
                return false;
            }
        }
        // An ear goes only from an edge that has one more triangle: a piece of one triangle stays, and so does an
        // edge of three.
        if let [ear] = self.ring.spokes[..] {
            let beside =
                self.surface.fan(ear.a).iter().filter(|&&t| self.surface.triangles[t as usize].contains(&ear.b));
            if beside.count() != 2 {
                return false;
            }
        }
        // An edge between two boundaries may not become a vertex: only boundary edges of boundary vertices collapse.
        common == opposite && (opposite == 2 || (opposite == 1 && !self.ring.closed))
    }

    /// Whether some triangle of the ring has its outer edge among `corners`.
    fn ring_has_edge(&self, corners: [u32; 3]) -> bool {
        self.ring.spokes.iter().any(|s| corners.contains(&s.a) && corners.contains(&s.b))
    }

    /// What the collapse of `v` onto `target` costs: the mean height over which the ring is swept, in mm, and a
    /// little for poor shape. `None` if it would fold a triangle or make a sliver.
    fn cost(&self, v: u32, target: u32) -> Option<f64> {
        let limits = self.limits(v);
        let (p, q) = (self.surface.at(v), self.surface.at(target));
        let way = q - p;
        let (mut swept, mut area, mut worst) = (0.0, 0.0, 1.0f64);
        for spoke in &self.ring.spokes {
            let (a, b) = (self.surface.at(spoke.a), self.surface.at(spoke.b));
            let old = (a - p).cross(b - p);
            let old_length = old.length();
            swept += way.dot(old).abs();
            area += old_length;
            if spoke.a == target || spoke.b == target {
                continue;
            }
            let new = (a - q).cross(b - q);
            let new_length = new.length();
            let quality = quality(new_length, q, a, b);
            if quality < limits.quality && quality < self::quality(old_length, p, a, b) {
                return None;
            }
            if new.dot(old) <= limits.turn * new_length * old_length {
                return None;
            }
            worst = worst.min(quality);
        }
        let height = if area > 0.0 { swept / area } else { 0.0 };
        Some(height + SHAPE_COST * area.sqrt() * (1.0 - worst))
    }

    fn result(&mut self) -> ProgressiveMesh {
        let mut limit = Limit::default();
        for state in &self.state {
            match state {
                State::Stuck(Stuck::Topology) => limit.topology += 1,
                State::Stuck(Stuck::Geometry) => limit.geometry += 1,
                State::Stuck(Stuck::Complex) => limit.complex += 1,
                State::Fresh | State::Stale | State::Gone => {}
            }
        }
        let errors = std::mem::take(&mut self.errors);
        ProgressiveMesh::from_collapses(&self.mesh, &self.collapses, &self.triangle_ends, errors, limit)
    }
}

impl<M: Deref<Target = TriMesh>> Task for DecimationTask<M> {
    type Output = ProgressiveMesh;

    fn advance(&mut self, budget: Budget) -> Progress<ProgressiveMesh> {
        let total = self.mesh.triangles.len().max(1) as f32;
        let count = self.surface.vertex_count() as u32;
        loop {
            for _ in 0..CHUNK {
                if (self.creased as usize) < self.surface.triangles.len() {
                    self.surface.find_creases(self.creased, self.crease);
                    self.creased += 1;
                } else if self.begun < count {
                    if !self.surface.fan(self.begun).is_empty() {
                        self.enqueue(self.begun);
                    }
                    self.begun += 1;
                } else if !self.step() {
                    return Progress::Done(self.result());
                }
            }
            if budget.is_spent() {
                // Judging all vertices once takes about a tenth of the run.
                let begun = self.begun as f32 / count.max(1) as f32;
                return Progress::Working(0.1 * begun + 0.9 * (1.0 - self.alive as f32 / total));
            }
        }
    }
}

/// Decimates `mesh` as far as it goes.
pub fn decimate(mesh: &TriMesh, topology: &Topology, settings: &Decimation) -> ProgressiveMesh {
    DecimationTask::new(mesh, topology, settings).finish()
}

/// Shape of a triangle from twice its area and its corners: 1 if equilateral, 0 without area.
fn quality(twice_area: f64, a: DVec3, b: DVec3, c: DVec3) -> f64 {
    const NORM: f64 = 3.464_101_615_137_754_6; // 2 sqrt 3
    let squares = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    if squares > 0.0 { NORM * twice_area / squares } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn caps_with_thousands_of_triangles_around_one_vertex_go_as_far_as_any() {
        let n = 3000u32;
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
        let mesh = TriMesh { positions, triangles: (0..n).flat_map(around).collect() };
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let levels = decimate(&mesh, &topology, &Decimation::default());
        levels.assert_well_formed();
        assert_eq!(levels.triangles_after(levels.errors.len() as u32), 4);
    }
}
