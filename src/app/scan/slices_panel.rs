//! The panel of a scan that is kept: which of its slices are shown behind the surface, and how.

use egui::{ComboBox, DragValue, Role, Ui};

use super::Action;
use super::slices::{AXES, KeptScan};
use crate::app::assist::{describe, name};
use crate::app::control::reads_comma;
use crate::app::row::row;
use crate::app::swipe::Way;
use crate::language::{decimal, tell};
use crate::say;
use crate::volume::{Survey, WINDOWS};

/// Shows the section.
pub(super) fn show(ui: &mut Ui, scan: &KeptScan, asked: &mut Vec<Action>) {
    let header = egui::CollapsingHeader::new(say!("scan-slices-title")).id_salt("slices").default_open(true);
    header.show(ui, |ui| {
        let mut options = scan.options;
        for ((axis, title), (is_shown, index)) in AXES.iter().zip(scan.names).zip(&mut options.planes) {
            let along = scan.opened.dimensions[axis.index()];
            let mm = *index as f64 * scan.opened.spacing_mm[axis.index()];
            ui.horizontal(|ui| {
                ui.checkbox(is_shown, title.say()).on_hover_text(say!("scan-plane-help"));
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    let (slice, count, mm) = ((*index + 1).to_string(), along.to_string(), decimal(mm, 1));
                    let place = ui.label(say!("scan-slice-place", slice = slice, count = count, mm = mm));
                    place.on_hover_text(say!("scan-slice-place-help"));
                });
            });
            if *is_shown {
                ui.spacing_mut().slider_width = (ui.available_width() - 8.0).max(40.0);
                let before = *index;
                let slider = egui::Slider::new(index, 0..=along.saturating_sub(1)).show_value(false);
                let slider = ui.add(slider).on_hover_text(say!("scan-plane-slider-help"));
                if Way::of(ui).scroll(ui, &slider) {
                    *index = before;
                }
                describe(&slider, Role::Slider, &say!("scan-plane-slice", plane = title.say()), *index as f64);
            }
        }
        window(ui, scan.is_ct, &scan.opened.survey, &mut options.window);
        let outline = ui.checkbox(&mut options.has_outline, say!("scan-outline"));
        outline.on_hover_text(say!("scan-outline-help"));
        if options != scan.options {
            asked.push(Action::Slices(options));
        }
        keep(ui, scan.opened.bytes, true, asked);
    });
}

/// The switch that keeps a scan for its slices.
pub(super) fn keep(ui: &mut Ui, bytes: u64, mut keeps: bool, asked: &mut Vec<Action>) {
    let text = say!("scan-keep", mb = decimal((bytes as f64 / 1e6).max(1.0), 0));
    if ui.checkbox(&mut keeps, text).on_hover_text(say!("scan-keep-help")).changed() {
        asked.push(Action::Keep(keeps));
    }
}

/// What is black and white: a window with a name, or level and width.
pub(super) fn window(ui: &mut Ui, is_ct: bool, survey: &Survey, ends: &mut [f64; 2]) {
    let (range, bulk) = (survey.range, survey.bulk());
    let known = WINDOWS.iter().filter(|_| is_ct).map(|window| (tell(&window.name), window.ends));
    let all = [(say!("scan-window-most"), bulk), (say!("scan-window-all"), range)];
    let known: Vec<(String, [f64; 2])> = known.chain(all).collect();
    let shown =
        known.iter().find(|(_, other)| other == ends).map_or_else(|| say!("scan-window-own"), |(name, _)| name.clone());
    row(ui, &say!("scan-window"), &say!("scan-window-help"), |ui| {
        let list = ComboBox::from_id_salt("window").selected_text(shown).show_ui(ui, |ui| {
            for (text, other) in &known {
                ui.selectable_value(ends, *other, text);
            }
        });
        name(&list.response, Role::ComboBox, &say!("scan-window-name"));
    });
    let unit = if is_ct { " HU" } else { "" };
    let speed = ((range[1] - range[0]) / 1000.0).max(1e-6);
    let (mut level, mut width) = ((ends[0] + ends[1]) / 2.0, ends[1] - ends[0]);
    row(ui, &say!("scan-level-width"), &say!("scan-level-width-help"), |ui| {
        let field = reads_comma(DragValue::new(&mut width), false).speed(speed).range(speed..=f64::MAX).suffix(unit);
        let field = ui.add(field);
        describe(&field, Role::SpinButton, &say!("scan-width"), width);
        let field = ui.add(reads_comma(DragValue::new(&mut level), false).speed(speed).suffix(unit));
        describe(&field, Role::SpinButton, &say!("scan-level"), level);
    });
    let moved = [level - width / 2.0, level + width / 2.0];
    if (moved[0] - ends[0]).abs().max((moved[1] - ends[1]).abs()) > speed * 1e-3 {
        *ends = moved;
    }
}
