//! The Worker's end of the line: hears commands, works on them in slices, and sends events.
//!
//! Between two slices the Worker goes back to the browser, so that a command is heard within a slice's time. A message
//! to itself brings it back at once; a timer would make it wait for 4 ms each time.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use lumen::engine::{Engine, SLICE, wire};
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, MessageChannel, MessageEvent, MessagePort};

use crate::worker::{Received, pack};

/// The job of the Worker that runs the pipeline.
pub(crate) const PIPELINE: &str = "pipeline";

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
        PIPELINE => run_engine(),
        _ => Err(format!("there is no job named {job}").into()),
    }
}

fn run_engine() -> Result<(), JsValue> {
    let scope: DedicatedWorkerGlobalScope = js_sys::global().dyn_into().map_err(|_| "this is no Worker")?;
    let engine = Rc::new(RefCell::new(Engine::new()));
    let again = Again::new()?;

    let hear = Closure::<dyn Fn(MessageEvent) -> Result<(), JsValue>>::new({
        let (engine, scope, again) = (Rc::clone(&engine), scope.clone(), again.clone());
        move |event: MessageEvent| {
            let message = Received::unpack(&event.data()).ok_or("a message that is none")?;
            let command = wire::decode_command(&message.header, &message).map_err(|error| error.to_string())?;
            let mut engine = engine.borrow_mut();
            engine.handle(command);
            // The answer to a cancel does not wait for the next slice.
            tell(&mut engine, &scope)?;
            again.soon()
        }
    });
    let work = Closure::<dyn Fn() -> Result<(), JsValue>>::new({
        let (scope, again) = (scope.clone(), again.clone());
        move || {
            again.waiting.set(false);
            let mut engine = engine.borrow_mut();
            let more = engine.advance(SLICE);
            tell(&mut engine, &scope)?;
            if more { again.soon() } else { Ok(()) }
        }
    });
    again.to.set_onmessage(Some(work.as_ref().unchecked_ref()));
    scope.set_onmessage(Some(hear.as_ref().unchecked_ref()));
    // Both live as long as the Worker.
    work.forget();
    hear.forget();
    Ok(())
}

/// Sends what the engine has to say to the page.
fn tell(engine: &mut Engine, scope: &DedicatedWorkerGlobalScope) -> Result<(), JsValue> {
    while let Some(event) = engine.poll() {
        let (values, transfer) = pack(&wire::encode_event(&event));
        scope.post_message_with_transfer(&values, &transfer)?;
    }
    Ok(())
}

/// A message from the Worker to itself, at most one at a time.
#[derive(Clone)]
struct Again {
    from: MessagePort,
    to: MessagePort,
    waiting: Rc<Cell<bool>>,
}

impl Again {
    fn new() -> Result<Self, JsValue> {
        let channel = MessageChannel::new()?;
        Ok(Self { from: channel.port1(), to: channel.port2(), waiting: Rc::default() })
    }

    fn soon(&self) -> Result<(), JsValue> {
        if self.waiting.replace(true) { Ok(()) } else { self.from.post_message(&JsValue::NULL) }
    }
}
