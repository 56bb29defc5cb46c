//! A trial: a wire on its way through a vessel, what it is told, and what is measured of it.

mod look_ahead;
mod shown;

use std::sync::Arc;

use glam::DVec3;
use web_time::Instant;

use self::look_ahead::{Found, LookAhead};
use super::STEP;
use super::autopilot::{Autopilot, AutopilotTask, BACK as WITHDRAWAL, DECISION, FEED, Seen};
use super::course::{Course, TrialError};
use super::frame::{Progress, Touch};
use super::log::Log;
use super::meter::{Meter, SinceRow};
use super::missed::{MissedFork, MissedForkText};
use super::peak_force_map::PeakForceMap;
use super::press::outward;
use super::report::StepKind;
use super::setup::{Command, Input, Setup};
use super::simulation::Simulation;
use super::stopwatch::Stopwatch;
use super::wire::Wire;
use lumen_pipeline::task::milliseconds;
use lumen_vessel::Located;

/// Steps between two rows of the log, and between two decisions.
pub const ROW_STEPS: u64 = (DECISION / STEP + 0.5) as u64;
/// Steps between two places that can be gone back to: a second.
const MARK_STEPS: u64 = (1.0 / STEP + 0.5) as u64;
/// Places that can be gone back to.
const MARKS: usize = 60;
/// The tip has arrived within this of the target's cross-section, in mm.
const ARRIVED: f64 = 2.0;
/// Cosine between the shaft's way and the route's below which the wire has turned back.
const BACK: f64 = -0.3;

/// What changes from step to step.
#[derive(Clone, Debug)]
struct State {
    simulation: Simulation,
    /// Its wire: see [`Setup::nth_wire`].
    wire: usize,
    /// Static and kinetic friction, varied by the seed.
    friction: [f64; 2],
    autopilot: Autopilot,
    /// The wires that failed before it, in turn.
    failed: Vec<usize>,
    /// Times that the wires before this one were withdrawn.
    retractions: u32,
    input: Input,
    located: Option<Located>,
    arc: f64,
    is_off: bool,
    /// The fork that has yet to be taken rightly.
    missed: Option<MissedFork>,
    is_looped: bool,
    progress: Progress,
    meter: Meter,
    /// Steps that the autopilot has steered this wire; those in which it takes it out do not count.
    steered: u64,
    /// While it takes it out for another: how many steps it has done so.
    leaving: Option<u64>,
    /// What the wall has felt, by every balanced step up to here.
    felt: PeakForceMap,
    rows: usize,
}

/// A trial.
///
/// Where the autopilot has tried all it knows at a place, or its time is over, and the setup has another wire, it takes the
/// wire out and goes on with that one from the entry. The steps that this takes are steps of the trial.
///
/// Where it withdraws the wire again at a place, the trial stands still and looks ahead: what it would try is simulated,
/// attempt by attempt, on a copy. The first that gets past is then made; where nothing does, the wire is taken out for
/// another, or, if there is none, what would be tried is tried. The log has what was done alone.
#[derive(Debug)]
pub struct Trial {
    course: Arc<Course>,
    setup: Setup,
    state: State,
    marks: Vec<State>,
    /// How long steps took: kept once, and not with each mark, as it grows with every step.
    stopwatch: Stopwatch,
    log: Log,
    is_steered: bool,
    /// What the operator does from the next row of the log on.
    wanted: Input,
    /// Input to be replayed: from which step on, and what; and the steps of it all.
    replay: Option<(Vec<Command>, u64)>,
    limit_s: f64,
    /// While it looks ahead.
    ahead: Option<Box<LookAhead>>,
    /// Whether it looks ahead: what is simulated for that does not.
    looks_ahead: bool,
}

impl Trial {
    /// The wire at the entry of a course.
    ///
    /// # Errors
    /// When it does not fit there.
    pub fn new(course: Arc<Course>, setup: Setup) -> Result<Self, TrialError> {
        let (simulation, friction) = course.place(&setup, &setup.wire)?;
        let limit_s = 3.0 * course.route.length_mm / FEED + 30.0;
        let state = State {
            simulation,
            wire: 0,
            friction,
            autopilot: Autopilot::default(),
            failed: Vec::new(),
            retractions: 0,
            input: Input::default(),
            located: None,
            arc: 0.0,
            is_off: false,
            missed: None,
            is_looped: false,
            progress: Progress::Running,
            meter: Meter::new(&course.route),
            steered: 0,
            leaving: None,
            felt: PeakForceMap::default(),
            rows: 0,
        };
        let log = Log::new(setup.clone(), course.fingerprint, course.reach);
        let mut trial = Self {
            course,
            setup,
            state,
            marks: Vec::new(),
            stopwatch: Stopwatch::default(),
            log,
            is_steered: false,
            wanted: Input::default(),
            replay: None,
            limit_s,
            ahead: None,
            looks_ahead: true,
        };
        trial.look();
        trial.mark();
        Ok(trial)
    }

    /// Plays this input, from the start, in place of any other, for so many steps.
    pub fn replay(&mut self, inputs: Vec<Command>, steps: u64) {
        self.replay = Some((inputs, steps));
    }

    /// Steps that the replay has in all, if it is one.
    pub fn replayed_steps(&self) -> Option<u64> {
        self.replay.as_ref().map(|replay| replay.1)
    }

    /// What it takes place in.
    pub fn course(&self) -> &Arc<Course> {
        &self.course
    }

    /// Its setup, with entry and target.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The wire that is in.
    pub fn wire(&self) -> &Wire {
        self.setup.nth_wire(self.state.wire).unwrap_or(&self.setup.wire)
    }

    /// The names of the wires that were in before it, in turn.
    pub fn failed_wires(&self) -> Vec<&str> {
        self.state.failed.iter().filter_map(|&i| Some(self.setup.nth_wire(i)?.name.as_str())).collect()
    }

    /// Static and kinetic friction, varied by the seed.
    pub fn friction(&self) -> [f64; 2] {
        self.state.friction
    }

    /// The wire.
    pub fn simulation(&self) -> &Simulation {
        &self.state.simulation
    }

    /// What was measured so far.
    pub fn meter(&self) -> &Meter {
        &self.state.meter
    }

    /// How long its steps took so far.
    pub(super) fn stopwatch(&self) -> &Stopwatch {
        &self.stopwatch
    }

    /// What was logged so far.
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.state.progress
    }

    /// Simulated seconds after which the autopilot has lost with a wire; a hand, or a log, takes the time that it takes.
    pub fn limit_s(&self) -> f64 {
        self.limit_s
    }

    /// The part that is done, 0 to 1: of the steps that a replay has, else of the time that the autopilot has.
    pub fn part_done(&self) -> f64 {
        let all = self.replayed_steps().map_or(self.limit_s() / STEP, |all| all as f64);
        (self.simulation().steps() as f64 / all.max(1.0)).min(1.0)
    }

    /// Steers by itself from the next row of the log on, or no longer.
    pub fn set_autopilot(&mut self, on: bool) {
        self.is_steered = on;
        self.ahead = None;
        // What a hand has done since then may have helped.
        self.state.leaving = None;
        self.wanted = Input::default();
    }

    /// What is done from the next row of the log on, by hand.
    pub fn drive(&mut self, input: Input) {
        self.wanted = input.limited();
    }

    /// Whether it stands still and looks ahead. Until it has, a step is one of what is simulated for that.
    pub fn is_looking_ahead(&self) -> bool {
        self.ahead.as_ref().is_some_and(|ahead| ahead.found().is_none())
    }

    /// One step of [`STEP`] seconds; nothing once it is over.
    pub fn step(&mut self) {
        if let Some(ahead) = self.ahead.as_mut().filter(|ahead| ahead.found().is_none()) {
            ahead.step(&self.state);
            return;
        }
        let steps = self.state.simulation.steps();
        if self.replay.as_ref().is_some_and(|&(_, all)| steps >= all) && self.state.progress == Progress::Running {
            self.state.progress = Progress::Over;
        }
        if steps.is_multiple_of(ROW_STEPS) && self.state.progress == Progress::Running {
            self.decide(steps);
        }
        if self.state.progress != Progress::Running || self.ahead.is_some() {
            return;
        }
        let start = Instant::now();
        self.press();
        let state = &mut self.state;
        let report = state.simulation.step(state.input);
        self.stopwatch.stepped(milliseconds(start));
        state.meter.stepped(&report, &state.simulation);
        if report.kind == StepKind::Balanced {
            state.felt.take(touches(&state.simulation));
        }
        if self.is_steered {
            *state.leaving.as_mut().unwrap_or(&mut state.steered) += 1;
        }
        let steps = self.state.simulation.steps();
        if steps.is_multiple_of(ROW_STEPS) {
            self.look();
            if steps.is_multiple_of(MARK_STEPS) {
                self.mark();
            }
        }
    }

    /// Presses the wire to the wall, if that is to be.
    fn press(&mut self) {
        let (press, simulation) = (self.setup.press, &mut self.state.simulation);
        if press.n_per_mm <= 0.0 {
            return;
        }
        let mut loads = Vec::new();
        if simulation.inserted() >= f64::from(press.from_mm) {
            loads = outward(&self.course.route, simulation.nodes());
            loads.iter_mut().for_each(|load| *load *= f64::from(press.n_per_mm));
        }
        simulation.set_loads(loads);
    }

    /// Runs to the end.
    pub fn finish(&mut self) {
        while self.state.progress == Progress::Running {
            self.step();
        }
    }

    /// Goes back by a second of simulated time, if there is so much.
    pub fn step_back(&mut self) {
        let steps = self.state.simulation.steps();
        while let Some(mark) = self.marks.last()
            && mark.simulation.steps() + MARK_STEPS / 2 > steps
            && self.marks.len() > 1
        {
            self.marks.pop();
        }
        if let Some(mark) = self.marks.last() {
            self.state = mark.clone();
            self.stopwatch.keep(self.state.simulation.steps() as usize);
            self.wanted = Input::default();
            self.ahead = None;
            self.log.rows.truncate(self.state.rows);
        }
    }

    fn mark(&mut self) {
        if self.marks.len() == MARKS {
            self.marks.remove(1);
        }
        self.state.rows = self.log.rows.len();
        self.marks.push(self.state.clone());
    }

    /// The input of the next row.
    fn decide(&mut self, steps: u64) {
        if let Some((inputs, _)) = &self.replay {
            let known = inputs.partition_point(|command| command.step <= steps);
            let command = known.checked_sub(1).map(|i| inputs[i]);
            if let Some(wire) = command.map(|command| command.wire).filter(|&wire| wire != self.state.wire)
                && !self.exchange(wire)
            {
                self.state.progress = Progress::Over;
            }
            self.state.input = command.map_or(Input::default(), |command| command.input);
        } else if self.is_steered {
            self.steer();
            if self.ahead.is_some() {
                return;
            }
        } else {
            self.state.input = self.wanted;
        }
        let row = self.row();
        self.log.rows.push(row);
        self.state.meter.since_row = SinceRow::default();
    }

    /// What the autopilot does until the next row.
    fn steer(&mut self) {
        self.state.input = Input::default();
        if let Some(steps) = self.state.leaving {
            if self.state.simulation.is_back() {
                if !self.next_that_fits().is_some_and(|wire| self.exchange(wire)) {
                    self.state.progress = Progress::GaveUp;
                }
            } else if steps as f64 * STEP > self.limit_s {
                self.state.progress = Progress::GaveUp;
            } else {
                self.state.input.feed = -WITHDRAWAL as f32;
            }
            return;
        }
        let seen = self.seen();
        let mut autopilot = self.state.autopilot.clone();
        let found = self.ahead.take().and_then(|ahead| {
            self.state.meter.looked_ahead += ahead.steps();
            ahead.found()
        });
        if let Some(found) = found {
            autopilot.looked_ahead(found.attempt());
        }
        let input = autopilot.decide(&self.course.route, &seen);
        let is_late = self.state.steered as f64 * STEP > self.limit_s;
        if self.looks_ahead
            && !is_late
            && let Some(place) = autopilot.failed_again_since(&self.state.autopilot)
        {
            self.ahead = Some(Box::new(LookAhead::new(self, &autopilot, place)));
            return;
        }
        self.state.autopilot = autopilot;
        self.state.meter.retractions = self.state.retractions + self.state.autopilot.retractions;
        let is_in_vain = found == Some(Found::Nothing);
        let has_failed = is_late || input.is_none() || is_in_vain || self.state.autopilot.has_failed_at_a_place();
        match input {
            _ if has_failed && self.next_that_fits().is_some() => self.state.leaving = Some(0),
            _ if is_late => self.state.progress = Progress::TimedOut,
            Some(input) => self.state.input = input.limited(),
            None => self.state.progress = Progress::GaveUp,
        }
    }

    /// The next wire that fits at the entry: one that is too thick is passed over.
    fn next_that_fits(&self) -> Option<usize> {
        let fits = |wire: &Wire| self.course.place(&self.setup, wire).is_ok();
        (self.state.wire + 1..=self.setup.next_wires.len()).find(|&wire| self.setup.nth_wire(wire).is_some_and(fits))
    }

    /// What the autopilot is doing.
    fn task(&self) -> AutopilotTask {
        match &self.ahead {
            Some(ahead) => ahead.task(),
            None if self.state.leaving.is_some() => AutopilotTask::Exchanging,
            None => self.state.autopilot.task(),
        }
    }

    /// Takes out the wire that is in, and puts another at the entry. Says whether it fits there; if not, nothing changes.
    fn exchange(&mut self, wire: usize) -> bool {
        let placed = self.setup.nth_wire(wire).map(|next| self.course.place(&self.setup, next));
        let Some(Ok((mut simulation, friction))) = placed else { return false };
        let state = &mut self.state;
        simulation.count_from(state.simulation.steps());
        state.failed.push(state.wire);
        state.retractions = state.meter.retractions;
        (state.simulation, state.friction, state.wire) = (simulation, friction, wire);
        (state.autopilot, state.steered, state.leaving) = (Autopilot::default(), 0, None);
        (state.located, state.missed, state.is_off, state.is_looped, state.arc) = (None, None, false, false, 0.0);
        self.look();
        true
    }

    fn seen(&self) -> Seen {
        let State { simulation, arc, is_off, is_looped, .. } = &self.state;
        let [_, side] = self.tip_side();
        Seen {
            tip: simulation.tip(),
            shaft: self.shaft(),
            side,
            arc: *arc,
            inserted: simulation.inserted(),
            is_off: *is_off,
            is_looped: *is_looped,
            is_hard: simulation.is_at_limit(),
        }
    }

    /// The direction of the shaft behind the bend of the tip.
    fn shaft(&self) -> DVec3 {
        let (rod, wire) = (&self.state.simulation.body().rod, self.wire());
        let behind = wire.bend_mm + 2.0 * wire.elements_mm[0];
        let grid = self.state.simulation.grid();
        let edge = grid.partition_point(|&at| at < behind).min(self.state.simulation.count());
        -rod.tangent(edge)
    }

    /// Direction of the tip, and the side to which it is bent, as the frame behind the bend has it.
    fn tip_side(&self) -> [DVec3; 2] {
        let simulation = &self.state.simulation;
        let wire = self.wire();
        let grid = simulation.grid();
        let edge = grid.partition_point(|&at| at < wire.bend_mm).min(simulation.count());
        [simulation.tip_direction(), simulation.body().rod.director(edge)]
    }

    /// Finds out where the tip is, and whether that is the end.
    fn look(&mut self) {
        let tip = self.state.simulation.tip();
        let route = &self.course.route;
        let state = &mut self.state;
        state.located = self.course.tree.locate(tip, state.located.as_ref());
        let was_off = state.is_off;
        state.is_off = state.located.as_ref().is_some_and(|located| route.is_off(tip, located));
        let on = route.locate(tip);
        if !state.is_off {
            state.arc = on.arc_mm;
            state.missed = state.missed.filter(|missed| !missed.is_passed(route, on.arc_mm));
        } else if let Some(located) = state.located.as_ref().filter(|_| !was_off) {
            state.missed = Some(MissedFork { arc_mm: state.arc, into: located.branch });
        }
        let shaft = self.shaft();
        let state = &mut self.state;
        let was_looped = state.is_looped;
        state.is_looped = shaft.dot(route.at(on.arc_mm).direction) < BACK && state.simulation.inserted() > 15.0;
        state.meter.wrong_branches += u32::from(state.is_off && !was_off);
        state.meter.loops += u32::from(state.is_looped && !was_looped);
        state.meter.looked(&state.simulation, state.arc);
        let is_there = !state.is_off && route.distance_to_target(tip) <= ARRIVED;
        if state.progress == Progress::Running && is_there {
            state.progress = Progress::Arrived;
        }
    }

    /// The fork that it missed and has not taken rightly since, as a clause; `None` where it missed none.
    pub(super) fn missed_fork(&self) -> Option<MissedForkText> {
        self.state.missed.map(|missed| missed.words(&self.course.tree, &self.course.route))
    }

    /// Where that fork is: where the tip left the route, in mm.
    pub(super) fn missed_fork_at(&self) -> Option<DVec3> {
        self.state.missed.map(|missed| self.course.route.at(missed.arc_mm).at)
    }

    /// What the wall has felt so far.
    pub fn felt(&self) -> &PeakForceMap {
        &self.state.felt
    }

    /// The same, to be told.
    pub fn felt_mut(&mut self) -> &mut PeakForceMap {
        &mut self.state.felt
    }
}

/// Where the wire presses against the vessel now.
fn touches(simulation: &Simulation) -> impl Iterator<Item = Touch> {
    simulation.body().touches().map(|(_, at, triangle, force)| {
        let at = at.as_vec3().to_array();
        Touch { at, triangle, force: force as f32 }
    })
}
