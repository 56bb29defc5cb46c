//! The app's end of the line to an engine.

use super::message::{Command, Event};

/// The app's end of the line to an engine: that of the pipeline, or with other commands and events that of the trial.
pub trait Link<C = Command, E = Event> {
    /// Sends a command.
    fn send(&mut self, command: C);

    /// The next event that has arrived.
    fn poll(&mut self) -> Option<E>;

    /// Gives up the engine, whatever it does, and starts another with nothing open.
    fn restart(&mut self);

    /// Gives up the engine, whatever it does. The next command starts another where one that dies at once would
    /// otherwise be started for ever; elsewhere it is started now.
    fn give_up(&mut self) {
        self.restart();
    }

    /// Whether the engine that has stopped by itself had no memory left: another would stop at the same place.
    fn is_out_of_memory(&self) -> bool {
        false
    }

    /// One plain sentence on why the engine stopped by itself, once; whoever asks should [`Self::restart`] or
    /// [`Self::give_up`].
    fn failure(&mut self) -> Option<String>;
}
