//! glTF texts and containers made for it: what is drawn and where it comes to lie, what is refused, and what is written.

use base64::Engine as _;
use glam::DVec3;

use super::super::Unit;
use super::super::error::ReadError;
use super::super::output::Output;
use super::super::pace::Pace;
use super::super::raw::RawSurface;
use super::super::text::BASE64;
use super::container::{read_binary, read_text};
use super::write::write;
use lumen_mesh::task::at_once;
use lumen_mesh::{TriMesh, Vec3};

/// A glTF text of four vertices of a unit square, drawn by `primitive` under `nodes`.
fn square(nodes: &str, primitive: &str) -> String {
    let corners = [[0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let mut data: Vec<u8> = corners.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    data.extend([0, 1, 2, 3]);
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{nodes}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}{primitive}}}]}}],\"accessors\":[\
         {{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}},\
         {{\"bufferView\":1,\"componentType\":5121,\"count\":4,\"type\":\"SCALAR\"}}],\"bufferViews\":[\
         {{\"buffer\":0,\"byteLength\":48}},{{\"buffer\":0,\"byteOffset\":48,\"byteLength\":4}}],\
         \"buffers\":[{{\"byteLength\":52,\"uri\":\"data:application/octet-stream;base64,{}\"}}]}}",
        BASE64.encode(data)
    )
}

fn read(text: &str) -> Result<RawSurface, ReadError> {
    at_once(read_text(text.as_bytes(), Unit::Metre, DVec3::ZERO, &Pace::never()))
}

#[test]
fn strips_fans_and_lists_are_drawn() {
    let triangles = |primitive: &str| read(&square("{\"mesh\":0}", primitive)).unwrap().triangles;
    assert_eq!(triangles(",\"indices\":1,\"mode\":5"), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(triangles(",\"mode\":6"), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(triangles(",\"indices\":1"), [[0, 1, 2]]);
    assert_eq!(read(&square("{\"mesh\":0}", ",\"mode\":1")).unwrap().skipped.lines, 2);
}

#[test]
fn transforms_go_down_the_tree_and_mirrors_keep_the_outside_out() {
    let half_turn = "{\"children\":[1],\"rotation\":[0,0,1,0],\"translation\":[0.1,0,0]}";
    let raw = read(&square(&format!("{half_turn},{{\"mesh\":0,\"scale\":[2,2,2]}}"), "")).unwrap();
    assert_eq!(raw.positions[3], Vec3::new(-1900.0, 0.0, -2000.0));
    assert_eq!(raw.triangles, [[0, 1, 2]]);
    let mirror = "{\"mesh\":0,\"matrix\":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}";
    let raw = read(&square(mirror, "")).unwrap();
    assert_eq!((raw.positions[1], raw.triangles[0]), (Vec3::new(-1000.0, 0.0, 0.0), [0, 2, 1]));
}

#[test]
fn lies_are_refused_in_a_sentence() {
    let good = square("{\"mesh\":0}", ",\"indices\":1");
    let problem = |from: &str, to: &str| read(&good.replace(from, to)).err().unwrap().to_string();
    assert_eq!(
        problem("\"count\":4,\"type\":\"VEC3\"", "\"count\":4000000000,\"type\":\"VEC3\""),
        "The glTF file is broken: accessor 0 lies beyond the end of the data."
    );
    assert!(
        problem("\"count\":4,\"type\":\"VEC3\"", "\"count\":18446744073709551615,\"type\":\"VEC3\"").contains("beyond")
    );
    assert!(problem("\"count\":4,\"type\":\"VEC3\"", "\"count\":2,\"type\":\"VEC3\"").contains("refers to vertex 2"));
    assert!(problem("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}").contains("node 0 hangs from two others"));
    assert!(problem("\"mesh\":0", "\"mesh\":7").contains("mesh 7 is missing"));
    assert!(problem("\"asset\"", "asset").contains("its JSON is wrong"));
    let other = problem("data:application/octet-stream;base64,", "square.bin?");
    assert!(other.starts_with("The glTF file keeps its data in another file (square.bin?AAAA"), "{other}");
}

#[test]
fn quantised_positions_are_those_that_they_stand_for() {
    let text = |component: u32, is_normalized: bool, bytes: &[u8]| {
        let data = BASE64.encode(bytes);
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"extensionsRequired\":[\"KHR_mesh_quantization\"],\
             \"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],\
             \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],\
             \"accessors\":[{{\"bufferView\":0,\"componentType\":{component},\"count\":3,\"type\":\"VEC3\",\
             \"normalized\":{is_normalized}}}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{0}}}],\
             \"buffers\":[{{\"byteLength\":{0},\"uri\":\"data:;base64,{data}\"}}]}}",
            bytes.len(),
        )
    };
    let shorts = |numbers: [i16; 9]| numbers.map(i16::to_le_bytes).concat();
    // The least and the largest number; y is up in the file, z here.
    let normalized = text(5122, true, &shorts([0, 0, 0, 32767, 0, 0, 0, -32768, 0]));
    assert_eq!(read(&normalized).unwrap().positions, [Vec3::ZERO, Vec3::X * 1000.0, Vec3::Z * -1000.0]);
    let whole = text(5122, false, &shorts([0, 0, 0, 3, 0, 0, 0, -2, 0]));
    assert_eq!(read(&whole).unwrap().positions, [Vec3::ZERO, Vec3::X * 3000.0, Vec3::Z * -2000.0]);
    let bytes = text(5121, true, &[0, 0, 0, 255, 0, 0, 0, 51, 0]);
    assert_eq!(read(&bytes).unwrap().positions[2], Vec3::Z * 200.0);
}

#[test]
fn compressed_meshes_are_refused_by_the_name_of_the_compression() {
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression"] {
        let text = square("{\"mesh\":0}", "").replacen('{', &format!("{{\"extensionsRequired\":[\"{name}\"],"), 1);
        let error = read(&text).err().unwrap().to_string();
        assert_eq!(error, format!("The glTF file uses {name}, which Lumen does not read."));
    }
}

#[test]
fn a_container_that_lies_is_refused() {
    let problem = |bytes: &[u8]| {
        let read = at_once(read_binary(bytes, Unit::Metre, DVec3::ZERO, &Pace::never()));
        read.err().unwrap().to_string()
    };
    assert_eq!(problem(b"glTF\x02\0\0"), "The GLB file is cut short: it announces 12 bytes and holds 7.");
    assert!(problem(b"glTF\x01\0\0\0\x0c\0\0\0").contains("uses version 1"));
    assert!(problem(b"glTF\x02\0\0\0\x00\0\0\0").contains("no JSON part"));
    assert!(problem(b"glTF\x02\0\0\0\x14\0\0\0\xff\xff\xff\xffJSON").contains("announces 4294967315 bytes"));
}

#[test]
fn what_is_up_in_the_file_is_up_and_written_so() {
    // The square's third corner is a metre up, by the specification.
    let raw = read(&square("{\"mesh\":0}", "")).unwrap();
    assert_eq!(raw.positions[2], Vec3::Z * 1000.0);
    // 100 mm to the front, -y, and 300 mm up: to another program along z, and along y.
    let [front, up] = [Vec3::new(0.0, -100.0, 0.0), Vec3::new(0.0, 0.0, 300.0)];
    let mesh = TriMesh { positions: vec![Vec3::ZERO, front, up], triangles: vec![[0, 1, 2]] };
    let bytes = write(&Output { normals: Some(&[Vec3::Z; 3]), ..Output::new(&mesh) }).unwrap();
    let json = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let numbers: Vec<f32> =
        bytes[28 + json..][..72].as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    assert_eq!(numbers[..9], [0.0, 0.0, 0.0, 0.0, 0.0, 100.0, 0.0, 300.0, 0.0]);
    assert_eq!(numbers[9..12], [0.0, 1.0, 0.0]);
    let text = String::from_utf8_lossy(&bytes[20..20 + json]);
    assert!(text.contains("\"max\":[0,300,100]"), "{text}");
}

#[test]
fn millimetres_survive_the_metre_bit_for_bit() {
    let positions: Vec<Vec3> = (1..4000).map(|i| Vec3::new(i as f32 / 7.0, -1e-5 * i as f32, 1e6 / i as f32)).collect();
    let mesh = TriMesh { triangles: vec![[0, 1, 2]], positions };
    let normals = vec![Vec3::Z; mesh.positions.len()];
    for normals in [None, Some(&normals[..])] {
        let raw = write(&Output { normals, ..Output::new(&mesh) }).unwrap();
        let raw = at_once(read_binary(&raw, Unit::Metre, DVec3::ZERO, &Pace::never())).unwrap();
        assert_eq!((&raw.positions, &raw.triangles), (&mesh.positions, &mesh.triangles));
    }
}
