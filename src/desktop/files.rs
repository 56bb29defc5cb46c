//! File dialogs and files, each on a thread of its own so that no frame waits for a disk.

use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::thread;

use rfd::FileDialog;

use crate::app::PlatformEvent;

/// Extensions that can be opened: those of surfaces, and that of a trial's log.
const EXTENSIONS: [&str; 6] = ["stl", "ply", "obj", "glb", "gltf", "csv"];

/// Lets the user choose a file and reads it.
pub(super) fn choose(events: Sender<PlatformEvent>, ctx: egui::Context) {
    thread::spawn(move || {
        if let Some(path) = FileDialog::new().add_filter("Surfaces and logs", &EXTENSIONS).pick_file() {
            send(&events, &ctx, load(&path));
        }
    });
}

/// Reads a file.
pub(super) fn read(path: PathBuf, events: Sender<PlatformEvent>, ctx: egui::Context) {
    thread::spawn(move || send(&events, &ctx, load(&path)));
}

fn load(path: &std::path::Path) -> PlatformEvent {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    match std::fs::read(path) {
        Ok(bytes) => PlatformEvent::Chosen { name, bytes },
        Err(error) => PlatformEvent::Failed { message: format!("{name} could not be read: {error}.") },
    }
}

/// Lets the user choose where to and writes a file there.
pub(super) fn save(name: String, bytes: Vec<u8>, events: Sender<PlatformEvent>, ctx: egui::Context) {
    thread::spawn(move || {
        let Some(path) = FileDialog::new().set_file_name(&name).save_file() else { return };
        send(
            &events,
            &ctx,
            match std::fs::write(&path, bytes) {
                Ok(()) => PlatformEvent::Saved { name: path.display().to_string() },
                Err(error) => {
                    PlatformEvent::Failed { message: format!("{} could not be written: {error}.", path.display()) }
                }
            },
        );
    });
}

fn send(events: &Sender<PlatformEvent>, ctx: &egui::Context, event: PlatformEvent) {
    // The window may have been closed meanwhile; then nobody needs to know.
    if events.send(event).is_ok() {
        ctx.request_repaint();
    }
}
