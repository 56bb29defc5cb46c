//! When which report goes to a physical interface device.
//!
//! Prepare: reset, actuators on, full gain, then each effect: ask for it, get its number, say what it is. Play: a spring
//! with a moving centre and a damper on both axes where the device has springs, else a constant force along each axis. An
//! effect lasts [`DURATION_MS`] and is started again every [`RESTART_MS`]; so if the host falls silent the device lets go by
//! itself. Nothing is written before the first wish. A stop overtakes all but the report that is under way.

use std::collections::VecDeque;

use super::layout::{Condition, Effect, Layout};
use crate::force::{ForceCommand, ForceDriver, ForceError, Reply, Request};
use crate::model::DeviceModel;
use crate::usage::{Usage, pid};

/// How long an effect plays without being started again, in ms.
pub const DURATION_MS: f64 = 100.0;
/// How often it is started again, in ms.
pub const RESTART_MS: f64 = 40.0;
/// The least between two reports of the same parameters, in ms: 500 a second.
const MIN_MS: f64 = 2.0;
/// How long a device may make room for an effect, in requests.
const TRIES: u32 = 5;
/// Failures in a row after which the device counts as gone.
const PATIENCE: u32 = 5;
/// ms without a reply after which it does.
const SILENCE_MS: f64 = 500.0;

/// What an effect of this driver is for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    kind: Usage,
    /// Its axes' places among the device's; a constant force has one.
    place: Option<usize>,
}

/// An effect that the device has.
#[derive(Clone, Debug)]
struct Playing {
    part: Part,
    index: u8,
    started_ms: Option<f64>,
}

/// What is to be done before anything plays.
#[derive(Clone, Debug)]
enum Step {
    Write(u8, Vec<u8>),
    Create(Part),
    Load(Part, u32),
    Describe(Part, u8),
}

/// What the report under way is.
#[derive(Clone, Debug)]
enum UnderWay {
    Step(Step),
    Parameters(usize),
    Start(usize),
    Stop,
}

/// Parameters that were or are to be told.
#[derive(Clone, Debug, Default)]
struct Parameters {
    report: Option<(u8, Vec<u8>)>,
    told: Option<(u8, Vec<u8>)>,
    told_ms: f64,
}

/// Drives a physical interface device.
#[derive(Clone, Debug)]
pub struct PidDriver {
    layout: Layout,
    has_coupling: bool,
    is_begun: bool,
    steps: VecDeque<Step>,
    playing: Vec<Playing>,
    /// For each effect and axis: `2 * effect + axis`.
    parameters: Vec<Parameters>,
    command: Option<ForceCommand>,
    must_stop: bool,
    under_way: Option<(UnderWay, f64)>,
    failures: u32,
    error: Option<ForceError>,
}

impl PidDriver {
    /// For a device whose feed and roll are its axes of these usages.
    ///
    /// # Errors
    /// When the device has no effects on any of them.
    pub fn new(model: &DeviceModel, axes: [Option<Usage>; 2]) -> Result<Self, ForceError> {
        let layout =
            Layout::new(model, axes).filter(|layout| layout.axes() != [None; 2]).ok_or(ForceError::Incomplete)?;
        let has_coupling = layout.offers(pid::ET_SPRING);
        if !has_coupling && !layout.offers(pid::ET_CONSTANT_FORCE) {
            return Err(ForceError::Incomplete);
        }
        Ok(Self {
            layout,
            has_coupling,
            is_begun: false,
            steps: VecDeque::new(),
            playing: Vec::new(),
            parameters: Vec::new(),
            command: None,
            must_stop: false,
            under_way: None,
            failures: 0,
            error: None,
        })
    }

    /// Renders by constant forces alone, for a device whose springs are no good.
    #[must_use]
    pub fn without_coupling(mut self) -> Self {
        self.has_coupling &= !self.layout.offers(pid::ET_CONSTANT_FORCE);
        self
    }

    /// The effects that it needs.
    fn parts(&self) -> Vec<Part> {
        if self.has_coupling {
            let kinds = [pid::ET_SPRING, pid::ET_DAMPER].into_iter().filter(|&kind| self.layout.offers(kind));
            return kinds.map(|kind| Part { kind, place: None }).collect();
        }
        let places = self.layout.axes().into_iter().flatten();
        places.map(|place| Part { kind: pid::ET_CONSTANT_FORCE, place: Some(place) }).collect()
    }

    fn begin(&mut self) {
        self.is_begun = true;
        let commands = [pid::DC_DEVICE_RESET, pid::DC_ENABLE_ACTUATORS].map(|command| self.layout.control(command));
        let writes = commands.into_iter().chain([self.layout.gain(1.0)]).flatten();
        self.steps = writes.map(|(id, data)| Step::Write(id, data)).collect();
        for (i, part) in self.parts().into_iter().enumerate() {
            // A host that numbers effects itself begins with 1.
            self.steps.push_back(if self.layout.makes_effects() {
                Step::Create(part)
            } else {
                Step::Describe(part, i as u8 + 1)
            });
        }
    }

    fn describe(&self, part: Part, index: u8) -> (u8, Vec<u8>) {
        let mut axes = [false; 2];
        let on = part.place.map_or_else(|| self.layout.axes().into_iter().flatten().collect(), |place| vec![place]);
        on.into_iter().for_each(|place| axes[place] = true);
        // A constant force comes from an angle: its sine is the first axis, less its cosine the second.
        let direction = part.place.map(|place| if place == 0 { 90.0 } else { 180.0 });
        self.layout.set_effect(&Effect { index, kind: part.kind, duration_ms: DURATION_MS, axes, direction })
    }

    /// The parameters of an effect along feed, 0, or roll, 1, for what is wished.
    fn parameters_for(&self, effect: usize, which: usize, command: &ForceCommand) -> Option<(u8, Vec<u8>)> {
        let Playing { part, index, .. } = &self.playing[effect];
        let place = self.layout.axes()[which]?;
        let of = &command[which];
        let limit = of.limit.clamp(0.0, 1.0);
        if part.kind == pid::ET_CONSTANT_FORCE {
            let force = if of.force.is_nan() { 0.0 } else { of.force.clamp(-limit, limit) };
            return (part.place == Some(place)).then(|| self.layout.set_constant(*index, force))?;
        }
        let coupling = of.coupling.unwrap_or_default();
        let coefficient = if part.kind == pid::ET_SPRING { coupling.stiffness } else { coupling.damping };
        // Without a number there is no force.
        let is_number = coupling.centre.is_finite() && coefficient.is_finite();
        let condition = Condition {
            centre: coupling.centre,
            coefficient: if is_number { coefficient } else { 0.0 },
            saturation: if is_number { limit } else { 0.0 },
        };
        self.layout.set_condition(*index, place, &condition)
    }

    fn refresh(&mut self) {
        let Some(command) = self.command else { return };
        self.parameters.resize_with(2 * self.playing.len(), Parameters::default);
        for slot in 0..self.parameters.len() {
            self.parameters[slot].report = self.parameters_for(slot / 2, slot % 2, &command);
        }
    }

    /// The step that comes next, and its request.
    fn prepare(&mut self) -> Option<(UnderWay, Request)> {
        let step = self.steps.pop_front()?;
        let send = |(id, data)| Request::Send { id, data };
        let request = match &step {
            Step::Write(id, data) => Some(Request::Send { id: *id, data: data.clone() }),
            Step::Create(part) => self.layout.create(part.kind).map(|(id, data)| Request::SetFeature { id, data }),
            Step::Load(..) => self.layout.load().map(|(id, bytes)| Request::GetFeature { id, bytes }),
            Step::Describe(part, index) => Some(send(self.describe(*part, *index))),
        };
        request.map(|request| (UnderWay::Step(step), request))
    }

    /// What is due while effects play: the oldest parameters that have changed, or a start.
    fn play(&mut self, now_ms: f64) -> Option<(UnderWay, Request)> {
        // What an effect does is said before it first starts.
        let untold = |parameters: &Parameters| parameters.report.is_some() && parameters.told.is_none();
        let is_told = !self.parameters.iter().any(untold);
        let is_due = |playing: &Playing| playing.started_ms.is_none_or(|started| now_ms - started >= RESTART_MS);
        if let Some(effect) = self.playing.iter().position(is_due).filter(|_| is_told) {
            self.playing[effect].started_ms = Some(now_ms);
            let (id, data) = self.layout.operate(self.playing[effect].index, true);
            return Some((UnderWay::Start(effect), Request::Send { id, data }));
        }
        let changed = (0..self.parameters.len()).filter(|&slot| {
            let of = &self.parameters[slot];
            of.report.is_some() && of.report != of.told && (of.told.is_none() || now_ms - of.told_ms >= MIN_MS)
        });
        let slot = changed.min_by(|&a, &b| {
            let age = |slot: usize| (self.parameters[slot].told.is_some(), self.parameters[slot].told_ms);
            let ((told, at), (other_told, other_at)) = (age(a), age(b));
            told.cmp(&other_told).then(at.total_cmp(&other_at))
        })?;
        let of = &mut self.parameters[slot];
        of.told.clone_from(&of.report);
        of.told_ms = now_ms;
        let (id, data) = of.report.clone()?;
        Some((UnderWay::Parameters(slot), Request::Send { id, data }))
    }

    /// The report that ends all force: for the whole device, or effect by effect where it has none.
    fn end(&mut self) -> Option<(UnderWay, Request)> {
        let whole = self.layout.control(pid::DC_STOP_ALL_EFFECTS);
        let one = self.playing.iter().find(|playing| playing.started_ms.is_some());
        let report = whole.or_else(|| one.map(|playing| self.layout.operate(playing.index, false)));
        let Some((id, data)) = report else {
            self.must_stop = false;
            return None;
        };
        Some((UnderWay::Stop, Request::Send { id, data }))
    }

    fn ended(&mut self) {
        if self.layout.control(pid::DC_STOP_ALL_EFFECTS).is_some() {
            self.playing.iter_mut().for_each(|playing| playing.started_ms = None);
        } else if let Some(playing) = self.playing.iter_mut().find(|playing| playing.started_ms.is_some()) {
            playing.started_ms = None;
        }
        self.must_stop = self.playing.iter().any(|playing| playing.started_ms.is_some());
    }

    /// A step went as it should, or brought an answer.
    fn stepped(&mut self, step: &Step, reply: Reply<'_>) {
        match *step {
            Step::Write(..) => {}
            Step::Create(part) => self.steps.push_front(Step::Load(part, 0)),
            Step::Load(part, tries) => {
                let Reply::Feature(answer) = reply else {
                    self.error = Some(ForceError::Silent);
                    return;
                };
                match self.layout.loaded(answer) {
                    Some(index) => self.steps.push_front(Step::Describe(part, index)),
                    None if tries + 1 < TRIES => self.steps.push_front(Step::Load(part, tries + 1)),
                    None => self.error = Some(ForceError::Full),
                }
            }
            Step::Describe(part, index) => {
                self.playing.push(Playing { part, index, started_ms: None });
                self.refresh();
            }
        }
    }
}

impl ForceDriver for PidDriver {
    fn command(&mut self, command: &ForceCommand) {
        self.command = Some(*command);
        self.must_stop = false;
        self.refresh();
    }

    fn stop(&mut self) {
        let was_on = self.command.take().is_some();
        self.must_stop |= was_on && self.is_begun;
        // What an effect did is no longer what it is to do when it starts again.
        self.parameters.iter_mut().for_each(|parameters| parameters.told = None);
    }

    fn next(&mut self, now_ms: f64) -> Option<Request> {
        if let Some((_, since)) = &self.under_way {
            if now_ms - since > SILENCE_MS {
                self.error = Some(ForceError::Silent);
            }
            return None;
        }
        if self.error.is_some() {
            return None;
        }
        let due = if self.must_stop {
            self.end()
        } else {
            self.command?;
            if !self.is_begun {
                self.begin();
            }
            if self.steps.is_empty() { self.play(now_ms) } else { self.prepare() }
        };
        let (what, request) = due?;
        self.under_way = Some((what, now_ms));
        Some(request)
    }

    fn reply(&mut self, _now_ms: f64, reply: Reply<'_>) {
        let Some((what, _)) = self.under_way.take() else { return };
        if reply == Reply::Failed {
            self.failures += 1;
            if self.failures >= PATIENCE {
                self.error = Some(ForceError::Silent);
            }
            match what {
                UnderWay::Step(step) => self.steps.push_front(step),
                UnderWay::Parameters(slot) => self.parameters[slot].told = None,
                UnderWay::Start(effect) => self.playing[effect].started_ms = None,
                UnderWay::Stop => {}
            }
            return;
        }
        self.failures = 0;
        match what {
            UnderWay::Step(step) => self.stepped(&step, reply),
            UnderWay::Stop => self.ended(),
            UnderWay::Parameters(_) | UnderWay::Start(_) => {}
        }
    }

    fn farewell(&self) -> Vec<Request> {
        if !self.is_begun {
            return Vec::new();
        }
        let stop = self.layout.control(pid::DC_STOP_ALL_EFFECTS).into_iter();
        let free = self.playing.iter().filter_map(|playing| self.layout.free(playing.index));
        stop.chain(free).map(|(id, data)| Request::Send { id, data }).collect()
    }

    fn error(&self) -> Option<ForceError> {
        self.error
    }

    fn has_coupling(&self) -> bool {
        self.has_coupling
    }
}
