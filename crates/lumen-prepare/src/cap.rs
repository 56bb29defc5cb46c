//! Caps: a patch over every open end, so that the surface encloses a volume.
//!
//! A fan has one vertex in the middle. A planar cap has vertices on a hexagonal grid of the rim's mean edge length; these
//! are moved to the mean of their neighbours a few times, and a constrained Delaunay triangulation joins them (Shewchuk,
//! "Delaunay refinement algorithms for triangular mesh generation", 2002; crate `spade`). A smooth cap is a planar one
//! raised to a dome that continues the wall: the clamped biharmonic (thin-plate) surface over a disc. With the vertex of
//! the planar cap at the part r of the way from the middle to the rim point b, whose wall leads s mm across the axis for
//! each mm along it, on a section of radius R, it lies at
//!
//! `b (3 r - r^3) / 2 + s R r^2 (1 - r) + n R (1 - r^2) / 2`
//!
//! from the middle, n the normal. A round straight vessel so ends in a dome half a radius high.

use glam::{DVec2, DVec3};
use lumen_mesh::{Topology, TriMesh, boundary_loops, triangle_area};
use serde::{Deserialize, Serialize};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use thiserror::Error;

use crate::ends::{OpenEnd, RimError, SurfaceError, check_surface};
use crate::extend::slopes;
use crate::{Patch, Patched};

/// Grid points nearer to the rim than this part of its mean edge are left out.
const FROM_RIM: f64 = 0.6;
/// Rounds in which inner vertices move to the mean of their neighbours.
const SMOOTHINGS: usize = 8;
/// The most inner vertices of a cap.
const MOST_VERTICES: f64 = 1e6;

/// The shape of a cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CapKind {
    /// Triangles from one vertex in the middle.
    Fan,
    /// Flat, with triangles of the rim's size.
    Planar,
    /// A dome that continues the wall, with triangles of about the rim's size.
    Smooth,
}

/// Why a surface cannot be capped.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CapError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// An end is none of this surface.
    #[error(transparent)]
    Rim(#[from] RimError),
    /// There is nothing to cap.
    #[error("there is no open end to cap")]
    NoEnds,
    /// Two ends have a vertex in common, or are the same.
    #[error("two ends share vertex {vertex}")]
    Shared {
        /// Vertex of the surface.
        vertex: u32,
    },
    /// The surface is open besides its ends.
    #[error("the surface has {holes} boundary loops besides its open ends: fill them first")]
    Holes {
        /// How many.
        holes: usize,
    },
    /// The outline is not seen whole from its middle.
    #[error("the outline of {name} is folded: it is not seen whole from its middle")]
    Folded {
        /// The end.
        name: String,
    },
    /// The outline crosses itself or passes a point twice.
    #[error("the outline of {name} crosses or touches itself")]
    SelfCrossing {
        /// The end.
        name: String,
    },
    /// The cap would take too many vertices.
    #[error("the edges of {name} are too short for its area: a cap would take more than {MOST_VERTICES:.0} vertices")]
    TooFine {
        /// The end.
        name: String,
    },
    /// A cap would share an edge with triangles of the wall.
    #[error("a cap of {name} would join two vertices that the wall joins already")]
    Joined {
        /// The end.
        name: String,
    },
}

/// Closes `mesh` at `ends`, which are all of its boundary loops. The wall is patch 1; the ends are patches 2, 3 and so on in
/// their order, with the area of their caps.
///
/// # Errors
/// [`CapError`]. Nothing is capped where one end cannot be.
pub fn cap(mesh: &TriMesh, ends: &[OpenEnd], kind: CapKind) -> Result<Patched, CapError> {
    check_surface(mesh)?;
    if ends.is_empty() {
        return Err(CapError::NoEnds);
    }
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let mut rims: Vec<u32> = ends.iter().flat_map(|end| end.rim.iter().copied()).collect();
    let ends: Vec<OpenEnd> = ends.iter().map(|end| end.measured(mesh, &topology)).collect::<Result<_, _>>()?;
    rims.sort_unstable();
    if let Some(pair) = rims.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(CapError::Shared { vertex: pair[0] });
    }
    let is_of_end = |v: &u32| rims.binary_search(v).is_ok();
    let holes = boundary_loops(&topology).iter().filter(|chain| !chain.iter().all(is_of_end)).count();
    if holes > 0 {
        return Err(CapError::Holes { holes });
    }
    let mut patched = Patched::wall(mesh.clone());
    for (id, end) in (2..).zip(&ends) {
        let section = Section::new(mesh, end);
        let lid = match kind {
            CapKind::Fan => section.fan()?,
            CapKind::Planar => section.planar()?,
            CapKind::Smooth => section.planar()?.raised(&section, &slopes(mesh, &topology, end))?,
        };
        let count = end.rim.len();
        let first = patched.mesh.positions.len() as u32;
        let number = |v: usize| end.rim.get(v).copied().unwrap_or(first + (v.saturating_sub(count)) as u32);
        // An edge that the wall has already would have four triangles.
        for [a, b, c] in &lid.triangles {
            for (a, b) in [(*a, *b), (*b, *c), (*c, *a)] {
                let is_chord = a < count && b < count && (a + 1) % count != b && (b + 1) % count != a;
                if is_chord && topology.edge(number(a), number(b)).is_some() {
                    return Err(CapError::Joined { name: end.name.clone() });
                }
            }
        }
        patched.mesh.positions.extend(lid.inner.iter().map(|p| p.as_vec3()));
        let before = patched.mesh.triangles.len();
        patched.mesh.triangles.extend(lid.triangles.iter().map(|t| t.map(number)));
        patched.of_triangle.resize(patched.mesh.triangles.len(), id - 1);
        let own = before..patched.mesh.triangles.len();
        patched.patches.push(Patch {
            id,
            name: end.name.clone(),
            kind: end.kind,
            centre: end.centre.to_array(),
            normal: end.normal.to_array(),
            area_mm2: own.map(|t| triangle_area(patched.mesh.corners(t))).sum(),
        });
    }
    Ok(patched)
}

/// A cap: vertices of the rim by their place in it, then its own.
struct Lid {
    /// Its own vertices in mm.
    inner: Vec<DVec3>,
    /// Counter-clockwise seen from outside.
    triangles: Vec<[usize; 3]>,
}

/// The outline of an end in its plane.
struct Section<'a> {
    end: &'a OpenEnd,
    axes: [DVec3; 2],
    /// The rim from the centre on, in mm, clockwise.
    rim: Vec<DVec2>,
    /// The mean length of its edges, in mm.
    edge: f64,
}

impl<'a> Section<'a> {
    fn new(mesh: &TriMesh, end: &'a OpenEnd) -> Self {
        let (x, y) = end.normal.any_orthonormal_pair();
        let flat = |&v: &u32| {
            let p = mesh.positions[v as usize].as_dvec3() - end.centre;
            DVec2::new(p.dot(x), p.dot(y))
        };
        Self { end, axes: [x, y], rim: end.rim.iter().map(flat).collect(), edge: end.mean_edge(mesh) }
    }

    fn sides(&self) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
        self.rim.iter().copied().zip(self.rim.iter().copied().cycle().skip(1))
    }

    fn place(&self, p: DVec2) -> DVec3 {
        self.end.centre + self.axes[0] * p.x + self.axes[1] * p.y
    }

    /// Whether the rim is seen whole from its middle.
    fn is_star(&self) -> bool {
        self.sides().all(|(p, q)| q.perp_dot(p) > 0.0)
    }

    fn fan(&self) -> Result<Lid, CapError> {
        if !self.is_star() {
            return Err(CapError::Folded { name: self.end.name.clone() });
        }
        let count = self.rim.len();
        let triangles = (0..count).map(|i| [(i + 1) % count, i, count]).collect();
        Ok(Lid { inner: vec![self.end.centre], triangles })
    }

    fn planar(&self) -> Result<Lid, CapError> {
        let mut inner = self.grid()?;
        let mut triangles = self.triangulated(&inner)?;
        for _ in 0..SMOOTHINGS {
            let moved = self.smoothed(&inner, &triangles);
            if moved.iter().any(|&p| !self.has(p, 0.0)) {
                break;
            }
            inner = moved;
            triangles = self.triangulated(&inner)?;
        }
        Ok(Lid { inner: inner.into_iter().map(|p| self.place(p)).collect(), triangles })
    }

    /// Whether a point lies in the outline and at least so far from it, in mm.
    fn has(&self, p: DVec2, distance: f64) -> bool {
        let mut is_inside = false;
        for (a, b) in self.sides() {
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
                is_inside = !is_inside;
            }
            let along = b - a;
            let part = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            if p.distance(a + along * part) < distance {
                return false;
            }
        }
        is_inside
    }

    /// The points of a hexagonal grid about the middle that lie well in the outline.
    fn grid(&self) -> Result<Vec<DVec2>, CapError> {
        let (low, high) =
            self.rim.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
        let row_height = self.edge * 0.75f64.sqrt();
        let [columns, rows] = [(high.x - low.x) / self.edge, (high.y - low.y) / row_height];
        if !(0.0..=MOST_VERTICES).contains(&(columns * rows)) {
            return Err(CapError::TooFine { name: self.end.name.clone() });
        }
        let mut points = Vec::new();
        for row in (low.y / row_height).floor() as i64..=(high.y / row_height).ceil() as i64 {
            let shift = if row.rem_euclid(2) == 1 { 0.5 } else { 0.0 };
            for column in (low.x / self.edge).floor() as i64 - 1..=(high.x / self.edge).ceil() as i64 {
                let p = DVec2::new((column as f64 + shift) * self.edge, row as f64 * row_height);
                if self.has(p, FROM_RIM * self.edge) {
                    points.push(p);
                }
            }
        }
        Ok(points)
    }

    /// The constrained Delaunay triangles in the outline over its vertices and the `inner` ones.
    fn triangulated(&self, inner: &[DVec2]) -> Result<Vec<[usize; 3]>, CapError> {
        let crossing = || CapError::SelfCrossing { name: self.end.name.clone() };
        let mut triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
        // Numbers next to 0 are refused there.
        let flat = |x: f64| if x.abs() < 1e-30 { 0.0 } else { x };
        let mut handles = Vec::with_capacity(self.rim.len() + inner.len());
        for (number, p) in self.rim.iter().chain(inner).enumerate() {
            let handle = triangulation.insert(Point2::new(flat(p.x), flat(p.y))).map_err(|_| crossing())?;
            // A point that is there already.
            if handle.index() != number {
                return Err(crossing());
            }
            handles.push(handle);
        }
        let rim = &handles[..self.rim.len()];
        for (&from, &to) in rim.iter().zip(rim.iter().cycle().skip(1)) {
            if !triangulation.can_add_constraint(from, to) {
                return Err(crossing());
            }
            triangulation.add_constraint(from, to);
        }
        if triangulation.num_constraints() != rim.len() {
            return Err(crossing());
        }
        let point = |v: usize| self.rim.get(v).or_else(|| inner.get(v - self.rim.len())).copied().unwrap_or_default();
        let triangles = triangulation.inner_faces().map(|face| face.vertices().map(|vertex| vertex.fix().index()));
        let mut triangles: Vec<[usize; 3]> =
            triangles.filter(|t| self.has(t.iter().map(|&v| point(v)).sum::<DVec2>() / 3.0, 0.0)).collect();
        // A triangle runs along every edge of the rim, against it.
        let mut sides: Vec<(usize, usize)> = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
        sides.sort_unstable();
        let count = self.rim.len();
        if (0..count).any(|i| sides.binary_search(&((i + 1) % count, i)).is_err()) {
            return Err(crossing());
        }
        triangles.sort_unstable();
        Ok(triangles)
    }

    /// The inner vertices, each at the mean of its neighbours.
    fn smoothed(&self, inner: &[DVec2], triangles: &[[usize; 3]]) -> Vec<DVec2> {
        let count = self.rim.len();
        let point = |v: usize| if v < count { self.rim[v] } else { inner[v - count] };
        let mut sums = vec![(DVec2::ZERO, 0.0); inner.len()];
        for &[a, b, c] in triangles {
            for (v, next) in [(a, b), (b, c), (c, a)] {
                // Around an inner vertex every neighbour comes next once.
                if let Some((sum, number)) = v.checked_sub(count).and_then(|v| sums.get_mut(v)) {
                    *sum += point(next);
                    *number += 1.0;
                }
            }
        }
        let mean = |((sum, number), &p): ((DVec2, f64), &DVec2)| if number > 0.0 { sum / number } else { p };
        sums.into_iter().zip(inner).map(mean).collect()
    }

    /// Where the half-line from the middle through `p` meets the rim: the edge, and how far along it.
    fn rim_beyond(&self, p: DVec2) -> Option<(usize, f64)> {
        let meets = |(i, (a, b)): (usize, (DVec2, DVec2))| {
            // p lies between the directions of a and b, which follow each other clockwise.
            let (to_a, to_b) = (p.perp_dot(a), b.perp_dot(p));
            (to_a >= 0.0 && to_b >= 0.0 && to_a + to_b > 0.0 && p.dot(a + b) > 0.0).then(|| (i, to_a / (to_a + to_b)))
        };
        self.sides().enumerate().find_map(meets)
    }
}

impl Lid {
    /// A planar cap raised to a dome that continues a wall of these slopes.
    fn raised(self, section: &Section, slopes: &[DVec3]) -> Result<Self, CapError> {
        let folded = || CapError::Folded { name: section.end.name.clone() };
        if !section.is_star() {
            return Err(folded());
        }
        let (count, radius) = (section.rim.len(), section.end.radius_mm());
        let OpenEnd { centre, normal, .. } = *section.end;
        let raise = |p: DVec3| {
            let from_centre = p - centre;
            let flat = DVec2::new(from_centre.dot(section.axes[0]), from_centre.dot(section.axes[1]));
            if flat.length() < 1e-9 * radius {
                return Ok(centre + normal * radius / 2.0);
            }
            let (i, part) = section.rim_beyond(flat).ok_or_else(folded)?;
            let next = (i + 1) % count;
            let rim = section.rim[i].lerp(section.rim[next], part);
            let slope = slopes[i].lerp(slopes[next], part);
            let r = (flat.length() / rim.length()).min(1.0);
            let across = (section.place(rim) - centre) * (3.0 * r - r * r * r) / 2.0;
            let along = normal * radius * (1.0 - r * r) / 2.0;
            Ok(centre + across + slope * radius * r * r * (1.0 - r) + along)
        };
        let inner = self.inner.into_iter().map(raise).collect::<Result<_, CapError>>()?;
        Ok(Self { inner, ..self })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use lumen_mesh::shapes::{tube, vertices_are_manifold};
    use lumen_mesh::{Vec3, angles, self_intersections, volume};

    use super::*;
    use crate::PatchKind;
    use crate::ends::{edges, open_ends};

    const KINDS: [CapKind; 3] = [CapKind::Fan, CapKind::Planar, CapKind::Smooth];

    fn capped(mesh: &TriMesh, kind: CapKind) -> Patched {
        cap(mesh, &open_ends(mesh).unwrap().0, kind).unwrap()
    }

    fn lid(patched: &Patched, patch: u32) -> TriMesh {
        patched.mesh.filtered(|t| patched.of_triangle[t] == patch)
    }

    /// Area of the polygon of `sides` in a circle.
    fn polygon(sides: f64, radius: f64) -> f64 {
        sides / 2.0 * radius * radius * libm::sin(2.0 * PI / sides)
    }

    #[test]
    fn a_capped_tube_is_a_sphere_in_topology_and_has_its_patches() {
        let mesh = tube(24, 76, 40.0, |z| 2.0 + z / 100.0);
        for kind in KINDS {
            let patched = capped(&mesh, kind);
            assert_eq!(patched, capped(&mesh, kind));
            let topology = Topology::new(patched.mesh.positions.len(), &patched.mesh.triangles);
            let counts = topology.edge_counts();
            assert_eq!((counts.boundary, counts.non_manifold, counts.flipped), (0, 0, 0));
            assert!(vertices_are_manifold(&patched.mesh, &topology));
            assert!(self_intersections(&patched.mesh).is_empty());
            let euler = patched.mesh.positions.len() as i64 - counts.edges as i64 + patched.mesh.triangles.len() as i64;
            assert_eq!(euler, 2);
            assert_eq!(patched.of_triangle.len(), patched.mesh.triangles.len());
            assert!(patched.of_triangle[..mesh.triangles.len()].iter().all(|&patch| patch == 0));
            assert_eq!(patched.mesh.positions[..mesh.positions.len()], mesh.positions[..]);
            let ids: Vec<(u32, &str, PatchKind)> =
                patched.patches.iter().map(|patch| (patch.id, patch.name.as_str(), patch.kind)).collect();
            let expected =
                [(1, "wall", PatchKind::Wall), (2, "outlet_1", PatchKind::Outlet), (3, "inlet", PatchKind::Inlet)];
            assert_eq!(ids, expected);
        }
    }

    #[test]
    fn flat_caps_have_the_area_of_the_polygon_and_the_tube_about_the_volume_of_a_prism() {
        let mesh = tube(24, 76, 40.0, |_| 2.0);
        for kind in [CapKind::Fan, CapKind::Planar] {
            let patched = capped(&mesh, kind);
            for patch in &patched.patches[1..] {
                assert!((patch.area_mm2 / polygon(24.0, 2.0) - 1.0).abs() < 1e-6, "{patch:?}");
                assert!(patch.normal[2].abs() > 1.0 - 1e-9 && patch.centre[2] * patch.normal[2] >= 0.0);
            }
            let topology = Topology::new(patched.mesh.positions.len(), &patched.mesh.triangles);
            let volume = volume(&patched.mesh, &topology);
            // Rings that are turned by half a side make antiprisms, which differ from prisms by less than a percent.
            assert!((volume / (polygon(24.0, 2.0) * 40.0) - 1.0).abs() < 1e-2, "{volume}");
        }
    }

    #[test]
    fn a_prism_has_the_volume_of_its_polygon_times_its_length() {
        // The rings are not turned against each other.
        let rings = 20u32;
        let at = |ring: u32, side: u32| ring * 24 + side % 24;
        let position = |i: u32| {
            let (sin, cos) = libm::sincos(f64::from(i % 24) / 24.0 * 2.0 * PI);
            Vec3::new((2.0 * cos) as f32, (2.0 * sin) as f32, (i / 24) as f32 * 0.5)
        };
        let mut mesh = TriMesh { positions: (0..24 * (rings + 1)).map(position).collect(), triangles: Vec::new() };
        for (ring, side) in (0..rings).flat_map(|ring| (0..24).map(move |side| (ring, side))) {
            let [a, b, c, d] = [at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1)];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
        for kind in [CapKind::Fan, CapKind::Planar] {
            let patched = capped(&mesh, kind);
            let topology = Topology::new(patched.mesh.positions.len(), &patched.mesh.triangles);
            assert!((volume(&patched.mesh, &topology) / (polygon(24.0, 2.0) * 10.0) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn a_planar_cap_has_no_sharp_triangles() {
        for sides in [8, 24, 60] {
            let mesh = tube(sides, 40, 40.0, |_| 2.0);
            let patched = capped(&mesh, CapKind::Planar);
            for patch in [1, 2] {
                let least = angles(&lid(&patched, patch)).unwrap().min_deg;
                assert!(least >= 25.0, "{least} with {sides} sides");
            }
        }
    }

    #[test]
    fn a_smooth_cap_is_half_a_radius_high_and_continues_the_wall() {
        let mesh = tube(48, 80, 20.0, |_| 2.0);
        let patched = capped(&mesh, CapKind::Smooth);
        let top = patched.mesh.positions.iter().fold(f32::MIN, |top, p| top.max(p.z));
        assert!((top - 21.0).abs() < 0.02, "{top}");
        let bottom = patched.mesh.positions.iter().fold(f32::MAX, |bottom, p| bottom.min(p.z));
        assert!((bottom + 1.0).abs() < 0.02, "{bottom}");
        let topology = Topology::new(patched.mesh.positions.len(), &patched.mesh.triangles);
        let (ends, _) = open_ends(&mesh).unwrap();
        for (a, b) in ends.iter().flat_map(|end| edges(&end.rim)) {
            let normals: Vec<DVec3> = topology
                .triangles_on(&patched.mesh.triangles, a, b)
                .map(|t| patched.mesh.corners(t as usize).map(Vec3::as_dvec3))
                .map(|[a, b, c]| (b - a).cross(c - a).normalize())
                .collect();
            // A flat lid turns by 90 degrees; the dome by what its first triangles take of its curve.
            assert!(normals[0].dot(normals[1]) > libm::cos(20f64.to_radians()), "{}", normals[0].dot(normals[1]));
        }
        let area = patched.patches[1].area_mm2;
        assert!(area > PI * 4.0 * 1.1 && area < PI * 8.0, "between a disc and a hemisphere: {area}");
    }

    #[test]
    fn what_cannot_be_capped_is_refused() {
        let mesh = tube(24, 20, 20.0, |_| 2.0);
        let (ends, _) = open_ends(&mesh).unwrap();
        assert_eq!(cap(&mesh, &[], CapKind::Fan), Err(CapError::NoEnds));
        assert_eq!(cap(&mesh, &ends[..1], CapKind::Fan), Err(CapError::Holes { holes: 1 }));
        let twice = [ends[0].clone(), ends[0].clone()];
        assert!(matches!(cap(&mesh, &twice, CapKind::Fan), Err(CapError::Shared { .. })));
        let mut broken = mesh.clone();
        broken.positions[100].x = f32::NAN;
        assert!(matches!(cap(&broken, &ends, CapKind::Planar), Err(CapError::Surface(_))));
        let mut bent = mesh.clone();
        bent.positions[3].z -= 0.5;
        assert!(matches!(cap(&bent, &ends, CapKind::Planar), Err(CapError::Rim(RimError::NotPlanar { .. }))));
        let short = [OpenEnd { rim: vec![0, 1, 2], ..ends[0].clone() }, ends[1].clone()];
        assert!(matches!(cap(&mesh, &short, CapKind::Planar), Err(CapError::Rim(RimError::TooFew { .. }))));
        // Two vertices of the rim change places.
        let mut crossed = mesh.clone();
        crossed.positions.swap(4, 5);
        assert!(matches!(cap(&crossed, &ends, CapKind::Planar), Err(CapError::SelfCrossing { .. })));
        assert!(matches!(cap(&crossed, &ends, CapKind::Fan), Err(CapError::Folded { .. })));
        let mut same = mesh.clone();
        same.positions[4] = same.positions[5];
        assert!(matches!(cap(&same, &ends, CapKind::Planar), Err(CapError::SelfCrossing { .. })));
    }
}
