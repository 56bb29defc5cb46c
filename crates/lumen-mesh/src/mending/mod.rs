//! What is wrong with a surface, and how it is mended: each fault a file, each remedy a file.
//!
//! [`faults`] finds and lists; the others change a surface, only where they are asked to, and say what they did: [`weld`]
//! joins open edges that nearly meet, [`wall`] takes the lumen out of a wall with two sides, [`split`] parts the sheets
//! that meet in an edge or a vertex, [`fill`] closes holes. Each hands back what its vertices and triangles were made of,
//! as a [`Blend`](super::Blend), so that arrays can follow. [`mend`] does what is asked for in this order.
//!
//! Lengths are in mm. Results depend neither on slices nor on the number of threads.

mod fair;
pub mod faults;
pub mod fill;
pub mod holes;
mod patch_mesh;
mod refine;
mod sides;
pub mod split;
mod task;
mod triangulate;
pub mod wall;
pub mod weld;

pub use faults::{FaultCounts, FaultKind, FaultPlace, Faults};
pub use holes::{Hole, Opening};
pub use task::{MendReport, MendWarning, Mended, Mending, mend};
