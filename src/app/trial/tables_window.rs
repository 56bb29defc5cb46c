//! The paper's tables in a window of their own, the paper's figures beside ours.
//!
//! Frames a second are 1 / (time to compute 1/60 s of simulated time + time to draw one frame of 1280x800); both parts
//! are shown.

use egui::{Align, Button, Grid, Layout, RichText, ScrollArea, Ui};

use super::action::Action;
use super::sweep;
use super::tables::{Outcome, Row, SEEDS, Tables};
use crate::app::control::progress;
use crate::app::explain::explain;
use crate::app::theme;
use crate::language::{Key, decimal, grouped};
use crate::phantom::Sample;
use crate::pipeline::paper::{TABLE_III, TABLE_IV, TrialRow};
use crate::say;

/// Heads of the columns, and what they say.
const COLUMNS: [(Key, Key); 13] = [
    (Key("trial-column-rate"), Key("trial-column-rate-help")),
    (Key("trial-column-triangles"), Key("trial-column-triangles-help")),
    (Key("trial-column-initial-fps"), Key("trial-column-initial-fps-help")),
    (Key("trial-column-average-fps"), Key("trial-column-average-fps-help")),
    (Key("trial-column-worst-fps"), Key("trial-column-worst-fps-help")),
    (Key("trial-column-simulation"), Key("trial-column-simulation-help")),
    (Key("trial-column-drawing"), Key("trial-column-drawing-help")),
    (Key("trial-column-steps"), Key("trial-column-steps-help")),
    (Key("trial-column-success"), Key("trial-column-success-help")),
    (Key("trial-column-peak-force"), Key("trial-column-peak-force-help")),
    (Key("trial-column-mean-force"), Key("trial-column-mean-force-help")),
    (Key("trial-column-unbalanced"), Key("trial-column-unbalanced-help")),
    (Key("trial-column-time"), Key("trial-column-time-help")),
];

/// What the columns take, in points; where there is less room they scroll.
const WIDTH: f32 = 960.0;

/// Shows the tables, if they are open.
pub(super) fn show(ui: &Ui, tables: &Tables, asked: &mut Vec<Action>) {
    if !tables.is_open {
        return;
    }
    let mut is_open = true;
    let room = ui.ctx().content_rect().shrink(16.0);
    let most = room.height() - 2.0 * theme::row(ui.ctx(), 32.0);
    egui::Window::new(say!("trial-tables"))
        .id(egui::Id::unique("trial tables"))
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .default_size([(room.width() - 32.0).min(WIDTH), most])
        .show(ui.ctx(), |ui| {
            ScrollArea::vertical().max_height(most).show(ui, |ui| content(ui, tables, asked));
        });
    if !is_open {
        asked.push(Action::CloseTables);
    }
}

fn content(ui: &mut Ui, tables: &Tables, asked: &mut Vec<Action>) {
    let what = match tables.sample {
        Some(Sample::Aorta) => say!("trial-tables-aorta"),
        Some(Sample::Coronary) => say!("trial-tables-coronary"),
        Some(Sample::AortaNets) | None => say!("trial-tables-other"),
    };
    ui.label(RichText::new(format!("{what} {}", say!("trial-tables-brackets"))).weak());
    ScrollArea::horizontal().show(ui, |ui| {
        let rows = tables.rows.iter().map(|row| cells(row, tables.printed));
        grid(ui, "tables", &COLUMNS, rows);
    });
    for row in &tables.rows {
        if let Outcome::Failed(why) = &row.outcome {
            ui.label(RichText::new(say!("trial-tables-failed", rate = row.rate, why = why)).small());
        }
    }
    ui.horizontal(|ui| {
        if tables.is_running() {
            progress(ui, tables.part(), 160.0, &say!("trial-tables-progress"));
            if ui.button(say!("trial-tables-cancel")).clicked() {
                asked.push(Action::CancelTables);
            }
        } else if ui.button(say!("trial-tables-again")).clicked() {
            asked.push(Action::RepeatTables);
        }
        if ui.button(say!("trial-tables-copy")).on_hover_text(say!("trial-tables-copy-help")).clicked() {
            ui.ctx().copy_text(text(tables) + &sweep::text(&tables.rows));
        }
        let sweep = ui.add_enabled(tables.can_sweep(), Button::new(say!("trial-sweep", seeds = SEEDS)));
        if sweep.on_hover_text(say!("trial-sweep-help")).clicked() {
            asked.push(Action::Sweep);
        }
    });
    sweep::show(ui, &tables.rows);
}

/// A table: heads, each with what it says, and cells to the right in their columns; the last column has no right side of its
/// own.
pub(super) fn grid<const N: usize>(
    ui: &mut Ui,
    id: &str,
    columns: &[(Key, Key); N],
    rows: impl Iterator<Item = [String; N]>,
) {
    let aligned = |ui: &mut Ui, column: usize, content: &dyn Fn(&mut Ui)| {
        if column + 1 == N {
            content(ui);
        } else {
            ui.with_layout(Layout::right_to_left(Align::Center), content);
        }
    };
    Grid::new(id).num_columns(N).striped(true).spacing([14.0, 6.0]).show(ui, |ui| {
        for (i, (head, help)) in columns.iter().enumerate() {
            aligned(ui, i, &|ui| {
                explain(ui.label(RichText::new(head.say()).small().strong()), &help.say());
            });
        }
        ui.end_row();
        for row in rows {
            for (i, cell) in row.iter().enumerate() {
                aligned(ui, i, &|ui| {
                    ui.label(cell);
                });
            }
            ui.end_row();
        }
    });
}

/// The same as text, a tab between columns.
pub(super) fn tabbed<const N: usize>(columns: &[(Key, Key); N], rows: impl Iterator<Item = [String; N]>) -> String {
    let line = |cells: &[String]| format!("{}\n", cells.join("\t"));
    let heads: Vec<String> = columns.iter().map(|(head, _)| head.say()).collect();
    line(&heads) + &rows.map(|row| line(&row)).collect::<String>()
}

/// The tables as text.
fn text(tables: &Tables) -> String {
    let rows = tables.rows.iter().map(|row| cells(row, tables.printed));
    format!("{}\n{}", tables.name, tabbed(&COLUMNS, rows))
}

/// Frames a second where 1/60 s takes so many ms to simulate.
fn fps(row: &Row, simulation_ms: f64) -> Option<f64> {
    Some(1000.0 / (simulation_ms + row.draw_ms?))
}

/// What stands in a row, the paper's figures in brackets.
fn cells(row: &Row, sample: Option<Sample>) -> [String; COLUMNS.len()] {
    let paper: &[TrialRow] = match sample {
        Some(Sample::Aorta) => &TABLE_III,
        Some(Sample::Coronary) => &TABLE_IV,
        Some(Sample::AortaNets) | None => &[],
    };
    let printed = paper.iter().find(|printed| printed.rate == row.rate);
    let beside = |ours: Option<String>, theirs: Option<String>| {
        let ours = ours.unwrap_or_else(|| "–".to_owned());
        theirs.map_or(ours.clone(), |theirs| format!("{ours} ({theirs})"))
    };
    let whole = |x: Option<f64>| x.map(|x| format!("{x:.0}"));
    let yes = |is_so: bool| if is_so { say!("trial-tables-yes") } else { say!("trial-tables-no") };
    let mut cells: [String; COLUMNS.len()] = std::array::from_fn(|_| "–".to_owned());
    cells[0] = format!("{} %", row.rate);
    if row.triangles > 0 {
        cells[1] = grouped(row.triangles);
    }
    if let Some(ms) = row.draw_ms {
        cells[6] = decimal(ms, 1);
    }
    let Outcome::Done(summary) = &row.outcome else { return cells };
    let passed: Vec<f64> = summary.stations.iter().filter_map(|station| station.simulation_ms).collect();
    let rates: Vec<f64> = passed.iter().filter_map(|&ms| fps(row, ms)).collect();
    let mean = |values: &[f64]| (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64);
    let worst = rates.iter().copied().reduce(f64::min);
    cells[2] = beside(whole(fps(row, summary.initial_simulation_ms)), printed.map(|p| p.initial_fps.to_string()));
    cells[3] = beside(whole(mean(&rates)), printed.map(|p| p.average_fps.to_string()));
    cells[4] = beside(whole(worst), None);
    if let Some(ms) = mean(&passed) {
        let first = decimal(summary.initial_simulation_ms, 1);
        cells[5] = say!("trial-tables-two", first = first, mean = decimal(ms, 1));
    }
    cells[7] = format!("{:.0}", summary.steps_per_second);
    cells[8] = beside(Some(yes(summary.success)), printed.map(|p| yes(p.success)));
    cells[9] = decimal(summary.max_wall_force_n, 3);
    cells[10] = decimal(summary.mean_wall_force_n, 3);
    cells[11] = decimal(100.0 * summary.unbalanced_share, 1);
    if summary.success {
        cells[12] = decimal(summary.time_s, 1);
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::stopwatch::StationResult;
    use crate::trial::summary::Summary;

    #[test]
    fn frames_a_second_count_both_parts_and_the_paper_stands_beside_them() {
        let station = |ms| StationResult { simulation_ms: Some(ms), ..StationResult::default() };
        let summary = Summary {
            success: true,
            time_s: 21.0,
            initial_simulation_ms: 6.0,
            stations: vec![station(6.0), station(16.0), StationResult::default()],
            ..Summary::default()
        };
        let row = Row { draw_ms: Some(4.0), outcome: Outcome::Done(Box::new(summary)), ..Row::new(90) };
        let cells = super::cells(&row, Some(Sample::Aorta));
        assert_eq!(cells[2], "100 (41)");
        assert_eq!(cells[3], "75 (18)");
        assert_eq!(cells[4], "50");
        assert_eq!((cells[5].as_str(), cells[6].as_str()), ("6.0, 11.0", "4.0"));
        assert_eq!((cells[8].as_str(), cells[12].as_str()), ("yes (yes)", "21.0"));
    }

    #[test]
    fn without_a_drawing_time_there_are_no_frames_a_second() {
        let row = Row { outcome: Outcome::Done(Box::default()), ..Row::new(95) };
        let cells = super::cells(&row, Some(Sample::Coronary));
        assert_eq!((cells[2].as_str(), cells[6].as_str()), ("– (32)", "–"));
        assert_eq!(cells[12], "–", "no time to a target that was not reached");
    }
}
