//! What outlives the page, in this browser alone: a text in its local storage, a surface in its IndexedDB
//! (`www/store.js`).

use js_sys::{Array, Uint8Array};
use lumen::app::PlatformEvent;
use lumen::language::decimal;
use lumen::say;
use lumen_worker::bytes;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::Storage;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = lumenStore, js_name = keep, catch)]
    async fn keep_bytes(name: &str, bytes: &Uint8Array) -> Result<JsValue, JsValue>;
    #[wasm_bindgen(js_namespace = lumenStore, js_name = restore, catch)]
    async fn restore_bytes() -> Result<JsValue, JsValue>;
    #[wasm_bindgen(js_namespace = lumenStore, js_name = forget, catch)]
    async fn forget_bytes() -> Result<JsValue, JsValue>;
}

/// The storage and the key: another Lumen may be served under another path of this origin. A browser that is told to keep
/// nothing has none.
fn storage() -> Option<(Storage, String)> {
    let window = web_sys::window()?;
    let path = window.location().pathname().ok()?;
    // With the name of the page and without it is one page.
    let folder = &path[..=path.rfind('/')?];
    Some((window.local_storage().ok()??, format!("lumen {folder}")))
}

/// The text that was kept.
pub(crate) fn text() -> Option<String> {
    let (storage, key) = storage()?;
    storage.get_item(&key).ok()?
}

/// Keeps a text, or nothing.
pub(crate) fn set_text(text: Option<&str>) {
    let Some((storage, key)) = storage() else { return };
    // Where there is no room for it, the next start begins anew.
    let _ = match text {
        Some(text) => storage.set_item(&key, text),
        None => storage.remove_item(&key),
    };
}

/// Keeps a surface; `tell` hears where that fails.
pub(crate) fn keep_surface(name: &str, bytes: &[u8], tell: impl Fn(PlatformEvent) + 'static) {
    let failed = say!("scan-not-kept", name = name, mb = decimal(bytes.len() as f64 / 1e6, 1));
    let Ok(copy) = bytes::copied(bytes) else { return tell(PlatformEvent::Failed { message: failed }) };
    let name = name.to_owned();
    spawn_local(async move {
        if keep_bytes(&name, &copy).await.is_err() {
            tell(PlatformEvent::Failed { message: failed });
        }
    });
}

/// Asks for the surface that is kept.
pub(crate) fn restore_surface(tell: impl Fn(PlatformEvent) + 'static) {
    spawn_local(async move { tell(PlatformEvent::Restored(restored().await)) });
}

async fn restored() -> Option<(String, Vec<u8>)> {
    let kept: Array = restore_bytes().await.ok()?.dyn_into().ok()?;
    let (name, copy) = (kept.get(0).as_string()?, kept.get(1).dyn_into::<Uint8Array>().ok()?);
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(copy.length() as usize).ok()?;
    bytes.resize(copy.length() as usize, 0);
    copy.copy_to(&mut bytes);
    Some((name, bytes))
}

/// Forgets the surface that is kept; `tell` hears where that fails.
pub(crate) fn forget_surface(tell: impl Fn(PlatformEvent) + 'static) {
    // A browser that is told to keep nothing has kept nothing.
    if storage().is_none() {
        return;
    }
    spawn_local(async move {
        if forget_bytes().await.is_err() {
            tell(PlatformEvent::Failed { message: say!("scan-not-forgotten") });
        }
    });
}
