//! The app's lines to its engines, each of which runs in a Worker.

use std::marker::PhantomData;

use lumen::app::Waker;
use lumen::engine::Link;
use wasm_bindgen::{JsCast as _, JsValue};

use crate::hid::page::Devices;
use crate::job::Sent;
use crate::worker::{Heard, WorkerLine};

/// A line to an engine of its own.
pub(crate) struct WorkerLink<M> {
    line: Option<WorkerLine>,
    waker: Waker,
    failure: Option<String>,
    /// Served beside the engine, where it is that of the trial.
    devices: Option<Devices>,
    engine: PhantomData<M>,
}

impl<M: Sent> WorkerLink<M> {
    /// Starts an engine; the window draws again whenever it has something to say.
    pub(crate) fn new(waker: Waker) -> Self {
        let mut link = Self::idle(waker);
        link.restart();
        link
    }

    /// A line without an engine: the first command starts one.
    pub(crate) fn idle(waker: Waker) -> Self {
        Self { line: None, waker, failure: None, devices: None, engine: PhantomData }
    }

    /// The same, beside whose engine `devices` are served.
    pub(crate) fn with_devices(self, devices: Devices) -> Self {
        Self { devices: Some(devices), ..self }
    }

    /// Whether there is an engine.
    pub(crate) fn has_begun(&self) -> bool {
        self.line.is_some()
    }

    /// The first failure is the cause; what follows from it says less.
    fn fail(&mut self, sentence: String) {
        self.failure.get_or_insert(sentence);
    }
}

impl<M: Sent> Link<M::Command, M::Event> for WorkerLink<M> {
    fn send(&mut self, command: M::Command) {
        if self.line.is_none() {
            self.restart();
        }
        let Some(line) = &self.line else { return };
        if let Err(error) = line.send(&command) {
            self.fail(format!("a command could not be sent: {}", told(&error)));
        }
    }

    fn poll(&mut self) -> Option<M::Event> {
        match self.line.as_ref()?.poll()? {
            Heard::Message(message) => match message.read() {
                Ok(event) => return Some(event),
                Err(error) => self.fail(format!("an answer could not be read: {error}")),
            },
            Heard::Died(why) => self.fail(why),
        }
        None
    }

    fn restart(&mut self) {
        self.failure = None;
        let started = match &mut self.line {
            Some(line) => line.restart(),
            None => {
                let waker = self.waker.clone();
                let devices = self.devices.clone();
                WorkerLine::start(M::JOB, M::is_passing_line, devices, move || waker.wake())
                    .map(|line| self.line = Some(line))
            }
        };
        if let Err(error) = started {
            self.fail(format!("no Worker could be started: {}", told(&error)));
        }
    }

    fn give_up(&mut self) {
        (self.line, self.failure) = (None, None);
    }

    fn failure(&mut self) -> Option<String> {
        self.failure.take()
    }
}

/// An exception as a sentence's end.
fn told(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => error.as_string().unwrap_or_else(|| format!("{error:?}")),
    }
}
