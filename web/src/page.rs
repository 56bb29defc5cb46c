//! Starts the app in the page and tells the page how it goes.
//!
//! The page shows what `data-state` on its root element says (`www/style.css`): `loading` until it becomes `ready`,
//! `lost` while nothing can be drawn, `failed` when the program has stopped (`www/boot.js` hears of that as an error
//! event).

use wasm_bindgen::prelude::*;
use web_sys::Window;

use crate::graphics::Stage;

/// Starts the app; the page is told of any failure.
pub(crate) fn start(window: Window) {
    report_panics();
    wasm_bindgen_futures::spawn_local(async move {
        if let Err(error) = Stage::open(window).await {
            report_error(&named_error("The app could not start", &error));
        }
    });
}

/// Makes a panic an error event: on the page `boot.js` shows its screen, from a Worker the page's end of the line
/// hears it.
pub(crate) fn report_panics() {
    std::panic::set_hook(Box::new(|info| report_error(&named_error("", &info.to_string().into()))));
}

fn named_error(what: &str, why: &JsValue) -> js_sys::Error {
    let why = why.as_string().unwrap_or_else(|| format!("{why:?}"));
    let error = js_sys::Error::new(&if what.is_empty() { why } else { format!("{what}: {why}") });
    error.set_name("Panic");
    error
}

#[wasm_bindgen]
extern "C" {
    // Global in pages and Workers alike: fires an error event as an exception that nobody caught would.
    #[wasm_bindgen(js_name = reportError)]
    fn report_error(error: &js_sys::Error);
}
