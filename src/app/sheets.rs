//! The sheets over the window: keys and gestures, and what Lumen is.

use egui::{Grid, Id, Modal, RichText, Ui};

use crate::pipeline::report::DISCLAIMER;

/// A sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// Keys and gestures.
    Help,
    /// What Lumen is.
    About,
}

const KEYS: [(&str, &str); 20] = [
    ("Drag", "Turn"),
    ("Shift or right button + drag, two fingers", "Move"),
    ("Wheel, pinch", "Zoom towards the pointer"),
    ("Arrows, + and -", "Turn and zoom"),
    ("F, double click", "Fit into the view"),
    ("1 to 6", "Anterior, posterior, left, right, superior, inferior"),
    ("B, held", "The surface as it was opened"),
    ("R", "As opened and as it is now in one picture; drag the line between"),
    ("L", "Show what is left out; click a piece to keep it"),
    ("D", "Colour by deviation"),
    ("V", "The vessels and what became of their calibre"),
    ("C", "Compare several settings; Enter takes the focused one"),
    ("Ctrl+O", "Open"),
    ("Ctrl+S", "Save as STL"),
    ("Ctrl+Z", "Undo"),
    ("Ctrl+Shift+Z, Ctrl+Y", "Redo"),
    ("Esc", "Close what is on top, cancel, leave the comparison"),
    ("T", "Light or dark"),
    ("Tab", "Next control; arrows move a slider"),
    ("F1", "This sheet"),
];

/// What the keys do while a trial is shown.
const TRIAL_KEYS: [(&str, &str); 17] = [
    ("W and S, up and down", "Feed and withdraw the wire"),
    ("A and D, left and right", "Roll it left and right"),
    ("Shift with these", "Faster"),
    ("Gamepad (in a browser)", "Left stick feeds, right stick rolls"),
    ("G", "Autopilot"),
    ("Space", "Fluoroscopy on or off"),
    ("C", "A puff of contrast"),
    ("1 to 4", "C-arm: AP, LAO 45, LAT, RAO 30"),
    ("Drag in the fluoroscopy", "Turn the C-arm"),
    ("Wheel, pinch there", "Magnify"),
    ("R", "Restart"),
    ("P", "Pause"),
    ("Z", "A second back"),
    ("M", "Slow motion"),
    ("Esc", "Close what is on top, at last the trial"),
    ("Drag, wheel in the vessel's view", "Turn, zoom"),
    ("F1", "This sheet"),
];

/// Shows a sheet; says whether it should be closed. `in_trial`: whether a trial is shown, which has keys of its own.
pub(super) fn show(ui: &Ui, sheet: Sheet, in_trial: bool) -> bool {
    let frame = egui::Frame::popup(ui.style()).inner_margin(24.0);
    let response = Modal::new(Id::unique("sheet")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_max_width(560.0_f32.min(ui.ctx().content_rect().width() - 80.0));
        match sheet {
            Sheet::Help if in_trial => help(ui, &TRIAL_KEYS),
            Sheet::Help => help(ui, &KEYS),
            Sheet::About => about(ui),
        }
        ui.add_space(8.0);
        ui.vertical_centered(|ui| ui.button("Close").clicked()).inner
    });
    response.inner || response.should_close()
}

fn help(ui: &mut Ui, keys: &[(&str, &str)]) {
    ui.heading("Keys and gestures");
    ui.add_space(8.0);
    ui.spacing_mut().interact_size.y = 20.0;
    Grid::new("keys").num_columns(2).spacing([16.0, 6.0]).show(ui, |ui| {
        for &(key, what) in keys {
            ui.label(RichText::new(key).weak());
            ui.label(what);
            ui.end_row();
        }
    });
}

fn about(ui: &mut Ui) {
    ui.heading(format!("Lumen {}", env!("CARGO_PKG_VERSION")));
    ui.add_space(8.0);
    ui.label("Makes a blood-vessel surface from a CT or MR scan light enough to simulate on: keeps the largest piece, smooths it, reduces it.");
    ui.add_space(8.0);
    ui.label("Everything happens on this machine. No file, and no part of one, is sent anywhere.");
    ui.add_space(8.0);
    ui.label(RichText::new(DISCLAIMER).strong());
    ui.add_space(8.0);
    ui.label(RichText::new("Licence: MIT or Apache-2.0, as you choose.").weak());
}
