//! The trial's part of the panel, and its keys.

use egui::{Button, Key, Modifiers, RichText, Ui};

use super::readout::{self, remark};
use super::setup::row;
use super::{AWAITS, Ask, Stage, Trial, carm, outcome, setup};
use crate::app::control::progress;
use crate::app::document::Document;
use crate::app::keys::pressed;
use crate::app::panel::step;
use crate::pipeline::settings::Smoothing;

/// Shows the step; while the trial's views are shown it has the panel to itself.
pub(in crate::app) fn show(
    ui: &mut Ui,
    trial: &mut Trial,
    smoothing: &Smoothing,
    document: Option<&Document>,
) -> Option<Ask> {
    step(ui, 4, "Trial", "Steers a guidewire through the level that is shown.");
    if let Some(problem) = &trial.problem {
        remark(ui, problem, true);
    }
    let gentler = trial.gentler(smoothing).and_then(|gentler| smooth_less(ui, &gentler));
    gentler.or(if trial.is_open { open(ui, trial) } else { closed(ui, document) })
}

/// Offers a smoothing that leaves thin vessels wider.
fn smooth_less(ui: &mut Ui, gentler: &Smoothing) -> Option<Ask> {
    let label = format!("Smooth less (pass band {}, {} iterations) and start", gentler.pass_band, gentler.iterations);
    let button = ui.add(Button::new(label).wrap());
    button.on_hover_text("Keeps thin vessels wider; Undo takes it back").clicked().then_some(Ask::SmoothLess)
}

fn closed(ui: &mut Ui, document: Option<&Document>) -> Option<Ask> {
    let can_start = document.is_some_and(|document| document.shown.is_some());
    let mut ask = None;
    ui.horizontal(|ui| {
        ui.add_enabled_ui(can_start, |ui| {
            if ui.button("Start trial").clicked() {
                ask = Some(Ask::Start);
            }
            let tables = ui.button("Tables III and IV").on_hover_text("The paper's trial at several reduction rates");
            if tables.clicked() {
                ask = Some(Ask::Tables);
            }
        });
    });
    ask
}

fn open(ui: &mut Ui, trial: &mut Trial) -> Option<Ask> {
    let mut ask = state(ui, trial);
    ask = ask.or(buttons(ui, trial));
    if let (Stage::On, Some(frame)) = (trial.stage, trial.frame.clone()) {
        ui.separator();
        // Rows of numbers are lower than those of controls.
        ui.scope(|ui| readout::show(ui, trial, &frame));
    }
    ui.separator();
    let proposed = trial.proposed_wire().cloned();
    ui.push_id("wire", |ui| setup::wire(ui, &mut trial.setup, proposed.as_ref()));
    if ui.push_id("places", |ui| setup::places(ui, trial)).inner {
        ask = Some(Ask::Restart);
    }
    if trial.has_changed() {
        remark(ui, "Restart to try the wire and seed as they are set now.", false);
    }
    ui.separator();
    ui.push_id("fluoroscopy", |ui| fluoroscopy(ui, trial));
    ui.separator();
    ask = ask.or(ui.push_id("outcome", |ui| outcome::show(ui, trial)).inner);
    ui.separator();
    ask.or(log(ui, trial))
}

fn state(ui: &mut Ui, trial: &Trial) -> Option<Ask> {
    ui.add_space(4.0);
    if trial.awaits.is_some() {
        ui.add(egui::Label::new(AWAITS).wrap());
        return None;
    }
    match (trial.stage, &trial.frame) {
        (Stage::Preparing(fraction), _) => {
            progress(ui, fraction, ui.available_width(), "Preparing the trial");
            ui.label("Finding the lumen and the way...");
        }
        (Stage::On, Some(frame)) => {
            let (text, is_well) = readout::sentence(trial, frame);
            let is_over = trial.summary.is_some();
            let mut rich = RichText::new(text);
            if is_over {
                rich = rich.strong();
            }
            if !is_well {
                rich = rich.color(ui.visuals().error_fg_color);
            }
            ui.add(egui::Label::new(rich).wrap());
        }
        (Stage::On, None) => {
            ui.label("The wire is at the entry.");
        }
        (Stage::Off, _) => {
            ui.label("No trial is on.");
        }
    }
    None
}

fn buttons(ui: &mut Ui, trial: &Trial) -> Option<Ask> {
    let mut ask = None;
    let is_on = trial.stage == Stage::On;
    ui.horizontal_wrapped(|ui| {
        let mut button = |ui: &mut Ui, enabled, is_down, label: &str, help: &str, what: Ask| {
            let response = ui.add_enabled(enabled, Button::new(label).selected(is_down)).on_hover_text(help);
            if response.clicked() {
                ask = Some(what);
            }
        };
        if trial.stage == Stage::Off {
            button(ui, true, false, "Start trial", "", Ask::Start);
        } else {
            button(ui, true, trial.has_changed(), "Restart", "From the entry (R)", Ask::Restart);
        }
        let help = "Steers by itself; a hand on the wire takes it back (G)";
        button(ui, is_on, trial.autopilot, "Autopilot", help, Ask::Autopilot);
        button(ui, is_on, trial.is_paused, "Pause", "Stands still (P)", Ask::Pause);
        button(ui, is_on, trial.is_slow, "Slow motion", "A quarter of the speed (M)", Ask::Slow);
        button(ui, is_on, false, "Step back", "A second back, and stand still (Z)", Ask::StepBack);
        button(ui, true, false, "Close", "Back to the surface (Esc)", Ask::Close);
    });
    ask
}

fn fluoroscopy(ui: &mut Ui, trial: &mut Trial) {
    let now = ui.input(|input| input.time);
    let arm = &mut trial.carm;
    ui.horizontal_wrapped(|ui| {
        let pedal = ui.add(Button::new("Fluoroscopy").selected(arm.is_on));
        if pedal.on_hover_text("The pedal: on or off (Space). Off, the last image stays").clicked() {
            arm.is_on = !arm.is_on;
        }
        if ui.button("Contrast").on_hover_text("A puff of contrast that the blood takes along (C)").clicked() {
            arm.give_contrast(now);
        }
        ui.checkbox(&mut arm.roadmap, "Roadmap").on_hover_text("Shows the lumen over the picture");
    });
    ui.horizontal_wrapped(|ui| {
        for (i, (label, lao, cran)) in carm::PRESETS.into_iter().enumerate() {
            let is_here = (arm.lao - lao).abs() < 0.5 && (arm.cran - cran).abs() < 0.5;
            let response = ui.add(Button::new(label).selected(is_here));
            if response.on_hover_text(format!("C-arm: {label} (key {})", i + 1)).clicked() {
                (arm.lao, arm.cran) = (lao, cran);
            }
        }
    });
    row(ui, "Pulses", "Pictures a second while the beam is on", |ui| {
        for rate in carm::RATES.into_iter().rev() {
            ui.selectable_value(&mut arm.rate, rate, format!("{rate} /s"));
        }
    });
}

fn log(ui: &mut Ui, trial: &Trial) -> Option<Ask> {
    let mut ask = None;
    ui.horizontal_wrapped(|ui| {
        let save = ui.add_enabled(trial.stage == Stage::On, Button::new("Save log"));
        if save.on_hover_text("Samples as CSV and a summary as JSON").clicked() {
            ask = Some(Ask::Save);
        }
        if ui.button("Open log...").on_hover_text("Replays a saved log (CSV) on this level").clicked() {
            ask = Some(Ask::OpenLog);
        }
        if ui.button("Tables III and IV").on_hover_text("The paper's trial at several reduction rates").clicked() {
            ask = Some(Ask::Tables);
        }
    });
    ask
}

/// What the keys ask for while a trial is shown.
pub(in crate::app) fn keys(ui: &Ui, trial: &mut Trial) -> Option<Ask> {
    let pressed = |key| pressed(ui, Modifiers::NONE, key);
    let now = ui.input(|input| input.time);
    for (key, (_, lao, cran)) in [Key::Num1, Key::Num2, Key::Num3, Key::Num4].into_iter().zip(carm::PRESETS) {
        if pressed(key) {
            (trial.carm.lao, trial.carm.cran) = (lao, cran);
        }
    }
    if pressed(Key::C) {
        trial.carm.give_contrast(now);
    }
    // A control that has the focus is pressed by it.
    if ui.ctx().memory(|memory| memory.focused().is_none()) && pressed(Key::Space) {
        trial.carm.is_on = !trial.carm.is_on;
    }
    let is_on = trial.stage == Stage::On;
    let asks = [
        (Key::R, true, Ask::Restart),
        (Key::P, is_on, Ask::Pause),
        (Key::Z, is_on, Ask::StepBack),
        (Key::M, is_on, Ask::Slow),
        (Key::G, is_on, Ask::Autopilot),
    ];
    asks.into_iter().find(|(key, allowed, _)| *allowed && pressed(*key)).map(|(.., ask)| ask)
}
