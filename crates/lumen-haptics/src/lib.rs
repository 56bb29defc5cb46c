#![doc = include_str!("../README.md")]
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
