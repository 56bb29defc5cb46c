//! Makes the end of a program heard.

use wasm_bindgen::prelude::*;

/// Makes a panic an error event: on the page `boot.js` shows its screen, from a Worker the page's end of the line
/// hears it.
pub fn report() {
    std::panic::set_hook(Box::new(|info| report_error(&named_error("", &info.to_string().into()))));
}

/// Makes an exception that ends the program such an event; `what` could not be done.
pub fn report_exception(what: &str, why: &JsValue) {
    report_error(&named_error(what, why));
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
