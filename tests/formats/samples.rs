//! A small valid file of every kind that is read.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use lumen::io::{Format, Output, write, write_output};
use lumen::mesh::arrays::{Association, Scalar, Values};
use lumen::mesh::{Array, TriMesh, Vec3};
use miniz_oxide::deflate::compress_to_vec_zlib;

/// The valid files, each with the name it has.
pub(crate) fn valid() -> Vec<(&'static str, Vec<u8>)> {
    let mesh = tetrahedra(3);
    let normals = vec![Vec3::Z; mesh.positions.len()];
    let binary = |format| write(&mesh, Some(&normals), format).expect("a valid mesh");
    let ids = Values::from_bytes(Scalar::U16, (0..24).collect());
    let flow = Values::from_floats(&[0.5; 36]);
    let arrays = [Array::new("Id", Association::Triangle, 1, ids), Array::new("Flow", Association::Point, 3, flow)];
    let carrying = |format| {
        let output = Output { arrays: &arrays, ..Output::new(&mesh) };
        write_output(&output, format).expect("arrays of its length")
    };
    let ascii_stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 90 0 0\nvertex 0 90 0\nendloop\n\
        endfacet\nendsolid a\n";
    let ascii_ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n90 0 0\n90 90 0\n0 90 0\n\
        4 0 1 2 3\n3 0 1 2\n";
    let big_ply = [
        &b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\nproperty short z\n\
        element face 1\nproperty list uchar uchar vertex_indices\nend_header\n"[..],
        &[0, 0, 0, 0, 0, 0, 0, 90, 0, 0, 0, 0, 0, 0, 0, 90, 0, 0, 3, 0, 1, 2],
    ]
    .concat();
    let gltf = "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\
        \"rotation\":[0,0,1,0]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":6}]}],\
        \"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\
        \"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\
        \"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
    let mut files = vec![
        ("a.stl", binary(Format::Stl)),
        ("a.ply", binary(Format::Ply)),
        ("a.obj", binary(Format::Obj)),
        ("a.vtp", binary(Format::Vtp)),
        ("a.vtk", binary(Format::Vtk)),
        ("a.glb", binary(Format::Glb)),
        ("a.ply", carrying(Format::Ply)),
        ("a.vtp", carrying(Format::Vtp)),
        ("a.vtk", carrying(Format::Vtk)),
        ("a.glb", carrying(Format::Glb)),
        ("a.stl", ascii_stl.into()),
        ("a.ply", ascii_ply.into()),
        ("a.ply", big_ply),
        ("a.gltf", gltf.into()),
        ("a.gltf", PACKED_GLTF.into()),
        ("a.vtk", LEGACY_TEXT.into()),
        ("a.vtk", legacy_binary_51()),
        ("a.vtk", LEGACY_GRID.into()),
        ("a.vtp", VTP_TEXT.into()),
        ("a.vtu", VTU_TEXT.into()),
    ];
    files.extend(Coding::ALL.map(|coding| ("a.vtp", vtp(coding))));
    files
}

/// Three vertices packed by meshopt, one of them put in place of another (sparse), held by a joint.
const PACKED_GLTF: &str = "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0,\"skin\":0},{\
    \"translation\":[1,0,0]}],\"skins\":[{\"joints\":[1]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\
    \"POSITION\":0,\"JOINTS_0\":2,\"WEIGHTS_0\":3},\"indices\":1}]}],\"accessors\":[{\"bufferView\":0,\
    \"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":2,\
    \"componentType\":5121},\"values\":{\"bufferView\":3}}},{\"bufferView\":1,\"componentType\":5123,\
    \"count\":3,\"type\":\"SCALAR\"},{\"bufferView\":4,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},{\
    \"bufferView\":5,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\",\"normalized\":true}],\"bufferViews\":[\
    {\"buffer\":0,\"byteLength\":36,\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":0,\
    \"byteLength\":57,\"byteStride\":12,\"mode\":\"ATTRIBUTES\",\"count\":3}}},{\"buffer\":0,\"byteLength\":6,\
    \"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":57,\"byteLength\":18,\
    \"byteStride\":2,\"mode\":\"TRIANGLES\",\"count\":3}}},{\"buffer\":0,\"byteOffset\":75,\"byteLength\":4},{\
    \"buffer\":0,\"byteOffset\":79,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":91,\"byteLength\":12},{\
    \"buffer\":0,\"byteOffset\":103,\"byteLength\":12}],\"buffers\":[{\"byteLength\":115,\
    \"uri\":\"data:;base64,oAAAATwAAAD//wE8AAAAfn0AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA4fAA\
    dodWZ3iphmWJaJgBaQAAAgAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAP8AAAD/AAAA/wAAAA==\"}]}";

/// Detached tetrahedra, outward, 100 mm apart.
pub(crate) fn tetrahedra(n: u32) -> TriMesh {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let sides = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    TriMesh {
        positions: (0..n).flat_map(|i| corners.map(|p| p * 30.0 + Vec3::splat(i as f32 * 100.0))).collect(),
        triangles: (0..n).flat_map(|i| sides.map(|t| t.map(|v| v + 4 * i))).collect(),
    }
}

/// The square that all the VTK files below hold, in four corners and one polygon or strip.
const CORNERS: [f32; 12] = [0.0, 0.0, 0.0, 90.0, 0.0, 0.0, 90.0, 90.0, 0.0, 0.0, 90.0, 0.0];

/// Text of version 3.0, with fields, metadata, points, lines, a polygon and a strip.
pub(crate) const LEGACY_TEXT: &str = "# vtk DataFile Version 3.0\n3D Slicer output. SPACE=RAS\nASCII\nDATASET POLYDATA\n\
    FIELD FieldData 2\nTimeValue 1 1 double\n0\nNames 1 2 string\none%20name\nanother\nPOINTS 4 float\n0 0 0 90 0 0\n\
    90 90 0 0 90 0\nMETADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 128\n\n\
    VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 1 5\n4 0 1 2 3\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\n\
    POINT_DATA 4\nSCALARS a float\nLOOKUP_TABLE default\n1 2 3 4\n";

/// An unstructured grid: a triangle, a pixel, a quadrilateral, a line and a tetrahedron.
pub(crate) const LEGACY_GRID: &str = "# vtk DataFile Version 2.0\ngrid\nASCII\nDATASET UNSTRUCTURED_GRID\n\
    POINTS 4 double\n0 0 0 90 0 0 90 90 0 0 90 0\nCELLS 5 22\n3 0 1 2\n4 0 1 3 2\n4 0 1 2 3\n2 0 1\n4 0 1 2 3\n\
    CELL_TYPES 5\n5\n8\n9\n3\n10\n";

/// Two pieces as text.
pub(crate) const VTP_TEXT: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n\
    <FieldData><Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">76 80 83 0</Array></FieldData>\n\
    <Piece NumberOfPoints=\"4\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"1\" NumberOfPolys=\"0\">\n\
    <PointData><DataArray type=\"Float32\" Name=\"a\" format=\"ascii\">1 2 3 4</DataArray></PointData>\n\
    <Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0 90 0 0 90 90 0 0 90 0\n\
    <InformationKey name=\"L2\"><Value index=\"0\">1</Value></InformationKey></DataArray></Points>\n\
    <Verts><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0</DataArray>\
    <DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">1</DataArray></Verts>\n\
    <Lines><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1</DataArray>\
    <DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">2</DataArray></Lines>\n\
    <Strips><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 3 2</DataArray>\
    <DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray></Strips>\n</Piece>\n\
    <Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">\n\
    <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 50 90 0 50 90 90 50</DataArray></Points>\n\
    <Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\
    <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";

/// An unstructured grid of a triangle and a tetrahedron, as text.
pub(crate) const VTU_TEXT: &str = "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>\n\
    <Piece NumberOfPoints=\"4\" NumberOfCells=\"2\"><Points>\n\
    <DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 90 0 0 90 90 0 0 90 0</DataArray></Points>\n\
    <Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 1 2 3</DataArray>\n\
    <DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 7</DataArray>\n\
    <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 10</DataArray></Cells></Piece>\n\
    </UnstructuredGrid></VTKFile>\n";

/// Binary of version 5.1: a field with a string, the square in 64-bit offsets and ids.
pub(crate) fn legacy_binary_51() -> Vec<u8> {
    let mut out = b"# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET POLYDATA\nFIELD FieldData 2\n\
        Name 1 1 string\n\xc5LumenMETADATA\nINFORMATION 0\n\nmask 1 9 bit\n\xff\x80\nPOINTS 4 float\n"
        .to_vec();
    out.extend(CORNERS.iter().flat_map(|x| x.to_be_bytes()));
    out.extend_from_slice(b"\nMETADATA\nINFORMATION 0\n\nPOLYGONS 2 4\nOFFSETS vtktypeint64\n");
    out.extend([0i64, 4].iter().flat_map(|n| n.to_be_bytes()));
    out.extend_from_slice(b"\nCONNECTIVITY vtktypeint64\n");
    out.extend([0i64, 1, 2, 3].iter().flat_map(|n| n.to_be_bytes()));
    out.extend_from_slice(b"\nCELL_DATA 1\nSCALARS a float\nLOOKUP_TABLE default\n\x3f\x80\0\0\n");
    out
}

/// A way to write the arrays of a VTP file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coding {
    pub(crate) is_big: bool,
    pub(crate) is_wide: bool,
    pub(crate) is_appended: bool,
    pub(crate) is_base64: bool,
    pub(crate) compressor: &'static str,
}

impl Coding {
    /// What programs write, and what is between.
    pub(crate) const ALL: [Self; 9] = [
        Self::new(false, false, true, true, ""),
        Self::new(false, true, true, false, ""),
        Self::new(true, false, true, false, ""),
        Self::new(true, true, false, true, ""),
        Self::new(false, false, false, true, "vtkZLibDataCompressor"),
        Self::new(false, true, true, true, "vtkZLibDataCompressor"),
        Self::new(true, true, true, false, "vtkZLibDataCompressor"),
        Self::new(false, false, true, false, "vtkLZ4DataCompressor"),
        Self::new(false, true, false, true, "vtkLZMADataCompressor"),
    ];

    const fn new(is_big: bool, is_wide: bool, is_appended: bool, is_base64: bool, compressor: &'static str) -> Self {
        Self { is_big, is_wide, is_appended, is_base64, compressor }
    }

    fn words(self, words: &[u64]) -> Vec<u8> {
        let bytes = words.iter().map(|&word| match (self.is_wide, self.is_big) {
            (true, true) => word.to_be_bytes().to_vec(),
            (true, false) => word.to_le_bytes().to_vec(),
            (false, true) => (word as u32).to_be_bytes().to_vec(),
            (false, false) => (word as u32).to_le_bytes().to_vec(),
        });
        bytes.collect::<Vec<_>>().concat()
    }

    /// An array with its header; where it is compressed, in blocks of 32 bytes, in base64 apart from the header.
    pub(crate) fn array(self, bytes: &[u8]) -> Vec<u8> {
        let [header, data] = if self.compressor.is_empty() {
            [Vec::new(), [self.words(&[bytes.len() as u64]), bytes.to_vec()].concat()]
        } else {
            let blocks: Vec<Vec<u8>> = bytes.chunks(32).map(|block| self.compress(block)).collect();
            let lengths = blocks.iter().map(|block| block.len() as u64);
            let start = [blocks.len() as u64, 32, bytes.len() as u64 % 32];
            [self.words(&start.into_iter().chain(lengths).collect::<Vec<_>>()), blocks.concat()]
        };
        if self.is_base64 {
            [header, data].map(|part| STANDARD.encode(part).into_bytes()).concat()
        } else {
            [header, data].concat()
        }
    }

    fn compress(self, block: &[u8]) -> Vec<u8> {
        match self.compressor {
            "vtkZLibDataCompressor" => compress_to_vec_zlib(block, 6),
            // LZ4 of literals alone: 15 of them and the rest of their number, then they.
            "vtkLZ4DataCompressor" if block.len() >= 15 => [&[0xf0, block.len() as u8 - 15], block].concat(),
            "vtkLZ4DataCompressor" => [&[(block.len() as u8) << 4], block].concat(),
            _ => xz(block),
        }
    }
}

/// An .xz stream without a check and with one LZMA2 chunk that is not compressed.
fn xz(block: &[u8]) -> Vec<u8> {
    let padded = |mut bytes: Vec<u8>| {
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        bytes
    };
    let checked = |bytes: Vec<u8>| [&bytes[..], &crc32(&bytes).to_le_bytes()].concat();
    let flags = [0, 0];
    let head = [&[0xfd, b'7', b'z', b'X', b'Z', 0], &flags[..], &crc32(&flags).to_le_bytes()].concat();
    // Twelve bytes of header: LZMA2 (0x21) with a dictionary of 4096 bytes.
    let block_head = checked(padded(vec![2, 0, 0x21, 1, 0]));
    let chunk = [&[1], &(block.len() as u16 - 1).to_be_bytes()[..], block, &[0]].concat();
    let unpadded = block_head.len() + chunk.len();
    let index = checked(padded(vec![0, 1, unpadded as u8, block.len() as u8]));
    let backward = [&(index.len() as u32 / 4 - 1).to_le_bytes()[..], &flags].concat();
    let projection = [&crc32(&backward).to_le_bytes()[..], &backward, b"YZ"].concat();
    [head, block_head, padded(chunk), index, projection].concat()
}

/// The checksum of .xz headers (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(sum & 1)))
    })
}

/// The square as a VTP file: one polygon of 32-bit ids over 64-bit floats.
pub(crate) fn vtp(coding: Coding) -> Vec<u8> {
    let order = |little: [u8; 8]| if coding.is_big { little.iter().rev().copied().collect() } else { little.to_vec() };
    let points: Vec<u8> = CORNERS.iter().flat_map(|&x| order(f64::from(x).to_le_bytes())).collect();
    let ids = |ids: &[u32]| -> Vec<u8> {
        ids.iter().flat_map(|n| if coding.is_big { n.to_be_bytes() } else { n.to_le_bytes() }).collect()
    };
    let mut appended = Vec::new();
    let mut array = |kind: &str, name: &str, bytes: &[u8]| {
        let bytes = coding.array(bytes);
        let head = format!("<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"1\"");
        if coding.is_appended {
            let offset = appended.len();
            appended.extend(bytes);
            format!("{head} format=\"appended\" offset=\"{offset}\"/>\n")
        } else {
            format!("{head} format=\"binary\">\n  {}\n</DataArray>\n", String::from_utf8_lossy(&bytes))
        }
    };
    let points = array("Float64", "Points", &points);
    let cells = array("Int32", "connectivity", &ids(&[0, 1, 2, 3])) + &array("Int32", "offsets", &ids(&[4]));
    let compressor = match coding.compressor {
        "" => String::new(),
        name => format!(" compressor=\"{name}\""),
    };
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"{}Endian\" header_type=\"UInt{}\"{compressor}>\n\
         <PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"1\">\n<Points>{points}</Points>\n<Polys>{cells}</Polys>\n\
         </Piece></PolyData>\n",
        if coding.is_big { "Big" } else { "Little" },
        if coding.is_wide { 64 } else { 32 },
    )
    .into_bytes();
    if coding.is_appended {
        let encoding = if coding.is_base64 { "base64" } else { "raw" };
        out.extend_from_slice(format!("<AppendedData encoding=\"{encoding}\">\n _").as_bytes());
        out.extend(appended);
        out.extend_from_slice(b"\n</AppendedData>\n");
    }
    out.extend_from_slice(b"</VTKFile>\n");
    out
}

/// Writes the samples into the folder that `LUMEN_SEEDS` names, a folder in it for each reader: `cargo xtask fuzz-files`
/// begins with them.
#[test]
fn seeds_are_written_where_they_are_asked_for() {
    let Some(folder) = std::env::var_os("LUMEN_SEEDS") else { return };
    for (i, (name, bytes)) in valid().into_iter().enumerate() {
        let reader = match name.trim_start_matches("a.") {
            "glb" => "gltf",
            "vtu" => "vtp",
            extension => extension,
        };
        let folder = std::path::Path::new(&folder).join(reader);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join(format!("seed-{i:02}")), bytes).unwrap();
    }
}
