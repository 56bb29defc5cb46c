//! What a user should hear about a surface or a scan that was opened.

use lumen_message::{Told, grouped, messages};
use serde::{Deserialize, Serialize};

use super::Unit;
use super::offer::VolumeField;
use super::report::{ImportReport, Skipped};
use super::size::{Length, UnusualSize};

messages! {
    /// What looks odd in a file, or was mended.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum Warning {
        "errors-stl-trailing" StlTrailing { bytes: usize } => "{bytes} bytes after the last triangle left out.",
        "errors-stl-count" StlCount { announced: u32, found: usize } =>
            "The number of triangles that the file announces ({announced}) does not go with its length: {found} read.",
        "errors-stl-fewer" StlFewer { announced: u32, found: usize } =>
            "The number of triangles that the file announces ({announced}) does not go with its length: {found} read. The file may be cut short.",
        "errors-stl-open" StlOpen => "The file may be cut short: its last solid has no end.",
        "errors-ply-trailing" PlyTrailing { bytes: usize } => "{bytes} bytes after the last element left out.",
        "errors-ply-unannounced" PlyUnannounced =>
            "Numbers that the file's header does not announce were left out.",
        "errors-ply-more-numbers" PlyMoreNumbers => "Numbers after the last element were left out.",
        "errors-vtk-solids-left-out" SolidCells { cells: u64 } =>
            "{cells} solid or curved cells left out: Lumen shows surfaces.",
        "errors-vtk-curved" CurvedCells { count: usize } => (
            count,
            "{count} curved face taken as flat: only its corners are kept.",
            "{count} curved faces taken as flat: only their corners are kept."
        ),
        "errors-gltf-instances" GltfInstances =>
            "Copies of meshes (EXT_mesh_gpu_instancing) left out: each is read once.",
        "errors-gltf-morphs" GltfMorphs => "Morph targets left out: meshes are read in their base shape.",
        "errors-fanned" Fanned { count: usize } => (
            count,
            "{count} polygon could not be cut into triangles without folding, having no area or crossing itself.",
            "{count} polygons could not be cut into triangles without folding, having no area or crossing itself."
        ),
        "errors-array-left-out" ArrayLeftOut { name: String, why: ArrayProblem } => "The array {name} is left out: {why}.",
        "errors-arrays-more" MoreArrays { count: usize } => (
            count,
            "{count} more array is left out.",
            "{count} more arrays are left out."
        ),
        "errors-moved" Moved { x: Length, y: Length, z: Length } =>
            "The surface lies far from the origin of its coordinates: it was moved by ({x}, {y}, {z}) mm to keep its detail, and is saved there.",
        "errors-degenerate" Degenerate { count: usize } => (
            count,
            "{count} triangle with a repeated vertex dropped.",
            "{count} triangles with a repeated vertex dropped."
        ),
        "errors-duplicate" Duplicate { count: usize } => (
            count,
            "{count} triangle present twice; kept.",
            "{count} triangles present twice; kept."
        ),
        "errors-short-faces" ShortFaces { count: usize } => (
            count,
            "{count} face of fewer than three corners left out.",
            "{count} faces of fewer than three corners left out."
        ),
        "errors-lines-left-out" Lines { count: usize } => (
            count,
            "{count} line left out: Lumen shows surfaces.",
            "{count} lines left out: Lumen shows surfaces."
        ),
        "errors-points-left-out" Points { count: usize } => (
            count,
            "{count} point left out: Lumen shows surfaces.",
            "{count} points left out: Lumen shows surfaces."
        ),
        "errors-reoriented" Reoriented { count: usize } => (
            count,
            "{count} triangle turned over to agree with the neighbours.",
            "{count} triangles turned over to agree with the neighbours."
        ),
        "errors-turned" Turned { count: usize } => (
            count,
            "{count} piece found inside out and turned.",
            "{count} pieces found inside out and turned."
        ),
        "errors-non-manifold" NonManifold { count: usize } => (
            count,
            "{count} edge where more than two triangles meet; left as in the file.",
            "{count} edges where more than two triangles meet; left as in the file."
        ),
        "errors-no-inside" NoInside =>
            "The surface has no inside and outside (its triangles cannot be made to agree).",
        "errors-unit-by-size" UnitBySize { unit: Unit } =>
            "The numbers of the file were taken in {unit}, by the size of the surface.",
    } or {
        /// The surface has a size that vessels seldom have.
        Size(UnusualSize),
        /// Of a scan or a mask.
        Scan(ScanWarning),
    }
}

messages! {
    /// Why an array is left out.
    #[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum ArrayProblem {
        "errors-array-parts" Parts => "its parts do not go together",
        "errors-array-beyond" Beyond { most: usize } =>
            { format!("only the first {} arrays of a file are read", grouped(*most)) },
        "errors-array-not-everywhere" NotEverywhere => "not every part of the file has it",
        "errors-array-damaged" Damaged => "its data are damaged or elsewhere",
        "errors-array-matrices" Matrices => "it holds matrices",
        "errors-array-other-length" OtherLength => "it has another length than the surface",
        "errors-array-memory" Memory => "it would take more memory than a file of this size is given",
        "errors-array-cut-short" CutShort => "it is cut short",
        "errors-array-no-number" NoNumber => "it holds what is no number",
        "errors-array-text" Text => "it holds text",
        "errors-array-type" NumberType => "its numbers are of a type that is not read",
        "errors-array-too-many" TooMany => "its data are damaged, or too many for a file of this size",
        "errors-array-of-type" OfType { kind: String } => "it holds values of the type {kind}",
        "errors-array-not-understood" NotUnderstood => "it and what follows are not understood",
    }
}

messages! {
    /// What a user should hear about a scan or a mask.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum ScanWarning {
        "scan-silent" Silent { format: String } =>
            "The {format} file does not say which way the patient lies: the axes are unknown.",
        "scan-silent-format" SilentFormat { format: String } =>
            "{format} does not say which way the patient lies: the axes are unknown.",
        "scan-unknown-unit" UnknownUnit { format: String, unit: String } =>
            "The unit of length of the {format} file, {unit}, is not known: it is taken as mm.",
        "scan-nifti-no-matrix" NoMatrix =>
            "The NIfTI file's matrix (sform) is unusable: its directions span no space. The quaternion (qform) is used instead.",
        "scan-nifti-no-place" NoPlace =>
            "The NIfTI file's matrix (sform) is unusable: its directions span no space. There is no usable quaternion (qform), and the spacings are used instead.",
        "scan-nifti-spacings" Spacings { matrix: f64 [3], stated: f64 [3] } =>
            "The NIfTI file contradicts itself: by its matrix (sform) voxels are {matrix:.3} mm apart, by its spacings {stated:.3} mm. The matrix is taken.",
        "scan-dicom-unreadable" Unreadable { count: usize, why: Told } => {
            match *count {
                1 => format!("One slice cannot be read and is left out. {why}"),
                count => format!("{} slices cannot be read and are left out. {why}", grouped(count)),
            }
        },
        "scan-dicom-same-place" SamePlace { count: usize } =>
            {
                match count {
                    1 => "1 slice is there twice: the same place and the same pixels; one is taken.".to_owned(),
                    _ => format!("{} slices are there twice: the same place and the same pixels; one of each is taken.", grouped(*count)),
                }
            },
        "scan-dicom-series" Series { count: usize, taken: usize, slices: usize, others: usize } => {
            let of = match *others {
                1 => "the other series".to_owned(),
                others => format!("{} other series", grouped(others)),
            };
            let (count, taken, slices) = (grouped(*count), grouped(*taken), grouped(*slices));
            format!("The files hold {count} series. The volume with most slices ({taken}) is opened. Slices of {of} left out: {slices}.")
        },
        "scan-dicom-mixed-left-out" MixedLeftOut { count: usize } => (
            count,
            "{count} volume is left out: several of its slices lie at one place, and nothing in the files says which volume each is of.",
            "{count} volumes are left out: several of their slices lie at one place, and nothing in the files says which volume each is of."
        ),
        "scan-volumes" Volumes { count: usize, by: VolumeField, list: String, taken: String } =>
            "The files hold {count} volumes of one series, told apart by {by}; each with its number of slices: {list}. Volume {taken} is open.",
        "scan-dicom-no-slices" NoSlices { count: usize } =>
            {
                match count {
                    1 => "1 file holds no slice in shades of grey and is left out.".to_owned(),
                    _ => format!("{} files hold no slice in shades of grey and are left out.", grouped(*count)),
                }
            },
        "scan-dicom-gap" Gap { usual: f64 [3], there: f64 [3], below: usize, above: usize } =>
            "The slices are not evenly apart: mostly {usual:.3} mm, but {there:.3} mm between slices {below} and {above}; some may be missing, and the surface is stretched there.",
        "scan-dicom-squeeze" Squeeze { usual: f64 [3], there: f64 [3], below: usize, above: usize } =>
            "The slices are not evenly apart: mostly {usual:.3} mm, but {there:.3} mm between slices {below} and {above}; the surface is pressed together there.",
    }
}

/// The English sentence of each.
pub fn in_english(warnings: &[Warning]) -> Vec<String> {
    warnings.iter().map(ToString::to_string).collect()
}

/// The warnings that follow from the numbers of a report.
pub(super) fn warnings(report: &ImportReport) -> Vec<Warning> {
    let mut warnings: Vec<Warning> = report.unusual_size().map(Warning::from).into_iter().collect();
    let mut tell = |is_so: bool, warning: Warning| warnings.extend(is_so.then_some(warning));
    let [x, y, z] = report.moved_mm.map(Length);
    tell(report.moved_mm != [0.0; 3], Warning::Moved { x, y, z });
    let mut tell_count = |count: usize, warning: fn(usize) -> Warning| tell(count > 0, warning(count));
    let Skipped { short_faces, lines, points } = report.skipped;
    tell_count(report.degenerate_triangles, |count| Warning::Degenerate { count });
    tell_count(report.duplicate_triangles, |count| Warning::Duplicate { count });
    tell_count(short_faces, |count| Warning::ShortFaces { count });
    tell_count(lines, |count| Warning::Lines { count });
    tell_count(points, |count| Warning::Points { count });
    tell_count(report.reoriented_triangles, |count| Warning::Reoriented { count });
    tell_count(report.components_turned, |count| Warning::Turned { count });
    tell_count(report.non_manifold_edges, |count| Warning::NonManifold { count });
    tell(!report.orientable, Warning::NoInside);
    warnings
}
