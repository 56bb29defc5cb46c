//! The app's line to the engine of scans, whose program is another (`web/scan`).
//!
//! Its Worker is started right after the first picture and fetches the program then, whole: no request depends on what is
//! opened later. Until it is there what is asked waits. Files are handed over as they are, for the Worker to read.

use js_sys::{Array, Object, Reflect};
use lumen::app::Waker;
use lumen::engine::Link;
use lumen::engine::scan::{Contents, NamedFile, ScanCommand, ScanEvent, ScanWork};
use lumen::say;
use wasm_bindgen::JsValue;
use web_sys::File;

use crate::job::Scan;
use crate::link::WorkerLink;

/// Endings of files that hold a scan; those of DICOM often have none.
pub(crate) const ENDINGS: [&str; 12] =
    ["nii", "gz", "hdr", "img", "nrrd", "nhdr", "mha", "mhd", "raw", "zraw", "vti", "dcm"];

/// By the time that the app asks so often for news, its first picture is drawn.
const FIRST_PICTURE: u32 = 3;

/// The line to the engine of scans.
pub(crate) struct ScanLine {
    link: WorkerLink<Scan>,
    /// How often the app has asked for news.
    asks: u32,
    /// Whether anything was asked of the Worker that there is.
    is_asked: bool,
    /// Whether the app is to be told that it has to wait.
    is_awaited: bool,
    /// The number of the next file.
    next: u32,
    /// Whether a scan is being opened, and whether the Worker holds one.
    opens: bool,
    holds: bool,
    /// Whether the app is to be told that the opening has been stopped.
    is_cancelled: bool,
}

impl ScanLine {
    /// A line whose Worker is not there yet.
    pub(crate) fn new(waker: Waker) -> Self {
        Self {
            link: WorkerLink::idle(waker),
            asks: 0,
            is_asked: false,
            is_awaited: false,
            next: 0,
            opens: false,
            holds: false,
            is_cancelled: false,
        }
    }

    /// Lets the engine speak so.
    pub(crate) fn speak(&mut self, speech: Object) {
        self.link.speak(speech);
    }

    /// Whether the app's first picture has been drawn.
    pub(crate) fn has_picture(&self) -> bool {
        self.asks >= FIRST_PICTURE
    }

    /// Hands files over to the Worker, and names them for the engine.
    pub(crate) fn hand_over(&mut self, files: &[File]) -> Vec<NamedFile> {
        let first = self.next;
        let values = Array::of1(&JsValue::from_f64(f64::from(first)));
        let named = files.iter().zip(first..).map(|(file, number)| {
            values.push(file);
            NamedFile { name: file.name(), contents: Contents::Shelved { number, bytes: file.size() as u64 } }
        });
        let named: Vec<NamedFile> = named.collect();
        self.next += named.len() as u32;
        self.is_asked = true;
        self.link.send_beside(&values);
        named
    }
}

impl Link<ScanCommand, ScanEvent> for ScanLine {
    fn send(&mut self, command: ScanCommand) {
        let is_let_go = match command {
            ScanCommand::Close => true,
            // What has been read of it by now.
            ScanCommand::Cancel => self.opens && !self.holds,
            _ => false,
        };
        if is_let_go && is_kept() {
            // A program never gives memory back: another takes its place, out of what the service worker keeps.
            self.is_cancelled = command == ScanCommand::Cancel;
            self.restart();
            return self.link.wake();
        }
        match command {
            ScanCommand::Open { .. } => self.opens = true,
            ScanCommand::Close => self.holds = false,
            _ => {}
        }
        self.is_awaited = !self.link.is_ready() && matches!(command, ScanCommand::Open { .. });
        self.is_asked = true;
        self.link.send(command);
    }

    fn poll(&mut self) -> Option<ScanEvent> {
        self.asks = self.asks.saturating_add(1);
        if self.asks == FIRST_PICTURE && !self.link.has_begun() {
            self.link.restart();
        }
        if std::mem::take(&mut self.is_awaited) {
            return Some(ScanEvent::Progress { work: ScanWork::Fetching, fraction: 0.0 });
        }
        if std::mem::take(&mut self.is_cancelled) {
            return Some(ScanEvent::Cancelled);
        }
        let event = self.link.poll()?;
        match event {
            ScanEvent::Opened(_) => (self.opens, self.holds) = (false, true),
            ScanEvent::Refused { .. } | ScanEvent::Cancelled => self.opens = false,
            _ => {}
        }
        Some(event)
    }

    fn restart(&mut self) {
        (self.is_asked, self.opens, self.holds) = (false, false, false);
        self.link.restart();
    }

    fn give_up(&mut self) {
        (self.is_asked, self.opens, self.holds) = (false, false, false);
        // One that has begun can begin again, and does so now, not with the next scan.
        if self.link.is_ready() { self.link.restart() } else { self.link.give_up() }
    }

    fn failure(&mut self) -> Option<String> {
        let reason = self.link.failure()?;
        if self.is_asked && self.link.is_ready() {
            return Some(reason);
        }
        // There may be no network now: the next scan that is opened tries again.
        self.link.give_up();
        let was_asked = std::mem::take(&mut self.is_asked);
        was_asked.then(|| say!("scan-not-fetched", reason = reason))
    }
}

/// Whether the service worker answers for the build's files, so that no request leaves the machine.
fn is_kept() -> bool {
    let Some(window) = web_sys::window() else { return false };
    // A page without a secure origin has none.
    let container = Reflect::get(&window.navigator(), &"serviceWorker".into());
    let controller = container.and_then(|container| Reflect::get(&container, &"controller".into()));
    controller.is_ok_and(|controller| controller.is_truthy())
}
