//! Ctrl-C: work ends between two slices, and no file is left half-written.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use anyhow::{Context, Result, bail};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

/// The exit status of what Ctrl-C has ended, as shells have it: 128 and the number of the signal.
pub(super) const STATUS: u8 = 130;

static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// The user has asked for an end.
#[derive(Debug, thiserror::Error)]
#[error("interrupted; what was written until then is whole")]
pub(super) struct Interrupted;

/// From now on the first Ctrl-C is heard by [`check`]; the second ends the program at once.
pub(super) fn listen() -> Result<()> {
    let asked = ASKED.get_or_init(Arc::default);
    for signal in [SIGINT, SIGTERM] {
        // In this order: the first signal finds the flag down, and raises it.
        register_conditional_shutdown(signal, STATUS.into(), Arc::clone(asked))
            .and_then(|_| register(signal, Arc::clone(asked)))
            .context("Ctrl-C cannot be heard")?;
    }
    Ok(())
}

/// Fails once the user has asked for an end.
pub(super) fn check() -> Result<()> {
    if ASKED.get().is_some_and(|asked| asked.load(Ordering::Relaxed)) {
        bail!(Interrupted);
    }
    Ok(())
}
