//! The parts of Web Serial (WICG) that are used, and a port that is open. `web-sys` has them behind an unstable flag only.

use std::cell::RefCell;

use js_sys::{Object, Promise, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::EventTarget;

#[wasm_bindgen]
extern "C" {
    /// `navigator.serial`.
    #[wasm_bindgen(extends = EventTarget)]
    #[derive(Clone)]
    pub(crate) type Serial;

    /// Ports that the user has allowed.
    #[wasm_bindgen(method, js_name = getPorts)]
    pub(crate) fn get_ports(this: &Serial) -> Promise;

    /// Asks the user for one, in the page alone and after a click alone.
    #[wasm_bindgen(method, js_name = requestPort)]
    pub(crate) fn request_port(this: &Serial, options: &Object) -> Promise;

    /// A port.
    #[wasm_bindgen(extends = EventTarget)]
    #[derive(Clone)]
    pub(crate) type SerialPort;

    #[wasm_bindgen(method, js_name = getInfo)]
    fn get_info(this: &SerialPort) -> Object;

    #[wasm_bindgen(method)]
    fn open(this: &SerialPort, options: &Object) -> Promise;

    #[wasm_bindgen(method)]
    fn close(this: &SerialPort) -> Promise;

    #[wasm_bindgen(method, js_name = setSignals)]
    fn set_signals(this: &SerialPort, signals: &Object) -> Promise;

    #[wasm_bindgen(method, getter)]
    fn readable(this: &SerialPort) -> Option<Readable>;

    #[wasm_bindgen(method, getter)]
    fn writable(this: &SerialPort) -> Option<Writable>;

    type Readable;

    #[wasm_bindgen(method, catch, js_name = getReader)]
    fn get_reader(this: &Readable) -> Result<Reader, JsValue>;

    #[derive(Clone)]
    type Reader;

    #[wasm_bindgen(method)]
    fn read(this: &Reader) -> Promise;

    #[wasm_bindgen(method)]
    fn cancel(this: &Reader) -> Promise;

    #[wasm_bindgen(method, catch, js_name = releaseLock)]
    fn release_lock(this: &Reader) -> Result<(), JsValue>;

    type Writable;

    #[wasm_bindgen(method, catch, js_name = getWriter)]
    fn get_writer(this: &Writable) -> Result<Writer, JsValue>;

    type Writer;

    #[wasm_bindgen(method)]
    fn write(this: &Writer, bytes: &Uint8Array) -> Promise;

    #[wasm_bindgen(method, catch, js_name = releaseLock)]
    fn release_lock(this: &Writer) -> Result<(), JsValue>;
}

/// Web Serial, in a page or in a Worker; `None` where the browser has none.
pub(crate) fn serial() -> Option<Serial> {
    let navigator = Reflect::get(&js_sys::global(), &"navigator".into()).ok()?;
    let serial = Reflect::get(&navigator, &"serial".into()).ok()?;
    // A mock is no instance of the browser's own class.
    (serial.is_object()).then(|| serial.unchecked_into())
}

/// A plain object with these entries.
pub(crate) fn object(entries: &[(&str, JsValue)]) -> Object {
    let object = Object::new();
    for (key, value) in entries {
        // A plain object takes any entry.
        let _ = Reflect::set(&object, &JsValue::from_str(key), value);
    }
    object
}

/// A list of ports as a promise had it.
pub(crate) fn ports(list: &JsValue) -> Vec<SerialPort> {
    js_sys::Array::from(list).iter().map(JsCast::unchecked_into).collect()
}

/// The vendor's number and the product's; `None` for a port that is not on the USB.
pub(crate) fn numbers(port: &SerialPort) -> Option<[u16; 2]> {
    let info = port.get_info();
    let number = |key: &str| Some(Reflect::get(&info, &key.into()).ok()?.as_f64()? as u16);
    Some([number("usbVendorId")?, number("usbProductId")?])
}

/// A port that is open.
pub(crate) struct Port {
    port: SerialPort,
    reader: RefCell<Reader>,
    writer: Writer,
}

impl Port {
    /// Opens it, and says to the device that somebody listens.
    ///
    /// # Errors
    ///
    /// What the browser answers: another program holds it, this user may not use it, or it is gone.
    pub(crate) async fn open(port: SerialPort) -> Result<Self, JsValue> {
        // The USB has a speed of its own; this one means nothing.
        JsFuture::from(port.open(&object(&[("baudRate", 115_200.into())]))).await?;
        match Self::opened(port.clone()).await {
            Ok(opened) => Ok(opened),
            Err(why) => {
                // It would stay open, and nobody would read.
                let _ = JsFuture::from(port.close()).await;
                Err(why)
            }
        }
    }

    async fn opened(port: SerialPort) -> Result<Self, JsValue> {
        JsFuture::from(port.set_signals(&object(&[("dataTerminalReady", true.into())]))).await?;
        // The reader last: with it taken the port could not be closed again.
        let writer = port.writable().ok_or("nothing can be written")?.get_writer()?;
        let reader = port.readable().ok_or("nothing can be read").map_err(JsValue::from).and_then(|it| it.get_reader());
        let reader = reader.inspect_err(|_| drop(writer.release_lock()))?;
        Ok(Self { port, reader: RefCell::new(reader), writer })
    }

    /// Writes bytes; resolves once they are taken.
    pub(crate) fn write(&self, bytes: &[u8]) -> Promise {
        self.writer.write(&Uint8Array::from(bytes))
    }

    /// Reads what comes next, which [`bytes`] understands.
    pub(crate) fn read(&self) -> Promise {
        self.reader.borrow().read()
    }

    /// After an error of [`Port::read`]: whether the port goes on, as after bytes that were lost.
    pub(crate) fn reads_on(&self) -> bool {
        let again = self.port.readable().and_then(|readable| {
            // The one before is of no use any more.
            let _ = self.reader.borrow().release_lock();
            readable.get_reader().ok()
        });
        let goes_on = again.is_some();
        if let Some(reader) = again {
            self.reader.replace(reader);
        }
        goes_on
    }

    /// Closes it. One that is unplugged is closed already, and says so at each step.
    pub(crate) async fn close(&self) {
        let reader = self.reader.borrow().clone();
        let _ = JsFuture::from(reader.cancel()).await;
        let _ = reader.release_lock();
        let _ = self.writer.release_lock();
        let _ = JsFuture::from(self.port.close()).await;
    }
}

/// The bytes that a read had; `None` at the end of the port's life.
pub(crate) fn bytes(read: &JsValue) -> Option<Vec<u8>> {
    let value = Reflect::get(read, &"value".into()).ok()?;
    value.dyn_ref::<Uint8Array>().map(Uint8Array::to_vec)
}
