//! The bars: files and help above, what is going on below.

use egui::{Button, Response, RichText, Role, Ui};

use super::action::Action;
use super::assist::name;
use super::control::progress;
use super::icon::{self, Icon};
use super::state::State;
use super::views::{Colours, ViewOptions, Views};
use super::{recovery, sharing, vessels};
use crate::digits::grouped;
use crate::io::{Axes, Format, Unit};
use crate::phantom::Sample;
use crate::render::StandardView;

/// What else is shown.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    /// A trial.
    pub(super) in_trial: bool,
    /// A scan, before there is a surface of it.
    pub(super) in_scan: bool,
    /// The window is that of a phone, where only what is needed most has a button of its own.
    pub(super) is_narrow: bool,
    /// The vessels' calibre.
    pub(super) are_vessels_open: bool,
    /// Whether surfaces are kept on this device, where they can be.
    pub(super) keeps_surface: Option<bool>,
    /// Links can be made here.
    pub(super) has_links: bool,
}

impl Shown {
    /// Whether the two views are shown.
    fn are_views(&self, state: &State) -> bool {
        !(self.in_trial || self.in_scan || state.comparison.is_open())
    }
}

/// The bar above.
pub(super) fn top(ui: &mut Ui, state: &State, views: &Views, shown: Shown, asked: &mut Vec<Action>) {
    let mut ask = |wanted: bool, what: Action| {
        if wanted {
            asked.push(what);
        }
    };
    ui.horizontal_centered(|ui| {
        if !shown.is_narrow {
            ui.label(RichText::new("Lumen").heading().strong());
            ui.add_space(8.0);
        }
        ask(
            ui.button("Open...").on_hover_text("A surface or settings (Ctrl+O); or drop a file").clicked(),
            Action::Open,
        );
        let open_in = ui.menu_button("Open in", |ui| {
            for unit in Unit::ALL {
                ask(ui.button(format!("{unit}...")).clicked(), Action::OpenIn(unit));
            }
        });
        open_in.response.on_hover_text("Open a file whose numbers are in another unit than mm (glTF: m)");
        ui.menu_button("Sample", |ui| {
            for sample in Sample::ALL {
                ask(ui.button(sample.label()).clicked(), Action::Sample(sample));
            }
        });
        let has_result = state.document.as_ref().is_some_and(|document| document.shown.is_some());
        ui.add_enabled_ui(has_result, |ui| {
            ui.menu_button("Save", |ui| {
                for format in Format::ALL {
                    let text = format!("{}...", format.label());
                    let unit = format!("Lengths in {}", format.unit());
                    ask(ui.button(text).on_hover_text(unit).clicked(), Action::Save(format));
                }
                ui.label(RichText::new("Lengths in mm; in m for glTF").small().weak());
                ui.separator();
                let has_vessels = state.calibre().is_some_and(|calibre| calibre.found.is_ok());
                ui.add_enabled_ui(has_vessels, |ui| {
                    for (text, what, help) in vessels::FILES {
                        ask(ui.button(text).on_hover_text(help).clicked(), Action::Vessels(what));
                    }
                });
                ui.separator();
                let help = "For whoever has the same file, and for lumen optimise --settings; opened as a surface is";
                let save = ui.button("Settings...").on_hover_text(help).clicked();
                ask(save, Action::Share(sharing::Action::SaveSettings));
                if shown.has_links {
                    let help = "The settings and the first digits of the file's hash, and nothing of the surface";
                    let copy = ui.button("Copy link").on_hover_text(help).clicked();
                    ask(copy, Action::Share(sharing::Action::CopyLink));
                }
                if let Some(mut keeps) = shown.keeps_surface {
                    ui.separator();
                    kept_here(ui, &mut keeps, &mut ask);
                }
            });
        });
        if shown.is_narrow {
            let menu = icon::button(ui, Icon::Menu, true, "Menu", "More");
            egui::Popup::menu(&menu).show(|ui| more(ui, state, views, shown, &mut ask));
        } else {
            ui.separator();
            let can_undo = state.history.can_undo();
            ask(icon::button(ui, Icon::Undo, can_undo, "Undo", "Undo (Ctrl+Z)").clicked(), Action::Undo);
            let can_redo = state.history.can_redo();
            ask(icon::button(ui, Icon::Redo, can_redo, "Redo", "Redo (Ctrl+Shift+Z)").clicked(), Action::Redo);
            ui.separator();
            ui.add_enabled_ui(shown.are_views(state), |ui| {
                let is_split = state.document.as_ref().is_some_and(|document| views.reveals(document));
                let split = ui.add(Button::new("Split").selected(is_split));
                let help = "As opened and as it is now in one picture; drag the line between them (R)";
                ask(split.on_hover_text(help).clicked(), Action::Reveal);
                before_button(ui, views, &mut ask);
            });
            ask(
                compare(ui, state, shown).on_hover_text("Several settings side by side (C)").clicked(),
                Action::Compare,
            );
            let help = "Steer a guidewire through the level that is shown";
            ask(trial(ui, state, shown).on_hover_text(help).clicked(), Action::ToggleTrial);
            let help = "The vessels, and what smoothing and reduction made of the calibre of each (V)";
            ask(
                vessels_button(ui, state, shown).on_hover_text(help).clicked(),
                Action::Vessels(vessels::Action::Toggle),
            );
            ui.menu_button("View", |ui| view_menu(ui, state, views.options, &mut ask));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ask(ui.button("About").clicked(), Action::About);
                ask(ui.button("Help").on_hover_text("Keys and gestures (F1)").clicked(), Action::Help);
                ask(icon::button(ui, Icon::Theme, true, "Theme", "Light or dark (T)").clicked(), Action::Theme);
            });
        }
    });
}

/// What is kept on this device.
fn kept_here(ui: &mut Ui, keeps: &mut bool, ask: &mut impl FnMut(bool, Action)) {
    let help =
        "The file itself, for the next start, in this browser; otherwise only its name, the settings and the view";
    let chosen = ui.checkbox(keeps, "Keep this surface on this device").on_hover_text(help).changed();
    ask(chosen, Action::Recovery(recovery::Action::KeepSurface(*keeps)));
    let help = "Settings, names and surfaces that are kept in this browser";
    let forget = ui.button("Forget what is kept here").on_hover_text(help).clicked();
    ask(forget, Action::Recovery(recovery::Action::Forget));
}

fn compare(ui: &mut Ui, state: &State, shown: Shown) -> Response {
    ui.add_enabled(!(shown.in_trial || shown.in_scan), Button::new("Compare").selected(state.comparison.is_open()))
}

fn trial(ui: &mut Ui, state: &State, Shown { in_trial, in_scan, .. }: Shown) -> Response {
    let has_level = state.document.as_ref().is_some_and(|document| document.shown.is_some());
    ui.add_enabled(has_level && !in_scan || in_trial, Button::new("Trial").selected(in_trial))
}

fn vessels_button(ui: &mut Ui, state: &State, shown: Shown) -> Response {
    let is_open = shown.are_vessels_open;
    let has_level = state.document.as_ref().is_some_and(|document| document.shown.is_some());
    ui.add_enabled(has_level && shown.are_views(state) || is_open, Button::new("Vessels").selected(is_open))
}

/// Shows the surface as it was opened for as long as it is held.
fn before_button(ui: &mut Ui, views: &Views, ask: &mut impl FnMut(bool, Action)) {
    let response = ui.add(Button::new("Before").sense(egui::Sense::click_and_drag()).selected(views.show_before));
    let response = response.on_hover_text("Hold to see the surface as it was opened (or hold B)");
    let is_held = response.is_pointer_button_down_on();
    ask(is_held != views.before_is_held, Action::HoldBefore(is_held));
}

fn view_menu(ui: &mut Ui, state: &State, options: ViewOptions, ask: &mut impl FnMut(bool, Action)) {
    ask(ui.button("Fit").clicked(), Action::Fit);
    ui.separator();
    // The sides are those of LPS: of other axes they are sides of the surface alone.
    let is_lps = state.document.as_ref().is_some_and(|document| document.import.axes == Axes::Lps);
    for view in StandardView::ALL {
        ask(ui.button(view.label(is_lps)).clicked(), Action::View(view));
    }
    ui.separator();
    let mut chosen = options;
    ui.checkbox(&mut chosen.flat, "Flat triangles").on_hover_text("Each triangle with its own normal");
    ui.checkbox(&mut chosen.see_through, "See-through wireframe").on_hover_text("Shows hidden lines, faintly");
    let maps = [
        (
            Colours::Deviation,
            "Colour by deviation",
            "Mean distance between this and the smoothed surface around each vertex, both ways, in mm",
        ),
        (
            Colours::Calibre,
            "Colour by change of calibre",
            "How much wider or narrower each vessel is than as opened, in percent of its radius",
        ),
    ];
    for (colours, text, help) in maps {
        let mut is_chosen = chosen.colours == colours;
        if ui.checkbox(&mut is_chosen, text).on_hover_text(help).changed() {
            chosen.colours = chosen.colours.toggled(colours);
        }
    }
    ask(chosen != options, Action::Show(chosen));
}

fn more(ui: &mut Ui, state: &State, views: &Views, shown: Shown, ask: &mut impl FnMut(bool, Action)) {
    ask(ui.add_enabled(state.history.can_undo(), Button::new("Undo")).clicked(), Action::Undo);
    ask(ui.add_enabled(state.history.can_redo(), Button::new("Redo")).clicked(), Action::Redo);
    let mut chosen = views.options;
    ui.checkbox(&mut chosen.before, "Show before");
    ask(chosen != views.options, Action::Show(chosen));
    let mut is_split = state.document.as_ref().is_some_and(|document| views.reveals(document));
    ask(ui.checkbox(&mut is_split, "Split view").clicked(), Action::Reveal);
    ask(compare(ui, state, shown).clicked(), Action::Compare);
    ask(trial(ui, state, shown).clicked(), Action::ToggleTrial);
    let toggle = Action::Vessels(vessels::Action::Toggle);
    ask(vessels_button(ui, state, shown).clicked(), toggle);
    ui.menu_button("View", |ui| view_menu(ui, state, views.options, ask));
    ask(ui.button("Theme").clicked(), Action::Theme);
    ask(ui.button("Help").clicked(), Action::Help);
    ask(ui.button("About").clicked(), Action::About);
}

/// The bar below.
pub(super) fn status(ui: &mut Ui, state: &State, views: &Views, is_narrow: bool, asked: &mut Vec<Action>) {
    ui.horizontal_centered(|ui| {
        if let Some((work, fraction)) = state.work {
            let width = if is_narrow { 96.0 } else { 160.0 };
            progress(ui, fraction, width, "Progress");
            ui.label(format!("{} {:.0} %", work.label(), fraction * 100.0));
            if let Some(name) = state.opening().filter(|_| !is_narrow) {
                ui.add(egui::Label::new(RichText::new(name).weak()).truncate());
            }
            if ui.button("Cancel").on_hover_text("Esc").clicked() {
                asked.push(Action::Cancel);
            }
        } else if let Some(notice) = &state.notice {
            let colour = if notice.is_error { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
            let text = RichText::new(&notice.text).color(colour);
            let response = ui.add(egui::Label::new(text).truncate()).on_hover_text(&notice.text);
            name(&response, Role::Label, &notice.text);
        } else if let Some(document) = &state.document {
            ui.label(RichText::new(&document.name).weak());
        }
        if !is_narrow || state.work.is_none() && state.notice.is_none() {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if !is_narrow {
                    ui.label(RichText::new("Not for clinical decisions").small().weak());
                    ui.separator();
                }
                if let Some(shown) = state.document.as_ref().and_then(|document| document.shown.as_ref()) {
                    if !is_narrow {
                        ui.label(RichText::new(views.rate()).weak());
                        ui.separator();
                    }
                    ui.label(format!("{} triangles", grouped(shown.level.triangles.len())));
                }
            });
        }
    });
}
