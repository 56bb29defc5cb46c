//! Starts the app in the page and tells the page how it goes.
//!
//! The page shows what `data-state` on its root element says (`www/style.css`): `loading` until it becomes `ready`,
//! `lost` while nothing can be drawn, `failed` when the program has stopped (`www/boot.js` hears of that as an error
//! event).

use web_sys::Window;

use crate::graphics::Stage;

/// Starts the app; the page is told of any failure.
pub(crate) fn start(window: Window) {
    lumen_worker::panics::report();
    wasm_bindgen_futures::spawn_local(async move {
        if let Err(error) = Stage::open(window).await {
            lumen_worker::panics::report_exception("The app could not start", &error);
        }
    });
}
