//! The sheets over the window: keys and gestures, and what Lumen is.

use egui::{Grid, Id, Label, Modal, RichText, ScrollArea, Ui};

use super::assist::heading;
use super::lesson::glossary;
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
}

const KEYS: [(Key, Key); 24] = [
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
    (Key("app-key-vessels"), Key("app-key-vessels-does")),
    (Key("app-key-measure"), Key("app-key-measure-does")),
    (Key("app-key-compare"), Key("app-key-compare-does")),
    (Key("app-key-compare-first"), Key("app-key-compare-first-does")),
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

/// What the keys do while a trial is shown.
const TRIAL_KEYS: [(Key, Key); 18] = [
    (Key("app-trial-key-feed"), Key("app-trial-key-feed-does")),
    (Key("app-trial-key-roll"), Key("app-trial-key-roll-does")),
    (Key("app-trial-key-faster"), Key("app-trial-key-faster-does")),
    (Key("app-trial-key-gamepad"), Key("app-trial-key-gamepad-does")),
    (Key("app-trial-key-autopilot"), Key("app-trial-key-autopilot-does")),
    (Key("app-trial-key-fluoroscopy"), Key("app-trial-key-fluoroscopy-does")),
    (Key("app-trial-key-enlarge"), Key("app-trial-key-enlarge-does")),
    (Key("app-trial-key-contrast"), Key("app-trial-key-contrast-does")),
    (Key("app-trial-key-arm"), Key("app-trial-key-arm-does")),
    (Key("app-trial-key-turn-arm"), Key("app-trial-key-turn-arm-does")),
    (Key("app-trial-key-magnify"), Key("app-trial-key-magnify-does")),
    (Key("app-trial-key-restart"), Key("app-trial-key-restart-does")),
    (Key("app-trial-key-pause"), Key("app-trial-key-pause-does")),
    (Key("app-trial-key-back"), Key("app-trial-key-back-does")),
    (Key("app-trial-key-slow"), Key("app-trial-key-slow-does")),
    (Key("app-trial-key-escape"), Key("app-trial-key-escape-does")),
    (Key("app-trial-key-view"), Key("app-trial-key-view-does")),
    (Key("app-trial-key-sheet"), Key("app-trial-key-sheet-does")),
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
            Sheet::Glossary => words(ui),
        }
        ui.add_space(8.0);
        ui.vertical_centered(|ui| ui.button(say!("app-close")).clicked()).inner
    });
    response.inner || response.should_close()
}

fn help(ui: &mut Ui, keys: &[(Key, Key)]) {
    heading(ui, &say!("app-keys"));
    ui.add_space(8.0);
    let before = std::mem::replace(&mut ui.spacing_mut().interact_size.y, 20.0);
    Grid::new("keys").num_columns(2).spacing([16.0, 6.0]).show(ui, |ui| {
        for &(key, what) in keys {
            ui.label(RichText::new(key.say()).weak());
            ui.label(what.say());
            ui.end_row();
        }
    });
    if theme::suits_finger(ui.ctx()) {
        // For the button below.
        ui.spacing_mut().interact_size.y = before;
    }
}

fn words(ui: &mut Ui) {
    heading(ui, &say!("app-glossary"));
    ui.add_space(8.0);
    // Heading, button and margins stay in the window.
    let height = ui.ctx().content_rect().height() - 260.0;
    ScrollArea::vertical().max_height(height.max(120.0)).show(ui, |ui| {
        for (word, meaning) in glossary() {
            ui.label(RichText::new(word).strong());
            ui.add(Label::new(meaning).wrap());
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
