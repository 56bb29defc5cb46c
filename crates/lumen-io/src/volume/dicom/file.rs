//! One file of DICOM: what it says about its slices, and where their pixels stand.
//!
//! DICOM PS3.5 (data structures and encoding) and PS3.10 (the file). The elements are walked by `dicom-parser`, on which
//! `dicom-object` stands, one by one and without their values: `dicom-object` itself keeps every element, the patient's name
//! among them, and fills as much memory as an element claims to be long. A value is looked at in the bytes of the file, if it
//! is one that is wanted and lies within them.

use std::io::Cursor;

use dicom_core::{Tag, VR};
use dicom_encoding::TransferSyntax;
use dicom_parser::dataset::LazyDataToken;
use dicom_parser::dataset::lazy_read::LazyDataSetReader;
use dicom_parser::stateful::decode::StatefulDecode;
use dicom_transfer_syntax_registry::entries;
use glam::DVec3;

use super::super::super::error::Feature;
use super::super::super::problem::DicomProblem;
use super::super::error::ScanError;

pub(super) const FORMAT: &str = "DICOM";

/// The file's own elements begin here, behind 128 bytes and "DICM".
const META: usize = 132;
/// Sequences in sequences are followed so deep.
const DEEPEST: usize = 32;

const TRANSFER_SYNTAX: Tag = Tag(0x0002, 0x0010);
const MODALITY: Tag = Tag(0x0008, 0x0060);
const THICKNESS: Tag = Tag(0x0018, 0x0050);
const BETWEEN: Tag = Tag(0x0018, 0x0088);
const SERIES: Tag = Tag(0x0020, 0x000E);
const INSTANCE: Tag = Tag(0x0020, 0x0013);
const POSITION: Tag = Tag(0x0020, 0x0032);
const ORIENTATION: Tag = Tag(0x0020, 0x0037);
const SAMPLES: Tag = Tag(0x0028, 0x0002);
const PHOTOMETRIC: Tag = Tag(0x0028, 0x0004);
const FRAMES: Tag = Tag(0x0028, 0x0008);
const ROWS: Tag = Tag(0x0028, 0x0010);
const COLUMNS: Tag = Tag(0x0028, 0x0011);
const SPACING: Tag = Tag(0x0028, 0x0030);
const ALLOCATED: Tag = Tag(0x0028, 0x0100);
const STORED: Tag = Tag(0x0028, 0x0101);
const SIGNED: Tag = Tag(0x0028, 0x0103);
const INTERCEPT: Tag = Tag(0x0028, 0x1052);
const SLOPE: Tag = Tag(0x0028, 0x1053);
const SHARED_GROUPS: Tag = Tag(0x5200, 0x9229);
const FRAME_GROUPS: Tag = Tag(0x5200, 0x9230);
const PIXELS: Tag = Tag(0x7FE0, 0x0010);

/// How pixels are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Little,
    Big,
    Rle,
    Jpeg,
}

/// What a file says; zeros and `None` where it does not.
#[derive(Clone, Debug, Default)]
pub(super) struct File<'a> {
    pub(super) packing: Option<Packing>,
    pub(super) modality: String,
    /// The series' number in the whole world, to tell it from others.
    pub(super) series: String,
    pub(super) instance: f64,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) frames: usize,
    pub(super) samples_per_pixel: u16,
    pub(super) is_monochrome: bool,
    pub(super) bits_allocated: u16,
    pub(super) bits_stored: u16,
    pub(super) is_signed: bool,
    pub(super) slope: Option<f64>,
    pub(super) intercept: Option<f64>,
    /// The centre of the first pixel of each frame in mm.
    pub(super) positions: Vec<DVec3>,
    /// The directions in which columns and rows are counted.
    pub(super) orientation: Option<[DVec3; 2]>,
    /// Distance between rows, and between columns.
    pub(super) spacing: Option<[f64; 2]>,
    /// Distance between slices, or their thickness.
    pub(super) between: Option<f64>,
    thickness: Option<f64>,
    /// The pixels, or the fragments that they are packed into.
    pub(super) pixels: Vec<&'a [u8]>,
}

impl<'a> File<'a> {
    /// Walks through a file.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, ScanError> {
        let mut file = Self { frames: 1, samples_per_pixel: 1, ..Self::default() };
        // The first element says how long the others of its group are.
        let length = bytes.get(META + 8..META + 12).and_then(|length| length.first_chunk().copied());
        let length = length.map_or(0, u32::from_le_bytes) as usize;
        let start = META + 12 + length;
        let (Some(meta), Some(rest)) = (bytes.get(META..start), bytes.get(start..)) else {
            return Err(ScanError::malformed(FORMAT, DicomProblem::Header));
        };
        let mut syntax = String::new();
        walk(meta, &entries::EXPLICIT_VR_LITTLE_ENDIAN.erased(), |_, tag, value| {
            if tag == TRANSFER_SYNTAX {
                syntax = text(value);
            }
        })?;
        let (packing, encoding) = packing(&syntax)?;
        file.packing = Some(packing);
        let is_big_endian = packing == Packing::Big;
        walk(rest, &encoding, |groups, tag, value| file.take(groups, tag, value, is_big_endian))?;
        file.between = file.between.or(file.thickness);
        Ok(file)
    }

    /// Takes what an element says, which stands in the file itself or in the `groups` of its frames.
    fn take(&mut self, groups: Option<Tag>, tag: Tag, value: &'a [u8], is_big_endian: bool) {
        let short = || {
            let word = value.first_chunk().copied().unwrap_or_default();
            if is_big_endian { u16::from_be_bytes(word) } else { u16::from_le_bytes(word) }
        };
        match tag {
            POSITION => self.positions.extend(decimals(value).map(DVec3::from)),
            ORIENTATION => {
                let six = decimals::<6>(value).map(|[a, b, c, d, e, f]| [DVec3::new(a, b, c), DVec3::new(d, e, f)]);
                self.orientation = self.orientation.or(six);
            }
            SPACING => self.spacing = self.spacing.or(decimals(value)),
            BETWEEN => self.between = self.between.or(decimal(value)),
            THICKNESS => self.thickness = self.thickness.or(decimal(value)),
            SLOPE => self.slope = self.slope.or(decimal(value)),
            INTERCEPT => self.intercept = self.intercept.or(decimal(value)),
            _ if groups.is_some() => {}
            MODALITY => self.modality = text(value),
            SERIES => self.series = text(value),
            INSTANCE => self.instance = decimal(value).unwrap_or_default(),
            SAMPLES => self.samples_per_pixel = short(),
            PHOTOMETRIC => self.is_monochrome = value.starts_with(b"MONOCHROME"),
            FRAMES => self.frames = decimal(value).map_or(1, |frames| frames as usize).max(1),
            ROWS => self.rows = short().into(),
            COLUMNS => self.columns = short().into(),
            ALLOCATED => self.bits_allocated = short(),
            STORED => self.bits_stored = short(),
            SIGNED => self.is_signed = short() == 1,
            PIXELS => self.pixels.push(value),
            _ => {}
        }
    }
}

/// How the pixels of a transfer syntax are packed, and how its elements are encoded.
fn packing(syntax: &str) -> Result<(Packing, TransferSyntax), ScanError> {
    let explicit = entries::EXPLICIT_VR_LITTLE_ENDIAN.erased();
    let refused = |what: Feature| Err(ScanError::unsupported(FORMAT, what));
    match syntax.strip_prefix("1.2.840.10008.1.2").unwrap_or("?") {
        "" => Ok((Packing::Little, entries::IMPLICIT_VR_LITTLE_ENDIAN.erased())),
        ".1" => Ok((Packing::Little, explicit)),
        ".2" => Ok((Packing::Big, entries::EXPLICIT_VR_BIG_ENDIAN.erased())),
        ".5" => Ok((Packing::Rle, explicit)),
        ".4.50" | ".4.51" | ".4.57" | ".4.70" => Ok((Packing::Jpeg, explicit)),
        ".1.99" => refused(Feature::Deflated),
        ".4.80" | ".4.81" => refused(Feature::JpegLs),
        ".4.90" | ".4.91" | ".4.201" | ".4.202" | ".4.203" => refused(Feature::Jpeg2000),
        _ => refused(Feature::UnknownCompression),
    }
}

/// Hands each value that lies in a data set itself, or in the groups of its frames, to `take`: in which groups, its tag, and
/// its bytes; the fragments of packed pixels one by one, their table of offsets left out.
fn walk<'a>(
    bytes: &'a [u8],
    encoding: &TransferSyntax,
    mut take: impl FnMut(Option<Tag>, Tag, &'a [u8]),
) -> Result<(), ScanError> {
    let broken = || ScanError::malformed(FORMAT, DicomProblem::Damaged);
    let mut reader = LazyDataSetReader::new_with_ts(Cursor::new(bytes), encoding).map_err(|_| broken())?;
    // The sequences that are open, and the items in them.
    let mut open: Vec<Option<Tag>> = Vec::new();
    // Items of the pixels so far; the first is a table of offsets, often empty.
    let mut items = 0;
    while let Some(token) = reader.advance() {
        match token.map_err(|_| broken())? {
            LazyDataToken::SequenceStart { tag, .. } => open.push(Some(tag)),
            LazyDataToken::PixelSequenceStart => open.push(Some(PIXELS)),
            LazyDataToken::ItemStart { .. } => {
                items += usize::from(open == [Some(PIXELS)]);
                open.push(None);
            }
            // The reader panics at what follows an end that nothing began.
            LazyDataToken::SequenceEnd | LazyDataToken::ItemEnd if open.pop().is_none() => return Err(broken()),
            LazyDataToken::LazyValue { header, decoder } => {
                let value = value(bytes, decoder.position(), header.len.0).ok_or_else(cut_short)?;
                decoder.skip_bytes(header.len.0).map_err(|_| broken())?;
                let groups = open.first().copied().flatten();
                if groups.is_none() || (matches!(groups, Some(SHARED_GROUPS | FRAME_GROUPS)) && header.vr != VR::SQ) {
                    take(groups, header.tag, value);
                }
            }
            LazyDataToken::LazyItemValue { len, decoder } => {
                let value = value(bytes, decoder.position(), len).ok_or_else(cut_short)?;
                decoder.skip_bytes(len).map_err(|_| broken())?;
                if items > 1 && open.first() == Some(&Some(PIXELS)) {
                    take(None, PIXELS, value);
                }
            }
            _ => {}
        }
        if open.len() > DEEPEST {
            return Err(broken());
        }
    }
    Ok(())
}

fn cut_short() -> ScanError {
    ScanError::malformed(FORMAT, DicomProblem::CutShort)
}

/// The bytes of a value, if they are all there.
fn value(bytes: &[u8], position: u64, length: u32) -> Option<&[u8]> {
    let start = usize::try_from(position).ok()?;
    bytes.get(start..start.checked_add(length as usize)?)
}

/// A value of letters, without its padding.
fn text(value: &[u8]) -> String {
    let end = value.iter().rposition(|byte| !matches!(byte, 0 | b' ')).map_or(0, |last| last + 1);
    String::from_utf8_lossy(&value[..end.min(64)]).into_owned()
}

/// The first of some decimal numbers.
fn decimal(value: &[u8]) -> Option<f64> {
    let first = value.split(|&byte| byte == b'\\').next()?;
    number(first)
}

/// `N` decimal numbers; `None` where there are not as many, or more.
fn decimals<const N: usize>(value: &[u8]) -> Option<[f64; N]> {
    let mut words = value.split(|&byte| byte == b'\\');
    let mut found = [0.0; N];
    for number in &mut found {
        *number = self::number(words.next()?)?;
    }
    words.next().is_none().then_some(found)
}

fn number(word: &[u8]) -> Option<f64> {
    let word = std::str::from_utf8(word).ok()?.trim_matches(|c: char| c == '\0' || c.is_ascii_whitespace());
    word.parse().ok().filter(|number: &f64| number.is_finite())
}
