//! The stages in order, each remembered with the settings that made it.
//!
//! ```text
//! opened --connectivity--> kept --smoothing--> smoothed --decimation--> progressive --level--> Level --> Deviations
//! ```
//!
//! Where the target is a bound on the deviation, the level that meets it is found before it is taken. Last come the
//! numbers that are no stage of the method (`measuring`).
//!
//! [`Pipeline::set`] drops what a change of settings makes stale, from the first stage that it touches;
//! [`Pipeline::advance`] works on the first stage that is missing. A change of the reduction rate alone costs a
//! level and its deviation.

use std::sync::Arc;

use web_time::Instant;

use super::bound::{Bound, BoundTask};
use super::connectivity::Connectivity;
use super::decimation::DecimationTask;
use super::deviation::{Comparison, DeviationTask, INTERACTIVE_SAMPLES};
use super::measuring::{LevelMeasures, LevelTask, SmoothedMeasures, SmoothedTask, Subject};
use super::normals::{Weighting, vertex_normals};
use super::progressive::ProgressiveMesh;
use super::results::{Deviations, Reduced, Smoothed, Stage, StageTimes, Surface, fingerprint};
use super::settings::{Settings, SettingsError};
use super::smoothing::{KeptTerms, Preparation, SmoothingStage};
use super::task::{Budget, Progress, Task, milliseconds};
use crate::mesh::{SurfaceIndex, Topology, TriMesh, measures, measures_within, oriented_loops};

/// What [`Pipeline::advance`] did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Advance {
    /// The stage goes on; the fraction of it that is done.
    Working(Stage, f32),
    /// The stage has a result.
    Finished(Stage),
    /// Nothing is left to do.
    Idle,
}

enum Running {
    Smoothing(Box<SmoothingStage>),
    Decimation(Box<DecimationTask<Arc<TriMesh>, Arc<Topology>>>),
    Bound(Box<BoundTask>),
    Deviation(Box<DeviationRun>),
    Level(Box<LevelTask>),
}

struct DeviationRun {
    from_smoothed: DeviationTask<Arc<TriMesh>>,
    from_original: DeviationTask<Arc<TriMesh>>,
    first: Option<Option<Comparison>>,
}

/// What the stages made, each from the one before; shared, so that a copy costs nothing.
#[derive(Clone, Default)]
struct Results {
    settings: Settings,
    kept: Option<Arc<Surface>>,
    smoothed: Option<Arc<Smoothed>>,
    progressive: Option<Arc<ProgressiveMesh>>,
    /// The smoothed surface over the nodes of the progressive mesh.
    finest: Option<Arc<TriMesh>>,
    bound: Option<Bound>,
    reduced: Option<Arc<Reduced>>,
    deviations: Option<Arc<Deviations>>,
    /// Of `finest` and the kept surface, for the next level.
    indices: [Option<Arc<SurfaceIndex>>; 2],
    /// Of the level, from its deviation to its measures.
    level_index: Option<Arc<SurfaceIndex>>,
    smoothed_measures: Option<Arc<SmoothedMeasures>>,
    level_measures: Option<Arc<LevelMeasures>>,
    times: StageTimes,
    /// Milliseconds that area and volume took, of the kept, the smoothed and the reduced surface.
    measuring: [f64; 3],
}

/// One opened surface and what the stages made of it so far.
pub struct Pipeline {
    opened: Arc<TriMesh>,
    samples: usize,
    /// Whether the level is measured.
    is_measured: bool,
    connectivity: Option<Arc<Connectivity>>,
    /// The pieces that go on, before they are measured, and their adjacency.
    adjacent: Option<(Arc<TriMesh>, Option<Arc<Topology>>)>,
    /// The stage whose time is being counted.
    timed: Option<Stage>,
    /// Milliseconds of the present call of `advance` that are not the stage's own.
    aside: f64,
    now: Results,
    /// The last results that reached a level, for when the next are cancelled.
    last: Option<Results>,
    running: Option<Running>,
    /// What makes another pass band cheap; and its making, which waits for the stages.
    terms: Option<KeptTerms>,
    preparation: Option<Preparation>,
    /// Whether the kept surface has been smoothed before: then it may well be again.
    is_smoothed_again: bool,
    /// The measuring of the smoothed surface: a change of the level does not stop it.
    measuring: Option<Box<SmoothedTask>>,
}

impl Pipeline {
    /// A pipeline for an opened surface. Triangles must not repeat a vertex, coordinates must be finite (`io` sees to
    /// both).
    pub fn new(opened: Arc<TriMesh>, settings: Settings) -> Self {
        let now = Results { settings, ..Results::default() };
        Self {
            opened,
            samples: INTERACTIVE_SAMPLES,
            is_measured: true,
            connectivity: None,
            adjacent: None,
            timed: None,
            aside: 0.0,
            now,
            last: None,
            running: None,
            terms: None,
            preparation: None,
            is_smoothed_again: false,
            measuring: None,
        }
    }

    /// Sets the number of samples of each surface that the deviation takes.
    #[must_use]
    pub fn with_samples(mut self, samples: usize) -> Self {
        self.samples = samples;
        self
    }

    /// Leaves out deviation, shape and lumen: for who wants the level alone.
    #[must_use]
    pub fn without_measures(mut self) -> Self {
        self.is_measured = false;
        self
    }

    /// Another pipeline for the same surface, with all that this one has made and nothing under way: the results are
    /// shared, not copied.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self {
            opened: self.opened.clone(),
            samples: self.samples,
            is_measured: self.is_measured,
            connectivity: self.connectivity.clone(),
            adjacent: None,
            now: self.now.clone(),
            last: None,
            running: None,
            terms: None,
            preparation: None,
            is_smoothed_again: false,
            timed: None,
            aside: 0.0,
            measuring: None,
        }
    }

    /// Changes the settings; what they made stale is dropped.
    ///
    /// # Errors
    /// When a setting is out of range; nothing changes then.
    pub fn set(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.check()?;
        if let (super::settings::Keep::Component(wanted), Some(found)) = (settings.keep, &self.connectivity)
            && wanted as usize >= found.components.len()
        {
            return Err(SettingsError::Component { wanted, count: found.components.len() });
        }
        if self.now.reduced.is_some() {
            self.last = Some(self.now.clone());
        }
        let old = std::mem::replace(&mut self.now.settings, settings);
        let new = &self.now.settings;
        let keep = old.keep != new.keep;
        let smoothing = keep || !old.smoothing.gives_same(&new.smoothing);
        let decimation = smoothing || !old.decimation.gives_same(&new.decimation);
        let level = decimation || old.target != new.target;
        self.is_smoothed_again |= smoothing && self.now.smoothed.is_some();
        if smoothing {
            self.preparation = None;
        }
        if keep {
            self.terms = None;
            self.is_smoothed_again = false;
            self.adjacent = None;
            self.now.kept = None;
            self.now.indices[1] = None;
        }
        if smoothing {
            self.now.smoothed = None;
        }
        if decimation {
            self.now.finest = None;
            self.now.indices[0] = None;
            self.now.progressive = None;
            self.now.smoothed_measures = None;
            self.measuring = None;
        }
        if level {
            self.now.bound = None;
            self.now.times.bound = 0.0;
            self.now.reduced = None;
            self.now.deviations = None;
            self.now.level_index = None;
            self.now.level_measures = None;
            self.now.times.measures = 0.0;
        }
        let stale = match &self.running {
            Some(Running::Smoothing(..)) => smoothing,
            Some(Running::Decimation(_)) => decimation,
            Some(Running::Bound(_) | Running::Deviation(_) | Running::Level(_)) => level,
            None => false,
        };
        if stale {
            self.running = None;
        }
        if stale || keep {
            self.timed = None;
        }
        Ok(())
    }

    /// Whether [`Self::prepare`] has something to do.
    pub fn can_prepare(&self) -> bool {
        let settings = &self.now.settings.smoothing;
        let lacks_terms = |kept: &Arc<Surface>| {
            KeptTerms::would_fit(kept, settings) && !self.terms.as_ref().is_some_and(|terms| terms.suit(kept, settings))
        };
        self.next_stage().is_none() && self.now.kept.as_ref().is_some_and(lacks_terms)
    }

    /// Works until `budget` is spent on what makes the next change of pass band or window cheap, while nothing else is
    /// to be done: the filter's terms, up to 64 MB. Says whether there is more to do.
    pub fn prepare(&mut self, budget: Budget) -> bool {
        let Some(kept) = self.now.kept.as_ref().filter(|_| self.can_prepare()) else { return false };
        let mut preparation =
            self.preparation.take().unwrap_or_else(|| Preparation::new(kept, &self.now.settings.smoothing));
        if preparation.advance(budget) {
            self.terms = preparation.into_terms();
            return false;
        }
        self.preparation = Some(preparation);
        true
    }

    /// Stops what is under way and goes back to the last settings that reached a level, with their results.
    pub fn cancel(&mut self) {
        self.running = None;
        self.measuring = None;
        self.adjacent = None;
        self.timed = None;
        if let (None, Some(last)) = (&self.now.reduced, self.last.take()) {
            self.now = last;
        }
    }

    /// Whether there is a level to show, or to go back to.
    pub fn has_result(&self) -> bool {
        self.now.reduced.is_some() || self.last.is_some()
    }

    /// Works until `budget` is spent or a stage is finished.
    ///
    /// # Errors
    /// When a setting is out of range or names a component that the surface does not have.
    pub fn advance(&mut self, budget: Budget) -> Result<Advance, SettingsError> {
        let Some(stage) = self.next_stage() else { return Ok(Advance::Idle) };
        let start = Instant::now();
        // The measures come in two parts, with their time begun by `set`.
        if self.timed.replace(stage) != Some(stage) && stage != Stage::Measures {
            *self.now.times.of(stage) = 0.0;
        }
        let result = self.work(stage, budget)?;
        *self.now.times.of(stage) += milliseconds(start) - std::mem::take(&mut self.aside);
        if result == Advance::Finished(stage) {
            self.timed = None;
        }
        Ok(result)
    }

    /// Runs all stages to the end.
    ///
    /// # Errors
    /// When a setting is out of range or names a component that the surface does not have.
    pub fn finish(&mut self) -> Result<(), SettingsError> {
        while self.advance(Budget::UNLIMITED)? != Advance::Idle {}
        Ok(())
    }

    /// The first stage that has no result.
    pub fn next_stage(&self) -> Option<Stage> {
        if self.now.kept.is_none() {
            Some(Stage::Connectivity)
        } else if self.now.smoothed.is_none() {
            Some(Stage::Smoothing)
        } else if self.now.progressive.is_none() {
            Some(Stage::Decimation)
        } else if self.now.bound.is_none() && self.now.settings.target.deviation_mm().is_some() {
            Some(Stage::Bound)
        } else if self.now.reduced.is_none() {
            Some(Stage::Level)
        } else if !self.is_measured {
            None
        } else if self.now.deviations.is_none() {
            Some(Stage::Deviation)
        } else if self.now.level_measures.is_none() {
            Some(Stage::Measures)
        } else {
            None
        }
    }

    fn work(&mut self, stage: Stage, budget: Budget) -> Result<Advance, SettingsError> {
        match stage {
            Stage::Connectivity => {
                self.now.settings.check()?;
                if let Some(fraction) = self.connect()? {
                    return Ok(Advance::Working(stage, fraction));
                }
            }
            Stage::Level => self.take_level(),
            Stage::Smoothing if self.now.settings.smoothing.iterations == 0 => self.skip_smoothing(),
            Stage::Measures if self.now.smoothed_measures.is_none() => {
                let fraction = self.measure_smoothed(budget).unwrap_or(0.9);
                return Ok(Advance::Working(stage, 0.9 * fraction));
            }
            Stage::Smoothing | Stage::Decimation | Stage::Bound | Stage::Deviation | Stage::Measures => {
                if self.running.is_none() {
                    self.running = self.start(stage);
                    if self.running.is_some() && budget.is_spent() {
                        return Ok(Advance::Working(stage, 0.0));
                    }
                }
                if let Some(fraction) = self.run(budget) {
                    return Ok(Advance::Working(stage, fraction));
                }
            }
        }
        Ok(Advance::Finished(stage))
    }

    /// One of the four parts of the first stage; `None` when it was the last.
    fn connect(&mut self) -> Result<Option<f32>, SettingsError> {
        let Some(found) = &mut self.connectivity else {
            self.connectivity = Some(Arc::new(Connectivity::unmeasured(&self.opened)));
            return Ok(Some(0.2));
        };
        let start = Instant::now();
        match self.adjacent.take() {
            None => {
                self.adjacent = Some((found.kept(&self.opened, self.now.settings.keep)?, None));
                Ok(Some(0.3))
            }
            Some((mesh, None)) => {
                let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
                self.adjacent = Some((mesh, Some(Arc::new(topology))));
                self.now.times.adjacency = milliseconds(start);
                self.aside += self.now.times.adjacency;
                Ok(Some(0.7))
            }
            Some((mesh, Some(topology))) => {
                if found.components.is_empty() {
                    Arc::make_mut(found).measure(&self.opened);
                }
                let loops = oriented_loops(&topology);
                let measures = measures_within(&mesh, loops.as_deref());
                self.now.kept = Some(Arc::new(Surface { mesh, topology, loops, measures }));
                self.now.measuring[0] = milliseconds(start);
                self.aside += self.now.measuring[0];
                Ok(None)
            }
        }
    }

    fn skip_smoothing(&mut self) {
        let unchanged = |kept: &Arc<Surface>| Smoothed {
            mesh: kept.mesh.clone(),
            filter: None,
            response: None,
            volume_held: None,
            measures: kept.measures,
        };
        self.now.smoothed = self.now.kept.as_ref().map(unchanged).map(Arc::new);
    }

    fn take_level(&mut self) {
        let Some(progressive) = &self.now.progressive else { return };
        let level = match &self.now.bound {
            Some(bound) => progressive.level_after(bound.steps),
            None => progressive.level(self.now.settings.target),
        };
        let mesh = Arc::new(progressive.extract(&level.triangles));
        let start = Instant::now();
        let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        self.now.times.normals = milliseconds(start);
        let measuring = Instant::now();
        let topology = Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
        let measures = measures(&mesh, &topology);
        self.now.measuring[2] = milliseconds(measuring);
        let fingerprint = fingerprint(&mesh);
        self.now.reduced = Some(Arc::new(Reduced { level, mesh, topology, normals, measures, fingerprint }));
        self.last = None;
        self.aside += milliseconds(start);
    }

    fn start(&self, stage: Stage) -> Option<Running> {
        let kept = self.now.kept.as_ref()?;
        Some(match stage {
            Stage::Smoothing => {
                let settings = self.now.settings.smoothing;
                let stage = SmoothingStage::new(kept, settings, self.terms.as_ref(), self.is_smoothed_again);
                Running::Smoothing(Box::new(stage))
            }
            Stage::Decimation => {
                let smoothed = self.now.smoothed.as_ref()?;
                let task =
                    DecimationTask::new(smoothed.mesh.clone(), kept.topology.clone(), &self.now.settings.decimation);
                Running::Decimation(Box::new(task))
            }
            Stage::Bound => {
                let (progressive, finest) = (self.now.progressive.as_ref()?, self.now.finest.as_ref()?);
                let bound = self.now.settings.target.deviation_mm()?;
                let task = BoundTask::new(progressive.clone(), finest.clone(), bound);
                Running::Bound(Box::new(match &self.now.indices[0] {
                    Some(index) => task.with_index(index.clone()),
                    None => task,
                }))
            }
            Stage::Measures => {
                let (reduced, of_smoothed) = (self.now.reduced.as_ref()?, self.now.smoothed_measures.as_ref()?);
                let mesh = reduced.mesh.clone();
                let index = self.now.level_index.clone().map(|index| (mesh.clone(), index));
                let subject = Subject { mesh, topology: reduced.topology.clone(), index };
                Running::Level(Box::new(LevelTask::new(subject, of_smoothed.samples.clone())))
            }
            _ => {
                let (finest, reduced) = (self.now.finest.as_ref()?, self.now.reduced.as_ref()?);
                let task = |mesh: &Arc<TriMesh>, index: &Option<Arc<SurfaceIndex>>| {
                    let task = DeviationTask::new(mesh.clone(), reduced.mesh.clone(), self.samples);
                    match index {
                        Some(index) => task.with_index_of_a(index.clone()),
                        None => task,
                    }
                };
                let [of_smoothed, of_original] = &self.now.indices;
                let (from_smoothed, from_original) =
                    (task(finest, of_smoothed).with_map(), task(&kept.mesh, of_original));
                Running::Deviation(Box::new(DeviationRun { from_smoothed, from_original, first: None }))
            }
        })
    }

    /// Advances the measuring of the smoothed surface; the fraction that is done, or `None` when it is stored.
    fn measure_smoothed(&mut self, budget: Budget) -> Option<f32> {
        if self.measuring.is_none() {
            let (kept, smoothed) = (self.now.kept.as_ref()?, self.now.smoothed.as_ref()?);
            let index = self.now.finest.clone().zip(self.now.indices[0].clone());
            let subject = Subject { mesh: smoothed.mesh.clone(), topology: kept.topology.clone(), index };
            self.measuring = Some(Box::new(SmoothedTask::new(subject, self.now.progressive.clone()?)));
        }
        match self.measuring.as_mut()?.advance(budget) {
            Progress::Working(fraction) => Some(fraction),
            Progress::Done(measures) => {
                self.now.smoothed_measures = Some(Arc::new(measures));
                self.measuring = None;
                None
            }
        }
    }

    /// Advances what is running; the fraction that is done, or `None` when all of it is and its result is stored.
    fn run(&mut self, budget: Budget) -> Option<f32> {
        match self.running.as_mut()? {
            Running::Smoothing(stage) => match stage.advance(budget) {
                Progress::Working(fraction) => return Some(fraction),
                Progress::Done(smoothed) => {
                    self.now.measuring[1] = stage.measuring_ms;
                    self.aside += stage.measuring_ms;
                    self.terms = stage.terms.take().or(self.terms.take());
                    self.now.smoothed = Some(Arc::new(smoothed));
                }
            },
            Running::Decimation(task) => match task.advance(budget) {
                Progress::Working(fraction) => return Some(fraction),
                Progress::Done(progressive) => {
                    self.now.finest = Some(Arc::new(progressive.finest()));
                    self.now.progressive = Some(Arc::new(progressive));
                }
            },
            Running::Bound(task) => match task.advance(budget) {
                Progress::Working(fraction) => return Some(fraction),
                Progress::Done(bound) => {
                    self.now.indices[0] = task.index().cloned();
                    self.now.bound = Some(bound);
                }
            },
            Running::Level(task) => match task.advance(budget) {
                Progress::Working(fraction) => return Some(0.9 + 0.1 * fraction),
                Progress::Done(measures) => {
                    self.now.level_measures = Some(Arc::new(measures));
                    self.now.level_index = None;
                }
            },
            Running::Deviation(run) => {
                if run.first.is_none() {
                    match run.from_smoothed.advance(budget) {
                        Progress::Working(fraction) => return Some(fraction / 2.0),
                        Progress::Done(found) => run.first = Some(found),
                    }
                }
                match run.from_original.advance(budget) {
                    Progress::Working(fraction) => return Some(0.5 + fraction / 2.0),
                    Progress::Done(from_original) => {
                        self.now.level_index = run.from_smoothed.index_of_b().cloned();
                        self.now.indices =
                            [&run.from_smoothed, &run.from_original].map(|task| task.index_of_a().cloned());
                        let from_smoothed = run.first.take().flatten();
                        let by_node = self.by_node(from_smoothed.as_ref());
                        self.now.deviations = Some(Arc::new(Deviations { from_smoothed, from_original, by_node }));
                    }
                }
            }
        }
        self.running = None;
        None
    }

    /// The map of the deviation over the level, at the nodes of the progressive mesh.
    fn by_node(&self, found: Option<&Comparison>) -> Vec<f32> {
        let (Some(progressive), Some(reduced)) = (&self.now.progressive, &self.now.reduced) else { return Vec::new() };
        let mut is_used = vec![false; progressive.positions.len()];
        reduced.level.triangles.as_flattened().iter().for_each(|&node| is_used[node as usize] = true);
        // The level's own vertices are the nodes in use, in their order.
        let mut map = found.map_or(&[][..], |found| &found.map).iter();
        is_used.into_iter().map(|used| if used { map.next().copied().unwrap_or(0.0) } else { 0.0 }).collect()
    }

    /// The surface as it was opened.
    pub fn opened(&self) -> &Arc<TriMesh> {
        &self.opened
    }

    /// The settings in force.
    pub fn settings(&self) -> &Settings {
        &self.now.settings
    }

    /// The pieces that were found.
    pub fn connectivity(&self) -> Option<&Connectivity> {
        self.connectivity.as_deref()
    }

    /// The part of the surface that goes on.
    pub fn kept(&self) -> Option<&Arc<Surface>> {
        self.now.kept.as_ref()
    }

    /// The smoothed surface.
    pub fn smoothed(&self) -> Option<&Arc<Smoothed>> {
        self.now.smoothed.as_ref()
    }

    /// Every level.
    pub fn progressive(&self) -> Option<&Arc<ProgressiveMesh>> {
        self.now.progressive.as_ref()
    }

    /// What the bound on the deviation led to, where the settings have one.
    pub fn bound(&self) -> Option<Bound> {
        self.now.bound
    }

    /// The level that the settings ask for.
    pub fn reduced(&self) -> Option<&Arc<Reduced>> {
        self.now.reduced.as_ref()
    }

    /// How far that level is from where it came from.
    pub fn deviations(&self) -> Option<&Arc<Deviations>> {
        self.now.deviations.as_ref()
    }

    /// Shape and lumen of the smoothed surface.
    pub fn smoothed_measures(&self) -> Option<&Arc<SmoothedMeasures>> {
        self.now.smoothed_measures.as_ref()
    }

    /// Shape and lumen of the level.
    pub fn level_measures(&self) -> Option<&Arc<LevelMeasures>> {
        self.now.level_measures.as_ref()
    }

    /// What each stage took.
    pub fn times(&self) -> StageTimes {
        StageTimes { areas: self.now.measuring.iter().sum(), ..self.now.times }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::phantom::{Sample, generate};
    use crate::pipeline::settings::{Keep, Smoothing, Target};

    fn finished() -> Pipeline {
        let opened = Arc::new(generate(Sample::Aorta, 10_000).unwrap());
        let mut pipeline = Pipeline::new(opened, Settings::default()).with_samples(2_000);
        pipeline.finish().unwrap();
        pipeline
    }

    #[test]
    fn a_fork_shares_what_is_made_and_goes_its_own_way() {
        let pipeline = finished();
        let mut fork = pipeline.fork();
        assert_eq!(fork.next_stage(), None);
        let rough = Smoothing { iterations: 20, ..Smoothing::default() };
        fork.set(Settings { smoothing: rough, ..Settings::default() }).unwrap();
        fork.finish().unwrap();
        assert!(Arc::ptr_eq(pipeline.kept().unwrap(), fork.kept().unwrap()), "the surface itself is shared");
        assert_ne!(fork.smoothed().unwrap().mesh, pipeline.smoothed().unwrap().mesh);
        assert_eq!((pipeline.next_stage(), pipeline.settings()), (None, &Settings::default()));
        fork.set(Settings::default()).unwrap();
        fork.finish().unwrap();
        assert_eq!(fork.reduced().unwrap().mesh, pipeline.reduced().unwrap().mesh);
    }

    #[test]
    fn another_rate_costs_a_level_and_another_pass_band_keeps_the_pieces() {
        let mut pipeline = finished();
        let (kept, smoothed) = (pipeline.kept().unwrap().clone(), pipeline.smoothed().unwrap().clone());
        pipeline.set(Settings { target: Target::Reduction(500), ..Settings::default() }).unwrap();
        assert_eq!(pipeline.next_stage(), Some(Stage::Level));
        pipeline.finish().unwrap();
        assert!(Arc::ptr_eq(&smoothed, pipeline.smoothed().unwrap()));
        let smoothing = Smoothing { pass_band: 0.1, ..Smoothing::default() };
        pipeline.set(Settings { smoothing, ..Settings::default() }).unwrap();
        assert_eq!(pipeline.next_stage(), Some(Stage::Smoothing));
        pipeline.finish().unwrap();
        assert!(Arc::ptr_eq(&kept, pipeline.kept().unwrap()));
        assert!(!Arc::ptr_eq(&smoothed, pipeline.smoothed().unwrap()));
    }

    #[test]
    fn a_cancelled_run_leaves_the_last_result_standing() {
        let mut pipeline = finished();
        let (reduced, settings) = (pipeline.reduced().unwrap().clone(), pipeline.settings().clone());
        pipeline.set(Settings { keep: Keep::All, ..Settings::default() }).unwrap();
        for _ in 0..8 {
            assert!(!matches!(pipeline.advance(Budget::new(Duration::ZERO)), Ok(Advance::Idle)));
        }
        assert!(pipeline.reduced().is_none());
        pipeline.cancel();
        assert!(Arc::ptr_eq(&reduced, pipeline.reduced().unwrap()));
        assert_eq!(*pipeline.settings(), settings);
    }

    #[test]
    fn colours_are_of_the_numbers_beside_them() {
        for method in crate::pipeline::settings::Method::ALL {
            let mut pipeline = finished();
            let decimation = crate::pipeline::settings::Decimation { method, ..Default::default() };
            pipeline.set(Settings { decimation, ..Settings::default() }).unwrap();
            pipeline.finish().unwrap();
            let (found, reduced) = (pipeline.deviations().unwrap(), pipeline.reduced().unwrap());
            let deviation = found.from_smoothed.as_ref().unwrap().deviation;
            let positions = &pipeline.progressive().unwrap().positions;
            // Over the triangles of the level: their area, how much of it has the last colour, the sum of the colours.
            let [mut area, mut last, mut sum] = [0.0; 3];
            for corners in &reduced.level.triangles {
                let size = crate::mesh::triangle_area(corners.map(|v| positions[v as usize]));
                let values = corners.map(|v| f64::from(found.by_node[v as usize]));
                area += size;
                sum += size * values.iter().sum::<f64>() / 3.0;
                last += size * values.iter().filter(|&&value| value >= deviation.p95).count() as f64 / 3.0;
            }
            assert!(last / area < 0.06, "{method:?}: {:.1} % have the last colour", 100.0 * last / area);
            assert!((sum / area / deviation.mean - 1.0).abs() < 0.1, "{method:?}: {} of {deviation:?}", sum / area);
            let most = found.by_node.iter().copied().fold(0.0, f32::max);
            assert!(f64::from(most) > deviation.mean && f64::from(most) <= deviation.max);
            let used = found.by_node.iter().filter(|&&distance| distance > 0.0).count();
            assert_eq!(used, reduced.mesh.positions.len());
        }
    }

    #[test]
    fn the_time_of_a_stage_in_slices_is_that_of_all_its_slices() {
        let opened = Arc::new(generate(Sample::Aorta, 100_000).unwrap());
        let mut pipeline = Pipeline::new(opened, Settings::default());
        let (mut spent, mut told) = (0.0, 0.0);
        while pipeline.next_stage() <= Some(Stage::Smoothing) && pipeline.next_stage().is_some() {
            let start = Instant::now();
            pipeline.advance(Budget::new(Duration::ZERO)).unwrap();
            spent += milliseconds(start);
            let times = pipeline.times();
            let all = times.connectivity + times.adjacency + times.areas + times.smoothing;
            assert!(all >= told, "a slice took {} ms off", told - all);
            told = all;
        }
        assert!(told <= spent && told > spent * 0.5, "{told} of {spent} ms");
    }

    #[test]
    fn nothing_comes_of_nothing_and_a_piece_that_is_not_there_is_refused() {
        let mut empty = Pipeline::new(Arc::new(TriMesh::default()), Settings::default());
        empty.finish().unwrap();
        assert!(empty.reduced().unwrap().mesh.triangles.is_empty());
        assert!(empty.deviations().unwrap().from_smoothed.is_none());
        let mut pipeline = finished();
        let wanted = Settings { keep: Keep::Component(10_000), ..Settings::default() };
        assert!(matches!(pipeline.set(wanted), Err(SettingsError::Component { wanted: 10_000, .. })));
        assert!(pipeline.reduced().is_some());
    }
}
