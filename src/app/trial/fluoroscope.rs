//! The fluoroscope's controls and keys.

use egui::{Button, Key, Ui, Vec2};

use super::action::{Action, Arm};
use super::carm::{CArm, PRESETS, RATES};
use crate::app::row::row;
use crate::app::theme;
use crate::io::Axes;
use crate::language::grouped;
use crate::say;

/// Shows the pedal, contrast, the angles and the pulses.
pub(super) fn show(ui: &mut Ui, arm: &CArm, asked: &mut Vec<Action>) {
    let now = ui.input(|input| input.time);
    let mut ask = |what| asked.push(Action::Arm(what));
    ui.horizontal_wrapped(|ui| {
        let pedal = ui.add(Button::new(say!("trial-fluoroscopy")).selected(arm.is_on));
        if pedal.on_hover_text(say!("trial-pedal-help")).clicked() {
            ask(Arm::Pedal);
        }
        if ui.button(say!("trial-contrast")).on_hover_text(say!("trial-contrast-help")).clicked() {
            ask(Arm::Contrast(now));
        }
        let mut roadmap = arm.roadmap;
        if ui.checkbox(&mut roadmap, say!("trial-roadmap")).on_hover_text(say!("trial-roadmap-help")).changed() {
            ask(Arm::Roadmap(roadmap));
        }
    });
    ui.horizontal_wrapped(|ui| {
        for (i, (of_patient, of_surface, lao, cran)) in PRESETS.into_iter().enumerate() {
            let label = if arm.axes == Axes::Unknown { of_surface.to_owned() } else { of_patient.say() };
            let help = say!("trial-arm-preset-help", angle = &label, key = i + 1);
            let is_here = (arm.lao - lao).abs() < 0.5 && (arm.cran - cran).abs() < 0.5;
            let least = Vec2::splat(theme::row(ui.ctx(), 0.0));
            let response = ui.add(Button::new(label).selected(is_here).min_size(least));
            if response.on_hover_text(help.to_owned()).clicked() {
                ask(Arm::Look(lao, cran));
            }
        }
    });
    row(ui, &say!("trial-pulses"), &say!("trial-pulses-help"), |ui| {
        let mut chosen = arm.rate;
        for rate in RATES.into_iter().rev() {
            ui.selectable_value(&mut chosen, rate, format!("{} /s", grouped(rate)));
        }
        if chosen.to_bits() != arm.rate.to_bits() {
            ask(Arm::Rate(chosen));
        }
    });
}

/// What the keys ask of it; `pressed` says whether one goes down.
pub(super) fn keys(ui: &Ui, pressed: impl Fn(Key) -> bool, asked: &mut Vec<Action>) {
    for (key, (.., lao, cran)) in [Key::Num1, Key::Num2, Key::Num3, Key::Num4].into_iter().zip(PRESETS) {
        if pressed(key) {
            asked.push(Action::Arm(Arm::Look(lao, cran)));
        }
    }
    if pressed(Key::F) {
        asked.push(Action::Arm(Arm::Enlarge));
    }
    if pressed(Key::C) {
        asked.push(Action::Arm(Arm::Contrast(ui.input(|input| input.time))));
    }
    // A control that has the focus is pressed by it.
    if ui.ctx().memory(|memory| memory.focused().is_none()) && pressed(Key::Space) {
        asked.push(Action::Arm(Arm::Pedal));
    }
}
