//! Haptic devices: HID reports to axes and forces, and back. It knows no transport, no mesh and no clock but the one that
//! it is told.
//!
//! ```text
//! descriptor bytes --descriptor--> DeviceModel <--webhid-- collections
//! input report --controls--> axes --mapping--> feed and roll
//! what is felt --safety--> what may be felt --force--> output reports
//! ```
//!
//! # Where things are
//!
//! - What a device's reports are: [`usage`], [`field`] (bits to numbers and back), [`model`] (reports, fields, collections),
//!   [`descriptor`] and [`webhid`], which make that of bytes and of what a browser tells.
//! - What a hand does: [`controls`] (axes, hats, buttons, by their usages), [`mapping`] (which of them feeds and which
//!   rolls), [`learning`] (finds that out), [`known`] (what was chosen for which device), [`profile`] (devices that are known
//!   by their numbers).
//! - What a hand feels: [`force`] (drivers that say which report goes next), [`safety`] (what stands before them),
//!   [`passivity`] (for forces that come late).
//! - A device in use: [`device`] has all of these, [`service`] is what it is asked and how it is; [`port`] is what a transport
//!   gives, [`joining`] makes one of several interfaces, [`latency`] is what is measured, [`identity`] what a device is known
//!   by. By a serial line: [`framing`] is how reports go over it, [`serial`] the host's end. By a maker's service: [`haply`].
//! - The open device: [`feeder`] is its descriptor, [`virtual_feeder`] its firmware and a hand, without hardware.
//!
//! Times are in ms by any clock that does not go back. A report's bytes are without its id everywhere but in a transport
//! that wants it.

#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

pub mod controls;
pub mod descriptor;
pub mod device;
pub mod field;
pub mod force;
pub mod haply;
pub mod identity;
pub mod joining;
pub mod known;
pub mod latency;
pub mod learning;
pub mod mapping;
pub mod model;
pub mod passivity;
pub mod port;
pub mod profile;
pub mod safety;
pub mod serial;
pub mod service;
pub mod usage;
pub mod virtual_feeder;
pub mod webhid;

pub use lumen_feeder_protocol::{feeder, framing};

#[cfg(test)]
mod feeder_tests;
#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod framing_tests;

/// What the messages of this crate need of a translation.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[descriptor::ModelError::MESSAGES, port::PortError::MESSAGES];
