//! The Worker's end of a haptic device: opens it, takes its reports in, sends those that are due, and is the hand at the other
//! side of the engine's [`HapticChannel`].
//!
//! A report that comes is taken in and answered at once; a timer looks after the device while it is silent. One request is
//! under way at a time, as devices want it. Devices on a serial line are [`serial`]'s. Where the browser has no WebHID in
//! Workers the page opens the device, and reports and requests are messages; all else is the same.

mod serial;
mod talk;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use lumen::engine::trial::HapticChannel;
use lumen::haptics::device::HapticDevice;
use lumen::haptics::feeder;
use lumen::haptics::force::Request;
use lumen::haptics::identity::Identity;
use lumen::haptics::port::{Port as _, carry_out};
use lumen::haptics::safety::STALE_MS;
use lumen::haptics::service::{DeviceStatus, Service};
use lumen::haptics::virtual_feeder::VirtualFeeder;
use lumen::language::Key;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::DedicatedWorkerGlobalScope;

use self::talk::Talk;
use super::api::{self, Hid, HidDevice, OnConnection};
use super::interfaces::{self, Collections, Input, Interfaces, NO_MODEL, NO_TIMER, NOT_OPENED, NOT_THERE};
use super::timers::Interval;
use super::turns::Turns;
use super::{Answer, Asked, Choice, Relay, Relayed, Told};

/// Between two looks at a device that is silent, in ms: as short as a browser's timer goes.
const LOOK_MS: i32 = 4;
/// Between two times that the page is told how the device is, in ms.
const TELL_MS: f64 = 50.0;
/// Requests of the virtual device that are carried out in a look at most.
const REQUESTS: usize = 4;
/// For how long what a page hands on that has hung is of the past, in ms.
const BURST_MS: f64 = 20.0;

/// The hand at the engine's side.
#[derive(Clone)]
pub(crate) struct Hands(Rc<Inner>);

struct Inner {
    scope: DedicatedWorkerGlobalScope,
    exchange: HapticChannel,
    /// Brings the engine back: a wire at rest waits for no clock.
    wake: Box<dyn Fn()>,
    served: RefCell<Option<Served>>,
    /// What is to be served, whether it is there or not.
    wanted: RefCell<Option<Choice>>,
    /// Counts those that were asked for: what comes late of one before is let go.
    number: Cell<u32>,
    /// The number of the one that is being opened.
    opening: Cell<Option<u32>>,
    /// Whether it was asked for once more meanwhile: an interface of it has come.
    again: Cell<bool>,
    turns: Turns,
    /// Looks after the device again and again.
    look: RefCell<Option<Interval>>,
    /// Hear that a device is pulled out, and plugged in.
    connections: RefCell<Option<[OnConnection; 2]>>,
}

/// A device that is served.
struct Served {
    service: Service,
    line: Line,
    looked_ms: f64,
    told_ms: f64,
}

enum Line {
    Virtual(Box<VirtualFeeder>),
    Device {
        device: Interfaces,
        is_asking: bool,
        _input: Input,
    },
    /// Opened in the page.
    Relayed {
        is_asking: bool,
        /// When the page was heard of, and from when on what its device's hand does moves the wire, in ms.
        heard_ms: f64,
        moves_from_ms: f64,
    },
    Serial(Talk),
}

impl Hands {
    /// Of the Worker `scope`, at the other side of `exchange`; `wake` brings the engine back.
    pub(crate) fn new(scope: DedicatedWorkerGlobalScope, exchange: HapticChannel, wake: impl Fn() + 'static) -> Self {
        Self(Rc::new(Inner {
            scope,
            exchange,
            wake: Box::new(wake),
            served: RefCell::default(),
            wanted: RefCell::default(),
            number: Cell::new(0),
            opening: Cell::new(None),
            again: Cell::new(false),
            turns: Turns::default(),
            look: RefCell::default(),
            connections: RefCell::default(),
        }))
    }

    /// Hears what the page asks.
    ///
    /// # Errors
    ///
    /// When it is nothing of the kind, or the browser gives no timer.
    pub(crate) fn hear(&self, line: &str) -> Result<(), JsValue> {
        match serde_json::from_str(line).map_err(|error| JsValue::from(error.to_string()))? {
            Asked::Serve(choice) => self.serve(choice),
            Asked::Command(command) => {
                if let Some(served) = &mut *self.0.served.borrow_mut() {
                    served.service.handle(command);
                    served.told_ms = f64::NEG_INFINITY;
                }
                self.look();
                Ok(())
            }
            Asked::Relayed(number, relayed) => {
                self.hear_relayed(number, relayed);
                Ok(())
            }
        }
    }

    fn now_ms(&self) -> f64 {
        self.0.scope.performance().map_or(0.0, |clock| clock.now())
    }

    fn serve(&self, choice: Option<Choice>) -> Result<(), JsValue> {
        // Page and Worker both hear that a device is plugged in again: it is opened once.
        let is_under_way = self.0.served.borrow().is_some() || self.0.opening.get() == Some(self.0.number.get());
        if choice.is_some() && *self.0.wanted.borrow() == choice && is_under_way {
            self.0.again.set(true);
            return Ok(());
        }
        self.0.again.set(false);
        self.release();
        self.0.wanted.replace(choice.clone());
        let number = self.0.number.get() + 1;
        self.0.number.set(number);
        match choice {
            None => {
                self.tell(None);
                Ok(())
            }
            Some(Choice::Virtual) => {
                let device = HapticDevice::from_descriptor(Choice::Virtual.identity(), feeder::DESCRIPTOR);
                let device = device.map_err(|error| JsValue::from(error.to_string()))?;
                self.begin(Service::new(device).with_virtual_hand(), Line::Virtual(Box::default()))
            }
            Some(choice @ Choice::Paired { .. }) if api::hid().is_none() => {
                // Until the page says what became of it.
                self.0.opening.set(Some(number));
                self.say(&Told::Relay(number, Relay::Open(choice)));
                Ok(())
            }
            Some(choice) => {
                let (hands, identity) = (self.clone(), choice.identity());
                self.0.opening.set(Some(number));
                let is_serial = matches!(choice, Choice::Serial { .. });
                let attempt = async move {
                    let is_wanted = || hands.0.number.get() == number;
                    let opened = if !is_wanted() {
                        // Another was chosen before it was its turn.
                        Ok(())
                    } else if is_serial {
                        hands.open_serial(&identity, number).await
                    } else {
                        hands.open(&identity, number).await
                    };
                    if hands.0.opening.get() == Some(number) {
                        hands.0.opening.set(None);
                    }
                    match opened {
                        _ if !is_wanted() => {}
                        Ok(()) if hands.0.again.take() => hands.take_force_up(),
                        Ok(()) => {}
                        Err(why) => hands.failed(&identity.name, why.say()),
                    }
                };
                // A port that is asked who is there takes its time, and is its own.
                if is_serial {
                    spawn_local(attempt);
                } else {
                    self.0.turns.next(attempt);
                }
                Ok(())
            }
        }
    }

    /// Opens a paired device and serves it.
    async fn open(&self, identity: &Identity, number: u32) -> Result<(), Key> {
        let hid = api::hid().ok_or(NOT_THERE)?;
        self.hear_connections(&hid);
        let (device, told) = Interfaces::find(&hid, identity).await?;
        let haptic = interfaces::device(identity, &told).ok_or(NO_MODEL)?;
        let hands = self.clone();
        let input = device.open(move |id, data| hands.take_input(hands.now_ms(), id, &data)).await?;
        if self.0.number.get() != number {
            // Another was chosen meanwhile.
            device.close(Vec::new()).await;
            return Ok(());
        }
        let line = Line::Device { device, is_asking: false, _input: input };
        self.begin(Service::new(haptic), line).map_err(|_| NO_TIMER)
    }

    /// Takes an input report in, and answers it.
    fn take_input(&self, at_ms: f64, id: u8, data: &[u8]) {
        if let Some(served) = &mut *self.0.served.borrow_mut() {
            served.service.device_mut().input(at_ms, id, data);
        }
        self.look();
    }

    /// What the page hands on of the device that it opens under this number; what is of one before is let go.
    fn hear_relayed(&self, number: u32, relayed: Relayed) {
        if self.0.number.get() != number {
            return;
        }
        let Some(identity) = self.0.wanted.borrow().as_ref().map(Choice::identity) else { return };
        let now = self.now_ms();
        if let Some(Served { line: Line::Relayed { heard_ms, moves_from_ms, .. }, .. }) =
            &mut *self.0.served.borrow_mut()
        {
            // What the hand did while the page hung comes now, all at once, and is over.
            if now - *heard_ms > STALE_MS {
                *moves_from_ms = now + BURST_MS;
            }
            *heard_ms = now;
        }
        match relayed {
            Relayed::Opened(axes, force) => {
                self.0.opening.set(None);
                if let Err(why) = self.begin_relayed(&identity, &(axes, force)) {
                    self.say(&Told::Relay(number, Relay::Close(Vec::new())));
                    self.end(&identity.name, why.say());
                }
            }
            Relayed::Ended(why) if self.0.opening.take().is_some() => self.failed(&identity.name, why),
            Relayed::Ended(why) => self.end(&identity.name, why),
            Relayed::Input { at_ms, id, data } => {
                // Both ends have the machine's clock, each from its own beginning.
                let began = self.0.scope.performance().map_or(0.0, |clock| clock.time_origin());
                self.take_input((at_ms - began).min(now), id, &data);
            }
            Relayed::Answer(answer) => self.answered(&answer),
            Relayed::Beat => {}
        }
    }

    fn begin_relayed(&self, identity: &Identity, told: &Collections) -> Result<(), Key> {
        let haptic = interfaces::device(identity, told).ok_or(NO_MODEL)?;
        let now = self.now_ms();
        self.begin(Service::new(haptic), Line::Relayed { is_asking: false, heard_ms: now, moves_from_ms: now })
            .map_err(|_| NO_TIMER)
    }

    fn hear_connections(&self, hid: &Hid) {
        let mut connections = self.0.connections.borrow_mut();
        if connections.is_some() {
            return;
        }
        let hands = self.clone();
        let plugged = OnConnection::new(hid, "connect", move |interface| hands.plugged_in(&interface));
        let hands = self.clone();
        let unplugged = OnConnection::new(hid, "disconnect", move |interface| {
            let name = match &*hands.0.served.borrow() {
                Some(Served { service, line: Line::Device { device, .. }, .. }) if device.have(&interface) => {
                    service.status().name
                }
                _ => return,
            };
            hands.end(&name, NOT_THERE.say());
        });
        *connections = Some([plugged, unplugged]);
    }

    /// An interface was plugged in: of what is to be served and is not there, or is without the one that takes its forces.
    fn plugged_in(&self, interface: &HidDevice) {
        let wanted = self.0.wanted.borrow().clone();
        if wanted != Some(Choice::of(interface)) {
            return;
        }
        if self.0.served.borrow().is_some() {
            self.take_force_up();
        } else {
            // To serve a paired device is asked for, and takes no answer.
            let _ = self.serve(wanted);
        }
    }

    /// Serves a device without a force anew, where one of its interfaces that are there now takes forces.
    fn take_force_up(&self) {
        let hands = self.clone();
        self.0.turns.next(async move {
            let identity = match &*hands.0.served.borrow() {
                Some(Served { service, line: Line::Device { .. }, .. }) if !service.status().has_force => {
                    hands.0.wanted.borrow().as_ref().map(Choice::identity)
                }
                _ => None,
            };
            let (Some(hid), Some(identity), number) = (api::hid(), identity, hands.0.number.get()) else { return };
            let found = Interfaces::find(&hid, &identity).await.ok();
            let device = found.and_then(|(_, told)| interfaces::device(&identity, &told));
            let has_force = device.is_some_and(|device| device.has_force());
            if has_force && hands.0.number.get() == number && hands.0.served.borrow().is_some() {
                let wanted = hands.0.wanted.borrow().clone();
                hands.release();
                // As in `plugged_in`.
                let _ = hands.serve(wanted);
            }
        });
    }

    fn begin(&self, service: Service, line: Line) -> Result<(), JsValue> {
        let now = self.now_ms();
        *self.0.served.borrow_mut() = Some(Served { service, line, looked_ms: now, told_ms: f64::NEG_INFINITY });
        let hands = self.clone();
        *self.0.look.borrow_mut() = Some(Interval::new(LOOK_MS, move || hands.look())?);
        self.look();
        // A hand that takes hold of a wire at rest is no command.
        (self.0.wake)();
        Ok(())
    }

    /// Takes over what the hand did, says what it feels, and sends what is due.
    fn look(&self) {
        let now = self.now_ms();
        let mut served = self.0.served.borrow_mut();
        let Some(Served { service, line, looked_ms, told_ms }) = &mut *served else { return };
        let passed_s = (now - std::mem::replace(looked_ms, now)) / 1000.0;
        if let Line::Virtual(feeder) = line {
            feeder.keep_pace(now, service.wanted());
            // It is never pulled out.
            while let Ok(Some(report)) = feeder.poll() {
                service.device_mut().input(now, report.id, &report.data);
            }
        }
        let moved = service.advance(passed_s);
        let is_heard = match line {
            // A page that hangs does not hear its device: a hand that was pushing may have let go.
            Line::Relayed { heard_ms, moves_from_ms, .. } => now - *heard_ms <= STALE_MS && now >= *moves_from_ms,
            Line::Virtual(_) | Line::Device { .. } | Line::Serial(_) => true,
        };
        if is_heard {
            self.0.exchange.moves(moved);
        }
        service.feel(now, self.0.exchange.feels().map(|feels| (feels.felt, feels.stiffness)));
        match line {
            Line::Virtual(feeder) => {
                for _ in 0..REQUESTS {
                    let device = service.device_mut();
                    let Some(request) = device.next(now) else { break };
                    if carry_out(&mut **feeder, &request, |reply| device.reply(now, reply)).is_err() {
                        break;
                    }
                }
            }
            Line::Device { device, is_asking, .. } if !*is_asking => {
                if let Some(request) = service.device_mut().next(now) {
                    *is_asking = true;
                    self.ask(device.clone(), request);
                }
            }
            Line::Relayed { is_asking, .. } if !*is_asking => {
                if let Some(request) = service.device_mut().next(now) {
                    *is_asking = true;
                    self.say(&Told::Relay(self.0.number.get(), Relay::Carry(request)));
                }
            }
            Line::Device { .. } | Line::Relayed { .. } => {}
            Line::Serial(talk) => {
                if let Some(request) = talk.next(now, service.device_mut()) {
                    self.ask_serial(talk.port(), request);
                }
            }
        }
        if now - *told_ms >= TELL_MS {
            *told_ms = now;
            let status = service.status();
            drop(served);
            self.tell(Some(status));
        }
    }

    /// Carries a request out; the next goes when it is done.
    fn ask(&self, device: Interfaces, request: Request) {
        let (hands, number) = (self.clone(), self.0.number.get());
        spawn_local(async move {
            let answer = device.carry_out(&request).await;
            if hands.0.number.get() == number {
                hands.answered(&answer);
            }
        });
    }

    /// How the request that was under way went.
    fn answered(&self, answer: &Answer) {
        let now = self.now_ms();
        if let Some(served) = &mut *self.0.served.borrow_mut() {
            if let Line::Device { is_asking, .. } | Line::Relayed { is_asking, .. } = &mut served.line {
                *is_asking = false;
            }
            served.service.device_mut().reply(now, answer.reply());
        }
        self.look();
    }

    /// Stops serving, and leaves the device without a force.
    fn release(&self) {
        *self.0.look.borrow_mut() = None;
        let Some(Served { service: mut of, line, .. }) = self.0.served.take() else {
            let is_relayed = matches!(&*self.0.wanted.borrow(), Some(Choice::Paired { .. })) && api::hid().is_none();
            if is_relayed && self.0.opening.take() == Some(self.0.number.get()) {
                // The page is about to open it.
                self.say(&Told::Relay(self.0.number.get(), Relay::Close(Vec::new())));
            }
            return;
        };
        let farewell = of.device_mut().farewell();
        match line {
            Line::Virtual(_) => {}
            Line::Device { device, .. } => self.0.turns.next(async move { device.close(farewell).await }),
            Line::Relayed { .. } => self.say(&Told::Relay(self.0.number.get(), Relay::Close(farewell))),
            Line::Serial(talk) => talk.close(&farewell),
        }
    }

    /// What was to be opened was not, and why; where an interface of it has come meanwhile it is tried once more.
    fn failed(&self, name: &str, why: String) {
        if self.0.again.take() {
            let wanted = self.0.wanted.borrow().clone();
            // As in `plugged_in`.
            let _ = self.serve(wanted);
        } else {
            self.end(name, why);
        }
    }

    /// The device is no longer served, and why.
    fn end(&self, name: &str, why: String) {
        self.release();
        self.0.number.set(self.0.number.get() + 1);
        self.tell(Some(DeviceStatus { name: name.to_owned(), ended: Some(why), ..DeviceStatus::default() }));
    }

    /// Tells the page how the device is.
    fn tell(&self, status: Option<DeviceStatus>) {
        self.say(&Told::Status(Box::new(status)));
    }

    fn say(&self, told: &Told) {
        // Numbers and short texts: the page that cannot be told is closing.
        if let Ok(line) = serde_json::to_string(told) {
            let _ = self.0.scope.post_message(&JsValue::from_str(&line));
        }
    }
}
