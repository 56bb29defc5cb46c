//! The scan's engine: one volume, its copy at reduced resolution, and what is being made of them.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::super::machine::{Machine, SLICE};
use super::message::{NamedFile, OpenedScan, ScanCommand, ScanEvent, ScanWork};
use crate::io::Axes;
use crate::io::volume::{self, Part};
use crate::task::{Budget, Progress, Task};
use crate::volume::{
    Grid, Reducing, Region, Selection, Surfacing, Survey, Surveying, VolumeError, preview_step, slice,
};

/// A volume and surfaces of it, as a machine of commands and events.
#[derive(Default)]
pub struct ScanEngine {
    /// The newest files to be read.
    opening: Option<(u64, Vec<NamedFile>)>,
    current: Option<Current>,
    events: VecDeque<ScanEvent>,
}

/// A volume that was read.
struct Current {
    grid: Arc<Grid>,
    /// What is said of it once it is surveyed.
    survey: Option<Survey>,
    /// At reduced resolution, and by which step.
    reduced: Option<(usize, Arc<Grid>)>,
    job: Option<Job>,
}

/// What is being made.
enum Job {
    Surveying {
        task: Surveying,
        opened: Box<OpenedScan>,
    },
    /// For a preview that is asked for, if one is.
    Reducing {
        task: Reducing,
        step: usize,
        then: Option<Wanted>,
    },
    Preview {
        task: Surfacing,
        generation: u64,
        step: usize,
    },
    Surface {
        task: Surfacing,
        generation: u64,
    },
}

/// A preview that is asked for.
#[derive(Clone, Copy)]
struct Wanted {
    generation: u64,
    selection: Selection,
    region: Option<Region>,
}

impl ScanEngine {
    /// An engine with nothing open.
    pub fn new() -> Self {
        Self::default()
    }

    fn refuse(&mut self, number: u64, sentence: impl Into<String>) {
        self.events.push_back(ScanEvent::Refused { number, sentence: sentence.into() });
    }

    fn open(&mut self, id: u64, files: &[NamedFile]) {
        let parts: Vec<Part> = files.iter().map(|file| Part { name: &file.name, bytes: &file.bytes }).collect();
        match volume::read(&parts) {
            Ok(scan) => {
                let geometry = *scan.grid.geometry();
                let grid = Arc::new(scan.grid);
                let opened = Box::new(OpenedScan {
                    id,
                    format: scan.format.to_owned(),
                    dimensions: geometry.size,
                    spacing_mm: geometry.spacing.to_array(),
                    origin_mm: geometry.origin.to_array(),
                    directions: geometry.direction.to_cols_array_2d(),
                    is_ct: scan.is_ct,
                    survey: Survey { range: [0.0; 2], histogram: Vec::new(), labels: Vec::new() },
                    proposed: None,
                    warnings: scan.warnings,
                });
                let job = Some(Job::Surveying { task: Surveying::new(Arc::clone(&grid)), opened });
                self.current = Some(Current { grid, survey: None, reduced: None, job });
            }
            Err(error) => self.refuse(id, error.to_string()),
        }
    }

    /// The surveyed volume, or a sentence on why there is none.
    fn surveyed(&mut self, number: u64) -> Option<&mut Current> {
        if self.current.as_ref().is_none_or(|current| current.survey.is_none()) {
            self.refuse(number, "No scan is open yet.");
            return None;
        }
        self.current.as_mut()
    }

    fn begin_preview(&mut self, wanted: Wanted, step: Option<usize>) {
        let Some(current) = self.surveyed(wanted.generation) else { return };
        if let Err(error) = current.begin_preview(wanted, step) {
            self.refuse(wanted.generation, error.to_string());
        }
    }

    fn begin_surface(&mut self, generation: u64, selection: Selection, region: Option<Region>) {
        let Some(current) = self.surveyed(generation) else { return };
        let checked = current.survey.as_ref().map_or(Ok(()), |survey| selection.check(survey));
        match checked.and_then(|()| Surfacing::new(&current.grid, selection, region)) {
            Ok(task) => current.job = Some(Job::Surface { task, generation }),
            Err(error) => self.refuse(generation, error.to_string()),
        }
    }

    fn picture(&mut self, axis: crate::volume::Axis, index: usize, window: [f64; 2]) {
        let picture = self.current.as_ref().and_then(|current| slice(&current.grid, axis, index, window));
        match picture {
            Some(crate::volume::Slice { size, pixels, corners }) => {
                self.events.push_back(ScanEvent::Slice { axis, index, size, pixels, corners });
            }
            None => self.refuse(0, "There is no such slice."),
        }
    }

    /// Says how far the work is; of several words in a row only the last is kept.
    fn tell(&mut self, work: ScanWork, fraction: f32) {
        let event = ScanEvent::Progress { work, fraction };
        match self.events.back_mut() {
            Some(last @ ScanEvent::Progress { .. }) => *last = event,
            _ => self.events.push_back(event),
        }
    }

    /// Goes on with what is being made; whether there is more to do.
    fn work(&mut self, budget: Budget) -> bool {
        let Some(current) = &mut self.current else { return false };
        let Some(mut job) = current.job.take() else { return false };
        match job.advance(budget) {
            Progress::Working(fraction) => {
                let work = job.work();
                current.job = Some(job);
                // A smaller copy is made while nobody waits for it, too.
                if let Some(work) = work {
                    self.tell(work, fraction);
                }
            }
            Progress::Done(made) => self.made(job, made),
        }
        self.current.as_ref().is_some_and(|current| current.job.is_some())
    }

    /// Passes on what a job made, and begins what follows it.
    fn made(&mut self, job: Job, made: Made) {
        let Some(current) = &mut self.current else { return };
        match (job, made) {
            (Job::Surveying { mut opened, .. }, Made::Survey(survey)) => {
                opened.proposed = survey.is_mask().then_some(Selection::AnyLabel);
                opened.survey = survey.clone();
                current.survey = Some(survey);
                current.reduce(preview_step(current.grid.geometry().points()), None);
                self.events.push_back(ScanEvent::Opened(opened));
            }
            (Job::Reducing { step, then, .. }, Made::Reduced(grid)) => {
                current.reduced = Some((step, grid));
                if let Some(wanted) = then {
                    self.begin_preview(wanted, Some(step));
                }
            }
            (Job::Preview { generation, step, .. }, Made::Surface(Ok(mesh))) => {
                self.events.push_back(ScanEvent::Preview { generation, step, mesh: Arc::new(mesh) });
            }
            (Job::Surface { generation, .. }, Made::Surface(Ok(mesh))) => {
                self.events.push_back(ScanEvent::Surface { generation, mesh: Arc::new(mesh), axes: Axes::Lps });
            }
            (Job::Preview { generation, .. } | Job::Surface { generation, .. }, Made::Surface(Err(error))) => {
                self.refuse(generation, error.to_string());
            }
            _ => unreachable!("a job makes what it is for"),
        }
    }
}

/// What a job makes.
enum Made {
    Survey(Survey),
    Reduced(Arc<Grid>),
    Surface(Result<crate::mesh::TriMesh, VolumeError>),
}

impl Job {
    fn advance(&mut self, budget: Budget) -> Progress<Made> {
        fn made<T>(progress: Progress<T>, as_made: impl FnOnce(T) -> Made) -> Progress<Made> {
            match progress {
                Progress::Working(fraction) => Progress::Working(fraction),
                Progress::Done(output) => Progress::Done(as_made(output)),
            }
        }
        match self {
            Self::Surveying { task, .. } => made(task.advance(budget), Made::Survey),
            Self::Reducing { task, .. } => made(task.advance(budget), Made::Reduced),
            Self::Preview { task, .. } | Self::Surface { task, .. } => made(task.advance(budget), Made::Surface),
        }
    }

    /// What it is for, where somebody waits for it.
    fn work(&self) -> Option<ScanWork> {
        match self {
            Self::Surveying { .. } => Some(ScanWork::Surveying),
            Self::Reducing { then, .. } => then.map(|_| ScanWork::Preview),
            Self::Preview { .. } => Some(ScanWork::Preview),
            Self::Surface { .. } => Some(ScanWork::Surface),
        }
    }
}

impl Current {
    /// Begins a copy at reduced resolution.
    fn reduce(&mut self, step: usize, then: Option<Wanted>) {
        let is_mask = self.survey.as_ref().is_some_and(Survey::is_mask);
        let task = Reducing::new(Arc::clone(&self.grid), step, is_mask);
        self.job = Some(Job::Reducing { task, step, then });
    }

    /// Begins a preview, or the copy that it takes.
    fn begin_preview(&mut self, wanted: Wanted, step: Option<usize>) -> Result<(), VolumeError> {
        let step = step.unwrap_or_else(|| preview_step(self.grid.geometry().points())).max(1);
        if let Some(survey) = &self.survey {
            wanted.selection.check(survey)?;
        }
        match &self.reduced {
            Some((known, grid)) if *known == step => {
                let region = wanted.region.map(|Region { first, last }| Region {
                    first: first.map(|first| first / step),
                    last: last.map(|last| last / step),
                });
                let task = Surfacing::new(grid, wanted.selection, region)?;
                self.job = Some(Job::Preview { task, generation: wanted.generation, step });
            }
            _ => match &mut self.job {
                // It is being made already.
                Some(Job::Reducing { step: making, then, .. }) if *making == step => *then = Some(wanted),
                _ => self.reduce(step, Some(wanted)),
            },
        }
        Ok(())
    }
}

impl Machine for ScanEngine {
    type Command = ScanCommand;
    type Event = ScanEvent;

    /// Takes a command. Nothing long happens here but a slice's picture, a few milliseconds.
    fn handle(&mut self, command: ScanCommand) {
        match command {
            ScanCommand::Open { id, files } => self.opening = Some((id, files)),
            ScanCommand::Preview { generation, selection, region, step } => {
                self.begin_preview(Wanted { generation, selection, region }, step);
            }
            ScanCommand::Surface { generation, selection, region } => self.begin_surface(generation, selection, region),
            ScanCommand::Slice { axis, index, window } => self.picture(axis, index, window),
            ScanCommand::Close => (self.opening, self.current) = (None, None),
            ScanCommand::Cancel => {
                self.opening = None;
                // A volume that is not surveyed yet is given up with what is being made of it.
                self.current.take_if(|current| current.survey.is_none());
                if let Some(current) = &mut self.current {
                    current.job = None;
                }
                self.events.push_back(ScanEvent::Cancelled);
            }
        }
    }

    /// Reading is one piece and may take longer than a slice of work.
    fn advance(&mut self, _: f64) -> Option<Duration> {
        if let Some((id, files)) = self.opening.take() {
            self.open(id, &files);
        }
        self.work(Budget::new(SLICE)).then_some(Duration::ZERO)
    }

    fn poll(&mut self) -> Option<ScanEvent> {
        self.events.pop_front()
    }

    fn is_passing(event: &ScanEvent) -> bool {
        matches!(event, ScanEvent::Progress { .. })
    }
}
