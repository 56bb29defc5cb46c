//! Begins the Worker's job.

use lumen::engine::scan::ScanEngine;
use lumen_worker::serve::{Beside, run};
use wasm_bindgen::prelude::*;

use crate::shelf::Handed;

/// Begins the Worker's job; called once by `www/worker.js`, before the first message is handed on.
///
/// # Errors
///
/// Where this is no Worker.
#[wasm_bindgen]
#[allow(unreachable_pub, reason = "wasm-bindgen exports only what is public")]
pub fn worker_main(_job: &str) -> Result<(), JsValue> {
    lumen_worker::panics::report();
    run(|_| {
        let handed = Handed::new()?;
        let shelf = handed.clone();
        let beside: Beside = Box::new(move |data| handed.take(data).then_some(Ok(())));
        Ok((ScanEngine::with_shelf(shelf), Some(beside)))
    })
}
