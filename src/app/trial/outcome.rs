//! What reduction does to the wire: the same input on the unreduced surface, and how the two differ.

use egui::{Align, Layout, RichText, Role, Ui};
use egui_plot::{Plot, PlotPoints};

use super::action::Action;
use super::marks;
use super::state::{Comparing, Trial};
use crate::app::assist::name;
use crate::app::control::progress;
use crate::app::plot_file::Drawn;
use crate::app::row::{number, wrapped};
use crate::app::still_plot::{curve, tick};
use crate::engine::trial::TrialComparison;
use crate::language::{decimal, tell};
use crate::say;

/// Shows the button, and what came of it.
pub(super) fn show(ui: &mut Ui, trial: &Trial, asked: &mut Vec<Action>) {
    let has_way = trial.frame().is_some_and(|frame| frame.step > 0);
    let can_compare = trial.is_on() && has_way && !trial.is_comparing();
    ui.add_enabled_ui(can_compare, |ui| {
        let button = ui.button(say!("trial-compare"));
        if button.on_hover_text(say!("trial-compare-help")).clicked() {
            asked.push(Action::Compare);
        }
    });
    let Some(run) = trial.run() else { return };
    if let Some(Comparing { fraction, .. }) = run.comparing {
        ui.horizontal(|ui| {
            ui.label(say!("trial-comparing-percent", percent = decimal(fraction * 100.0, 0)));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let cancel = ui.button(say!("trial-cancel")).on_hover_text(say!("trial-cancel-comparison-help"));
                name(&cancel, Role::Button, &say!("trial-cancel-comparison"));
                if cancel.clicked() {
                    asked.push(Action::CancelComparison);
                }
                progress(ui, fraction, ui.available_width(), &say!("trial-comparing"));
            });
        });
    }
    if let Some(comparison) = &run.comparison {
        ui.scope(|ui| shown(ui, comparison));
    }
}

fn shown(ui: &mut Ui, comparison: &TrialComparison) {
    wrapped(ui, &tell(&comparison.verdict), RichText::strong);
    let [after, before] = [comparison.smallest_after_mm, comparison.smallest_before_mm].map(|mm| decimal(mm, 2));
    let diameters = say!("trial-smallest-was", after = after, before = before);
    number(ui, &say!("trial-smallest"), &diameters, &say!("trial-smallest-help"));
    let pinched = comparison.pinched.len();
    if pinched > 0 {
        let places = say!("trial-pinched-places", count = pinched);
        number(ui, &say!("trial-pinched"), &places, &say!("trial-pinched-help"));
    }
    let largest = comparison.deviation_mm.iter().copied().fold(0.0, f32::max);
    let told = format!("{} mm", decimal(largest, 2));
    number(ui, &say!("trial-largest-deviation"), &told, &say!("trial-largest-deviation-help"));
    if comparison.orders[0] > 0 {
        let noise = comparison.noise_mm.iter().copied().fold(0.0, f32::max);
        let told = format!("{} mm", decimal(noise, 2));
        number(ui, &say!("trial-noise"), &told, &say!("trial-noise-help"));
    }
    let points = |differences: &[f32]| -> PlotPoints<'_> {
        let along = comparison.inserted_mm.iter().zip(differences);
        along.map(|(&inserted, &apart)| [f64::from(inserted) / 10.0, f64::from(apart)]).collect()
    };
    let [colour, grey] = [marks::colours(ui.visuals().dark_mode)[0], ui.visuals().weak_text_color()];
    ui.label(RichText::new(say!("trial-deviation-plot-help")).small().weak());
    let plot = Plot::new("deviation")
        .height(120.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_x(false)
        .include_y(0.0)
        .x_axis_formatter(tick)
        .y_axis_formatter(tick);
    let [noise, deviation] = [say!("trial-noise"), say!("trial-deviation")];
    let shown = ui.scope(|ui| {
        plot.show(ui, |plot| {
            plot.line(curve(&noise, points(&comparison.noise_mm)).color(grey).width(1.0));
            plot.line(curve(&deviation, points(&comparison.deviation_mm)).color(colour).width(1.5));
        })
    });
    let title = say!("trial-deviation-plot");
    let (frame, whole) = (shown.inner.response.rect, shown.response.rect);
    name(&shown.inner.response, Role::Image, &title);
    Drawn { stem: "trial", title: &title, legend: &[(&noise, grey), (&deviation, colour)], whole, frame }.offer(ui);
}
