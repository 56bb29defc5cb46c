//! The sheets over the window: keys and gestures, what Lumen is, and what a report is to have.

use egui::{Grid, Id, Modal, RichText, ScrollArea, Ui};

use super::assist::heading;
use super::lesson::glossary;
use super::row::wrapped;
use super::theme;
use crate::language::Key;
use crate::say;

/// A sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// Keys and gestures.
    Help,
    /// What Lumen is.
    About,
    /// The words of the method.
    Glossary,
    /// What a report is to have.
    Report,
}

/// What keys and gestures do in the views. Those of the panels come after them.
const IN_VIEWS: [(Key, Key); 11] = [
    (Key("app-key-drag"), Key("app-key-drag-does")),
    (Key("app-key-move"), Key("app-key-move-does")),
    (Key("app-key-zoom"), Key("app-key-zoom-does")),
    (Key("app-key-arrows"), Key("app-key-arrows-does")),
    (Key("app-key-fit"), Key("app-key-fit-does")),
    (Key("app-key-sides"), Key("app-key-sides-does")),
    (Key("app-key-before"), Key("app-key-before-does")),
    (Key("app-key-split"), Key("app-key-split-does")),
    (Key("app-key-left-out"), Key("app-key-left-out-does")),
    (Key("app-key-deviation"), Key("app-key-deviation-does")),
    (Key("app-key-raking"), Key("app-key-raking-does")),
];

/// What fingers do in the views, where one points.
const BY_FINGER: [(Key, Key); 3] = [
    (Key("app-touch-one"), Key("app-key-drag-does")),
    (Key("app-touch-two"), Key("app-touch-two-does")),
    (Key("app-touch-double"), Key("app-key-fit-does")),
];

/// What the other keys do.
const OTHERS: [(Key, Key); 9] = [
    (Key("app-key-present"), Key("app-key-present-does")),
    (Key("app-key-open"), Key("app-key-open-does")),
    (Key("app-key-save"), Key("app-key-save-does")),
    (Key("app-key-undo"), Key("app-key-undo-does")),
    (Key("app-key-redo"), Key("app-key-redo-does")),
    (Key("app-key-escape"), Key("app-key-escape-does")),
    (Key("app-key-theme"), Key("app-key-theme-does")),
    (Key("app-key-tab"), Key("app-key-tab-does")),
    (Key("app-key-sheet"), Key("app-key-sheet-does")),
];

/// The lines of the sheet of keys: those that the mode has for itself, or else those of views and panels.
pub(super) fn keys(of_mode: Option<&[(Key, Key)]>, of_panels: &[(Key, Key)]) -> Vec<(Key, Key)> {
    of_mode.map_or_else(|| [&IN_VIEWS[..], of_panels, &OTHERS[..]].concat(), <[_]>::to_vec)
}

/// Shows a sheet; says whether it should be closed. `keys` are the lines of that of keys, `report` shows that of a report.
pub(super) fn show(ui: &Ui, sheet: Sheet, keys: &[(Key, Key)], report: &mut dyn FnMut(&mut Ui)) -> bool {
    let frame = egui::Frame::popup(ui.style()).inner_margin(24.0);
    let response = Modal::new(Id::unique("sheet")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_max_width(560.0_f32.min(ui.ctx().content_rect().width() - 80.0));
        match sheet {
            Sheet::Help => help(ui, keys),
            Sheet::About => about(ui),
            Sheet::Glossary => words(ui),
            Sheet::Report => report(ui),
        }
        ui.add_space(8.0);
        ui.vertical_centered(|ui| ui.button(say!("app-close")).clicked()).inner
    });
    response.inner || response.should_close()
}

fn help(ui: &mut Ui, keys: &[(Key, Key)]) {
    heading(ui, &say!("app-keys"));
    ui.add_space(8.0);
    let rows = |ui: &mut Ui, name: &str, rows: &[(Key, Key)]| {
        if theme::is_narrow(ui.ctx()) {
            // No room for two columns.
            for (key, what) in rows {
                ui.label(RichText::new(key.say()).weak());
                ui.label(what.say());
                ui.add_space(6.0);
            }
            return;
        }
        let widest = 0.6 * ui.available_width();
        Grid::new(name).num_columns(2).spacing([16.0, 6.0]).max_col_width(widest).show(ui, |ui| {
            for (key, what) in rows {
                ui.label(RichText::new(key.say()).weak());
                ui.label(what.say());
                ui.end_row();
            }
        });
    };
    let has_finger = theme::suits_finger(ui.ctx());
    ScrollArea::vertical().max_height(height_inside(ui)).show(ui, |ui| {
        // Rows of words are lower than those of controls.
        ui.spacing_mut().interact_size.y = 20.0;
        if has_finger {
            rows(ui, "fingers", &BY_FINGER);
            ui.add_space(8.0);
            ui.label(RichText::new(say!("app-keys-keyboard")).strong());
            ui.add_space(8.0);
        }
        rows(ui, "keys", keys);
    });
}

/// The height that is left for what scrolls in a sheet: its heading, button and margins stay in the window.
fn height_inside(ui: &Ui) -> f32 {
    (ui.ctx().content_rect().height() - 200.0).max(120.0)
}

fn words(ui: &mut Ui) {
    heading(ui, &say!("app-glossary"));
    ui.add_space(8.0);
    ScrollArea::vertical().max_height(height_inside(ui)).show(ui, |ui| {
        for (word, meaning) in glossary() {
            ui.label(RichText::new(word).strong());
            wrapped(ui, &meaning, |text| text);
            ui.add_space(6.0);
        }
    });
}

fn about(ui: &mut Ui) {
    heading(ui, concat!("Lumen ", env!("CARGO_PKG_VERSION")));
    ui.add_space(8.0);
    ui.label(say!("app-about-purpose"));
    ui.add_space(8.0);
    ui.label(say!("app-about-privacy"));
    ui.add_space(8.0);
    ui.label(RichText::new(format!("{}.", say!("about-not-clinical"))).strong());
    ui.add_space(8.0);
    ui.label(say!("app-about-method"));
    ui.add_space(8.0);
    ui.label(RichText::new(say!("app-about-licence")).weak());
    ui.label(RichText::new(say!("app-about-letters")).weak());
}
