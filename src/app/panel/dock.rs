//! What of the method is always in sight: the sliders of pass band, iterations and reduction with their numbers, how far a
//! reduction is safe, and how many triangles are left.

use egui::{Align, Label, Layout, RichText, Ui};

use super::reduce::{DEFAULT_BOUND, LARGEST_BOUND};
use super::{come_to, entering, measured, set};
use crate::app::action::Action;
use crate::app::control::{self, Change, Form, Setting};
use crate::app::explain::explain;
use crate::app::row::{number, row};
use crate::app::state::State;
use crate::app::theme;
use crate::app::tie::Tie;
use crate::language::{decimal, tell, text};
use crate::pipeline::settings::table::{self, Kind};
use crate::pipeline::settings::{Settings, Target};
use crate::pipeline::verdict;
use crate::say;

/// From this width on the sliders stand side by side, each with room for its name and its field, in points.
const WIDE: f32 = 680.0;
/// Room between sliders that stand side by side, in points.
const GAP: f32 = 24.0;
/// The same where there is next to no room, in points.
const FLAT_GAP: f32 = 16.0;

/// Shows the three sliders in a row, and nothing that they lead to: where there is next to no height.
pub(in crate::app) fn flat_dock(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = FLAT_GAP;
        ui.columns(3, |columns| {
            columns.iter_mut().for_each(|column| column.spacing_mut().item_spacing.x = theme::GRID);
            smoothing(&mut columns[0], "pass-band", &mut settings, Form::Flat);
            smoothing(&mut columns[1], "iterations", &mut settings, Form::Flat);
            reduction(&mut columns[2], state, &mut settings, Form::Flat);
        });
    });
    set(settings, state, asked);
}

/// Shows the dock. Its height depends on the width alone, whatever is known.
pub(in crate::app) fn dock(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    if ui.available_width() >= WIDE {
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            ui.columns(3, |columns| {
                columns.iter_mut().for_each(|column| column.spacing_mut().item_spacing.x = theme::GRID);
                smoothing(&mut columns[0], "pass-band", &mut settings, Form::Tall);
                smoothing(&mut columns[1], "iterations", &mut settings, Form::Tall);
                // As high as the row beside it.
                row(&mut columns[1], &say!("panel-triangles"), &say!("panel-of-help"), |ui| {
                    ui.label(counts(state));
                });
                reduction(&mut columns[2], state, &mut settings, Form::Tall);
                limit(&mut columns[2], state, &mut settings, Form::Tall);
            });
        });
    } else {
        let form = if theme::suits_finger(ui.ctx()) { Form::Low } else { Form::Tall };
        smoothing(ui, "pass-band", &mut settings, form);
        smoothing(ui, "iterations", &mut settings, form);
        reduction(ui, state, &mut settings, form);
        limit(ui, state, &mut settings, form);
        number(ui, &say!("panel-triangles"), &counts(state), &say!("panel-of-help"));
    }
    set(settings, state, asked);
}

fn smoothing(ui: &mut Ui, key: &str, settings: &mut Settings, form: Form) {
    if let Some(setting) = table::find(key) {
        control::docked(ui, setting, settings, form);
    }
}

/// How far the reduction goes: a rate, or a bound on the deviation.
fn reduction(ui: &mut Ui, state: &State, settings: &mut Settings, form: Form) {
    let target = &mut settings.target;
    match target.deviation_mm() {
        Some(mm) => {
            let largest = f64::from(LARGEST_BOUND) / 1000.0;
            let default = DEFAULT_BOUND.deviation_mm().unwrap_or_default();
            target_row(ui, "max-deviation", mm, target, |row, ui, bound| {
                Setting { range: *row.range.start()..=largest, default, ..row }.show_docked(ui, bound, form, None)
            });
        }
        None => {
            let percent = come_to(state, *target).percent(entering(state).unwrap_or(0));
            let safe = state.safe().and_then(|safe| safe.percent);
            target_row(ui, "reduction", percent, target, |row, ui, percent| {
                Tie::Reduction.around(ui, |ui| row.show_docked(ui, percent, form, safe))
            });
        }
    }
}

/// The slider of a target that is said in the way `key` of the table, where it stands at `value`.
fn target_row(
    ui: &mut Ui,
    key: &str,
    value: f64,
    target: &mut Target,
    show: impl FnOnce(Setting<'_>, &mut Ui, &mut f64) -> Change,
) {
    let Some(setting) = table::find(key) else { return };
    let Kind::Target { steps, make, named, ref range, .. } = setting.kind else { return };
    let (words, help) = (text(setting.messages.label), text(setting.messages.help));
    let mut value = value;
    let shown =
        Setting { auto: named.map(|(_, auto)| auto == *target), ..control::number(setting, range, &words, &help) };
    *target = match (show(shown, ui, &mut value), named) {
        (Change::None, _) => return,
        (Change::Reset, Some((_, auto))) => auto,
        _ => make((value * f64::from(steps)).round() as u32),
    };
}

/// How far the reduction may go.
fn limit(ui: &mut Ui, state: &State, settings: &mut Settings, form: Form) {
    if settings.target.deviation_mm().is_some() {
        next_coarser(ui, state, settings);
    } else {
        let shown = come_to(state, settings.target);
        safe_row(ui, state, shown, settings, form);
    }
}

fn next_coarser(ui: &mut Ui, state: &State, settings: &Settings) {
    // Of these settings and no others: another smoothing has other levels.
    let is_current = *settings == state.settings && state.has_level();
    let found = measured(state.document.as_ref()).filter(|_| is_current).and_then(|report| report.bound);
    let next = found.map(|found| match found.next_coarser_mm {
        Some(mm) => format!("{} mm", decimal(mm, 3)),
        None => say!("panel-next-coarser-none"),
    });
    row(ui, &say!("panel-next-coarser"), &say!("panel-next-coarser-help"), |ui| {
        ui.label(next.as_deref().unwrap_or("–"));
    });
}

/// What is safe in words, and a way there. The row is there before it is known: what lies below must not move when it is.
fn safe_row(ui: &mut Ui, state: &State, shown: Target, settings: &mut Settings, form: Form) {
    let safe = state.safe();
    let mut help = say!("panel-safe-help", tolerance = settings.tolerance_percent);
    if let Some(why) = safe.and_then(|safe| safe.stopped_by.as_ref()) {
        help += &format!(" {}.", tell(why));
    }
    let refused = safe.and_then(|safe| safe.refused.as_ref()).map(|why| tell(why));
    if let Some(why) = &refused {
        help += " ";
        help += &say!("panel-safe-refused", why = why);
    }
    let changed = safe.map_or(0, |safe| safe.branches.iter().filter(|branch| branch.changed_by_smoothing).count());
    if changed > 0 {
        help += " ";
        help += &say!("panel-safe-changed", count = changed);
    }
    let coverage = safe.and_then(|safe| safe.coverage).map(|coverage| tell(&coverage.text()));
    let at = safe.and_then(|safe| safe.percent).map(|percent| decimal(percent, 1)).unwrap_or_default();
    if let Some(coverage) = &coverage {
        help += " ";
        help += &say!("panel-safe-rests", coverage = coverage, percent = at.as_str());
    }
    // The verdict is on the level that is shown, and this on the one at the mark: less is measured of coarser ones.
    let of_verdict = state.calibre().and_then(|calibre| Some(tell(&calibre.found.as_ref().ok()?.coverage.text())));
    let differs =
        of_verdict.is_some_and(|of_verdict| coverage.as_ref().is_some_and(|coverage| *coverage != of_verdict));
    let coverage =
        coverage.map(
            |coverage| {
                if differs { say!("panel-safe-rests-at", coverage = coverage, percent = at) } else { coverage }
            },
        );
    if theme::suits_finger(ui.ctx()) {
        // A tap on the button would press it.
        help += &format!(" {}: {}.", say!("panel-go-there"), say!("panel-safe-go-help"));
    }
    let is_covered = safe.is_none_or(|safe| safe.coverage.is_none() || safe.is_covered());
    let label = if is_covered { say!("panel-safe") } else { say!("panel-kept-to") };
    let percent = safe.and_then(|safe| safe.percent);
    let wanted = percent.map(verdict::rate);
    let rests = coverage.as_deref().or(refused.as_deref()).unwrap_or("...");
    let line = |ui: &mut Ui| ui.add(Label::new(RichText::new(rests).small()).truncate());
    let mut control = |ui: &mut Ui| {
        let go =
            ui.add_enabled(wanted.is_some_and(|wanted| wanted != shown), egui::Button::new(say!("panel-go-there")));
        if let Some(wanted) = wanted.filter(|_| go.on_hover_text(say!("panel-safe-go-help")).clicked()) {
            settings.target = wanted;
        }
        ui.label(match (safe, percent) {
            (_, Some(percent)) => format!("{} %", decimal(percent, 1)),
            (Some(_), None) => "–".to_owned(),
            (None, _) => "...".to_owned(),
        });
    };
    match form {
        Form::Tall | Form::Flat => {
            row(ui, &label, &help, control);
            line(ui);
        }
        // A row for a finger has room for two lines.
        Form::Low => {
            ui.horizontal(|ui| {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    control(ui);
                    ui.vertical(|ui| {
                        ui.spacing_mut().item_spacing.y = 0.0;
                        explain(ui.add(Label::new(label).truncate()), &help);
                        line(ui);
                    });
                });
            });
        }
    }
}

/// How many triangles the level has, and how many there were before the reduction.
fn counts(state: &State) -> String {
    let document = state.document.as_ref();
    let counts = document.and_then(|document| Some((&document.levels.as_ref()?.1, document.shown.as_ref()?)));
    counts.map_or_else(
        || "–".to_owned(),
        |(levels, shown)| say!("panel-of", count = shown.level.triangles.len(), all = levels.triangles.len()),
    )
}
