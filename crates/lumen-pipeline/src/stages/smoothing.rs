//! Smoothing as a stage: the filter, or the terms of an earlier run, then what vessels lost of their calibre, and the volume.

use std::sync::Arc;

use web_time::Instant;

use super::running::Run;
use crate::filter::Filter;
use crate::response::{SmoothingResponse, edge_length};
use crate::results::{Adapted, Smoothed, Surface};
use crate::settings::{SettingsError, Smoothing};
use crate::smoothing::{
    Before, GuardTask, Guarded, LeastPassBands, RestoreTask, SmoothingTask, TERMS_BYTES, VOLUME_TOLERANCE, VolumeTask,
    kept_terms,
};
use crate::store::Store;
use crate::task::{Budget, Progress, Task as _};
use crate::times::Part;
use crate::widths::WidthTask;
use lumen_mesh::{Measures, Topology, TriMesh, Vec3, measures_within};

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
    Calibre(Box<WidthTask<Arc<TriMesh>, Arc<Topology>>>),
    Bands(Box<LeastPassBands<Arc<TriMesh>, Arc<Topology>>>),
    Filter(Box<SmoothingTask<Arc<Topology>>>),
    Restore(Box<RestoreTask>),
    Volume(Box<VolumeTask>),
    /// And whether the volume was held.
    Guard(Box<GuardTask>, Option<bool>),
    /// Area and volume come next.
    Measure(Guarded, Option<bool>),
    Done(Guarded, Option<bool>, Measures),
}

impl Filtering {
    /// Terms of an earlier run that suit are used, and new ones kept where they fit and may be used again.
    pub(super) fn start(store: &Store) -> Option<Self> {
        let kept = store.now.kept.as_ref()?;
        let settings = store.now.settings.smoothing;
        let filter = Filter::new(&settings);
        let mut stage = Self { kept: kept.clone(), settings, filter, step: Step::Skipped };
        if settings.iterations > 0 {
            let known = store.bands.as_ref().filter(|(of, _)| Arc::ptr_eq(of, kept));
            stage.step = match known {
                Some((_, bands)) if settings.adapt => stage.filter_step(store, Some(bands)),
                None if settings.adapt => match store.known_widths() {
                    Some(widths) => stage.bands_step(widths.clone()),
                    None => {
                        let task = WidthTask::new(kept.mesh.clone(), kept.topology.clone());
                        Step::Calibre(Box::new(task.with_index(store.now.indices.kept.clone())))
                    }
                },
                _ => stage.filter_step(store, None),
            };
        }
        Some(stage)
    }

    fn bands_step(&self, widths: Arc<[f32]>) -> Step {
        let Surface { mesh, topology, .. } = &*self.kept;
        Step::Bands(Box::new(LeastPassBands::new(mesh.clone(), topology.clone(), widths)))
    }

    /// The filter, with a pass band of its own at each vertex where there are `bands`.
    fn filter_step(&self, store: &Store, bands: Option<&Arc<[f32]>>) -> Step {
        let Self { kept, settings, filter, .. } = self;
        if let Some(known) = store.terms.as_ref().filter(|terms| terms.suit(kept, settings)) {
            return match bands {
                Some(bands) => self.restore(store, known.terms().smooth_varying(settings, bands), bands),
                None => self.after_filter(store, known.terms().smooth(filter)),
            };
        }
        let (positions, topology) = (&kept.mesh.positions, kept.topology.clone());
        let task = match bands {
            Some(bands) => SmoothingTask::varying(positions, topology, settings, bands),
            None => SmoothingTask::new(positions, topology, settings.boundary, filter),
        };
        Step::Filter(Box::new(if store.is_smoothed_again { task.keeping_terms(TERMS_BYTES) } else { task }))
    }

    fn restore(&self, store: &Store, positions: Vec<Vec3>, bands: &Arc<[f32]>) -> Step {
        match RestoreTask::new(&self.kept, positions, &self.settings, bands) {
            Ok(task) => Step::Restore(Box::new(task)),
            Err(positions) => self.after_filter(store, positions),
        }
    }

    fn after_filter(&self, store: &Store, positions: Vec<Vec3>) -> Step {
        match self.before() {
            _ if !self.settings.preserve_volume => self.guard(store, positions, None),
            Some(before) => {
                Step::Volume(Box::new(VolumeTask::new(&before, positions, self.settings.boundary, &self.filter)))
            }
            None => self.guard(store, positions, Some(false)),
        }
    }

    fn guard(&self, store: &Store, positions: Vec<Vec3>, volume_held: Option<bool>) -> Step {
        if self.settings.guard {
            let task = GuardTask::new(self.kept.clone(), store.now.indices.kept.clone(), positions);
            return Step::Guard(Box::new(task), volume_held);
        }
        let mesh = TriMesh { positions, triangles: self.kept.mesh.triangles.clone() };
        Step::Measure(Guarded::without(mesh), volume_held)
    }

    /// The surface before smoothing, if it encloses a volume.
    fn before(&self) -> Option<Before<'_>> {
        let Surface { mesh, topology, loops, measures } = &*self.kept;
        Some(Before { mesh, topology, loops: loops.as_deref()?, volume: measures.volume_mm3? })
    }

    /// The surface as it is, without a pass.
    fn unchanged(&self) -> Smoothed {
        let Surface { mesh, measures, .. } = &*self.kept;
        Smoothed {
            mesh: mesh.clone(),
            filter: None,
            response: None,
            volume_held: None,
            adapted: None,
            weakened: None,
            crosses_nothing: false,
            measures: *measures,
        }
    }

    fn measured(&self, mesh: &TriMesh, store: &mut Store) -> Measures {
        let start = Instant::now();
        let measures = measures_within(mesh, self.kept.loops.as_deref());
        store.now.times.tell_apart(Part::SmoothedAreas, start);
        measures
    }

    fn result(&self, guarded: Guarded, volume_held: Option<bool>, measures: Measures, store: &Store) -> Smoothed {
        let Guarded { mesh, weakened, crosses_nothing } = guarded;
        let response = SmoothingResponse::new(&self.filter, self.settings.pass_band, edge_length(&mesh));
        // What is put back has the volume that it had.
        let change = self.kept.measures.volume_mm3.zip(measures.volume_mm3).map(|(before, after)| after / before - 1.0);
        let is_held = weakened.is_none() || change.is_some_and(|change| change.abs() <= VOLUME_TOLERANCE);
        let bands = store.bands.as_ref().filter(|_| self.settings.adapt);
        Smoothed {
            mesh,
            filter: Some(self.filter.clone()),
            response: Some(response),
            volume_held: volume_held.map(|held| held && is_held),
            adapted: bands.and_then(|(_, bands)| Adapted::of(bands, self.settings.pass_band)),
            weakened,
            crosses_nothing,
            measures,
        }
    }

    /// The parts of the work that are done when the filter is, and when the volume is.
    fn shares(&self) -> [f32; 2] {
        let end = if self.settings.guard { 0.7 } else { 1.0 };
        [if self.settings.preserve_volume { end / 2.0 } else { end }, end]
    }

    /// The part of the work that is done when the present step begins.
    fn begun(&self) -> f32 {
        let [share, end] = self.shares();
        match &self.step {
            Step::Skipped | Step::Calibre(_) => 0.0,
            Step::Bands(_) => 0.5 * share,
            Step::Filter(_) if self.settings.adapt => 0.6 * share,
            Step::Filter(_) => 0.0,
            Step::Restore(_) => 0.9 * share,
            Step::Volume(_) => share,
            Step::Guard(..) => end,
            Step::Measure(..) | Step::Done(..) => 1.0,
        }
    }
}

impl Run for Filtering {
    fn advance(&mut self, store: &mut Store, budget: Budget) -> Result<Progress<()>, SettingsError> {
        let [share, end] = self.shares();
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
                    Progress::Done(widths) => {
                        store.now.indices.kept = task.index().cloned();
                        let widths: Arc<[f32]> = widths.into();
                        store.widths = Some((self.kept.clone(), widths.clone()));
                        self.bands_step(widths)
                    }
                },
                Step::Bands(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Bands(task);
                        return Ok(Progress::Working((0.5 + 0.1 * fraction) * share));
                    }
                    Progress::Done(bands) => {
                        let bands: Arc<[f32]> = bands.into();
                        store.bands = Some((self.kept.clone(), bands.clone()));
                        self.filter_step(store, Some(&bands))
                    }
                },
                Step::Filter(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Filter(task);
                        let done = if self.settings.adapt { 0.6 + 0.3 * fraction } else { fraction };
                        return Ok(Progress::Working(done * share));
                    }
                    Progress::Done(positions) => {
                        let terms = kept_terms(*task, self.kept.clone(), self.settings.boundary);
                        store.terms = terms.or(store.terms.take());
                        match store.bands.as_ref().filter(|_| self.settings.adapt) {
                            Some((_, bands)) => self.restore(store, positions, bands),
                            None => self.after_filter(store, positions),
                        }
                    }
                },
                Step::Restore(mut task) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Restore(task);
                        return Ok(Progress::Working((0.9 + 0.1 * fraction) * share));
                    }
                    Progress::Done(positions) => self.after_filter(store, positions),
                },
                Step::Volume(mut task) => {
                    let advanced = self.before().map(|before| task.advance(&before, budget));
                    match advanced {
                        Some(Progress::Working(fraction)) => {
                            self.step = Step::Volume(task);
                            return Ok(Progress::Working(share + (end - share) * fraction));
                        }
                        Some(Progress::Done((positions, held))) => self.guard(store, positions, Some(held)),
                        None => self.guard(store, task.into_smoothed(), Some(false)),
                    }
                }
                Step::Guard(mut task, held) => match task.advance(budget) {
                    Progress::Working(fraction) => {
                        self.step = Step::Guard(task, held);
                        return Ok(Progress::Working(end + (1.0 - end) * fraction));
                    }
                    Progress::Done(guarded) => Step::Measure(guarded, held),
                },
                Step::Measure(guarded, held) => {
                    let measures = self.measured(&guarded.mesh, store);
                    Step::Done(guarded, held, measures)
                }
                Step::Done(guarded, held, measures) => {
                    let smoothed = self.result(guarded, held, measures, store);
                    store.now.smoothed = Some(Arc::new(smoothed));
                    return Ok(Progress::Done(()));
                }
            };
            if budget.is_spent() {
                return Ok(Progress::Working(self.begun()));
            }
        }
    }
}
