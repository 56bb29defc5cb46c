//! Ctrl-C, and SIGTERM alike: work ends between two slices, and no file is left half-written.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use anyhow::{Context, Result, bail};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown, register_usize};

/// What was heard.
#[derive(Default)]
struct Heard {
    /// Whether anything was.
    is_asked: Arc<AtomicBool>,
    /// The exit status of the last, as shells have it: 128 and the number of the signal.
    status: Arc<AtomicUsize>,
}

static HEARD: OnceLock<Heard> = OnceLock::new();

/// The user, or the system, has asked for an end. It has the exit status.
#[derive(Debug, thiserror::Error)]
#[error("interrupted; what was written until then is whole")]
pub(super) struct Interrupted(pub(super) u8);

/// From now on the first signal is heard by [`check`]; the second ends the program at once.
pub(super) fn listen() -> Result<()> {
    let Heard { is_asked, status } = HEARD.get_or_init(Heard::default);
    for signal in [SIGINT, SIGTERM] {
        let of_signal = 128 + signal;
        // In this order: the first signal finds the flag down, and raises it once its status is there.
        register_conditional_shutdown(signal, of_signal, Arc::clone(is_asked))
            .and_then(|_| register_usize(signal, Arc::clone(status), of_signal as usize))
            .and_then(|_| register(signal, Arc::clone(is_asked)))
            .context("Ctrl-C cannot be heard")?;
    }
    Ok(())
}

/// Fails once an end was asked for.
pub(super) fn check() -> Result<()> {
    if let Some(heard) = HEARD.get().filter(|heard| heard.is_asked.load(Ordering::SeqCst)) {
        bail!(Interrupted(heard.status.load(Ordering::SeqCst) as u8));
    }
    Ok(())
}
