//! The nearest point of a surface to a place whose nearest point nearby is known: found by walking over neighbouring
//! triangles while they come nearer.
//!
//! What is found is the nearest point of the triangles around it, and so on the same wall as where the walk began, even
//! where another wall is nearer. Its distance is never less than that of the nearest point of all.

use glam::{DVec3, Vec3};
use lumen_mesh::{TriangleProjection, closest_point_on_triangle};

use super::net::{NONE, Net, next, prev};

/// Triangles that a walk enters, at most.
const MOST: usize = 64;

/// A surface to walk on: corners of the triangles, and their half-edges' twins.
#[derive(Clone, Debug, Default)]
pub(super) struct Walk {
    faces: Vec<Face>,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    corners: [Vec3; 3],
    twins: [u32; 3],
}

/// Where a walk ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// The triangle.
    pub(super) triangle: u32,
    /// Weights of its corners: each 0 or more, with sum 1.
    pub(super) weights: [f32; 3],
    /// The point in mm.
    pub(super) point: Vec3,
    /// Squared distance in mm2; no number where the triangle has no side.
    pub(super) squared: f64,
}

/// The part of a triangle that is nearest, by the number of the half-edge that it is or that leaves it.
#[derive(Clone, Copy)]
enum Part {
    Face,
    Side(u32),
    Corner(u32),
}

struct Nearest {
    triangle: u32,
    part: Part,
    v: f64,
    w: f64,
    squared: f64,
}

impl Walk {
    /// On the triangles of a net, of which `number` has the new numbers, [`NONE`] for those that are not to be walked on;
    /// `count` is how many are.
    pub(super) fn on(net: &Net, count: usize, number: impl Fn(u32) -> u32) -> Self {
        let none = Face { corners: [Vec3::ZERO; 3], twins: [NONE; 3] };
        let mut faces = vec![none; count];
        for t in 0..net.patch.len() as u32 {
            let new = number(t);
            if new == NONE {
                continue;
            }
            let twins = [0, 1, 2].map(|i| {
                let g = net.twin(3 * t + i);
                let beside = if g == NONE { NONE } else { number(g / 3) };
                if beside == NONE { NONE } else { 3 * beside + g % 3 }
            });
            faces[new as usize] = Face { corners: net.corners(t), twins };
        }
        Self { faces }
    }

    /// Walks from a triangle to the point nearest to `p`, or to one whose squared distance is at most `enough`.
    pub(super) fn from(&self, start: u32, p: Vec3, enough: f64) -> Found {
        let p = p.as_dvec3();
        let mut best = self.project(start, p);
        for _ in 0..MOST {
            if best.squared <= enough {
                break;
            }
            let nearer = match best.part {
                Part::Face => None,
                Part::Side(h) => self.nearer(self.twin(h), p, best.squared),
                Part::Corner(h) => self.nearer_around(h, p, best.squared),
            };
            let Some(nearer) = nearer else { break };
            best = nearer;
        }
        let Nearest { triangle, v, w, squared, .. } = best;
        let u = (1.0 - v - w).max(0.0);
        let [a, b, c] = self.faces[triangle as usize].corners.map(Vec3::as_dvec3);
        let point = (a + (b - a) * v + (c - a) * w).as_vec3();
        Found { triangle, weights: [u as f32, v as f32, w as f32], point, squared }
    }

    #[inline]
    fn twin(&self, h: u32) -> u32 {
        self.faces[(h / 3) as usize].twins[(h % 3) as usize]
    }

    /// The triangle of `h`, if it is nearer than `squared`.
    #[inline]
    fn nearer(&self, h: u32, p: DVec3, squared: f64) -> Option<Nearest> {
        if h == NONE {
            return None;
        }
        Some(self.project(h / 3, p)).filter(|found| found.squared < squared)
    }

    /// The nearest triangle around the origin of `h` that is nearer than `squared`.
    fn nearer_around(&self, h: u32, p: DVec3, squared: f64) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut look = |h: u32| {
            let bound = best.as_ref().map_or(squared, |best| best.squared);
            best = self.nearer(h, p, bound).or(best.take());
        };
        let mut left = self.twin(prev(h));
        while left != NONE && left != h {
            look(left);
            left = self.twin(prev(left));
        }
        if left == NONE {
            // A rim: the others lie to the right.
            let mut right = self.twin(h);
            while right != NONE {
                look(right);
                right = self.twin(next(right));
            }
        }
        best
    }

    #[inline]
    fn project(&self, triangle: u32, p: DVec3) -> Nearest {
        let TriangleProjection { squared, v, w } = closest_point_on_triangle(p, self.faces[triangle as usize].corners);
        let h = 3 * triangle;
        // What is not inside has one of these weights to the bit.
        let part = match (v, w) {
            (0.0, 0.0) => Part::Corner(h),
            (1.0, 0.0) => Part::Corner(h + 1),
            (0.0, 1.0) => Part::Corner(h + 2),
            (_, 0.0) => Part::Side(h),
            (0.0, _) => Part::Side(h + 2),
            _ if v == 1.0 - w => Part::Side(h + 1),
            _ => Part::Face,
        };
        Nearest { triangle, part, v, w, squared }
    }
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::{icosphere, tube};
    use lumen_mesh::{SurfaceIndex, TriMesh};

    use super::*;

    fn walk(mesh: &TriMesh) -> Walk {
        let net = Net::new(&mesh.positions, &mesh.triangles, vec![0; mesh.triangles.len()]).unwrap();
        Walk::on(&net, mesh.triangles.len(), |t| t)
    }

    /// Places beside the surface, nearer than it bends.
    fn beside(mesh: &TriMesh, t: usize) -> Vec3 {
        let [a, b, c] = mesh.corners(t);
        a * 0.2 + b * 0.5 + c * 0.3 + (b - a).cross(c - a).normalize() * if t.is_multiple_of(2) { 0.3 } else { -0.3 }
    }

    #[test]
    fn a_walk_ends_where_the_nearest_point_is() {
        // Rims, corners of five triangles, and a bend to one side alone.
        for mesh in [icosphere(3, 4.0, Vec3::ONE), tube(24, 20, 10.0, |z| 2.0 + z / 10.0)] {
            let (walk, index) = (walk(&mesh), SurfaceIndex::new(&mesh.positions, &mesh.triangles));
            for t in 0..mesh.triangles.len() {
                let p = beside(&mesh, t);
                let nearest = f64::from(index.nearest(p).unwrap().distance);
                for start in (0..mesh.triangles.len()).filter(|&s| beside(&mesh, s).distance(p) < 2.0) {
                    let found = walk.from(start as u32, p, 0.0);
                    assert!((found.squared.sqrt() - nearest).abs() < 1e-5, "{t} from {start}");
                    let [a, b, c] = mesh.corners(found.triangle as usize);
                    let [u, v, w] = found.weights;
                    assert!((a * u + b * v + c * w).distance(found.point) < 1e-5);
                }
            }
        }
    }

    #[test]
    fn a_walk_may_end_as_soon_as_it_is_near_enough_and_says_how_near() {
        let mesh = icosphere(3, 4.0, Vec3::ZERO);
        let walk = walk(&mesh);
        let p = mesh.positions[0] * 1.1;
        let all = walk.from(700, p, 0.0);
        let some = walk.from(700, p, 4.0);
        assert!(some.squared <= 4.0 && some.squared >= all.squared);
        assert!((f64::from(some.point.distance(p)) - some.squared.sqrt()).abs() < 1e-5);
    }
}
