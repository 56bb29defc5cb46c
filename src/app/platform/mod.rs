//! What the app needs of the machine it runs on. The desktop, the browser and the memory of tests each have one.
//!
//! A trait for each concern, with defaults where a platform may lack it: [`Engines`], [`Files`], [`Video`] and [`Storage`]
//! (`files`), [`Screen`], [`Sharing`] and [`Languages`] (`screen`), [`Hands`] and [`Sound`] (`hands`). [`Platform`] is
//! all of them.

mod files;
mod hands;
mod screen;

use std::sync::{Arc, Mutex, PoisonError};

pub use self::files::{Files, OTHER_ENDINGS, Offer, Storage, Store, Video};
pub use self::hands::{Devices, FOLLOW_S, Gamepad, Hands, Listing, SHAKE_MS, Sound, Tone};
pub use self::screen::{Languages, Screen, Sharing};
use crate::engine::Link;
use crate::engine::scan::{NamedFile, ScanLink};
use crate::engine::trial::TrialLink;
use crate::language::Language;

/// A platform. Nothing here blocks: what takes time arrives through [`Platform::poll`].
pub trait Platform: Engines + Files + Video + Storage + Screen + Sharing + Languages + Hands + Sound {
    /// The app goes on in another window: whatever has news wakes this one from now on.
    fn enter(&mut self, ctx: &egui::Context);

    /// What has happened since.
    fn poll(&mut self) -> Option<PlatformEvent>;
}

/// The lines to the engines.
pub trait Engines {
    /// The line to the engine.
    fn link(&mut self) -> &mut dyn Link;

    /// The line to the trial, which has a machine of its own so that neither stalls the other.
    fn trial(&mut self) -> &mut TrialLink;

    /// The line to the engine of scans; `None` where the platform has none.
    fn scans(&mut self) -> Option<&mut ScanLink> {
        None
    }

    /// The most memory, in bytes, that an engine can have; `None` where it is the machine's.
    fn memory_limit(&self) -> Option<u64> {
        None
    }
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
    /// These came with the file that was chosen or dropped: [`Files::open_next`] reads them.
    More {
        /// Their names, at least one.
        names: Vec<String>,
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
