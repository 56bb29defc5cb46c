//! A surface in patches, written for the programs that mesh and solve: a file a format.
//!
//! The writers are by hand and small: `lumen-io`, which reads and writes surfaces without patches, stands beside this crate
//! and not below it, and no format here needs more than lines of numbers.
//!
//! Coordinates are in mm with nine significant digits, which give back every bit of an `f32`. Triangles keep their order
//! within a patch and wind counter-clockwise seen from outside, as they came; vertices that no triangle uses are left out.

mod inp;
mod json;
mod msh;
mod stl;
mod vtp;

use std::fmt::Write;

use glam::Vec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use lumen_mesh::arrays::{Association, Scalar, gathered};
use lumen_mesh::{Array, TriMesh, compacted, used_vertices};

use crate::ends::{SurfaceError, check_surface};
use crate::{Patch, PatchKind, Patched};

/// The longest name of a patch in a file, in characters: Abaqus takes 80, a suffix included.
const LONGEST_NAME: usize = 60;
/// What stands in every file that has room for a remark.
const NOTICE: &str = "Not for clinical decisions.";

/// A format that a solver or volume mesher reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SolverFormat {
    /// STL as text with a solid for each patch, as OpenFOAM's snappyHexMesh takes it.
    Stl,
    /// Gmsh MSH 4.1 as text with a physical surface for each patch.
    Msh,
    /// Abaqus input with an element set and a surface for each patch.
    Inp,
    /// VTK XML PolyData with `ModelFaceID` and `CapID` on its cells.
    Vtp,
    /// The surface files of a SimVascular mesh: the whole, the walls, and a file for each patch.
    SimVascular,
    /// What there is to say about the patches, without the surface.
    Json,
}

impl SolverFormat {
    /// All formats, in the order in which they are offered.
    pub const ALL: [Self; 6] = [Self::Stl, Self::Msh, Self::Inp, Self::Vtp, Self::SimVascular, Self::Json];

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stl => "STL by patch (OpenFOAM)",
            Self::Msh => "Gmsh MSH 4.1",
            Self::Inp => "Abaqus input",
            Self::Vtp => "VTK PolyData",
            Self::SimVascular => "SimVascular mesh surfaces",
            Self::Json => "Patches as JSON",
        }
    }

    /// The extension of its files, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Stl => "stl",
            Self::Msh => "msh",
            Self::Inp => "inp",
            Self::Vtp | Self::SimVascular => "vtp",
            Self::Json => "json",
        }
    }

    /// Whether its files are a folder of several.
    pub fn is_folder(self) -> bool {
        self == Self::SimVascular
    }

    /// Whether its files have a place for arrays.
    pub fn has_arrays(self) -> bool {
        matches!(self, Self::Vtp | Self::Msh)
    }

    /// The files of a surface, each with its name; folders in a name end with `/`. `stem` begins the names: it is used as
    /// it is.
    ///
    /// # Errors
    /// When the surface has no triangle, when a number in it is out of range or not finite, or when two patches share an id.
    pub fn written(self, surface: &Patched, stem: &str) -> Result<Vec<(String, Vec<u8>)>, WriteError> {
        self.written_with(surface, &[], stem)
    }

    /// As [`Self::written`], with arrays of the surface's vertices and triangles where the format has a place for them: VTP
    /// and MSH do. One on triangles that is called as what the format has itself is left out.
    ///
    /// # Errors
    /// As [`Self::written`], and when an array is not as long as the surface.
    pub fn written_with(
        self,
        surface: &Patched,
        arrays: &[Array],
        stem: &str,
    ) -> Result<Vec<(String, Vec<u8>)>, WriteError> {
        let sheet = Sheet::of(surface)?;
        let arrays = sheet.arrays(surface, arrays)?;
        let bytes = match self {
            Self::Stl => stl::stl(&sheet),
            Self::Msh => msh::msh(&sheet, &arrays),
            Self::Inp => inp::inp(&sheet),
            Self::Vtp => vtp::vtp(&sheet, &arrays),
            Self::SimVascular => {
                let folder = format!("{stem}-mesh-complete");
                let files = vtp::simvascular(&sheet).into_iter();
                return Ok(files.map(|(name, text)| (format!("{folder}/{name}"), text.into_bytes())).collect());
            }
            Self::Json => json::json(&sheet)?,
        };
        Ok(vec![(format!("{stem}.{}", self.extension()), bytes.into_bytes())])
    }
}

/// The surface files of a SimVascular mesh, by their names in its folder: `mesh-complete.exterior.vtp`,
/// `walls_combined.vtp`, and `mesh-surfaces/NAME.vtp` for each patch.
///
/// # Errors
/// As [`SolverFormat::written`].
pub fn simvascular(surface: &Patched) -> Result<Vec<(String, Vec<u8>)>, WriteError> {
    let files = vtp::simvascular(&Sheet::of(surface)?).into_iter();
    Ok(files.map(|(name, text)| (name, text.into_bytes())).collect())
}

/// Why a surface cannot be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Not every triangle has its patch.
    #[error("{of} of {triangles} triangles have a patch")]
    Count {
        /// Entries of [`Patched::of_triangle`].
        of: usize,
        /// Triangles of the surface.
        triangles: usize,
    },
    /// A triangle is of a patch that is not there.
    #[error("triangle {triangle} is of patch {patch}: there are {patches}")]
    NoPatch {
        /// Its place in the list of triangles.
        triangle: usize,
        /// The place of the patch that it names.
        patch: u32,
        /// How many patches there are.
        patches: usize,
    },
    /// A patch has id 0, one beyond 2147483647, or that of another.
    #[error("the id {id} of patch \"{name}\" cannot be written: ids are distinct numbers from 1 to 2147483647")]
    Id {
        /// The id.
        id: u32,
        /// The name of the patch.
        name: String,
    },
    /// An array has not a tuple for each vertex or triangle.
    #[error("the array \"{name}\" has {tuples} tuples where {expected} are expected")]
    Array {
        /// Its name.
        name: String,
        /// How many it has.
        tuples: usize,
        /// How many vertices or triangles there are.
        expected: usize,
    },
    /// The JSON text could not be made.
    #[error("the patches could not be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// A part of a surface as files have it.
struct Part<'a> {
    patch: &'a Patch,
    /// Distinct from those of all other parts, whatever the case of letters.
    name: String,
    /// Its triangles' places in the mesh, ascending.
    triangles: Vec<u32>,
    area_mm2: f64,
}

/// A surface that can be written: every number in it was looked at.
struct Sheet<'a> {
    mesh: TriMesh,
    /// The patches that have a triangle, in their order.
    parts: Vec<Part<'a>>,
}

impl<'a> Sheet<'a> {
    fn of(surface: &'a Patched) -> Result<Self, WriteError> {
        let Patched { mesh, of_triangle, patches } = surface;
        check_surface(mesh)?;
        let triangles = mesh.triangles.len();
        if of_triangle.len() != triangles {
            return Err(WriteError::Count { of: of_triangle.len(), triangles });
        }
        for (i, Patch { id, name, .. }) in patches.iter().enumerate() {
            if *id == 0 || i32::try_from(*id).is_err() || patches.iter().take(i).any(|other| other.id == *id) {
                return Err(WriteError::Id { id: *id, name: name.clone() });
            }
        }
        let mut names: Vec<String> = Vec::new();
        for patch in patches {
            let name = distinct(&sanitised(&patch.name), &names);
            names.push(name);
        }
        let mut parts: Vec<Part> = patches
            .iter()
            .zip(names)
            .map(|(patch, name)| Part { patch, name, triangles: Vec::new(), area_mm2: 0.0 })
            .collect();
        for (t, &patch) in of_triangle.iter().enumerate() {
            let missing = WriteError::NoPatch { triangle: t, patch, patches: patches.len() };
            let part = parts.get_mut(patch as usize).ok_or(missing)?;
            part.triangles.push(t as u32);
        }
        parts.iter_mut().zip(surface.areas_mm2()).for_each(|(part, area)| part.area_mm2 = area);
        parts.retain(|part| !part.triangles.is_empty());
        Ok(Self { mesh: compacted(&mesh.positions, mesh.triangles.clone()), parts })
    }

    /// Arrays of the surface for the vertices and triangles that are written.
    fn arrays(&self, surface: &Patched, arrays: &[Array]) -> Result<Vec<Array>, WriteError> {
        let TriMesh { positions, triangles } = &surface.mesh;
        for array in arrays {
            let expected = if array.on == Association::Point { positions.len() } else { triangles.len() };
            if array.len() != expected {
                return Err(WriteError::Array { name: array.name.clone(), tuples: array.len(), expected });
            }
        }
        let all: Vec<u32> = (0..triangles.len() as u32).collect();
        Ok(gathered(arrays, &used_vertices(positions.len(), triangles), &all))
    }

    /// The corners of a part's triangles.
    fn corners<'b>(&'b self, part: &'b Part) -> impl Iterator<Item = [Vec3; 3]> + 'b {
        part.triangles.iter().map(|&t| self.mesh.corners(t as usize))
    }

    /// The vertices of a part's triangles.
    fn vertices<'b>(&'b self, part: &'b Part) -> impl Iterator<Item = [u32; 3]> + 'b {
        part.triangles.iter().map(|&t| self.mesh.triangles[t as usize])
    }
}

/// A name of letters, digits, `_` and `-` that begins with a letter.
fn sanitised(name: &str) -> String {
    let plain = name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' });
    let starts_well = name.starts_with(|c: char| c.is_ascii_alphabetic());
    let prefix = if starts_well { "" } else { "patch_" };
    prefix.chars().chain(plain).take(LONGEST_NAME).collect()
}

/// `name`, or with a number behind it where it is among `taken`: letters of either case are the same to Abaqus and to file
/// systems.
fn distinct(name: &str, taken: &[String]) -> String {
    let is_free = |name: &str| !taken.iter().any(|other| other.eq_ignore_ascii_case(name));
    // One of so many is free, there being one more than names taken.
    let numbered = (2..taken.len() + 3).map(|number| format!("{name}_{number}"));
    std::iter::once(name.to_owned()).chain(numbered).find(|name| is_free(name)).unwrap_or_default()
}

/// Adds a line. Writing to a string cannot fail.
fn line(text: &mut String, arguments: std::fmt::Arguments) {
    let _ = text.write_fmt(arguments);
    text.push('\n');
}

/// Adds a line of a text, as `writeln!`.
macro_rules! put {
    ($text:expr, $($argument:tt)*) => { $crate::write::line($text, format_args!($($argument)*)) };
}
use put;

/// Tuple `i` of an array, with zeros behind it up to `components` numbers.
fn tuple(array: &Array, i: usize, components: usize) -> String {
    let number = |at: usize| {
        let value = if at < array.components { array.values.get(i * array.components + at) } else { 0.0 };
        match array.values.scalar() {
            Scalar::F32 => format!("{:?}", value as f32),
            Scalar::F64 => format!("{value:?}"),
            _ => format!("{value:.0}"),
        }
    };
    (0..components).map(number).collect::<Vec<String>>().join(" ")
}

/// A point in nine digits a coordinate, `between` standing between them.
fn point(p: Vec3, between: &str) -> String {
    let [x, y, z] = p.to_array();
    format!("{x:.8e}{between}{y:.8e}{between}{z:.8e}")
}

/// The number of a patch among caps in SimVascular: its id, and -1 for the wall.
fn cap_id(patch: &Patch) -> i64 {
    if patch.kind == PatchKind::Wall { -1 } else { i64::from(patch.id) }
}

#[cfg(test)]
mod tests;
