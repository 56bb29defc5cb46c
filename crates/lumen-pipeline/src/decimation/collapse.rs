//! The surface under collapses: where a vertex may go, and what is left when it has gone.

use glam::Vec3A;

use super::borders::{Border, border_of, mark};
use super::cap_areas::CapAreas;
use super::guard::{Guard, Planned};
use super::method::{Candidate, Judged, Method};
use super::one_ring::{MAX_AROUND, OneRing};
use super::rings::{Rings, gather, neighbour};
use super::schedule::Stuck;
use lumen_mesh::{Topology, TriMesh};

/// What a collapse may do to the triangles around it.
#[derive(Clone, Copy)]
pub(super) struct Strictness {
    /// Smallest cosine between a triangle's normal before and after.
    pub(super) turn: f32,
    /// Smallest quality of a triangle that gets worse: 1 is equilateral, 0 has no area.
    pub(super) quality: f32,
    /// By what the distance of a vertex counts that is held to no more than this: it waits until the others have come
    /// as far.
    pub(super) price: f32,
}

/// A vertex that does not pass is tried again under the next, at its price. The last lets a triangle swing round as
/// the end of a branch does that is drawn in, but not fold over, and no longer heeds feature edges. The quality of the
/// first is the method's ([`method::Method::fair_quality`]).
pub(super) const STRICTNESS: [Strictness; 4] = [
    Strictness { turn: 0.5, quality: 1.0, price: 1.0 },
    Strictness { turn: 0.2, quality: 0.03, price: 2.0 },
    Strictness { turn: 0.0, quality: 1e-3, price: 8.0 },
    Strictness { turn: -0.8, quality: 1e-4, price: 64.0 },
];

/// The last of them.
pub(super) const LAST: u8 = STRICTNESS.len() as u8 - 1;

/// A star of less flatness may be the end of something thin: no plane says how far it reaches.
const FLAT: f32 = 0.8;
/// What the distance of such a vertex from what it leaves behind counts for, beside the mean distance of a star.
const TIP: f32 = 0.5;

/// Why a vertex does not go.
pub(super) enum Refusal {
    /// It cannot.
    Stuck(Stuck),
    /// The cheapest way that is open costs more than it was judged by.
    Later(f32),
}

/// The surface, and what stands around the vertex that is looked at.
pub(super) struct Surface {
    pub(super) rings: Rings,
    pub(super) method: Box<dyn Method + Send>,
    pub(super) guard: Guard,
    pub(super) caps: CapAreas,
    /// By what the distance of each slot counts (`weights.rs`); empty where all count alike.
    pub(super) weights: Vec<f32>,
    pub(super) star: OneRing,
    other: OneRing,
    /// Whose star `other` is.
    loaded: Option<u32>,
    candidates: Vec<Candidate>,
}

impl Surface {
    pub(super) fn new(mesh: &TriMesh, method: Box<dyn Method + Send>) -> Self {
        Self {
            rings: Rings::new(mesh),
            method,
            guard: Guard::default(),
            caps: CapAreas::default(),
            weights: Vec::new(),
            star: OneRing::new(),
            other: OneRing::new(),
            loaded: None,
            candidates: Vec::new(),
        }
    }

    /// Whether too many triangles meet at `v`.
    fn is_hub(&self, v: u32) -> bool {
        self.rings.around(v).len() > MAX_AROUND
    }

    /// Why `v` need not be looked at, whatever its surroundings.
    pub(super) fn barred(&self, v: u32) -> Option<Stuck> {
        if self.rings.stays(v) {
            Some(Stuck::Complex)
        } else if self.is_hub(v) {
            Some(Stuck::Geometry)
        } else if self.rings.has_borders() && border_of(&self.rings, v) == Border::Stays {
            Some(Stuck::Topology)
        } else {
            None
        }
    }

    /// Finds the borders between labels around `v`; `labels` has a number for each triangle of the mesh.
    pub(super) fn find_borders(&mut self, v: u32, mesh: &TriMesh, topology: &Topology, labels: &[u32]) {
        if !self.is_hub(v) {
            mark(&mut self.rings, v, mesh, topology, labels);
        }
    }

    /// Finds the feature edges around `v`, and shows it to the method.
    pub(super) fn meet(&mut self, v: u32, crease: f32) {
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
            if a.dot(b) < crease * (a.length_squared() * b.length_squared()).sqrt() {
                self.rings.set_crease(v, i);
            }
        }
    }

    /// Counts distances by these `ratios` of radii, one for each vertex of the mesh. No vertex is gone yet.
    pub(super) fn weigh(&mut self, ratios: &[f32]) {
        let weight = |&node: &u32| self.method.weight(ratios[node as usize]);
        self.weights = self.rings.nodes.iter().map(weight).collect();
    }

    /// Loads the star of `v` and judges it, held to the limits of number `strictness`.
    pub(super) fn judge(&mut self, v: u32, strictness: u8) -> Judged {
        self.star.load(&self.rings, v);
        let border = if self.rings.has_borders() { border_of(&self.rings, v) } else { Border::None };
        let along = if let Border::Along(ends) = border { Some(ends) } else { None };
        self.method.judge(&self.rings, &self.star, v, strictness == LAST, along)
    }

    /// The limits of that number for `v`, whose weight is in the price.
    pub(super) fn limits(&self, v: u32, strictness: u8) -> Strictness {
        let limits = STRICTNESS[usize::from(strictness)];
        let quality = if strictness == 0 { self.method.fair_quality() } else { limits.quality };
        let weight = self.weights.get(v as usize).copied().unwrap_or(1.0);
        Strictness { quality, price: limits.price * weight, ..limits }
    }

    /// The cheapest way for `v` to go that passes every test, and how far it reaches out of what it leaves behind.
    pub(super) fn way(
        &mut self,
        mesh: &TriMesh,
        v: u32,
        judged: &Judged,
        limits: Strictness,
        threshold: f32,
    ) -> Result<(Candidate, f32), Refusal> {
        self.star.span();
        self.candidates.clear();
        self.method.offer(&self.star, v, judged, &mut self.candidates);
        self.candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
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
                // Where a cheaper one is barred, this one waits until it would have been its turn.
                let key = candidate.priority.max(self.method.priority(tip)) * limits.price;
                if key > threshold {
                    return Err(Refusal::Later(key));
                }
                let end = self.end(v, u, &candidate);
                if self.caps.allow(&self.rings, v, u, end) && self.is_clear(mesh, v, u, &candidate, at) {
                    return Ok((candidate, tip));
                }
                stuck = Stuck::Geometry;
            }
            self.candidates[i].cost = f32::INFINITY;
        }
        Err(Refusal::Stuck(stuck))
    }

    /// The candidate of least cost, shape included, of equal ones the first around the vertex; those that fold or make a sliver
    /// are struck out.
    fn cheapest(&mut self, v: u32, limits: Strictness, stuck: &mut Stuck) -> Option<usize> {
        let mut best: Option<(f32, usize)> = None;
        for i in 0..self.candidates.len() {
            let candidate = self.candidates[i];
            if candidate.cost == f32::INFINITY {
                continue;
            }
            // Shape only adds to the cost, and what follows costs no less.
            if best.is_some_and(|(least, _)| candidate.cost > least) {
                break;
            }
            match self.worst_after(v, &candidate, limits) {
                None => {
                    *stuck = Stuck::Geometry;
                    self.candidates[i].cost = f32::INFINITY;
                }
                Some(worst) => {
                    let cost = candidate.cost + self.method.shape_cost(&self.star, candidate.cost) * (1.0 - worst);
                    let is_before = |other: usize| candidate.to < self.candidates[other].to;
                    if best.is_none_or(|(least, other)| cost < least || cost == least && is_before(other)) {
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

    /// Loads the star of `u`, if it is not there yet, and says where `v` stands in it.
    fn load_other(&mut self, v: u32, u: u32) -> Option<usize> {
        if self.loaded != Some(u) {
            self.other.load(&self.rings, u);
            self.other.span();
            self.loaded = Some(u);
        }
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
        let reach = |star: &OneRing, way: Vec3A, j: usize| {
            if star.flatness() >= FLAT { 0.0 } else { TIP * star.distance_to_patch(way, j) }
        };
        let edge = self.star.edge(candidate.to);
        let own = reach(&self.star, candidate.place.unwrap_or(edge), candidate.to);
        match (at, candidate.place) {
            (Some(at), Some(place)) => own.max(reach(&self.other, place - edge, at)),
            _ => own,
        }
    }

    /// Where `u` is once `v` has gone to it.
    fn end(&self, v: u32, u: u32, candidate: &Candidate) -> Vec3A {
        candidate.place.map_or(self.rings.at(u), |place| self.rings.at(v) + place)
    }

    /// Whether no triangle would run into another.
    fn is_clear(&mut self, mesh: &TriMesh, v: u32, u: u32, candidate: &Candidate, at: Option<usize>) -> bool {
        let other = at.map(|at| (&self.other, at));
        let end = self.end(v, u, candidate);
        let planned = Planned { v, u, to: candidate.to, end, star: &self.star, other };
        self.guard.allows(&self.rings, mesh, &planned)
    }

    /// Collapses `v`, whose star is loaded, onto the neighbour of `candidate`; the new place of that, where it moves.
    pub(super) fn collapse(&mut self, v: u32, candidate: &Candidate, tip: f32) -> Option<u32> {
        let u = neighbour(self.star.entries()[candidate.to]);
        let way = self.star.edge(candidate.to);
        self.method.merge(v, u, way, candidate.place, tip);
        self.caps.spend(&self.rings, v, u, self.end(v, u, candidate));
        let end = candidate.place.map(|place| self.rings.at(v) + place);
        self.rings.collapse(v, u);
        self.loaded = None;
        end.map(|end| self.rings.renew(u, end))
    }

    /// Drops the slots that are gone, so that what is left stands close together; those that are kept, in their order.
    pub(super) fn compact(&mut self) -> Vec<u32> {
        let kept = self.rings.compact();
        self.loaded = None;
        self.method.compact(&kept);
        self.guard.restart(&self.rings);
        self.caps.compact(&kept);
        if !self.weights.is_empty() {
            self.weights = gather(&self.weights, &kept);
        }
        kept
    }
}
