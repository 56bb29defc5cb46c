//! What a place on the surface sees: the triangle that a ray from there meets first, and whether the space before it is
//! closed nearly all around.

use glam::DVec3;

use crate::{Components, SurfaceIndex, TriMesh};

/// Two sides are nearly parallel below 60 degrees.
pub(super) const PARALLEL: f64 = 0.5;
/// Of nine directions, those that must end at the surface in a space that is closed nearly all around.
const CLOSED: usize = 8;

/// A place on a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) triangle: u32,
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
}

impl Place {
    pub(super) fn on(mesh: &TriMesh, triangle: u32) -> Option<Self> {
        let [a, b, c] = mesh.corners(triangle as usize).map(glam::Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).try_normalize()?;
        Some(Self { triangle, point: (a + b + c) / 3.0, normal })
    }
}

/// What is looked at.
pub(super) struct Visibility<'a> {
    pub(super) mesh: &'a TriMesh,
    pub(super) index: &'a SurfaceIndex,
    pub(super) pieces: &'a Components,
}

impl Visibility<'_> {
    pub(super) fn piece(&self, triangle: u32) -> u32 {
        self.pieces.of_triangle[triangle as usize]
    }

    /// What a ray from a place meets first, and the cosine between the normals there.
    pub(super) fn met(&self, from: &Place, direction: DVec3) -> Option<(f64, u32, f64)> {
        let (depth, triangle) = self.index.first_met(from.point, direction, f64::INFINITY, from.triangle)?;
        let there = Place::on(self.mesh, triangle)?;
        Some((depth, triangle, from.normal.dot(there.normal)))
    }

    /// Whether what lies before a place is closed nearly all around.
    pub(super) fn lines_a_space(&self, place: &Place) -> bool {
        let right = place.normal.any_orthonormal_vector();
        let up = place.normal.cross(right);
        // Straight out, and at 60 degrees from there all around.
        let tilted = (0..8).map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / 8.0;
            place.normal * 0.5 + (right * libm::cos(angle) + up * libm::sin(angle)) * 0.75f64.sqrt()
        });
        let ends =
            |&direction: &DVec3| self.index.first_met(place.point, direction, f64::INFINITY, place.triangle).is_some();
        std::iter::once(place.normal).chain(tilted).filter(ends).count() >= CLOSED
    }
}
