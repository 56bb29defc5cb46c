//! What the desktop gives the app: a window, file dialogs, engines and haptic devices on threads, a tone.

mod files;
mod haply;
mod haptics;
mod hid;
#[cfg(not(feature = "scans"))]
#[path = "no_scans.rs"]
mod scans;
#[cfg(feature = "scans")]
mod scans;
mod sound;
mod speech;
mod synth;
mod thread;
mod window;

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};

use self::thread::ThreadLink;
pub use self::window::{run, run_on};
use crate::app::{
    self, Devices, Engines, Files, Hands, Languages, Offer, Platform, PlatformEvent, Screen, Sharing, Storage, Tone,
    Video, Waker,
};
use crate::engine::scan::ScanLink;
use crate::engine::trial::{HapticChannel, TrialLink};
use crate::engine::{Engine, Link, TrialEngine};
use crate::language::Language;

/// The desktop.
pub struct Desktop {
    link: ThreadLink<Engine>,
    trial: ThreadLink<TrialEngine>,
    scans: scans::Line,
    devices: haptics::HapticDevices,
    sound: sound::Sound,
    sender: Sender<PlatformEvent>,
    events: Receiver<PlatformEvent>,
    next: files::Next,
    waker: Waker,
}

impl Desktop {
    /// A desktop with engines on threads of their own, which wake `ctx` when they have something to say.
    pub fn new(ctx: &egui::Context) -> Self {
        let (sender, events) = channel();
        let waker = Waker::new(ctx);
        let link = ThreadLink::new(waker.clone(), Engine::new);
        let exchange = HapticChannel::default();
        let hand = exchange.clone();
        let trial = ThreadLink::new(waker.clone(), move || TrialEngine::with_hand(hand.clone()));
        let scans = scans::Line::new(waker.clone());
        let (devices, sound) = (haptics::HapticDevices::new(exchange), sound::Sound::new());
        Self { link, trial, scans, devices, sound, sender, events, next: files::Next::default(), waker }
    }

    fn reader(&self) -> files::Reader {
        files::Reader {
            disk: self.scans.disk(),
            next: self.next.clone(),
            events: self.sender.clone(),
            waker: self.waker.clone(),
        }
    }
}

/// What threads share, which is whole at any time: one that panicked has left it so.
fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Platform for Desktop {
    fn enter(&mut self, ctx: &egui::Context) {
        self.waker.enter(ctx);
    }

    fn poll(&mut self) -> Option<PlatformEvent> {
        self.events.try_recv().ok()
    }
}

impl Engines for Desktop {
    fn link(&mut self) -> &mut dyn Link {
        &mut self.link
    }

    fn trial(&mut self) -> &mut TrialLink {
        &mut self.trial
    }

    fn scans(&mut self) -> Option<&mut ScanLink> {
        self.scans.link()
    }
}

impl Files for Desktop {
    fn choose_file(&mut self, _: &egui::Context) {
        files::choose(self.reader());
    }

    fn read_dropped(&mut self, files: Vec<egui::DroppedFileHandle>, _: &egui::Context) {
        let paths = files.iter().map(|file| file.path().to_owned()).collect();
        files::read(paths, self.reader());
    }

    fn open_next(&mut self) {
        files::read(self.next.take(), self.reader());
    }

    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, _: &egui::Context) {
        files::save(name.to_owned(), bytes, self.sender.clone(), self.waker.clone());
    }

    fn offer_pair(&mut self, pair: [Offer; 2], _: &egui::Context) {
        files::save_pair(pair, self.sender.clone(), self.waker.clone());
    }
}

impl Video for Desktop {}

impl Storage for Desktop {}

impl Screen for Desktop {
    fn today(&self) -> String {
        crate::report::today()
    }
}

impl Sharing for Desktop {}

impl Languages for Desktop {
    fn locale(&self) -> Option<String> {
        sys_locale::get_locale()
    }

    fn speak(&mut self, language: Language, _: &str) {
        speech::set(language);
        self.devices.speak();
    }
}

impl Hands for Desktop {
    fn devices(&mut self) -> Option<&mut dyn Devices> {
        Some(&mut self.devices)
    }
}

impl app::Sound for Desktop {
    fn has_sound(&self) -> bool {
        self.sound.is_there()
    }

    fn sound(&mut self, tone: Tone) {
        self.sound.play(tone);
    }
}
