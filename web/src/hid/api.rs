//! The parts of WebHID (WICG) that are used. `web-sys` has them behind an unstable flag only.

use js_sys::{Object, Promise, Reflect};
use wasm_bindgen::prelude::*;
use web_sys::{Event, EventTarget};

#[wasm_bindgen]
extern "C" {
    /// `navigator.hid`.
    #[wasm_bindgen(extends = EventTarget)]
    #[derive(Clone)]
    pub(crate) type Hid;

    /// Devices that the user has allowed, one for each interface.
    #[wasm_bindgen(method, js_name = getDevices)]
    pub(crate) fn get_devices(this: &Hid) -> Promise;

    /// Asks the user for one, in the page alone and after a click alone.
    #[wasm_bindgen(method, js_name = requestDevice)]
    pub(crate) fn request_device(this: &Hid, options: &Object) -> Promise;

    /// An interface of a device.
    #[wasm_bindgen(extends = EventTarget)]
    #[derive(Clone, PartialEq)]
    pub(crate) type HidDevice;

    #[wasm_bindgen(method, getter)]
    pub(crate) fn opened(this: &HidDevice) -> bool;

    #[wasm_bindgen(method, getter, js_name = vendorId)]
    pub(crate) fn vendor_id(this: &HidDevice) -> u16;

    #[wasm_bindgen(method, getter, js_name = productId)]
    pub(crate) fn product_id(this: &HidDevice) -> u16;

    #[wasm_bindgen(method, getter, js_name = productName)]
    pub(crate) fn product_name(this: &HidDevice) -> String;

    #[wasm_bindgen(method, getter)]
    pub(crate) fn collections(this: &HidDevice) -> JsValue;

    #[wasm_bindgen(method)]
    pub(crate) fn open(this: &HidDevice) -> Promise;

    #[wasm_bindgen(method)]
    pub(crate) fn close(this: &HidDevice) -> Promise;

    #[wasm_bindgen(method, js_name = sendReport)]
    pub(crate) fn send_report(this: &HidDevice, id: u8, data: &[u8]) -> Promise;

    #[wasm_bindgen(method, js_name = sendFeatureReport)]
    pub(crate) fn send_feature_report(this: &HidDevice, id: u8, data: &[u8]) -> Promise;

    #[wasm_bindgen(method, js_name = receiveFeatureReport)]
    pub(crate) fn receive_feature_report(this: &HidDevice, id: u8) -> Promise;

    /// A report has come.
    #[wasm_bindgen(extends = Event)]
    pub(crate) type HidInputReportEvent;

    #[wasm_bindgen(method, getter, js_name = reportId)]
    pub(crate) fn report_id(this: &HidInputReportEvent) -> u8;

    #[wasm_bindgen(method, getter)]
    pub(crate) fn data(this: &HidInputReportEvent) -> js_sys::DataView;

    /// A device was plugged in or pulled out.
    #[wasm_bindgen(extends = Event)]
    type HidConnectionEvent;

    #[wasm_bindgen(method, getter)]
    fn device(this: &HidConnectionEvent) -> HidDevice;
}

/// Hears of interfaces that are plugged in, or pulled out, until it is dropped.
pub(crate) struct OnConnection {
    hid: Hid,
    name: &'static str,
    hear: Closure<dyn Fn(HidConnectionEvent)>,
}

impl OnConnection {
    /// Hears of "connect" or "disconnect". Where it cannot be heard, the next request that fails says it.
    pub(crate) fn new(hid: &Hid, name: &'static str, hear: impl Fn(HidDevice) + 'static) -> Self {
        let hear = Closure::<dyn Fn(HidConnectionEvent)>::new(move |event: HidConnectionEvent| hear(event.device()));
        let _ = hid.add_event_listener_with_callback(name, hear.as_ref().unchecked_ref());
        Self { hid: hid.clone(), name, hear }
    }
}

impl Drop for OnConnection {
    fn drop(&mut self) {
        // What cannot be removed is not there any more.
        let _ = self.hid.remove_event_listener_with_callback(self.name, self.hear.as_ref().unchecked_ref());
    }
}

/// WebHID, in a page or in a Worker; `None` where the browser has none.
pub(crate) fn hid() -> Option<Hid> {
    let navigator = Reflect::get(&js_sys::global(), &"navigator".into()).ok()?;
    let hid = Reflect::get(&navigator, &"hid".into()).ok()?;
    // A mock is no instance of the browser's own class.
    (hid.is_object()).then(|| hid.unchecked_into())
}

/// A list of devices as a promise had it.
pub(crate) fn devices(list: &JsValue) -> Vec<HidDevice> {
    js_sys::Array::from(list).iter().map(JsCast::unchecked_into).collect()
}

/// A view of bytes, copied.
pub(crate) fn bytes(view: &js_sys::DataView) -> Vec<u8> {
    let (start, length) = (view.byte_offset() as u32, view.byte_length() as u32);
    js_sys::Uint8Array::new_with_byte_offset_and_length(&view.buffer(), start, length).to_vec()
}
