//! What is compared, how, and the numbers that came of it.

use egui::{Button, Grid, RichText, Role, Ui};

use super::action::Action;
use super::against::Found;
use crate::app::action::Action as Ask;
use crate::app::assist::{heading, name};
use crate::app::explain::explain;
use crate::app::icon::{self, Icon};
use crate::app::row::{number, remark, row, warning, wrapped};
use crate::app::state::State;
use crate::io::Unit;
use crate::language::{decimal, grouped, signed, tell};
use crate::pipeline::beside::{Align, BesideReport, Branch, Calibre, Farthest, Fit, Moved};
use crate::say;
use crate::vessel::BranchName;
use crate::vessel::certificate::Verdict;

/// What is seen where the surfaces are farthest apart: times the distance, and in mm at least.
const SEEN: f64 = 20.0;
const LEAST_MM: f32 = 10.0;

/// What is compared, and how.
pub(super) fn head(ui: &mut Ui, state: &State, asked: &mut Vec<Ask>) {
    let against = &state.against;
    let mut ask = |action: Action| asked.push(Ask::Reference(action));
    ui.horizontal(|ui| {
        heading(ui, &say!("reference-heading"));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if icon::button(ui, Icon::Close, true, &say!("app-close"), &say!("reference-close-help")).clicked() {
                ask(Action::Show(false));
            }
        });
    });
    row(ui, &say!("reference-reference"), &say!("reference-reference-help"), |ui| {
        if ui.button(say!("reference-other")).on_hover_text(say!("reference-other-help")).clicked() {
            ask(Action::Choose);
        }
        let named = against.source.as_ref().map_or_else(Default::default, |source| source.label());
        ui.add(egui::Label::new(RichText::new(named).strong()).truncate());
    });
    if let Some(now) = against.answer().and_then(Result::ok).and_then(|found| found.two.unit) {
        ui.horizontal_wrapped(|ui| {
            explain(ui.label(say!("reference-unit")), &say!("reference-unit-help"));
            for unit in Unit::ALL {
                choice(ui, unit == now, unit.symbol(), "", &mut || ask(Action::Unit(unit)));
            }
        });
    }
    ui.horizontal_wrapped(|ui| {
        explain(ui.label(say!("reference-surface")), &say!("reference-surface-help"));
        for of_level in [false, true] {
            let label = if of_level { say!("reference-level") } else { say!("reference-opened") };
            choice(ui, against.of_level == of_level, &label, "", &mut || ask(Action::OfLevel(of_level)));
        }
    });
    ui.horizontal_wrapped(|ui| {
        explain(ui.label(say!("reference-move")), &say!("reference-move-help"));
        for align in Align::ALL {
            let (label, help) = match align {
                Align::Still => (say!("reference-still"), say!("reference-still-help")),
                Align::Axes => (say!("reference-axes"), say!("reference-axes-help")),
                Align::Rigid => (say!("reference-rigid"), say!("reference-rigid-help")),
            };
            choice(ui, against.align == align, &label, &help, &mut || ask(Action::Align(align)));
        }
    });
}

fn choice(ui: &mut Ui, is_chosen: bool, label: &str, help: &str, choose: &mut dyn FnMut()) {
    let response = ui.selectable_label(is_chosen, label);
    name(&response, Role::RadioButton, label);
    let response = if help.is_empty() { response } else { response.on_hover_text(help.to_owned()) };
    if response.clicked() {
        choose();
    }
}

/// What came of it.
pub(super) fn numbers(ui: &mut Ui, state: &State, asked: &mut Vec<Ask>) {
    let against = &state.against;
    if let Some(why) = against.stopped() {
        wrapped(ui, why, |text| text);
        if ui.button(say!("reference-again")).clicked() {
            asked.push(Ask::Reference(Action::Again));
        }
        return;
    }
    let found = match against.answer() {
        _ if against.is_busy() => return remark(ui, &say!("reference-coming")),
        None if against.of_level && state.document.as_ref().is_none_or(|document| document.shown.is_none()) => {
            return remark(ui, &say!("reference-no-level"));
        }
        None => return remark(ui, &say!("reference-coming")),
        Some(Err(why)) => return warning(ui, &say!("reference-failed", why = why)),
        Some(Ok(found)) => found,
    };
    let report = &found.two.report;
    moved(ui, found, asked);
    sizes(ui, report);
    ui.separator();
    distances(ui, report, asked);
    let mut is_signed = !against.is_plain;
    let signed = ui.checkbox(&mut is_signed, say!("panel-signed")).on_hover_text(say!("reference-signed-help"));
    if signed.changed() {
        asked.push(Ask::Reference(Action::Plain(!is_signed)));
    }
    ui.separator();
    vessels(ui, found, asked);
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        let save = ui.button(say!("reference-save-numbers")).on_hover_text(say!("reference-save-numbers-help"));
        if save.clicked() {
            asked.push(Ask::Reference(Action::SaveNumbers));
        }
        let save = ui.add_enabled(found.two.csv.is_some(), Button::new(say!("reference-save-stations")));
        if save.on_hover_text(say!("reference-save-stations-help")).clicked() {
            asked.push(Ask::Reference(Action::SaveStations));
        }
    });
    for note in &found.two.warnings {
        remark(ui, &say!("reference-note", note = tell(note)));
    }
}

/// How the surface was moved, and whether it should be.
fn moved(ui: &mut Ui, found: &Found, asked: &mut Vec<Ask>) {
    let report = &found.two.report;
    if let Some(Moved { mean_shift_mm, turned_deg, fit, .. }) = report.moved {
        let told = say!("reference-moved", mm = decimal(mean_shift_mm, 2), degrees = decimal(turned_deg, 2));
        remark(ui, &told);
        if let Some(Fit { before_mm, residual_mm }) = fit {
            remark(ui, &say!("reference-fit", mm = decimal(residual_mm, 3), before = decimal(before_mm, 3)));
        }
    }
    if found.two.axes_differ {
        warning(ui, &say!("reference-axes-differ"));
        if ui.button(say!("reference-turn")).clicked() {
            asked.push(Ask::Reference(Action::Align(Align::Axes)));
        }
    }
    if found.two.lie_apart {
        warning(ui, &say!("reference-apart", mm = decimal(report.deviation_mm.mean, 1)));
        let is_fitted = report.moved.is_some_and(|moved| moved.fit.is_some());
        if !is_fitted && ui.button(say!("reference-bring-together")).clicked() {
            asked.push(Ask::Reference(Action::Align(Align::Rigid)));
        }
    }
}

/// How large both are.
fn sizes(ui: &mut Ui, BesideReport { reference, surface, .. }: &BesideReport) {
    let count = |from: usize, to: usize| [grouped(from), grouped(to), change(from as f64, to as f64)];
    let size = |from: Option<f64>, to: Option<f64>, unit: &str| {
        let shown = |value: Option<f64>| {
            value.map_or("–".to_owned(), |value| format!("{} {unit}", grouped(format!("{value:.0}"))))
        };
        let change = from.zip(to).map_or("–".to_owned(), |(from, to)| change(from, to));
        [shown(from), shown(to), change]
    };
    let rows = [
        (say!("reference-triangles"), count(reference.triangles, surface.triangles)),
        (say!("reference-area"), size(Some(reference.area_mm2), Some(surface.area_mm2), "mm²")),
        (say!("reference-volume"), size(reference.volume_mm3, surface.volume_mm3, "mm³")),
    ];
    Grid::new("sizes").num_columns(4).spacing([12.0, 2.0]).show(ui, |ui| {
        let heads =
            [String::new(), say!("reference-column-reference"), say!("reference-column-surface"), String::new()];
        for head in heads {
            ui.label(RichText::new(head).small().strong());
        }
        ui.end_row();
        for (what, cells) in rows {
            ui.label(RichText::new(what).weak());
            for cell in cells {
                ui.label(cell);
            }
            ui.end_row();
        }
    });
}

/// How far apart they are.
fn distances(ui: &mut Ui, report: &BesideReport, asked: &mut Vec<Ask>) {
    let BesideReport { deviation_mm, reference_farthest, surface_farthest, .. } = report;
    let mm = |value: f64| format!("{} mm", decimal(value, 3));
    let help = say!("reference-distance-help");
    number(ui, &say!("reference-mean"), &mm(deviation_mm.mean), &help);
    number(ui, &say!("reference-rms"), &mm(deviation_mm.rms), &help);
    number(ui, &say!("reference-p95"), &mm(deviation_mm.p95), &help);
    let both = [
        (say!("reference-farthest-reference"), reference_farthest),
        (say!("reference-farthest-surface"), surface_farthest),
    ];
    for (what, &Farthest { mm: distance, at_mm, at_most_mm, .. }) in both {
        // Rounded up, or it would not be so.
        let most = decimal((at_most_mm * 1e3).ceil() / 1e3, 3);
        row(ui, &what, &say!("reference-farthest-help", most = most), |ui| {
            let go = ui.button(say!("reference-go"));
            name(&go, Role::Button, &say!("reference-go-long", what = what.as_str()));
            if go.clicked() {
                let height_mm = ((SEEN * distance) as f32).max(LEAST_MM);
                asked.push(Ask::GoTo { at_mm, height_mm, label: mm(distance) });
            }
            ui.label(mm(distance));
        });
    }
}

/// What became of the vessels.
fn vessels(ui: &mut Ui, found: &Found, asked: &mut Vec<Ask>) {
    let Calibre { tolerance_percent, measured_percent, branches, verdict, .. } = &found.two.report.calibre;
    if let Some(refused) = &found.two.refused {
        return remark(ui, &say!("reference-no-vessels", why = tell(refused)));
    }
    let measured = decimal(measured_percent.unwrap_or(0.0).floor(), 0);
    let changed = branches.iter().filter(|branch| branch.verdict == Verdict::Changed).count();
    let tolerance = *tolerance_percent;
    let told = match verdict {
        Some(Verdict::Changed) => {
            say!("reference-changed", changed = changed, all = branches.len(), tolerance = tolerance)
        }
        Some(Verdict::Kept) => say!("reference-kept", tolerance = tolerance),
        Some(Verdict::NotMeasured) | None => say!("reference-not-measured"),
    };
    let told = format!("{told} {}", say!("reference-measured", percent = measured));
    let colour = ui.visuals().error_fg_color;
    wrapped(ui, &told, |text| if changed > 0 { text.color(colour) } else { text });
    Grid::new("branches").num_columns(5).striped(true).spacing([10.0, 2.0]).show(ui, |ui| {
        let heads = [
            (say!("reference-column-vessel"), say!("reference-column-vessel-help")),
            (say!("reference-column-reference"), say!("reference-column-radius-help")),
            (say!("reference-column-surface"), say!("reference-column-radius-help")),
            (say!("reference-column-change"), say!("reference-column-change-help")),
            (say!("reference-column-verdict"), String::new()),
        ];
        for (head, help) in heads {
            let head = ui.label(RichText::new(head).small().strong());
            if !help.is_empty() {
                explain(head, &help);
            }
        }
        ui.end_row();
        for branch in branches {
            vessel(ui, branch, asked);
            ui.end_row();
        }
    });
}

fn vessel(ui: &mut Ui, branch: &Branch, asked: &mut Vec<Ask>) {
    let named = tell(&BranchName::Numbered { number: branch.number });
    let radius = |value: Option<f64>| value.map_or("–".to_owned(), |value| decimal(value, 2));
    let change = branch.largest_change_percent.map(|percent| format!("{} %", signed(percent, 1)));
    let place = branch.largest_change_at_mm.zip(change.clone());
    let button = ui.add_enabled(place.is_some(), Button::selectable(false, &named));
    name(&button, Role::Button, &named);
    if let Some((at_mm, change)) = place.filter(|_| button.clicked()) {
        let around = branch.mean_radius_reference_mm.map_or(LEAST_MM, |radius| 16.0 * radius as f32);
        asked.push(Ask::GoTo { at_mm, height_mm: around, label: format!("{named}: {change}") });
    }
    ui.label(radius(branch.mean_radius_reference_mm));
    ui.label(radius(branch.mean_radius_surface_mm));
    ui.label(change.unwrap_or_else(|| "–".to_owned()));
    let verdict = RichText::new(tell(&branch.verdict));
    let colour = ui.visuals().error_fg_color;
    ui.label(match branch.verdict {
        Verdict::Changed => verdict.color(colour),
        Verdict::NotMeasured => verdict.weak(),
        Verdict::Kept => verdict,
    });
}

fn change(from: f64, to: f64) -> String {
    if from == 0.0 { "–".to_owned() } else { format!("{} %", signed(100.0 * (to / from - 1.0), 1)) }
}
