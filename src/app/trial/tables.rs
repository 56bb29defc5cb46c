//! The paper's Tables III and IV: the autopilot at several reduction rates, one after another, the paper's figures
//! beside ours.
//!
//! Frames a second are 1 / (time to compute 1/60 s of simulated time + time to draw one frame of 1280x800); both parts
//! are shown.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{Align, Grid, Layout, RichText, ScrollArea, Ui};

use crate::app::control::progress;
use crate::app::document::Document;
use crate::digits::grouped;
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::pipeline::paper::{TABLE_III, TABLE_IV, TrialRow};
use crate::pipeline::progressive::ProgressiveMesh;
use crate::pipeline::settings::Target;
use crate::trial::setup::Setup;
use crate::trial::summary::Summary;
use crate::trial::wire::Wire;

/// Reduction rates in percent: of Table III, and of Table IV with the whole surface before them.
const RATES: [&[u32]; 2] = [&[10, 50, 75, 90, 99], &[0, 90, 95, 99]];

/// How far a row is.
#[derive(Debug, Default)]
enum Outcome {
    #[default]
    Waiting,
    Running(f32),
    Done(Box<Summary>),
    Failed(String),
}

/// A row.
#[derive(Debug, Default)]
pub(super) struct Row {
    rate: u32,
    triangles: usize,
    outcome: Outcome,
    /// The surface, until a frame of it has been timed.
    mesh: Option<Arc<TriMesh>>,
    timing: Option<Receiver<f64>>,
    draw_ms: Option<f64>,
}

/// The tables and how far they are.
#[derive(Debug, Default)]
pub struct Tables {
    /// Whether they are shown.
    pub is_open: bool,
    rows: Vec<Row>,
    levels: Option<Arc<ProgressiveMesh>>,
    sample: Option<Sample>,
    setup: Setup,
    name: String,
    /// The number of the measurement that is going on.
    running: Option<u64>,
}

impl Tables {
    /// Whether a row is being run or is to be.
    pub fn is_running(&self) -> bool {
        self.running.is_some() || self.rows.iter().any(|row| matches!(row.outcome, Outcome::Waiting))
    }

    /// Whether there is more to come: rows, or the time to draw a surface.
    pub(in crate::app) fn is_busy(&self) -> bool {
        self.is_running() || self.rows.iter().any(|row| row.timing.is_some())
    }

    /// Whether there is something to run, and nothing of it known.
    pub(super) fn can_start(&self, document: &Document) -> bool {
        document.levels.is_some() && !self.is_running() && (self.rows.is_empty() || self.name != document.name)
    }

    /// Runs all rows on the levels of a surface.
    pub(super) fn begin(&mut self, document: &Document, sample: Option<Sample>, setup: &Setup) {
        let Some((_, levels)) = &document.levels else { return };
        let rates = RATES[usize::from(sample != Some(Sample::Aorta))];
        self.rows = rates.iter().map(|&rate| Row { rate, ..Row::default() }).collect();
        self.levels = Some(levels.clone());
        self.sample = sample;
        // Places that were picked by hand are places in this surface; others are those that the first row proposes.
        self.setup = setup.clone();
        document.name.clone_into(&mut self.name);
    }

    /// What has to be measured next.
    pub(super) fn next(&mut self) -> Option<(Arc<TriMesh>, Option<Sample>, Setup)> {
        if self.running.is_some() {
            return None;
        }
        let levels = self.levels.as_ref()?;
        let row = self.rows.iter_mut().find(|row| matches!(row.outcome, Outcome::Waiting))?;
        let level = levels.level(Target::Reduction(row.rate * 10));
        let mesh = Arc::new(levels.extract(&level.triangles));
        row.mesh = Some(mesh.clone());
        Some((mesh, self.sample, self.setup.clone()))
    }

    /// That measurement has begun under this number.
    pub(super) fn started(&mut self, id: u64, triangles: usize) {
        if let Some(row) = self.rows.iter_mut().find(|row| matches!(row.outcome, Outcome::Waiting)) {
            (row.outcome, row.triangles) = (Outcome::Running(0.0), triangles);
            self.running = Some(id);
        }
    }

    /// Whether the measurement of this number is going on.
    pub(super) fn is_measuring(&self, id: u64) -> bool {
        self.running == Some(id)
    }

    fn current(&mut self) -> Option<&mut Row> {
        self.rows.iter_mut().find(|row| matches!(row.outcome, Outcome::Running(_)))
    }

    /// Hears how far the measurement is.
    pub(super) fn progresses(&mut self, fraction: f32) {
        if let Some(row) = self.current() {
            row.outcome = Outcome::Running(fraction);
        }
    }

    /// Hears what came of it.
    pub(super) fn receive(&mut self, id: u64, summary: Box<Summary>) {
        if self.is_measuring(id) {
            self.running = None;
            // One wire and one way for all rows.
            if let Some(wire) = Wire::preset(&summary.wire).filter(|_| self.setup.proposes_wire) {
                (self.setup.wire, self.setup.proposes_wire) = (wire, false);
            }
            self.setup.entry = self.setup.entry.or(summary.entry);
            self.setup.target = self.setup.target.or(summary.target);
            if let Some(row) = self.current() {
                row.outcome = Outcome::Done(summary);
            }
        }
    }

    /// Hears that it could not be done.
    pub(super) fn fails(&mut self, why: &str) {
        if self.running.take().is_some()
            && let Some(row) = self.current()
        {
            row.outcome = Outcome::Failed(why.to_owned());
        }
    }

    /// Gives up what is not done; gives the number of the measurement that was going on.
    pub(super) fn cancel(&mut self) -> Option<u64> {
        for row in &mut self.rows {
            if matches!(row.outcome, Outcome::Waiting | Outcome::Running(_)) {
                row.outcome = Outcome::Failed("Cancelled.".to_owned());
            }
        }
        self.running.take()
    }

    /// Runs all rows again.
    fn again(&mut self) {
        for row in &mut self.rows {
            *row = Row { rate: row.rate, ..Row::default() };
        }
    }

    /// Times a frame of each surface by `time`, and takes the answers that have come.
    pub(super) fn time(&mut self, mut time: impl FnMut(&TriMesh) -> Option<Receiver<f64>>) {
        for row in &mut self.rows {
            if let Some(mesh) = row.mesh.take() {
                row.timing = time(&mesh);
            }
            match row.timing.as_ref().map(Receiver::try_recv) {
                None | Some(Err(TryRecvError::Empty)) => {}
                // A device that is lost gives no answer.
                Some(answer) => (row.draw_ms, row.timing) = (answer.ok(), None),
            }
        }
    }

    fn part(&self) -> f32 {
        let done = |row: &Row| match row.outcome {
            Outcome::Waiting => 0.0,
            Outcome::Running(fraction) => fraction,
            Outcome::Done(_) | Outcome::Failed(_) => 1.0,
        };
        self.rows.iter().map(done).sum::<f32>() / self.rows.len().max(1) as f32
    }
}

impl Row {
    /// Frames a second where 1/60 s takes so many ms to simulate.
    fn fps(&self, simulation_ms: f64) -> Option<f64> {
        Some(1000.0 / (simulation_ms + self.draw_ms?))
    }

    fn cells(&self, sample: Option<Sample>) -> [String; COLUMNS.len()] {
        let paper: &[TrialRow] = match sample {
            Some(Sample::Aorta) => &TABLE_III,
            Some(Sample::Coronary) => &TABLE_IV,
            None => &[],
        };
        let printed = paper.iter().find(|row| row.rate == self.rate);
        let beside = |ours: Option<String>, theirs: Option<String>| {
            let ours = ours.unwrap_or_else(|| "–".to_owned());
            theirs.map_or(ours.clone(), |theirs| format!("{ours} ({theirs})"))
        };
        let whole = |x: Option<f64>| x.map(|x| format!("{x:.0}"));
        let yes = |is_so: bool| if is_so { "yes" } else { "no" }.to_owned();
        let mut cells: [String; COLUMNS.len()] = std::array::from_fn(|_| "–".to_owned());
        cells[0] = format!("{} %", self.rate);
        if self.triangles > 0 {
            cells[1] = grouped(self.triangles);
        }
        if let Some(ms) = self.draw_ms {
            cells[6] = format!("{ms:.1}");
        }
        let Outcome::Done(summary) = &self.outcome else { return cells };
        let passed: Vec<f64> = summary.stations.iter().filter_map(|station| station.simulation_ms).collect();
        let rates: Vec<f64> = passed.iter().filter_map(|&ms| self.fps(ms)).collect();
        let mean = |values: &[f64]| (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64);
        let worst = rates.iter().copied().reduce(f64::min);
        cells[2] = beside(whole(self.fps(summary.initial_simulation_ms)), printed.map(|p| p.initial_fps.to_string()));
        cells[3] = beside(whole(mean(&rates)), printed.map(|p| p.average_fps.to_string()));
        cells[4] = beside(whole(worst), None);
        cells[5] =
            mean(&passed).map_or("–".to_owned(), |ms| format!("{:.1}, {ms:.1}", summary.initial_simulation_ms));
        cells[7] = format!("{:.0}", summary.steps_per_second);
        cells[8] = beside(Some(yes(summary.success)), printed.map(|p| yes(p.success)));
        cells[9] = format!("{:.3}", summary.max_wall_force_n);
        cells[10] = format!("{:.3}", summary.mean_wall_force_n);
        cells[11] = format!("{:.1}", 100.0 * summary.unbalanced_share);
        if summary.success {
            cells[12] = format!("{:.1}", summary.time_s);
        }
        cells
    }
}

/// Heads of the columns, and what they say.
const COLUMNS: [(&str, &str); 13] = [
    ("Rate", "The part of the triangles that was removed"),
    ("Triangles", "What was left"),
    ("Initial fps", "Frames a second in the first simulated second (the paper's)"),
    ("Average fps", "Mean over the five stations (the paper's)"),
    ("Worst fps", "The slowest station"),
    ("Simulation, ms", "To compute 1/60 s: in the first second, and the mean at the stations"),
    ("Drawing, ms", "To draw one frame of 1280x800"),
    ("Steps/s", "Steps of 2 ms that this machine computes in a second"),
    ("Success", "Whether the tip arrived (the paper's)"),
    ("Peak force, N", "The largest wall force at one place, in the steps that are balanced"),
    ("Mean force, N", "The sum of the wall forces, mean over the balanced steps"),
    ("Unbalanced, %", "Steps whose forces were not in balance; the forces are those of the others"),
    ("Time, s", "Simulated time to the target"),
];

/// What the columns take, in points; where there is less room they scroll.
const WIDTH: f32 = 960.0;

/// Shows the tables; says whether they were cancelled.
pub(super) fn show(ui: &Ui, tables: &mut Tables) -> bool {
    let mut cancelled = false;
    let mut is_open = tables.is_open;
    let room = ui.ctx().content_rect().shrink(16.0);
    egui::Window::new("Tables III and IV")
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .default_width((room.width() - 32.0).min(WIDTH))
        .show(ui.ctx(), |ui| cancelled = content(ui, tables));
    tables.is_open = is_open;
    cancelled
}

fn content(ui: &mut Ui, tables: &mut Tables) -> bool {
    let what = match tables.sample {
        Some(Sample::Aorta) => "Table III: the autopilot in the aorta.",
        Some(Sample::Coronary) => "Table IV: the autopilot in aorta and coronary arteries.",
        None => "The autopilot in this surface.",
    };
    ui.label(RichText::new(format!("{what} The paper's figures are in brackets.")).weak());
    ScrollArea::horizontal().show(ui, |ui| {
        Grid::new("tables").num_columns(COLUMNS.len()).striped(true).spacing([14.0, 6.0]).show(ui, |ui| {
            for (i, (head, help)) in COLUMNS.into_iter().enumerate() {
                aligned(ui, i, |ui| {
                    ui.label(RichText::new(head).small().strong()).on_hover_text(help);
                });
            }
            ui.end_row();
            for row in &tables.rows {
                for (i, cell) in row.cells(tables.sample).into_iter().enumerate() {
                    aligned(ui, i, |ui| {
                        ui.label(cell);
                    });
                }
                ui.end_row();
            }
        });
    });
    for row in &tables.rows {
        if let Outcome::Failed(why) = &row.outcome {
            ui.label(RichText::new(format!("{} %: {why}", row.rate)).small());
        }
    }
    let mut cancelled = false;
    ui.horizontal(|ui| {
        if tables.is_running() {
            progress(ui, tables.part(), 160.0, "Tables");
            cancelled = ui.button("Cancel tables").clicked();
        } else if ui.button("Run again").clicked() {
            tables.again();
        }
        if ui.button("Copy").on_hover_text("As text, a tab between columns").clicked() {
            ui.ctx().copy_text(text(tables));
        }
    });
    cancelled
}

/// To the right in its column; the last column has no right side of its own.
fn aligned(ui: &mut Ui, column: usize, content: impl FnOnce(&mut Ui)) {
    if column + 1 == COLUMNS.len() {
        content(ui);
    } else {
        ui.with_layout(Layout::right_to_left(Align::Center), content);
    }
}

/// The tables as text.
fn text(tables: &Tables) -> String {
    let line = |cells: &[String]| format!("{}\n", cells.join("\t"));
    let heads: Vec<String> = COLUMNS.iter().map(|(head, _)| (*head).to_owned()).collect();
    let rows = tables.rows.iter().map(|row| line(&row.cells(tables.sample)));
    format!("{}\n{}{}", tables.name, line(&heads), rows.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::stopwatch::StationResult;

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
        let row = Row { rate: 90, draw_ms: Some(4.0), outcome: Outcome::Done(Box::new(summary)), ..Row::default() };
        let cells = row.cells(Some(Sample::Aorta));
        assert_eq!(cells[2], "100 (41)");
        assert_eq!(cells[3], "75 (18)");
        assert_eq!(cells[4], "50");
        assert_eq!((cells[5].as_str(), cells[6].as_str()), ("6.0, 11.0", "4.0"));
        assert_eq!((cells[8].as_str(), cells[12].as_str()), ("yes (yes)", "21.0"));
    }

    #[test]
    fn without_a_drawing_time_there_are_no_frames_a_second() {
        let row = Row { rate: 95, outcome: Outcome::Done(Box::default()), ..Row::default() };
        let cells = row.cells(Some(Sample::Coronary));
        assert_eq!((cells[2].as_str(), cells[6].as_str()), ("– (32)", "–"));
        assert_eq!(cells[12], "–", "no time to a target that was not reached");
    }
}
