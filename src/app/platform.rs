//! What the app needs of the machine it runs on; the desktop and the browser each have one.

use std::sync::{Arc, Mutex, PoisonError};

use crate::engine::Link;
use crate::engine::scan::{NamedFile, ScanLink};
use crate::engine::trial::TrialLink;
use crate::haptics::service::{DeviceCommand, DeviceStatus};
use crate::language::Language;

/// What files end in that are no surfaces, and are opened like them: a trial's log, settings, a lesson.
pub const OTHER_ENDINGS: [&str; 3] = ["csv", "json", "lesson"];

/// A platform. Nothing here blocks: what takes time arrives through [`Platform::poll`].
pub trait Platform {
    /// The line to the engine.
    fn link(&mut self) -> &mut dyn Link;

    /// The line to the trial, which has a machine of its own so that neither stalls the other.
    fn trial(&mut self) -> &mut TrialLink;

    /// The line to the engine of scans; `None` where the platform has none.
    fn scans(&mut self) -> Option<&mut ScanLink> {
        None
    }

    /// What the first gamepad that is plugged in does; `None` without one. The desktop has none: what reads them there
    /// needs a C library (libudev), and keys and pads on the screen do the same.
    fn gamepad(&self) -> Option<Gamepad> {
        None
    }

    /// Lets that gamepad shake with so much of its strength, 0 to 1, for [`SHAKE_MS`]; 0 ends it at once. Not called where
    /// none can.
    fn rumble(&mut self, _strength: f64) {}

    /// Whether it can sound: the desktop can where it finds a program that plays.
    fn has_sound(&self) -> bool {
        false
    }

    /// Sounds so for [`SHAKE_MS`], in place of what sounded before. Not called where it cannot.
    fn sound(&mut self, _tone: Tone) {}

    /// Whether keys that are let go will be heard of: a page that is seen beside the window in use hears none. The
    /// desktop is told by its window.
    fn has_attention(&self) -> bool {
        true
    }

    /// Whether the window was left, if only for a moment, since this was asked last: what moves by itself ends. Where the
    /// window's own events tell that, it is never so.
    fn was_left(&self) -> bool {
        false
    }

    /// Whether the user asks for less motion on the screen.
    fn prefers_less_motion(&self) -> bool {
        false
    }

    /// Whether what points is a finger, as on a phone or a tablet.
    fn has_finger(&self) -> bool {
        false
    }

    /// How many triangles the user wants samples to have, where that is another number than
    /// [theirs](crate::phantom::Sample::default_triangles).
    fn sample_triangles(&self) -> Option<u32> {
        None
    }

    /// The most memory, in bytes, that an engine can have; `None` where it is the machine's.
    fn memory_limit(&self) -> Option<u64> {
        None
    }

    /// Haptic devices; `None` where the platform has none.
    fn devices(&mut self) -> Option<&mut dyn Devices> {
        None
    }

    /// What outlives the app; `None` where nothing does.
    fn store(&mut self) -> Option<&mut dyn Store> {
        None
    }

    /// The address that a link begins with; `None` where there is no page.
    fn address(&self) -> Option<String> {
        None
    }

    /// The language of the system, as a tag such as `de-AT` or a locale such as `fr_FR.UTF-8`; `None` where it states none.
    fn locale(&self) -> Option<String> {
        None
    }

    /// Fetches the messages of a language that the program has not in it: [`PlatformEvent::Texts`] has them, or
    /// [`PlatformEvent::Failed`] says why there are none.
    fn fetch_texts(&mut self, _language: Language) {}

    /// Lets the engines speak a language, those too that are started later: `texts` are its messages, none for English,
    /// which they have in them.
    fn speak(&mut self, _language: Language, _texts: &str) {}

    /// Says outside the window which language is spoken in it, by its tag: a page tells those who read it aloud.
    fn show_language(&mut self, _tag: &'static str) {}

    /// The app goes on in another window: whatever has news wakes this one from now on.
    fn enter(&mut self, ctx: &egui::Context);

    /// Lets the user choose a file to open. Called while a click or key press is handled, as browsers demand.
    fn choose_file(&mut self, ctx: &egui::Context);

    /// Starts to read the files that were dropped on the window, at least one: a scan may stand in several.
    fn read_dropped(&mut self, files: Vec<egui::DroppedFileHandle>, ctx: &egui::Context);

    /// Gives the user a file: a save dialog or a download.
    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, ctx: &egui::Context);

    /// Gives the user a file and one that belongs to it: a save dialog for the first, beside which the second goes under
    /// the same stem, or two downloads.
    fn offer_pair(&mut self, pair: [Offer; 2], ctx: &egui::Context);

    /// What has happened since.
    fn poll(&mut self) -> Option<PlatformEvent>;
}

/// The haptic devices that can be chosen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Their names.
    pub names: Vec<String>,
    /// Why the system lists no others, if so.
    pub problem: Option<String>,
    /// The one that is served.
    pub chosen: Option<usize>,
}

/// Haptic devices, of which one holds the wire.
pub trait Devices {
    /// Names of those that are there now, and why the system lists none, if so.
    fn look(&mut self) -> (Vec<String>, Option<String>);

    /// Those that can be chosen and which is, where that has changed by itself: one was plugged in, or has been paired.
    fn changed(&mut self) -> Option<Listing> {
        None
    }

    /// Serves one of those that were listed last, and none else; none at all for `None`.
    fn choose(&mut self, number: Option<usize>);

    /// Asks the one that is served for something.
    fn ask(&mut self, command: DeviceCommand);

    /// How the one that is served is; `None` where there is none.
    fn status(&self) -> Option<DeviceStatus>;
}

/// What outlives the app, on this device alone. Where the system keeps nothing, the next start begins anew.
pub trait Store {
    /// The text that was kept.
    fn text(&self) -> Option<String>;

    /// Keeps a text in place of the one before.
    fn set_text(&mut self, text: &str);

    /// Keeps a surface in place of the one before. A failure is told as an event.
    fn keep_surface(&mut self, name: &str, bytes: &[u8]);

    /// Asks for the surface that is kept: [`PlatformEvent::Restored`] has it.
    fn restore_surface(&mut self);

    /// Forgets the surface that is kept.
    fn forget_surface(&mut self);

    /// Forgets everything.
    fn forget(&mut self);
}

/// A file for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// What wakes the window that the app is in, from any thread; clones wake the same.
#[derive(Clone)]
pub struct Waker(Arc<Mutex<egui::Context>>);

impl Waker {
    /// Wakes the window of `ctx`.
    pub fn new(ctx: &egui::Context) -> Self {
        Self(Arc::new(Mutex::new(ctx.clone())))
    }

    /// Wakes the window of `ctx` from now on, and at once: what has come meanwhile woke another.
    pub fn enter(&self, ctx: &egui::Context) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
        ctx.request_repaint();
    }

    /// Lets the window draw again.
    pub fn wake(&self) {
        let ctx = self.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        ctx.request_repaint();
    }
}

/// The state of a gamepad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gamepad {
    /// The left stick, forwards positive, -1 to 1: feed.
    pub feed: f32,
    /// The right stick, to the right positive, -1 to 1: roll.
    pub roll: f32,
    /// Whether a shoulder button is held: faster.
    pub fast: bool,
    /// Whether it has motors that can be told to shake it.
    pub can_rumble: bool,
}

/// A tone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// Its frequency, in Hz; above 0.
    pub pitch_hz: f64,
    /// Its amplitude as a part of the most that can be played, 0 (silent) to 1.
    pub loudness: f64,
}

/// For how long a gamepad shakes, and a tone sounds, that is not told again, in ms.
pub const SHAKE_MS: f64 = 100.0;

/// How fast a tone follows what it is told, and fades, in s: fast enough for a force, too slow to click.
pub const FOLLOW_S: f64 = 0.015;

/// What a platform reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlatformEvent {
    /// A file was chosen or dropped.
    Chosen {
        /// Its name, with extension.
        name: String,
        /// Its bytes.
        bytes: Vec<u8>,
    },
    /// A link was followed.
    Linked {
        /// What stands behind `#` in it.
        fragment: String,
    },
    /// The surface that was kept: its name and its bytes, or nothing.
    Restored(Option<(String, Vec<u8>)>),
    /// The messages of a language that were asked for, or why they are not to be had.
    Texts {
        /// The language.
        language: Language,
        /// All its messages, one file after another.
        texts: Result<String, String>,
    },
    /// A scan was chosen or dropped.
    Scan {
        /// Its files.
        files: Vec<NamedFile>,
    },
    /// A file was saved, or two.
    Saved {
        /// One sentence: under which name, and where.
        message: String,
    },
    /// Something could not be done: one plain sentence.
    Failed {
        /// The sentence.
        message: String,
    },
}
