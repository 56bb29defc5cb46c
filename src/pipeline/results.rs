//! What the stages of the pipeline make, and how long they took.

use std::sync::Arc;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::deviation::Comparison;
use super::filter::Filter;
use super::progressive::Level;
use super::response::SmoothingResponse;
use crate::mesh::{Measures, Topology, TriMesh};

/// A stage of the pipeline, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Stage {
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
    /// Shape and lumen of the smoothed surface and of the level.
    Measures,
}

impl Stage {
    /// What the stage is called while it runs.
    pub fn label(self) -> &'static str {
        match self {
            Self::Connectivity => "Finding pieces",
            Self::Smoothing => "Smoothing",
            Self::Decimation => "Reducing",
            Self::Bound => "Finding the level",
            Self::Level => "Taking the level",
            Self::Deviation => "Measuring deviation",
            Self::Measures => "Measuring shape and lumen",
        }
    }
}

/// Milliseconds that each stage took when it last ran.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StageTimes {
    /// File to surface; set by whoever reads it.
    pub read: f64,
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
    /// Shape and lumen of the smoothed surface, if it is new, and of the level.
    pub measures: f64,
    /// Surface to file; set by whoever writes it.
    pub write: f64,
}

impl StageTimes {
    pub(super) fn of(&mut self, stage: Stage) -> &mut f64 {
        match stage {
            Stage::Connectivity => &mut self.connectivity,
            Stage::Smoothing => &mut self.smoothing,
            Stage::Decimation => &mut self.decimation,
            Stage::Bound => &mut self.bound,
            Stage::Level => &mut self.level,
            Stage::Deviation => &mut self.deviation,
            Stage::Measures => &mut self.measures,
        }
    }
}

/// A surface on its way, with its topology and measures.
#[derive(Debug)]
pub struct Surface {
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// Adjacency of its triangles.
    pub topology: Arc<Topology>,
    /// Its boundary loops; `None` where its windings do not agree.
    pub loops: Option<Vec<Vec<u32>>>,
    /// Its area and volume.
    pub measures: Measures,
}

/// The smoothed surface: the triangles of the kept one.
#[derive(Debug)]
pub struct Smoothed {
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// The filter that made it; `None` where smoothing was skipped.
    pub filter: Option<Filter>,
    /// Which waves that filter leaves; `None` likewise.
    pub response: Option<SmoothingResponse>,
    /// Whether the volume was held to 0.01 %; `None` where that was not asked for.
    pub volume_held: Option<bool>,
    /// Its area and volume.
    pub measures: Measures,
}

/// A level as a surface of its own.
#[derive(Debug)]
pub struct Reduced {
    /// The level over the nodes of the progressive mesh.
    pub level: Level,
    /// The level over its own vertices.
    pub mesh: Arc<TriMesh>,
    /// Adjacency of its triangles.
    pub topology: Arc<Topology>,
    /// Vertex normals, weighted by area.
    pub normals: Vec<Vec3>,
    /// Its area and volume.
    pub measures: Measures,
    /// A number that differs where surfaces do: see [`fingerprint`].
    pub fingerprint: u64,
}

/// How far a level is from where it came from.
#[derive(Debug)]
pub struct Deviations {
    /// From the smoothed surface; `None` where one of the two has no area.
    pub from_smoothed: Option<Comparison>,
    /// From the surface as it was opened.
    pub from_original: Option<Comparison>,
    /// For each node of the level, the mean deviation from the smoothed surface around it, in mm, by the samples of
    /// which `from_smoothed` gives the numbers; 0 for other nodes.
    pub by_node: Vec<f32>,
}

/// A number by which two runs can see that they made the same surface: FNV-1a (Fowler, Noll, Vo), 64 bits, over the
/// positions' and the triangles' 32-bit words.
pub fn fingerprint(mesh: &TriMesh) -> u64 {
    const PRIME: u64 = 0x0000_0100_0000_01b3;
    let words = bytemuck::cast_slice::<_, u32>(&mesh.positions).iter().chain(mesh.triangles.as_flattened());
    words.fold(0xcbf2_9ce4_8422_2325, |hash, &word| (hash ^ u64::from(word)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_have_one_fingerprint_only_where_they_are_the_same() {
        let mesh = TriMesh { positions: vec![Vec3::X, Vec3::Y, Vec3::Z], triangles: vec![[0, 1, 2]] };
        let mut other = mesh.clone();
        assert_eq!(fingerprint(&mesh), fingerprint(&other));
        other.triangles[0].rotate_left(1);
        assert_ne!(fingerprint(&mesh), fingerprint(&other));
        other = mesh.clone();
        other.positions[1].x = f32::from_bits(1);
        assert_ne!(fingerprint(&mesh), fingerprint(&other));
    }
}
