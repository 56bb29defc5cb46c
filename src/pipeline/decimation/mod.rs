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
//! The error of a step is the method's measure, no bound of the true deviation: measure that (`super::deviation`).

mod fan;
mod guard;
mod method;
mod order;
mod quadric;
mod rings;
mod schroeder;
mod star;

use std::ops::Deref;

use glam::Vec3A;

use self::guard::{Guard, Planned};
use self::method::{Candidate, Judged};
use self::quadric::Quadric;
use self::rings::{Rings, gather, neighbour};
use self::schroeder::Schroeder;
use self::star::{MOST_AROUND, Star};
use super::progressive::{Limit, Merge, ProgressiveMesh};
use super::settings::{Decimation, Method};
use super::task::{Budget, Progress, Task};
use crate::mesh::{Topology, TriMesh, components};

/// What a collapse may do to the triangles around it.
#[derive(Clone, Copy)]
struct Strictness {
    /// Smallest cosine between a triangle's normal before and after.
    turn: f32,
    /// Smallest quality of a triangle that gets worse: 1 is equilateral, 0 has no area.
    quality: f32,
    /// By what the distance of a vertex counts that is held to no more than this: it waits until the others have come
    /// as far.
    price: f32,
}

/// A vertex that does not pass is tried again under the next, at its price. The last lets a triangle swing round as
/// the end of a branch does that is drawn in, but not fold over, and no longer heeds feature edges. The quality of the
/// first is the method's ([`method::Method::fair_quality`]).
const STRICTNESS: [Strictness; 4] = [
    Strictness { turn: 0.5, quality: 1.0, price: 1.0 },
    Strictness { turn: 0.2, quality: 0.03, price: 2.0 },
    Strictness { turn: 0.0, quality: 1e-3, price: 8.0 },
    Strictness { turn: -0.8, quality: 1e-4, price: 64.0 },
];

/// The last of them.
const LAST: u8 = STRICTNESS.len() as u8 - 1;

/// By what the threshold grows from round to round.
const GROWTH: f32 = 1.1;

/// Up to so many vertices a round are taken by their distances, the smallest first.
const FEW: usize = 4096;

/// Of so many slots one is left when those that are gone are dropped.
const SPARSE: usize = 3;

/// Keys that are passed over at once where none is small enough.
const BLOCK: usize = 32;

/// Vertices between two looks at the clock.
const CHUNK: usize = 64;

/// Tests of the guard between two looks at the clock.
const EFFORT: usize = 1 << 15;

/// Slots that get their rings between two looks at the clock before the first vertex is met.
const LINKED: usize = 1 << 15;

/// A star of less flatness may be the end of something thin: no plane says how far it reaches.
const FLAT: f32 = 0.8;
/// What the distance of such a vertex from what it leaves behind counts for, beside the mean distance of a star.
const TIP: f32 = 0.5;

/// Why a vertex does not go.
enum Refusal {
    /// It cannot.
    Stuck(Stuck),
    /// Its distance is larger than it was judged.
    Later(f32),
}

/// Why a vertex could not go when it was last tried.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stuck {
    Topology,
    Geometry,
    Complex,
}

/// What the run knows of a slot.
#[derive(Clone, Copy, Default)]
struct State {
    /// Whether its surroundings changed since it was judged.
    is_stale: bool,
    /// The index into [`STRICTNESS`] that it is held to.
    strictness: u8,
    /// Tried and refused; comes back when its surroundings change.
    stuck: Option<Stuck>,
}

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
    rings: Rings,
    method: Box<dyn method::Method + Send>,
    guard: Guard,
    phase: Phase,
    /// The threshold at which each slot is looked at again; infinite for those that are gone or stuck.
    keys: Vec<f32>,
    states: Vec<State>,
    /// The slots of the round, and the next one.
    round: Vec<u32>,
    next: usize,
    threshold: f32,
    /// Cosine of the feature angle.
    crease: f32,
    merges: Vec<Merge>,
    errors: Vec<f32>,
    /// Slots that are left, and that there were.
    alive: usize,
    total: usize,
    star: Star,
    other: Star,
    candidates: Vec<Candidate>,
}

impl<M: Deref<Target = TriMesh>, T: Deref<Target = Topology>> DecimationTask<M, T> {
    /// Starts decimating `mesh`, whose topology is `topology`.
    pub fn new(mesh: M, topology: T, settings: &Decimation) -> Self {
        let method: Box<dyn method::Method + Send> = match settings.method {
            Method::Schroeder => Box::new(Schroeder::default()),
            Method::Quadric => Box::new(Quadric::default()),
        };
        Self {
            rings: Rings::new(&mesh),
            mesh,
            topology,
            method,
            guard: Guard::default(),
            phase: Phase::Linking,
            keys: Vec::new(),
            states: Vec::new(),
            round: Vec::new(),
            next: 0,
            threshold: 0.0,
            crease: libm::cos(settings.feature_angle.to_radians()) as f32,
            merges: Vec::new(),
            errors: Vec::new(),
            alive: 0,
            total: 0,
            star: Star::new(),
            other: Star::new(),
            candidates: Vec::new(),
        }
    }

    /// The next piece of what comes before the first vertex is met; at most some 20 ms at a million triangles.
    fn prepare(&mut self) {
        match self.phase {
            Phase::Linking => {
                if self.rings.link(&self.mesh, &self.topology, LINKED) {
                    self.phase = Phase::Numbering;
                }
            }
            Phase::Numbering => {
                self.rings.compact();
                let count = self.rings.len();
                self.method.start(count);
                self.keys = vec![f32::INFINITY; count];
                self.states = vec![State::default(); count];
                self.merges.reserve(count);
                self.errors.reserve(count);
                (self.alive, self.total) = (count, count);
                self.phase = Phase::Counting;
            }
            Phase::Counting => {
                let count = components(self.mesh.positions.len(), &self.mesh.triangles).count();
                self.guard.start(&self.rings, count == 1 && self.rings.is_closed());
                self.phase = Phase::Meeting(0);
            }
            Phase::Meeting(_) | Phase::Judging(_) | Phase::Collapsing => {}
        }
    }

    /// Whether too many triangles meet at `v`.
    fn is_hub(&self, v: u32) -> bool {
        self.rings.around(v).len() > MOST_AROUND
    }

    /// Why `v` need not be looked at, whatever its surroundings.
    fn barred(&self, v: u32) -> Option<Stuck> {
        if self.rings.stays(v) {
            Some(Stuck::Complex)
        } else if self.is_hub(v) {
            Some(Stuck::Geometry)
        } else {
            None
        }
    }

    /// Finds the feature edges around `v`, and shows it to the method.
    fn meet(&mut self, v: u32) {
        if self.is_hub(v) {
            return;
        }
        self.star.load(&self.rings, v);
        self.star.span();
        self.method.meet(&self.rings, &self.star, v);
        let n = self.star.entries().len();
        let open = usize::from(self.rings.is_open(v));
        for i in open..n - open {
            let (a, b) = (self.star.normal((i + n - 1) % n), self.star.normal(i));
            if a.dot(b) < self.crease * (a.length_squared() * b.length_squared()).sqrt() {
                self.rings.set_crease(v, i);
            }
        }
    }

    /// Puts `v` into its place for the first time.
    fn begin(&mut self, v: u32) {
        self.states[v as usize].stuck = self.barred(v);
        if self.states[v as usize].stuck.is_none() {
            self.star.load(&self.rings, v);
            self.keys[v as usize] = self.judge(v).priority;
        }
    }

    fn limits(&self, v: u32) -> Strictness {
        match self.states[v as usize].strictness {
            0 => Strictness { quality: self.method.fair_quality(), ..STRICTNESS[0] },
            eased => STRICTNESS[usize::from(eased)],
        }
    }

    /// Judges `v`, whose star is loaded.
    fn judge(&mut self, v: u32) -> Judged {
        self.method.judge(&self.rings, &self.star, v, self.states[v as usize].strictness == LAST)
    }

    fn set_stuck(&mut self, v: u32, stuck: Stuck) {
        self.states[v as usize].stuck = Some(stuck);
        self.keys[v as usize] = f32::INFINITY;
    }

    /// Collapses `v` if its distance is below the threshold and there is a way.
    fn visit(&mut self, v: u32) {
        if self.rings.is_gone(v) {
            return;
        }
        if let Some(stuck) = self.barred(v) {
            self.set_stuck(v, stuck);
            return;
        }
        let state = &mut self.states[v as usize];
        if state.is_stale {
            state.strictness = 0;
            state.is_stale = false;
        }
        self.star.load(&self.rings, v);
        let judged = self.judge(v);
        let limits = self.limits(v);
        let key = judged.priority * limits.price;
        if key > self.threshold {
            self.keys[v as usize] = key;
            return;
        }
        match self.way(v, &judged, limits) {
            Ok((candidate, tip)) => self.collapse(v, candidate, judged.distance, tip),
            Err(Refusal::Later(key)) => self.keys[v as usize] = key,
            Err(Refusal::Stuck(stuck)) if self.is_eased(v, &judged, stuck) => {
                self.keys[v as usize] = judged.priority * self.limits(v).price;
            }
            Err(Refusal::Stuck(stuck)) => self.set_stuck(v, stuck),
        }
    }

    /// Holds `v` to less, if that can help: what is stuck by topology is helped only where a feature edge holds it.
    fn is_eased(&mut self, v: u32, judged: &Judged, stuck: Stuck) -> bool {
        let strictness = &mut self.states[v as usize].strictness;
        if *strictness == LAST || (stuck == Stuck::Topology && !judged.is_held) {
            return false;
        }
        *strictness = if stuck == Stuck::Topology { LAST } else { *strictness + 1 };
        true
    }

    /// The cheapest way for `v` to go that passes every test, and how far it reaches out of what it leaves behind.
    fn way(&mut self, v: u32, judged: &Judged, limits: Strictness) -> Result<(Candidate, f32), Refusal> {
        self.star.span();
        self.candidates.clear();
        self.method.offer(&self.star, v, judged, &mut self.candidates);
        let mut stuck = Stuck::Topology;
        while let Some(i) = self.cheapest(v, limits, &mut stuck) {
            let mut candidate = self.candidates[i];
            let u = neighbour(self.star.entries()[candidate.to]);
            if !self.is_hub(u) && self.rings.may_collapse(v, u) {
                let at = candidate.place.and_then(|_| self.load_other(v, u));
                if let (Some(at), Some(place)) = (at, candidate.place) {
                    candidate.place = Some(self.level(v, u, &candidate, at, limits).unwrap_or(place));
                }
                let tip = self.tip(&candidate, at);
                let key = self.method.priority(tip) * limits.price;
                if key > self.threshold {
                    return Err(Refusal::Later(key));
                }
                if self.is_clear(v, u, &candidate, at) {
                    return Ok((candidate, tip));
                }
                stuck = Stuck::Geometry;
            }
            self.candidates[i].cost = f32::INFINITY;
        }
        Err(Refusal::Stuck(stuck))
    }

    /// The candidate of least cost, shape included; those that fold or make a sliver are struck out.
    fn cheapest(&mut self, v: u32, limits: Strictness, stuck: &mut Stuck) -> Option<usize> {
        let mut best: Option<(f32, usize)> = None;
        for i in 0..self.candidates.len() {
            let candidate = self.candidates[i];
            // Shape only adds to the cost.
            if candidate.cost == f32::INFINITY || best.is_some_and(|(least, _)| candidate.cost >= least) {
                continue;
            }
            match self.worst_after(v, &candidate, limits) {
                None => {
                    *stuck = Stuck::Geometry;
                    self.candidates[i].cost = f32::INFINITY;
                }
                Some(worst) => {
                    let cost = candidate.cost + self.method.shape_cost(&self.star, candidate.cost) * (1.0 - worst);
                    if best.is_none_or(|(least, _)| cost < least) {
                        best = Some((cost, i));
                    }
                }
            }
        }
        best.map(|(_, i)| i)
    }

    fn worst_after(&mut self, v: u32, candidate: &Candidate, limits: Strictness) -> Option<f32> {
        let Strictness { turn, quality, .. } = limits;
        let edge = self.star.edge(candidate.to);
        let Some(place) = candidate.place else { return self.star.worst_after(edge, candidate.to, turn, quality) };
        let worst = self.star.worst_after(place, candidate.to, turn, quality)?;
        let u = neighbour(self.star.entries()[candidate.to]);
        if self.rings.stays(u) || self.is_hub(u) {
            return None;
        }
        let at = self.load_other(v, u)?;
        Some(worst.min(self.other.worst_after(place - edge, at, turn, quality)?))
    }

    /// Loads the star of `u`, and says where `v` stands in it.
    fn load_other(&mut self, v: u32, u: u32) -> Option<usize> {
        self.other.load(&self.rings, u);
        self.other.span();
        self.other.position(v)
    }

    /// Where the new vertex of a candidate should be so that the volume stays, if that passes the tests of shape.
    fn level(&self, v: u32, u: u32, candidate: &Candidate, at: usize, limits: Strictness) -> Option<Vec3A> {
        if self.rings.is_open(v) || self.rings.is_open(u) {
            return None;
        }
        let edge = self.star.edge(candidate.to);
        let count = self.other.entries().len();
        let shared = self.other.normal(at) + self.other.normal((at + count - 1) % count);
        let apart = self.other.normal_sum() - shared;
        let normal = self.star.normal_sum() + apart;
        let place = self.method.level(v, u, edge, candidate.place?, normal, apart.dot(edge))?;
        self.star.worst_after(place, candidate.to, limits.turn, limits.quality)?;
        self.other.worst_after(place - edge, at, limits.turn, limits.quality)?;
        Some(place)
    }

    /// The distance that a vertex which goes has, by its reach alone, from what it leaves behind; 0 where its planes say
    /// it. `at` is where the vertex stands in the other's star, if both go.
    fn tip(&self, candidate: &Candidate, at: Option<usize>) -> f32 {
        let reach = |star: &Star, way: Vec3A, j: usize| {
            if star.flatness() >= FLAT { 0.0 } else { TIP * star.distance_to_patch(way, j) }
        };
        let edge = self.star.edge(candidate.to);
        let own = reach(&self.star, candidate.place.unwrap_or(edge), candidate.to);
        match (at, candidate.place) {
            (Some(at), Some(place)) => own.max(reach(&self.other, place - edge, at)),
            _ => own,
        }
    }

    /// Whether no triangle would run into another.
    fn is_clear(&mut self, v: u32, u: u32, candidate: &Candidate, at: Option<usize>) -> bool {
        let other = at.map(|at| (&self.other, at));
        let end = candidate.place.map_or(self.rings.at(u), |place| self.rings.at(v) + place);
        let planned = Planned { v, u, to: candidate.to, end, star: &self.star, other };
        self.guard.allows(&self.rings, &self.mesh, &planned)
    }

    fn collapse(&mut self, v: u32, candidate: Candidate, distance: f32, tip: f32) {
        let distance = distance.max(tip);
        let u = neighbour(self.star.entries()[candidate.to]);
        let way = self.star.edge(candidate.to);
        self.method.merge(v, u, way, candidate.place, tip);
        let (gone, kept) = (self.rings.nodes[v as usize], self.rings.nodes[u as usize]);
        let end = candidate.place.map(|place| self.rings.at(v) + place);
        self.rings.collapse(v, u);
        let made = end.map(|end| self.rings.renew(u, end));
        self.merges.push(Merge { gone, kept, made });
        self.errors.push(distance * self.rings.unit);
        self.keys[v as usize] = f32::INFINITY;
        self.alive -= 1;
        for i in 0..self.star.entries().len() {
            self.set_stale(neighbour(self.star.entries()[i]));
        }
        if made.is_some() {
            for i in 0..self.rings.around(u).len() {
                self.set_stale(neighbour(self.rings.around(u)[i]));
            }
        }
    }

    fn set_stale(&mut self, v: u32) {
        if !self.rings.stays(v) {
            let state = &mut self.states[v as usize];
            state.is_stale = true;
            if state.stuck.take().is_some() {
                self.keys[v as usize] = 0.0;
            }
        }
    }

    /// The slots of the next round. Returns false when there is none.
    fn next_round(&mut self) -> bool {
        if self.alive * SPARSE < self.rings.len() {
            self.compact();
        }
        self.round.clear();
        self.next = 0;
        let mut least = f32::INFINITY;
        let smaller = |a: f32, b: f32| if b < a { b } else { a };
        for (block, keys) in self.keys.chunks(BLOCK).enumerate() {
            let smallest = keys.iter().fold(f32::INFINITY, |smallest, &key| smaller(smallest, key));
            if smallest > self.threshold {
                least = smaller(least, smallest);
                continue;
            }
            for (i, &key) in keys.iter().enumerate() {
                if key <= self.threshold {
                    self.round.push((block * BLOCK + i) as u32);
                } else {
                    least = smaller(least, key);
                }
            }
        }
        if self.round.is_empty() {
            self.threshold = (self.threshold * GROWTH).max(least * GROWTH);
            return least < f32::INFINITY;
        }
        if self.round.len() <= FEW {
            let keys = &self.keys;
            self.round.sort_by(|&a, &b| keys[a as usize].total_cmp(&keys[b as usize]));
        }
        self.threshold *= GROWTH;
        true
    }

    /// Drops the slots that are gone, so that what is left stands close together.
    fn compact(&mut self) {
        let kept = self.rings.compact();
        self.keys = gather(&self.keys, &kept);
        self.states = gather(&self.states, &kept);
        self.method.compact(&kept);
        self.guard.restart(&self.rings);
    }

    fn result(&mut self) -> ProgressiveMesh {
        let mut limit = Limit::default();
        for state in &self.states {
            match state.stuck {
                Some(Stuck::Topology) => limit.topology += 1,
                Some(Stuck::Geometry) => limit.geometry += 1,
                Some(Stuck::Complex) => limit.complex += 1,
                None => {}
            }
        }
        let errors = std::mem::take(&mut self.errors);
        ProgressiveMesh::from_merges(&self.mesh, &self.merges, &self.rings.made, errors, limit)
    }

    /// The next piece of work. Returns false when there is none.
    fn step(&mut self) -> bool {
        let count = self.rings.len() as u32;
        match self.phase {
            Phase::Linking | Phase::Numbering | Phase::Counting => self.prepare(),
            _ if !self.guard.is_ready() => {
                self.guard.advance(&self.rings, &mut self.star);
            }
            Phase::Meeting(v) if v < count => {
                self.meet(v);
                self.phase = Phase::Meeting(v + 1);
            }
            Phase::Meeting(_) => self.phase = Phase::Judging(0),
            Phase::Judging(v) if v < count => {
                self.begin(v);
                self.phase = Phase::Judging(v + 1);
            }
            Phase::Judging(_) => self.phase = Phase::Collapsing,
            Phase::Collapsing => match self.round.get(self.next) {
                Some(&v) => {
                    self.next += 1;
                    self.visit(v);
                }
                None => return self.next_round(),
            },
        }
        true
    }

    fn fraction(&self) -> f32 {
        let total = self.total.max(1) as f32;
        // Seeing and judging all vertices once takes about a tenth of the run.
        match self.phase {
            Phase::Linking | Phase::Numbering | Phase::Counting => 0.0,
            Phase::Meeting(v) => 0.05 * v as f32 / total,
            Phase::Judging(v) => 0.05 + 0.05 * v as f32 / total,
            Phase::Collapsing => 0.1 + 0.9 * (1.0 - self.alive as f32 / total),
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
                effort += self.guard.take_effort();
                if effort > EFFORT || self.phase < Phase::Meeting(0) || !self.guard.is_ready() {
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
    use crate::mesh::shapes::{icosphere, joined};
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
