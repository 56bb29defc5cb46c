//! What the app needs of the machine it runs on; the desktop and the browser each have one.

use crate::engine::Link;

/// A platform. Nothing here blocks: what takes time arrives through [`Platform::poll`].
pub trait Platform {
    /// The line to the engine.
    fn link(&mut self) -> &mut dyn Link;

    /// Lets the user choose a file to open. Called while a click or key press is handled, as browsers demand.
    fn choose_file(&mut self, ctx: &egui::Context);

    /// Starts to read a file that was dropped on the window.
    fn read_dropped(&mut self, file: egui::DroppedFileHandle, ctx: &egui::Context);

    /// Gives the user a file: a save dialog or a download.
    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, ctx: &egui::Context);

    /// What has happened since.
    fn poll(&mut self) -> Option<PlatformEvent>;
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
    /// A file was saved under this name.
    Saved {
        /// Its name.
        name: String,
    },
    /// Something could not be done: one plain sentence.
    Failed {
        /// The sentence.
        message: String,
    },
}
