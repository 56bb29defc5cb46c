//! A device being served: what it is asked, how it is, and what is learnt of it. Whoever has the transport and the clock
//! calls it; it has neither.

use serde::{Deserialize, Serialize};

use super::device::{HapticDevice, Resistance};
use super::latency::Percentiles;
use super::learning::{Ask, Learning};
use super::mapping::Mapping;
use super::safety::Halt;

/// What a device is asked.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum DeviceCommand {
    /// The user has seen what will move, and lets it.
    Arm,
    /// Force ends until it is armed again.
    Halt(Halt),
    /// Force ends while the trial is paused.
    Pause(bool),
    /// Other axes feed and roll.
    Map(Mapping),
    /// Those that most devices are held by feed and roll.
    Propose,
    /// Learns which axes those are: a push, then a turn.
    Learn,
    /// The part of the device's most force that 1 N, and 1 N mm, are felt as; not below 0.
    Factor([f64; 2]),
    /// Where the hand on the virtual device wants it, in mm and radians.
    Want([f64; 2]),
}

/// An axis, as it is shown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AxisStatus {
    /// Its name.
    pub name: String,
    /// Where it is, -1 to 1.
    pub part: f64,
    /// Its last number; `None` before the first.
    pub raw: Option<i64>,
}

/// How a device is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DeviceStatus {
    /// What it is called.
    pub name: String,
    /// By what its mapping is remembered; empty before it is open.
    pub key: String,
    /// Its axes.
    pub axes: Vec<AxisStatus>,
    /// Which feed and roll.
    pub mapping: Mapping,
    /// What the user is asked for while a mapping is learnt.
    pub asks: Option<Ask>,
    /// Whether it can give a force.
    pub has_force: bool,
    /// Why there is no force now; `None` where it is armed.
    pub halted: Option<Halt>,
    /// The part of its most force that 1 N, and 1 N mm, are felt as.
    pub factor: [f64; 2],
    /// What is felt now, in N and N mm; `None` without a trial.
    pub felt: Option<[f64; 2]>,
    /// Where the hand on the virtual device wants it, in mm and radians; `None` for another device.
    pub wanted: Option<[f64; 2]>,
    /// From input report to output report.
    pub latency: Percentiles,
    /// Why it is no longer served, in one sentence.
    pub ended: Option<String>,
}

/// 1 N is four fifths, and 10 N mm are half, of what the device gives.
const FACTOR: [f64; 2] = [0.8, 0.05];

/// A device being served.
pub struct Service {
    device: HapticDevice,
    factor: [f64; 2],
    wanted: Option<[f64; 2]>,
    felt: Option<[f64; 2]>,
    learning: Option<Learning>,
}

impl Service {
    /// Of a device that has just been opened.
    pub fn new(device: HapticDevice) -> Self {
        Self { device, factor: FACTOR, wanted: None, felt: None, learning: None }
    }

    /// The same of a device whose hand is told where to go: the virtual one.
    #[must_use]
    pub fn with_virtual_hand(self) -> Self {
        Self { wanted: Some([0.0; 2]), ..self }
    }

    /// The device, for input, requests and replies.
    pub fn device_mut(&mut self) -> &mut HapticDevice {
        &mut self.device
    }

    /// Where the hand on the virtual device wants it, in mm and radians.
    pub fn wanted(&self) -> [f64; 2] {
        self.wanted.unwrap_or_default()
    }

    /// Does what is asked.
    pub fn handle(&mut self, command: DeviceCommand) {
        match command {
            DeviceCommand::Arm => self.device.arm(),
            DeviceCommand::Halt(why) => self.device.halt(why),
            DeviceCommand::Pause(on) => self.device.pause(on),
            DeviceCommand::Map(mapping) => {
                self.learning = None;
                self.device.set_mapping(mapping);
            }
            DeviceCommand::Propose => {
                self.learning = None;
                self.device.propose_mapping();
            }
            DeviceCommand::Learn => {
                self.device.halt(Halt::NotArmed);
                self.learning = Some(Learning::new(self.device.travel()));
            }
            DeviceCommand::Factor(factor) => {
                self.factor = factor.map(|of| if of.is_finite() { of.max(0.0) } else { 0.0 });
            }
            DeviceCommand::Want(wanted) => self.wanted = self.wanted.map(|_| wanted),
        }
    }

    /// How far to feed, in mm, and to roll, in radians, for what the hand did in the last `dt_s` seconds; nothing while it
    /// is learnt what moves.
    pub fn advance(&mut self, dt_s: f64) -> [f64; 2] {
        let moved = self.device.advance(dt_s);
        let Some(learning) = &mut self.learning else { return moved };
        learning.observe(self.device.controls(), self.device.state());
        if learning.ask() == Ask::Done {
            let clutch = self.device.mapping().clutch;
            self.device.set_mapping(Mapping { clutch, ..learning.mapping() });
            self.learning = None;
        }
        [0.0; 2]
    }

    /// Says what the trial lets the hand feel at `now_ms`: force in N and torque in N mm, and by how much these grow with
    /// each mm and radian; `None` where there is no trial.
    pub fn feel(&mut self, now_ms: f64, feels: Option<([f64; 2], [f64; 2])>) {
        self.felt = feels.map(|(felt, _)| felt);
        let Some((felt, stiffness)) = feels else { return };
        let scaled = |values: [f64; 2]| std::array::from_fn(|i| values[i] * self.factor[i]);
        self.device.resist(now_ms, &Resistance { part: scaled(felt), slope: scaled(stiffness) });
    }

    /// How it is.
    pub fn status(&self) -> DeviceStatus {
        let device = &self.device;
        let axes = device.controls().axes.iter().zip(&device.state().axes);
        DeviceStatus {
            name: device.identity().name.clone(),
            key: device.key().to_owned(),
            axes: axes.map(|(axis, at)| AxisStatus { name: axis.name(), part: axis.part(at), raw: at.raw }).collect(),
            mapping: *device.mapping(),
            asks: self.learning.as_ref().map(Learning::ask),
            has_force: device.has_force(),
            halted: device.halted(),
            factor: self.factor,
            felt: self.felt,
            wanted: self.wanted,
            latency: device.latency(),
            ended: None,
        }
    }
}
