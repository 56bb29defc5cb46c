//! Every way to write a volume is read as the same volume, and what cannot be read is refused in a sentence.

use std::sync::Arc;

use lumen::io::volume::{Head, Part, Scan, ScanError, begin, data_name, is_volume, read, read_volume};
use lumen::io::{Axes, LabelName, in_english};
use lumen::volume::{Label, Selection, VolumeError, surface, survey};

use crate::open;
use crate::samples::{
    Nifti, all, ascii, assert_is_it, big, gzip, label_name, little, metaimage, metaimage_of_four, nrrd, points, value,
    vti,
};

#[test]
fn every_way_gives_the_same_volume_in_the_same_place() {
    for (what, files) in all() {
        let scan = open(&files).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_is_it(&scan, what);
        let is_silent = what.starts_with("vti");
        assert_eq!(scan.axes, if is_silent { Axes::Unknown } else { Axes::Lps }, "{what}");
        assert!(files.iter().any(|(_, bytes)| is_volume(bytes)), "{what}");
    }
}

#[test]
fn headers_name_the_file_of_their_numbers() {
    let names: Vec<Option<String>> =
        all().iter().map(|(_, files)| files.iter().find_map(|(name, bytes)| data_name(bytes, name))).collect();
    let named: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
    assert_eq!(named, ["folder/a.raw", "a.txt", "a.raw", "a.img"]);
    let header = metaimage("", "numbers.raw");
    let error = open(&[("a.mhd", header.into_bytes())]).unwrap_err().to_string();
    assert_eq!(error, "The MetaImage header keeps its numbers in the file \"numbers.raw\": open both together.");
}

#[test]
fn an_unknown_space_is_told() {
    let header = nrrd("raw", "\n").replace("space: left-posterior-superior\n", "");
    let scan = open(&[("a.nrrd", [header.into_bytes(), little()].concat())]).unwrap();
    assert_eq!((scan.axes, scan.warnings.len()), (Axes::Unknown, 1));
    let scan = open(&[("a.vti", vti("", &format!("format=\"ascii\">{}", crate::samples::ascii()), b""))]).unwrap();
    assert_eq!(in_english(&scan.warnings), ["VTI does not say which way the patient lies: the axes are unknown."]);
    for header in [
        metaimage("", "LOCAL").replace("AnatomicalOrientation = RAI\n", ""),
        metaimage("", "LOCAL").replace("RAI", "???"),
    ] {
        let scan = open(&[("a.mha", [header.into_bytes(), little()].concat())]).unwrap();
        assert_eq!((scan.axes, scan.warnings.len()), (Axes::Unknown, 1));
        assert_is_it(&scan, "its numbers are as they stand");
    }
    // By neither matrix nor quaternion: the place of a voxel is its index times the spacing (method 1 of NIfTI-1), and nothing
    // says that it is RAS.
    let mut header = Nifti::first(false, true, b"n+1\0", 352.0);
    header[254] = 0;
    let scan = open(&[("a.nii", [header, little()].concat())]).unwrap();
    assert_eq!((scan.axes, scan.warnings.len()), (Axes::Unknown, 1));
    assert_eq!(scan.grid.geometry().at(1.0, 1.0, 1.0).to_array(), [0.5, 0.75, 2.0]);
}

#[test]
fn a_space_of_left_anterior_superior_is_turned() {
    let header = nrrd("raw", "\n")
        .replace("left-posterior-superior", "left-anterior-superior")
        .replace("(0.3,0.4,0) (-0.6,0.45,0)", "(0.3,-0.4,0) (-0.6,-0.45,0)")
        .replace("(-10,20,300)", "(-10,-20,300)");
    let scan = open(&[("a.nrrd", [header.into_bytes(), little()].concat())]).unwrap();
    assert_eq!((scan.axes, scan.warnings.len()), (Axes::Lps, 0));
    assert_is_it(&scan, "nrrd in LAS");
}

#[test]
fn lengths_in_other_units_are_made_millimetres() {
    let grid = |name: &str, header: String| {
        let scan = open(&[(name, [header.into_bytes(), little()].concat())]).unwrap();
        let geometry = scan.grid.geometry();
        ((geometry.spacing * 1e6).round() / 1e6, geometry.origin, in_english(&scan.warnings))
    };
    // Both have steps of 0.5, 0.75 and 2 from (-10, 20, 300).
    let (spacing, origin, none) = grid("a.nrrd", nrrd("raw", "\n"));
    for (unit, mm) in [("mm", 1.0), ("cm", 10.0), ("um", 1e-3)] {
        let line = format!("space units: \"{unit}\" \"{unit}\" \"{unit}\"\n\n");
        assert_eq!(grid("a.nrrd", nrrd("raw", &line)), (spacing * mm, origin * mm, none.clone()), "{unit}");
        let line = format!("DistanceUnits = {unit}\n");
        let (spacing_mha, origin_mha, _) = grid("a.mha", metaimage("", "LOCAL"));
        assert_eq!(grid("a.mha", metaimage(&line, "LOCAL")), (spacing_mha * mm, origin_mha * mm, Vec::new()), "{unit}");
    }
    // In metres its slices would be 2 m apart.
    let header = nrrd("raw", "space units: \"m\" \"m\" \"m\"\n\n");
    let refused = open(&[("a.nrrd", [header.into_bytes(), little()].concat())]).unwrap_err().to_string();
    assert!(refused.contains("2000 mm"), "{refused}");
    let (same, _, warnings) = grid("a.nrrd", nrrd("raw", "space units: \"ell\" \"ell\" \"ell\"\n\n"));
    assert_eq!(same, spacing);
    assert!(warnings.iter().any(|text| text.contains("is not known: it is taken as mm")), "{warnings:?}");
}

#[test]
fn what_cannot_be_read_is_refused_in_a_sentence() {
    let refused = |name: &str, bytes: Vec<u8>| open(&[(name, bytes)]).unwrap_err().to_string();
    assert_eq!(refused("a.nii", Vec::new()), "The file is empty.");
    assert_eq!(
        refused("folder/notes.txt", b"Dear colleague".to_vec()),
        "\"notes.txt\" is not a volume that Lumen knows: it opens NIfTI, NRRD, MetaImage and VTI files and series of DICOM."
    );
    let mha = |from: &str, to: &str| {
        refused("a.mha", [metaimage("", "LOCAL").replace(from, to).into_bytes(), little()].concat())
    };
    assert_eq!(
        mha("DimSize = 6 5 4", "DimSize = 6 5 5"),
        "The MetaImage file is cut short: it announces 300 bytes and holds 240."
    );
    assert_eq!(
        mha("NDims = 3", "NDims = 2"),
        "The MetaImage file uses other than three dimensions, which Lumen does not read."
    );
    assert_eq!(mha("NDims = 3", "NDims = 4"), "The MetaImage file is broken: \"DimSize\" is not 4 numbers.");
    let two_times = metaimage_of_four("2");
    assert_eq!(
        refused("a.mha", [two_times.into_bytes(), little(), little()].concat()),
        "The MetaImage file uses more than three dimensions, which Lumen does not read."
    );
    assert_eq!(
        mha("MET_SHORT", "MET_WORD"),
        "The MetaImage file uses numbers of type \"MET_WORD\", which Lumen does not read."
    );
    assert_eq!(
        mha("= 0.6 0.8 0", "= 0 0 0"),
        "The volume cannot be placed in the patient: a distance of 0 mm between its points is none that a scan has."
    );
    assert_eq!(
        mha("0.6 0.8 0 -0.8 0.6 0", "0.6 0.8 0 0.6 0.8 0"),
        "The volume cannot be placed in the patient: the directions of its axes span no space."
    );
    assert!(
        mha("6 5 4", "600000 500000 4").starts_with("The volume is too large: its numbers take 2400000000000 bytes")
    );
    let header = nrrd("gzip", "\n");
    let damaged = refused("a.nrrd", [header.clone().into_bytes(), gzip(&little())[..60].to_vec()].concat());
    assert!(damaged.starts_with("The NRRD file is"), "{damaged}");
    assert_eq!(
        refused("a.nrrd", header.replace("gzip", "bzip2").into_bytes()),
        "The NRRD file uses the encoding \"bzip2\", which Lumen does not read."
    );
    let packed = nrrd("gzip", "\n").replace("6 5 4", "6000 500 40").into_bytes();
    let claimed = refused("a.nrrd", [packed, gzip(&little())].concat());
    assert!(claimed.contains("announces 240000000 bytes, more than its"), "{claimed}");
    assert!(read(&[] as &[Part]).is_err());
}

#[test]
fn a_mask_is_told_from_a_scan_and_its_labels_are_counted() {
    let survey = |text: &str, size: &str| {
        let header = metaimage("", "LOCAL").replace("BinaryData = True", "BinaryData = False").replace("6 5 4", size);
        let scan = open(&[("a.mha", [header.as_bytes(), text.as_bytes()].concat())]).unwrap();
        survey(&scan.grid)
    };
    let mask = survey("0 0 3 3 0 1 0 3", "2 2 2");
    assert_eq!(mask.labels, [Label { value: 1, points: 1 }, Label { value: 3, points: 3 }]);
    assert_eq!((mask.range, mask.histogram[0], mask.histogram[255]), ([0.0, 3.0], 4, 3));
    assert_eq!(Selection::choose(&mask, None, None), Ok(Selection::AnyLabel));
    let absent = Selection::choose(&mask, None, Some(2)).unwrap_err();
    assert_eq!(absent.to_string(), "There is no label 2 in the volume; it has 1, 3.");
    // A whole body's labels are too many to be told from a scan, and each can be chosen all the same.
    let body: Vec<String> = (0..117).map(|label| label.to_string()).collect();
    let body = survey(&body.join(" "), "13 9 1");
    assert!(!body.is_mask());
    assert_eq!(Selection::choose(&body, None, Some(52)), Ok(Selection::Label(52)));
    assert!(Selection::choose(&body, None, Some(117)).is_err());
    let scan = survey("-1000 40 300 0 60 0 0 200", "2 2 2");
    assert!(!scan.is_mask());
    assert_eq!(
        Selection::choose(&scan, None, None).unwrap_err().to_string(),
        "This is a scan with values from -1000 to 300: say at which threshold its surface is to be made (contrast-filled \
         vessels in CT: 130 for vessels with little contrast, 180 for arteries, 250 for the aorta and the coronary arteries)."
    );
    let above = Selection::choose(&scan, Some(301.0), None);
    assert_eq!(above, Err(VolumeError::OutsideRange { threshold: 301.0, low: -1000.0, high: 300.0 }));
    assert!(Selection::choose(&scan, Some(f64::NAN), None).is_err());
    assert_eq!(Selection::choose(&scan, Some(180.0), None), Ok(Selection::Threshold(180.0)));
}

/// The sample as NIfTI of bytes with a slope and an intercept, and each point's stored number.
fn scaled(slope: f32, intercept: f32, stored: impl Fn([usize; 3]) -> u8) -> Scan {
    let mut header = Nifti::first(false, true, b"n+1\0", 352.0);
    header[70..74].copy_from_slice(&[2, 0, 8, 0]);
    header[112..116].copy_from_slice(&slope.to_le_bytes());
    header[116..120].copy_from_slice(&intercept.to_le_bytes());
    open(&[("a.nii", [header, points().map(stored).collect()].concat())]).unwrap()
}

/// 30 points of each of two labels, and how a slope leaves them: the labels are known, as the numbers are made of them.
#[test]
fn labels_beside_whole_numbers_are_labels() {
    let slice = |[_, _, k]: [usize; 3]| [0, 1, 2, 0][k];
    for (slope, intercept, numbers) in [
        (1.000_000_1, 0.0, [0, 1, 2]),
        (0.003_921_569, 0.0, [0, 255, 0]),
        (0.988, 0.0, [0, 1, 2]),
        (0.038, 0.0, [0, 26, 53]),
        (-0.01, 2.0, [200, 100, 0]),
    ] {
        let scan = scaled(slope, intercept, |point| numbers[slice(point)]);
        let found = survey(&scan.grid);
        let expected: Vec<Label> =
            [1, 2].into_iter().zip([30, 30]).map(|(value, points)| Label { value, points }).collect();
        let expected = if numbers[2] == numbers[0] && slope > 0.0 { &expected[..1] } else { &expected[..] };
        assert_eq!(found.labels, expected, "{slope}");
        let grid = Arc::new(scan.grid);
        for label in &found.labels {
            let selection = Selection::choose(&found, None, Some(label.value)).unwrap();
            assert!(!surface(&grid, selection, None).unwrap().triangles.is_empty(), "{slope}: {label:?}");
        }
    }
    let parts = scaled(0.125, 0.0, |[i, ..]| i as u8);
    assert!(!survey(&parts.grid).is_mask(), "parts of a whole are a scan");
}

#[test]
fn a_volume_of_one_side_is_told_without_a_box() {
    let scan = scaled(0.5, 0.0, |[i, j, k]| (7 * i + 11 * j + 13 * k) as u8);
    let all = surface(&Arc::new(scan.grid), Selection::Threshold(-1.0), None).unwrap_err();
    assert_eq!(all.to_string(), "There is no surface: all of the volume lies on one side.");
}

/// The quaternion of the sample says the same as its matrix.
#[test]
fn a_matrix_that_is_none_gives_way_to_the_quaternion_and_that_is_told_once() {
    for matrix in [0.0, f32::NAN] {
        let mut header = Nifti::first(false, false, b"n+1\0", 352.0);
        header[254] = 1;
        (280..328).step_by(4).for_each(|at| header[at..at + 4].copy_from_slice(&matrix.to_le_bytes()));
        let scan = open(&[("a.nii", [header.clone(), little()].concat())]).unwrap();
        assert_is_it(&scan, "by quaternion");
        let told = "The NIfTI file's matrix (sform) is unusable: its directions span no space. The quaternion (qform) is used instead.";
        assert_eq!((scan.axes, in_english(&scan.warnings)), (Axes::Lps, vec![told.to_owned()]));
        header[252] = 0;
        let scan = open(&[("a.nii", [header, little()].concat())]).unwrap();
        assert_eq!((scan.axes, scan.warnings.len()), (Axes::Unknown, 2));
    }
}

#[test]
fn a_matrix_that_contradicts_the_spacings_is_told() {
    let mut header = Nifti::first(false, true, b"n+1\0", 352.0);
    header[88..92].copy_from_slice(&0.2f32.to_le_bytes());
    let scan = open(&[("a.nii", [header, little()].concat())]).unwrap();
    assert_is_it(&scan, "by matrix");
    assert_eq!(
        in_english(&scan.warnings),
        [
            "The NIfTI file contradicts itself: by its matrix (sform) voxels are 2.000 mm apart, by its spacings 0.200 mm. The matrix is taken."
        ]
    );
}

#[test]
fn analyze_is_read_in_axes_that_nobody_knows() {
    for is_big in [false, true] {
        let mut header = Nifti::first(is_big, true, b"\0\0\0\0", 16.0)[..348].to_vec();
        // A slope is none of it.
        header[112..116].copy_from_slice(&if is_big { 0.5f32.to_be_bytes() } else { 0.5f32.to_le_bytes() });
        let data = [vec![7; 16], if is_big { big() } else { little() }].concat();
        let scan = open(&[("a.img", data), ("a.hdr", header)]).unwrap();
        assert_eq!((scan.format, scan.axes), ("Analyze", Axes::Unknown));
        assert!(points().all(|point| scan.grid.value(point) == f64::from(value(point))));
        assert_eq!(scan.grid.geometry().at(1.0, 1.0, 1.0).to_array(), [0.5, 0.75, 2.0]);
    }
}

/// As VTK has it: a value of a cell is in its middle.
#[test]
fn structured_points_are_read_on_points_and_on_cells() {
    let numbers = ascii();
    for (size, origin, on) in [("6 5 4", "-10 20 300", "POINT_DATA"), ("7 6 5", "-10.25 19.625 299", "CELL_DATA")] {
        let head =
            format!("DATASET STRUCTURED_POINTS\nDIMENSIONS {size}\nORIGIN {origin}\nSPACING 0.5 0.75 2\n{on} 120\n");
        let text = format!(
            "# vtk DataFile Version 3.0\nx\nASCII\n{head}SCALARS ct short 1\nLOOKUP_TABLE default\n{numbers}\n"
        );
        let field = format!("# vtk DataFile Version 3.0\nx\nBINARY\n{head}FIELD data 2\nvectors 3 120 float\n");
        let binary =
            [field.into_bytes(), vec![0; 1440], b"\nct 1 120 short\n".to_vec(), big(), b"\n".to_vec()].concat();
        let described = format!(
            "# vtk DataFile Version 4.2\nx\nASCII\n{head}FIELD data 2\nvectors 3 1 float\n0 0 0\nMETADATA\nINFORMATION 0\n\n"
        );
        let described = format!("{described}ct 1 120 short\n{numbers}\nMETADATA\nINFORMATION 0\n\n");
        for bytes in [text.into_bytes(), binary, described.into_bytes()] {
            assert!(is_volume(&bytes));
            let scan = open(&[("a.vtk", bytes)]).unwrap();
            assert_eq!((scan.format, scan.axes), ("VTK", Axes::Unknown));
            assert!(points().all(|point| scan.grid.value(point) == f64::from(value(point))));
            assert_eq!(scan.grid.geometry().at(1.0, 1.0, 1.0).to_array(), [-9.5, 20.75, 302.0]);
        }
    }
}

/// All numbers are there before the damage: they count whether the file comes whole or in pieces.
#[test]
fn damage_behind_the_numbers_is_none_of_theirs() {
    let header = [0x1F, 0x8B, 8, 0, 0, 0, 0, 0, 0, 3];
    // A block of the numbers as they are, and one of a kind that there is not.
    let packed = |whole: &[u8]| {
        let length = whole.len() as u16;
        [&header[..], &[0], &length.to_le_bytes(), &(!length).to_le_bytes(), whole, &[7; 9]].concat()
    };
    let bytes = [nrrd("gzip", "\n").into_bytes(), packed(&little())].concat();
    assert_is_it(&open(&[("a.nrrd", bytes)]).unwrap(), "damage behind the numbers");
    let nifti = [Nifti::first(false, true, b"n+1\0", 352.0), little()].concat();
    assert_is_it(&open(&[("a.nii.gz", packed(&nifti))]).unwrap(), "damage behind the numbers of NIfTI");
}

/// Labels of two layers, one number of each after another.
fn layered(second: impl Fn([usize; 3]) -> u8, segments: &str) -> Vec<u8> {
    let header = nrrd("raw", segments)
        .replace("type: short", "type: uchar")
        .replace("dimension: 3", "dimension: 4")
        .replace("sizes: ", "sizes: 2 ")
        .replace("directions: ", "directions: none ")
        .replace("kinds: ", "kinds: list ");
    let first = |[i, ..]: [usize; 3]| u8::from(i < 2);
    [header.into_bytes(), points().flat_map(|point| [first(point), second(point)]).collect()].concat()
}

#[test]
fn layers_of_a_segmentation_are_one_map_or_a_volume_each() {
    let names = "Segment0_Name:=aorta: arch\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n\
        Segment0_Color:=0.847059 0.396078 0.309804\nSegment1_Color:=red\nSegment1_Name:=vein\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n\n";
    let bytes = layered(|[i, ..]| u8::from(i > 4), names);
    let scan = open(&[("a.nrrd", bytes)]).unwrap();
    let labels = [(1, 40), (2, 20)].map(|(value, points)| Label { value, points });
    assert_eq!(survey(&scan.grid).labels, labels);
    let (arch, vein) = (label_name(1, "aorta: arch", Some([216, 101, 79])), label_name(2, "vein", None));
    assert_eq!(scan.names, [arch.clone(), vein.clone()]);
    let bytes = layered(|[i, ..]| u8::from(i > 0), names);
    let read = |choice| read_volume(&[Part { name: "a.nrrd", bytes: &bytes }], choice);
    for (choice, number, points, name) in [(None, 0, 40, arch), (Some(1), 1, 100, LabelName { value: 1, ..vein })] {
        let scan = read(choice).unwrap();
        assert_eq!(survey(&scan.grid).labels, [Label { value: 1, points }]);
        assert_eq!((scan.names, scan.taken), (vec![name], number));
        assert_eq!(
            scan.offers.iter().map(|offer| offer.value.as_str()).collect::<Vec<_>>(),
            ["1 aorta: arch", "2 vein"]
        );
    }
    assert_eq!(read(Some(2)).unwrap_err(), ScanError::NoSuchVolume { number: 3, count: 2 });
    // A label that names no segment keeps its own number, unless a segment of the other layer has it.
    let scan = open(&[("a.nrrd", layered(|[i, ..]| if i > 4 { 7 } else { 0 }, names))]).unwrap();
    assert_eq!(scan.grid.value([5, 0, 0]), 3.0, "two segments are 1");
    let one = "Segment0_Name:=aorta\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n\n";
    let scan = open(&[("a.nrrd", layered(|[i, ..]| if i > 4 { 7 } else { 0 }, one))]).unwrap();
    assert_eq!([0, 3, 5].map(|i| scan.grid.value([i, 0, 0])), [1.0, 0.0, 7.0]);
    let times = layered(|_| 0, "\n");
    assert!(open(&[("a.nrrd", times)]).unwrap_err().to_string().contains("more than three dimensions"));
}

/// Labels of 32 bits in layers whose map has 16.
#[test]
fn labels_of_layers_beyond_a_map_are_numbered_anew_or_refused() {
    let layers = |second: &dyn Fn(usize) -> u32, size: [usize; 3]| {
        let header = nrrd("raw", "Segment0_Name:=aorta\nSegment0_LabelValue:=70000\nSegment0_Layer:=1\n\n")
            .replace("type: short", "type: uint")
            .replace("dimension: 3", "dimension: 4")
            .replace("sizes: 6 5 4", &format!("sizes: 2 {} {} {}", size[0], size[1], size[2]))
            .replace("directions: ", "directions: none ")
            .replace("kinds: ", "kinds: list ");
        let numbers = (0..size.iter().product::<usize>()).flat_map(|at| [0, second(at)]).flat_map(u32::to_le_bytes);
        open(&[("a.nrrd", [header.into_bytes(), numbers.collect()].concat())])
    };
    let scan = layers(&|at| if at == 0 { 70_000 } else { 0 }, [6, 5, 4]).unwrap();
    assert_eq!((scan.grid.value([0, 0, 0]), &scan.names[..]), (1.0, &[label_name(1, "aorta", None)][..]));
    let many = layers(&|at| at as u32, [300, 300, 2]).unwrap_err().to_string();
    assert!(many.contains("labels, the most that a map can have"), "{many}");
}

/// Reads a volume of which so many bytes of each file are known at first, in pieces of seven; `None` where it has to be read
/// whole.
fn in_pieces(files: &[(&str, Vec<u8>)], known: usize) -> Result<Option<Scan>, ScanError> {
    let known: Vec<_> =
        files.iter().map(|(name, bytes)| (name, &bytes[..known.min(bytes.len())], bytes.len())).collect();
    let heads: Vec<Head> =
        known.iter().map(|&(name, bytes, length)| Head { name, bytes, length: length as u64 }).collect();
    let Some(mut stream) = begin(&heads)? else { return Ok(None) };
    for piece in files[stream.file()].1[stream.start() as usize..].chunks(7) {
        stream.push(piece)?;
    }
    stream.finish().map(Some)
}

#[test]
fn a_volume_is_read_in_pieces_as_it_is_whole() {
    let mut streamed = 0;
    for (what, files) in all() {
        if let Some(scan) = in_pieces(&files, 600).unwrap() {
            assert_is_it(&scan, what);
            streamed += 1;
        }
    }
    assert_eq!(streamed, 14, "all of NIfTI, NRRD and MetaImage but text");
    // A header that goes on beyond what is known.
    let (_, nrrd) = all().into_iter().find(|(what, _)| *what == "nrrd").unwrap();
    assert!(in_pieces(&nrrd, 100).unwrap_or(None).is_none());
}

#[test]
fn what_ends_early_or_is_damaged_is_refused_in_pieces_too() {
    for (what, mut files) in
        all().into_iter().filter(|(what, _)| ["nii", "nii.gz", "mha of zlib", "nrrd"].contains(what))
    {
        let bytes = &mut files[0].1;
        bytes.truncate(bytes.len() - 20);
        assert!(in_pieces(&files, 600).is_err(), "{what}");
    }
}

/// What a file is does not depend on how much of it is known: its first element says it, and no word behind that.
#[test]
fn a_file_beside_a_volume_is_none_by_a_word_far_behind_its_beginning() {
    let surface = format!("<VTKFile type=\"PolyData\">{}<Array Name=\"ImageData\"/>", " ".repeat(1500));
    let nifti = [Nifti::first(false, true, b"n+1\0", 352.0), little()].concat();
    let files = [("a.vtp", surface.into_bytes()), ("a.nii", nifti)];
    assert_is_it(&open(&files).unwrap(), "whole");
    assert_is_it(&in_pieces(&files, 1024).unwrap().unwrap(), "in pieces");
}
