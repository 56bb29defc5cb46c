//! Bytes on their way out of the program's memory and into it. What the browser has no memory for is an error here: an
//! exception that passed through the program would leave it standing still, with the page looking as if all were well.

use js_sys::Uint8Array;
use lumen::language::decimal;
use lumen::say;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// The script's own constructor, whose exceptions are caught.
    #[wasm_bindgen(js_name = Uint8Array, extends = Uint8Array)]
    type Bytes;

    #[wasm_bindgen(constructor, catch, js_class = "Uint8Array")]
    fn with_length(length: u32) -> Result<Bytes, JsValue>;

    #[wasm_bindgen(constructor, catch, js_class = "Uint8Array")]
    fn over(buffer: &JsValue) -> Result<Bytes, JsValue>;

    #[wasm_bindgen(js_name = ArrayBuffer)]
    type Buffer;

    #[wasm_bindgen(method, catch)]
    fn transfer(this: &Buffer, length: u32) -> Result<JsValue, JsValue>;
}

/// A copy of `bytes` outside the program's memory.
///
/// # Errors
///
/// An error with a sentence's end, when the browser has no memory for it.
pub fn copied(bytes: &[u8]) -> Result<Uint8Array, JsValue> {
    let copy = Bytes::with_length(bytes.len() as u32).map_err(|_| no_memory(bytes.len()))?;
    copy.copy_from(bytes);
    Ok(copy.into())
}

/// The bytes of a buffer of the script's, which stay where they are.
///
/// # Errors
///
/// What the browser answers where it is no buffer.
pub fn view(buffer: &JsValue) -> Result<Uint8Array, JsValue> {
    Bytes::over(buffer).map(Into::into)
}

/// Gives the memory of a buffer back at once: the collector of garbage would take its time to, and that of a frame.
pub fn give_back(buffer: &Uint8Array) {
    // Browsers of before 2024 have no such way; there it is collected.
    let _ = JsValue::from(buffer.buffer()).unchecked_into::<Buffer>().transfer(0);
}

/// That there is no memory for so many bytes, as an exception.
pub fn no_memory(bytes: usize) -> JsValue {
    js_sys::Error::new(&say!("scan-browser-memory", mb = decimal(bytes as f64 / 1e6, 1))).into()
}
