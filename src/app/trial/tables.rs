//! The paper's Tables III and IV: the autopilot at several reduction rates, one after another.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

use crate::app::document::Document;
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::pipeline::progressive::ProgressiveMesh;
use crate::pipeline::settings::Target;
use crate::say;
use crate::trial::setup::Setup;
use crate::trial::summary::Summary;
use crate::trial::wire::Wire;

/// Reduction rates in percent: of Table III, and of Table IV with the whole surface before them.
const RATES: [&[u32]; 2] = [&[10, 50, 75, 90, 99], &[0, 90, 95, 99]];

/// How far a row is.
#[derive(Debug, Default)]
pub(super) enum Outcome {
    #[default]
    Waiting,
    Running(f32),
    Done(Box<Summary>),
    Failed(String),
}

/// A row.
#[derive(Debug, Default)]
pub(super) struct Row {
    pub(super) rate: u32,
    pub(super) triangles: usize,
    pub(super) outcome: Outcome,
    /// The surface, until a frame of it has been timed.
    pub(super) mesh: Option<Arc<TriMesh>>,
    pub(super) timing: Option<Receiver<f64>>,
    pub(super) draw_ms: Option<f64>,
}

/// The tables and how far they are.
#[derive(Debug, Default)]
pub struct Tables {
    /// Whether they are shown.
    pub is_open: bool,
    pub(super) rows: Vec<Row>,
    levels: Option<Arc<ProgressiveMesh>>,
    pub(super) sample: Option<Sample>,
    /// The same where it has as many triangles as it has by itself: beside those the paper's figures stand.
    pub(super) printed: Option<Sample>,
    setup: Setup,
    pub(super) name: String,
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
        self.printed = document.source.usual_sample();
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
                row.outcome = Outcome::Failed(say!("trial-cancelled"));
            }
        }
        self.running.take()
    }

    /// Runs all rows again.
    pub(super) fn again(&mut self) {
        for row in &mut self.rows {
            *row = Row { rate: row.rate, ..Row::default() };
        }
    }

    /// Whether the window's frames are to be timed, or it is shown.
    pub(in crate::app) fn needs_views(&self) -> bool {
        self.is_open || self.is_busy()
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

    /// The part that is done, 0 to 1.
    pub(super) fn part(&self) -> f32 {
        let done = |row: &Row| match row.outcome {
            Outcome::Waiting => 0.0,
            Outcome::Running(fraction) => fraction,
            Outcome::Done(_) | Outcome::Failed(_) => 1.0,
        };
        self.rows.iter().map(done).sum::<f32>() / self.rows.len().max(1) as f32
    }
}
