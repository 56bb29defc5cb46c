//! What whoever runs an engine (a thread, a Worker) has to know of it.

use std::time::Duration;

/// How long a slice of work should be, so that a command is heard in time.
pub const SLICE: Duration = Duration::from_millis(8);

/// An engine: commands in, events out. Whoever runs it is given what makes one: it may need more than a thread to be on.
pub trait Machine: 'static {
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
