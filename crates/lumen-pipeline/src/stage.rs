//! The stages of the pipeline, in their order.
//!
//! What a stage needs, what of the settings decides it, what it leaves and what it does says its `Row`, in its file in
//! `stages/`. What [`run`](super::run) does by itself (what is stale after a change, what comes next) follows from these.

use serde::{Deserialize, Serialize};

use super::settings::Settings;
use super::stages::{Row, row};
use lumen_message::messages;

messages! {
    /// A stage of the pipeline, in their order. Its words are what it is called while it runs.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
    pub enum Stage {
        /// What is wrong with the surface is mended, where that was asked for.
        "panel-stage-mending" Mending => "Mending",
        /// Which pieces there are, and the ones that go on.
        "panel-stage-connectivity" Connectivity => "Finding pieces",
        /// The windowed-sinc filter.
        "panel-stage-smoothing" Smoothing => "Smoothing",
        /// The run that makes the progressive mesh.
        "panel-stage-decimation" Decimation => "Reducing",
        /// Which level stays within the bound on the deviation, if there is one.
        "panel-stage-bound" Bound => "Finding the level",
        /// One level of it.
        "panel-stage-level" Level => "Taking the level",
        /// How far it is from the smoothed surface and from the one that was opened.
        "panel-stage-deviation" Deviation => "Measuring deviation",
        /// What the file says of its vertices and triangles, for those of the level.
        "panel-stage-arrays" Arrays => "Carrying the arrays",
        /// Shape and lumen of the smoothed surface, and from which rate on a vessel of it is pinched.
        "panel-stage-measures" SmoothedMeasures => "Measuring shape and lumen",
        /// Shape and lumen of the level.
        "panel-stage-measures" Measures => "Measuring shape and lumen",
        /// What is wrong with the surface as it was opened.
        "panel-stage-faults" Faults => "Looking for faults",
        /// Where the vessels are, and how wide before and after smoothing.
        "panel-stage-vessels" Vessels => "Finding the vessels",
        /// Whether the level keeps the calibre of each.
        "panel-stage-certificate" Certificate => "Measuring calibre",
        /// Up to which rate every vessel keeps its calibre.
        "panel-stage-safe" Safe => "Finding how far is safe",
    }
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

    /// Whether the stage runs while the user works with the level, and nothing waits for it.
    pub fn is_background(self) -> bool {
        self.row().is_background
    }

    /// Whether its result is made from that of `other`, or is that itself.
    pub(super) fn rests_on(self, other: Self) -> bool {
        self == other || self.row().needs.iter().any(|below| below.rests_on(other))
    }

    pub(super) fn row(self) -> &'static Row {
        row(self)
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

/// Which stages are others after a change of the settings: those that it decides anew, and all that need them.
pub(super) fn stale(old: &Settings, new: &Settings) -> PerStage<bool> {
    let mut stale = PerStage::default();
    for stage in Stage::ALL {
        stale[stage] = (stage.row().is_decided_anew)(old, new) || stage.row().needs.iter().any(|&below| stale[below]);
    }
    stale
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::{Keep, Mending, Smoothing, Target};

    #[test]
    fn no_stage_needs_a_later_one() {
        for (i, stage) in Stage::ALL.into_iter().enumerate() {
            assert_eq!(stage as usize, i);
            assert!(stage.row().needs.iter().all(|&below| below < stage), "{stage:?}");
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
