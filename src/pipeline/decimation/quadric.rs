//! The method of least error: Garland and Heckbert, "Surface simplification using quadric error metrics" (1997). An edge
//! becomes a new vertex where the sum of the squared distances from the planes of all triangles it stands for, each by
//! its area, is least.
//!
//! Where that leaves a direction free (on a plane, along a tube), the new vertex stays near the middle of its edge: the
//! middle counts as a faint point of attraction, so that the system is never singular. Boundary edges add a plane that
//! stands on the surface, as heavy as [`BOUNDARY`]; a vertex inside that meets the boundary goes where the boundary is.

use glam::{DVec3, Vec3A};

use super::method::{Candidate, Class, Judged, Method};
use super::rings::{CREASE, Rings, gather, neighbour};
use super::star::Star;

fn var(n: &str, d: f64) -> f64 {
    std::env::var(n).ok().and_then(|g| g.parse().ok()).unwrap_or(d)
}

/// Weight of the plane that stands on a boundary edge, beside that of a triangle of the same size.
const BOUNDARY: f64 = 10.0;
/// Pull of the middle of an edge, as a part of the mean stiffness of its planes.
const PULL: f64 = 1e-3;

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
        DVec3::new(
            xx * x.x + xy * x.y + xz * x.z,
            xy * x.x + yy * x.y + yz * x.z,
            xz * x.x + yz * x.y + zz * x.z,
        )
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

    /// Where it is least, drawn towards `anchor`; `None` where there are no planes.
    fn least(&self, anchor: DVec3, pull: f64) -> Option<DVec3> {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let pull = (xx + yy + zz) / 3.0 * pull;
        if pull.is_nan() || pull <= 0.0 {
            return None;
        }
        // Cholesky's factors; the pull keeps each root real.
        let rest = -(self.times(anchor) + self.b);
        let l11 = (xx + pull).sqrt();
        let (l21, l31) = (xy / l11, xz / l11);
        let l22 = (yy + pull - l21 * l21).sqrt();
        let l32 = (yz - l21 * l31) / l22;
        let l33 = (zz + pull - l31 * l31 - l32 * l32).sqrt();
        let y1 = rest.x / l11;
        let y2 = (rest.y - l21 * y1) / l22;
        let y3 = (rest.z - l31 * y1 - l32 * y2) / l33;
        let z = y3 / l33;
        let y = (y2 - l32 * z) / l22;
        let x = (y1 - l21 * y - l31 * z) / l11;
        let found = anchor + DVec3::new(x, y, z);
        found.is_finite().then_some(found)
    }
}

/// The method's state: for each slot its form.
pub(super) struct Quadric {
    forms: Vec<Form>,
    /// Of the vertex judged last.
    candidates: Vec<Candidate>,
    pull: f64,
    shape: f32,
    mode: f64,
}
impl Default for Quadric {
    fn default() -> Self {
        Self { forms: Vec::new(), candidates: Vec::new(), pull: var("P", PULL), shape: var("QS", 0.5) as f32, mode: var("QM", 0.0) }
    }
}

impl Method for Quadric {
    fn start(&mut self, slots: usize) {
        self.forms = vec![Form::default(); slots];
    }

    fn meet(&mut self, rings: &Rings, star: &Star, v: u32) {
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
        self.forms[v as usize] = form;
    }

    fn judge(&mut self, rings: &Rings, star: &Star, v: u32, with_features: bool) -> Judged {
        let entries = star.entries();
        let is_open = rings.is_open(v);
        let along = is_open.then(|| [0, entries.len() - 1]);
        let creases = entries.iter().filter(|&&entry| with_features && entry & CREASE != 0).count();
        let class = match creases {
            0 if is_open => Class::Boundary,
            0 => Class::Simple,
            2 if !is_open => Class::InteriorEdge,
            _ => Class::Corner,
        };
        let own = &self.forms[v as usize];
        self.candidates.clear();
        let mut judged = Judged { class, distance: f32::INFINITY, priority: f32::INFINITY, along };
        for (to, &entry) in entries.iter().enumerate() {
            if !judged.allows(to) {
                continue;
            }
            let u = neighbour(entry);
            let way = star.edge(to).as_dvec3();
            let form = own.plus(&self.forms[u as usize].seen_from(-way));
            let stays = rings.stays(u) || rings.is_open(u) && !is_open;
            let place = if stays { None } else { form.least(way * 0.5, self.pull) };
            let cost = form.at(place.unwrap_or(way));
            self.candidates.push(Candidate { cost: cost as f32, to, place: place.map(|p| p.as_vec3a()) });
            let priority = cost.sqrt() as f32;
            if priority < judged.priority {
                judged.priority = priority;
                judged.distance = if form.area > 0.0 { (cost / form.area).sqrt() as f32 } else { 0.0 };
            }
        }
        judged
    }

    fn offer(&mut self, _: &Star, _: u32, _: &Judged, candidates: &mut Vec<Candidate>) {
        candidates.extend_from_slice(&self.candidates);
    }

    fn shape_cost(&self, star: &Star, cost: f32) -> f32 {
        if self.mode == 0.0 { self.shape * cost } else { self.shape * cost + 1e-4 * self.mode as f32 * star.area() * star.area() }
    }

    fn merge(&mut self, v: u32, u: u32, way: Vec3A, place: Option<Vec3A>) {
        let end = place.unwrap_or(way).as_dvec3();
        let (v, u) = (self.forms[v as usize], &mut self.forms[u as usize]);
        *u = u.seen_from(end - way.as_dvec3()).plus(&v.seen_from(end));
    }

    fn compact(&mut self, kept: &[u32]) {
        self.forms = gather(&self.forms, kept);
    }
}
