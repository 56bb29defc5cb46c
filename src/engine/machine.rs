//! What whoever runs an engine (a thread, a Worker) has to know of it.

use std::time::Duration;

use super::trial::{TrialCommand, TrialEvent};
use super::{Command, Engine, Event, SLICE, TrialEngine};

/// An engine: commands in, events out.
pub trait Machine: Default + 'static {
    /// What it is asked.
    type Command: Send;
    /// What it tells.
    type Event: Send;

    /// Takes a command.
    fn handle(&mut self, command: Self::Command);

    /// Works for a slice at `now_s`, in seconds by any steady clock; says after what time it should be called again,
    /// `None` for not before the next command.
    fn advance(&mut self, now_s: f64) -> Option<Duration>;

    /// What it has to tell.
    fn poll(&mut self) -> Option<Self::Event>;

    /// Whether an event says only what the next of its kind says anew: where nobody listens, as while a window is
    /// hidden, such events need not pile up.
    fn is_passing(_: &Self::Event) -> bool {
        false
    }
}

impl Machine for Engine {
    type Command = Command;
    type Event = Event;

    fn handle(&mut self, command: Command) {
        self.handle(command);
    }

    fn advance(&mut self, _: f64) -> Option<Duration> {
        self.advance(SLICE).then_some(Duration::ZERO)
    }

    fn poll(&mut self) -> Option<Event> {
        self.poll()
    }
}

impl Machine for TrialEngine {
    type Command = TrialCommand;
    type Event = TrialEvent;

    fn handle(&mut self, command: TrialCommand) {
        self.handle(command);
    }

    fn advance(&mut self, now_s: f64) -> Option<Duration> {
        self.advance(now_s, SLICE)
    }

    fn poll(&mut self) -> Option<TrialEvent> {
        self.poll()
    }

    fn is_passing(event: &TrialEvent) -> bool {
        matches!(event, TrialEvent::Frame { .. })
    }
}
