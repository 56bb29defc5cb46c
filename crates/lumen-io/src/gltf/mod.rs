//! glTF 2.0 (Khronos 2021), as one binary file (GLB) or as text with its data inside.
//!
//! The crate `gltf` gives the structure of the JSON (`gltf::json`); buffers and accessors are in `buffers`. Its readers of
//! the GLB container and of accessors are not used: they subtract and multiply what a file claims without looking, and panic on some claims.
//!
//! A node's numbers are decimal in the file and f32 in that structure; they are taken back to the decimal they stood
//! for before being multiplied in f64. So 0.001 times 1000 is exactly 1, and a surface that Lumen wrote, in mm under
//! a node scale of 0.001, reads back to the same bits.
//!
//! Draco compression is refused by name: there is no decoder in Rust alone (`draco_decoder` binds the C++ one,
//! `draco-oxide` has only the encoder yet). Meshopt compression is read (`unpack`). A skinned mesh stands as its skeleton
//! does in the file (`skin`); animations are passed over. Morph targets and the
//! copies of `EXT_mesh_gpu_instancing` are left out with a warning.
//!
//! By the specification (3.4) y is up, and the front of what is shown looks along z. Lumen has z up, as patients' axes do,
//! and the front towards -y: what is read is turned by a right angle about x, what is written is turned back.

mod arrays;
mod beyond;
mod buffers;
mod container;
mod primitive;
mod problem;
mod scene;
mod skin;
mod unpack;
mod write;

use super::error::{Feature, ReadError};
use super::formats::{Arrays, FileKind, MediaType, Sign, Written};
use super::problem::Problem;
use super::text;
use super::unit::Unit;

pub use problem::GltfProblem;
pub(super) use write::write_levels;

/// GLB in the table of formats.
pub(super) static BINARY: FileKind = FileKind {
    label: "GLB",
    extensions: &["glb"],
    media_types: &[MediaType {
        name: "model/gltf-binary",
        comment: "Binary glTF model",
        extension: "glb",
        magic: None,
    }],
    unit: Unit::Metre,
    axes_in_head: false,
    signs: &[(Sign::Sure, |bytes| bytes.starts_with(b"glTF"))],
    parse: |bytes, unit, origin, pace| Box::pin(container::read_binary(bytes, unit, origin, pace)),
    triangles,
};

/// GLB as it is written.
pub(super) static WRITTEN: Written = Written { write: write::write, arrays: Arrays::Vertices(arrays::has_place) };

/// glTF as text in the table of formats: it is read only.
pub(super) static TEXT: FileKind = FileKind {
    label: "glTF",
    extensions: &["gltf"],
    media_types: &[MediaType { name: "model/gltf+json", comment: "glTF model", extension: "gltf", magic: None }],
    unit: Unit::Metre,
    axes_in_head: false,
    signs: &[(Sign::Begins, |bytes| {
        let text = text::beginning(bytes);
        text.starts_with(b"{") && text[..text.len().min(1024)].contains(&b'"')
    })],
    parse: |bytes, unit, origin, pace| Box::pin(container::read_text(bytes, unit, origin, pace)),
    triangles,
};

/// Half a vertex of three f32 and three numbers of 32 bits take 18 bytes.
fn triangles(bytes: &[u8]) -> u64 {
    bytes.len() as u64 / 18
}

const FORMAT: &str = "glTF";
const DRACO: &str = "KHR_draco_mesh_compression";

fn malformed(problem: impl Into<Problem>) -> ReadError {
    ReadError::malformed(FORMAT, problem)
}

fn unsupported(feature: Feature) -> ReadError {
    ReadError::Unsupported { format: FORMAT, feature }
}

fn draco() -> ReadError {
    unsupported(Feature::Extension { name: DRACO.to_owned() })
}

#[cfg(test)]
mod tests;
