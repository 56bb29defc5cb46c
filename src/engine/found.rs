//! What the engine finds out about a surface: what its events carry.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::surfaces::{levels, surface};
use crate::io::{ImportReport, Unit, Warning};
use crate::mesh::mending::{FaultCounts, FaultPlace};
use crate::mesh::{TriMesh, Vec3};
use crate::pipeline::beside::{BesideReport, Distances};
use crate::pipeline::deviation::Deviation;
use crate::pipeline::histogram::Histogram;
use crate::pipeline::progressive::ProgressiveMesh;
use crate::pipeline::report::Report;
use crate::pipeline::settings::Keep;
use crate::prepare::Patch;
use crate::prepare::check::Fate;
use crate::prepare::cuts::{Cuts, PlannedEnd};
use crate::prepare::ends::EndPlane;
use crate::prepare::notes::{Note, PrepareError, Reason};
use crate::prepare::remesh::{Deviation as SolverDeviation, Quality};
use crate::sharing::Digest;
use crate::transfer::bulk;
use crate::vessel::certificate::{CalibreError, Certificate};

/// A surface that was opened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// That of the command.
    pub id: u64,
    /// The surface's name.
    pub name: String,
    /// The hash of its file; none of a sample.
    pub digest: Option<Digest>,
    /// What was found and mended.
    #[serde(with = "import_report")]
    pub report: ImportReport,
    /// All of it.
    #[serde(with = "surface")]
    pub mesh: Arc<TriMesh>,
}

/// Every level of the surface under some settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reduced {
    /// That of the settings.
    pub generation: u64,
    /// The pieces it is made from.
    pub keep: Keep,
    /// The levels.
    #[serde(with = "levels")]
    pub mesh: Arc<ProgressiveMesh>,
    /// How many nodes the finest of them uses.
    pub vertices: usize,
}

/// What came of comparing a surface with another file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilesCompared {
    /// That of the command.
    pub id: u64,
    /// What was found, or one plain sentence.
    pub outcome: Result<TwoFiles, String>,
}

/// A surface beside another file, both in the coordinates in which that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoFiles {
    /// What is compared with.
    #[serde(with = "surface")]
    pub reference: Arc<TriMesh>,
    /// What is judged, moved as was asked for.
    #[serde(with = "surface")]
    pub surface: Arc<TriMesh>,
    /// For each vertex of the reference the mean distance of the surface around it, in mm.
    pub over_reference: Over,
    /// The same for each vertex of the surface.
    pub over_surface: Over,
    /// The numbers.
    pub report: BesideReport,
    /// Why no vessels were measured.
    pub refused: Option<CalibreError>,
    /// The table of stations, where there are vessels.
    pub csv: Option<String>,
    /// Whether they lie so far apart that they are hardly of one vessel in one place.
    pub lie_apart: bool,
    /// Whether one is in LPS and the other in RAS, and neither was turned.
    pub axes_differ: bool,
    /// The unit of the numbers in the reference's file; none of a sample.
    pub unit: Option<Unit>,
    /// What looked odd about the reference's file.
    pub warnings: Vec<Warning>,
}

/// Mean distances around each vertex, in mm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Over {
    /// Without a sign.
    #[serde(with = "bulk")]
    pub plain: Vec<f32>,
    /// Positive where the surface lies outside the reference.
    #[serde(with = "bulk")]
    pub signed: Vec<f32>,
}

impl From<Distances> for Over {
    fn from(Distances { plain, signed }: Distances) -> Self {
        Self { plain, signed }
    }
}

/// What came of making a surface ready for a solver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolverReady {
    /// That of the command.
    pub id: u64,
    /// The surface, or why there is none.
    pub outcome: Result<Ready, PrepareError>,
}

/// What came of planning cuts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CutsPlanned {
    /// That of the command.
    pub id: u64,
    /// The cuts, or why there are none.
    pub outcome: Result<PlannedCuts, PrepareError>,
}

/// The ends of a surface, and what is cut off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedCuts {
    /// The surface.
    #[serde(with = "surface")]
    pub mesh: Arc<TriMesh>,
    /// For each triangle 0 where it stays, or 1 more than the place of the end with which it goes.
    #[serde(with = "bulk")]
    pub of_triangle: Vec<u32>,
    /// The ends.
    pub ends: Vec<CutEnd>,
    /// What cannot be cut as asked, but for what an end says itself.
    pub notes: Vec<Note>,
}

/// An end of a vessel, and where it is cut.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CutEnd {
    /// The centreline from the end inwards, as far as a plane may stand: x, y, z and radius, in mm.
    pub way: Vec<[f32; 4]>,
    /// The plane, where it is cut.
    pub plane: Option<CutPlane>,
    /// Why it cannot be cut as asked.
    pub why: Option<Reason>,
}

/// A plane that cuts a vessel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CutPlane {
    /// How far it is from the end along the centreline, in mm.
    pub arc_mm: f64,
    /// The middle of the section, in mm.
    pub centre: [f32; 3],
    /// Out of the vessel, of length 1.
    pub normal: [f32; 3],
    /// The radius of the circle of the section's area, in mm.
    pub radius_mm: f32,
}

impl From<Cuts> for PlannedCuts {
    fn from(Cuts { mesh, ends, of_triangle, notes }: Cuts) -> Self {
        let plane = |plane: EndPlane| CutPlane {
            arc_mm: plane.arc_mm,
            centre: plane.centre.as_vec3().to_array(),
            normal: plane.normal.as_vec3().to_array(),
            radius_mm: plane.radius_mm as f32,
        };
        let end = |end: PlannedEnd| CutEnd {
            way: end.way.iter().map(|place| place.at.as_vec3().extend(place.radius as f32).to_array()).collect(),
            plane: end.plane.map(plane),
            why: end.why,
        };
        Self { mesh: Arc::new(mesh), of_triangle, ends: ends.into_iter().map(end).collect(), notes }
    }
}

/// A surface in patches, and what there is to say of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ready {
    /// The surface.
    #[serde(with = "surface")]
    pub mesh: Arc<TriMesh>,
    /// For each triangle the place of its patch.
    #[serde(with = "bulk")]
    pub of_triangle: Vec<u32>,
    /// The patches, the wall first.
    pub patches: Vec<Patch>,
    /// What a volume mesher would say.
    pub fate: Fate,
    /// What was done otherwise than asked for.
    pub notes: Vec<Note>,
    /// Triangles that crossed before and after they were taken apart, where that was asked for.
    pub crossing: Option<[usize; 2]>,
    /// Shape and deviation of the triangles, where they were made anew.
    pub remeshed: Option<(Quality, SolverDeviation)>,
}

/// What a level makes of the vessels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibre {
    /// That of the settings.
    pub generation: u64,
    /// The calibre of each branch; or why there is none.
    pub found: Result<Certificate, CalibreError>,
    /// For each node of the level the change of calibre in percent, [`NOT_MEASURED`](crate::pipeline::results::NOT_MEASURED)
    /// where it is not known; empty where there are no branches.
    #[serde(with = "bulk")]
    pub change_by_node: Vec<f32>,
}

/// What the file says of the vertices and triangles of a level, as it is shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelArrays {
    /// That of the settings.
    pub generation: u64,
    /// For each array of the import report a number for each vertex of the level, one array after the other: its value,
    /// or its magnitude.
    #[serde(with = "bulk")]
    pub values: Vec<f32>,
}

/// What else is known of the deviation of a level, beside the numbers and the map from the smoothed surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deviated {
    /// That of the settings.
    pub generation: u64,
    /// Three numbers for each vertex of the level, in mm, one kind after the other: the mean signed distance from the
    /// smoothed surface around it, the mean distance from the opened one, and the mean signed distance from that.
    #[serde(with = "bulk")]
    pub values: Vec<f32>,
    /// How the samples are spread: from the smoothed surface, and from the opened one.
    pub histograms: [Histogram; 2],
}

/// What is wrong with a surface as it was opened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaultsFound {
    /// How often.
    pub counts: FaultCounts,
    /// Where: the first of each kind.
    pub places: Vec<FaultPlace>,
}

/// What the pipeline made at one of the settings to compare.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// That of the command.
    pub id: u64,
    /// Which of its settings.
    pub index: u32,
    /// The numbers, deviations among them.
    pub report: Report,
    /// The level, over its own vertices.
    #[serde(with = "surface")]
    pub mesh: Arc<TriMesh>,
}

/// How far a surface is from another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Differed {
    /// That of the command.
    pub id: u64,
    /// For each vertex of the other surface its mean distance from the first around it, in mm; empty where one of them
    /// has no area.
    #[serde(with = "bulk")]
    pub by_vertex: Vec<f32>,
    /// The numbers, where both have one.
    pub deviation: Option<Deviation>,
    /// The diameter of the first one's lumen where they are farthest apart, in mm, where a wall faces it.
    pub width_mm: Option<f32>,
}

/// What plain Laplacian smoothing makes of the surface that is open.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Averaged {
    /// That of the command.
    pub id: u64,
    /// That of the command.
    pub passes: u32,
    /// The pieces that were smoothed.
    pub keep: Keep,
    /// Where each vertex of the surface as it was opened is moved to, in mm; those of other pieces stay.
    #[serde(with = "bulk")]
    pub positions: Vec<Vec3>,
}

/// A report with its warnings as they are: its own JSON has their sentences.
mod import_report {
    use serde::{Deserializer, Serializer};

    use super::*;

    pub(super) fn serialize<S: Serializer>(report: &ImportReport, serializer: S) -> Result<S::Ok, S::Error> {
        (report, &report.warnings).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<ImportReport, D::Error> {
        let (report, warnings) = <(ImportReport, Vec<Warning>)>::deserialize(deserializer)?;
        Ok(ImportReport { warnings, ..report })
    }
}
