//! What stands around the grid of the compare view: above it a bar with what can be done and what the colours say, below it
//! what all cells share.

use egui::{ComboBox, Rect, RichText, Role, Sense, Ui, vec2};

use super::action::Action as OfComparison;
use super::arrangement::Arrangement;
use super::comparison::{Cell, Comparison, MAX_COMPARED, Outcome};
use super::difference::Difference;
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::icon::{self, Icon};
use crate::app::menus::icon_menu;
use crate::app::state::State;
use crate::app::{record, reference};
use crate::language::decimal;
use crate::pipeline::settings::Settings;
use crate::render::viridis;
use crate::say;

/// Cells of more triangles may turn jerkily.
const MANY: usize = 300_000;

/// What can be done; whether the button that shows the first settings everywhere is held. A phone has room for one row: the
/// rest is in a menu.
pub(super) fn bar(ui: &mut Ui, state: &State, is_narrow: bool, shows_first: bool, asked: &mut Vec<Action>) -> bool {
    let State { comparison, settings, against, .. } = state;
    let file = against.source.as_ref().map(|source| source.label());
    let file = file.as_deref();
    let mut is_held = false;
    let mut ask = |action: Action| asked.push(action);
    ui.horizontal_wrapped(|ui| {
        begin(ui, comparison, settings, is_narrow, &mut ask);
        if !is_narrow {
            let list =
                ComboBox::from_id_salt("arrangement").width(96.0).selected_text(comparison.arrangement.label().say());
            let response = list.show_ui(ui, |ui| arrangements(ui, comparison, &mut ask));
            name(&response.response, Role::ComboBox, &say!("compare-show-as"));
        }
        let flicker = egui::Button::new(say!("compare-first")).sense(Sense::click_and_drag()).selected(shows_first);
        let flicker = ui.add_enabled(comparison.cells().len() > 1, flicker);
        is_held = flicker.on_hover_text(say!("compare-first-help")).is_pointer_button_down_on();
        let help = say!("compare-done-help");
        let is_done = if is_narrow {
            icon_menu(ui, Icon::Menu, &say!("compare-more"), &say!("compare-more-help"), &mut |ui| {
                arrangements(ui, comparison, &mut ask);
                ui.separator();
                others(ui, comparison, file, &mut ask);
            });
            icon::button(ui, Icon::Close, true, &say!("compare-done"), &help).clicked()
        } else {
            others(ui, comparison, file, &mut ask);
            ui.button(say!("compare-done")).on_hover_text(help).clicked()
        };
        if is_done {
            ask(Action::Comparison(OfComparison::Close));
        }
    });
    is_held
}

/// What is to be compared.
fn begin(ui: &mut Ui, comparison: &Comparison, settings: &Settings, is_narrow: bool, asked: &mut dyn FnMut(Action)) {
    let add = if is_narrow { say!("compare-add-short") } else { say!("compare-add") };
    let add = ui.add_enabled(comparison.can_add(settings), egui::Button::new(add));
    name(&add, Role::Button, &say!("compare-add-long"));
    let why_not =
        if comparison.cells().len() >= MAX_COMPARED { say!("compare-full") } else { say!("compare-there-already") };
    if add.on_hover_text(say!("compare-add-help")).on_disabled_hover_text(why_not).clicked() {
        asked(Action::Comparison(OfComparison::Add));
    }
    if ui.button(say!("compare-figure-6")).on_hover_text(say!("compare-figure-6-help")).clicked() {
        asked(Action::Comparison(OfComparison::Figure6));
    }
    if ui.button(say!("compare-figure-7")).on_hover_text(say!("compare-figure-7-help")).clicked() {
        asked(Action::Comparison(OfComparison::Figure7));
    }
}

/// How the pictures may stand.
fn arrangements(ui: &mut Ui, comparison: &Comparison, asked: &mut dyn FnMut(Action)) {
    for choice in Arrangement::ALL {
        let entry = ui.selectable_label(choice == comparison.arrangement, choice.label().say());
        if entry.on_hover_text(choice.help().say()).clicked() {
            asked(Action::Comparison(OfComparison::Arrange(choice)));
        }
    }
}

/// Colours for the difference from the first, the ways to where it is largest and back, another `file` that is compared, and
/// the picture for a file.
fn others(ui: &mut Ui, comparison: &Comparison, file: Option<&str>, asked: &mut dyn FnMut(Action)) {
    let toggle = egui::Button::new(say!("compare-difference")).selected(comparison.shows_difference);
    let toggle = ui.add_enabled(comparison.cells().len() > 1, toggle);
    if toggle.on_hover_text(say!("compare-difference-help")).clicked() {
        asked(Action::Comparison(OfComparison::Difference));
    }
    let patch = comparison.largest_difference().and_then(Difference::patch);
    let go = ui.add_enabled(patch.is_some(), egui::Button::new(say!("compare-most")));
    let go = go.on_hover_text(say!("compare-most-help"));
    if let Some((at, height_mm)) = patch.filter(|_| go.clicked()) {
        asked(Action::LookAt { at_mm: at.into(), height_mm });
    }
    if ui.button(say!("reference-open")).on_hover_text(say!("reference-open-help")).clicked() {
        asked(Action::Reference(reference::action::Action::Choose));
    }
    if let Some(file) = file
        && ui.button(say!("reference-back", name = file)).on_hover_text(say!("reference-back-help")).clicked()
    {
        asked(Action::Reference(reference::action::Action::Show(true)));
    }
    if ui.button(say!("compare-whole")).on_hover_text(say!("compare-whole-help")).clicked() {
        asked(Action::Fit);
    }
    let save = ui.add_enabled(comparison.made().is_some(), egui::Button::new(say!("record-figure")));
    if save.on_hover_text(say!("record-figure-help")).clicked() {
        asked(Action::Record(record::Action::Figure));
    }
}

/// What the colours of the difference say.
pub(super) fn legend(ui: &mut Ui, comparison: &Comparison) {
    const STEPS: usize = 48;
    ui.horizontal_wrapped(|ui| {
        let small = |text: String| RichText::new(text).small();
        let Some(most) = comparison.colours_up_to_mm() else {
            let is_coming = comparison.is_busy();
            let text = if is_coming { say!("compare-distance-coming") } else { say!("compare-distance-unknown") };
            ui.label(small(text));
            return;
        };
        ui.label(small(say!("compare-distance-from")));
        let (bar, _) = ui.allocate_exact_size(vec2(96.0, 10.0), Sense::hover());
        let width = bar.width() / STEPS as f32;
        for i in 0..STEPS {
            let [r, g, b] = viridis(i as f32 / STEPS as f32).0;
            let corner = bar.left_top() + vec2(width * i as f32, 0.0);
            let piece = Rect::from_min_size(corner, vec2(width + 0.5, bar.height()));
            ui.painter().rect_filled(piece, 0.0, egui::Color32::from_rgb(r, g, b));
        }
        ui.label(small(say!("compare-distance-to", most = decimal(most, 3))));
    });
}

/// A word on cells that are slow to draw, if there are any.
pub(super) fn slow(comparison: &Comparison) -> String {
    let is_large = |cell: &Cell| matches!(&cell.outcome, Outcome::Done(made) if made.mesh.triangles.len() > MANY);
    if comparison.cells().iter().any(is_large) { say!("compare-slow", count = MANY) } else { String::new() }
}

/// What all cells share; on a phone, whose bar has no room for it, that it is not for clinical decisions.
pub(super) fn footer(ui: &mut Ui, document: &str, shared: &str, slow: &str, is_narrow: bool) {
    let text = [document, shared, slow].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("  ·  ");
    ui.spacing_mut().item_spacing.y = 0.0;
    ui.add(egui::Label::new(RichText::new(&text).small().weak()).truncate()).on_hover_text(text.clone());
    if is_narrow {
        ui.label(RichText::new(say!("about-not-clinical")).small().weak());
    }
}
