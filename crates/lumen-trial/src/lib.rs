#![doc = include_str!("../README.md")]
//!
//! # Words
//!
//! Of contact:
//!
//! - *Gap*: distance of the rod's surface from the flat triangles of the wall; less than 0 inside of it.
//! - *Penalty*: by what a contact's force grows with less of a gap, in N/mm, within a step.
//! - *Multiplier*: the normal force that a contact begins a step with, and the one a step has come to; with it the gap at
//!   rest is 0 whatever the penalty.
//! - *Slip*: how far the rod's surface has gone across the normal; its elastic part is what friction springs back by.
//! - *Pair*: two places of the rod that touch each other, or nearly do.
//! - *Coulomb limit*: what friction can give, `mu N`: by the static coefficient where a contact sticks, by the kinetic one
//!   where it slides.
//! - *Return mapping*: the slip as if the contact stuck, brought back to the Coulomb limit.
//!
//! Of the solver:
//!
//! - *Potential*: what a step makes least: energy of the rod and its contacts, loads, and what stands for inertia and drag.
//! - *Correction*: one step of Newton's method, with all contacts in it.
//! - *Search direction*: one solution of the equations within a correction, for the contacts as they stand.
//! - *Line search*: how much of a direction is gone: until the slope along it is level, or the potential has fallen.
//! - *Artificial damping*: drag that the solver adds where something snaps; such a step is
//!   [`StepKind::Braked`](report::StepKind::Braked) in logs.
//! - *Residual*: what is left over of all forces once a step is done, in N.
//!
//! Of the rod and its guide:
//!
//! - *Fixed*: a node or a frame that stays where it is put. Its *reaction* is what keeps it there.
//! - *Guide*: the rigid sheath or catheter that the wire comes out of; its end is the *mouth*, and what is in it is fixed.
//! - *Push* and *torque*: what the hand does to the wire along the way in and about it: the reaction of the guide, less what
//!   its mouth pushes a bent wire out with by itself. Their sign is said at
//!   [`StepReport::push_n`](report::StepReport::push_n).
//! - *Held*: a step that found no way on and left the rod where it was, [`StepKind::Held`](report::StepKind::Held); nothing
//!   else is.

#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

pub mod audit;
pub mod autopilot;
pub mod body;
pub mod compare;
pub mod contact;
pub mod course;
mod descent;
pub mod frame;
pub mod log;
pub mod meter;
pub mod missed;
pub mod peak_force_map;
pub mod placement;
mod press;
mod proposal;
pub mod reach;
pub mod report;
pub mod rod;
pub mod route;
pub mod session;
pub mod setup;
pub mod simulation;
pub mod stopwatch;
pub mod summary;
pub mod sweep;
pub mod virtual_coupling;
pub mod wall;
pub mod wire;

/// Seconds of simulated time in a step.
pub const STEP: f64 = 0.002;

/// What the messages of this crate need of a translation.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[
    autopilot::AutopilotTask::MESSAGES,
    compare::ComparisonVerdict::MESSAGES,
    compare::PathVerdict::MESSAGES,
    course::TrialError::MESSAGES,
    log::LineProblem::MESSAGES,
    log::LogError::MESSAGES,
    missed::MissedForkText::MESSAGES,
    missed::Taken::MESSAGES,
    placement::PlacementError::MESSAGES,
    reach::ReachFinding::MESSAGES,
    route::AtText::MESSAGES,
    route::PlaceLabel::MESSAGES,
    route::RouteError::MESSAGES,
    route::TargetLabel::MESSAGES,
    summary::TrialEnd::MESSAGES,
    wire::WireError::MESSAGES,
    wire::WireNumber::MESSAGES,
];
