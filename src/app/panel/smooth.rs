//! The second step of the panel: the controls of the smoothing filter, its response and what it did to the surface.

use egui::{Button, ComboBox, RichText, Role, Ui};

use super::{measured, set};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::row::{Fold, advanced, formulas, remark, row};
use crate::app::state::State;
use crate::app::views::Views;
use crate::app::{control, equations, response, theme};
use crate::language::tell;
use crate::pipeline::settings::table::{self, Kind};
use crate::pipeline::settings::{Preset, Settings, Smoothing};
use crate::say;
use crate::vessel::certificate::{BranchCalibre, Certificate, StationStatus};

/// Height of what is seen at a place that is gone to, in edges.
const AROUND: f32 = 60.0;
/// Settings that stand in the dock.
const DOCKED: [&str; 2] = ["pass-band", "iterations"];
/// The others from top to bottom; one that is not among them comes last.
const ORDER: [&str; 5] = ["window", "adapt", "guard", "hold-caps", "preserve-volume"];

/// Shows the step.
pub(super) fn show(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    let summary = RichText::new(strength(&settings.smoothing).1).weak();
    let (title, what) = (say!("panel-smooth"), say!("panel-smooth-does"));
    Fold { number: 2, title: &title, what: &what, summary, is_open: true }
        .show(ui, |ui| smoothing(ui, &title, &mut settings, state, asked));
    set(settings, state, asked);
}

/// The settings that have a name and are these, and what they are called.
fn strength(smoothing: &Smoothing) -> (Option<Preset>, String) {
    // Whether the volume is held is chosen beside it.
    let chosen = Preset::of(&Smoothing { preserve_volume: false, ..*smoothing });
    (chosen, chosen.map_or_else(|| say!("panel-strength-own"), |preset| tell(&preset)))
}

/// The settings that have a name.
fn preset_list(ui: &mut Ui, smoothing: &mut Smoothing) {
    row(ui, &say!("panel-strength"), &say!("panel-strength-help"), |ui| {
        let (chosen, words) = strength(smoothing);
        let list = ComboBox::from_id_salt("preset").selected_text(words);
        let response = list.show_ui(ui, |ui| {
            for preset in Preset::ALL {
                if ui.selectable_label(chosen == Some(preset), tell(&preset)).clicked() {
                    *smoothing = Smoothing { preserve_volume: smoothing.preserve_volume, ..preset.smoothing() };
                    ui.close();
                }
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-strength"));
    });
}

fn smoothing(ui: &mut Ui, title: &str, settings: &mut Settings, state: &State, asked: &mut Vec<Action>) {
    preset_list(ui, &mut settings.smoothing);
    effect(ui, &settings.smoothing, state, asked);
    formulas(ui, title, |ui| equations::smoothing(ui, settings));
    advanced(ui, title, |ui| filter(ui, settings));
}

/// How the filter is made.
fn filter(ui: &mut Ui, settings: &mut Settings) {
    let mut rows: Vec<_> = table::of("smoothing").filter(|setting| !DOCKED.contains(&setting.key)).collect();
    rows.sort_by_key(|setting| ORDER.iter().position(|key| *key == setting.key).unwrap_or(ORDER.len()));
    let (switches, others): (Vec<_>, Vec<_>) =
        rows.into_iter().partition(|row| matches!(row.kind, Kind::Switch { .. }));
    for setting in others {
        control::setting(ui, setting, settings);
    }
    ui.horizontal_wrapped(|ui| {
        for setting in switches {
            control::setting(ui, setting, settings);
        }
    });
}

/// The diameter of the thinnest place that is measured, in mm, on the surface as opened. Where a vessel is less than two mean
/// edges wide, ends or forks no calibre is measured: a spur on a rim has a tip of no width.
fn thinnest(found: &Certificate) -> Option<f64> {
    let measured = |branch: &BranchCalibre| {
        let stations = branch.standings.iter().zip(&branch.opened.inscribed_radii_mm);
        let counted = stations.filter(|(standing, _)| **standing == StationStatus::Counts);
        counted.filter_map(|(_, radius)| radius.map(f64::from)).reduce(f64::min)
    };
    found.branches.iter().filter_map(measured).reduce(f64::min).map(|radius| 2.0 * radius)
}

/// What is known of the surface: the thinnest vessel is that of the surface as opened, whatever smoothing makes of it.
fn scale(state: &State) -> response::Scale {
    let document = state.document.as_ref();
    let response = measured(document).and_then(|report| report.smoothing_response);
    let calibre = document.and_then(|document| document.calibre.as_ref()?.found.as_ref().ok());
    response::Scale {
        edge_length: response.map(|response| response.edge_length_mm),
        thinnest: calibre.and_then(thinnest),
    }
}

/// Shows what the filter lets through, large, for whoever presents.
pub(in crate::app) fn present_response(ui: &mut Ui, state: &State) {
    response::present(ui, &state.settings.smoothing, scale(state));
}

/// What the filter lets through, and where less was smoothed.
fn effect(ui: &mut Ui, smoothing: &Smoothing, state: &State, asked: &mut Vec<Action>) {
    let report = measured(state.document.as_ref());
    let mut shows_averaged = state.shows_averaged;
    response::show(ui, smoothing, scale(state), &mut shows_averaged);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vessel::summary::fixtures::certificate;

    #[test]
    fn the_thinnest_place_is_the_thinnest_that_is_measured() {
        let mut found = certificate(&[Some(0.5), Some(0.5)]).unwrap();
        let standings = [StationStatus::End, StationStatus::Thin, StationStatus::Counts, StationStatus::Counts];
        // A spur on a rim, and a vessel of 2.4 mm.
        for (branch, radii) in found.branches.iter_mut().zip([[0.01, 0.02, 1.5, 1.2], [0.1, 0.2, 2.0, 1.9]]) {
            branch.standings = standings.to_vec();
            branch.opened.inscribed_radii_mm = radii.map(|radius: f32| Some(radius)).to_vec();
        }
        assert!((thinnest(&found).unwrap() - 2.4).abs() < 1e-6, "{:?}", thinnest(&found));
        for branch in &mut found.branches {
            branch.standings = vec![StationStatus::Thin; 4];
        }
        assert_eq!(thinnest(&found), None);
    }
}
