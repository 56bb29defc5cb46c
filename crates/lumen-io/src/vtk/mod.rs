//! VTK's files of polygonal data: the XML kind (.vtp) and the legacy kind (.vtk), in and out.
//!
//! Both are described in "VTK File Formats" (Kitware). Polygons and triangle strips are the surface; vertices and lines are
//! counted and left out. Of an unstructured grid (.vtu, or .vtk) the flat cells are read: triangles, strips, polygons,
//! pixels and quadrilaterals. Everything else that VTK writes holds no surface and is refused by its name.
//!
//! The crate `vtkio` is not used: it does not read appended raw data, which is what VTK writes unless told otherwise,
//! takes memory as a header claims it, and brings C libraries along.

mod array;
mod encoded;
#[cfg(feature = "scans")]
mod image;
mod legacy;
mod legacy_data;
mod legacy_text;
mod surface;
mod write;
mod xml;
mod xml_arrays;
mod xml_structure;

#[cfg(feature = "scans")]
pub(super) use image::{Image, Values, read as read_image};
pub(super) use legacy::{is_legacy, read as read_legacy};
pub(super) use write::{legacy as write_legacy, xml as write_xml};
pub(super) use xml::{is_xml, read as read_xml};

use super::error::ReadError;

/// Refuses a kind of data that is no surface, by the name that VTK has for it.
fn no_surface(kind: &str) -> ReadError {
    let is = |name: &str| kind.trim_start_matches('P').eq_ignore_ascii_case(name);
    if is("ImageData") {
        ReadError::ImageVolume { format: "VTK image data" }
    } else if is("STRUCTURED_POINTS") {
        ReadError::ImageVolume { format: "VTK structured points" }
    } else if kind == "PPolyData" || kind == "PUnstructuredGrid" || is("Collection") || kind.contains("MultiBlock") {
        ReadError::VtkIndex { kind: kind.chars().take(40).collect() }
    } else {
        ReadError::VtkKind { kind: kind.chars().take(40).collect() }
    }
}
