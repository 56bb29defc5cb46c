//! Smoothing as a stage of the pipeline: the filter, or the terms of an earlier run, and then the volume.

use std::sync::Arc;

use web_time::Instant;

use super::volume::{Before, VolumeTask};
use super::{SmoothingTask, Terms};
use crate::mesh::{Topology, TriMesh, Vec3, measures_within};
use crate::pipeline::filter::Filter;
use crate::pipeline::response::{SmoothingResponse, edge_length};
use crate::pipeline::results::{Smoothed, Surface};
use crate::pipeline::settings::{Boundary, Smoothing};
use crate::pipeline::task::{Budget, Progress, Task};

/// Bytes that terms may take. Surfaces of more than about 53,000 vertices at 100 iterations are filtered anew each time.
pub(crate) const TERMS_BYTES: usize = 64_000_000;

/// The terms of a surface, and which they are of.
pub(crate) struct KeptTerms {
    of: Arc<Surface>,
    boundary: Boundary,
    terms: Terms,
}

impl KeptTerms {
    /// Whether another filter for `settings` on `kept` is but a sum of these.
    pub(crate) fn suit(&self, kept: &Arc<Surface>, settings: &Smoothing) -> bool {
        let degree = settings.iterations as usize;
        Arc::ptr_eq(&self.of, kept) && self.boundary == settings.boundary && degree <= self.terms.degree()
    }

    /// Whether the terms of `kept` for `settings` are few enough to be kept.
    pub(crate) fn would_fit(kept: &Surface, settings: &Smoothing) -> bool {
        settings.iterations > 0
            && Terms::bytes(kept.mesh.positions.len(), settings.iterations as usize) <= TERMS_BYTES as u64
    }
}

/// Runs the filter for its terms alone.
pub(crate) struct Preparation {
    kept: Arc<Surface>,
    boundary: Boundary,
    task: SmoothingTask<Arc<Topology>>,
}

impl Preparation {
    pub(crate) fn new(kept: &Arc<Surface>, settings: &Smoothing) -> Self {
        Self { kept: kept.clone(), boundary: settings.boundary, task: keeping(kept, settings, &Filter::new(settings)) }
    }

    /// Works until `budget` is spent; whether all is done.
    pub(crate) fn advance(&mut self, budget: Budget) -> bool {
        matches!(self.task.advance(budget), Progress::Done(_))
    }

    /// The terms of a run that is done.
    pub(crate) fn into_terms(self) -> Option<KeptTerms> {
        kept_terms(self.task, self.kept, self.boundary)
    }
}

fn keeping(kept: &Surface, settings: &Smoothing, filter: &Filter) -> SmoothingTask<Arc<Topology>> {
    let task = SmoothingTask::new(&kept.mesh.positions, kept.topology.clone(), settings.boundary, filter);
    task.keeping_terms(TERMS_BYTES)
}

fn kept_terms(task: SmoothingTask<Arc<Topology>>, of: Arc<Surface>, boundary: Boundary) -> Option<KeptTerms> {
    Some(KeptTerms { of, boundary, terms: task.into_terms()? })
}

/// The stage under way.
pub(crate) struct SmoothingStage {
    kept: Arc<Surface>,
    settings: Smoothing,
    filter: Filter,
    step: Step,
    /// Terms that came of the run, for the next.
    pub(crate) terms: Option<KeptTerms>,
    /// Milliseconds that area and volume of the result took.
    pub(crate) measuring_ms: f64,
}

enum Step {
    Filter(Box<SmoothingTask<Arc<Topology>>>),
    Volume(Box<VolumeTask>),
    Done(Vec<Vec3>, Option<bool>),
}

impl SmoothingStage {
    /// Starts the stage on `kept`; `terms` that suit are used, and with `keeps_terms` new ones kept where they fit.
    pub(crate) fn new(kept: &Arc<Surface>, settings: Smoothing, terms: Option<&KeptTerms>, keeps_terms: bool) -> Self {
        let filter = Filter::new(&settings);
        let step = Step::Done(Vec::new(), None);
        let mut stage = Self { kept: kept.clone(), settings, filter, step, terms: None, measuring_ms: 0.0 };
        stage.step = match terms.filter(|terms| terms.suit(kept, &settings)) {
            Some(known) => stage.after_filter(known.terms.smooth(&stage.filter)),
            None if keeps_terms => Step::Filter(Box::new(keeping(kept, &settings, &stage.filter))),
            None => {
                let task =
                    SmoothingTask::new(&kept.mesh.positions, kept.topology.clone(), settings.boundary, &stage.filter);
                Step::Filter(Box::new(task))
            }
        };
        stage
    }

    /// Works until `budget` is spent or the surface is smoothed.
    pub(crate) fn advance(&mut self, budget: Budget) -> Progress<Smoothed> {
        let share = if self.settings.preserve_volume { 0.5 } else { 1.0 };
        loop {
            let step = std::mem::replace(&mut self.step, Step::Done(Vec::new(), None));
            self.step = match step {
                Step::Filter(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Filter(task);
                        return Progress::Working(fraction * share);
                    }
                    Progress::Done(positions) => {
                        self.terms = kept_terms(*task, self.kept.clone(), self.settings.boundary);
                        self.after_filter(positions)
                    }
                },
                Step::Volume(mut task) => {
                    let advanced = self.before().map(|before| task.advance(&before, budget));
                    match advanced {
                        Some(Progress::Working(fraction)) => {
                            self.step = Step::Volume(task);
                            return Progress::Working(0.5 + fraction / 2.0);
                        }
                        Some(Progress::Done((positions, held))) => Step::Done(positions, Some(held)),
                        None => Step::Done(task.into_smoothed(), Some(false)),
                    }
                }
                Step::Done(positions, held) => return Progress::Done(self.result(positions, held)),
            };
        }
    }

    fn after_filter(&self, positions: Vec<Vec3>) -> Step {
        match self.before() {
            _ if !self.settings.preserve_volume => Step::Done(positions, None),
            Some(before) => {
                Step::Volume(Box::new(VolumeTask::new(&before, positions, self.settings.boundary, &self.filter)))
            }
            None => Step::Done(positions, Some(false)),
        }
    }

    /// The surface before smoothing, if it encloses a volume.
    fn before(&self) -> Option<Before<'_>> {
        let Surface { mesh, topology, loops, measures } = &*self.kept;
        Some(Before { mesh, topology, loops: loops.as_deref()?, volume: measures.volume_mm3? })
    }

    fn result(&mut self, positions: Vec<Vec3>, volume_held: Option<bool>) -> Smoothed {
        let mesh = TriMesh { positions, triangles: self.kept.mesh.triangles.clone() };
        let start = Instant::now();
        let measures = measures_within(&mesh, self.kept.loops.as_deref());
        self.measuring_ms = start.elapsed().as_secs_f64() * 1e3;
        let response = SmoothingResponse::new(&self.filter, self.settings.pass_band, edge_length(&mesh));
        let filter = Some(self.filter.clone());
        Smoothed { mesh: Arc::new(mesh), filter, response: Some(response), volume_held, measures }
    }
}
