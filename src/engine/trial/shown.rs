//! The trial that is shown: what moves it, and what is told of it.

use std::collections::VecDeque;
use std::time::Duration;

use lumen_message::Message as _;
use web_time::Instant;

use super::haptic_channel::{Grasp, HapticChannel};
use super::message::{HAND, TrialEvent};
use super::pace::Pace;
use crate::language::{decimal, tell};
use crate::say;
use crate::trial::course::TrialError;
use crate::trial::frame::Progress;
use crate::trial::log::Log;
use crate::trial::session::Trial;
use crate::trial::setup::Input;

/// Seconds between two frames.
const FRAME: f64 = 1.0 / 60.0;

/// How often a wire at its entry is looked at for a device's hand.
const LOOK: Duration = Duration::from_millis(20);

/// The hand on the wire. Whoever holds it tells so again and again; one that is not heard of any more (its window is
/// hidden, its page has stopped) is off.
#[derive(Clone, Copy, PartialEq)]
enum Hand {
    /// None is on it.
    Off,
    /// It was heard of since the clock was looked at last.
    Heard,
    /// It is on the wire until then, in seconds by the clock.
    Until(f64),
}

/// What moves the wire.
#[derive(Clone, Copy, PartialEq)]
enum Mover {
    /// Nothing has yet: it lies at its entry, and its time does not run.
    Nothing,
    /// A hand, or no one just now.
    Hand,
    /// The autopilot, or a log.
    Steering,
}

impl Mover {
    /// A hand is on the wire. Who steers goes on.
    fn take_hold(&mut self) {
        if *self == Self::Nothing {
            *self = Self::Hand;
        }
    }

    /// Who steers does so no longer.
    fn release(&mut self) {
        if *self == Self::Steering {
            *self = Self::Hand;
        }
    }
}

/// The trial that is shown.
pub(super) struct Shown {
    /// That of the command which began what is shown now.
    id: u64,
    trial: Box<Trial>,
    mover: Mover,
    hand: Hand,
    /// A haptic device's.
    grasp: Grasp,
    is_paused: bool,
    pace: Pace,
    /// When the last frame was told, in seconds by the clock.
    framed: f64,
    /// Whether the end was told.
    is_told: bool,
    needs_frame: bool,
}

impl Shown {
    pub(super) fn new(id: u64, trial: Trial, exchange: Option<HapticChannel>) -> Self {
        Self {
            id,
            trial: Box::new(trial),
            mover: Mover::Nothing,
            hand: Hand::Off,
            grasp: Grasp::new(exchange),
            is_paused: false,
            pace: Pace::new(),
            framed: f64::NEG_INFINITY,
            is_told: false,
            needs_frame: true,
        }
    }

    /// What is simulated.
    pub(super) fn trial(&self) -> &Trial {
        &self.trial
    }

    /// A command of number `id` begins what follows, whether or not it can be done: the frames that follow are those after
    /// it.
    pub(super) fn begin(&mut self, id: u64) {
        self.id = id;
    }

    /// What the wall has felt up to where the wire is now is told to whoever has forgotten all.
    pub(super) fn tell_felt_again(&mut self) {
        self.trial.felt_mut().tell_again();
    }

    /// A frame is told in the next slice, whatever the clock says.
    pub(super) fn needs_frame(&mut self) {
        self.needs_frame = true;
    }

    /// Goes on with the input of a hand.
    pub(super) fn drive(&mut self, input: Input) {
        self.trial.drive(input);
        self.grasp.beside = input.limited();
        let is_on = input != Input::default();
        self.hand = if is_on { Hand::Heard } else { Hand::Off };
        if is_on {
            self.mover.take_hold();
        }
    }

    pub(super) fn set_autopilot(&mut self, on: bool) {
        self.trial.set_autopilot(on);
        if on {
            self.mover = Mover::Steering;
        } else {
            self.mover.release();
        }
    }

    pub(super) fn pause(&mut self, on: bool) {
        self.is_paused = on;
        self.grasp.rest();
    }

    pub(super) fn set_pace(&mut self, pace: f32) {
        self.pace.set(pace);
    }

    /// Begins again on the same course, by hand.
    pub(super) fn restart(&mut self) -> Result<(), TrialError> {
        let made = Trial::new(self.trial.course().clone(), self.trial.setup().clone());
        let trial = made.inspect_err(|_| self.hand_over())?;
        *self = Self { pace: self.pace.anew(), ..Self::new(self.id, trial, self.grasp.exchange()) };
        Ok(())
    }

    /// Goes back by a second of simulated time, and stands still.
    pub(super) fn step_back(&mut self) {
        self.trial.step_back();
        self.pace.forgive();
        (self.is_paused, self.is_told) = (true, false);
    }

    /// Begins again with what a log says.
    pub(super) fn replay(&mut self, csv: &[u8]) -> Result<(), String> {
        let trial = self.recorded(csv).inspect_err(|_| self.hand_over())?;
        let anew = Self::new(self.id, trial, self.grasp.exchange());
        *self = Self { pace: self.pace.anew(), mover: Mover::Steering, ..anew };
        Ok(())
    }

    fn recorded(&self, csv: &[u8]) -> Result<Trial, String> {
        let recorded = Log::read(csv).map_err(|error| tell(&error))?;
        let (course, setup) = (self.trial.course().clone(), self.trial.setup());
        if recorded.surface != format!("{:016x}", course.fingerprint) {
            return Err(say!("devices-log-other-surface"));
        }
        if (recorded.setup.entry, recorded.setup.target) != (setup.entry, setup.target) {
            return Err(say!("devices-log-other-route", length = decimal(course.route.length_mm, 0)));
        }
        let mut trial = Trial::new(course, recorded.setup).map_err(|error| tell(&error))?;
        trial.replay(recorded.inputs, recorded.steps);
        Ok(trial)
    }

    /// What was to begin anew could not: it goes on, but in the hand of whoever asked.
    fn hand_over(&mut self) {
        self.trial.set_autopilot(false);
        self.mover.release();
        (self.is_paused, self.is_told) = (false, false);
    }

    /// Lets go of the wire where the hand was not heard of for too long. The autopilot and a log need none.
    pub(super) fn look_after_hand(&mut self, now_s: f64) {
        match self.hand {
            Hand::Heard => self.hand = Hand::Until(now_s + HAND),
            Hand::Until(end) if now_s > end => {
                self.trial.drive(Input::default());
                self.grasp.beside = Input::default();
                self.hand = Hand::Off;
            }
            Hand::Off | Hand::Until(_) => {}
        }
    }

    /// Other work is done at `now_s`: the wire waits.
    pub(super) fn wait(&mut self, now_s: f64) {
        self.pace.skip(now_s);
        self.grasp.rest();
    }

    /// Whether it stands, whatever the clock says.
    fn stands(&self) -> bool {
        self.is_paused || self.mover == Mover::Nothing
    }

    fn is_over(&self) -> bool {
        self.trial.progress() != Progress::Running
    }

    /// Works for a slice at `now_s`, and tells what there is to show; says after what time it wants to go on.
    pub(super) fn advance(
        &mut self,
        now_s: f64,
        slice: Duration,
        events: &mut VecDeque<TrialEvent>,
    ) -> Option<Duration> {
        if self.stands() || self.is_over() {
            self.pace.stand();
            let moves = self.grasp.rest();
            if moves && !self.is_paused {
                self.mover.take_hold();
            }
        } else if self.trial.is_looking_ahead() {
            self.look_ahead(now_s, slice);
        } else {
            let Self { pace, trial, grasp, mover, .. } = self;
            pace.run(trial, now_s, slice, |trial| grasp.step(trial, *mover != Mover::Steering));
        }
        let is_over = self.is_over();
        let is_end = is_over && !self.is_told;
        if self.needs_frame || is_end || now_s - self.framed >= FRAME && !self.stands() {
            self.framed = now_s;
            self.needs_frame = false;
            self.tell_frame(events);
        }
        if is_end {
            self.is_told = true;
            let (summary, end) = (Box::new(self.trial.summary()), self.trial.end().told());
            events.push_back(TrialEvent::Ended { id: self.id, summary, end });
        }
        match (is_over, self.stands()) {
            (false, false) if self.trial.is_looking_ahead() => Some(Duration::ZERO),
            (false, false) => Some(self.pace.rest()),
            // A hand that takes hold of the wire is no command.
            (false, true) if self.grasp.is_awaited() && !self.is_paused => Some(LOOK),
            _ => None,
        }
    }

    /// Looks ahead for a slice, as fast as it goes: the wire stands, and that time is not made up for.
    fn look_ahead(&mut self, now_s: f64, slice: Duration) {
        let since = Instant::now();
        while self.trial.is_looking_ahead() && since.elapsed() < slice {
            self.trial.step();
        }
        self.wait(now_s);
    }

    fn tell_frame(&mut self, events: &mut VecDeque<TrialEvent>) {
        let touches = self.trial.felt_mut().news();
        if !touches.is_empty() {
            events.push_back(TrialEvent::Felt { id: self.id, touches });
        }
        let mut frame = self.trial.frame();
        (frame.steps_per_second, frame.is_behind) = (self.pace.speed(), self.pace.is_behind());
        events.push_back(TrialEvent::Frame { id: self.id, frame: Box::new(frame) });
    }
}
