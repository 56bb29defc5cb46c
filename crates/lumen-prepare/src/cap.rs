//! Closes the open ends of a surface, each with a patch of its own.
//!
//! A planar cap is a constrained Delaunay triangulation (the crate `spade`) of the rim and of a hexagonal grid of points in
//! it, as far apart as the rim's vertices are; the points take the mean of their neighbours a few times. A smooth cap is the
//! same disc raised to a dome: what is at the part `q` of the way from the middle to the rim goes to the angle `q pi / 2` of a
//! half ellipsoid, so that it leaves the rim along the wall of a cylinder.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};
use thiserror::Error;

use super::ends::{OpenEnd, RimError, SurfaceError, check_surface};
use super::{Patch, Patched};
use lumen_mesh::{Topology, TriMesh};

/// How an end is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CapKind {
    /// Triangles from the rim to one vertex in the middle.
    Fan,
    /// An even mesh in the plane.
    Planar,
    /// A dome as high as the end's radius that goes on from the wall.
    Smooth,
}

/// Points of the grid are at least this part of their distance away from the rim.
const CLEAR: f64 = 0.7;
/// Times that points take the mean of their neighbours.
const ROUNDS: usize = 6;
/// The most points in a cap.
const MOST: f64 = 1e6;

/// Why an end cannot be closed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CapError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The end is no planar loop of the surface.
    #[error(transparent)]
    Rim(#[from] RimError),
    /// The rim crosses itself, or has edges so short that the cap would have more than a million vertices.
    #[error("the rim of {name} crosses itself or is too uneven to be closed")]
    Uneven {
        /// The end.
        name: String,
    },
}

/// Closes `ends` of `mesh`. The wall is the first patch, and each end one behind it, in their order.
///
/// # Errors
/// [`CapError`]. Nothing is closed where one end cannot be.
pub fn cap(mesh: &TriMesh, ends: &[OpenEnd], kind: CapKind) -> Result<Patched, CapError> {
    check_surface(mesh)?;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let mut surface = Patched::wall(mesh.clone());
    for (i, end) in ends.iter().enumerate() {
        let end = end.measured(mesh, &topology)?;
        let disc = Disc::of(mesh, &end, kind).ok_or_else(|| CapError::Uneven { name: end.name.clone() })?;
        let first = surface.mesh.positions.len() as u32;
        surface.mesh.positions.extend(disc.inner.iter().map(|p| p.as_vec3()));
        let vertex = |v: usize| end.rim.get(v).copied().unwrap_or(first + (v - end.rim.len().min(v)) as u32);
        surface.mesh.triangles.extend(disc.triangles.iter().map(|corners| corners.map(vertex)));
        surface.of_triangle.resize(surface.mesh.triangles.len(), i as u32 + 1);
        let (centre, normal) = (end.centre.to_array(), end.normal.to_array());
        let (name, kind, area_mm2) = (end.name.clone(), end.kind, end.area_mm2);
        surface.patches.push(Patch { id: i as u32 + 2, name, kind, centre, normal, area_mm2 });
    }
    Ok(surface)
}

/// What closes a rim: vertices inside of it, and triangles over the rim's vertices and those behind them.
struct Disc {
    inner: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
}

/// A vertex of a triangulation.
struct Corner {
    at: Point2<f64>,
    number: usize,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

impl Disc {
    fn of(mesh: &TriMesh, end: &OpenEnd, kind: CapKind) -> Option<Self> {
        let corner = |v: u32| mesh.positions[v as usize].as_dvec3();
        let count = end.rim.len();
        if kind == CapKind::Fan {
            // The rim runs clockwise seen from outside.
            let triangles = (0..count).map(|i| [(i + 1) % count, i, count]).collect();
            return Some(Self { inner: vec![end.centre], triangles });
        }
        let (along, across) = end.normal.any_orthonormal_pair();
        let flat = |p: DVec3| DVec2::new((p - end.centre).dot(along), (p - end.centre).dot(across));
        let rim: Vec<DVec2> = end.rim.iter().map(|&v| flat(corner(v))).collect();
        let mut inner = grid(&rim, end.mean_edge(mesh))?;
        let mut triangles = triangulated(&rim, &inner)?;
        for _ in 0..ROUNDS {
            relax(&rim, &mut inner, &triangles);
            triangles = triangulated(&rim, &inner)?;
        }
        let place = |p: DVec2| end.centre + along * p.x + across * p.y;
        let raised = |p: DVec2| {
            let part = if kind == CapKind::Smooth { p.length() / reach(&rim, p) } else { 0.0 };
            if kind == CapKind::Planar {
                return place(p);
            }
            let (sine, cosine) = (libm::sin(part * FRAC_PI_2), libm::cos(part * FRAC_PI_2));
            let out = if part > 0.0 { p * (sine / part) } else { p };
            place(out) + end.normal * (end.radius_mm() * cosine)
        };
        Some(Self { inner: inner.into_iter().map(raised).collect(), triangles })
    }
}

/// The distance from the middle to the rim in the direction of `p`; that of `p` where the rim is nearer.
fn reach(rim: &[DVec2], p: DVec2) -> f64 {
    let Some(way) = p.try_normalize() else { return 1.0 };
    let hit = |(a, b): (DVec2, DVec2)| {
        let side = b - a;
        let turn = way.perp_dot(side);
        let (along, part) = (a.perp_dot(side) / turn, a.perp_dot(way) / turn);
        (along > 0.0 && (0.0..=1.0).contains(&part)).then_some(along)
    };
    edges(rim).filter_map(hit).fold(p.length(), f64::max)
}

fn edges(rim: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    rim.iter().copied().zip(rim.iter().copied().cycle().skip(1))
}

/// Points of a hexagonal grid of edges `edge` in the rim; `None` where there are too many.
fn grid(rim: &[DVec2], edge: f64) -> Option<Vec<DVec2>> {
    let low = rim.iter().copied().reduce(DVec2::min)?;
    let high = rim.iter().copied().reduce(DVec2::max)?;
    let (rows, columns) = ((high.y - low.y) / (edge * HEIGHT), (high.x - low.x) / edge);
    if edge.is_nan() || edge <= 0.0 || rows * columns > MOST {
        return None;
    }
    let mut points = Vec::new();
    for row in 0..=rows as usize {
        for column in 0..=columns as usize {
            let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
            let at = low + DVec2::new((column as f64 + shift) * edge, (row as f64 + 0.5) * edge * HEIGHT);
            if is_inside(rim, at) && edges(rim).all(|(a, b)| distance(at, a, b) > CLEAR * edge) {
                points.push(at);
            }
        }
    }
    Some(points)
}

/// The height of an equilateral triangle.
const HEIGHT: f64 = 0.866_025_403_784_438_6;

/// Whether a point lies in a closed polygon, by the edges that a ray to the right passes.
fn is_inside(rim: &[DVec2], p: DVec2) -> bool {
    let passes =
        |(a, b): (DVec2, DVec2)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
    edges(rim).filter(|&edge| passes(edge)).count() % 2 == 1
}

/// The distance of a point from a side.
fn distance(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let side = b - a;
    let part = ((p - a).dot(side) / side.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    p.distance(a + side * part)
}

/// The triangles over rim and inner points, counter-clockwise; `None` where the rim crosses itself.
fn triangulated(rim: &[DVec2], inner: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut triangulation = ConstrainedDelaunayTriangulation::<Corner>::new();
    let mut handles = Vec::with_capacity(rim.len());
    for (number, p) in rim.iter().chain(inner).enumerate() {
        let handle = triangulation.insert(Corner { at: Point2::new(p.x, p.y), number }).ok()?;
        if number < rim.len() {
            handles.push(handle);
        }
    }
    // Two points at one place are one vertex.
    if triangulation.num_vertices() != rim.len() + inner.len() {
        return None;
    }
    for (i, &from) in handles.iter().enumerate() {
        let to = handles[(i + 1) % handles.len()];
        if !triangulation.can_add_constraint(from, to) {
            return None;
        }
        triangulation.add_constraint(from, to);
    }
    let faces = triangulation.inner_faces().filter_map(|face| {
        let corners = face.vertices();
        let middle = corners.iter().fold(DVec2::ZERO, |sum, v| sum + DVec2::new(v.position().x, v.position().y)) / 3.0;
        is_inside(rim, middle).then(|| corners.map(|v| v.data().number))
    });
    Some(faces.collect())
}

/// Each inner point goes to the mean of its neighbours.
fn relax(rim: &[DVec2], inner: &mut [DVec2], triangles: &[[usize; 3]]) {
    let mut sums = vec![(DVec2::ZERO, 0.0); inner.len()];
    let at = |v: usize| rim.get(v).copied().unwrap_or_else(|| inner[v - rim.len()]);
    for corners in triangles {
        for (i, &v) in corners.iter().enumerate() {
            if let Some(sum) = v.checked_sub(rim.len()).and_then(|v| sums.get_mut(v)) {
                sum.0 += at(corners[(i + 1) % 3]) + at(corners[(i + 2) % 3]);
                sum.1 += 2.0;
            }
        }
    }
    for (p, (sum, count)) in inner.iter_mut().zip(sums) {
        if count > 0.0 && is_inside(rim, sum / count) {
            *p = sum / count;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::ends::open_ends;
    use super::*;
    use lumen_mesh::shapes::tube;
    use lumen_mesh::{Vec3, angles, self_intersections, triangle_area, volume};

    const SIDES: u32 = 24;

    fn capped(mesh: &TriMesh, kind: CapKind) -> Patched {
        let (ends, refused) = open_ends(mesh).unwrap();
        assert!(refused.is_empty());
        cap(mesh, &ends, kind).unwrap()
    }

    /// Checks that a surface is closed and consistent, of the Euler characteristic of a sphere; gives its volume.
    fn closed(mesh: &TriMesh) -> f64 {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let counts = topology.edge_counts();
        assert_eq!((counts.boundary, counts.non_manifold, counts.flipped), (0, 0, 0));
        assert_eq!(mesh.positions.len() + mesh.triangles.len(), counts.edges + 2);
        assert!(self_intersections(mesh).is_empty());
        volume(mesh, &topology)
    }

    /// The area of a regular polygon in a circle of 2 mm.
    fn polygon() -> f64 {
        f64::from(SIDES) * 2.0 * libm::sin(std::f64::consts::TAU / f64::from(SIDES))
    }

    #[test]
    fn flat_caps_close_a_tube_with_the_areas_of_its_polygons() {
        let mesh = tube(SIDES, 40, 20.0, |_| 2.0);
        for kind in [CapKind::Fan, CapKind::Planar] {
            let surface = capped(&mesh, kind);
            // Between rings that are turned by half a side the section lies between the polygon and the circle.
            let whole = closed(&surface.mesh);
            assert!(whole > polygon() * 20.0 && whole < std::f64::consts::PI * 80.0, "{kind:?}: {whole}");
            assert_eq!(surface.patches.len(), 3);
            for (number, patch) in surface.patches.iter().enumerate().skip(1) {
                let of = |t: &usize| surface.of_triangle[*t] as usize == number;
                let triangles = (0..surface.mesh.triangles.len()).filter(of);
                let area: f64 = triangles.clone().map(|t| triangle_area(surface.mesh.corners(t))).sum();
                assert!((area / polygon() - 1.0).abs() < 1e-5 && (patch.area_mm2 / polygon() - 1.0).abs() < 1e-5);
                for t in triangles {
                    let [a, b, c] = surface.mesh.corners(t).map(Vec3::as_dvec3);
                    let normal = (b - a).cross(c - a).normalize();
                    assert!(normal.dot(DVec3::from_array(patch.normal)) > 1.0 - 1e-6, "out of the vessel");
                }
            }
        }
    }

    #[test]
    fn a_planar_cap_has_no_small_angles() {
        let mesh = tube(SIDES, 40, 20.0, |_| 2.0);
        let surface = capped(&mesh, CapKind::Planar);
        let caps = surface.mesh.filtered(|t| surface.of_triangle[t] > 0);
        assert!(angles(&caps).unwrap().min_deg > 25.0, "{:?}", angles(&caps));
    }

    #[test]
    fn a_dome_goes_on_from_the_wall_and_has_the_volume_of_a_half_ball() {
        let mesh = tube(96, 160, 20.0, |_| 2.0);
        let volumes = [CapKind::Planar, CapKind::Smooth].map(|kind| closed(&capped(&mesh, kind).mesh));
        let ball = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
        assert!(((volumes[1] - volumes[0]) / ball - 1.0).abs() < 0.02, "{volumes:?}");
    }

    #[test]
    fn a_rim_that_crosses_itself_is_refused() {
        // A strip whose one rim is bent to an eight in its plane.
        let mut mesh = tube(24, 2, 10.0, |_| 2.0);
        for (i, p) in mesh.positions.iter_mut().take(24).enumerate() {
            let angle = i as f32 / 24.0 * std::f32::consts::TAU;
            (p.x, p.y) = (2.0 * angle.sin() + 0.1 * angle.cos(), (2.0 * angle).sin() + 0.3);
        }
        let (ends, _) = open_ends(&mesh).unwrap();
        let refused = ends.iter().any(|end| cap(&mesh, std::slice::from_ref(end), CapKind::Planar).is_err());
        assert!(refused || ends.len() < 2, "{ends:?}");
    }

    #[test]
    fn the_same_surface_gives_the_same_cap() {
        let mesh = tube(31, 20, 20.0, |z| 2.0 + 0.01 * z);
        assert!(capped(&mesh, CapKind::Planar) == capped(&mesh, CapKind::Planar));
    }
}
