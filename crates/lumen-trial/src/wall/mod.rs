//! What the wire touches: the triangles of the level, as they are.

mod ridges;

use std::sync::Arc;

use glam::DVec3;

use self::ridges::ridges;
use lumen_mesh::{PointProjection, SurfaceIndex, Topology, TriMesh, Vec3, boundary_loops};
use lumen_pipeline::normals::{Weighting, vertex_normals};

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
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let capped = capped(&mesh, &topology);
        Self::of(mesh, capped, &topology)
    }

    /// Likewise, with its open ends left open: for wires that pass through them.
    pub fn open(mesh: Arc<TriMesh>) -> Self {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        Self::of(mesh.clone(), mesh, &topology)
    }

    fn of(mesh: Arc<TriMesh>, capped: Arc<TriMesh>, topology: &Topology) -> Self {
        let mut index = SurfaceIndex::new(&capped.positions, &capped.triangles);
        let sides = ridges(&mesh, topology, index.triangles());
        index.keep_sides(&sides);
        index.keep_planes();
        let normals = vertex_normals(&capped.positions, &capped.triangles, Weighting::Angle);
        Self { mesh, capped, index: Arc::new(index), normals }
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

    /// The normal of a triangle, of length 1; `None` if it has no area.
    pub(super) fn normal(&self, triangle: u32) -> Option<DVec3> {
        let [a, b, c] = self.capped.corners(triangle as usize).map(Vec3::as_dvec3);
        (b - a).cross(c - a).try_normalize()
    }

    /// The curvature of the wall along `way` at a triangle, in 1/mm, as the interpolated normal turns there; positive where the wall comes
    /// round the lumen, and 0 where it falls away.
    pub(super) fn curvature(&self, triangle: u32, way: DVec3) -> f64 {
        let [a, b, c] = self.capped.corners(triangle as usize).map(Vec3::as_dvec3);
        let [from, to_b, to_c] = self.capped.triangles[triangle as usize].map(|v| self.normals[v as usize].as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let area = ab.cross(ac);
        let turn = (to_b - from) * area.dot(way.cross(ac)) + (to_c - from) * area.dot(ab.cross(way));
        let curvature = turn.dot(way) / area.length_squared();
        if curvature > 0.0 { curvature } else { 0.0 }
    }

    /// Into the lumen, where the wire is at `p` and the wall is nearest at `projection`: the interpolated normal, so that
    /// facets are not felt, and the way from the wall where that is another one, at ridges and slivers.
    pub(super) fn inward(&self, p: DVec3, projection: &PointProjection) -> DVec3 {
        let corners = self.capped.triangles[projection.triangle as usize];
        let outward: DVec3 =
            corners.iter().zip(projection.barycentric).map(|(&v, w)| self.normals[v as usize].as_dvec3() * w).sum();
        let smooth = -outward.normalize_or_zero();
        let Some(away) = (p - projection.point).try_normalize() else { return smooth };
        let cosine = smooth.dot(away);
        let part = ((cosine - TRUSTED[1]) / (TRUSTED[0] - TRUSTED[1])).clamp(0.0, 1.0);
        away.lerp(smooth, part).normalize_or(away)
    }
}

/// The surface with a fan over each open end; the surface itself where there is none.
fn capped(mesh: &Arc<TriMesh>, topology: &Topology) -> Arc<TriMesh> {
    let loops = boundary_loops(topology);
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

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::SegmentProjection;
    use lumen_mesh::shapes::{icosphere, tube};

    /// Numbers from -1 to 1.
    fn random() -> impl FnMut() -> f64 {
        let mut state = 7u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 23) - 1.0
        }
    }

    #[test]
    fn a_tube_is_round_across_itself_alone() {
        let wall = Wall::open(Arc::new(tube(48, 20, 10.0, |_| 2.0)));
        for triangle in 0..48 * 18 {
            let middle: DVec3 = wall.mesh().corners(triangle).iter().map(|p| p.as_dvec3() / 3.0).sum();
            let out = middle.reject_from(DVec3::Z).normalize();
            let curvature = wall.curvature(triangle as u32, DVec3::Z.cross(out));
            assert!((curvature - 0.5).abs() < 0.02, "{curvature} at {middle}");
            assert!(wall.curvature(triangle as u32, DVec3::Z) < 0.02);
        }
    }

    #[test]
    fn without_valleys_the_inside_of_a_segment_is_as_near() {
        let mut random = random();
        let mut lumen = icosphere(3, 5.0, Vec3::ZERO);
        lumen.positions.iter_mut().for_each(|p| *p *= 1.0 + 0.1 * random() as f32);
        let whole = SurfaceIndex::new(&lumen.positions, &lumen.triangles);
        let wall = Wall::new(Arc::new(lumen));
        let mut point = || DVec3::new(random(), random(), random()) * 4.5;
        let mut inside = 0;
        for _ in 0..4000 {
            let a = point();
            let b = a + point() * 0.2;
            let [near_a, near_b] = [a, b].map(|p| whole.project_point(p, f64::INFINITY, u32::MAX).unwrap().distance);
            if whole.winding(a.as_vec3(), Vec3::Z) != 1 || whole.winding(b.as_vec3(), Vec3::Z) != 1 {
                continue;
            }
            let within = near_a.min(near_b) - 1e-9;
            let [of_all, of_ridges] = [&whole, wall.index().as_ref()].map(|index| index.project_segment(a, b, within));
            let distance = |found: Option<SegmentProjection>| found.map_or(within, |found| found.projection.distance);
            assert!((distance(of_all) - distance(of_ridges)).abs() < 1e-12, "{of_all:?} {of_ridges:?}");
            inside += usize::from(of_all.is_some());
        }
        assert!(inside > 100, "{inside}");
    }
}
