//! What the open feeder's firmware does, without a board: it runs and is tested on any machine (`docs/haptic-device.md`).
//!
//! ```text
//! samples of two lines --quadrature--> counts --axis--> place and speed
//! output reports --effects--> parts of the greatest force --motor--> inputs of the bridge
//! ```
//!
//! [`device`] joins these, a ms at a time. Reports come by USB's human interface or by [`serial`]; [`turn`] says which of both
//! is heard. The report descriptor, the ids and the frames on the serial line ([`feeder`], [`framing`]) are the crate that Lumen
//! uses too. Lumen's virtual feeder is the same device written a second time; a test of Lumen's gives both the same reports.

#![no_std]

pub mod axis;
pub mod device;
pub mod effects;
pub mod motor;
pub mod quadrature;
pub mod serial;
pub mod turn;

pub use lumen_feeder_protocol::{feeder, framing};
