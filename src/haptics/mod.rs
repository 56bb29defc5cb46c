//! Haptic devices: HID reports to axes and forces, and back. It knows no transport, no mesh and no clock but the one that
//! it is told.
//!
//! ```text
//! descriptor bytes --descriptor--> DeviceModel <--webhid-- collections
//! ```
//!
//! # Where things are
//!
//! - What a device's reports are: [`usage`], [`field`] (bits to numbers and back), [`model`] (reports, fields, collections),
//!   [`descriptor`] and [`webhid`], which make that of bytes and of what a browser tells.
//!
//! Times are in ms by any clock that does not go back. A report's bytes are without its id everywhere but in a transport
//! that wants it.

pub mod descriptor;
pub mod field;
pub mod model;
pub mod usage;
pub mod webhid;

#[cfg(test)]
mod fixtures;
