//! The guidewire trial on the samples and in tubes.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod autopilot;
mod fuzz;
mod hold;
mod route;
mod steps;
mod wire;
