//! No bytes make a reader of volumes panic, or take memory that a header merely claims.

use proptest::prelude::*;

use crate::samples::all;
use crate::{Files, alone, open_measured};

/// The most that reading so many bytes may take: what deflate can make of them, and what goes with it.
fn room(bytes: usize) -> usize {
    2 * 1032 * bytes + 8_000_000
}

/// Reads, and checks what must hold whatever the bytes are: a number for each point in a place, or a sentence.
fn open_anything(files: &Files) -> Result<(), TestCaseError> {
    let bytes: usize = files.iter().map(|(_, bytes)| bytes.len()).sum();
    let _alone = alone();
    let (result, taken) = open_measured(files);
    prop_assert!(taken <= room(bytes), "{} bytes took {}", bytes, taken);
    match result {
        Ok(scan) => {
            let geometry = scan.grid.geometry();
            prop_assert_eq!(geometry.check(), Ok(()));
            prop_assert_eq!(geometry.points(), scan.grid.samples().len());
        }
        Err(error) => {
            let sentence = error.to_string();
            prop_assert!(sentence.ends_with('.') && sentence.len() > 10, "{}", sentence);
        }
    }
    Ok(())
}

#[test]
fn every_truncation_of_every_kind_is_survived() {
    for (_, files) in all() {
        for which in 0..files.len().min(2) {
            for end in 0..files[which].1.len() {
                let mut cut = files.clone();
                cut[which].1.truncate(end);
                open_anything(&cut).unwrap();
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_never_panic(
        which in 0..all().len(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut in prop::option::weighted(0.2, any::<prop::sample::Index>()),
        doubled in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let (_, mut files) = all().swap_remove(which);
        let last = files.len() - 1;
        let bytes = &mut files[last].1;
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
        open_anything(&files)?;
    }

    #[test]
    fn damaged_headers_never_panic(
        which in 0..all().len(),
        file in any::<prop::sample::Index>(),
        damage in prop::collection::vec((0usize..600, "[-0-9.e]{1,12}"), 1..5),
    ) {
        let (_, mut files) = all().swap_remove(which);
        let file = file.index(files.len());
        let bytes = &mut files[file].1;
        for (at, digits) in damage {
            let places: Vec<usize> = (0..bytes.len().min(600)).filter(|&i| bytes[i].is_ascii_digit()).collect();
            if !places.is_empty() {
                let at = places[at % places.len()];
                bytes.splice(at..=at, digits.into_bytes());
            }
        }
        open_anything(&files)?;
    }

    #[test]
    fn damaged_dicom_never_panics(
        which in prop::sample::select(vec!["implicit", "explicit", "big-endian", "run lengths", "lossless JPEG", "JPEG-LS"]),
        at in prop::collection::vec((132usize..900, prop::sample::select(vec![0u8, 1, 2, 8, 0x0D, 0xE0, 0xFE, 0xFF, 0xDD])), 1..6),
    ) {
        let (_, mut files) = all().into_iter().find(|(what, _)| *what == which).unwrap();
        for (at, byte) in at {
            if let Some(target) = files[0].1.get_mut(at) {
                *target = byte;
            }
        }
        open_anything(&files)?;
    }

    #[test]
    fn random_bytes_never_panic(
        magic in prop::sample::select(vec![
            "NRRD0004\ntype: short\ndimension: 3\nsizes: 9 9 9\nencoding: raw\n\n",
            "ObjectType = Image\nDimSize = 9 9 9\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n",
            "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 9 0 9 0 9\"><PointData><DataArray type=\"Int8\">",
            "\x1f\u{8b}",
            "",
        ]),
        noise in prop::collection::vec(any::<u8>(), 0..900),
    ) {
        open_anything(&vec![("a", [magic.as_bytes(), &noise].concat())])?;
        let mut dicom = vec![0; 128];
        dicom.extend(b"DICM\x02\0\0\0UL\x04\0\0\0\0\0");
        dicom.extend(noise);
        open_anything(&vec![("a", dicom)])?;
    }
}
