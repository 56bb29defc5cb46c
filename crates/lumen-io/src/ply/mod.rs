//! PLY, the Stanford polygon file (Turk 1994): text, and binary of either byte order.
//!
//! A header describes elements with typed properties; of these the `x y z` of `vertex`, the `vertex_indices` of
//! `face` and those of `tristrips` make the surface. Other numbers of `vertex` and `face` are arrays (`arrays`), and
//! everything else is stepped over. The crate `ply-rs-bw` is not used:
//! it wants a structure a row filled property by property, names included, which is slow at a million faces.

mod arrays;
mod body;
mod header;
mod parsing;
mod write;

use super::error::ReadError;

pub(super) use parsing::read;
pub(super) use write::write;

fn malformed(problem: String) -> ReadError {
    ReadError::Malformed { format: "PLY", problem }
}

#[cfg(test)]
mod tests;
