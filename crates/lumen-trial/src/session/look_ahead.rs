//! Looking ahead by simulation: which of the autopilot's attempts at a place gets past it.
//!
//! Each is made on a copy of the trial, in the autopilot's own order, until the tip is past the place, or the wire would be
//! withdrawn again. Steps are counted, and no clock is looked at: the same trial finds the same. What is simulated is what
//! happens, so the attempt that is then made gets past, too.
//!
//! Limits: only the autopilot's own attempts are tried, one deep. What comes after the place is not looked at.

use std::collections::VecDeque;

use super::{Progress, State, Trial};
use crate::autopilot::Autopilot;
use crate::log::Log;
use crate::stopwatch::Stopwatch;

/// Steps that are looked ahead at one place. An attempt takes 400 to 2,000, and there are 21.
pub(super) const MAX_STEPS: u64 = 30_000;

/// Attempts that are simulated one after another.
#[derive(Debug)]
pub(super) struct LookAhead {
    /// A copy of the trial, in which one is made.
    trial: Trial,
    /// Those that follow it.
    rest: VecDeque<usize>,
    /// The one that is made.
    attempt: usize,
    /// Arc length of the place along the route, in mm.
    place: f64,
    /// Times that the wire is withdrawn once it is made.
    retractions: u32,
    /// Steps so far, and at most.
    steps: u64,
    most: u64,
    found: Option<usize>,
    is_over: bool,
}

impl LookAhead {
    /// For a trial whose autopilot would withdraw the wire again at `place`, and be as `withdrawn`; `None` where `looked`
    /// steps are all that may be looked ahead there.
    pub(super) fn new(trial: &Trial, withdrawn: &Autopilot, place: f64, looked: u64) -> Option<Self> {
        let most = MAX_STEPS.checked_sub(looked).filter(|&most| most > 0)?;
        let mut plan = Autopilot::plan();
        let attempt = plan.next()?;
        let copy = Trial {
            course: trial.course.clone(),
            setup: trial.setup.clone(),
            state: trial.state.clone(),
            marks: Vec::new(),
            stopwatch: Stopwatch::default(),
            log: Log::new(trial.setup.clone(), trial.course.fingerprint, trial.course.reach),
            is_steered: true,
            wanted: trial.wanted,
            replay: None,
            limit_s: trial.limit_s,
            ahead: None,
            looks_ahead: false,
        };
        let mut ahead = Self {
            trial: copy,
            rest: plan.collect(),
            attempt,
            place,
            retractions: withdrawn.retractions,
            steps: 0,
            most,
            found: None,
            is_over: false,
        };
        ahead.trial.state.autopilot.settle(Some(attempt));
        Some(ahead)
    }

    /// A step of the attempt that is made, or the beginning of the next; `state` is that of the trial.
    pub(super) fn step(&mut self, state: &State) {
        self.trial.step();
        self.steps += 1;
        let ahead = &self.trial.state;
        if ahead.progress == Progress::Arrived || ahead.autopilot.is_past(self.place, &self.trial.seen()) {
            (self.found, self.is_over) = (Some(self.attempt), true);
        } else if self.steps >= self.most {
            self.is_over = true;
        } else if ahead.progress != Progress::Running
            || ahead.leaving.is_some()
            || ahead.autopilot.retractions > self.retractions
        {
            self.begin_next(state);
        }
    }

    fn begin_next(&mut self, state: &State) {
        let Some(attempt) = self.rest.pop_front() else {
            self.is_over = true;
            return;
        };
        self.attempt = attempt;
        self.trial.state.clone_from(state);
        self.trial.state.autopilot.settle(Some(attempt));
        self.trial.marks.clear();
        self.trial.log.rows.clear();
    }

    /// Whether it has found what it can.
    pub(super) fn is_over(&self) -> bool {
        self.is_over
    }

    /// The attempt that gets past the place.
    pub(super) fn found(&self) -> Option<usize> {
        self.found
    }

    /// Steps so far.
    pub(super) fn steps(&self) -> u64 {
        self.steps
    }

    /// The part of the steps that it may take that is done.
    pub(super) fn percent(&self) -> u32 {
        (100 * self.steps / self.most) as u32
    }
}
