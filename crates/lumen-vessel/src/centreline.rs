//! From a chain of balls to a smooth centreline with radii.
//!
//! The chain is divided finely. In the plane across it at each point, the wall is sought along eight rays; the point
//! moves towards the middle of what they enclose, and the line is smoothed along itself, a few times in turn. So bumps
//! of the wall, stair-steps above all, move the centreline less than they would move an inscribed ball. A move that
//! would bring the point nearer to the wall is left out. The radius is then that of the largest ball inside with its
//! middle near the point.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec3;

use super::space::Space;
use lumen_mesh::{Ball, parallel};

/// Distance between points, as a part of the radius.
const SPACING: f64 = 0.3;
/// Centrings, each with as many smoothings.
const ROUNDS: usize = 3;
const SMOOTHINGS: usize = 4;
/// A ray counts no longer than this many times the distance to the wall.
const FARTHEST: f64 = 1.4;
/// Points that are centred in one piece.
const PIECE: usize = 64;

/// A point of a centreline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Where, in mm.
    pub at: DVec3,
    /// Radius of the largest ball inside there, in mm.
    pub radius: f64,
}

/// The centreline through the middles of `balls`. What lies within `fixed` mm of the first is only smoothed. The ends
/// stay.
pub fn centreline(space: &Space, balls: &[Ball], fixed: f64) -> Vec<Place> {
    let mut points = divided(balls);
    let origin = points[0].at;
    for _ in 0..ROUNDS {
        let count = points.len();
        let moved = parallel::map_ranges(count, PIECE, |piece| {
            let one = |i: usize| {
                let is_fixed = i == 0 || points[i].at.distance(origin) <= fixed;
                if is_fixed { points[i].at } else { centred(space, &points, i) }
            };
            piece.map(one).collect::<Vec<_>>()
        });
        for (point, at) in points.iter_mut().zip(moved.into_iter().flatten()) {
            point.at = at;
        }
        for _ in 0..SMOOTHINGS {
            smooth(&mut points);
        }
    }
    measure(space, &mut points);
    points
}

/// Sets each radius to that of the largest ball there.
pub(crate) fn measure(space: &Space, points: &mut [Place]) {
    parallel::for_each_chunk_mut(points, PIECE, |_, piece| {
        for point in piece {
            if let Some(ball) = space.largest(point.at) {
                point.radius = f64::from(ball.radius);
            }
        }
    });
}

/// Points along the middles of the balls, the radius between those at the ends of each part.
fn divided(balls: &[Ball]) -> Vec<Place> {
    let place = |ball: &Ball| Place { at: ball.centre.as_dvec3(), radius: f64::from(ball.radius) };
    let mut points = Vec::new();
    for pair in balls.windows(2) {
        let [from, to] = [place(&pair[0]), place(&pair[1])];
        let spacing = (SPACING * from.radius.min(to.radius)).max(1e-3 * from.radius.max(to.radius));
        let steps = (from.at.distance(to.at) / spacing).ceil().clamp(1.0, 1000.0) as usize;
        for step in 0..steps {
            let part = step as f64 / steps as f64;
            let radius = from.radius + (to.radius - from.radius) * part;
            points.push(Place { at: from.at.lerp(to.at, part), radius });
        }
    }
    points.extend(balls.last().map(place));
    points
}

/// The direction of a line at its point `i`, of length 1.
pub fn direction(points: &[Place], i: usize) -> DVec3 {
    let reach = points[i].radius;
    let mut ends = [i, i];
    while ends[0] > 0 && points[ends[0]].at.distance(points[i].at) < reach {
        ends[0] -= 1;
    }
    while ends[1] + 1 < points.len() && points[ends[1]].at.distance(points[i].at) < reach {
        ends[1] += 1;
    }
    (points[ends[1]].at - points[ends[0]].at).normalize_or(DVec3::Z)
}

/// Where point `i` is moved to: towards the middle of the cross-section.
fn centred(space: &Space, points: &[Place], i: usize) -> DVec3 {
    towards_middle(space, points[i], direction(points, i))
}

/// Where a place is moved to in the plane across `way`: towards the middle of what the wall encloses there.
pub(super) fn towards_middle(space: &Space, Place { at, radius }: Place, way: DVec3) -> DVec3 {
    const ROUND: [[f64; 2]; 8] = {
        let s = FRAC_1_SQRT_2;
        [[1.0, 0.0], [s, s], [0.0, 1.0], [-s, s], [-1.0, 0.0], [-s, -s], [0.0, -1.0], [s, -s]]
    };
    let Some((before, _)) = space.ball(at.as_vec3(), None) else { return at };
    let (x, y) = way.any_orthonormal_pair();
    let farthest = FARTHEST * f64::from(before.radius);
    let rays = ROUND.map(|[a, b]| {
        let ray = x * a + y * b;
        let depth = space.index.depth_within(before.centre, ray.as_vec3(), farthest as f32);
        ray * depth.map_or(farthest, f64::from)
    });
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    for (i, &ray) in rays.iter().enumerate() {
        let next = rays[(i + 1) % rays.len()];
        let part = ray.length() * next.length();
        area += part;
        moment += (ray + next) / 3.0 * part;
    }
    let middle = if area > 0.0 { moment / area } else { DVec3::ZERO };
    let moved = at + middle.clamp_length_max(0.5 * radius);
    if space.index.is_within(moved.as_vec3(), 0.97 * before.radius) { at } else { moved }
}

/// Moves each point but the ends half way to the middle of its neighbours.
fn smooth(points: &mut [Place]) {
    let Some(first) = points.first() else { return };
    let mut before = first.at;
    for i in 1..points.len().saturating_sub(1) {
        let at = points[i].at;
        points[i].at = at * 0.5 + (before + points[i + 1].at) * 0.25;
        before = at;
    }
}

/// Arc lengths along a line, in mm.
pub fn arcs(points: &[Place]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut arcs = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        if i > 0 {
            sum += point.at.distance(points[i - 1].at);
        }
        arcs.push(sum);
    }
    arcs
}
