//! The Worker's end of the line: hears commands, works on them in slices, and sends events.
//!
//! Between two slices the Worker goes back to the browser, so that a command is heard within a slice's time. A message
//! to itself brings it back at once; a timer would make it wait for 4 ms each time, and is for an engine that keeps
//! pace with the clock and has time to spare.

use std::cell::{Cell, OnceCell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use lumen::engine::Machine;
use lumen::transfer::Message;
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, MessageChannel, MessageEvent, MessagePort};

use crate::message::{Received, pack};
use crate::speech;

/// Hears what is no command of the engine's; `None` where it is none of its own either.
pub type Beside = Box<dyn Fn(&JsValue) -> Option<Result<(), JsValue>>>;

/// What the Worker holds.
struct Worker<M> {
    machine: RefCell<M>,
    scope: DedicatedWorkerGlobalScope,
    again: Rc<Again>,
    beside: Option<Beside>,
}

/// The Worker that this runs in.
///
/// # Errors
///
/// Where this is no Worker.
pub fn scope() -> Result<DedicatedWorkerGlobalScope, JsValue> {
    js_sys::global().dyn_into().map_err(|_| "this is no Worker".into())
}

/// Runs the engine that `make` makes, which is told what brings the Worker back, and what stands beside it.
///
/// # Errors
///
/// Where this is no Worker, or it has no means to call itself; and those of `make`.
pub fn run<M>(make: impl FnOnce(&Rc<Again>) -> Result<(M, Option<Beside>), JsValue>) -> Result<(), JsValue>
where
    M: Machine<Command: Message, Event: Message>,
{
    let scope = scope()?;
    let again = Rc::new(Again::new(&scope)?);
    let (machine, beside) = make(&again)?;
    let worker = Rc::new(Worker { machine: RefCell::new(machine), again, scope, beside });

    let hear = Closure::<dyn Fn(MessageEvent) -> Result<(), JsValue>>::new({
        let worker = Rc::clone(&worker);
        move |event: MessageEvent| {
            if speech::hear(&event.data()) {
                return Ok(());
            }
            if let Some(heard) = worker.beside.as_ref().and_then(|beside| beside(&event.data())) {
                return heard;
            }
            let message = Received::unpack(&event.data()).ok_or("a message that is none")?;
            let command = message.read().map_err(|error| error.to_string())?;
            worker.machine.borrow_mut().handle(command);
            // The answer to a cancel does not wait for the next slice.
            worker.tell()?;
            worker.again.soon()
        }
    });
    let work = Closure::<dyn Fn() -> Result<(), JsValue>>::new({
        let worker = Rc::clone(&worker);
        move || worker.work()
    });
    worker.again.begin(work.as_ref().unchecked_ref());
    worker.scope.set_onmessage(Some(hear.as_ref().unchecked_ref()));
    // Both live as long as the Worker.
    work.forget();
    hear.forget();
    Ok(())
}

impl<M: Machine<Command: Message, Event: Message>> Worker<M> {
    /// Works for a slice.
    fn work(&self) -> Result<(), JsValue> {
        self.again.comes();
        let now_s = self.scope.performance().map_or(0.0, |clock| clock.now() / 1000.0);
        let rest = self.machine.borrow_mut().advance(now_s);
        self.tell()?;
        match rest {
            None => Ok(()),
            Some(Duration::ZERO) => self.again.soon(),
            Some(rest) => self.again.after(rest),
        }
    }

    /// Sends what the engine has to say to the page.
    fn tell(&self) -> Result<(), JsValue> {
        let mut machine = self.machine.borrow_mut();
        while let Some(event) = machine.poll() {
            let (values, transfer) = pack(&event)?;
            self.scope.post_message_with_transfer(&values, &transfer)?;
        }
        Ok(())
    }
}

/// What brings the Worker back: a message to itself or a timer, at most one of each.
pub struct Again {
    from: MessagePort,
    to: MessagePort,
    scope: DedicatedWorkerGlobalScope,
    /// What is called. None yet is no empty function: making one is forbidden where a host tells Workers the page's policy.
    work: OnceCell<js_sys::Function>,
    is_sent: Cell<bool>,
    timer: Cell<Option<i32>>,
}

impl Again {
    fn new(scope: &DedicatedWorkerGlobalScope) -> Result<Self, JsValue> {
        let channel = MessageChannel::new()?;
        let (from, to, scope) = (channel.port1(), channel.port2(), scope.clone());
        Ok(Self { from, to, scope, work: OnceCell::new(), is_sent: Cell::new(false), timer: Cell::new(None) })
    }

    /// Calls `work` from now on.
    fn begin(&self, work: &js_sys::Function) {
        self.to.set_onmessage(Some(work));
        self.work.get_or_init(|| work.clone());
    }

    /// The Worker is back.
    fn comes(&self) {
        self.is_sent.set(false);
        if let Some(timer) = self.timer.take() {
            self.scope.clear_timeout_with_handle(timer);
        }
    }

    /// Brings it back once what has been sent before is heard.
    ///
    /// # Errors
    ///
    /// What the browser answers when it takes no message.
    pub fn soon(&self) -> Result<(), JsValue> {
        if self.is_sent.replace(true) { Ok(()) } else { self.from.post_message(&JsValue::NULL) }
    }

    fn after(&self, rest: Duration) -> Result<(), JsValue> {
        let ms = rest.as_secs_f64() * 1000.0;
        let work = self.work.get().ok_or("the Worker has not begun")?;
        let timer = self.scope.set_timeout_with_callback_and_timeout_and_arguments_0(work, ms as i32)?;
        if let Some(older) = self.timer.replace(Some(timer)) {
            self.scope.clear_timeout_with_handle(older);
        }
        Ok(())
    }
}
