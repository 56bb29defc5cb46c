//! The numbers that are no stage of the method: shape and lumen of the smoothed surface and of a level.
//!
//! What belongs to the smoothed surface (its shape, samples of its vessels, the rate at which the first is pinched) is
//! measured once and kept from level to level.

use std::sync::Arc;

use super::lumen::{Narrowing, Sample, narrowing, samples};
use super::pinch::{Pinch, PinchTask};
use super::progressive::ProgressiveMesh;
use super::shape::{Measured, Shape, ShapeTask};
use super::task::{Budget, Progress, Task};
use crate::mesh::{SurfaceIndex, Topology, TriMesh};

/// A surface, its adjacency and, if there is one, an index of it in the numbering of a mesh of its own.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// Adjacency of its triangles.
    pub topology: Arc<Topology>,
    /// The index, and the mesh that it is of.
    pub index: Option<(Arc<TriMesh>, Arc<SurfaceIndex>)>,
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

/// What is measured of the smoothed surface.
#[derive(Clone, Debug)]
pub struct SmoothedMeasures {
    /// Its shape.
    pub shape: Shape,
    /// The middles of its vessels.
    pub samples: Arc<[Sample]>,
    /// Where and from which rate on a vessel is pinched, if one is.
    pub pinch: Option<Pinch>,
}

/// What is measured of a level.
#[derive(Clone, Debug)]
pub struct LevelMeasures {
    /// Its shape.
    pub shape: Shape,
    /// Where it has narrowed a vessel most; `None` where there is no vessel.
    pub narrowing: Option<Narrowing>,
}

/// The measuring of the smoothed surface, in slices.
#[derive(Debug)]
pub struct SmoothedTask {
    subject: Subject,
    progressive: Arc<ProgressiveMesh>,
    shape: ShapeTask<Arc<TriMesh>, Arc<Topology>>,
    search: Option<Search>,
}

/// The search for the first pinch, and what was found before.
#[derive(Debug)]
struct Search {
    shape: Shape,
    samples: Arc<[Sample]>,
    pinch: PinchTask<Arc<ProgressiveMesh>>,
}

impl SmoothedTask {
    /// Of the smoothed surface, and the levels made of it.
    pub fn new(subject: Subject, progressive: Arc<ProgressiveMesh>) -> Self {
        let shape = subject.task();
        Self { subject, progressive, shape, search: None }
    }
}

impl Task for SmoothedTask {
    type Output = SmoothedMeasures;

    /// Taking the samples is one piece, of about 50 ns a vertex and a microsecond a sample.
    fn advance(&mut self, budget: Budget) -> Progress<SmoothedMeasures> {
        let Some(search) = &mut self.search else {
            return match self.shape.advance(budget) {
                Progress::Working(fraction) => Progress::Working(fraction / 2.0),
                Progress::Done(measured) => {
                    self.begin_search(measured);
                    Progress::Working(0.5)
                }
            };
        };
        match search.pinch.advance(budget) {
            Progress::Working(fraction) => Progress::Working(0.5 + fraction / 2.0),
            Progress::Done(pinch) => {
                let (shape, samples) = (search.shape.clone(), search.samples.clone());
                Progress::Done(SmoothedMeasures { shape, samples, pinch })
            }
        }
    }
}

impl SmoothedTask {
    fn begin_search(&mut self, measured: Measured) {
        let Subject { mesh, topology, .. } = &self.subject;
        let samples: Arc<[Sample]> = match self.shape.index() {
            Some(index) => samples(mesh, topology, &measured.balls, index).into(),
            None => Arc::new([]),
        };
        let pinch = PinchTask::new(self.progressive.clone(), samples.clone());
        self.search = Some(Search { shape: measured.shape, samples, pinch });
    }
}

/// The measuring of a level, in slices.
#[derive(Debug)]
pub struct LevelTask {
    subject: Subject,
    samples: Arc<[Sample]>,
    shape: ShapeTask<Arc<TriMesh>, Arc<Topology>>,
}

impl LevelTask {
    /// Of a level, whose index must be of the level's own mesh, by samples of the smoothed surface.
    pub fn new(subject: Subject, samples: Arc<[Sample]>) -> Self {
        let shape = subject.task();
        Self { subject, samples, shape }
    }
}

impl Task for LevelTask {
    type Output = LevelMeasures;

    /// The samples are measured in one piece, of up to 2 microseconds each.
    fn advance(&mut self, budget: Budget) -> Progress<LevelMeasures> {
        match self.shape.advance(budget) {
            Progress::Working(fraction) => Progress::Working(fraction),
            Progress::Done(measured) => {
                let Subject { mesh, topology, .. } = &self.subject;
                let index = self.shape.index();
                let narrowing = index.and_then(|index| narrowing(&self.samples, mesh, topology, index));
                Progress::Done(LevelMeasures { shape: measured.shape, narrowing })
            }
        }
    }
}
