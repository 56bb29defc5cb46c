//! The pipeline as commands and events: one opened surface (`current`), what else is asked of it, and files to be made of it.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::averaging::Averaging;
use super::beside::Besiding;
use super::compare::Comparing;
use super::current::Current;
use super::differing::Differing;
use super::found::Opened;
use super::machine::{Machine, SLICE};
use super::message::{Command, Event, Work};
use super::opening::{Opening, Read};
use super::preparing::{Made, Preparing, written};
use super::progress::tell_progress;
use super::record::{self, Animation, Asked, Origin};
use super::source::Source;
use crate::io::{self, Axes, Imported, Output};
use crate::language::{Key, tell};
use crate::mesh::{Array, TriMesh, Vec3};
use crate::pipeline::coarser::halved;
use crate::pipeline::normals::{Weighting, vertex_normals};
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::Settings;
use crate::say;
use crate::task::{Budget, Progress, milliseconds};
use crate::vessel::CentrelineFormat;

/// What is said of a file whose surface was another by the time that it was written.
const NOT_CARRIED: Key = Key("errors-not-carried");

/// The pipeline as a machine of commands and events.
#[derive(Default)]
pub struct Engine {
    /// Files to be opened, with the settings to begin with: the newest is, those before it only if it cannot be read.
    opening: Vec<(u64, Source, Settings)>,
    /// The one that is being read; those that come meanwhile wait until it is.
    reading: Option<Box<Opening>>,
    current: Option<Current>,
    /// Settings to compare on the surface that is open, or is opened next.
    pub(super) comparing: Option<Comparing>,
    /// Two of their surfaces that are measured against each other.
    differing: Option<Differing>,
    /// A surface that is compared with another file.
    besiding: Option<Besiding>,
    /// Plain Laplacian smoothing, to be seen beside the filter.
    averaging: Option<Averaging>,
    /// A surface on its way to a solver.
    preparing: Option<Preparing>,
    /// The one that is ready.
    prepared: Option<Made>,
    writing: VecDeque<Writing>,
    animation: Animation,
    events: VecDeque<Event>,
}

/// A file to be written.
struct Writing {
    name: String,
    format: io::Format,
    mesh: TriMesh,
    axes: Axes,
    to: Axes,
}

/// The arrays of the newest level, where that is `mesh`.
fn level_arrays(current: &Current, mesh: &TriMesh) -> Option<Arc<Vec<Array>>> {
    let reduced = current.pipeline.reduced().filter(|reduced| *reduced.mesh == *mesh);
    reduced.and(current.pipeline.level_arrays()).cloned()
}

impl Engine {
    /// An engine with nothing open.
    pub fn new() -> Self {
        Self::default()
    }

    /// Another engine with the same surface open, and all that this one, which is at rest, has made of it: shared, not copied.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self { current: self.current.as_ref().map(Current::fork), ..Self::default() }
    }

    /// Takes a command. Nothing long happens here, but for a report and a frame of a picture: some tens of milliseconds.
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
                let before = self.comparing.take().filter(|_| !self.is_opening());
                self.comparing = Some(match before {
                    Some(before) => comparing.after(before),
                    None => comparing,
                });
            }
            Command::Differ { id, first, other } => self.differing = Some(Differing::new(id, first, other)),
            Command::Beside { id, reference, mesh, of, align, tolerance_percent } => {
                self.besiding = Some(Besiding::new(id, reference, mesh, of, (align, tolerance_percent)));
            }
            Command::Average { id, passes } => self.averaging = Some(Averaging::new(id, passes)),
            Command::Prepare { id, mesh, plan } => self.preparing = Some(Preparing::Asked(id, mesh, plan)),
            Command::PlanCuts { id, mesh, plan } => self.preparing = Some(Preparing::cuts(id, mesh, plan)),
            Command::WriteSolver { id, name, format, names } => {
                let ready = self.prepared.as_ref().filter(|made| made.id == id);
                let not_carried = format.has_arrays() && ready.is_some_and(|made| made.arrays.is_none());
                let left_out = (not_carried && self.has_arrays()).then(|| NOT_CARRIED.say());
                let ready = ready.ok_or_else(|| say!("errors-no-result"));
                self.events.push_back(match ready.and_then(|made| written(made, &name, names, format)) {
                    Ok(bytes) => Event::Written { name, bytes, left_out },
                    Err(message) => Event::NotWritten { name, message },
                });
            }
            Command::Cancel => self.cancel(),
            Command::WriteCentrelines { name, format } => self.write_centrelines(name, format),
            Command::WriteLevel { name, format } => self.write_level(name, format),
            Command::WriteLevels { name, axes, to } => self.write_levels(name, axes, to),
            Command::WriteReport { name, format, heading, axes, measures, patches, pictures } => {
                self.write_report(name, Asked { format, heading, axes, measures, patches, pictures });
            }
            Command::WriteFrame { name, index, count, has_alpha, frame } => {
                self.events.extend(self.animation.take(name, [index, count], has_alpha, frame));
            }
            Command::Write { name, format, mesh, axes, to } => {
                self.writing.push_back(Writing { name, format, mesh, axes, to });
            }
        }
    }

    fn cancel(&mut self) {
        self.opening.clear();
        self.reading = None;
        (self.comparing, self.differing, self.preparing, self.besiding) = (None, None, None, None);
        if let Some(current) = &mut self.current {
            current.waiting = None;
            current.pipeline.cancel();
            current.is_stopped = true;
            current.has_new_levels = false;
            if current.pipeline.reduced().is_some() {
                current.generation = current.reached;
            }
            // What was gone back to may be another surface than that of the settings in between.
            if current.tell_mended(&mut self.events) {
                current.tell_pieces(&mut self.events);
            }
            let (generation, settings) = (current.generation, current.pipeline.settings().clone());
            self.events.push_back(Event::Cancelled { generation, settings });
        }
    }

    /// Works for about `slice` and says whether there is more to do. Writing a file is one piece and may take longer; so may,
    /// for surfaces of a million triangles, the JSON of a glTF text, the end of parsing and of an import, the parts of
    /// connectivity and the beginning and end of smoothing and decimation (tens of milliseconds).
    pub fn advance(&mut self, slice: Duration) -> bool {
        let budget = Budget::new(slice);
        if let Some(writing) = self.writing.pop_front_if(|_| !self.current.as_ref().is_some_and(Current::is_carrying)) {
            self.write(writing);
        } else if self.is_opening() {
            self.open(budget);
        } else if self.is_asked_more() && self.current.as_ref().is_some_and(Current::is_in_background) {
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
        self.is_opening() || self.current.is_some() || !self.writing.is_empty()
    }

    /// Whether something beside the settings in force is asked for.
    fn is_asked_more(&self) -> bool {
        self.preparing.is_some()
            || self.besiding.is_some()
            || self.comparing.is_some()
            || self.differing.is_some()
            || self.averaging.is_some()
    }

    /// Goes on with a surface for a solver, then with one beside another file, then with plain Laplacian smoothing, then with the settings to compare, then with
    /// how far apart two surfaces are; whether there is more to do.
    fn compare(&mut self, budget: Budget) -> bool {
        let Some(current) = &self.current else { return false };
        let events = &mut self.events;
        let can_average = current.pipeline.kept().is_some();
        if let Some(preparing) = &mut self.preparing {
            if !preparing.advance(budget, |mesh| level_arrays(current, mesh), &mut self.prepared, events) {
                self.preparing = None;
            }
        } else if let Some(besiding) = &mut self.besiding {
            if !besiding.advance(budget, events) {
                self.besiding = None;
            }
        } else if let Some(averaging) = self.averaging.as_mut().filter(|_| can_average) {
            if !averaging.advance(&current.pipeline, budget, events) {
                self.averaging = None;
            }
        } else if let Some(comparing) = &mut self.comparing {
            if !comparing.advance(&current.pipeline, &current.name, budget, events) {
                self.comparing = None;
            }
        } else {
            self.differing.take_if(|differing| !differing.advance(budget, events));
        }
        self.comparing.is_some()
            || self.differing.is_some()
            || self.besiding.is_some()
            || self.preparing.is_some()
            || can_average && self.averaging.is_some()
    }

    /// The next event.
    pub fn poll(&mut self) -> Option<Event> {
        self.events.pop_front()
    }

    fn has_arrays(&self) -> bool {
        self.current.as_ref().is_some_and(|current| current.pipeline.has_arrays())
    }

    fn write(&mut self, Writing { name, format, mut mesh, axes, to }: Writing) {
        let mut normals: Vec<Vec3> = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        let carried = self.current.as_ref().and_then(|current| level_arrays(current, &mesh));
        let has_arrays = self.has_arrays();
        let left_out = match carried {
            None => has_arrays.then(|| NOT_CARRIED.say()),
            Some(ref arrays) => io::left_out(arrays, format).map(|arrays| tell(&arrays)),
        };
        let mut arrays = Cow::Borrowed(carried.as_deref().map_or(&[][..], |arrays| arrays));
        let turned = if axes == to { Ok(()) } else { axes.turn(to, &mut mesh, &mut normals, arrays.to_mut()) };
        let written = turned.map_err(|error| tell(&error)).and_then(|()| {
            let output = Output { mesh: &mesh, normals: Some(&normals), arrays: &arrays, axes: to };
            io::write_output(&output, format).map_err(|error| tell(&error))
        });
        self.events.push_back(match written {
            Ok(bytes) => Event::Written { name, bytes, left_out },
            Err(message) => Event::NotWritten { name, message },
        });
    }

    fn write_level(&mut self, name: String, format: io::Format) {
        match self.current.as_ref().and_then(|current| Some((current.pipeline.reduced()?, current.origin.import.axes)))
        {
            Some((reduced, axes)) => {
                let mesh = (*reduced.mesh).clone();
                self.write(Writing { name, format, mesh, axes, to: axes });
            }
            None => {
                let message = say!("errors-no-result");
                self.events.push_back(Event::NotWritten { name, message });
            }
        }
    }

    fn write_levels(&mut self, name: String, axes: Axes, to: Axes) {
        let has_arrays = self.current.as_ref().is_some_and(|current| current.pipeline.has_arrays());
        let current = self.current.as_ref().ok_or_else(|| say!("errors-no-result"));
        let written = current.and_then(|current| {
            let pipeline = &current.pipeline;
            let both = pipeline.reduced().zip(pipeline.progressive());
            let (reduced, levels) = both.ok_or_else(|| say!("errors-no-result"))?;
            let mut all = vec![((*reduced.mesh).clone(), reduced.normals.clone())];
            all.extend(halved(levels, reduced.mesh.triangles.len()));
            let mut turned = all.iter_mut();
            turned
                .try_for_each(|(mesh, normals)| axes.turn(to, mesh, normals, &mut []))
                .map_err(|error| tell(&error))?;
            let output = |(mesh, normals)| Output { normals: Some(normals), axes: to, ..Output::new(mesh) };
            let outputs: Vec<_> = all.iter().map(|(mesh, normals)| output((mesh, &normals[..]))).collect();
            io::write_levels(&outputs).map_err(|error| tell(&error))
        });
        self.events.push_back(match written {
            Ok(bytes) => Event::Written { name, bytes, left_out: has_arrays.then(|| NOT_CARRIED.say()) },
            Err(message) => Event::NotWritten { name, message },
        });
    }

    fn write_report(&mut self, name: String, asked: Asked) {
        let current = self.current.as_ref().ok_or_else(|| say!("errors-no-result"));
        let made = current.and_then(|of| record::report(&of.name, &of.pipeline, &of.origin, asked));
        self.events.push_back(match made {
            Ok(bytes) => Event::Written { name, bytes, left_out: None },
            Err(message) => Event::NotWritten { name, message },
        });
    }

    fn write_centrelines(&mut self, name: String, format: CentrelineFormat) {
        let vessels = self.current.as_ref().and_then(|current| current.pipeline.vessels());
        self.events.push_back(match vessels {
            Some(Ok(basis)) => {
                let bytes = basis.centrelines().written(format).into_bytes();
                Event::Written { name, bytes, left_out: None }
            }
            Some(Err(error)) => Event::NotWritten { name, message: tell(error) },
            None => Event::NotWritten { name, message: say!("errors-not-measured") },
        });
    }

    /// Whether a source is on its way in.
    fn is_opening(&self) -> bool {
        self.reading.is_some() || !self.opening.is_empty()
    }

    /// Reads the newest source. What was open stays open if that fails.
    fn open(&mut self, budget: Budget) {
        let next = || self.opening.pop().map(|(id, source, settings)| Box::new(Opening::new(id, source, settings)));
        let Some(mut opening) = self.reading.take().or_else(next) else { return };
        match opening.advance(budget) {
            Progress::Working(fraction) => {
                tell_progress(Work::Reading, fraction, &mut self.events);
                self.reading = Some(opening);
            }
            Progress::Done(Ok(read)) => self.opened(*opening, read),
            Progress::Done(Err(message)) => {
                self.events.push_back(Event::OpenFailed { id: opening.id, name: opening.name, message });
            }
        }
    }

    /// What was read takes the place of what is open.
    fn opened(&mut self, opening: Opening, read: Read) {
        let Opening { id, name, settings, since, has_units, .. } = opening;
        let Read { imported: Imported { mesh, arrays, report }, digest } = read;
        let mesh = Arc::new(mesh);
        let mut pipeline = Pipeline::new(mesh.clone(), Settings::default()).with_arrays(arrays).with_safe();
        if let Err(error) = pipeline.set(settings) {
            self.events.push_back(Event::OpenFailed { id, name, message: tell(&error) });
            return;
        }
        // Those that were asked for before belong to the surface before.
        self.comparing.take_if(|comparing| comparing.id < id);
        self.differing.take_if(|differing| differing.id < id);
        self.averaging.take_if(|averaging| averaging.id < id);
        self.preparing.take_if(|preparing| preparing.id() < id);
        self.besiding.take_if(|besiding| besiding.id < id);
        let origin = Origin { digest, import: report.clone(), has_units };
        self.current = Some(Current::new(id, name.clone(), origin, pipeline, milliseconds(since)));
        // What came meanwhile is newer.
        self.opening.retain(|(other, ..)| *other > id);
        self.events.push_back(Event::Opened(Box::new(Opened { id, name, digest, report, mesh })));
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
