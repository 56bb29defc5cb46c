//! The paper's Tables III and IV: the autopilot at several reduction rates, one after another; and, where that is asked for, a
//! sweep of each rate: many seeds, beside the unreduced surface.

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
use crate::trial::sweep::SweepRow;
use crate::trial::wire::Wire;

/// Reduction rates in percent: of Table III, and of Table IV with the whole surface before them.
const RATES: [&[u32]; 2] = [&[10, 50, 75, 90, 99], &[0, 90, 95, 99]];

/// Seeds of a sweep.
pub(super) const SEEDS: u64 = 10;

/// How far something is that ends with a `T`.
#[derive(Debug)]
pub(super) enum Outcome<T> {
    Waiting,
    Running(f32),
    Done(T),
    Failed(String),
}

impl<T> Outcome<T> {
    fn is_waiting(&self) -> bool {
        matches!(self, Self::Waiting)
    }

    /// The part that is done, 0 to 1.
    fn part(&self) -> f32 {
        match self {
            Self::Waiting => 0.0,
            Self::Running(fraction) => *fraction,
            Self::Done(_) | Self::Failed(_) => 1.0,
        }
    }

    fn cancel(&mut self) {
        if matches!(self, Self::Waiting | Self::Running(_)) {
            *self = Self::Failed(say!("trial-cancelled"));
        }
    }
}

/// What has to be run next.
pub(super) enum Next {
    /// The autopilot on a surface.
    Measure(Arc<TriMesh>, Option<Sample>, Setup),
    /// Many seeds on a surface, beside the unreduced one.
    Sweep([Arc<TriMesh>; 2], Setup),
}

/// A row.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) rate: u32,
    pub(super) triangles: usize,
    pub(super) outcome: Outcome<Box<Summary>>,
    /// Once it was asked for.
    pub(super) sweep: Option<Outcome<SweepRow>>,
    /// The surface, until a frame of it has been timed.
    pub(super) mesh: Option<Arc<TriMesh>>,
    pub(super) timing: Option<Receiver<f64>>,
    pub(super) draw_ms: Option<f64>,
}

impl Row {
    /// Of which nothing is known.
    pub(super) fn new(rate: u32) -> Self {
        let outcome = Outcome::Waiting;
        Self { rate, triangles: 0, outcome, sweep: None, mesh: None, timing: None, draw_ms: None }
    }

    fn is_waiting(&self) -> bool {
        self.outcome.is_waiting() || self.sweep.as_ref().is_some_and(Outcome::is_waiting)
    }
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
    /// The number of the measurement or sweep that is going on.
    running: Option<u64>,
}

impl Tables {
    /// Whether a row is being run or is to be.
    pub fn is_running(&self) -> bool {
        self.running.is_some() || self.rows.iter().any(Row::is_waiting)
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
        self.rows = rates.iter().copied().map(Row::new).collect();
        self.levels = Some(levels.clone());
        self.sample = sample;
        self.printed = document.source.usual_sample();
        // Places that were picked by hand are places in this surface; others are those that the first row proposes.
        self.setup = setup.clone();
        document.name.clone_into(&mut self.name);
    }

    /// What has to be run next, which has begun under this number then: all rows of the table come before their sweeps.
    pub(super) fn next(&mut self, id: u64) -> Option<Next> {
        if self.running.is_some() {
            return None;
        }
        let levels = self.levels.as_ref()?;
        let level = |rate: u32| Arc::new(levels.extract(&levels.level(Target::Reduction(rate * 10)).triangles));
        let next = if let Some(row) = self.rows.iter_mut().find(|row| row.outcome.is_waiting()) {
            let mesh = level(row.rate);
            (row.outcome, row.triangles, row.mesh) = (Outcome::Running(0.0), mesh.triangles.len(), Some(mesh.clone()));
            Next::Measure(mesh, self.sample, self.setup.clone())
        } else {
            let is_waiting = |row: &&mut Row| row.sweep.as_ref().is_some_and(Outcome::is_waiting);
            let row = self.rows.iter_mut().find(is_waiting)?;
            row.sweep = Some(Outcome::Running(0.0));
            Next::Sweep([level(row.rate), level(0)], self.setup.clone())
        };
        self.running = Some(id);
        Some(next)
    }

    /// Whether the measurement or sweep of this number is going on.
    pub(super) fn is_measuring(&self, id: u64) -> bool {
        self.running == Some(id)
    }

    fn current(&mut self) -> Option<&mut Row> {
        self.rows.iter_mut().find(|row| matches!(row.outcome, Outcome::Running(_)))
    }

    fn current_sweep(&mut self) -> Option<&mut Outcome<SweepRow>> {
        self.rows.iter_mut().filter_map(|row| row.sweep.as_mut()).find(|sweep| matches!(sweep, Outcome::Running(_)))
    }

    /// Hears how far it is.
    pub(super) fn progresses(&mut self, fraction: f32) {
        if let Some(row) = self.current() {
            row.outcome = Outcome::Running(fraction);
        } else if let Some(sweep) = self.current_sweep() {
            *sweep = Outcome::Running(fraction);
        }
    }

    /// Whether a sweep can be asked for: the rows say with which wire and where.
    pub(super) fn can_sweep(&self) -> bool {
        !self.is_running() && self.rows.iter().any(|row| matches!(row.outcome, Outcome::Done(_)))
    }

    /// Sweeps all rates.
    pub(super) fn sweep(&mut self) {
        self.rows.iter_mut().for_each(|row| row.sweep = Some(Outcome::Waiting));
    }

    /// Hears what came of a sweep.
    pub(super) fn receive_sweep(&mut self, id: u64, row: SweepRow) {
        if self.is_measuring(id) {
            self.running = None;
            if let Some(sweep) = self.current_sweep() {
                *sweep = Outcome::Done(row);
            }
        }
    }

    /// Hears what came of a measurement.
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
        if self.running.take().is_none() {
            return;
        }
        if let Some(row) = self.current() {
            row.outcome = Outcome::Failed(why.to_owned());
        } else if let Some(sweep) = self.current_sweep() {
            *sweep = Outcome::Failed(why.to_owned());
        }
    }

    /// Gives up what is not done; gives the number of the measurement that was going on.
    pub(super) fn cancel(&mut self) -> Option<u64> {
        for row in &mut self.rows {
            row.outcome.cancel();
            if let Some(sweep) = &mut row.sweep {
                sweep.cancel();
            }
        }
        self.running.take()
    }

    /// Runs all rows again.
    pub(super) fn again(&mut self) {
        for row in &mut self.rows {
            *row = Row::new(row.rate);
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
        let sweeps = self.rows.iter().filter_map(|row| row.sweep.as_ref());
        // The rows are done where one is swept.
        let parts: Vec<f32> = match sweeps.clone().next() {
            Some(_) => sweeps.map(Outcome::part).collect(),
            None => self.rows.iter().map(|row| row.outcome.part()).collect(),
        };
        parts.iter().sum::<f32>() / parts.len().max(1) as f32
    }
}
