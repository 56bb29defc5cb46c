//! The inside of a vessel surface as a wire would find it: how far the wall is, where the middle is, where it is open.
//!
//! A point is moved to the middle by going away from the nearest wall, to half way between it and the wall behind, as
//! long as the distance to the wall grows. A move is never longer than that distance, so that the balls on the way
//! overlap: the way itself lies inside. In a crevice the middle between the walls is no middle of a vessel: where the two
//! walls do not face each other, the point goes on away from both.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::width::RAYS;
use lumen_mesh::{Ball, Nearest, SurfaceIndex, Topology, TriMesh, boundary_loops};

/// Most moves to the middle. From the wall of a round vessel, six or seven are enough.
const MOVES: usize = 16;
/// A move must gain this part of the distance.
const GAIN: f32 = 2e-3;
/// Walls face each other when the cosine between the ways from them is less: 25 degrees from opposite.
const FACING: f32 = -0.906;

/// An open end: its middle, where out is, and its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    pub centre: Vec3,
    pub outward: Vec3,
    /// Mean distance of its rim from the middle, in mm.
    pub radius: f32,
}

/// The inside of a surface.
#[derive(Clone, Debug)]
pub struct Space {
    pub index: Arc<SurfaceIndex>,
    pub openings: Vec<Opening>,
    /// Triangles over the open ends.
    caps: SurfaceIndex,
    low: Vec3,
    high: Vec3,
    /// Outward normal of each triangle, not of any length.
    normals: Vec<Vec3>,
}

impl Space {
    pub fn new(mesh: &TriMesh, topology: &Topology, index: Arc<SurfaceIndex>) -> Self {
        let rims = boundary_loops(topology);
        let openings = rims.iter().filter_map(|rim| opening(mesh, rim)).collect();
        let normal = |t: usize| {
            let [a, b, c] = mesh.corners(t);
            (b - a).cross(c - a)
        };
        let bounds = mesh.bounds();
        Self {
            index,
            openings,
            caps: caps(mesh, &rims),
            low: bounds.min.into(),
            high: bounds.max.into(),
            normals: (0..mesh.triangles.len()).map(normal).collect(),
        }
    }

    /// Whether `p` lies on the inner side of the wall that is nearest to it.
    fn is_before(&self, p: Vec3, nearest: &Nearest) -> bool {
        (p - nearest.point).dot(self.normals[nearest.triangle as usize]) <= 0.0
    }

    /// Whether the straight way from a point inside leads out of an open end, or out of the surface's box.
    pub fn leaves(&self, from: Vec3, to: Vec3) -> bool {
        let is_boxed = to.cmpge(self.low).all() && to.cmple(self.high).all();
        !is_boxed || self.caps.passes(from, to) != 0
    }

    /// Whether the surface and the caps over its open ends go around `p`, as most of three rays have it.
    pub fn is_inside(&self, p: Vec3) -> bool {
        let around = |&&ray: &&Vec3| self.index.winding(p, ray) + self.caps.winding(p, ray) > 0;
        RAYS.iter().filter(around).count() >= 2
    }

    /// The ball about a point inside, as `hint`, an earlier answer near by, helps to find.
    pub fn ball(&self, p: Vec3, hint: Option<&Nearest>) -> Option<(Ball, Nearest)> {
        let nearest = match hint {
            Some(hint) => self.index.nearest_from(p, hint),
            None => self.index.nearest(p),
        }?;
        Some((Ball { centre: p, radius: nearest.distance }, nearest))
    }

    /// Moves a ball to the middle; `visit` is told of every ball on the way, the last one too, not of the first.
    pub fn ascend(&self, ball: Ball, nearest: Nearest, mut visit: impl FnMut(Ball)) -> (Ball, Nearest) {
        let (mut ball, mut nearest) = (ball, nearest);
        for _ in 0..MOVES {
            let Some((next, projection)) = self.across(ball, &nearest).or_else(|| self.out_of_crevice(ball, &nearest))
            else {
                break;
            };
            (ball, nearest) = (next, projection);
            visit(ball);
        }
        (ball, nearest)
    }

    /// A larger ball farther from the nearest wall.
    fn across(&self, ball: Ball, nearest: &Nearest) -> Option<(Ball, Nearest)> {
        let away = (ball.centre - nearest.point).try_normalize()?;
        let behind = self.index.depth_within(ball.centre, away, 3.0 * ball.radius).unwrap_or(3.0 * ball.radius);
        let step = (behind - ball.radius) / 2.0;
        if step <= GAIN * ball.radius {
            return None;
        }
        // In a corner half of the way is too far.
        [step, 0.4 * step].into_iter().find_map(|step| self.larger(ball, away * step, nearest))
    }

    /// A larger ball farther from both walls, where they do not face each other.
    fn out_of_crevice(&self, ball: Ball, nearest: &Nearest) -> Option<(Ball, Nearest)> {
        let away = (ball.centre - nearest.point).try_normalize()?;
        let (_, other) = self.ball(ball.centre + away * (0.3 * ball.radius), Some(nearest))?;
        let from_other = (ball.centre - other.point).try_normalize()?;
        let cosine = away.dot(from_other);
        if !(FACING..0.99).contains(&cosine) {
            return None;
        }
        let out = (away + from_other).try_normalize()?;
        self.larger(ball, out * (0.7 * ball.radius), nearest)
    }

    fn larger(&self, ball: Ball, step: Vec3, nearest: &Nearest) -> Option<(Ball, Nearest)> {
        let centre = ball.centre + step;
        // To find that a wall is near costs less than to find the nearest.
        if self.index.is_within(centre, ball.radius * (1.0 + GAIN)) || self.leaves(ball.centre, centre) {
            return None;
        }
        self.ball(centre, Some(nearest)).filter(|(next, projection)| self.is_before(next.centre, projection))
    }

    /// The middle between a point of the wall with this outward normal, of length 1, and the wall behind.
    pub(crate) fn behind_wall(&self, p: Vec3, normal: Vec3) -> Option<(Ball, Nearest)> {
        let start = p - normal * (1e-6 * (self.high - self.low).max_element());
        let depth = self.index.depth(start, -normal)?;
        let (ball, nearest) = self.ball(p - normal * (depth / 2.0), None)?;
        let inside = ball.radius > 0.0 && self.is_before(ball.centre, &nearest) && !self.leaves(start, ball.centre);
        if !inside {
            return None;
        }
        let (mut ball, mut nearest) = (ball, nearest);
        for _ in 0..MOVES {
            let Some((next, projection)) = self.across(ball, &nearest) else { break };
            (ball, nearest) = (next, projection);
        }
        Some((ball, nearest))
    }

    /// The largest ball inside near a point of a centreline: its middle may be off by a third of its radius.
    pub fn largest(&self, p: DVec3) -> Option<Ball> {
        let (start, nearest) = self.ball(p.as_vec3(), None)?;
        let (mut best, mut nearest) = (start, nearest);
        for _ in 0..MOVES {
            let Some((next, projection)) = self.across(best, &nearest) else { break };
            if next.centre.distance(start.centre) > 0.35 * start.radius {
                break;
            }
            (best, nearest) = (next, projection);
        }
        Some(best)
    }
}

/// A fan over each rim, from the middle of its vertices.
fn caps(mesh: &TriMesh, rims: &[Vec<u32>]) -> SurfaceIndex {
    let mut all = TriMesh::default();
    for rim in rims {
        let first = all.positions.len() as u32;
        all.positions.extend(rim.iter().map(|&v| mesh.positions[v as usize]));
        let sum: DVec3 = rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3()).sum();
        all.positions.push((sum / rim.len() as f64).as_vec3());
        let count = rim.len() as u32;
        // The rim runs as its triangles do, so a cap over it runs the other way.
        all.triangles.extend((0..count).map(|i| [first + (i + 1) % count, first + i, first + count]));
    }
    SurfaceIndex::new(&all.positions, &all.triangles)
}

fn opening(mesh: &TriMesh, rim: &[u32]) -> Option<Opening> {
    let at = |i: usize| mesh.positions[rim[i % rim.len()] as usize].as_dvec3();
    let centroid: DVec3 = (0..rim.len()).map(at).sum::<DVec3>() / rim.len() as f64;
    let (mut area, mut around, mut length) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for i in 0..rim.len() {
        let (from, to) = (at(i), at(i + 1));
        area += (from - centroid).cross(to - centroid);
        around += (from + to) / 2.0 * from.distance(to);
        length += from.distance(to);
    }
    // The middle of the rim, not of its vertices, which may lie closer together on one side.
    let centre = around / length;
    let radius = (0..rim.len()).map(|i| at(i).distance(centre)).sum::<f64>() / rim.len() as f64;
    // The rim runs as its triangles do, so a cap over it would run the other way.
    let outward = (-area).try_normalize()?;
    (radius > 0.0 && centre.is_finite()).then(|| Opening {
        centre: centre.as_vec3(),
        outward: outward.as_vec3(),
        radius: radius as f32,
    })
}
