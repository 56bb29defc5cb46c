//! PLY files made for it: what of them is read in each form, and what is refused.

use glam::DVec3;

use super::super::error::ReadError;
use super::super::pace::Pace;
use super::super::raw::RawSurface;
use lumen_mesh::Vec3;
use lumen_mesh::task::at_once;

fn read(bytes: &[u8]) -> Result<RawSurface, ReadError> {
    at_once(super::parsing::read(bytes, DVec3::ZERO, &Pace::never()))
}

const SQUARE: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement camera 1\nproperty list uchar float view\n\
    element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\nproperty float z\n\
    element face 2\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\nproperty int part\n\
    end_header\n2 0.5 0.5\n255 0 0 0\n255 1 0 0\n0 1 1 0\n0 0 1 0\n4 0 1 2 3 2 .5 .5 7\n2 0 1 0 7\n";

#[test]
fn properties_of_no_interest_are_stepped_over() {
    let raw = read(SQUARE.as_bytes()).unwrap();
    assert_eq!(raw.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]);
    assert_eq!((raw.triangles.len(), raw.polygons, raw.skipped.short_faces), (2, 1, 1));
    assert_eq!(read(SQUARE.replace('\n', "\r\n").as_bytes()).unwrap().triangles, raw.triangles);
}

#[test]
fn numbers_that_the_header_forgets_are_passed_over() {
    let text = SQUARE.replace("property int part\n", "");
    let raw = read(text.as_bytes()).unwrap();
    assert_eq!((raw.triangles.len(), raw.warnings.len()), (2, 1));
}

#[test]
fn words_that_are_no_numbers_stop_only_what_needs_them() {
    let nan = ["-1.#IND", "1.#QNAN", "nan(ind)", "-nan(ind)", "1.#INF", "n/a"];
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float quality\nproperty list uchar float more\nproperty int id\n\
        element face 1\nproperty list uchar int vertex_indices\nproperty float part\nend_header\n";
    for word in nan {
        let text = format!("{header}0 0 0 {word} 1 1 {word} 5\n1 0 0 1 {word} 0 6\n0 1 0 1 1 0 7\n3 0 1 2 {word}\n");
        let raw = read(text.as_bytes()).unwrap();
        let names: Vec<&str> = raw.arrays.iter().map(|array| &*array.name).collect();
        assert_eq!((raw.triangles.len(), names), (1, vec!["id"]), "{word}");
        let left_out = |name: &str| format!("The array \"{name}\" is left out: it holds what is no number.");
        assert_eq!(crate::in_english(&raw.warnings), [left_out("quality"), left_out("part")]);
        for needed in ["1 0 0 1", "3 0 1 2"] {
            let broken = text.replace(needed, &needed.replacen('0', word, 1));
            assert!(read(broken.as_bytes()).err().unwrap().to_string().contains("where a number should"));
        }
    }
}

#[test]
fn strips_turn_every_second_triangle() {
    let text = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\n\
        element vertex 5\nproperty float x\nproperty float y\nproperty float z\nend_header\n8 0 1 2 3 -1 2 3 4\n\
        0 0 0 1 0 0 0 1 0 1 1 0 9 9 9\n";
    assert_eq!(read(text.as_bytes()).unwrap().triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
}

#[test]
fn both_byte_orders_are_read() {
    let mut bytes = b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\nproperty short y\n\
        property float z\nelement face 1\nproperty list uint ushort vertex_indices\nend_header\n"
        .to_vec();
    for i in 0..3i16 {
        bytes.extend_from_slice(&f64::from(i).to_be_bytes());
        bytes.extend_from_slice(&(-i).to_be_bytes());
        bytes.extend_from_slice(&0.5f32.to_be_bytes());
    }
    bytes.extend_from_slice(&3u32.to_be_bytes());
    bytes.extend([0u16, 1, 2].iter().flat_map(|v| v.to_be_bytes()));
    let raw = read(&bytes).unwrap();
    assert_eq!((raw.label, raw.positions[2]), ("PLY binary big-endian", Vec3::new(2.0, -2.0, 0.5)));
    assert_eq!(raw.triangles, [[0, 1, 2]]);
}

#[test]
fn lies_are_refused_in_a_sentence() {
    let problem = |from: &str, to: &str| read(SQUARE.replace(from, to).as_bytes()).err().unwrap().to_string();
    assert_eq!(
        problem("vertex 4", "vertex 3000000000"),
        "The PLY ascii file is cut short: it announces 3000000000 vertices and holds 7."
    );
    assert_eq!(
        problem("4 0 1 2 3", "4 0 1 2 -9"),
        "Face 1 of the PLY file refers to vertex -9, but the file has 4 vertices."
    );
    assert!(problem("end_header", "the_end").ends_with("has no \"end_header\"."));
    assert!(problem("float z", "float w").ends_with("its vertices have no x, y and z."));
    assert!(problem("255 1 0 0", "255 one 0 0").contains("line 18: \"one\" stands where a number should"));
    assert!(problem("int vertex_index", "long vertex_index").contains("\"long\" is no type of number"));
    assert!(problem("2 0.5 0.5", "-2 0.5 0.5").contains("a list has the length -2"));
}
