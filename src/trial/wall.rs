//! What the wire touches: the triangles of the level, as they are.

use std::sync::Arc;

use glam::DVec3;

use crate::mesh::{PointFoot, SurfaceIndex, Topology, TriMesh, Vec3, boundary_loops};
use crate::pipeline::normals::{Weighting, vertex_normals};

/// A surface to be touched from inside. Its open ends are closed by fans around their middles: what lies beyond is not
/// known, and there the wire stops.
#[derive(Debug)]
pub struct Wall {
    mesh: Arc<TriMesh>,
    /// The surface with its fans.
    capped: Arc<TriMesh>,
    index: Arc<SurfaceIndex>,
    /// Of each vertex, out of the lumen.
    normals: Vec<Vec3>,
}

/// The largest angle between the way from the wall to the wire and the interpolated normal at which the latter alone
/// is the direction of contact, and the one from which on the former alone is; as cosines.
const TRUSTED: [f64; 2] = [0.87, 0.5];

impl Wall {
    /// Of a surface whose triangles look out of the lumen.
    pub fn new(mesh: Arc<TriMesh>) -> Self {
        let capped = capped(&mesh);
        Self::of(mesh, capped)
    }

    /// Likewise, with its open ends left open: for wires that pass through them.
    pub fn open(mesh: Arc<TriMesh>) -> Self {
        Self::of(mesh.clone(), mesh)
    }

    fn of(mesh: Arc<TriMesh>, capped: Arc<TriMesh>) -> Self {
        let index = Arc::new(SurfaceIndex::new(&capped.positions, &capped.triangles));
        let normals = vertex_normals(&capped.positions, &capped.triangles, Weighting::Angle);
        Self { mesh, capped, index, normals }
    }

    /// Whether there are no open ends, so that the index is that of the surface itself.
    pub fn is_closed(&self) -> bool {
        Arc::ptr_eq(&self.mesh, &self.capped)
    }

    /// Whether a triangle is of the surface, and not of a fan over an open end.
    pub fn is_vessel(&self, triangle: u32) -> bool {
        (triangle as usize) < self.mesh.triangles.len()
    }

    /// The surface.
    pub fn mesh(&self) -> &Arc<TriMesh> {
        &self.mesh
    }

    /// The index of the surface with its fans, whose triangles come last.
    pub fn index(&self) -> &Arc<SurfaceIndex> {
        &self.index
    }

    /// Into the lumen, where the wire is at `p` and the wall is nearest at `foot`: the interpolated normal, so that
    /// facets are not felt, and the way from the wall where that is another one, at ridges and slivers.
    pub(super) fn inward(&self, p: DVec3, foot: &PointFoot) -> DVec3 {
        let corners = self.capped.triangles[foot.triangle as usize];
        let outward: DVec3 =
            corners.iter().zip(foot.barycentric).map(|(&v, w)| self.normals[v as usize].as_dvec3() * w).sum();
        let smooth = -outward.normalize_or_zero();
        let Some(away) = (p - foot.point).try_normalize() else { return smooth };
        let cosine = smooth.dot(away);
        let part = ((cosine - TRUSTED[1]) / (TRUSTED[0] - TRUSTED[1])).clamp(0.0, 1.0);
        away.lerp(smooth, part).normalize_or(away)
    }
}

/// The surface with a fan over each open end; the surface itself where there is none.
fn capped(mesh: &Arc<TriMesh>) -> Arc<TriMesh> {
    let loops = boundary_loops(&Topology::new(mesh.positions.len(), &mesh.triangles));
    if loops.is_empty() {
        return mesh.clone();
    }
    let mut capped = (**mesh).clone();
    for around in loops {
        let sum: DVec3 = around.iter().map(|&v| mesh.positions[v as usize].as_dvec3()).sum();
        let middle = capped.positions.len() as u32;
        capped.positions.push((sum / around.len().max(1) as f64).as_vec3());
        for (i, &a) in around.iter().enumerate() {
            capped.triangles.push([around[(i + 1) % around.len()], a, middle]);
        }
    }
    Arc::new(capped)
}
