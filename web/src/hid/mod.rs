//! Haptic devices by WebHID and by Web Serial: asked for in the page, where a click may ask, and served in the trial's
//! Worker, beside the engine, so that neither drawing nor the page's other work stands between hand and wire.
//!
//! - [`api`]: the parts of WebHID that are used.
//! - [`port`]: those of Web Serial, and a port that is open.
//! - [`page`]: which devices there are, pairing, and the page's end of the line to the Worker.
//! - [`served`]: the Worker's end: opens a device, takes its reports, sends those that are due.

pub(crate) mod api;
pub(crate) mod page;
pub(crate) mod port;
pub(crate) mod served;

use lumen::haptics::device::Identity;
use lumen::haptics::service::{DeviceCommand, DeviceStatus};
use serde::{Deserialize, Serialize};

use self::api::HidDevice;
use self::port::SerialPort;

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
    /// A serial port that the user has paired, by the numbers of what is behind it; ports have no names.
    Serial {
        /// Its vendor's number.
        vendor: u16,
        /// Its own.
        product: u16,
    },
}

impl Choice {
    /// That of an interface of a device.
    pub(crate) fn of(device: &HidDevice) -> Self {
        Self::Paired { vendor: device.vendor_id(), product: device.product_id(), name: device.product_name() }
    }

    /// That of a serial port; `None` for one that is not on the USB.
    pub(crate) fn of_port(port: &SerialPort) -> Option<Self> {
        port::numbers(port).map(|[vendor, product]| Self::Serial { vendor, product })
    }

    /// What the device is known by, in all languages.
    pub(crate) fn identity(&self) -> Identity {
        match self {
            Self::Virtual => Identity { name: "Virtual device".to_owned(), ..Identity::default() },
            Self::Paired { vendor, product, name } => {
                Identity { vendor: *vendor, product: *product, name: name.clone() }
            }
            Self::Serial { vendor, product } => {
                Identity { vendor: *vendor, product: *product, name: "Feeder by serial".to_owned() }
            }
        }
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
