//! The panel: the method from top to bottom, each step with its few controls, its result in numbers, and one line
//! that says what it does.

use egui::{ComboBox, RichText, Role, ScrollArea, Ui};

use super::action::Action;
use super::arrays;
use super::assist::name;
use super::axes;
use super::control::Setting;
use super::document::Document;
use super::response;
use super::row::{number, remark, row, step};
use super::state::State;
use super::vessels;
use super::views::{ViewOptions, Views};
use crate::digits::grouped;
use crate::engine::Source;
use crate::io::Unit;
use crate::pipeline::report::Report;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Keep, Method, Preset, Settings, Smoothing, Target, Window, reduction_percent};

/// A step of the method: shows its controls, and says what they ask for.
type Step = fn(&mut Ui, &State, &Views, &mut Vec<Action>);

/// The steps that lead to a level, each with an identity of its own: what comes and goes in one must not take the focus
/// away in another.
pub(super) const STEPS: [(&str, Step); 3] = [("surface", surface), ("smooth", smooth), ("reduce", reduce)];

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
    step(ui, 1, "Surface", "The largest connected piece is kept.");
    let Some(document) = &state.document else {
        ui.label("Open a surface, or drop a file here.");
        return;
    };
    let pieces = &document.pieces;
    unit_list(ui, document, asked);
    axes::list(ui, document, asked);
    number(ui, "Triangles in file", &grouped(document.import.triangles), "As the file holds them, polygons split");
    let Some(kept) = pieces.kept(state.settings.keep).or(pieces.by_size.first().copied()) else {
        return;
    };
    let kept_count = match state.settings.keep {
        Keep::All => document.opened.triangles.len(),
        _ => pieces.list.get(kept as usize).map_or(0, |piece| piece.triangles as usize),
    };
    number(ui, "Kept", &format!("{} triangles", grouped(kept_count)), "");
    let left_out = document.opened.triangles.len() - kept_count;
    let others = pieces.list.len().saturating_sub(1);
    if others > 0 && state.settings.keep != Keep::All {
        let text = format!("{} in {} pieces", grouped(left_out), grouped(others));
        number(ui, "Left out", &text, "Pieces that share no vertex with the one that is kept");
    }
    if pieces.list.len() > 1 {
        let mut settings = state.settings.clone();
        piece_list(ui, document, &mut settings.keep);
        set(settings, state, asked);
        let mut left_out = views.options.left_out;
        let shown = ui.checkbox(&mut left_out, "Show what is left out");
        if shown.on_hover_text("Click a piece in the view to keep that one").changed() {
            asked.push(Action::Show(ViewOptions { left_out, ..views.options }));
        }
    }
    arrays::list(ui, document, views, asked);
}

/// The unit of the file's numbers.
fn unit_list(ui: &mut Ui, document: &Document, asked: &mut Vec<Action>) {
    if !matches!(document.source, Source::File { .. }) {
        return;
    }
    let mut unit = document.import.unit;
    ui.horizontal(|ui| {
        ui.label(RichText::new("Unit of the file").weak()).on_hover_text("What a length of 1 in the file means");
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let list = ComboBox::from_id_salt("unit").width(56.0).selected_text(unit.symbol());
            let response = list.show_ui(ui, |ui| {
                for choice in Unit::ALL {
                    ui.selectable_value(&mut unit, choice, choice.symbol());
                }
            });
            name(&response.response, Role::ComboBox, "Unit");
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
    format!("{} triangles, {size:.1} mm", grouped(found.triangles as usize))
}

fn piece_list(ui: &mut Ui, document: &Document, keep: &mut Keep) {
    let pieces = &document.pieces;
    let selected = match *keep {
        Keep::All => "All pieces".to_owned(),
        keep => pieces.kept(keep).map(|piece| piece_label(document, piece)).unwrap_or_default(),
    };
    let list = ComboBox::from_id_salt("pieces").width(ui.available_width() - 16.0).selected_text(selected);
    let response = list.show_ui(ui, |ui| {
        ui.selectable_value(keep, Keep::All, "All pieces");
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
    name(&response.response, Role::ComboBox, "Piece");
}

fn smooth(ui: &mut Ui, state: &State, _: &Views, asked: &mut Vec<Action>) {
    let mut settings = state.settings.clone();
    smoothing(ui, &mut settings.smoothing, measured(state.document.as_ref()), asked);
    set(settings, state, asked);
}

/// The settings that have a name.
fn preset_list(ui: &mut Ui, smoothing: &mut Smoothing) {
    let help = "Suits this surface: as the paper, and nowhere so much that a vessel loses its calibre or triangles cross. \
                The paper's: pass band 0.01, 100 iterations, the same everywhere.";
    row(ui, "Strength", help, |ui| {
        // Whether the volume is held is chosen beside it.
        let chosen = Preset::of(&Smoothing { preserve_volume: false, ..*smoothing });
        let list = ComboBox::from_id_salt("preset").selected_text(chosen.map_or("Own", Preset::label));
        let response = list.show_ui(ui, |ui| {
            for preset in Preset::ALL {
                if ui.selectable_label(chosen == Some(preset), preset.label()).clicked() {
                    *smoothing = Smoothing { preserve_volume: smoothing.preserve_volume, ..preset.smoothing() };
                    ui.close();
                }
            }
        });
        name(&response.response, Role::ComboBox, "Strength");
    });
}

fn smoothing(ui: &mut Ui, smoothing: &mut Smoothing, report: Option<&Report>, asked: &mut Vec<Action>) {
    step(ui, 2, "Smooth", "Takes off the stair-steps of the scan.");
    preset_list(ui, smoothing);
    let default = Smoothing::default();
    let pass_band = Setting {
        name: "Pass band",
        help: "What passes the filter: 0.001 leaves the broad form alone, 2 leaves everything. Without unit.",
        unit: "",
        range: Smoothing::PASS_BAND,
        default: default.pass_band,
        decimals: 4,
        logarithmic: true,
    };
    pass_band.show(ui, &mut smoothing.pass_band);
    let iterations = Setting {
        name: "Iterations",
        help: "Degree of the filter: more make it sharper. 0 turns smoothing off.",
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
    let help = "How the filter is tapered. Hamming is the paper's; Nuttall ripples least.";
    row(ui, "Window", help, |ui| {
        let list = ComboBox::from_id_salt("window").selected_text(smoothing.window.name());
        let response = list.show_ui(ui, |ui| {
            for window in Window::ALL {
                ui.selectable_value(&mut smoothing.window, window, window.name());
            }
        });
        name(&response.response, Role::ComboBox, "Window");
    });
    ui.horizontal_wrapped(|ui| {
        let adapt = ui.checkbox(&mut smoothing.adapt, "Adapt to calibre");
        adapt.on_hover_text(
            "Smooths thin vessels less, so that each keeps its calibre. The pass band is that of the wide ones.",
        );
        let guard = ui.checkbox(&mut smoothing.guard, "No crossings");
        guard.on_hover_text("Smooths less where triangles would be drawn through others: at folds, between vessels.");
        let hold = ui.checkbox(&mut smoothing.preserve_volume, "Preserve volume");
        hold.on_hover_text("Gives back what smoothing takes off, where it does: open ends capped, held to 0.01 %.");
    });
    let edge_length = report.and_then(|report| report.smoothing_response).map(|response| response.edge_length_mm);
    let lumen = report.and_then(|report| report.smoothed_shape.as_ref()?.smallest_lumen);
    let thinnest = lumen.map(|lumen| lumen.diameter_mm);
    response::show(ui, smoothing, response::Scale { edge_length, thinnest });
    let Some(report) = report.filter(|report| report.settings.smoothing == *smoothing) else { return };
    if let Some(weakened) = report.smoothing_weakened {
        ui.horizontal_wrapped(|ui| {
            remark(ui, &format!("Smoothed less at {} vertices: no crossings.", grouped(weakened.vertices)));
            if ui.small_button("Show").on_hover_text("Goes to where it is smoothed least").clicked() {
                let height_mm = AROUND * report.smoothing_response.map_or(1.0, |found| found.edge_length_mm) as f32;
                asked.push(Action::GoTo { at_mm: weakened.at_mm, height_mm, label: "Smoothed less".to_owned() });
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
    step(ui, 3, "Reduce", "Removes what matters least; topology stays.");
    stop_list(ui, state, &mut settings.target);
    if settings.target.deviation_mm().is_some() {
        largest_deviation(ui, state, settings);
    } else {
        rate_or_count(ui, state, settings);
    }
    let decimation = &mut settings.decimation;
    let help = "Schroeder is the paper's: it deletes vertices and moves none. Quadric moves them: half the mean deviation, better shape.";
    row(ui, "Method", help, |ui| {
        let list = ComboBox::from_id_salt("method").selected_text(decimation.method.name());
        let response = list.show_ui(ui, |ui| {
            for method in Method::ALL {
                ui.selectable_value(&mut decimation.method, method, method.name());
            }
        });
        name(&response.response, Role::ComboBox, "Method");
    });
    if decimation.method == Method::Schroeder {
        let angle = Setting {
            name: "Feature angle",
            help: "Edges sharper than this are kept as edges.",
            unit: "°",
            range: 0.0..=180.0,
            default: crate::pipeline::settings::Decimation::default().feature_angle,
            decimals: 0,
            logarithmic: false,
        };
        angle.show(ui, &mut decimation.feature_angle);
    }
    let spare = ui.checkbox(&mut decimation.spare_thin, "Spare thin vessels");
    spare.on_hover_text(
        "An error counts the more, the thinner the vessel is: thin ones keep more of the triangles, wide ones fewer.",
    );
    let shown = state.document.as_ref().and_then(|d| d.shown.as_ref());
    if let Some(shortfall) = shown.and_then(|shown| shown.level.shortfall.as_ref()) {
        remark(ui, &format!("{shortfall}."));
    }
}

/// What the reduction stops at; another choice goes on from the level that is shown.
fn stop_list(ui: &mut Ui, state: &State, target: &mut Target) {
    let by_deviation = target.deviation_mm().is_some();
    let mut chosen = by_deviation;
    row(ui, "Stop at", "What says how far the reduction goes", |ui| {
        let names = |by_deviation: bool| if by_deviation { "Deviation" } else { "Rate or count" };
        let list = ComboBox::from_id_salt("stop").selected_text(names(by_deviation));
        let response = list.show_ui(ui, |ui| {
            for choice in [false, true] {
                ui.selectable_value(&mut chosen, choice, names(choice));
            }
        });
        name(&response.response, Role::ComboBox, "Stop at");
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

fn largest_deviation(ui: &mut Ui, state: &State, settings: &mut Settings) {
    let mut bound = settings.target.deviation_mm().unwrap_or_default();
    let setting = Setting {
        name: "Largest deviation",
        help: "As few triangles as stay within this of the smoothed surface everywhere, both ways.",
        unit: " mm",
        range: 0.001..=f64::from(LARGEST_BOUND) / 1000.0,
        default: DEFAULT_BOUND.deviation_mm().unwrap_or_default(),
        decimals: 3,
        logarithmic: true,
    };
    if setting.show(ui, &mut bound) {
        settings.target = Target::Deviation((bound * 1000.0).round() as u32);
    }
    // Of these settings and no others: another smoothing has other levels.
    let is_current = *settings == state.settings && state.has_level();
    let found = measured(state.document.as_ref()).filter(|_| is_current).and_then(|report| report.bound);
    let next = found.map(|found| found.next_coarser_mm.map_or("none".to_owned(), |mm| format!("{mm:.3} mm")));
    let help = "A deviation that was found in the level with one step more";
    number(ui, "Next coarser level", next.as_deref().unwrap_or("–"), help);
}

/// What is safe in words, and a way there. The row is there before it is known: what lies below must not move when it is.
fn safe_row(ui: &mut Ui, safe: Option<&Safe>, tolerance: f64, target: &mut Target) {
    let mut help = format!(
        "Up to here every vessel that can be measured keeps its calibre to {tolerance} %, none is pinched, and no \
         triangles cross that did not."
    );
    if let Some(why) = safe.and_then(|safe| safe.stopped_by.as_ref()) {
        help += &format!(" {why}.");
    }
    if let Some(why) = safe.and_then(|safe| safe.refused.as_ref()) {
        help += &format!(" There is no such rate here: {why}.");
    }
    let changed = safe.map_or(0, |safe| safe.branches.iter().filter(|branch| branch.changed_by_smoothing).count());
    if changed > 0 {
        help += &format!(" Branches that smoothing itself changes by more do not count: {}.", grouped(changed));
    }
    let percent = safe.and_then(|safe| safe.percent);
    let wanted = percent.map(|percent| Target::Reduction((percent * 10.0).round() as u32));
    row(ui, "Safe to", &help, |ui| {
        let go = ui.add_enabled(wanted.is_some_and(|wanted| wanted != *target), egui::Button::new("Go there"));
        if let Some(wanted) =
            wanted.filter(|_| go.on_hover_text("Sets the reduction to the mark under the slider").clicked())
        {
            *target = wanted;
        }
        ui.label(match (safe, percent) {
            (_, Some(percent)) => format!("{percent:.1} %"),
            (Some(_), None) => "–".to_owned(),
            (None, _) => "...".to_owned(),
        });
    });
}

fn rate_or_count(ui: &mut Ui, state: &State, settings: &mut Settings) {
    let safe = state.safe();
    let target = &mut settings.target;
    let entering = state.document.as_ref().and_then(|d| Some(d.levels.as_ref()?.1.triangles.len()));
    let mut rate = target.percent(entering.unwrap_or(0));
    let reduction = Setting {
        name: "Reduction",
        help: "The part of the triangles that is removed.",
        unit: " %",
        range: 0.0..=f64::from(Target::MAX_PER_MILLE) / 10.0,
        default: Target::default().percent(0),
        decimals: 1,
        logarithmic: false,
    };
    if reduction.show_with_mark(ui, &mut rate, safe.and_then(|safe| safe.percent)) {
        *target = Target::Reduction((rate * 10.0).round() as u32);
    }
    safe_row(ui, safe, settings.tolerance_percent, target);
    if let Some(entering) = entering {
        row(ui, "Triangles wanted", "The same as a number; drag, or click to type", |ui| {
            // The field shows what can be typed into it: left alone, it sets nothing.
            let most = entering.max(1);
            let wanted = target.triangles(entering).clamp(1, most);
            let mut typed = wanted;
            let field = egui::DragValue::new(&mut typed).range(1..=most).speed(entering as f64 / 500.0);
            let response = ui.add(field.update_while_editing(false));
            name(&response, Role::SpinButton, "Triangles wanted");
            if typed != wanted {
                *target = Target::Triangles(typed as u32);
            }
        });
    }
}

/// Shows what came of it, in numbers.
pub(super) fn result(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let Some(document) = &state.document else { return };
    let (Some((_, levels)), Some(shown)) = (&document.levels, &document.shown) else { return };
    ui.separator();
    ui.label(RichText::new("Result").heading());
    let (before, after) = (levels.triangles.len(), shown.level.triangles.len());
    let counts = format!("{} of {}", grouped(after), grouped(before));
    number(ui, "Triangles", &counts, "After and before the reduction");
    let vertices = format!("{} of {}", grouped(shown.vertices), grouped(document.entering_vertices));
    number(ui, "Vertices", &vertices, "After and before the reduction");
    number(ui, "Removed", &format!("{:.2} %", reduction_percent(before, after)), "");
    row(ui, "Calibre", "Whether every vessel that can be measured keeps its calibre", |ui| {
        if ui.button("Vessels").on_hover_text("What became of each, and where").clicked() {
            asked.push(Action::Vessels(vessels::Action::Toggle));
        }
        ui.label(vessels::verdict(state));
    });
    let Some(measured) = &document.measured else { return };
    let is_current = measured.generation == state.generation() && measured.report.output.triangles == after;
    let report = &measured.report;
    let percent =
        |change: Option<f64>| change.filter(|_| is_current).map_or("–".to_owned(), |c| format!("{c:+.2} %"));
    let distance = |pick: fn(&crate::pipeline::deviation::Deviation) -> f64| {
        let found = report.deviation_mm.as_ref().filter(|_| is_current);
        found.map_or("–".to_owned(), |d| format!("{:.3} mm", pick(d)))
    };
    number(ui, "Deviation, mean", &distance(|d| d.mean), "Distance from the smoothed surface, measured both ways");
    number(ui, "Deviation, max", &distance(|d| d.max), "Distance from the smoothed surface, measured both ways");
    number(
        ui,
        "Volume",
        &percent(report.volume_change_percent),
        "Change from the kept pieces as opened, open ends capped",
    );
    number(ui, "Area", &percent(report.area_change_percent), "Change from the kept pieces as opened");
    super::numbers::shape(ui, is_current.then_some(report));
    ui.collapsing("Time a stage", |ui| {
        let ms = &report.stages_ms;
        let stages = [
            ("Reading", ms.read),
            ("Connectivity", ms.connectivity),
            ("Smoothing", ms.smoothing),
            ("Decimation, all rates", ms.decimation),
            ("Finding the level", ms.bound),
            ("Level", ms.level),
            ("Normals", ms.normals),
            ("Deviation", ms.deviation),
            ("Shape and lumen", ms.measures),
            ("Calibre", ms.calibre),
        ];
        for (stage, ms) in stages {
            number(ui, stage, &format!("{ms:.1} ms"), "");
        }
    });
    if !document.import.warnings.is_empty() {
        ui.collapsing("Notes on the file", |ui| {
            for warning in &document.import.warnings {
                remark(ui, warning);
            }
        });
    }
}
