//! The fluoroscope's controls and keys.

use egui::{Button, Key, Ui};

use super::action::{Action, Arm};
use super::carm::{CArm, PRESETS, RATES};
use crate::app::row::row;

/// Shows the pedal, contrast, the angles and the pulses.
pub(super) fn show(ui: &mut Ui, arm: &CArm, asked: &mut Vec<Action>) {
    let now = ui.input(|input| input.time);
    let mut ask = |what| asked.push(Action::Arm(what));
    ui.horizontal_wrapped(|ui| {
        let pedal = ui.add(Button::new("Fluoroscopy").selected(arm.is_on));
        if pedal.on_hover_text("The pedal: on or off (Space). Off, the last image stays").clicked() {
            ask(Arm::Pedal);
        }
        if ui.button("Contrast").on_hover_text("A puff of contrast that the blood takes along (C)").clicked() {
            ask(Arm::Contrast(now));
        }
        let mut roadmap = arm.roadmap;
        if ui.checkbox(&mut roadmap, "Roadmap").on_hover_text("Shows the lumen over the picture").changed() {
            ask(Arm::Roadmap(roadmap));
        }
    });
    ui.horizontal_wrapped(|ui| {
        for (i, (label, lao, cran)) in PRESETS.into_iter().enumerate() {
            let is_here = (arm.lao - lao).abs() < 0.5 && (arm.cran - cran).abs() < 0.5;
            let response = ui.add(Button::new(label).selected(is_here));
            if response.on_hover_text(format!("C-arm: {label} (key {})", i + 1)).clicked() {
                ask(Arm::Look(lao, cran));
            }
        }
    });
    row(ui, "Pulses", "Pictures a second while the beam is on", |ui| {
        let mut chosen = arm.rate;
        for rate in RATES.into_iter().rev() {
            ui.selectable_value(&mut chosen, rate, format!("{rate} /s"));
        }
        if chosen.to_bits() != arm.rate.to_bits() {
            ask(Arm::Rate(chosen));
        }
    });
}

/// What the keys ask of it; `pressed` says whether one goes down.
pub(super) fn keys(ui: &Ui, pressed: impl Fn(Key) -> bool, asked: &mut Vec<Action>) {
    for (key, (_, lao, cran)) in [Key::Num1, Key::Num2, Key::Num3, Key::Num4].into_iter().zip(PRESETS) {
        if pressed(key) {
            asked.push(Action::Arm(Arm::Look(lao, cran)));
        }
    }
    if pressed(Key::C) {
        asked.push(Action::Arm(Arm::Contrast(ui.input(|input| input.time))));
    }
    // A control that has the focus is pressed by it.
    if ui.ctx().memory(|memory| memory.focused().is_none()) && pressed(Key::Space) {
        asked.push(Action::Arm(Arm::Pedal));
    }
}
