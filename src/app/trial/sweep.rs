//! What reduction does to the wire, rate by rate: a table, and the deviation of the tip beside its noise as a plot.

use egui::{RichText, Role, ScrollArea, Ui};
use egui_plot::{AxisHints, GridMark, LineStyle, Plot, PlotPoints};

use super::marks;
use super::tables::{Outcome, Row};
use super::tables_window::{grid, tabbed};
use crate::app::assist::name;
use crate::app::plot_file::Drawn;
use crate::app::still_plot::{curve, marks as grid_marks, still, tick};
use crate::language::{Key, decimal};
use crate::say;
use crate::trial::sweep::{Spread, SweepRow};

/// Heads of the columns, and what they say.
const COLUMNS: [(Key, Key); 6] = [
    (Key("trial-column-rate"), Key("trial-column-rate-help")),
    (Key("trial-column-arrive"), Key("trial-column-arrive-help")),
    (Key("trial-column-deviation"), Key("trial-column-deviation-help")),
    (Key("trial-column-noise"), Key("trial-noise-help")),
    (Key("trial-column-peak-force"), Key("trial-column-peak-force-help")),
    (Key("trial-column-mean-force"), Key("trial-column-mean-force-help")),
];

/// The plot's height and its least width, in points.
const PLOT: [f32; 2] = [170.0, 260.0];
/// From this width on the plot stands beside the table, in points.
const BESIDE: f32 = 760.0;

/// Shows what is known of the sweep, if one was asked for.
pub(super) fn show(ui: &mut Ui, rows: &[Row]) {
    if rows.iter().all(|row| row.sweep.is_none()) {
        return;
    }
    ui.separator();
    ui.label(RichText::new(say!("trial-sweep-what")).weak());
    if ui.available_width() < BESIDE {
        ScrollArea::horizontal().id_salt("sweep").show(ui, |ui| table(ui, rows));
        plot(ui, rows);
    } else {
        ui.horizontal(|ui| {
            ui.vertical(|ui| table(ui, rows));
            ui.vertical(|ui| plot(ui, rows));
        });
    }
    for row in rows {
        if let Some(Outcome::Failed(why)) = &row.sweep {
            ui.label(RichText::new(say!("trial-tables-failed", rate = row.rate, why = why)).small());
        }
    }
}

fn table(ui: &mut Ui, rows: &[Row]) {
    grid(ui, "sweep", &COLUMNS, rows.iter().map(cells));
}

/// The table as text; nothing where there is none.
pub(super) fn text(rows: &[Row]) -> String {
    if rows.iter().all(|row| row.sweep.is_none()) {
        return String::new();
    }
    format!("\n{}", tabbed(&COLUMNS, rows.iter().map(cells)))
}

fn cells(row: &Row) -> [String; COLUMNS.len()] {
    let mut cells: [String; COLUMNS.len()] = std::array::from_fn(|_| "–".to_owned());
    cells[0] = format!("{} %", row.rate);
    let Some(Outcome::Done(swept)) = &row.sweep else { return cells };
    let told = |spread: Option<Spread>, decimals: usize| {
        let of = |it: Spread| [it.median, it.largest].map(|value| decimal(value, decimals));
        spread.map(of).map_or("–".to_owned(), |[first, mean]| say!("trial-tables-two", first = first, mean = mean))
    };
    cells[1] = say!("trial-sweep-arrived", arrived = swept.arrived, seeds = swept.seeds);
    cells[2] = told(swept.deviation_mm, 2);
    cells[3] = told(swept.noise_mm, 2);
    cells[4] = told(swept.peak_force_n, 3);
    cells[5] = told(swept.mean_force_n, 3);
    cells
}

fn plot(ui: &mut Ui, rows: &[Row]) {
    // The rates stand at equal distances.
    let rates: Vec<u32> = rows.iter().map(|row| row.rate).collect();
    let points = |value: fn(&SweepRow) -> Option<f64>| -> PlotPoints<'static> {
        let swept = |(i, row): (usize, &Row)| match &row.sweep {
            Some(Outcome::Done(swept)) => Some([i as f64, value(swept)?]),
            _ => None,
        };
        rows.iter().enumerate().filter_map(swept).collect()
    };
    let highest = rows.iter().filter_map(|row| match &row.sweep {
        Some(Outcome::Done(swept)) => Some(swept.deviation_mm?.largest.max(swept.noise_mm?.largest)),
        _ => None,
    });
    let highest = highest.fold(0.1, f64::max);
    let [colour, grey] = [marks::colours(ui.visuals().dark_mode)[0], ui.visuals().weak_text_color()];
    let mark = |i: usize| GridMark { value: i as f64, step_size: 1.0 };
    let count = rates.len();
    let x_axis = AxisHints::new_x()
        .label(RichText::new(say!("trial-column-rate")).small())
        .label_spacing(egui::Rangef::new(8.0, 16.0))
        .formatter(move |mark, _| rates.get(mark.value as usize).map_or(String::new(), |rate| format!("{rate} %")));
    let plot = still(Plot::new("sweep"))
        .height(PLOT[0])
        .width(ui.available_width().clamp(PLOT[1], 1.5 * PLOT[1]))
        .include_x(-0.2)
        .include_x(count as f64 - 0.8)
        .include_y(0.0)
        .include_y(1.1 * highest)
        .y_grid_spacer(move |_| grid_marks((0.0, 1.1 * highest), 4))
        .x_grid_spacer(move |_| (0..count).map(mark).collect())
        .custom_x_axes(vec![x_axis])
        .y_axis_formatter(tick);
    let [noise, middle, deviation] =
        [say!("trial-sweep-noise"), say!("trial-sweep-median"), say!("trial-sweep-largest")];
    let legend = [(deviation.as_str(), colour), (&middle, colour), (&noise, grey)];
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        for (name, colour) in legend {
            ui.label(RichText::new(name).small().color(colour));
        }
    });
    let shown = ui.scope(|ui| {
        plot.show(ui, |plot| {
            plot.line(curve(&noise, points(|swept| Some(swept.noise_mm?.largest))).color(grey).width(1.0));
            let median = curve(&middle, points(|swept| Some(swept.deviation_mm?.median))).color(colour).width(1.0);
            plot.line(median.style(LineStyle::dashed_dense()));
            plot.line(curve(&deviation, points(|swept| Some(swept.deviation_mm?.largest))).color(colour).width(1.5));
        })
    });
    let title = say!("trial-sweep-plot");
    let (frame, whole) = (shown.inner.response.rect, shown.response.rect);
    name(&shown.inner.response, Role::Image, &title);
    Drawn { stem: "sweep", title: &title, legend: &legend, whole, frame }.offer(ui);
}
