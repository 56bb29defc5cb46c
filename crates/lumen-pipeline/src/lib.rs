#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

pub mod beside;
pub mod bound;
pub mod caps;
pub mod carry;
pub mod classes;
pub mod coarser;
pub mod connectivity;
pub mod decimation;
pub mod deviation;
pub mod error_curve;
pub mod filter;
pub mod histogram;
pub mod laplacian;
mod lines;
pub mod normals;
pub mod one_collapse;
pub mod paper;
pub mod pinch;
pub mod progressive;
pub mod report;
pub mod response;
pub mod results;
pub mod run;
pub mod safe;
pub mod settings;
pub mod shape;
pub mod smoothing;
pub mod stage;
mod stages;
mod store;
mod times;
pub mod verdict;
pub mod warnings;

pub use lumen_mesh::task;

/// What translations need of the messages of this crate.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[
    beside::BesideError::MESSAGES,
    classes::Class::MESSAGES,
    pinch::PinchMessage::MESSAGES,
    progressive::ShortfallMessage::MESSAGES,
    response::HalfGain::MESSAGES,
    safe::NoSafeRate::MESSAGES,
    safe::PastSafe::MESSAGES,
    safe::Stop::MESSAGES,
    settings::OutOfRange::MESSAGES,
    settings::Preset::MESSAGES,
    settings::SettingsError::MESSAGES,
    stage::Stage::MESSAGES,
    verdict::FindingKind::MESSAGES,
    verdict::Head::MESSAGES,
    verdict::HeadText::MESSAGES,
    verdict::PlaceLabel::MESSAGES,
    verdict::RemedyLabel::MESSAGES,
    warnings::DrawnShut::MESSAGES,
    warnings::NarrowedAt::MESSAGES,
    warnings::Pinches::MESSAGES,
    warnings::VolumeCause::MESSAGES,
    warnings::VolumeChange::MESSAGES,
    warnings::VolumeNotHeld::MESSAGES,
    warnings::VolumeWarning::MESSAGES,
];
