//! How much memory the reading of a file may take: 64 MB and twenty times the file.
//!
//! A few bytes can stand for much: a strip makes a triangle of every number, a compressed block of zeros a thousand bytes
//! of one. What a file unfolds to is counted before it is made, and refused where it would not fit. Files that programs
//! write stay far below: a triangle of a compressed strip takes seven bytes, of anything else ten or more.

use super::error::{ReadError, Unfolded};

const MB: u64 = 1_000_000;
/// What a vertex and a triangle take at most on their way through the import stage, in bytes (`tests/formats` measures).
const VERTEX: u64 = 64;
const TRIANGLE: u64 = 104;
/// And a part of a structure, such as a node of a scene or a list of cells, while lists of them grow.
const PART: u64 = 1024;

/// The room for one file.
#[derive(Clone, Copy, Debug)]
pub(super) struct MemoryBudget {
    /// Bytes of the file.
    file: u64,
}

impl MemoryBudget {
    /// For a file of so many bytes.
    pub(super) fn of(file: usize) -> Self {
        Self { file: file as u64 }
    }

    /// The most bytes that its compressed data may unfold to, all together.
    pub(super) fn unfolded(self) -> u64 {
        16 * MB + 8 * self.file
    }

    /// Refuses a structure of so many parts that, each taking a few bytes in the file, would not fit.
    pub(super) fn check_parts(self, format: &'static str, parts: usize) -> Result<(), ReadError> {
        if PART * parts as u64 > self.bytes() {
            let what = Unfolded::Parts { parts };
            return Err(ReadError::Unfolds { format, what, file: self.file });
        }
        Ok(())
    }

    /// All of it.
    fn bytes(self) -> u64 {
        64 * MB + 20 * self.file
    }

    /// Whether so many bytes of arrays fit beside a surface. They are there up to three times: as in the file, for its
    /// triangles, and as they come out of the import stage.
    pub(super) fn holds_arrays(self, vertices: usize, triangles: usize, bytes: u64) -> bool {
        let lists = (VERTEX + 16) * vertices as u64 + (TRIANGLE + 8) * triangles as u64;
        bytes.checked_mul(3).and_then(|bytes| bytes.checked_add(lists)).is_some_and(|needed| needed <= self.bytes())
    }

    /// Refuses a surface that would not fit.
    pub(super) fn check(self, format: &'static str, vertices: usize, triangles: usize) -> Result<(), ReadError> {
        let needed = VERTEX * vertices as u64 + TRIANGLE * triangles as u64;
        if needed > self.bytes() {
            let what = Unfolded::Surface { vertices, triangles };
            return Err(ReadError::Unfolds { format, what, file: self.file });
        }
        Ok(())
    }
}
