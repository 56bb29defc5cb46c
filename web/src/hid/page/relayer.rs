//! What the page holds of a device that it has opened in the Worker's place, and gives back when it is dropped.

use crate::hid::api::OnConnection;
use crate::hid::interfaces::{Input, Interfaces};
use crate::hid::timers::Interval;

/// The device that the page has opened for the Worker, or is opening.
#[derive(Default)]
pub(super) struct Relayer {
    /// Counts what was asked for: what comes late of one before is let go.
    pub(super) turn: u32,
    pub(super) open: Option<Open>,
}

/// One that is open.
pub(super) struct Open {
    pub(super) device: Interfaces,
    pub(super) _input: Input,
    /// Hears that it is pulled out.
    pub(super) _unplugged: OnConnection,
    /// Says again and again that the page still hears it.
    pub(super) _beat: Interval,
}
