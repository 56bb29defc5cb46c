//! The forks of a route: where it leaves one vessel for another, and another way leads on as straight.

use glam::DVec3;

use super::Route;
use lumen_vessel::{Branch, Tree};

/// Degrees by which a route turns where it still goes straight on.
const STRAIGHT: f64 = 10.0;
/// A vessel so many times as wide as the one that is left is one that the wire comes out into: its walls lead on.
const WIDER: f64 = 1.25;
/// The ways into a fork and out of it are those over so many radii of the lumen there, from one radius away on: nearer, the
/// middle of the lumen cuts the corner.
const OVER: f64 = 2.0;
/// From so many radii before that on it is looked at on which side the wire comes in: on the outer one of a bend.
const BEND: f64 = 4.0;

/// Where a route leaves one vessel for another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fork {
    /// Arc length along the route where their middles part, in mm.
    pub arc_mm: f64,
    /// Radius of the lumen that is left, before the fork, in mm.
    pub parent_radius_mm: f64,
    /// Radius of the branch that is taken, in mm.
    pub branch_radius_mm: f64,
    /// The angle between the ways before and behind it, in degrees.
    pub turn_degrees: f64,
}

impl Route {
    /// The forks along it, in order. Where it goes straight on, or straighter than every other way, there is none; nor
    /// where it comes out of a branch into a wider vessel, or where it takes a branch at the outer side of a bend: there the
    /// wire lies.
    pub fn forks(&self, tree: &Tree) -> Vec<Fork> {
        self.branches.windows(2).filter_map(|pair| self.fork(tree, [pair[0], pair[1]])).collect()
    }

    fn fork(&self, tree: &Tree, route: [u32; 2]) -> Option<Fork> {
        let [from, into] = route.map(|id| &tree.branches()[id as usize]);
        let child = child(from, into)?;
        let (parent, joint) = (child.parent?, child.points[0]);
        let (arc_mm, radius) = (self.locate(joint.at).arc_mm, joint.radius);
        let before = arc_mm - (1.0 + OVER) * radius;
        let way_in = self.way(before, arc_mm - radius);
        let ostium = self.locate(into.points[into.ostium].at).arc_mm.max(arc_mm + radius);
        let branch_radius_mm = self.at(ostium + radius.min(into.length_mm() / 2.0)).radius;
        let way_out = self.way(ostium + branch_radius_mm, ostium + (1.0 + OVER) * branch_radius_mm);
        let turn_degrees = degrees(way_in, way_out);
        let meets = |other: &&Branch| {
            let is_there = other.id == parent || other.parent == Some(parent);
            is_there && !route.contains(&other.id)
        };
        let others = tree.branches().iter().filter(meets).filter_map(|other| way_from(tree, other, joint.at, radius));
        let straightest = others.map(|way| degrees(way_in, way)).fold(f64::INFINITY, f64::min);
        // Where vessels meet, the largest sphere is wider than each of them.
        let parent_radius_mm = self.at(before).radius;
        let earlier = self.way(before - BEND * radius, before - (BEND - OVER) * radius);
        let is_bent = degrees(earlier, way_in) >= STRAIGHT;
        // A branch at the outer side of a bend is where the wire lies.
        let lies_there = is_bent && (way_out - way_in).dot(way_in - earlier) < 0.0;
        let is_fork = turn_degrees >= STRAIGHT
            && !lies_there
            && straightest <= turn_degrees + STRAIGHT
            && branch_radius_mm <= WIDER * parent_radius_mm;
        is_fork.then_some(Fork { arc_mm, parent_radius_mm, branch_radius_mm, turn_degrees })
    }

    /// The way between two arc lengths; beyond its ends the route goes on as it begins and ends.
    fn way(&self, from: f64, to: f64) -> DVec3 {
        let there = if to <= 0.0 { self.at(0.0) } else { self.at(from) };
        (self.at(to).at - self.at(from).at).normalize_or(there.direction)
    }
}

/// Which of two branches that meet begins there: on the centreline of its parent, or where that ends.
fn child<'a>(from: &'a Branch, into: &'a Branch) -> Option<&'a Branch> {
    match (from.parent, into.parent) {
        (_, Some(parent)) if parent == from.id => Some(into),
        (Some(parent), _) if parent == into.id => Some(from),
        (Some(one), Some(other)) if one == other => Some(if from.ostium > 0 { from } else { into }),
        _ => None,
    }
}

/// By how many degrees a way turns that leaves one branch for another which it meets, by their centrelines from one to three
/// radii away; `None` where the vessel of one of them is no longer than wide, or they do not meet.
pub(super) fn turn_degrees(tree: &Tree, pair: [u32; 2]) -> Option<f64> {
    let [from, into] = pair.map(|id| &tree.branches()[id as usize]);
    let joint = child(from, into)?.points[0];
    let [back, on] = [from, into].map(|branch| way_from(tree, branch, joint.at, joint.radius));
    Some(degrees(-back?, on?))
}

/// Whether two branches that meet are both longer than the lumen is wide there.
pub(super) fn are_long(tree: &Tree, pair: [u32; 2]) -> bool {
    let [from, into] = pair.map(|id| &tree.branches()[id as usize]);
    child(from, into).is_some_and(|child| from.length_mm().min(into.length_mm()) > 2.0 * child.points[0].radius)
}

/// The angle between two ways.
fn degrees(one: DVec3, other: DVec3) -> f64 {
    libm::acos(one.dot(other).clamp(-1.0, 1.0)).to_degrees()
}

/// The way that a branch goes from a joint at one of its ends; `None` where it has none there, or where its vessel is no
/// longer than wide. A branch that ends before that at the ostium of another goes on in the one that goes straight on there.
fn way_from(tree: &Tree, branch: &Branch, joint: DVec3, radius: f64) -> Option<DVec3> {
    let [first, last] = [0, branch.points.len() - 1].map(|i| branch.points[i].at.distance(joint));
    if first.min(last) > radius {
        return None;
    }
    let far = (1.0 + OVER) * radius;
    let is_reversed = last < first;
    let (mut part, mut arc) = (branch, 0.0);
    let mut near = None;
    loop {
        let length = part.length_mm();
        let at = |past: f64| {
            let past = if is_reversed { (length - past).max(0.0) } else { past };
            part.points[part.arcs.partition_point(|&a| a < past).min(part.arcs.len() - 1)].at
        };
        if near.is_none() && arc + length >= radius {
            near = Some(at(radius - arc));
        }
        let next = (arc + length < far).then(|| straight_on(tree, part, is_reversed)).flatten();
        let Some(next) = next else {
            let is_long = arc + length > 2.0 * radius;
            return is_long.then_some(near?).and_then(|near| (at(far - arc) - near).try_normalize());
        };
        (part, arc) = (next, arc + length);
    }
}

/// The branch in which one goes on behind its end, or before its start, as the same vessel.
pub(super) fn straight_on<'a>(tree: &'a Tree, branch: &Branch, is_reversed: bool) -> Option<&'a Branch> {
    if is_reversed {
        let parent = branch.parent.filter(|_| branch.goes_straight_on())?;
        return tree.branches().get(parent as usize);
    }
    tree.branches().iter().find(|next| next.parent == Some(branch.id) && next.goes_straight_on())
}
