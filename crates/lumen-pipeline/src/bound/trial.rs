//! One level put to the test: first by its vertices and some points of its triangles, which as a rule finds what is
//! beyond at once, then to the last point.

use std::task::Poll;

use glam::Vec3;

use super::history::births;
use crate::progressive::ProgressiveMesh;
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{HausdorffBound, SurfaceIndex};

/// Queries or pieces between two looks at the clock.
const QUERIES: usize = 64;
/// Units of lighter work between two looks at the clock.
pub(super) const UNITS: usize = 8192;
/// Points that rule out a level at most: the more, the longer the leap, and the longer each step of it.
const POINTS: usize = 24;

/// What rules out a level.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Counterexample {
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
    /// Of the finest level.
    pub(super) fine: &'a SurfaceIndex,
    /// Whether each node is a vertex of the finest level; a method may make others.
    pub(super) is_vertex: &'a [bool],
}

/// What rules out the level after `steps` steps by a bound of `bound` mm; `None` where it is within.
pub(super) async fn ruled_out(
    all: &Surfaces<'_>,
    steps: u32,
    bound: f64,
    memory: &mut Memory,
    yielder: &Yielder,
) -> Option<Counterexample> {
    let triangles = all.progressive.triangles_at(steps);
    yielder.rest(0.0).await;
    let index = SurfaceIndex::build(&all.progressive.positions, &triangles, yielder).await;
    let mut level = Level { steps, bound, triangles, index, births: Vec::new() };
    if let Some(witness) = level.nodes(all, yielder).await {
        return Some(witness);
    }
    level.births = births(all.progressive, steps);
    if let Some(witness) = level.points(all, memory, yielder).await {
        return Some(witness);
    }
    match level.coarse(all, memory, yielder).await {
        Some(witness) => Some(witness),
        None => level.fine(all, memory, yielder).await,
    }
}

/// A level that is being tried.
struct Level {
    steps: u32,
    bound: f64,
    triangles: Vec<[u32; 3]>,
    index: SurfaceIndex,
    births: Vec<u32>,
}

impl Level {
    /// Vertices that are gone, the first to go first: they rule out most levels. (Those of the level are on it.)
    async fn nodes(&self, all: &Surfaces<'_>, yielder: &Yielder) -> Option<Counterexample> {
        let ProgressiveMesh { positions, node_ends, .. } = all.progressive;
        let alive = node_ends.partition_point(|&end| end >= self.steps);
        let (gone, is_vertex) = (&positions[alive..], &all.is_vertex[alive..]);
        let mut beyond = Vec::new();
        for (gone, is_vertex) in gone.rchunks(QUERIES).zip(is_vertex.rchunks(QUERIES)) {
            for (&p, &is_vertex) in gone.iter().zip(is_vertex).rev() {
                if is_vertex && p.is_finite() && !self.index.is_within(p, self.bound as f32) {
                    beyond.push(p);
                }
            }
            if beyond.len() >= POINTS {
                break;
            }
            yielder.rest(0.0).await;
        }
        (!beyond.is_empty()).then_some(Counterexample::Points(beyond))
    }

    /// Some points of the level's triangles; the witness is the oldest triangle that is beyond.
    async fn points(&self, all: &Surfaces<'_>, memory: &mut Memory, yielder: &Yielder) -> Option<Counterexample> {
        let mut oldest = Oldest::default();
        for block in blocks(self.triangles.len(), QUERIES / 4) {
            for t in block {
                if memory.seen[t] == self.births[t] {
                    continue;
                }
                let [a, b, c] = self.corners(all, t);
                let points = [(a + b + c) / 3.0, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, a, b, c];
                let is_new = self.triangles[t].iter().any(|&v| !all.is_vertex[v as usize]);
                let points = &points[..if is_new { 7 } else { 4 }];
                match points.iter().find(|&&p| !all.fine.is_within(p, self.bound as f32)) {
                    None => memory.seen[t] = self.births[t],
                    Some(&p) => oldest.offer(self.births[t], distance(all.fine, p)),
                }
            }
            yielder.rest(0.0).await;
        }
        oldest.witness()
    }

    /// The level's triangles, to the last point.
    async fn coarse(&self, all: &Surfaces<'_>, memory: &mut Memory, yielder: &Yielder) -> Option<Counterexample> {
        let is_open = |&t: &u32| memory.coarse[t as usize] != self.births[t as usize];
        let order: Vec<u32> = self.index.triangles().filter(is_open).collect();
        let (mut oldest, mut reach) = (Oldest::default(), HausdorffBound::new(self.bound));
        for block in order.chunks(QUERIES) {
            for &t in block {
                let t = t as usize;
                match settle(&mut reach, self.corners(all, t), all.fine, yielder).await {
                    Settled::Within(_) => memory.coarse[t] = self.births[t],
                    Settled::FarPoint(found) => oldest.offer(self.births[t], found.distance),
                }
            }
            yielder.rest(0.0).await;
        }
        oldest.witness()
    }

    /// The finest level's triangles, to the last point.
    async fn fine(&self, all: &Surfaces<'_>, memory: &mut Memory, yielder: &Yielder) -> Option<Counterexample> {
        let is_open = |&t: &u32| {
            let (by, birth) = memory.fine[t as usize];
            self.births.get(by as usize) != Some(&birth)
        };
        let order: Vec<u32> = all.fine.triangles().filter(is_open).collect();
        let mut reach = HausdorffBound::new(self.bound);
        for block in order.chunks(QUERIES) {
            for &t in block {
                let t = t as usize;
                let ProgressiveMesh { positions, triangles, .. } = all.progressive;
                let corners = triangles[t].map(|v| positions[v as usize]);
                match settle(&mut reach, corners, &self.index, yielder).await {
                    Settled::Within(by) => {
                        memory.fine[t] = by.map_or((0, NO_BIRTH), |by| (by, self.births[by as usize]));
                    }
                    Settled::FarPoint(found) => return Some(Counterexample::Points(vec![found.point])),
                }
            }
            yielder.rest(0.0).await;
        }
        None
    }

    fn corners(&self, all: &Surfaces<'_>, t: usize) -> [Vec3; 3] {
        self.triangles[t].map(|v| all.progressive.positions[v as usize])
    }
}

/// The oldest triangle that is beyond, by its birth, and a distance of it.
#[derive(Default)]
struct Oldest(Option<(u32, f64)>);

impl Oldest {
    fn offer(&mut self, birth: u32, distance: f64) {
        if self.0.is_none_or(|(oldest, _)| birth < oldest) {
            self.0 = Some((birth, distance));
        }
    }

    fn witness(self) -> Option<Counterexample> {
        self.0.map(|(birth, distance)| Counterexample::Triangle { birth, distance })
    }
}

/// What came of a triangle.
enum Settled {
    /// It is within; of this one triangle, if it was one.
    Within(Option<u32>),
    FarPoint(lumen_mesh::FarPoint),
}

/// Whether a triangle is within the bound of a surface.
async fn settle(reach: &mut HausdorffBound, corners: [Vec3; 3], surface: &SurfaceIndex, yielder: &Yielder) -> Settled {
    reach.begin(corners);
    let mut is_whole = true;
    let mut found = reach.advance(surface, 1);
    while found.is_pending() {
        yielder.rest(0.0).await;
        is_whole = false;
        found = reach.advance(surface, QUERIES);
    }
    match found {
        Poll::Ready(Some(found)) => Settled::FarPoint(found),
        _ => Settled::Within(reach.nearest().filter(|_| is_whole)),
    }
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
    use lumen_mesh::task::at_once;

    /// What comes of a triangle.
    fn settled(corners: [Vec3; 3], surface: &SurfaceIndex, bound: f64) -> Settled {
        at_once(settle(&mut HausdorffBound::new(bound), corners, surface, &Yielder::never()))
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
                Settled::FarPoint(_) => panic!("all is {height} mm above the square"),
            }
        }
        assert!(of_one > 20 && of_many > 20, "{of_one} {of_many}");
    }
}
