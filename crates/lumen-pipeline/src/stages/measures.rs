//! The measures as two stages: shape and lumen of the smoothed surface and of a level. They are no part of the method.
//!
//! What belongs to the smoothed surface (its shape, samples of its vessels, the rate at which the first is pinched) is
//! measured once and kept from level to level.

use std::sync::Arc;

use super::running::Run;
use crate::lumen::{Sample, Sampling, narrowing};
use crate::pinch::PinchTask;
use crate::progressive::ProgressiveMesh;
use crate::results::{LevelMeasures, SmoothedMeasures};
use crate::settings::SettingsError;
use crate::shape::{Measured, Shape, ShapeTask};
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use lumen_mesh::{InnerRadii, SurfaceIndex, Topology, TriMesh};

/// Samples between two looks at the clock, and inner balls that may become some.
const SAMPLES: usize = 256;
const BALLS: usize = 4096;

/// The part of the work that the smoothed surface is, where it is to be measured.
const SMOOTHED: f32 = 0.9;

/// A surface, its adjacency and, if there is one, an index of it in the numbering of a mesh of its own.
#[derive(Clone, Debug)]
struct Subject {
    mesh: Arc<TriMesh>,
    topology: Arc<Topology>,
    /// The index, and the mesh that it is of.
    index: Option<(Arc<TriMesh>, Arc<SurfaceIndex>)>,
}

impl Subject {
    fn task(&self) -> ShapeTask<Arc<TriMesh>, Arc<Topology>> {
        let task = ShapeTask::new(self.mesh.clone(), self.topology.clone());
        match &self.index {
            Some((indexed, index)) => task.with_index(indexed.clone(), index.clone()),
            None => task,
        }
    }
}

/// The measuring of the smoothed surface, in slices.
pub(super) struct OfSmoothed {
    subject: Subject,
    progressive: Arc<ProgressiveMesh>,
    shape: ShapeTask<Arc<TriMesh>, Arc<Topology>>,
    step: Step,
}

/// How far it is, and what was found before.
enum Step {
    Shape,
    /// Which of the inner balls may be samples.
    Balls(Shape, InnerRadii, Sampling),
    Samples(Shape, Sampling),
    /// The search for the first pinch.
    Pinch(Shape, Arc<[Sample]>, Box<PinchTask<Arc<ProgressiveMesh>>>),
}

impl OfSmoothed {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (kept, smoothed, levels) = (now.kept.as_ref()?, now.smoothed.as_ref()?, now.levels.as_ref()?);
        let index = now.indices.finest.clone().map(|index| (levels.finest.clone(), index));
        let subject = Subject { mesh: smoothed.mesh.clone(), topology: kept.topology.clone(), index };
        let shape = if smoothed.crosses_nothing { subject.task().without_crossings() } else { subject.task() };
        Some(Self { subject, progressive: levels.progressive.clone(), shape, step: Step::Shape })
    }

    fn search(&self, shape: Shape, samples: Vec<Sample>) -> Step {
        let samples: Arc<[Sample]> = samples.into();
        let pinch = PinchTask::new(self.progressive.clone(), samples.clone());
        Step::Pinch(shape, samples, Box::new(pinch))
    }
}

impl Run for OfSmoothed {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        let (step, fraction) = match std::mem::replace(&mut self.step, Step::Shape) {
            Step::Shape => match self.shape.advance(budget) {
                Progress::Working(fraction) => (Step::Shape, 0.4 * fraction),
                Progress::Done(Measured { shape, balls, .. }) => {
                    (Step::Balls(shape, balls, Sampling::new(&self.subject.mesh)), 0.4)
                }
            },
            Step::Balls(shape, balls, mut sampling) => {
                let Subject { mesh, topology, .. } = &self.subject;
                let mut is_done = sampling.choose(mesh, topology, &balls, BALLS);
                while !is_done && !budget.is_spent() {
                    is_done = sampling.choose(mesh, topology, &balls, BALLS);
                }
                (if is_done { Step::Samples(shape, sampling) } else { Step::Balls(shape, balls, sampling) }, 0.4)
            }
            Step::Samples(shape, mut sampling) => match self.shape.index() {
                Some(index) => {
                    let mut is_done = sampling.advance(index, SAMPLES);
                    while !is_done && !budget.is_spent() {
                        is_done = sampling.advance(index, SAMPLES);
                    }
                    let fraction = 0.4 + 0.1 * sampling.fraction();
                    let next =
                        if is_done { self.search(shape, sampling.finish()) } else { Step::Samples(shape, sampling) };
                    (next, fraction)
                }
                None => (self.search(shape, Vec::new()), 0.5),
            },
            Step::Pinch(shape, samples, mut task) => match task.advance(budget) {
                Progress::Working(fraction) => (Step::Pinch(shape, samples, task), 0.5 + fraction / 2.0),
                Progress::Done(pinch) => {
                    store.now.smoothed_measures = Some(Arc::new(SmoothedMeasures { shape, samples, pinch }));
                    return Ok(Progress::Done(()));
                }
            },
        };
        self.step = step;
        Ok(Progress::Working(SMOOTHED * fraction))
    }
}

/// The measuring of a level, in slices.
pub(super) struct OfLevel {
    subject: Subject,
    /// Of the smoothed surface.
    samples: Arc<[Sample]>,
    shape: ShapeTask<Arc<TriMesh>, Arc<Topology>>,
}

impl OfLevel {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let now = &store.now;
        let (reduced, of_smoothed) = (now.reduced.as_ref()?, now.smoothed_measures.as_ref()?);
        let mesh = reduced.mesh.clone();
        let index = now.indices.level.clone().map(|index| (mesh.clone(), index));
        let subject = Subject { mesh, topology: reduced.topology.clone(), index };
        let shape = subject.task();
        Some(Self { subject, samples: of_smoothed.samples.clone(), shape })
    }
}

impl Run for OfLevel {
    /// The samples are measured in one piece, of up to 2 microseconds each.
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        Ok(match self.shape.advance(budget) {
            Progress::Working(fraction) => Progress::Working(SMOOTHED + (1.0 - SMOOTHED) * fraction),
            Progress::Done(measured) => {
                let Subject { mesh, topology, .. } = &self.subject;
                let index = self.shape.index();
                let narrowing = index.and_then(|index| narrowing(&self.samples, mesh, topology, index));
                store.now.level_measures = Some(Arc::new(LevelMeasures { shape: measured.shape, narrowing }));
                let finest = store.now.levels.as_ref().map_or(0, |levels| levels.finest.triangles.len());
                store.now.indices.let_go(finest);
                Progress::Done(())
            }
        })
    }
}
