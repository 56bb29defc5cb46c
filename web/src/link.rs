//! The app's lines to its engines, each of which runs in a Worker.

use std::marker::PhantomData;

use js_sys::Object;
use lumen::app::Waker;
use lumen::engine::Link;
use lumen::language::decimal;
use lumen::say;
use wasm_bindgen::{JsCast as _, JsValue};

use crate::hid::page::Devices;
use crate::job::Job;
use crate::worker::{Heard, WorkerLine};

/// What `www/worker.js` says of a program that ended because an allocation failed.
const NO_MEMORY: &str = "there is no memory left beyond its ";

/// A line to an engine of its own.
pub(crate) struct WorkerLink<J> {
    line: Option<WorkerLine>,
    waker: Waker,
    failure: Option<String>,
    is_out_of_memory: bool,
    /// Served beside the engine, where it is that of the trial.
    devices: Option<Devices>,
    /// What it speaks, told to each Worker that is started.
    speech: Option<Object>,
    job: PhantomData<J>,
}

impl<J: Job> WorkerLink<J> {
    /// Starts an engine; the window draws again whenever it has something to say.
    pub(crate) fn new(waker: Waker) -> Self {
        let mut link = Self::idle(waker);
        link.restart();
        link
    }

    /// A line without an engine: the first command starts one.
    pub(crate) fn idle(waker: Waker) -> Self {
        Self {
            line: None,
            waker,
            failure: None,
            is_out_of_memory: false,
            devices: None,
            speech: None,
            job: PhantomData,
        }
    }

    /// The same, beside whose engine `devices` are served.
    pub(crate) fn with_devices(self, devices: Devices) -> Self {
        Self { devices: Some(devices), ..self }
    }

    /// Lets the window draw again, which asks for news.
    pub(crate) fn wake(&self) {
        self.waker.wake();
    }

    /// Whether there is an engine.
    pub(crate) fn has_begun(&self) -> bool {
        self.line.is_some()
    }

    /// Whether there is one whose program, another than the page's, runs.
    pub(crate) fn is_ready(&self) -> bool {
        self.line.as_ref().is_some_and(WorkerLine::is_ready)
    }

    /// Lets the engine speak so, and those that take its place: see [`lumen_worker::speech`].
    pub(crate) fn speak(&mut self, speech: Object) {
        self.speech = Some(speech);
        self.tell_speech();
    }

    fn tell_speech(&mut self) {
        let (Some(line), Some(speech)) = (&self.line, &self.speech) else { return };
        if let Err(error) = line.send_beside(speech) {
            self.fail(say!("scan-language-not-handed-over", why = told(&error)));
        }
    }

    /// Sends a script's value to what stands beside the engine, which is started where there is none.
    pub(crate) fn send_beside(&mut self, value: &JsValue) {
        if self.line.is_none() {
            self.restart();
        }
        let Some(line) = &self.line else { return };
        if let Err(error) = line.send_beside(value) {
            self.fail(say!("scan-not-handed-over", why = told(&error)));
        }
    }

    /// The first failure is the cause; what follows from it says less.
    fn fail(&mut self, sentence: String) {
        self.failure.get_or_insert(sentence);
    }
}

impl<J: Job> Link<J::Command, J::Event> for WorkerLink<J> {
    fn send(&mut self, command: J::Command) {
        if self.line.is_none() {
            self.restart();
        }
        let Some(line) = &self.line else { return };
        if let Err(error) = line.send(&command) {
            self.fail(say!("scan-not-sent", why = told(&error)));
        }
    }

    fn poll(&mut self) -> Option<J::Event> {
        match self.line.as_ref()?.poll()? {
            Heard::Message(message) => match message.read() {
                Ok(event) => return Some(event),
                Err(error) => self.fail(say!("scan-not-understood", why = error.to_string())),
            },
            Heard::Died(why) => {
                let gigabytes =
                    why.split_once(NO_MEMORY).and_then(|(_, rest)| rest.split(' ').next()?.parse::<f64>().ok());
                self.is_out_of_memory = gigabytes.is_some();
                self.fail(gigabytes.map_or(why, |gb| say!("scan-memory-ends", gb = decimal(gb, 1))));
            }
        }
        None
    }

    fn restart(&mut self) {
        (self.failure, self.is_out_of_memory) = (None, false);
        let started = match &mut self.line {
            Some(line) => line.restart(),
            None => {
                let waker = self.waker.clone();
                let devices = self.devices.clone();
                WorkerLine::start::<J>(devices, move || waker.wake()).map(|line| self.line = Some(line))
            }
        };
        match started {
            Ok(()) => self.tell_speech(),
            Err(error) => self.fail(say!("scan-no-worker", why = told(&error))),
        }
    }

    fn give_up(&mut self) {
        (self.line, self.failure) = (None, None);
    }

    fn is_out_of_memory(&self) -> bool {
        self.is_out_of_memory
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
