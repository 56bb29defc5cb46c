//! Devices are opened and closed one after the other: one that is being closed is not taken for open, nor closed under
//! whoever has opened it since.

use std::cell::RefCell;

use js_sys::Promise;
use wasm_bindgen::JsValue;
use wasm_bindgen_futures::{JsFuture, future_to_promise};

/// What was begun last.
#[derive(Default)]
pub(crate) struct Turns(RefCell<Option<Promise>>);

impl Turns {
    /// Does `work` once what was begun before is done.
    pub(crate) fn next(&self, work: impl Future<Output = ()> + 'static) {
        let before = self.0.take();
        let done = future_to_promise(async move {
            if let Some(before) = before {
                // It never fails.
                let _ = JsFuture::from(before).await;
            }
            work.await;
            Ok(JsValue::UNDEFINED)
        });
        self.0.replace(Some(done));
    }
}
