//! How long the stages of the pipeline took.

use serde::{Deserialize, Serialize};

use super::stage::{PerStage, Stage};

/// Milliseconds that each stage took when it last ran.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StageTimes {
    /// File to surface; set by whoever reads it.
    pub read: f64,
    /// Mending; next to nothing where it was not asked for.
    #[serde(default)]
    pub mending: f64,
    /// Pieces, and the surface of those that are kept.
    pub connectivity: f64,
    /// Who touches whom in what is kept; smoothing and decimation rest on it.
    #[serde(default)]
    pub adjacency: f64,
    /// Windowed sinc.
    pub smoothing: f64,
    /// All levels.
    pub decimation: f64,
    /// Finding the level for a bound on the deviation; 0 for another target.
    #[serde(default)]
    pub bound: f64,
    /// One level.
    pub level: f64,
    /// Vertex normals of the level.
    pub normals: f64,
    /// Areas and volumes of the pieces, the kept, the smoothed and the reduced surface.
    #[serde(default)]
    pub areas: f64,
    /// Both deviations.
    pub deviation: f64,
    /// The arrays that came with the file, carried to the level.
    #[serde(default)]
    pub arrays: f64,
    /// Shape and lumen of the smoothed surface, if it is new, and of the level.
    pub measures: f64,
    /// The vessels' calibre before and after smoothing, if it is new, and on the level; 0 where that was not asked for.
    #[serde(default)]
    pub calibre: f64,
    /// The search for faults of the surface as it was opened; 0 where that was not asked for.
    #[serde(default)]
    pub faults: f64,
    /// The search for how far a reduction is safe, when it last ran.
    #[serde(default)]
    pub safe: f64,
    /// Surface to file; set by whoever writes it.
    pub write: f64,
}

/// Milliseconds by stage, and what is told apart from the stage that it was part of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Times {
    stages: PerStage<f64>,
    parts: [f64; 5],
    /// Of the present slice: what is told apart.
    aside: f64,
}

/// What is told apart from the stage that it is part of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Adjacency,
    Normals,
    /// Areas and volumes, of each of the three surfaces.
    KeptAreas,
    SmoothedAreas,
    LevelAreas,
}

impl Times {
    /// The stage starts from nothing.
    pub(super) fn begin(&mut self, stage: Stage) {
        self.stages[stage] = 0.0;
    }

    /// A slice of the stage took so long, with what was told apart since the last.
    pub(super) fn add(&mut self, stage: Stage, ms: f64) {
        self.stages[stage] += ms - std::mem::take(&mut self.aside);
    }

    /// Tells a part of the slice under way, of so many milliseconds, apart from its stage.
    pub(super) fn tell_apart(&mut self, part: Part, ms: f64) {
        self.parts[part as usize] = ms;
        self.aside += ms;
    }

    /// As reports have them.
    pub(super) fn told(&self) -> StageTimes {
        let part = |part: Part| self.parts[part as usize];
        let mut told = StageTimes {
            adjacency: part(Part::Adjacency),
            normals: part(Part::Normals),
            areas: part(Part::KeptAreas) + part(Part::SmoothedAreas) + part(Part::LevelAreas),
            ..StageTimes::default()
        };
        for stage in Stage::ALL {
            *(stage.row().time)(&mut told) += self.stages[stage];
        }
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_of_a_stage_is_the_sum_of_its_slices_less_what_is_told_apart() {
        let mut times = Times::default();
        times.begin(Stage::Smoothing);
        times.add(Stage::Smoothing, 4.0);
        times.tell_apart(Part::Adjacency, 2.0);
        times.add(Stage::Smoothing, 8.0);
        times.add(Stage::Smoothing, 16.0);
        times.add(Stage::Level, 32.0);
        let told = times.told();
        assert_eq!((told.smoothing, told.adjacency, told.level), (26.0, 2.0, 32.0));
        times.begin(Stage::Smoothing);
        times.add(Stage::Smoothing, 1.0);
        assert_eq!((times.told().smoothing, times.told().level), (1.0, 32.0));
    }
}
