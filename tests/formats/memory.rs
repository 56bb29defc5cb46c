//! How much memory reading takes: never more than twenty times the file and 64 MB.

use lumen::io::{Format, write};
use lumen::phantom::{Sample, generate};

use crate::{alone, read_measured};

/// The most that reading `file` bytes may take.
pub(crate) fn room(file: usize) -> usize {
    20 * file + 64_000_000
}

#[test]
fn honest_files_stay_far_below() {
    let _alone = alone();
    let mesh = generate(Sample::Aorta, 400_000).unwrap();
    for format in Format::ALL {
        let bytes = write(&mesh, None, format).unwrap();
        let (result, taken) = read_measured(&bytes, "a");
        let report = result.unwrap().report;
        println!(
            "{format:?}: {} bytes, {:.1} times that, {:.1} a triangle",
            bytes.len(),
            taken as f64 / bytes.len() as f64,
            taken as f64 / report.triangles as f64
        );
        assert!(taken < room(bytes.len()), "{format:?}");
    }
}

/// Reads a file that stands for much more than its size, and looks that it took no more than it may.
fn stays_within(what: &str, bytes: &[u8]) {
    let (result, taken) = read_measured(bytes, "a");
    println!("{what}: {} bytes took {taken} of {}, {:?}", bytes.len(), room(bytes.len()), result.as_ref().err());
    assert!(taken <= room(bytes.len()), "{what}: {} bytes took {taken}", bytes.len());
}

/// Bytes without a pattern.
fn noise(count: usize) -> Vec<u8> {
    let mut state = 1u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    (0..count).map(|_| next()).collect()
}

/// Coordinates of 256 vertices.
fn cloud() -> Vec<u8> {
    noise(3 * 256).iter().flat_map(|&byte| f32::from(byte).to_le_bytes()).collect()
}

#[test]
fn a_byte_a_triangle_is_refused_before_it_is_made() {
    let _alone = alone();
    let n = 8_000_000;
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 256\nproperty float x\nproperty float y\n\
        property float z\n";
    for element in ["tristrips", "face"] {
        let header = format!("{header}element {element} 1\nproperty list uint uchar vertex_indices\nend_header\n");
        let strip = [header.as_bytes(), &cloud(), &(n as u32).to_le_bytes(), &noise(n)].concat();
        stays_within(element, &strip);
    }
    let corners = "1 2 3 ".repeat(n / 6);
    stays_within("a face of OBJ", format!("v 0 0 0\nv 90 0 0\nv 0 90 0\nf {corners}\n").as_bytes());
    let faces = "f 1 2 3\n".repeat(n / 8);
    stays_within("faces of OBJ", format!("v 0 0 0\nv 90 0 0\nv 0 90 0\n{faces}").as_bytes());
    stays_within("vertices of OBJ", "v 0 0 0\n".repeat(n / 8).as_bytes());
    let facet = "facet outer loop vertex 0 0 0 vertex 9 0 0 vertex 0 9 0 endloop ";
    stays_within("text of STL", format!("solid\n{}", facet.repeat(n / facet.len())).as_bytes());
}

#[test]
fn many_small_parts_are_refused_before_they_are_kept() {
    let _alone = alone();
    let n = 8_000_000;
    let nodes = "{},".repeat(n / 3);
    stays_within("nodes", format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{nodes}{{}}]}}").as_bytes());
    stays_within("pieces", format!("<VTKFile type=\"PolyData\">{}", "<Piece/>".repeat(n / 8)).as_bytes());
    stays_within("elements", format!("<VTKFile type=\"PolyData\">{}", "<a>".repeat(n / 3)).as_bytes());
    let attributes = "a=\"\" ".repeat(n / 5);
    stays_within("attributes", format!("<VTKFile type=\"PolyData\"><Piece {attributes}/>").as_bytes());
    let legacy = "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\n";
    stays_within("lists", format!("{legacy}{}", "LINES 1 0\n".repeat(n / 10)).as_bytes());
    stays_within("words", format!("ply\ncomment {}\n", "a ".repeat(n / 2)).as_bytes());
    stays_within("elements of PLY", format!("ply\n{}", "element a 0\n".repeat(n / 12)).as_bytes());
    let properties = "property char a\n".repeat(n / 16);
    stays_within("properties", format!("ply\nformat ascii 1.0\nelement vertex 1\n{properties}").as_bytes());
}

/// A VTP file of one strip of `count` points, named by a byte each, in blocks of `block` bytes compressed by zlib.
fn strip(ids: &[u8], block: usize) -> Vec<u8> {
    let mut appended = Vec::new();
    let mut array = |bytes: &[u8]| {
        let offset = appended.len();
        let blocks: Vec<Vec<u8>> =
            bytes.chunks(block).map(|block| miniz_oxide::deflate::compress_to_vec_zlib(block, 9)).collect();
        let header = [blocks.len(), block, bytes.len() % block];
        appended.extend(header.into_iter().chain(blocks.iter().map(Vec::len)).flat_map(|n| (n as u32).to_le_bytes()));
        appended.extend(blocks.concat());
        offset
    };
    let (points, ids_at, ends) = (array(&cloud()), array(ids), array(&(ids.len() as u64).to_le_bytes()));
    let mut out = format!(
        "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\"><PolyData>\
         <Piece NumberOfPoints=\"256\" NumberOfStrips=\"1\"><Points>\
         <DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" offset=\"{points}\"/></Points><Strips>\
         <DataArray type=\"UInt8\" Name=\"connectivity\" format=\"appended\" offset=\"{ids_at}\"/>\
         <DataArray type=\"UInt64\" Name=\"offsets\" format=\"appended\" offset=\"{ends}\"/></Strips></Piece></PolyData>\
         <AppendedData encoding=\"raw\">_"
    )
    .into_bytes();
    out.extend(appended);
    out
}

#[test]
fn compressed_zeros_and_noise_stay_within() {
    let _alone = alone();
    stays_within("200 MB of zeros in a block", &strip(&vec![0; 200_000_000], 200_000_000));
    stays_within("15 MB of zeros", &strip(&vec![0; 15_000_000], 1 << 15));
    stays_within("noise", &strip(&noise(8_000_000), 1 << 15));
    stays_within("a little noise", &strip(&noise(300_000), 1 << 15));
}
