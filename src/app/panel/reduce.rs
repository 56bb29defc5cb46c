//! The third step of the panel: what the reduction stops at, and by which method.

use egui::{ComboBox, RichText, Role, Ui};

use super::{come_to, entering, measured, set};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::control::{self, counts};
use crate::app::row::{Fold, advanced, formulas, remark, row};
use crate::app::state::State;
use crate::app::swipe::Way;
use crate::app::views::Views;
use crate::app::{equations, error_plot};
use crate::language::{decimal, tell};
use crate::pipeline::report::AutoReport;
use crate::pipeline::safe::{Claim, Safe};
use crate::pipeline::settings::table;
use crate::pipeline::settings::{Settings, Target, reduction_percent};
use crate::say;

/// The bound that a reset goes back to: 0.1 mm.
pub(super) const DEFAULT_BOUND: Target = Target::Deviation(100);
/// The largest bound of the slider, in thousandths of a mm.
pub(super) const LARGEST_BOUND: u32 = 10_000;

/// Shows the step.
pub(super) fn show(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    let summary = RichText::new(settings.decimation.method.name()).weak();
    let (title, what) = (say!("panel-reduce"), say!("panel-reduce-does"));
    Fold { number: 3, title: &title, what: &what, summary, is_open: true }
        .show(ui, |ui| reduction(ui, state, &title, &mut settings));
    set(settings, state, asked);
}

/// Changes `settings`, a copy of those of `state`.
fn reduction(ui: &mut Ui, state: &State, title: &str, settings: &mut Settings) {
    stop_list(ui, state, &mut settings.target);
    if settings.target.deviation_mm().is_none() {
        auto(ui, state, &mut settings.target);
        wanted(ui, state, &mut settings.target);
    }
    let shown = state.document.as_ref().and_then(|d| d.shown.as_ref());
    if let Some(shortfall) = shown.and_then(|shown| shown.level.shortfall.as_ref()) {
        remark(ui, &format!("{}.", tell(&shortfall.message())));
    }
    error_plot::section(ui, state, &mut settings.target);
    formulas(ui, title, |ui| equations::reduction(ui, settings));
    advanced(ui, title, |ui| decimation(ui, state, settings));
}

/// How it is reduced.
fn decimation(ui: &mut Ui, state: &State, settings: &mut Settings) {
    // Where it is on, it can be turned off.
    let has_labels =
        state.document.as_ref().is_some_and(|document| document.import.arrays.iter().any(|info| info.labels.len() > 1));
    let keeps_labels = has_labels || settings.decimation.keep_labels;
    for setting in table::of("decimation").filter(|setting| setting.key != "keep-labels" || keeps_labels) {
        if (setting.matters)(settings) {
            control::setting(ui, setting, settings);
        }
    }
}

/// What the reduction stops at; another choice goes on from the level that is shown.
fn stop_list(ui: &mut Ui, state: &State, target: &mut Target) {
    let by_deviation = target.deviation_mm().is_some();
    let mut chosen = by_deviation;
    row(ui, &say!("panel-stop"), &say!("panel-stop-help"), |ui| {
        let names = |by_deviation: bool| {
            if by_deviation { say!("panel-stop-deviation") } else { say!("panel-stop-rate") }
        };
        let list = ComboBox::from_id_salt("stop").selected_text(names(by_deviation));
        let response = list.show_ui(ui, |ui| {
            for choice in [false, true] {
                ui.selectable_value(&mut chosen, choice, names(choice));
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-stop"));
    });
    if chosen != by_deviation {
        *target = if chosen { deviation_shown(state) } else { rate_shown(state) };
    }
}

/// The bound that the shown level just meets, if its deviation is known.
fn deviation_shown(state: &State) -> Target {
    let largest = measured(state.document.as_ref()).and_then(|report| Some(report.deviation_mm?.max));
    let range = Target::DEVIATION;
    largest.map_or(DEFAULT_BOUND, |mm| {
        Target::Deviation(((mm * 1000.0).ceil() as u32).clamp(*range.start(), LARGEST_BOUND))
    })
}

/// The rate of the shown level.
fn rate_shown(state: &State) -> Target {
    let counts = state.document.as_ref().and_then(|document| {
        Some((document.levels.as_ref()?.1.triangles.len(), document.shown.as_ref()?.level.triangles.len()))
    });
    counts.map_or(Target::default(), |(before, after)| {
        let per_mille = (reduction_percent(before, after) * 10.0).round() as u32;
        Target::Reduction(per_mille.min(Target::MAX_PER_MILLE))
    })
}

/// Whether the rate is set by itself, and what it then goes by.
fn auto(ui: &mut Ui, state: &State, target: &mut Target) {
    let was_auto = *target == Target::Auto;
    let percent = |found: &AutoReport| decimal(found.percent, 1);
    let text = match state.auto().filter(|_| was_auto) {
        _ if !was_auto => say!("panel-auto"),
        Some(found) if !found.is_at_most() => match state.safe().map(Safe::claim) {
            Some(Claim::Safe) => say!("panel-auto-safe", percent = percent(found)),
            Some(Claim::NotPinched) => say!("panel-auto-pinched", percent = percent(found)),
            Some(Claim::KeptWhereMeasured) | None => say!("panel-auto-kept", percent = percent(found)),
        },
        Some(found) if found.is_decided => say!("panel-auto-most", percent = percent(found)),
        _ => say!("panel-auto-deciding"),
    };
    let mut is_auto = was_auto;
    ui.checkbox(&mut is_auto, text)
        .on_hover_text(say!("panel-auto-help", tolerance = state.settings.tolerance_percent));
    if is_auto != was_auto {
        let number = Some(come_to(state, *target)).filter(|target| *target != Target::Auto);
        *target = if is_auto { Target::Auto } else { number.unwrap_or_else(|| rate_shown(state)) };
    }
}

/// The reduction as a number of triangles.
fn wanted(ui: &mut Ui, state: &State, target: &mut Target) {
    let Some(entering) = entering(state) else { return };
    row(ui, &say!("panel-wanted"), &say!("panel-wanted-help"), |ui| {
        // The field shows what can be typed into it: left alone, it sets nothing.
        let most = entering.max(1);
        let wanted = come_to(state, *target).triangles(entering).clamp(1, most);
        let mut typed = wanted;
        let field = egui::DragValue::new(&mut typed).range(1..=most).speed(entering as f64 / 500.0);
        let response = ui.add(counts(field).update_while_editing(false));
        name(&response, Role::SpinButton, &say!("panel-wanted"));
        if !Way::of(ui).scroll(ui, &response) && typed != wanted {
            *target = Target::Triangles(typed as u32);
        }
    });
}
