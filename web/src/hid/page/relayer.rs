//! What the page holds of a device that it has opened in the Worker's place, and gives back when it is dropped.

use std::rc::Rc;

use wasm_bindgen::prelude::*;
use web_sys::Window;

use crate::hid::api::{Hid, HidConnectionEvent};
use crate::hid::interfaces::{Input, Interfaces};

/// The device that the page has opened for the Worker, or is opening.
#[derive(Default)]
pub(super) struct Relayer {
    /// Counts what was asked for: what comes late of one before is let go.
    pub(super) turn: u32,
    pub(super) open: Option<Rc<Open>>,
}

/// One that is open.
pub(super) struct Open {
    pub(super) device: Interfaces,
    pub(super) _input: Input,
    pub(super) _unplugged: Unplugged,
    pub(super) _beat: Beat,
}

/// Says again and again that the page still hears the device, until it is dropped.
pub(super) struct Beat {
    pub(super) window: Window,
    pub(super) handle: i32,
    pub(super) _say: Closure<dyn Fn()>,
}

impl Drop for Beat {
    fn drop(&mut self) {
        self.window.clear_interval_with_handle(self.handle);
    }
}

/// Hears that a device is pulled out, until it is dropped.
pub(super) struct Unplugged {
    pub(super) hid: Hid,
    pub(super) hear: Closure<dyn Fn(HidConnectionEvent)>,
}

impl Drop for Unplugged {
    fn drop(&mut self) {
        // What cannot be removed is not there any more.
        let _ = self.hid.remove_event_listener_with_callback("disconnect", self.hear.as_ref().unchecked_ref());
    }
}
