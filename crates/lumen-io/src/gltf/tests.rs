//! glTF texts and containers made for it: what is drawn and where it comes to lie, what is refused, and what is written.

use base64::Engine as _;
use glam::DVec3;

use super::super::Unit;
use super::super::error::ReadError;
use super::super::output::Output;
use super::super::pace::Pace;
use super::super::raw::RawSurface;
use super::super::text::BASE64;
use super::super::warnings::Warning;
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
fn draco_is_refused_by_its_name() {
    let name = "KHR_draco_mesh_compression";
    let text = square("{\"mesh\":0}", "").replacen('{', &format!("{{\"extensionsRequired\":[\"{name}\"],"), 1);
    let error = read(&text).err().unwrap().to_string();
    assert_eq!(error, format!("The glTF file uses {name}, which Lumen does not read."));
    // Used, not required, and all data in it: BoxDraco.gltf of glTF-Transform.
    let text = square("{\"mesh\":0}", "").replacen('{', &format!("{{\"extensionsUsed\":[\"{name}\"],"), 1);
    assert!(read(&text).is_ok());
    let error = read(&text.replacen("\"bufferView\":0,", "", 1)).err().unwrap().to_string();
    assert_eq!(error, format!("The glTF file uses {name}, which Lumen does not read."));
}

#[test]
fn a_file_of_the_first_version_is_refused_by_it() {
    // Objects by name where version 2 has lists, as in glTF 1.0; the version as a text and as a number.
    for version in ["\"1.0\"", "\"1.0.1\"", "1", "1.0"] {
        let text = format!("{{\"asset\":{{\"version\":{version}}},\"meshes\":{{\"a\":{{\"primitives\":[]}}}}}}");
        let error = read(&text).err().unwrap().to_string();
        assert_eq!(error, "The glTF file uses version 1, which Lumen does not read.");
    }
    for version in ["\"2.0\"", "\"two\"", "null"] {
        let text = format!("{{\"asset\":{{\"version\":{version}}},\"meshes\":{{\"a\":{{\"primitives\":[]}}}}}}");
        assert!(read(&text).err().unwrap().to_string().contains("its JSON is wrong"));
    }
}

/// A bent strip of 16 triangles, from 1 m to -1 m, that the encoder of the npm package `meshoptimizer` has packed: places in
/// 16 bits, under a node that takes them back to metres.
fn strip(extension: &str) -> String {
    let places = BASE64
        .decode("oVWvAFRV+U8qgXCNngEAVQBUVQcTHyctLSsBACMAVFUsDizDOk62AQCqAFRVLioiGAoDEQEAHQAgHyAfIB8gHyAfIB8gHyAfIABOTU5NTk1OTU5NTk1OTU5NTgAAAAAAAAAAAAAAAAAAUMMwdTB1AAAAAA==")
        .unwrap();
    let triangles = BASE64.decode("4f4eHg4eDh4OHg4eDh4OHg7wBAB2h1ZneKmGZYlomAFpAAA=").unwrap();
    let [at, places_length, length] = [places.len(), places.len(), triangles.len()];
    let data = BASE64.encode([places, triangles].concat());
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"extensionsRequired\":[\"KHR_mesh_quantization\",\"{extension}\"],\
         \"nodes\":[{{\"mesh\":0,\"scale\":[5e-5,5e-5,5e-5],\"translation\":[-1.5,-1.5,-1.5]}}],\
         \"scenes\":[{{\"nodes\":[0]}}],\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}},\"indices\":1}}]}}],\
         \"accessors\":[{{\"bufferView\":0,\"componentType\":5123,\"count\":18,\"type\":\"VEC3\"}},\
         {{\"bufferView\":1,\"componentType\":5123,\"count\":48,\"type\":\"SCALAR\"}}],\"bufferViews\":[\
         {{\"buffer\":1,\"byteLength\":144,\"byteStride\":8,\"extensions\":{{\"{extension}\":{{\"buffer\":0,\
         \"byteLength\":{places_length},\"byteStride\":8,\"mode\":\"ATTRIBUTES\",\"count\":18}}}}}},\
         {{\"buffer\":1,\"byteOffset\":144,\"byteLength\":96,\"extensions\":{{\"{extension}\":{{\"buffer\":0,\"byteOffset\":{at},\
         \"byteLength\":{length},\"byteStride\":2,\"mode\":\"TRIANGLES\",\"count\":48}}}}}}],\"buffers\":[\
         {{\"byteLength\":{},\"uri\":\"data:;base64,{data}\"}},{{\"byteLength\":240}}]}}",
        at + length
    )
}

#[test]
fn meshopt_is_unpacked_into_places_and_triangles() {
    for extension in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let raw = read(&strip(extension)).unwrap();
        assert_eq!((raw.positions.len(), raw.triangles.len()), (18, 16));
        for (i, p) in raw.positions.iter().enumerate() {
            let (along, turn) = ((i % 2) as f32 * 500.0, (i / 2) as f32 * 0.3);
            let place = Vec3::new(1000.0 * turn.cos(), -along, 1000.0 * turn.sin());
            assert!(p.distance(place) < 0.05, "{i}: {p} is not {place}");
        }
        assert_eq!(raw.triangles[..2], [[0, 2, 1], [1, 2, 3]]);
        let damaged = strip(extension).replace("\"count\":48}}", "\"count\":45}}");
        let error = read(&damaged).err().unwrap().to_string();
        assert_eq!(error, "The glTF file is broken: its compressed view 1 is damaged, or of a kind that is not read.");
        // What is wrong of one view does not hide the other, and is no reason where nothing takes the view.
        for (from, to) in [("\"count\":48}}", "\"count\":48.0}}"), ("\"count\":48}}", "\"count\":48,\"filter\":1}}")] {
            let error = read(&strip(extension).replace(from, to)).err().unwrap().to_string();
            assert!(error.contains("compressed view 1 is damaged"), "{error}");
            let unused = strip(extension).replace(from, to).replace(",\"indices\":1", "");
            assert_eq!(read(&unused).unwrap().positions.len(), 18);
        }
        let bomb = strip(extension).replace("\"count\":18}}", "\"count\":18000000}}");
        assert!(read(&bomb).err().unwrap().to_string().contains("would unfold to"));
    }
}

/// A text with a second buffer that holds `data`, in views of so many bytes each, the first of which is view 2.
fn with_data(text: &str, data: &[u8], views: &[usize]) -> String {
    let (mut at, mut more) = (0, String::new());
    for length in views {
        more += &format!(",{{\"buffer\":1,\"byteOffset\":{at},\"byteLength\":{length}}}");
        at += length;
    }
    let text = text.replace("],\"buffers\":[", &format!("{more}],\"buffers\":["));
    let buffer = format!("{{\"byteLength\":{at},\"uri\":\"data:;base64,{}\"}}", BASE64.encode(data));
    format!("{},{buffer}]}}", text.strip_suffix("]}").unwrap())
}

#[test]
fn sparse_items_stand_in_place_of_others_or_of_zeros() {
    let values = [[5f32, 0.0, 0.0], [5.0, 5.0, 0.0]];
    let square =
        with_data(&square("{\"mesh\":0}", ",\"mode\":5"), &[&[1, 3], bytemuck::bytes_of(&values)].concat(), &[2, 24]);
    let sparse =
        "\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":2,\"componentType\":5121},\"values\":{\"bufferView\":3}},";
    let over_view = square.replacen("{\"bufferView\":0,", &format!("{{\"bufferView\":0,{sparse}"), 1);
    let over_zeros = square.replacen("{\"bufferView\":0,", &format!("{{{sparse}"), 1);
    let [x, z] = [Vec3::X, Vec3::Z].map(|axis| axis * 1000.0);
    assert_eq!(read(&over_view).unwrap().positions, [Vec3::ZERO, x * 5.0, z, (x + z) * 5.0]);
    assert_eq!(read(&over_zeros).unwrap().positions, [Vec3::ZERO, x * 5.0, Vec3::ZERO, (x + z) * 5.0]);
    for (count, problem) in [("3", "accessor 0 lies beyond"), ("400000000", "would unfold to")] {
        let wrong =
            over_zeros.replace("\"count\":4,\"type\":\"VEC3\"", &format!("\"count\":{count},\"type\":\"VEC3\""));
        assert!(read(&wrong).err().unwrap().to_string().contains(problem));
    }
}

#[test]
fn copies_and_morph_targets_are_told() {
    let plain = strip("EXT_meshopt_compression");
    assert!(read(&plain).unwrap().warnings.is_empty());
    let copies = plain
        .replace("\"extensionsRequired\"", "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],\"extensionsRequired\"");
    assert_eq!(read(&copies).unwrap().warnings, [Warning::GltfInstances]);
    let morphs = plain.replace("\"indices\":1", "\"indices\":1,\"targets\":[{\"POSITION\":0}]");
    assert_eq!(read(&morphs).unwrap().warnings, [Warning::GltfMorphs]);
}

#[test]
fn joints_place_a_skinned_mesh_and_its_node_does_not() {
    // The vertices are held by the first joint, the second, both alike, and none.
    let joints: [[u8; 4]; 4] = [[0, 1, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0], [1, 0, 0, 0]];
    let weights: [[u8; 4]; 4] = [[255, 0, 0, 0], [255, 0, 0, 0], [64, 64, 0, 0], [0; 4]];
    let nodes = "{\"children\":[1],\"scale\":[7,7,7],\"mesh\":0,\"skin\":0},{},{\"translation\":[2,0,0]}";
    let accessor = "\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"";
    let text = square(nodes, ",\"mode\":5")
        .replace("\"nodes\":[0]", "\"nodes\":[0,2]")
        .replace("\"POSITION\":0", "\"POSITION\":0,\"JOINTS_0\":2,\"WEIGHTS_0\":3")
        .replace("\"meshes\"", "\"skins\":[{\"joints\":[2,1]}],\"meshes\"")
        .replace(
            "],\"bufferViews\"",
            &format!(
                ",{{\"bufferView\":2,{accessor}}},{{\"bufferView\":3,{accessor},\"normalized\":true}}],\"bufferViews\""
            ),
        );
    let text = with_data(&text, &[joints.as_flattened(), weights.as_flattened()].concat(), &[16, 16]);
    // The first joint is moved by 2 m; the second hangs from a node that is seven times as large, which counts for it.
    let [x, z] = [Vec3::X, Vec3::Z].map(|axis| axis * 1000.0);
    assert_eq!(read(&text).unwrap().positions, [2.0 * x, 7.0 * x, x + 4.0 * z, 7.0 * (x + z)]);
    for (from, to) in
        [("\"joints\":[2,1]", "\"joints\":[2,9]"), ("\"joints\":[2,1]", "\"joints\":[2]"), (",\"WEIGHTS_0\":3", "")]
    {
        let error = read(&text.replace(from, to)).err().unwrap().to_string();
        assert_eq!(error, "The glTF file is broken: skin 0 does not fit the scene or the mesh that it moves.");
    }
}

#[test]
fn a_mark_before_the_json_and_zeros_behind_it_are_passed_over() {
    let json = square("{\"mesh\":0}", "");
    for text in [format!("\u{feff}{json}"), format!("{json}\0\0\0"), format!("\u{feff}{json}  \0")] {
        let length = (text.len() as u32).to_le_bytes();
        let head = [&b"glTF\x02\0\0\0"[..], &(20 + text.len() as u32).to_le_bytes(), &length, b"JSON"].concat();
        let glb = [&head, text.as_bytes()].concat();
        let raw = at_once(read_binary(&glb, Unit::Metre, DVec3::ZERO, &Pace::never())).unwrap();
        assert_eq!((read(&text).unwrap().positions.len(), raw.positions.len()), (4, 4));
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

#[test]
fn coarser_levels_stand_beside_the_finest_which_others_read() {
    let sphere = |n| lumen_mesh::shapes::icosphere(n, 5.0, Vec3::ZERO);
    let meshes = [sphere(3), sphere(2), sphere(1)];
    let normals: Vec<Vec<Vec3>> =
        meshes.iter().map(|mesh| mesh.positions.iter().map(|p| p.normalize()).collect()).collect();
    let outputs: Vec<_> = meshes
        .iter()
        .zip(&normals)
        .map(|(mesh, normals)| Output { normals: Some(&normals[..]), ..Output::new(mesh) })
        .collect();
    let bytes = super::write_levels(&outputs).unwrap();
    let raw = at_once(read_binary(&bytes, Unit::Metre, DVec3::ZERO, &Pace::never())).unwrap();
    assert_eq!((&raw.positions, &raw.triangles), (&meshes[0].positions, &meshes[0].triangles));
    let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    // As the extension has it: the finest names the others, and each has the part of the screen from which on it is shown. The
    // last is shown however small: below its number nothing is.
    assert_eq!(json["extensionsUsed"], serde_json::json!(["MSFT_lod"]));
    assert_eq!(json["nodes"][0]["extensions"]["MSFT_lod"]["ids"], serde_json::json!([1, 2]));
    assert_eq!(json["nodes"][0]["extras"]["MSFT_screencoverage"], serde_json::json!([0.5, 0.25, 0]));
    assert_eq!(json["scenes"][0]["nodes"], serde_json::json!([0]));
    for (i, mesh) in meshes.iter().enumerate() {
        assert_eq!((&json["nodes"][i]["mesh"], &json["nodes"][i]["scale"][0]), (&i.into(), &0.001.into()));
        let primitive = &json["meshes"][i]["primitives"][0];
        let accessor = |of: &serde_json::Value| json["accessors"][of.as_u64().unwrap() as usize].clone();
        assert_eq!(accessor(&primitive["indices"])["count"], 3 * mesh.triangles.len());
        for name in ["POSITION", "NORMAL"] {
            let vectors = accessor(&primitive["attributes"][name]);
            assert_eq!((&vectors["count"], &vectors["type"]), (&mesh.positions.len().into(), &"VEC3".into()));
        }
        // Where the first vertex of each stands in the data.
        let view = accessor(&primitive["attributes"]["POSITION"])["bufferView"].as_u64().unwrap() as usize;
        let offset = json["bufferViews"][view]["byteOffset"].as_u64().unwrap_or(0) as usize;
        let x = f32::from_le_bytes(bytes[28 + length + offset..][..4].try_into().unwrap());
        assert_eq!(x, mesh.positions[0].x);
    }
}
