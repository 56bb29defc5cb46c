//! The stop by deviation: the level of fewest triangles that stays within a bound of the surface that entered
//! decimation.
//!
//! A level is *within* the bound when no point of it is farther than the bound from the finest level, and no point of
//! the finest level is farther from it. That is decided for whole surfaces, not for samples
//! ([`HausdorffBound`](lumen_mesh::HausdorffBound)): what is within is so for certain, what is not has a point that is farther than the
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

use glam::Vec3;
use serde::{Deserialize, Serialize};

use self::history::History;
use self::trial::{Counterexample, Memory, Surfaces, distance, ruled_out};
use super::progressive::ProgressiveMesh;
use super::task::Yielder;
use lumen_mesh::{SurfaceIndex, distance_to_triangle};

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

/// What rules out the level one step coarser than the one at work.
#[derive(Clone, Copy)]
enum Last {
    Point(Vec3),
    Distance(f64),
}

/// The coarsest level of `progressive` that is within `bound_mm`. Rests every
/// fraction of a millisecond, but for the beginning of each level (a few nanoseconds a node).
pub async fn bound_in_slices(progressive: &ProgressiveMesh, bound_mm: f64, yielder: &Yielder) -> Bound {
    let most = progressive.errors.len() as u32;
    // The part that is done: how far the search has come from the coarsest level.
    let at = |steps: u32| {
        let done = 1.0 - steps as f32 / most.max(1) as f32;
        yielder.part(done..done)
    };
    // Of the finest level in the numbering of the progressive mesh: a triangle is known by one number at all levels.
    let fine = SurfaceIndex::build(&progressive.positions, &progressive.triangles, &at(most)).await;
    let history = History::new(progressive, &at(most)).await;
    let is_vertex = is_vertex(progressive);
    let all = Surfaces { progressive, fine: &fine, is_vertex: &is_vertex };
    let mut memory = Memory::new(progressive.triangles.len());
    let (mut steps, mut last) = (most, None);
    while steps > 0 {
        match ruled_out(&all, steps, bound_mm, &mut memory, &at(steps)).await {
            None => break,
            Some(Counterexample::Triangle { birth, distance }) => {
                last = Some(Last::Distance(distance));
                steps = birth.saturating_sub(1);
            }
            Some(Counterexample::Points(mut points)) => {
                // A level of no steps is the surface itself.
                while steps > 0 {
                    steps -= 1;
                    if let Some(point) = step_back(progressive, &history, steps, &mut points, bound_mm) {
                        last = Some(Last::Point(point));
                        break;
                    }
                    if steps.is_multiple_of(STEPS) {
                        at(steps).rest(1.0).await;
                    }
                }
            }
        }
        at(steps).rest(1.0).await;
    }
    let next_coarser_mm = match last {
        None => None,
        Some(Last::Distance(distance)) => Some(distance),
        Some(Last::Point(point)) => {
            let level = progressive.triangles_at(steps + 1);
            let index = SurfaceIndex::build(&progressive.positions, &level, &at(steps)).await;
            Some(distance(&index, point))
        }
    };
    Bound { steps, next_coarser_mm }
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::decimation::decimate;
    use crate::deviation::deviation;
    use crate::settings::{Decimation, Method};
    use crate::task::{Budget, Progress, Running, at_once};
    use lumen_mesh::{Topology, TriMesh, surface_area};
    use lumen_vessel::phantom::{Sample, generate};

    fn levels(mesh: &TriMesh) -> Arc<ProgressiveMesh> {
        levels_by(mesh, Method::default())
    }

    fn levels_by(mesh: &TriMesh, method: Method) -> Arc<ProgressiveMesh> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        Arc::new(decimate(mesh, &topology, &Decimation { method, ..Decimation::default() }))
    }

    fn search(levels: &Arc<ProgressiveMesh>, bound: f64) -> Bound {
        at_once(bound_in_slices(levels, bound, &Yielder::never()))
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
    fn slices_change_nothing_and_progress_goes_up() {
        let levels = levels(&generate(Sample::Aorta, 2_000).unwrap());
        let whole = search(&levels, 0.2);
        let levels = &levels;
        let mut running = Running::new(|yielder| async move { bound_in_slices(levels, 0.2, &yielder).await });
        let mut before = 0.0;
        let sliced = loop {
            match running.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(now) => {
                    assert!((before..=1.0).contains(&now), "{before} then {now}");
                    before = now;
                }
                Progress::Done(found) => break found,
            }
        };
        assert_eq!(sliced, whole);
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
