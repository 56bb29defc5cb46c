//! What a browser gives the app: lines to engines in Workers, gamepads, haptic devices, the file dialog, dropped files,
//! downloads.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use lumen::app::{Devices as AppDevices, Gamepad, Listing, Offer, Platform, PlatformEvent, Store, Waker};
use lumen::engine::trial::TrialLink;
use lumen::engine::{Engine, Link, TrialEngine};
use lumen::haptics::service::{DeviceCommand, DeviceStatus};
use lumen::io::Format;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;

use crate::files;
use crate::hid::page::Devices;
use crate::link::WorkerLink;
use crate::store;

/// What a trial's log and a file of settings end in.
const OTHERS: [&str; 2] = ["csv", "json"];

/// The browser as a platform.
pub(crate) struct Browser {
    link: WorkerLink<Engine>,
    trial: WorkerLink<TrialEngine>,
    devices: Devices,
    inbox: Rc<RefCell<VecDeque<PlatformEvent>>>,
    waker: Waker,
}

impl Browser {
    /// Starts the engine, that of the trial when it is needed; `ctx` draws again whenever there is news.
    pub(crate) fn new(ctx: &egui::Context) -> Self {
        let waker = Waker::new(ctx);
        wake_at_gamepad(waker.clone());
        let devices = Devices::new(waker.clone());
        let link = WorkerLink::new(waker.clone());
        let trial = WorkerLink::idle(waker.clone()).with_devices(devices.clone());
        let browser = Self { link, trial, devices, inbox: Rc::default(), waker };
        hear_links(browser.news());
        browser
    }

    /// Where news is put, from wherever it comes.
    fn news(&self) -> impl Fn(PlatformEvent) + Clone + 'static {
        let (inbox, waker) = (Rc::clone(&self.inbox), self.waker.clone());
        move |event| {
            inbox.borrow_mut().push_back(event);
            waker.wake();
        }
    }
}

/// Tells of the link that the page was opened by, and of each that is put into its address later.
fn hear_links(tell: impl Fn(PlatformEvent) + 'static) {
    let Some(window) = web_sys::window() else { return };
    let location = window.location();
    let look = Closure::<dyn Fn()>::new(move || {
        let fragment = location.hash().unwrap_or_default();
        if fragment.len() > 1 {
            tell(PlatformEvent::Linked { fragment });
        }
    });
    let look_now: &js_sys::Function = look.as_ref().unchecked_ref();
    // Where it cannot be heard, a link is followed at the next start.
    let _ = look_now.call0(&JsValue::NULL);
    let _ = window.add_event_listener_with_callback("hashchange", look_now);
    // It lives as long as the page.
    look.forget();
}

/// Draws again when a gamepad is plugged in: until then it is not asked.
fn wake_at_gamepad(waker: Waker) {
    let wake = Closure::<dyn Fn()>::new(move || waker.wake());
    let window = web_sys::window();
    // Where it cannot be heard, the next movement of the pointer finds the gamepad.
    let _ = window.map(|w| w.add_event_listener_with_callback("gamepadconnected", wake.as_ref().unchecked_ref()));
    // It lives as long as the page.
    wake.forget();
}

fn chosen((name, bytes): files::Chosen) -> PlatformEvent {
    match bytes {
        Ok(bytes) => PlatformEvent::Chosen { name, bytes },
        Err(message) => PlatformEvent::Failed { message },
    }
}

/// Makes a download, or says why not.
fn save(name: &str, bytes: &[u8]) -> Result<(), String> {
    files::save(name, bytes).map_err(|_| {
        format!("{name} was not saved: the browser has no memory left for {:.1} MB.", bytes.len() as f64 / 1e6)
    })
}

impl Platform for Browser {
    fn prefers_less_motion(&self) -> bool {
        let window = web_sys::window();
        // Where it cannot be asked, nobody has asked for less.
        let query = window.and_then(|window| window.match_media("(prefers-reduced-motion: reduce)").ok().flatten());
        query.is_some_and(|query| query.matches())
    }

    fn has_attention(&self) -> bool {
        let document = web_sys::window().and_then(|window| window.document());
        // Where it cannot be told, eframe's own word counts.
        document.is_none_or(|document| document.has_focus().unwrap_or(true))
    }

    fn link(&mut self) -> &mut dyn Link {
        &mut self.link
    }

    fn trial(&mut self) -> &mut TrialLink {
        &mut self.trial
    }

    fn enter(&mut self, ctx: &egui::Context) {
        self.waker.enter(ctx);
    }

    fn gamepad(&self) -> Option<Gamepad> {
        crate::gamepad::read()
    }

    fn devices(&mut self) -> Option<&mut dyn AppDevices> {
        Some(self)
    }

    fn store(&mut self) -> Option<&mut dyn Store> {
        Some(self)
    }

    fn address(&self) -> Option<String> {
        let address = web_sys::window()?.location().href().ok()?;
        address.split(['?', '#']).next().map(str::to_owned)
    }

    fn choose_file(&mut self, _: &egui::Context) {
        let news = self.news();
        let tell = news.clone();
        let accept: Vec<String> = Format::OPENED.into_iter().chain(OTHERS).map(|end| format!(".{end}")).collect();
        if files::open(&accept.join(","), move |file| tell(chosen(file))).is_err() {
            news(PlatformEvent::Failed { message: "The browser opened no file dialog.".to_owned() });
        }
    }

    fn read_dropped(&mut self, file: egui::DroppedFileHandle, _: &egui::Context) {
        let news = self.news();
        spawn_local(async move {
            let event = match file.web_file() {
                Some(file) => chosen((file.name(), files::read(file).await)),
                None => PlatformEvent::Failed { message: "What was dropped is no file.".to_owned() },
            };
            news(event);
        });
    }

    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, _: &egui::Context) {
        let event = match save(name, &bytes) {
            Ok(()) => PlatformEvent::Saved { message: format!("{name} was saved.") },
            Err(message) => PlatformEvent::Failed { message },
        };
        self.news()(event);
    }

    fn offer_pair(&mut self, [first, second]: [Offer; 2], _: &egui::Context) {
        let saved = save(&first.name, &first.bytes).and_then(|()| save(&second.name, &second.bytes));
        let event = match saved {
            Ok(()) => PlatformEvent::Saved { message: format!("{} and {} were saved.", first.name, second.name) },
            Err(message) => PlatformEvent::Failed { message },
        };
        self.news()(event);
    }

    fn poll(&mut self) -> Option<PlatformEvent> {
        self.inbox.borrow_mut().pop_front()
    }
}

impl Store for Browser {
    fn text(&self) -> Option<String> {
        store::text()
    }

    fn set_text(&mut self, text: &str) {
        store::set_text(Some(text));
    }

    fn keep_surface(&mut self, name: &str, bytes: &[u8]) {
        store::keep_surface(name, bytes, self.news());
    }

    fn restore_surface(&mut self) {
        store::restore_surface(self.news());
    }

    fn forget_surface(&mut self) {
        store::forget_surface(self.news());
    }

    fn forget(&mut self) {
        store::set_text(None);
        store::forget_surface(self.news());
    }
}

impl AppDevices for Browser {
    fn look(&mut self) -> (Vec<String>, Option<String>) {
        let Listing { names, problem, .. } = self.devices.listing();
        (names, problem)
    }

    fn changed(&mut self) -> Option<Listing> {
        self.devices.changed()
    }

    fn choose(&mut self, number: Option<usize>) {
        // It is served beside the trial's engine.
        if number.is_some() && !self.trial.has_begun() {
            self.trial.restart();
        }
        self.devices.choose(number);
    }

    fn ask(&mut self, command: DeviceCommand) {
        self.devices.ask(command);
    }

    fn status(&self) -> Option<DeviceStatus> {
        self.devices.status()
    }
}
