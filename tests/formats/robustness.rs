//! No file makes the reader panic, hang or take memory that a header merely claims, and what is written reads back.

use lumen::io::{Format, ImportOptions, Imported, ReadError, import_mesh, read, write};
use lumen::mesh::arrays::Association;
use lumen::mesh::{TriMesh, Vec3};
use proptest::prelude::*;

use crate::memory::room;
use crate::samples::valid;
use crate::{alone, read_measured};

/// Names for a file whose content may be anything.
const NAMES: [&str; 9] = ["a.stl", "a.ply", "a.obj", "a.vtp", "a.vtu", "a.vtk", "a.glb", "a.gltf", "a"];

/// How files begin.
const MAGIC: [&str; 11] = [
    "",
    "glTF\x02\0\0\0",
    "ply\n",
    "solid ",
    "{\"",
    "v ",
    "ply\nformat ascii 1.0\n",
    "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"9\" NumberOfPolys=\"9\">",
    "<VTKFile type=\"PolyData\"><AppendedData encoding=\"raw\">_",
    "# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\nPOINTS 9 float\n",
    "# vtk DataFile Version 5.1\n\nASCII\nDATASET POLYDATA\nFIELD FieldData 9\n",
];

/// Reads, and checks what must hold whatever the bytes are: indices in range and finite numbers, or a sentence.
fn read_anything(bytes: &[u8], name: &str) -> Result<(), TestCaseError> {
    let (result, taken) = read_measured(bytes, name);
    prop_assert!(taken <= room(bytes.len()), "{} bytes took {}", bytes.len(), taken);
    match result {
        Ok(Imported { mesh, arrays, report }) => {
            prop_assert!(mesh.triangles.as_flattened().iter().all(|&v| (v as usize) < mesh.positions.len()));
            prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
            prop_assert!(!mesh.triangles.is_empty() && report.area_mm2.is_finite());
            for array in &arrays {
                let rows = if array.on == Association::Point { mesh.positions.len() } else { mesh.triangles.len() };
                prop_assert_eq!(array.values.len(), rows * array.components);
            }
            // A byte makes a corner at most, a corner a triangle.
            prop_assert!(report.triangles <= bytes.len());
        }
        Err(error) => {
            let sentence = error.to_string();
            prop_assert!(sentence.ends_with('.') && sentence.len() > 10, "{}", sentence);
        }
    }
    Ok(())
}

#[test]
fn valid_files_are_valid() {
    for (name, bytes) in valid() {
        read(&bytes, name, &ImportOptions::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn every_truncation_of_every_kind_is_survived() {
    let _alone = alone();
    for (name, bytes) in valid() {
        for end in 0..bytes.len() {
            read_anything(&bytes[..end], name).unwrap();
        }
    }
}

#[test]
fn claims_of_gigabytes_cost_nothing() {
    let _alone = alone();
    let mut stl = vec![b' '; 100];
    stl[80..84].copy_from_slice(&60_000_000u32.to_le_bytes());
    let ply = |kind: &str, vertices: &str| {
        format!(
            "ply\nformat {kind} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
            element face 4000000000\nproperty list uint int vertex_indices\nend_header\n\u{ff}\u{ff}\u{ff}\u{ff}"
        )
    };
    let none = "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\nelement face 1\nend_header\n";
    let mut files: Vec<(&str, Vec<u8>)> = vec![("a.stl", stl), ("a.ply", none.into())];
    for kind in ["ascii", "binary_little_endian", "binary_big_endian"] {
        files.push(("a.ply", ply(kind, "3000000000").into()));
        files.push(("a.ply", ply(kind, "0").into()));
    }
    files.push(("a.glb", b"glTF\x02\0\0\0\xff\xff\xff\xff\xff\xff\xff\xffJSON{}".to_vec()));
    for (name, bytes) in files {
        let (result, taken) = read_measured(&bytes, name);
        let error = result.expect_err(name);
        assert!(!matches!(error, ReadError::Unknown { .. }), "{error}");
        assert!(taken < 1_000_000, "{name}: {taken}");
    }
}

#[test]
fn lines_and_faces_without_end_are_read_in_good_time() {
    let _alone = alone();
    let million = 1_000_000;
    let continued = format!("v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\n{}", "\\\n".repeat(million));
    read(continued.as_bytes(), "a.obj", &ImportOptions::default()).unwrap();
    // One vertex in a million triangles, wound every which way.
    let rim: String = (0..million / 10).map(|i| format!("v {i} {} 5\n", i % 97)).collect();
    let fan: String = (2..million / 10)
        .map(|i| if i % 3 == 0 { format!("f 1 {i} {}\n", i + 1) } else { format!("f 1 {} {i}\n", i + 1) })
        .collect();
    let imported = read(format!("v 0 0 0\n{rim}{fan}").as_bytes(), "a.obj", &ImportOptions::default()).unwrap();
    assert!(imported.report.orientable && imported.report.winding_flips > 1000);
}

/// Meshes with faults: repeated and missing neighbours, any winding, several pieces.
fn meshes() -> impl Strategy<Value = TriMesh> {
    let coordinate = prop_oneof![
        4 => -500.0f32..500.0,
        1 => prop::num::f32::NORMAL.prop_map(|x| if x.abs() > 1e8 { x % 1e8 } else { x }),
        1 => (-3i8..3).prop_map(f32::from),
    ];
    let position = [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from);
    (prop::collection::vec(position, 3..40), prop::collection::vec([0u32..40, 0u32..40, 0u32..40], 1..80)).prop_map(
        |(positions, triangles)| {
            let n = positions.len() as u32;
            import_mesh(
                TriMesh { positions, triangles: triangles.into_iter().map(|t| t.map(|v| v % n)).collect() },
                "any",
            )
            .mesh
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_never_panic(
        which in 0..valid().len(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut in prop::option::weighted(0.3, any::<prop::sample::Index>()),
        doubled in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let (name, mut bytes) = valid().swap_remove(which);
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(from) = doubled {
            bytes.extend_from_within(from.index(bytes.len())..);
        }
        if let Some(end) = cut {
            bytes.truncate(end.index(bytes.len()));
        }
        let _alone = alone();
        read_anything(&bytes, name)?;
    }

    #[test]
    fn damaged_digits_never_panic(
        which in 0..valid().len(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), "[-0-9.e]{1,12}"), 1..5),
    ) {
        let (name, mut bytes) = valid().swap_remove(which);
        for (at, digits) in damage {
            let places: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
            if !places.is_empty() {
                let at = places[at.index(places.len())];
                bytes.splice(at..=at, digits.into_bytes());
            }
        }
        let _alone = alone();
        read_anything(&bytes, name)?;
    }

    #[test]
    fn random_bytes_never_panic(
        magic in prop::sample::select(MAGIC.to_vec()),
        noise in prop::collection::vec(any::<u8>(), 0..400),
        name in prop::sample::select(NAMES.to_vec()),
    ) {
        let _alone = alone();
        read_anything(&[magic.as_bytes(), &noise].concat(), name)?;
    }

    #[test]
    fn random_text_never_panics(
        text in "([vf#lp/ -]|solid|facet|vertex|endloop|[0-9]{1,3}|\n|\\\\){0,200}",
        name in prop::sample::select(NAMES.to_vec()),
    ) {
        let _alone = alone();
        read_anything(text.as_bytes(), name)?;
    }

    #[test]
    fn what_is_written_reads_back_bit_for_bit(mesh in meshes()) {
        prop_assume!(!mesh.triangles.is_empty());
        let corners = |mesh: &TriMesh| -> Vec<_> {
            (0..mesh.triangles.len()).map(|t| mesh.corners(t).map(|p| p.to_array().map(f32::to_bits))).collect()
        };
        let normals = vec![Vec3::Y; mesh.positions.len()];
        for format in Format::ALL {
            for normals in [None, Some(&normals[..])] {
                let bytes = write(&mesh, normals, format).unwrap();
                let again = read(&bytes, "surface", &ImportOptions::default()).unwrap();
                // STL has no vertices of its own: they come back in the order of the triangles.
                if format == Format::Stl {
                    prop_assert_eq!(corners(&again.mesh), corners(&mesh), "{:?}", format);
                } else {
                    prop_assert_eq!(&again.mesh, &mesh, "{:?}", format);
                }
            }
        }
    }
}
