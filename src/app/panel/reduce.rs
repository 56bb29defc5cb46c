//! The reduction: what it stops at, and by which method.

use egui::{ComboBox, Role, Ui};

use super::{measured, set};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::control::{self, Setting, reads_comma};
use crate::app::error_plot;
use crate::app::row::{number, remark, row, step};
use crate::app::state::State;
use crate::app::swipe::Way;
use crate::app::views::Views;
use crate::language::{decimal, tell, text};
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::table::{self, Kind};
use crate::pipeline::settings::{Settings, Target, reduction_percent};
use crate::pipeline::verdict;
use crate::say;

/// Shows the step.
pub(super) fn show(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    reduction(ui, state, &mut settings);
    set(settings, state, asked);
}

/// Changes `settings`, a copy of those of `state`.
fn reduction(ui: &mut Ui, state: &State, settings: &mut Settings) {
    step(ui, 3, &say!("panel-reduce"), &say!("panel-reduce-does"));
    stop_list(ui, state, &mut settings.target);
    if settings.target.deviation_mm().is_some() {
        largest_deviation(ui, state, settings);
    } else {
        rate_or_count(ui, state, settings);
    }
    // Where it is on, it can be turned off.
    let has_labels =
        state.document.as_ref().is_some_and(|document| document.import.arrays.iter().any(|info| info.labels.len() > 1));
    let keeps_labels = has_labels || settings.decimation.keep_labels;
    for setting in table::of("decimation").filter(|setting| setting.key != "keep-labels" || keeps_labels) {
        if (setting.matters)(settings) {
            control::setting(ui, setting, settings);
        }
    }
    error_plot::section(ui, state, &mut settings.target);
    let shown = state.document.as_ref().and_then(|d| d.shown.as_ref());
    if let Some(shortfall) = shown.and_then(|shown| shown.level.shortfall.as_ref()) {
        remark(ui, &format!("{}.", tell(&shortfall.message())));
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

/// The bound that a reset goes back to: 0.1 mm.
const DEFAULT_BOUND: Target = Target::Deviation(100);
/// The largest bound of the slider, in thousandths of a mm.
const LARGEST_BOUND: u32 = 10_000;

/// The slider of a target that is said in the way `key` of the table, where it stands at `value`.
fn target_row(
    ui: &mut Ui,
    key: &str,
    value: f64,
    target: &mut Target,
    show: impl FnOnce(Setting<'_>, &mut Ui, &mut f64) -> bool,
) {
    let Some(setting) = table::find(key) else { return };
    let Kind::Target { steps, make, ref range, .. } = setting.kind else { return };
    let (words, help) = (text(setting.messages.label), text(setting.messages.help));
    let mut value = value;
    if show(control::number(setting, range, &words, &help), ui, &mut value) {
        *target = make((value * f64::from(steps)).round() as u32);
    }
}

/// The slider of the largest deviation.
fn bound(ui: &mut Ui, target: &mut Target) {
    let largest = f64::from(LARGEST_BOUND) / 1000.0;
    let default = DEFAULT_BOUND.deviation_mm().unwrap_or_default();
    target_row(ui, "max-deviation", target.deviation_mm().unwrap_or_default(), target, |row, ui, bound| {
        Setting { range: *row.range.start()..=largest, default, ..row }.show(ui, bound)
    });
}

fn largest_deviation(ui: &mut Ui, state: &State, settings: &mut Settings) {
    bound(ui, &mut settings.target);
    // Of these settings and no others: another smoothing has other levels.
    let is_current = *settings == state.settings && state.has_level();
    let found = measured(state.document.as_ref()).filter(|_| is_current).and_then(|report| report.bound);
    let next = found.map(|found| match found.next_coarser_mm {
        Some(mm) => format!("{} mm", decimal(mm, 3)),
        None => say!("panel-next-coarser-none"),
    });
    let help = say!("panel-next-coarser-help");
    number(ui, &say!("panel-next-coarser"), next.as_deref().unwrap_or("–"), &help);
}

/// What is safe in words, and a way there. The row is there before it is known: what lies below must not move when it is.
fn safe_row(ui: &mut Ui, safe: Option<&Safe>, tolerance: f64, target: &mut Target) {
    let mut help = say!("panel-safe-help", tolerance = tolerance);
    if let Some(why) = safe.and_then(|safe| safe.stopped_by.as_ref()) {
        help += &format!(" {}.", tell(why));
    }
    if let Some(why) = safe.and_then(|safe| safe.refused.as_ref()) {
        help += " ";
        help += &say!("panel-safe-refused", why = tell(why));
    }
    let changed = safe.map_or(0, |safe| safe.branches.iter().filter(|branch| branch.changed_by_smoothing).count());
    if changed > 0 {
        help += " ";
        help += &say!("panel-safe-changed", count = changed);
    }
    let coverage = safe.and_then(|safe| safe.coverage);
    let is_covered = safe.is_none_or(|safe| safe.coverage.is_none() || safe.is_covered());
    let coverage = coverage.map(|coverage| tell(&coverage.text()));
    if let Some(coverage) = &coverage {
        help += " ";
        help += &say!("panel-safe-rests", coverage = coverage);
    }
    let percent = safe.and_then(|safe| safe.percent);
    let wanted = percent.map(verdict::rate);
    let label = if is_covered { say!("panel-safe") } else { say!("panel-kept-to") };
    row(ui, &label, &help, |ui| {
        let go =
            ui.add_enabled(wanted.is_some_and(|wanted| wanted != *target), egui::Button::new(say!("panel-go-there")));
        if let Some(wanted) = wanted.filter(|_| go.on_hover_text(say!("panel-safe-go-help")).clicked()) {
            *target = wanted;
        }
        ui.label(match (safe, percent) {
            (_, Some(percent)) => format!("{} %", decimal(percent, 1)),
            (Some(_), None) => "–".to_owned(),
            (None, _) => "...".to_owned(),
        });
    });
    remark(ui, coverage.as_deref().unwrap_or("..."));
}

/// How many triangles enter the reduction.
fn entering(state: &State) -> Option<usize> {
    Some(state.document.as_ref()?.levels.as_ref()?.1.triangles.len())
}

/// The slider of the rate.
fn rate(ui: &mut Ui, state: &State, target: &mut Target) {
    let percent = target.percent(entering(state).unwrap_or(0));
    let safe = state.safe().and_then(|safe| safe.percent);
    target_row(ui, "reduction", percent, target, |row, ui, percent| row.show_with_mark(ui, percent, safe));
}

fn rate_or_count(ui: &mut Ui, state: &State, settings: &mut Settings) {
    let safe = state.safe();
    let target = &mut settings.target;
    rate(ui, state, target);
    safe_row(ui, safe, settings.tolerance_percent, target);
    if let Some(entering) = entering(state) {
        row(ui, &say!("panel-wanted"), &say!("panel-wanted-help"), |ui| {
            // The field shows what can be typed into it: left alone, it sets nothing.
            let most = entering.max(1);
            let wanted = target.triangles(entering).clamp(1, most);
            let mut typed = wanted;
            let field = egui::DragValue::new(&mut typed).range(1..=most).speed(entering as f64 / 500.0);
            let response = ui.add(reads_comma(field, true).update_while_editing(false));
            name(&response, Role::SpinButton, &say!("panel-wanted"));
            if !Way::of(ui).scroll(ui, &response) && typed != wanted {
                *target = Target::Triangles(typed as u32);
            }
        });
    }
}

/// Shows what is seen of the panel where there is no room for more: the count, and how far the reduction goes.
pub(in crate::app) fn peek(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let document = state.document.as_ref();
    let counts = document.and_then(|document| Some((&document.levels.as_ref()?.1, document.shown.as_ref()?)));
    let Some((levels, shown)) = counts else { return };
    let counts = say!("panel-of", count = shown.level.triangles.len(), all = levels.triangles.len());
    number(ui, &say!("panel-triangles"), &counts, &say!("panel-of-help"));
    let mut settings = state.settings.clone();
    let is_bound = settings.target.deviation_mm().is_some();
    if is_bound {
        bound(ui, &mut settings.target);
    } else {
        rate(ui, state, &mut settings.target);
    }
    set(settings, state, asked);
}
