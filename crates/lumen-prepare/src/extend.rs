//! Flow extensions: a straight tube at an open end, whose section goes over from the vessel's outline to a circle.
//!
//! Each vertex of the rim is led to its place on the circle by a cubic Hermite curve over one radius of length: it leaves
//! along the wall's own direction there and arrives along the axis. The curves are parametrised by the height over the
//! end's plane, so that every ring lies in a plane square to the axis. The circle's polygon has the area of the rim's
//! polygon: its radius is that of a circle of this area, made up for what a polygon lacks of a circle. Rings follow each
//! other at the mean length of the rim's edges, and have as many vertices as the rim.
//!
//! The method is that of vmtkflowextensions (Antiga et al., "An image-based modeling framework for patient-specific
//! computational hemodynamics", 2008), with Hermite curves in place of its thin plate. An extension that would run into
//! the surface, into another or into itself is refused with the length that is free.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use glam::DVec3;
use lumen_mesh::{Topology, TriMesh, self_intersections};
use thiserror::Error;

use crate::ends::{Length, OpenEnd, RimError, SurfaceError, check_surface, edges};

/// The length over which the section becomes a circle, in radii.
const TRANSITION: f64 = 1.0;
/// A wall that leaves its end's plane at less than 45 degrees is led away at 45 degrees.
const STEEPEST: f64 = 1.0;
/// Rounds in which the directions of the wall are smoothed around the rim.
const SMOOTHINGS: usize = 2;
/// The most rings of one extension.
const MOST_RINGS: f64 = 10_000.0;

/// Why a surface cannot be extended.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ExtendError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// An end is none of this surface.
    #[error(transparent)]
    Rim(#[from] RimError),
    /// There is nothing to extend.
    #[error("there is no open end to extend")]
    NoEnds,
    /// There is not one length for each end.
    #[error("{lengths} lengths are given for {ends} ends")]
    Lengths {
        /// How many ends there are.
        ends: usize,
        /// How many lengths there are.
        lengths: usize,
    },
    /// A length is 0, negative or no number.
    #[error("the length of the extension of {name} is not a positive number")]
    Length {
        /// The end.
        name: String,
    },
    /// Too long for its edges.
    #[error("an extension of {name} by {length_mm:.0} mm needs more than {MOST_RINGS:.0} rings of {edge_mm:.4} mm")]
    TooLong {
        /// The end.
        name: String,
        /// The length asked for, in mm.
        length_mm: f64,
        /// The mean length of the rim's edges, in mm.
        edge_mm: f64,
    },
    /// The rim does not go around its middle once.
    #[error("the outline of {name} does not go around its middle once, so that it cannot become a circle")]
    Folded {
        /// The end.
        name: String,
    },
    /// Extensions run into something.
    #[error("extensions run into the surface, into each other or into themselves: {}", list(free))]
    Collides {
        /// The ends, and the length in mm up to which each is free.
        free: Vec<(String, f64)>,
    },
}

fn list(free: &[(String, f64)]) -> String {
    let texts: Vec<String> = free.iter().map(|(name, mm)| format!("{name} is free for {mm:.2} mm")).collect();
    texts.join(", ")
}

/// A surface with extensions.
#[derive(Clone, Debug, PartialEq)]
pub struct Extended {
    /// The surface: its first vertices and triangles are those of before.
    pub mesh: TriMesh,
    /// The ends, now at the far ends of the extensions, in the same order and with the same names.
    pub ends: Vec<OpenEnd>,
    /// The triangles of each extension.
    pub triangles: Vec<Range<u32>>,
}

/// Extends `mesh` at each of `ends` by the length at the same place in `lengths`; radii are those of circles of the ends'
/// areas.
///
/// # Errors
/// [`ExtendError`]. Nothing is extended where one extension cannot be.
pub fn extend(mesh: &TriMesh, ends: &[OpenEnd], lengths: &[Length]) -> Result<Extended, ExtendError> {
    check_surface(mesh)?;
    if ends.is_empty() {
        return Err(ExtendError::NoEnds);
    }
    if ends.len() != lengths.len() {
        return Err(ExtendError::Lengths { ends: ends.len(), lengths: lengths.len() });
    }
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let mut extended = Extended { mesh: mesh.clone(), ends: Vec::new(), triangles: Vec::new() };
    let mut spacings = Vec::new();
    for (end, length) in ends.iter().zip(lengths) {
        let end = end.measured(mesh, &topology)?;
        let tube = Tube::new(mesh, &topology, &end, *length)?;
        spacings.push(tube.spacing());
        let first = extended.mesh.triangles.len() as u32;
        let rim = tube.add_to(&mut extended.mesh, &end.rim);
        extended.triangles.push(first..extended.mesh.triangles.len() as u32);
        extended.ends.push(OpenEnd { rim, ..end });
    }
    // What only touches by rounding, as slivers of a cut do, is no wall in the way.
    let crossing = self_intersections(&extended.mesh);
    let mut free = Vec::new();
    for ((end, triangles), spacing) in ends.iter().zip(&extended.triangles).zip(&spacings) {
        // Triangles follow ring by ring: the first that crosses is the lowest.
        if let Some(&t) =
            crossing.get(crossing.partition_point(|&t| t < triangles.start)).filter(|t| triangles.contains(t))
        {
            let ring = (t - triangles.start) / (2 * end.rim.len() as u32);
            free.push((end.name.clone(), f64::from(ring) * spacing));
        }
    }
    if !free.is_empty() {
        return Err(ExtendError::Collides { free });
    }
    let topology = Topology::new(extended.mesh.positions.len(), &extended.mesh.triangles);
    let measured: Result<Vec<OpenEnd>, RimError> =
        extended.ends.iter().map(|end| end.measured(&extended.mesh, &topology)).collect();
    Ok(Extended { ends: measured?, ..extended })
}

/// An extension on the way.
struct Tube {
    centre: DVec3,
    normal: DVec3,
    length: f64,
    rings: usize,
    /// The length over which the section becomes a circle, in mm.
    transition: f64,
    /// For each vertex of the rim: where it is across the axis, the wall's way across the axis for each mm along it, and its
    /// place on the circle. In mm from the centre.
    curves: Vec<[DVec3; 3]>,
}

impl Tube {
    fn new(mesh: &TriMesh, topology: &Topology, end: &OpenEnd, length: Length) -> Result<Self, ExtendError> {
        let name = || end.name.clone();
        let radius = end.radius_mm();
        let length = length.mm(radius).filter(|&mm| mm > 0.0).ok_or_else(|| ExtendError::Length { name: name() })?;
        let edge_mm = end.mean_edge(mesh);
        let rings = (length / edge_mm).round().max(1.0);
        if !(1.0..=MOST_RINGS).contains(&rings) {
            return Err(ExtendError::TooLong { name: name(), length_mm: length, edge_mm });
        }
        let OpenEnd { centre, normal, .. } = *end;
        let count = end.rim.len() as f64;
        let (x, y) = normal.any_orthonormal_pair();
        let from_centre: Vec<DVec3> = end.rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3() - centre).collect();
        // Clockwise seen from outside: the angles fall by a whole turn.
        let angles = unwound(&from_centre, x, y);
        let step = -TAU / count;
        let [first, .., last] = angles[..] else { return Err(ExtendError::Folded { name: name() }) };
        let back = wrapped(libm::atan2(from_centre[0].dot(y), from_centre[0].dot(x)) - last);
        if (last + back - first + TAU).abs() > 1e-6 {
            return Err(ExtendError::Folded { name: name() });
        }
        let turn = (0..).zip(&angles).map(|(i, angle)| angle - step * f64::from(i)).sum::<f64>() / count;
        // The area of a regular polygon in a circle of radius r is n/2 r2 sin(2 pi / n).
        let circle = (2.0 * end.area_mm2 / (count * libm::sin(TAU / count))).sqrt();
        let slopes = slopes(mesh, topology, end);
        let curves = (0..).zip(from_centre.iter().zip(slopes)).map(|(i, (p, slope))| {
            let (sin, cos) = libm::sincos(turn + step * f64::from(i));
            [p.reject_from_normalized(normal), slope, (x * cos + y * sin) * circle]
        });
        let transition = (TRANSITION * radius).min(length);
        Ok(Self { centre, normal, length, rings: rings as usize, transition, curves: curves.collect() })
    }

    fn spacing(&self) -> f64 {
        self.length / self.rings as f64
    }

    /// Where a curve is at a height over the end's plane, in mm.
    fn at(&self, [from, slope, to]: [DVec3; 3], height: f64) -> DVec3 {
        let u = (height / self.transition).min(1.0);
        let (square, cube) = (u * u, u * u * u);
        let across = from * (2.0 * cube - 3.0 * square + 1.0)
            + slope * self.transition * (cube - 2.0 * square + u)
            + to * (3.0 * square - 2.0 * cube);
        self.centre + across + self.normal * height
    }

    /// Adds the rings and their triangles; the vertices of the last ring.
    fn add_to(&self, mesh: &mut TriMesh, rim: &[u32]) -> Vec<u32> {
        let mut lower = rim.to_vec();
        for ring in 1..=self.rings {
            let height = self.length * ring as f64 / self.rings as f64;
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(self.curves.iter().map(|&curve| self.at(curve, height).as_vec3()));
            let upper: Vec<u32> = (first..first + rim.len() as u32).collect();
            for ((a, b), (c, d)) in edges(&lower).zip(edges(&upper)) {
                let at = |v: u32| mesh.positions[v as usize];
                // The rim's own triangles run from a to b.
                if at(b).distance_squared(at(c)) <= at(a).distance_squared(at(d)) {
                    mesh.triangles.extend([[b, a, c], [b, c, d]]);
                } else {
                    mesh.triangles.extend([[b, a, d], [a, c, d]]);
                }
            }
            lower = upper;
        }
        lower
    }
}

/// An angle within half a turn of 0.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}

/// The angles of points about the origin, each within half a turn of the one before.
fn unwound(points: &[DVec3], x: DVec3, y: DVec3) -> Vec<f64> {
    let mut angles: Vec<f64> = Vec::with_capacity(points.len());
    for p in points {
        let angle = libm::atan2(p.dot(y), p.dot(x));
        angles.push(angles.last().map_or(angle, |last| last + wrapped(angle - last)));
    }
    angles
}

/// For each vertex of an end how far the wall leads across the axis for each mm along it, smoothed around the rim.
pub(crate) fn slopes(mesh: &TriMesh, topology: &Topology, end: &OpenEnd) -> Vec<DVec3> {
    let at = |v: u32| mesh.positions[v as usize].as_dvec3();
    let count = end.rim.len();
    // Straight out over an edge, in the triangle behind it, as long as the edge.
    let out = |(a, b): (u32, u32)| {
        let behind = topology.triangles_on(&mesh.triangles, a, b).next();
        let third = behind.and_then(|t| mesh.triangles[t as usize].into_iter().find(|&v| v != a && v != b));
        let along = at(b) - at(a);
        let across = third.map_or(DVec3::ZERO, |third| (at(a) - at(third)).reject_from(along).normalize_or_zero());
        if across.is_finite() { across * along.length() } else { DVec3::ZERO }
    };
    let over_edges: Vec<DVec3> = edges(&end.rim).map(out).collect();
    let mut directions: Vec<DVec3> = (0..count).map(|i| over_edges[(i + count - 1) % count] + over_edges[i]).collect();
    for _ in 0..SMOOTHINGS {
        directions = (0..count)
            .map(|i| directions[(i + count - 1) % count] + directions[i] * 2.0 + directions[(i + 1) % count])
            .collect();
    }
    let slope = |direction: DVec3| {
        let along = direction.dot(end.normal);
        let across = direction.reject_from_normalized(end.normal);
        if along > 0.0 { (across / along).clamp_length_max(STEEPEST) } else { across.normalize_or_zero() * STEEPEST }
    };
    directions.into_iter().map(slope).collect()
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::{joined, tube, vertices_are_manifold};
    use lumen_mesh::{Vec3, volume};

    use super::*;
    use crate::ends::open_ends;

    /// A tube of 20 mm whose section is an ellipse of half axes 3 and 1.5 mm.
    fn elliptic() -> TriMesh {
        let mut mesh = tube(48, 50, 20.0, |_| 1.5);
        mesh.positions.iter_mut().for_each(|p| p.x *= 2.0);
        mesh
    }

    fn both(length: Length) -> [Length; 2] {
        [length; 2]
    }

    #[test]
    fn an_elliptic_end_becomes_a_circle_of_its_area_at_the_length_asked_for() {
        let mesh = elliptic();
        let (ends, _) = open_ends(&mesh).unwrap();
        let extended = extend(&mesh, &ends, &[Length::Mm(9.0), Length::Radii(5.0)]).unwrap();
        let topology = Topology::new(extended.mesh.positions.len(), &extended.mesh.triangles);
        let counts = topology.edge_counts();
        assert_eq!((counts.non_manifold, counts.flipped, counts.boundary), (0, 0, 96));
        assert!(vertices_are_manifold(&extended.mesh, &topology));
        assert!(self_intersections(&extended.mesh).is_empty());
        let low = f64::from(extended.mesh.bounds().min[2]);
        let high = f64::from(extended.mesh.bounds().max[2]);
        assert!((low + 9.0).abs() < 1e-5 && (high - 20.0 - 5.0 * ends[1].radius_mm()).abs() < 1e-5, "{low} {high}");
        for (end, before) in extended.ends.iter().zip(&ends) {
            assert!((end.area_mm2 / before.area_mm2 - 1.0).abs() < 1e-5);
            assert!((end.area_mm2 / (PI * 4.5) - 1.0).abs() < 5e-3, "an ellipse of 3 and 1.5 mm");
            let radii = end.rim.iter().map(|&v| extended.mesh.positions[v as usize].as_dvec3().distance(end.centre));
            let (least, largest) = radii.fold((f64::MAX, 0.0f64), |(l, h), r| (l.min(r), h.max(r)));
            assert!(largest / least < 1.0001, "{least} to {largest}");
            assert!(end.normal.distance(before.normal) < 1e-5 && end.name == before.name);
        }
        assert_eq!(extended.mesh.positions[..mesh.positions.len()], mesh.positions[..]);
        assert_eq!(extended.mesh.triangles[..mesh.triangles.len()], mesh.triangles[..]);
    }

    #[test]
    fn rings_rise_evenly_and_the_wall_goes_on_without_an_edge() {
        let mesh = elliptic();
        let (ends, _) = open_ends(&mesh).unwrap();
        let extended = extend(&mesh, &ends, &both(Length::Mm(8.0))).unwrap();
        let mut new = extended.mesh.positions[mesh.positions.len()..].chunks(48);
        let spacing = {
            let heights: Vec<f32> = new.by_ref().take_while(|ring| ring[0].z < 0.0).map(|ring| ring[0].z).collect();
            assert!(heights.windows(2).all(|pair| pair[1] < pair[0]), "{heights:?}");
            f64::from(heights[0] - heights[1])
        };
        assert!((spacing / ends[0].mean_edge(&mesh) - 1.0).abs() < 0.05, "{spacing}");
        for ring in new {
            assert!(ring.iter().all(|p| (p.z - ring[0].z).abs() < 1e-5), "rings are planar");
        }
        // The angle between the wall and the extension, over each edge of the rims.
        let topology = Topology::new(extended.mesh.positions.len(), &extended.mesh.triangles);
        for (a, b) in ends.iter().flat_map(|end| edges(&end.rim)) {
            let normals: Vec<DVec3> = topology
                .triangles_on(&extended.mesh.triangles, a, b)
                .map(|t| extended.mesh.corners(t as usize).map(Vec3::as_dvec3))
                .map(|[a, b, c]| (b - a).cross(c - a).normalize())
                .collect();
            assert!(normals[0].dot(normals[1]) > libm::cos(15f64.to_radians()), "{}", normals[0].dot(normals[1]));
        }
    }

    #[test]
    fn a_cone_goes_on_along_its_own_wall_before_it_becomes_straight() {
        // It widens by 0.3 mm for each mm.
        let mesh = tube(64, 80, 20.0, |z| 2.0 + 0.3 * z);
        let (ends, _) = open_ends(&mesh).unwrap();
        let extended = extend(&mesh, &ends, &both(Length::Radii(3.0))).unwrap();
        let widest = &extended.mesh.positions[mesh.positions.len()..];
        let ring = widest.iter().filter(|p| p.z > 20.0).take(64).copied().collect::<Vec<_>>();
        let slope = (f64::from(ring[0].truncate().length()) - 8.0) / f64::from(ring[0].z - 20.0);
        assert!((0.2..0.31).contains(&slope), "{slope}");
        let last = extended.mesh.positions[extended.mesh.positions.len() - 1];
        assert!((f64::from(last.truncate().length()) - 8.0).abs() < 1e-4);
    }

    #[test]
    fn the_volume_of_a_round_extension_is_that_of_a_cylinder() {
        let mesh = tube(48, 40, 20.0, |_| 2.0);
        let (ends, _) = open_ends(&mesh).unwrap();
        let extended = extend(&mesh, &ends, &both(Length::Mm(10.0))).unwrap();
        assert_eq!(extended, extend(&mesh, &ends, &both(Length::Mm(10.0))).unwrap());
        let volume = |mesh: &TriMesh| volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
        let added = volume(&extended.mesh) - volume(&mesh);
        // The prism of the rim, within what the turned rings of the transition lack.
        assert!((added / (20.0 * ends[0].area_mm2) - 1.0).abs() < 5e-3, "{added}");
    }

    #[test]
    fn an_extension_that_meets_something_is_refused_with_the_length_that_is_free() {
        // The second tube stands across the first's axis, 12 mm beyond its end.
        let mut wall = tube(48, 80, 40.0, |_| 3.0);
        wall.positions.iter_mut().for_each(|p| *p = Vec3::new(p.z - 20.0, p.x, p.y + 35.0));
        let mesh = joined(&[tube(48, 40, 20.0, |_| 2.0), wall]);
        let (ends, _) = open_ends(&mesh).unwrap();
        let upper: Vec<OpenEnd> = ends.into_iter().filter(|end| end.normal.z > 0.9).collect();
        let found = extend(&mesh, &upper, &[Length::Mm(20.0)]).unwrap_err();
        let ExtendError::Collides { free } = found else { panic!("{found}") };
        let [(_, free_mm)] = free[..] else { panic!("{free:?}") };
        assert!((11.0..12.5).contains(&free_mm), "{free_mm}");
        assert!(extend(&mesh, &upper, &[Length::Mm(free_mm - 0.01)]).is_ok());
    }

    #[test]
    fn ends_and_lengths_that_make_no_sense_are_refused() {
        let mesh = elliptic();
        let (ends, _) = open_ends(&mesh).unwrap();
        assert_eq!(extend(&mesh, &[], &[]), Err(ExtendError::NoEnds));
        assert_eq!(extend(&mesh, &ends, &[Length::Mm(1.0)]), Err(ExtendError::Lengths { ends: 2, lengths: 1 }));
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(extend(&mesh, &ends, &both(Length::Radii(bad))), Err(ExtendError::Length { .. })));
        }
        assert!(matches!(extend(&mesh, &ends, &both(Length::Mm(1e9))), Err(ExtendError::TooLong { .. })));
        let mut stale = ends.clone();
        stale[0].rim[0] = 1_000_000;
        assert!(matches!(extend(&mesh, &stale, &both(Length::Mm(1.0))), Err(ExtendError::Rim(_))));
        let mut broken = mesh.clone();
        broken.positions[0].x = f32::NAN;
        assert!(matches!(extend(&broken, &ends, &both(Length::Mm(1.0))), Err(ExtendError::Surface(_))));
    }
}
