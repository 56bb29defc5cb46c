//! A route: the way through the lumen from an entry to a target.
//!
//! The balls of the cheapest way are joined by a smooth centreline, as those of the tree are; so a route around a loop of
//! vessels takes the wider side, though the tree is cut open there.

use glam::{DVec3, Vec3};

use super::{At, RouteError, usual_radius};
use lumen_vessel::{Ball, Located, NONE, Place, Tree, arcs, centreline, direction, power};

/// Number of stations.
const STATIONS: usize = 5;

/// A point of a route.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RoutePoint {
    /// In the middle of the lumen, in mm.
    pub at: DVec3,
    /// Radius of the largest ball inside there, in mm.
    pub radius: f64,
    /// Arc length from the entry, in mm.
    pub arc_mm: f64,
    /// Where the route goes on, of length 1.
    pub direction: DVec3,
}

/// Where a point is along a route.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OnRoute {
    /// Arc length of the place next to it, in mm.
    pub arc_mm: f64,
    /// Its distance from that place in mm.
    pub distance_mm: f64,
    /// Radius of the lumen there, in mm.
    pub radius_mm: f64,
}

/// A disc across a vessel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrossSection {
    /// Its middle, in mm.
    pub at: DVec3,
    /// The way through it, of length 1.
    pub normal: DVec3,
    /// Its radius in mm.
    pub radius: f64,
}

/// The way from an entry to a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// The centreline from the place next to the entry to the place next to the target.
    pub points: Vec<RoutePoint>,
    /// How the target's vessel goes on behind the target.
    pub beyond: Vec<Place>,
    /// Arc length of it all, in mm.
    pub length_mm: f64,
    /// Length over the straight distance between the ends.
    pub tortuosity: f64,
    /// The smallest radius of the lumen along it, in mm.
    pub smallest_radius_mm: f64,
    /// Where that is: its place in `points`.
    pub smallest_at: usize,
    /// The branches of the tree that it leads through, in order.
    pub branches: Vec<u32>,
    /// Branches that come out along it and are left aside.
    pub branches_passed: usize,
    /// Arc lengths in mm of the five stations, in the middles of five equal parts: at (i + 0.5) / 5 of the length.
    pub stations: [f64; STATIONS],
    /// The cross-section of the vessel at the target.
    pub target: CrossSection,
}

/// Routes through the lumen of a vessel tree.
pub trait Routes {
    /// The way from `entry` to `target`, points in mm inside the lumen; the target may also lie on its wall.
    ///
    /// # Errors
    /// [`RouteError::EntryOutside`], [`RouteError::TargetOutside`], [`RouteError::NoWay`], [`RouteError::TooShort`].
    fn route(&self, entry: Vec3, target: Vec3) -> Result<Route, RouteError>;
}

impl Routes for Tree {
    fn route(&self, entry: Vec3, target: Vec3) -> Result<Route, RouteError> {
        let outside = |at: Vec3| (at.to_array(), self.space.index.nearest(at).map_or(f32::INFINITY, |n| n.distance));
        let from = ball_at(self, entry).ok_or_else(|| {
            let (at, distance_mm) = outside(entry);
            RouteError::EntryOutside { at: At(at), distance_mm }
        })?;
        let to = ball_at(self, target).ok_or_else(|| {
            let (at, distance_mm) = outside(target);
            RouteError::TargetOutside { at: At(at), distance_mm }
        })?;
        let ways = self.graph.ways(from);
        if ways.length[to as usize].is_infinite() {
            return Err(gap(self, from, to));
        }
        let mut numbers = vec![to];
        while let Some(&last) = numbers.last()
            && ways.before[last as usize] != NONE
        {
            numbers.push(ways.before[last as usize]);
        }
        numbers.reverse();
        let line = line_through(self, &numbers);
        if line.len() < 2 {
            return Err(RouteError::TooShort { length_mm: 0.0 });
        }
        let (start, end) = (along(&line, entry.as_dvec3()), along(&line, target.as_dvec3()));
        let length_mm = end.arc_mm - start.arc_mm;
        if length_mm <= end.radius_mm.min(start.radius_mm) {
            return Err(RouteError::TooShort { length_mm: length_mm.max(0.0) });
        }
        let points = cut(&line, start.arc_mm, end.arc_mm);
        Ok(finished(self, &points, end))
    }
}

fn finished(tree: &Tree, line: &[Place], end: OnRoute) -> Route {
    let mut arc_mm = 0.0;
    let mut points = Vec::with_capacity(line.len());
    for (i, place) in line.iter().enumerate() {
        arc_mm += if i > 0 { place.at.distance(line[i - 1].at) } else { 0.0 };
        points.push(RoutePoint { at: place.at, radius: place.radius, arc_mm, direction: direction(line, i) });
    }
    let least = |least: usize, next: usize| if line[next].radius < line[least].radius { next } else { least };
    let smallest_at = (0..line.len()).reduce(least).unwrap_or(0);
    let straight = line[0].at.distance(line[line.len() - 1].at);
    let last = points[points.len() - 1];
    let target = CrossSection { at: last.at, normal: last.direction, radius: end.radius_mm };
    let branches = branches_along(tree, &points);
    Route {
        length_mm: arc_mm,
        tortuosity: arc_mm / straight,
        smallest_radius_mm: line[smallest_at].radius,
        smallest_at,
        branches_passed: left_aside(tree, &branches),
        stations: std::array::from_fn(|i| arc_mm * (i as f64 + 0.5) / STATIONS as f64),
        beyond: beyond(tree, &target),
        points,
        branches,
        target,
    }
}

/// The ball that holds `p` deepest, or the nearest one if `p` is inside or hardly out.
fn ball_at(tree: &Tree, p: Vec3) -> Option<u32> {
    let balls = tree.graph.balls.iter().enumerate();
    let power = |ball: &Ball| ball.centre.distance_squared(p) - ball.radius * ball.radius;
    let powers = balls.map(|(i, ball)| (power(ball) * if tree.graph.is_passing[i] { 0.5 } else { 1.0 }, i));
    let (_, best) = powers.reduce(|least, next| if next.0 < least.0 { next } else { least })?;
    let radius = tree.graph.balls[best].radius;
    let distance = tree.space.index.nearest(p)?.distance;
    let is_in = distance <= 0.25 * radius || tree.space.is_inside(p);
    is_in.then_some(best as u32)
}

/// Where the lumen of one ball comes nearest to that of another.
fn gap(tree: &Tree, from: u32, to: u32) -> RouteError {
    let of = |group: u32| tree.graph.balls.iter().zip(&tree.graph.group).filter(move |of| *of.1 == group);
    let [one, other] = [from, to].map(|ball| tree.graph.group[ball as usize]);
    let mut best = (f32::INFINITY, Vec3::ZERO);
    for (a, _) in of(one) {
        for (b, _) in of(other) {
            let gap = a.centre.distance(b.centre) - a.radius - b.radius;
            if gap < best.0 {
                best = (gap, a.centre + (b.centre - a.centre).normalize_or_zero() * a.radius);
            }
        }
    }
    RouteError::NoWay { at: At(best.1.to_array()), gap_mm: best.0.max(0.0) }
}

/// The centreline through these balls, and a little on at both ends.
fn line_through(tree: &Tree, numbers: &[u32]) -> Vec<Place> {
    let ball = |number: u32| tree.graph.balls[number as usize];
    let mut balls: Vec<Ball> = numbers.iter().map(|&number| ball(number)).collect();
    for at_start in [true, false] {
        let mut reached = 0.0;
        let mut last = if at_start { numbers[0] } else { numbers[numbers.len() - 1] };
        let enough = 1.5 * ball(last).radius;
        while reached < enough {
            let count = balls.len();
            let before = if count < 2 { None } else { Some(if at_start { balls[1] } else { balls[count - 2] }) };
            let away = before.map(|before| (ball(last).centre - before.centre).normalize_or_zero());
            let Some(next) = tree.graph.onward(last, away) else { break };
            reached += ball(next).centre.distance(ball(last).centre);
            if at_start {
                balls.insert(0, ball(next));
            } else {
                balls.push(ball(next));
            }
            last = next;
        }
        tree.extend(&mut balls, at_start);
    }
    centreline(&tree.space, &balls, 0.0)
}

/// The branches that a line leads through: those between its ends in the tree, or, where it takes another way around
/// a loop, those that hold a part of it that is longer than wide.
fn branches_along(tree: &Tree, points: &[RoutePoint]) -> Vec<u32> {
    let mut lengths: Vec<(u32, f64, f64)> = Vec::new();
    let mut last: Option<Located> = None;
    for (i, point) in points.iter().enumerate() {
        last = tree.locate(point.at, last.as_ref());
        let Some(found) = last else { continue };
        let length = if i > 0 { point.arc_mm - points[i - 1].arc_mm } else { 0.0 };
        match lengths.iter_mut().find(|entry| entry.0 == found.branch) {
            Some(entry) => (entry.1, entry.2) = (entry.1 + length, entry.2.max(found.radius_mm)),
            None => lengths.push((found.branch, length, found.radius_mm)),
        }
    }
    let (Some(first), Some(last)) = (lengths.first(), last) else { return Vec::new() };
    let between = between(tree, first.0, last.branch);
    let is_elsewhere = |entry: &(u32, f64, f64)| entry.1 > 2.0 * entry.2 && !between.contains(&entry.0);
    if lengths.iter().any(is_elsewhere) {
        let is_end = |branch: u32| branch == first.0 || branch == last.branch;
        lengths.iter().filter(|entry| entry.1 > 2.0 * entry.2 || is_end(entry.0)).map(|entry| entry.0).collect()
    } else {
        between
    }
}

/// The branches from one to another by the tree, both included.
pub(super) fn between(tree: &Tree, from: u32, to: u32) -> Vec<u32> {
    let up = |branch: u32| {
        std::iter::successors(Some(branch), |&at| tree.branches()[at as usize].parent).collect::<Vec<u32>>()
    };
    let (mut one, mut other) = (up(from), up(to));
    // What both come out of ends where they part, and is passed only if one of them is it.
    let mut common = None;
    while one.last() == other.last() && !one.is_empty() {
        common = one.pop();
        other.pop();
    }
    if one.is_empty() || other.is_empty() {
        one.extend(common);
    }
    one.extend(other.into_iter().rev());
    one
}

/// Branches that meet the inside of a route and are not on it.
fn left_aside(tree: &Tree, route: &[u32]) -> usize {
    let branch = |id: u32| &tree.branches()[id as usize];
    // The branch at whose end two neighbours meet.
    let joint =
        |pair: &[u32]| if branch(pair[1]).parent == Some(pair[0]) { Some(pair[0]) } else { branch(pair[0]).parent };
    let mut joints: Vec<u32> = route.windows(2).filter_map(joint).collect();
    joints.sort_unstable();
    joints.dedup();
    let meets = |other: u32| {
        let ends_there = joints.binary_search(&other).is_ok();
        ends_there || branch(other).parent.is_some_and(|parent| joints.binary_search(&parent).is_ok())
    };
    (0..tree.branches().len() as u32).filter(|&other| !route.contains(&other) && meets(other)).count()
}

/// How the vessel goes on behind a cross-section.
fn beyond(tree: &Tree, target: &CrossSection) -> Vec<Place> {
    let Some(found) = tree.locate(target.at, None) else { return Vec::new() };
    let branch = &tree.branches()[found.branch as usize];
    let next = branch.arcs.partition_point(|&arc| arc <= found.arc_mm).clamp(1, branch.points.len() - 1);
    let along = branch.points[next].at - branch.points[next - 1].at;
    let mut places = vec![Place { at: target.at, radius: target.radius }];
    if along.dot(target.normal) >= 0.0 {
        places.extend(&branch.points[next..]);
    } else {
        places.extend(branch.points[..next].iter().rev());
    }
    places.retain(|place| (place.at - target.at).dot(target.normal) > -1e-9);
    places
}

impl Route {
    /// Where `p` is along the route: next to the place whose ball holds it deepest.
    pub fn locate(&self, p: DVec3) -> OnRoute {
        deepest(&self.points, p, |point| (Place { at: point.at, radius: point.radius }, point.arc_mm))
    }

    /// The route at an arc length, between its ends.
    pub fn at(&self, arc_mm: f64) -> RoutePoint {
        let last = self.points.len() - 1;
        let arc = arc_mm.clamp(0.0, self.length_mm);
        let next = self.points.partition_point(|point| point.arc_mm <= arc).clamp(1, last);
        let (from, to) = (self.points[next - 1], self.points[next]);
        let part = ((arc - from.arc_mm) / (to.arc_mm - from.arc_mm).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        RoutePoint {
            at: from.at.lerp(to.at, part),
            radius: from.radius + (to.radius - from.radius) * part,
            arc_mm: arc,
            direction: from.direction.lerp(to.direction, part).normalize_or(from.direction),
        }
    }

    /// Distance of `p` from the target's cross-section in mm; 0 in it, and past it in the same vessel.
    pub fn distance_to_target(&self, p: DVec3) -> f64 {
        let to = p - self.target.at;
        let past = to.dot(self.target.normal);
        let across = (to - self.target.normal * past).length();
        if past >= 0.0 && self.beyond.len() > 1 {
            let place = deepest(&self.beyond, p, |&place| (place, 0.0));
            if place.distance_mm <= 1.25 * place.radius_mm {
                return 0.0;
            }
        }
        let out = (across - self.target.radius).max(0.0);
        (past * past + out * out).sqrt()
    }

    /// Whether a point, and where the tree has it, are in a branch off the route: outside of the route's lumen by more
    /// than the radius of that branch.
    pub fn is_off(&self, p: DVec3, located: &Located) -> bool {
        if self.branches.contains(&located.branch) {
            return false;
        }
        let here = self.locate(p);
        here.distance_mm > here.radius_mm + located.radius_mm
    }

    /// The radius that half of the route is narrower than, in mm.
    pub fn usual_radius_mm(&self) -> f64 {
        usual_radius(self.points.windows(2).map(|pair| (pair[1].radius, pair[1].arc_mm - pair[0].arc_mm)).collect())
    }

    /// Whether a wire of this diameter in mm fits through.
    ///
    /// # Errors
    /// [`RouteError::TooThin`], with the first place where it does not.
    pub fn clearance(&self, diameter_mm: f64) -> Result<(), RouteError> {
        match self.points.iter().find(|point| 2.0 * point.radius < diameter_mm) {
            None => Ok(()),
            Some(point) => Err(RouteError::TooThin {
                wire_mm: diameter_mm,
                lumen_mm: 2.0 * point.radius,
                at: At(point.at.as_vec3().to_array()),
                arc_mm: point.arc_mm,
            }),
        }
    }
}

/// Where `p` is along a line: next to the place whose ball holds it deepest.
fn deepest<T>(points: &[T], p: DVec3, place: impl Fn(&T) -> (Place, f64)) -> OnRoute {
    let mut best = (f64::INFINITY, OnRoute::default());
    for pair in points.windows(2) {
        let ((from, arc), (to, _)) = (place(&pair[0]), place(&pair[1]));
        let found = power(from, to, p);
        if found.power < best.0 {
            let arc_mm = arc + found.part * from.at.distance(to.at);
            best = (found.power, OnRoute { arc_mm, distance_mm: found.squared.sqrt(), radius_mm: found.radius });
        }
    }
    best.1
}

/// The place of a line next to `p`.
fn along(line: &[Place], p: DVec3) -> OnRoute {
    let arcs = arcs(line);
    let points: Vec<(Place, f64)> = line.iter().copied().zip(arcs).collect();
    deepest(&points, p, |&point| point)
}

/// The part of a line between two arc lengths.
fn cut(line: &[Place], from: f64, to: f64) -> Vec<Place> {
    let arcs = arcs(line);
    let at = |arc: f64| {
        let next = arcs.partition_point(|&a| a <= arc).clamp(1, line.len() - 1);
        let part = ((arc - arcs[next - 1]) / (arcs[next] - arcs[next - 1]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let (a, b) = (line[next - 1], line[next]);
        Place { at: a.at.lerp(b.at, part), radius: a.radius + (b.radius - a.radius) * part }
    };
    let inner = line.iter().zip(&arcs).filter(|(_, arc)| **arc > from + 1e-6 && **arc < to - 1e-6);
    std::iter::once(at(from)).chain(inner.map(|(place, _)| *place)).chain(std::iter::once(at(to))).collect()
}
