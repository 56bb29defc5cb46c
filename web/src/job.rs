//! The engines that have a Worker of their own, and how those of this program begin.

use std::rc::Rc;

use lumen::engine::scan::{ScanCommand, ScanEvent, is_progress};
use lumen::engine::trial::{HapticChannel, TrialCommand, TrialEvent, is_frame};
use lumen::engine::{Command, Engine, Event, TrialEngine};
use lumen::transfer::Message;
use lumen_worker::serve::{Beside, run, scope};
use wasm_bindgen::prelude::*;

use crate::hid::served::Hands;

/// An engine behind a line.
pub(crate) trait Job {
    /// The name of its Worker's job.
    const NAME: &str;
    /// The program that does it, where it is not this one.
    const PROGRAM: Option<&str> = None;
    /// What it is asked.
    type Command: Message + 'static;
    /// What it tells.
    type Event: Message + 'static;

    /// Whether a message with this head is useless once there is another such.
    fn is_passing(_: &[u8]) -> bool {
        false
    }
}

/// The pipeline's.
pub(crate) enum Pipeline {}

impl Job for Pipeline {
    const NAME: &str = "pipeline";
    type Command = Command;
    type Event = Event;
}

/// The trial's.
pub(crate) enum Trial {}

impl Job for Trial {
    const NAME: &str = "trial";
    type Command = TrialCommand;
    type Event = TrialEvent;

    fn is_passing(head: &[u8]) -> bool {
        is_frame(head)
    }
}

/// That of scans, in `web/scan`.
pub(crate) enum Scan {}

impl Job for Scan {
    const NAME: &str = "scan";
    const PROGRAM: Option<&str> = Some("lumen-scan");
    type Command = ScanCommand;
    type Event = ScanEvent;

    fn is_passing(head: &[u8]) -> bool {
        is_progress(head)
    }
}

/// Begins the Worker's job; called once by `www/worker.js`, before the first message is handed on.
///
/// # Errors
///
/// Where there is no such job, or this is no Worker.
#[wasm_bindgen]
#[allow(unreachable_pub, reason = "wasm-bindgen exports only what is public")]
pub fn worker_main(job: &str) -> Result<(), JsValue> {
    lumen_worker::panics::report();
    match job {
        Pipeline::NAME => run(|_| Ok((Engine::new(), None))),
        Trial::NAME => run(|again| {
            let (exchange, again) = (HapticChannel::default(), Rc::clone(again));
            // A Worker that cannot be brought back has no engine that could be held.
            let hands = Hands::new(scope()?, exchange.clone(), move || drop(again.soon()));
            let beside: Beside = Box::new(move |data| data.as_string().map(|line| hands.hear(&line)));
            Ok((TrialEngine::with_hand(exchange), Some(beside)))
        }),
        _ => Err(format!("there is no job named {job}").into()),
    }
}
