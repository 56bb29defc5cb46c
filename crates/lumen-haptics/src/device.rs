//! A device in use: what its reports say of the hand, and what the hand is to feel, with all that stands between.
//!
//! Whoever has the transport tells it input reports and the time, asks it for requests, and tells it how they went; whoever
//! has the trial asks it how far to feed and roll, and tells it what resists. It does neither by itself.

use std::collections::VecDeque;

use super::controls::{Controls, State};
use super::descriptor::{ModelError, parse};
use super::force::cartesian::Cartesian;
use super::force::ffbeast::Ffbeast;
use super::force::logitech::Logitech;
use super::force::pid::PidDriver;
use super::force::{AxisForce, Coupling, ForceCommand, ForceDriver, ForceError, Reply, Request};
use super::haply;
use super::identity::Identity;
use super::known;
use super::latency::{Latency, Percentiles};
use super::mapping::{Mapper, Mapping, TRAVEL};
use super::model::DeviceModel;
use super::passivity::Softness;
use super::port::Port;
use super::profile::{ForceReports, force_reports, profile};
use super::safety::{Guard, Halt, Limits};

/// What resists feed, 0, and roll, 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resistance {
    /// Parts of the device's most force, -1 to 1; positive against positive feed and roll.
    pub part: [f64; 2],
    /// By how much these grow with each mm, and each radian, that the hand goes on; not below 0.
    pub slope: [f64; 2],
}

/// The force, as a part of the most, below which a spring is more than half let go.
const FAINT: f64 = 0.02;
/// How much the device's own damper brakes where it has one, 0 to 1.
const DAMPING: f64 = 0.05;

/// Whose request is under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum UnderWay {
    /// The driver's.
    Driver,
    /// That of one which no longer drives.
    Parted,
}

/// A device in use.
pub struct HapticDevice {
    identity: Identity,
    /// By what its mapping is remembered.
    key: String,
    model: DeviceModel,
    /// The reports of the interface that takes forces, where that is another.
    force_model: Option<DeviceModel>,
    controls: Controls,
    state: State,
    mapper: Mapper,
    guard: Guard,
    driver: Option<Box<dyn ForceDriver>>,
    /// What a driver before has left to say, so that its force ends.
    farewells: VecDeque<Request>,
    under_way: Option<UnderWay>,
    softness: [Softness; 2],
    latency: Latency,
    /// When the input report came that no output report has answered yet, in ms.
    heard_ms: Option<f64>,
    /// Whether its motors have been asked to be still since force was last let through.
    is_still: bool,
}

impl HapticDevice {
    /// A device whose reports a descriptor describes.
    ///
    /// # Errors
    /// When the descriptor makes no sense. That a device has no axes, or no force, is no error.
    pub fn from_descriptor(identity: Identity, descriptor: &[u8]) -> Result<Self, ModelError> {
        let own = parse(descriptor)?;
        Ok(Self::new(identity, own).known_by(descriptor))
    }

    /// A device of this model. Where it is known to be meant otherwise, that holds.
    pub fn new(identity: Identity, model: DeviceModel) -> Self {
        let known = profile(identity.vendor, identity.product).and_then(|profile| profile.descriptor);
        let model = known.and_then(|descriptor| parse(descriptor).ok()).unwrap_or(model);
        let controls = Controls::new(&model);
        let state = controls.state();
        let mut device = Self {
            key: known::key(&identity, &[]),
            identity,
            mapper: Mapper::default(),
            guard: Guard::new(Limits::default()),
            driver: None,
            farewells: VecDeque::new(),
            under_way: None,
            softness: [Softness::default(); 2],
            latency: Latency::default(),
            heard_ms: None,
            is_still: true,
            model,
            force_model: None,
            controls,
            state,
        };
        device.propose_mapping();
        device
    }

    /// The device behind a port, by one interface or two ([`joining`](super::joining)).
    ///
    /// # Errors
    /// As for [`HapticDevice::from_descriptor`].
    pub fn from_port(identity: Identity, port: &dyn Port) -> Result<Self, ModelError> {
        let device = Self::from_descriptor(identity, port.descriptor())?;
        Ok(match port.force_descriptor() {
            Some(descriptor) => device.with_force_by(parse(descriptor)?),
            None => device,
        })
    }

    /// The same, its forces by another interface of these reports: requests go there.
    #[must_use]
    pub fn with_force_by(mut self, model: DeviceModel) -> Self {
        self.force_model = Some(model);
        self.propose_mapping();
        self
    }

    /// The same, told from others of its numbers by its report descriptor, or by what else says its reports.
    #[must_use]
    pub fn known_by(self, descriptor: &[u8]) -> Self {
        Self { key: known::key(&self.identity, descriptor), ..self }
    }

    /// By what its mapping is remembered ([`known`]).
    pub fn key(&self) -> &str {
        &self.key
    }

    /// Its numbers and its name.
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// What its reports are, those of the interface by which it is held.
    pub fn model(&self) -> &DeviceModel {
        &self.model
    }

    /// What a hand can move on it.
    pub fn controls(&self) -> &Controls {
        &self.controls
    }

    /// Where all that is.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Which axes feed and roll.
    pub fn mapping(&self) -> &Mapping {
        self.mapper.mapping()
    }

    /// Feeds and rolls as most devices of its axes do; the force has to be armed again.
    pub fn propose_mapping(&mut self) {
        self.set_mapping(Mapping::proposed(&self.controls, self.travel()));
    }

    /// Feeds and rolls by other axes, from where they are; the force has to be armed again.
    pub fn set_mapping(&mut self, mapping: Mapping) {
        self.guard.halt(Halt::NotArmed);
        let usages = [mapping.feed, mapping.roll].map(|of| Some(self.controls.axes.get(of?.axis)?.usage));
        let alone = usize::from(mapping.feed.is_none());
        self.part();
        self.driver = match self.force_reports() {
            Some(ForceReports::Pid) => match PidDriver::new(self.takes_forces(), usages) {
                Ok(driver) => Some(Box::new(driver)),
                Err(_) => None,
            },
            Some(ForceReports::Ffbeast) => Some(Box::new(Ffbeast::new(alone))),
            Some(ForceReports::Logitech) => Some(Box::new(Logitech::new(alone))),
            Some(ForceReports::Cartesian) => {
                Cartesian::new(usages).map(|driver| Box::new(driver) as Box<dyn ForceDriver>)
            }
            None => None,
        };
        self.mapper = Mapper::new(mapping);
        self.softness.iter_mut().for_each(Softness::release);
        self.is_still = true;
    }

    /// What one way of an axis feeds, in mm, and rolls, in radians, unless the user says otherwise.
    pub fn travel(&self) -> [f64; 2] {
        match self.force_reports() {
            // The hand's way is the wire's.
            Some(ForceReports::Cartesian) => haply::HALF_WAY.map(|half| 2.0 * half),
            _ => TRAVEL,
        }
    }

    fn force_reports(&self) -> Option<ForceReports> {
        force_reports(self.identity.vendor, self.identity.product, self.takes_forces())
    }

    /// The reports of the interface that takes forces.
    fn takes_forces(&self) -> &DeviceModel {
        self.force_model.as_ref().unwrap_or(&self.model)
    }

    /// Drives it by another driver than the one that fits it; the force has to be armed again.
    pub fn set_driver(&mut self, driver: Box<dyn ForceDriver>) {
        self.halt(Halt::NotArmed);
        self.part();
        self.driver = Some(driver);
    }

    /// The present driver ends its force, and drives no more.
    fn part(&mut self) {
        self.farewells.extend(self.driver.take().iter().flat_map(|driver| driver.farewell()));
        self.under_way = self.under_way.map(|_| UnderWay::Parted);
    }

    /// How strong and how fast forces may be.
    pub fn set_limits(&mut self, limits: Limits) {
        self.guard.set_limits(limits);
    }

    /// Whether its motors, or its brake, can be driven by the present mapping.
    pub fn has_force(&self) -> bool {
        self.driver.is_some()
    }

    /// Why it gives no force any more, if so.
    pub fn force_error(&self) -> Option<ForceError> {
        self.driver.as_ref().and_then(|driver| driver.error())
    }

    /// The user has armed it.
    pub fn arm(&mut self) {
        self.guard.arm();
    }

    /// Force ends, until it is armed again; the next request says so.
    pub fn halt(&mut self, why: Halt) {
        self.guard.halt(why);
        self.be_still();
    }

    /// Force ends while the trial is paused.
    pub fn pause(&mut self, on: bool) {
        self.guard.pause(on);
        if on {
            self.be_still();
        }
    }

    /// Why it is not armed; `None` where it is.
    pub fn halted(&self) -> Option<Halt> {
        self.guard.halted()
    }

    fn be_still(&mut self) {
        self.is_still = true;
        self.softness.iter_mut().for_each(Softness::release);
        if let Some(driver) = &mut self.driver {
            driver.stop();
        }
    }

    /// Takes in an input report, without its id, that came at `now_ms`.
    pub fn input(&mut self, now_ms: f64, id: u8, data: &[u8]) {
        if self.controls.read(&self.model, &mut self.state, id, data) {
            self.heard_ms = Some(now_ms);
        }
    }

    /// How far to feed, in mm, and to roll, in radians, for what the hand did in the last `dt_s` seconds.
    pub fn advance(&mut self, dt_s: f64) -> [f64; 2] {
        self.mapper.advance(&self.controls, &self.state, dt_s)
    }

    /// Says what resists at `now_ms`. Without that for [`STALE_MS`](super::safety::STALE_MS) there is no force.
    pub fn resist(&mut self, now_ms: f64, resistance: &Resistance) {
        self.guard.renew(now_ms);
        let command = self.command(now_ms, resistance);
        match (self.guard.pass(&command, now_ms), &mut self.driver) {
            (Some(command), Some(driver)) => {
                driver.command(&command);
                self.is_still = false;
            }
            (None, Some(_)) if !self.is_still => self.be_still(),
            _ => {}
        }
    }

    fn command(&mut self, now_ms: f64, resistance: &Resistance) -> ForceCommand {
        let mappings = [self.mapping().feed, self.mapping().roll];
        let has_coupling = self.driver.as_ref().is_some_and(|driver| driver.has_coupling());
        std::array::from_fn(|which| {
            let Some(mapping) = mappings[which] else { return AxisForce::default() };
            let place = self.mapper.place(&self.controls, &self.state, which);
            let resists = resistance.part[which];
            // Along half of the axis's way.
            let slope = resistance.slope[which] * mapping.half_way();
            let own = if has_coupling && place.is_some() { slope.min(1.0) } else { 0.0 };
            let soft = self.softness[which].part(now_ms, slope, own, resists);
            let force = soft * if mapping.is_inverted { resists } else { -resists };
            // A spring that pulls with that force where the axis is now, and goes on at the device's own rate. What nothing
            // resists has no spring: its centre comes late, and would drag.
            let stiffness = own * force.abs() / (force.abs() + FAINT);
            let coupling = place.map(|place| {
                let centre = if stiffness > 0.0 { place + force / stiffness } else { place };
                Coupling { centre, stiffness, damping: DAMPING }
            });
            AxisForce { force, coupling, limit: 1.0 }
        })
    }

    /// The request that goes next at `now_ms`; `None` while one is under way, or if none is due.
    pub fn next(&mut self, now_ms: f64) -> Option<Request> {
        // A trial that has fallen silent says nothing that could end its force.
        if !self.is_still && self.guard.is_stale(now_ms) {
            self.be_still();
        }
        let request = match self.under_way {
            Some(UnderWay::Parted) => return None,
            None if !self.farewells.is_empty() => {
                self.under_way = Some(UnderWay::Parted);
                return self.farewells.pop_front();
            }
            // The driver hears for how long its request is under way.
            Some(UnderWay::Driver) | None => self.driver.as_mut()?.next(now_ms)?,
        };
        self.under_way = Some(UnderWay::Driver);
        if matches!(request, Request::Send { .. })
            && let Some(heard) = self.heard_ms.take()
        {
            self.latency.count(now_ms - heard);
        }
        Some(request)
    }

    /// How the last request went.
    pub fn reply(&mut self, now_ms: f64, reply: Reply<'_>) {
        if self.under_way.take() == Some(UnderWay::Driver)
            && let Some(driver) = &mut self.driver
        {
            driver.reply(now_ms, reply);
            if driver.error().is_some() && self.guard.halted().is_none() {
                self.guard.halt(Halt::Refused);
            }
        }
    }

    /// The reports that leave it without force, for when it is let go.
    pub fn farewell(&self) -> Vec<Request> {
        let present = self.driver.iter().flat_map(|driver| driver.farewell());
        self.farewells.iter().cloned().chain(present).collect()
    }

    /// From input report to output report, so far.
    pub fn latency(&self) -> Percentiles {
        self.latency.percentiles()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fixtures::{descriptor, hostile};
    use crate::model::Kind;

    /// What a device that says anything at all is asked and answers.
    fn use_it(device: &mut HapticDevice, reports: &[(u8, Vec<u8>)], value: f64) {
        device.arm();
        for (i, (id, data)) in reports.iter().enumerate() {
            let now = 4.0 * i as f64;
            device.input(now, *id, data);
            let moved = device.advance(0.004);
            assert!(moved.iter().all(|way| way.is_finite()));
            device.resist(now, &Resistance { part: [value; 2], slope: [value.abs(); 2] });
            while let Some(request) = device.next(now) {
                match &request {
                    Request::Send { id, data } => {
                        let report = device.model().report(Kind::Output, *id);
                        assert_eq!(report.map(crate::model::Report::bytes), Some(data.len()));
                        device.reply(now, Reply::Done);
                    }
                    Request::SetFeature { .. } => device.reply(now, Reply::Done),
                    Request::GetFeature { .. } => device.reply(now, Reply::Feature(data)),
                }
            }
        }
    }

    #[test]
    fn a_wheel_of_a_vendor_is_driven_by_its_own_reports() {
        let identity = |vendor, product| Identity { vendor, product, name: String::new() };
        let board = HapticDevice::from_descriptor(identity(0x1209, 0xFFB0), &descriptor("openffboard-1")).unwrap();
        assert!(board.has_force());
        let knob = HapticDevice::from_descriptor(identity(0x046D, 0xC626), &descriptor("spacenavigator")).unwrap();
        assert!(!knob.has_force() && knob.mapping().feed.is_some() && knob.mapping().roll.is_some());
        // A G29 in its PlayStation mode has no seven bytes without an id.
        let wheel = HapticDevice::from_descriptor(identity(0x046D, 0xC260), &descriptor("logitech-g29")).unwrap();
        assert!(!wheel.has_force());
        let native = [
            5, 1, 9, 4, 0xA1, 1, 9, 0x30, 0x15, 0, 0x26, 0xFF, 0, 0x75, 8, 0x95, 1, 0x81, 2, 6, 0, 0xFF, 9, 1, 0x95, 7,
            0x91, 2, 0xC0,
        ];
        assert!(HapticDevice::from_descriptor(identity(0x046D, 0xC24F), &native).unwrap().has_force());
        assert!(!HapticDevice::from_descriptor(identity(0x1234, 0xC24F), &native).unwrap().has_force());
    }

    proptest! {
        #[test]
        fn no_device_makes_it_panic(
            bytes in hostile(),
            reports in proptest::collection::vec((0_u8..20, proptest::collection::vec(any::<u8>(), 0..30)), 0..12),
            value in prop_oneof![-2.0..2.0, Just(f64::NAN), Just(f64::INFINITY)],
        ) {
            if let Ok(mut device) = HapticDevice::from_descriptor(Identity::default(), &bytes) {
                use_it(&mut device, &reports, value);
            }
        }
    }
}
