//! What a device's motors are to do, and what says to them.
//!
//! A driver is a state machine without a transport: it says which report goes next, hears how that went, and has one report
//! under way at a time. Forces are parts of the most that the device gives: what that is in N, its maker knows.

pub mod cartesian;
pub mod ffbeast;
pub mod logitech;
pub mod pid;
pub mod single;

use serde::{Deserialize, Serialize};

/// A spring and a damper that the device itself renders, at its own rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coupling {
    /// Where the spring pulls to: -1 to 1 from one end of the axis to the other.
    pub centre: f64,
    /// By which part of the most force it pulls at half of the axis's way from there, 0 to 1.
    pub stiffness: f64,
    /// How much the damper brakes, 0 to 1 of the most that the device has.
    pub damping: f64,
}

/// What one axis is to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisForce {
    /// The force as a part of the most, -1 to 1; positive pushes towards greater numbers. For devices without springs, and
    /// for axes that have no ends.
    pub force: f64,
    /// The same as a spring, where the axis has ends.
    pub coupling: Option<Coupling>,
    /// What neither exceeds, 0 to 1.
    pub limit: f64,
}

/// What both axes are to do: feed and roll.
pub type ForceCommand = [AxisForce; 2];

/// A report that is to be sent or got.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Request {
    /// To be sent as an output report.
    Send {
        /// Its id, 0 for none.
        id: u8,
        /// Its bytes, exactly as many as the device's descriptor has.
        data: Vec<u8>,
    },
    /// To be set as a feature report.
    SetFeature {
        /// Its id.
        id: u8,
        /// Its bytes.
        data: Vec<u8>,
    },
    /// To be got as a feature report.
    GetFeature {
        /// Its id.
        id: u8,
        /// Its length without the id.
        bytes: usize,
    },
}

/// How a request went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reply<'a> {
    /// It was sent.
    Done,
    /// What was got; whether its id stands before it depends on the system.
    Feature(&'a [u8]),
    /// It failed.
    Failed,
}

/// Why a device gives no force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ForceError {
    /// Its descriptor lacks what every force needs.
    #[error("the device has force reports, but none for a spring or a constant force that Lumen can use")]
    Incomplete,
    /// It has no room for the effect.
    #[error("the device has no room for another effect: another program may be using it")]
    Full,
    /// Reports no longer reach it.
    #[error("the device no longer takes reports")]
    Silent,
}

/// What moves a device's motors.
pub trait ForceDriver: Send {
    /// Says what the motors are to do from now on, until it is said again or [`ForceDriver::stop`] comes.
    fn command(&mut self, command: &ForceCommand);

    /// All force ends: the next report says so, whatever else was to come.
    fn stop(&mut self);

    /// The report that goes next at `now_ms`; `None` while one is under way, or if none is due.
    fn next(&mut self, now_ms: f64) -> Option<Request>;

    /// How the last request went.
    fn reply(&mut self, now_ms: f64, reply: Reply<'_>);

    /// The reports that leave the device without force, for when it is let go: all at once, whatever is under way.
    fn farewell(&self) -> Vec<Request>;

    /// Why it gives no force any more, if so.
    fn error(&self) -> Option<ForceError>;

    /// Whether the device renders springs itself.
    fn has_coupling(&self) -> bool;
}
