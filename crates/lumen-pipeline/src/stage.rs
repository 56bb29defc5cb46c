//! The stages of the pipeline: their order, what each rests on, and what of the settings decides it.
//!
//! What [`run`](super::run) does by itself (what is stale after a change, what comes next) follows from this table; what a
//! stage does is its file in `stages/`, and what it leaves its slot in [`results`](super::results).

use serde::{Deserialize, Serialize};

use super::settings::Settings;
use lumen_language::say;

/// A stage of the pipeline, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Stage {
    /// What is wrong with the surface is mended, where that was asked for.
    Mending,
    /// Which pieces there are, and the ones that go on.
    Connectivity,
    /// The windowed-sinc filter.
    Smoothing,
    /// The run that makes the progressive mesh.
    Decimation,
    /// Which level stays within the bound on the deviation, if there is one.
    Bound,
    /// One level of it.
    Level,
    /// How far it is from the smoothed surface and from the one that was opened.
    Deviation,
    /// What the file says of its vertices and triangles, for those of the level.
    Arrays,
    /// Shape and lumen of the smoothed surface, and from which rate on a vessel of it is pinched.
    SmoothedMeasures,
    /// Shape and lumen of the level.
    Measures,
    /// What is wrong with the surface as it was opened.
    Faults,
    /// Where the vessels are, and how wide before and after smoothing.
    Vessels,
    /// Whether the level keeps the calibre of each.
    Certificate,
    /// Up to which rate every vessel keeps its calibre.
    Safe,
}

impl Stage {
    /// All, in their order.
    pub const ALL: [Self; 14] = [
        Self::Mending,
        Self::Connectivity,
        Self::Smoothing,
        Self::Decimation,
        Self::Bound,
        Self::Level,
        Self::Deviation,
        Self::Arrays,
        Self::SmoothedMeasures,
        Self::Measures,
        Self::Faults,
        Self::Vessels,
        Self::Certificate,
        Self::Safe,
    ];

    /// What the stage is called while it runs, in the language that is spoken.
    pub fn label(self) -> String {
        match self {
            Self::Mending => say!("panel-stage-mending"),
            Self::Connectivity => say!("panel-stage-connectivity"),
            Self::Smoothing => say!("panel-stage-smoothing"),
            Self::Decimation => say!("panel-stage-decimation"),
            Self::Bound => say!("panel-stage-bound"),
            Self::Level => say!("panel-stage-level"),
            Self::Deviation => say!("panel-stage-deviation"),
            Self::Arrays => say!("panel-stage-arrays"),
            Self::SmoothedMeasures | Self::Measures => say!("panel-stage-measures"),
            Self::Faults => say!("panel-stage-faults"),
            Self::Vessels => say!("panel-stage-vessels"),
            Self::Certificate => say!("panel-stage-certificate"),
            Self::Safe => say!("panel-stage-safe"),
        }
    }

    /// The stages whose results it takes.
    fn rests_on(self) -> &'static [Self] {
        match self {
            Self::Mending | Self::Faults => &[],
            Self::Connectivity => &[Self::Mending],
            Self::Smoothing => &[Self::Connectivity],
            Self::Decimation => &[Self::Smoothing],
            Self::Bound | Self::SmoothedMeasures => &[Self::Decimation],
            Self::Level => &[Self::Decimation, Self::Bound],
            Self::Deviation | Self::Arrays => &[Self::Level],
            Self::Measures => &[Self::Level, Self::SmoothedMeasures],
            Self::Vessels => &[Self::Smoothing],
            Self::Certificate => &[Self::Level, Self::Vessels],
            Self::Safe => &[Self::SmoothedMeasures, Self::Vessels],
        }
    }

    /// Whether other settings make it another by themselves.
    fn is_decided_anew(self, old: &Settings, new: &Settings) -> bool {
        match self {
            Self::Mending => old.mending != new.mending,
            Self::Connectivity => old.keep != new.keep,
            Self::Smoothing => !old.smoothing.gives_same(&new.smoothing),
            Self::Decimation => !old.decimation.gives_same(&new.decimation),
            Self::Bound | Self::Level => old.target != new.target,
            Self::Certificate | Self::Safe => old.tolerance_percent != new.tolerance_percent,
            Self::Deviation | Self::Arrays | Self::SmoothedMeasures | Self::Measures | Self::Faults | Self::Vessels => {
                false
            }
        }
    }

    /// Whether it is made at all.
    pub(super) fn is_wanted(self, settings: &Settings, wanted: Wanted) -> bool {
        match self {
            Self::Bound => settings.target.deviation_mm().is_some(),
            Self::Deviation | Self::Arrays | Self::SmoothedMeasures | Self::Measures => wanted >= Wanted::Measures,
            Self::Faults | Self::Vessels | Self::Certificate => wanted >= Wanted::Certificate,
            Self::Safe => wanted >= Wanted::Safe,
            Self::Mending | Self::Connectivity | Self::Smoothing | Self::Decimation | Self::Level => true,
        }
    }
}

/// How much is made. Who wants the level alone leaves out the measures, and few want the vessels' calibre, or to know how
/// far is safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Wanted {
    Level,
    Measures,
    Certificate,
    Safe,
}

/// Something for each stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct PerStage<T>([T; Stage::ALL.len()]);

impl<T> std::ops::Index<Stage> for PerStage<T> {
    type Output = T;

    fn index(&self, stage: Stage) -> &T {
        &self.0[stage as usize]
    }
}

impl<T> std::ops::IndexMut<Stage> for PerStage<T> {
    fn index_mut(&mut self, stage: Stage) -> &mut T {
        &mut self.0[stage as usize]
    }
}

/// Which stages are others after a change of the settings: those that it decides anew, and all that rest on them.
pub(super) fn stale(old: &Settings, new: &Settings) -> PerStage<bool> {
    let mut stale = PerStage::default();
    for stage in Stage::ALL {
        stale[stage] = stage.is_decided_anew(old, new) || stage.rests_on().iter().any(|&below| stale[below]);
    }
    stale
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::{Keep, Mending, Smoothing, Target};

    #[test]
    fn no_stage_rests_on_a_later_one() {
        for (i, stage) in Stage::ALL.into_iter().enumerate() {
            assert_eq!(stage as usize, i);
            assert!(stage.rests_on().iter().all(|&below| below < stage), "{stage:?}");
        }
    }

    #[test]
    fn a_change_makes_stale_what_it_touches_and_nothing_before() {
        let old = Settings::default();
        let smoothing = Smoothing { iterations: old.smoothing.iterations + 1, ..old.smoothing };
        let changes = [
            (old.clone(), None),
            (Settings { mending: Mending { split: true, ..Mending::default() }, ..old.clone() }, Some(Stage::Mending)),
            (Settings { keep: Keep::All, ..old.clone() }, Some(Stage::Connectivity)),
            (Settings { smoothing, ..old.clone() }, Some(Stage::Smoothing)),
            (Settings { target: Target::Reduction(10), ..old.clone() }, Some(Stage::Bound)),
            (Settings { tolerance_percent: 5.0, ..old.clone() }, Some(Stage::Certificate)),
        ];
        for (new, first) in changes {
            let stale = stale(&old, &new);
            let expected = |stage: Stage| match first {
                None => false,
                // What the file holds is the same whatever is made of it.
                _ if stage == Stage::Faults => false,
                // What is measured of the smoothed surface and of all levels is the same for every level.
                Some(Stage::Bound) => {
                    let of_all = [Stage::SmoothedMeasures, Stage::Vessels, Stage::Safe];
                    stage >= Stage::Bound && !of_all.contains(&stage)
                }
                Some(Stage::Certificate) => stage >= Stage::Certificate,
                Some(first) => stage >= first,
            };
            for stage in Stage::ALL {
                assert_eq!(stale[stage], expected(stage), "{stage:?} after a change of {first:?}");
            }
        }
    }
}
