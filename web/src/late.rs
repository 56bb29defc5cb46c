//! The late half of the program: `cargo xtask build` takes what the first picture does without into a module of its own
//! (`xtask/src/split.rs`), and `www/late.js` fetches it.

use lumen::say;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = lumenLate)]
    fn join_late(early: &JsValue);

    #[wasm_bindgen(catch, js_name = lumenLateArrives)]
    async fn late_arrives() -> Result<(), JsValue>;
}

/// Waits on the page until the late half has been fetched, so that what follows does not hold up the page.
///
/// # Errors
///
/// Where it could not be fetched this time; it is asked for again.
pub(crate) async fn arrived() -> Result<(), String> {
    late_arrives().await.map_err(|_| say!("scan-part-missing"))
}

/// Brings the late half at once; what is left of a late function calls it where that half is not there.
#[wasm_bindgen]
#[allow(unreachable_pub, reason = "wasm-bindgen exports only what is public")]
pub fn bring_late() {
    join_late(&wasm_bindgen::exports());
}
