//! Mending in the panel: what is wrong with the surface as the file has it, a way to each place, and what is done about it.

use egui::{Color32, DragValue, Rect, Role, Shape, Stroke, Ui, pos2};

use super::action::Action;
use super::assist::name;
use super::control::{self, reads_comma, suffix};
use super::document::Document;
use super::options::{FaultShown, ViewOptions};
use super::places::seen;
use super::row::{number, remark, row};
use super::state::State;
use crate::language::{Key, decimal, grouped, inner, tell, text};
use crate::mesh::mending::{FaultCounts, FaultKind, FaultPlace, Mending};
use crate::pipeline::settings::Settings;
use crate::pipeline::settings::table::{self, Kind};
use crate::render::Camera;
use crate::say;

/// Height of what is seen around a fault, in times its size, and in mm at least.
const AROUND: f32 = 6.0;
const MIN_MM: f32 = 5.0;
/// What can be mended, from top to bottom.
const ORDER: [&str; 4] = ["fill-holes", "weld", "split", "lumen"];

/// Shows the section: folded where there is nothing to mend and nothing is mended.
pub(super) fn section(ui: &mut Ui, state: &State, options: ViewOptions, asked: &mut Vec<Action>) {
    let Some(document) = &state.document else { return };
    let counts = document.faults.as_ref().map(|found| found.counts);
    let is_open = counts.is_some_and(|counts| is_faulty(&counts)) || !state.settings.mending.is_off();
    let header = egui::CollapsingHeader::new(say!("panel-mending")).default_open(is_open);
    // Another surface, or news of this one, folds or unfolds it anew.
    header.id_salt(("mending", document.revision.document, is_open)).show(ui, |ui| {
        match &counts {
            Some(counts) => faults(ui, document, counts, options, asked),
            None => remark(ui, &say!("panel-faults-sought")),
        }
        let mut settings = state.settings.clone();
        choices(ui, &mut settings, counts.as_ref());
        if settings != state.settings {
            asked.push(set(settings));
        }
        done(ui, state, document);
    });
}

/// Whether there is something to mend, and nothing is mended.
pub(super) fn is_called_for(state: &State) -> bool {
    let found = state.document.as_ref().and_then(|document| document.faults.as_ref());
    found.is_some_and(|found| is_faulty(&found.counts)) && state.settings.mending.is_off()
}

/// Whether there is something to mend.
fn is_faulty(counts: &FaultCounts) -> bool {
    counts.non_manifold_edges + counts.non_manifold_vertices + counts.holes > 0 || counts.wall.is_some()
}

/// Other settings; a piece that is kept by its number may be another one then, so the largest is.
fn set(mut settings: Settings) -> Action {
    settings.keep = settings.keep.without_numbers();
    Action::Set(Box::new(settings))
}

/// What is wrong, with a way to each place.
fn faults(ui: &mut Ui, document: &Document, counts: &FaultCounts, options: ViewOptions, asked: &mut Vec<Action>) {
    if !is_faulty(counts) {
        remark(ui, &say!("panel-faults-none"));
    }
    let rows = [
        (FaultKind::Hole, counts.holes, say!("panel-holes"), say!("panel-holes-help")),
        (FaultKind::Edge, counts.non_manifold_edges, say!("panel-edges"), say!("panel-edges-help")),
        (FaultKind::Vertex, counts.non_manifold_vertices, say!("panel-points"), say!("panel-points-help")),
        (FaultKind::VesselEnd, counts.vessel_ends, say!("panel-ends"), say!("panel-ends-help")),
    ];
    for (kind, count, what, help) in rows.into_iter().filter(|&(_, count, ..)| count > 0) {
        let counted = match counts.largest_hole_mm.filter(|_| kind == FaultKind::Hole) {
            Some(mm) => say!("panel-holes-count", count = count, size = decimal(mm, 1)),
            None => grouped(count),
        };
        row(ui, &what, &help, |ui| {
            let shown = show_button(ui, document, kind, &what, options, asked);
            ui.label(shown.unwrap_or(counted));
        });
    }
    if let Some(wall) = counts.wall {
        let thick = say!("panel-wall-thickness", thickness = decimal(wall.thickness_mm, 2));
        number(ui, &say!("panel-wall"), &thick, &say!("panel-wall-help"));
    }
    let import = &document.import;
    for (what, count, help) in [
        (Key("panel-dropped"), import.degenerate_triangles, Key("panel-dropped-help")),
        (Key("panel-double"), import.duplicate_triangles, Key("panel-double-help")),
        (Key("panel-turned"), import.reoriented_triangles, Key("panel-turned-help")),
        (Key("panel-turned-pieces"), import.components_turned, Key("panel-turned-pieces-help")),
    ] {
        if count > 0 {
            number(ui, &what.say(), &grouped(count), &help.say());
        }
    }
}

/// Marks the faults of a kind and goes to the first, then to the next; which of how many is looked at, if one is.
fn show_button(
    ui: &mut Ui,
    document: &Document,
    kind: FaultKind,
    what: &str,
    options: ViewOptions,
    asked: &mut Vec<Action>,
) -> Option<String> {
    let places: Vec<&FaultPlace> = of_kind(document, kind).collect();
    let shown = options.fault.filter(|shown| shown.kind == kind).map(|shown| usize::from(shown.index));
    let next = shown.map_or(0, |index| (index + 1) % places.len().max(1));
    let position = shown.map(|index| say!("panel-of", count = index + 1, all = places.len()));
    let (words, spoken) = match shown {
        Some(_) => (say!("panel-fault-next"), say!("panel-fault-next-of", faults = inner(what))),
        None => (say!("panel-show"), say!("panel-fault-show", faults = inner(what))),
    };
    let response = ui.button(words).on_hover_text(say!("panel-fault-show-help"));
    name(&response, Role::Button, &spoken);
    if response.clicked()
        && let Some(place) = places.get(next)
    {
        let fault = Some(FaultShown { kind, index: next as u16 });
        asked.push(Action::Show(ViewOptions { fault, ..options }));
        let height_mm = (AROUND * place.size_mm).max(MIN_MM);
        asked.push(Action::GoTo { at_mm: place.at_mm, height_mm, label: label(place) });
    }
    position
}

fn of_kind(document: &Document, kind: FaultKind) -> impl Iterator<Item = &FaultPlace> {
    document.faults.iter().flat_map(|found| &found.places).filter(move |place| place.kind == kind)
}

fn label(place: &FaultPlace) -> String {
    match place.kind {
        FaultKind::Edge => say!("panel-edge-place"),
        FaultKind::Vertex => say!("panel-point-place"),
        FaultKind::Hole => say!("panel-hole-place", size = decimal(place.size_mm, 1)),
        FaultKind::VesselEnd => say!("panel-end-place", size = decimal(place.size_mm, 1)),
    }
}

/// What is to be mended.
fn choices(ui: &mut Ui, settings: &mut Settings, counts: Option<&FaultCounts>) {
    let whole = counts.and_then(|counts| counts.largest_hole_mm).map(Mending::filling);
    let mut rows: Vec<_> = table::of("mending").collect();
    rows.sort_by_key(|setting| ORDER.iter().position(|key| *key == setting.key).unwrap_or(ORDER.len()));
    for setting in &rows {
        if let Kind::Limit { at, ref range, proposed } = setting.kind {
            let proposed = whole.filter(|_| setting.key == "fill-holes").unwrap_or(proposed);
            limit(ui, setting, range, proposed, at(settings));
        }
    }
    ui.horizontal_wrapped(|ui| {
        for setting in rows {
            control::setting(ui, setting, settings);
        }
    });
}

/// A length that is on or off; `proposed` when it is switched on.
fn limit(ui: &mut Ui, setting: &table::Setting, range: &table::Range, proposed: f64, value: &mut Option<f64>) {
    let (words, help) = (text(setting.messages.label), text(setting.messages.help));
    ui.horizontal(|ui| {
        let mut is_on = value.is_some();
        if ui.checkbox(&mut is_on, &words).on_hover_text(help).changed() {
            *value = is_on.then_some(proposed);
        }
        let mut shown = value.unwrap_or(proposed);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let field = reads_comma(DragValue::new(&mut shown), range.decimals == 0)
                .range(range.bounds.clone())
                .speed(proposed / 50.0)
                .max_decimals(range.decimals)
                .suffix(suffix(range))
                .update_while_editing(false);
            let response = ui.add_enabled(is_on, field).on_hover_text(say!("panel-type"));
            name(&response, Role::SpinButton, &say!("panel-value", name = &words));
            if response.changed() && is_on {
                *value = Some(shown);
            }
        });
    });
}

/// What was mended under the settings in force.
fn done(ui: &mut Ui, state: &State, document: &Document) {
    let report = document.measured.as_ref().map(|measured| &measured.report);
    let Some(report) = report.filter(|report| report.settings.mending == state.settings.mending) else { return };
    let Some(done) = &report.mending else { return };
    let parts = [
        (done.vertices_welded, say!("panel-mended-welded", count = done.vertices_welded)),
        (done.edges_split, say!("panel-mended-edges", count = done.edges_split)),
        (done.vertices_split, say!("panel-mended-vertices", count = done.vertices_split)),
        (done.duplicates_left_out, say!("panel-mended-double", count = done.duplicates_left_out)),
        (done.holes_filled, say!("panel-mended-holes", count = done.holes_filled)),
        (done.wall_triangles_left_out, say!("panel-mended-wall", count = done.wall_triangles_left_out)),
    ];
    let parts: Vec<String> = parts.into_iter().filter(|&(count, _)| count > 0).map(|(_, words)| words).collect();
    if !parts.is_empty() {
        remark(ui, &format!("{}.", parts.join(", ")));
    }
    for warning in report.mending_warnings() {
        remark(ui, &tell(&warning));
    }
}

/// Draws the faults of the kind that is shown over a view.
pub(super) fn marks(ui: &Ui, rect: Rect, camera: &Camera, document: &Document, shown: FaultShown) {
    const RADIUS: f32 = 4.0;
    let colour: Color32 = ui.visuals().error_fg_color;
    let painter = ui.painter_at(rect);
    let seen = |at: [f32; 3]| seen(at.into(), camera, rect);
    for place in of_kind(document, shown.kind) {
        let line: Option<Vec<egui::Pos2>> = place.line.iter().map(|&at| seen(at)).collect();
        match line {
            Some(line) if line.len() > 2 => {
                painter.add(Shape::closed_line(line, Stroke::new(2.0, colour)));
            }
            Some(line) if line.len() == 2 => {
                painter.line_segment([line[0], line[1]], Stroke::new(3.0, colour));
                painter.circle_filled(pos2((line[0].x + line[1].x) / 2.0, (line[0].y + line[1].y) / 2.0), 2.5, colour);
            }
            Some(_) => {
                if let Some(at) = seen(place.at_mm) {
                    painter.circle_filled(at, RADIUS, colour);
                }
            }
            None => {}
        }
    }
}
