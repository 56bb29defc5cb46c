//! Files of VTK and glTF are parsed in slices: into the same surface, with progress, and what is dropped half way is gone.

use std::f32::consts::TAU;
use std::sync::Arc;
use std::time::Duration;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use lumen::io::{Format, ImportOptions, Imported, ReadError, import_mesh, read, read_in_slices, write};
use lumen::mesh::{TriMesh, Vec3};
use lumen::task::{Budget, Progress, Running};
use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::samples::valid;
use crate::{MEMORY, alone};

/// What is told once the bytes are parsed.
const PARSED: f32 = 0.2;

fn reading(bytes: Arc<Vec<u8>>, name: &str) -> Running<'_, Result<Imported, ReadError>> {
    Running::new(move |yielder| async move { read_in_slices(bytes, name, &ImportOptions::default(), &yielder).await })
}

/// A torus of 200,320 triangles.
fn torus() -> TriMesh {
    let (around, across) = (320u32, 313u32);
    let vertex = |i: u32, j: u32| (i % around) * across + j % across;
    let at = |i: u32, j: u32| {
        let (u, v) = (TAU * i as f32 / around as f32, TAU * j as f32 / across as f32);
        let radius = 40.0 + 10.0 * v.cos();
        Vec3::new(radius * u.cos(), radius * u.sin(), 10.0 * v.sin())
    };
    let cells = || (0..around).flat_map(move |i| (0..across).map(move |j| (i, j)));
    let corners = |(i, j): (u32, u32)| {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let made =
        TriMesh { positions: cells().map(|(i, j)| at(i, j)).collect(), triangles: cells().flat_map(corners).collect() };
    import_mesh(made, "torus").mesh
}

/// A VTP file whose arrays `encode` writes: a format, what stands in the element, and the data to append.
fn vtp(mesh: &TriMesh, outer: &str, appended_as: &str, mut encode: impl FnMut(&[u8]) -> [Vec<u8>; 2]) -> Vec<u8> {
    let points: Vec<u8> = mesh.positions.iter().flat_map(Vec3::to_array).flat_map(f32::to_le_bytes).collect();
    let ids: Vec<u8> = mesh.triangles.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    let ends: Vec<u8> = (1..=mesh.triangles.len() as u32).flat_map(|t| (3 * t).to_le_bytes()).collect();
    let mut appended = Vec::new();
    let mut array = |kind: &str, name: &str, bytes: &[u8]| {
        let head = format!("<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"3\"");
        let [inline, behind] = encode(bytes);
        let offset = appended.len();
        appended.extend(behind);
        if appended_as.is_empty() {
            format!("{head} format=\"binary\">\n    {}\n</DataArray>", String::from_utf8(inline).unwrap())
        } else {
            format!("{head} format=\"appended\" offset=\"{offset}\"/>")
        }
    };
    let [points, ids, ends] =
        [array("Float32", "Points", &points), array("Int32", "connectivity", &ids), array("Int32", "offsets", &ends)];
    let mut out = head(mesh, outer, &points, &(ids + &ends)).into_bytes();
    if !appended_as.is_empty() {
        out.extend(format!("<AppendedData encoding=\"{appended_as}\">_").into_bytes());
        out.extend(appended);
        out.extend(b"</AppendedData>");
    }
    out.extend(b"</VTKFile>");
    out
}

/// The structure around the arrays.
fn head(mesh: &TriMesh, outer: &str, points: &str, cells: &str) -> String {
    format!(
        "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"{outer}><PolyData><Piece NumberOfPoints=\"{}\" \
         NumberOfPolys=\"{}\"><Points>{points}</Points><Polys>{cells}</Polys></Piece></PolyData>",
        mesh.positions.len(),
        mesh.triangles.len(),
    )
}

/// The bytes in zlib blocks of `block` bytes, behind their header.
fn zlib(bytes: &[u8], block: usize) -> [Vec<u8>; 2] {
    let blocks: Vec<Vec<u8>> = bytes.chunks(block).map(|block| compress_to_vec_zlib(block, 1)).collect();
    let words = [blocks.len(), block, bytes.len() % block].into_iter().chain(blocks.iter().map(Vec::len));
    [words.flat_map(|word| (word as u32).to_le_bytes()).collect(), blocks.concat()]
}

/// The torus in every kind of file that is cut into slices here.
fn files(mesh: &TriMesh) -> Vec<(&'static str, Vec<u8>)> {
    let rows: String = mesh.positions.iter().map(|p| format!("{} {} {}\n", p.x, p.y, p.z)).collect();
    let list =
        |before: &str| -> String { mesh.triangles.iter().map(|[a, b, c]| format!("{before}{a} {b} {c}\n")).collect() };
    let ends: String = (1..=mesh.triangles.len()).map(|t| format!("{} ", 3 * t)).collect();
    let text = |kind: &str, name: &str, numbers: &str| {
        format!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">{numbers}</DataArray>")
    };
    let cells = text("Int64", "connectivity", &list("")) + &text("Int64", "offsets", &ends);
    let ascii = head(mesh, "", &text("Float32", "Points", &rows), &cells) + "</VTKFile>";
    let sized = |bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes()[..], bytes].concat();
    let compressor = " compressor=\"vtkZLibDataCompressor\"";
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let legacy = format!(
        "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS {vertices} float\n{rows}POLYGONS {triangles} {}\n{}",
        4 * triangles,
        list("3 "),
    );
    let glb = write(mesh, None, Format::Glb).unwrap();
    vec![
        ("ascii.vtp", ascii.into_bytes()),
        ("base64.vtp", vtp(mesh, "", "", |bytes| [STANDARD.encode(sized(bytes)).into_bytes(), Vec::new()])),
        ("raw.vtp", vtp(mesh, "", "raw", |bytes| [Vec::new(), sized(bytes)])),
        ("zlib.vtp", vtp(mesh, compressor, "raw", |bytes| [Vec::new(), zlib(bytes, 1 << 15).concat()])),
        (
            "one block.vtp",
            vtp(mesh, compressor, "base64", |bytes| {
                [Vec::new(), zlib(bytes, bytes.len()).map(|part| STANDARD.encode(part).into_bytes()).concat()]
            }),
        ),
        ("ascii.vtk", legacy.into_bytes()),
        ("binary.vtk", write(mesh, None, Format::Vtk).unwrap()),
        ("a.gltf", with_data_inside(&glb)),
        ("a.glb", glb),
    ]
}

/// A GLB file as text.
fn with_data_inside(glb: &[u8]) -> Vec<u8> {
    let word = |at: usize| u32::from_le_bytes(*glb[at..].first_chunk().unwrap()) as usize;
    let (json, data) = glb[20..].split_at(word(12));
    let buffer = format!("\"buffers\":[{{\"byteLength\":{}", word(20 + json.len()));
    let json = std::str::from_utf8(json).unwrap();
    assert!(json.contains(&buffer));
    json.replace(&buffer, &format!("{buffer},\"uri\":\"data:;base64,{}\"", STANDARD.encode(&data[8..]))).into_bytes()
}

/// What is read a block at a time, and the fractions that were told.
fn in_slices(bytes: Vec<u8>, name: &str) -> (Result<Imported, ReadError>, Vec<f32>) {
    let mut reading = reading(Arc::new(bytes), name);
    let mut told = Vec::new();
    loop {
        match reading.advance(Budget::new(Duration::ZERO)) {
            Progress::Working(fraction) => told.push(fraction),
            Progress::Done(read) => return (read, told),
        }
    }
}

#[test]
fn every_kind_read_in_slices_is_what_it_is_at_once() {
    for (name, bytes) in valid() {
        // Whole, and cut short in its data.
        for end in [bytes.len(), bytes.len() * 3 / 4] {
            let whole = read(&bytes[..end], name, &ImportOptions::default());
            assert_eq!(in_slices(bytes[..end].to_vec(), name).0, whole, "{name}, {end} bytes");
        }
    }
}

#[test]
fn no_slice_of_a_large_file_is_a_great_part_of_it() {
    let _alone = alone();
    let torus = torus();
    assert_eq!((torus.positions.len(), torus.triangles.len()), (100_160, 200_320));
    for (name, bytes) in files(&torus) {
        let (read, told) = in_slices(bytes, name);
        assert!(read.unwrap().mesh == torus, "{name}");
        assert_eq!(told[0], 0.0, "{name}");
        assert!(told.windows(2).all(|two| two[0] <= two[1]), "{name}: {told:?}");
        let parsed = told.iter().position(|&fraction| fraction >= PARSED).expect(name);
        assert!(parsed >= 40, "{name}: {parsed} slices");
        let largest = told[..=parsed].windows(2).map(|two| two[1] - two[0]).fold(0.0, f32::max);
        println!("{name}: {parsed} slices, the largest {:.1} %", 100.0 * largest / PARSED);
        assert!(largest <= PARSED / 10.0, "{name}: {largest} in one slice of {:?}", &told[..=parsed]);
    }
}

#[test]
fn what_is_dropped_half_way_leaves_nothing() {
    let _alone = alone();
    for (name, bytes) in files(&torus()) {
        let bytes = Arc::new(bytes);
        let before = MEMORY.current_usage();
        let mut reading = reading(Arc::clone(&bytes), name);
        let mut told = 0.0;
        while told < 0.75 * PARSED {
            let Progress::Working(fraction) = reading.advance(Budget::new(Duration::ZERO)) else { panic!("{name}") };
            told = fraction;
        }
        assert!(told < PARSED && Arc::strong_count(&bytes) > 1, "{name} is still parsed");
        // The points, at least.
        let held = MEMORY.current_usage().saturating_sub(before);
        assert!(held > 1_000_000, "{name}: {held}");
        drop(reading);
        assert_eq!(Arc::strong_count(&bytes), 1, "{name}");
        // Other tests may hold a little meanwhile.
        let left = MEMORY.current_usage().saturating_sub(before);
        assert!(left < 500_000, "{name}: {left}");
    }
}

#[test]
fn a_field_of_nothing_is_stepped_over_in_slices() {
    let mut file = b"# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 10 0 0 0 10 0\n\
        POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\nPOINT_DATA 3\nFIELD FieldData 100000\n"
        .to_vec();
    file.extend(b"NULL_ARRAY\n".repeat(100_000));
    let (read, told) = in_slices(file, "nothing.vtk");
    assert_eq!(read.unwrap().mesh.triangles.len(), 1);
    assert!(told.len() > 50_000, "{} slices", told.len());
}
