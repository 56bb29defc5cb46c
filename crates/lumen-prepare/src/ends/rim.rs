//! An open end of a surface: the planar boundary loop that an extension or a cap begins at.

use std::f64::consts::PI;

use glam::DVec3;
use lumen_mesh::cut::area_and_middle;
use lumen_mesh::{EdgeUse, Topology, TriMesh, boundary_loops};
use thiserror::Error;

use super::EndPlane;
use crate::PatchKind;

/// How far inside of an uneven opening its plane is, in radii.
const INWARDS: f64 = 0.1;
/// A loop of fewer vertices is the rim of a missing triangle and no vessel.
const FEWEST_SIDES: usize = 4;
/// A loop is planar where no vertex is farther than this part of its radius from its plane.
const PLANAR: f64 = 0.01;

/// Why a surface cannot be worked on.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SurfaceError {
    /// There is nothing to work on.
    #[error("the surface has no triangles")]
    NoTriangles,
    /// An index is out of range.
    #[error("triangle {triangle} has a vertex number that does not exist")]
    MissingVertex {
        /// Its number.
        triangle: usize,
    },
    /// A vertex comes twice in a triangle.
    #[error("triangle {triangle} has the same vertex twice")]
    RepeatedVertex {
        /// Its number.
        triangle: usize,
    },
    /// A coordinate is no number.
    #[error("vertex {vertex} has a coordinate that is not a finite number")]
    NotFinite {
        /// Its number.
        vertex: usize,
    },
}

/// Checks that every triangle has three different vertices that exist, and that every coordinate is finite.
///
/// # Errors
/// [`SurfaceError`], for the first triangle or vertex that fails.
pub fn check_surface(mesh: &TriMesh) -> Result<(), SurfaceError> {
    if mesh.triangles.is_empty() {
        return Err(SurfaceError::NoTriangles);
    }
    if let Some(vertex) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return Err(SurfaceError::NotFinite { vertex });
    }
    for (triangle, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        if a.max(b).max(c) as usize >= mesh.positions.len() {
            return Err(SurfaceError::MissingVertex { triangle });
        }
        if a == b || b == c || c == a {
            return Err(SurfaceError::RepeatedVertex { triangle });
        }
    }
    Ok(())
}

/// Why a loop is no open end.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RimError {
    /// Too few vertices.
    #[error("end {name} has {vertices} vertices; an open end has at least {FEWEST_SIDES}")]
    TooFew {
        /// The end.
        name: String,
        /// Vertices of the loop.
        vertices: usize,
    },
    /// The loop is not on the surface's boundary.
    #[error("end {name} is not a boundary loop of this surface at its vertex {vertex}")]
    NotBoundary {
        /// The end.
        name: String,
        /// Vertex of the surface.
        vertex: u32,
    },
    /// The loop encloses no area.
    #[error("end {name} encloses no area")]
    NoArea {
        /// The end.
        name: String,
    },
    /// The loop does not lie in a plane.
    #[error("end {name} is not planar: a vertex is {off_mm:.3} mm off its plane, of a radius of {radius_mm:.3} mm")]
    NotPlanar {
        /// The end.
        name: String,
        /// Largest distance of a vertex from the plane, in mm.
        off_mm: f64,
        /// Radius of a circle of the loop's area, in mm.
        radius_mm: f64,
    },
}

/// An open end of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenEnd {
    /// Its name: letters, digits, `_` and `-` alone.
    pub name: String,
    /// Inlet or outlet.
    pub kind: PatchKind,
    /// The vertices of the loop, in the direction in which the triangles of the surface run along it: clockwise seen
    /// from outside of the vessel.
    pub rim: Vec<u32>,
    /// Centroid of the area in the loop, in mm.
    pub centre: DVec3,
    /// Unit normal of its plane, out of the vessel.
    pub normal: DVec3,
    /// Area of the polygon, in mm2.
    pub area_mm2: f64,
}

impl OpenEnd {
    /// The open end along the boundary loop `rim` of `mesh`, whose adjacency is `topology`.
    ///
    /// # Errors
    /// [`RimError`], where the loop has too few vertices, is not a boundary loop in the direction of its triangles,
    /// encloses no area or is farther than a hundredth of its radius from a plane.
    pub fn new(
        mesh: &TriMesh,
        topology: &Topology,
        rim: Vec<u32>,
        name: String,
        kind: PatchKind,
    ) -> Result<Self, RimError> {
        if rim.len() < FEWEST_SIDES {
            return Err(RimError::TooFew { name, vertices: rim.len() });
        }
        let mut sorted = rim.clone();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(RimError::NotBoundary { name, vertex: pair[0] });
        }
        let exists = |v: u32| (v as usize) < topology.vertex_count().min(mesh.positions.len());
        // Triangles without an area may face either way: most of the length says how the loop runs.
        let is_open = |a: u32, b: u32| topology.edge(a, b).is_some_and(EdgeUse::is_boundary);
        if let Some((vertex, _)) = edges(&rim).find(|&(a, b)| !exists(a) || !exists(b) || !is_open(a, b)) {
            return Err(RimError::NotBoundary { name, vertex });
        }
        if forwards(mesh, topology, &rim) < 0.0 {
            return Err(RimError::NotBoundary { name, vertex: rim[0] });
        }
        let points: Vec<DVec3> = rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3()).collect();
        let Some((mean, normal)) = plane(&points) else { return Err(RimError::NoArea { name }) };
        let (signed, centre) = area_and_middle(&points, mean, normal);
        let radius_mm = (signed.abs() / PI).sqrt();
        let off_mm = points.iter().map(|&p| (p - mean).dot(normal).abs()).fold(0.0, f64::max);
        if off_mm > PLANAR * radius_mm {
            return Err(RimError::NotPlanar { name, off_mm, radius_mm });
        }
        Ok(Self { name, kind, rim, centre, normal, area_mm2: signed.abs() })
    }

    /// The same loop measured on `mesh`.
    pub(crate) fn measured(&self, mesh: &TriMesh, topology: &Topology) -> Result<Self, RimError> {
        Self::new(mesh, topology, self.rim.clone(), self.name.clone(), self.kind)
    }

    /// The radius of a circle of its area, in mm.
    pub fn radius_mm(&self) -> f64 {
        (self.area_mm2 / PI).sqrt()
    }

    /// The mean length of its edges on `mesh`, in mm.
    pub(crate) fn mean_edge(&self, mesh: &TriMesh) -> f64 {
        let at = |v: u32| mesh.positions[v as usize].as_dvec3();
        edges(&self.rim).map(|(a, b)| at(a).distance(at(b))).sum::<f64>() / self.rim.len() as f64
    }
}

/// The mean of a loop's points and its unit normal: along its vector area (Newell), which points out of the vessel where the
/// loop runs clockwise seen from outside. `None` where it encloses no area.
pub(crate) fn plane(points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    let area: DVec3 = pairs.map(|(&p, &q)| (q - mean).cross(p - mean)).sum();
    area.try_normalize().filter(|normal| normal.is_finite()).map(|normal| (mean, normal))
}

/// The edges of a loop.
pub(crate) fn edges(rim: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    rim.iter().copied().zip(rim.iter().copied().cycle().skip(1))
}

/// The length in mm of the edges of a loop along which the triangles run as it does, less that of the others.
pub(crate) fn forwards(mesh: &TriMesh, topology: &Topology, rim: &[u32]) -> f64 {
    let at = |v: u32| mesh.positions[v as usize].as_dvec3();
    let signed = edges(rim).map(|(a, b)| {
        let runs_on = topology.edge(a, b).is_some_and(|edge| edge.forward > 0);
        at(a).distance(at(b)) * if runs_on { 1.0 } else { -1.0 }
    });
    signed.sum()
}

/// The open ends that a surface has, one for each planar boundary loop, named by [`names`]; and why other loops are none.
///
/// # Errors
/// [`SurfaceError`].
pub fn open_ends(mesh: &TriMesh) -> Result<(Vec<OpenEnd>, Vec<RimError>), SurfaceError> {
    check_surface(mesh)?;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let (mut ends, mut refused) = (Vec::new(), Vec::new());
    for (number, rim) in boundary_loops(&topology).into_iter().enumerate() {
        match OpenEnd::new(mesh, &topology, rim, format!("loop_{}", number + 1), PatchKind::Outlet) {
            Ok(end) => ends.push(end),
            Err(error) => refused.push(error),
        }
    }
    let radii: Vec<f64> = ends.iter().map(OpenEnd::radius_mm).collect();
    for (end, (kind, name)) in ends.iter_mut().zip(names(&radii)) {
        (end.kind, end.name) = (kind, name);
    }
    Ok((ends, refused))
}

/// Planes just inside of the openings that do not lie in one, so that a cut there takes all of the rim away. Where an end is
/// too near a fork for a plane square to its centreline these are left.
///
/// # Errors
/// [`SurfaceError`].
pub fn planes_of_uneven_openings(mesh: &TriMesh) -> Result<Vec<EndPlane>, SurfaceError> {
    check_surface(mesh)?;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let planes = boundary_loops(&topology).into_iter().filter_map(|rim| {
        let end = OpenEnd::new(mesh, &topology, rim.clone(), String::new(), PatchKind::Outlet);
        let Err(RimError::NotPlanar { radius_mm, .. }) = end else { return None };
        let points: Vec<DVec3> = rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3()).collect();
        let (mean, normal) = plane(&points)?;
        let deepest = points.iter().map(|&p| (p - mean).dot(normal)).fold(0.0, f64::min);
        let arc_mm = INWARDS * radius_mm - deepest;
        Some(EndPlane {
            branch: None,
            at_end: false,
            centre: mean - normal * arc_mm,
            normal,
            radius_mm,
            roundness: 1.0,
            arc_mm,
        })
    });
    Ok(planes.collect())
}

/// What ends of these radii are and are called: the widest is the inlet, the others are outlet_1, outlet_2 and so on by
/// decreasing radius; of equal radii the earlier comes first.
pub fn names(radii: &[f64]) -> Vec<(PatchKind, String)> {
    let mut order: Vec<usize> = (0..radii.len()).collect();
    order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]));
    let mut names = vec![(PatchKind::Inlet, "inlet".to_owned()); radii.len()];
    for (rank, &end) in order.iter().enumerate().skip(1) {
        names[end] = (PatchKind::Outlet, format!("outlet_{rank}"));
    }
    names
}

#[cfg(test)]
mod tests {
    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::tube;

    use super::*;

    #[test]
    fn the_ends_of_a_tube_face_away_from_it_and_have_the_area_of_their_polygons() {
        let (ends, refused) = open_ends(&tube(24, 10, 20.0, |z| 2.0 + z / 20.0)).unwrap();
        assert!(refused.is_empty());
        let polygon = |radius: f64| 12.0 * radius * radius * libm::sin(PI / 12.0);
        let [low, high] = &ends[..] else { panic!("two ends") };
        assert!(low.normal.distance(-DVec3::Z) < 1e-6 && high.normal.distance(DVec3::Z) < 1e-6);
        assert!((low.area_mm2 - polygon(2.0)).abs() < 1e-5 && (high.area_mm2 - polygon(3.0)).abs() < 1e-5);
        assert!(low.centre.length() < 1e-5 && high.centre.distance(DVec3::Z * 20.0) < 1e-5);
        assert_eq!((low.name.as_str(), high.name.as_str()), ("outlet_1", "inlet"));
        assert_eq!((low.kind, high.kind), (PatchKind::Outlet, PatchKind::Inlet));
    }

    #[test]
    fn loops_that_are_no_ends_are_told_apart() {
        let mesh = tube(24, 10, 20.0, |_| 2.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let of = |mesh: &TriMesh, rim: Vec<u32>| {
            OpenEnd::new(mesh, &topology, rim, "a".to_owned(), PatchKind::Outlet).unwrap_err()
        };
        assert!(matches!(of(&mesh, vec![0, 1, 2]), RimError::TooFew { vertices: 3, .. }));
        assert!(matches!(of(&mesh, vec![0, 1, 2, 3]), RimError::NotBoundary { vertex: 3, .. }));
        assert!(matches!(of(&mesh, vec![0, 1, 2, 9999]), RimError::NotBoundary { .. }));
        let whole: Vec<u32> = (0..24).collect();
        let mut bent = mesh.clone();
        bent.positions[3].z -= 0.5;
        assert!(matches!(of(&bent, whole.clone()), RimError::NotPlanar { .. }));
        let mut flat = mesh.clone();
        flat.positions.iter_mut().for_each(|p| *p = Vec3::ONE);
        assert!(matches!(of(&flat, whole), RimError::NoArea { .. }));
    }

    #[test]
    fn broken_surfaces_are_refused() {
        let mesh = tube(8, 2, 2.0, |_| 1.0);
        let mut broken = mesh.clone();
        broken.positions[3].y = f32::NAN;
        assert_eq!(open_ends(&broken), Err(SurfaceError::NotFinite { vertex: 3 }));
        let mut broken = mesh.clone();
        broken.triangles[5][1] = 10_000;
        assert_eq!(open_ends(&broken), Err(SurfaceError::MissingVertex { triangle: 5 }));
        let mut broken = mesh;
        broken.triangles[5] = [1, 1, 2];
        assert_eq!(open_ends(&broken), Err(SurfaceError::RepeatedVertex { triangle: 5 }));
        assert_eq!(open_ends(&TriMesh::default()), Err(SurfaceError::NoTriangles));
    }

    #[test]
    fn the_widest_end_is_the_inlet_and_outlets_go_by_their_radius() {
        let named: Vec<String> = names(&[1.0, 4.0, 2.0, 2.0]).into_iter().map(|(_, name)| name).collect();
        assert_eq!(named, ["outlet_3", "inlet", "outlet_1", "outlet_2"]);
        assert!(names(&[]).is_empty());
    }
}
