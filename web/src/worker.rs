//! Work in a dedicated Worker: the page's end of the line and the Worker's.
//!
//! A Worker runs an instance of its own of the module the page has already compiled (`www/worker.js`). There is no
//! shared memory. A message is a line of JSON and any number of byte buffers: each buffer is copied once out of the
//! sender's memory, transferred, and copied once into the receiver's.
//!
//! A Worker that dies (a panic, out of memory) says so to the page as an error event; [`WorkerLine::poll`] hands it on
//! and [`WorkerLine::restart`] starts another.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use js_sys::{Array, Object, Reflect, Uint8Array};
use lumen::transfer::{self, Buffers, Message, TransferError};
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, Worker, WorkerOptions, WorkerType};

use crate::bytes;
use crate::hid::page::Devices;

/// A message as a script value, and the list of what is to be transferred rather than copied again.
///
/// # Errors
///
/// When the browser has no memory left for the copies.
pub(crate) fn pack(message: &impl Message) -> Result<(Array, Array), JsValue> {
    let (line, buffers) = transfer::encode(message, |array| Ok::<_, JsValue>(bytes::copied(array)?.buffer()))?;
    let values = Array::of1(&JsValue::from_str(&line));
    let transfer = Array::new();
    for buffer in buffers {
        values.push(&buffer);
        transfer.push(&buffer);
    }
    Ok((values, transfer))
}

/// A message that has arrived; its buffers are still outside this instance's memory.
#[derive(Debug)]
pub(crate) struct Received {
    /// What it is, as a line of JSON.
    line: String,
    buffers: Outside,
}

/// Buffers outside this instance's memory.
#[derive(Debug)]
struct Outside(Vec<Uint8Array>);

impl Received {
    /// The reverse of [`pack`]; `None` for anything else.
    pub(crate) fn unpack(value: &JsValue) -> Option<Self> {
        let values: &Array = value.dyn_ref()?;
        let line = values.get(0).as_string()?;
        let buffers = values.iter().skip(1).map(|buffer| bytes::view(&buffer).ok()).collect::<Option<_>>()?;
        Some(Self { line, buffers: Outside(buffers) })
    }

    /// The message.
    ///
    /// # Errors
    ///
    /// When it is none such, or there is no memory left for it.
    pub(crate) fn read<M: Message>(self) -> Result<M, TransferError> {
        transfer::decode(&self.line, self.buffers)
    }
}

impl Buffers for Outside {
    fn len(&self, index: usize) -> Option<usize> {
        self.0.get(index).map(|buffer| buffer.length() as usize)
    }

    fn copy(&self, index: usize, target: &mut [u8]) {
        self.0[index].copy_to(target);
    }
}

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
    inbox: Inbox,
    worker: Worker,
    _listeners: Listeners,
}

impl WorkerLine {
    /// Starts a Worker on `job`; `wake` is called whenever [`poll`](Self::poll) has something new. Of messages that
    /// are `passing`, by their lines, only the newest waits: a hidden page listens to none. What is a text alone is between
    /// the Worker and `devices`.
    ///
    /// # Errors
    ///
    /// What the browser answers when it makes no Worker. One that fails later is heard of through `poll`.
    pub(crate) fn start(
        job: &'static str,
        passing: fn(&str) -> bool,
        devices: Option<Devices>,
        wake: impl Fn() + 'static,
    ) -> Result<Self, JsValue> {
        let inbox = Inbox { queue: Rc::default(), passing, devices, wake: Rc::new(wake) };
        let (worker, listeners) = spawn(job, &inbox)?;
        Ok(Self { job, inbox, worker, _listeners: listeners })
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
        (self.worker, self._listeners) = spawn(self.job, &self.inbox)?;
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
    passing: fn(&str) -> bool,
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
        let is_passing = |heard: &Heard| matches!(heard, Heard::Message(message) if (self.passing)(&message.line));
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
    _message: Closure<dyn Fn(MessageEvent)>,
    _error: Closure<dyn Fn(web_sys::Event)>,
}

fn spawn(job: &str, inbox: &Inbox) -> Result<(Worker, Listeners), JsValue> {
    let options = WorkerOptions::new();
    options.set_type(WorkerType::Module);
    options.set_name(job);
    let worker = Worker::new_with_options(&script_address()?, &options)?;

    // A death is told once: a panic arrives as its own report and then as the trap that ends it.
    let dead = Rc::new(Cell::new(false));
    let message = Closure::<dyn Fn(MessageEvent)>::new({
        let inbox = inbox.clone();
        let dead = Rc::clone(&dead);
        move |event: MessageEvent| {
            if let Some((devices, line)) = inbox.devices.as_ref().zip(event.data().as_string()) {
                devices.hear(&line);
            } else if !dead.get() {
                inbox.put(match Received::unpack(&event.data()) {
                    Some(message) => Heard::Message(message),
                    None => Heard::Died("The message could not be read.".to_owned()),
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
                let why = event.dyn_ref::<ErrorEvent>().map(ErrorEvent::message);
                inbox.put(Heard::Died(why.unwrap_or_else(|| "The Worker's script could not be loaded.".to_owned())));
            }
        }
    });
    worker.set_onmessage(Some(message.as_ref().unchecked_ref()));
    worker.set_onerror(Some(error.as_ref().unchecked_ref()));

    let first = Object::new();
    Reflect::set(&first, &"module".into(), &wasm_bindgen::module())?;
    Reflect::set(&first, &"job".into(), &job.into())?;
    worker.post_message(&first)?;
    if job == crate::job::PIPELINE {
        // Where the page's program stops, the page can still ask this one for the result.
        Reflect::set(&js_sys::global(), &"lumenEngine".into(), &worker)?;
    }
    inbox.tell_devices(Some(&worker));
    Ok((worker, Listeners { _message: message, _error: error }))
}

/// The address of `worker.js` beside the page, with the version the page was stamped with, whatever path it is under.
fn script_address() -> Result<String, JsValue> {
    let document = web_sys::window().and_then(|window| window.document()).ok_or("there is no page")?;
    let base = document.base_uri()?.ok_or("the page has no address")?;
    let version = document.query_selector("meta[name=lumen-version]")?.and_then(|meta| meta.get_attribute("content"));
    let script = version.map_or("worker.js".to_owned(), |version| format!("worker.js?v={version}"));
    Ok(web_sys::Url::new_with_base(&script, &base)?.href())
}
