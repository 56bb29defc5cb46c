//! Ctrl-C: work ends between two slices, and no file is left half-written.

use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, bail};

/// The exit status of what Ctrl-C has ended, as shells have it: 128 and the number of the signal.
pub(super) const STATUS: u8 = 130;

static ASKED: AtomicBool = AtomicBool::new(false);

/// The user has asked for an end.
#[derive(Debug, thiserror::Error)]
#[error("interrupted; what was written until then is whole")]
pub(super) struct Interrupted;

/// From now on the first Ctrl-C is heard by [`check`]; the second ends the program at once.
pub(super) fn listen() -> Result<()> {
    ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            exit(i32::from(STATUS));
        }
    })
    .context("Ctrl-C cannot be heard")
}

/// Fails once the user has asked for an end.
pub(super) fn check() -> Result<()> {
    if ASKED.load(Ordering::Relaxed) {
        bail!(Interrupted);
    }
    Ok(())
}
