//! Files that come and go, and what outlives the app.

use crate::engine::Frame;

/// What files end in that are no surfaces, and are opened like them: a trial's log, settings, a lesson.
pub const OTHER_ENDINGS: [&str; 3] = ["csv", "json", "lesson"];

/// Files: chosen, dropped, and given to the user.
pub trait Files {
    /// Lets the user choose a file to open. Called while a click or key press is handled, as browsers demand.
    fn choose_file(&mut self, ctx: &egui::Context);

    /// Starts to read the files that were dropped on the window, at least one: a scan may stand in several.
    fn read_dropped(&mut self, files: Vec<egui::DroppedFileHandle>, ctx: &egui::Context);

    /// Starts to read the files that came with the last ([`PlatformEvent::More`](super::PlatformEvent::More)), as if they had
    /// been dropped.
    fn open_next(&mut self);

    /// Gives the user a file: a save dialog or a download.
    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, ctx: &egui::Context);

    /// Gives the user a file and one that belongs to it: a save dialog for the first, beside which the second goes under
    /// the same stem, or two downloads.
    fn offer_pair(&mut self, pair: [Offer; 2], ctx: &egui::Context);
}

/// Videos of frames that the app has drawn.
pub trait Video {
    /// Whether there can be one.
    fn has_video(&self) -> bool {
        false
    }

    /// Makes a video of frames of one size, each of which is seen for so long, and gives it to the user.
    fn offer_video(&mut self, _name: &str, _frames: Vec<Frame>, _pause_ms: u16) {}
}

/// A file for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Where something may be kept.
pub trait Storage {
    /// What outlives the app; `None` where nothing does.
    fn store(&mut self) -> Option<&mut dyn Store> {
        None
    }
}

/// What outlives the app, on this device alone. Where the system keeps nothing, the next start begins anew.
pub trait Store {
    /// The text that was kept.
    fn text(&self) -> Option<String>;

    /// Keeps a text in place of the one before.
    fn set_text(&mut self, text: &str);

    /// Keeps a surface in place of the one before. A failure is told as an event.
    fn keep_surface(&mut self, name: &str, bytes: &[u8]);

    /// Asks for the surface that is kept: [`PlatformEvent::Restored`](super::PlatformEvent::Restored) has it.
    fn restore_surface(&mut self);

    /// Forgets the surface that is kept.
    fn forget_surface(&mut self);

    /// Forgets everything.
    fn forget(&mut self);
}
