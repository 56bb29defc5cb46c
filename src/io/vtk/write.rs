//! VTK's files of polygonal data, written: XML with its data appended raw and compressed by zlib, and legacy binary.
//!
//! The legacy file is of version 4.2, the newest that programs without VTK 9 read. Both have 32-bit numbers; the
//! XML file has 64-bit ones for its cells where 32 bits do not hold them.

use miniz_oxide::deflate::compress_to_vec_zlib;

use super::super::error::WriteError;
use crate::mesh::{TriMesh, Vec3};

/// Bytes of a block before it is compressed: what VTK takes for one.
const BLOCK: usize = 1 << 15;
/// zlib's usual level.
const LEVEL: u8 = 6;

/// The XML file (.vtp), with normals as the point data that VTK takes them for.
pub(in crate::io) fn xml(mesh: &TriMesh, normals: Option<&[Vec3]>) -> Vec<u8> {
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let mut data = Appended::default();
    let mut array = |kind: &str, name: &str, bytes: &[u8]| {
        let components = if kind == "Float32" { " NumberOfComponents=\"3\"" } else { "" };
        let offset = data.add(bytes);
        format!("<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"appended\" offset=\"{offset}\"/>\n")
    };
    let is_narrow = i32::try_from(3 * triangles).is_ok() && i32::try_from(vertices).is_ok();
    let ids = |numbers: &mut dyn Iterator<Item = u64>| -> Vec<u8> {
        if is_narrow {
            numbers.flat_map(|n| (n as u32).to_le_bytes()).collect()
        } else {
            numbers.flat_map(u64::to_le_bytes).collect()
        }
    };
    let id = if is_narrow { "Int32" } else { "Int64" };
    let normals = normals.map_or(String::new(), |normals| {
        let array = array("Float32", "Normals", &vectors(normals, f32::to_le_bytes));
        format!("<PointData Normals=\"Normals\">\n{array}</PointData>\n")
    });
    let points = array("Float32", "Points", &vectors(&mesh.positions, f32::to_le_bytes));
    let corners = ids(&mut mesh.triangles.as_flattened().iter().map(|&v| u64::from(v)));
    let connectivity = array(id, "connectivity", &corners);
    drop(corners);
    let offsets = array(id, "offsets", &ids(&mut (1..=triangles as u64).map(|n| 3 * n)));
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<!-- Surface written by Lumen; millimetres -->\n\
         <VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" \
         compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n\
         <Piece NumberOfPoints=\"{vertices}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{triangles}\">\n{normals}<Points>\n{points}</Points>\n<Polys>\n{connectivity}{offsets}</Polys>\n\
         </Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_"
    )
    .into_bytes();
    out.append(&mut data.bytes);
    out.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    out
}

/// Arrays one after another, compressed, each with its header.
#[derive(Default)]
struct Appended {
    bytes: Vec<u8>,
}

impl Appended {
    /// Adds an array and says where it begins.
    fn add(&mut self, array: &[u8]) -> usize {
        let start = self.bytes.len();
        let blocks: Vec<Vec<u8>> = array.chunks(BLOCK).map(|block| compress_to_vec_zlib(block, LEVEL)).collect();
        let header = [blocks.len(), BLOCK, array.len() % BLOCK];
        for word in header.into_iter().chain(blocks.iter().map(Vec::len)) {
            // No block is longer than 32 bits can say, and a mesh has no more of them.
            self.bytes.extend_from_slice(&(word as u32).to_le_bytes());
        }
        self.bytes.extend(blocks.into_iter().flatten());
        start
    }
}

/// The legacy binary file (.vtk).
///
/// # Errors
/// [`WriteError::TooLarge`] where its 32-bit numbers do not hold the mesh.
pub(in crate::io) fn legacy(mesh: &TriMesh, normals: Option<&[Vec3]>) -> Result<Vec<u8>, WriteError> {
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let size = 4 * triangles as u64;
    let bytes = 12 * vertices as u64 * (1 + u64::from(normals.is_some())) + 4 * size;
    if i32::try_from(size).is_err() || i32::try_from(vertices).is_err() {
        return Err(WriteError::TooLarge { format: "VTK", bytes });
    }
    let mut out = Vec::with_capacity(bytes as usize + 256);
    out.extend_from_slice(
        b"# vtk DataFile Version 4.2\nSurface written by Lumen; millimetres\nBINARY\nDATASET POLYDATA\n",
    );
    out.extend_from_slice(format!("POINTS {vertices} float\n").as_bytes());
    out.append(&mut vectors(&mesh.positions, f32::to_be_bytes));
    out.extend_from_slice(format!("\nPOLYGONS {triangles} {size}\n").as_bytes());
    for &[a, b, c] in &mesh.triangles {
        out.extend_from_slice(bytemuck::cast_slice(&[3, a, b, c].map(u32::to_be_bytes)));
    }
    if let Some(normals) = normals {
        out.extend_from_slice(format!("\nPOINT_DATA {vertices}\nNORMALS Normals float\n").as_bytes());
        out.append(&mut vectors(normals, f32::to_be_bytes));
    }
    out.push(b'\n');
    Ok(out)
}

/// The bytes of vectors, one after another.
fn vectors(vectors: &[Vec3], bytes: fn(f32) -> [u8; 4]) -> Vec<u8> {
    vectors.iter().copied().flat_map(|v| [v.x, v.y, v.z]).flat_map(bytes).collect()
}
