//! The surface that is open, under the newest settings.
//!
//! The newest settings win. Those that arrive while older ones are being worked on wait until that result is out, so that a
//! slider being dragged shows one result after another; but no longer than [`PATIENCE`], after which the older work is
//! dropped.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use super::arrays;
use super::found::{Calibre, Deviated, FaultsFound, LevelArrays, Reduced};
use super::message::{Event, Work};
use super::progress::tell_progress;
use super::record::Origin;
use crate::language::tell;
use crate::mesh::{TriMesh, used_vertices};
use crate::pipeline::report::Report;
use crate::pipeline::run::{Advance, Pipeline};
use crate::pipeline::settings::{Settings, SettingsError};
use crate::pipeline::stage::Stage;
use crate::task::Budget;

/// How long work on older settings may hold up newer ones.
pub const PATIENCE: Duration = Duration::from_millis(400);

/// A surface that is open, under the newest settings.
pub(super) struct Current {
    pub(super) name: String,
    pub(super) origin: Origin,
    pub(super) pipeline: Pipeline,
    /// The surface that the app has: the opened one, or what mending made of it.
    told: Arc<TriMesh>,
    read_ms: f64,
    /// The number of the settings that are worked on.
    pub(super) generation: u64,
    /// The number of the newest settings that reached a level.
    pub(super) reached: u64,
    /// Newer settings, with their number.
    pub(super) waiting: Option<(u64, Settings)>,
    /// When work on the present settings began.
    since: Instant,
    /// Whether it was cancelled: nothing goes on until there are newer settings.
    pub(super) is_stopped: bool,
    /// Whether the levels are newer than those that were sent: they go out with their first numbers, so that a
    /// cancel never leaves levels outside that the pipeline has gone back from.
    pub(super) has_new_levels: bool,
}

impl Current {
    /// Of a surface that was opened by the command `id`, in the `pipeline` for it, after `read_ms` of reading.
    pub(super) fn new(id: u64, name: String, origin: Origin, pipeline: Pipeline, read_ms: f64) -> Self {
        Self {
            name,
            origin,
            told: pipeline.opened().clone(),
            pipeline,
            read_ms,
            generation: id,
            reached: id,
            waiting: None,
            since: Instant::now(),
            is_stopped: false,
            has_new_levels: false,
        }
    }

    /// The same with nothing under way.
    pub(super) fn fork(&self) -> Self {
        Self {
            name: self.name.clone(),
            origin: self.origin.clone(),
            pipeline: self.pipeline.fork(),
            told: self.told.clone(),
            waiting: None,
            ..*self
        }
    }

    /// Whether the arrays of the level are still on their way to it: a file of it waits for them.
    pub(super) fn is_carrying(&self) -> bool {
        let is_coming = self.waiting.is_some() || self.pipeline.level_arrays().is_none();
        self.pipeline.has_arrays() && is_coming && !self.is_stopped
    }

    /// Whether nothing is left but what nobody waits for: the faults of the file, the vessels' calibre, and how far is safe
    /// where the level does not go by it.
    pub(super) fn is_in_background(&self) -> bool {
        let is_awaited = self.waiting.is_some() || self.pipeline.is_deciding();
        !is_awaited && self.pipeline.next_stage().is_some_and(Stage::is_background)
    }

    /// One step; whether there is more to do.
    pub(super) fn advance(&mut self, budget: Budget, events: &mut VecDeque<Event>) -> Result<bool, String> {
        self.take_waiting(events).map_err(|error| tell(&error))?;
        if self.is_stopped {
            return Ok(false);
        }
        let generation = self.generation;
        match self.pipeline.advance(budget).map_err(|error| tell(&error))? {
            Advance::Idle => return Ok(self.pipeline.prepare(budget)),
            // Nobody waits for these: they go on in the background, and leave the bar to what is told there.
            Advance::Working(stage, _) if stage.is_background() => {}
            Advance::Working(stage, fraction) => {
                tell_progress(Work::Stage(stage), fraction, events);
            }
            Advance::Finished(Stage::Decimation) => self.has_new_levels = true,
            Advance::Finished(stage @ (Stage::Level | Stage::Deviation | Stage::Measures | Stage::Safe)) => {
                self.reached = generation;
                if let Some(mesh) = self.pipeline.progressive().filter(|_| self.has_new_levels) {
                    let keep = self.pipeline.settings().keep;
                    let vertices = used_vertices(mesh.positions.len(), &mesh.triangles).len();
                    let reduced = Reduced { generation, keep, vertices, mesh: mesh.clone() };
                    events.push_back(Event::Reduced(Box::new(reduced)));
                    self.has_new_levels = false;
                }
                // Shape and lumen come when the deviation is told.
                let has_new_map = !matches!(stage, Stage::Measures | Stage::Safe);
                self.tell_numbers(stage != Stage::Level, has_new_map, events);
                if stage == Stage::Deviation {
                    self.tell_deviation(events);
                }
            }
            Advance::Finished(Stage::Arrays) => self.tell_arrays(events),
            Advance::Finished(Stage::Certificate) => self.tell_calibre(events),
            Advance::Finished(Stage::Mending) => {
                self.tell_mended(events);
            }
            Advance::Finished(Stage::Faults) => self.tell_faults(events),
            Advance::Finished(Stage::Connectivity) => self.tell_pieces(events),
            Advance::Finished(_) => {}
        }
        Ok(self.pipeline.next_stage().is_some() || self.waiting.is_some() || self.pipeline.can_prepare())
    }

    /// Goes over to newer settings, unless a result of the present ones is near.
    fn take_waiting(&mut self, events: &mut VecDeque<Event>) -> Result<(), SettingsError> {
        let result_is_near = !self.is_stopped
            && self.pipeline.reduced().is_none()
            && self.pipeline.kept().is_some()
            && self.since.elapsed() < PATIENCE;
        if result_is_near {
            return Ok(());
        }
        if let Some((generation, settings)) = self.waiting.take() {
            self.generation = generation;
            self.since = Instant::now();
            self.is_stopped = false;
            self.pipeline.set(settings)?;
            // Where they change nothing that is made, the numbers stand under their number too.
            if self.pipeline.reduced().is_some() {
                self.reached = generation;
                self.tell_numbers(self.pipeline.deviations().is_some(), true, events);
                self.tell_deviation(events);
                self.tell_arrays(events);
                self.tell_calibre(events);
            }
        }
        Ok(())
    }

    /// The numbers of the level, with or without its deviation; that of each node with them, unless it was the last that
    /// was told.
    fn tell_numbers(&self, complete: bool, with_deviation: bool, events: &mut VecDeque<Event>) {
        let Some(mut report) = Report::new(&self.name, &self.pipeline) else { return };
        report.stages_ms.read = self.read_ms;
        // They come by themselves, with what is shown of them.
        (report.branches, report.safe) = (None, None);
        let safe = self.pipeline.safe().map(|safe| Box::new((**safe).clone()));
        let by_node = || self.pipeline.deviations().map_or_else(Vec::new, |found| found.by_node.clone());
        let deviation = with_deviation.then(by_node);
        let generation = self.generation;
        events.push_back(Event::Measured { generation, complete, report: Box::new(report), safe, deviation });
    }

    /// The surface that goes through the stages, where it is another than the app has; whether it is.
    pub(super) fn tell_mended(&mut self, events: &mut VecDeque<Event>) -> bool {
        let Some(entering) = self.pipeline.entering() else { return false };
        if Arc::ptr_eq(&entering.mesh, &self.told) {
            return false;
        }
        self.told = entering.mesh.clone();
        events.push_back(Event::Mended { mesh: self.told.clone() });
        true
    }

    /// The pieces, once they are known.
    pub(super) fn tell_pieces(&self, events: &mut VecDeque<Event>) {
        if let Some(found) = self.pipeline.connectivity() {
            let labels = found.labels.of_triangle.clone();
            events.push_back(Event::Pieces { labels, components: found.components.clone() });
        }
    }

    fn tell_faults(&self, events: &mut VecDeque<Event>) {
        if let Some(found) = self.pipeline.faults() {
            let places = found.places(self.pipeline.opened());
            events.push_back(Event::Faults(Box::new(FaultsFound { counts: found.counts(), places })));
        }
    }

    /// What else is known of the deviation, once it is.
    fn tell_deviation(&self, events: &mut VecDeque<Event>) {
        let found = self.pipeline.deviations().map(|found| (&found.from_smoothed, &found.from_original));
        if let Some((Some(smoothed), Some(original))) = found {
            let values = [&smoothed.signed_map[..], &original.map, &original.signed_map].concat();
            let histograms = [smoothed.histogram.clone(), original.histogram.clone()];
            let generation = self.generation;
            events.push_back(Event::Deviated(Box::new(Deviated { generation, values, histograms })));
        }
    }

    /// What the file says of the level, if it says something and that is carried to it.
    fn tell_arrays(&self, events: &mut VecDeque<Event>) {
        let carried = self.pipeline.level_arrays().zip(self.pipeline.reduced());
        if let Some((arrays, reduced)) = carried.filter(|(arrays, _)| !arrays.is_empty()) {
            let (generation, values) = (self.generation, arrays::by_vertex(arrays, reduced));
            events.push_back(Event::LevelArrays(Box::new(LevelArrays { generation, values })));
        }
    }

    /// What the level makes of the vessels, if that is known.
    fn tell_calibre(&self, events: &mut VecDeque<Event>) {
        let Some(certified) = self.pipeline.certified() else { return };
        let (found, change_by_node) = match certified {
            Ok(found) => (Ok(found.certificate.clone()), found.change_by_node.clone()),
            Err(error) => (Err(error.clone()), Vec::new()),
        };
        let generation = self.generation;
        events.push_back(Event::Certified(Box::new(Calibre { generation, found, change_by_node })));
    }
}
