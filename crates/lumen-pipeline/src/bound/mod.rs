//! The stop by deviation: the level of fewest triangles that stays within a bound of the surface that entered
//! decimation.
//!
//! A level is *within* the bound when no point of it is farther than the bound from the finest level, and no point of
//! the finest level is farther from it. That is decided for whole surfaces, not for samples
//! ([`Reach`](lumen_mesh::Reach)): what is within is so for certain, what is not has a point that is farther than the
//! bound less one part in a thousand.
//!
//! The deviation is not monotone in the level: a collapse may mend what another has done. So the search goes from the
//! coarsest level towards finer ones and ends at the first that is within; each level that it passes is ruled out by a
//! witness, and one witness rules out many:
//!
//! - a triangle that is beyond rules out every level that it is part of;
//! - a point of the finest level that is beyond the bound of one level is so of the next finer as well, unless one of
//!   the few triangles that come back with that step is near.
//!
//! What was found within stays so: a coarse triangle, and a fine one within the bound of one coarse triangle that is
//! still there, are not tested again at another level.

mod history;
mod trial;

use std::sync::Arc;
use std::task::Poll;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use self::history::History;
use self::trial::{Memory, Surfaces, Trial, UNITS, Witness, distance};
use super::progressive::ProgressiveMesh;
use super::task::{Budget, Progress, Task};
use lumen_mesh::{IndexBuild, SurfaceIndex, TriMesh, distance_to_triangle};

/// Steps of a leap between two looks at the clock.
const STEPS: u32 = 32;

/// The level that a bound on the deviation leads to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bound {
    /// Steps from the finest level to the one that is within.
    pub steps: u32,
    /// A distance in mm that was found between the next coarser level and the finest: more than the bound, or less by
    /// no more than one part in a thousand. `None` where there is no coarser level.
    pub next_coarser_mm: Option<f64>,
}

/// The search for the level, in slices.
pub struct BoundTask {
    progressive: Arc<ProgressiveMesh>,
    finest: Arc<TriMesh>,
    /// The bound in mm.
    bound: f64,
    build: IndexBuild,
    fine: Option<Arc<SurfaceIndex>>,
    history: History,
    /// Whether each node is a vertex of the finest level.
    is_vertex: Vec<bool>,
    memory: Memory,
    work: Work,
    /// What rules out the level one step coarser than the one at work.
    last: Option<Last>,
}

enum Work {
    /// The next level, in steps, if it is not the finest.
    Begin(u32),
    Trial(Box<Trial>),
    /// Points that are beyond the bound of the level after so many steps.
    Leap(u32, Vec<Vec3>),
    /// The level is found; the next coarser is measured from this point.
    Measure(u32, Vec3, Box<(IndexBuild, Vec<[u32; 3]>)>),
}

enum Last {
    Point(Vec3),
    Distance(f64),
}

impl BoundTask {
    /// A search over the levels of `progressive`, whose finest is `finest`, for the coarsest within `bound` mm.
    pub fn new(progressive: Arc<ProgressiveMesh>, finest: Arc<TriMesh>, bound: f64) -> Self {
        Self {
            work: Work::Begin(progressive.errors.len() as u32),
            memory: Memory::new(finest.triangles.len()),
            is_vertex: is_vertex(&progressive),
            progressive,
            finest,
            bound,
            build: IndexBuild::new(),
            fine: None,
            history: History::default(),
            last: None,
        }
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
            if let Poll::Ready(index) = self.build.advance(&self.finest.positions, &self.finest.triangles, UNITS) {
                self.fine = Some(Arc::new(index));
            }
            return None;
        };
        if !self.history.advance(&self.progressive, UNITS) {
            return None;
        }
        match &mut self.work {
            Work::Begin(0) => return self.found(0),
            Work::Begin(steps) => {
                self.work = Work::Trial(Box::new(Trial::new(&self.progressive, *steps, self.bound)));
            }
            Work::Trial(trial) => {
                let all =
                    Surfaces { progressive: &self.progressive, finest: &self.finest, fine, is_vertex: &self.is_vertex };
                let steps = trial.steps;
                match trial.advance(&all, &mut self.memory) {
                    Poll::Pending => {}
                    Poll::Ready(None) => return self.found(steps),
                    Poll::Ready(Some(Witness::Points(points))) => self.work = Work::Leap(steps, points),
                    Poll::Ready(Some(Witness::Triangle { birth, distance })) => {
                        self.last = Some(Last::Distance(distance));
                        self.work = Work::Begin(birth.saturating_sub(1));
                    }
                }
            }
            Work::Leap(steps, points) => {
                for _ in 0..STEPS {
                    // A level of no steps is the surface itself.
                    if let Some(last) = step_back(&self.progressive, &self.history, *steps - 1, points, self.bound) {
                        self.last = Some(Last::Point(last));
                        self.work = Work::Begin(*steps - 1);
                        return None;
                    }
                    *steps -= 1;
                    if *steps == 0 {
                        self.work = Work::Begin(0);
                        return None;
                    }
                }
            }
            Work::Measure(steps, point, next) => {
                let (build, level) = &mut **next;
                if let Poll::Ready(index) = build.advance(&self.progressive.positions, level, UNITS) {
                    return Some(Bound { steps: *steps, next_coarser_mm: Some(distance(&index, *point)) });
                }
            }
        }
        None
    }

    /// The level is found; what is left is how far the next coarser is.
    fn found(&mut self, steps: u32) -> Option<Bound> {
        match self.last {
            None => Some(Bound { steps, next_coarser_mm: None }),
            Some(Last::Distance(distance)) => Some(Bound { steps, next_coarser_mm: Some(distance) }),
            Some(Last::Point(point)) => {
                let level = self.progressive.triangles_at(steps + 1);
                self.work = Work::Measure(steps, point, Box::new((IndexBuild::new(), level)));
                None
            }
        }
    }

    /// The part that is done, 0 to 1: how far the search has come from the coarsest level.
    fn fraction(&self) -> f32 {
        let steps = match &self.work {
            Work::Begin(steps) | Work::Leap(steps, _) | Work::Measure(steps, ..) => *steps,
            Work::Trial(trial) => trial.steps,
        };
        1.0 - steps as f32 / self.progressive.errors.len().max(1) as f32
    }
}

/// Whether each node is a vertex of the finest level.
fn is_vertex(mesh: &ProgressiveMesh) -> Vec<bool> {
    let mut is_vertex = vec![false; mesh.positions.len()];
    mesh.triangles.as_flattened().iter().for_each(|&node| is_vertex[node as usize] = true);
    is_vertex
}

/// Leaves out the points that are near to a triangle that comes back between `steps` + 1 steps and `steps`; the last of
/// them, if none is left.
fn step_back(
    mesh: &ProgressiveMesh,
    history: &History,
    steps: u32,
    points: &mut Vec<Vec3>,
    bound: f64,
) -> Option<Vec3> {
    let last = points.last().copied();
    let [reach, margin] = [Vec3::splat(bound as f32), Vec3::splat(1.0 + 1e-6)];
    for corners in history.before(mesh, steps) {
        let [a, b, c] = corners;
        // A little too large, for the rounding of f32.
        let slack = reach * margin + a.abs().max(b.abs()).max(c.abs()) * 1e-6;
        let (min, max) = (a.min(b).min(c) - slack, a.max(b).max(c) + slack);
        let is_near = |p: Vec3| p.cmpge(min).all() && p.cmple(max).all();
        points.retain(|&p| !is_near(p) || distance_to_triangle(p, corners) > bound);
    }
    last.filter(|_| points.is_empty())
}

impl Task for BoundTask {
    type Output = Bound;

    /// The clock is read every fraction of a millisecond, but for the beginning of each level (a few nanoseconds a
    /// node).
    fn advance(&mut self, budget: Budget) -> Progress<Bound> {
        loop {
            if let Some(bound) = self.step() {
                return Progress::Done(bound);
            }
            if budget.is_spent() {
                return Progress::Working(self.fraction());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::decimation::decimate;
    use crate::deviation::deviation;
    use crate::settings::{Decimation, Method};
    use lumen_mesh::{Topology, surface_area};
    use lumen_vessel::phantom::{Sample, generate};

    fn levels(mesh: &TriMesh) -> Arc<ProgressiveMesh> {
        levels_by(mesh, Method::default())
    }

    fn levels_by(mesh: &TriMesh, method: Method) -> Arc<ProgressiveMesh> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        Arc::new(decimate(mesh, &topology, &Decimation { method, ..Decimation::default() }))
    }

    fn search(levels: &Arc<ProgressiveMesh>, bound: f64) -> Bound {
        BoundTask::new(levels.clone(), Arc::new(levels.finest()), bound).finish()
    }

    fn largest(levels: &ProgressiveMesh, steps: u32, samples: usize) -> f64 {
        let level = levels.extract(&levels.triangles_at(steps));
        deviation(&levels.finest(), &level, samples).unwrap().max
    }

    #[test]
    fn the_level_found_is_within_by_samples_and_the_next_is_not() {
        for (sample, triangles, method) in [
            (Sample::Aorta, 3_000, Method::Schroeder),
            (Sample::Aorta, 3_000, Method::Quadric),
            (Sample::Coronary, 8_000, Method::Schroeder),
        ] {
            let levels = levels_by(&generate(sample, triangles).unwrap(), method);
            for bound in [0.02, 0.1, 0.5, 2.0, 8.0] {
                let found = search(&levels, bound);
                let measured = largest(&levels, found.steps, 50_000);
                assert!(measured <= bound, "{sample:?}, {bound}: {found:?}, {measured}");
                let Some(next) = found.next_coarser_mm else { continue };
                let measured = largest(&levels, found.steps + 1, 200_000);
                let spacing = (surface_area(&levels.finest()) / 200_000.0).sqrt();
                assert!(next > bound * 0.998, "{sample:?}, {bound}: {found:?}");
                assert!(next <= measured + 2.0 * spacing, "{sample:?}, {bound}: {found:?}, {measured}");
            }
        }
    }

    #[test]
    fn no_coarser_level_is_within() {
        let levels = levels(&generate(Sample::Aorta, 2_000).unwrap());
        let last = levels.errors.len() as u32;
        for bound in [0.05, 0.3, 2.0] {
            let found = search(&levels, bound);
            assert!(found.steps < last);
            for steps in (found.steps + 1..=last).step_by(29) {
                let measured = largest(&levels, steps, 20_000);
                // Samples may miss the farthest point.
                assert!(measured > bound * 0.9, "{bound}: {found:?}, {steps} steps: {measured}");
            }
        }
    }

    #[test]
    fn slices_and_a_given_index_change_nothing_and_progress_goes_up() {
        let levels = levels(&generate(Sample::Aorta, 2_000).unwrap());
        let whole = search(&levels, 0.2);
        let mut task = BoundTask::new(levels.clone(), Arc::new(levels.finest()), 0.2);
        let mut before = 0.0;
        let sliced = loop {
            match task.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(now) => {
                    assert!((before..=1.0).contains(&now), "{before} then {now}");
                    before = now;
                }
                Progress::Done(found) => break found,
            }
        };
        assert_eq!(sliced, whole);
        let index = task.index().unwrap().clone();
        let again = BoundTask::new(levels.clone(), Arc::new(levels.finest()), 0.2).with_index(index).finish();
        assert_eq!(again, whole);
    }

    #[test]
    fn a_bound_beyond_all_levels_gives_the_coarsest_and_nothing_gives_nothing() {
        let levels = levels(&generate(Sample::Aorta, 2_000).unwrap());
        let found = search(&levels, 1e6);
        assert_eq!(found, Bound { steps: levels.errors.len() as u32, next_coarser_mm: None });
        let none = Arc::new(ProgressiveMesh::default());
        assert_eq!(search(&none, 0.1), Bound { steps: 0, next_coarser_mm: None });
    }
}
