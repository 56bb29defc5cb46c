#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

mod axes;
mod columns;
mod detect;
mod error;
mod estimate;
mod far;
pub mod formats;
mod gltf;
mod import;
mod memory_budget;
mod numbers;
mod obj;
mod offer;
mod output;
mod pace;
mod parsing;
mod places;
mod ply;
mod polygons;
pub mod problem;
mod raw;
mod reading;
mod report;
mod size;
mod stl;
mod text;
mod unit;
#[cfg(feature = "scans")]
pub mod volume;
mod vtk;
mod warnings;
mod weld;

pub use axes::{Axes, TurnError, has_directions};
pub use detect::may_be_volume;
pub use error::{Counted, Elements, Feature, Named, ReadError, Unfolded, Unnamed, WriteError};
pub use estimate::{Estimate, estimate};
pub use formats::Format;
pub use import::{import_arrays, import_made, import_mesh};
pub use offer::{LabelName, Offer, VolumeField};
pub use output::Output;
pub use places::{LeftOut, left_out};
pub use reading::{read, read_in_slices};
pub use report::{ImportReport, Imported, Skipped, ThresholdReport};
pub use size::{InUnits, Length, UnusualSize};
pub use unit::{Unit, UnknownUnit};
pub use warnings::{ArrayProblem, ScanWarning, Warning, in_english};

use serde::{Deserialize, Serialize};

use lumen_mesh::{TriMesh, Vec3};

/// What translations need of the messages of this crate.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[
    ArrayProblem::MESSAGES,
    Axes::MESSAGES,
    Counted::MESSAGES,
    Elements::MESSAGES,
    Feature::MESSAGES,
    InUnits::MESSAGES,
    LeftOut::MESSAGES,
    ReadError::MESSAGES,
    ScanWarning::MESSAGES,
    Warning::MESSAGES,
    TurnError::MESSAGES,
    Unfolded::MESSAGES,
    UnknownUnit::MESSAGES,
    Unnamed::MESSAGES,
    UnusualSize::MESSAGES,
    VolumeField::MESSAGES,
    WriteError::MESSAGES,
    problem::DicomProblem::MESSAGES,
    problem::GltfProblem::MESSAGES,
    problem::PlyProblem::MESSAGES,
    problem::ScanProblem::MESSAGES,
    problem::StlProblem::MESSAGES,
    problem::TextProblem::MESSAGES,
    problem::VtiProblem::MESSAGES,
    problem::VtkProblem::MESSAGES,
    #[cfg(feature = "scans")]
    volume::ScanError::MESSAGES,
    #[cfg(all(feature = "scans", not(target_arch = "wasm32")))]
    volume::Unreadable::MESSAGES,
];

/// What the user says about a file that the file does not say itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ImportOptions {
    /// The unit of the file's numbers; `None` takes millimetres, and metres for glTF.
    pub unit: Option<Unit>,
}

/// The bytes of `mesh` in `format`, in mm (GLB: in mm under a node scale of 0.001, since glTF is metres, and with y
/// upwards).
/// `normals` are unit vectors, one a vertex; STL has no place for them and writes each facet's own.
/// The same mesh gives the same bytes everywhere.
///
/// # Errors
/// [`WriteError`] when the mesh is empty or not well formed, or too large for the format.
pub fn write(mesh: &TriMesh, normals: Option<&[Vec3]>, format: Format) -> Result<Vec<u8>, WriteError> {
    write_output(&Output { normals, ..Output::new(mesh) }, format)
}

/// As [`write()`], with arrays and axes beside. Arrays that the format has no place for are not written ([`left_out`]).
///
/// # Errors
/// [`WriteError`] as there, and when an array has another length than the surface.
pub fn write_output(output: &Output, format: Format) -> Result<Vec<u8>, WriteError> {
    output.check()?;
    (format.written().write)(output)
}

/// The bytes of a surface and coarser levels of it, the finest first, as GLB: viewers that know the extension `MSFT_lod`
/// show the one that is fine enough, others the finest.
///
/// # Errors
/// [`WriteError`] as [`write_output`].
pub fn write_levels(levels: &[Output]) -> Result<Vec<u8>, WriteError> {
    levels.iter().try_for_each(Output::check)?;
    if levels.is_empty() {
        return Err(WriteError::Empty);
    }
    gltf::write_levels(levels)
}
