//! What is said on a serial line: one request at a time, and the answer to it.

use std::rc::Rc;

use js_sys::{Array, Promise};
use lumen::haptics::device::HapticDevice;
use lumen::haptics::force::{Reply, Request};
use lumen::haptics::framing::{Frame, Kind};
use lumen::haptics::serial::{answer, framed};
use wasm_bindgen_futures::{JsFuture, spawn_local};

use crate::hid::port::Port;
use crate::hid::timers::slept;

/// For how long an answer is waited for, in ms.
pub(super) const ANSWER_MS: f64 = 250.0;

/// A device on a serial line.
pub(super) struct Talk {
    port: Rc<Port>,
    is_writing: bool,
    /// The request whose answer is waited for, and since when, in ms.
    awaited: Option<(Request, f64)>,
}

impl Talk {
    /// Nothing is said yet.
    pub(super) fn new(port: Rc<Port>) -> Self {
        Self { port, is_writing: false, awaited: None }
    }

    /// The port that it is at.
    pub(super) fn port(&self) -> Rc<Port> {
        Rc::clone(&self.port)
    }

    /// The request that goes next; `None` while one is under way, or if none is due.
    pub(super) fn next(&mut self, now_ms: f64, device: &mut HapticDevice) -> Option<Request> {
        if let Some((_, since_ms)) = &self.awaited
            && now_ms - since_ms > ANSWER_MS
        {
            self.awaited = None;
            device.reply(now_ms, Reply::Failed);
        }
        if self.is_writing || self.awaited.is_some() {
            return None;
        }
        let request = device.next(now_ms)?;
        self.is_writing = true;
        if !matches!(request, Request::Send { .. }) {
            self.awaited = Some((request.clone(), now_ms));
        }
        Some(request)
    }

    /// A request was written, or could not be.
    pub(super) fn written(&mut self, now_ms: f64, request: &Request, is_written: bool, device: &mut HapticDevice) {
        self.is_writing = false;
        if !is_written {
            self.awaited = None;
            device.reply(now_ms, Reply::Failed);
        } else if matches!(request, Request::Send { .. }) {
            device.reply(now_ms, Reply::Done);
        }
    }

    pub(super) fn heard(&mut self, now_ms: f64, frame: &Frame<'_>, device: &mut HapticDevice) {
        if frame.kind == Kind::Input {
            device.input(now_ms, frame.id, frame.data);
        } else if let Some((request, _)) = &self.awaited
            && let Some(reply) = answer(request, frame)
        {
            self.awaited = None;
            device.reply(now_ms, reply);
        }
    }

    /// Leaves the device without a force, and the port closed.
    pub(super) fn close(self, farewell: &[Request]) {
        // One that is gone hears nothing; its motors end by themselves.
        let said: Array = farewell.iter().filter_map(framed).map(|bytes| self.port.write(&bytes)).collect();
        // One that takes nothing any more has had its time then.
        let said = Promise::race(&Array::of2(&Promise::all_settled(&said), &slept(ANSWER_MS as i32)));
        spawn_local(async move {
            let _ = JsFuture::from(said).await;
            self.port.close().await;
        });
    }
}
