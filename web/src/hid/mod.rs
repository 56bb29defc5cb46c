//! Haptic devices by WebHID: asked for in the page, where a click may ask, and served in the trial's Worker, beside the
//! engine, so that neither drawing nor the page's other work stands between hand and wire.
//!
//! - [`api`]: the parts of WebHID that are used.
//! - [`page`]: which devices there are, pairing, and the page's end of the line to the Worker.
//! - [`served`]: the Worker's end: opens a device, takes its reports, sends those that are due.

pub(crate) mod api;
pub(crate) mod page;
pub(crate) mod served;

use lumen::haptics::service::{DeviceCommand, DeviceStatus};
use serde::{Deserialize, Serialize};

use self::api::HidDevice;

/// A device that can be served.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Choice {
    /// The one without hardware.
    Virtual,
    /// One that the user has paired, by its numbers and its name: the browser has no other sign of it that page and Worker
    /// share.
    Paired {
        /// Its vendor's number.
        vendor: u16,
        /// Its own.
        product: u16,
        /// What it calls itself.
        name: String,
    },
}

impl Choice {
    /// That of an interface of a device.
    pub(crate) fn of(device: &HidDevice) -> Self {
        Self::Paired { vendor: device.vendor_id(), product: device.product_id(), name: device.product_name() }
    }
}

/// What the page asks of the Worker.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Asked {
    /// Serve this one and none else; none at all for `None`.
    Serve(Option<Choice>),
    /// Something of the one that is served.
    Command(DeviceCommand),
}

/// How the device that is served is; `None` where none is.
pub(crate) type Told = Option<DeviceStatus>;
