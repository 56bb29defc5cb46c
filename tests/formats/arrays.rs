//! Arrays: what a file has for its points and cells comes in, follows the import, and goes out again.

use lumen::io::{Axes, Format, ImportOptions, Imported, Output, WriteError, in_english, left_out, read, write_output};
use lumen::mesh::Array;
use lumen::mesh::arrays::{Association, Kind, Scalar, Values};

use crate::samples::{LEGACY_TEXT, VTP_TEXT, tetrahedra};
use crate::{alone, read_measured};

fn open(bytes: &[u8]) -> Imported {
    read(bytes, "a.obj", &ImportOptions::default()).unwrap()
}

fn array(
    name: &str,
    on: Association,
    scalar: Scalar,
    components: usize,
    numbers: impl IntoIterator<Item = f64>,
) -> Array {
    Array::new(name, on, components, Values::of(scalar, numbers))
}

fn numbers(array: &Array) -> Vec<f64> {
    (0..array.values.len()).map(|i| array.values.get(i)).collect()
}

/// The numbers of the array of that name.
fn named(arrays: &[Array], name: &str, on: Association) -> Vec<f64> {
    numbers(arrays.iter().find(|array| array.name == name && array.on == on).expect("there is such an array"))
}

const ALL: [Scalar; 10] = [
    Scalar::I8,
    Scalar::U8,
    Scalar::I16,
    Scalar::U16,
    Scalar::I32,
    Scalar::U32,
    Scalar::I64,
    Scalar::U64,
    Scalar::F32,
    Scalar::F64,
];

/// Twelve vertices and twelve triangles, with an array of every type on both.
fn every_type() -> Vec<Array> {
    let of = |scalar: Scalar| {
        let name = |on| format!("{} on <{on}> & \"more\" %20", scalar.name());
        let numbers = || (0..12).map(f64::from);
        [
            array(&name("p"), Association::Point, scalar, 1, numbers()),
            array(&name("t"), Association::Triangle, scalar, 2, numbers().chain(numbers())),
        ]
    };
    ALL.into_iter().flat_map(of).collect()
}

#[test]
fn every_type_goes_through_vtp_and_vtk_with_its_name() {
    let (mesh, arrays) = (tetrahedra(3), every_type());
    for axes in [Axes::Unknown, Axes::Ras] {
        for format in [Format::Vtp, Format::Vtk] {
            let output = Output { arrays: &arrays, axes, ..Output::new(&mesh) };
            let back = open(&write_output(&output, format).unwrap());
            assert_eq!((&back.mesh, back.report.axes), (&mesh, axes), "{format:?}");
            assert_eq!(back.report.arrays.len(), arrays.len());
            for array in &arrays {
                assert!(back.arrays.contains(array), "{format:?} {}: {:?}", array.name, back.report.warnings);
            }
        }
    }
}

#[test]
fn ply_takes_tuples_apart_and_puts_them_together() {
    let mesh = tetrahedra(3);
    let twelve = || (0..12).map(f64::from);
    let arrays = [
        array("Wall shear", Association::Point, Scalar::F64, 3, (0..36).map(|i| f64::from(i) / 7.0)),
        array("RGBA", Association::Point, Scalar::U8, 4, (0..48).map(f64::from)),
        array("x", Association::Point, Scalar::F32, 1, twelve()),
        array("Region", Association::Triangle, Scalar::I64, 1, twelve()),
        array("Far", Association::Triangle, Scalar::U64, 1, twelve().map(|i| i * 1e15)),
        array("RGB", Association::Triangle, Scalar::U8, 3, (0..36).map(f64::from)),
    ];
    let output = Output { arrays: &arrays, axes: Axes::Lps, normals: None, mesh: &mesh };
    let Imported { mesh: back, arrays: found, report } = open(&write_output(&output, Format::Ply).unwrap());
    assert_eq!((back, report.axes), (mesh.clone(), Axes::Lps));
    let names: Vec<(&str, Association, Scalar, usize)> =
        found.iter().map(|array| (&*array.name, array.on, array.values.scalar(), array.components)).collect();
    assert_eq!(
        names,
        [
            ("Wall_shear", Association::Point, Scalar::F64, 3),
            ("RGBA", Association::Point, Scalar::U8, 4),
            ("x_", Association::Point, Scalar::F32, 1),
            ("Region", Association::Triangle, Scalar::I32, 1),
            ("Far", Association::Triangle, Scalar::F64, 1),
            ("RGB", Association::Triangle, Scalar::U8, 3),
        ]
    );
    assert!(arrays.iter().zip(&found).all(|(one, other)| numbers(one) == numbers(other)));
    assert_eq!(found[3].kind, Kind::Label);
}

#[test]
fn glb_has_attributes_of_vertices_alone() {
    let mesh = tetrahedra(3);
    let twelve = || (0..12).map(f64::from);
    let arrays = [
        array("Pressure \"a\"", Association::Point, Scalar::F64, 1, twelve()),
        array("Flow", Association::Point, Scalar::F32, 3, (0..36).map(f64::from)),
        array("Group", Association::Point, Scalar::I32, 1, twelve().map(|i| i - 3.0)),
        array("Kind", Association::Point, Scalar::U8, 1, twelve()),
        array("COLOR_0", Association::Point, Scalar::U8, 3, (0..36).map(f64::from)),
        array("Face", Association::Triangle, Scalar::I32, 1, twelve()),
        array("Id", Association::Point, Scalar::I64, 1, twelve().map(|i| i + 1e9)),
    ];
    let output = Output { arrays: &arrays, ..Output::new(&mesh) };
    let Imported { arrays: found, report, .. } = open(&write_output(&output, Format::Glb).unwrap());
    assert_eq!(report.warnings, []);
    for (name, scalar) in [
        ("Pressure \"a\"", Scalar::F32),
        ("Flow", Scalar::F32),
        ("Group", Scalar::I16),
        ("Kind", Scalar::U8),
        ("COLOR_0", Scalar::U8),
    ] {
        let back = found.iter().find(|array| array.name == name).expect(name);
        assert_eq!((back.values.scalar(), numbers(back)), (scalar, named(&arrays, name, Association::Point)), "{name}");
    }
    assert_eq!(found.len(), 5);
    assert_eq!(
        left_out(&arrays, Format::Glb).unwrap().to_string(),
        "GLB has no place for such arrays: Face, Id are left out."
    );
}

#[test]
fn obj_has_colours_and_groups() {
    let text = "v 0 0 0 1 0 0\nv 90 0 0 0 1 0\nv 90 90 0 0 0 1\nv 0 90 0 .5 .5 .5\ng one\nf 1 2 3\ng two\nf 1 3 4\n\
        g one\nf 2 3 4\nf 1 2\n";
    let Imported { mesh, arrays, .. } = open(text.as_bytes());
    assert_eq!(named(&arrays, "Groups", Association::Triangle), [1.0, 2.0, 1.0]);
    let output = Output { arrays: &arrays, ..Output::new(&mesh) };
    let back = open(&write_output(&output, Format::Obj).unwrap());
    let colours = named(&arrays, "RGB", Association::Point);
    assert_eq!((&colours[3..6], back.arrays.len()), (&[0.0, 1.0, 0.0][..], 1));
    assert_eq!(named(&back.arrays, "RGB", Association::Point), colours);
    // Not every vertex has a colour.
    assert!(open(text.replace(" .5 .5 .5", "").as_bytes()).arrays.iter().all(|array| array.name == "Groups"));
}

#[test]
fn an_array_of_another_length_is_not_written() {
    let short = [array("Short", Association::Triangle, Scalar::F32, 1, [1.0])];
    let mesh = tetrahedra(1);
    let output = Output { arrays: &short, ..Output::new(&mesh) };
    let error = write_output(&output, Format::Vtk).unwrap_err();
    assert_eq!(error, WriteError::ArrayLength { name: "Short".to_owned(), tuples: 1, rows: 4 });
}

/// As VTK 9.7 writes one vertex, one line, two polygons and one strip with the numbers 0, 10, ... 40 on its cells: the
/// strip stands before the polygons in the file and behind them in the array.
#[test]
fn cells_are_counted_in_the_order_of_vtk() {
    let part = |name: &str, connectivity: &str, offsets: &str| {
        format!(
            "<{name}><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{connectivity}</DataArray>\
             <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{offsets}</DataArray></{name}>"
        )
    };
    let vtp = [
        "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"4\" NumberOfVerts=\"1\" \
         NumberOfLines=\"1\" NumberOfStrips=\"1\" NumberOfPolys=\"2\"><CellData Scalars=\"cell id\">\
         <DataArray type=\"Int32\" Name=\"cell &lt;id\" format=\"ascii\">0 10 20 30 40</DataArray>\
         <Array type=\"String\" Name=\"names\" format=\"ascii\">110 0 110 0 110 0 110 0 110 0</Array></CellData><Points>\
         <DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 90 0 0 90 90 0 0 90 0</DataArray></Points>",
        &part("Verts", "0", "1"),
        &part("Lines", "0 1", "2"),
        &part("Strips", "0 1 3 2", "4"),
        &part("Polys", "0 1 2 0 2 3", "3 6"),
        "</Piece></PolyData></VTKFile>",
    ]
    .concat();
    let Imported { arrays, report, .. } = open(vtp.as_bytes());
    assert_eq!(named(&arrays, "cell <id", Association::Triangle), [40.0, 40.0, 20.0, 30.0]);
    assert!(
        in_english(&report.warnings).contains(&"The array \"names\" is left out: it holds text.".to_owned()),
        "{:?}",
        report.warnings
    );
    let legacy = "# vtk DataFile Version 4.2\n\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 90 0 0 90 90 0 0 90 0\n\
        TRIANGLE_STRIPS 1 5\n4 0 1 3 2\nVERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 5\n\
        SCALARS cell%20id int\nLOOKUP_TABLE default\n0 10 20 30 40\nMETADATA\nINFORMATION 0\n\nFIELD FieldData 2\n\
        names 1 5 string\nn0\nn1\nn2\nn3\nn4\nmore 2 5 double\n0 0 1 1 2 2 3 3 4 4\nPOINT_DATA 4\n\
        VECTORS v float\n1 0 0 0 1 0 0 0 1 0 0 0\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\n\
        SCALARS pair unsigned_char 2\nLOOKUP_TABLE table\n1 2 3 4 5 6 7 8\nLOOKUP_TABLE table 1\n0 0 0 1\nTEXTURE_COORDINATES \
        t 2 float\n0 0 1 1 0 0 1 1\nCOLOR_SCALARS c 3\n0 0 1 1 0 0 1 1 0 0 0 1\nsome rest\n";
    let Imported { arrays, report, .. } = open(legacy.as_bytes());
    assert_eq!(named(&arrays, "cell id", Association::Triangle), [40.0, 40.0, 20.0, 30.0]);
    assert_eq!(named(&arrays, "more", Association::Triangle)[..4], [4.0; 4]);
    assert_eq!(named(&arrays, "pair", Association::Point), (1..9).map(f64::from).collect::<Vec<_>>());
    assert_eq!(named(&arrays, "v", Association::Point)[3..6], [0.0, 1.0, 0.0]);
    assert_eq!(arrays.len(), 5, "{:?}", report.arrays);
    let last = "The array \"some\" is left out: it and what follows are not understood.";
    assert!(in_english(&report.warnings).iter().any(|warning| warning == last), "{:?}", report.warnings);
}

#[test]
fn what_is_welded_takes_the_mean_and_what_is_cut_keeps_its_value() {
    // A quadrilateral, and a triangle over corners of its own at the same places; the third face has no area.
    let text = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
        property double heat\nproperty int part\nproperty uchar flow_0\nproperty uchar flow_1\nelement face 3\n\
        property list uchar int vertex_indices\nproperty short side\nend_header\n\
        0 0 0 1 7 1 2\n90 0 0 2 7 3 4\n90 90 0 3 7 5 6\n0 90 0 4 7 7 8\n\
        90 0 0 4 9 5 6\n0 90 0 8 9 9 10\n90 90 50 5 9 0 0\n0 0 0 99 1 99 99\n\
        4 0 1 2 3 -1\n3 4 4 5 5\n3 4 6 5 -2\n";
    let Imported { mesh, arrays, report } = open(text.as_bytes());
    assert_eq!((mesh.positions.len(), mesh.triangles.len(), report.degenerate_triangles), (5, 3, 1));
    // The last vertex lies where the first does, and no face uses it.
    assert_eq!(named(&arrays, "heat", Association::Point), [1.0, 3.0, 3.0, 6.0, 5.0]);
    assert_eq!(named(&arrays, "part", Association::Point), [7.0, 7.0, 7.0, 7.0, 9.0]);
    assert_eq!(named(&arrays, "flow", Association::Point), [1.0, 2.0, 4.0, 5.0, 5.0, 6.0, 8.0, 9.0, 0.0, 0.0]);
    assert_eq!(named(&arrays, "side", Association::Triangle), [-1.0, -1.0, -2.0]);
}

#[test]
fn broken_arrays_leave_the_surface_whole() {
    let warned = |text: String| {
        let Imported { arrays, report, .. } = open(text.as_bytes());
        (arrays.len(), in_english(&report.warnings).join(" "))
    };
    let legacy = |to: &str| warned(LEGACY_TEXT.replace("1 2 3 4\n", to));
    assert_eq!(legacy("1 2 3 4\n").0, 1);
    assert!(legacy("1 2 3\n").1.contains("The array \"a\" is left out: it is cut short."));
    assert!(legacy("1 2 x 4\n").1.contains("The array \"a\" is left out: it holds what is no number."));
    let text = LEGACY_TEXT.replace("SCALARS a float", "SCALARS a float 4000000000000000000");
    assert!(warned(text).1.contains("is cut short"));
    let part = "The array \"a\" is left out: not every part of the file has it.";
    assert_eq!(warned(VTP_TEXT.to_owned()).1.matches(part).count(), 1);
    let second = "NumberOfPolys=\"1\"><PointData><DataArray type=\"Float32\" Name=\"a\" format=\"ascii\">5 6 7\
        </DataArray></PointData>";
    let Imported { arrays, .. } = open(VTP_TEXT.replace("NumberOfPolys=\"1\">", second).as_bytes());
    assert_eq!(named(&arrays, "a", Association::Point), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    for (from, to, why) in [
        ("Name=\"a\" format=\"ascii\">1 2 3 4<", "Name=\"a\" format=\"binary\">AAAA<", "its data are damaged"),
        ("type=\"Float32\" Name=\"a\"", "type=\"Bit\" Name=\"a\"", "of a type that is not read"),
        ("Name=\"a\" format", "Name=\"a\" NumberOfComponents=\"18446744073709551615\" format", "it is cut short"),
    ] {
        assert!(VTP_TEXT.contains(from));
        let (_, warnings) = warned(VTP_TEXT.replacen(from, to, 1));
        assert!(warnings.contains(why), "{to}: {warnings}");
    }
}

#[test]
fn a_wide_array_of_one_large_polygon_is_not_spread_over_its_triangles() {
    let _alone = alone();
    let n = 200_000;
    let corners: String = (0..n).map(|i| format!("{} ", i % 3)).collect();
    let wide = "1 ".repeat(500_000);
    let legacy = format!(
        "# vtk DataFile Version 4.2\n\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 90 0 0 0 90 0\nPOLYGONS 1 {}\n{n} \
         {corners}\nCELL_DATA 1\nFIELD FieldData 1\nwide 500000 1 double\n{wide}\n",
        n + 1
    );
    let (result, taken) = read_measured(legacy.as_bytes(), "a.vtk");
    let Imported { arrays, report, .. } = result.unwrap();
    let why = "The array \"wide\" is left out: it would take more memory than a file of this size is given.";
    assert!(
        arrays.is_empty() && in_english(&report.warnings).iter().any(|warning| warning == why),
        "{:?}",
        report.warnings
    );
    assert!(taken <= crate::memory::room(legacy.len()), "{taken}");
}
