//! Bytes to mesh and back, one file a format, with a report of what was found and what was mended.
//!
//! Reading is two steps. A format's file (`stl`, `ply`, `obj`, `gltf`) or folder (`vtk`) turns bytes into the polygons that stand in
//! them and judges nothing but its own syntax; the import stage (`import`) then welds, triangulates, cleans and
//! orients, the same for every format and for generated surfaces ([`import_mesh`]). Which file reads is decided by
//! the content first and by the extension only where the content does not say (`detect`).
//!
//! Scans and masks are read by `volume` (feature `scans`), which knows nothing of the rest but its texts and errors.
//!
//! glTF has y upwards by its specification and Lumen z: it is turned on the way in and back on the way out. Which way a
//! patient lies is known only where a file says so (`axes`).
//!
//! Numbers in a file are millimetres unless [`ImportOptions::unit`] says otherwise; glTF is metres, as its
//! specification has it. Nothing is rescaled silently: a size that no vessel has draws a warning.
//!
//! A surface far from the origin of its coordinates is read relative to a place within it (`far`), so that its detail
//! is not rounded away; the report says by what it was moved.
//!
//! No memory is allocated because a header claims it: every count is checked against the bytes that are there, and what
//! a few bytes unfold to against the room that a file of their number has (`room`).

mod axes;
mod columns;
mod detect;
mod error;
mod far;
mod format;
mod gltf;
mod gltf_arrays;
mod import;
mod numbers;
mod obj;
mod output;
mod ply;
mod ply_arrays;
mod polygons;
mod report;
mod room;
mod size;
mod stl;
mod text;
#[cfg(feature = "scans")]
pub mod volume;
mod vtk;
mod weld;
mod winding;

pub use axes::{Axes, UnknownAxes};
pub use error::{ReadError, WriteError};
pub use format::{Format, Unit, UnknownUnit};
pub use import::{NO_INSIDE, import_mesh};
pub use output::{Output, left_out};
pub use report::{ImportReport, Imported, Skipped};
pub use size::UnusualSize;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::mesh::{TriMesh, Vec3};
use detect::Content;
use room::Room;

/// What the user says about a file that the file does not say itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ImportOptions {
    /// The unit of the file's numbers; `None` takes millimetres, and metres for glTF.
    pub unit: Option<Unit>,
}

/// Reads the surface in `bytes`. `name` is the file's name: it matters only where the content alone does not tell
/// the format, as with OBJ.
///
/// # Errors
/// [`ReadError`], each in one plain sentence: the file is empty, of another kind, cut short or broken, or holds no
/// triangle that has an area.
pub fn read(bytes: &[u8], name: &str, options: &ImportOptions) -> Result<Imported, ReadError> {
    let content = detect::detect(bytes, name)?;
    let unit = options.unit.unwrap_or(match content {
        Content::Glb | Content::Gltf => Unit::Metre,
        _ => Unit::Millimetre,
    });
    let relative_to = |origin: DVec3| match content {
        Content::Stl => stl::read(bytes, origin),
        Content::Ply => ply::read(bytes, origin),
        Content::Obj => obj::read(bytes, origin),
        Content::Vtp => vtk::read_xml(bytes, origin),
        Content::Vtk => vtk::read_legacy(bytes, origin),
        Content::Glb => gltf::read_binary(bytes, unit, origin),
        Content::Gltf => gltf::read_text(bytes, unit, origin),
    };
    let mut raw = relative_to(DVec3::ZERO)?;
    if let Some(origin) = far::origin_for(&raw, unit) {
        // Never both at once.
        drop(raw);
        raw = relative_to(origin)?;
    }
    Room::of(bytes.len()).check(raw.label, raw.positions.len(), raw.triangles.len())?;
    let axes = match content {
        Content::Stl | Content::Ply | Content::Obj => axes::stated(bytes),
        Content::Vtp | Content::Vtk | Content::Glb | Content::Gltf => raw.axes,
    };
    import::import(raw, unit, axes)
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

/// As [`write`], with arrays and axes beside. Arrays that the format has no place for are not written ([`left_out`]).
///
/// # Errors
/// [`WriteError`] as there, and when an array has another length than the surface.
pub fn write_output(output: &Output, format: Format) -> Result<Vec<u8>, WriteError> {
    error::check_writable(output)?;
    match format {
        Format::Stl => stl::write(output),
        Format::Ply => Ok(ply::write(output)),
        Format::Obj => Ok(obj::write(output)),
        Format::Vtp => Ok(vtk::write_xml(output)),
        Format::Vtk => vtk::write_legacy(output),
        Format::Glb => gltf::write(output),
    }
}
