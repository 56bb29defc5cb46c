//! Ways through linked balls, and the tree that they make.
//!
//! A link costs its length over the square of what fits through it, so that the cheapest way keeps to the middle of the
//! lumen and to wide vessels. The tree is found as by Sato et al., "TEASAR: tree-structure extraction algorithm for
//! accurate and robust skeletons" (2000): from a root, the way to the farthest ball that no way explains yet is added
//! until none is left that is far enough from the rest to be a vessel.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};

use glam::Vec3;

use super::balls::Balls;
use lumen_mesh::Ball;

/// No ball.
pub const NONE: u32 = u32::MAX;
/// A closed branch is at least so many of its mean diameters long, out of the lumen that it leaves and with the ball at its
/// tip; what is shorter is a bump, or the corner of a cap or rim. The mean is over the length: towards a corner the balls
/// become ever smaller, and 2 diameters are more than any corner of 60 degrees or wider has.
const DIAMETERS: f32 = 2.0;
/// What is beside it counts as width, too: in the wedge between two walls, or along the rim of a cap, balls stand side by side,
/// and each row of them is no vessel. It is looked at in these places of the branch's length, most of which decide.
const BESIDE: [f32; 3] = [0.3, 0.5, 0.7];
/// And it sticks out by this part of the radius that it comes out of.
const STICKS_OUT_OF: f32 = 0.35;
/// One that is half of a loop may be short: it sticks out by this many of its end's radii.
const STICKS_OUT_LOOP: f32 = 1.0;
/// One with an open end sticks out by this many of its end's radii.
const STICKS_OUT_OPEN: f32 = 0.3;

/// A way that has only balls of at most this part of its vessel's radius left has come into a branch. A vessel that divides
/// goes on about as wide: by Murray's law in 8 vessels as thin as this.
const MUCH_THINNER: f32 = 0.5;
/// It counts from so many of the vessel's radii on: before that it narrows.
const FUNNEL: f32 = 1.3;
/// A ball is one of its vessel if its radius is at least this part of the vessel's.
const AS_WIDE: f32 = 0.7;
/// A branch leaves sideways if the cosine between the vessel and the branch is less: 45 degrees. What goes straight on is the
/// vessel itself, narrowed, where no more of it is ahead.
const SIDEWAYS: f32 = 0.7;

/// Linked balls as compressed rows.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    pub balls: Vec<Ball>,
    pub is_passing: Vec<bool>,
    pub group: Vec<u32>,
    offsets: Vec<u32>,
    /// The other ball, the length and the cost of each link.
    links: Vec<(u32, f32, f64)>,
}

/// The cheapest ways from one ball to all that can be reached.
#[derive(Clone, Debug)]
pub struct Ways {
    /// The ball before, on the way.
    pub before: Vec<u32>,
    /// Length of the way in mm; infinite where there is none.
    pub length: Vec<f32>,
}

/// The tree of ways from a root.
#[derive(Clone, Debug, Default)]
pub struct Skeleton {
    /// The first is through to the far end.
    pub paths: Vec<Path>,
    /// How many bumps, corners and stumps were too short to be a branch.
    pub bumps: usize,
}

/// A way that is part of the tree, from where it leaves the rest to its end.
#[derive(Clone, Debug)]
pub struct Path {
    /// The path that it leaves; itself for the first.
    pub parent: usize,
    /// Where it leaves that one: the number of a ball of its list.
    pub joint: usize,
    /// Its balls; those of a branch begin outside of its parent.
    pub balls: Vec<u32>,
}

impl Graph {
    pub fn new(found: Balls) -> Self {
        let Balls { balls, is_passing, links: pairs, group, .. } = found;
        let mut offsets = vec![0u32; balls.len() + 1];
        for pair in &pairs {
            pair.iter().for_each(|&end| offsets[end as usize + 1] += 1);
        }
        for ball in 0..balls.len() {
            offsets[ball + 1] += offsets[ball];
        }
        let mut cursor = offsets.clone();
        let mut links = vec![(0, 0.0, 0.0); 2 * pairs.len()];
        for &[a, b] in &pairs {
            let [one, other] = [a, b].map(|ball| &balls[ball as usize]);
            let length = one.centre.distance(other.centre);
            let clear = f64::from(one.passage(other)).max(1e-12);
            for (from, to) in [(a, b), (b, a)] {
                links[cursor[from as usize] as usize] = (to, length, f64::from(length) / (clear * clear));
                cursor[from as usize] += 1;
            }
        }
        Self { balls, is_passing, group, offsets, links }
    }

    fn links(&self, ball: u32) -> &[(u32, f32, f64)] {
        &self.links[self.offsets[ball as usize] as usize..self.offsets[ball as usize + 1] as usize]
    }

    /// The cheapest ways from `root` (Dijkstra 1959); of ways of the same cost, that by the balls of lower number.
    pub fn ways(&self, root: u32) -> Ways {
        let count = self.balls.len();
        let mut ways = Ways { before: vec![NONE; count], length: vec![f32::INFINITY; count] };
        let mut cost = vec![f64::INFINITY; count];
        let mut queue = BinaryHeap::new();
        cost[root as usize] = 0.0;
        ways.length[root as usize] = 0.0;
        queue.push(Reverse((0u64, root)));
        while let Some(Reverse((bits, ball))) = queue.pop() {
            // Numbers that are not negative are ordered as their bits are.
            if f64::from_bits(bits) > cost[ball as usize] {
                continue;
            }
            for &(next, length, price) in self.links(ball) {
                let sum = cost[ball as usize] + price;
                if sum < cost[next as usize] {
                    cost[next as usize] = sum;
                    ways.before[next as usize] = ball;
                    ways.length[next as usize] = ways.length[ball as usize] + length;
                    queue.push(Reverse((sum.to_bits(), next)));
                }
            }
        }
        ways
    }

    /// The linked ball that goes on from `ball` most nearly straight `away`, or the farthest if there is no saying.
    pub fn onward(&self, ball: u32, away: Option<Vec3>) -> Option<u32> {
        let from = self.balls[ball as usize].centre;
        let mut best = (0.6, None);
        for &(next, length, _) in self.links(ball) {
            let way = (self.balls[next as usize].centre - from) / length.max(f32::MIN_POSITIVE);
            let straight = away.map_or(length, |away| way.dot(away));
            if straight > best.0 && !self.is_passing[next as usize] {
                best = (straight, Some(next));
            }
        }
        best.1
    }

    /// The tree of ways from `root`.
    pub fn tree(&self, root: u32, is_open: impl Fn(&Ball) -> bool) -> Skeleton {
        let ways = self.ways(root);
        let mut order: Vec<u32> = (0..self.balls.len() as u32)
            .filter(|&ball| ways.length[ball as usize].is_finite() && !self.is_passing[ball as usize])
            .collect();
        order.sort_unstable_by(|&a, &b| ways.length[b as usize].total_cmp(&ways.length[a as usize]).then(a.cmp(&b)));
        let count = self.balls.len();
        let along_x = AlongX::new(&self.balls);
        let mut covering = Covering { owner: vec![None; count], seen: vec![NONE; count], along_x };
        let mut found = Skeleton::default();
        // Balls on the way to the tip of a bump: what else ends there is of the same.
        let mut is_bump = vec![false; count];
        let mut next = 0;
        while let Some(&end) = order.get(next) {
            if covering.owner[end as usize].is_some() {
                next += 1;
                continue;
            }
            let mut free = vec![end];
            let mut met = None;
            let mut at = end;
            while ways.before[at as usize] != NONE {
                at = ways.before[at as usize];
                met = covering.owner[at as usize];
                if met.is_some() {
                    break;
                }
                free.push(at);
            }
            free.reverse();
            match met {
                None if found.paths.is_empty() => {
                    let free = self.to_end_of_vessel(&ways, free, &is_open);
                    covering.add(self, 0, &free);
                    found.paths.push(Path { parent: 0, joint: 0, balls: free });
                }
                None => next += 1,
                Some((parent, _)) => {
                    let first = self.balls[free[0] as usize];
                    let joint = self.nearest_of(&found.paths[parent].balls, &first);
                    let trunk = self.balls[found.paths[parent].balls[joint] as usize];
                    let out = ways.length[end as usize] - ways.length[free[0] as usize]
                        + (first.centre.distance(trunk.centre) - trunk.radius).max(0.0);
                    let tip = self.balls[end as usize];
                    // The mean radius that a branch of this length may have.
                    let (mean, most) = (self.mean_radius(&free), (out + tip.radius) / (2.0 * DIAMETERS));
                    let is_loop = || {
                        out >= STICKS_OUT_LOOP * tip.radius && self.closes_loop(&ways, &covering.owner, &free, &trunk)
                    };
                    let is_branch = if is_open(&tip) {
                        out >= STICKS_OUT_OPEN * tip.radius
                    } else {
                        out >= STICKS_OUT_OF * trunk.radius
                            && (most >= mean || is_loop())
                            && self.is_tube(&free, mean.max(most))
                    };
                    if is_branch {
                        let free = self.to_end_of_vessel(&ways, free, &is_open);
                        covering.add(self, found.paths.len(), &free);
                        found.paths.push(Path { parent, joint, balls: free });
                    } else {
                        next += 1;
                        found.bumps += usize::from(free.iter().all(|&ball| !is_bump[ball as usize]));
                        free.iter().for_each(|&ball| is_bump[ball as usize] = true);
                    }
                }
            }
        }
        found
    }
}

/// Where a way leaves its vessel for a much thinner one.
struct Leaving {
    /// The place of the vessel's last ball in the way.
    last: usize,
    /// Whether the thinner one goes off to the side.
    is_sideways: bool,
}

impl Graph {
    /// The tree's root, or where it is on a thin branch of the widest vessel, that vessel's end on the side of the branch.
    pub fn wide_root(&self, tree: &Skeleton, is_open: impl Fn(&Ball) -> bool) -> Option<u32> {
        let widest = |path: &Path| path.balls.iter().map(|&ball| self.balls[ball as usize].radius).fold(0.0, f32::max);
        let widest = tree.paths.iter().map(|path| (widest(path), path));
        let (_, vessel) = widest.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
        let (root, far) = (*tree.paths.first()?.balls.first()?, *vessel.balls.last()?);
        let ways = self.ways(far);
        let before = |&at: &u32| Some(ways.before[at as usize]).filter(|&before| before != NONE);
        let mut way: Vec<u32> = std::iter::successors(Some(root), before).collect();
        way.reverse();
        self.to_end_of_vessel(&ways, way, is_open).last().copied()
    }

    /// A way, or where it leaves its vessel for a much thinner one, its part up to there with what of the vessel is ahead.
    /// What is cut off is met again as a branch. Ways to open ends stay as they are.
    fn to_end_of_vessel(&self, ways: &Ways, way: Vec<u32>, is_open: impl Fn(&Ball) -> bool) -> Vec<u32> {
        let Some(Leaving { last, is_sideways }) = self.leaving(&way) else { return way };
        let wide = self.balls[way[last] as usize];
        // Ways from the root part and never meet, so that each ball is come to once.
        let (mut end, mut pending) = (way[last], vec![way[last]]);
        while let Some(at) = pending.pop() {
            if (ways.length[at as usize], end) > (ways.length[end as usize], at) {
                end = at;
            }
            let is_next = |next: u32| {
                ways.before[next as usize] == at && self.balls[next as usize].radius >= AS_WIDE * wide.radius
            };
            pending.extend(self.links(at).iter().map(|link| link.0).filter(|&next| is_next(next)));
        }
        let tip = self.balls[end as usize];
        let is_on_way = way.iter().any(|&ball| {
            let ball = self.balls[ball as usize];
            ball.centre.distance(tip.centre) <= ball.radius
        });
        let is_any_open = is_open(&tip) || way.last().is_some_and(|&ball| is_open(&self.balls[ball as usize]));
        if is_any_open || (is_on_way && !is_sideways) {
            return way;
        }
        let mut ahead = Vec::new();
        while end != way[last] {
            ahead.push(end);
            end = ways.before[end as usize];
        }
        way[..=last].iter().copied().chain(ahead.into_iter().rev()).collect()
    }

    /// Where a way leaves its vessel for a much thinner one in which it ends.
    fn leaving(&self, way: &[u32]) -> Option<Leaving> {
        let ball = |place: usize| self.balls[way[place] as usize];
        let apart = |a: usize, b: usize| ball(a).centre.distance(ball(b).centre);
        // The widest of each place and those after it.
        let mut widest = vec![0.0f32; way.len() + 1];
        (0..way.len()).rev().for_each(|place| widest[place] = widest[place + 1].max(ball(place).radius));
        let beyond =
            |from: usize, radii: f32| (from..way.len()).find(|&to| apart(from, to) >= radii * ball(from).radius);
        let leaves = |last: usize| {
            let out = beyond(last, FUNNEL)?;
            (widest[out] <= MUCH_THINNER * ball(last).radius).then_some((last, out))
        };
        let (last, out) = (0..way.len()).find_map(leaves)?;
        let wide = ball(last).radius;
        // With the ball at its end the vessel is as long as a branch has to be, and as wide over that length.
        let mut length = 0.0;
        let first = (0..last).rev().find(|&place| {
            length += apart(place, place + 1);
            length + wide >= 2.0 * DIAMETERS * wide
        })?;
        if way[first..last].iter().any(|&ball| self.balls[ball as usize].radius < AS_WIDE * wide) {
            return None;
        }
        let before = (first..last).rev().find(|&place| apart(place, last) >= wide).unwrap_or(first);
        let leaving = if out + 1 < way.len() { out } else { last };
        let away = ball(beyond(leaving, 1.0).unwrap_or(way.len() - 1)).centre - ball(leaving).centre;
        let along = ball(last).centre - ball(before).centre;
        let is_sideways = along.normalize_or_zero().dot(away.normalize_or_zero()) < SIDEWAYS;
        Some(Leaving { last, is_sideways })
    }

    /// Whether one of the balls, which come out of `trunk`, is linked with one whose own way is from elsewhere.
    fn closes_loop(&self, ways: &Ways, owner: &[Option<(usize, usize)>], balls: &[u32], trunk: &Ball) -> bool {
        let comes_from_elsewhere = |&(mut at, ..): &(u32, f32, f64)| {
            while owner[at as usize].is_none() && ways.before[at as usize] != NONE {
                at = ways.before[at as usize];
            }
            let from = self.balls[at as usize];
            from.centre.distance(trunk.centre) > from.radius + trunk.radius
        };
        balls.iter().any(|&ball| self.links(ball).iter().any(comes_from_elsewhere))
    }

    /// Whether in most places of a row of balls no linked ball stands farther beside it than `widest`.
    fn is_tube(&self, balls: &[u32], widest: f32) -> bool {
        let wide = BESIDE.iter().filter(|&&part| {
            let i = (part * (balls.len() - 1) as f32).round() as usize;
            let [before, ball, after] = [i.saturating_sub(1), i, (i + 1).min(balls.len() - 1)].map(|i| balls[i]);
            let along = self.balls[after as usize].centre - self.balls[before as usize].centre;
            self.reaches_beside(ball, along.normalize_or_zero(), widest)
        });
        2 * wide.count() <= BESIDE.len()
    }

    /// Whether by links, in the slab across `along` that is as thick as a ball, there is one more than `widest` from its middle.
    fn reaches_beside(&self, ball: u32, along: Vec3, widest: f32) -> bool {
        let Ball { centre, radius } = self.balls[ball as usize];
        let (mut seen, mut pending) = (HashSet::from([ball]), vec![ball]);
        while let Some(at) = pending.pop() {
            for &(other, ..) in self.links(at) {
                let to = self.balls[other as usize].centre - centre;
                let height = to.dot(along);
                if height.abs() <= radius && seen.insert(other) {
                    if (to - along * height).length() > widest {
                        return true;
                    }
                    pending.push(other);
                }
            }
        }
        false
    }

    /// The mean radius along balls, by length.
    fn mean_radius(&self, balls: &[u32]) -> f32 {
        let ball = |number: u32| self.balls[number as usize];
        let (mut length, mut sum) = (0.0, 0.0);
        for pair in balls.windows(2) {
            let [from, to] = [ball(pair[0]), ball(pair[1])];
            let step = from.centre.distance(to.centre);
            length += step;
            sum += step * (from.radius + to.radius) / 2.0;
        }
        if length > 0.0 { sum / length } else { ball(balls[0]).radius }
    }

    /// The place in a path whose middle is nearest to a ball.
    fn nearest_of(&self, path: &[u32], ball: &Ball) -> usize {
        let distance = |&other: &u32| self.balls[other as usize].centre.distance(ball.centre);
        let places = path.iter().map(distance).enumerate();
        places.reduce(|least, next| if next.1 < least.1 { next } else { least }).map_or(0, |(place, _)| place)
    }
}

/// Which ball is explained by which path.
struct Covering {
    /// The path and the number in its list.
    owner: Vec<Option<(usize, usize)>>,
    /// By which ball each was looked at last.
    seen: Vec<u32>,
    along_x: AlongX,
}

impl Covering {
    /// All balls of their group whose middle lies in one of the path's balls, or a little out of it, by links.
    fn add(&mut self, graph: &Graph, path: usize, balls: &[u32]) {
        let mut pending = Vec::new();
        for (place, &middle) in balls.iter().enumerate() {
            let by = graph.balls[middle as usize];
            self.owner[middle as usize] = Some((path, place));
            self.seen[middle as usize] = middle;
            pending.push(middle);
            while let Some(at) = pending.pop() {
                for &(next, ..) in graph.links(at) {
                    let other = graph.balls[next as usize];
                    if self.seen[next as usize] != middle && other.centre.distance(by.centre) <= by.radius * 1.05 {
                        self.seen[next as usize] = middle;
                        self.owner[next as usize].get_or_insert((path, place));
                        pending.push(next);
                    }
                }
            }
            // Two chains of balls may stand side by side in a vessel, and not be linked here.
            for other in self.along_x.within(by.centre.x - by.radius, by.centre.x + by.radius) {
                let is_inside = graph.balls[other as usize].centre.distance(by.centre) <= by.radius;
                if is_inside && graph.group[other as usize] == graph.group[middle as usize] {
                    self.owner[other as usize].get_or_insert((path, place));
                }
            }
        }
    }
}

/// The balls in the order of their x.
struct AlongX(Vec<(f32, u32)>);

impl AlongX {
    fn new(balls: &[Ball]) -> Self {
        let mut order: Vec<(f32, u32)> = (0..).zip(balls).map(|(number, ball)| (ball.centre.x, number)).collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Self(order)
    }

    /// The balls with their middle from `low` to `high`.
    fn within(&self, low: f32, high: f32) -> impl Iterator<Item = u32> {
        let [first, end] = [self.0.partition_point(|at| at.0 < low), self.0.partition_point(|at| at.0 <= high)];
        self.0[first..end].iter().map(|at| at.1)
    }
}
