//! What the wire touches: the triangles of the level, as they are.

use std::sync::Arc;

use glam::DVec3;

use crate::mesh::{PointFoot, SurfaceIndex, Topology, TriMesh, boundary_loops};
use crate::pipeline::normals::{Weighting, vertex_normals};

/// A surface to be touched from inside.
#[derive(Debug)]
pub struct Wall {
    mesh: Arc<TriMesh>,
    index: Arc<SurfaceIndex>,
    /// Of each vertex, out of the lumen.
    normals: Vec<crate::mesh::Vec3>,
    is_closed: bool,
}

/// The largest angle between the way from the wall to the wire and the interpolated normal at which the latter alone
/// is the direction of contact, and the one from which on the former alone is; as cosines.
const TRUSTED: [f64; 2] = [0.87, 0.5];

impl Wall {
    /// Of a surface whose triangles look out of the lumen.
    pub fn new(mesh: Arc<TriMesh>) -> Self {
        let index = Arc::new(SurfaceIndex::new(&mesh.positions, &mesh.triangles));
        Self::with_index(mesh, index)
    }

    /// Likewise, with an index that was built from the same surface.
    pub fn with_index(mesh: Arc<TriMesh>, index: Arc<SurfaceIndex>) -> Self {
        let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Angle);
        let is_closed = boundary_loops(&Topology::new(mesh.positions.len(), &mesh.triangles)).is_empty();
        Self { mesh, index, normals, is_closed }
    }

    /// Whether the surface has no boundary, so that every point is inside or outside.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// The surface.
    pub fn mesh(&self) -> &Arc<TriMesh> {
        &self.mesh
    }

    /// Its index.
    pub fn index(&self) -> &Arc<SurfaceIndex> {
        &self.index
    }

    /// Into the lumen, where the wire is at `p` and the wall is nearest at `foot`: the interpolated normal, so that
    /// facets are not felt, and the way from the wall where that is another one, at ridges and slivers.
    pub(super) fn inward(&self, p: DVec3, foot: &PointFoot) -> DVec3 {
        let corners = self.mesh.triangles[foot.triangle as usize];
        let outward: DVec3 =
            corners.iter().zip(foot.barycentric).map(|(&v, w)| self.normals[v as usize].as_dvec3() * w).sum();
        let smooth = -outward.normalize_or_zero();
        let Some(away) = (p - foot.point).try_normalize() else { return smooth };
        let cosine = smooth.dot(away);
        let part = ((cosine - TRUSTED[1]) / (TRUSTED[0] - TRUSTED[1])).clamp(0.0, 1.0);
        away.lerp(smooth, part).normalize_or(away)
    }
}
