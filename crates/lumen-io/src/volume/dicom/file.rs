//! One file of DICOM: what it says about its slices, and where their pixels stand.
//!
//! DICOM PS3.5 (data structures and encoding), PS3.10 (the file) and PS3.3 C.7.6.16 (what is said of each frame). The elements
//! are walked by `dicom-parser`, on which `dicom-object` stands, one by one and without their values: `dicom-object` itself
//! keeps every element, the patient's name among them, and fills as much memory as an element claims to be long. A value is
//! looked at in the bytes of the file, if it is one that is wanted and lies within them.
//!
//! The file's own elements are read by hand: many writers leave out their length, or get it wrong, or leave them out altogether.

use std::borrow::Cow;
use std::io::{Cursor, Read as _};

use dicom_core::{Tag, VR};
use dicom_encoding::TransferSyntax;
use dicom_parser::dataset::LazyDataToken;
use dicom_parser::dataset::lazy_read::LazyDataSetReader;
use dicom_parser::stateful::decode::StatefulDecode;
use dicom_transfer_syntax_registry::entries;
use flate2::read::DeflateDecoder;
use glam::DVec3;

use super::super::super::detect::{self, DataSet};
use super::super::super::error::Feature;
use super::super::super::offer::LabelName;
use super::super::super::problem::{DicomProblem, ScanProblem};
use super::super::error::ScanError;
use super::super::numbers::{LARGEST, MAX_UNFOLDED};
use super::{colours, tags};

pub(super) const FORMAT: &str = "DICOM";

/// Sequences in sequences are followed so deep.
const DEEPEST: usize = 32;

/// How pixels are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Little,
    Big,
    Rle,
    Jpeg,
    JpegLs,
    Jpeg2000,
}

/// What an element says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value<'a> {
    tag: Tag,
    vr: VR,
    bytes: &'a [u8],
    is_big_endian: bool,
}

/// Elements one after another.
type Values<'a> = Vec<Value<'a>>;

/// What a file says; zeros and `None` where it does not.
#[derive(Clone, Debug, Default)]
pub(super) struct File<'a> {
    pub(super) packing: Option<Packing>,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) frames: usize,
    pub(super) bits_allocated: u16,
    pub(super) bits_stored: u16,
    pub(super) is_signed: bool,
    /// Whether pixels are floats.
    pub(super) is_float: bool,
    /// What it says of all its frames.
    own: Values<'a>,
    /// The same, in the place that is meant for it.
    shared: Values<'a>,
    /// What it says of one frame each.
    each: Vec<Values<'a>>,
    /// Whether it says of a frame alone where that is.
    has_places: bool,
    /// What it says of each of its segments.
    segments: Vec<Values<'a>>,
    /// The pixels, or the fragments that they are packed into.
    pub(super) pixels: Vec<&'a [u8]>,
    /// Where the fragments of each frame begin, as far as the file says it.
    offsets: &'a [u8],
    /// The first fragment of each frame, where frames have several.
    pub(super) first_fragments: Vec<usize>,
    /// Whether a table says what stored numbers stand for.
    has_table: bool,
}

impl<'a> File<'a> {
    /// Walks through a file.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, ScanError> {
        let (syntax, rest) = meta(bytes);
        let (packing, encoding) = packing(&syntax, rest)?;
        let mut file = Self { packing: Some(packing), ..Self::default() };
        let is_big_endian = packing == Packing::Big;
        walk(rest, &encoding, |path, item, tag, vr, bytes| {
            file.take(path, item, Value { tag, vr, bytes, is_big_endian });
        })?;
        let whole = |tag| find(&file.own, tag).map_or(0, Value::short);
        let (rows, columns, allocated, stored) =
            (whole(tags::ROWS), whole(tags::COLUMNS), whole(tags::ALLOCATED), whole(tags::STORED));
        file.is_signed = whole(tags::SIGNED) == 1;
        (file.rows, file.columns, file.bits_allocated, file.bits_stored) =
            (rows.into(), columns.into(), allocated, stored);
        file.has_places = file.each.iter().any(|values| find(values, tags::POSITION).is_some());
        file.frames = file.own(tags::FRAMES).and_then(Value::number).map_or(1, |frames| frames as usize).max(1);
        if (2..file.pixels.len()).contains(&file.frames) {
            file.first_fragments = file.begin_frames();
        }
        if file.has_table {
            return Err(ScanError::unsupported(FORMAT, Feature::ValueTable));
        }
        Ok(file)
    }

    /// The fragments with which frames begin: those that the table of offsets names, else those that begin a picture.
    fn begin_frames(&self) -> Vec<usize> {
        const HEADER: usize = 8;
        let mut offsets = self.offsets.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word) as usize).peekable();
        let is_told = offsets.peek().is_some();
        let mut at = 0;
        let begins = self.pixels.iter().enumerate().filter_map(|(number, fragment)| {
            let is_first = if is_told {
                offsets.next_if_eq(&at).is_some()
            } else {
                // A picture of JPEG or JPEG-LS, or a codestream of JPEG 2000.
                fragment.starts_with(&[0xFF, 0xD8]) || fragment.starts_with(&[0xFF, 0x4F])
            };
            at += HEADER + fragment.len();
            is_first.then_some(number)
        });
        begins.collect()
    }

    /// Takes an element that is in these sequences, in item `item` of the outermost.
    fn take(&mut self, path: &[Tag], item: usize, value: Value<'a>) {
        let tag = value.tag;
        match *path {
            [] if matches!(tag, tags::PIXELS | tags::FLOAT_PIXELS | tags::DOUBLE_PIXELS) => {
                self.is_float |= tag != tags::PIXELS;
                self.pixels.push(value.bytes);
            }
            [tags::PIXELS] => self.offsets = value.bytes,
            [tags::VALUE_TABLE] => self.has_table = true,
            [] if tags::OWN.contains(&tag) => self.own.push(value),
            [tags::SHARED_GROUPS, group] if tags::GROUPED.contains(&(group, tag)) => self.shared.push(value),
            [tags::FRAME_GROUPS, group] if tags::GROUPED.contains(&(group, tag)) => {
                item_of(&mut self.each, item).push(value);
            }
            [tags::SEGMENTS] if tags::OF_SEGMENT.contains(&tag) => item_of(&mut self.segments, item).push(value),
            _ => {}
        }
    }

    /// What the file itself says.
    pub(super) fn own(&self, tag: Tag) -> Option<Value<'a>> {
        find(&self.own, tag)
    }

    /// What the file says of a frame: of that alone, else of all of them.
    pub(super) fn value(&self, frame: usize, tag: Tag) -> Option<Value<'a>> {
        self.of_frame(frame, tag).or_else(|| find(&self.shared, tag)).or_else(|| self.own(tag))
    }

    fn of_frame(&self, frame: usize, tag: Tag) -> Option<Value<'a>> {
        find(self.each.get(frame)?, tag)
    }

    pub(super) fn number(&self, frame: usize, tag: Tag) -> Option<f64> {
        self.value(frame, tag)?.number()
    }

    pub(super) fn text(&self, tag: Tag) -> String {
        self.own(tag).map_or_else(String::new, Value::text)
    }

    /// The centre of the first pixel of a frame in mm. Frames on top of each other may have the first one's place alone, and
    /// a distance between them.
    pub(super) fn position(&self, frame: usize, normal: DVec3) -> Option<DVec3> {
        let place = |value: Value| value.decimals().map(DVec3::from);
        if let Some(position) = self.of_frame(frame, tags::POSITION) {
            return place(position);
        }
        let first = place(self.value(0, tags::POSITION)?)?;
        if self.frames == 1 {
            return Some(first);
        }
        // A file that says where some frames are and not where this one is.
        if self.has_places {
            return None;
        }
        let between = self.number(0, tags::BETWEEN).or_else(|| self.number(0, tags::THICKNESS))?;
        Some(first + normal * (between * frame as f64))
    }

    /// The directions in which the columns and the rows of a frame are counted.
    pub(super) fn orientation(&self, frame: usize) -> Option<[DVec3; 2]> {
        let [a, b, c, d, e, f] = self.value(frame, tags::ORIENTATION)?.decimals()?;
        Some([DVec3::new(a, b, c), DVec3::new(d, e, f)])
    }

    /// Distance between the rows of a frame, and between its columns.
    pub(super) fn spacing(&self, frame: usize) -> Option<[f64; 2]> {
        self.value(frame, tags::SPACING)?.decimals()
    }

    /// Slope and intercept of a frame.
    pub(super) fn rescale(&self, frame: usize) -> (f64, f64) {
        let number = |tag, default| self.number(frame, tag).unwrap_or(default);
        (number(tags::SLOPE, 1.0), number(tags::INTERCEPT, 0.0))
    }

    /// Whether it holds slices in shades of grey, or segments.
    pub(super) fn holds_slices(&self) -> bool {
        let is_grey = self.own(tags::PHOTOMETRIC).is_some_and(|kind| {
            kind.bytes.starts_with(b"MONOCHROME") || (self.is_segmentation() && kind.bytes.starts_with(b"PALETTE"))
        });
        let samples = self.own(tags::SAMPLES).map_or(1, Value::short);
        !self.pixels.is_empty() && is_grey && samples == 1 && self.rows * self.columns > 0
    }

    /// Whether its pictures are in colours.
    pub(super) fn is_in_colours(&self) -> bool {
        !self.pixels.is_empty() && !self.holds_slices() && self.own(tags::PHOTOMETRIC).is_some()
    }

    /// Whether its pixels say which segment they are of.
    pub(super) fn is_segmentation(&self) -> bool {
        self.own(tags::SEGMENTATION_TYPE).is_some()
    }

    /// Each segment that has a name.
    pub(super) fn segments(&self) -> impl Iterator<Item = LabelName> {
        // The first that it names; Latin-1 is the one beside UTF-8 that these names have in practice.
        let letters = self.text(tags::LETTERS);
        let is_latin_1 = matches!(letters.split('\\').next(), Some("ISO_IR 100" | "ISO 2022 IR 100"));
        let name = move |value: Value| if is_latin_1 { latin_1(value.bytes) } else { text(value.bytes) };
        self.segments.iter().filter_map(move |values| {
            let (number, label) = (find(values, tags::SEGMENT_NUMBER)?, find(values, tags::SEGMENT_LABEL)?);
            let colour = find(values, tags::SEGMENT_COLOUR).and_then(Value::shorts).map(colours::of_lab);
            let named = LabelName { value: number.short().into(), name: name(label), colour };
            Some(named).filter(|named| !named.name.is_empty())
        })
    }

    /// The frames that there are, which are no more than the bytes of the file can hold: packed ones have a fragment each.
    pub(super) fn held_frames(&self) -> usize {
        /// Frames of fewer bits are none.
        const LEAST: usize = 64;
        let bits = (self.rows * self.columns).saturating_mul(self.bits_allocated.into()).max(LEAST);
        let bytes: usize = self.pixels.iter().map(|fragment| fragment.len()).sum();
        self.frames.min(self.pixels.len().max(bytes.saturating_mul(8) / bits).max(self.each.len()))
    }
}

/// The list of an item of a sequence, whose items come in order; those without anything of use count, too.
fn item_of<'l, 'a>(items: &'l mut Vec<Values<'a>>, item: usize) -> &'l mut Values<'a> {
    if items.len() <= item {
        items.resize(item + 1, Vec::new());
    }
    &mut items[item]
}

fn find<'a>(values: &[Value<'a>], tag: Tag) -> Option<Value<'a>> {
    values.iter().find(|value| value.tag == tag && !value.bytes.is_empty()).copied()
}

impl Value<'_> {
    /// As a whole number of 16 bits.
    pub(super) fn short(self) -> u16 {
        self.shorts().map_or(0, |[word]| word)
    }

    /// The first whole numbers of 16 bits in it.
    fn shorts<const N: usize>(self) -> Option<[u16; N]> {
        let words: &[[u8; 2]; N] = self.bytes.as_chunks().0.first_chunk()?;
        let word = if self.is_big_endian { u16::from_be_bytes } else { u16::from_le_bytes };
        Some(words.map(word))
    }

    /// The first number in it.
    pub(super) fn number(self) -> Option<f64> {
        fn word<const N: usize>(value: Value) -> Option<[u8; N]> {
            let mut word = *value.bytes.first_chunk()?;
            if value.is_big_endian {
                word.reverse();
            }
            Some(word)
        }
        match self.vr {
            VR::US => Some(self.short().into()),
            VR::SS => Some((self.short() as i16).into()),
            VR::UL => word(self).map(|word| u32::from_le_bytes(word).into()),
            VR::SL => word(self).map(|word| i32::from_le_bytes(word).into()),
            VR::FL => word(self).map(|word| f32::from_le_bytes(word).into()),
            VR::FD => word(self).map(f64::from_le_bytes),
            _ => number(self.bytes.split(|&byte| byte == b'\\').next()?),
        }
        .filter(|number| number.is_finite())
    }

    /// `N` decimal numbers; `None` where there are not as many, or more.
    fn decimals<const N: usize>(self) -> Option<[f64; N]> {
        let mut words = self.bytes.split(|&byte| byte == b'\\');
        let mut found = [0.0; N];
        for number in &mut found {
            *number = self::number(words.next()?)?;
        }
        words.next().is_none().then_some(found)
    }

    /// As words, without what pads them.
    pub(super) fn text(self) -> String {
        match self.vr {
            VR::US | VR::SS | VR::UL | VR::SL | VR::FL | VR::FD => {
                self.number().map_or_else(String::new, |number| number.to_string())
            }
            _ => text(self.bytes),
        }
    }
}

/// The transfer syntax, empty where nothing says it, and the elements behind the file's own.
fn meta(bytes: &[u8]) -> (String, &[u8]) {
    let mut rest = detect::behind_preamble(bytes);
    let mut syntax = String::new();
    while let [2, 0, low, high, a, b, ..] = *rest {
        // Explicit, as the standard has it, or as some write it.
        let (length, at) = match [a, b] {
            [b'O', b'B' | b'W'] | [b'U', b'N' | b'T'] | [b'S', b'Q'] => (rest.get(8..12).map(long), 12),
            [b'A'..=b'Z', b'A'..=b'Z'] => {
                (rest.get(6..8).map(|short| usize::from(short[0]) | usize::from(short[1]) << 8), 8)
            }
            _ => (rest.get(4..8).map(long), 8),
        };
        let end = length.and_then(|length| length.checked_add(at));
        let Some(value) = end.and_then(|end| rest.get(at..end)) else { break };
        if [low, high] == [0x10, 0] {
            syntax = text(value);
        }
        rest = &rest[at + value.len()..];
    }
    (syntax, rest)
}

fn long(bytes: &[u8]) -> usize {
    bytes.first_chunk().map_or(0, |&word| u32::from_le_bytes(word) as usize)
}

/// A file as `dicom-parser` takes it: not deflated, and with the lengths of sequences whose kind is not known.
pub(super) fn prepared(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ScanError> {
    let (syntax, rest) = meta(bytes);
    let mut file = Cow::from(bytes);
    if syntax == "1.2.840.10008.1.2.1.99" {
        let mut whole = bytes[..bytes.len() - rest.len()].to_vec();
        let most = LARGEST.min(MAX_UNFOLDED * rest.len() as u64);
        let read = DeflateDecoder::new(rest).take(most).read_to_end(&mut whole);
        read.map_err(|_| ScanError::malformed(FORMAT, ScanProblem::PackedDamaged))?;
        file = whole.into();
    }
    if syntax != "1.2.840.10008.1.2.2" {
        give_lengths(&mut file);
    }
    Ok(file)
}

/// Gives their lengths to sequences without one that stand before the pixels where the kind of a value is not known (UN).
/// Their elements are implicit (PS3.5, 6.2.2, note 2), and `dicom-parser` takes them for those of the transfer syntax.
fn give_lengths(file: &mut Cow<'_, [u8]>) {
    const UNKNOWN: &[u8] = b"UN\0\0\xFF\xFF\xFF\xFF";
    const PIXELS: &[u8] = &[0xE0, 0x7F, 0x10, 0x00, b'O'];
    let mut at = 0;
    while let Some(next) = file
        .get(at..)
        .and_then(|rest| rest.windows(UNKNOWN.len()).position(|here| here == UNKNOWN || here.starts_with(PIXELS)))
    {
        at += next + UNKNOWN.len();
        if file[..at].ends_with(UNKNOWN)
            && let Some(length) = sequence_length(&file[at..])
        {
            file.to_mut()[at - 4..at].copy_from_slice(&length.to_le_bytes());
            at += length as usize;
        } else {
            break;
        }
    }
}

/// The length of a sequence of implicit elements that ends with a delimiter, that included.
fn sequence_length(all: &[u8]) -> Option<u32> {
    const UNDEFINED: u32 = u32::MAX;
    let (mut at, mut open) = (0usize, 1usize);
    while open > 0 {
        let tag = *all.get(at..)?.first_chunk::<4>()?;
        let length = u32::from_le_bytes(*all.get(at + 4..)?.first_chunk()?);
        at += 8;
        match (tag, length) {
            ([0xFE, 0xFF, 0x0D | 0xDD, 0xE0], _) => open -= 1,
            (_, UNDEFINED) => open += 1,
            _ => at = at.checked_add(length as usize)?,
        }
    }
    at.try_into().ok()
}

/// How the pixels of a transfer syntax are packed, and how its elements are encoded. What the elements look like counts where
/// nothing is said, and where it is not so: some write the one uncompressed syntax and name the other.
fn packing(syntax: &str, data_set: &[u8]) -> Result<(Packing, TransferSyntax), ScanError> {
    let refused = |what: Feature| Err(ScanError::unsupported(FORMAT, what));
    let looks = detect::data_set(data_set);
    let explicit = entries::EXPLICIT_VR_LITTLE_ENDIAN.erased();
    let implicit = entries::IMPLICIT_VR_LITTLE_ENDIAN.erased();
    match syntax.strip_prefix("1.2.840.10008.1.2").unwrap_or(if syntax.is_empty() { "" } else { "?" }) {
        "" | ".1" if looks == Some(DataSet::BigEndian) => Ok((Packing::Big, entries::EXPLICIT_VR_BIG_ENDIAN.erased())),
        "" | ".1" | ".1.99" if looks == Some(DataSet::Implicit) => Ok((Packing::Little, implicit)),
        "" if looks.is_none() => Ok((Packing::Little, implicit)),
        "" | ".1" | ".1.99" => Ok((Packing::Little, explicit)),
        ".2" => Ok((Packing::Big, entries::EXPLICIT_VR_BIG_ENDIAN.erased())),
        ".5" => Ok((Packing::Rle, explicit)),
        ".4.50" | ".4.51" | ".4.57" | ".4.70" => Ok((Packing::Jpeg, explicit)),
        ".4.80" | ".4.81" => Ok((Packing::JpegLs, explicit)),
        ".4.90" | ".4.91" => Ok((Packing::Jpeg2000, explicit)),
        // Of several components, and of high throughput.
        ".4.92" | ".4.93" | ".4.201" | ".4.202" | ".4.203" => refused(Feature::Jpeg2000),
        _ => refused(Feature::UnknownCompression),
    }
}

/// Hands each value to `take`: the sequences that it is in, the number of the outermost one's item, its tag, its kind and its
/// bytes; the fragments of packed pixels one by one, their table of offsets left out.
fn walk<'a>(
    bytes: &'a [u8],
    encoding: &TransferSyntax,
    mut take: impl FnMut(&[Tag], usize, Tag, VR, &'a [u8]),
) -> Result<(), ScanError> {
    let broken = || ScanError::malformed(FORMAT, DicomProblem::Damaged);
    let mut reader = LazyDataSetReader::new_with_ts(Cursor::new(bytes), encoding).map_err(|_| broken())?;
    // The sequences that are open, whether an item in the last of them is, and the items so far of the outermost; of pixels the
    // first is a table of offsets, often empty.
    let (mut path, mut open, mut items) = (Vec::<Tag>::new(), Vec::new(), 0);
    while let Some(token) = reader.advance() {
        match token.map_err(|_| broken())? {
            LazyDataToken::SequenceStart { tag, .. } => {
                items = if path.is_empty() { 0 } else { items };
                path.push(tag);
                open.push(false);
            }
            LazyDataToken::PixelSequenceStart => {
                items = 0;
                path.push(tags::PIXELS);
                open.push(false);
            }
            LazyDataToken::ItemStart { .. } => {
                items += usize::from(path.len() == 1);
                open.push(true);
            }
            end @ (LazyDataToken::SequenceEnd | LazyDataToken::ItemEnd) => {
                match open.pop() {
                    Some(true) => {}
                    Some(false) => drop(path.pop()),
                    // The reader panics at what follows an end that nothing began.
                    None => return Err(broken()),
                }
                // And at an item after the end of one that stood in no sequence.
                if open.is_empty() && matches!(end, LazyDataToken::ItemEnd) {
                    return Err(broken());
                }
            }
            LazyDataToken::LazyValue { header, decoder } => {
                let value = value(bytes, decoder.position(), header.len.0).ok_or_else(cut_short)?;
                decoder.skip_bytes(header.len.0).map_err(|_| broken())?;
                take(&path, items.saturating_sub(1), header.tag, header.vr, value);
            }
            LazyDataToken::LazyItemValue { len, decoder } => {
                let value = value(bytes, decoder.position(), len).ok_or_else(cut_short)?;
                decoder.skip_bytes(len).map_err(|_| broken())?;
                if path == [tags::PIXELS] {
                    let within = if items > 1 { &[] } else { &path[..] };
                    take(within, 0, tags::PIXELS, VR::OB, value);
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

/// A value of letters, which are UTF-8.
fn text(value: &[u8]) -> String {
    String::from_utf8_lossy(unpadded(value)).into_owned()
}

/// A value of letters of ISO 8859-1, whose bytes are the numbers of its letters.
fn latin_1(value: &[u8]) -> String {
    unpadded(value).iter().copied().map(char::from).collect()
}

/// A value without its padding, and not more than a name is long.
fn unpadded(value: &[u8]) -> &[u8] {
    const LONGEST: usize = 128;
    let is_padding = |byte: &u8| matches!(byte, 0 | b' ');
    let start = value.iter().position(|byte| !is_padding(byte)).unwrap_or(0);
    let end = value.iter().rposition(|byte| !is_padding(byte)).map_or(0, |last| last + 1);
    &value[start..end.min(start + LONGEST).max(start)]
}

fn number(word: &[u8]) -> Option<f64> {
    let word = std::str::from_utf8(word).ok()?.trim_matches(|c: char| c == '\0' || c.is_ascii_whitespace());
    word.parse().ok().filter(|number: &f64| number.is_finite())
}
