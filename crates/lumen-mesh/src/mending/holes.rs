//! The openings of a surface: where a vessel ends, where its wall has a hole, and where a sheet has its edge.
//!
//! What tells them apart is how the surface meets the rim. In each triangle on it, take the direction in the triangle that
//! leads straight out over the rim. Where a vessel ends, these stand across the plane of the rim; around a hole in a wall
//! they lie in that plane and point to its middle; at the outer edge of a sheet they point away from it.

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use crate::{EdgeUse, Topology, TriMesh, boundary_loops};

/// A rim is that of a vessel where the directions out of the surface stand by more than this across its plane, in the
/// mean: the sine of 30 degrees.
const ACROSS: f64 = 0.5;
/// A vessel has more sides than a triangle.
const FEWEST_SIDES: usize = 4;
/// A rim is planar where no vertex is farther than this part of its diameter from its plane.
const PLANAR: f64 = 0.05;
/// Vertices that the diameter is measured by, at most.
const MEASURED: usize = 512;

/// What an opening is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Opening {
    /// A hole in a wall.
    Hole,
    /// The open end of a vessel.
    VesselEnd,
    /// The outer edge of a sheet.
    Edge,
}

/// An opening of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// Its vertices, in the direction in which the triangles on it run.
    pub rim: Vec<u32>,
    /// What it is.
    pub opening: Opening,
    /// The length of the rim in mm.
    pub length_mm: f64,
    /// The largest distance between two vertices of the rim in mm.
    pub diameter_mm: f64,
    /// Whether the rim lies in a plane, by a twentieth of its diameter.
    pub is_planar: bool,
    /// The mean of the rim's vertices in mm.
    pub centre: Vec3,
}

/// The openings of `mesh`, in the order of [`boundary_loops`]. A chain of fewer than three edges, as where windings
/// disagree, is none.
pub fn holes(mesh: &TriMesh, topology: &Topology) -> Vec<Hole> {
    let loops = boundary_loops(topology).into_iter();
    loops.filter(|rim| is_closed(topology, rim)).map(|rim| hole(mesh, topology, rim)).collect()
}

/// Whether every edge around `rim` is an open one, and no vertex comes twice.
fn is_closed(topology: &Topology, rim: &[u32]) -> bool {
    let mut sorted = rim.to_vec();
    sorted.sort_unstable();
    rim.len() >= 3
        && sorted.windows(2).all(|pair| pair[0] != pair[1])
        && edges(rim).all(|(a, b)| topology.edge(a, b).is_some_and(EdgeUse::is_boundary))
}

/// The edges of a loop.
pub(super) fn edges(rim: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    rim.iter().copied().zip(rim.iter().copied().cycle().skip(1))
}

/// The third corner of the triangle on an open edge.
pub(super) fn behind(mesh: &TriMesh, topology: &Topology, a: u32, b: u32) -> Option<(u32, u32)> {
    let t = topology.triangles_on(&mesh.triangles, a, b).next()?;
    let third = mesh.triangles[t as usize].into_iter().find(|&v| v != a && v != b)?;
    Some((t, third))
}

fn hole(mesh: &TriMesh, topology: &Topology, rim: Vec<u32>) -> Hole {
    let origin = mesh.positions[rim[0] as usize].as_dvec3();
    let at = |v: u32| mesh.positions[v as usize].as_dvec3() - origin;
    let middle = rim.iter().map(|&v| at(v)).sum::<DVec3>() / rim.len() as f64;
    // The vector area of the loop (Newell): its plane, whatever its shape.
    let area: DVec3 = edges(&rim).map(|(a, b)| (at(a) - middle).cross(at(b) - middle)).sum();
    let normal = area.normalize_or_zero();
    let length_mm: f64 = edges(&rim).map(|(a, b)| at(a).distance(at(b))).sum();
    let (mut out, mut inwards) = (DVec3::ZERO, 0.0);
    for (a, b) in edges(&rim) {
        let Some((_, third)) = behind(mesh, topology, a, b) else { continue };
        let along = at(b) - at(a);
        // Straight out over the edge, as long as the edge.
        let across = (at(a) - at(third)).reject_from(along).normalize_or_zero() * along.length();
        if across.is_finite() {
            out += across;
            inwards += across.dot((middle - at(a).midpoint(at(b))).normalize_or_zero());
        }
    }
    let diameter_mm = diameter(&rim, at);
    let farthest = rim.iter().map(|&v| (at(v) - middle).dot(normal).abs()).fold(0.0, f64::max);
    let opening = if rim.len() >= FEWEST_SIDES && out.dot(normal).abs() > ACROSS * length_mm {
        Opening::VesselEnd
    } else if inwards < 0.0 {
        Opening::Edge
    } else {
        Opening::Hole
    };
    Hole {
        opening,
        length_mm,
        diameter_mm,
        is_planar: farthest <= PLANAR * diameter_mm,
        centre: (middle + origin).as_vec3(),
        rim,
    }
}

/// The largest distance between two of the vertices; of very many, between every so manyth.
fn diameter(rim: &[u32], at: impl Fn(u32) -> DVec3) -> f64 {
    let step = rim.len().div_ceil(MEASURED);
    let points: Vec<DVec3> = rim.iter().step_by(step).map(|&v| at(v)).collect();
    let pairs = points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(move |q| p.distance_squared(*q)));
    pairs.fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::shapes::{icosphere, square, tube};

    /// `mesh` without the triangles whose middle is within `radius` of one of the places.
    pub(in crate::mending) fn pierced(mesh: &TriMesh, places: &[Vec3], radius: f32) -> TriMesh {
        mesh.filtered(|t| {
            let middle = mesh.corners(t).iter().sum::<Vec3>() / 3.0;
            places.iter().all(|place| place.distance(middle) > radius)
        })
    }

    pub(in crate::mending) fn found(mesh: &TriMesh) -> Vec<Hole> {
        holes(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
    }

    #[test]
    fn a_tube_has_two_ends_and_as_many_holes_as_were_made_at_any_scale() {
        for scale in [0.1, 1.0, 1000.0] {
            let tube = tube(48, 120, 60.0 * scale, |_| 4.0 * scale);
            let places = [15.0, 30.0, 45.0].map(|z| Vec3::new(4.0, 0.0, z) * scale);
            let found = found(&pierced(&tube, &places, 1.5 * scale));
            let of = |opening| found.iter().filter(|hole| hole.opening == opening).collect::<Vec<_>>();
            let (ends, holes) = (of(Opening::VesselEnd), of(Opening::Hole));
            assert_eq!((ends.len(), holes.len(), found.len()), (2, 3, 5));
            for end in ends {
                assert!((end.diameter_mm / f64::from(8.0 * scale) - 1.0).abs() < 1e-5 && end.is_planar);
                let circumference = 48.0 * f64::from(8.0 * scale) * libm::sin(std::f64::consts::PI / 48.0);
                assert!((end.length_mm / circumference - 1.0).abs() < 1e-5);
            }
            for (hole, place) in holes.iter().zip(places) {
                assert!(hole.centre.distance(place) < 0.3 * scale, "{hole:?}");
                assert!((2.4..4.4).contains(&(hole.diameter_mm / f64::from(scale))), "{}", hole.diameter_mm);
            }
        }
    }

    #[test]
    fn a_missing_triangle_is_a_hole_and_a_sheet_has_an_edge() {
        let sphere = icosphere(3, 10.0, Vec3::ONE);
        let [hole] = &found(&sphere.filtered(|t| t != 100))[..] else { panic!("there is one hole") };
        assert_eq!((hole.rim.len(), hole.opening, hole.is_planar), (3, Opening::Hole, true));
        let [edge] = &found(&square(8, 10.0, 0.0))[..] else { panic!("there is one edge") };
        assert_eq!((edge.rim.len(), edge.opening), (32, Opening::Edge));
        assert!((edge.diameter_mm - 200f64.sqrt()).abs() < 1e-5 && (edge.length_mm - 40.0).abs() < 1e-5);
        // Half a sphere ends as a vessel does.
        let half = sphere.filtered(|t| sphere.corners(t).iter().all(|p| p.z > 1.0));
        assert_eq!(found(&half)[0].opening, Opening::VesselEnd);
    }
}
