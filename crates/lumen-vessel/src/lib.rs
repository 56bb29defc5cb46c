//! The tree in a surface: branches between the places where vessels divide, their centrelines and calibres.
//!
//! ```text
//! surface --space--> distance to the wall, open ends
//!   --balls--> overlapping balls that fill the lumen, linked where a wire fits through
//!   --paths--> the cheapest ways, and the tree they make
//!   --centreline--> smooth centrelines with radii
//!   --tree--> branches and their ends
//!   --locating--> the branch of a point
//!   --caps--> centrelines that reach the caps of closed ends, for what is measured along them
//! ```
//!
//! What is found rests on the balls: two places are connected when overlapping balls lead from one to the other.
//! A lumen that is pinched shut is not passed, however thin the wall between.

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
mod zones;

use thiserror::Error;
pub use zones::Zone;

use lumen_language::say;

pub use calibre::{Calibre, Subject};
pub use centreline::Place;
pub use centreline::{arcs, centreline, direction};
pub use centrelines::{CentrelineFormat, Centrelines};
pub use locating::Located;
pub use locating::power;
pub use paths::NONE;
pub use space::Ball;
pub use stations::{Station, Stations};
pub use tree::{Branch, End, Tree};

/// Why there is no tree.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TreeError {
    /// There is nothing to go through.
    #[error("{}", say!("vessels-error-no-triangles"))]
    NoTriangles,
    /// Every wall faces away.
    #[error("{}", say!("vessels-error-inside-out"))]
    InsideOut,
    /// No wall faces another.
    #[error("{}", say!("vessels-error-no-inside", triangles = .triangles.to_string()))]
    NoInside {
        /// Triangles.
        triangles: usize,
    },
    /// What is inside is flat.
    #[error("{}", say!("vessels-error-sheet", balls = .balls.to_string()))]
    Sheet {
        /// Balls that overlap.
        balls: usize,
    },
}
