//! How a trial keeps pace with the clock.

use std::time::Duration;

use web_time::Instant;

use crate::trial::STEP;
use crate::trial::frame::Progress;
use crate::trial::session::Trial;

/// Seconds by which the trial may be behind the clock before it slows down.
pub(super) const BEHIND: f64 = 0.05;
/// Seconds over which the speed is told.
const TELL: f64 = 0.5;

/// The clock, as the trial has followed it.
pub(super) struct Pace {
    /// Simulated seconds a second.
    pace: f64,
    /// Simulated seconds that the clock has asked for and that are not done.
    owed: f64,
    /// When it was looked at last; `None` where the trial stood.
    clock: Option<f64>,
    is_behind: bool,
    /// Steps and the clock's seconds for them since the speed was told last, and that speed.
    counted: (u64, f64),
    speed: f32,
}

impl Pace {
    /// As fast as time.
    pub(super) fn new() -> Self {
        Self { pace: 1.0, owed: 0.0, clock: None, is_behind: false, counted: (0, 0.0), speed: 0.0 }
    }

    /// The same pace, with nothing owed and nothing counted.
    pub(super) fn anew(&self) -> Self {
        Self { pace: self.pace, ..Self::new() }
    }

    /// Goes on with so many simulated seconds a second.
    pub(super) fn set(&mut self, pace: f32) {
        self.pace = if pace.is_finite() { f64::from(pace).clamp(0.01, 1.0) } else { 1.0 };
    }

    /// Whether the trial is behind the clock.
    pub(super) fn is_behind(&self) -> bool {
        self.is_behind
    }

    /// Steps a second that were made of late; 0 where that is not known.
    pub(super) fn speed(&self) -> f32 {
        self.speed
    }

    /// What the clock has asked for is not to be done.
    pub(super) fn forgive(&mut self) {
        self.owed = 0.0;
    }

    /// The machine works on something else at `now_s`: that time is not made up for.
    pub(super) fn skip(&mut self, now_s: f64) {
        (self.clock, self.owed, self.is_behind) = (Some(now_s), 0.0, false);
    }

    /// The trial stands. What time passes until it goes on is not owed.
    pub(super) fn stand(&mut self) {
        self.clock = None;
    }

    /// Makes as many steps as the clock asks for at `now_s`, and the slice allows, each by `step`.
    pub(super) fn run(&mut self, trial: &mut Trial, now_s: f64, slice: Duration, mut step: impl FnMut(&mut Trial)) {
        let passed = self.clock.replace(now_s).map_or(0.0, |before| (now_s - before).max(0.0));
        self.owed += passed * self.pace;
        // After a pause of the machine it goes on, and does not hurry after it.
        self.is_behind = self.owed > BEHIND;
        self.owed = self.owed.min(BEHIND);
        let start = Instant::now();
        let mut steps = 0;
        while self.owed >= STEP && start.elapsed() < slice && trial.progress() == Progress::Running {
            step(trial);
            if trial.is_looking_ahead() {
                break;
            }
            self.owed -= STEP;
            steps += 1;
        }
        self.counted.0 += steps;
        self.counted.1 += start.elapsed().as_secs_f64();
        if self.counted.0 as f64 * STEP > TELL * self.pace && self.counted.1 > 0.0 {
            self.speed = (self.counted.0 as f64 / self.counted.1) as f32;
            self.counted = (0, 0.0);
        }
    }

    /// After what time it has something to do.
    pub(super) fn rest(&self) -> Duration {
        if self.owed >= STEP { Duration::ZERO } else { Duration::from_secs_f64(2.0 * STEP) }
    }
}
