//! Devices by the system's HID interface, without a C library (hidraw on Linux).
//!
//! On Linux a device can be opened by its user where a udev rule says so; the rule to copy is in `docs/haptics.md`.

use std::ffi::{CStr, CString};

use hidapi::{HidApi, HidDevice, HidError};

use crate::haptics::descriptor::{LONGEST, parse};
use crate::haptics::identity::Identity;
use crate::haptics::joining::JoinedPort;
use crate::haptics::port::{InputReport, Port, PortError};
use crate::say;

/// The longest input report that is read, with its id.
const MAX_BYTES: usize = 4096;

/// A device that can be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Found {
    pub(super) identity: Identity,
    /// Where the system has its interfaces.
    paths: Vec<CString>,
}

/// An interface of a device, or a part of one, as the system lists it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Listed {
    name: String,
    numbers: [u16; 2],
    path: CString,
    /// Which it is of the device's: its number, and the page and number of its usage.
    part: (i32, u16, u16),
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
    let own = api.device_list().filter(|info| !(info.usage_page() == 1 && matches!(info.usage(), 2 | 6 | 7)));
    let listed = own.map(|info| {
        let numbers = [info.vendor_id(), info.product_id()];
        let name = info.product_string().filter(|name| !name.is_empty()).map(str::to_owned);
        let name = name.unwrap_or_else(|| format!("{:04X}:{:04X}", numbers[0], numbers[1]));
        let part = (info.interface_number(), info.usage_page(), info.usage());
        Listed { name, numbers, path: info.path().to_owned(), part }
    });
    Ok(grouped(listed.collect()))
}

/// Devices by what the system lists: what has the same numbers and the same name is of one device, unless the same part is
/// listed twice. Then there are two of a kind, of which nothing says which part is of which: each stands for itself.
fn grouped(mut listed: Vec<Listed>) -> Vec<Found> {
    listed.sort();
    listed.dedup();
    let is_of_one = |a: &Listed, b: &Listed| (&a.name, a.numbers) == (&b.name, b.numbers);
    let mut found = Vec::new();
    for of_one in listed.chunk_by(is_of_one) {
        let [vendor, product] = of_one[0].numbers;
        let identity = Identity { vendor, product, name: of_one[0].name.clone() };
        // A path is listed once for each collection at its top.
        let paths: Vec<CString> = of_one.chunk_by(|a, b| a.path == b.path).map(|of| of[0].path.clone()).collect();
        let mut parts: Vec<_> = of_one.iter().map(|listed| listed.part).collect();
        parts.sort_unstable();
        if parts.windows(2).all(|pair| pair[0] != pair[1]) {
            found.push(Found { identity, paths });
        } else {
            found.extend(paths.into_iter().map(|path| Found { identity: identity.clone(), paths: vec![path] }));
        }
    }
    found
}

/// Opens a device that was found, by the interfaces that are of use.
///
/// # Errors
/// When the system lets us open none of them.
pub(super) fn open(found: &Found) -> Result<JoinedPort<HidPort>, OpenError> {
    let api = HidApi::new().map_err(OpenError::System)?;
    let refused = |error| OpenError::Device { name: found.identity.name.clone(), error };
    let (mut ports, mut why) = (Vec::new(), None);
    for path in &found.paths {
        match HidPort::open(&api, path) {
            Ok(port) => ports.push(port),
            // One that others own may be of no use; a device that is left without a force shows that it has none.
            Err(error) => why = Some(error),
        }
    }
    let joined = JoinedPort::new(&found.identity, ports);
    match (joined, why) {
        // What is left cannot be held: the interface that can is the one that was refused.
        (Some(joined), Some(why)) if !joined.has_axes() => Err(refused(why)),
        (Some(joined), _) => Ok(joined),
        (None, why) => Err(refused(why.unwrap_or(HidError::HidApiErrorEmpty))),
    }
}

/// An interface that is open.
pub(super) struct HidPort {
    device: HidDevice,
    descriptor: Vec<u8>,
    has_ids: bool,
    buffer: Vec<u8>,
}

impl HidPort {
    /// Opens an interface.
    fn open(api: &HidApi, path: &CStr) -> Result<Self, HidError> {
        let device = api.open_path(path)?;
        device.set_blocking_mode(false)?;
        let mut descriptor = vec![0; LONGEST];
        let length = device.get_report_descriptor(&mut descriptor)?;
        descriptor.truncate(length);
        // What makes no sense is told by whoever takes it for a device.
        let has_ids = parse(&descriptor).is_ok_and(|model| model.has_ids());
        Ok(Self { device, descriptor, has_ids, buffer: vec![0; MAX_BYTES] })
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

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(name: &str, path: &str, part: (i32, u16, u16)) -> Listed {
        Listed { name: name.to_owned(), numbers: [0x1209, 0xFFB0], path: CString::new(path).unwrap(), part }
    }

    fn paths(found: &[Found]) -> Vec<Vec<&str>> {
        found.iter().map(|found| found.paths.iter().map(|path| path.to_str().unwrap()).collect()).collect()
    }

    #[test]
    fn what_is_of_one_device_is_listed_once() {
        // As on Linux: a path an interface, listed for each collection at its top.
        let wheel = [
            listed("Wheel", "/dev/hidraw3", (1, 0xFF00, 1)),
            listed("Wheel", "/dev/hidraw2", (0, 1, 4)),
            listed("Wheel", "/dev/hidraw2", (0, 0x0F, 1)),
        ];
        let knob = listed("Knob", "/dev/hidraw7", (0, 1, 8));
        let found = grouped([&wheel[..], std::slice::from_ref(&knob)].concat());
        assert_eq!(paths(&found), [vec!["/dev/hidraw7"], vec!["/dev/hidraw2", "/dev/hidraw3"]]);
        assert_eq!(found[1].identity, Identity { vendor: 0x1209, product: 0xFFB0, name: "Wheel".to_owned() });
        // As on Windows: a path for each collection at the top of an interface.
        let windows = [listed("Wheel", "mi_00&col01", (0, 1, 4)), listed("Wheel", "mi_00&col02", (0, 0x0F, 1))];
        assert_eq!(paths(&grouped(windows.to_vec())), [vec!["mi_00&col01", "mi_00&col02"]]);
        // The same name under other numbers is another device.
        let other = Listed { numbers: [0x1209, 1], ..wheel[0].clone() };
        assert_eq!(grouped([&wheel[..], &[other]].concat()).len(), 2);
    }

    #[test]
    fn of_two_devices_of_a_kind_each_interface_stands_for_itself() {
        let all = [
            listed("Wheel", "a", (0, 1, 4)),
            listed("Wheel", "b", (1, 0xFF00, 1)),
            listed("Wheel", "c", (0, 1, 4)),
            listed("Wheel", "d", (1, 0xFF00, 1)),
        ];
        assert_eq!(paths(&grouped(all.to_vec())), [["a"], ["b"], ["c"], ["d"]]);
    }
}
