//! The Worker's end of a haptic device: opens it, takes its reports in, sends those that are due, and is the hand at the other
//! side of the engine's [`Exchange`].
//!
//! A report that comes is taken in and answered at once; a timer looks after the device while it is silent. One request is
//! under way at a time, as devices want it. Devices on a serial line are [`serial`]'s.

mod serial;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::DataView;
use lumen::engine::trial::Exchange;
use lumen::haptics::device::{HapticDevice, Identity};
use lumen::haptics::feeder;
use lumen::haptics::force::{Reply, Request};
use lumen::haptics::port::{Port as _, carry_out};
use lumen::haptics::service::{DeviceStatus, Service};
use lumen::haptics::virtual_feeder::VirtualFeeder;
use lumen::haptics::webhid::{self, CollectionInfo};
use lumen::language::Key;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::DedicatedWorkerGlobalScope;

use super::api::{self, Hid, HidConnectionEvent, HidDevice, HidInputReportEvent};
use super::{Asked, Choice, Told};

/// Between two looks at a device that is silent, in ms: as short as a browser's timer goes.
const LOOK_MS: i32 = 4;
/// Between two times that the page is told how the device is, in ms.
const TELL_MS: f64 = 50.0;
/// Requests of the virtual device that are carried out in a look at most.
const REQUESTS: usize = 4;

const NO_HID: Key = Key("devices-no-hid-in-worker");
const NOT_THERE: Key = Key("devices-not-there");
const NO_TIMER: Key = Key("devices-no-timer");
const NO_MODEL: Key = Key("devices-no-axis");
const NOT_OPENED: Key = Key("devices-not-opened");

/// Hears of devices that come and go.
type OnConnection = Closure<dyn Fn(HidConnectionEvent)>;

/// The hand at the engine's side.
#[derive(Clone)]
pub(crate) struct Hands(Rc<Inner>);

struct Inner {
    scope: DedicatedWorkerGlobalScope,
    exchange: Exchange,
    /// Brings the engine back: a wire at rest waits for no clock.
    wake: Box<dyn Fn()>,
    served: RefCell<Option<Served>>,
    /// What is to be served, whether it is there or not.
    wanted: RefCell<Option<Choice>>,
    /// Counts those that were asked for: what comes late of one before is let go.
    number: Cell<u32>,
    /// The number of the one that is being opened.
    opening: Cell<Option<u32>>,
    look: RefCell<Option<Timer>>,
    /// Hear that a device is pulled out, and plugged in.
    connections: RefCell<Option<[OnConnection; 2]>>,
}

/// Looks after the device again and again, until it is dropped.
struct Timer {
    scope: DedicatedWorkerGlobalScope,
    handle: i32,
    _look: Closure<dyn Fn()>,
}

impl Drop for Timer {
    fn drop(&mut self) {
        self.scope.clear_interval_with_handle(self.handle);
    }
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
    Device { device: HidDevice, is_asking: bool, _input: Input },
    Serial(serial::Talk),
}

/// Hears a device's reports until it is dropped: the browser keeps the device, and one that is served again is the same.
struct Input {
    device: HidDevice,
    hear: Closure<dyn Fn(HidInputReportEvent)>,
}

impl Input {
    fn new(device: HidDevice, hear: Closure<dyn Fn(HidInputReportEvent)>) -> Result<Self, JsValue> {
        device.add_event_listener_with_callback("inputreport", hear.as_ref().unchecked_ref())?;
        Ok(Self { device, hear })
    }
}

impl Drop for Input {
    fn drop(&mut self) {
        // What cannot be removed is not there any more.
        let _ = self.device.remove_event_listener_with_callback("inputreport", self.hear.as_ref().unchecked_ref());
    }
}

impl Hands {
    /// Of the Worker `scope`, at the other side of `exchange`; `wake` brings the engine back.
    pub(crate) fn new(scope: DedicatedWorkerGlobalScope, exchange: Exchange, wake: impl Fn() + 'static) -> Self {
        Self(Rc::new(Inner {
            scope,
            exchange,
            wake: Box::new(wake),
            served: RefCell::default(),
            wanted: RefCell::default(),
            number: Cell::new(0),
            opening: Cell::new(None),
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
        }
    }

    fn now_ms(&self) -> f64 {
        self.0.scope.performance().map_or(0.0, |clock| clock.now())
    }

    fn serve(&self, choice: Option<Choice>) -> Result<(), JsValue> {
        // Page and Worker both hear that a device is plugged in again: it is opened once.
        let is_under_way = self.0.served.borrow().is_some() || self.0.opening.get() == Some(self.0.number.get());
        if choice.is_some() && *self.0.wanted.borrow() == choice && is_under_way {
            return Ok(());
        }
        self.0.wanted.replace(choice.clone());
        let number = self.0.number.get() + 1;
        self.0.number.set(number);
        self.let_go();
        match choice {
            None => {
                self.tell(&None);
                Ok(())
            }
            Some(Choice::Virtual) => {
                let device = HapticDevice::from_descriptor(Choice::Virtual.identity(), feeder::DESCRIPTOR);
                let device = device.map_err(|error| JsValue::from(error.to_string()))?;
                self.begin(Service::new(device).with_virtual_hand(), Line::Virtual(Box::default()))
            }
            Some(choice) => {
                let (hands, identity) = (self.clone(), choice.identity());
                self.0.opening.set(Some(number));
                spawn_local(async move {
                    let opened = match choice {
                        Choice::Serial { .. } => hands.open_serial(&identity, number).await,
                        Choice::Virtual | Choice::Paired { .. } => hands.open(&identity, number).await,
                    };
                    if hands.0.opening.get() == Some(number) {
                        hands.0.opening.set(None);
                    }
                    if let Err(why) = opened
                        && hands.0.number.get() == number
                    {
                        hands.end(&identity.name, why);
                    }
                });
                Ok(())
            }
        }
    }

    /// The interface that can be held, opened; a device may have several, and some say nothing of a hand.
    async fn open(&self, identity: &Identity, number: u32) -> Result<(), Key> {
        let hid = api::hid().ok_or(NO_HID)?;
        self.hear_connections(&hid);
        let list = JsFuture::from(hid.get_devices()).await.map_err(|_| NOT_THERE)?;
        let is_it = |device: &HidDevice| {
            device.vendor_id() == identity.vendor
                && device.product_id() == identity.product
                && device.product_name() == identity.name
        };
        let found: Vec<HidDevice> = api::devices(&list).into_iter().filter(is_it).collect();
        if found.is_empty() {
            return Err(NOT_THERE);
        }
        let served = found.into_iter().filter_map(|device| Some((modelled(identity, &device)?, device)));
        // One that can push back goes before one that can only be moved.
        let best = served.max_by_key(|(haptic, _)| haptic.has_force());
        let (haptic, device) = best.ok_or(NO_MODEL)?;
        if !device.opened() {
            JsFuture::from(device.open()).await.map_err(|_| NOT_OPENED)?;
        }
        if self.0.number.get() != number {
            // Another was chosen meanwhile; that it does not close is no harm.
            let _ = JsFuture::from(device.close()).await;
            return Ok(());
        }
        let hands = self.clone();
        let hear = Closure::<dyn Fn(HidInputReportEvent)>::new(move |event: HidInputReportEvent| {
            let now = hands.now_ms();
            if let Some(served) = &mut *hands.0.served.borrow_mut() {
                served.service.device_mut().input(now, event.report_id(), &api::bytes(&event.data()));
            }
            hands.look();
        });
        let input = Input::new(device.clone(), hear).map_err(|_| NOT_OPENED)?;
        let line = Line::Device { device, is_asking: false, _input: input };
        self.begin(Service::new(haptic), line).map_err(|_| NO_TIMER)
    }

    fn hear_connections(&self, hid: &Hid) {
        let mut connections = self.0.connections.borrow_mut();
        if connections.is_some() {
            return;
        }
        let hands = self.clone();
        let plugged = OnConnection::new(move |event: HidConnectionEvent| {
            let wanted = hands.0.wanted.borrow().clone();
            if hands.0.served.borrow().is_none() && wanted == Some(Choice::of(&event.device())) {
                // To serve a paired device is asked for, and takes no answer.
                let _ = hands.serve(wanted);
            }
        });
        let hands = self.clone();
        let unplugged = OnConnection::new(move |event: HidConnectionEvent| {
            let name = match &*hands.0.served.borrow() {
                Some(Served { service, line: Line::Device { device, .. }, .. }) if *device == event.device() => {
                    service.status().name
                }
                _ => return,
            };
            hands.end(&name, NOT_THERE);
        });
        // Where they cannot be heard, the next request that fails says it, and the user looks again.
        let _ = hid.add_event_listener_with_callback("connect", plugged.as_ref().unchecked_ref());
        let _ = hid.add_event_listener_with_callback("disconnect", unplugged.as_ref().unchecked_ref());
        *connections = Some([plugged, unplugged]);
    }

    fn begin(&self, service: Service, line: Line) -> Result<(), JsValue> {
        let now = self.now_ms();
        *self.0.served.borrow_mut() = Some(Served { service, line, looked_ms: now, told_ms: f64::NEG_INFINITY });
        let hands = self.clone();
        let look = Closure::<dyn Fn()>::new(move || hands.look());
        let callback = look.as_ref().unchecked_ref();
        let scope = self.0.scope.clone();
        let handle = scope.set_interval_with_callback_and_timeout_and_arguments_0(callback, LOOK_MS)?;
        *self.0.look.borrow_mut() = Some(Timer { scope, handle, _look: look });
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
        self.0.exchange.moves(service.advance(passed_s));
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
            Line::Device { .. } => {}
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
            self.tell(&Some(status));
        }
    }

    /// Carries a request out; the next goes when it is done.
    fn ask(&self, device: HidDevice, request: Request) {
        let (hands, number) = (self.clone(), self.0.number.get());
        spawn_local(async move {
            let answer = carried_out(&device, &request).await;
            if hands.0.number.get() != number {
                return;
            }
            let now = hands.now_ms();
            if let Some(Served { service, line: Line::Device { is_asking, .. }, .. }) =
                &mut *hands.0.served.borrow_mut()
            {
                *is_asking = false;
                let device = service.device_mut();
                match &answer {
                    Ok(None) => device.reply(now, Reply::Done),
                    Ok(Some(data)) => device.reply(now, Reply::Feature(data)),
                    Err(_) => device.reply(now, Reply::Failed),
                }
            }
            hands.look();
        });
    }

    /// Stops serving, and leaves the device without a force.
    fn let_go(&self) {
        *self.0.look.borrow_mut() = None;
        let Some(Served { service: mut of, line, .. }) = self.0.served.take() else { return };
        let farewell = of.device_mut().farewell();
        match line {
            Line::Virtual(_) => {}
            Line::Device { device, .. } => spawn_local(async move {
                for request in farewell {
                    // One that is gone hears nothing; its motors end by themselves.
                    let _ = carried_out(&device, &request).await;
                }
                let _ = JsFuture::from(device.close()).await;
            }),
            Line::Serial(talk) => talk.close(&farewell, &self.slept()),
        }
    }

    /// The device is no longer served, and why.
    fn end(&self, name: &str, why: Key) {
        self.0.number.set(self.0.number.get() + 1);
        self.let_go();
        let status = DeviceStatus { name: name.to_owned(), ended: Some(why.say()), ..DeviceStatus::default() };
        self.tell(&Some(status));
    }

    /// Tells the page how the device is.
    fn tell(&self, told: &Told) {
        // Numbers and short texts: the page that cannot be told is closing.
        if let Ok(line) = serde_json::to_string(told) {
            let _ = self.0.scope.post_message(&JsValue::from_str(&line));
        }
    }
}

/// What a device can be held by; `None` for an interface without axes.
fn modelled(identity: &Identity, device: &HidDevice) -> Option<HapticDevice> {
    let text = js_sys::JSON::stringify(&device.collections()).ok()?.as_string()?;
    let collections: Vec<CollectionInfo> = serde_json::from_str(&text).ok()?;
    let haptic = HapticDevice::new(identity.clone(), webhid::model(&collections).ok()?).known_by(text.as_bytes());
    (!haptic.controls().axes.is_empty()).then_some(haptic)
}

/// What the device answers a request.
async fn carried_out(device: &HidDevice, request: &Request) -> Result<Option<Vec<u8>>, JsValue> {
    match request {
        Request::Send { id, data } => JsFuture::from(device.send_report(*id, data)).await.map(|_| None),
        Request::SetFeature { id, data } => JsFuture::from(device.send_feature_report(*id, data)).await.map(|_| None),
        Request::GetFeature { id, .. } => {
            let data: DataView = JsFuture::from(device.receive_feature_report(*id)).await?.unchecked_into();
            Ok(Some(api::bytes(&data)))
        }
    }
}
