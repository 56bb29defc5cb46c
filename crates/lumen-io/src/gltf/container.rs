//! What a glTF file is packed in: GLB, whose chunks are the JSON and the data, or the JSON alone.

use glam::DVec3;

use super::super::Unit;
use super::super::error::{Counted, Feature, ReadError};
use super::super::pace::Pace;
use super::super::problem::GltfProblem;
use super::super::raw::RawSurface;
use super::malformed;
use super::scene::read_scene;

pub(super) const JSON_CHUNK: u32 = 0x4e4f_534a;
pub(super) const BIN_CHUNK: u32 = 0x004e_4942;

/// Reads a GLB file; its positions come in mm, relative to `origin`.
pub(super) async fn read_binary(bytes: &[u8], unit: Unit, origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    let word = |at: usize| bytes.get(at..).and_then(|rest| rest.first_chunk()).map(|b| u32::from_le_bytes(*b));
    let cut_short = |announced: usize| ReadError::CutShort {
        format: "GLB",
        what: Counted::Bytes,
        announced: announced as u64,
        found: bytes.len() as u64,
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(cut_short(12));
    };
    if version != 2 {
        return Err(ReadError::Unsupported { format: "GLB", feature: Feature::Version { version } });
    }
    if length as usize > bytes.len() {
        return Err(cut_short(length as usize));
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while let (Some(length), Some(kind)) = (word(at), word(at + 4)) {
        let chunk = &bytes[at + 8..];
        let chunk = chunk.get(..length as usize).ok_or_else(|| cut_short((at + 8).saturating_add(length as usize)))?;
        match kind {
            JSON_CHUNK => json = json.or(Some(chunk)),
            BIN_CHUNK => binary = binary.or(Some(chunk)),
            _ => {}
        }
        at += 8 + chunk.len();
    }
    let json = json.ok_or_else(|| malformed(GltfProblem::NoJson))?;
    pace.rest(json.len() as f64).await;
    read_scene("GLB", json, binary, unit, bytes.len(), origin, pace).await
}

/// Reads a glTF text that carries its own data; its positions come in mm, relative to `origin`.
pub(super) async fn read_text(bytes: &[u8], unit: Unit, origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    read_scene("glTF", bytes, None, unit, bytes.len(), origin, pace).await
}
