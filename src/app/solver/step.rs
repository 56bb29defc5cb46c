//! The step's controls: what is done at the ends, how large triangles are, and what came of it.

use std::ops::RangeInclusive;

use egui::{Button, ComboBox, DragValue, Grid, RichText, Role, Sense, TextEdit, Ui, vec2};

use super::action::Action;
use super::cuts;
use super::preparation::{Made, Preparation, Shown, level};
use super::view::end_colour;
use crate::app::action::Action as Ask;
use crate::app::assist::name;
use crate::app::control::{Setting, reads_comma};
use crate::app::menus::menu;
use crate::app::row::{Fold, advanced, number, remark, row, warning, wrapped};
use crate::app::state::State;
use crate::language::{decimal, grouped, tell};
use crate::prepare::Patch;
use crate::prepare::cap::CapKind;
use crate::prepare::check::Finding;
use crate::prepare::cuts::ClipAt;
use crate::prepare::ends::Length;
use crate::prepare::prepare::Plan;
use crate::prepare::remesh::Sizing;
use crate::prepare::write::SolverFormat;
use crate::say;

/// The bound on the deviation that is begun with, in mm.
const BOUND_MM: f64 = 0.1;
/// The tolerance of a wrap that is begun with, in mm.
const TOLERANCE_MM: f64 = 0.5;
/// Width of a field for a name, in points.
const NAME: f32 = 96.0;
/// Times the radius of an end that is shown around a place.
const AROUND: f64 = 8.0;

/// Shows the step.
pub(super) fn show(ui: &mut Ui, state: &State, asked: &mut Vec<Ask>) {
    let preparation = &state.preparation;
    let mut plan = preparation.plan.clone();
    let mut of_step = Vec::new();
    let (title, what) = (say!("solver-title"), say!("solver-does"));
    let summary = preparation.made.as_ref().map(|made| readiness(made.ready.fate.is_ready()));
    let summary = RichText::new(summary.unwrap_or_default()).weak();
    Fold { number: 5, title: &title, what: &what, summary, is_open: false }.show(ui, |ui| {
        wrap(ui, &mut plan);
        ends(ui, &mut plan);
        triangles(ui, &title, &mut plan);
        buttons(ui, state, &mut of_step);
        if let (Some(planned), Some(Shown::Cuts)) = (&preparation.planned, preparation.shown) {
            cuts::list(ui, preparation, planned, asked);
        }
        if let Some(error) = &preparation.failure {
            warning(ui, &say!("solver-failed", why = tell(error)));
        }
        if let Some(made) = &preparation.made {
            let revision = state.document.as_ref().map(|document| document.revision);
            if made.plan != preparation.plan || revision.is_some_and(|revision| level(revision) != made.of) {
                remark(ui, &say!("solver-older"));
            }
            result(ui, preparation, made, asked, &mut of_step);
        }
    });
    if plan != preparation.plan {
        of_step.insert(0, Action::Set(plan));
    }
    asked.extend(of_step.into_iter().map(Ask::Solver));
}

/// Whether a wrap is taken in place of the surface, and how near to it.
fn wrap(ui: &mut Ui, plan: &mut Plan) {
    let (mut wraps, help) = (plan.wrap.is_some(), say!("solver-wrap-help"));
    ui.checkbox(&mut wraps, say!("solver-wrap")).on_hover_text(&help);
    if wraps != plan.wrap.is_some() {
        plan.wrap = wraps.then_some(TOLERANCE_MM);
    }
    if let Some(mm) = &mut plan.wrap {
        let (name, range, default) = (say!("solver-wrap-mm"), 0.05..=5.0, TOLERANCE_MM);
        let setting = Setting {
            name: &name,
            help: &help,
            unit: " mm",
            range,
            default,
            auto: None,
            decimals: 2,
            logarithmic: true,
        };
        setting.show(ui, mm);
    }
}

/// What is done where vessels end.
fn ends(ui: &mut Ui, plan: &mut Plan) {
    ui.checkbox(&mut plan.uncross, say!("solver-uncross")).on_hover_text(say!("solver-uncross-help"));
    let radii = match plan.clip {
        Some(ClipAt::Distance(Length::Radii(radii))) => radii,
        _ => 1.0,
    };
    let places = [None, Some(ClipAt::Round), Some(ClipAt::Distance(Length::Radii(radii)))];
    let called = |place: Option<ClipAt>| match place {
        None => say!("solver-clip-none"),
        Some(ClipAt::Round) => say!("solver-clip-round"),
        Some(ClipAt::Distance(_)) => say!("solver-clip-distance"),
    };
    choose(ui, "clip", &say!("solver-clip"), &say!("solver-clip-help"), &mut plan.clip, &places, called);
    if let Some(ClipAt::Distance(Length::Radii(radii))) = &mut plan.clip {
        in_radii(ui, &say!("solver-clip-by"), 0.1..=10.0, radii);
    }
    let mut extends = plan.extend.is_some();
    ui.checkbox(&mut extends, say!("solver-extend")).on_hover_text(say!("solver-extend-help"));
    if extends != plan.extend.is_some() {
        plan.extend = extends.then_some(Length::Radii(5.0));
    }
    if let Some(Length::Radii(radii)) = &mut plan.extend {
        in_radii(ui, &say!("solver-extend-by"), 0.5..=50.0, radii);
    }
    let kinds = [None, Some(CapKind::Planar), Some(CapKind::Fan), Some(CapKind::Smooth)];
    let called = |kind: Option<CapKind>| match kind {
        None => say!("solver-cap-none"),
        Some(CapKind::Planar) => say!("solver-cap-planar"),
        Some(CapKind::Fan) => say!("solver-cap-fan"),
        Some(CapKind::Smooth) => say!("solver-cap-smooth"),
    };
    choose(ui, "cap", &say!("solver-cap"), &say!("solver-cap-help"), &mut plan.cap, &kinds, called);
}

/// How large triangles are.
fn triangles(ui: &mut Ui, title: &str, plan: &mut Plan) {
    let mut remeshes = plan.remesh.is_some();
    ui.checkbox(&mut remeshes, say!("solver-remesh")).on_hover_text(say!("solver-remesh-help"));
    if remeshes != plan.remesh.is_some() {
        plan.remesh = remeshes.then(Sizing::default);
    }
    let Some(sizing) = &mut plan.remesh else { return };
    let default = Sizing::default();
    let set = |ui: &mut Ui, name: String, unit: &str, [least, most]: [f64; 2], default, decimals, value: &mut f64| {
        let help = say!("solver-remesh-help");
        let range = least..=most;
        let logarithmic = most > 100.0 * least;
        Setting { name: &name, help: &help, unit, range, default, auto: None, decimals, logarithmic }.show(ui, value);
    };
    set(ui, say!("solver-around"), "", [6.0, 48.0], default.around, 0, &mut sizing.around);
    advanced(ui, title, |ui| {
        set(ui, say!("solver-least"), " mm", [0.01, 2.0], default.least_mm, 2, &mut sizing.least_mm);
        set(ui, say!("solver-largest"), " mm", [0.1, 20.0], default.largest_mm, 1, &mut sizing.largest_mm);
        sizing.largest_mm = sizing.largest_mm.max(sizing.least_mm);
        let mut is_bound = sizing.max_deviation_mm.is_some();
        ui.checkbox(&mut is_bound, say!("solver-bound")).on_hover_text(say!("solver-bound-help"));
        let bound = sizing.max_deviation_mm.unwrap_or(BOUND_MM);
        sizing.max_deviation_mm = is_bound.then_some(bound);
        if let Some(mm) = &mut sizing.max_deviation_mm {
            set(ui, say!("solver-bound-mm"), " mm", [0.01, 2.0], BOUND_MM, 2, mm);
        }
    });
}

/// A list of a few choices.
fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    id: &str,
    label: &str,
    help: &str,
    chosen: &mut T,
    all: &[T],
    called: impl Fn(T) -> String,
) {
    row(ui, label, help, |ui| {
        let list = ComboBox::from_id_salt(id).width(128.0).selected_text(called(*chosen));
        let response = list.show_ui(ui, |ui| {
            for &choice in all {
                ui.selectable_value(chosen, choice, called(choice));
            }
        });
        name(&response.response, Role::ComboBox, label);
    });
}

/// A number of radii.
fn in_radii(ui: &mut Ui, label: &str, range: RangeInclusive<f64>, radii: &mut f64) {
    row(ui, label, &say!("solver-radii-help"), |ui| {
        let field = DragValue::new(radii).range(range).speed(0.05).max_decimals(1).suffix(say!("solver-radii"));
        name(&ui.add(reads_comma(field, false)), Role::SpinButton, label);
    });
}

fn buttons(ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
    let Preparation { made, shown, .. } = &state.preparation;
    let has_level = state.document.as_ref().is_some_and(|document| document.shown.is_some());
    ui.horizontal_wrapped(|ui| {
        let can_prepare = has_level && !state.preparation.is_busy();
        let button = ui.add_enabled(can_prepare, Button::new(say!("solver-prepare")));
        if button.on_hover_text(say!("solver-prepare-help")).clicked() {
            asked.push(Action::Prepare);
        }
        let others = [
            (Shown::Made, made.is_some(), say!("solver-show-made"), ""),
            (Shown::Cuts, has_level, say!("solver-show-cuts"), &*say!("solver-show-cuts-help")),
        ];
        for (view, is_there, label, help) in others {
            let is_shown = *shown == Some(view);
            let label = if is_shown { say!("solver-show-level") } else { label };
            if is_there && ui.button(label).on_hover_text(help).clicked() {
                asked.push(Action::Show((!is_shown).then_some(view)));
            }
        }
    });
}

/// What came of it.
fn result(ui: &mut Ui, preparation: &Preparation, made: &Made, asked: &mut Vec<Ask>, of_step: &mut Vec<Action>) {
    let ready = &made.ready;
    ui.separator();
    let is_ready = ready.fate.is_ready();
    if is_ready {
        wrapped(ui, &readiness(true), RichText::strong);
    } else {
        warning(ui, &readiness(false));
    }
    for finding in &ready.fate.findings {
        of_fate(ui, finding, made, asked);
    }
    for note in &ready.notes {
        remark(ui, &tell(note));
    }
    if let Some([before, after]) = ready.crossing.filter(|[before, _]| *before > 0) {
        remark(ui, &say!("solver-crossed", before = before, after = after));
    }
    number(ui, &say!("solver-result-triangles"), &grouped(ready.mesh.triangles.len()), "");
    if let Some((quality, deviation)) = ready.remeshed {
        number(ui, &say!("solver-quality"), &decimal(quality.mean, 3), &say!("solver-quality-help"));
        let below = format!("{} %", decimal(100.0 * quality.below_30_deg, 2));
        number(ui, &say!("solver-below"), &below, &say!("solver-below-help"));
        let far = format!("{} mm", decimal(deviation.to_old_mm.max(deviation.to_new_mm), 3));
        number(ui, &say!("solver-deviation"), &far, &say!("solver-deviation-help"));
    }
    patches(ui, made, of_step);
    menu(ui, &say!("solver-save"), &mut |ui| {
        for format in SolverFormat::ALL {
            let zip = if format.is_folder() { " (ZIP)" } else { "" };
            if ui.button(format!("{}{zip}", format.name())).clicked() {
                of_step.push(Action::Save(format));
                ui.close();
            }
        }
    });
    if preparation.shown == Some(Shown::Made) {
        remark(ui, &say!("solver-names"));
    }
}

/// A finding of what a volume mesher minds, and the way to its places.
fn of_fate(ui: &mut Ui, finding: &Finding, made: &Made, asked: &mut Vec<Ask>) {
    let text = tell(&finding.fault);
    ui.horizontal_wrapped(|ui| if finding.fault.stops() { warning(ui, &text) } else { remark(ui, &text) });
    let Some(&at) = finding.places.first() else { return };
    let go = ui.small_button(say!("solver-go"));
    name(&go, Role::Button, &say!("solver-go-to", what = text.clone()));
    if go.clicked() {
        let radius = made.ready.patches.iter().skip(1).map(Patch::radius_mm).fold(f64::INFINITY, f64::min);
        let height_mm = if radius.is_finite() { (AROUND * radius) as f32 } else { 10.0 };
        asked.push(Ask::Solver(Action::Show(Some(Shown::Made))));
        asked.push(Ask::GoTo { at_mm: at.map(|x| x as f32), height_mm, label: text });
    }
}

/// The patches: colour, name, number, area and radius.
fn patches(ui: &mut Ui, made: &Made, asked: &mut Vec<Action>) {
    let grid = Grid::new("patches").num_columns(5).striped(true).spacing(vec2(8.0, 4.0)).min_col_width(8.0);
    grid.show(ui, |ui| {
        for head in ["", &say!("solver-name"), &say!("solver-id"), &say!("solver-area"), &say!("solver-radius")] {
            ui.label(RichText::new(head).small().weak());
        }
        ui.end_row();
        for (place, patch) in made.ready.patches.iter().enumerate() {
            let (swatch, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
            if place > 0 {
                ui.painter().rect_filled(swatch, 2.0, end_colour(place - 1));
            }
            let id = ui.scope_id().with(("name of a patch", made.id, place));
            let mut typed: String = ui.data(|data| data.get_temp(id)).unwrap_or_else(|| patch.name.clone());
            let size = vec2(NAME, ui.spacing().interact_size.y);
            let field = ui.add_sized(size, TextEdit::singleline(&mut typed).char_limit(60));
            name(&field, Role::TextInput, &say!("solver-name-of", name = patch.name.clone()));
            if field.lost_focus() {
                asked.push(Action::Rename(place, typed));
                ui.data_mut(|data| data.remove::<String>(id));
            } else if field.changed() {
                ui.data_mut(|data| data.insert_temp(id, typed));
            }
            ui.label(patch.id.to_string());
            ui.label(decimal(patch.area_mm2, if patch.area_mm2 < 100.0 { 2 } else { 0 }));
            ui.label(if place > 0 { decimal(patch.radius_mm(), 2) } else { String::new() });
            ui.end_row();
        }
    });
}

fn readiness(is_ready: bool) -> String {
    if is_ready { say!("solver-ready") } else { say!("solver-not-ready") }
}
