//! What a vertex is and how far it lies from the surface that would remain without it: the five classes of
//! Schroeder, Zarge and Lorensen (1992), section 3 (the paper's Figure 3).

use glam::DVec3;

use super::surface::{Ring, Surface};

/// The class of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A full ring of triangles, no feature edge: measured from the average plane of the ring.
    Simple,
    /// Not one disc or half-disc of triangles: stays.
    Complex,
    /// A half ring: measured from the line through its two neighbours on the boundary.
    Boundary,
    /// A full ring with two feature edges: measured from the line through their ends.
    InteriorEdge,
    /// One feature edge, or three and more, or a feature edge that meets the boundary: measured from the average
    /// plane, which lies far off where the corner is sharp.
    Corner,
}

/// The class of a vertex and the vertices it may collapse onto.
pub(super) struct Judged {
    pub(super) class: Class,
    /// Distance in mm from the plane or line that would take its place.
    pub(super) distance: f64,
    /// The two neighbours along the line, for boundary and interior-edge vertices.
    pub(super) along: Option<[u32; 2]>,
}

impl Judged {
    /// Judges `v`, whose ring is in order if `is_fan`; feature edges count only `with_features`.
    pub(super) fn new(surface: &Surface, v: u32, ring: &Ring, is_fan: bool, with_features: bool) -> Self {
        if !is_fan {
            return Self { class: Class::Complex, distance: f64::INFINITY, along: None };
        }
        let creases = if with_features { ring.neighbours().filter(|&(_, crease)| crease).count() } else { 0 };
        if !ring.closed {
            let along = ring.ends();
            let distance = distance_to_line(surface, v, along);
            let class = if creases == 0 { Class::Boundary } else { Class::Corner };
            return Self { class, distance, along: Some(along) };
        }
        if creases == 2 {
            let mut ends = ring.neighbours().filter(|&(_, crease)| crease).map(|(n, _)| n);
            if let (Some(a), Some(b)) = (ends.next(), ends.next()) {
                let distance = distance_to_line(surface, v, [a, b]);
                return Self { class: Class::InteriorEdge, distance, along: Some([a, b]) };
            }
        }
        let class = if creases == 0 { Class::Simple } else { Class::Corner };
        Self { class, distance: distance_to_average_plane(surface, v, ring), along: None }
    }
}

/// Distance of `v` from the average plane of its ring: normals and centres of the triangles, weighted by area.
fn distance_to_average_plane(surface: &Surface, v: u32, ring: &Ring) -> f64 {
    let p = surface.at(v);
    let (mut normal, mut centre, mut area) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for spoke in &ring.spokes {
        let (a, b) = (surface.at(spoke.a) - p, surface.at(spoke.b) - p);
        let n = a.cross(b);
        let weight = n.length();
        normal += n;
        centre += (a + b) * weight;
        area += weight;
    }
    let length = normal.length();
    if length == 0.0 || area == 0.0 {
        return 0.0;
    }
    (normal.dot(centre) / (3.0 * area * length)).abs()
}

/// Distance of `v` from the segment between two of its neighbours.
fn distance_to_line(surface: &Surface, v: u32, [a, b]: [u32; 2]) -> f64 {
    let (p, a, b) = (surface.at(v), surface.at(a), surface.at(b));
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * t - p).length()
}
