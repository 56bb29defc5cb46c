//! VTK's files of polygonal data: the XML kind (.vtp) and the legacy kind (.vtk), in and out.
//!
//! Both are described in "VTK File Formats" (Kitware). Polygons and triangle strips are the surface; vertices and lines are
//! counted and left out. Of an unstructured grid (.vtu, or .vtk) the flat cells are read: triangles, strips, polygons,
//! pixels and quadrilaterals, and the corners of curved ones. Everything else that VTK writes holds no surface and is refused by its name.
//!
//! The crate `vtkio` is not used: it does not read appended raw data, which is what VTK writes unless told otherwise,
//! takes memory as a header claims it, and brings C libraries along.

mod array;
mod encoded;
#[cfg(feature = "scans")]
mod image;
mod legacy;
mod legacy_data;
#[cfg(feature = "scans")]
mod legacy_image;
mod legacy_text;
mod problem;
mod surface;
mod write;
mod xml;
mod xml_arrays;
mod xml_structure;

#[cfg(feature = "scans")]
pub(super) use image::{Image, Values, read as read_image};
pub(super) use legacy::is_legacy;
#[cfg(feature = "scans")]
pub(super) use legacy_image::read as read_legacy_image;
pub use problem::VtkProblem;
pub(super) use xml::is_xml;

use super::error::{Named, ReadError};
use super::formats::{Arrays, FileKind, MediaType, Sign, Written};
use super::text;
use super::unit::Unit;

/// The XML kind in the table of formats.
pub(super) static XML: FileKind = FileKind {
    label: "VTP",
    extensions: &["vtp", "vtu"],
    media_types: &[
        MediaType { name: "model/x-vtp", comment: "VTK polygonal data", extension: "vtp", magic: None },
        MediaType { name: "model/x-vtu", comment: "VTK unstructured grid", extension: "vtu", magic: None },
    ],
    unit: Unit::Millimetre,
    axes_in_head: false,
    signs: &[(Sign::Begins, |bytes| is_xml(text::beginning(bytes)))],
    parse: |bytes, _, origin, pace| Box::pin(xml::read(bytes, origin, pace)),
    // As the legacy kind, packed to a third of that.
    triangles: |bytes| bytes.len() as u64 / 7,
};

/// The XML kind as it is written.
pub(super) static XML_WRITTEN: Written = Written { write: |output| Ok(write::xml(output)), arrays: Arrays::All };

/// The legacy kind in the table of formats.
pub(super) static LEGACY: FileKind = FileKind {
    label: "VTK",
    extensions: &["vtk"],
    media_types: &[MediaType {
        name: "model/x-vtk",
        comment: "VTK legacy data",
        extension: "vtk",
        magic: Some("# vtk DataFile Version"),
    }],
    unit: Unit::Millimetre,
    axes_in_head: false,
    signs: &[(Sign::Begins, |bytes| legacy::is_legacy(text::beginning(bytes)))],
    parse: |bytes, _, origin, pace| Box::pin(legacy::read(bytes, origin, pace)),
    // Half a vertex of three f32, three numbers of 32 bits and how many there are.
    triangles: |bytes| bytes.len() as u64 / 22,
};

/// The legacy kind as it is written.
pub(super) static LEGACY_WRITTEN: Written = Written { write: write::legacy, arrays: Arrays::All };

/// Refuses a kind of data that is no surface, by the name that VTK has for it.
fn no_surface(kind: &str) -> ReadError {
    let is = |name: &str| kind.trim_start_matches('P').eq_ignore_ascii_case(name);
    let named = || Named::Word(kind.chars().take(40).collect());
    if is("ImageData") {
        ReadError::ImageVolume { format: "VTK image data" }
    } else if is("STRUCTURED_POINTS") {
        ReadError::ImageVolume { format: "VTK structured points" }
    } else if kind == "PPolyData" || kind == "PUnstructuredGrid" || is("Collection") || kind.contains("MultiBlock") {
        ReadError::VtkIndex { kind: named() }
    } else {
        ReadError::VtkKind { kind: named() }
    }
}
