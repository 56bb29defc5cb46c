//! Leads centrelines on to the caps that close vessels: Lumen's own way.
//!
//! A chain of balls ends in the last ball that fits: a radius before a flat cap, somewhere between its middle and its
//! rim, and where the wall has steps a part of a radius earlier. So its last part says little of the vessel's axis. It is
//! left out, and the line goes on from there along the vessel: in steps that are moved to the middle of the
//! cross-section as long as the cap is more than a radius ahead, then straight to the cap. Where no wall comes, or only
//! far off, the line stays as it was, and so do lines that are hardly longer than wide and those that end beside another
//! vessel, where they may go on in it.

use glam::DVec3;

use super::centreline::{Place, arcs, measure, towards_middle};
use super::space::Space;
use super::tree::{Branch, End};

/// Of the last part of a line so much is left out, in radii, and at most this part of the line.
const LEFT_OUT: f64 = 1.5;
const LEFT_OUT_OF: f64 = 0.4;
/// The vessel's radius is that of the largest ball whose middle is at most so many of a ball's radii from the tip, as long
/// as that finds a larger one: towards the corner of a cap balls are as small as it is near. A ball in a square corner is
/// 1.4 of its radii from it, where the wall has steps up to 1.6, and 2.6 in the sharp one of a cap that leans by 45 degrees.
const NEAR: f64 = 2.5;
/// A ball smaller than this part of it is one in a corner. The line there is left out too.
const CORNER: f64 = 0.8;
/// The same at the end of a branch that may be closed askew, by up to 45 degrees; and the part of the vessel's radius from which
/// on it is whole.
const ASKEW: f64 = 4.0;
const WHOLE: f64 = 0.9;
/// The least length of a line that is led on, in radii.
const SHORTEST: f64 = 1.0;
/// The way on is that over so many radii before.
const BEFORE: f64 = 2.0;
/// A step, in radii.
const STEP: f64 = 0.25;
/// How much of a step's own way goes into that of the next.
const TURN: f64 = 0.2;
/// The cap is at most so many radii ahead of the line's end as it was.
const AHEAD: f64 = 2.0;
/// The part of the way to the cap at which the line ends: the wall itself is in no vessel.
const UP_TO: f64 = 0.98;

/// A branch's centreline that reaches the caps.
pub(super) struct ExtendedLine {
    pub(super) points: Vec<Place>,
    /// By how many mm it is longer at its first point.
    pub(super) before_mm: f64,
    /// The vessel's radius at the first and at the last point, in mm, where that is at a cap.
    pub(super) caps: [Option<f64>; 2],
}

/// The points of a branch with those on to the caps at its closed ends.
pub(super) fn extended_to_caps(space: &Space, branches: &[Branch], branch: &Branch) -> ExtendedLine {
    let is_free = |end: usize| branch.ends[end] == End::Closed && !is_beside_another(branches, branch, end);
    let mut led = ExtendedLine { points: branch.points.clone(), before_mm: 0.0, caps: [None; 2] };
    for end in [1, 0].into_iter().filter(|&end| is_free(end)) {
        if end == 0 {
            led.points.reverse();
        }
        let before = length(&led.points);
        if let Some((points, radius)) = led_on(space, &led.points) {
            led.points = points;
            led.caps[end] = Some(radius);
        }
        if end == 0 {
            led.points.reverse();
            led.before_mm = length(&led.points) - before;
        }
    }
    led
}

impl Branch {
    /// The vessel's radius at its first point or `at_end`, and how far from there its line has it, both in mm: before, in the
    /// corner of an end that is closed askew, balls are smaller. `None` for a branch without points.
    pub fn radius_at_end(&self, at_end: bool) -> Option<(f64, f64)> {
        let mut inwards: Vec<usize> = (self.ostium..self.points.len()).collect();
        if at_end {
            inwards.reverse();
        }
        let tip = *inwards.first()?;
        let own: Vec<Place> = inwards.iter().map(|&i| self.points[i]).collect();
        let radius = vessel_radius(&own, own[0], ASKEW);
        let is_whole = |place: &Place| place.radius >= WHOLE * radius;
        let first = own.iter().position(is_whole).filter(|_| own[0].radius < CORNER * radius).unwrap_or(0);
        let radius = if first == 0 { own[0].radius } else { radius };
        Some((radius, (self.arcs[inwards[first]] - self.arcs[tip]).abs()))
    }
}

fn length(points: &[Place]) -> f64 {
    arcs(points).last().copied().unwrap_or(0.0)
}

/// Whether the balls at an end of a branch meet those of another.
fn is_beside_another(branches: &[Branch], branch: &Branch, end: usize) -> bool {
    let Some(tip) = (if end == 0 { branch.points.first() } else { branch.points.last() }) else { return true };
    let near = |place: &Place| place.at.distance(tip.at) < place.radius + tip.radius;
    branches.iter().any(|other| other.id != branch.id && other.points.iter().any(near))
}

/// The radius of the vessel that a line ends in.
fn vessel_radius(points: &[Place], tip: Place, near: f64) -> f64 {
    let mut radius = tip.radius;
    loop {
        let around = points.iter().filter(|place| place.at.distance(tip.at) < near * radius);
        let largest = around.map(|place| place.radius).fold(radius, f64::max);
        if largest <= radius {
            return radius;
        }
        radius = largest;
    }
}

/// The line with its last part led on to the cap, and the vessel's radius there; `None` where there is none.
fn led_on(space: &Space, points: &[Place]) -> Option<(Vec<Place>, f64)> {
    let tip = *points.last()?;
    let radius = vessel_radius(points, tip, NEAR);
    let whole = length(points);
    if points.len() < 3 || whole < SHORTEST * radius || radius <= 0.0 {
        return None;
    }
    let corner = points.iter().rev().take_while(|place| place.radius < CORNER * radius).count();
    let corner = length(&points[points.len() - corner..]);
    let left_out = (corner + LEFT_OUT * radius).min(LEFT_OUT_OF * whole);
    let mut kept = points.to_vec();
    let mut gone = 0.0;
    while kept.len() > 2 && gone < left_out {
        let last = kept.pop()?;
        gone += last.at.distance(kept[kept.len() - 1].at);
    }
    let end = kept.len() - 1;
    let back = (0..end).rev().find(|&i| kept[i].at.distance(kept[end].at) >= BEFORE * radius).unwrap_or(0);
    let mut way = (kept[end].at - kept[back].at).try_normalize()?;
    let farthest = gone + AHEAD * radius;
    let ahead = |from: DVec3, way: DVec3| {
        space.index.depth_within(from.as_vec3(), way.as_vec3(), farthest as f32).map(f64::from)
    };
    let mut at = kept[end].at;
    let mut advanced = 0.0;
    loop {
        let free = ahead(at, way)? - radius;
        if free <= 0.0 || advanced > farthest {
            break;
        }
        let next = at + way * free.min(STEP * radius);
        let moved = towards_middle(space, Place { at: next, radius }, way);
        way = way.lerp((moved - at).normalize_or(way), TURN).normalize_or(way);
        advanced += moved.distance(at);
        at = moved;
        kept.push(Place { at, radius });
    }
    let rest = UP_TO * ahead(at, way)?;
    if advanced + rest > farthest {
        return None;
    }
    let steps = (rest / (STEP * radius)).ceil().clamp(1.0, 100.0);
    let straight = (1..=steps as u32).map(|step| Place { at: at + way * (rest * f64::from(step) / steps), radius });
    kept.extend(straight);
    measure(space, &mut kept[end + 1..]);
    Some((kept, radius))
}
