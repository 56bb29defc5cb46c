//! What reduction does to the wire: the same input on the unreduced surface, and how the two differ.

use egui::{Align, Layout, RichText, Role, Ui};
use egui_plot::{Line, Plot, PlotPoints};

use super::action::Action;
use super::marks;
use super::state::{Comparing, Trial};
use crate::app::assist::name;
use crate::app::control::progress;
use crate::app::row::number;
use crate::engine::trial::TrialComparison;

/// Shows the button, and what came of it.
pub(super) fn show(ui: &mut Ui, trial: &Trial, asked: &mut Vec<Action>) {
    let has_way = trial.frame().is_some_and(|frame| frame.step > 0);
    let can_compare = trial.is_on() && has_way && !trial.is_comparing();
    ui.add_enabled_ui(can_compare, |ui| {
        let button = ui.button("Compare with the unreduced surface");
        if button.on_hover_text("Replays the same input on the surface before its reduction").clicked() {
            asked.push(Action::Compare);
        }
    });
    let Some(run) = trial.run() else { return };
    if let Some(Comparing { fraction, .. }) = run.comparing {
        ui.horizontal(|ui| {
            ui.label(format!("Comparing: {:.0} %", fraction * 100.0));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let cancel = ui.button("Cancel").on_hover_text("Compare no more; the trial goes on");
                name(&cancel, Role::Button, "Cancel comparison");
                if cancel.clicked() {
                    asked.push(Action::CancelComparison);
                }
                progress(ui, fraction, ui.available_width(), "Comparing");
            });
        });
    }
    if let Some(comparison) = &run.comparison {
        ui.scope(|ui| shown(ui, comparison));
    }
}

fn shown(ui: &mut Ui, comparison: &TrialComparison) {
    ui.add(egui::Label::new(RichText::new(&comparison.verdict).strong()).wrap());
    let diameters = format!("{:.2} mm, was {:.2} mm", comparison.smallest_after_mm, comparison.smallest_before_mm);
    number(ui, "Smallest lumen", &diameters, "Diameter where the route is narrowest, after and before the reduction");
    let pinched = comparison.pinched.len();
    if pinched > 0 {
        number(ui, "Pinched", &format!("{pinched} places"), "Ringed in the view");
    }
    let largest = comparison.deviation_mm.iter().copied().fold(0.0, f32::max);
    number(ui, "Largest deviation", &format!("{largest:.2} mm"), "Between the two tips at the same time");
    if comparison.orders[0] > 0 {
        let noise = comparison.noise_mm.iter().copied().fold(0.0, f32::max);
        let help = "Between the tips on the unreduced surface and on the same with its triangles in another order: what is \
                    less than this says nothing of the reduction";
        number(ui, "Noise", &format!("{noise:.2} mm"), help);
    }
    let points = |differences: &[f32]| -> PlotPoints<'_> {
        let along = comparison.inserted_mm.iter().zip(differences);
        along.map(|(&inserted, &apart)| [f64::from(inserted) / 10.0, f64::from(apart)]).collect()
    };
    let [colour, grey] = [marks::colours(ui.visuals().dark_mode)[0], ui.visuals().weak_text_color()];
    ui.label(RichText::new("Deviation of the tip in mm over insertion in cm; grey: noise").small().weak());
    let response = Plot::new("deviation")
        .height(120.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_x(false)
        .include_y(0.0)
        .show(ui, |plot| {
            plot.line(Line::new("Noise", points(&comparison.noise_mm)).color(grey).width(1.0));
            plot.line(Line::new("Deviation", points(&comparison.deviation_mm)).color(colour).width(1.5));
        });
    name(&response.response, Role::Image, "Deviation of the tip over insertion");
}
