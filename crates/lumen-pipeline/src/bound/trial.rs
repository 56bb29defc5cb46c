//! One level put to the test: first by its vertices and some points of its triangles, which as a rule finds what is
//! beyond at once, then to the last point.

use std::task::Poll;

use glam::Vec3;

use super::history::births;
use crate::progressive::ProgressiveMesh;
use lumen_mesh::{IndexBuild, Reach, SurfaceIndex, TriMesh};

/// Queries or pieces between two looks at the clock.
const QUERIES: usize = 64;
/// Units of lighter work between two looks at the clock.
pub(super) const UNITS: usize = 8192;
/// Points that rule out a level at most: the more, the longer the leap, and the longer each step of it.
const POINTS: usize = 24;

/// What rules out a level.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Witness {
    /// Points of the finest level that are beyond the bound of this one.
    Points(Vec<Vec3>),
    /// A triangle, part of every level from `birth` steps to this one, with a point that is `distance` mm from the
    /// finest.
    Triangle { birth: u32, distance: f64 },
}

/// What stays true from one level to another. A triangle as it stands is known by its number and its birth.
pub(super) struct Memory {
    /// For each triangle, the birth of one of which some points were within.
    seen: Vec<u32>,
    /// For each triangle, the birth of one of which all was within.
    coarse: Vec<u32>,
    /// For each triangle of the finest level, a triangle and its birth within whose bound it is.
    fine: Vec<(u32, u32)>,
}

/// A birth that no triangle has.
const NO_BIRTH: u32 = u32::MAX;

impl Memory {
    /// What is known of a surface of so many triangles: that none of them is far from itself.
    pub(super) fn new(triangles: usize) -> Self {
        Self {
            seen: vec![0; triangles],
            coarse: vec![0; triangles],
            fine: (0..triangles as u32).map(|t| (t, 0)).collect(),
        }
    }
}

/// The surfaces that a trial compares.
pub(super) struct Surfaces<'a> {
    pub(super) progressive: &'a ProgressiveMesh,
    pub(super) finest: &'a TriMesh,
    pub(super) fine: &'a SurfaceIndex,
    /// Whether each node is a vertex of the finest level; a method may make others.
    pub(super) is_vertex: &'a [bool],
}

/// A level that is being tried.
pub(super) struct Trial {
    pub(super) steps: u32,
    bound: f64,
    level: Vec<[u32; 3]>,
    build: IndexBuild,
    index: SurfaceIndex,
    stage: Stage,
    next: usize,
    beyond: Vec<Vec3>,
    births: Vec<u32>,
    witness: Option<Witness>,
    reach: Reach,
    /// Triangles still to be settled, in this order.
    order: Vec<u32>,
    /// Whether the triangle in hand was begun.
    is_begun: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Index,
    /// Vertices that are gone.
    Nodes,
    /// Corners, middles of sides and centroids of the level's triangles.
    Points,
    /// The level's triangles, to the last point.
    Coarse,
    /// The finest level's triangles, to the last point.
    Fine,
}

impl Trial {
    /// A trial of the level after `steps` steps by a bound of `bound` mm.
    pub(super) fn new(progressive: &ProgressiveMesh, steps: u32, bound: f64) -> Self {
        Self {
            steps,
            bound,
            level: progressive.triangles_at(steps),
            build: IndexBuild::new(),
            index: SurfaceIndex::default(),
            stage: Stage::Index,
            next: 0,
            beyond: Vec::new(),
            births: Vec::new(),
            witness: None,
            reach: Reach::new(bound),
            order: Vec::new(),
            is_begun: false,
        }
    }

    /// One piece of work: `Ready(None)` where the level is within.
    pub(super) fn advance(&mut self, all: &Surfaces<'_>, memory: &mut Memory) -> Poll<Option<Witness>> {
        let found = match self.stage {
            Stage::Index => self.build.advance(&all.progressive.positions, &self.level, UNITS).map(|index| {
                self.index = index;
                None
            }),
            Stage::Nodes => self.nodes(all),
            Stage::Points => self.points(all, memory),
            Stage::Coarse => self.coarse(all, memory),
            Stage::Fine => self.fine(all, memory),
        };
        if found != Poll::Ready(None) {
            return found;
        }
        self.next = 0;
        self.stage = match self.stage {
            Stage::Index => Stage::Nodes,
            Stage::Nodes => {
                self.births = births(all.progressive, self.steps);
                Stage::Points
            }
            Stage::Points => {
                let is_open = |&t: &u32| memory.coarse[t as usize] != self.births[t as usize];
                self.order = self.index.triangles().filter(is_open).collect();
                Stage::Coarse
            }
            Stage::Coarse => {
                let is_open = |&t: &u32| {
                    let (by, birth) = memory.fine[t as usize];
                    self.births.get(by as usize) != Some(&birth)
                };
                self.order = all.fine.triangles().filter(is_open).collect();
                Stage::Fine
            }
            Stage::Fine => return Poll::Ready(None),
        };
        Poll::Pending
    }

    /// Vertices that are gone, the first to go first: they rule out most levels. (Those of the level are on it.)
    fn nodes(&mut self, all: &Surfaces<'_>) -> Poll<Option<Witness>> {
        let ProgressiveMesh { positions, node_ends, .. } = all.progressive;
        let alive = node_ends.partition_point(|&end| end >= self.steps);
        let gone = &positions[alive..];
        let end = gone.len().min(self.next + QUERIES);
        let vertices = gone.iter().zip(&all.is_vertex[alive..]).rev();
        for (&p, &is_vertex) in vertices.skip(self.next).take(QUERIES) {
            if is_vertex && p.is_finite() && !self.index.is_within(p, self.bound as f32) {
                self.beyond.push(p);
            }
        }
        self.next = end;
        if self.beyond.len() >= POINTS || (end == gone.len() && !self.beyond.is_empty()) {
            return Poll::Ready(Some(Witness::Points(std::mem::take(&mut self.beyond))));
        }
        if end == gone.len() { Poll::Ready(None) } else { Poll::Pending }
    }

    /// Some points of the level's triangles; the witness is the oldest triangle that is beyond.
    fn points(&mut self, all: &Surfaces<'_>, memory: &mut Memory) -> Poll<Option<Witness>> {
        let end = self.level.len().min(self.next + QUERIES / 4);
        for t in self.next..end {
            if memory.seen[t] == self.births[t] {
                continue;
            }
            let [a, b, c] = self.level[t].map(|v| all.progressive.positions[v as usize]);
            let points = [(a + b + c) / 3.0, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, a, b, c];
            let is_new = self.level[t].iter().any(|&v| !all.is_vertex[v as usize]);
            let points = &points[..if is_new { 7 } else { 4 }];
            match points.iter().find(|&&p| !all.fine.is_within(p, self.bound as f32)) {
                None => memory.seen[t] = self.births[t],
                Some(&p) => self.offer(t, distance(all.fine, p)),
            }
        }
        self.next = end;
        if end == self.level.len() { Poll::Ready(self.witness.take()) } else { Poll::Pending }
    }

    /// Keeps triangle `t` as a witness if it is older than the one there is.
    fn offer(&mut self, t: usize, distance: f64) {
        let birth = self.births[t];
        if !matches!(self.witness, Some(Witness::Triangle { birth: oldest, .. }) if oldest <= birth) {
            self.witness = Some(Witness::Triangle { birth, distance });
        }
    }

    fn coarse(&mut self, all: &Surfaces<'_>, memory: &mut Memory) -> Poll<Option<Witness>> {
        for _ in 0..QUERIES {
            let Some(&t) = self.order.get(self.next) else { return Poll::Ready(self.witness.take()) };
            let t = t as usize;
            let corners = || self.level[t].map(|v| all.progressive.positions[v as usize]);
            match settle(&mut self.reach, &mut self.is_begun, corners, all.fine) {
                Settled::Open => return Poll::Pending,
                Settled::Within(_) => memory.coarse[t] = self.births[t],
                Settled::Beyond(found) => self.offer(t, found.distance),
            }
            self.next += 1;
        }
        Poll::Pending
    }

    fn fine(&mut self, all: &Surfaces<'_>, memory: &mut Memory) -> Poll<Option<Witness>> {
        for _ in 0..QUERIES {
            let Some(&t) = self.order.get(self.next) else { return Poll::Ready(None) };
            let t = t as usize;
            match settle(&mut self.reach, &mut self.is_begun, || all.finest.corners(t), &self.index) {
                Settled::Open => return Poll::Pending,
                Settled::Within(by) => {
                    memory.fine[t] = by.map_or((0, NO_BIRTH), |by| (by, self.births[by as usize]));
                }
                Settled::Beyond(found) => return Poll::Ready(Some(Witness::Points(vec![found.point]))),
            }
            self.next += 1;
        }
        Poll::Pending
    }
}

/// What came of a triangle.
enum Settled {
    Open,
    /// It is within; of this one triangle, if it was one.
    Within(Option<u32>),
    Beyond(lumen_mesh::Beyond),
}

/// Goes on with a triangle, from its beginning unless `is_begun`.
fn settle(reach: &mut Reach, is_begun: &mut bool, corners: impl Fn() -> [Vec3; 3], surface: &SurfaceIndex) -> Settled {
    let is_whole = !*is_begun;
    if is_whole {
        reach.begin(corners());
    }
    let settled = match reach.advance(surface, if is_whole { 1 } else { QUERIES }) {
        Poll::Ready(None) => Settled::Within(reach.nearest().filter(|_| is_whole)),
        Poll::Ready(Some(found)) => Settled::Beyond(found),
        Poll::Pending => Settled::Open,
    };
    *is_begun = matches!(settled, Settled::Open);
    settled
}

/// Distance of `p` from a surface in mm; infinite from one of no triangles.
pub(super) fn distance(surface: &SurfaceIndex, p: Vec3) -> f64 {
    surface.nearest(p).map_or(f64::INFINITY, |found| f64::from(found.distance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::distance_to_triangle;
    use lumen_mesh::shapes::square;

    /// What comes of a triangle.
    fn settled(corners: [Vec3; 3], surface: &SurfaceIndex, bound: f64) -> Settled {
        let (mut reach, mut is_begun) = (Reach::new(bound), false);
        loop {
            match settle(&mut reach, &mut is_begun, || corners, surface) {
                Settled::Open => assert!(is_begun),
                settled => {
                    assert!(!is_begun, "the next triangle begins anew");
                    return settled;
                }
            }
        }
    }

    #[test]
    fn a_triangle_is_put_down_to_one_only_where_that_one_is_near_to_all_of_it() {
        // A square of 8 by 8 cells of two triangles, and above it triangles over part of a cell and over many.
        let ground = square(8, 8.0, 0.0);
        let surface = SurfaceIndex::new(&ground.positions, &ground.triangles);
        let (height, bound) = (0.01, 0.011);
        let (mut of_one, mut of_many) = (0, 0);
        for i in 0..64 {
            let at = Vec3::new((i % 8) as f32, (i / 8) as f32, height);
            let size = if i % 2 == 0 { 0.2 } else { 3.0 };
            let way =
                |x: f32, y: f32| (at + Vec3::new(x, y, 0.0) * size).clamp(Vec3::ZERO, Vec3::new(8.0, 8.0, height));
            let corners = [way(0.3, 0.1), way(0.9, 0.2), way(0.8, 0.7)];
            match settled(corners, &surface, bound) {
                // The distance from a triangle is convex: what is near at the corners is so between them.
                Settled::Within(Some(by)) => {
                    let off = corners.map(|p| distance_to_triangle(p, ground.corners(by as usize)));
                    assert!(off.iter().all(|&off| off <= bound), "{corners:?} by {by}: {off:?}");
                    of_one += 1;
                }
                Settled::Within(None) => of_many += 1,
                Settled::Open | Settled::Beyond(_) => panic!("all is {height} mm above the square"),
            }
        }
        assert!(of_one > 20 && of_many > 20, "{of_one} {of_many}");
    }
}
