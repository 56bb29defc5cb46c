//! A platform of plain memory: the engines run within the test, files are lists of bytes.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::time::Duration;

use lumen::app::{
    Engines, Files, Gamepad, Hands, Languages, Offer, Platform, PlatformEvent, Screen, Sharing, Sound, Storage, Store,
    Tone, Video,
};
use lumen::engine::scan::{ScanCommand, ScanEngine, ScanEvent, ScanLink};
use lumen::engine::trial::{TrialCommand, TrialEvent, TrialLink};
use lumen::engine::{Command, Event, Frame, Link, Machine, TrialEngine};

use crate::first::{FirstEngine, SLICE};

/// What the test sees of the platform.
#[derive(Default)]
pub struct Memory {
    /// Files that the app offered.
    pub offered: Vec<(String, Vec<u8>)>,
    /// Whether videos can be made.
    pub has_video: bool,
    /// The frames of the last video: width, height and pixels of each.
    pub video: Vec<(u32, u32, Vec<u8>)>,
    /// How many of them were offered two at a time.
    pub pairs: usize,
    /// How often the app asked for a file.
    pub asked: usize,
    /// What the platform will report next.
    pub events: VecDeque<PlatformEvent>,
    /// Why the engine stops at the next look, if it does.
    pub engine_failure: Option<String>,
    /// Engines that were started.
    pub engines: usize,
    /// Windows that the app went on in.
    pub windows: usize,
    /// Lets the engine work when it is listened to.
    pub runs: bool,
    /// How many triangles a sample is opened with, where they are not those that a user's has.
    pub coarse_samples: Option<u32>,
    /// How long it works in each frame.
    pub slice: Duration,
    /// What the trial was asked.
    pub asked_of_trial: Vec<TrialCommand>,
    /// What the trial tells next.
    pub trial_events: VecDeque<TrialEvent>,
    /// Why the trial stops at the next look, if it does.
    pub trial_failure: Option<String>,
    /// The gamepad that is plugged in.
    pub gamepad: Option<Gamepad>,
    /// How strongly it was told to shake.
    pub rumbled: Vec<f64>,
    /// Whether it can sound.
    pub has_sound: bool,
    /// What it was told to sound.
    pub sounded: Vec<Tone>,
    /// Whether what moves by itself is welcome.
    pub likes_motion: bool,
    /// Whether what points is a finger.
    pub has_finger: bool,
    /// Lets a trial run too, by a clock that goes on by 1/60 s a frame.
    pub trial_runs: bool,
    /// What outlives the app, where something does.
    pub kept: Option<Kept>,
    /// The address that a link begins with, where there is one.
    pub address: Option<String>,
    /// Whether the window is a part of somebody else's page.
    pub is_embedded: bool,
}

/// What outlives the app.
#[derive(Clone, Default)]
pub struct Kept {
    /// The text.
    pub text: Option<String>,
    /// The surface: its name and its bytes.
    pub surface: Option<(String, Vec<u8>)>,
}

/// A platform of plain memory.
pub(crate) struct MemoryPlatform {
    /// `None` until something is asked.
    engine: Option<FirstEngine>,
    has_advanced: bool,
    trial: MemoryTrial,
    scans: MemoryScans,
    /// What was dropped with the file that was opened.
    next: Vec<egui::DroppedFileHandle>,
    memory: Rc<RefCell<Memory>>,
}

impl MemoryPlatform {
    fn change_kept(&self, change: impl FnOnce(&mut Kept)) {
        if let Some(kept) = &mut self.memory.borrow_mut().kept {
            change(kept);
        }
    }
}

impl Store for MemoryPlatform {
    fn text(&self) -> Option<String> {
        self.memory.borrow().kept.as_ref()?.text.clone()
    }

    fn set_text(&mut self, text: &str) {
        self.change_kept(|kept| kept.text = Some(text.to_owned()));
    }

    fn keep_surface(&mut self, name: &str, bytes: &[u8]) {
        self.change_kept(|kept| kept.surface = Some((name.to_owned(), bytes.to_vec())));
    }

    fn restore_surface(&mut self) {
        let mut memory = self.memory.borrow_mut();
        let surface = memory.kept.as_ref().and_then(|kept| kept.surface.clone());
        memory.events.push_back(PlatformEvent::Restored(surface));
    }

    fn forget_surface(&mut self) {
        self.change_kept(|kept| kept.surface = None);
    }

    fn forget(&mut self) {
        self.change_kept(|kept| *kept = Kept::default());
    }
}

/// The line to an engine of scans within the test.
#[derive(Default)]
struct MemoryScans(ScanEngine);

impl Link<ScanCommand, ScanEvent> for MemoryScans {
    fn send(&mut self, command: ScanCommand) {
        self.0.handle(command);
    }

    fn poll(&mut self) -> Option<ScanEvent> {
        self.0.poll().or_else(|| {
            self.0.advance(0.0);
            self.0.poll()
        })
    }

    fn restart(&mut self) {
        self.0 = ScanEngine::new();
    }

    fn failure(&mut self) -> Option<String> {
        None
    }
}

/// The line to a trial that is told what to say, or runs within the test.
struct MemoryTrial {
    engine: TrialEngine,
    now_s: f64,
    has_advanced: bool,
    memory: Rc<RefCell<Memory>>,
}

impl Link<TrialCommand, TrialEvent> for MemoryTrial {
    fn send(&mut self, command: TrialCommand) {
        if self.memory.borrow().trial_runs {
            self.engine.handle(command.clone());
        }
        self.memory.borrow_mut().asked_of_trial.push(command);
    }

    fn poll(&mut self) -> Option<TrialEvent> {
        if let Some(event) = self.memory.borrow_mut().trial_events.pop_front() {
            return Some(event);
        }
        if !self.memory.borrow().trial_runs {
            return None;
        }
        if !self.has_advanced {
            self.now_s += 1.0 / 60.0;
            self.engine.advance(self.now_s, Duration::from_millis(50));
            self.has_advanced = true;
        }
        let event = self.engine.poll();
        self.has_advanced &= event.is_some();
        event
    }

    fn restart(&mut self) {
        self.engine = TrialEngine::new();
    }

    fn failure(&mut self) -> Option<String> {
        self.memory.borrow_mut().trial_failure.take()
    }
}

impl Link for MemoryPlatform {
    fn send(&mut self, command: Command) {
        match &mut self.engine {
            Some(engine) => engine.handle(command),
            None => self.engine = Some(FirstEngine::asked_first(command)),
        }
    }

    fn poll(&mut self) -> Option<Event> {
        let engine = self.engine.as_mut()?;
        // One slice a frame: the app listens until there is nothing more to hear.
        if self.memory.borrow().runs && !self.has_advanced {
            engine.advance(self.memory.borrow().slice);
            self.has_advanced = true;
        }
        let event = engine.poll();
        self.has_advanced &= event.is_some();
        event
    }

    fn restart(&mut self) {
        self.engine = Some(FirstEngine::new());
        self.memory.borrow_mut().engines += 1;
    }

    fn failure(&mut self) -> Option<String> {
        self.memory.borrow_mut().engine_failure.take()
    }
}

impl Platform for MemoryPlatform {
    fn enter(&mut self, _: &egui::Context) {
        self.memory.borrow_mut().windows += 1;
    }

    fn poll(&mut self) -> Option<PlatformEvent> {
        self.memory.borrow_mut().events.pop_front()
    }
}

impl Engines for MemoryPlatform {
    fn link(&mut self) -> &mut dyn Link {
        self
    }

    fn trial(&mut self) -> &mut TrialLink {
        &mut self.trial
    }

    fn scans(&mut self) -> Option<&mut ScanLink> {
        Some(&mut self.scans)
    }
}

impl Files for MemoryPlatform {
    fn choose_file(&mut self, _: &egui::Context) {
        self.memory.borrow_mut().asked += 1;
    }

    fn read_dropped(&mut self, files: Vec<egui::DroppedFileHandle>, _: &egui::Context) {
        let Some((file, rest)) = files.split_first() else { return };
        let name = file.path().display().to_string();
        let event = match file.bytes() {
            Ok(bytes) => PlatformEvent::Chosen { name, bytes },
            Err(message) => PlatformEvent::Failed { message },
        };
        let names: Vec<String> = rest.iter().map(|file| file.path().display().to_string()).collect();
        self.next = rest.to_vec();
        let mut memory = self.memory.borrow_mut();
        memory.events.push_back(event);
        if !names.is_empty() {
            memory.events.push_back(PlatformEvent::More { names });
        }
    }

    fn open_next(&mut self) {
        let files = std::mem::take(&mut self.next);
        self.read_dropped(files, &egui::Context::default());
    }

    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, _: &egui::Context) {
        self.memory.borrow_mut().offered.push((name.to_owned(), bytes));
    }

    fn offer_pair(&mut self, pair: [Offer; 2], _: &egui::Context) {
        let mut memory = self.memory.borrow_mut();
        memory.pairs += 1;
        memory.offered.extend(pair.map(|offer| (offer.name, offer.bytes)));
    }
}

impl Video for MemoryPlatform {
    fn has_video(&self) -> bool {
        self.memory.borrow().has_video
    }

    fn offer_video(&mut self, name: &str, frames: Vec<Frame>, pause_ms: u16) {
        let mut memory = self.memory.borrow_mut();
        memory.offered.push((name.to_owned(), pause_ms.to_string().into_bytes()));
        memory.video = frames.into_iter().map(|frame| (frame.width, frame.height, frame.rgba)).collect();
    }
}

impl Storage for MemoryPlatform {
    fn store(&mut self) -> Option<&mut dyn Store> {
        let has_store = self.memory.borrow().kept.is_some();
        has_store.then_some(self)
    }
}

impl Screen for MemoryPlatform {
    fn today(&self) -> String {
        "2026-11-26".to_owned()
    }

    fn prefers_less_motion(&self) -> bool {
        !self.memory.borrow().likes_motion
    }

    fn is_embedded(&self) -> bool {
        self.memory.borrow().is_embedded
    }

    fn has_finger(&self) -> bool {
        self.memory.borrow().has_finger
    }
}

impl Sharing for MemoryPlatform {
    fn address(&self) -> Option<String> {
        self.memory.borrow().address.clone()
    }

    fn sample_triangles(&self) -> Option<u32> {
        self.memory.borrow().coarse_samples
    }
}

impl Languages for MemoryPlatform {}

impl Hands for MemoryPlatform {
    fn gamepad(&self) -> Option<Gamepad> {
        self.memory.borrow().gamepad
    }

    fn rumble(&mut self, strength: f64) {
        self.memory.borrow_mut().rumbled.push(strength);
    }
}

impl Sound for MemoryPlatform {
    fn has_sound(&self) -> bool {
        self.memory.borrow().has_sound
    }

    fn sound(&mut self, tone: Tone) {
        self.memory.borrow_mut().sounded.push(tone);
    }
}

/// Triangles of a sample whose numbers do not matter: a test then spends its time in the window and not in the pipeline. With
/// `--long` each is as users have it.
const COARSE: u32 = 10_000;

/// The platform, and what the test sees of it.
pub(crate) fn platform() -> (MemoryPlatform, Rc<RefCell<Memory>>) {
    let memory = Memory {
        runs: true,
        coarse_samples: (!lumen_test_support::is_long()).then_some(COARSE),
        slice: SLICE,
        engines: 1,
        ..Memory::default()
    };
    let memory = Rc::new(RefCell::new(memory));
    let trial = MemoryTrial { engine: TrialEngine::new(), now_s: 0.0, has_advanced: false, memory: memory.clone() };
    let scans = MemoryScans::default();
    let platform =
        MemoryPlatform { engine: None, has_advanced: false, trial, scans, next: Vec::new(), memory: memory.clone() };
    (platform, memory)
}
