//! What can go wrong with a file, each in one sentence that needs no programmer to understand.
//!
//! What is wrong in a place of a file is a [`Problem`]; each format has its own.

use std::fmt;

use lumen_message::{ToValue, Value, messages};

use super::formats::KINDS;
use super::problem::Problem;

messages! {
    /// Why a file was not opened. Every message is one sentence.
    #[derive(Clone, Debug, PartialEq)]
    pub enum ReadError {
        /// No bytes at all.
        "errors-file-empty" Empty => "The file is empty.",
        /// Neither the content nor the extension is one that Lumen knows.
        "errors-file-unknown" Unknown {
            /// The file's name.
            name: String,
            /// What can be opened, with commas between, but for the last.
            formats: String,
            /// The last.
            last: &'static str,
        } => "\"{name}\" is not a surface that Lumen knows: it opens {formats} and {last} files.",
        /// VTK data of another kind than surfaces.
        "errors-vtk-kind" VtkKind {
            /// What VTK calls it.
            kind: Named,
        } => "This is VTK data of another kind ({kind}), and Lumen opens surfaces: extract its surface and save that.",
        /// A VTK file that only names others.
        "errors-vtk-index" VtkIndex {
            /// What VTK calls it.
            kind: Named,
        } => "This VTK file ({kind}) only names others that hold the data: open one of those.",
        /// An image volume, not a surface.
        "errors-image-volume" ImageVolume {
            /// The format.
            format: &'static str,
        } => "This is no surface but an image volume ({format}) that is broken or of a kind that Lumen does not read: segment it and save the surface.",
        /// A compressed file or an archive.
        "errors-compressed" Compressed {
            /// The format.
            format: &'static str,
        } => "This is a compressed file ({format}): unpack it and open the surface inside.",
        /// Less is there than the file itself announces.
        "errors-cut-short" CutShort {
            /// The format.
            format: &'static str,
            /// What is counted: "triangles", "bytes".
            what: Counted,
            /// How many the file announces.
            announced: u64,
            /// How many are there in full.
            found: u64,
        } => "The {format} file is cut short: it announces {announced} {what} and holds {found}.",
        /// A text file breaks its format's rules.
        "errors-broken-line" Syntax {
            /// The format.
            format: &'static str,
            /// Line number, from 1.
            line: usize,
            /// What is wrong there.
            problem: Problem,
        } => "The {format} file is broken at line {line}: {problem}.",
        /// A file breaks its format's rules in a place that has no line.
        "errors-broken" Malformed {
            /// The format.
            format: &'static str,
            /// What is wrong.
            problem: Problem,
        } => "The {format} file is broken: {problem}.",
        /// A face names a vertex that does not exist.
        "errors-face-refers" IndexOutOfRange {
            /// The format.
            format: &'static str,
            /// Number of the face, from 1.
            face: usize,
            /// The index as it stands in the file.
            index: i64,
            /// Vertices in the file.
            vertices: usize,
        } => "Face {face} of the {format} file refers to vertex {index}, but the file has {vertices} vertices.",
        /// A coordinate is NaN, infinite, or farther out than a thousand kilometres.
        "errors-coordinate" Coordinate {
            /// Number of the vertex, from 1.
            vertex: usize,
            /// The coordinate in mm.
            value: f64,
        } => "Vertex {vertex} of the file has the coordinate {value}, which is not a place in a body.",
        /// A glTF file that keeps its numbers in a second file.
        "errors-gltf-elsewhere" ExternalBuffer {
            /// Where the file says its data are.
            uri: Named,
        } => "The glTF file keeps its data in another file ({uri}): save it as one GLB file and open that.",
        /// A part of a format that Lumen does not read.
        "errors-unsupported" Unsupported {
            /// The format.
            format: &'static str,
            /// The part of the format.
            feature: Feature,
        } => "The {format} file uses {feature}, which Lumen does not read.",
        /// More corners than 32-bit indices can number.
        "errors-too-large" TooLarge {
            /// Vertices or corners of triangles, whichever are more.
            corners: u64,
            /// The most that can be taken.
            limit: u64,
        } => "The surface is too large: it has {corners} vertices or corners, and Lumen can take {limit}.",
        /// A readable file without a surface.
        "errors-no-triangles" NoTriangles {
            /// The format.
            format: &'static str,
            /// Vertices in the file.
            vertices: usize,
        } => "The {format} file holds no triangles ({vertices} vertices and nothing between them to show).",
        /// A readable file of lines or points alone.
        "errors-no-surface" NoSurface {
            /// The format.
            format: &'static str,
            /// Lines.
            lines: Elements,
            /// Points.
            points: Elements,
        } => "The {format} file holds no surface, only {lines} and {points}: Lumen does not open centrelines.",
        /// A few bytes that stand for more than can be honest.
        "errors-unfolds" Unfolds {
            /// The format.
            format: &'static str,
            /// What it unfolds to.
            what: Unfolded,
            /// Bytes that it has for that.
            file: u64,
        } => "The {format} file would unfold to {what}, more than a file of {file} bytes can honestly hold.",
        /// Triangles, but each with a repeated vertex.
        "errors-all-degenerate" AllDegenerate {
            /// The format.
            format: &'static str,
            /// Triangles in the file.
            triangles: usize,
        } => "None of the {triangles} triangles of the {format} file has an area: each repeats one of its vertices.",
    }
}

impl ReadError {
    /// That a file is none of those that can be opened.
    pub(super) fn unknown(name: &str) -> Self {
        let [formats @ .., last] = KINDS.map(|kind| kind.label);
        Self::Unknown { name: name.to_owned(), formats: formats.join(", "), last }
    }

    /// That a file breaks its format's rules.
    pub(super) fn malformed(format: &'static str, problem: impl Into<Problem>) -> Self {
        Self::Malformed { format, problem: problem.into() }
    }

    /// That a text breaks its format's rules in a line.
    pub(super) fn syntax(format: &'static str, line: usize, problem: impl Into<Problem>) -> Self {
        Self::Syntax { format, line, problem: problem.into() }
    }
}

messages! {
    /// Why a surface was not written.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum WriteError {
        /// No triangle to write.
        "errors-nothing-to-save" Empty => "There is no surface to save.",
        /// A triangle names a vertex that does not exist.
        "errors-triangle-refers" IndexOutOfRange {
            /// The triangle, from 0.
            triangle: usize,
            /// The vertex it names.
            index: u32,
            /// Vertices of the mesh.
            vertices: usize,
        } => "Triangle {triangle} refers to vertex {index}, but there are {vertices} vertices.",
        /// A position or a normal is NaN or infinite.
        "errors-not-finite" NotFinite {
            /// The vertex, from 0.
            vertex: usize,
        } => "Vertex {vertex} has a position or a normal that is not a finite number.",
        /// There must be one normal for each vertex.
        "errors-normal-count" NormalCount {
            /// Normals given.
            normals: usize,
            /// Vertices of the mesh.
            vertices: usize,
        } => "There are {normals} normals for {vertices} vertices.",
        /// An array must have a tuple for each vertex or triangle.
        "errors-array-length" ArrayLength {
            /// Its name.
            name: String,
            /// Tuples that it has.
            tuples: usize,
            /// Vertices or triangles of the mesh.
            rows: usize,
        } => "The array \"{name}\" has {tuples} tuples for {rows} vertices or triangles.",
        /// More than the format's 32-bit counts can hold.
        "errors-format-too-large" TooLarge {
            /// The format.
            format: &'static str,
            /// Bytes that it would take.
            bytes: u64,
        } => "The surface is too large for a {format} file: it would take {bytes} bytes.",
    }
}

/// A word of a file, or what is said where it has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Named {
    /// As the file has it.
    Word(String),
    /// It has none.
    Unnamed(Unnamed),
}

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => f.write_str(word),
            Self::Unnamed(what) => what.fmt(f),
        }
    }
}

impl ToValue for Named {
    fn to_value(&self) -> Value {
        match self {
            Self::Word(word) => word.to_value(),
            Self::Unnamed(what) => what.to_value(),
        }
    }
}

messages! {
    /// What has no name in its file.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum Unnamed {
        "errors-vtk-solids" Solids => "a grid of solid cells",
        "errors-vtk-no-kind" NoKind => "file of no type",
        "errors-gltf-unnamed" NoFile => "which it does not name",
    }
}

messages! {
    /// Parts of a file that are counted.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum Counted {
        "errors-bytes" Bytes => "bytes",
        "errors-header-bytes" HeaderBytes => "bytes of header",
        "errors-vertices" Vertices => "vertices",
        "errors-faces" Faces => "faces",
        "errors-triangles" Triangles => "triangles",
        "errors-strips" Strips => "triangle strips",
        "errors-rows" Rows { name: String } => "rows of {name}",
        "errors-points" Points => "points",
        "errors-cells" Cells => "cells",
        "errors-cell-types" CellTypes => "types of cells",
    }
}

messages! {
    /// Parts of a file that are no surface, counted.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum Elements {
        "errors-lines" Lines { count: usize } => (count, "{count} line", "{count} lines"),
        "errors-so-many-points" Points { count: usize } => (count, "{count} point", "{count} points"),
    }
}

messages! {
    /// What a file would unfold to.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum Unfolded {
        "errors-so-many-bytes" Bytes { bytes: u64 } => "{bytes} bytes",
        "errors-too-many-bytes" TooManyBytes => "more bytes than there can be",
        "errors-parts" Parts { parts: usize } => "{parts} parts",
        "errors-vertices-triangles" Surface { vertices: usize, triangles: usize } => "{vertices} vertices and {triangles} triangles",
    }
}

messages! {
    /// A part of a format that is not read.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum Feature {
        "errors-version" Version { version: u32 } => "version {version}",
        "errors-compressor" Compressor { name: String } => "the compressor {name}",
        "errors-lzma" Lzma { bytes: u64 } => "LZMA with a dictionary of {bytes} bytes",
        "errors-extension" Extension { name: String } => "{name}",
        "errors-gltf-whole-positions" WholePositions => "positions of 32-bit whole numbers",
        "scan-dimensions" NotThreeDimensions => "other than three dimensions",
        "scan-more-dimensions" MoreDimensions => "more than three dimensions",
        "scan-number-type" NumberType { kind: String } => "numbers of type {kind}",
        "scan-file-a-slice" FileASlice => "a file for each slice",
        "scan-encoding" Encoding { name: String } => "the encoding {name}",
        "scan-numbers-a-voxel" NumbersAVoxel => "several numbers a voxel",
        "scan-dicom-jpeg-bits" JpegBits { bits: u8 } => "JPEG pictures of {bits} bits",
        "scan-dicom-table" ValueTable => "a table of values (modality LUT)",
        "scan-dicom-jpeg-2000" Jpeg2000 => "JPEG 2000 compression",
        "scan-dicom-compression" UnknownCompression => "a compression that is not known",
        "scan-dicom-bits" Bits { bits: u16 } => "{bits} bits a pixel",
        "scan-vti-pieces" Pieces => "several pieces",
    }
}
