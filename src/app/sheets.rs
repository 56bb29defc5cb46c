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

const KEYS: [(&str, &str); 18] = [
    ("Drag", "Turn"),
    ("Shift or right button + drag, two fingers", "Move"),
    ("Wheel, pinch", "Zoom towards the pointer"),
    ("Arrows, + and -", "Turn and zoom"),
    ("F, double click", "Fit into the view"),
    ("1 to 6", "Anterior, posterior, left, right, superior, inferior"),
    ("B, held", "The surface as it was opened"),
    ("L", "Show what is left out; click a piece to keep it"),
    ("D", "Colour by deviation"),
    ("C", "Compare several settings; Enter takes the focused one"),
    ("Ctrl+O", "Open"),
    ("Ctrl+S", "Save as STL"),
    ("Ctrl+Z", "Undo"),
    ("Ctrl+Shift+Z, Ctrl+Y", "Redo"),
    ("Esc", "Cancel what is going on, or close this"),
    ("T", "Light or dark"),
    ("Tab", "Next control; arrows move a slider"),
    ("F1", "This sheet"),
];

/// Shows a sheet; says whether it should be closed.
pub(super) fn show(ui: &Ui, sheet: Sheet) -> bool {
    let frame = egui::Frame::popup(ui.style()).inner_margin(24.0);
    let response = Modal::new(Id::unique("sheet")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_max_width(560.0_f32.min(ui.ctx().content_rect().width() - 80.0));
        match sheet {
            Sheet::Help => help(ui),
            Sheet::About => about(ui),
        }
        ui.add_space(8.0);
        ui.vertical_centered(|ui| ui.button("Close").clicked()).inner
    });
    response.inner || response.should_close()
}

fn help(ui: &mut Ui) {
    ui.heading("Keys and gestures");
    ui.add_space(8.0);
    ui.spacing_mut().interact_size.y = 20.0;
    Grid::new("keys").num_columns(2).spacing([16.0, 6.0]).show(ui, |ui| {
        for (key, what) in KEYS {
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
