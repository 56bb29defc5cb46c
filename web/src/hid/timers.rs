//! Timers as pages and Workers both have them.

use js_sys::{Function, Promise};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = setInterval, catch)]
    fn set_interval(run: &Closure<dyn Fn()>, ms: i32) -> Result<i32, JsValue>;

    #[wasm_bindgen(js_name = clearInterval)]
    fn clear_interval(handle: i32);

    #[wasm_bindgen(js_name = setTimeout, catch)]
    fn set_timeout(run: &Function, ms: i32) -> Result<i32, JsValue>;
}

/// Runs something again and again, until it is dropped.
pub(crate) struct Interval {
    handle: i32,
    _run: Closure<dyn Fn()>,
}

impl Interval {
    /// Runs `run` every `ms`.
    ///
    /// # Errors
    ///
    /// When there is no timer to be had.
    pub(crate) fn new(ms: i32, run: impl Fn() + 'static) -> Result<Self, JsValue> {
        let run = Closure::new(run);
        Ok(Self { handle: set_interval(&run, ms)?, _run: run })
    }
}

impl Drop for Interval {
    fn drop(&mut self) {
        clear_interval(self.handle);
    }
}

/// Resolves after `ms`, with nothing.
pub(crate) fn slept(ms: i32) -> Promise {
    Promise::new(&mut |resolve, _| {
        if set_timeout(&resolve, ms).is_err() {
            // Without a timer, at once.
            let _ = resolve.call0(&JsValue::UNDEFINED);
        }
    })
}
