//! The tree in a surface: branches between the places where vessels divide, their centrelines and calibres.
//!
//! ```text
//! surface --space--> distance to the wall, open ends
//!   --balls--> overlapping balls that fill the lumen, linked where a wire fits through
//!   --paths--> the cheapest ways, and the tree they make
//!   --centreline--> smooth centrelines with radii
//!   --tree--> branches, ends, the branch of a point
//! ```
//!
//! What is found rests on the balls: two places are connected when overlapping balls lead from one to the other.
//! A lumen that is pinched shut is not passed, however thin the wall between.

mod balls;
mod calibre;
#[cfg(test)]
mod calibre_tests;
mod centreline;
mod centrelines;
pub mod certificate;
mod paths;
mod recentring;
mod section;
mod space;
mod stations;
#[cfg(test)]
mod tests;
mod tree;
mod zones;

use thiserror::Error;
pub use zones::Zone;

pub use calibre::{Calibre, Subject};
pub use centreline::Place;
pub(crate) use centreline::{arcs, centreline, direction};
pub use centrelines::{CentrelineFormat, Centrelines};
pub(crate) use paths::NONE;
pub(crate) use space::Ball;
pub use stations::{Station, Stations};
pub use tree::{Branch, End, Located, Tree, TreeTask};

/// Why there is no tree.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TreeError {
    /// There is nothing to go through.
    #[error("the surface has no triangles")]
    NoTriangles,
    /// Every wall faces away.
    #[error("the surface is inside out: its triangles face into the vessel")]
    InsideOut,
    /// No wall faces another.
    #[error("the surface has no inside: of its {triangles} triangles none faces another")]
    NoInside {
        /// Triangles.
        triangles: usize,
    },
    /// What is inside is flat.
    #[error(
        "the inside of the surface is a thin sheet and no vessel: it takes more than {balls} balls to fill it. \
         Is it the wall of a vessel, with an inner and an outer side?"
    )]
    Sheet {
        /// Balls that overlap.
        balls: usize,
    },
}
