//! The reports of a physical interface device, found by usages, and filled.
//!
//! What differs between devices: ids and order of fields; whether the device's control takes a number or a bit for each
//! command (an array of 8 bits, or bits that are variables); whether effects are made by the device or numbered by the host;
//! whether arrays list their usages in order (some browsers list those of a CAMMUS DDWB backwards, or others altogether:
//! then the order of the usage tables holds).

use crate::field::{Content, Field};
use crate::model::{DeviceModel, Kind, Report};
use crate::usage::{Usage, desktop, page, pid};

/// Effect types in the order of the usage tables.
const TYPES: [Usage; 12] = [
    pid::ET_CONSTANT_FORCE,
    Usage::new(page::PHYSICAL_INTERFACE, 0x27),
    Usage::new(page::PHYSICAL_INTERFACE, 0x30),
    Usage::new(page::PHYSICAL_INTERFACE, 0x31),
    Usage::new(page::PHYSICAL_INTERFACE, 0x32),
    Usage::new(page::PHYSICAL_INTERFACE, 0x33),
    Usage::new(page::PHYSICAL_INTERFACE, 0x34),
    pid::ET_SPRING,
    pid::ET_DAMPER,
    Usage::new(page::PHYSICAL_INTERFACE, 0x42),
    Usage::new(page::PHYSICAL_INTERFACE, 0x43),
    Usage::new(page::PHYSICAL_INTERFACE, 0x28),
];
const OPERATIONS: [Usage; 3] = [pid::OP_EFFECT_START, pid::OP_EFFECT_START_SOLO, pid::OP_EFFECT_STOP];
const CONTROLS: [Usage; 6] = [
    pid::DC_ENABLE_ACTUATORS,
    pid::DC_DISABLE_ACTUATORS,
    pid::DC_STOP_ALL_EFFECTS,
    pid::DC_DEVICE_RESET,
    pid::DC_DEVICE_PAUSE,
    pid::DC_DEVICE_CONTINUE,
];
const STATUSES: [Usage; 3] = [pid::BLOCK_LOAD_SUCCESS, pid::BLOCK_LOAD_FULL, pid::BLOCK_LOAD_ERROR];

/// The number that stands for a usage in an array, or in a variable that is used as one. `all` are the usages that belong
/// there, in the order of the tables.
fn selector(field: &Field, usage: Usage, all: &[Usage]) -> Option<i64> {
    let listed: Vec<_> = all.iter().map(|&of| field.usages.position(of)).collect();
    let is_backward = listed.iter().flatten().count() > 1 && listed.iter().flatten().is_sorted_by(|a, b| a > b);
    let place = match field.usages.position(usage) {
        Some(place) if is_backward => listed.iter().flatten().max()?.checked_sub(place)?,
        Some(place) => place,
        // Not offered, unless the list is of something else altogether.
        None if listed.iter().any(Option::is_some) => return None,
        None => all.iter().position(|of| *of == usage)? as u32,
    };
    let value = field.logical.least.checked_add(place.into())?;
    // A list that does not fit its own range was told wrongly.
    if value <= field.logical.greatest {
        return Some(value);
    }
    let place = all.iter().position(|of| *of == usage)?;
    field.logical.least.checked_add(place as i64).filter(|value| *value <= field.logical.greatest)
}

/// A report that is being filled.
pub(super) struct Filling<'a> {
    model: &'a DeviceModel,
    report: &'a Report,
    pub(super) data: Vec<u8>,
}

impl<'a> Filling<'a> {
    fn new(model: &'a DeviceModel, report: &'a Report) -> Self {
        Self { model, report, data: report.blank() }
    }

    /// Puts a number into the element of this usage, if there is one; what does not fit is brought within range.
    fn put(&mut self, usage: Usage, value: impl Fn(&Field) -> i64) {
        if let Some(slot) = self.report.find(usage) {
            _ = slot.write(&mut self.data, value(slot.field));
        }
    }

    /// Puts the number of a usage into the array in that collection.
    fn select(&mut self, collection: Usage, usage: Usage, all: &[Usage]) {
        let within = |field: &&Field| field.content == Content::Array && self.model.is_in(field, collection);
        let field = self.report.fields.iter().find(within);
        if let Some((field, value)) = field.and_then(|field| Some((field, selector(field, usage, all)?))) {
            _ = field.write(&mut self.data, 0, value);
        }
    }

    /// Puts a number into an element of the collection: into the `place`th of its fields' elements.
    fn put_in(&mut self, collection: Usage, place: usize, value: impl Fn(&Field) -> i64) {
        let fields = self.report.fields.iter().filter(|field| self.model.is_in(field, collection));
        let mut elements = fields.flat_map(|field| (0..field.count).map(move |element| (field, element)));
        if let Some((field, element)) = elements.nth(place) {
            _ = field.write(&mut self.data, element, value(field));
        }
    }
}

/// A part, 0 to 1, of the greatest that a field takes.
fn part(value: f64) -> impl Fn(&Field) -> i64 {
    move |field| field.clamp((value.clamp(0.0, 1.0) * field.logical.greatest as f64).round() as i64)
}

/// ms in a field's own unit: seconds by a power of ten, or ms where it names none.
fn milliseconds(ms: f64) -> impl Fn(&Field) -> i64 {
    move |field| {
        let exponent = if field.unit_exponent == 0 { -3 } else { i32::from(field.unit_exponent) };
        field.from_physical(ms * libm::pow(10.0, f64::from(-3 - exponent)))
    }
}

/// What an effect is, for [`Layout::set_effect`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// Its number on the device.
    pub index: u8,
    /// Constant force, spring or damper.
    pub kind: Usage,
    /// How long it plays, in ms.
    pub duration_ms: f64,
    /// Which of the device's axes it is on.
    pub axes: [bool; 2],
    /// The angle that it comes from, in degrees, where it has one.
    pub direction: Option<f64>,
}

/// A condition along an axis, in parts of the greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// The centre, -1 to 1.
    pub centre: f64,
    /// The coefficient on both sides, 0 to 1.
    pub coefficient: f64,
    /// The saturation on both sides, 0 to 1.
    pub saturation: f64,
}

/// The device's reports.
#[derive(Clone, Debug)]
pub struct Layout {
    model: DeviceModel,
    effect: Report,
    operation: Report,
    condition: Option<Report>,
    constant: Option<Report>,
    control: Option<Report>,
    gain: Option<Report>,
    free: Option<Report>,
    create: Option<Report>,
    load: Option<Report>,
    /// The places of feed and roll among the axes of its effects.
    axes: [Option<usize>; 2],
}

impl Layout {
    /// Those of a device; feed and roll are its axes of these usages. `None` where it has no effects, or no way to start
    /// one.
    pub fn new(model: &DeviceModel, axes: [Option<Usage>; 2]) -> Option<Self> {
        let output = |usage| model.report_in(Kind::Output, usage).cloned();
        let feature = |usage| model.report_in(Kind::Feature, usage).cloned();
        let effect = output(pid::SET_EFFECT_REPORT)?;
        let enable = effect.fields.iter().filter(|field| model.is_in(field, pid::AXES_ENABLE));
        let named: Vec<_> =
            enable.flat_map(|field| (0..field.count).filter_map(|element| field.usage(element))).collect();
        // A device that names no axes, or others than those that it reads, has them in the order of X and Y.
        let places = axes.map(|usage| {
            let usage = usage?;
            named.iter().position(|of| *of == usage).or(match usage {
                desktop::X => Some(0),
                desktop::Y => Some(1),
                _ => None,
            })
        });
        Some(Self {
            operation: output(pid::EFFECT_OPERATION_REPORT)?,
            condition: output(pid::SET_CONDITION_REPORT),
            constant: output(pid::SET_CONSTANT_FORCE_REPORT),
            control: output(pid::DEVICE_CONTROL),
            gain: output(pid::DEVICE_GAIN_REPORT),
            free: output(pid::BLOCK_FREE_REPORT),
            create: feature(pid::CREATE_NEW_EFFECT_REPORT),
            load: feature(pid::BLOCK_LOAD_REPORT),
            axes: places.map(|place| place.filter(|place| *place < 2 && *place < named.len().max(1))),
            effect,
            model: model.clone(),
        })
    }

    /// The places of feed and roll among the axes of its effects, where they have forces.
    pub fn axes(&self) -> [Option<usize>; 2] {
        self.axes
    }

    /// Whether it plays this type of effect, and takes its parameters.
    pub fn offers(&self, kind: Usage) -> bool {
        let parameters = if kind == pid::ET_CONSTANT_FORCE { &self.constant } else { &self.condition };
        let within = |field: &&Field| field.content == Content::Array && self.model.is_in(field, pid::EFFECT_TYPE);
        let listed = self.effect.fields.iter().find(within);
        parameters.is_some() && listed.is_some_and(|field| selector(field, kind, &TYPES).is_some())
    }

    /// Whether the device numbers effects; else the host does, from 1 on.
    pub fn makes_effects(&self) -> bool {
        self.create.is_some() && self.load.is_some()
    }

    /// The feature report that asks for a new effect: its id and bytes.
    pub fn create(&self, kind: Usage) -> Option<(u8, Vec<u8>)> {
        let report = self.create.as_ref()?;
        let mut filling = Filling::new(&self.model, report);
        filling.select(pid::EFFECT_TYPE, kind, &TYPES);
        if filling.data.iter().all(|&byte| byte == 0) {
            filling.select(pid::CREATE_NEW_EFFECT_REPORT, kind, &TYPES);
        }
        Some((report.id, filling.data))
    }

    /// The feature report that tells what became of it: its id and its length.
    pub fn load(&self) -> Option<(u8, usize)> {
        self.load.as_ref().map(|report| (report.id, report.bytes()))
    }

    /// The number of a new effect in the answer; `None` where there was no room. Systems differ in whether the id comes
    /// first: it does where the answer is one byte too long and begins with it.
    pub fn loaded(&self, answer: &[u8]) -> Option<u8> {
        let report = self.load.as_ref()?;
        let answer = match answer {
            [id, rest @ ..] if *id == report.id && rest.len() == report.bytes() => rest,
            whole => whole,
        };
        let index = report.find(pid::EFFECT_BLOCK_INDEX)?.read(answer)?;
        let within = |field: &&Field| self.model.is_in(field, pid::BLOCK_LOAD_STATUS);
        let is_loaded = report.fields.iter().find(within).is_none_or(|field| {
            let (status, success) = (field.read(answer, 0), selector(field, pid::BLOCK_LOAD_SUCCESS, &STATUSES));
            status.is_some() && status == success
        });
        u8::try_from(index).ok().filter(|index| is_loaded && *index != 0)
    }

    /// The report that says what an effect is.
    pub fn set_effect(&self, effect: &Effect) -> (u8, Vec<u8>) {
        let mut filling = Filling::new(&self.model, &self.effect);
        filling.put(pid::EFFECT_BLOCK_INDEX, |_| effect.index.into());
        filling.select(pid::EFFECT_TYPE, effect.kind, &TYPES);
        filling.put(pid::DURATION, milliseconds(effect.duration_ms));
        filling.put(pid::GAIN, part(1.0));
        // All ones are no button: what DirectInput writes, and outside of every range that has a null.
        filling.put(pid::TRIGGER_BUTTON, |_| -1);
        for (place, is_on) in effect.axes.into_iter().enumerate() {
            filling.put_in(pid::AXES_ENABLE, place, |_| is_on.into());
        }
        if let Some(degrees) = effect.direction {
            filling.put(pid::DIRECTION_ENABLE, |_| 1);
            filling.put_in(pid::DIRECTION, 0, |field| field.from_part(degrees / 360.0));
        }
        (self.effect.id, filling.data)
    }

    /// The report that sets a spring or damper along the axis of this place.
    pub fn set_condition(&self, index: u8, place: usize, condition: &Condition) -> Option<(u8, Vec<u8>)> {
        let report = self.condition.as_ref()?;
        let mut filling = Filling::new(&self.model, report);
        filling.put(pid::EFFECT_BLOCK_INDEX, |_| index.into());
        filling.put(pid::PARAMETER_BLOCK_OFFSET, |_| place as i64);
        filling.put(pid::CP_OFFSET, |field| field.from_signed(condition.centre));
        filling.put(pid::POSITIVE_COEFFICIENT, part(condition.coefficient));
        filling.put(pid::NEGATIVE_COEFFICIENT, part(condition.coefficient));
        filling.put(pid::POSITIVE_SATURATION, part(condition.saturation));
        filling.put(pid::NEGATIVE_SATURATION, part(condition.saturation));
        Some((report.id, filling.data))
    }

    /// The report that sets a constant force of -1 to 1.
    pub fn set_constant(&self, index: u8, force: f64) -> Option<(u8, Vec<u8>)> {
        let report = self.constant.as_ref()?;
        let mut filling = Filling::new(&self.model, report);
        filling.put(pid::EFFECT_BLOCK_INDEX, |_| index.into());
        filling.put(pid::MAGNITUDE, |field| field.from_signed(force));
        Some((report.id, filling.data))
    }

    /// The report that starts or stops an effect.
    pub fn operate(&self, index: u8, starts: bool) -> (u8, Vec<u8>) {
        let mut filling = Filling::new(&self.model, &self.operation);
        let operation = if starts { pid::OP_EFFECT_START } else { pid::OP_EFFECT_STOP };
        filling.put(pid::EFFECT_BLOCK_INDEX, |_| index.into());
        filling.select(pid::EFFECT_OPERATION, operation, &OPERATIONS);
        filling.put(pid::LOOP_COUNT, |_| starts.into());
        (self.operation.id, filling.data)
    }

    /// The report that gives an effect back.
    pub fn free(&self, index: u8) -> Option<(u8, Vec<u8>)> {
        let report = self.free.as_ref()?;
        let mut filling = Filling::new(&self.model, report);
        filling.put(pid::EFFECT_BLOCK_INDEX, |_| index.into());
        Some((report.id, filling.data))
    }

    /// The report for a command to the whole device: a bit where each command is one, else its number.
    pub fn control(&self, command: Usage) -> Option<(u8, Vec<u8>)> {
        let report = self.control.as_ref()?;
        let mut data = report.blank();
        let is_bit = report.find(command).filter(|slot| slot.field.size == 1);
        let is_written = match is_bit {
            Some(slot) => slot.write(&mut data, 1),
            None => {
                let field = report.fields.iter().find(|field| self.model.is_in(field, pid::DEVICE_CONTROL))?;
                field.write(&mut data, 0, selector(field, command, &CONTROLS)?)
            }
        };
        is_written.then_some((report.id, data))
    }

    /// The report that sets the gain of all, 0 to 1.
    pub fn gain(&self, gain: f64) -> Option<(u8, Vec<u8>)> {
        let report = self.gain.as_ref()?;
        let mut filling = Filling::new(&self.model, report);
        filling.put(pid::DEVICE_GAIN, part(gain));
        Some((report.id, filling.data))
    }
}
