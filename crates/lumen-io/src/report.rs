//! What an import found and what it mended.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::warnings::{Warning, in_english};
use super::{Axes, Unit};
use lumen_mesh::{Array, ArrayInfo, Bounds, TriMesh};
use lumen_volume::{Grid, Selection, shifts_mm};

/// A surface as it was read, and what is to be said about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The surface: welded, oriented, in mm, every vertex in use, no triangle with a repeated vertex.
    pub mesh: TriMesh,
    /// What the file has for its vertices and triangles, in their order; of vertices that were welded the mean, of labels
    /// the majority. Values are as they stand in the file: none is turned or scaled with the surface.
    pub arrays: Vec<Array>,
    /// What was found and mended.
    pub report: ImportReport,
}

/// Facts about a file and what was mended in it. The field names are the keys of the JSON that `lumen inspect`
/// prints: they are public and stay.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImportReport {
    /// What the file is: "STL binary", "STL ascii", "PLY ascii", "PLY binary little-endian",
    /// "PLY binary big-endian", "OBJ", "VTP", "VTU", "VTK ascii", "VTK binary", "GLB", "glTF", or what a generated surface calls itself.
    pub format: String,
    /// The unit that the file's numbers were taken in.
    pub unit: Unit,
    /// Whether that unit was taken because the surface would be of an unusual size in the one that the format says.
    #[serde(default)]
    pub unit_by_size: bool,
    /// Millimetres in one of that unit.
    pub scale_to_mm: f64,
    /// What the coordinates grow towards, as far as the file says: "lps", "ras" or "unknown".
    #[serde(default)]
    pub axes: Axes,
    /// Triangles that the file holds once its polygons are triangulated, degenerate ones included.
    pub triangles: usize,
    /// Vertices in use once coincident ones are welded.
    pub vertices: usize,
    /// Polygons of more than three corners that were triangulated.
    pub polygons_triangulated: usize,
    /// Triangles that repeat a vertex once coincident ones are welded; dropped.
    pub degenerate_triangles: usize,
    /// Triangles over the same three vertices as an earlier one; kept.
    pub duplicate_triangles: usize,
    /// Connected pieces (triangles that share a vertex belong together).
    pub components: usize,
    /// Triangles in the largest piece.
    pub largest_component_triangles: usize,
    /// Edges of one triangle.
    pub boundary_edges: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges of two triangles whose windings disagree in the file.
    pub winding_flips: usize,
    /// Triangles whose winding was reversed so that it agrees with their neighbours'.
    pub reoriented_triangles: usize,
    /// Components that faced inwards and were turned as a whole.
    pub components_turned: usize,
    /// Whether windings could be made to agree everywhere.
    pub orientable: bool,
    /// Surface area in mm2.
    pub area_mm2: f64,
    /// Enclosed volume in mm3, open ends capped; `None` where the surface is not orientable.
    pub volume_mm3: Option<f64>,
    /// The box around the surface, in mm.
    pub bounds_mm: Bounds,
    /// By what the surface was moved, in mm: not at all unless it lies so far from the origin of the file's coordinates
    /// that 32-bit numbers would not hold its detail, and the file has more digits than they do.
    #[serde(default)]
    pub moved_mm: [f64; 3],
    /// How it hangs on the threshold that it was made by; null of what was not made of a scan by one.
    #[serde(default)]
    pub threshold: Option<ThresholdReport>,
    /// The arrays that came with it.
    #[serde(default)]
    pub arrays: Vec<ArrayInfo>,
    /// What the file holds besides the surface.
    pub skipped: Skipped,
    /// What looks odd or was mended. In JSON these are English sentences, which are not read back.
    #[serde(default, serialize_with = "as_sentences", deserialize_with = "passed_over")]
    pub warnings: Vec<Warning>,
}

fn as_sentences<S: Serializer>(warnings: &[Warning], serializer: S) -> Result<S::Ok, S::Error> {
    in_english(warnings).serialize(serializer)
}

fn passed_over<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Warning>, D::Error> {
    Vec::<String>::deserialize(from).map(|_| Vec::new())
}

/// How the surface of a scan hangs on its threshold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThresholdReport {
    /// The threshold, in the unit of the scan.
    pub value: f64,
    /// By how much the wall would move outwards at a threshold 10 % lower, in mm: the radii of all vessels on average.
    pub lower_mm: f64,
    /// The same at one 10 % higher, negative where it would move inwards.
    pub higher_mm: f64,
}

impl ThresholdReport {
    /// Of `mesh`, the surface of a selection of `grid` in the grid's own coordinates; `None` where that is no threshold.
    pub fn new(grid: &Grid, mesh: &TriMesh, selection: Selection) -> Option<Self> {
        let Selection::Threshold(value) = selection else { return None };
        let [lower_mm, higher_mm] = shifts_mm(grid, mesh, selection)?;
        Some(Self { value, lower_mm, higher_mm })
    }
}

/// Parts of a file that are no surface and were left out, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Skipped {
    /// Faces of fewer than three corners.
    pub short_faces: usize,
    /// Lines and polylines.
    pub lines: usize,
    /// Point elements (vertices that nothing uses are not counted).
    pub points: usize,
}
