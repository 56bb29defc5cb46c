//! Segmentations (DICOM SEG): maps of labels, or volumes where segments overlap.

use super::*;

/// Segments of which each has frames where it is, and none between: their pixels are known, as they are made so.
#[test]
fn segmentations_become_labels_with_names_or_volumes_where_they_overlap() {
    let segmentation = |inside: fn(usize, [usize; 3]) -> bool, kind: &str| {
        let order = [(2, 1), (0, 1), (0, 2), (3, 2)];
        let each = order.iter().flat_map(|&(k, segment)| {
            let (at, segment) = (String::from_utf8(place(k, 0.0)).unwrap(), segment.to_string());
            groups(&[
                (0x0020, 0x9113, "DS", 0x0020, 0x0032, at.trim()),
                (0x0062, 0x000A, "US", 0x0062, 0x000B, segment.as_str()),
            ])
        });
        let pixels = order.iter().flat_map(|&(k, segment)| {
            points().filter(move |point| point[2] == k).map(move |point| inside(segment, point))
        });
        let pixels: Vec<bool> = pixels.collect();
        let is_binary = kind == "BINARY";
        let bytes = if is_binary {
            pixels.chunks(8).map(|eight| eight.iter().enumerate().map(|(n, &bit)| u8::from(bit) << n).sum()).collect()
        } else {
            pixels.iter().map(|&inside| if inside { 100 } else { 99 }).collect()
        };
        // 3D Slicer's colour of arteries, and full red: in CIE L*a*b* of the white D50 (54.29, 80.81, 69.89).
        let segments = [(1, "aorta", [37_457, 44_450, 41_893]), (2, "vein", [35_580, 53_665, 50_856u16])].map(
            |(number, name, lab)| {
                let number = element(0x0062, 0x0004, "US", &short(number), EXPLICIT);
                let name = element(0x0062, 0x0005, "LO", &text(name), EXPLICIT);
                let colour = element(0x0062, 0x000D, "US", &lab.map(u16::to_le_bytes).concat(), EXPLICIT);
                item(&[number, name, colour].concat())
            },
        );
        let bits = short(if is_binary { 1 } else { 8 });
        let numbers = order.map(|(k, _)| k);
        let file = frames(&numbers, groups(&[ORIENTED, SPACED]), each.collect(), padded(bytes));
        let file = file.with(0x0028, 0x0100, bits.clone()).with(0x0028, 0x0101, bits).with(0x0008, 0x0060, text("SEG"));
        let file = file.also(0x0062, 0x0001, "CS", text(kind)).also(0x0062, 0x000E, "US", short(200));
        vec![("a", file.also(0x0062, 0x0002, "SQ", segments.concat()).bytes())]
    };
    let names = [label_name(1, "aorta", Some([216, 101, 79])), label_name(2, "vein", Some([255, 0, 0]))];
    for kind in ["BINARY", "FRACTIONAL"] {
        let scan = open(&segmentation(|segment, [i, ..]| if segment == 1 { i < 2 } else { i > 4 }, kind)).unwrap();
        assert_eq!(scan.grid.geometry().size, SIZE, "{kind}");
        let label = |[i, _, k]: [usize; 3]| match (i, k) {
            (0 | 1, 0 | 2) => 1.0,
            (5, 0 | 3) => 2.0,
            _ => 0.0,
        };
        assert!(points().all(|point| scan.grid.value(point) == label(point)), "{kind}");
        assert_eq!((&scan.names[..], scan.offers.len()), (&names[..], 1));
        let files = segmentation(|segment, [i, ..]| if segment == 1 { i < 2 } else { i > 0 }, kind);
        let second = open_volume(&files, Some(1)).unwrap();
        let values: Vec<_> = second.offers.iter().map(|offer| (offer.by, offer.value.as_str())).collect();
        assert_eq!(values, [(Some(VolumeField::Segment), "aorta"), (Some(VolumeField::Segment), "vein")]);
        assert_eq!(second.grid.geometry().size, SIZE);
        assert!(
            points()
                .all(|[i, j, k]| second.grid.value([i, j, k]) == if i > 0 && (k == 0 || k == 3) { 2.0 } else { 0.0 })
        );
    }
}

/// A file of segment 1 in the pixels with `i == column`, with frames of `heights` in mm and elements more.
fn segment_file(
    column: usize,
    name: &[u8],
    heights: &[f64],
    also: &[(u16, u16, &'static str, u16, u16, &str)],
) -> File {
    let each = heights.iter().flat_map(|height| {
        let at = format!("-10\\20\\{}", 300.0 + height);
        groups(&[(0x0020, 0x9113, "DS", 0x0020, 0x0032, &at), (0x0062, 0x000A, "US", 0x0062, 0x000B, "1")])
    });
    let slice = (0..SIZE[0] * SIZE[1]).map(|at| u8::from(at % SIZE[0] == column)).collect::<Vec<_>>();
    let shared = groups(&[&[ORIENTED, SPACED], also].concat());
    let segment = [element(0x0062, 0x0004, "US", &short(1), EXPLICIT), element(0x0062, 0x0005, "LO", name, EXPLICIT)];
    frames(&vec![0; heights.len()], shared, each.collect(), slice.repeat(heights.len()))
        .with(0x0028, 0x0100, short(8))
        .with(0x0028, 0x0101, short(8))
        .with(0x0008, 0x0060, text("SEG"))
        .also(0x0062, 0x0001, "CS", text("BINARY"))
        .also(0x0062, 0x0002, "SQ", item(&segment.concat()))
}

#[test]
fn segments_of_one_number_in_two_files_are_two_and_a_file_opened_twice_is_one() {
    let heights = [0.0, 2.0, 4.0];
    let named = |column, name: &str, number| {
        segment_file(column, name.as_bytes(), &heights, &[]).also(0x0008, 0x0018, "UI", text(number)).bytes()
    };
    let (aorta, vein) = (named(0, "aorta ", "1.1"), named(3, "vein", "1.2"));
    let scan = open(&[("a", aorta.clone()), ("b", vein.clone())]).unwrap();
    assert!(scan.warnings.is_empty(), "{:?}", scan.warnings);
    assert_eq!(scan.names, [label_name(1, "aorta", None), label_name(2, "vein", None)]);
    assert_eq!([0, 1, 3].map(|i| scan.grid.value([i, 0, 2])), [1.0, 0.0, 2.0]);
    // Where they overlap, too.
    let files = vec![("a", aorta.clone()), ("b", named(0, "vein", "1.2"))];
    let second = open_volume(&files, Some(1)).unwrap();
    assert_eq!((second.offers.len(), second.offers[1].slices, second.grid.value([0, 0, 0])), (2, 3, 2.0));
    let twice = open(&[("a", aorta.clone()), ("b", aorta)]).unwrap();
    assert_eq!((twice.names, twice.offers.len()), (vec![label_name(1, "aorta", None)], 1));
    assert_eq!(in_english(&twice.warnings).len(), 1, "three slices are there twice");
}

/// Each of 400 segments is a volume, and all have the same 800 frames: 36 MB if each kept them.
#[test]
fn segments_that_overlap_share_their_frames() {
    let each = (0..800).flat_map(|n| {
        let (at, segment) = (format!("-10\\20\\{}", 300 + n % 2), (1 + n / 2).to_string());
        groups(&[(0x0020, 0x9113, "DS", 0x0020, 0x0032, &at), (0x0062, 0x000A, "US", 0x0062, 0x000B, &segment)])
    });
    let file = frames(&[0; 800], groups(&[ORIENTED, SPACED]), each.collect(), vec![1; 800 * SIZE[0] * SIZE[1]])
        .with(0x0028, 0x0100, short(8))
        .also(0x0062, 0x0001, "CS", text("BINARY"));
    let _alone = crate::alone();
    let (scan, taken) = crate::open_measured(&[("a", file.bytes())]);
    let scan = scan.unwrap();
    assert_eq!((scan.offers.len(), scan.grid.value([0, 0, 1])), (400, 1.0));
    assert!(taken < 4_000_000, "{taken}");
}

#[test]
fn names_of_segments_are_in_the_letters_that_the_file_names() {
    for (letters, name) in [("ISO_IR 100", &b"Gef\xE4\xDF "[..]), ("ISO_IR 192", "Gef\u{e4}\u{df}".as_bytes())] {
        let file = segment_file(0, &padded(name.to_vec()), &[0.0, 2.0], &[]).also(0x0008, 0x0005, "CS", text(letters));
        assert_eq!(open(&[("a", file.bytes())]).unwrap().names, [label_name(1, "Gef\u{e4}\u{df}", None)], "{letters}");
    }
}

#[test]
fn uneven_segmentations_are_told_and_stated_distances_are_taken_where_they_can_be_so() {
    let open = |heights: &[f64], stated: &[_]| open(&[("a", segment_file(0, b"aorta ", heights, stated).bytes())]);
    let between = |distance| (0x0028, 0x9110, "DS", 0x0018, 0x0088, distance);
    let uneven = open(&[0.0, 5.0, 12.0], &[]).unwrap();
    assert_eq!(uneven.grid.geometry().size[2], 3);
    assert!(in_english(&uneven.warnings)[0].contains("not evenly apart"), "{:?}", uneven.warnings);
    for (stated, slices) in [("2", 4), ("1", 7), ("600", 4)] {
        let scan = open(&[0.0, 2.0, 6.0], &[between(stated)]).unwrap();
        let geometry = scan.grid.geometry();
        assert_eq!((geometry.size[2], geometry.spacing.z * (slices - 1) as f64), (slices, 6.0), "{stated}");
        assert!(scan.warnings.is_empty(), "{:?}", scan.warnings);
    }
    // More slices than there can be.
    let far = open(&[0.0, 0.002, 9e8], &[]).unwrap_err();
    assert!(matches!(far, ScanError::Volume(_)), "{far:?}");
    let bits = segment_file(0, b"aorta ", &[0.0, 2.0], &[]).with(0x0028, 0x0100, short(32));
    let bits = crate::open(&[("a", bits.bytes())]).unwrap_err().to_string();
    assert_eq!(bits, "The DICOM file uses 32 bits a pixel, which Lumen does not read.");
}
