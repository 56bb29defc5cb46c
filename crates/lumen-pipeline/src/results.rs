//! What the stages of the pipeline make, a slot each.

use std::sync::{Arc, OnceLock};

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::bound::Bound;
use super::caps::{CapArea, Capped};
use super::connectivity::Connectivity;
use super::deviation::Comparison;
use super::filter::Filter;
use super::pinch::Pinch;
use super::progressive::{Level, ProgressiveMesh};
use super::response::SmoothingResponse;
use super::safe::Safe;
use super::settings::{Settings, Target};
use super::shape::Shape;
pub use super::times::StageTimes;
use super::times::Times;
use lumen_mesh::mending::{Faults, MendReport};
use lumen_mesh::{Array, Ball, Measures, SurfaceIndex, Topology, TriMesh};
use lumen_vessel::certificate::{Basis, BranchCalibre, CalibreError, Certificate};
use lumen_vessel::width::Narrowing;

/// What the stages made, a slot each; shared, so that a copy costs nothing.
#[derive(Clone, Default)]
pub(super) struct Results {
    pub(super) settings: Settings,
    /// Mending.
    pub(super) mended: Option<Arc<MendedSurface>>,
    /// The pieces of that: the same whichever of them are kept.
    pub(super) connectivity: Option<Arc<Connectivity>>,
    /// Connectivity.
    pub(super) kept: Option<Arc<Surface>>,
    /// Smoothing.
    pub(super) smoothed: Option<Arc<Smoothed>>,
    /// Decimation.
    pub(super) levels: Option<Levels>,
    /// The search for the level within a bound.
    pub(super) bound: Option<Bound>,
    /// The level.
    pub(super) reduced: Option<Arc<Reduced>>,
    /// Its deviation.
    pub(super) deviations: Option<Arc<Deviations>>,
    /// The level's arrays.
    pub(super) arrays: Option<Arc<Vec<Array>>>,
    /// Shape and lumen of the smoothed surface.
    pub(super) smoothed_measures: Option<Arc<SmoothedMeasures>>,
    /// Shape and lumen of the level.
    pub(super) level_measures: Option<Arc<LevelMeasures>>,
    /// What is wrong with the surface as it was opened.
    pub(super) faults: Option<Arc<Faults>>,
    /// Where the vessels are, or why there are none.
    pub(super) vessels: Option<Result<Arc<Basis>, CalibreError>>,
    /// What the level makes of them.
    pub(super) certified: Option<Result<Arc<Certified>, CalibreError>>,
    /// How far a reduction is safe.
    pub(super) safe: Option<Arc<Safe>>,
    /// Of the level whose vessels were measured last, or of that at 90 %.
    pub(super) calibres: Option<Arc<LevelCalibres>>,
    pub(super) indices: Indices,
    pub(super) times: Times,
}

impl Results {
    /// How far the level goes: the settings' target, where it is auto with the rate that it has come to so far.
    pub(super) fn target(&self) -> Target {
        let Target::Auto = self.settings.target else { return self.settings.target };
        let pinch = self.smoothed_measures.as_ref().and_then(|found| found.pinch);
        Target::Reduction(self.safe.as_ref().map_or(Target::AUTO_PER_MILLE, |safe| safe.auto(pinch)))
    }
}

/// What the vessels have at a level: the certificate and the search for the safe rate ask for the same.
pub(super) struct LevelCalibres {
    pub(super) steps: u32,
    pub(super) tolerance_percent: f64,
    pub(super) branches: Vec<BranchCalibre>,
}

impl LevelCalibres {
    /// Those of the level after so many steps, if they are known.
    pub(super) fn at(&self, steps: u32, tolerance_percent: f64) -> Option<Vec<BranchCalibre>> {
        let is_it = self.steps == steps && self.tolerance_percent == tolerance_percent;
        is_it.then(|| self.branches.clone())
    }
}

/// What decimation leaves.
#[derive(Clone, Debug)]
pub(super) struct Levels {
    pub(super) progressive: Arc<ProgressiveMesh>,
    /// For each node the vertex that it was, where there are arrays to carry.
    pub(super) vertex_of_node: Arc<[u32]>,
}

/// Indices that one stage built and others use: they go with the surface that they are of.
#[derive(Clone, Debug, Default)]
pub(super) struct Indices {
    pub(super) kept: Option<Arc<SurfaceIndex>>,
    pub(super) smoothed: Option<Arc<SurfaceIndex>>,
    /// Of the level, from its deviation to its measures.
    pub(super) level: Option<Arc<SurfaceIndex>>,
}

/// Triangles of the smoothed surface up to which its index is kept from one level to the next: 63 bytes for each, and 16 more with
/// its planes. In the four gigabytes that a page's program can have, those of ten million left no room for the finding of the
/// vessels (`tests/browser/large.test.mjs`); everything else grows by the triangles as well, so that four million have room.
const KEPT_INDEX: usize = if usize::BITS < 64 { 4_000_000 } else { usize::MAX };

impl Indices {
    /// A level of a surface of `triangles` is measured: what only it has asked for is given up.
    pub(super) fn release(&mut self, triangles: usize) {
        self.let_go_beyond(triangles, KEPT_INDEX);
    }

    fn let_go_beyond(&mut self, triangles: usize, most: usize) {
        self.level = None;
        if triangles > most {
            self.smoothed = None;
        }
    }
}

/// The surface that goes through the other stages: as it was opened, or mended.
#[derive(Clone, Debug)]
pub struct MendedSurface {
    /// The surface: the opened one itself where mending changed nothing.
    pub mesh: Arc<TriMesh>,
    /// Its arrays.
    pub arrays: Arc<Vec<Array>>,
    /// What was mended; `None` where nothing was asked for.
    pub report: Option<MendReport>,
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
    /// Its flat caps, once they are looked for, if it has some.
    pub caps: OnceLock<Option<Box<Capped>>>,
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
    /// Where vessels asked for a wider pass band than the settings'; `None` where none did, or was not asked.
    pub adapted: Option<Adapted>,
    /// Where the filter was weakened, so that no triangles cross; `None` where it was nowhere.
    pub weakened: Option<Weakened>,
    /// Whether it is known that no triangle crosses another.
    pub crosses_nothing: bool,
    /// Its area and volume.
    pub measures: Measures,
}

/// What adapting to the calibre came to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Adapted {
    /// The part of the vertices with a wider pass band than the settings', in percent.
    pub vertices_percent: f64,
    /// The widest pass band, that of the thinnest vessel.
    pub widest_pass_band: f64,
}

impl Adapted {
    /// Sums up the pass bands that vessels ask for, where the settings have `pass_band`.
    pub(super) fn of(bands: &[f32], pass_band: f64) -> Option<Self> {
        let wider = bands.iter().filter(|&&band| f64::from(band) > pass_band).count();
        let widest = bands.iter().fold(0.0f32, |widest, &band| widest.max(band));
        let vertices_percent = 100.0 * wider as f64 / bands.len() as f64;
        (wider > 0).then_some(Self { vertices_percent, widest_pass_band: f64::from(widest) })
    }
}

/// Where the filter was weakened.
#[derive(Clone, Debug, PartialEq)]
pub struct Weakened {
    /// The part of its way by which each vertex was put back, 0 to 1.
    pub parts: Vec<f32>,
    /// Triangles that the filter alone would have made cross.
    pub spared: usize,
}

/// A level as a surface of its own.
#[derive(Debug)]
pub struct Reduced {
    /// What it was taken for; a rate where the settings leave it to the pipeline.
    pub target: Target,
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

/// What is measured of the smoothed surface.
#[derive(Clone, Debug)]
pub struct SmoothedMeasures {
    /// Its shape.
    pub shape: Shape,
    /// The middles of its vessels, each with its clearance.
    pub samples: Arc<[Ball]>,
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
    /// The areas of the opened surface's flat caps.
    pub caps: Vec<CapArea>,
}

/// What a level makes of the vessels.
#[derive(Debug)]
pub struct Certified {
    /// The calibre of each branch.
    pub certificate: Certificate,
    /// For each node of the level the change of calibre from the opened surface in percent; [`NOT_MEASURED`] where there
    /// is no vessel that can be measured, and for other nodes.
    pub change_by_node: Vec<f32>,
}

/// No change of calibre that is known: more than any.
pub const NOT_MEASURED: f32 = 1e30;

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
    fn the_index_of_a_large_smoothed_surface_is_given_up_and_that_of_the_opened_surface_stays() {
        let some = || Some(Arc::new(SurfaceIndex::default()));
        for (triangles, is_kept) in [(1000, true), (1001, false)] {
            let mut indices = Indices { kept: some(), smoothed: some(), level: some() };
            indices.let_go_beyond(triangles, 1000);
            let has = [&indices.kept, &indices.smoothed, &indices.level].map(Option::is_some);
            assert_eq!(has, [true, is_kept, false], "{triangles}");
        }
    }

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
