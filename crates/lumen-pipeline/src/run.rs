//! The stages in order, each remembered with the settings that made it.
//!
//! ```text
//! opened --mending--> entering --connectivity--> kept --smoothing--> smoothed --decimation--> progressive --level--> Level --> Deviations
//! ```
//!
//! Where the target is a bound on the deviation, the level that meets it is found before it is taken; where it is auto, it is
//! taken anew once it is known how far is safe. Last come the
//! numbers that are no stage of the method (`stages/measures.rs`).
//!
//! [`Pipeline::set`] drops what a change of settings makes stale; [`Pipeline::advance`] works on the first stage that is
//! missing. A change of the reduction rate alone costs a level and its deviation. Both go by the rows of the stages: a new one
//! has a name in [`stage`](super::stage), a slot in `Results`, and in `stages/` a line and a file with its row.

use std::sync::Arc;

use web_time::Instant;

use super::bound::Bound;
use super::connectivity::Connectivity;
use super::deviation::INTERACTIVE_SAMPLES;
use super::progressive::ProgressiveMesh;
use super::results::{
    Certified, Deviations, LevelMeasures, MendedSurface, Reduced, Results, Smoothed, SmoothedMeasures, StageTimes,
    Surface,
};
use super::safe::Safe;
use super::settings::{Settings, SettingsError, Target};
use super::smoothing::{KeptTerms, Preparation};
use super::stage::{PerStage, Stage, Wanted, stale};
use super::stages::Run;
use super::store::Store;
use super::task::{Budget, Progress, milliseconds};
use lumen_mesh::arrays::Association;
use lumen_mesh::mending::Faults;
use lumen_mesh::{Array, TriMesh};
use lumen_vessel::certificate::{Basis, CalibreError};

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

/// One opened surface and what the stages made of it so far.
pub struct Pipeline {
    store: Store,
    /// How much is made.
    wanted: Wanted,
    /// The last results that reached a level, for when the next are cancelled.
    last: Option<Results>,
    /// What is under way. A stage that a change of the settings does not touch goes on when its turn comes again.
    running: PerStage<Option<Run>>,
    /// The making of what makes another pass band cheap, which waits for the stages.
    preparation: Option<Preparation>,
}

impl Pipeline {
    /// A pipeline for an opened surface. Triangles must not repeat a vertex, coordinates must be finite (`io` sees to
    /// both).
    pub fn new(opened: Arc<TriMesh>, settings: Settings) -> Self {
        Self::over(Store::new(opened, settings, INTERACTIVE_SAMPLES), Wanted::Measures)
    }

    fn over(store: Store, wanted: Wanted) -> Self {
        Self { store, wanted, last: None, running: PerStage::default(), preparation: None }
    }

    /// Carries these along, which have a tuple for each vertex or triangle of the opened surface; others stay behind. To be
    /// said before there are levels.
    #[must_use]
    pub fn with_arrays(mut self, mut arrays: Vec<Array>) -> Self {
        let TriMesh { positions, triangles } = &*self.store.opened;
        arrays.retain(|array| {
            array.len() == if array.on == Association::Point { positions.len() } else { triangles.len() }
        });
        self.store.arrays = Arc::new(arrays);
        self
    }

    /// Sets the number of samples of each surface that the deviation takes.
    #[must_use]
    pub fn with_samples(mut self, samples: usize) -> Self {
        self.store.samples = samples;
        self
    }

    /// Leaves out deviation, shape and lumen: for who wants the level alone.
    #[must_use]
    pub fn without_measures(mut self) -> Self {
        self.wanted = Wanted::Level;
        self
    }

    /// Measures deviation, shape and lumen, and nothing that nobody has asked for.
    #[must_use]
    pub fn with_measures(mut self) -> Self {
        self.wanted = Wanted::Measures;
        self
    }

    /// Also measures what became of the calibre of each vessel.
    #[must_use]
    pub fn with_certificate(mut self) -> Self {
        self.wanted = Wanted::Certificate;
        self
    }

    /// As [`Self::with_certificate`], and finds how far a reduction is safe: for who looks at the level meanwhile. Where the
    /// target is auto they see 90 % first; for others how far is safe is found before the level is taken.
    #[must_use]
    pub fn with_safe(mut self) -> Self {
        self.wanted = Wanted::Safe;
        self
    }

    /// Another pipeline for the same surface, with all that this one has made and nothing under way: the results are
    /// shared, not copied.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self::over(self.store.fork(), self.wanted)
    }

    /// Changes the settings; what they made stale is dropped.
    ///
    /// # Errors
    /// When a setting is out of range; nothing changes then.
    pub fn set(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.check()?;
        let known = self.store.now.connectivity.as_ref().filter(|_| settings.mending == self.settings().mending);
        if let Some(found) = known {
            found.check(settings.keep)?;
        }
        if self.store.now.reduced.is_some() {
            self.last = Some(self.store.now.clone());
        }
        let old = std::mem::replace(&mut self.store.now.settings, settings);
        let stale = stale(&old, &self.store.now.settings);
        if stale[Stage::Smoothing] {
            self.preparation = None;
            self.store.is_smoothed_again |= self.store.now.smoothed.is_some();
        }
        if stale[Stage::Connectivity] {
            self.store.terms = None;
            self.store.widths = None;
            self.store.bands = None;
            self.store.is_smoothed_again = false;
        }
        for stage in Stage::ALL.into_iter().filter(|&stage| stale[stage]) {
            (stage.row().clear)(&mut self.store.now);
            self.running[stage] = None;
        }
        Ok(())
    }

    /// Whether [`Self::prepare`] has something to do.
    pub fn can_prepare(&self) -> bool {
        self.next_stage().is_none() && self.store.lacks_terms()
    }

    /// Works until `budget` is spent on what makes the next change of pass band or window cheap, while nothing else is
    /// to be done: the filter's terms, up to 64 MB. Says whether there is more to do.
    pub fn prepare(&mut self, budget: Budget) -> bool {
        let Some(kept) = self.store.now.kept.as_ref().filter(|_| self.can_prepare()) else { return false };
        let mut preparation =
            self.preparation.take().unwrap_or_else(|| KeptTerms::preparation(kept, &self.settings().smoothing));
        if let Progress::Done(terms) = preparation.advance(budget) {
            self.store.terms = terms.map(Arc::new);
            return false;
        }
        self.preparation = Some(preparation);
        true
    }

    /// Stops what is under way and goes back to the last settings that reached a level, with their results.
    pub fn cancel(&mut self) {
        self.running = PerStage::default();
        if let (None, Some(last)) = (&self.store.now.reduced, self.last.take()) {
            self.store.now = last;
        }
    }

    /// Whether there is a level to show, or to go back to.
    pub fn has_result(&self) -> bool {
        self.store.now.reduced.is_some() || self.last.is_some()
    }

    /// Works until `budget` is spent or a stage is finished.
    ///
    /// # Errors
    /// When a setting is out of range or names a component that the surface does not have.
    pub fn advance(&mut self, budget: Budget) -> Result<Advance, SettingsError> {
        let Some(stage) = self.next_stage() else { return Ok(Advance::Idle) };
        let start = Instant::now();
        let done = self.work(stage, budget);
        self.store.now.times.add(stage, milliseconds(start));
        match done {
            Progress::Working(fraction) => return Ok(Advance::Working(stage, fraction)),
            Progress::Done(done) => {
                self.running[stage] = None;
                done?;
            }
        }
        match stage {
            Stage::Level => self.last = None,
            Stage::Safe => self.step_back(),
            _ => {}
        }
        Ok(Advance::Finished(stage))
    }

    /// Drops a level of auto that goes another way than it is known by now to be safe.
    fn step_back(&mut self) {
        let now = &self.store.now;
        if now.reduced.as_ref().is_none_or(|reduced| reduced.target == now.target()) {
            return;
        }
        // Who cancels before the next level is there has this one, and that it is not known.
        self.last = Some(Results { safe: None, ..now.clone() });
        for stage in Stage::ALL.into_iter().filter(|stage| stage.rests_on(Stage::Level)) {
            (stage.row().clear)(&mut self.store.now);
            self.running[stage] = None;
        }
    }

    fn work(&mut self, stage: Stage, budget: Budget) -> Progress<Result<(), SettingsError>> {
        if self.running[stage].is_none() {
            self.store.now.times.begin(stage);
            self.running[stage] = (stage.row().start)(&self.store);
            if budget.is_spent() && self.running[stage].is_some() {
                return Progress::Working(0.0);
            }
        }
        match &mut self.running[stage] {
            Some(run) => run.advance(&mut self.store, budget),
            None => Progress::Done(Ok(())),
        }
    }

    /// Runs all stages to the end.
    ///
    /// # Errors
    /// When a setting is out of range or names a component that the surface does not have.
    pub fn finish(&mut self) -> Result<(), SettingsError> {
        while self.advance(Budget::UNLIMITED)? != Advance::Idle {}
        Ok(())
    }

    /// The first stage that is wanted and has no result.
    pub fn next_stage(&self) -> Option<Stage> {
        let now = &self.store.now;
        let is_missing = |stage: &Stage| (stage.row().is_wanted)(&now.settings, self.wanted) && !(stage.row().has)(now);
        // Nobody looks at a level that another may follow.
        let decides_first = self.is_deciding() && self.wanted < Wanted::Safe;
        let first = |stage: &Stage| is_missing(stage) && (!decides_first || Stage::Safe.rests_on(*stage));
        Stage::ALL.into_iter().find(first)
    }

    /// Whether the target is auto, and it is not known yet how far is safe.
    pub fn is_deciding(&self) -> bool {
        self.settings().target == Target::Auto && self.store.now.safe.is_none()
    }

    /// The surface as it was opened.
    pub fn opened(&self) -> &Arc<TriMesh> {
        &self.store.opened
    }

    /// The settings in force.
    pub fn settings(&self) -> &Settings {
        &self.store.now.settings
    }

    /// The surface that goes through the other stages: as it was opened, or mended.
    pub fn entering(&self) -> Option<&Arc<MendedSurface>> {
        self.store.now.mended.as_ref()
    }

    /// What is wrong with the surface as it was opened, where that was asked for.
    pub fn faults(&self) -> Option<&Arc<Faults>> {
        self.store.now.faults.as_ref()
    }

    /// The pieces that were found.
    pub fn connectivity(&self) -> Option<&Connectivity> {
        self.store.now.connectivity.as_deref()
    }

    /// The part of the surface that goes on.
    pub fn kept(&self) -> Option<&Arc<Surface>> {
        self.store.now.kept.as_ref()
    }

    /// The smoothed surface.
    pub fn smoothed(&self) -> Option<&Arc<Smoothed>> {
        self.store.now.smoothed.as_ref()
    }

    /// Every level.
    pub fn progressive(&self) -> Option<&Arc<ProgressiveMesh>> {
        self.store.now.levels.as_ref().map(|levels| &levels.progressive)
    }

    /// What the bound on the deviation led to, where the settings have one.
    pub fn bound(&self) -> Option<Bound> {
        self.store.now.bound
    }

    /// The level that the settings ask for.
    pub fn reduced(&self) -> Option<&Arc<Reduced>> {
        self.store.now.reduced.as_ref()
    }

    /// How far that level is from where it came from.
    pub fn deviations(&self) -> Option<&Arc<Deviations>> {
        self.store.now.deviations.as_ref()
    }

    /// Whether the surface has arrays.
    pub fn has_arrays(&self) -> bool {
        !self.store.arrays.is_empty()
    }

    /// The arrays of that level, for its vertices and triangles.
    pub fn level_arrays(&self) -> Option<&Arc<Vec<Array>>> {
        self.store.now.arrays.as_ref()
    }

    /// Shape and lumen of the smoothed surface.
    pub fn smoothed_measures(&self) -> Option<&Arc<SmoothedMeasures>> {
        self.store.now.smoothed_measures.as_ref()
    }

    /// Shape and lumen of the level.
    pub fn level_measures(&self) -> Option<&Arc<LevelMeasures>> {
        self.store.now.level_measures.as_ref()
    }

    /// How far a reduction is safe, where that was asked for.
    pub fn safe(&self) -> Option<&Arc<Safe>> {
        self.store.now.safe.as_ref()
    }

    /// Where the vessels are, or why there are none, where that was asked for.
    pub fn vessels(&self) -> Option<&Result<Arc<Basis>, CalibreError>> {
        self.store.now.vessels.as_ref()
    }

    /// What the level makes of the vessels, where that was asked for.
    pub fn certified(&self) -> Option<&Result<Arc<Certified>, CalibreError>> {
        self.store.now.certified.as_ref()
    }

    /// What each stage took.
    pub fn times(&self) -> StageTimes {
        self.store.now.times.told()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::settings::{Keep, Smoothing};
    use lumen_vessel::phantom::{Sample, generate};

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
    fn what_was_made_before_changes_no_number() {
        for smoothing in [Smoothing::PAPER, Smoothing { iterations: 0, ..Smoothing::default() }] {
            let settings = Settings { smoothing, target: Target::Reduction(900), ..Settings::default() };
            let mut again = finished();
            let mut anew = Pipeline::new(again.opened().clone(), settings.clone()).with_samples(2_000);
            again.set(settings).unwrap();
            for pipeline in [&mut again, &mut anew] {
                pipeline.finish().unwrap();
            }
            let [again, anew] = [again, anew].map(|pipeline| {
                let (apart, measured) = (pipeline.deviations().unwrap(), pipeline.smoothed_measures().unwrap());
                (apart.from_smoothed.clone(), apart.from_original.clone(), measured.shape.clone(), measured.pinch)
            });
            assert_eq!(again, anew);
        }
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
        for method in crate::settings::Method::ALL {
            let mut pipeline = finished();
            let decimation = crate::settings::Decimation { method, ..Default::default() };
            pipeline.set(Settings { decimation, ..Settings::default() }).unwrap();
            pipeline.finish().unwrap();
            let (found, reduced) = (pipeline.deviations().unwrap(), pipeline.reduced().unwrap());
            let deviation = found.from_smoothed.as_ref().unwrap().deviation;
            let positions = &pipeline.progressive().unwrap().positions;
            // Over the triangles of the level: their area, how much of it has the last colour, the sum of the colours.
            let [mut area, mut last, mut sum] = [0.0; 3];
            for corners in &reduced.level.triangles {
                let size = lumen_mesh::triangle_area(corners.map(|v| positions[v as usize]));
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
        assert!(told > 0.0 && told <= spent, "{told} of {spent} ms");
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
