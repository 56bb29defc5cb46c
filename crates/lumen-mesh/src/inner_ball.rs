//! The lumen at a point of its wall: the largest ball inside the surface that touches it there.
//!
//! The shrinking ball of Ma, Bae and Choi ("3D medial axis point approximation using nearest neighbors and the normal
//! field", 2012): of a ball that touches the wall at `p` and holds a point `q` of the surface, only the smaller one
//! through both can be empty; with `d` the inward normal its radius is `|q - p|^2 / (2 d.(q - p))`. The balls at `p` are
//! nested, so the hierarchy of boxes is searched once, with a ball that shrinks on the way. Unlike in the paper, `q` is
//! any point of a triangle, not only a vertex: the walls of a coarse level have few.
//!
//! Robust against noise: `q` counts only if it is seen from `p` within 15 degrees of the inward normal (the walls then
//! face each other: the separation angle of the paper is at least 150 degrees) and if its triangle is seen from inside.
//! The inward normal itself is followed first: where it meets no wall there is no ball, and where it meets one the ball
//! is small before the search begins. Bumps and stair-steps beside `p`, which would shrink the ball to their own size, are thus left out. What an error of
//! the normal does is small: 10 degrees make a tube up to 6 % too narrow.
//!
//! [`inner_radii`] finds the balls of a whole surface. Where vertices lie much closer together than the walls, their balls
//! hardly differ: a vertex within a fifth of a ball's radius of the vertex that it was found at takes its radius over.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3, Vec4};

use super::ball::Ball;
use super::nearest::{Leaf, Node, STACK, SurfaceIndex};
use super::ray::Hit;
use super::{Topology, TriMesh};
use crate::task::{Yielder, at_once};

/// Cosine and sine of 15 degrees, the half-angle of the cone in which a wall faces another.
const FACING: [f64; 2] = [0.965_925_826_289_068_3, 0.258_819_045_102_520_7];
/// A ball is small enough when the next is not smaller by more than this part.
const ENOUGH: f64 = 1e-6;
/// By what the squared distance from a plane may be off in f32: of the squared distance from a corner.
const OF_PLANE: f32 = 2e-4;
/// Steps on one triangle. Each lands on the triangle's nearest point to a smaller ball; two or three do.
const STEPS: usize = 8;

/// A vertex this near to another, as a part of that one's radius, takes its radius over.
const NEAR: f32 = 0.2;

/// Balls between two looks at the clock.
const BALLS: usize = 64;

/// The inner balls of a surface.
#[derive(Clone, Debug, Default)]
pub struct InnerRadii {
    /// Radius at each vertex in mm, infinite where no wall faces it.
    pub radii: Vec<f32>,
    /// The vertices whose balls were found, ascending; the others took theirs over.
    pub own: Vec<u32>,
}

impl InnerRadii {
    /// The ball that touches the wall at vertex `v`; `None` where no wall faces it. `mesh` and `topology` are those of the
    /// surface that they were found in.
    pub fn ball(&self, mesh: &TriMesh, topology: &Topology, v: u32) -> Option<Ball> {
        let radius = self.radii[v as usize];
        let normal = outward_normal(mesh, topology, v).filter(|_| radius.is_finite())?;
        Some(Ball { centre: mesh.positions[v as usize] - normal * radius, radius })
    }
}

/// The inner balls of a surface; `topology` and `index` must be those of `mesh`.
pub fn inner_radii(mesh: &TriMesh, topology: &Topology, index: &SurfaceIndex) -> InnerRadii {
    at_once(inner_radii_in_slices(mesh, topology, index, &Yielder::never()))
}

/// As [`inner_radii`], resting every fraction of a millisecond.
pub async fn inner_radii_in_slices(
    mesh: &TriMesh,
    topology: &Topology,
    index: &SurfaceIndex,
    yielder: &Yielder,
) -> InnerRadii {
    let vertices = topology.vertex_count();
    // No ball inside of a surface is larger than its box.
    let limit = mesh.bounds().diagonal().min(f32::MAX);
    // Not a number where it is not known yet.
    let (mut radii, mut own) = (vec![f32::NAN; vertices], Vec::new());
    let (mut queue, mut found) = (Vec::new(), 0);
    for v in 0..vertices {
        if !radii[v].is_nan() {
            continue;
        }
        let normal = outward_normal(mesh, topology, v as u32);
        let ball = normal.and_then(|normal| index.inner_ball(mesh.positions[v], normal, limit));
        radii[v] = ball.map_or(f32::INFINITY, |ball| ball.radius);
        if ball.is_some() {
            own.push(v as u32);
            spread(mesh, topology, &mut radii, v as u32, &mut queue);
        }
        found += 1;
        if found % BALLS == 0 {
            yielder.rest((v + 1) as f32 / vertices as f32).await;
        }
    }
    InnerRadii { radii, own }
}

/// Gives the radius at `v` to the vertices around that are near and have none; `queue` is room for them.
fn spread(mesh: &TriMesh, topology: &Topology, radii: &mut [f32], v: u32, queue: &mut Vec<u32>) {
    let (radius, p) = (radii[v as usize], mesh.positions[v as usize]);
    let reach = NEAR * radius;
    if !radius.is_finite() {
        return;
    }
    queue.push(v);
    while let Some(v) = queue.pop() {
        for &n in topology.neighbours(v) {
            if radii[n as usize].is_nan() && mesh.positions[n as usize].distance(p) <= reach {
                radii[n as usize] = radius;
                queue.push(n);
            }
        }
    }
}

/// The outward normal at vertex `v`, weighted by area; `None` where the triangles have none.
pub fn outward_normal(mesh: &TriMesh, topology: &Topology, v: u32) -> Option<Vec3> {
    let mut sum = DVec3::ZERO;
    for &t in topology.triangles(v) {
        let [a, b, c] = mesh.corners(t as usize).map(Vec3::as_dvec3);
        sum += (b - a).cross(c - a);
    }
    sum.try_normalize().map(DVec3::as_vec3).filter(|normal| normal.is_finite())
}

/// The ball at a point, while it shrinks.
struct Shrinking {
    p: DVec3,
    inward: DVec3,
    radius: f64,
}

impl Shrinking {
    fn centre(&self) -> DVec3 {
        self.p + self.inward * self.radius
    }

    /// Shrinks the ball to the triangle, if that faces `p` and reaches into the ball.
    fn shrink_to(&mut self, leaf: &Leaf) -> bool {
        let [a, b, c] = leaf.corners.map(Vec3::as_dvec3);
        if (b - a).cross(c - a).dot(self.inward) <= 0.0 {
            return false;
        }
        let before = self.radius;
        for _ in 0..STEPS {
            let projection = leaf.project_point(self.centre().as_vec3());
            let to = a + (b - a) * projection.v + (c - a) * projection.w - self.p;
            let depth = to.dot(self.inward);
            let squared = to.length_squared();
            let faces = depth > 0.0 && depth * depth >= FACING[0] * FACING[0] * squared;
            let radius = squared / (2.0 * depth);
            if faces && radius < self.radius * (1.0 - ENOUGH) {
                self.radius = radius;
            } else {
                break;
            }
        }
        self.radius < before
    }
}

impl SurfaceIndex {
    /// The largest ball of at most `limit` mm that touches the surface from inside at `p`, a point of it with outward
    /// normal `normal` (of length 1). `None` where no wall faces `p` within that ball.
    pub fn inner_ball(&self, p: Vec3, normal: Vec3, limit: f32) -> Option<Ball> {
        if !(p.is_finite() && normal.is_finite() && limit.is_finite() && limit > 0.0) {
            return None;
        }
        let limit = f64::from(limit);
        let mut ball = Shrinking { p: p.as_dvec3(), inward: -normal.as_dvec3(), radius: limit };
        self.shoot(&mut ball);
        if ball.radius >= limit {
            return None;
        }
        let mut stack = ArrayVec::<(u32, u8), STACK>::new();
        if !self.nodes.is_empty() {
            stack.push((0, 0));
        }
        let (mut extent, cone) = (Extent::of(&ball), Cone::of(&ball));
        while let Some((child, count)) = stack.pop() {
            if count > 0 {
                for leaf in &self.leaves[child as usize..child as usize + usize::from(count)] {
                    if !extent.misses(leaf) && ball.shrink_to(leaf) {
                        extent = Extent::of(&ball);
                    }
                }
                continue;
            }
            let node = &self.nodes[child as usize];
            let distances = node.squared_distances(&extent.centre);
            let faces = cone.reaches(node);
            let bottom = stack.len();
            for (lane, &squared) in distances.iter().enumerate().take(usize::from(node.used)) {
                if squared <= extent.squared && faces >> lane & 1 != 0 {
                    stack.push((node.child[lane], node.count[lane]));
                    let top = stack.len();
                    // The nearest is looked at first.
                    if top - bottom > 1 && squared > distances[..lane].iter().copied().fold(f32::INFINITY, f32::min) {
                        stack.swap(top - 1, top - 2);
                    }
                }
            }
        }
        let centre = ball.centre().as_vec3();
        Some(Ball { centre, radius: ball.radius as f32 })
    }

    /// The inner ball at the place of the surface that is nearest to `p`: where it touches, and the ball. Its normal is
    /// between those of the triangle's corners, by the place in it. `positions` and `triangles` are those of the index;
    /// all of the triangles are looked at.
    pub fn inner_ball_beside(
        &self,
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        p: Vec3,
        limit: f32,
    ) -> Option<(Vec3, Ball)> {
        let nearest = self.nearest(p)?;
        let corners = *triangles.get(nearest.triangle as usize)?;
        let mut normals = [DVec3::ZERO; 3];
        for triangle in triangles {
            if !triangle.iter().any(|v| corners.contains(v)) {
                continue;
            }
            let [a, b, c] = triangle.map(|v| positions[v as usize].as_dvec3());
            let area = (b - a).cross(c - a);
            for (normal, corner) in normals.iter_mut().zip(corners) {
                if triangle.contains(&corner) {
                    *normal += area;
                }
            }
        }
        let weighted = normals.iter().zip(nearest.barycentric);
        let sum: DVec3 = weighted.map(|(normal, weight)| normal.normalize_or_zero() * f64::from(weight)).sum();
        let normal = sum.try_normalize()?.as_vec3();
        Some((nearest.point, self.inner_ball(nearest.point, normal, limit)?))
    }

    /// A first, small ball: as deep as the inward normal goes before it leaves the surface.
    fn shoot(&self, ball: &mut Shrinking) {
        let (p, inward) = (ball.p, ball.inward);
        self.along(p, inward, 2.0 * ball.radius, |leaf, farthest| {
            if let Some(hit) = Hit::of(p, inward, leaf.corners).filter(|hit| hit.is_outward) {
                ball.radius = ball.radius.min(hit.depth / 2.0);
                *farthest = 2.0 * ball.radius;
            }
        });
    }
}

/// The cone in which walls face a point.
struct Cone {
    apex: [Vec4; 3],
    axis: [Vec4; 3],
}

impl Cone {
    fn of(ball: &Shrinking) -> Self {
        let lanes = |v: DVec3| v.as_vec3().to_array().map(Vec4::splat);
        Self { apex: lanes(ball.p), axis: lanes(ball.inward) }
    }

    /// A bit for each child whose box may reach into the cone: the ball around the box does.
    #[inline]
    fn reaches(&self, node: &Node) -> u32 {
        let (mut depth, mut squared, mut size) = (Vec4::ZERO, Vec4::ZERO, Vec4::ZERO);
        for axis in 0..3 {
            let half = (node.max[axis] - node.min[axis]) * 0.5;
            let to = (node.max[axis] + node.min[axis]) * 0.5 - self.apex[axis];
            depth += to * self.axis[axis];
            squared += to * to;
            size += half * half;
        }
        // How far the middle of the box lies out of the cone is its distance across the axis, seen along the side.
        let across = (squared - depth * depth).max(Vec4::ZERO);
        let out = across.map(f32::sqrt) * FACING[0] as f32 - depth * FACING[1] as f32;
        let allowed = size.map(f32::sqrt) + squared.map(f32::sqrt) * 1e-3;
        out.cmple(allowed).bitmask()
    }
}

/// A ball as boxes and planes are compared with it, with an allowance for rounding.
struct Extent {
    centre: [Vec4; 3],
    middle: Vec3,
    inward: Vec3,
    squared: f32,
}

impl Extent {
    fn of(ball: &Shrinking) -> Self {
        let middle = ball.centre().as_vec3();
        let squared = (ball.radius * ball.radius * (1.0 + 1e-5)) as f32;
        Self { centre: middle.to_array().map(Vec4::splat), middle, inward: ball.inward.as_vec3(), squared }
    }

    /// Whether a triangle does not reach into the ball, or looks away: f32 knows that of nearly all, but of no sliver.
    #[inline]
    fn misses(&self, leaf: &Leaf) -> bool {
        let [a, b, c] = leaf.corners;
        let (normal, from) = ((b - a).cross(c - a), a - self.middle);
        // What reaches into the ball has a plane that does.
        let (height, size) = (normal.dot(from), normal.length_squared());
        let is_far = height * height > (self.squared + OF_PLANE * from.length_squared()) * size;
        let looks_away = normal.dot(self.inward) < -1e-3 * size.sqrt();
        !leaf.is_sliver && (looks_away || is_far && height > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::shapes::{icosphere, sagitta, square, tube};
    use crate::task::{Budget, Progress, Running};

    fn balls(mesh: &TriMesh, limit: f32) -> Vec<Option<Ball>> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let ball = |v: usize| index.inner_ball(mesh.positions[v], outward_normal(mesh, &topology, v as u32)?, limit);
        (0..mesh.positions.len()).map(ball).collect()
    }

    #[test]
    fn in_a_sphere_every_ball_is_the_sphere() {
        let centre = Vec3::new(40.0, -7.0, 300.0);
        let sphere = icosphere(4, 12.0, centre);
        // The normals are right to half a degree, 0.1 mm at 12 mm.
        let slack = sagitta(&sphere, 12.0, centre) + 0.1;
        for ball in balls(&sphere, 100.0) {
            let ball = ball.unwrap();
            assert!((ball.radius - 12.0).abs() < slack && ball.centre.distance(centre) < slack, "{ball:?}");
        }
    }

    #[test]
    fn in_a_tube_the_ball_has_its_radius_and_lies_on_its_axis() {
        for sides in [8, 16, 64] {
            let mesh = tube(sides, 80, 40.0, |_| 0.75);
            // The wall between two vertices is nearer by this.
            let slack = 0.75 * (1.0 - (std::f32::consts::PI / sides as f32).cos()) + 1e-4;
            for (ball, p) in balls(&mesh, 20.0).iter().zip(&mesh.positions) {
                let ball = ball.unwrap();
                assert!((ball.radius - 0.75).abs() < slack, "{sides}: {ball:?}");
                assert!(ball.centre.truncate().length() < slack && (ball.centre.z - p.z).abs() < 0.05, "{ball:?}");
            }
        }
    }

    #[test]
    fn no_ball_is_wider_than_all_slivers_one_by_one_leave_it() {
        // Walls 400 mm long, aslant to all axes.
        let turn = glam::Quat::from_rotation_arc(Vec3::Z, Vec3::new(1.0, 1.1, 0.9).normalize());
        for sides in [24, 64, 200] {
            let mut mesh = tube(sides, 1, 400.0, |_| 0.5);
            mesh.positions.iter_mut().for_each(|p| *p = turn * *p);
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
            let mut count = 0;
            for v in 0..mesh.positions.len() {
                let Some(normal) = outward_normal(&mesh, &topology, v as u32) else { continue };
                let Some(found) = index.inner_ball(mesh.positions[v], normal, 100.0) else { continue };
                // A hair wider, so that it is the walls that make it narrower again.
                let (p, radius) = (mesh.positions[v].as_dvec3(), f64::from(found.radius) * 1.0001);
                let mut ball = Shrinking { p, inward: -normal.as_dvec3(), radius };
                let mut has_shrunk = true;
                while std::mem::take(&mut has_shrunk) {
                    index.leaves.iter().for_each(|leaf| has_shrunk |= ball.shrink_to(leaf));
                }
                assert!(f64::from(found.radius) / ball.radius - 1.0 < 2e-5, "{v}: {found:?}, {}", ball.radius);
                count += 1;
            }
            assert!(count > mesh.positions.len() / 3, "{count}");
        }
    }

    #[test]
    fn slivers_that_stand_in_several_leaves_count_once() {
        // Six walls of two triangles each, 400 mm long and half a millimetre wide, aslant to all axes.
        let mut mesh = tube(6, 1, 400.0, |_| 0.5);
        let turn = glam::Quat::from_rotation_arc(Vec3::Z, Vec3::new(1.0, 1.1, 0.9).normalize());
        mesh.positions.iter_mut().for_each(|p| *p = turn * *p);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        assert!(index.leaves.len() > 2 * mesh.triangles.len(), "the slivers are not cut");
        let across = [0.3f32, 1.7, 4.4].map(|angle| turn * Vec3::new(angle.cos(), angle.sin(), 0.0));
        for direction in across {
            assert_eq!(index.winding(turn * Vec3::new(0.02, 0.01, 190.0), direction), 1);
            assert_eq!(index.winding(turn * Vec3::new(2.0, 0.0, 190.0) - direction * 5.0, direction), 0);
        }
        let mut numbers: Vec<u32> = index.triangles().collect();
        numbers.sort_unstable();
        assert!(numbers.into_iter().eq(0..mesh.triangles.len() as u32));
    }

    #[test]
    fn a_plane_and_the_outside_of_a_sphere_have_no_lumen() {
        assert!(balls(&square(5, 5.0, 0.0), 100.0).iter().all(Option::is_none));
        let mut sphere = icosphere(3, 5.0, Vec3::ZERO);
        sphere.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        assert!(balls(&sphere, 100.0).iter().all(Option::is_none));
    }

    #[test]
    fn bumps_on_the_wall_leave_the_ball_nearly_as_it_is() {
        let mut mesh = tube(48, 200, 40.0, |_| 3.0);
        let clean = balls(&mesh, 20.0);
        // Every seventh vertex is moved by 0.05 mm, an eighth of an edge, out or in.
        for (v, p) in mesh.positions.iter_mut().enumerate().filter(|(v, _)| v % 7 == 0) {
            let outward = p.truncate().normalize();
            *p += (outward * if v % 2 == 0 { 0.05 } else { -0.05 }).extend(0.0);
        }
        for (v, (noisy, clean)) in balls(&mesh, 20.0).iter().zip(&clean).enumerate() {
            if !(2.0..38.0).contains(&mesh.positions[v].z) {
                // At an open end, a tilted normal may look out of it.
                continue;
            }
            let (noisy, clean) = (noisy.unwrap(), clean.unwrap());
            assert!((noisy.radius / clean.radius - 1.0).abs() < 0.12, "{v}: {noisy:?} {clean:?}");
        }
    }

    #[test]
    fn close_vertices_share_a_radius_and_slices_change_nothing() {
        let waist = |z: f32| 2.0 - 1.2 * (-(z - 20.0) * (z - 20.0) / 16.0).exp();
        let mesh = tube(64, 400, 40.0, waist);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        let whole = inner_radii(&mesh, &topology, &index).radii;
        for (p, radius) in mesh.positions.iter().zip(&whole) {
            // The wall falls by up to 0.26 a mm; a ball that leans against it is wider or narrower by that much.
            assert!((radius / waist(p.z) - 1.0).abs() < 0.12, "{p}: {radius}");
        }
        let mut distinct = whole.clone();
        distinct.sort_by(f32::total_cmp);
        distinct.dedup();
        assert!(distinct.len() * 2 < whole.len(), "{} of {}", distinct.len(), whole.len());
        let (mesh, topology, index) = (&mesh, &topology, &index);
        let mut running =
            Running::new(|yielder| async move { inner_radii_in_slices(mesh, topology, index, &yielder).await });
        let mut slices = 1;
        let sliced = loop {
            match running.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(_) => slices += 1,
                Progress::Done(sliced) => break sliced,
            }
        };
        assert!(slices > 1);
        assert_eq!(sliced.radii, whole);
    }

    #[test]
    fn what_is_no_place_has_no_ball() {
        let sphere = icosphere(1, 5.0, Vec3::ZERO);
        let index = SurfaceIndex::new(&sphere.positions, &sphere.triangles);
        for (p, n, limit) in [
            (Vec3::splat(f32::NAN), Vec3::X, 1.0),
            (Vec3::X, Vec3::splat(f32::NAN), 1.0),
            (Vec3::X, Vec3::X, f32::NAN),
            (Vec3::X, Vec3::X, 0.0),
        ] {
            assert_eq!(index.inner_ball(p, n, limit), None);
        }
        assert_eq!(SurfaceIndex::default().inner_ball(Vec3::X, Vec3::X, 9.0), None);
    }

    #[test]
    fn wherever_one_points_in_a_tube_the_ball_is_as_wide_as_it() {
        let mesh = crate::shapes::tube(96, 60, 40.0, |_| 3.0);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        for (angle, z) in [(0.0, 20.0), (0.31, 17.7), (2.0, 11.11), (4.4, 29.03)] {
            let (sin, cos) = libm::sincos(angle);
            // A little beside the wall, as a pick is.
            let p = Vec3::new(3.01 * cos as f32, 3.01 * sin as f32, z);
            let (at, ball) = index.inner_ball_beside(&mesh.positions, &mesh.triangles, p, 100.0).unwrap();
            assert!((ball.radius / 3.0 - 1.0).abs() < 0.005, "{angle} {z}: {ball:?}");
            assert!(at.distance(p) < 0.05 && ball.centre.distance(Vec3::Z * z) < 0.02, "{ball:?}");
        }
        assert!(index.inner_ball_beside(&mesh.positions, &mesh.triangles, Vec3::NAN, 100.0).is_none());
    }
}
