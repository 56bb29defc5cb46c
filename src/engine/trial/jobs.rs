//! Trials that run to their end as fast as they go, one after another and in slices, while the trial that is shown waits:
//! measurements, comparisons with the unreduced surface, and sweeps of many seeds.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use super::message::TrialEvent;
use super::start::start;
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::trial::compare::{Noise, SHUFFLES, TrialComparison};
use crate::trial::course::{Course, TrialError};
use crate::trial::frame::Progress;
use crate::trial::session::Trial;
use crate::trial::setup::Setup;
use crate::trial::sweep::{SeedRuns, SweepRow};

/// Seconds between two words on how far a job is.
const TELL: f64 = 0.5;
/// Steps of a sweep between two looks at the clock.
const STEPS: u32 = 20;

/// Jobs, in the order in which they were asked for.
#[derive(Default)]
pub(super) struct Jobs(VecDeque<Job>);

struct Job {
    id: u64,
    work: Work,
    told: Instant,
}

enum Work {
    Measure(Box<Trial>),
    Compare(Box<Trial>, Comparing),
    Sweep(Box<Sweeping>),
}

/// A sweep: seed by seed.
struct Sweeping {
    course: Arc<Course>,
    setup: Setup,
    /// Triangles of the reduced surface.
    triangles: usize,
    original: Arc<TriMesh>,
    seeds: u64,
    runs: SeedRuns,
    found: Vec<TrialComparison>,
}

/// A comparison: the trial runs on the unreduced surface, then on the same in other orders.
struct Comparing {
    mesh: Arc<TriMesh>,
    /// The run on the surface as it is, once it is over.
    original: Option<Box<Trial>>,
    noise: Noise,
    /// Orders that were tried.
    orders: u64,
}

impl Jobs {
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    #[cfg(test)]
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Lets the autopilot run on a surface of its own.
    pub(super) fn measure(
        &mut self,
        id: u64,
        mesh: &Arc<TriMesh>,
        sample: Option<Sample>,
        setup: Setup,
    ) -> Result<(), TrialError> {
        // The rows of a table are of one wire.
        let mut trial = start(mesh, sample, setup, false)?;
        trial.set_autopilot(true);
        self.add(id, Work::Measure(Box::new(trial)));
        Ok(())
    }

    /// Lets the autopilot run on `reduced` by each of the seeds 1 to `seeds`, and with the same input on `original`.
    pub(super) fn sweep(
        &mut self,
        id: u64,
        [reduced, original]: [Arc<TriMesh>; 2],
        mut setup: Setup,
        seeds: u64,
    ) -> Result<(), TrialError> {
        let course = Arc::new(Course::new(&reduced, None, &mut setup)?);
        setup.next_wires.clear();
        let runs = SeedRuns::new(course.clone(), Setup { seed: 1, ..setup.clone() }, &original)?;
        let triangles = reduced.triangles.len();
        let sweeping = Sweeping { course, setup, triangles, original, seeds, runs, found: Vec::new() };
        self.add(id, Work::Sweep(Box::new(sweeping)));
        Ok(())
    }

    /// Lets the input of `shown` run on another surface.
    pub(super) fn compare(&mut self, id: u64, shown: &Trial, mesh: Arc<TriMesh>) -> Result<(), TrialError> {
        let trial = shown.on(&mesh)?;
        let comparing = Comparing { mesh, original: None, noise: Noise::default(), orders: 0 };
        self.add(id, Work::Compare(Box::new(trial), comparing));
        Ok(())
    }

    fn add(&mut self, id: u64, work: Work) {
        self.0.push_back(Job { id, work, told: Instant::now() });
    }

    /// Gives up the job of this number.
    pub(super) fn cancel(&mut self, id: u64) {
        self.0.retain(|job| job.id != id);
    }

    /// Gives up comparing a trial that is no longer what it was.
    pub(super) fn drop_comparisons(&mut self) {
        self.0.retain(|job| !matches!(job.work, Work::Compare(..)));
    }

    /// Goes on with the first for a slice; `shown` is the trial that is shown.
    pub(super) fn work(&mut self, slice: Duration, shown: Option<&Trial>, events: &mut VecDeque<TrialEvent>) {
        let Some(job) = self.0.front_mut() else { return };
        let since = Instant::now();
        let mut swept = None;
        let is_over = match &mut job.work {
            Work::Measure(trial) | Work::Compare(trial, _) => {
                while trial.progress() == Progress::Running && since.elapsed() < slice {
                    trial.step();
                }
                trial.progress() != Progress::Running
            }
            Work::Sweep(sweeping) => {
                while swept.is_none() && since.elapsed() < slice {
                    swept = sweeping.advance().transpose();
                }
                swept.is_some()
            }
        };
        if !is_over {
            if job.told.elapsed().as_secs_f64() > TELL {
                job.told = Instant::now();
                events.push_back(TrialEvent::Busy { id: job.id, fraction: job.fraction() });
            }
            return;
        }
        let Some(Job { id, work, told }) = self.0.pop_front() else { return };
        match (work, shown) {
            (Work::Measure(trial), _) => {
                events.push_back(TrialEvent::Measured { id, summary: Box::new(trial.summary()) });
            }
            (Work::Sweep(_), _) => match swept {
                Some(Ok(row)) => events.push_back(TrialEvent::Swept { id, row }),
                Some(Err(error)) => events.push_back(TrialEvent::refused(id, &error)),
                None => {}
            },
            (Work::Compare(trial, mut comparing), Some(shown)) => {
                if let Some(comparison) = comparing.ran(trial, shown) {
                    events.push_back(TrialEvent::Compared { id, comparison: Box::new(comparison) });
                    return;
                }
                match shown.on_shuffled(&comparing.mesh, comparing.orders + 1) {
                    Ok(trial) => {
                        let work = Work::Compare(Box::new(trial), comparing);
                        self.0.push_front(Job { id, work, told });
                    }
                    Err(error) => events.push_back(TrialEvent::refused(id, &error)),
                }
            }
            (Work::Compare(..), None) => {}
        }
    }
}

impl Job {
    /// The part that is done.
    fn fraction(&self) -> f32 {
        match &self.work {
            Work::Measure(trial) => trial.part_done() as f32,
            Work::Compare(trial, comparing) => {
                let before = comparing.orders + u64::from(comparing.original.is_some());
                ((before as f64 + trial.part_done()) / (SHUFFLES + 1) as f64) as f32
            }
            Work::Sweep(sweeping) => {
                (sweeping.found.len() as f32 + sweeping.runs.fraction()) / sweeping.seeds.max(1) as f32
            }
        }
    }
}

impl Sweeping {
    /// Goes on for some steps. Gives the row once no seed is left.
    fn advance(&mut self) -> Result<Option<SweepRow>, TrialError> {
        let Some(comparison) = self.runs.advance(STEPS)? else { return Ok(None) };
        self.found.push(comparison);
        let seed = self.found.len() as u64 + 1;
        if seed > self.seeds {
            return Ok(Some(SweepRow::new(self.triangles, &self.found)));
        }
        let setup = Setup { seed, ..self.setup.clone() };
        self.runs = SeedRuns::new(self.course.clone(), setup, &self.original)?;
        Ok(None)
    }
}

impl Comparing {
    /// Takes in a run that is over. Returns what comes of all of them, once none is left to be made.
    fn ran(&mut self, trial: Box<Trial>, shown: &Trial) -> Option<TrialComparison> {
        match &self.original {
            None => self.original = Some(trial),
            Some(original) => {
                self.noise.take(original, &trial);
                self.orders += 1;
            }
        }
        let original = self.original.as_ref().filter(|_| self.orders == SHUFFLES)?;
        Some(TrialComparison::new(shown, original, &self.noise))
    }
}
