//! The stop by deviation: the coarsest level that stays within a bound of the surface that entered decimation.
//!
//! A level is *within* the bound when no point of it is farther than the bound from the finest level, and no point of
//! the finest level is farther from it. That is decided for whole surfaces, not for samples (`mesh::Reach`): what is
//! within is so for certain, what is not has a point that is farther than the bound less one part in a thousand.
//!
//! The deviation is not monotone in the level: a collapse may mend what another has done. The level found is within,
//! and the next coarser, after one more collapse, is not. It lies where the search ends, which goes as follows. Levels
//! are tried by bisection over the logarithm of their triangles, from the one that the method's own errors point at,
//! each by its vertices and some points of its triangles, which as a rule finds what is beyond at once. Where that
//! search ends, the level is decided exactly. If it is beyond after all, the search goes on from there towards
//! finer levels in growing steps, and then by bisection, deciding each exactly.
//!
//! What was settled stays so: a coarse triangle that is within, and a fine one that is within the bound of one coarse
//! triangle that is still there, are not tested again at another level.

use std::sync::Arc;
use std::task::Poll;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::progressive::ProgressiveMesh;
use super::task::{Budget, Progress, Task};
use crate::mesh::{Beyond, IndexBuild, Reach, SurfaceIndex, TriMesh};

/// Queries or pieces between two looks at the clock.
const QUERIES: usize = 64;
/// Units of lighter work between two looks at the clock.
const UNITS: usize = 8192;
/// Points that were beyond, to try first on another level.
const REMEMBERED: usize = 64;

/// The level that a bound on the deviation leads to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bound {
    /// Steps from the finest level to the one that is within.
    pub steps: u32,
    /// A distance in mm that was found between the next coarser level and the finest; `None` where there is none.
    pub next_coarser_mm: Option<f64>,
}

/// The search for the level, in slices.
pub struct BoundTask {
    progressive: Arc<ProgressiveMesh>,
    finest: Arc<TriMesh>,
    /// The bound in mm.
    bound: f64,
    fine_build: IndexBuild,
    fine: Option<Arc<SurfaceIndex>>,
    search: Search,
    trial: Option<Trial>,
    memory: Memory,
    /// Trials so far, for the progress.
    trials: u32,
}

/// The bracket.
struct Search {
    /// Steps of a level that is within for certain.
    within: u32,
    /// Steps of a level that passed at first sight, above `within`.
    hopeful: u32,
    /// Steps of the finest level that is known to be beyond, or one more than there are.
    beyond: u32,
    /// How far beyond.
    distance: Option<f64>,
    /// Exact decisions that went against what was seen at first sight.
    surprises: u32,
}

/// What stays true from one level to another.
struct Memory {
    /// Points of the finest level that were beyond, the latest last.
    points: Vec<Vec3>,
    /// For each triangle, the corners with which it was within.
    coarse: Vec<[u32; 3]>,
    /// For each triangle of the finest level, a triangle and its corners within whose bound it is.
    cover: Vec<(u32, [u32; 3])>,
    /// Where points of coarse triangles were beyond: the next level is looked at there first.
    places: Vec<Vec3>,
}

/// No triangle.
const NONE: [u32; 3] = [u32::MAX; 3];

/// A level that is being tried.
struct Trial {
    steps: u32,
    is_exact: bool,
    level: Vec<[u32; 3]>,
    build: IndexBuild,
    index: SurfaceIndex,
    stage: Stage,
    next: usize,
    reach: Reach,
    /// Triangles still to be settled, in this order.
    order: Vec<u32>,
    is_begun: bool,
    /// Whether the triangle in hand is still whole.
    is_whole: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Index,
    /// What was beyond before.
    Remembered,
    /// Nodes that are gone.
    Nodes,
    /// Corners, middles of sides and centroids of the level's triangles.
    Points,
    /// The level's triangles, to the last point.
    Coarse,
    /// The finest level's triangles, to the last point.
    Fine,
}

impl BoundTask {
    /// A search over the levels of `progressive`, whose finest is `finest`, for the coarsest within `bound` mm.
    pub fn new(progressive: Arc<ProgressiveMesh>, finest: Arc<TriMesh>, bound: f64) -> Self {
        let search = Search {
            within: 0,
            hopeful: 0,
            beyond: progressive.errors.len() as u32 + 1,
            distance: None,
            surprises: 0,
        };
        let memory = Memory {
            points: Vec::new(),
            coarse: vec![NONE; finest.triangles.len()],
            cover: vec![(0, NONE); finest.triangles.len()],
            places: Vec::new(),
        };
        let fine_build = IndexBuild::new();
        Self { progressive, finest, bound, fine_build, fine: None, search, trial: None, memory, trials: 0 }
    }

    /// Uses an index of the finest level that is there already.
    #[must_use]
    pub fn with_index(mut self, index: Arc<SurfaceIndex>) -> Self {
        self.fine = Some(index);
        self
    }

    /// The index of the finest level, once it is built.
    pub fn index(&self) -> Option<&Arc<SurfaceIndex>> {
        self.fine.as_ref()
    }

    /// One piece of work; the result when it is there.
    fn step(&mut self) -> Option<Bound> {
        let Some(fine) = &self.fine else {
            if let Poll::Ready(index) = self.fine_build.advance(&self.finest.positions, &self.finest.triangles, UNITS) {
                self.fine = Some(Arc::new(index));
            }
            return None;
        };
        let Some(trial) = &mut self.trial else {
            let Some((steps, is_exact)) = self.search.next(&self.progressive, self.bound) else {
                return Some(Bound { steps: self.search.within, next_coarser_mm: self.search.distance });
            };
            self.trials += 1;
            self.trial = Some(Trial::new(&self.progressive, steps, is_exact, self.bound));
            return None;
        };
        let all = Surfaces { progressive: &self.progressive, finest: &self.finest, fine };
        match trial.advance(&all, &mut self.memory, self.bound) {
            Poll::Pending => {}
            Poll::Ready(found) => {
                self.search.learn(trial.steps, trial.is_exact, found);
                self.trial = None;
            }
        }
        None
    }
}

impl Task for BoundTask {
    type Output = Bound;

    fn advance(&mut self, budget: Budget) -> Progress<Bound> {
        loop {
            if let Some(bound) = self.step() {
                return Progress::Done(bound);
            }
            if budget.is_spent() {
                // How many trials it will be cannot be known; each is less likely to be the last but one.
                return Progress::Working(1.0 - libm::expf(-0.1 * self.trials as f32));
            }
        }
    }
}

impl Search {
    /// The next level to try, and whether to decide it exactly; `None` when there is nothing left to find out.
    fn next(&self, progressive: &ProgressiveMesh, bound: f64) -> Option<(u32, bool)> {
        let last = progressive.errors.len() as u32;
        let low = self.within.max(self.hopeful);
        if self.beyond == low + 1 {
            return (self.hopeful > self.within).then_some((self.hopeful, true));
        }
        if self.surprises > 0 && self.within == 0 {
            let stride = 1u32 << self.surprises.min(30);
            return Some((self.beyond.saturating_sub(stride).max(1), true));
        }
        let count = |steps: u32| progressive.triangles_after(steps).max(1) as f64;
        let steps = match (low == 0, self.beyond > last) {
            (true, true) => progressive.errors.partition_point(|&error| f64::from(error) <= bound) as u32,
            (true, false) => progressive.steps_to((count(self.beyond) * 2.0) as usize),
            (false, true) => progressive.steps_to((count(low) / 2.0) as usize),
            (false, false) => progressive.steps_to(libm::sqrt(count(low) * count(self.beyond)) as usize),
        };
        let is_inside = low < steps && steps < self.beyond;
        let steps = if is_inside { steps } else { low + (self.beyond - low) / 2 };
        Some((steps, self.surprises > 0))
    }

    /// What a trial came to: `None` for within.
    fn learn(&mut self, steps: u32, is_exact: bool, found: Option<f64>) {
        match found {
            None if is_exact => self.within = steps,
            None => self.hopeful = steps,
            Some(distance) => {
                self.surprises += u32::from(is_exact && self.within == 0);
                self.beyond = steps;
                self.distance = Some(distance);
                if self.hopeful >= steps {
                    self.hopeful = 0;
                }
            }
        }
    }
}

/// The surfaces that a trial compares.
struct Surfaces<'a> {
    progressive: &'a ProgressiveMesh,
    finest: &'a TriMesh,
    fine: &'a SurfaceIndex,
}

impl Trial {
    fn new(progressive: &ProgressiveMesh, steps: u32, is_exact: bool, bound: f64) -> Self {
        Self {
            steps,
            is_exact,
            level: progressive.triangles_at(steps),
            build: IndexBuild::new(),
            index: SurfaceIndex::default(),
            stage: Stage::Index,
            next: 0,
            reach: Reach::new(bound),
            order: Vec::new(),
            is_begun: false,
            is_whole: false,
        }
    }

    /// One piece of work: `Ready(None)` where the level is within, else a distance that is beyond.
    fn advance(&mut self, all: &Surfaces<'_>, memory: &mut Memory, bound: f64) -> Poll<Option<f64>> {
        let found = match self.stage {
            Stage::Index => {
                let built = self.build.advance(&all.progressive.positions, &self.level, UNITS);
                built.map(|index| {
                    self.index = index;
                    None
                })
            }
            Stage::Remembered => {
                let points = memory.points.iter().rev();
                let beyond = points.copied().find(|&p| !self.index.is_within(p, bound as f32));
                Poll::Ready(beyond.and_then(|p| distance(&self.index, p)))
            }
            Stage::Nodes => self.nodes(all, memory, bound),
            Stage::Points => self.points(all, memory, bound),
            Stage::Coarse => self.coarse(all, memory),
            Stage::Fine => self.fine(all, memory),
        };
        match found {
            Poll::Ready(None) => self.following().map_or(Poll::Ready(None), |stage| {
                self.stage = stage;
                self.next = 0;
                self.is_begun = false;
                Poll::Pending
            }),
            found => found,
        }
    }

    fn following(&self) -> Option<Stage> {
        match self.stage {
            Stage::Index => Some(Stage::Remembered),
            Stage::Remembered => Some(Stage::Nodes),
            Stage::Nodes => Some(Stage::Points),
            Stage::Points => self.is_exact.then_some(Stage::Coarse),
            Stage::Coarse => Some(Stage::Fine),
            Stage::Fine => None,
        }
    }

    /// Nodes that are gone, the last to go first: they are likely the farthest. (Those of the level are on it.)
    fn nodes(&mut self, all: &Surfaces<'_>, memory: &mut Memory, bound: f64) -> Poll<Option<f64>> {
        let ProgressiveMesh { positions, node_ends, .. } = all.progressive;
        let alive = node_ends.partition_point(|&end| end >= self.steps);
        let end = positions.len().min(alive + self.next + QUERIES);
        for &p in &positions[alive + self.next..end] {
            if !self.index.is_within(p, bound as f32) && p.is_finite() {
                memory.remember(p);
                return Poll::Ready(distance(&self.index, p));
            }
        }
        self.next = end - alive;
        if end == positions.len() { Poll::Ready(None) } else { Poll::Pending }
    }

    /// Some points of the level's triangles.
    fn points(&mut self, all: &Surfaces<'_>, memory: &mut Memory, bound: f64) -> Poll<Option<f64>> {
        let end = self.level.len().min(self.next + QUERIES / 4);
        for (corners, settled) in self.level[self.next..end].iter().zip(&memory.coarse[self.next..]) {
            if settled == corners {
                continue;
            }
            let [a, b, c] = corners.map(|v| all.progressive.positions[v as usize]);
            for p in [(a + b + c) / 3.0, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0] {
                if !all.fine.is_within(p, bound as f32) {
                    return Poll::Ready(distance(all.fine, p));
                }
            }
        }
        self.next = end;
        if end == self.level.len() { Poll::Ready(None) } else { Poll::Pending }
    }

    fn coarse(&mut self, all: &Surfaces<'_>, memory: &mut Memory) -> Poll<Option<f64>> {
        if !self.is_begun {
            self.is_begun = true;
            self.order.clear();
            let near = memory.places.iter().rev().filter_map(|&p| self.index.nearest(p)).map(|found| found.triangle);
            self.order.extend(near);
            let rest = self.index.triangles().filter(|&t| memory.coarse[t as usize] != self.level[t as usize]);
            self.order.extend(rest);
        }
        for _ in 0..QUERIES {
            if let Some(found) = self.settle(all.fine, |t, level| level[t].map(|v| all.progressive.positions[v as usize])) {
                match found {
                    Settled::All => return Poll::Ready(None),
                    Settled::One(t, _) => memory.coarse[t] = self.level[t],
                    Settled::Beyond(found) => {
                        memory.places.push(found.point);
                        if memory.places.len() > REMEMBERED {
                            memory.places.remove(0);
                        }
                        return Poll::Ready(Some(found.distance));
                    }
                }
            }
        }
        Poll::Pending
    }

    fn fine(&mut self, all: &Surfaces<'_>, memory: &mut Memory) -> Poll<Option<f64>> {
        if !self.is_begun {
            self.is_begun = true;
            self.order.clear();
            let settled = |t: u32| {
                let (by, corners) = memory.cover[t as usize];
                self.level.get(by as usize) == Some(&corners)
            };
            self.order.extend(all.fine.triangles().filter(|&t| !settled(t)));
        }
        let index = std::mem::take(&mut self.index);
        let mut outcome = Poll::Pending;
        for _ in 0..QUERIES {
            if let Some(found) = self.settle(&index, |t, _| all.finest.corners(t)) {
                match found {
                    Settled::All => {
                        outcome = Poll::Ready(None);
                        break;
                    }
                    Settled::One(t, Some(by)) => memory.cover[t] = (by, self.level[by as usize]),
                    Settled::One(..) => {}
                    Settled::Beyond(found) => {
                        memory.remember(found.point);
                        outcome = Poll::Ready(Some(found.distance));
                        break;
                    }
                }
            }
        }
        self.index = index;
        outcome
    }

    /// Goes on with the triangle in hand.
    fn settle(
        &mut self,
        surface: &SurfaceIndex,
        corners: impl Fn(usize, &[[u32; 3]]) -> [Vec3; 3],
    ) -> Option<Settled> {
        let Some(&t) = self.order.get(self.next) else { return Some(Settled::All) };
        let t = t as usize;
        if !self.is_whole {
            self.reach.begin(corners(t, &self.level));
            self.is_whole = true;
            if let Poll::Ready(None) = self.reach.advance(surface, 1) {
                self.next += 1;
                self.is_whole = false;
                return Some(Settled::One(t, self.reach.nearest()));
            }
        }
        match self.reach.advance(surface, QUERIES) {
            Poll::Pending => None,
            Poll::Ready(Some(found)) => Some(Settled::Beyond(found)),
            Poll::Ready(None) => {
                self.next += 1;
                self.is_whole = false;
                Some(Settled::One(t, None))
            }
        }
    }
}

/// What came of a triangle.
enum Settled {
    All,
    /// It is within; of this one triangle, if it was one.
    One(usize, Option<u32>),
    Beyond(Beyond),
}

impl Memory {
    fn remember(&mut self, p: Vec3) {
        self.points.push(p);
        if self.points.len() > REMEMBERED {
            self.points.remove(0);
        }
    }
}

fn distance(surface: &SurfaceIndex, p: Vec3) -> Option<f64> {
    Some(surface.nearest(p).map_or(f64::INFINITY, |found| f64::from(found.distance)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Topology;
    use crate::phantom::{Sample, generate};
    use crate::pipeline::decimation::decimate;
    use crate::pipeline::settings::Decimation;

    #[test]
    fn probe() {
        let n: usize = std::env::var("N").map_or(74_307, |n| n.parse().unwrap());
        let opened = generate(Sample::Aorta, n).unwrap();
        let mut p = crate::pipeline::run::Pipeline::new(
            Arc::new(opened),
            crate::pipeline::settings::Settings::default(),
        )
        .with_samples(200_000);
        p.finish().unwrap();
        println!("{:?}", p.deviations().unwrap().from_smoothed.as_ref().unwrap().deviation);
        let smoothed = p.smoothed().unwrap().mesh.clone();
        let topology = Topology::new(smoothed.positions.len(), &smoothed.triangles);
        let progressive = Arc::new(decimate(&smoothed, &topology, &Decimation::default()));
        let finest = Arc::new(progressive.finest());
        let index = Arc::new(SurfaceIndex::new(&finest.positions, &finest.triangles));
        for bound in [0.001, 0.003, 0.01, 0.03, 0.1, 0.2, 0.3, 1.0, 3.0, 10.0] {
            let start = web_time::Instant::now();
            let mut task = BoundTask::new(progressive.clone(), finest.clone(), bound).with_index(index.clone());
            let mut log = String::new();
            let mut last = start;
            let mut now = None;
            let found = loop {
                if let Some(bound) = task.step() {
                    break bound;
                }
                let id = task.trial.as_ref().map(|t| (t.steps, t.is_exact, t.stage));
                if id != now {
                    if let Some((s, e, st)) = now { log += &format!(" {s}{}{st:?}:{:.1}", if e { "!" } else { "?" }, last.elapsed().as_secs_f64() * 1e3); }
                    last = web_time::Instant::now();
                    now = id;
                }
            };
            let ms = start.elapsed().as_secs_f64() * 1e3;
            let level = progressive.extract(&progressive.triangles_at(found.steps));
            let next = progressive.extract(&progressive.triangles_at((found.steps + 1).min(progressive.errors.len() as u32)));
            let d = |m: &TriMesh| crate::pipeline::deviation::deviation(&finest, m, 200_000).unwrap().max;
            println!("{bound}: {ms:.0} ms, {found:?}, {} triangles, sampled {:.5} next {:.5}; trials {}", level.triangles.len(), d(&level), d(&next), task.trials);
            println!("   {log}");
        }
    }
}
