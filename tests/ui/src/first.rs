//! The first surface of an engine, worked out once for all tests: they open the same few samples some hundred times.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use lumen::engine::{Command, Engine, Event, Source};
use lumen_test_support::is_long;

/// An engine that tells of its first surface, where that is a sample, what another told of it before. Whatever else is asked
/// of it, it does itself. With `--long` it does everything itself.
pub(crate) enum FirstEngine {
    /// Nothing but this is asked; so many of its frames are told, and of the last of them this is left.
    Retelling { command: Box<Command>, frames: usize, events: VecDeque<Event> },
    /// It does what it is asked.
    Working(Box<Engine>),
}

impl FirstEngine {
    /// An engine with nothing open.
    pub(crate) fn new() -> Self {
        Self::Working(Box::default())
    }

    /// The first engine of a test: what it is asked first may be known.
    pub(crate) fn asked_first(command: Command) -> Self {
        let is_sample = matches!(command, Command::Open { source: Source::Sample { .. }, .. });
        if is_sample && !is_long() {
            return Self::Retelling { command: Box::new(command), frames: 0, events: VecDeque::new() };
        }
        let mut engine = Self::new();
        engine.handle(command);
        engine
    }

    pub(crate) fn handle(&mut self, command: Command) {
        self.working().handle(command);
    }

    /// Works for a slice, or where that is [`SLICE`] tells the next frame in which there is something to hear.
    pub(crate) fn advance(&mut self, slice: Duration) {
        if slice != SLICE {
            self.working();
        }
        match self {
            Self::Retelling { command, frames, events } => {
                let known = told(command);
                let told = known.get_or_init(|| Told::of(command));
                match told.frames.get(*frames) {
                    Some(next) => {
                        events.extend(next.iter().cloned());
                        *frames += 1;
                    }
                    // At rest it has something to do again: what makes another pass band cheap.
                    None if events.is_empty() => *self = Self::Working(Box::new(told.fork())),
                    None => {}
                }
            }
            Self::Working(engine) => {
                engine.advance(slice);
            }
        }
    }

    pub(crate) fn poll(&mut self) -> Option<Event> {
        match self {
            Self::Retelling { events, .. } => events.pop_front(),
            Self::Working(engine) => engine.poll(),
        }
    }

    /// An engine that is where this one would be.
    fn working(&mut self) -> &mut Engine {
        if let Self::Retelling { command, frames, events } = self {
            *self = Self::Working(Box::new(
                told(command).get().map_or_else(|| begun(command), |told| told.engine_after(command, *frames, events)),
            ));
        }
        match self {
            Self::Working(engine) => engine,
            Self::Retelling { .. } => unreachable!("it was replaced"),
        }
    }
}

/// What an engine tells of its first surface.
struct Told {
    /// In each frame that has something to hear; of how far the work is, what was told last.
    frames: Vec<Vec<Event>>,
    /// At rest.
    engine: Mutex<Engine>,
}

impl Told {
    fn of(command: &Command) -> Self {
        let mut engine = begun(command);
        let mut frames = Vec::new();
        let mut has_more = true;
        while has_more {
            has_more = engine.advance(SLICE);
            let mut events: Vec<Event> = std::iter::from_fn(|| engine.poll()).collect();
            if count(&events) > 0 {
                let last = events.iter().rposition(is_progress);
                let mut at = 0..;
                events.retain(|event| at.next() == last || !is_progress(event));
                frames.push(events);
            }
        }
        Self { frames, engine: Mutex::new(engine) }
    }

    fn fork(&self) -> Engine {
        self.engine.lock().expect("forking does not panic").fork()
    }

    /// An engine that has told so many frames but for what is left of the last of them.
    fn engine_after(&self, command: &Command, frames: usize, left: &VecDeque<Event>) -> Engine {
        if frames == self.frames.len() && left.is_empty() {
            return self.fork();
        }
        let mut still = self.frames[..frames].iter().map(count).sum::<usize>() - count(left);
        let (mut engine, mut has_more) = (begun(command), true);
        while still > 0 {
            match engine.poll() {
                Some(event) => still -= usize::from(!is_progress(&event)),
                None => {
                    assert!(has_more, "it tells as much as the one before");
                    has_more = engine.advance(SLICE);
                }
            }
        }
        engine
    }
}

/// How long an engine works in a frame, where a test does not say otherwise.
pub(crate) const SLICE: Duration = Duration::from_millis(50);

/// An engine that was asked this and has done nothing.
fn begun(command: &Command) -> Engine {
    let mut engine = Engine::new();
    engine.handle(command.clone());
    engine
}

fn is_progress(event: &Event) -> bool {
    matches!(event, Event::Progress { .. })
}

/// How many of them say more than how far the work is.
fn count<'a>(events: impl IntoIterator<Item = &'a Event>) -> usize {
    events.into_iter().filter(|event| !is_progress(event)).count()
}

/// What is told, or will be, of a command.
fn told(command: &Command) -> Arc<OnceLock<Told>> {
    static TOLD: Mutex<Vec<(Command, Arc<OnceLock<Told>>)>> = Mutex::new(Vec::new());
    let mut known = TOLD.lock().expect("nothing panics with it");
    match known.iter().find(|(of, _)| of == command) {
        Some((_, told)) => told.clone(),
        None => {
            let told = Arc::default();
            known.push((command.clone(), Arc::clone(&told)));
            told
        }
    }
}
