//! How well triangles are shaped, and how far two surfaces are apart.

use glam::Vec3;
use lumen_mesh::{SurfaceIndex, TriMesh, corner_angles, parallel, triangle_area};
use serde::{Deserialize, Serialize};

use super::net::Net;
use super::walk::Walk;

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

/// A surface that distances are measured from.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    /// A way over it, which gives an upper bound.
    pub(super) walk: &'a Walk,
    /// What knows the nearest point of all.
    pub(super) index: &'a SurfaceIndex,
}

impl Target<'_> {
    /// The nearest triangle and its distance, where an upper bound of that is known, squared.
    fn nearest_below(self, p: Vec3, squared: f64) -> Option<(u32, f32)> {
        /// Against rounding.
        const MARGIN: f64 = 1.001;
        let bound = (squared.sqrt() * MARGIN) as f32;
        let found = self.index.nearest_within(p, bound).or_else(|| self.index.nearest(p))?;
        Some((found.triangle, found.distance))
    }

    /// The larger of `farthest` and the distance of `p`, in mm. `near` is a triangle nearby, and then the one found.
    fn farther(self, p: Vec3, farthest: f32, near: &mut u32) -> f32 {
        let enough = f64::from(farthest) * f64::from(farthest);
        let found = self.walk.from(*near, p, enough);
        if found.squared <= enough {
            *near = found.triangle;
            return farthest;
        }
        // What is no farther than what was found does not matter.
        let Some((triangle, distance)) = self.nearest_below(p, found.squared) else { return farthest };
        *near = triangle;
        farthest.max(distance)
    }
}

/// The largest distance of a vertex, the middle of an edge or of a triangle, of these triangles of a net, in mm. Where the
/// net `is_on` the surface its vertices know where, and those that did not leave it lie on it.
pub(super) fn farthest(net: &Net, triangles: &[u32], from: Target, is_on: bool) -> f64 {
    let of = |triangles: &mut dyn Iterator<Item = &u32>, mut farthest: f32| {
        let mut near = 0;
        for &t in triangles {
            let corners = net.corners(t);
            if is_on {
                near = net.near[net.origin(3 * t) as usize];
            }
            farthest = from.farther(middle(corners), farthest, &mut near);
            for i in 0..3 {
                let h = 3 * t + i;
                let v = net.origin(h);
                let (p, q) = (corners[i as usize], corners[(i as usize + 1) % 3]);
                if net.is_edge(h) {
                    farthest = from.farther(p.midpoint(q), farthest, &mut near);
                }
                if net.out[v as usize] == h && (!is_on || net.is_adrift[v as usize]) {
                    farthest = from.farther(p, farthest, &mut near);
                }
            }
        }
        farthest
    };
    let at_some = of(&mut triangles.iter().step_by(SOME), 0.0);
    let ranges = parallel::map_ranges(triangles.len(), CHUNK, |range| of(&mut triangles[range].iter(), at_some));
    f64::from(ranges.into_iter().fold(at_some, f32::max))
}
