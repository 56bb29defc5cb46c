//! Haptic devices by WebHID and by Web Serial: asked for in the page, where a click may ask, and served in the trial's
//! Worker, beside the engine, so that neither drawing nor the page's other work stands between hand and wire.
//!
//! - [`api`]: the parts of WebHID that are used; [`interfaces`]: a paired device that is open, by one interface or two.
//! - [`port`]: those of Web Serial, and a port that is open.
//! - [`page`]: which devices there are, pairing, and the page's end of the line to the Worker. Where Workers have no WebHID
//!   (Chromium before 131) the page opens the device, and its reports go to and fro by messages; it decides nothing.
//! - [`served`]: the Worker's end: opens a device, takes its reports, sends those that are due.
//! - [`timers`], and [`turns`], in which devices are opened and closed.

pub(crate) mod api;
pub(crate) mod interfaces;
pub(crate) mod page;
pub(crate) mod port;
pub(crate) mod served;
pub(crate) mod timers;
pub(crate) mod turns;

use lumen::haptics::force::{Reply, Request};
use lumen::haptics::identity::Identity;
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
    /// Hear what became of a device that the page has opened, by the number under which it was asked to.
    Relayed(u32, Relayed),
}

/// What the page hands on of a device that it has opened.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Relayed {
    /// It is open; what the browser tells of the reports of the interface that is held, and of another that takes forces.
    Opened(String, Option<String>),
    /// It is not, or no longer, and why, in a sentence.
    Ended(String),
    /// An input report that came at this time, in ms of the machine's clock.
    Input {
        /// When.
        at_ms: f64,
        /// Its id.
        id: u8,
        /// Its bytes, without it.
        data: Vec<u8>,
    },
    /// How the last request went.
    Answer(Answer),
    /// The page still answers for the device: said again and again.
    Beat,
}

/// How a request went.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Answer {
    /// It was sent.
    Done,
    /// What was got.
    Got(Vec<u8>),
    /// It failed.
    Failed,
}

impl Answer {
    /// As a driver hears it.
    pub(crate) fn reply(&self) -> Reply<'_> {
        match self {
            Self::Done => Reply::Done,
            Self::Got(data) => Reply::Feature(data),
            Self::Failed => Reply::Failed,
        }
    }
}

/// What the Worker tells the page.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Told {
    /// How the device that is served is; `None` where none is.
    Status(Box<Option<DeviceStatus>>),
    /// What the page has to do with a device, which it opens under this number.
    Relay(u32, Relay),
}

/// What the page does with a device that it opens in the Worker's place.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Relay {
    /// Opens this one.
    Open(Choice),
    /// Carries this out.
    Carry(Request),
    /// Carries these out, and closes it.
    Close(Vec<Request>),
}
