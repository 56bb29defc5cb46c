//! What reduction does to the wire, over many rates: who arrives, how far the tip goes another way than on the unreduced
//! surface, and how hard it presses.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::compare::{Noise, TrialComparison};
use super::course::{Course, TrialError};
use super::frame::Progress;
use super::session::Trial;
use super::setup::Setup;
use lumen_mesh::{TriMesh, parallel};
use lumen_vessel::phantom::Sample;

/// Steps between two looks at whether it is to be cancelled.
const SLICE: u32 = 500;

/// The middle and the largest of the values of all seeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The median; of an even number the lower of the two in the middle.
    pub median: f64,
    /// The largest.
    pub largest: f64,
}

impl Spread {
    /// `None` without values.
    fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        Some(Self { median: values[values.len().checked_sub(1)? / 2], largest: *values.last()? })
    }
}

/// The trials on one surface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SweepRow {
    /// Its triangles.
    pub triangles: usize,
    /// Seeds that were tried.
    pub seeds: usize,
    /// On how many of them the wire arrived.
    pub arrived: usize,
    /// The largest distance of the tip from where the same input brings it on the unreduced surface, in mm.
    pub deviation_mm: Option<Spread>,
    /// The same between the unreduced surface and that with its triangles in another order: what is less than that says
    /// nothing of the reduction.
    pub noise_mm: Option<Spread>,
    /// The largest force at one place of the wall, in N.
    pub peak_force_n: Option<Spread>,
    /// The mean of all that presses on the wall, in N.
    pub mean_force_n: Option<Spread>,
    /// Simulated seconds to the target, of those that arrived.
    pub time_s: Option<Spread>,
}

/// The wire that a sweep is made with: with the one that the autopilot arrives with on the unreduced surface, where several
/// are tried in turn.
///
/// # Errors
/// When there is no way for it.
pub fn settled_setup(original: &Arc<TriMesh>, sample: Option<Sample>, mut setup: Setup) -> Result<Setup, TrialError> {
    let course = Arc::new(Course::new(original, sample, &mut setup)?);
    if !setup.next_wires.is_empty() {
        let mut trial = Trial::new(course, setup.clone())?;
        trial.set_autopilot(true);
        trial.finish();
        if trial.progress() == Progress::Arrived {
            setup.wire = trial.wire().clone();
        }
        setup.next_wires.clear();
    }
    Ok(setup)
}

/// The three runs of one seed: by autopilot on the reduced surface, then with the same input on the unreduced one, and on that
/// with its triangles in another order.
#[derive(Debug)]
pub struct SeedRuns {
    original: Arc<TriMesh>,
    /// In that order.
    runs: Vec<Trial>,
}

/// Runs of a seed.
const RUNS: usize = 3;

impl SeedRuns {
    /// By the autopilot on a course in the reduced surface.
    ///
    /// # Errors
    /// When the setup makes no trial there.
    pub fn new(course: Arc<Course>, setup: Setup, original: &Arc<TriMesh>) -> Result<Self, TrialError> {
        let mut trial = Trial::new(course, setup)?;
        trial.set_autopilot(true);
        Ok(Self { original: original.clone(), runs: vec![trial] })
    }

    /// Goes on for at most `steps` steps. Gives what comes of the runs once they are over.
    ///
    /// # Errors
    /// When the wire does not fit in the other surface.
    pub fn advance(&mut self, steps: u32) -> Result<Option<TrialComparison>, TrialError> {
        if let Some(trial) = self.runs.last_mut() {
            for _ in 0..steps {
                if trial.progress() != Progress::Running {
                    break;
                }
                trial.step();
            }
            if trial.progress() == Progress::Running {
                return Ok(None);
            }
        }
        match self.runs.as_slice() {
            [first] => {
                let unreduced = first.on(&self.original)?;
                self.runs.push(unreduced);
            }
            [first, _] => {
                let shuffled = first.on_shuffled(&self.original, first.setup().seed)?;
                self.runs.push(shuffled);
            }
            [first, unreduced, shuffled] => {
                let mut noise = Noise::default();
                noise.take(unreduced, shuffled);
                return Ok(Some(TrialComparison::new(first, unreduced, &noise)));
            }
            _ => {}
        }
        Ok(None)
    }

    /// The part that is done, 0 to 1: the runs before, and of this one the way to its end where that is known.
    pub fn fraction(&self) -> f32 {
        let Some(trial) = self.runs.last() else { return 0.0 };
        ((self.runs.len() - 1) as f64 + trial.part_done()) as f32 / RUNS as f32
    }
}

impl SweepRow {
    /// Of a surface of so many triangles, of what came of each seed.
    pub fn new(triangles: usize, found: &[TrialComparison]) -> Self {
        let summaries = || found.iter().map(|comparison| &comparison.summaries[0]);
        let largest = |all: &[f32]| f64::from(all.iter().copied().fold(0.0, f32::max));
        Self {
            triangles,
            seeds: found.len(),
            arrived: summaries().filter(|summary| summary.success).count(),
            deviation_mm: Spread::of(found.iter().map(|comparison| largest(&comparison.deviation_mm)).collect()),
            noise_mm: Spread::of(found.iter().map(|comparison| largest(&comparison.noise_mm)).collect()),
            peak_force_n: Spread::of(summaries().map(|summary| summary.max_wall_force_n).collect()),
            mean_force_n: Spread::of(summaries().map(|summary| summary.mean_wall_force_n).collect()),
            time_s: Spread::of(summaries().filter(|summary| summary.success).map(|summary| summary.time_s).collect()),
        }
    }
}

/// The runs of the seeds 1 to `seeds`, on all cores. `None` when it was cancelled.
///
/// # Errors
/// When there is no way for the wire.
pub fn sweep(
    reduced: &Arc<TriMesh>,
    original: &Arc<TriMesh>,
    setup: &Setup,
    seeds: u64,
    is_cancelled: impl Fn() -> bool + Sync + Send,
) -> Result<Option<SweepRow>, TrialError> {
    let course = Arc::new(Course::new(reduced, None, &mut setup.clone())?);
    let of_seed = |seed: u64| -> Result<Option<TrialComparison>, TrialError> {
        let mut runs = SeedRuns::new(course.clone(), Setup { seed, ..setup.clone() }, original)?;
        while !is_cancelled() {
            if let Some(comparison) = runs.advance(SLICE)? {
                return Ok(Some(comparison));
            }
        }
        Ok(None)
    };
    let found: Result<Vec<_>, _> = parallel::map((1..=seeds).collect(), of_seed).into_iter().collect();
    let found: Option<Vec<_>> = found?.into_iter().collect();
    Ok(found.map(|found| SweepRow::new(reduced.triangles.len(), &found)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::shapes::tube;

    #[test]
    fn a_surface_beside_itself_differs_by_nothing_and_a_narrower_one_by_something() {
        let vessel = |radius: f32| Arc::new(tube(24, 40, 40.0, move |_| radius));
        let [wide, narrow] = [2.0, 1.7].map(vessel);
        let setup = settled_setup(&wide, None, Setup::default()).unwrap();
        let [same, other] = [&wide, &narrow].map(|mesh| sweep(mesh, &wide, &setup, 3, || false).unwrap().unwrap());
        assert_eq!((same.seeds, same.arrived, same.deviation_mm), (3, 3, Some(Spread::default())));
        let (deviation, noise) = (other.deviation_mm.unwrap(), other.noise_mm.unwrap());
        // The tip lies by the wall: as far as the two walls are apart, and not farther than across the vessel.
        assert!(deviation.median > 0.2 && deviation.largest < 4.0 && noise.largest < 0.01, "{other:?}");
        assert_eq!(sweep(&wide, &wide, &setup, 2, || true), Ok(None));
    }

    #[test]
    fn the_spread_of_values_is_their_middle_and_their_largest() {
        assert_eq!(Spread::of(vec![5.0, 1.0, 2.0]), Some(Spread { median: 2.0, largest: 5.0 }));
        assert_eq!(Spread::of(Vec::new()), None);
    }
}
