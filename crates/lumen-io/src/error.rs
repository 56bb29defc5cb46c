//! What can go wrong with a file, each in one sentence that needs no programmer to understand.

use super::formats::KINDS;
use lumen_language::exact;
use lumen_language::say;
use thiserror::Error;

/// Why a file was not opened. Every message is one sentence.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ReadError {
    /// No bytes at all.
    #[error("{}", say!("errors-file-empty"))]
    Empty,
    /// Neither the content nor the extension is one that Lumen knows.
    #[error("{}", unknown(.name))]
    Unknown {
        /// The file's name.
        name: String,
    },
    /// VTK data of another kind than surfaces.
    #[error("{}", say!("errors-vtk-kind", kind = .kind))]
    VtkKind {
        /// What VTK calls it.
        kind: String,
    },
    /// A VTK file that only names others.
    #[error("{}", say!("errors-vtk-index", kind = .kind))]
    VtkIndex {
        /// What VTK calls it.
        kind: String,
    },
    /// An image volume, not a surface.
    #[error("{}", say!("errors-image-volume", format = *.format))]
    ImageVolume {
        /// The format.
        format: &'static str,
    },
    /// A compressed file or an archive.
    #[error("{}", say!("errors-compressed", format = *.format))]
    Compressed {
        /// The format.
        format: &'static str,
    },
    /// Less is there than the file itself announces.
    #[error("{}", say!(
        "errors-cut-short",
        format = *.format,
        announced = .announced.to_string(),
        what = .what,
        found = .found.to_string()
    ))]
    CutShort {
        /// The format.
        format: &'static str,
        /// What is counted: "triangles", "bytes".
        what: String,
        /// How many the file announces.
        announced: u64,
        /// How many are there in full.
        found: u64,
    },
    /// A text file breaks its format's rules.
    #[error("{}", say!("errors-broken-line", format = *.format, line = .line.to_string(), problem = .problem))]
    Syntax {
        /// The format.
        format: &'static str,
        /// Line number, from 1.
        line: usize,
        /// What is wrong there.
        problem: String,
    },
    /// A file breaks its format's rules in a place that has no line.
    #[error("{}", say!("errors-broken", format = *.format, problem = .problem))]
    Malformed {
        /// The format.
        format: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// A face names a vertex that does not exist.
    #[error("{}", say!(
        "errors-face-refers",
        format = *.format,
        face = .face.to_string(),
        index = .index.to_string(),
        vertices = .vertices.to_string()
    ))]
    IndexOutOfRange {
        /// The format.
        format: &'static str,
        /// Number of the face, from 1.
        face: usize,
        /// The index as it stands in the file.
        index: i64,
        /// Vertices in the file.
        vertices: usize,
    },
    /// A coordinate is NaN, infinite, or farther out than a thousand kilometres.
    #[error("{}", say!("errors-coordinate", vertex = .vertex.to_string(), value = exact(*.value)))]
    Coordinate {
        /// Number of the vertex, from 1.
        vertex: usize,
        /// The coordinate in mm.
        value: f64,
    },
    /// A glTF file that keeps its numbers in a second file.
    #[error("{}", say!("errors-gltf-elsewhere", uri = .uri))]
    ExternalBuffer {
        /// Where the file says its data are.
        uri: String,
    },
    /// A part of a format that Lumen does not read.
    #[error("{}", say!("errors-unsupported", format = *.format, feature = .feature))]
    Unsupported {
        /// The format.
        format: &'static str,
        /// The part of the format.
        feature: String,
    },
    /// More corners than 32-bit indices can number.
    #[error("{}", say!("errors-too-large", corners = .corners.to_string(), limit = .limit.to_string()))]
    TooLarge {
        /// Vertices or corners of triangles, whichever are more.
        corners: u64,
        /// The most that can be taken.
        limit: u64,
    },
    /// A readable file without a surface.
    #[error("{}", say!("errors-no-triangles", format = *.format, vertices = .vertices.to_string()))]
    NoTriangles {
        /// The format.
        format: &'static str,
        /// Vertices in the file.
        vertices: usize,
    },
    /// A readable file of lines or points alone.
    #[error("{}", say!("errors-no-surface", format = *.format, found = .found))]
    NoSurface {
        /// The format.
        format: &'static str,
        /// What it holds: "145 lines".
        found: String,
    },
    /// A few bytes that stand for more than can be honest.
    #[error("{}", say!("errors-unfolds", format = *.format, what = .what, file = .file.to_string()))]
    Unfolds {
        /// The format.
        format: &'static str,
        /// What it unfolds to.
        what: String,
        /// Bytes that it has for that.
        file: u64,
    },
    /// Triangles, but each with a repeated vertex.
    #[error("{}", say!("errors-all-degenerate", format = *.format, triangles = .triangles.to_string()))]
    AllDegenerate {
        /// The format.
        format: &'static str,
        /// Triangles in the file.
        triangles: usize,
    },
}

/// Why a surface was not written.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WriteError {
    /// No triangle to write.
    #[error("{}", say!("errors-nothing-to-save"))]
    Empty,
    /// A triangle names a vertex that does not exist.
    #[error("{}", say!(
        "errors-triangle-refers",
        triangle = .triangle.to_string(),
        index = .index.to_string(),
        vertices = .vertices.to_string()
    ))]
    IndexOutOfRange {
        /// The triangle, from 0.
        triangle: usize,
        /// The vertex it names.
        index: u32,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// A position or a normal is NaN or infinite.
    #[error("{}", say!("errors-not-finite", vertex = .vertex.to_string()))]
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
    },
    /// There must be one normal for each vertex.
    #[error("{}", say!("errors-normal-count", normals = .normals.to_string(), vertices = .vertices.to_string()))]
    NormalCount {
        /// Normals given.
        normals: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// An array must have a tuple for each vertex or triangle.
    #[error("{}", say!("errors-array-length", name = .name, tuples = .tuples.to_string(), rows = .rows.to_string()))]
    ArrayLength {
        /// Its name.
        name: String,
        /// Tuples that it has.
        tuples: usize,
        /// Vertices or triangles of the mesh.
        rows: usize,
    },
    /// More than the format's 32-bit counts can hold.
    #[error("{}", say!("errors-format-too-large", format = *.format, bytes = .bytes.to_string()))]
    TooLarge {
        /// The format.
        format: &'static str,
        /// Bytes that it would take.
        bytes: u64,
    },
}

/// That a file is none of those that can be opened, in the language that is spoken.
fn unknown(name: &str) -> String {
    let [formats @ .., last] = KINDS.map(|kind| kind.label);
    say!("errors-file-unknown", name = name, formats = formats.join(", "), last = last)
}
