//! The guidewire trial as an engine of its own, on a line of its own, which keeps pace with the clock.
//!
//! - `message`: what it is asked and what it tells. `engine`: each command done, each slice worked.
//! - `shown`: the trial that is shown: its frames, and the hand on its wire. `grasp`: a haptic device's hand. `pace`: how
//!   many steps the clock asks for.
//! - `start`: a surface and a setup made into a trial. `jobs`: trials that run to their end as fast as they go, in slices:
//!   measurements,
//!   comparisons and sweeps.

mod engine;
mod haptic_channel;
mod jobs;
mod message;
mod pace;
mod shown;
mod start;
#[cfg(test)]
mod tests;

pub use self::engine::TrialEngine;
pub use self::haptic_channel::{HandFeels, HapticChannel, STALE};
pub use self::message::{HAND, RouteShown, TrialCommand, TrialEvent, TrialLink, TrialReady, is_frame};
pub use crate::trial::compare::TrialComparison;
