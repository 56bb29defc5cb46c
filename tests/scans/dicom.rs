//! Series of DICOM: every packing, any order, and what is said of series that are mixed or have gaps.

use lumen::io::in_english;
use lumen::io::volume::ScanError;

use crate::jpeg::{flat, lossless};
use crate::samples::{ORIGIN, SIZE, STEPS, assert_is_it, value};
use crate::{Files, open};

const IMPLICIT: &str = "1.2.840.10008.1.2";
const EXPLICIT: &str = "1.2.840.10008.1.2.1";
const BIG: &str = "1.2.840.10008.1.2.2";
const RLE: &str = "1.2.840.10008.1.2.5";
const BASELINE: &str = "1.2.840.10008.1.2.4.50";
const LOSSLESS: &str = "1.2.840.10008.1.2.4.70";

/// The name that no reader may ever repeat.
const PATIENT: &str = "Roentgen^Anna Bertha";

/// A file of one slice, whose elements can be changed.
#[derive(Clone)]
pub(crate) struct File {
    syntax: &'static str,
    elements: Vec<(u16, u16, &'static str, Vec<u8>)>,
    fragments: Option<Vec<Vec<u8>>>,
}

fn short(n: u16) -> Vec<u8> {
    n.to_le_bytes().to_vec()
}

fn text(words: &str) -> Vec<u8> {
    let mut bytes = words.as_bytes().to_vec();
    if !bytes.len().is_multiple_of(2) {
        bytes.push(b' ');
    }
    bytes
}

impl File {
    /// Slice `k` of the volume of `samples`, stored as twice the value less a thousand.
    pub(crate) fn slice(syntax: &'static str, k: usize) -> Self {
        let place: Vec<String> = (0..3).map(|axis| (ORIGIN[axis] + k as f64 * STEPS[2][axis]).to_string()).collect();
        let stored = |point| (2 * (i32::from(value(point)) + 1000)) as u16;
        let points = (0..SIZE[1]).flat_map(|j| (0..SIZE[0]).map(move |i| [i, j, k]));
        let pixels: Vec<u16> = points.map(stored).collect();
        let plain: Vec<u8> = pixels.iter().flat_map(|pixel| pixel.to_le_bytes()).collect();
        let fragments = match syntax {
            RLE => Some(vec![Vec::new(), run_lengths(&pixels)]),
            // In two fragments.
            LOSSLESS => {
                let picture = padded(lossless(&pixels, SIZE[0]));
                let (first, rest) = picture.split_at(20);
                Some(vec![Vec::new(), first.to_vec(), rest.to_vec()])
            }
            _ => None,
        };
        let elements = vec![
            (0x0008, 0x0060, "CS", text("CT")),
            (0x0010, 0x0010, "PN", text(PATIENT)),
            (0x0018, 0x0050, "DS", text("5")),
            (0x0020, 0x000E, "UI", text("1.2.3.4")),
            (0x0020, 0x0013, "IS", text(&(k + 1).to_string())),
            (0x0020, 0x0032, "DS", text(&place.join("\\"))),
            (0x0020, 0x0037, "DS", text("0.6\\0.8\\0\\-0.8\\0.6\\0")),
            (0x0028, 0x0002, "US", short(1)),
            (0x0028, 0x0004, "CS", text("MONOCHROME2")),
            (0x0028, 0x0010, "US", short(SIZE[1] as u16)),
            (0x0028, 0x0011, "US", short(SIZE[0] as u16)),
            (0x0028, 0x0030, "DS", text("0.75\\0.5")),
            (0x0028, 0x0100, "US", short(16)),
            (0x0028, 0x0101, "US", short(12)),
            (0x0028, 0x0103, "US", short(0)),
            (0x0028, 0x1052, "DS", text("-1000")),
            (0x0028, 0x1053, "DS", text("0.5")),
            // A sequence with an item, of no use here: another orientation, which must not be taken for the slice's.
            (0x0040, 0x0275, "SQ", item(&element(0x0020, 0x0037, "DS", &text("1\\0\\0\\0\\1\\0"), EXPLICIT))),
            (0x7FE0, 0x0010, "OW", plain),
        ];
        Self { syntax, elements, fragments }
    }

    /// The same with another value of an element.
    pub(crate) fn with(mut self, group: u16, number: u16, bytes: Vec<u8>) -> Self {
        let element = self.elements.iter_mut().find(|element| (element.0, element.1) == (group, number)).unwrap();
        element.3 = bytes;
        self
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        let syntax = element(
            0x0002,
            0x0010,
            "UI",
            &text(self.syntax).iter().map(|&b| if b == b' ' { 0 } else { b }).collect::<Vec<u8>>(),
            EXPLICIT,
        );
        let mut file = vec![0; 128];
        file.extend(b"DICM");
        file.extend(element(0x0002, 0x0000, "UL", &(syntax.len() as u32).to_le_bytes(), EXPLICIT));
        file.extend(syntax);
        for (group, number, kind, value) in &self.elements {
            match (&self.fragments, *group) {
                (Some(fragments), 0x7FE0) => {
                    file.extend([0xE0, 0x7F, 0x10, 0x00, b'O', b'B', 0, 0, 0xFF, 0xFF, 0xFF, 0xFF]);
                    file.extend(fragments.iter().flat_map(|fragment| item(fragment)));
                    file.extend([0xFE, 0xFF, 0xDD, 0xE0, 0, 0, 0, 0]);
                }
                _ => file.extend(element(*group, *number, kind, value, self.syntax)),
            }
        }
        file
    }
}

/// An element as a transfer syntax encodes it.
fn element(group: u16, number: u16, kind: &str, value: &[u8], syntax: &str) -> Vec<u8> {
    let is_big = syntax == BIG;
    let order = |mut word: Vec<u8>| {
        if is_big {
            word.reverse();
        }
        word
    };
    let value = match kind {
        "US" | "OW" if is_big => value.as_chunks::<2>().0.iter().flat_map(|&[a, b]| [b, a]).collect(),
        // Of a sequence the length alone is kept where its items would have to be turned as well.
        "SQ" if is_big || syntax == IMPLICIT => Vec::new(),
        _ => value.to_vec(),
    };
    let mut out = [order(short(group)), order(short(number))].concat();
    let long = order((value.len() as u32).to_le_bytes().to_vec());
    match (syntax, kind) {
        (IMPLICIT, _) => out.extend(long),
        (_, "OB" | "OW" | "SQ" | "UN") => out.extend([kind.as_bytes(), &[0, 0], &long].concat()),
        _ => out.extend([kind.as_bytes(), &order(short(value.len() as u16))].concat()),
    }
    out.extend(value);
    out
}

fn item(bytes: &[u8]) -> Vec<u8> {
    [&[0xFE, 0xFF, 0x00, 0xE0][..], &(bytes.len() as u32).to_le_bytes(), bytes].concat()
}

fn padded(mut bytes: Vec<u8>) -> Vec<u8> {
    if !bytes.len().is_multiple_of(2) {
        bytes.push(0);
    }
    bytes
}

/// Run lengths of 16-bit pixels: their high bytes, as runs where there are some, then their low ones as they are.
fn run_lengths(pixels: &[u16]) -> Vec<u8> {
    let mut high = Vec::new();
    for run in pixels.chunk_by(|a, b| a >> 8 == b >> 8) {
        let byte = (run[0] >> 8) as u8;
        match run.len() {
            1 => high.extend([0, byte]),
            n => high.extend([(257 - n) as u8, byte]),
        }
    }
    // A byte that stands for nothing.
    high.push(0x80);
    let mut low = vec![pixels.len() as u8 - 1];
    low.extend(pixels.iter().map(|&pixel| pixel as u8));
    let mut header = vec![2, 64, 64 + high.len() as u32];
    header.resize(16, 0);
    padded([header.iter().flat_map(|word| word.to_le_bytes()).collect(), high, low].concat())
}

const NAMES: [&str; 4] = ["c", "a", "d", "b"];

/// The slices of the volume in an order that is not theirs.
fn series(syntax: &'static str) -> Files {
    [2, 0, 3, 1].into_iter().zip(NAMES).map(|(k, name)| (name, File::slice(syntax, k).bytes())).collect()
}

/// Every packing.
pub(crate) fn all() -> Vec<(&'static str, Files)> {
    let ways = [("implicit", IMPLICIT), ("explicit", EXPLICIT), ("big-endian", BIG), ("run lengths", RLE)];
    let ways = ways.into_iter().chain([("lossless JPEG", LOSSLESS)]);
    ways.map(|(what, syntax)| (what, series(syntax))).collect()
}

#[test]
fn values_are_hounsfield_units_and_nothing_names_the_patient() {
    for (what, files) in all() {
        let scan = open(&files).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(scan.is_ct && scan.warnings.is_empty(), "{what}: {:?}", scan.warnings);
        assert!(!format!("{scan:?}").contains("Roentgen"));
    }
}

#[test]
fn what_is_said_of_a_broken_series_does_not_name_the_patient() {
    let mut refused = 0;
    for (what, files) in all() {
        let longest = files.iter().map(|(_, bytes)| bytes.len()).max().unwrap();
        for length in (132..longest).step_by(7) {
            let cut: Files =
                files.iter().map(|(name, bytes)| (*name, bytes[..length.min(bytes.len())].to_vec())).collect();
            let said = match open(&cut) {
                Ok(scan) => in_english(&scan.warnings).join(" "),
                Err(error) => {
                    refused += 1;
                    format!("{error} {error:?}")
                }
            };
            assert!(!said.contains("Roentgen") && !said.contains("Bertha"), "{what}, {length} bytes: {said}");
        }
    }
    assert!(refused > 100, "{refused} broken series");
}

#[test]
fn baseline_pictures_are_read() {
    let slices = (0..2).map(|k| {
        let mut slice = File::slice(BASELINE, k)
            .with(0x0028, 0x0100, short(8))
            .with(0x0028, 0x0101, short(8))
            .with(0x0028, 0x0010, short(16))
            .with(0x0028, 0x0011, short(24));
        slice.fragments = Some(vec![Vec::new(), padded(flat(200 + k as u8, 24, 16))]);
        (NAMES[k], slice.bytes())
    });
    let scan = open(&slices.collect::<Vec<_>>()).unwrap();
    assert_eq!(scan.grid.geometry().size, [24, 16, 2]);
    assert_eq!([0, 1].map(|k| scan.grid.value([23, 15, k])), [0.5 * 200.0 - 1000.0, 0.5 * 201.0 - 1000.0]);
}

#[test]
fn frames_of_one_file_are_slices() {
    let one = File::slice(EXPLICIT, 0);
    let pixels = (0..4).flat_map(|k| File::slice(EXPLICIT, k).elements.pop().unwrap().3).collect();
    let mut file = one.with(0x7FE0, 0x0010, pixels).with(0x0018, 0x0050, text("2"));
    file.elements.insert(9, (0x0028, 0x0008, "IS", text("4")));
    let scan = open(&[("a", file.bytes())]).unwrap();
    assert_is_it(&scan, "four frames");
}

#[test]
fn signed_pixels_of_fewer_bits_are_extended() {
    let slices = (0..2).map(|k| {
        // -5 in twelve bits, with something of another's above them.
        let pixels = [0x7FFBu16; 30].iter().flat_map(|pixel| pixel.to_le_bytes()).collect();
        (NAMES[k], File::slice(EXPLICIT, k).with(0x0028, 0x0103, short(1)).with(0x7FE0, 0x0010, pixels).bytes())
    });
    let scan = open(&slices.collect::<Vec<_>>()).unwrap();
    assert_eq!(scan.grid.value([0, 0, 0]), 0.5 * -5.0 - 1000.0);
}

#[test]
fn slices_that_are_scaled_each_in_its_way_become_values() {
    let slices = (0..4).map(|k| {
        let slice = File::slice(EXPLICIT, k);
        let changed = if k == 2 {
            let pixels = slice.elements.last().unwrap().3.as_chunks::<2>().0.iter();
            let halved = pixels.flat_map(|&pixel| (u16::from_le_bytes(pixel) / 2).to_le_bytes()).collect();
            slice.with(0x7FE0, 0x0010, halved).with(0x0028, 0x1053, text("1"))
        } else {
            slice
        };
        (NAMES[k], changed.bytes())
    });
    assert_is_it(&open(&slices.collect::<Vec<_>>()).unwrap(), "scaled");
}

#[test]
fn the_series_of_most_slices_is_taken_and_the_rest_told_by_number() {
    let mut files = series(EXPLICIT);
    files.insert(1, ("scout", File::slice(EXPLICIT, 0).with(0x0020, 0x000E, text("1.2.3.5")).bytes()));
    files.insert(0, ("side", File::slice(EXPLICIT, 0).with(0x0020, 0x0037, text("0\\1\\0\\0\\0\\-1")).bytes()));
    files.push(("again", File::slice(EXPLICIT, 1).with(0x0020, 0x0013, text("9")).bytes()));
    files.push(("report", File::slice(EXPLICIT, 1).with(0x0028, 0x0004, text("RGB")).bytes()));
    let scan = open(&files).unwrap();
    assert_is_it(&scan, "mixed");
    assert_eq!(
        in_english(&scan.warnings),
        [
            "The files hold 3 series: the one with most slices, 5, is taken, and 2 of 2 others are left out.",
            "1 file holds no slice in shades of grey and is left out.",
            "1 slice is there twice: the same place and the same pixels; one is taken.",
        ]
    );
}

#[test]
fn files_that_cannot_be_read_are_left_out_and_counted() {
    let whole = series(EXPLICIT);
    let warnings = |extra: Vec<(&'static str, Vec<u8>)>| {
        let mut files = whole.clone();
        files.splice(1..1, extra);
        let scan = open(&files).unwrap();
        assert_is_it(&scan, "beside what cannot be read");
        in_english(&scan.warnings)
    };
    let cut = File::slice(EXPLICIT, 2).bytes()[..200].to_vec();
    let short_of_pixels = File::slice(EXPLICIT, 4).with(0x7FE0, 0x0010, vec![0; 58]).bytes();
    let nowhere = File::slice(EXPLICIT, 5).with(0x0020, 0x0032, Vec::new()).bytes();
    let few = "The DICOM file is broken: a slice has fewer pixels than rows times columns.";
    assert_eq!(
        warnings(vec![("x", short_of_pixels.clone())]),
        [format!("One slice cannot be read and is left out. {few}")]
    );
    let several = warnings(vec![("x", cut.clone()), ("y", short_of_pixels), ("z", nowhere)]);
    assert!(
        several.len() == 1 && several[0].starts_with("3 slices cannot be read and are left out. The"),
        "{several:?}"
    );
    assert!(open(&[("x", cut)]).is_err(), "nothing is left");
}

#[test]
fn gaps_are_told() {
    let files: Files = (0..4).map(|k| (NAMES[k], File::slice(EXPLICIT, if k == 3 { 4 } else { k }).bytes())).collect();
    let scan = open(&files).unwrap();
    assert_eq!(
        in_english(&scan.warnings),
        [
            "The slices are not evenly apart: mostly 2.000 mm, but 4.000 mm between slices 3 and 4; some may be missing, and \
         the surface is stretched there.",
        ]
    );
}

#[test]
fn what_no_volume_can_be_made_of_is_refused() {
    let refused = |change: fn(File) -> File| {
        let files: Files = (0..3).map(|k| (NAMES[k], change(File::slice(EXPLICIT, k)).bytes())).collect();
        open(&files).unwrap_err().to_string()
    };
    assert_eq!(
        refused(|file| file.with(0x0020, 0x0037, Vec::new())),
        "The DICOM file is broken: it does not say which way its slices lie."
    );
    assert_eq!(
        refused(|file| file.with(0x0020, 0x0032, Vec::new())),
        "The DICOM file is broken: it does not say where its slices are."
    );
    assert_eq!(
        refused(|file| file.with(0x7FE0, 0x0010, vec![0; 58])),
        "The DICOM file is broken: a slice has fewer pixels than rows times columns."
    );
    assert_eq!(
        refused(|file| file.with(0x0028, 0x0100, short(12))),
        "The DICOM file uses 12 bits a pixel, which Lumen does not read."
    );
    assert_eq!(
        refused(|file| File { syntax: "1.2.840.10008.1.2.4.90", ..file }),
        "The DICOM file uses JPEG 2000 compression, which Lumen does not read."
    );
    let one = open(&series(EXPLICIT)[..1]).unwrap_err().to_string();
    assert_eq!(one, "The DICOM file is broken: it holds a single slice, and a surface takes two or more.");
    // Pictures and runs that are smaller than the file says.
    for syntax in [RLE, LOSSLESS] {
        let files: Files =
            (0..2).map(|k| (NAMES[k], File::slice(syntax, k).with(0x0028, 0x0010, short(7)).bytes())).collect();
        assert!(matches!(open(&files), Err(ScanError::File(_))), "{syntax}");
    }
}

/// Elements that claim to be long, and an end of an item that nothing began, which `dicom-parser` panics after.
#[test]
fn claims_and_stray_ends_are_refused() {
    let file = File::slice(EXPLICIT, 0).bytes();
    let at = file.windows(4).position(|four| four == [0x10, 0x00, 0x10, 0x00]).unwrap();
    let mut long = file.clone();
    long.splice(at + 4..at + 8, [b'U', b'T', 0, 0, 0xF0, 0xFF, 0xFF, 0xFF]);
    let mut stray = file.clone();
    stray.splice(at..at, [0xFE, 0xFF, 0x0D, 0xE0, 0, 0, 0, 0, 0xFE, 0xFF, 0x00, 0xE0, 8, 0, 0, 0]);
    for broken in [long, stray] {
        let _alone = crate::alone();
        let (result, taken) = crate::open_measured(&[("a", broken)]);
        assert!(matches!(result, Err(ScanError::File(_))), "{result:?}");
        assert!(taken < 1_000_000, "{taken}");
    }
}
