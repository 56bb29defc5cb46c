//! VTK's files of polygonal data, written: XML with its data appended raw and compressed by zlib, and legacy binary.
//!
//! The legacy file is of version 4.2, the newest that programs without VTK 9 read. Both have 32-bit numbers; the
//! XML file has 64-bit ones for its cells where 32 bits do not hold them. Arrays are written in their own types, as
//! point and cell data; those of the legacy file as a field, which holds any number of components.

use miniz_oxide::deflate::compress_to_vec_zlib;

use super::super::Axes;
use super::super::error::WriteError;
use super::super::output::Output;
use lumen_mesh::arrays::{Association, Scalar};
use lumen_mesh::{Array, Vec3};

/// Bytes of a block before it is compressed: what VTK takes for one.
const BLOCK: usize = 1 << 15;
/// zlib's usual level.
const LEVEL: u8 = 6;

/// The XML file (.vtp), with normals as the point data that VTK takes them for.
pub(super) fn xml(output: &Output) -> Vec<u8> {
    let Output { mesh, normals, arrays, axes } = *output;
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let mut data = Appended::default();
    let mut array = |kind: &str, name: &str, components: usize, bytes: &[u8]| {
        let components = if components == 1 { String::new() } else { format!(" NumberOfComponents=\"{components}\"") };
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
    let mut point_data =
        normals.map_or(String::new(), |normals| array("Float32", "Normals", 3, &vectors(normals, f32::to_le_bytes)));
    let mut cell_data = String::new();
    for Array { name, on, components, values, .. } in arrays {
        let line = array(values.scalar().vtk_name(), &escaped(name), *components, values.bytes());
        if *on == Association::Point { &mut point_data } else { &mut cell_data }.push_str(&line);
    }
    let attributes = if normals.is_some() { " Normals=\"Normals\"" } else { "" };
    let section = |name: &str, attributes: &str, lines: String| {
        if lines.is_empty() { lines } else { format!("<{name}{attributes}>\n{lines}</{name}>\n") }
    };
    let data_sections = section("PointData", attributes, point_data) + &section("CellData", "", cell_data);
    let points = array("Float32", "Points", 3, &vectors(&mesh.positions, f32::to_le_bytes));
    let corners = ids(&mut mesh.triangles.as_flattened().iter().map(|&v| u64::from(v)));
    let connectivity = array(id, "connectivity", 1, &corners);
    drop(corners);
    let offsets = array(id, "offsets", 1, &ids(&mut (1..=triangles as u64).map(|n| 3 * n)));
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<!-- Surface written by Lumen; millimetres -->\n\
         <VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" \
         compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n{}\
         <Piece NumberOfPoints=\"{vertices}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{triangles}\">\n{data_sections}<Points>\n{points}</Points>\n<Polys>\n{connectivity}{offsets}\
         </Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_",
        space(axes),
    )
    .into_bytes();
    out.append(&mut data.bytes);
    out.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    out
}

/// The field data that say which way the axes point, as 3D Slicer writes them: the letters as a string, with its end.
fn space(axes: Axes) -> String {
    let letters = match axes {
        Axes::Lps => "76 80 83 0",
        Axes::Ras => "82 65 83 0",
        Axes::Unknown => return String::new(),
    };
    format!(
        "<FieldData>\n<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">\n{letters}\n\
         </Array>\n</FieldData>\n"
    )
}

/// A name as the value of an attribute.
fn escaped(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
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
pub(super) fn legacy(output: &Output) -> Result<Vec<u8>, WriteError> {
    let Output { mesh, normals, arrays, axes } = *output;
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let size = 4 * triangles as u64;
    let bytes = 12 * vertices as u64 * (1 + u64::from(normals.is_some())) + 4 * size;
    if i32::try_from(size).is_err() || i32::try_from(vertices).is_err() {
        return Err(WriteError::TooLarge { format: "VTK", bytes });
    }
    let mut out = Vec::with_capacity(bytes as usize + 256);
    let title = format!("Surface written by Lumen; millimetres{}", axes.said());
    out.extend_from_slice(format!("# vtk DataFile Version 4.2\n{title}\nBINARY\nDATASET POLYDATA\n").as_bytes());
    out.extend_from_slice(format!("POINTS {vertices} float\n").as_bytes());
    out.append(&mut vectors(&mesh.positions, f32::to_be_bytes));
    out.extend_from_slice(format!("\nPOLYGONS {triangles} {size}\n").as_bytes());
    for &[a, b, c] in &mesh.triangles {
        out.extend_from_slice(bytemuck::cast_slice(&[3, a, b, c].map(u32::to_be_bytes)));
    }
    for (on, keyword, rows) in
        [(Association::Point, "POINT_DATA", vertices), (Association::Triangle, "CELL_DATA", triangles)]
    {
        let arrays: Vec<&Array> = arrays.iter().filter(|array| array.on == on).collect();
        let normals = normals.filter(|_| on == Association::Point);
        if !arrays.is_empty() || normals.is_some() {
            out.extend_from_slice(format!("\n{keyword} {rows}").as_bytes());
        }
        if let Some(normals) = normals {
            out.extend_from_slice(b"\nNORMALS Normals float\n");
            out.append(&mut vectors(normals, f32::to_be_bytes));
        }
        field(&arrays, rows, &mut out);
    }
    out.push(b'\n');
    Ok(out)
}

/// Adds arrays of `rows` tuples as a field.
fn field(arrays: &[&Array], rows: usize, out: &mut Vec<u8>) {
    if arrays.is_empty() {
        return;
    }
    out.extend_from_slice(format!("\nFIELD FieldData {}", arrays.len()).as_bytes());
    for Array { name, components, values, .. } in arrays {
        let kind = legacy_name(values.scalar());
        out.extend_from_slice(format!("\n{} {components} {rows} {kind}\n", encoded(name)).as_bytes());
        for number in values.bytes().chunks_exact(values.scalar().size()) {
            out.extend(number.iter().rev());
        }
    }
}

/// A name as one word of printable characters.
fn encoded(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_graphic() && byte != b'%' && byte != b'"';
    name.bytes().map(|byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") }).collect()
}

/// What the legacy format calls a type; a `long` has as many bits as the machine says that reads it.
fn legacy_name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::I8 => "char",
        Scalar::U8 => "unsigned_char",
        Scalar::I16 => "short",
        Scalar::U16 => "unsigned_short",
        Scalar::I32 => "int",
        Scalar::U32 => "unsigned_int",
        Scalar::I64 => "vtktypeint64",
        Scalar::U64 => "vtktypeuint64",
        Scalar::F32 => "float",
        Scalar::F64 => "double",
    }
}

/// The bytes of vectors, one after another.
fn vectors(vectors: &[Vec3], bytes: fn(f32) -> [u8; 4]) -> Vec<u8> {
    vectors.iter().copied().flat_map(|v| [v.x, v.y, v.z]).flat_map(bytes).collect()
}
