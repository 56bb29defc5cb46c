//! The page's end of haptic devices: which there are, pairing one by a click, and the line to the Worker that serves it.
//!
//! The page's own events end a force at once: what egui hears a frame later would be late. A device that no Worker can open is
//! [`relay`]'s.

mod relay;
mod relayer;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::{Array, Object, Reflect};
use lumen::app::{Listing, Waker};
use lumen::haptics::feeder::USB_IDS;
use lumen::haptics::safety::Halt;
use lumen::haptics::service::{DeviceCommand, DeviceStatus};
use lumen::language::Key;
use lumen::say;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{EventTarget, Worker};

use self::relayer::Relayer;
use super::api::{self, Hid};
use super::port::{self, Serial, object};
use super::turns::Turns;
use super::{Asked, Choice, Told};

/// The name of the choice that asks for a device.
const PAIR: Key = Key("devices-pair");
/// That of the one that asks for a serial port.
const PAIR_SERIAL: Key = Key("devices-pair-serial");
const NO_HID: Key = Key("devices-no-hid");
const ONLY_SERIAL: Key = Key("devices-only-serial");
const NOT_PAIRED: Key = Key("devices-not-paired");

/// What a device that can be held has: the pages and numbers of its outermost usage, or its vendor's number.
const USAGES: [(u16, u16); 5] = [(1, 4), (1, 5), (1, 8), (1, 0x0E), (0x0F, 1)];
const VENDORS: [u16; 5] = [0x1209, 0x045B, 0x046D, 0x256F, 0x0B33];

/// The page's end.
#[derive(Clone)]
pub(crate) struct Devices(Rc<Inner>);

struct Inner {
    hid: Option<Hid>,
    serial: Option<Serial>,
    waker: Waker,
    paired: RefCell<Vec<Choice>>,
    /// What the Worker is to serve.
    wanted: RefCell<Option<Choice>>,
    status: RefCell<Option<DeviceStatus>>,
    problem: Cell<Option<Key>>,
    has_changed: Cell<bool>,
    /// Whether the page was left and the app has not heard of it.
    was_left: Cell<bool>,
    /// The Worker that serves, while it runs.
    worker: RefCell<Option<Worker>>,
    /// The device that the page opens in its place.
    relayer: RefCell<Relayer>,
    turns: Turns,
}

impl Devices {
    /// Finds what is paired already, and hears of what comes and goes.
    pub(crate) fn new(waker: Waker) -> Self {
        let (hid, serial) = (api::hid(), port::serial());
        let problem = match (&hid, &serial) {
            (Some(_), _) => None,
            (None, Some(_)) => Some(ONLY_SERIAL),
            (None, None) => Some(NO_HID),
        };
        let devices = Self(Rc::new(Inner {
            hid,
            serial,
            waker,
            paired: RefCell::default(),
            wanted: RefCell::default(),
            status: RefCell::default(),
            problem: Cell::new(problem),
            has_changed: Cell::new(false),
            was_left: Cell::new(false),
            worker: RefCell::default(),
            relayer: RefCell::default(),
            turns: Turns::default(),
        }));
        devices.find();
        devices.listen();
        devices
    }

    fn listen(&self) {
        let targets: [Option<&EventTarget>; 2] = [self.0.hid.as_deref(), self.0.serial.as_deref()];
        for target in targets.into_iter().flatten() {
            for (name, is_there) in [("connect", true), ("disconnect", false)] {
                let devices = self.clone();
                let hear = Closure::<dyn Fn()>::new(move || {
                    devices.find();
                    if is_there {
                        devices.resume();
                    }
                });
                // Where it cannot be heard, the user looks again.
                let _ = target.add_event_listener_with_callback(name, hear.as_ref().unchecked_ref());
                // It lives as long as the page.
                hear.forget();
            }
        }
        let Some(window) = web_sys::window() else { return };
        let devices = self.clone();
        let end = Closure::<dyn Fn()>::new(move || {
            crate::gamepad::shake(0.0);
            crate::sound::end();
            devices.0.was_left.set(true);
            devices.0.waker.wake();
            // One that was armed a moment ago, and is not told of yet, ends with the app's next look.
            let is_armed = devices.0.status.borrow().as_ref().is_some_and(|status| status.halted.is_none());
            if is_armed {
                devices.ask(DeviceCommand::Halt(Halt::Hidden));
            }
        });
        let callback = end.as_ref().unchecked_ref();
        let _ = window.add_event_listener_with_callback("blur", callback);
        let _ = window.add_event_listener_with_callback("pagehide", callback);
        if let Some(document) = window.document() {
            let _ = document.add_event_listener_with_callback("visibilitychange", callback);
        }
        end.forget();
    }

    /// Lists what is paired, when the browser has told.
    fn find(&self) {
        if self.0.hid.is_none() && self.0.serial.is_none() {
            return;
        }
        let devices = self.clone();
        spawn_local(async move {
            let mut found = Vec::new();
            if let Some(hid) = &devices.0.hid
                && let Ok(list) = JsFuture::from(hid.get_devices()).await
            {
                found.extend(api::devices(&list).iter().map(Choice::of));
            }
            if let Some(serial) = &devices.0.serial
                && let Ok(list) = JsFuture::from(serial.get_ports()).await
            {
                found.extend(port::ports(&list).iter().filter_map(Choice::of_port));
            }
            devices.list(found);
        });
    }

    fn list(&self, found: Vec<Choice>) {
        let mut paired: Vec<Choice> = Vec::new();
        for choice in found {
            // A device has an entry for each of its interfaces.
            if !paired.contains(&choice) {
                paired.push(choice);
            }
        }
        *self.0.paired.borrow_mut() = paired;
        self.change();
    }

    /// Says that the listing is another, if only in its words.
    pub(crate) fn change(&self) {
        self.0.has_changed.set(true);
        self.0.waker.wake();
    }

    /// Serves again what was pulled out and is there again; its force has to be armed anew.
    fn resume(&self) {
        let has_ended = self.0.status.borrow().as_ref().is_some_and(|status| status.ended.is_some());
        if has_ended {
            self.send(&Asked::Serve(self.0.wanted.borrow().clone()));
        }
    }

    fn choices(&self) -> Vec<Choice> {
        std::iter::once(Choice::Virtual).chain(self.0.paired.borrow().iter().cloned()).collect()
    }

    /// What can be chosen now.
    pub(crate) fn listing(&self) -> Listing {
        let choices = self.choices();
        let wanted = self.0.wanted.borrow();
        let chosen = wanted.as_ref().and_then(|wanted| choices.iter().position(|choice| choice == wanted));
        let mut names: Vec<String> = choices.iter().map(name).collect();
        if self.0.hid.is_some() {
            names.push(PAIR.say());
        }
        if self.0.serial.is_some() {
            names.push(PAIR_SERIAL.say());
        }
        Listing { names, problem: self.0.problem.get().map(Key::say), chosen }
    }

    /// Whether the page was left, or hidden, since this was asked last.
    pub(crate) fn was_left(&self) -> bool {
        self.0.was_left.take()
    }

    /// The same, where it has changed since this was asked.
    pub(crate) fn changed(&self) -> Option<Listing> {
        self.0.has_changed.take().then(|| self.listing())
    }

    /// Serves one of the listed ones, or asks the user for one.
    pub(crate) fn choose(&self, number: Option<usize>) {
        let choices = self.choices();
        match number {
            Some(number) if number >= choices.len() => self.pair(self.0.hid.is_none() || number > choices.len()),
            number => self.serve(number.map(|number| choices[number].clone())),
        }
    }

    fn serve(&self, choice: Option<Choice>) {
        self.0.wanted.replace(choice.clone());
        self.0.status.take();
        self.send(&Asked::Serve(choice));
    }

    /// Asks the user for a device, or for a serial port.
    fn pair(&self, by_serial: bool) {
        // Now: the browser asks only while the click is fresh.
        let asked = match (&self.0.hid, &self.0.serial) {
            (Some(hid), _) if !by_serial => hid.request_device(&filters()),
            (_, Some(serial)) if by_serial => serial.request_port(&port_filter()),
            _ => return,
        };
        let devices = self.clone();
        spawn_local(async move {
            match JsFuture::from(asked).await {
                Ok(found) => {
                    devices.0.problem.set(None);
                    let choice = if by_serial {
                        Choice::of_port(found.unchecked_ref())
                    } else {
                        api::devices(&found).first().map(Choice::of)
                    };
                    if let Some(choice) = choice {
                        if !devices.0.paired.borrow().contains(&choice) {
                            devices.0.paired.borrow_mut().push(choice.clone());
                        }
                        devices.serve(Some(choice));
                    }
                }
                // The user has chosen none.
                Err(why) if Reflect::get(&why, &"name".into()).is_ok_and(|name| name == "NotFoundError") => {}
                Err(_) => devices.0.problem.set(Some(NOT_PAIRED)),
            }
            devices.change();
        });
    }

    /// Asks the one that is served for something.
    pub(crate) fn ask(&self, command: DeviceCommand) {
        self.send(&Asked::Command(command));
    }

    /// How the one that is served is.
    pub(crate) fn status(&self) -> Option<DeviceStatus> {
        self.0.status.borrow().clone()
    }

    fn send(&self, asked: &Asked) {
        // Without a Worker nothing is served: one that starts is told what to serve.
        if let (Some(worker), Ok(line)) = (&*self.0.worker.borrow(), serde_json::to_string(asked)) {
            // Short texts: a Worker that does not take them has died, and is heard of as such.
            let _ = worker.post_message(&JsValue::from_str(&line));
        }
    }

    /// A Worker has started, or has ended. What was served goes on in the next, unarmed.
    pub(crate) fn worker(&self, worker: Option<&Worker>) {
        // Whoever had the page open a device is gone; its effects end by themselves.
        self.end_relay(Vec::new());
        self.0.worker.replace(worker.cloned());
        self.0.status.take();
        let wanted = self.0.wanted.borrow().clone();
        if wanted.is_some() {
            self.send(&Asked::Serve(wanted));
        }
    }

    /// Hears how the device is, or what to do with one that the page has opened.
    pub(crate) fn hear(&self, line: &str) {
        // What cannot be read is of another build.
        match serde_json::from_str(line) {
            Ok(Told::Status(status)) => {
                self.0.status.replace(*status);
                self.0.waker.wake();
            }
            Ok(Told::Relay(number, relay)) => self.relay(number, relay),
            Err(_) => {}
        }
    }
}

fn name(choice: &Choice) -> String {
    match choice {
        Choice::Virtual => say!("app-virtual-device"),
        Choice::Serial { .. } => say!("devices-serial-feeder"),
        Choice::Paired { vendor, product, name } if name.is_empty() => {
            say!("devices-unnamed", numbers = format!("{vendor:04X}:{product:04X}"))
        }
        Choice::Paired { name, .. } => name.clone(),
    }
}

/// Which devices the browser offers.
fn filters() -> Object {
    let filter = |entries: [(&str, u16); 2]| object(&entries.map(|(key, value)| (key, JsValue::from(value))));
    let all: Array = USAGES.iter().map(|&(page, usage)| filter([("usagePage", page), ("usage", usage)])).collect();
    VENDORS.iter().for_each(|&vendor| {
        all.push(&object(&[("vendorId", vendor.into())]));
    });
    object(&[("filters", all.into())])
}

/// Which serial ports it offers: the open feeder's.
fn port_filter() -> Object {
    let [vendor, product] = USB_IDS;
    let filter = object(&[("usbVendorId", vendor.into()), ("usbProductId", product.into())]);
    object(&[("filters", Array::of1(&filter).into())])
}
