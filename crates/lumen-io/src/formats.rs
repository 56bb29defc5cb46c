//! The table of surface formats: a row for each kind of file, with how it is told from others, what reads and writes it, and
//! what it can hold.
//!
//! Detection, dialogs, menus, estimates, help texts and the types that packages declare are made from it. The row of a format
//! stands in the format's own file. One more format is that file, its `mod` line, and its lines here: in `KINDS`, and where
//! it is written in [`Format`].

use std::pin::Pin;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::error::{ReadError, WriteError};
use super::output::Output;
use super::pace::Pace;
use super::raw::RawSurface;
use super::unit::Unit;
use super::{gltf, obj, ply, stl, vtk};
use lumen_mesh::Array;

/// The kinds of file that can be opened, in the order in which menus show them. Where a sign of two is in a file, the first
/// is taken.
pub(super) static KINDS: [&FileKind; 7] =
    [&stl::KIND, &ply::KIND, &obj::KIND, &vtk::XML, &vtk::LEGACY, &gltf::BINARY, &gltf::TEXT];

/// A format that Lumen reads and writes. (It also reads glTF as text, and the flat cells of VTK's unstructured grids.)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// Stereolithography, written in binary.
    Stl,
    /// Stanford polygon file, written in little-endian binary.
    Ply,
    /// Wavefront object, text.
    Obj,
    /// VTK's XML format for polygonal data, written in compressed binary.
    Vtp,
    /// VTK's legacy format, written in binary.
    Vtk,
    /// Binary glTF 2.0.
    Glb,
}

impl Format {
    /// All formats, in the order in which menus show them.
    pub const ALL: [Self; 6] = [Self::Stl, Self::Ply, Self::Obj, Self::Vtp, Self::Vtk, Self::Glb];

    fn row(self) -> (&'static FileKind, &'static Written) {
        match self {
            Self::Stl => (&stl::KIND, &stl::WRITTEN),
            Self::Ply => (&ply::KIND, &ply::WRITTEN),
            Self::Obj => (&obj::KIND, &obj::WRITTEN),
            Self::Vtp => (&vtk::XML, &vtk::XML_WRITTEN),
            Self::Vtk => (&vtk::LEGACY, &vtk::LEGACY_WRITTEN),
            Self::Glb => (&gltf::BINARY, &gltf::WRITTEN),
        }
    }

    /// The extensions of all files that can be opened, those of formats that are not written included.
    pub fn opened() -> impl Iterator<Item = &'static str> {
        KINDS.into_iter().flat_map(|kind| kind.extensions.iter().copied())
    }

    /// The format of an extension such as `stl` or `.STL`.
    pub fn from_extension(extension: &str) -> Option<Self> {
        let extension = extension.strip_prefix('.').unwrap_or(extension);
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// The format of a file name, by its extension.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::from_extension(name.rsplit_once('.')?.1)
    }

    /// The extension, without a dot.
    pub fn extension(self) -> &'static str {
        self.row().0.extensions[0]
    }

    /// The unit of length of what Lumen writes in it: millimetres, but for glTF, which has metres.
    pub fn unit(self) -> Unit {
        self.row().0.unit
    }

    /// What people call it.
    pub fn label(self) -> &'static str {
        self.row().0.label
    }

    /// What writes it, and what it holds.
    pub(super) fn written(self) -> &'static Written {
        self.row().1
    }
}

/// A kind of file: a row of the table.
pub(super) struct FileKind {
    /// What people call it.
    pub(super) label: &'static str,
    /// The extensions of its files in lower case, first that of files that Lumen writes.
    pub(super) extensions: &'static [&'static str],
    /// The types that desktops know its files by.
    pub(super) media_types: &'static [MediaType],
    /// The unit of its numbers, where nobody says another.
    pub(super) unit: Unit,
    /// Whether what its axes are stands in the text before its numbers; else its reader finds it.
    pub(super) axes_in_head: bool,
    /// By what of its content a file is told to be one.
    pub(super) signs: &'static [(Sign, IsKind)],
    /// Parses a file whose numbers are in a unit, with positions relative to an origin.
    pub(super) parse: Parser,
    /// How many triangles a file seems to hold, without reading it.
    pub(super) triangles: fn(&[u8]) -> u64,
}

/// Whether bytes have a sign of a kind of file.
pub(super) type IsKind = fn(&[u8]) -> bool;

/// What parses a file.
pub(super) type Parser = for<'a> fn(&'a [u8], Unit, DVec3, &'a Pace) -> ParserFuture<'a>;

/// The polygons of a file, once they are parsed.
pub(super) type ParserFuture<'a> = Pin<Box<dyn Future<Output = Result<RawSurface, ReadError>> + Send + 'a>>;

/// How surely a sign in a file's content tells its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sign {
    /// Nothing else can be meant: neither an archive nor a scan is looked for.
    Sure,
    /// It begins as files of the kind do, whatever its extension says.
    Begins,
    /// It looks like one. The extension counts for more.
    Resembles,
}

/// What writes a format.
pub(super) struct Written {
    /// The bytes of a surface that was checked.
    pub(super) write: fn(&Output<'_>) -> Result<Vec<u8>, WriteError>,
    /// Which arrays it has a place for.
    pub(super) arrays: Arrays,
}

/// The arrays that a format has a place for.
pub(super) enum Arrays {
    /// All.
    All,
    /// None.
    None,
    /// One colour of the vertices: which of several.
    Colour(fn(&[Array]) -> Option<&Array>),
    /// Some arrays of vertices.
    Vertices(fn(&Array) -> bool),
}

/// A type that desktops know files by, as [freedesktop.org] has it.
///
/// [freedesktop.org]: https://www.freedesktop.org/wiki/Specifications/shared-mime-info-spec/
#[derive(Clone, Copy, Debug)]
pub struct MediaType {
    /// Its name: `model/stl`.
    pub name: &'static str,
    /// What its files are.
    pub comment: &'static str,
    /// The extension of its files.
    pub extension: &'static str,
    /// What its files begin with, where desktops do not know that; a line feed as `\n`.
    pub magic: Option<&'static str>,
}

/// The types of all surface files that can be opened.
pub fn media_types() -> impl Iterator<Item = &'static MediaType> {
    KINDS.into_iter().flat_map(|kind| kind.media_types)
}

impl PartialEq for FileKind {
    fn eq(&self, other: &Self) -> bool {
        self.label == other.label
    }
}

impl std::fmt::Debug for FileKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.label)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn names_find_their_format() {
        assert_eq!(Format::from_name("left.leg.STL"), Some(Format::Stl));
        assert_eq!(Format::from_extension(".glb"), Some(Format::Glb));
        assert_eq!(Format::from_name("surface.gltf"), None, "glTF as text is read, not written");
        assert_eq!(Format::from_name("stl"), None);
        assert!(Format::ALL.iter().all(|format| Format::opened().any(|opened| opened == format.extension())));
    }

    #[test]
    fn every_extension_has_one_kind_and_a_media_type() {
        let extensions: Vec<&str> = Format::opened().collect();
        let once: BTreeSet<&str> = extensions.iter().copied().collect();
        assert_eq!(once.len(), extensions.len(), "{extensions:?}");
        assert_eq!(media_types().map(|media| media.extension).collect::<BTreeSet<_>>(), once);
        let labels: BTreeSet<&str> = KINDS.iter().map(|kind| kind.label).collect();
        assert_eq!(labels.len(), KINDS.len());
        assert!(KINDS.iter().all(|kind| !kind.signs.is_empty()));
    }

    #[test]
    fn menus_show_written_formats_in_the_order_of_the_table() {
        let written = KINDS.iter().filter(|kind| Format::from_extension(kind.extensions[0]).is_some());
        assert!(written.map(|kind| kind.label).eq(Format::ALL.map(Format::label)));
    }
}
