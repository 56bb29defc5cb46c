//! The method of least error: Garland and Heckbert, "Surface simplification using quadric error metrics" (1997). An edge
//! becomes a new vertex where the sum of the squared distances from the planes of all triangles it stands for, each by
//! its area, is least.
//!
//! From there it moves on, the way that adds least to that sum, until the surface encloses as much as before (the
//! volume constraint of Lindstrom and Turk, "Fast and memory efficient polygonal simplification", 1998): planes that
//! touch a round vessel lie outside of it, triangles between points of it inside. That takes a tenth off the mean error,
//! and nearly all of the change of volume.
//!
//! Where the planes leave a direction free (on a plane, along a tube), the new vertex stays near the middle of its edge,
//! which counts as a faint point of attraction, so that the system is never singular. Planes that are nearly parallel
//! meet anywhere: where that would be farther from the edge than the edge is long, the vertex goes to the best place on
//! the edge, as in VTK's `vtkQuadricDecimation` where the matrix is ill-conditioned. Boundary edges add a plane that
//! stands on the surface; a vertex inside that meets the boundary goes where the boundary is; so do borders between labels. Feature edges need no rule:
//! the planes on both sides hold them. Where a vertex can go in no better way, it may go to where a neighbour is.

use glam::{DVec3, Vec3A};

use super::method::{Candidate, Judged, Method, distance_to_segment};
use super::one_ring::OneRing;
use super::rings::{Rings, SIZE, gather, neighbour};

/// Weight of the plane that stands on a boundary edge, beside that of a triangle of the same size.
const BOUNDARY: f64 = 10.0;
/// Pull of the middle of an edge, as a part of the mean stiffness of its planes.
const PULL: f64 = 1e-6;
/// What a triangle without area adds to the cost of a candidate, as a part of it.
const SHAPE_COST: f32 = 0.2;
/// Most of its edge's length that a new vertex moves to keep the volume.
const MAX_LEVELLED: f64 = 0.5;
/// How far a new vertex may lie from the edge in whose place it comes, in lengths of that edge, before it moves to keep
/// the volume.
const REACH: f64 = 1.0;

/// `x.Ax + 2 b.x + c` with `x` relative to a vertex: squared distances from planes, by area.
#[derive(Clone, Copy, Default)]
struct Form {
    /// xx, xy, xz, yy, yz, zz.
    a: [f64; 6],
    b: DVec3,
    c: f64,
    area: f64,
}

impl Form {
    fn add_plane(&mut self, normal: DVec3, weight: f64) {
        let n = normal.normalize_or_zero();
        let products = [n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z];
        self.a.iter_mut().zip(products).for_each(|(sum, part)| *sum += part * weight);
    }

    fn times(&self, x: DVec3) -> DVec3 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        DVec3::new(xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z, xz * x.x + yz * x.y + zz * x.z)
    }

    fn at(&self, x: DVec3) -> f64 {
        (x.dot(self.times(x) + 2.0 * self.b) + self.c).max(0.0)
    }

    /// The same form seen from `way` off.
    fn seen_from(&self, way: DVec3) -> Self {
        Self { b: self.times(way) + self.b, c: self.at(way), ..*self }
    }

    fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        sum.a.iter_mut().zip(other.a).for_each(|(sum, part)| *sum += part);
        sum.b += other.b;
        sum.c += other.c;
        sum.area += other.area;
        sum
    }

    /// Where it is least, drawn towards `anchor`; no numbers where there are no planes.
    fn least(&self, anchor: DVec3) -> DVec3 {
        anchor - self.solve(self.times(anchor) + self.b)
    }

    /// Where it is least on the edge from here to `way`, drawn towards its middle.
    fn least_on(&self, way: DVec3) -> DVec3 {
        let stiffness = way.dot(self.times(way));
        let pull = (self.a[0] + self.a[3] + self.a[5]) / 3.0 * PULL * way.length_squared();
        let part = (0.5 * pull - way.dot(self.b)) / (stiffness + pull);
        way * if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.5 }
    }

    /// `x` with `A x = right`, with [`PULL`] added to A's diagonal; no numbers where A is zero.
    fn solve(&self, right: DVec3) -> DVec3 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let pull = (xx + yy + zz) / 3.0 * PULL;
        // Cholesky's factors; the pull keeps each root real.
        let l11 = (xx + pull).sqrt();
        let (l21, l31) = (xy / l11, xz / l11);
        let l22 = (yy + pull - l21 * l21).sqrt();
        let l32 = (yz - l21 * l31) / l22;
        let l33 = (zz + pull - l31 * l31 - l32 * l32).sqrt();
        let y1 = right.x / l11;
        let y2 = (right.y - l21 * y1) / l22;
        let y3 = (right.z - l31 * y1 - l32 * y2) / l33;
        let z = y3 / l33;
        let y = (y2 - l32 * z) / l22;
        DVec3::new((y1 - l21 * y - l31 * z) / l11, y, z)
    }
}

/// Whether a place is within [`REACH`] of the edge from the origin to `way`.
fn is_near(place: DVec3, way: DVec3) -> bool {
    let square = way.length_squared();
    let part = if square > 0.0 { (place.dot(way) / square).clamp(0.0, 1.0) } else { 0.0 };
    (place - way * part).length_squared() <= REACH * REACH * square
}

/// Edges of a star that are worked on at once.
const BATCH: usize = 16;

/// What is known of some edges of a star, each number side by side for all of them, so that the processor takes two or more
/// edges at once.
#[derive(Default)]
struct Edges {
    count: usize,
    /// Along each.
    ways: [[f64; BATCH]; 3],
    /// The form at its end, then the sum of both ends' as seen from the vertex.
    a: [[f64; BATCH]; 6],
    b: [[f64; BATCH]; 3],
    c: [f64; BATCH],
    area: [f64; BATCH],
    /// Where that is least; then where the new vertex would be, and the form there.
    places: [[f64; BATCH]; 3],
    costs: [f64; BATCH],
}

impl Edges {
    fn push(&mut self, way: DVec3, form: &Form) {
        let i = self.count;
        self.count += 1;
        put(&mut self.ways, i, way);
        self.a.iter_mut().zip(form.a).for_each(|(all, a)| all[i] = a);
        put(&mut self.b, i, form.b);
        (self.c[i], self.area[i]) = (form.c, form.area);
    }

    fn form(&self, i: usize) -> Form {
        Form { a: [0, 1, 2, 3, 4, 5].map(|k| self.a[k][i]), b: get(&self.b, i), c: self.c[i], area: self.area[i] }
    }

    /// Adds the form of the vertex to each, and finds where the sum is least, drawn towards the middle of the edge.
    fn sum(&mut self, own: &Form) {
        for i in 0..self.count.min(BATCH) {
            let way = get(&self.ways, i);
            let form = own.plus(&self.form(i).seen_from(-way));
            self.a.iter_mut().zip(form.a).for_each(|(all, a)| all[i] = a);
            put(&mut self.b, i, form.b);
            (self.c[i], self.area[i]) = (form.c, form.area);
            put(&mut self.places, i, form.least(way * 0.5));
        }
    }

    /// Where a new vertex should be that takes the place of edge `i`: where the form is least, if that is near the edge, else
    /// where it is least on the edge. `None` where there are no planes.
    fn place(&self, i: usize) -> Option<DVec3> {
        let (found, way) = (get(&self.places, i), get(&self.ways, i));
        let place = || if is_near(found, way) { found } else { self.form(i).least_on(way) };
        found.is_finite().then(place)
    }

    /// Works out the forms at the places.
    fn weigh(&mut self) {
        for i in 0..self.count.min(BATCH) {
            self.costs[i] = self.form(i).at(get(&self.places, i));
        }
    }
}

fn get(all: &[[f64; BATCH]; 3], i: usize) -> DVec3 {
    DVec3::new(all[0][i], all[1][i], all[2][i])
}

fn put(all: &mut [[f64; BATCH]; 3], i: usize, v: DVec3) {
    (all[0][i], all[1][i], all[2][i]) = (v.x, v.y, v.z);
}

/// The method's state.
#[derive(Default)]
pub(super) struct Quadric {
    /// Of each slot.
    forms: Vec<Form>,
    /// The area of all, doubled, and how many vertices share it.
    area: f64,
    vertices: f64,
    /// Of the vertex judged last.
    candidates: Vec<Candidate>,
    edges: Edges,
}

impl Quadric {
    /// The area that a vertex stands for, on average.
    fn mean_area(&self) -> f64 {
        self.area / self.vertices.max(1.0)
    }
}

impl Method for Quadric {
    fn start(&mut self, slots: usize) {
        self.forms = vec![Form::default(); slots];
    }

    fn meet(&mut self, rings: &Rings, star: &OneRing, v: u32) {
        let mut form = Form::default();
        for i in 0..star.triangles() {
            let normal = star.normal(i).as_dvec3();
            let area = normal.length();
            form.add_plane(normal, area);
            form.area += area;
        }
        if rings.is_open(v) && star.triangles() > 0 {
            let last = star.triangles() - 1;
            for (edge, triangle) in [(0, 0), (last + 1, last)] {
                let (edge, normal) = (star.edge(edge).as_dvec3(), star.normal(triangle).as_dvec3());
                form.add_plane(edge.cross(normal), BOUNDARY * edge.length_squared());
            }
        }
        for (edge, normal) in star.borders() {
            let edge = edge.as_dvec3();
            form.add_plane(edge.cross(normal.as_dvec3()), BOUNDARY * edge.length_squared());
        }
        // A star that reaches farther than the surface is large has a stray in it, and the area of many others.
        if star.reach().iter().all(|corner| corner.abs().max_element() <= 2.0 * SIZE) {
            self.area += form.area;
            self.vertices += 1.0;
        }
        self.forms[v as usize] = form;
    }

    fn judge(&mut self, rings: &Rings, star: &OneRing, v: u32, is_last: bool, border: Option<[usize; 2]>) -> Judged {
        let entries = star.entries();
        let is_open = rings.is_open(v);
        let along = is_open.then(|| [0, entries.len() - 1]).or(border);
        // What the planes do not know: how far the border is from the line that takes its place.
        let off = border.map(|[a, b]| distance_to_segment(star.edge(a), star.edge(b)));
        let least = off.map_or(0.0, |off| self.priority(off));
        let Self { forms, candidates, edges, .. } = self;
        candidates.clear();
        let mut judged = Judged { distance: f32::INFINITY, priority: f32::INFINITY, along, is_held: false };
        let unjudged = judged;
        let mut allowed = (0..entries.len()).filter(|&to| unjudged.allows(to)).peekable();
        while allowed.peek().is_some() {
            edges.count = 0;
            let mut tos = [0; BATCH];
            for to in allowed.by_ref().take(BATCH) {
                tos[edges.count] = to;
                edges.push(star.edge(to).as_dvec3(), &forms[neighbour(entries[to]) as usize]);
            }
            edges.sum(&forms[v as usize]);
            let mut moves = [false; BATCH];
            for i in 0..edges.count {
                let u = neighbour(entries[tos[i]]);
                let stays = rings.stays(u) || rings.is_open(u) && !is_open || rings.is_on_border(u);
                let place = if stays { None } else { edges.place(i) };
                moves[i] = place.is_some();
                put(&mut edges.places, i, place.unwrap_or(get(&edges.ways, i)));
            }
            edges.weigh();
            for i in 0..edges.count {
                let candidate = |cost: f64, place: Option<DVec3>| {
                    let area = edges.area[i];
                    let distance = if area > 0.0 { (cost / area).sqrt() as f32 } else { 0.0 };
                    let distance = off.map_or(distance, |off| distance.max(off));
                    let priority = least.max(cost.sqrt() as f32);
                    let place = place.map(DVec3::as_vec3a);
                    Candidate { distance, priority, cost: cost as f32, to: tos[i], place }
                };
                let best = candidate(edges.costs[i], moves[i].then(|| get(&edges.places, i)));
                candidates.push(best);
                if is_last && moves[i] {
                    candidates.push(candidate(edges.form(i).at(get(&edges.ways, i)), None));
                }
                if best.priority < judged.priority {
                    (judged.priority, judged.distance) = (best.priority, best.distance);
                }
            }
        }
        judged
    }

    fn offer(&mut self, _: &OneRing, _: u32, _: &Judged, candidates: &mut Vec<Candidate>) {
        candidates.extend_from_slice(&self.candidates);
    }

    fn fair_quality(&self) -> f32 {
        0.25
    }

    fn shape_cost(&self, _: &OneRing, cost: f32) -> f32 {
        SHAPE_COST * cost
    }

    fn level(&self, v: u32, u: u32, way: Vec3A, place: Vec3A, normal: Vec3A, offset: f32) -> Option<Vec3A> {
        let (way, place, normal) = (way.as_dvec3(), place.as_dvec3(), normal.as_dvec3());
        let form = self.forms[v as usize].plus(&self.forms[u as usize].seen_from(-way));
        let direction = form.solve(normal);
        let step = (f64::from(offset) - normal.dot(place)) / normal.dot(direction);
        let found = place + direction * step;
        let is_near = (found - place).length() < MAX_LEVELLED * way.length();
        is_near.then_some(found.as_vec3a())
    }

    fn priority(&self, distance: f32) -> f32 {
        distance * self.mean_area().sqrt() as f32
    }

    /// The priority is a length times the root of an area: a root of the ratio for each.
    fn weight(&self, ratio: f32) -> f32 {
        ratio
    }

    fn merge(&mut self, v: u32, u: u32, way: Vec3A, place: Option<Vec3A>, tip: f32) {
        let end = place.unwrap_or(way).as_dvec3();
        let mut v = self.forms[v as usize];
        let reach = end.length_squared();
        if tip > 0.0 && reach > 0.0 {
            // The tip counts as a point that the surface should come near to.
            let weight = self.mean_area() * f64::from(tip * tip) / reach;
            for i in [0, 3, 5] {
                v.a[i] += weight;
            }
        }
        self.vertices -= 1.0;
        let u = &mut self.forms[u as usize];
        *u = u.seen_from(end - way.as_dvec3()).plus(&v.seen_from(end));
    }

    fn compact(&mut self, kept: &[u32]) {
        self.forms = gather(&self.forms, kept);
    }
}
