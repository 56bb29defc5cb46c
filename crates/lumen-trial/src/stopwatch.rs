//! What the clock says of a trial: how long its steps take.

use serde::{Deserialize, Serialize};

use super::STEP;

/// Steps in a second of simulated time.
const SECOND: usize = (1.0 / STEP + 0.5) as usize;
/// Steps in 1/60 s of simulated time.
const FRAME_STEPS: f64 = 1.0 / 60.0 / STEP;

/// The times of single steps, in ms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepTimes {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub p50: f64,
    /// 95th percentile.
    #[serde(default)]
    pub p95: f64,
    /// 99th percentile.
    pub p99: f64,
    /// The longest.
    pub max: f64,
}

/// What was measured where the tip passed one of the five stations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StationResult {
    /// Arc length along the route, in mm.
    pub arc_mm: f64,
    /// When the tip passed it first, in simulated seconds; `None` if it never did.
    pub time_s: Option<f64>,
    /// Steps a second over the second of simulated time around it.
    pub steps_per_second: Option<f64>,
    /// Mean milliseconds of 1/60 s of simulated time around it.
    pub simulation_ms: Option<f64>,
}

/// The times of all steps.
#[derive(Clone, Debug, Default)]
pub(super) struct Stopwatch {
    /// Milliseconds of each step.
    step_ms: Vec<f32>,
}

impl Stopwatch {
    /// Takes a step in.
    pub(super) fn stepped(&mut self, ms: f64) {
        self.step_ms.push(ms as f32);
    }

    /// Forgets all but the first steps.
    pub(super) fn keep(&mut self, steps: usize) {
        self.step_ms.truncate(steps);
    }

    /// Mean milliseconds of the last `count` steps.
    pub(super) fn last_ms(&self, count: usize) -> f64 {
        mean(&self.step_ms[self.step_ms.len().saturating_sub(count)..])
    }

    /// Milliseconds of all steps together.
    pub(super) fn total_ms(&self) -> f64 {
        self.step_ms.iter().map(|&ms| f64::from(ms)).sum()
    }

    /// Milliseconds of 1/60 s of simulated time, over the first simulated second.
    pub(super) fn first_frame_ms(&self) -> f64 {
        mean(&self.step_ms[..self.step_ms.len().min(SECOND)]) * FRAME_STEPS
    }

    /// The times of single steps.
    pub(super) fn times(&self) -> StepTimes {
        let mut sorted = self.step_ms.clone();
        sorted.sort_by(f32::total_cmp);
        let at = |part: f64| sorted.get(((sorted.len() as f64 * part) as usize).min(sorted.len().max(1) - 1));
        let at = |part: f64| at(part).map_or(0.0, |&ms| f64::from(ms));
        StepTimes { mean: mean(&self.step_ms), p50: at(0.5), p95: at(0.95), p99: at(0.99), max: at(1.0) }
    }

    /// What was measured around a station at this arc length in mm, by the step at which the tip passed it.
    pub(super) fn station(&self, arc_mm: f64, passed: Option<usize>) -> StationResult {
        let around = passed.map(|step| {
            let from = step.saturating_sub(SECOND / 2);
            let to = (step + SECOND / 2).min(self.step_ms.len());
            mean(&self.step_ms[from..to])
        });
        StationResult {
            arc_mm,
            time_s: passed.map(|step| step as f64 * STEP),
            steps_per_second: around.map(|ms| 1e3 / ms.max(1e-6)),
            simulation_ms: around.map(|ms| ms * FRAME_STEPS),
        }
    }
}

fn mean(values: &[f32]) -> f64 {
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len().max(1) as f64
}
