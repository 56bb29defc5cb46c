//! The tube of `data/public` under every condition of a file that a public report tells of: the same 1,920 triangles and
//! 2,981.478 mm3, which VTK measured, and the word that is said with them.

use std::path::Path;

use libtest_mimic::{Failed, Trial};
use lumen::io::{Format, ImportOptions, in_english, read, write};
use lumen::mesh::TriMesh;

const TRIANGLES: usize = 1920;
const VOLUME_MM3: f64 = 2981.478;

/// A file of the tube, and what is said of it.
struct File {
    name: String,
    bytes: Vec<u8>,
    said: &'static str,
}

/// Files as they are, each with the beginning of what is said of it.
const FILES: [(&str, &str); 7] = [
    ("obj_group_backslash_end.obj", ""),
    ("obj_cr_only.obj", ""),
    ("stlb_count_minus1.stl", COUNT),
    ("stlb_count_less.stl", COUNT),
    ("ply_normals_1ind.ply", ""),
    ("glb_jsonnulpad.glb", ""),
    ("glb_skinned.glb", ""),
];
const COUNT: &str = "The number of triangles that the file announces";

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let folder = data.join("public");
    let Ok(tube) = tube(&folder) else { return Vec::new() };
    let there = FILES.iter().filter_map(|&(name, said)| {
        Some(File { name: name.to_owned(), bytes: std::fs::read(folder.join(name)).ok()?, said })
    });
    let files = there.chain(of_obj(&tube)).chain(of_stl(&tube));
    files.map(|file| Trial::test(format!("public: {}", file.name), move || check(&file))).collect()
}

fn tube(folder: &Path) -> Result<TriMesh, Failed> {
    let bytes = std::fs::read(folder.join("obj_cr_only.obj"))?;
    Ok(read(&bytes, "a.obj", &ImportOptions::default()).map_err(|error| error.to_string())?.mesh)
}

/// Texts that say the same in other ways.
fn of_obj(tube: &TriMesh) -> Vec<File> {
    let text = String::from_utf8(write(tube, None, Format::Obj).unwrap()).unwrap();
    let file = |name: &str, text: String| File { name: format!("{name}.obj"), bytes: text.into_bytes(), said: "" };
    let mut files = vec![
        file("comments behind faces", text.lines().map(|line| format!("{line} # a \\\n")).collect()),
        file("faces that go on", text.replace("\nf ", "\nf \\\n  ")),
        file("faces that go on, of Windows", text.replace("\nf ", "\nf \\\n  ").replace('\n', "\r\n")),
    ];
    for keyword in ["#", "g", "o", "usemtl", "mtllib"] {
        let between = text.replacen("\nf ", &format!("\n{keyword} C:\\models\\\nf "), 99);
        files.push(file(&format!("{keyword} that ends in a backslash"), between.clone()));
        files.push(file(&format!("{keyword} that ends in a backslash, of Windows"), between.replace('\n', "\r\n")));
    }
    for (name, unit) in [("UTF-16LE", u16::to_le_bytes as fn(u16) -> [u8; 2]), ("UTF-16BE", u16::to_be_bytes)] {
        let bytes = format!("\u{feff}{text}").encode_utf16().flat_map(unit).collect();
        files.push(File { name: format!("{name}.obj"), bytes, said: "" });
    }
    files
}

/// Counts that are wrong, and the text in one line.
fn of_stl(tube: &TriMesh) -> Vec<File> {
    let binary = write(tube, None, Format::Stl).unwrap();
    let mut files = Vec::new();
    for announced in [0, 1, 960, 1919, 3840, u32::MAX] {
        for (behind, more) in [("", &b""[..]), (" and a line end", b"\r\n")] {
            let mut bytes = [&binary, more].concat();
            bytes[80..84].copy_from_slice(&announced.to_le_bytes());
            files.push(File { name: format!("{announced} announced{behind}.stl"), bytes, said: COUNT });
        }
    }
    let facet = |t: usize| {
        let corners = tube.corners(t).map(|p| format!("vertex {} {} {} ", p.x, p.y, p.z)).concat();
        format!("facet normal 0 0 0 outer loop {corners}endloop endfacet ")
    };
    let text = format!("solid of facets {}endsolid of facets", (0..TRIANGLES).map(facet).collect::<String>());
    files.push(File { name: "a single line.stl".to_owned(), bytes: text.into_bytes(), said: "" });
    files
}

fn check(file: &File) -> Result<(), Failed> {
    let read = read(&file.bytes, &file.name, &ImportOptions::default());
    let report = read.map_err(|error| error.to_string())?.report;
    let volume = report.volume_mm3.ok_or("no inside")?;
    if report.triangles != TRIANGLES || (volume - VOLUME_MM3).abs() > 0.01 {
        return Err(format!("{} triangles, {volume} mm3", report.triangles).into());
    }
    let told = in_english(&report.warnings);
    let is_said = if file.said.is_empty() { told.is_empty() } else { told[0].starts_with(file.said) };
    if is_said { Ok(()) } else { Err(format!("{told:?}").into()) }
}
