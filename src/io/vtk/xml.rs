//! VTK's XML files of polygonal data (.vtp) and unstructured grids (.vtu).
//!
//! Arrays stand in the file as text, in base64, or appended behind the structure, raw or in base64. What is appended raw
//! is no XML: reading stops where it begins.

use std::borrow::Cow;

use glam::DVec3;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::super::Axes;
use super::super::error::ReadError;
use super::super::import::RawSurface;
use super::super::numbers::Scalar;
use super::super::room::Room;
use super::super::text;
use super::array::{Array, Content};
use super::encoded::{Compressor, Encoded, Encoding};
use super::no_surface;
use super::surface::{Cells, Lengths, Shape, Surface, is_whole};

/// Whether a text begins as VTK's XML files do.
pub(in crate::io) fn is_xml(text: &[u8]) -> bool {
    let head = &text[..text.len().min(1024)];
    head.starts_with(b"<") && head.windows(8).any(|part| part == b"<VTKFile")
}

/// Reads a file, with positions relative to `origin`.
pub(in crate::io) fn read(bytes: &[u8], origin: DVec3) -> Result<RawSurface, ReadError> {
    let file = Structure::parse(bytes)?;
    let mut arrays = Arrays::new(&file, bytes, Room::of(bytes.len()).unfolded());
    let mut surface = Surface::new(file.format, bytes.len(), origin);
    for piece in &file.pieces {
        arrays.add_piece(piece, &mut surface)?;
    }
    let axes = file.space.as_ref().map_or(Ok(Axes::Unknown), |array| arrays.axes(array))?;
    surface.finish(file.format, axes)
}

/// What the structure says.
pub(super) struct Structure<'a> {
    /// "VTP" or "VTU".
    format: &'static str,
    encoding: Encoding,
    pieces: Vec<Piece<'a>>,
    /// Which way the axes point, where the file says so as 3D Slicer does.
    space: Option<DataArray<'a>>,
    /// What is appended, from its first byte on, and whether it is in base64.
    pub(super) appended: Option<(&'a [u8], bool)>,
}

/// A part of the surface, with points of its own.
#[derive(Default)]
struct Piece<'a> {
    /// Number of points, vertices, lines, strips, polygons and cells of a grid, as the file claims them.
    counts: [u64; 6],
    points: Option<DataArray<'a>>,
    /// The arrays of its cells, each with its place in [`KINDS`] and in [`PARTS`].
    cells: Vec<(usize, usize, DataArray<'a>)>,
}

impl<'a> Piece<'a> {
    /// An array of a kind of cells.
    fn cells(&self, kind: usize, part: usize) -> Option<&DataArray<'a>> {
        self.cells.iter().find(|array| (array.0, array.1) == (kind, part)).map(|array| &array.2)
    }
}

/// The names of the arrays of cells.
const PARTS: [&str; 3] = ["connectivity", "offsets", "types"];

/// The names of the counts of a piece, and of the elements that hold what is counted.
const KINDS: [(&str, &str, Shape); 6] = [
    ("NumberOfPoints", "Points", Shape::Vertices),
    ("NumberOfVerts", "Verts", Shape::Vertices),
    ("NumberOfLines", "Lines", Shape::Lines),
    ("NumberOfStrips", "Strips", Shape::Strips),
    ("NumberOfPolys", "Polys", Shape::Polygons),
    ("NumberOfCells", "Cells", Shape::Typed),
];

/// Where an array's numbers are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place<'a> {
    /// As text, from this byte of the file on.
    Text(&'a [u8], usize),
    Binary(&'a [u8]),
    Appended(u64),
}

#[derive(Clone, Debug)]
pub(super) struct DataArray<'a> {
    kind: String,
    place: Place<'a>,
}

/// Where in the structure an element stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Elsewhere,
    FieldData,
    /// One of [`KINDS`].
    Kind(usize),
}

pub(super) fn malformed(format: &'static str, problem: impl Into<String>) -> ReadError {
    ReadError::Malformed { format, problem: problem.into() }
}

/// The value of an attribute, if it is there.
pub(super) fn attribute(element: &BytesStart, name: &str) -> Option<String> {
    // Without a search for duplicates, which takes the square of their number.
    let mut attributes = element.attributes();
    let found = attributes.with_checks(false).flatten().find(|attribute| attribute.key.as_ref() == name.as_bytes())?;
    Some(String::from_utf8_lossy(&found.value).trim().to_owned())
}

impl<'a> Structure<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut reader = Reader::from_reader(text::without_mark(bytes).trim_ascii_start());
        let start = bytes.len() - text::without_mark(bytes).trim_ascii_start().len();
        let mut file = None;
        let mut section = Section::Elsewhere;
        let room = Room::of(bytes.len());
        loop {
            let event = reader.read_event().map_err(|_| broken(bytes, start + reader.error_position() as usize))?;
            let (element, is_open) = match event {
                Event::Start(element) => (element, true),
                Event::Empty(element) => (element, false),
                Event::End(element) => {
                    if section_named(element.name().as_ref()).is_some() {
                        section = Section::Elsewhere;
                    }
                    continue;
                }
                Event::Eof => break,
                _ => continue,
            };
            let name = element.name();
            let Some(file) = &mut file else {
                if name.as_ref() == b"VTKFile" {
                    file = Some(Self::begin(&element)?);
                }
                continue;
            };
            match name.as_ref() {
                b"Piece" => {
                    let count = |name| attribute(&element, name).and_then(|n| n.parse().ok()).unwrap_or(0);
                    file.pieces.push(Piece { counts: KINDS.map(|(name, ..)| count(name)), ..Piece::default() });
                    room.check_parts(file.format, file.pieces.len())?;
                }
                b"DataArray" | b"Array" => {
                    let inline = if is_open { inline_text(&mut reader, bytes, start)? } else { (&b""[..], 0) };
                    file.add_array(section, &element, inline)?;
                }
                b"AppendedData" => {
                    let rest = bytes.get(start + reader.buffer_position() as usize..).unwrap_or_default();
                    file.append(&element, rest)?;
                    break;
                }
                other => section = section_named(other).filter(|_| is_open).unwrap_or(section),
            }
        }
        file.ok_or_else(|| malformed("VTP", "it has no element \"VTKFile\""))
    }

    /// What the outermost element says.
    fn begin(element: &BytesStart) -> Result<Self, ReadError> {
        let format = match attribute(element, "type").as_deref() {
            Some("PolyData") => "VTP",
            Some("UnstructuredGrid") => "VTU",
            other => return Err(no_surface(other.unwrap_or("file of no type"))),
        };
        Self::of(format, element)
    }

    /// A file of a format, of which nothing is known but what the outermost element says of its encoding.
    pub(super) fn of(format: &'static str, element: &BytesStart) -> Result<Self, ReadError> {
        let compressor = match attribute(element, "compressor").as_deref() {
            None | Some("") => None,
            Some(name) => Some(Compressor::named(name).ok_or_else(|| ReadError::Unsupported {
                format,
                feature: format!("the compressor {}", text::quoted(name.as_bytes())),
            })?),
        };
        let is = |name, value: &str| attribute(element, name).is_some_and(|found| found == value);
        let (big_endian, wide_header) = (is("byte_order", "BigEndian"), is("header_type", "UInt64"));
        let encoding = Encoding { format, big_endian, wide_header, compressor };
        Ok(Self { format, encoding, pieces: Vec::new(), space: None, appended: None })
    }

    /// Keeps an array that matters.
    fn add_array(
        &mut self,
        section: Section,
        element: &BytesStart,
        inline: (&'a [u8], usize),
    ) -> Result<(), ReadError> {
        let name = attribute(element, "Name").unwrap_or_default();
        let array = DataArray::new(self.format, element, inline)?;
        match (section, self.pieces.last_mut()) {
            (Section::FieldData, _) if name == "SPACE" => self.space = Some(array),
            (Section::Kind(0), Some(piece)) => piece.points = piece.points.take().or(Some(array)),
            (Section::Kind(kind), Some(piece)) => {
                let part = PARTS.iter().position(|&part| part == name);
                if let Some(part) = part.filter(|&part| piece.cells(kind, part).is_none()) {
                    piece.cells.push((kind, part, array));
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// What is appended, with the reader behind its element's beginning.
    pub(super) fn append(&mut self, element: &BytesStart, rest: &'a [u8]) -> Result<(), ReadError> {
        let rest = rest.trim_ascii_start().strip_prefix(b"_");
        let rest = rest.ok_or_else(|| malformed(self.format, "its appended data do not begin with an underscore"))?;
        let is_base64 = attribute(element, "encoding").is_some_and(|encoding| encoding == "base64");
        self.appended = Some((rest, is_base64));
        Ok(())
    }
}

impl<'a> DataArray<'a> {
    /// What an element says, with the text in it and where that begins.
    pub(super) fn new(
        format: &'static str,
        element: &BytesStart,
        (inline, at): (&'a [u8], usize),
    ) -> Result<Self, ReadError> {
        let place = match attribute(element, "format").as_deref() {
            Some("appended") => {
                let offset = attribute(element, "offset").and_then(|offset| offset.parse().ok());
                Place::Appended(offset.ok_or_else(|| malformed(format, "an array does not say where its data are"))?)
            }
            Some("binary") => Place::Binary(inline),
            _ => Place::Text(inline, at),
        };
        Ok(Self { kind: attribute(element, "type").unwrap_or_default(), place })
    }
}

/// The section that an element begins.
fn section_named(name: &[u8]) -> Option<Section> {
    match name {
        b"FieldData" => Some(Section::FieldData),
        b"PointData" | b"CellData" => Some(Section::Elsewhere),
        _ => KINDS.iter().position(|(_, element, _)| element.as_bytes() == name).map(Section::Kind),
    }
}

/// The text of the element that has just begun, without that of elements in it, and where it begins; the reader is then
/// past its end.
pub(super) fn inline_text<'a>(
    reader: &mut Reader<&'a [u8]>,
    bytes: &'a [u8],
    start: usize,
) -> Result<(&'a [u8], usize), ReadError> {
    let (mut depth, mut found) = (0, (&b""[..], start));
    loop {
        let from = start + reader.buffer_position() as usize;
        let event = reader.read_event().map_err(|_| broken(bytes, start + reader.error_position() as usize))?;
        match event {
            Event::Text(_) if depth == 0 && found.0.is_empty() => {
                let to = start + reader.buffer_position() as usize;
                found = (bytes.get(from..to).unwrap_or_default().trim_ascii_end(), from);
            }
            Event::Start(_) => depth += 1,
            Event::End(_) if depth == 0 => return Ok(found),
            Event::End(_) => depth -= 1,
            Event::Eof => return Err(broken(bytes, bytes.len())),
            _ => {}
        }
    }
}

/// That the XML is wrong at a place.
pub(super) fn broken(bytes: &[u8], at: usize) -> ReadError {
    let problem = "its XML is wrong or incomplete there".to_owned();
    ReadError::Syntax { format: "VTK", line: line_of(bytes, at), problem }
}

/// The line that a byte stands in, from 1.
fn line_of(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at.min(bytes.len())].iter().filter(|&&byte| byte == b'\n').count()
}

/// The numbers behind the structure.
pub(super) struct Arrays<'a> {
    file: &'a Structure<'a>,
    bytes: &'a [u8],
    /// How many bytes compressed data may still unfold to.
    room: u64,
}

impl<'a> Arrays<'a> {
    /// Of a file whose compressed data may unfold to so many bytes.
    pub(super) fn new(file: &'a Structure<'a>, bytes: &'a [u8], room: u64) -> Self {
        Self { file, bytes, room }
    }

    fn add_piece(&mut self, piece: &Piece<'a>, surface: &mut Surface) -> Result<(), ReadError> {
        let [points, kinds @ ..] = piece.counts;
        if let (Some(array), true) = (&piece.points, points > 0) {
            surface.add_points(&self.open(array)?, points)?;
        }
        for (kind, (&count, &(_, element, shape))) in kinds.iter().zip(&KINDS[1..]).enumerate() {
            if count == 0 {
                continue;
            }
            let missing = || malformed(self.file.format, format!("\"{element}\" has no arrays"));
            let [connectivity, offsets, types] = [0, 1, 2].map(|part| piece.cells(kind + 1, part));
            let (Some(connectivity), Some(offsets)) = (connectivity, offsets) else { return Err(missing()) };
            if piece.points.is_none() {
                return Err(malformed(self.file.format, "a piece has no points"));
            }
            if shape == Shape::Typed && types.is_none() {
                return Err(missing());
            }
            // Vertices and lines are only counted.
            let is_surface = !matches!(shape, Shape::Vertices | Shape::Lines);
            let none = || Ok(Array { kind: Scalar::U8, content: Content::Little(Cow::Borrowed(b"")) });
            let mut open = |array| if is_surface { self.open_whole(array) } else { none() };
            let (ends, points) = (open(offsets)?, open(connectivity)?);
            let types = types.filter(|_| shape == Shape::Typed).map(open).transpose()?;
            surface.add_cells(&Cells { shape, count, lengths: Lengths::Ends(ends), points, types })?;
        }
        Ok(())
    }

    /// The numbers of an array, which must be whole ones.
    fn open_whole(&mut self, array: &DataArray<'a>) -> Result<Array<'a>, ReadError> {
        let opened = self.open(array)?;
        if !is_whole(opened.kind) && !matches!(opened.content, Content::Text { .. }) {
            return Err(malformed(self.file.format, "its cells are numbered with fractions"));
        }
        Ok(opened)
    }

    /// The numbers of an array.
    pub(super) fn open(&mut self, array: &DataArray<'a>) -> Result<Array<'a>, ReadError> {
        let format = self.file.format;
        let kind = scalar(&array.kind).ok_or_else(|| {
            malformed(format, format!("{} is no type of number", text::quoted(array.kind.as_bytes())))
        })?;
        let encoding = self.file.encoding;
        let bytes = match array.place {
            Place::Text(text, at) => {
                return Ok(Array { kind, content: Content::Text { text, line: line_of(self.bytes, at) } });
            }
            Place::Binary(text) => match compact(text) {
                Cow::Borrowed(text) => encoding.decode(Encoded::Base64(text), &mut self.room)?,
                Cow::Owned(text) => Cow::Owned(encoding.decode(Encoded::Base64(&text), &mut self.room)?.into_owned()),
            },
            Place::Appended(offset) => {
                let rest = self.file.appended.and_then(|(data, is_base64)| {
                    let rest = data.get(usize::try_from(offset).ok()?..)?;
                    Some(if is_base64 { Encoded::Base64(rest) } else { Encoded::Raw(rest) })
                });
                let rest = rest.ok_or_else(|| malformed(format, "an array lies beyond the end of the file"))?;
                encoding.decode(rest, &mut self.room)?
            }
        };
        let content = if encoding.big_endian { Content::Big(bytes) } else { Content::Little(bytes) };
        Ok(Array { kind, content })
    }

    /// The axes that a string of the field data names.
    fn axes(&mut self, array: &DataArray<'a>) -> Result<Axes, ReadError> {
        let letters = self.open(&DataArray { kind: "UInt8".to_owned(), ..array.clone() })?;
        let mut numbers = letters.numbers(self.file.format);
        let word: Vec<u8> = std::iter::from_fn(|| numbers.number(Scalar::U8)).take(4).map(|n| n as u8).collect();
        Ok(match word.strip_suffix(b"\0").unwrap_or(&word) {
            b"LPS" => Axes::Lps,
            b"RAS" => Axes::Ras,
            _ => Axes::Unknown,
        })
    }
}

/// The type that a file calls `name`.
fn scalar(name: &str) -> Option<Scalar> {
    Some(match name {
        "Int8" => Scalar::I8,
        "UInt8" => Scalar::U8,
        "Int16" => Scalar::I16,
        "UInt16" => Scalar::U16,
        "Int32" => Scalar::I32,
        "UInt32" => Scalar::U32,
        "Int64" => Scalar::I64,
        "UInt64" => Scalar::U64,
        "Float32" => Scalar::F32,
        "Float64" => Scalar::F64,
        _ => return None,
    })
}

/// A text without its white space.
fn compact(text: &[u8]) -> Cow<'_, [u8]> {
    if text.iter().any(u8::is_ascii_whitespace) {
        Cow::Owned(text.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect())
    } else {
        Cow::Borrowed(text)
    }
}
