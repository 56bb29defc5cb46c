//! What can go wrong with a file, each in one sentence that needs no programmer to understand.

use super::output::Output;
use crate::mesh::arrays::On;
use thiserror::Error;

/// Why a file was not opened. Every message is one sentence.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ReadError {
    /// No bytes at all.
    #[error("The file is empty.")]
    Empty,
    /// Neither the content nor the extension is one that Lumen knows.
    #[error("\"{name}\" is not a surface that Lumen knows: it opens STL, PLY, OBJ, VTP, VTK, GLB and glTF files.")]
    Unknown {
        /// The file's name.
        name: String,
    },
    /// VTK data of another kind than surfaces.
    #[error("This is VTK data of another kind ({kind}), and Lumen opens surfaces: extract its surface and save that.")]
    VtkKind {
        /// What VTK calls it.
        kind: String,
    },
    /// A VTK file that only names others.
    #[error("This VTK file ({kind}) only names others that hold the data: open one of those.")]
    VtkIndex {
        /// What VTK calls it.
        kind: String,
    },
    /// An image volume, not a surface.
    #[error("This is an image volume ({format}), and Lumen opens surfaces: segment it and save the surface first.")]
    ImageVolume {
        /// The format.
        format: &'static str,
    },
    /// A compressed file or an archive.
    #[error("This is a compressed file ({format}): unpack it and open the surface inside.")]
    Compressed {
        /// The format.
        format: &'static str,
    },
    /// Less is there than the file itself announces.
    #[error("The {format} file is cut short: it announces {announced} {what} and holds {found}.")]
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
    #[error("The {format} file is broken at line {line}: {problem}.")]
    Syntax {
        /// The format.
        format: &'static str,
        /// Line number, from 1.
        line: usize,
        /// What is wrong there.
        problem: String,
    },
    /// A file breaks its format's rules in a place that has no line.
    #[error("The {format} file is broken: {problem}.")]
    Malformed {
        /// The format.
        format: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// A face names a vertex that does not exist.
    #[error("Face {face} of the {format} file refers to vertex {index}, but the file has {vertices} vertices.")]
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
    #[error("Vertex {vertex} of the file has the coordinate {value}, which is not a place in a body.")]
    Coordinate {
        /// Number of the vertex, from 1.
        vertex: usize,
        /// The coordinate in mm.
        value: f64,
    },
    /// A glTF file that keeps its numbers in a second file.
    #[error("The glTF file keeps its data in another file ({uri}): save it as one GLB file and open that.")]
    ExternalBuffer {
        /// Where the file says its data are.
        uri: String,
    },
    /// A part of a format that Lumen does not read.
    #[error("The {format} file uses {feature}, which Lumen does not read.")]
    Unsupported {
        /// The format.
        format: &'static str,
        /// The part of the format.
        feature: String,
    },
    /// More corners than 32-bit indices can number.
    #[error("The surface is too large: it has {corners} vertices or corners, and Lumen can take {limit}.")]
    TooLarge {
        /// Vertices or corners of triangles, whichever are more.
        corners: u64,
        /// The most that can be taken.
        limit: u64,
    },
    /// A readable file without a surface.
    #[error("The {format} file holds no triangles ({vertices} vertices and nothing between them to show).")]
    NoTriangles {
        /// The format.
        format: &'static str,
        /// Vertices in the file.
        vertices: usize,
    },
    /// A readable file of lines or points alone.
    #[error("The {format} file holds no surface, only {found}: Lumen does not open centrelines.")]
    NoSurface {
        /// The format.
        format: &'static str,
        /// What it holds: "145 lines".
        found: String,
    },
    /// A few bytes that stand for more than can be honest.
    #[error("The {format} file would unfold to {what}, more than a file of {file} bytes can honestly hold.")]
    Unfolds {
        /// The format.
        format: &'static str,
        /// What it unfolds to.
        what: String,
        /// Bytes that it has for that.
        file: u64,
    },
    /// Triangles, but each with a repeated vertex.
    #[error("None of the {triangles} triangles of the {format} file has an area: each repeats one of its vertices.")]
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
    #[error("There is no surface to save.")]
    Empty,
    /// A triangle names a vertex that does not exist.
    #[error("Triangle {triangle} refers to vertex {index}, but there are {vertices} vertices.")]
    IndexOutOfRange {
        /// The triangle, from 0.
        triangle: usize,
        /// The vertex it names.
        index: u32,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// A position or a normal is NaN or infinite.
    #[error("Vertex {vertex} has a position or a normal that is not a finite number.")]
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
    },
    /// There must be one normal for each vertex.
    #[error("There are {normals} normals for {vertices} vertices.")]
    NormalCount {
        /// Normals given.
        normals: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// An array must have a tuple for each vertex or triangle.
    #[error("The array \"{name}\" has {tuples} tuples for {rows} vertices or triangles.")]
    ArrayLength {
        /// Its name.
        name: String,
        /// Tuples that it has.
        tuples: usize,
        /// Vertices or triangles of the mesh.
        rows: usize,
    },
    /// More than the format's 32-bit counts can hold.
    #[error("The surface is too large for a {format} file: it would take {bytes} bytes.")]
    TooLarge {
        /// The format.
        format: &'static str,
        /// Bytes that it would take.
        bytes: u64,
    },
}

/// Refuses what no format can hold.
pub(super) fn check_writable(&Output { mesh, normals, arrays, .. }: &Output) -> Result<(), WriteError> {
    let vertices = mesh.positions.len();
    if mesh.triangles.is_empty() {
        return Err(WriteError::Empty);
    }
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(WriteError::IndexOutOfRange { triangle, index, vertices });
        }
    }
    if let Some(vertex) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return Err(WriteError::NotFinite { vertex });
    }
    for array in arrays {
        let rows = if array.on == On::Point { vertices } else { mesh.triangles.len() };
        if array.values.len() != rows * array.components {
            return Err(WriteError::ArrayLength { name: array.name.clone(), tuples: array.len(), rows });
        }
    }
    if let Some(normals) = normals {
        if normals.len() != vertices {
            return Err(WriteError::NormalCount { normals: normals.len(), vertices });
        }
        if let Some(vertex) = normals.iter().position(|n| !n.is_finite()) {
            return Err(WriteError::NotFinite { vertex });
        }
    }
    Ok(())
}
