//! An engine on a thread.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use crate::engine::{Command, Engine, Event, Link, SLICE};

/// The line to an engine on a thread of its own.
pub(super) struct ThreadLink {
    ctx: egui::Context,
    commands: Sender<Command>,
    events: Receiver<Result<Event, String>>,
    failure: Option<String>,
}

impl ThreadLink {
    /// Starts an engine that wakes `ctx` when it has something to say.
    pub(super) fn new(ctx: egui::Context) -> Self {
        let (commands, events) = start(ctx.clone());
        Self { ctx, commands, events, failure: None }
    }
}

impl Link for ThreadLink {
    fn send(&mut self, command: Command) {
        if self.commands.send(command).is_err() {
            self.failure.get_or_insert_with(|| "its thread has ended".to_owned());
        }
    }

    fn poll(&mut self) -> Option<Event> {
        match self.events.try_recv() {
            Ok(Ok(event)) => Some(event),
            Ok(Err(reason)) => {
                self.failure = Some(reason);
                None
            }
            Err(_) => None,
        }
    }

    fn restart(&mut self) {
        // The old thread ends when it next looks for a command, and its events go nowhere.
        (self.commands, self.events) = start(self.ctx.clone());
        self.failure = None;
    }

    fn failure(&mut self) -> Option<String> {
        self.failure.take()
    }
}

fn start(ctx: egui::Context) -> (Sender<Command>, Receiver<Result<Event, String>>) {
    let (commands, inbox) = channel();
    let (outbox, events) = channel();
    thread::spawn(move || {
        let run = catch_unwind(AssertUnwindSafe(|| work(&inbox, &outbox, &ctx)));
        if let Err(panic) = run {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let reason = text.or_else(|| panic.downcast_ref::<String>().cloned());
            // Without a window nobody listens any more.
            let _ = outbox.send(Err(reason.unwrap_or_else(|| "for an unknown reason".to_owned())));
            ctx.request_repaint();
        }
    });
    (commands, events)
}

/// Runs an engine until its line is cut.
fn work(inbox: &Receiver<Command>, outbox: &Sender<Result<Event, String>>, ctx: &egui::Context) {
    let mut engine = Engine::new();
    let mut is_busy = false;
    loop {
        if !is_busy {
            let Ok(command) = inbox.recv() else { return };
            engine.handle(command);
        }
        loop {
            match inbox.try_recv() {
                Ok(command) => engine.handle(command),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => return,
            }
        }
        is_busy = engine.advance(SLICE);
        while let Some(event) = engine.poll() {
            if outbox.send(Ok(event)).is_err() {
                return;
            }
            ctx.request_repaint();
        }
    }
}
