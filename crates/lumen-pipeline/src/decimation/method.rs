//! What the two methods of decimation have in common: they judge a vertex, name where it may go, and take note of what
//! has gone. Order, topology, shape and crossings are the run's (`super`).

use glam::Vec3A;

use super::one_ring::OneRing;
use super::rings::Rings;

/// What the removal of a vertex costs, and where it may go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged {
    /// Distance by which the surface would suffer, in the unit of the rings.
    pub(super) distance: f32,
    /// What it is ordered by: grows with the distance.
    pub(super) priority: f32,
    /// The neighbours, by their place in the ring, that it may go to; `None` for all.
    pub(super) along: Option<[usize; 2]>,
    /// Whether it is feature edges that leave it no more.
    pub(super) is_held: bool,
}

impl Judged {
    /// Whether the vertex may go to the `j`-th neighbour.
    pub(super) fn allows(&self, j: usize) -> bool {
        self.along.is_none_or(|along| along.contains(&j))
    }
}

/// A way for a vertex to go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// Distance by which the surface would suffer, in the unit of the rings.
    pub(super) distance: f32,
    /// What it is ordered by, as [`Judged::priority`] is that of the best.
    pub(super) priority: f32,
    /// What it costs, without the triangles' shape; infinite once it has been tried.
    pub(super) cost: f32,
    /// The neighbour that takes over, by its place in the ring.
    pub(super) to: usize,
    /// Where that neighbour moves to, relative to the vertex; `None` if it stays.
    pub(super) place: Option<Vec3A>,
}

/// A method of decimation. Vertices are slots of the rings; the star is that of the vertex.
pub(super) trait Method {
    /// Makes room for so many slots.
    fn start(&mut self, slots: usize);

    /// Looks at a vertex for the first time, before any is judged. The triangles of the star are worked out.
    fn meet(&mut self, rings: &Rings, star: &OneRing, v: u32);

    /// Judges a vertex; if it `is_last`, nothing else has helped, and feature edges no longer count. On the `border` between
    /// labels it may go to those two neighbours alone. The triangles of the star are not worked out.
    fn judge(&mut self, rings: &Rings, star: &OneRing, v: u32, is_last: bool, border: Option<[usize; 2]>) -> Judged;

    /// Adds to `candidates` where the vertex, judged just now, may go.
    fn offer(&mut self, star: &OneRing, v: u32, judged: &Judged, candidates: &mut Vec<Candidate>);

    /// Quality below which no triangle should fall.
    fn fair_quality(&self) -> f32;

    /// What poor shape costs for a star, beside the cost of a candidate: times one less the quality of the worst
    /// triangle.
    fn shape_cost(&self, star: &OneRing, cost: f32) -> f32;

    /// Where a new vertex for `v` and `u`, which is at `way` from it, should be instead of at `place`, to lie in the plane
    /// `normal.x = offset`.
    fn level(&self, v: u32, u: u32, way: Vec3A, place: Vec3A, normal: Vec3A, offset: f32) -> Option<Vec3A>;

    /// The priority of a vertex of that distance.
    fn priority(&self, distance: f32) -> f32;

    /// What the priority counts for where the median of the radii is `ratio` times that of the vessel (`weights.rs`).
    fn weight(&self, ratio: f32) -> f32;

    /// `v` is about to go to `u`, which is at `way` from it and moves to `place`, if to anywhere; `tip` is the distance that
    /// its planes do not know of.
    fn merge(&mut self, v: u32, u: u32, way: Vec3A, place: Option<Vec3A>, tip: f32);

    /// Only the slots in `kept` are left, renumbered in this order.
    fn compact(&mut self, kept: &[u32]);
}

/// Distance from the origin to the segment between `a` and `b`.
pub(super) fn distance_to_segment(a: Vec3A, b: Vec3A) -> f32 {
    let way = b - a;
    let square = way.length_squared();
    let t = if square > 0.0 { (-a.dot(way) / square).clamp(0.0, 1.0) } else { 0.0 };
    (a + way * t).length()
}
