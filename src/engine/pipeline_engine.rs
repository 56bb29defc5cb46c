//! The pipeline as commands and events: one opened surface, the newest settings, and files to be made of it.
//!
//! The newest settings win. Those that arrive while older ones are being worked on wait until that result is out, so that a
//! slider being dragged shows one result after another; but no longer than [`PATIENCE`], after which the older work is
//! dropped.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use super::arrays;
use super::compare::Comparing;
use super::machine::{Machine, SLICE};
use super::message::{Calibre, Carried, Command, Event, Opened, Reduced, Source, Work};
use super::progress::tell_progress;
use crate::io::{self, Axes, Imported, Output};
use crate::mesh::{TriMesh, Vec3};
use crate::phantom;
use crate::pipeline::normals::{Weighting, vertex_normals};
use crate::pipeline::report::Report;
use crate::pipeline::run::{Advance, Pipeline};
use crate::pipeline::settings::Settings;
use crate::pipeline::stage::Stage;
use crate::pipeline::task::Budget;
use crate::sharing::Digest;
use crate::vessel::CentrelineFormat;

/// How long work on older settings may hold up newer ones.
pub const PATIENCE: Duration = Duration::from_millis(400);

/// The pipeline as a machine of commands and events.
#[derive(Default)]
pub struct Engine {
    /// Files to be opened, with the settings to begin with: the newest is, those before it only if it cannot be read.
    opening: Vec<(u64, Source, Settings)>,
    current: Option<Current>,
    /// Settings to compare on the surface that is open, or is opened next.
    pub(super) comparing: Option<Comparing>,
    writing: VecDeque<Writing>,
    events: VecDeque<Event>,
}

/// A file to be written.
struct Writing {
    name: String,
    format: io::Format,
    mesh: TriMesh,
    axes: Axes,
}

struct Current {
    name: String,
    axes: Axes,
    pipeline: Pipeline,
    read_ms: f64,
    /// The number of the settings that are worked on.
    generation: u64,
    /// The number of the newest settings that reached a level.
    reached: u64,
    /// Newer settings, with their number.
    waiting: Option<(u64, Settings)>,
    /// When work on the present settings began.
    since: Instant,
    /// Whether it was cancelled: nothing goes on until there are newer settings.
    is_stopped: bool,
    /// Whether the levels are newer than those that were sent: they go out with their first numbers, so that a
    /// cancel never leaves levels outside that the pipeline has gone back from.
    has_new_levels: bool,
}

impl Engine {
    /// An engine with nothing open.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a command. Nothing long happens here.
    pub fn handle(&mut self, command: Command) {
        match command {
            Command::Open { id, source, settings } => self.opening.push((id, source, settings)),
            Command::Set { generation, settings } => {
                if let Some(current) = &mut self.current {
                    current.waiting = Some((generation, settings));
                }
            }
            Command::Compare { id, settings } => {
                let comparing = Comparing::new(id, settings);
                // A surface that is on its way in would be another than that of the work so far.
                let before = self.comparing.take().filter(|_| self.opening.is_empty());
                self.comparing = Some(match before {
                    Some(before) => comparing.after(before),
                    None => comparing,
                });
            }
            Command::Cancel => self.cancel(),
            Command::WriteCentrelines { name, format } => self.write_centrelines(name, format),
            Command::WriteLevel { name, format } => self.write_level(name, format),
            Command::Write { name, format, mesh, axes } => {
                self.writing.push_back(Writing { name, format, mesh, axes });
            }
        }
    }

    fn cancel(&mut self) {
        self.opening.clear();
        self.comparing = None;
        if let Some(current) = &mut self.current {
            current.waiting = None;
            current.pipeline.cancel();
            current.is_stopped = true;
            current.has_new_levels = false;
            if current.pipeline.reduced().is_some() {
                current.generation = current.reached;
            }
            let (generation, settings) = (current.generation, current.pipeline.settings().clone());
            self.events.push_back(Event::Cancelled { generation, settings });
        }
    }

    /// Works for about `slice` and says whether there is more to do. Reading a file and writing one are one piece each
    /// and may take longer; so may, for surfaces of a million triangles, the parts of connectivity and the beginning
    /// and end of smoothing and decimation (tens of milliseconds).
    pub fn advance(&mut self, slice: Duration) -> bool {
        let budget = Budget::new(slice);
        if let Some(writing) = self.writing.pop_front_if(|_| !self.current.as_ref().is_some_and(Current::is_carrying)) {
            self.write(writing);
        } else if let Some((id, source, settings)) = self.opening.pop() {
            self.open(id, source, settings);
        } else if self.comparing.is_some() && self.current.as_ref().is_some_and(Current::is_in_background) {
            // What a user waits for goes before what nobody asked for.
            self.compare(budget);
        } else if let Some(current) = &mut self.current {
            loop {
                match current.advance(budget, &mut self.events) {
                    Ok(true) if !budget.is_spent() => {}
                    Ok(true) => return true,
                    Ok(false) => break,
                    Err(message) => {
                        self.cancel();
                        self.events.push_back(Event::Failed { message });
                        return false;
                    }
                }
            }
            return self.compare(budget) || !self.writing.is_empty();
        }
        !self.opening.is_empty() || self.current.is_some() || !self.writing.is_empty()
    }

    /// Goes on with the settings to compare; whether there is more to do.
    fn compare(&mut self, budget: Budget) -> bool {
        let (Some(current), Some(comparing)) = (&self.current, &mut self.comparing) else { return false };
        if !comparing.advance(&current.pipeline, &current.name, budget, &mut self.events) {
            self.comparing = None;
        }
        self.comparing.is_some()
    }

    /// The next event.
    pub fn poll(&mut self) -> Option<Event> {
        self.events.pop_front()
    }

    fn write(&mut self, Writing { name, format, mesh, axes }: Writing) {
        let normals: Vec<Vec3> = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        let carried = self.current.as_ref().and_then(|current| {
            let reduced = current.pipeline.reduced().filter(|reduced| *reduced.mesh == mesh);
            reduced.and(current.pipeline.level_arrays())
        });
        let arrays = carried.map_or(&[][..], |arrays| arrays);
        let output = Output { mesh: &mesh, normals: Some(&normals), arrays, axes };
        self.events.push_back(match io::write_output(&output, format) {
            Ok(bytes) => Event::Written { name, bytes },
            Err(error) => Event::NotWritten { name, message: error.to_string() },
        });
    }

    fn write_level(&mut self, name: String, format: io::Format) {
        match self.current.as_ref().and_then(|current| Some((current.pipeline.reduced()?, current.axes))) {
            Some((reduced, axes)) => {
                let mesh = (*reduced.mesh).clone();
                self.write(Writing { name, format, mesh, axes });
            }
            None => {
                let message = "there is no result yet".to_owned();
                self.events.push_back(Event::NotWritten { name, message });
            }
        }
    }

    fn write_centrelines(&mut self, name: String, format: CentrelineFormat) {
        let vessels = self.current.as_ref().and_then(|current| current.pipeline.vessels());
        self.events.push_back(match vessels {
            Some(Ok(basis)) => Event::Written { name, bytes: basis.centrelines().written(format).into_bytes() },
            Some(Err(error)) => Event::NotWritten { name, message: error.to_string() },
            None => Event::NotWritten { name, message: "the vessels are still being measured".to_owned() },
        });
    }

    /// Reads a source. What was open stays open if that fails.
    fn open(&mut self, id: u64, source: Source, settings: Settings) {
        let start = Instant::now();
        let name = source.name().to_owned();
        let digest = match &source {
            Source::File { bytes, .. } => Some(Digest::of(bytes)),
            Source::Sample { .. } | Source::Made { .. } => None,
        };
        match read(source) {
            Ok(Imported { mesh, arrays, report }) => {
                let mesh = Arc::new(mesh);
                let mut pipeline = Pipeline::new(mesh.clone(), Settings::default()).with_arrays(arrays).with_safe();
                if let Err(error) = pipeline.set(settings) {
                    self.events.push_back(Event::OpenFailed { id, name, message: error.to_string() });
                    return;
                }
                // Those that were asked for before belong to the surface before.
                self.comparing.take_if(|comparing| comparing.id < id);
                let read_ms = start.elapsed().as_secs_f64() * 1e3;
                let since = Instant::now();
                self.current = Some(Current {
                    name: name.clone(),
                    axes: report.axes,
                    pipeline,
                    read_ms,
                    generation: id,
                    reached: id,
                    waiting: None,
                    since,
                    is_stopped: false,
                    has_new_levels: false,
                });
                self.opening.clear();
                self.events.push_back(Event::Opened(Box::new(Opened { id, name, digest, report, mesh })));
            }
            Err(message) => self.events.push_back(Event::OpenFailed { id, name, message }),
        }
    }
}

fn read(source: Source) -> Result<Imported, String> {
    match source {
        Source::File { name, bytes, options } => io::read(&bytes, &name, &options).map_err(|error| error.to_string()),
        Source::Made { format, mesh, .. } => Ok(io::import_mesh(Arc::unwrap_or_clone(mesh), &format)),
        Source::Sample { sample, triangles } => {
            let mesh = phantom::generate(sample, triangles as usize).map_err(|error| error.to_string())?;
            Ok(io::import_mesh(mesh, "sample"))
        }
    }
}

impl Current {
    /// Whether the arrays of the level are still on their way to it: a file of it waits for them.
    fn is_carrying(&self) -> bool {
        let is_coming = self.waiting.is_some() || self.pipeline.level_arrays().is_none();
        self.pipeline.has_arrays() && is_coming && !self.is_stopped
    }

    /// Whether nothing is left but what nobody waits for: the vessels' calibre, and how far is safe.
    fn is_in_background(&self) -> bool {
        self.waiting.is_none() && self.pipeline.next_stage() >= Some(Stage::Vessels)
    }

    /// One step; whether there is more to do.
    fn advance(&mut self, budget: Budget, events: &mut VecDeque<Event>) -> Result<bool, String> {
        self.take_waiting(events).map_err(|error| error.to_string())?;
        if self.is_stopped {
            return Ok(false);
        }
        let generation = self.generation;
        match self.pipeline.advance(budget).map_err(|error| error.to_string())? {
            Advance::Idle => return Ok(self.pipeline.prepare(budget)),
            // Nobody waits for these: they go on in the background, and leave the bar to what is told there.
            Advance::Working(Stage::Vessels | Stage::Certificate | Stage::Safe, _) => {}
            Advance::Working(stage, fraction) => {
                tell_progress(Work::Stage(stage), fraction, events);
            }
            Advance::Finished(Stage::Decimation) => self.has_new_levels = true,
            Advance::Finished(stage @ (Stage::Level | Stage::Deviation | Stage::Measures | Stage::Safe)) => {
                self.reached = generation;
                if let Some(mesh) = self.pipeline.progressive().filter(|_| self.has_new_levels) {
                    let keep = self.pipeline.settings().keep;
                    let reduced = Reduced { generation, keep, mesh: mesh.clone() };
                    events.push_back(Event::Reduced(Box::new(reduced)));
                    self.has_new_levels = false;
                }
                // Shape and lumen come when the deviation is told.
                let has_new_map = !matches!(stage, Stage::Measures | Stage::Safe);
                self.tell_numbers(stage != Stage::Level, has_new_map, events);
            }
            Advance::Finished(Stage::Arrays) => self.tell_arrays(events),
            Advance::Finished(Stage::Certificate) => self.tell_calibre(events),
            Advance::Finished(Stage::Connectivity) => {
                let pieces = self.pipeline.connectivity();
                if let Some(found) = pieces {
                    let labels = found.labels.of_triangle.clone();
                    events.push_back(Event::Pieces { labels, components: found.components.clone() });
                }
            }
            Advance::Finished(_) => {}
        }
        Ok(self.pipeline.next_stage().is_some() || self.waiting.is_some() || self.pipeline.can_prepare())
    }

    /// Goes over to newer settings, unless a result of the present ones is near.
    fn take_waiting(&mut self, events: &mut VecDeque<Event>) -> Result<(), crate::pipeline::settings::SettingsError> {
        let result_is_near = !self.is_stopped
            && self.pipeline.reduced().is_none()
            && self.pipeline.next_stage() > Some(Stage::Connectivity)
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
        report.branches = None;
        let by_node = || self.pipeline.deviations().map_or_else(Vec::new, |found| found.by_node.clone());
        let deviation = with_deviation.then(by_node);
        let generation = self.generation;
        events.push_back(Event::Measured { generation, complete, report: Box::new(report), deviation });
    }

    /// What the file says of the level, if it says something and that is carried to it.
    fn tell_arrays(&self, events: &mut VecDeque<Event>) {
        let carried = self.pipeline.level_arrays().zip(self.pipeline.reduced());
        if let Some((arrays, reduced)) = carried.filter(|(arrays, _)| !arrays.is_empty()) {
            let (generation, values) = (self.generation, arrays::by_vertex(arrays, reduced));
            events.push_back(Event::Carried(Box::new(Carried { generation, values })));
        }
    }

    /// What the level makes of the vessels, if that is known.
    fn tell_calibre(&self, events: &mut VecDeque<Event>) {
        let Some(certified) = self.pipeline.certified() else { return };
        let (found, change_by_node) = match certified {
            Ok(found) => (Ok(found.certificate.clone()), found.change_by_node.clone()),
            Err(error) => (Err(error.to_string()), Vec::new()),
        };
        let generation = self.generation;
        events.push_back(Event::Certified(Box::new(Calibre { generation, found, change_by_node })));
    }
}

impl Machine for Engine {
    type Command = Command;
    type Event = Event;

    fn handle(&mut self, command: Command) {
        self.handle(command);
    }

    fn advance(&mut self, _: f64) -> Option<Duration> {
        self.advance(SLICE).then_some(Duration::ZERO)
    }

    fn poll(&mut self) -> Option<Event> {
        self.poll()
    }
}
