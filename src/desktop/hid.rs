//! Devices by the system's HID interface, without a C library (hidraw on Linux).
//!
//! On Linux a device can be opened by its user where a udev rule says so; the rule to copy is in `docs/haptics.md`.

use std::ffi::CString;

use hidapi::{HidApi, HidDevice, HidError};

use crate::haptics::descriptor::{LONGEST, parse};
use crate::haptics::device::Identity;
use crate::haptics::port::{InputReport, Port, PortError};
use crate::say;

/// The longest input report that is read, with its id.
const MOST_BYTES: usize = 4096;

/// A device that can be opened: one interface of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Found {
    pub(super) identity: Identity,
    path: CString,
}

/// Why a device cannot be used.
#[derive(Debug, thiserror::Error)]
pub(super) enum OpenError {
    /// The system has no HID interface, or does not list devices.
    #[error("{}", say!("app-devices-not-listed", error = .0.to_string()))]
    System(HidError),
    /// It is there, but cannot be opened.
    #[error("{}", say!("app-device-not-opened", name = .name, error = .error.to_string()))]
    Device {
        /// What it calls itself.
        name: String,
        /// What the system says.
        error: HidError,
    },
    /// Haply's service is not there.
    #[error("{}", say!("app-haply-not-there", address = *.address, error = .error.to_string()))]
    Haply {
        /// Where it should be.
        address: &'static str,
        /// What the system says.
        error: std::io::Error,
    },
    /// It is there, and has no arm.
    #[error("{}", say!("app-haply-no-arm"))]
    HaplyArm,
}

/// Devices that have axes: those that others own, keyboards and mice, are left out.
///
/// # Errors
/// When the system does not list them.
pub(super) fn find() -> Result<Vec<Found>, OpenError> {
    let api = HidApi::new().map_err(OpenError::System)?;
    let mut found: Vec<_> = api
        .device_list()
        .filter(|info| !(info.usage_page() == 1 && matches!(info.usage(), 2 | 6 | 7)))
        .map(|info| {
            let (vendor, product) = (info.vendor_id(), info.product_id());
            let name = info.product_string().filter(|name| !name.is_empty()).map(str::to_owned);
            let name = name.unwrap_or_else(|| format!("{vendor:04X}:{product:04X}"));
            Found { identity: Identity { vendor, product, name }, path: info.path().to_owned() }
        })
        .collect();
    // A device is listed once for each collection at its top.
    found.sort_by(|a, b| (&a.identity.name, &a.path).cmp(&(&b.identity.name, &b.path)));
    found.dedup_by(|a, b| a.path == b.path);
    Ok(found)
}

/// A device that is open.
pub(super) struct HidPort {
    device: HidDevice,
    descriptor: Vec<u8>,
    has_ids: bool,
    buffer: Vec<u8>,
}

impl HidPort {
    /// Opens a device that was found.
    ///
    /// # Errors
    /// When the system does not let us.
    pub(super) fn open(found: &Found) -> Result<Self, OpenError> {
        let refused = |error| OpenError::Device { name: found.identity.name.clone(), error };
        let api = HidApi::new().map_err(OpenError::System)?;
        let device = api.open_path(&found.path).map_err(refused)?;
        device.set_blocking_mode(false).map_err(refused)?;
        let mut descriptor = vec![0; LONGEST];
        let length = device.get_report_descriptor(&mut descriptor).map_err(refused)?;
        descriptor.truncate(length);
        // What makes no sense is told by whoever takes it for a device.
        let has_ids = parse(&descriptor).is_ok_and(|model| model.has_ids());
        Ok(Self { device, descriptor, has_ids, buffer: vec![0; MOST_BYTES] })
    }

    fn with_id(id: u8, data: &[u8]) -> Vec<u8> {
        [&[id], data].concat()
    }
}

/// A system call that failed: without the device nothing goes any more, and the system says so by the error of its last call.
fn refused(id: u8, error: &HidError) -> PortError {
    let reason = error.to_string();
    let is_gone = ["No such device", "Input/output error", "not connected"].iter().any(|gone| reason.contains(gone));
    if is_gone { PortError::Gone } else { PortError::Refused { id, reason } }
}

impl Port for HidPort {
    fn descriptor(&self) -> &[u8] {
        &self.descriptor
    }

    fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        self.device.write(&Self::with_id(id, data)).map(drop).map_err(|error| refused(id, &error))
    }

    fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        self.device.send_feature_report(&Self::with_id(id, data)).map_err(|error| refused(id, &error))
    }

    fn get_feature(&mut self, id: u8, bytes: usize) -> Result<Vec<u8>, PortError> {
        let mut data = vec![0; bytes + 1];
        data[0] = id;
        let length = self.device.get_feature_report(&mut data).map_err(|error| refused(id, &error))?;
        data.truncate(length);
        Ok(data)
    }

    fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
        let length = self.device.read(&mut self.buffer).map_err(|error| refused(0, &error))?;
        Ok(match (self.has_ids, &self.buffer[..length]) {
            (_, []) => None,
            (true, [id, data @ ..]) => Some(InputReport { id: *id, data: data.to_vec() }),
            (false, data) => Some(InputReport { id: 0, data: data.to_vec() }),
        })
    }
}
