//! Frames as a video, recorded by the browser: `www/video.js`.

use js_sys::{Array, Uint8ClampedArray};
use lumen::engine::Frame;
use lumen::say;
use lumen_worker::bytes;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    // www/video.js
    #[wasm_bindgen(js_namespace = lumenVideo)]
    fn can() -> bool;
    #[wasm_bindgen(js_namespace = lumenVideo, catch)]
    async fn record(frames: &Array, width: u32, height: u32, pause: u16) -> Result<JsValue, JsValue>;
}

/// Whether the browser can record.
pub(crate) fn is_there() -> bool {
    can()
}

/// The bytes of a WebM video of frames of one size, each of which is seen for so long, or one sentence on why not. It takes
/// as long as the video plays.
pub(crate) async fn recorded(frames: Vec<Frame>, pause_ms: u16) -> Result<Vec<u8>, String> {
    let [width, height] = frames.first().map_or([0; 2], |frame| [frame.width, frame.height]);
    let pixels: Array = frames.iter().map(|frame| Uint8ClampedArray::from(&frame.rgba[..])).collect();
    drop(frames);
    let refused = |_| say!("record-no-video");
    let video = record(&pixels, width, height, pause_ms).await.map_err(refused)?;
    Ok(bytes::view(&video).map_err(refused)?.to_vec())
}
