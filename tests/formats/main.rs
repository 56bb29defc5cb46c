//! Files: what is read and written of each format, and that no bytes do harm.
//!
//! Memory is counted by the allocator of this program: what measures it, or takes much of it, runs [`alone`].

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod arrays;
mod memory;
mod robustness;
mod samples;
mod slices;
mod table;
mod vtk;

use std::sync::{Mutex, MutexGuard, PoisonError};

use lumen::io::{ImportOptions, Imported, ReadError, read};
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Held by the test whose memory is measured.
static MEASURED: Mutex<()> = Mutex::new(());

/// Waits for the other tests that measure.
fn alone() -> MutexGuard<'static, ()> {
    // The first sentence that is said takes the messages apart, which takes memory that no file has asked for.
    lumen::language::text("errors-no-result");
    // One that failed has said so already.
    MEASURED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What reading gave, and the most bytes that it took beyond the file itself; for tests that are [`alone`].
fn read_measured(bytes: &[u8], name: &str) -> (Result<Imported, ReadError>, usize) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let result = read(bytes, name, &ImportOptions::default());
    (result, MEMORY.peak_usage().saturating_sub(before))
}
