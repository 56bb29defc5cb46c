//! The app's line to the engine, which runs in a Worker.

use lumen::engine::{Command, Event, Link, wire};
use wasm_bindgen::{JsCast as _, JsValue};

use crate::job::PIPELINE;
use crate::worker::{Heard, WorkerLine};

/// A line to an engine of its own.
pub(crate) struct WorkerLink {
    line: Option<WorkerLine>,
    ctx: egui::Context,
    failure: Option<String>,
}

impl WorkerLink {
    /// Starts an engine; `ctx` draws again whenever it has something to say.
    pub(crate) fn new(ctx: egui::Context) -> Self {
        let mut link = Self { line: None, ctx, failure: None };
        link.restart();
        link
    }

    /// The first failure is the cause; what follows from it says less.
    fn fail(&mut self, sentence: String) {
        self.failure.get_or_insert(sentence);
    }
}

impl Link for WorkerLink {
    fn send(&mut self, command: Command) {
        let Some(line) = &self.line else { return };
        if let Err(error) = line.send(&wire::encode_command(&command)) {
            self.fail(format!("a command could not be sent: {}", told(&error)));
        }
    }

    fn poll(&mut self) -> Option<Event> {
        match self.line.as_ref()?.poll()? {
            Heard::Message(message) => match wire::decode_event(&message.header, &message) {
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
                let ctx = self.ctx.clone();
                WorkerLine::start(PIPELINE, move || ctx.request_repaint()).map(|line| self.line = Some(line))
            }
        };
        if let Err(error) = started {
            self.fail(format!("no Worker could be started: {}", told(&error)));
        }
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
