//! How well triangles are shaped, and how far two surfaces are apart.

use glam::Vec3;
use lumen_mesh::{SurfaceIndex, TriMesh, corner_angles, parallel, triangle_area};
use serde::{Deserialize, Serialize};

/// Distances are first looked at in one of this many triangles.
const SOME: usize = 64;
/// Triangles that one thread looks at, at a time.
const CHUNK: usize = 4096;

/// How well triangles are shaped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Quality {
    /// Mean of `4 sqrt(3) A` over the sum of the squared sides: 1 where all triangles are equilateral.
    pub mean: f64,
    /// Least angle of all triangles in degrees.
    pub least_angle_deg: f64,
    /// The part of the triangles with an angle below 30 degrees, 0 to 1.
    pub below_30_deg: f64,
}

/// Largest distances that were found between two surfaces, in mm, at vertices, at the middles of edges and of
/// triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Deviation {
    /// Of points of the new surface from the old one.
    pub to_old_mm: f64,
    /// Of points of the old surface from the new one.
    pub to_new_mm: f64,
}

impl Quality {
    /// Of the triangles of `mesh`; all 0 where there are none.
    ///
    /// # Panics
    /// When an index of a triangle is out of range.
    pub fn of(mesh: &TriMesh) -> Self {
        let (mut sum, mut least, mut below) = (0.0, 180.0f64, 0usize);
        for t in 0..mesh.triangles.len() {
            let corners = mesh.corners(t);
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let sides = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
            sum += if sides > 0.0 { 4.0 * 3.0f64.sqrt() * triangle_area(corners) / sides } else { 0.0 };
            let smallest = corner_angles(corners).into_iter().fold(180.0, f64::min);
            least = least.min(smallest);
            below += usize::from(smallest < 30.0);
        }
        let count = mesh.triangles.len();
        if count == 0 {
            return Self::default();
        }
        Self { mean: sum / count as f64, least_angle_deg: least, below_30_deg: below as f64 / count as f64 }
    }
}

/// Its corners, the middles of its sides and its own.
pub(super) fn samples([a, b, c]: [Vec3; 3]) -> [Vec3; 7] {
    [a, b, c, a.midpoint(b), b.midpoint(c), c.midpoint(a), middle([a, b, c])]
}

/// The mean of the corners.
pub(super) fn middle([a, b, c]: [Vec3; 3]) -> Vec3 {
    (a + b + c) / 3.0
}

/// The largest distance of a vertex, the middle of an edge or of a triangle.
pub(super) fn farthest(mesh: &TriMesh, from: &SurfaceIndex) -> f64 {
    // What is no farther than what was found does not matter.
    let of = |triangles: &mut dyn Iterator<Item = usize>, mut farthest: f32| {
        let mut last = 0;
        for p in triangles.flat_map(|t| samples(mesh.corners(t))) {
            if !from.is_within_from(p, farthest, &mut last) {
                farthest = from.nearest(p).map_or(farthest, |found| found.distance.max(farthest));
            }
        }
        farthest
    };
    let count = mesh.triangles.len();
    let at_some = of(&mut (0..count).step_by(SOME), 0.0);
    let at_all = parallel::map_ranges(count, CHUNK, |mut triangles| of(&mut triangles, at_some));
    f64::from(at_all.into_iter().fold(at_some, f32::max))
}
