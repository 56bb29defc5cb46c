//! The guidewire trial: a wire is steered through a vessel surface, by hand or by autopilot, and what happens to it is
//! measured.
//!
//! ```text
//! surface --wall--> what the wire touches        surface --route--> where it should go
//! wire + wall + input --rod, contact--> step by step --trial--> frame, log, summary
//! ```
//!
//! Units are mm, N, s, t (tonne), MPa; forces in N, moments in N mm. The step is [`STEP`] of simulated time; input is
//! latched by step, so a log replays to the same end, to the bit on one platform.

pub mod audit;
pub mod autopilot;
pub mod body;
pub mod compare;
pub mod contact;
pub mod course;
mod descent;
pub mod felt;
pub mod frame;
pub mod log;
pub mod meter;
pub mod press;
pub mod report;
pub mod rod;
pub mod route;
pub mod session;
pub mod setup;
pub mod simulation;
pub mod wall;
pub mod wire;

/// Seconds of simulated time in a step.
pub const STEP: f64 = 0.002;
