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
mod problem;
mod write;

use super::error::ReadError;
use super::formats::{Arrays, FileKind, MediaType, Sign, Written};
use super::problem::Problem;
use super::text;
use super::unit::Unit;

pub use problem::PlyProblem;

/// PLY in the table of formats.
pub(super) static KIND: FileKind = FileKind {
    label: "PLY",
    extensions: &["ply"],
    media_types: &[MediaType { name: "model/x-ply", comment: "PLY surface", extension: "ply", magic: Some("ply\\n") }],
    unit: Unit::Millimetre,
    axes_in_head: true,
    signs: &[(Sign::Begins, |bytes| text::begins_with(bytes, b"ply\n") || text::begins_with(bytes, b"ply\r"))],
    parse: |bytes, _, origin, pace| Box::pin(parsing::read(bytes, origin, pace)),
    triangles: |bytes| announced_faces(bytes).unwrap_or(bytes.len() as u64 / 20),
};

/// PLY as it is written.
pub(super) static WRITTEN: Written = Written { write: |output| Ok(write::write(output)), arrays: Arrays::All };

/// The faces that the header of a PLY announces; no more than there are bytes for.
fn announced_faces(bytes: &[u8]) -> Option<u64> {
    let head = &bytes[..bytes.len().min(4096)];
    let line = head.split(|&byte| byte == b'\n').find_map(|line| line.strip_prefix(b"element face "))?;
    let faces: u64 = std::str::from_utf8(line).ok()?.trim().parse().ok()?;
    Some(faces.min(bytes.len() as u64 / 4))
}

fn malformed(problem: impl Into<Problem>) -> ReadError {
    ReadError::malformed("PLY", problem)
}

#[cfg(test)]
mod tests;
