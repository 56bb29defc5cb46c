//! Files that the engine reads itself, a piece at a time: their bytes are nowhere else, reading them has a progress, and a
//! command is heard between two pieces.

use super::message::{Contents, NamedFile};
use crate::language::decimal;
use crate::say;

/// What has files that are not in memory: the browser, a disk.
pub trait Shelf {
    /// Fills `target` with the bytes of a file from `begin` on.
    ///
    /// # Errors
    /// One plain sentence without the file's name: it is not there, was changed, or there is no memory for the piece.
    fn read(&mut self, number: u32, begin: u64, target: &mut [u8]) -> Result<(), String>;

    /// Files with a smaller number are not asked for again.
    fn forget_before(&mut self, number: u32);
}

/// No files.
pub(super) struct Empty;

impl Shelf for Empty {
    fn read(&mut self, _: u32, _: u64, _: &mut [u8]) -> Result<(), String> {
        Err(say!("scan-file-gone"))
    }

    fn forget_before(&mut self, _: u32) {}
}

/// The length of a file in bytes.
pub(super) fn length(file: &NamedFile) -> u64 {
    match &file.contents {
        Contents::Bytes(bytes) => bytes.len() as u64,
        Contents::Shelved { bytes, .. } => *bytes,
    }
}

/// The bytes of a file from `begin` on, `most` or as many as there are.
///
/// # Errors
/// One plain sentence: they cannot be read, or there is no memory for them.
pub(super) fn piece(shelf: &mut dyn Shelf, file: &NamedFile, begin: u64, most: usize) -> Result<Vec<u8>, String> {
    let count = (length(file) - begin).min(most as u64) as usize;
    let mut piece = Vec::new();
    let full = |_| say!("scan-no-memory", mb = decimal(count as f64 / 1e6, 0));
    piece.try_reserve_exact(count).map_err(full)?;
    match &file.contents {
        Contents::Bytes(bytes) => piece.extend_from_slice(&bytes[begin as usize..][..count]),
        Contents::Shelved { number, .. } => {
            piece.resize(count, 0);
            shelf.read(*number, begin, &mut piece)?;
        }
    }
    Ok(piece)
}
