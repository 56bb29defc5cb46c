//! The Worker's end of a device on a serial line. What such a device says of itself is asked for first; then its frames are
//! taken in as they come, and requests go out as frames ([`Talk`]).

use std::rc::Rc;

use js_sys::{Array, Promise};
use lumen::haptics::device::HapticDevice;
use lumen::haptics::force::Request;
use lumen::haptics::framing::Decoder;
use lumen::haptics::identity::Identity;
use lumen::haptics::serial::{Hello, framed};
use lumen::haptics::service::Service;
use lumen::language::Key;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::talk::{ANSWER_MS, Talk};
use super::{Hands, Line, NO_MODEL, NO_TIMER, NOT_OPENED, NOT_THERE, Served};
use crate::hid::port::{self, Port, Serial, SerialPort};
use crate::hid::timers::slept;

/// How often a port is opened, and a piece asked for, before it is given up.
const TRIES: u32 = 4;

const NO_SERIAL: Key = Key("devices-no-serial-in-worker");
const NO_ANSWER: Key = Key("devices-no-answer");

/// Whether the port has taken a request.
async fn written(port: &Port, request: &Request) -> bool {
    match framed(request) {
        Some(bytes) => JsFuture::from(port.write(&bytes)).await.is_ok(),
        None => false,
    }
}

impl Hands {
    /// Opens the port of a device and serves it.
    pub(super) async fn open_serial(&self, identity: &Identity, number: u32) -> Result<(), Key> {
        let serial = port::serial().ok_or(NO_SERIAL)?;
        let port = Rc::new(self.opened(&serial, identity).await?);
        let begun = match self.greeted(&port).await {
            // Another was chosen meanwhile.
            _ if self.0.number.get() != number => Err(NOT_OPENED),
            Ok((descriptor, read)) => self.begin_serial(identity, &descriptor, &port).map(|()| read),
            Err(why) => Err(why),
        };
        match begun {
            Ok(read) => {
                spawn_local(self.clone().follow(port, read, number, identity.name.clone()));
                Ok(())
            }
            Err(why) => {
                port.close().await;
                Err(why)
            }
        }
    }

    /// Opens the port, which may have been plugged in a moment ago: this Worker hears of it later than the page, and a program
    /// that looks for modems may hold it.
    async fn opened(&self, serial: &Serial, identity: &Identity) -> Result<Port, Key> {
        let is_it = |found: &SerialPort| port::numbers(found) == Some([identity.vendor, identity.product]);
        let mut why = NOT_THERE;
        for _ in 0..TRIES {
            let list = JsFuture::from(serial.get_ports()).await.map_err(|_| NOT_THERE)?;
            if let Some(found) = port::ports(&list).into_iter().find(is_it) {
                match Port::open(found).await {
                    Ok(port) => return Ok(port),
                    Err(_) => why = NOT_OPENED,
                }
            }
            // It cannot fail, and what matters is that it takes time.
            let _ = JsFuture::from(slept(ANSWER_MS as i32)).await;
        }
        Err(why)
    }

    /// The device's descriptor, and the read that is under way.
    async fn greeted(&self, port: &Port) -> Result<(Vec<u8>, Promise), Key> {
        let (mut decoder, mut hello) = (Decoder::new(), Hello::default());
        let (mut asked_ms, mut tries) = (f64::NEG_INFINITY, 0);
        let mut read = port.read();
        loop {
            let now = self.now_ms();
            if now - asked_ms >= ANSWER_MS {
                if tries == TRIES {
                    return Err(NO_ANSWER);
                }
                (asked_ms, tries) = (now, tries + 1);
                JsFuture::from(port.write(&hello.ask())).await.map_err(|_| NOT_THERE)?;
            }
            let first = Promise::race(&Array::of2(&read, &slept(ANSWER_MS as i32)));
            let first = JsFuture::from(first).await.map_err(|_| NOT_THERE)?;
            if first.is_undefined() {
                continue;
            }
            let bytes = port::bytes(&first).ok_or(NOT_THERE)?;
            read = port.read();
            for byte in bytes {
                if decoder.take(byte).is_some_and(|frame| hello.take(&frame)) {
                    if let Some(descriptor) = hello.whole() {
                        return Ok((descriptor.to_vec(), read));
                    }
                    (asked_ms, tries) = (f64::NEG_INFINITY, 0);
                }
            }
        }
    }

    fn begin_serial(&self, identity: &Identity, descriptor: &[u8], port: &Rc<Port>) -> Result<(), Key> {
        let device = HapticDevice::from_descriptor(identity.clone(), descriptor).map_err(|_| NO_MODEL)?;
        if device.controls().axes.is_empty() {
            return Err(NO_MODEL);
        }
        self.begin(Service::new(device), Line::Serial(Talk::new(Rc::clone(port)))).map_err(|_| NO_TIMER)
    }

    /// Takes in what comes until the port is closed, or gone.
    async fn follow(self, port: Rc<Port>, mut read: Promise, number: u32, name: String) {
        let mut decoder = Decoder::new();
        loop {
            let read_now = JsFuture::from(read).await;
            if self.0.number.get() != number {
                return;
            }
            match read_now.map(|read| port::bytes(&read)) {
                Ok(Some(bytes)) => self.take(&mut decoder, &bytes),
                // Some bytes were lost.
                Err(_) if port.reads_on() => {}
                Ok(None) | Err(_) => {
                    self.end(&name, NOT_THERE.say());
                    return;
                }
            }
            read = port.read();
        }
    }

    fn take(&self, decoder: &mut Decoder, bytes: &[u8]) {
        let now = self.now_ms();
        if let Some(Served { service, line: Line::Serial(talk), .. }) = &mut *self.0.served.borrow_mut() {
            for &byte in bytes {
                if let Some(frame) = decoder.take(byte) {
                    talk.heard(now, &frame, service.device_mut());
                }
            }
        }
        self.look();
    }

    /// Sends a request; the next goes when it is done.
    pub(super) fn ask_serial(&self, port: Rc<Port>, request: Request) {
        let (hands, number) = (self.clone(), self.0.number.get());
        spawn_local(async move {
            let is_written = written(&port, &request).await;
            if hands.0.number.get() != number {
                return;
            }
            let now = hands.now_ms();
            if let Some(Served { service, line: Line::Serial(talk), .. }) = &mut *hands.0.served.borrow_mut() {
                talk.written(now, &request, is_written, service.device_mut());
            }
            hands.look();
        });
    }
}
