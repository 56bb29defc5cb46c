//! Series of DICOM: every packing, any order, and what is said of series that are mixed or have gaps.

mod segments;
mod volumes;

use std::io::Read as _;

use flate2::Compression;
use flate2::read::DeflateEncoder;
use lumen::io::volume::{Part, Scan, ScanError, read_volume};
use lumen::io::{VolumeField, in_english};

use crate::jpeg::{flat, lossless};
use crate::samples::{ORIGIN, SIZE, STEPS, assert_is_it, label_name, points, value};
use crate::{Files, open};

const IMPLICIT: &str = "1.2.840.10008.1.2";
const EXPLICIT: &str = "1.2.840.10008.1.2.1";
const BIG: &str = "1.2.840.10008.1.2.2";
const DEFLATED: &str = "1.2.840.10008.1.2.1.99";
const RLE: &str = "1.2.840.10008.1.2.5";
const BASELINE: &str = "1.2.840.10008.1.2.4.50";
const JPEG_2000: &str = "1.2.840.10008.1.2.4.90";
const JPEG_LS: &str = "1.2.840.10008.1.2.4.80";
const LOSSLESS: &str = "1.2.840.10008.1.2.4.70";
const NEAR_LOSSLESS: &str = "1.2.840.10008.1.2.4.81";

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
            JPEG_LS => Some(vec![Vec::new(), jpeg_ls(k)]),
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

    /// The same with an element more.
    fn also(mut self, group: u16, number: u16, kind: &'static str, bytes: Vec<u8>) -> Self {
        let at = self.elements.iter().position(|element| (element.0, element.1) > (group, number)).unwrap();
        self.elements.insert(at, (group, number, kind, bytes));
        self
    }

    /// The same without an element.
    fn without(mut self, group: u16, number: u16) -> Self {
        self.elements.retain(|element| (element.0, element.1) != (group, number));
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

/// Bytes by their hexadecimal digits.
fn hexadecimal(digits: &str) -> Vec<u8> {
    (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(&digits[at..at + 2], 16).unwrap()).collect()
}

/// The picture of slice `k`, packed by CharLS (pyjpegls 1.5.1); slices differ in their first pixel.
fn jpeg_ls(k: usize) -> Vec<u8> {
    let first = ["d46", "ed6", "f95", "e05"][k];
    hexadecimal(&format!(
        "ffd8fff7000b0c0005000601011100ffda0008010100000000000000001{first}87061863a224282089a21084216688888324444400ffd9"
    ))
}

const NAMES: [&str; 4] = ["c", "a", "d", "b"];

/// The slices of the volume in an order that is not theirs.
fn series(syntax: &'static str) -> Files {
    [2, 0, 3, 1].into_iter().zip(NAMES).map(|(k, name)| (name, File::slice(syntax, k).bytes())).collect()
}

/// Every packing.
pub(crate) fn all() -> Vec<(&'static str, Files)> {
    let ways = [("implicit", IMPLICIT), ("explicit", EXPLICIT), ("big-endian", BIG), ("run lengths", RLE)];
    let ways = ways.into_iter().chain([("lossless JPEG", LOSSLESS), ("JPEG-LS", JPEG_LS)]);
    let mut all: Vec<_> = ways.map(|(what, syntax)| (what, series(syntax))).collect();
    // The length of the file's own elements is left out or wrong, or they are not there at all.
    let changed = |syntax, change: fn(&mut Vec<u8>)| {
        let mut files = series(syntax);
        files.iter_mut().for_each(|(_, bytes)| change(bytes));
        files
    };
    all.push(("without a length", changed(EXPLICIT, |bytes| drop(bytes.drain(132..144)))));
    all.push(("with a wrong length", changed(EXPLICIT, |bytes| bytes[140..144].copy_from_slice(&[5, 1, 0, 0]))));
    for syntax in [EXPLICIT, IMPLICIT] {
        let own = 144 + element(0x0002, 0x0010, "UI", &padded(syntax.as_bytes().to_vec()), EXPLICIT).len();
        let mut files = series(syntax);
        files.iter_mut().for_each(|(_, bytes)| drop(bytes.drain(..own)));
        all.push(("without what it says of itself", files));
    }
    let named = format!("{IMPLICIT}\0\0\0");
    let mut files = series(EXPLICIT);
    files.iter_mut().for_each(|(_, bytes)| bytes[152..172].copy_from_slice(&named.as_bytes()[..20]));
    all.push(("with the name of another way to write elements", files));
    let own = |syntax| File { syntax, elements: Vec::new(), fragments: None }.bytes();
    let behind = |own: Vec<u8>, data: Vec<u8>| [own, data].concat();
    all.push((
        "deflated",
        (0..4)
            .map(|k| {
                let data = File::slice(EXPLICIT, k).bytes().split_off(own(EXPLICIT).len());
                let mut packed = Vec::new();
                DeflateEncoder::new(&*data, Compression::best()).read_to_end(&mut packed).unwrap();
                (NAMES[k], behind(own(DEFLATED), packed))
            })
            .collect(),
    ));
    // A sequence of a kind that its writer did not know and without a length: implicit elements in one of its items, and a
    // sequence in the other.
    let (open_item, end_item) =
        ([0xFE, 0xFF, 0x00, 0xE0, 0xFF, 0xFF, 0xFF, 0xFF], [0xFE, 0xFF, 0x0D, 0xE0, 0, 0, 0, 0]);
    let end = [0xFE, 0xFF, 0xDD, 0xE0, 0, 0, 0, 0];
    let inner = element(0x0020, 0x0037, "DS", &text("1\\0\\0\\0\\1\\0"), IMPLICIT);
    let nested = [&[0x29, 0, 0x20, 0x10, 0xFF, 0xFF, 0xFF, 0xFF][..], &open_item, &inner, &end_item, &end].concat();
    let unknown = [
        &[0x29, 0, 0x10, 0x10, b'U', b'N', 0, 0, 0xFF, 0xFF, 0xFF, 0xFF][..],
        &item(&inner),
        &open_item,
        &nested,
        &end_item,
        &end,
    ]
    .concat();
    let mut files = series(EXPLICIT);
    for (_, bytes) in &mut files {
        let at = bytes.windows(4).position(|tag| tag == [0x40, 0, 0x75, 0x02]).unwrap();
        bytes.splice(at..at, unknown.iter().copied());
    }
    all.push(("a sequence of an unknown kind", files));
    all
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

/// A ramp of `8 i + j` in 32 x 32 pixels, and the same less 1000 in signed numbers, packed by OpenJPEG 2.5.
const RAMPS: [&str; 2] = [
    "ff4fff510029000000000020000000200000000000000000000000200000002000000000000000000001080101ff52000c00000001000504040001\
     ff5c00134048505058505058505058505058505058ff640025000143726561746564206279204f70656e4a5045472076657273696f6e20322e352e\
     32ff90000a0000000000570001ff93cfc00805a7c7e00503e704045f043fc3ed0380f901800d02050b3d7fc1f502c03e10c0221a085d8f037fbfc0\
     f9c3c01d0c36a199ae63a35f3da633c07c816004605fa7c788b79dac29ffd9",
    "ff4fff5100290000000000200000002000000000000000000000002000000020000000000000000000018a0101ff52000c00000001000504040001\
     ff5c00134058606068606068606068606068606068ff640025000143726561746564206279204f70656e4a5045472076657273696f6e20322e352e\
     32ff90000a0000000000590001ff93cfd8080969c1f801403e7040045f043fc0fb40e00f90180d02050b3d7fc07d40b003e10c221a085d8f037fbf\
     c03e70f001d0c036a199ae63a35f3da633c01f205800465fa7c788b79dac29ffd9",
];

fn ramp(signed: usize, k: usize) -> File {
    let mut slice =
        File::slice(JPEG_2000, k).with(0x0028, 0x0103, short(signed as u16)).with(0x0028, 0x0101, short(16));
    slice = slice.with(0x0028, 0x0010, short(32)).with(0x0028, 0x0011, short(32));
    slice.fragments = Some(vec![Vec::new(), padded(hexadecimal(RAMPS[signed]))]);
    slice
}

#[test]
fn jpeg_2000_is_read() {
    for (signed, less) in [0.0, 1000.0].into_iter().enumerate() {
        let scan = open(&[0, 1].map(|k| (NAMES[k], ramp(signed, k).bytes()))).unwrap();
        for (i, j) in [(0, 0), (31, 0), (0, 31), (17, 9)] {
            assert_eq!(scan.grid.value([i, j, 1]), 0.5 * ((8 * i + j) as f64 - less) - 1000.0, "{signed}");
        }
        let cut = |k: usize| {
            let mut slice = ramp(signed, k);
            slice.fragments.as_mut().unwrap()[1].truncate(60);
            (NAMES[k], slice.bytes())
        };
        assert!(open(&[0, 1].map(cut)).is_err());
    }
}

/// What is announced in the first words of a picture would take much memory before the picture is found to be damaged.
#[test]
fn jpeg_2000_of_many_tiles_or_components_is_refused_without_room_for_them() {
    let changed = |side: u32, at: usize, words: &[u8]| {
        let mut slice = ramp(0, 0).with(0x0028, 0x0010, short(side as u16)).with(0x0028, 0x0011, short(side as u16));
        let picture = &mut slice.fragments.as_mut().unwrap()[1];
        picture[8..16].copy_from_slice(&[side.to_be_bytes(), side.to_be_bytes()].concat());
        picture[at..at + words.len()].copy_from_slice(words);
        slice
    };
    let one = 1u32.to_be_bytes();
    // Tiles of one pixel, and of none; 255 components; a picture that is wider than the file says.
    let tiny = changed(2000, 24, &[one, one].concat());
    let broken = [tiny, changed(32, 24, &[0; 8]), changed(32, 40, &[0, 255]), changed(32, 8, &[0xFF; 4])];
    for (n, slice) in broken.into_iter().enumerate() {
        let _alone = crate::alone();
        let (result, taken) = crate::open_measured(&[("a", slice.bytes())]);
        let refused = result.unwrap_err().to_string();
        assert!(refused.contains("JPEG picture") && taken < 1_000_000, "{n}: {refused} {taken}");
    }
}

/// Two slices that are this JPEG-LS picture, of so many columns and rows.
fn two_of(picture: &[u8], [columns, rows]: [u16; 2]) -> Result<Scan, ScanError> {
    let slice = |k: usize| {
        let mut slice =
            File::slice(NEAR_LOSSLESS, k).with(0x0028, 0x0010, short(rows)).with(0x0028, 0x0011, short(columns));
        slice.fragments = Some(vec![Vec::new(), padded(picture.to_vec())]);
        (NAMES[k], slice.bytes())
    };
    open(&[0, 1].map(slice))
}

/// The stored number of a pixel in the first slice.
fn stored(scan: &Scan, column: usize, row: usize) -> f64 {
    2.0 * (scan.grid.value([column, row, 0]) + 1000.0)
}

/// The example of the standard (ITU-T T.87, annex H.3), its thresholds left out or said; and what is cut, of several
/// components, of another size, or of a wrong kind.
#[test]
fn jpeg_ls_of_the_standard_is_read() {
    const PIXELS: [u8; 16] = [0, 0, 90, 74, 68, 50, 43, 205, 64, 145, 145, 145, 100, 145, 145, 145];
    let [frame, thresholds, scan] = [
        "ffd8fff7000b080004000401011100",
        "fff8000d0100ff0003000700150040",
        "ffda0008010100000000c000006c80208e01c00000574000006ee6000001bc18000005d800009160ffd9",
    ]
    .map(hexadecimal);
    let short = [&*frame, &scan].concat();
    for picture in [&short, &[&*frame, &thresholds, &scan].concat()] {
        let scan = two_of(picture, [4, 4]).unwrap();
        for (at, pixel) in PIXELS.into_iter().enumerate() {
            assert_eq!(stored(&scan, at % 4, at / 4), f64::from(pixel), "{at}");
        }
    }
    let changed = |at: usize, byte: u8| {
        let mut picture = short.clone();
        picture[at] = byte;
        picture
    };
    // Cut; three components; by half of the largest number and more; interleaved; all zeros, which no encoder writes.
    let zeros = [&short[..25], &[0; 40]].concat();
    for damaged in [short[..45].to_vec(), changed(11, 3), changed(22, 128), changed(23, 1), zeros] {
        let refused = two_of(&damaged, [4, 4]).unwrap_err().to_string();
        assert!(refused.contains("the JPEG picture of a slice is damaged"), "{refused}");
    }
    let refused = two_of(&short, [5, 4]).unwrap_err().to_string();
    assert!(refused.contains("is not of the size that the file says"), "{refused}");
}

/// A disc of 12 bits, each pixel off by 4 at most, as CharLS (pyjpegls 1.5.1) packs it and takes it apart again.
#[test]
fn near_lossless_jpeg_ls_is_read() {
    const DISC: &str = "ffd8fff7000b0c0010001801011100ffda00080101000400000000000d9d2aaa93f4fc54c54e8374d837486a850cebd00056600000000074f6bd\
         4cda600000000001d7c6440000000001d250000000001d0c0c408a4bd2060000000007633a6b4814600000053d6da0000000003afa928b980000000007\
         4000000049c304acd484ab548040434570500063234d7c00000000073c00000000073cc1ec814e964cf416f196775aabb95c5b45045020ccd3d3100603\
         eadce000000000743b60e7cf1497104c41cd4000000000e9e6feffd9";
    const MIDDLE: [u16; 24] = [
        1004, 1004, 1005, 1005, 1005, 996, 2958, 2965, 2948, 2940, 2942, 2931, 2913, 2914, 2908, 2893, 2891, 2884,
        2880, 996, 1006, 1003, 1003, 1003,
    ];
    let scan = two_of(&hexadecimal(DISC), [24, 16]).unwrap();
    assert_eq!((0..24).map(|i| stored(&scan, i, 8)).collect::<Vec<_>>(), MIDDLE.map(f64::from));
    let all = (0..16).flat_map(|j| (0..24).map(move |i| (i, j)));
    assert_eq!(all.map(|(i, j)| stored(&scan, i, j)).sum::<f64>(), 617_233.0);
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

/// As many fragments to a frame as a writer likes: the table of offsets says where frames begin, or each begins a picture.
#[test]
fn frames_of_several_fragments_are_put_together() {
    for is_told in [true, false] {
        let mut file = File::slice(LOSSLESS, 0).with(0x0018, 0x0050, text("2"));
        file.elements.insert(9, (0x0028, 0x0008, "IS", text("4")));
        let (mut offsets, mut fragments, mut at) = (Vec::new(), Vec::new(), 0u32);
        for k in 0..4 {
            offsets.extend(at.to_le_bytes());
            // Two fragments, but for the last frame.
            let parts = File::slice(LOSSLESS, k).fragments.unwrap().split_off(1);
            let parts = if k == 3 { vec![parts.concat()] } else { parts };
            at += parts.iter().map(|part| 8 + part.len() as u32).sum::<u32>();
            fragments.extend(parts);
        }
        fragments.insert(0, if is_told { offsets } else { Vec::new() });
        file.fragments = Some(fragments);
        assert_is_it(&open(&[("a", file.bytes())]).unwrap(), "frames of several fragments");
    }
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
            "The files hold 3 series. The volume with most slices (4) is opened. Slices of 2 other series left out: 2.",
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

/// The place of slice `k`, farther up by so many mm.
fn place(k: usize, up: f64) -> Vec<u8> {
    text(&format!("-10\\20\\{}", 300.0 + 2.0 * k as f64 + up))
}

fn open_volume(files: &Files, choice: Option<usize>) -> Result<Scan, ScanError> {
    let parts: Vec<Part> = files.iter().map(|(name, bytes)| Part { name, bytes }).collect();
    read_volume(&parts, choice)
}

/// An item of the groups of frames: what is said of a frame, each in a group of its own.
fn groups(said: &[(u16, u16, &'static str, u16, u16, &str)]) -> Vec<u8> {
    let group = |&(group, number, kind, of, in_group, words): &(u16, u16, &'static str, u16, u16, &str)| {
        let value = if kind == "US" { short(words.parse().unwrap()) } else { text(words) };
        element(group, number, "SQ", &item(&element(of, in_group, kind, &value, EXPLICIT)), EXPLICIT)
    };
    item(&said.iter().flat_map(group).collect::<Vec<_>>())
}

/// A file of all slices as frames, in an order that is not theirs, without what it says of them itself.
fn frames(order: &[usize], shared: Vec<u8>, each: Vec<u8>, pixels: Vec<u8>) -> File {
    let own =
        [(0x0018, 0x0050), (0x0020, 0x0032), (0x0020, 0x0037), (0x0028, 0x0030), (0x0028, 0x1052), (0x0028, 0x1053)];
    let file = own.into_iter().fold(File::slice(EXPLICIT, 0), |file, (group, number)| file.without(group, number));
    file.with(0x7FE0, 0x0010, pixels)
        .also(0x0028, 0x0008, "IS", text(&order.len().to_string()))
        .also(0x5200, 0x9229, "SQ", shared)
        .also(0x5200, 0x9230, "SQ", each)
}

const ORIENTED: (u16, u16, &str, u16, u16, &str) = (0x0020, 0x9116, "DS", 0x0020, 0x0037, "0.6\\0.8\\0\\-0.8\\0.6\\0");
const SPACED: (u16, u16, &str, u16, u16, &str) = (0x0028, 0x9110, "DS", 0x0028, 0x0030, "0.75\\0.5");

#[test]
fn frames_have_a_place_a_slope_and_a_volume_of_their_own() {
    let order = [2, 0, 3, 1];
    let stored = |k: usize, slope: i32, intercept: i32| {
        let of_slice = points().filter(move |point| point[2] == k);
        of_slice.flat_map(move |point| (((i32::from(value(point)) - intercept) / slope) as i16).to_le_bytes())
    };
    let each = order.iter().flat_map(|&k| {
        let (at, intercept) = (String::from_utf8(place(k, 0.0)).unwrap(), (-1000 - 7 * k as i32).to_string());
        groups(&[
            (0x0020, 0x9113, "DS", 0x0020, 0x0032, at.trim()),
            (0x0028, 0x9145, "DS", 0x0028, 0x1052, intercept.as_str()),
            // What a maker repeats, in a place of its own.
            (0x2005, 0x140F, "DS", 0x0020, 0x0032, "1\\2\\3"),
            (0x2005, 0x140E, "DS", 0x0028, 0x1053, "9"),
        ])
    });
    let pixels = order.iter().flat_map(|&k| stored(k, 1, -1000 - 7 * k as i32)).collect();
    let file = frames(&order, groups(&[ORIENTED, SPACED]), each.collect(), pixels);
    let scan = open(&[("a", file.bytes())]).unwrap();
    assert_is_it(&scan, "frames");
    assert!(scan.warnings.is_empty(), "{:?}", scan.warnings);
    // Two times of each.
    let order = [2, 0, 3, 1, 1, 3, 0, 2];
    let each = order.iter().enumerate().flat_map(|(n, &k)| {
        let (at, time) = (String::from_utf8(place(k, 0.0)).unwrap(), (1 + n / 4).to_string());
        groups(&[
            (0x0020, 0x9111, "US", 0x0020, 0x9128, time.as_str()),
            (0x0020, 0x9113, "DS", 0x0020, 0x0032, at.trim()),
        ])
    });
    let pixels = order.iter().enumerate().flat_map(|(n, &k)| stored(k, 1, -1000 - 10 * (n / 4) as i32)).collect();
    let file = frames(
        &order,
        groups(&[ORIENTED, SPACED, (0x0028, 0x9145, "DS", 0x0028, 0x1052, "-1000")]),
        each.collect(),
        pixels,
    );
    let files = vec![("a", file.bytes())];
    assert_is_it(&open_volume(&files, None).unwrap(), "the first time");
    let second = open_volume(&files, Some(1)).unwrap();
    assert!(points().all(|point| second.grid.value(point) == f64::from(value(point)) + 10.0));
}

#[test]
fn pixels_of_32_bits_and_floats_are_read() {
    let wide = |k: usize, float: bool| {
        let values = points().filter(move |point| point[2] == k).map(value);
        let pixels: Vec<u8> = if float {
            values.flat_map(|value| (f32::from(value) + 0.5).to_le_bytes()).collect()
        } else {
            values.flat_map(|value| (100_000 * i32::from(value)).to_le_bytes()).collect()
        };
        let file = File::slice(EXPLICIT, k).with(0x0028, 0x0100, short(32)).with(0x0028, 0x0101, short(32));
        let file = file.with(0x0028, 0x0103, short(1)).with(0x0028, 0x1052, text(if float { "-0.5" } else { "0" }));
        let file = file.with(0x0028, 0x1053, text(if float { "1" } else { "0.00001" })).with(0x7FE0, 0x0010, pixels);
        let mut file = file;
        if float {
            file.elements.last_mut().unwrap().1 = 0x0008;
        }
        ("a", file.bytes())
    };
    for float in [false, true] {
        let scan = open(&(0..4).map(|k| wide(k, float)).collect::<Vec<_>>()).unwrap();
        assert!(points().all(|point| (scan.grid.value(point) - f64::from(value(point))).abs() < 1e-9), "{float}");
    }
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
        "The DICOM file cannot be opened as a scan: it does not say which way its slices lie."
    );
    assert_eq!(
        refused(|file| file.with(0x0020, 0x0032, Vec::new())),
        "The DICOM file cannot be opened as a scan: it does not say where its slices are."
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
        refused(|file| File { syntax: "1.2.840.10008.1.2.4.201", ..file }),
        "The DICOM file uses JPEG 2000 compression, which Lumen does not read."
    );
    assert_eq!(
        refused(|file| file.with(0x0028, 0x0002, short(3)).with(0x0028, 0x0004, text("RGB"))),
        "The DICOM file cannot be opened as a scan: its pictures are in colours, and a surface takes shades of grey."
    );
    let table = item(&element(0x0028, 0x3002, "US", &[0, 16, 0, 0, 16, 0], EXPLICIT));
    let tabled: Files = (0..3)
        .map(|k| (NAMES[k], File::slice(EXPLICIT, k).also(0x0028, 0x3000, "SQ", table.clone()).bytes()))
        .collect();
    assert_eq!(
        open(&tabled).unwrap_err().to_string(),
        "The DICOM file uses a table of values (modality LUT), which Lumen does not read."
    );
    let twelve = |file: File| File {
        syntax: BASELINE,
        fragments: Some(vec![Vec::new(), {
            let mut picture = padded(flat(200, 6, 5));
            let at = picture.windows(2).position(|two| two == [0xFF, 0xC0]).unwrap();
            (picture[at + 1], picture[at + 4]) = (0xC1, 12);
            picture
        }]),
        ..file
    };
    assert_eq!(refused(twelve), "The DICOM file uses JPEG pictures of 12 bits, which Lumen does not read.");
    let one = open(&series(EXPLICIT)[..1]).unwrap_err().to_string();
    assert_eq!(
        one,
        "The DICOM file cannot be opened as a scan: it holds a single slice, and a surface takes two or more."
    );
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
    // The same in a sequence, which ends with it, as far as the reader knows.
    let mut unfit = file.clone();
    let (sequence, end) =
        ([0x08, 0x00, 0x40, 0x11, b'S', b'Q', 0, 0, 0xFF, 0xFF, 0xFF, 0xFF], [0xFE, 0xFF, 0x0D, 0xE0]);
    unfit.splice(at..at, [&sequence[..], &end, &[0; 4], &[0xFE, 0xFF, 0x00, 0xE0, 8, 0, 0, 0]].concat());
    for broken in [long, stray, unfit] {
        let _alone = crate::alone();
        let (result, taken) = crate::open_measured(&[("a", broken)]);
        assert!(matches!(result, Err(ScanError::File(_))), "{result:?}");
        assert!(taken < 1_000_000, "{taken}");
    }
}
