//! Where a rod touches itself.
//!
//! ```text
//! rod --candidates--> edges that may touch --detect--> pairs and their gaps --pair--> forces --link--> search direction
//! ```
//!
//! Each node touches a far piece of the rod where that is nearest, and two edges touch where they cross nearer than the
//! ends of both. The gap is the distance of the middle lines less the diameter. There is no friction between the two, and
//! the guide is no body that could be touched.

mod candidates;
mod link;
mod pair;
#[cfg(test)]
mod tests;

use candidates::Candidates;
pub(crate) use link::Link;
pub use pair::Pair;
use pair::Place;

use glam::DVec3;

use crate::rod::Rod;

/// A gap of less than this, in mm, is looked after in the step from its beginning; in a thin wire this part of its diameter.
const REACH: (f64, f64) = (0.1, 0.25);
/// The part of the radius by which the insides of two edges must be nearer than their ends to be a pair of their own.
const DEEPER: f64 = 0.01;
/// A pair is the one of the step before if it has gone along the rod by no more than so many edges and mm.
const SAME: (f64, f64) = (0.6, 0.2);
/// The square of the sine between two edges below which they do not cross.
const PARALLEL: f64 = 1e-6;

/// The pairs of a rod.
#[derive(Clone, Debug, Default)]
pub(super) struct SelfContacts {
    candidates: Candidates,
    pub(super) pairs: Vec<Pair>,
    /// Those of the detection before.
    before: Vec<Pair>,
    /// The gap of each node and the edges beside it at least, in mm, where any are candidates; and that of others.
    rooms: Vec<f64>,
    room: f64,
    /// Whether nothing was measured yet in this step.
    is_new: bool,
}

impl SelfContacts {
    /// None yet.
    pub(super) fn new() -> Self {
        Self { room: f64::INFINITY, is_new: true, ..Self::default() }
    }

    /// Begins a step.
    pub(super) fn begin(&mut self) {
        self.is_new = true;
        self.pairs.iter_mut().for_each(Pair::begin);
    }

    /// Lets go of the pairs of all but the first `count` nodes and the edge behind them.
    pub(super) fn keep(&mut self, count: usize) {
        self.pairs.retain(|pair| pair.places.iter().all(|place| place.edge < count));
    }

    /// How far a node and the edges beside it are from other pieces of the rod at least, in mm.
    pub(super) fn room(&self, node: usize) -> f64 {
        self.rooms.get(node).copied().unwrap_or(self.room)
    }

    /// Measures the gaps of the first `count` nodes and the edges behind them. Returns how far the rod, of this radius in
    /// mm, reaches into itself, in mm; less than 0 where it does not.
    pub(super) fn detect(&mut self, rod: &Rod, count: usize, radius: f64) -> f64 {
        let diameter = 2.0 * radius;
        let reach = diameter + REACH.0.min(REACH.1 * diameter);
        // The edge at the guide's mouth is half outside.
        let count = if count == 0 { 0 } else { (count + 1).min(rod.len()) };
        self.room = self.candidates.update(rod, count, reach, diameter, self.is_new) + reach - diameter;
        self.is_new = false;
        self.rooms.clear();
        if self.candidates.edges.is_empty() {
            self.pairs.clear();
            return f64::NEG_INFINITY;
        }
        self.rooms.resize(count, self.room);
        std::mem::swap(&mut self.pairs, &mut self.before);
        self.pairs.clear();
        self.find_at_nodes(rod, count, reach, diameter);
        self.find_at_edges(rod, reach, diameter);
        self.hand_over(rod, diameter);
        self.pairs.iter().map(|pair| -pair.gap).fold(f64::NEG_INFINITY, f64::max)
    }

    fn find_at_nodes(&mut self, rod: &Rod, count: usize, reach: f64, diameter: f64) {
        let nodes = &self.candidates.nodes;
        let mut before = ([usize::MAX; 2], 0.0);
        for &[node, edge] in nodes {
            let (p, a, b) = (rod.positions[node], rod.positions[edge], rod.positions[edge + 1]);
            let along = ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
            let way = p - a.lerp(b, along);
            let gap = way.length() - diameter;
            for room in [node, edge, edge + 1] {
                self.rooms[room] = self.rooms[room].min(gap);
            }
            let is_behind = |along: f64| before == ([node, edge.wrapping_sub(1)], along);
            // Where an end is nearest it must be nearest from both sides. What is nearest where the candidates end is
            // brought near by curvature.
            let is_nearest = if along <= 0.0 { edge == 0 || is_behind(1.0) } else { along < 1.0 };
            before = ([node, edge], along);
            if gap < reach - diameter && is_nearest {
                let own = if node + 1 < count {
                    Place { edge: node, along: 0.0 }
                } else {
                    Place { edge: node - 1, along: 1.0 }
                };
                self.pairs.push(Pair::new(rod, [own, Place { edge, along }], way.normalize_or_zero(), gap));
            }
        }
    }

    fn find_at_edges(&mut self, rod: &Rod, reach: f64, diameter: f64) {
        for &[i, j] in &self.candidates.edges {
            let ends = [i, j].map(|edge| [rod.positions[edge], rod.positions[edge + 1]]);
            let Some([s, t]) = crossing(ends) else { continue };
            let places = [Place { edge: i, along: s }, Place { edge: j, along: t }];
            let way = places[0].at(rod) - places[1].at(rod);
            let distance = way.length();
            for room in [i, i + 1, j, j + 1] {
                self.rooms[room] = self.rooms[room].min(distance - diameter);
            }
            if distance >= reach {
                continue;
            }
            let [[a, b], [c, d]] = ends;
            let of_ends = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])].map(|(p, edge)| from_edge(p, edge));
            let least = of_ends.into_iter().fold(f64::INFINITY, f64::min);
            if distance < least - DEEPER * 0.5 * diameter {
                self.pairs.push(Pair::new(rod, places, way.normalize_or_zero(), distance - diameter));
            }
        }
    }

    /// Gives each pair the force of the one before that it goes on from: at the same node first, else the nearest.
    fn hand_over(&mut self, rod: &Rod, diameter: f64) {
        for is_at_node in [true, false] {
            for pair in &mut self.pairs {
                if pair.is_known {
                    continue;
                }
                let off = |other: &Pair| -> Option<f64> {
                    let [a, b] = [0, 1].map(|side| {
                        let (here, there) = (pair.places[side], other.places[side]);
                        let off = (here.number() - there.number()).abs();
                        (off, SAME.0 + SAME.1 / rod.sections[here.edge].length)
                    });
                    (a.0 <= a.1 && b.0 <= b.1 && (!is_at_node || a.0 == 0.0)).then_some(a.0 + b.0)
                };
                let found = self
                    .before
                    .iter()
                    .enumerate()
                    .filter_map(|(k, other)| Some((off(other)?, k)))
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                let Some((_, k)) = found else { continue };
                let other = self.before.remove(k);
                pair.goes_on_from(&other);
                if pair.normal.dot(other.normal) < 0.0 {
                    // They have gone through each other.
                    pair.normal = -pair.normal;
                    pair.gap = -pair.gap - 2.0 * diameter;
                }
            }
        }
        self.before.clear();
    }
}

/// How far a point is from an edge.
fn from_edge(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
    p.distance(a.lerp(b, along))
}

/// Where the insides of two edges are nearest to each other, if they are not parallel.
fn crossing([[a, b], [c, d]]: [[DVec3; 2]; 2]) -> Option<[f64; 2]> {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let determinant = uu * vv - uv * uv;
    if determinant <= PARALLEL * uu * vv {
        return None;
    }
    let along = [(uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant];
    along.iter().all(|along| *along > 0.0 && *along < 1.0).then_some(along)
}
