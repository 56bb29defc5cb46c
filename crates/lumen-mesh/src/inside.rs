//! On which side of a surface a point lies: by the pseudonormal at the nearest point.
//!
//! Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal" (2005): on a face its
//! normal, on an edge the sum of the normals of its faces, on a vertex their sum weighted by the angles there. The sign
//! of the offset from the nearest point against it is right for every closed surface without self-intersections. Where
//! the nearest point lies on an open end, there is no saying.

use glam::{DVec3, Vec3};

use super::{Nearest, Topology, TriMesh, opposite};

/// Closer to a side of its triangle than this, as a barycentric weight, a nearest point counts as on it.
const ON_SIDE: f32 = 1e-5;

/// The sides of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Sides<'a> {
    mesh: &'a TriMesh,
    topology: &'a Topology,
}

impl<'a> Sides<'a> {
    /// Of a surface and its adjacency.
    pub fn new(mesh: &'a TriMesh, topology: &'a Topology) -> Self {
        Self { mesh, topology }
    }

    /// Whether `p` lies outside; `nearest` is the nearest point of this surface to it. `None` where that point lies on
    /// an open end.
    pub fn is_outside(&self, p: Vec3, nearest: &Nearest) -> Option<bool> {
        let triangle = self.mesh.triangles[nearest.triangle as usize];
        let touched: Vec<u32> = (0..3).filter(|&i| nearest.barycentric[i] > ON_SIDE).map(|i| triangle[i]).collect();
        let normal = match touched[..] {
            [v] => self.vertex_normal(v)?,
            [v, w] => self.edge_normal(v, w)?,
            _ => self.face_normal(nearest.triangle),
        };
        Some((p.as_dvec3() - nearest.point.as_dvec3()).dot(normal) > 0.0)
    }

    fn face_normal(&self, t: u32) -> DVec3 {
        let [a, b, c] = self.mesh.corners(t as usize).map(Vec3::as_dvec3);
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// `None` on an open end.
    fn edge_normal(&self, v: u32, w: u32) -> Option<DVec3> {
        if self.topology.edge(v, w)?.is_boundary() {
            return None;
        }
        let around = self.topology.triangles(v).iter();
        Some(around.filter(|&&t| self.mesh.triangles[t as usize].contains(&w)).map(|&t| self.face_normal(t)).sum())
    }

    /// `None` on an open end.
    fn vertex_normal(&self, v: u32) -> Option<DVec3> {
        if self.topology.edge_uses(v).iter().any(|edge| edge.is_boundary()) {
            return None;
        }
        Some(self.topology.triangles(v).iter().map(|&t| self.face_normal(t) * self.angle(t, v)).sum())
    }

    /// The angle of triangle `t` at its vertex `v`, in radians.
    fn angle(&self, t: u32, v: u32) -> f64 {
        let [one, other] = opposite(self.mesh.triangles[t as usize], v);
        let [at, one, other] = [v, one, other].map(|v| self.mesh.positions[v as usize].as_dvec3());
        let (e, f) = (one - at, other - at);
        libm::atan2(e.cross(f).length(), e.dot(f))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SurfaceIndex;
    use crate::shapes::{icosphere, tube};

    fn outside(mesh: &TriMesh, p: Vec3) -> Option<bool> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let nearest = SurfaceIndex::new(&mesh.positions, &mesh.triangles).nearest(p).unwrap();
        Sides::new(mesh, &topology).is_outside(p, &nearest)
    }

    #[test]
    fn points_are_where_their_distance_from_the_middle_says() {
        let sphere = icosphere(2, 10.0, Vec3::ONE);
        for direction in [Vec3::X, Vec3::new(0.3, -2.0, 0.7), Vec3::new(-1.0, 1.0, 1.0)].map(Vec3::normalize) {
            for (distance, expected) in [(0.1, false), (5.0, false), (9.5, false), (10.2, true), (30.0, true)] {
                assert_eq!(
                    outside(&sphere, Vec3::ONE + direction * distance),
                    Some(expected),
                    "{direction} {distance}"
                );
            }
        }
    }

    #[test]
    fn over_a_sharp_edge_and_a_sharp_corner_the_pseudonormal_decides() {
        // A thin wedge: its faces' normals alone would call points beyond the edge inside or outside at random.
        let positions = [[0, 0, 0], [20, 0, 1], [20, 0, -1], [0, 9, 0], [20, 9, 1], [20, 9, -1]];
        let positions = positions.iter().map(|p| Vec3::from(p.map(|x| x as f32))).collect();
        let triangles = vec![[0, 2, 1], [3, 4, 5], [0, 4, 3], [0, 1, 4], [0, 5, 2], [0, 3, 5], [1, 5, 4], [1, 2, 5]];
        let wedge = TriMesh { positions, triangles };
        for p in [
            Vec3::new(-1.0, 4.0, 0.3),
            Vec3::new(-1.0, 4.0, -0.3),
            Vec3::new(-1.0, -1.0, 0.1),
            Vec3::new(-0.2, 9.5, 0.0),
        ] {
            assert_eq!(outside(&wedge, p), Some(true), "{p}");
        }
        assert_eq!(outside(&wedge, Vec3::new(10.0, 4.0, 0.2)), Some(false));
    }

    #[test]
    fn beyond_an_open_end_there_is_no_saying() {
        let open = tube(16, 10, 10.0, |_| 2.0);
        assert_eq!(outside(&open, Vec3::new(0.5, 0.0, 5.0)), Some(false));
        assert_eq!(outside(&open, Vec3::new(2.5, 0.0, 5.0)), Some(true));
        assert_eq!(outside(&open, Vec3::new(1.0, 0.0, 12.0)), None);
    }
}
