//! Devices that are known by their numbers: those whose descriptor does not say what they do.
//!
//! All else goes by usages. A profile says what a device is called, which descriptor is meant where its own is not, and
//! which vendor's reports move its motor.

use super::model::{DeviceModel, Kind};
use super::usage::pid;

/// How a device is asked for a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceReports {
    /// USB PID, by the usages in its descriptor.
    Pid,
    /// FFBeast's report 0xA3: force and nothing else.
    Ffbeast,
    /// Logitech's seven bytes.
    Logitech,
    /// A force along X, Y and Z, by Lumen's own usage ([`haply`](super::haply)).
    Cartesian,
}

/// A kind of device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Profile {
    /// What it is called.
    pub name: &'static str,
    /// Its vendor's number.
    pub vendor: u16,
    /// Its own; none for all of the vendor's.
    pub products: &'static [u16],
    /// What its reports are, where its own descriptor says something else.
    pub descriptor: Option<&'static [u8]>,
    /// A vendor's reports that move its motor.
    pub force: Option<ForceReports>,
}

/// Contour's five bytes: a ring that springs back from -7 to 7, a wheel that counts around from 0 to 255, a byte of nothing,
/// sixteen buttons. The device's own descriptor calls both relative (Linux makes `REL_WHEEL` and `REL_DIAL` of them), so
/// that whoever believes it adds up places.
const SHUTTLE: &[u8] = &[
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01, 0x09, 0x38, 0x15, 0xF9, 0x25, 0x07, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02, 0xC0,
    0x05, 0x01, 0x09, 0x0E, 0xA1, 0x01, 0x09, 0x37, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x81, 0x0A, 0x81, 0x03, 0x05, 0x09,
    0x19, 0x01, 0x29, 0x10, 0x25, 0x01, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02, 0xC0,
];

/// The known ones.
pub const PROFILES: &[Profile] = &[
    // The number that pid.codes has for prototypes.
    Profile { name: "Lumen feeder", vendor: 0x1209, products: &[0x0001], descriptor: None, force: None },
    Profile { name: "OpenFFBoard", vendor: 0x1209, products: &[0xFFB0], descriptor: None, force: None },
    Profile {
        name: "FFBeast",
        vendor: 0x045B,
        products: &[0x59D7, 0x58F9, 0x5968],
        descriptor: None,
        force: Some(ForceReports::Ffbeast),
    },
    Profile {
        name: "Logitech wheel",
        vendor: 0x046D,
        // Driving Force Pro, G25, Driving Force GT, G27, G29: those of Linux's hid-lg4ff in their own mode.
        products: &[0xC298, 0xC299, 0xC29A, 0xC29B, 0xC24F],
        descriptor: None,
        force: Some(ForceReports::Logitech),
    },
    Profile { name: "SpaceMouse", vendor: 0x256F, products: &[], descriptor: None, force: None },
    Profile {
        name: "SpaceNavigator",
        vendor: 0x046D,
        products: &[0xC603, 0xC605, 0xC606, 0xC621, 0xC623, 0xC625, 0xC626, 0xC627, 0xC628, 0xC629, 0xC62B],
        descriptor: None,
        force: None,
    },
    Profile {
        name: "Contour Shuttle",
        vendor: 0x0B33,
        products: &[0x0020, 0x0030],
        descriptor: Some(SHUTTLE),
        force: None,
    },
];

/// The profile of a device of these numbers.
pub fn profile(vendor: u16, product: u16) -> Option<&'static Profile> {
    let is = |of: &&Profile| of.vendor == vendor && (of.products.is_empty() || of.products.contains(&product));
    PROFILES.iter().find(is)
}

/// How a device of these numbers and reports is asked for a force, if it can be: by its vendor's reports where this
/// interface of it has them, else by PID.
pub fn force_reports(vendor: u16, product: u16, model: &DeviceModel) -> Option<ForceReports> {
    let bytes = |id| model.report(Kind::Output, id).map_or(0, super::model::Report::bytes);
    let vendors = profile(vendor, product).and_then(|profile| profile.force).filter(|force| match force {
        ForceReports::Ffbeast => bytes(super::force::ffbeast::REPORT) == super::force::ffbeast::BYTES,
        ForceReports::Logitech => bytes(0) == super::force::logitech::BYTES,
        ForceReports::Pid | ForceReports::Cartesian => true,
    });
    let has_effects = model.report_in(Kind::Output, pid::SET_EFFECT_REPORT).is_some();
    let has_forces = model
        .report_in(Kind::Output, super::haply::FORCES)
        .is_some_and(|report| (report.id, report.bytes()) == (super::haply::id::FORCE, super::haply::FORCE_BYTES));
    vendors.or(has_effects.then_some(ForceReports::Pid)).or(has_forces.then_some(ForceReports::Cartesian))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controls::{Controls, Motion};
    use crate::descriptor::parse;

    #[test]
    fn a_shuttle_s_five_bytes_are_its_ring_its_wheel_and_its_buttons() {
        let model = parse(profile(0x0B33, 0x0020).unwrap().descriptor.unwrap()).unwrap();
        assert_eq!(model.report(Kind::Input, 0).unwrap().bytes(), 5);
        let controls = Controls::new(&model);
        let mut state = controls.state();
        // Ring half left, wheel at its end and around, the first button: mask 0x10 of the fourth byte.
        controls.read(&model, &mut state, 0, &[0xFD, 0xFF, 0x00, 0x10, 0x00]);
        controls.read(&model, &mut state, 0, &[0xFD, 0x01, 0x00, 0x10, 0x00]);
        let dial = controls.axes.iter().position(|axis| axis.motion == Motion::Circle).unwrap();
        assert_eq!((state.axes[dial].gone, state.axes[1 - dial].raw), (2, Some(-3)));
        assert_eq!(state.buttons.iter().position(|&pressed| pressed), Some(4));
    }

    #[test]
    fn a_device_is_known_by_its_numbers() {
        assert_eq!(profile(0x256F, 0xC635).unwrap().name, "SpaceMouse");
        assert_eq!(profile(0x1209, 0xFFB0).unwrap().name, "OpenFFBoard");
        assert_eq!(profile(0x046D, 0xC52B), None, "a receiver for mice");
    }
}
