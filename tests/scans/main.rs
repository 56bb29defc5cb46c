//! Scans and masks: every format and way to write the same small volume, and that no bytes do harm.
//!
//! Memory is counted by the allocator of this program: what measures it, or takes much of it, runs [`alone`].

mod dicom;
mod formats;
mod jpeg;
mod robustness;
mod samples;
mod slices;

use std::sync::{Mutex, MutexGuard, PoisonError};

use lumen::io::volume::{Part, Scan, ScanError, read};
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Held by the test whose memory is measured.
static MEASURED: Mutex<()> = Mutex::new(());

/// Files by their names.
type Files = Vec<(&'static str, Vec<u8>)>;

/// Waits for the other tests that measure.
fn alone() -> MutexGuard<'static, ()> {
    // The first sentence that is said takes the messages apart, which takes memory that no file has asked for.
    lumen::language::text("errors-no-result");
    // One that failed has said so already.
    MEASURED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Reads the volume in some files.
fn open(files: &[(&str, Vec<u8>)]) -> Result<Scan, ScanError> {
    let parts: Vec<Part> = files.iter().map(|(name, bytes)| Part { name, bytes }).collect();
    read(&parts)
}

/// What reading gave, and the most bytes that it took beyond the files themselves; for tests that are [`alone`].
fn open_measured(files: &[(&str, Vec<u8>)]) -> (Result<Scan, ScanError>, usize) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let result = open(files);
    (result, MEMORY.peak_usage().saturating_sub(before))
}
