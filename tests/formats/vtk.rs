//! VTK's files: every way to write the same square, several pieces, grids, axes, and what is refused.

use base64::Engine as _;
use lumen::io::{Axes, Format, ImportOptions, Imported, ReadError, read, write};

use crate::samples::{Coding, LEGACY_GRID, LEGACY_TEXT, VTP_TEXT, VTU_TEXT, legacy_binary_51, tetrahedra, vtp};

fn open(bytes: &[u8]) -> Imported {
    read(bytes, "a", &ImportOptions::default()).unwrap()
}

fn refused(bytes: &[u8]) -> String {
    read(bytes, "a", &ImportOptions::default()).unwrap_err().to_string()
}

#[test]
fn every_encoding_of_vtp_gives_the_same_square() {
    for coding in Coding::ALL {
        let Imported { mesh, report, .. } = open(&vtp(coding));
        assert_eq!(
            (report.format.as_str(), report.triangles, report.polygons_triangulated),
            ("VTP", 2, 1),
            "{coding:?}"
        );
        assert_eq!((report.area_mm2, mesh.positions.len()), (8100.0, 4), "{coding:?}");
    }
}

#[test]
fn pieces_strips_and_what_is_no_surface_are_told_apart() {
    let Imported { mesh, report, .. } = open(VTP_TEXT.as_bytes());
    assert_eq!((report.triangles, report.components, report.axes), (3, 2, Axes::Lps));
    assert_eq!((report.area_mm2, mesh.positions.len()), (8100.0 + 4050.0, 7));
    assert_eq!((report.skipped.lines, report.skipped.points, report.winding_flips), (1, 1, 0));
}

#[test]
fn legacy_text_and_binary_of_both_layouts_are_read() {
    let Imported { report, .. } = open(LEGACY_TEXT.as_bytes());
    // The square once as a polygon and once as a strip.
    assert_eq!((report.format.as_str(), report.triangles, report.area_mm2), ("VTK ascii", 4, 2.0 * 8100.0));
    assert_eq!((report.skipped.lines, report.skipped.points, report.axes), (1, 1, Axes::Ras));
    let windows = LEGACY_TEXT.replace('\n', "\r\n");
    assert_eq!(open(windows.as_bytes()).report, report);
    let Imported { report, .. } = open(&legacy_binary_51());
    assert_eq!((report.format.as_str(), report.triangles, report.area_mm2), ("VTK binary", 2, 8100.0));
    assert_eq!(report.axes, Axes::Unknown);
}

/// Curved faces, as VTK numbers them: points of each, and the area of its surface with no subdivision by VTK 9.6's
/// `vtkDataSetSurfaceFilter`.
const CURVED: [(u32, &str, f64); 10] = [
    (22, TRIANGLE, 4050.0),
    (34, TRIANGLE, 4050.0),
    (69, TRIANGLE, 4050.0),
    (76, TRIANGLE, 4050.0),
    (36, TRIANGLE, 4050.0),
    (23, SQUARE, 8100.0),
    (28, SQUARE, 8100.0),
    (30, LINEAR, 8100.0),
    (70, SQUARE, 8100.0),
    (77, SQUARE, 8100.0),
];
const TRIANGLE: &str = "0 0 0 90 0 0 0 90 0 45 0 0 45 45 0 0 45 0";
const SQUARE: &str = "0 0 0 90 0 0 90 90 0 0 90 0 45 0 0 90 45 0 45 90 0 0 45 0 45 45 0";
const LINEAR: &str = "0 0 0 90 0 0 90 90 0 0 90 0 45 0 0 45 90 0";

#[test]
fn curved_faces_of_a_grid_are_flat_between_their_corners() {
    for (kind, points, area) in CURVED {
        let count = points.split(' ').count() / 3;
        let ids = (0..count).map(|id| id.to_string()).collect::<Vec<_>>().join(" ");
        let legacy = format!(
            "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {count} float\n{points}\n\
             CELLS 1 {}\n{count} {ids}\nCELL_TYPES 1\n{kind}\nPOINT_DATA {count}\nSCALARS a int\nLOOKUP_TABLE default\n{ids}\n",
            count + 1
        );
        let xml = VTU_TEXT
            .replace(
                "NumberOfPoints=\"4\" NumberOfCells=\"2\"",
                &format!("NumberOfPoints=\"{count}\" NumberOfCells=\"1\""),
            )
            .replace("0 0 0 90 0 0 90 90 0 0 90 0<", &format!("{points}<"))
            .replace("0 1 2 0 1 2 3<", &format!("{ids}<"))
            .replace("3 7<", &format!("{count}<"))
            .replace("5 10<", &format!("{kind}<"));
        for text in [legacy, xml] {
            let Imported { report, .. } = open(text.as_bytes());
            assert_eq!(report.area_mm2, area, "{kind}: {text}");
            assert_eq!(report.warnings[0].to_string(), "1 curved face taken as flat: only its corners are kept.");
        }
    }
}

#[test]
fn flat_cells_of_a_grid_are_its_surface() {
    let Imported { report, .. } = open(LEGACY_GRID.as_bytes());
    assert_eq!((report.triangles, report.area_mm2, report.skipped.lines), (5, 4050.0 + 2.0 * 8100.0, 1));
    assert_eq!(report.warnings[0].to_string(), "1 solid or curved cells left out: Lumen shows surfaces.");
    let Imported { report, .. } = open(VTU_TEXT.as_bytes());
    assert_eq!((report.format.as_str(), report.triangles, report.area_mm2), ("VTU", 1, 4050.0));
    let solid = VTU_TEXT.replace("5 10<", "10 10<");
    assert!(refused(solid.as_bytes()).starts_with("This is VTK data of another kind (a grid of solid cells)"));
}

#[test]
fn other_data_are_refused_by_their_name() {
    let xml = |kind: &str| refused(format!("<?xml version=\"1.0\"?><VTKFile type=\"{kind}\"></VTKFile>").as_bytes());
    let legacy = |kind: &str| refused(format!("# vtk DataFile Version 3.0\n\nASCII\nDATASET {kind}\n").as_bytes());
    assert!(xml("ImageData").starts_with("This is no surface but an image volume (VTK image data)"));
    assert!(legacy("STRUCTURED_POINTS").starts_with("This is no surface but an image volume (VTK structured points)"));
    assert!(xml("StructuredGrid").starts_with("This is VTK data of another kind (StructuredGrid)"));
    assert!(legacy("RECTILINEAR_GRID").starts_with("This is VTK data of another kind (RECTILINEAR_GRID)"));
    for kind in ["Collection", "PPolyData", "vtkMultiBlockDataSet"] {
        assert!(xml(kind).starts_with(&format!("This VTK file ({kind}) only names others")), "{}", xml(kind));
    }
    let lines = LEGACY_TEXT.replace("POLYGONS", "LINES").replace("TRIANGLE_STRIPS", "LINES");
    assert_eq!(
        refused(lines.as_bytes()),
        "The VTK ascii file holds no surface, only 3 lines and 1 point: Lumen does not open centrelines."
    );
}

#[test]
fn broken_files_say_what_is_wrong_and_where() {
    let text = |from: &str, to: &str| refused(LEGACY_TEXT.replace(from, to).as_bytes());
    assert_eq!(
        text("90 90 0", "90 x 0"),
        "The VTK ascii file is broken at line 13: \"x\" stands where a number should."
    );
    assert_eq!(
        text("4 0 1 2 3", "4 0 1 2 9"),
        "Face 1 of the VTK ascii file refers to vertex 9, but the file has 4 vertices."
    );
    assert_eq!(
        text("POINTS 4 float", "POINTS 4000000000 float"),
        "The VTK ascii file is broken at line 15: \"INFORMATION\" stands where a number should."
    );
    let xml = |from: &str, to: &str| refused(VTP_TEXT.replace(from, to).as_bytes());
    assert_eq!(
        xml("</Polys>", "</Points>"),
        "The VTK file is broken at line 16: its XML is wrong or incomplete there."
    );
    assert!(xml("90 90 50<", "90 x 50<").contains("line 15: \"x\" stands where a number should"));
    assert!(xml("type=\"Int64\"", "type=\"Int128\"").contains("\"Int128\" is no type of number"));
    assert!(xml(" version=\"0.1\"", " compressor=\"zstd\"").contains("uses the compressor \"zstd\""));
    let mut cut = write(&tetrahedra(3), None, Format::Vtp).unwrap();
    cut.truncate(cut.len() - 60);
    assert!(refused(&cut).contains("goes on beyond the end of its data"), "{}", refused(&cut));
}

/// What libFuzzer found: counts near the end of 64 bits.
#[test]
fn counts_that_overflow_are_refused() {
    for coding in Coding::ALL.into_iter().filter(|coding| coding.is_wide && coding.is_base64) {
        for words in [vec![u64::MAX], vec![u64::MAX - 8], vec![1, 32, 0, u64::MAX - 40], vec![u64::MAX / 2, 1, 1]] {
            let claim: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
            let text = format!(
                "<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"{}\"><PolyData>\
                 <Piece NumberOfPoints=\"4\" NumberOfPolys=\"1\"><Points>\
                 <DataArray type=\"Float32\" format=\"binary\">{}AAAA</DataArray></Points></Piece></PolyData></VTKFile>",
                coding.compressor,
                base64::engine::general_purpose::STANDARD.encode(claim),
            );
            let problem = refused(text.as_bytes());
            // Without compression the first word alone is the header.
            let is_short = words[0] == 1 && coding.compressor.is_empty();
            let expected = if is_short { "is cut short: it announces 4 points" } else { "goes on beyond the end" };
            assert!(problem.contains(expected), "{words:?}: {problem}");
        }
    }
}

#[test]
fn compressed_claims_are_refused_before_they_are_met() {
    let mut coding = Coding::ALL[6];
    coding.is_big = false;
    let file = String::from_utf8_lossy(&vtp(coding)).into_owned();
    assert!(file.contains("raw"));
    // Three blocks of the points, said to be of a terabyte each.
    let mut bytes = vtp(coding);
    let at = bytes.windows(2).position(|two| two == b" _").unwrap() + 2;
    bytes[at + 8..at + 16].copy_from_slice(&(1u64 << 40).to_le_bytes());
    let error = read(&bytes, "a", &ImportOptions::default()).unwrap_err();
    assert!(matches!(error, ReadError::Unfolds { .. }), "{error}");
}
