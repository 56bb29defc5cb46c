//! Engines on threads of their own.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Instant;

use super::speech;
use crate::app::Waker;
use crate::engine::{Link, Machine};
use crate::say;

/// Passing events are dropped while so many others are not heard.
const UNHEARD: usize = 30;

/// Makes an engine, on the thread that it is to work on.
type Make<M> = Arc<dyn Fn() -> M + Send + Sync>;

/// The line to an engine on a thread of its own.
pub(super) struct ThreadLink<M: Machine> {
    make: Make<M>,
    waker: Waker,
    commands: Sender<M::Command>,
    events: Receiver<Result<M::Event, String>>,
    unheard: Arc<AtomicUsize>,
    failure: Option<String>,
}

impl<M: Machine> ThreadLink<M> {
    /// Starts an engine that `make` makes, as it does after a restart, and that wakes the window when it has something to
    /// say.
    pub(super) fn new(waker: Waker, make: impl Fn() -> M + Send + Sync + 'static) -> Self {
        let (make, unheard): (Make<M>, _) = (Arc::new(make), Arc::default());
        let (commands, events) = start(Arc::clone(&make), waker.clone(), Arc::clone(&unheard));
        Self { make, waker, commands, events, unheard, failure: None }
    }
}

impl<M: Machine> Link<M::Command, M::Event> for ThreadLink<M> {
    fn send(&mut self, command: M::Command) {
        if self.commands.send(command).is_err() {
            self.failure.get_or_insert_with(|| say!("app-thread-ended"));
        }
    }

    fn poll(&mut self) -> Option<M::Event> {
        match self.events.try_recv() {
            Ok(Ok(event)) => {
                self.unheard.fetch_sub(1, Ordering::Relaxed);
                Some(event)
            }
            Ok(Err(reason)) => {
                self.failure = Some(reason);
                None
            }
            Err(_) => None,
        }
    }

    fn restart(&mut self) {
        // The old thread ends when it next looks for a command, and its events go nowhere.
        self.unheard = Arc::default();
        (self.commands, self.events) = start(Arc::clone(&self.make), self.waker.clone(), Arc::clone(&self.unheard));
        self.failure = None;
    }

    fn failure(&mut self) -> Option<String> {
        self.failure.take()
    }
}

type Ends<M> = (Sender<<M as Machine>::Command>, Receiver<Result<<M as Machine>::Event, String>>);

fn start<M: Machine>(make: Make<M>, waker: Waker, unheard: Arc<AtomicUsize>) -> Ends<M> {
    let (commands, inbox) = channel();
    let (outbox, events) = channel();
    thread::spawn(move || {
        let run = catch_unwind(AssertUnwindSafe(|| work(make(), &inbox, &outbox, &unheard, &waker)));
        if let Err(panic) = run {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let reason = text.or_else(|| panic.downcast_ref::<String>().cloned());
            // Without a window nobody listens any more.
            let _ = outbox.send(Err(reason.unwrap_or_else(|| say!("app-reason-unknown"))));
            waker.wake();
        }
    });
    (commands, events)
}

/// Runs an engine until its line is cut.
fn work<M: Machine>(
    mut machine: M,
    inbox: &Receiver<M::Command>,
    outbox: &Sender<Result<M::Event, String>>,
    unheard: &AtomicUsize,
    waker: &Waker,
) {
    let since = Instant::now();
    let mut rest = None;
    loop {
        let heard = match rest {
            None => inbox.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(rest) => inbox.recv_timeout(rest),
        };
        speech::follow();
        match heard {
            Ok(command) => machine.handle(command),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        while let Ok(command) = inbox.try_recv() {
            machine.handle(command);
        }
        rest = machine.advance(since.elapsed().as_secs_f64());
        let mut has_told = false;
        while let Some(event) = machine.poll() {
            if M::is_passing(&event) && unheard.load(Ordering::Relaxed) >= UNHEARD {
                continue;
            }
            unheard.fetch_add(1, Ordering::Relaxed);
            if outbox.send(Ok(event)).is_err() {
                return;
            }
            has_told = true;
        }
        if has_told {
            waker.wake();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    /// Ticks every 2 ms once it was asked to; counts what it was asked.
    #[derive(Default)]
    struct Clock {
        ticks: u32,
        is_on: bool,
        events: Vec<Tick>,
    }

    #[derive(Debug, PartialEq)]
    enum Tick {
        Tick(u32),
        Heard(&'static str),
    }

    impl Machine for Clock {
        type Command = &'static str;
        type Event = Tick;

        fn handle(&mut self, command: &'static str) {
            assert!(command != "panic", "as it was told");
            self.is_on = command == "start";
            self.events.push(Tick::Heard(command));
        }

        fn advance(&mut self, _: f64) -> Option<Duration> {
            self.ticks += 1;
            self.events.push(Tick::Tick(self.ticks));
            self.is_on.then_some(Duration::from_millis(2))
        }

        fn poll(&mut self) -> Option<Tick> {
            (!self.events.is_empty()).then(|| self.events.remove(0))
        }

        fn is_passing(event: &Tick) -> bool {
            matches!(event, Tick::Tick(_))
        }
    }

    fn wait<T>(mut ask: impl FnMut() -> Option<T>) -> T {
        for _ in 0..2000 {
            if let Some(answer) = ask() {
                return answer;
            }
            thread::sleep(Duration::from_millis(2));
        }
        panic!("no answer");
    }

    #[test]
    fn a_machine_that_keeps_pace_hears_commands_in_between_and_piles_nothing_up() {
        let mut link = ThreadLink::new(Waker::new(&egui::Context::default()), Clock::default);
        link.send("start");
        thread::sleep(Duration::from_millis(300));
        link.send("stop");
        thread::sleep(Duration::from_millis(100));
        let events: Vec<Tick> = std::iter::from_fn(|| link.poll()).collect();
        assert!(events.len() <= UNHEARD + 2, "{} events were not heard", events.len());
        assert_eq!(events.last(), Some(&Tick::Heard("stop")), "what is not passing comes through");
    }

    #[test]
    fn a_machine_that_panics_is_told_of_and_another_takes_its_place() {
        let mut link = ThreadLink::new(Waker::new(&egui::Context::default()), Clock::default);
        link.send("panic");
        let reason = wait(|| {
            let _ = link.poll();
            link.failure()
        });
        assert!(reason.contains("as it was told"), "{reason}");
        link.restart();
        link.send("again");
        assert_eq!(wait(|| link.poll()), Tick::Heard("again"));
    }
}
