//! Trials that run to their end as fast as they go, one after another and in slices, while the trial that is shown waits:
//! measurements, and comparisons with the unreduced surface.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use super::message::TrialEvent;
use super::start::start;
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::trial::STEP;
use crate::trial::compare::{Noise, SHUFFLES, TrialComparison};
use crate::trial::course::TrialError;
use crate::trial::frame::Progress;
use crate::trial::session::Trial;
use crate::trial::setup::Setup;

/// Seconds between two words on how far a job is.
const TELL: f64 = 0.5;

/// Jobs, in the order in which they were asked for.
#[derive(Default)]
pub(super) struct Jobs(VecDeque<Job>);

struct Job {
    id: u64,
    trial: Box<Trial>,
    kind: Kind,
    told: Instant,
}

enum Kind {
    Measure,
    Compare(Comparing),
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
        self.add(id, trial, Kind::Measure);
        Ok(())
    }

    /// Lets the input of `shown` run on another surface.
    pub(super) fn compare(&mut self, id: u64, shown: &Trial, mesh: Arc<TriMesh>) -> Result<(), TrialError> {
        let trial = shown.on(&mesh)?;
        self.add(id, trial, Kind::Compare(Comparing { mesh, original: None, noise: Noise::default(), orders: 0 }));
        Ok(())
    }

    fn add(&mut self, id: u64, trial: Trial, kind: Kind) {
        self.0.push_back(Job { id, trial: Box::new(trial), kind, told: Instant::now() });
    }

    /// Gives up the job of this number.
    pub(super) fn cancel(&mut self, id: u64) {
        self.0.retain(|job| job.id != id);
    }

    /// Gives up comparing a trial that is no longer what it was.
    pub(super) fn drop_comparisons(&mut self) {
        self.0.retain(|job| matches!(job.kind, Kind::Measure));
    }

    /// Goes on with the first for a slice; `shown` is the trial that is shown.
    pub(super) fn work(&mut self, slice: Duration, shown: Option<&Trial>, events: &mut VecDeque<TrialEvent>) {
        let Some(job) = self.0.front_mut() else { return };
        let since = Instant::now();
        while job.trial.progress() == Progress::Running && since.elapsed() < slice {
            job.trial.step();
        }
        if job.trial.progress() == Progress::Running {
            if job.told.elapsed().as_secs_f64() > TELL {
                job.told = Instant::now();
                events.push_back(TrialEvent::Busy { id: job.id, fraction: job.fraction() });
            }
            return;
        }
        let Some(Job { id, trial, kind, told }) = self.0.pop_front() else { return };
        match (kind, shown) {
            (Kind::Measure, _) => {
                events.push_back(TrialEvent::Measured { id, summary: Box::new(trial.summary()) });
            }
            (Kind::Compare(mut comparing), Some(shown)) => {
                if let Some(comparison) = comparing.ran(trial, shown) {
                    events.push_back(TrialEvent::Compared { id, comparison: Box::new(comparison) });
                    return;
                }
                match shown.on_shuffled(&comparing.mesh, comparing.orders + 1) {
                    Ok(trial) => {
                        let kind = Kind::Compare(comparing);
                        self.0.push_front(Job { id, trial: Box::new(trial), kind, told });
                    }
                    Err(error) => events.push_back(TrialEvent::refused(id, &error)),
                }
            }
            (Kind::Compare(_), None) => {}
        }
    }
}

impl Job {
    /// The part that is done.
    fn fraction(&self) -> f32 {
        let steps = self.trial.simulation().steps() as f64;
        let all = self.trial.replayed_steps().map_or(self.trial.limit_s() / STEP, |all| all as f64);
        let part = steps / all.max(1.0);
        match &self.kind {
            Kind::Measure => part as f32,
            Kind::Compare(comparing) => {
                let before = comparing.orders + u64::from(comparing.original.is_some());
                ((before as f64 + part) / (SHUFFLES + 1) as f64) as f32
            }
        }
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
