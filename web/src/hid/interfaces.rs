//! A paired device that is open: the interface by which it is held and, where that is another, the one that takes its forces
//! ([`lumen::haptics::joining`]). In the Worker that serves it, or in the page in its place.

use js_sys::{Array, Promise};
use lumen::haptics::device::HapticDevice;
use lumen::haptics::force::Request;
use lumen::haptics::identity::Identity;
use lumen::haptics::joining::{Parts, parts};
use lumen::haptics::model::DeviceModel;
use lumen::haptics::webhid::{self, CollectionInfo};
use lumen::language::Key;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise};

use super::api::{self, Hid, HidDevice, HidInputReportEvent};
use super::timers::slept;
use super::{Answer, Choice};

pub(crate) const NOT_THERE: Key = Key("devices-not-there");
pub(crate) const NO_TIMER: Key = Key("devices-no-timer");
pub(crate) const NO_MODEL: Key = Key("devices-no-axis");
pub(crate) const NOT_OPENED: Key = Key("devices-not-opened");

/// For how long a device is waited for that does not take what it is told last, in ms.
const FAREWELL_MS: i32 = 250;

/// What the browser tells of the reports of the interface that is held, and of another that takes forces.
pub(crate) type Collections = (String, Option<String>);

/// The interfaces of a device that are used, open or not.
#[derive(Clone)]
pub(crate) struct Interfaces {
    axes: HidDevice,
    force: Option<HidDevice>,
}

/// Hears a device's reports until it is dropped: the browser keeps the device, and one that is served again is the same.
pub(crate) struct Input {
    device: HidDevice,
    hear: Closure<dyn Fn(HidInputReportEvent)>,
}

impl Drop for Input {
    fn drop(&mut self) {
        // What cannot be removed is not there any more.
        let _ = self.device.remove_event_listener_with_callback("inputreport", self.hear.as_ref().unchecked_ref());
    }
}

impl Interfaces {
    /// Those of a device that is there, with what the browser tells of their reports.
    ///
    /// # Errors
    ///
    /// When there is no such device, or none of its interfaces has axes.
    pub(crate) async fn find(hid: &Hid, identity: &Identity) -> Result<(Self, Collections), Key> {
        let list = JsFuture::from(hid.get_devices()).await.map_err(|_| NOT_THERE)?;
        let is_it = |device: &HidDevice| Choice::of(device).identity() == *identity;
        let devices: Vec<HidDevice> = api::devices(&list).into_iter().filter(is_it).collect();
        if devices.is_empty() {
            return Err(NOT_THERE);
        }
        // What cannot be read has neither axes nor a force.
        let told: Vec<String> = devices.iter().map(|device| collections(device).unwrap_or_default()).collect();
        let models: Vec<DeviceModel> = told.iter().map(|told| model(told).unwrap_or_default()).collect();
        let Parts { axes, force } = parts(identity, &models).ok_or(NO_MODEL)?;
        let found = Self { axes: devices[axes].clone(), force: force.map(|force| devices[force].clone()) };
        Ok((found, (told[axes].clone(), force.map(|force| told[force].clone()))))
    }

    fn all(&self) -> impl Iterator<Item = &HidDevice> {
        std::iter::once(&self.axes).chain(&self.force)
    }

    /// Whether an interface is among them.
    pub(crate) fn have(&self, device: &HidDevice) -> bool {
        self.all().any(|of| of == device)
    }

    /// Opens them, and lets `hear` hear the ids and bytes of input reports from then on.
    ///
    /// # Errors
    ///
    /// When the browser does not: another program has it, or this user may not.
    pub(crate) async fn open(&self, hear: impl Fn(u8, Vec<u8>) + 'static) -> Result<Input, Key> {
        match self.opened().await.and_then(|()| self.heard(hear)) {
            Ok(input) => Ok(input),
            Err(_) => {
                // One of two would stay open.
                self.close(Vec::new()).await;
                Err(NOT_OPENED)
            }
        }
    }

    async fn opened(&self) -> Result<(), JsValue> {
        for device in self.all().filter(|device| !device.opened()) {
            JsFuture::from(device.open()).await?;
        }
        Ok(())
    }

    fn heard(&self, hear: impl Fn(u8, Vec<u8>) + 'static) -> Result<Input, JsValue> {
        let hear = Closure::<dyn Fn(HidInputReportEvent)>::new(move |event: HidInputReportEvent| {
            hear(event.report_id(), api::bytes(&event.data()));
        });
        self.axes.add_event_listener_with_callback("inputreport", hear.as_ref().unchecked_ref())?;
        Ok(Input { device: self.axes.clone(), hear })
    }

    /// Carries a request out.
    pub(crate) async fn carry_out(&self, request: &Request) -> Answer {
        let device = self.takes_forces();
        let asked = match request {
            Request::Send { id, data } => device.send_report(*id, data),
            Request::SetFeature { id, data } => device.send_feature_report(*id, data),
            Request::GetFeature { id, .. } => device.receive_feature_report(*id),
        };
        match (JsFuture::from(asked).await, request) {
            (Err(_), _) => Answer::Failed,
            (Ok(data), Request::GetFeature { .. }) => Answer::Got(api::bytes(data.unchecked_ref())),
            (Ok(_), _) => Answer::Done,
        }
    }

    /// The interface that requests go to.
    fn takes_forces(&self) -> &HidDevice {
        self.force.as_ref().unwrap_or(&self.axes)
    }

    /// Leaves the device with these as its last.
    pub(crate) async fn close(&self, farewell: Vec<Request>) {
        // One that was pulled out is closed already, and hears nothing; its motors end by themselves.
        if self.takes_forces().opened() {
            let device = self.clone();
            let said = future_to_promise(async move {
                for request in &farewell {
                    // It may be pulled out meanwhile.
                    let _ = device.carry_out(request).await;
                }
                Ok(JsValue::UNDEFINED)
            });
            let _ = JsFuture::from(Promise::race(&Array::of2(&said, &slept(FAREWELL_MS)))).await;
        }
        for device in self.all() {
            let _ = JsFuture::from(device.close()).await;
        }
    }
}

fn collections(device: &HidDevice) -> Option<String> {
    js_sys::JSON::stringify(&device.collections()).ok()?.as_string()
}

fn model(told: &str) -> Option<DeviceModel> {
    let collections: Vec<CollectionInfo> = serde_json::from_str(told).ok()?;
    webhid::model(&collections).ok()
}

/// The device of which the browser tells this.
pub(crate) fn device(identity: &Identity, (axes, force): &Collections) -> Option<HapticDevice> {
    let device = HapticDevice::new(identity.clone(), model(axes)?).known_by(axes.as_bytes());
    Some(match force {
        Some(force) => device.with_force_by(model(force)?),
        None => device,
    })
}
