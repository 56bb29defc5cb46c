//! The vessels below the views: what became of all of them, a row each, and the radius along the one that is chosen.

use egui::{Button, DragValue, Grid, RichText, Role, ScrollArea, Ui};

use super::words::{COLUMNS, cells, text, uneven_in_short, why_not_measured};
use super::{Action as Asked, Vessels, plot};
use crate::app::action::Action;
use crate::app::assist::{describe, heading, name};
use crate::app::control::reads_comma;
use crate::app::document::Document;
use crate::app::explain::explain;
use crate::app::mode::Now;
use crate::app::options::{Colours, ViewOptions};
use crate::app::row::wrapped;
use crate::app::state::State;
use crate::app::theme;
use crate::language::{decimal, tell};
use crate::pipeline::settings::Settings;
use crate::say;
use crate::vessel::certificate::{BranchCalibre, Certificate, Change, Verdict};
use crate::vessel::summary::{in_order, place, summary};

/// Height of what is seen at a place that is gone to, in radii of the vessel there.
const SEEN: f32 = 16.0;
/// What is seen around a narrowing, in its distance from what is farthest of it: twice that, and some room.
const AROUND: f32 = 2.5;
/// Height of the plot and its words on a phone, in points.
const PHONE: f32 = 180.0;
/// What the plot takes of the width, where it stands beside the table, and at least where that is wide.
const PLOT: f32 = 0.42;
const LEAST_PLOT: f32 = 0.24;

/// Shows the vessels, with the branch that is chosen; on a phone the plot stands below the table.
pub(super) fn show(ui: &mut Ui, shown: Vessels, now: Now<'_>, asked: &mut Vec<Action>) {
    let Vessels { selected, scrolls, reference_mm } = shown;
    let Now { state, options, is_narrow, .. } = now;
    ui.spacing_mut().item_spacing.y = 4.0;
    head(ui, state, options, is_narrow, asked);
    // What was known last stands until there is something newer.
    let known = state.document.as_ref().and_then(|document| document.calibre.as_ref());
    let Some(calibre) = known else {
        ui.label(RichText::new(say!("vessels-coming")).weak());
        return;
    };
    let is_current = state.calibre().is_some();
    let told = tell(&summary(&calibre.found));
    let told = if is_current { told } else { format!("{told} {}", say!("vessels-newer")) };
    let is_changed = matches!(&calibre.found, Ok(found) if found.verdict == Verdict::Changed);
    let colour = ui.visuals().error_fg_color;
    wrapped(ui, &told, |told| if is_changed && is_current { told.color(colour) } else { told });
    let Ok(found) = &calibre.found else { return };
    let rows = in_order(found);
    let chosen = rows.iter().find(|branch| Some(branch.number) == selected).or(rows.first());
    let Some(&branch) = chosen else { return };
    if is_narrow {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ScrollArea::horizontal().show(ui, |ui| table(ui, &rows, (branch, scrolls), state, asked));
            ui.allocate_ui(egui::vec2(ui.available_width(), PHONE), |ui| {
                radius(ui, branch, (found, reference_mm), PHONE, asked);
            });
        });
        return;
    }
    let (room, height) = (ui.available_width(), ui.available_height());
    // As wide as it was in the frame before.
    let id = ui.scope_id().with("width of the table");
    let wanted = ui.data(|data| data.get_temp(id)).unwrap_or(0.0_f32);
    let width = wanted.clamp(room * (1.0 - PLOT), room * (1.0 - LEAST_PLOT));
    ui.horizontal_top(|ui| {
        ui.allocate_ui(egui::vec2(width, height), |ui| {
            let area = ScrollArea::both().auto_shrink(false);
            let shown = area
                .show(ui, |ui| ui.scope(|ui| table(ui, &rows, (branch, scrolls), state, asked)).response.rect.width());
            let wide = shown.inner + ui.spacing().scroll.allocated_width();
            if (wide - wanted).abs() > 0.5 {
                ui.data_mut(|data| data.insert_temp(id, wide));
                ui.ctx().request_repaint();
            }
        });
        let column = ScrollArea::vertical().id_salt("radius").max_height(height);
        ui.vertical(|ui| column.show(ui, |ui| radius(ui, branch, (found, reference_mm), height, asked)));
    });
}

fn head(ui: &mut Ui, state: &State, options: ViewOptions, is_narrow: bool, asked: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        heading(ui, &say!("vessels-heading"));
        ui.add_space(8.0);
        let mut tolerance = state.settings.tolerance_percent;
        let allowed = say!("vessels-allowed");
        explain(ui.label(&allowed), &say!("vessels-allowed-help"));
        let field = DragValue::new(&mut tolerance).range(0.0..=100.0).speed(0.05).max_decimals(1).suffix(" %");
        let field = reads_comma(field, false).update_while_editing(false);
        let field = ui.add(field).on_hover_text(say!("panel-type"));
        describe(&field, Role::SpinButton, &allowed, tolerance);
        let tolerance_percent = (tolerance * 10.0).round() / 10.0;
        if tolerance_percent.to_bits() != state.settings.tolerance_percent.to_bits() && field.changed() {
            asked.push(Action::Set(Box::new(Settings { tolerance_percent, ..state.settings.clone() })));
        }
        let mut is_coloured = options.colours == Colours::Calibre;
        let colour = ui.checkbox(&mut is_coloured, say!("vessels-colour"));
        if colour.on_hover_text(say!("vessels-colour-help")).changed() {
            let colours = options.colours.toggled(Colours::Calibre);
            asked.push(Action::Show(ViewOptions { colours, ..options }));
        }
        let calibre = state.calibre();
        let found = calibre.and_then(|calibre| calibre.found.as_ref().ok());
        let copy = ui.add_enabled(found.is_some(), Button::new(say!("vessels-copy")));
        if let (Some(found), true) = (found, copy.on_hover_text(say!("vessels-copy-help")).clicked()) {
            let of = state.document.as_ref().map_or_else(Default::default, Document::title);
            ui.ctx().copy_text(text(&of, found, state.safe()));
        }
        let save = ui.add_enabled(found.is_some(), Button::new(say!("vessels-save")));
        if save.on_hover_text(say!("vessels-save-help")).clicked() {
            asked.push(Action::Vessels(Asked::SaveTable));
        }
        let close = if is_narrow { say!("vessels-back") } else { say!("vessels-close") };
        if ui.button(close).on_hover_text("V, Esc".to_owned()).clicked() {
            asked.push(Action::Vessels(Asked::Toggle));
        }
    });
}

fn table(
    ui: &mut Ui,
    rows: &[&BranchCalibre],
    (chosen, scrolls): (&BranchCalibre, bool),
    state: &State,
    asked: &mut Vec<Action>,
) {
    let safe = state.safe();
    ui.spacing_mut().interact_size.y = theme::row(ui.ctx(), 18.0);
    ui.spacing_mut().button_padding.y = 1.0;
    Grid::new("vessels").num_columns(COLUMNS.len()).striped(true).spacing([8.0, 2.0]).show(ui, |ui| {
        for (head, help) in COLUMNS {
            explain(ui.label(RichText::new(head.say()).small().strong()), &help.say());
        }
        ui.end_row();
        for &branch in rows {
            for (column, cell) in cells(branch, safe).into_iter().enumerate() {
                if column > 0 {
                    // The whole of it stands beside the table, above the plot.
                    let is_uneven = column == COLUMNS.len() - 1;
                    let short = uneven_in_short(branch).filter(|_| is_uneven);
                    let whole = cell.clone();
                    let cell = RichText::new(short.clone().unwrap_or(cell));
                    let label = ui.label(match branch.verdict {
                        Verdict::Changed if column == 1 => cell.color(ui.visuals().error_fg_color),
                        Verdict::NotMeasured => cell.weak(),
                        _ => cell,
                    });
                    if let Some(why) = why_not_measured(branch).filter(|_| column == 1) {
                        explain(label, &why.say());
                    } else if short.is_some() {
                        explain(label, &whole);
                    }
                    continue;
                }
                let label = ui.selectable_label(branch.number == chosen.number, &cell);
                name(&label, Role::Button, &cell);
                if scrolls && branch.number == chosen.number {
                    label.scroll_to_me(Some(egui::Align::Center));
                }
                if label.clicked() {
                    asked.push(Action::Vessels(Asked::Select(branch.number)));
                    // What reduction has changed comes first, then what the vessel has by itself.
                    let narrowing = narrowing(branch);
                    match branch.reduced.largest_change {
                        Some(change) if branch.verdict == Verdict::Changed => asked.push(go_to(branch, &change)),
                        _ if !narrowing.is_empty() => asked.extend(narrowing),
                        Some(change) => asked.push(go_to(branch, &change)),
                        None => asked.extend(go_to_station(branch, branch.at_mm.len() / 2)),
                    }
                }
            }
            ui.end_row();
        }
    });
}

/// Shows the radius along a branch in a column of this height, or a higher one where its words leave the plot too little.
fn radius(
    ui: &mut Ui,
    branch: &BranchCalibre,
    (found, reference_mm): (&Certificate, Option<f64>),
    height: f32,
    asked: &mut Vec<Action>,
) {
    let top = ui.cursor().top();
    for stretch in branch.uneven().into_iter().flatten() {
        let told = say!("vessels-uneven", stretch = tell(&stretch.text()), reference = tell(&stretch.reference()));
        ui.add(egui::Label::new(RichText::new(told).small()).wrap());
    }
    let mut wanted = reference(ui, branch, reference_mm);
    match plot::show(ui, branch, found.tolerance_percent, (reference_mm, top + height)) {
        Some(plot::Asked::Station(i)) => asked.extend(go_to_station(branch, i)),
        Some(plot::Asked::Reference(at_mm)) => wanted = Some(at_mm),
        None => {}
    }
    if wanted != reference_mm {
        asked.push(Action::Vessels(Asked::Refer(wanted)));
        let found = wanted.and_then(|at_mm| branch.narrowest_beside(at_mm));
        let place = found.and_then(|found| Some((plot::nearest(branch, found.sides[0]?.abscissa_mm)?, found)));
        asked.extend(place.map(|(i, found)| {
            let label = say!("vessels-refers-here", diameter = decimal(found.reference_mm, 2));
            Action::Mark { at_mm: branch.at_mm[i], label }
        }));
    }
}

/// The reference of the narrowest place, where it is chosen by hand, and what that makes of it. Returns what is wanted.
fn reference(ui: &mut Ui, branch: &BranchCalibre, reference_mm: Option<f64>) -> Option<f64> {
    let mut wanted = reference_mm;
    ui.horizontal(|ui| {
        let mut is_chosen = reference_mm.is_some();
        let chosen = ui.checkbox(&mut is_chosen, say!("vessels-refer"));
        if chosen.on_hover_text(say!("vessels-refer-help")).changed() {
            let side = branch.uneven()[0].and_then(|found| found.sides.into_iter().flatten().next());
            wanted = is_chosen.then(|| side.map_or(branch.length_mm / 4.0, |side| side.abscissa_mm));
        }
        if let Some(mut at_mm) = reference_mm {
            let field = DragValue::new(&mut at_mm).range(0.0..=branch.length_mm).max_decimals(1).suffix(" mm");
            let field = ui.add(reads_comma(field.speed(branch.length_mm / 200.0), false));
            describe(&field, Role::SpinButton, &say!("vessels-refer-at"), at_mm);
            if field.on_hover_text(say!("vessels-refer-at-help")).changed() {
                wanted = Some(at_mm);
            }
        }
    });
    if let Some(found) = reference_mm.and_then(|at_mm| branch.narrowest_beside(at_mm)) {
        let told = say!("vessels-uneven", stretch = tell(&found.text()), reference = tell(&found.reference()));
        let told = match found.reduced_degree_percent {
            Some(percent) => format!("{told}. {}", say!("vessels-refer-reduced", percent = decimal(percent, 0))),
            None => told,
        };
        wrapped(ui, &told, RichText::small);
    }
    wanted
}

/// A look at the narrowing of a branch, so that all of it and the places that it is measured by are in view, and marks on them;
/// nothing where there is none.
pub(super) fn narrowing(branch: &BranchCalibre) -> Vec<Action> {
    let [Some(found), _] = branch.uneven() else { return Vec::new() };
    let at = glam::Vec3::from(found.at_mm);
    let sides = found.sides.iter().flatten().filter_map(|side| {
        let place = branch.at_mm[plot::nearest(branch, side.abscissa_mm)?];
        Some((place, say!("vessels-refers-here", diameter = decimal(side.diameter_mm, 2))))
    });
    let beside: Vec<([f32; 3], String)> = sides.collect();
    let is_in = |at: &f32| (found.from_mm..=found.to_mm).contains(&f64::from(*at));
    let stations = branch.abscissas_mm.iter().zip(&branch.at_mm).filter(|(at, _)| is_in(at));
    let along_mm: Vec<[f32; 3]> = stations.map(|(_, place)| *place).collect();
    let places = beside.iter().map(|(place, _)| place).chain(&along_mm);
    let farthest = places.map(|place| at.distance(glam::Vec3::from(*place))).fold(0.0, f32::max);
    let height_mm = height(branch, found.abscissa_mm).max(AROUND * farthest);
    vec![
        Action::GoTo { at_mm: found.at_mm, height_mm, label: tell(&found.text()) },
        Action::MarkStretch { along_mm, beside },
    ]
}

/// A look at station `i` of a branch, if there is such a station.
pub(super) fn go_to_station(branch: &BranchCalibre, i: usize) -> Option<Action> {
    let (at_mm, abscissa_mm) = (*branch.at_mm.get(i)?, f64::from(branch.abscissas_mm[i]));
    let percent = branch.reduced.changes_percent.get(i).copied().flatten().map(f64::from);
    Some(match percent {
        Some(percent) => go_to(branch, &Change { percent, at_mm, abscissa_mm }),
        None => Action::GoTo {
            at_mm,
            height_mm: height(branch, abscissa_mm),
            label: say!("vessels-not-here", name = tell(&branch.label())),
        },
    })
}

/// A look at the place of a change.
fn go_to(branch: &BranchCalibre, change: &Change) -> Action {
    let label = tell(&place(branch, change));
    Action::GoTo { at_mm: change.at_mm, height_mm: height(branch, change.abscissa_mm), label }
}

/// What is to be seen around a place of a branch, in mm.
fn height(branch: &BranchCalibre, abscissa_mm: f64) -> f32 {
    let i = branch.abscissas_mm.partition_point(|&at| f64::from(at) < abscissa_mm);
    let radius = branch.opened.inscribed_radii_mm.get(i).copied().flatten();
    SEEN * radius.unwrap_or(1.0).max(0.1)
}
