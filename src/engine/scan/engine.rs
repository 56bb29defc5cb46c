//! The scan's engine: one volume, its copy at reduced resolution, and what is being made of them.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::super::machine::{Machine, SLICE};
use super::message::{ScanCommand, ScanEvent, ScanWork};
use super::opening::{Found, Opening};
use super::shelf::{Empty, Shelf};
use crate::io::ThresholdReport;
use crate::language::tell;
use crate::mesh::TriMesh;
use crate::say;
use crate::task::{Budget, Progress, Running};
use crate::volume::{
    Cut, Grid, Region, Selection, Survey, VolumeError, half_way, preview_step, reduced_in_slices, region_of, slice,
    surface_in_slices,
};

/// A volume and surfaces of it, as a machine of commands and events.
pub struct ScanEngine {
    shelf: Box<dyn Shelf>,
    /// The newest files, until they are a volume; what is open stands that long.
    opening: Option<Opening>,
    current: Option<Current>,
    events: VecDeque<ScanEvent>,
}

/// A volume that is open.
struct Current {
    grid: Arc<Grid>,
    survey: Survey,
    /// At reduced resolution, and by which step.
    reduced: Option<(usize, Arc<Grid>)>,
    job: Option<Job>,
}

/// What is being made.
enum Job {
    /// For a preview that is asked for, if one is.
    Reducing {
        work: Running<'static, Arc<Grid>>,
        step: usize,
        then: Option<Wanted>,
    },
    Preview {
        work: Surfacing,
        generation: u64,
        step: usize,
    },
    Surface {
        work: Surfacing,
        generation: u64,
        cut: Cut,
    },
}

/// A surface that is being made.
type Surfacing = Running<'static, Result<TriMesh, VolumeError>>;

/// Begins with the surface of a cut.
fn surfacing(grid: &Arc<Grid>, cut: Cut) -> Result<Surfacing, VolumeError> {
    region_of(grid, cut.region)?;
    let grid = Arc::clone(grid);
    Ok(Running::new(move |yielder| async move { surface_in_slices(&grid, cut, &yielder).await }))
}

/// A preview that is asked for.
#[derive(Clone, Copy)]
struct Wanted {
    generation: u64,
    cut: Cut,
}

impl ScanEngine {
    /// An engine with nothing open, which is given the bytes of files.
    pub fn new() -> Self {
        Self::with_shelf(Empty)
    }

    /// An engine with nothing open, which can read the files on a shelf.
    pub fn with_shelf(shelf: impl Shelf + 'static) -> Self {
        Self { shelf: Box::new(shelf), opening: None, current: None, events: VecDeque::new() }
    }

    fn refuse(&mut self, number: u64, sentence: impl Into<String>) {
        self.events.push_back(ScanEvent::Refused { number, sentence: sentence.into() });
    }

    /// Goes on with opening; whether there is more to do.
    fn open(&mut self, budget: Budget) -> bool {
        let Some(mut opening) = self.opening.take() else { return false };
        match opening.advance(&mut *self.shelf, budget) {
            Ok(Progress::Working(fraction)) => {
                self.tell(opening.work(), fraction);
                self.opening = Some(opening);
            }
            Ok(Progress::Done(Found { grid, mut opened })) => {
                opened.proposed = opened.survey.is_mask().then_some(Selection::AnyLabel);
                let mut current = Current { grid, survey: opened.survey.clone(), reduced: None, job: None };
                current.reduce(preview_step(current.grid.geometry().points()), None);
                self.current = Some(current);
                self.events.push_back(ScanEvent::Opened(opened));
            }
            Err(sentence) => self.refuse(opening.id, sentence),
        }
        self.opening.is_some()
    }

    /// The volume that is open, or a sentence on why there is none.
    fn current(&mut self, number: u64) -> Option<&mut Current> {
        if self.current.is_none() {
            self.refuse(number, say!("scan-none-open"));
            return None;
        }
        self.current.as_mut()
    }

    fn begin_preview(&mut self, wanted: Wanted, step: Option<usize>) {
        let Some(current) = self.current(wanted.generation) else { return };
        if let Err(error) = current.begin_preview(wanted, step) {
            self.refuse(wanted.generation, tell(&error));
        }
    }

    fn begin_surface(&mut self, generation: u64, cut: Cut) {
        let Some(current) = self.current(generation) else { return };
        match cut.selection.check(&current.survey).and_then(|()| surfacing(&current.grid, cut)) {
            Ok(work) => current.job = Some(Job::Surface { work, generation, cut }),
            Err(error) => self.refuse(generation, tell(&error)),
        }
    }

    fn picture(&mut self, axis: crate::volume::Axis, index: usize, window: [f64; 2]) {
        let picture = self.current.as_ref().and_then(|current| slice(&current.grid, axis, index, window));
        match picture {
            Some(crate::volume::Slice { size, pixels, corners }) => {
                self.events.push_back(ScanEvent::Slice { axis, index, size, pixels, window, corners });
            }
            None => self.refuse(0, say!("scan-no-slice")),
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
            (Job::Reducing { step, then, .. }, Made::Reduced(grid)) => {
                current.reduced = Some((step, grid));
                if let Some(wanted) = then {
                    self.begin_preview(wanted, Some(step));
                }
            }
            (Job::Preview { generation, step, .. }, Made::Surface(Ok(mesh))) => {
                self.events.push_back(ScanEvent::Preview { generation, step, mesh: Arc::new(mesh) });
            }
            (Job::Surface { generation, cut, .. }, Made::Surface(Ok(mesh))) => {
                let threshold = ThresholdReport::new(&current.grid, &mesh, cut.selection);
                self.events.push_back(ScanEvent::Surface { generation, mesh: Arc::new(mesh), threshold });
            }
            (Job::Preview { generation, .. } | Job::Surface { generation, .. }, Made::Surface(Err(error))) => {
                self.refuse(generation, tell(&error));
            }
            _ => unreachable!("a job makes what it is for"),
        }
    }
}

/// What a job makes.
enum Made {
    Reduced(Arc<Grid>),
    Surface(Result<TriMesh, VolumeError>),
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
            Self::Reducing { work, .. } => made(work.advance(budget), Made::Reduced),
            Self::Preview { work, .. } | Self::Surface { work, .. } => made(work.advance(budget), Made::Surface),
        }
    }

    /// What it is for, where somebody waits for it.
    fn work(&self) -> Option<ScanWork> {
        match self {
            Self::Reducing { then, .. } => then.map(|_| ScanWork::Preview),
            Self::Preview { .. } => Some(ScanWork::Preview),
            Self::Surface { .. } => Some(ScanWork::Surface),
        }
    }
}

impl Current {
    /// Begins a copy at reduced resolution.
    fn reduce(&mut self, step: usize, then: Option<Wanted>) {
        let (grid, is_mask) = (Arc::clone(&self.grid), self.survey.is_mask());
        let work =
            Running::new(
                move |yielder| async move { Arc::new(reduced_in_slices(&grid, step, is_mask, &yielder).await) },
            );
        self.job = Some(Job::Reducing { work, step, then });
    }

    /// Begins a preview, or the copy that it takes.
    fn begin_preview(&mut self, wanted: Wanted, step: Option<usize>) -> Result<(), VolumeError> {
        let step = step.unwrap_or_else(|| preview_step(self.grid.geometry().points())).max(1);
        wanted.cut.selection.check(&self.survey)?;
        match &self.reduced {
            Some((known, grid)) if *known == step => {
                let region = wanted.cut.region.map(|Region { first, last }| Region {
                    first: first.map(|first| first / step),
                    // A thin box holds two of the coarser points at least.
                    last: std::array::from_fn(|axis| last[axis].div_ceil(step).max(first[axis] / step + 1)),
                });
                let seed = wanted.cut.seed.map(|seed| seed.map(|along| along / step));
                let work = surfacing(grid, Cut { region, seed, ..wanted.cut })?;
                self.job = Some(Job::Preview { work, generation: wanted.generation, step });
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

impl Default for ScanEngine {
    fn default() -> Self {
        Self::new()
    }
}

impl Machine for ScanEngine {
    type Command = ScanCommand;
    type Event = ScanEvent;

    /// Takes a command. Nothing long happens here but a slice's picture or the rays from a seed, a few milliseconds.
    fn handle(&mut self, command: ScanCommand) {
        match command {
            ScanCommand::Open { id, files, volume } => {
                let opening = Opening::new(id, files, volume);
                if let Some(first) = opening.first_number() {
                    self.shelf.forget_before(first);
                }
                self.opening = Some(opening);
            }
            ScanCommand::Preview { generation, cut, step } => self.begin_preview(Wanted { generation, cut }, step),
            ScanCommand::Surface { generation, cut } => self.begin_surface(generation, cut),
            ScanCommand::HalfWay { seed } => {
                let found = self.current.as_ref().and_then(|current| half_way(&current.grid, seed));
                self.events.push_back(ScanEvent::HalfWay { seed, found });
            }
            ScanCommand::Slice { axis, index, window } => self.picture(axis, index, window),
            ScanCommand::Close => (self.opening, self.current) = (None, None),
            ScanCommand::Cancel => {
                // What was open before goes on.
                if self.opening.take().is_none()
                    && let Some(current) = &mut self.current
                {
                    current.job = None;
                }
                self.events.push_back(ScanEvent::Cancelled);
            }
        }
    }

    /// What is read whole is understood in one piece, which may take longer than a slice of work.
    fn advance(&mut self, _: f64) -> Option<Duration> {
        let budget = Budget::new(SLICE);
        let is_busy = self.open(budget) || self.work(budget);
        is_busy.then_some(Duration::ZERO)
    }

    fn poll(&mut self) -> Option<ScanEvent> {
        self.events.pop_front()
    }

    fn is_passing(event: &ScanEvent) -> bool {
        matches!(event, ScanEvent::Progress { .. })
    }
}
