//! Looking ahead by simulation: which of the autopilot's attempts at a place gets past it.
//!
//! Each is made on a copy of the trial, in the autopilot's own order, until the tip is past the place, or the wire would be
//! withdrawn again. Where none gets past and there is another wire, all that the autopilot would do with this one is
//! simulated, too: each failure leaves the wire as another attempt may find it. Only where that is in vain is it exchanged.
//!
//! Steps are counted, and no clock is looked at: the same trial finds the same. What is simulated is what happens, so what
//! gets past then gets past again.
//!
//! Limits: only the autopilot's own attempts are tried. What comes after the place is not looked at.

use std::collections::VecDeque;

use super::{Progress, State, Trial};
use crate::autopilot::{Autopilot, AutopilotTask};
use crate::log::Log;
use crate::stopwatch::Stopwatch;

/// Steps that are looked ahead at one place. An attempt takes 400 to 2,000, there are 21, and all that is done with a wire
/// that does not get past takes 20,000 to 30,000.
const MAX_STEPS: u64 = 60_000;

/// Attempts that are simulated one after another.
#[derive(Debug)]
pub(super) struct LookAhead {
    /// A copy of the trial, in which one is made.
    trial: Trial,
    /// All of them: by their number in the autopilot's plan, or `None` for what it would do without looking ahead.
    attempts: VecDeque<Option<usize>>,
    /// How many of them were in vain.
    failed: usize,
    /// Arc length of the place along the route, in mm.
    place: f64,
    /// Times that the wire is withdrawn once an attempt is made.
    retractions: u32,
    /// Steps so far.
    steps: u64,
    found: Option<Found>,
}

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Found {
    /// This attempt gets past.
    Attempt(usize),
    /// What would be done without looking ahead gets past, or may.
    Usual,
    /// Nothing gets past.
    Nothing,
}

impl Found {
    pub(super) fn attempt(self) -> Option<usize> {
        match self {
            Self::Attempt(attempt) => Some(attempt),
            Self::Usual | Self::Nothing => None,
        }
    }
}

impl LookAhead {
    /// For a trial whose autopilot would withdraw the wire again at `place`, and be as `withdrawn`.
    pub(super) fn new(trial: &Trial, withdrawn: &Autopilot, place: f64) -> Self {
        let usual = trial.next_that_fits().map(|_| None);
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
            attempts: Autopilot::plan().map(Some).chain(usual).collect(),
            failed: 0,
            place,
            retractions: withdrawn.retractions,
            steps: 0,
            found: None,
        };
        ahead.begin();
        ahead
    }

    /// Begins an attempt, where the copy is as the trial.
    fn begin(&mut self) {
        match self.attempts.get(self.failed) {
            Some(&attempt) => self.trial.state.autopilot.looked_ahead(attempt),
            None => self.found = Some(Found::Nothing),
        }
    }

    /// A step of an attempt, and the beginning of the next if that was in vain; `state` is that of the trial.
    pub(super) fn step(&mut self, state: &State) {
        let Some(&attempt) = self.attempts.get(self.failed) else { return };
        self.trial.step();
        self.steps += 1;
        let ahead = &self.trial.state;
        if ahead.progress == Progress::Arrived || ahead.autopilot.is_past(self.place, &self.trial.seen()) {
            self.found = Some(attempt.map_or(Found::Usual, Found::Attempt));
        } else if self.steps >= MAX_STEPS {
            self.found = Some(Found::Usual);
        } else if ahead.progress != Progress::Running
            || ahead.leaving.is_some()
            || attempt.is_some() && ahead.autopilot.retractions > self.retractions
        {
            self.failed += 1;
            self.trial.state.clone_from(state);
            self.trial.marks.clear();
            self.trial.log.rows.clear();
            self.begin();
        }
    }

    /// What was found, once it is over.
    pub(super) fn found(&self) -> Option<Found> {
        self.found
    }

    /// Steps so far.
    pub(super) fn steps(&self) -> u64 {
        self.steps
    }

    /// What it is doing, to a user.
    pub(super) fn task(&self) -> AutopilotTask {
        let attempts = self.attempts.len();
        AutopilotTask::LookingAhead { attempt: (self.failed + 1).min(attempts) as u32, attempts: attempts as u32 }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::course::Course;
    use crate::log::Log;
    use crate::setup::{Entry, Setup};
    use crate::wire::Wire;
    use lumen_mesh::shapes::parted;

    /// A trunk 16 mm wide with a branch half as wide that leaves it by 60°, and a trial on the way into that.
    fn forked(wire: &'static str, next: &[&'static str]) -> Trial {
        let (mesh, end) = parted(8.0, 90.0, 40.0, 1.0);
        let mesh = Arc::new(mesh);
        let mut setup = Setup {
            wire: Wire::preset(wire).unwrap(),
            next_wires: next.iter().map(|wire| Wire::preset(wire).unwrap()).collect(),
            entry: Some(Entry { at: [0.0, 0.0, 4.0], direction: [0.0, 0.0, 1.0] }),
            target: Some(end.as_vec3().to_array()),
            seed: 2,
            ..Setup::default()
        };
        let course = Arc::new(Course::new(&mesh, None, &mut setup).unwrap());
        let mut trial = Trial::new(course, setup).unwrap();
        trial.set_autopilot(true);
        trial
    }

    fn bits(trial: &Trial) -> Vec<u64> {
        trial.simulation().nodes().flat_map(|p| p.to_array()).map(f64::to_bits).collect()
    }

    fn until_it_looks_ahead(trial: &mut Trial) {
        while !trial.is_looking_ahead() {
            assert_eq!(trial.progress(), Progress::Running);
            trial.step();
        }
    }

    #[test]
    fn the_attempt_that_is_found_gets_past_and_the_log_replays_without_looking_ahead() {
        let mut trial = forked("035-angled", &[]);
        until_it_looks_ahead(&mut trial);
        let (stands, summary) = (bits(&trial), trial.summary());
        let mut attempts = Vec::new();
        while trial.is_looking_ahead() {
            let doing = trial.frame().doing;
            if attempts.last() != Some(&doing) {
                attempts.push(doing);
            }
            trial.step();
        }
        assert_eq!((bits(&trial), trial.summary()), (stands, summary), "the trial stands still");
        let told = |attempt| Some(AutopilotTask::LookingAhead { attempt, attempts: 21 });
        assert_eq!(attempts, (1..=attempts.len() as u32).map(told).collect::<Vec<_>>());
        trial.finish();
        let summary = trial.summary();
        // The attempts that fail are left out.
        assert!(summary.success && summary.retractions == 2 && attempts.len() > 1, "{}, {attempts:?}", summary.reason);
        assert!((500..MAX_STEPS).contains(&summary.steps_looked_ahead), "{}", summary.steps_looked_ahead);
        let mut again = forked("035-angled", &[]);
        again.finish();
        assert_eq!((bits(&again), again.summary().steps_looked_ahead), (bits(&trial), summary.steps_looked_ahead));
        let recorded = Log::read(trial.log().csv(summary.steps).unwrap().as_bytes()).unwrap();
        let mut replayed = Trial::new(trial.course().clone(), recorded.setup).unwrap();
        replayed.replay(recorded.inputs, recorded.steps);
        (0..summary.steps).for_each(|_| replayed.step());
        assert_eq!((bits(&replayed), replayed.progress()), (bits(&trial), Progress::Arrived));
        assert_eq!(replayed.summary().steps_looked_ahead, 0);
    }

    #[test]
    fn a_hand_that_takes_the_wire_meanwhile_finds_it_as_it_was() {
        let mut trial = forked("035-angled", &[]);
        until_it_looks_ahead(&mut trial);
        let (stands, summary, rows) = (bits(&trial), trial.summary(), trial.log().rows.clone());
        (0..300).for_each(|_| trial.step());
        assert!(trial.is_looking_ahead());
        trial.set_autopilot(false);
        assert!(!trial.is_looking_ahead() && trial.frame().doing.is_none());
        assert_eq!((bits(&trial), trial.summary(), &trial.log().rows), (stands, summary, &rows));
        // The autopilot that has it back looks ahead anew, and comes to the same end.
        trial.set_autopilot(true);
        trial.finish();
        let mut whole = forked("035-angled", &[]);
        whole.finish();
        assert_eq!(bits(&trial), bits(&whole));
        // A step back ends it, too.
        let mut trial = forked("035-angled", &[]);
        until_it_looks_ahead(&mut trial);
        let steps = trial.simulation().steps();
        trial.step_back();
        assert!(!trial.is_looking_ahead() && trial.simulation().steps() < steps);
    }

    #[test]
    fn where_no_attempt_gets_past_within_the_bound_the_next_wire_goes_in() {
        // The tip of the first is too short.
        let mut trial = forked("workhorse", &["035-angled"]);
        trial.finish();
        let summary = trial.summary();
        assert_eq!(summary.failed_wires, ["workhorse"]);
        assert!(summary.success && summary.retractions < 10, "{summary:?}");
        // One place for the one wire, and one for the other.
        assert!((10_000..=2 * MAX_STEPS).contains(&summary.steps_looked_ahead), "{summary:?}");
    }
}
