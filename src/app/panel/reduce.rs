//! The panel: the method from top to bottom, each step with its few controls, its result in numbers, and one line
//! that says what it does.

use egui::{Button, CollapsingHeader, ComboBox, RichText, Role, ScrollArea, Ui};

use super::action::Action;
use super::arrays;
use super::assist::{heading, name};
use super::axes;
use super::control::{Setting, reads_comma};
use super::document::Document;
use super::error_plot;
use super::mending;
use super::response;
use super::row::{number, remark, row, step};
use super::state::State;
use super::swipe::Way;
use super::theme;
use super::vessels;
use super::views::{ViewOptions, Views};
use crate::engine::Source;
use crate::io::Unit;
use crate::language::{Key, decimal, grouped, signed};
use crate::pipeline::report::Report;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Keep, Method, Preset, Settings, Smoothing, Target, Window, reduction_percent};
use crate::pipeline::verdict;
use crate::say;

/// A step of the method: shows its controls, and says what they ask for.
type Step = fn(&mut Ui, &State, &Views, &mut Vec<Action>);

/// The steps that lead to a level, each with an identity of its own: what comes and goes in one must not take the focus
/// away in another.
pub(super) const STEPS: [(&str, Step); 3] = [("surface", surface), ("smooth", smooth), ("reduce", reduce)];

/// Height of what [`peek`] shows, in points.
pub(super) const PEEK: f32 = 132.0;

/// Height of what is seen at a place that is gone to, in edges.
const AROUND: f32 = 60.0;

/// Asks for `settings`, if they are others than those of `state`.
fn set(settings: Settings, state: &State, asked: &mut Vec<Action>) {
    if settings != state.settings {
        asked.push(Action::Set(Box::new(settings)));
    }
}

fn measured(document: Option<&Document>) -> Option<&Report> {
    Some(&document?.measured.as_ref()?.report)
}

fn surface(ui: &mut Ui, state: &State, views: &Views, asked: &mut Vec<Action>) {
    step(ui, 1, &say!("panel-surface"), &say!("panel-surface-does"));
    let Some(document) = &state.document else {
        ui.label(say!("panel-surface-none"));
        return;
    };
    let pieces = &document.pieces;
    unit_list(ui, document, asked);
    axes::list(ui, document, asked);
    let in_file = grouped(document.import.triangles);
    number(ui, &say!("panel-in-file"), &in_file, &say!("panel-in-file-help"));
    let Some(kept) = pieces.kept(state.settings.keep).or(pieces.by_size.first().copied()) else {
        return;
    };
    let kept_count = match state.settings.keep {
        Keep::All => document.opened.triangles.len(),
        _ => pieces.list.get(kept as usize).map_or(0, |piece| piece.triangles as usize),
    };
    number(ui, &say!("panel-kept"), &say!("panel-triangle-count", count = kept_count), "");
    let left_out = document.opened.triangles.len() - kept_count;
    let others = pieces.list.len().saturating_sub(1);
    if others > 0 && state.settings.keep != Keep::All {
        let text = say!("panel-left-out-count", count = left_out, pieces = others);
        number(ui, &say!("panel-left-out"), &text, &say!("panel-left-out-help"));
    }
    if pieces.list.len() > 1 {
        let mut settings = state.settings.clone();
        piece_list(ui, document, &mut settings.keep);
        set(settings, state, asked);
        let mut left_out = views.options.left_out;
        let shown = ui.checkbox(&mut left_out, say!("panel-show-left-out"));
        if shown.on_hover_text(say!("panel-show-left-out-help")).changed() {
            asked.push(Action::Show(ViewOptions { left_out, ..views.options }));
        }
    }
    arrays::list(ui, document, views, asked);
    mending::section(ui, state, views, asked);
}

/// The unit of the file's numbers.
fn unit_list(ui: &mut Ui, document: &Document, asked: &mut Vec<Action>) {
    if !matches!(document.source, Source::File { .. }) {
        return;
    }
    let mut unit = document.import.unit;
    ui.horizontal(|ui| {
        ui.label(RichText::new(say!("panel-unit")).weak()).on_hover_text(say!("panel-unit-help"));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let list = ComboBox::from_id_salt("unit").width(56.0).selected_text(unit.symbol());
            let response = list.show_ui(ui, |ui| {
                for choice in Unit::ALL {
                    ui.selectable_value(&mut unit, choice, choice.symbol());
                }
            });
            name(&response.response, Role::ComboBox, &say!("panel-unit-list"));
        });
    });
    if unit != document.import.unit {
        asked.push(Action::ReadIn(unit));
    }
}

/// Size of a piece in words.
fn piece_label(document: &Document, piece: u32) -> String {
    let Some(found) = document.pieces.list.get(piece as usize) else { return String::new() };
    let size = found.bounds.size().max_element();
    say!("panel-piece", count = found.triangles, size = decimal(size, 1))
}

fn piece_list(ui: &mut Ui, document: &Document, keep: &mut Keep) {
    let pieces = &document.pieces;
    let selected = match *keep {
        Keep::All => say!("panel-all-pieces"),
        keep => pieces.kept(keep).map(|piece| piece_label(document, piece)).unwrap_or_default(),
    };
    let list = ComboBox::from_id_salt("pieces").width(ui.available_width() - 16.0).selected_text(selected);
    let response = list.show_ui(ui, |ui| {
        ui.selectable_value(keep, Keep::All, say!("panel-all-pieces"));
        let row = ui.spacing().interact_size.y;
        ScrollArea::vertical().max_height(240.0).show_rows(ui, row, pieces.by_size.len(), |ui, rows| {
            for i in rows {
                let piece = pieces.by_size[i];
                let value = if i == 0 { Keep::Largest } else { Keep::Component(piece) };
                let is_kept = *keep != Keep::All && pieces.kept(*keep) == Some(piece);
                if ui.selectable_label(is_kept, piece_label(document, piece)).clicked() {
                    *keep = value;
                    ui.close();
                }
            }
        });
    });
    name(&response.response, Role::ComboBox, &say!("panel-piece-list"));
}

fn smooth(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
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

fn reduce(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
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
    let decimation = &mut settings.decimation;
    row(ui, &say!("panel-method"), &say!("panel-method-help"), |ui| {
        let list = ComboBox::from_id_salt("method").selected_text(decimation.method.name());
        let response = list.show_ui(ui, |ui| {
            for method in Method::ALL {
                ui.selectable_value(&mut decimation.method, method, method.name());
            }
        });
        name(&response.response, Role::ComboBox, &say!("panel-method"));
    });
    if decimation.method == Method::Schroeder {
        let angle = Setting {
            name: &say!("panel-feature-angle"),
            help: &say!("panel-feature-angle-help"),
            unit: "°",
            range: 0.0..=180.0,
            default: crate::pipeline::settings::Decimation::default().feature_angle,
            decimals: 0,
            logarithmic: false,
        };
        angle.show(ui, &mut decimation.feature_angle);
    }
    let spare = ui.checkbox(&mut decimation.spare_thin, say!("panel-spare-thin"));
    spare.on_hover_text(say!("panel-spare-thin-help"));
    // Where it is on, it can be turned off.
    let has_labels =
        state.document.as_ref().is_some_and(|document| document.import.arrays.iter().any(|info| info.labels.len() > 1));
    if has_labels || decimation.keep_labels {
        let keep = ui.checkbox(&mut decimation.keep_labels, say!("panel-keep-labels"));
        keep.on_hover_text(say!("panel-keep-labels-help"));
    }
    error_plot::section(ui, state, &mut settings.target);
    let shown = state.document.as_ref().and_then(|d| d.shown.as_ref());
    if let Some(shortfall) = shown.and_then(|shown| shown.level.shortfall.as_ref()) {
        remark(ui, &format!("{shortfall}."));
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

/// The slider of the largest deviation.
fn bound(ui: &mut Ui, target: &mut Target) {
    let mut bound = target.deviation_mm().unwrap_or_default();
    let setting = Setting {
        name: &say!("panel-bound"),
        help: &say!("panel-bound-help"),
        unit: " mm",
        range: 0.001..=f64::from(LARGEST_BOUND) / 1000.0,
        default: DEFAULT_BOUND.deviation_mm().unwrap_or_default(),
        decimals: 3,
        logarithmic: true,
    };
    if setting.show(ui, &mut bound) {
        *target = Target::Deviation((bound * 1000.0).round() as u32);
    }
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
        help += &format!(" {why}.");
    }
    if let Some(why) = safe.and_then(|safe| safe.refused.as_ref()) {
        help += " ";
        help += &say!("panel-safe-refused", why = why);
    }
    let changed = safe.map_or(0, |safe| safe.branches.iter().filter(|branch| branch.changed_by_smoothing).count());
    if changed > 0 {
        help += " ";
        help += &say!("panel-safe-changed", count = changed);
    }
    let percent = safe.and_then(|safe| safe.percent);
    let wanted = percent.map(verdict::rate);
    row(ui, &say!("panel-safe"), &help, |ui| {
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
}

/// How many triangles enter the reduction.
fn entering(state: &State) -> Option<usize> {
    Some(state.document.as_ref()?.levels.as_ref()?.1.triangles.len())
}

/// The slider of the rate.
fn rate(ui: &mut Ui, state: &State, target: &mut Target) {
    let mut rate = target.percent(entering(state).unwrap_or(0));
    let reduction = Setting {
        name: &say!("panel-reduction"),
        help: &say!("panel-reduction-help"),
        unit: " %",
        range: 0.0..=f64::from(Target::MAX_PER_MILLE) / 10.0,
        default: Target::default().percent(0),
        decimals: 1,
        logarithmic: false,
    };
    if reduction.show_with_mark(ui, &mut rate, state.safe().and_then(|safe| safe.percent)) {
        *target = Target::Reduction((rate * 10.0).round() as u32);
    }
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
pub(super) fn peek(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
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

/// Shows what came of it, in numbers.
pub(super) fn result(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let Some(document) = &state.document else { return };
    let (Some((_, levels)), Some(shown)) = (&document.levels, &document.shown) else { return };
    ui.separator();
    heading(ui, &say!("panel-result"));
    let (before, after) = (levels.triangles.len(), shown.level.triangles.len());
    let counts = say!("panel-of", count = after, all = before);
    number(ui, &say!("panel-triangles"), &counts, &say!("panel-of-help"));
    let vertices = say!("panel-of", count = shown.vertices, all = document.entering_vertices);
    number(ui, &say!("panel-vertices"), &vertices, &say!("panel-of-help"));
    number(ui, &say!("panel-removed"), &format!("{} %", decimal(reduction_percent(before, after), 2)), "");
    row(ui, &say!("panel-calibre"), &say!("panel-calibre-help"), |ui| {
        if ui.button(say!("panel-vessels")).on_hover_text(say!("panel-vessels-help")).clicked() {
            asked.push(Action::Vessels(vessels::Action::Toggle));
        }
        ui.label(vessels::verdict(state));
    });
    let Some(measured) = &document.measured else { return };
    let is_current = measured.generation == state.generation() && measured.report.output.triangles == after;
    let report = &measured.report;
    let percent = |change: Option<f64>| {
        change.filter(|_| is_current).map_or("–".to_owned(), |change| format!("{} %", signed(change, 2)))
    };
    let distance = |pick: fn(&crate::pipeline::deviation::Deviation) -> f64| {
        let found = report.deviation_mm.as_ref().filter(|_| is_current);
        found.map_or("–".to_owned(), |d| format!("{} mm", decimal(pick(d), 3)))
    };
    let help = say!("panel-deviation-help");
    number(ui, &say!("panel-deviation-mean"), &distance(|d| d.mean), &help);
    number(ui, &say!("panel-deviation-max"), &distance(|d| d.max), &help);
    number(ui, &say!("panel-volume"), &percent(report.volume_change_percent), &say!("panel-volume-help"));
    number(ui, &say!("panel-area"), &percent(report.area_change_percent), &say!("panel-area-help"));
    super::numbers::shape(ui, is_current.then_some(report));
    CollapsingHeader::new(say!("panel-times")).id_salt("Time a stage").show(ui, |ui| {
        let ms = &report.stages_ms;
        let stages = [
            (Key("panel-time-reading"), ms.read),
            (Key("panel-time-mending"), ms.mending),
            (Key("panel-time-connectivity"), ms.connectivity),
            (Key("panel-time-smoothing"), ms.smoothing),
            (Key("panel-time-decimation"), ms.decimation),
            (Key("panel-time-bound"), ms.bound),
            (Key("panel-time-level"), ms.level),
            (Key("panel-time-normals"), ms.normals),
            (Key("panel-time-deviation"), ms.deviation),
            (Key("panel-time-measures"), ms.measures),
            (Key("panel-time-calibre"), ms.calibre),
        ];
        for (stage, ms) in stages {
            number(ui, &stage.say(), &format!("{} ms", decimal(ms, 1)), "");
        }
    });
    if !document.import.warnings.is_empty() {
        CollapsingHeader::new(say!("panel-notes")).id_salt("Notes on the file").show(ui, |ui| {
            for warning in &document.import.warnings_now() {
                remark(ui, warning);
            }
        });
    }
}
