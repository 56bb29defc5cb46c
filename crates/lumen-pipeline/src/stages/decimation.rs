//! Decimation as a stage: all levels, and the smoothed surface in their numbering.

use std::sync::Arc;

use super::carry::kept_arrays;
use super::running::Run;
use crate::decimation::{DecimationTask, labels_of};
use crate::results::{Levels, Smoothed, Surface};
use crate::settings::SettingsError;
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use crate::widths::WidthTask;
use lumen_mesh::{Topology, TriMesh};

pub(super) struct Decimating {
    kept: Arc<Surface>,
    smoothed: Arc<Smoothed>,
    step: Step,
    /// The part of the work that is done when the collapses begin.
    before: f32,
}

enum Step {
    /// How wide the vessels are, where smoothing has not found it.
    Widths(Box<WidthTask<Arc<TriMesh>, Arc<Topology>>>),
    Collapses(Box<DecimationTask<Arc<TriMesh>, Arc<Topology>>>),
}

/// The part of the work that it is to find the widths.
const WIDTHS: f32 = 0.5;

impl Decimating {
    pub(super) fn start(store: &Store) -> Option<Self> {
        let (kept, smoothed) = (store.now.kept.clone()?, store.now.smoothed.clone()?);
        let settings = store.now.settings.decimation;
        // The widths are those of the kept surface, whoever finds them: the levels are the same.
        let step = match store.known_widths() {
            None if settings.spare_thin => {
                let task = WidthTask::new(kept.mesh.clone(), kept.topology.clone());
                Step::Widths(Box::new(task.with_index(store.now.indices.kept.clone())))
            }
            known => {
                let widths = known.filter(|_| settings.spare_thin).cloned();
                collapses(store, &kept, &smoothed, widths)
            }
        };
        let before = if matches!(step, Step::Widths(_)) { WIDTHS } else { 0.0 };
        Some(Self { kept, smoothed, step, before })
    }
}

fn collapses(store: &Store, kept: &Surface, smoothed: &Smoothed, widths: Option<Arc<[f32]>>) -> Step {
    let settings = &store.now.settings.decimation;
    let task = DecimationTask::new(smoothed.mesh.clone(), kept.topology.clone(), settings);
    let arrays = if settings.keep_labels { kept_arrays(store) } else { None };
    let task = match arrays.and_then(|arrays| labels_of(&kept.mesh, &arrays)) {
        Some(labels) => task.with_labels(labels.into()),
        None => task,
    };
    Step::Collapses(Box::new(match widths {
        Some(widths) => task.with_widths(widths),
        None => task,
    }))
}

impl Run for Decimating {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        loop {
            match &mut self.step {
                Step::Widths(task) => match task.advance(budget) {
                    Progress::Working(fraction) => return Ok(Progress::Working(self.before * fraction)),
                    Progress::Done(widths) => {
                        store.now.indices.kept = task.index().cloned();
                        let widths: Arc<[f32]> = widths.into();
                        store.widths = Some((self.kept.clone(), widths.clone()));
                        self.step = collapses(store, &self.kept, &self.smoothed, Some(widths));
                    }
                },
                Step::Collapses(task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        return Ok(Progress::Working(self.before + (1.0 - self.before) * fraction));
                    }
                    Progress::Done(progressive) => {
                        let finest = Arc::new(progressive.finest());
                        let needs_vertices = !store.arrays.is_empty();
                        let vertex_of_node = if needs_vertices { task.vertices_of_nodes() } else { Vec::new() }.into();
                        store.now.levels = Some(Levels { progressive: Arc::new(progressive), finest, vertex_of_node });
                        return Ok(Progress::Done(()));
                    }
                },
            }
        }
    }
}
