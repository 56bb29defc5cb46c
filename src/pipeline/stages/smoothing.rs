//! Smoothing as a stage: the filter, or the terms of an earlier run, and then the volume.

use std::sync::Arc;

use web_time::Instant;

use super::Run;
use crate::mesh::{Topology, TriMesh, Vec3, measures_within};
use crate::pipeline::filter::Filter;
use crate::pipeline::response::{SmoothingResponse, edge_length};
use crate::pipeline::results::{Part, Smoothed, Surface, Times};
use crate::pipeline::settings::{SettingsError, Smoothing};
use crate::pipeline::shape::ShapeTask;
use crate::pipeline::smoothing::{
    Before, LeastPassBands, SmoothingTask, VolumeTask, keeping, kept_terms, least_pass_bands,
};
use crate::pipeline::store::Store;
use crate::pipeline::task::{Budget, Progress, Task as _};

pub(super) struct Filtering {
    kept: Arc<Surface>,
    settings: Smoothing,
    filter: Filter,
    step: Step,
}

enum Step {
    /// No iterations.
    Skipped,
    /// How wide the vessels are, and by what each may be smoothed.
    Calibre(Box<ShapeTask<Arc<TriMesh>, Arc<Topology>>>),
    Bands(Box<LeastPassBands<Arc<TriMesh>, Arc<Topology>>>),
    Filter(Box<SmoothingTask<Arc<Topology>>>),
    Volume(Box<VolumeTask>),
    Done(Vec<Vec3>, Option<bool>),
}

impl Filtering {
    /// Terms of an earlier run that suit are used, and new ones kept where they fit and may be used again.
    pub(super) fn start(store: &Store) -> Option<Self> {
        let kept = store.now.kept.as_ref()?;
        let settings = store.now.settings.smoothing;
        let filter = Filter::new(&settings);
        let mut stage = Self { kept: kept.clone(), settings, filter, step: Step::Skipped };
        if settings.iterations > 0 && settings.adapt {
            let task = ShapeTask::radii_only(kept.mesh.clone(), kept.topology.clone());
            stage.step = Step::Calibre(Box::new(match &store.now.indices.kept {
                Some(index) => task.with_index(kept.mesh.clone(), index.clone()),
                None => task,
            }));
        } else if settings.iterations > 0 {
            stage.step = match store.terms.as_ref().filter(|terms| terms.suit(kept, &settings)) {
                Some(known) => stage.after_filter(known.smooth(&stage.filter)),
                None if store.is_smoothed_again => Step::Filter(Box::new(keeping(kept, &settings, &stage.filter))),
                None => {
                    let (positions, topology) = (&kept.mesh.positions, kept.topology.clone());
                    let task = SmoothingTask::new(positions, topology, settings.boundary, &stage.filter);
                    Step::Filter(Box::new(task))
                }
            };
        }
        Some(stage)
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

    /// The surface as it is, without a pass.
    fn unchanged(&self) -> Smoothed {
        let Surface { mesh, measures, .. } = &*self.kept;
        Smoothed { mesh: mesh.clone(), filter: None, response: None, volume_held: None, measures: *measures }
    }

    fn result(&self, positions: Vec<Vec3>, volume_held: Option<bool>, times: &mut Times) -> Smoothed {
        let mesh = TriMesh { positions, triangles: self.kept.mesh.triangles.clone() };
        let start = Instant::now();
        let measures = measures_within(&mesh, self.kept.loops.as_deref());
        times.tell_apart(Part::SmoothedAreas, start);
        let response = SmoothingResponse::new(&self.filter, self.settings.pass_band, edge_length(&mesh));
        let filter = Some(self.filter.clone());
        Smoothed { mesh: Arc::new(mesh), filter, response: Some(response), volume_held, measures }
    }
}

impl Run for Filtering {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        let share = if self.settings.preserve_volume { 0.5 } else { 1.0 };
        loop {
            self.step = match std::mem::replace(&mut self.step, Step::Skipped) {
                Step::Skipped => {
                    store.now.smoothed = Some(Arc::new(self.unchanged()));
                    return Ok(Progress::Done(()));
                }
                Step::Calibre(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Calibre(task);
                        return Ok(Progress::Working(0.5 * fraction * share));
                    }
                    Progress::Done(measured) => {
                        store.now.indices.kept = task.index().cloned();
                        let Surface { mesh, topology, .. } = &*self.kept;
                        let bands = least_pass_bands(mesh.clone(), topology.clone(), measured.balls.radii);
                        Step::Bands(Box::new(bands))
                    }
                },
                Step::Bands(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Bands(task);
                        return Ok(Progress::Working((0.5 + 0.1 * fraction) * share));
                    }
                    Progress::Done(mut bands) => {
                        let Smoothing { pass_band, .. } = self.settings;
                        bands.iter_mut().for_each(|band| *band = band.max(pass_band as f32));
                        let Surface { mesh, topology, .. } = &*self.kept;
                        let (positions, topology) = (&mesh.positions, topology.clone());
                        let task = SmoothingTask::varying(positions, topology, &self.settings, &bands);
                        Step::Filter(Box::new(task))
                    }
                },
                Step::Filter(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Filter(task);
                        let done = if self.settings.adapt { 0.6 + 0.4 * fraction } else { fraction };
                        return Ok(Progress::Working(done * share));
                    }
                    Progress::Done(positions) => {
                        let terms = kept_terms(*task, self.kept.clone(), self.settings.boundary);
                        store.terms = terms.or(store.terms.take());
                        self.after_filter(positions)
                    }
                },
                Step::Volume(mut task) => {
                    let advanced = self.before().map(|before| task.advance(&before, budget));
                    match advanced {
                        Some(Progress::Working(fraction)) => {
                            self.step = Step::Volume(task);
                            return Ok(Progress::Working(0.5 + fraction / 2.0));
                        }
                        Some(Progress::Done((positions, held))) => Step::Done(positions, Some(held)),
                        None => Step::Done(task.into_smoothed(), Some(false)),
                    }
                }
                Step::Done(positions, held) => {
                    let smoothed = self.result(positions, held, &mut store.now.times);
                    store.now.smoothed = Some(Arc::new(smoothed));
                    return Ok(Progress::Done(()));
                }
            };
        }
    }
}
