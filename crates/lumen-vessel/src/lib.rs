#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

mod balls;
pub mod beside;
mod calibre;
#[cfg(test)]
mod calibre_tests;
mod caps;
mod centreline;
mod centrelines;
pub mod certificate;
mod locating;
mod on_surface;
mod paths;
pub mod phantom;
mod recentring;
mod section;
mod space;
mod stations;
pub mod summary;
#[cfg(test)]
mod tests;
mod tree;
pub mod variation;
#[cfg(test)]
mod variation_tests;
pub mod width;
mod zones;

pub use zones::Zone;

use lumen_message::{grouped, messages};
use serde::{Deserialize, Serialize};

pub use calibre::{Asked, Calibre, Subject};
pub use centreline::Place;
pub use centreline::{arcs, centreline, direction};
pub use centrelines::{CentrelineFormat, Centrelines};
pub use locating::Located;
pub use locating::power;
pub use lumen_mesh::Ball;
pub use paths::NONE;
pub use stations::{Station, Stations};
pub use tree::{Branch, BranchName, End, Tree};

messages! {
    /// Why there is no tree.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum TreeError {
        /// There is nothing to go through.
        "vessels-error-no-triangles" NoTriangles => "the surface has no triangles",
        /// Every wall faces away.
        "vessels-error-inside-out" InsideOut => "the surface is inside out: its triangles face into the vessel",
        /// No wall faces another.
        "vessels-error-no-inside" NoInside {
            /// Triangles.
            triangles: usize,
        } => {
            match triangles {
                1 => "the surface has no inside: it is a single triangle".to_owned(),
                _ => format!("the surface has no inside: of its {} triangles none faces another", grouped(triangles)),
            }
        },
        /// What is inside is flat.
        "vessels-error-sheet" Sheet {
            /// Balls that overlap.
            balls: usize,
        } => {
            format!(
            "the inside of the surface is a thin sheet and no vessel: it takes more than {} balls to fill it; it may be the \
             wall of a vessel, with an inner and an outer side",
            grouped(balls)
        )
        },
    }
}

/// What the messages of this crate need of a translation.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[
    BranchName::MESSAGES,
    TreeError::MESSAGES,
    beside::NotMeasured::MESSAGES,
    certificate::CalibreError::MESSAGES,
    certificate::SpreadText::MESSAGES,
    certificate::Verdict::MESSAGES,
    phantom::PhantomError::MESSAGES,
    phantom::SampleName::MESSAGES,
    summary::CalibreFinding::MESSAGES,
    summary::CalibreSummary::MESSAGES,
    summary::CoverageText::MESSAGES,
    summary::PlaceText::MESSAGES,
    summary::Unmeasured::MESSAGES,
    summary::UnmeasuredParts::MESSAGES,
    variation::ReferenceText::MESSAGES,
    variation::UnevenText::MESSAGES,
    variation::VariationText::MESSAGES,
];
