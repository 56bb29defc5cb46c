//! The second step of the panel: the controls of the smoothing filter, its response and what it did to the surface.

use egui::{Button, ComboBox, Role, Ui};

use super::{measured, set};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::control::Setting;
use crate::app::row::{remark, row, step};
use crate::app::state::State;
use crate::app::views::Views;
use crate::app::{response, theme};
use crate::pipeline::settings::{Preset, Smoothing, Window};
use crate::say;

/// Height of what is seen at a place that is gone to, in edges.
const AROUND: f32 = 60.0;

/// Shows the step.
pub(super) fn show(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    smoothing(ui, &mut settings.smoothing, state, asked);
    set(settings, state, asked);
}

/// The settings that have a name.
fn preset_list(ui: &mut Ui, smoothing: &mut Smoothing) {
    row(ui, &say!("panel-strength"), &say!("panel-strength-help"), |ui| {
        // Whether the volume is held is chosen beside it.
        let chosen = Preset::of(&Smoothing { preserve_volume: false, ..*smoothing });
        let words = chosen.map_or_else(|| say!("panel-strength-own"), Preset::label);
        let list = ComboBox::from_id_salt("preset").selected_text(words);
        let response = list.show_ui(ui, |ui| {
            for preset in Preset::ALL {
                if ui.selectable_label(chosen == Some(preset), preset.label()).clicked() {
                    *smoothing = Smoothing { preserve_volume: smoothing.preserve_volume, ..preset.smoothing() };
                    ui.close();
                }
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-strength"));
    });
}

fn smoothing(ui: &mut Ui, smoothing: &mut Smoothing, state: &State, asked: &mut Vec<Action>) {
    let report = measured(state.document.as_ref());
    step(ui, 2, &say!("panel-smooth"), &say!("panel-smooth-does"));
    preset_list(ui, smoothing);
    let default = Smoothing::default();
    let pass_band = Setting {
        name: &say!("panel-pass-band"),
        help: &say!("panel-pass-band-help"),
        unit: "",
        range: Smoothing::PASS_BAND,
        default: default.pass_band,
        decimals: 4,
        logarithmic: true,
    };
    pass_band.show(ui, &mut smoothing.pass_band);
    let iterations = Setting {
        name: &say!("panel-iterations"),
        help: &say!("panel-iterations-help"),
        unit: "",
        range: 0.0..=f64::from(Smoothing::MAX_ITERATIONS),
        default: f64::from(default.iterations),
        decimals: 0,
        logarithmic: false,
    };
    let mut count = f64::from(smoothing.iterations);
    if iterations.show(ui, &mut count) {
        smoothing.iterations = count as u32;
    }
    row(ui, &say!("panel-window"), &say!("panel-window-help"), |ui| {
        let list = ComboBox::from_id_salt("window").selected_text(smoothing.window.name());
        let response = list.show_ui(ui, |ui| {
            for window in Window::ALL {
                ui.selectable_value(&mut smoothing.window, window, window.name());
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-window"));
    });
    ui.horizontal_wrapped(|ui| {
        let adapt = ui.checkbox(&mut smoothing.adapt, say!("panel-adapt"));
        adapt.on_hover_text(say!("panel-adapt-help"));
        let guard = ui.checkbox(&mut smoothing.guard, say!("panel-guard"));
        guard.on_hover_text(say!("panel-guard-help"));
        let hold = ui.checkbox(&mut smoothing.preserve_volume, say!("panel-volume-held"));
        hold.on_hover_text(say!("panel-volume-held-help"));
    });
    let edge_length = report.and_then(|report| report.smoothing_response).map(|response| response.edge_length_mm);
    let lumen = report.and_then(|report| report.smoothed_shape.as_ref()?.smallest_lumen);
    let thinnest = lumen.map(|lumen| lumen.diameter_mm);
    let mut shows_averaged = state.shows_averaged;
    response::show(ui, smoothing, response::Scale { edge_length, thinnest }, &mut shows_averaged);
    if shows_averaged != state.shows_averaged {
        asked.push(Action::Average(shows_averaged));
    }
    let Some(report) = report.filter(|report| report.settings.smoothing == *smoothing) else { return };
    if let Some(weakened) = report.smoothing_weakened {
        ui.horizontal_wrapped(|ui| {
            remark(ui, &say!("panel-smoothed-less", count = weakened.vertices));
            let show = Button::new(say!("panel-show"));
            let show = if theme::suits_finger(ui.ctx()) { show } else { show.small() };
            if ui.add(show).on_hover_text(say!("panel-smoothed-less-help")).clicked() {
                let height_mm = AROUND * report.smoothing_response.map_or(1.0, |found| found.edge_length_mm) as f32;
                asked.push(Action::GoTo { at_mm: weakened.at_mm, height_mm, label: say!("panel-smoothed-less-place") });
            }
        });
    }
}
