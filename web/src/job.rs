//! The Worker's end of the line: hears messages, works in slices, and answers.

use js_sys::global;
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, MessageEvent};

use crate::worker::Message;

/// Begins the Worker's job; called once by `www/worker.js`, before the first message is handed on.
///
/// # Errors
///
/// Where there is no such job, or this is no Worker.
#[wasm_bindgen]
#[allow(unreachable_pub, reason = "wasm-bindgen exports only what is public")]
pub fn worker_main(job: &str) -> Result<(), JsValue> {
    crate::page::report_panics();
    match job {
        "echo" => echo(),
        _ => Err(format!("there is no job named {job}").into()),
    }
}

/// The Worker's global scope.
fn scope() -> Result<DedicatedWorkerGlobalScope, JsValue> {
    global().dyn_into().map_err(|_| "this is no Worker".into())
}

fn echo() -> Result<(), JsValue> {
    let scope = scope()?;
    let answer = Closure::<dyn Fn(MessageEvent)>::new({
        let scope = scope.clone();
        move |event: MessageEvent| {
            let Some(message) = Message::unpack(&event.data()) else { panic!("a message that is none") };
            let (values, transfer) = message.pack();
            scope.post_message_with_transfer(&values, &transfer).expect("an echo fits");
        }
    });
    scope.set_onmessage(Some(answer.as_ref().unchecked_ref()));
    answer.forget();
    Ok(())
}
