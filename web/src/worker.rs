//! Work in a dedicated Worker: the page's end of the line. The Worker's is `lumen_worker::serve`, and what a message is
//! `lumen_worker::message`.
//!
//! A Worker runs an instance of its own of the module the page has already compiled, or of another program, which it fetches
//! itself (`www/worker.js`).
//!
//! A Worker that dies (a panic, out of memory) says so to the page as an error event; [`WorkerLine::poll`] hands it on
//! and [`WorkerLine::restart`] starts another.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use js_sys::{Object, Reflect};
use lumen::engine::Command;
use lumen::io::Format;
use lumen::say;
use lumen::transfer::Message;
use lumen_worker::message::{Received, pack};
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, Worker, WorkerOptions, WorkerType};

use crate::hid::page::Devices;
use crate::job::{Job, Pipeline};

/// What the page hears from a Worker.
#[derive(Debug)]
pub(crate) enum Heard {
    /// It answers.
    Message(Received),
    /// It has died, and why, as far as the browser tells; nothing more comes until a restart.
    Died(String),
}

/// The page's end of the line to one Worker. Dropped, it ends the Worker.
pub(crate) struct WorkerLine {
    job: &'static str,
    program: Option<&'static str>,
    inbox: Inbox,
    worker: Worker,
    listeners: Listeners,
}

impl WorkerLine {
    /// Starts a Worker on a job; `wake` is called whenever [`poll`](Self::poll) has something new. Of messages that
    /// are passing, by their lines, only the newest waits: a hidden page listens to none. What is a text alone is between
    /// the Worker and `devices`.
    ///
    /// # Errors
    ///
    /// What the browser answers when it makes no Worker. One that fails later is heard of through `poll`.
    pub(crate) fn start<J: Job>(devices: Option<Devices>, wake: impl Fn() + 'static) -> Result<Self, JsValue> {
        let inbox = Inbox { queue: Rc::default(), passing: J::is_passing, devices, wake: Rc::new(wake) };
        let (job, program) = (J::NAME, J::PROGRAM);
        let (worker, listeners) = spawn(job, program, &inbox)?;
        Ok(Self { job, program, inbox, worker, listeners })
    }

    /// Whether its program, where it is not the page's, is there and runs.
    pub(crate) fn is_ready(&self) -> bool {
        self.listeners.is_ready.get()
    }

    /// Sends a script's value that is no message, to what stands beside the engine.
    ///
    /// # Errors
    ///
    /// What the browser answers when it cannot be copied.
    pub(crate) fn send_beside(&self, value: &JsValue) -> Result<(), JsValue> {
        self.worker.post_message(value)
    }

    /// Sends a message.
    ///
    /// # Errors
    ///
    /// What the browser answers when there is no memory left for the copies.
    pub(crate) fn send(&self, message: &impl Message) -> Result<(), JsValue> {
        let (values, transfer) = pack(message)?;
        self.worker.post_message_with_transfer(&values, &transfer)
    }

    /// The next thing heard, if there is one.
    pub(crate) fn poll(&self) -> Option<Heard> {
        self.inbox.queue.borrow_mut().pop_front()
    }

    /// Ends the Worker in the middle of whatever it does and starts another; what was under way is lost.
    ///
    /// # Errors
    ///
    /// As for [`start`](Self::start).
    pub(crate) fn restart(&mut self) -> Result<(), JsValue> {
        self.worker.terminate();
        self.inbox.queue.borrow_mut().clear();
        self.inbox.tell_devices(None);
        (self.worker, self.listeners) = spawn(self.job, self.program, &self.inbox)?;
        Ok(())
    }
}

impl Drop for WorkerLine {
    fn drop(&mut self) {
        self.worker.terminate();
        self.inbox.tell_devices(None);
    }
}

#[derive(Clone)]
struct Inbox {
    queue: Rc<RefCell<VecDeque<Heard>>>,
    passing: fn(&[u8]) -> bool,
    devices: Option<Devices>,
    wake: Rc<dyn Fn()>,
}

impl Inbox {
    /// Which Worker there is now to serve a device.
    fn tell_devices(&self, worker: Option<&Worker>) {
        if let Some(devices) = &self.devices {
            devices.worker(worker);
        }
    }

    fn put(&self, heard: Heard) {
        let is_passing = |heard: &Heard| matches!(heard, Heard::Message(message) if (self.passing)(message.head()));
        {
            let mut queue = self.queue.borrow_mut();
            // What does not pass may have come between.
            let older = if is_passing(&heard) { queue.iter().rposition(is_passing) } else { None };
            if let Some(older) = older {
                queue.remove(older);
            }
            queue.push_back(heard);
        }
        (self.wake)();
    }
}

/// The closures a Worker calls; they live as long as it does.
struct Listeners {
    /// Set once the program has begun.
    is_ready: Rc<Cell<bool>>,
    _message: Closure<dyn Fn(MessageEvent)>,
    _error: Closure<dyn Fn(web_sys::Event)>,
}

fn spawn(job: &str, program: Option<&str>, inbox: &Inbox) -> Result<(Worker, Listeners), JsValue> {
    let options = WorkerOptions::new();
    options.set_type(WorkerType::Module);
    options.set_name(job);
    let worker = Worker::new_with_options(&format!("{}#{job}", beside_page("worker.js")?), &options)?;

    // A death is told once: a panic arrives as its own report and then as the trap that ends it.
    let (dead, is_ready) = (Rc::new(Cell::new(false)), Rc::new(Cell::new(false)));
    let message = Closure::<dyn Fn(MessageEvent)>::new({
        let inbox = inbox.clone();
        let (dead, is_ready) = (Rc::clone(&dead), Rc::clone(&is_ready));
        move |event: MessageEvent| {
            if event.data().is_null() {
                is_ready.set(true);
            } else if let Some((devices, line)) = inbox.devices.as_ref().zip(event.data().as_string()) {
                devices.hear(&line);
            } else if !dead.get() {
                inbox.put(match Received::unpack(&event.data()) {
                    Some(message) => Heard::Message(message),
                    None => Heard::Died(say!("scan-message-unread")),
                });
            }
        }
    });
    let error = Closure::<dyn Fn(web_sys::Event)>::new({
        let inbox = inbox.clone();
        move |event: web_sys::Event| {
            event.prevent_default();
            if !dead.replace(true) {
                inbox.tell_devices(None);
                let why = event.dyn_ref::<ErrorEvent>().map(|event| told(&event.message()));
                inbox.put(Heard::Died(why.unwrap_or_else(|| say!("scan-script-unloaded"))));
            }
        }
    });
    worker.set_onmessage(Some(message.as_ref().unchecked_ref()));
    worker.set_onerror(Some(error.as_ref().unchecked_ref()));

    let first = Object::new();
    match program {
        Some(program) => Reflect::set(&first, &"program".into(), &program.into())?,
        None => {
            Reflect::set(&first, &"module".into(), &wasm_bindgen::module())?;
            let late = &"lumenLateModule".into();
            Reflect::set(&first, late, &Reflect::get(&js_sys::global(), late)?)?
        }
    };
    Reflect::set(&first, &"job".into(), &job.into())?;
    worker.post_message(&first)?;
    if job == Pipeline::NAME {
        // Where the page's program stops, the page can still ask this one for the result.
        Reflect::set(&js_sys::global(), &"lumenEngine".into(), &worker)?;
        let ask = Command::WriteLevel { name: "lumen-result.stl".into(), format: Format::Stl };
        Reflect::set(&worker, &"save".into(), &pack(&ask)?.0)?;
    }
    inbox.tell_devices(Some(&worker));
    Ok((worker, Listeners { is_ready, _message: message, _error: error }))
}

/// What an error event says, without what the browser puts before it ("Uncaught RangeError: ").
fn told(message: &str) -> String {
    let rest = message.strip_prefix("Uncaught ").and_then(|rest| rest.split_once(": "));
    rest.map_or(message, |(_, rest)| rest).to_owned()
}

/// The address of a file beside the page, with the version the page was stamped with, whatever path it is under.
pub(crate) fn beside_page(name: &str) -> Result<String, JsValue> {
    let document = web_sys::window().and_then(|window| window.document()).ok_or("there is no page")?;
    let base = document.base_uri()?.ok_or("the page has no address")?;
    let version = document.query_selector("meta[name=lumen-version]")?.and_then(|meta| meta.get_attribute("content"));
    let name = version.map_or(name.to_owned(), |version| format!("{name}?v={version}"));
    Ok(web_sys::Url::new_with_base(&name, &base)?.href())
}
