//! The structure of a VTK XML file: its pieces and their arrays, and where the numbers of each are.

use std::borrow::Cow;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::super::error::{Feature, Named, ReadError, Unnamed};
use super::super::memory_budget::MemoryBudget;
use super::super::pace::{NUMBERS, Pace};
use super::super::problem::{Problem, VtkProblem};
use super::super::text;
use super::encoded::{Compressor, Encoding};
use super::no_surface;
use super::surface::Shape;
use lumen_mesh::arrays::Association;

/// What the structure says.
pub(super) struct Structure<'a> {
    /// "VTP" or "VTU".
    pub(super) format: &'static str,
    pub(super) encoding: Encoding,
    pub(super) pieces: Vec<Piece<'a>>,
    /// Which way the axes point, where the file says so as 3D Slicer does.
    pub(super) space: Option<DataArray<'a>>,
    /// What is appended, from its first byte on, and whether it is in base64.
    pub(super) appended: Option<(&'a [u8], bool)>,
}

/// A part of the surface, with points of its own.
#[derive(Default)]
pub(super) struct Piece<'a> {
    /// Number of points, vertices, lines, strips, polygons and cells of a grid, as the file claims them.
    pub(super) counts: [u64; 6],
    pub(super) points: Option<DataArray<'a>>,
    /// The arrays of its cells, each with its place in [`KINDS`] and in [`PARTS`].
    cells: Vec<(usize, usize, DataArray<'a>)>,
    /// The arrays on its points and on its cells.
    pub(super) data: Vec<(Association, DataArray<'a>)>,
}

impl<'a> Piece<'a> {
    /// How many cells it has of all kinds.
    pub(super) fn cell_count(&self) -> u64 {
        self.counts[1..].iter().fold(0, |sum, &count| sum.saturating_add(count))
    }

    /// How many of its cells stand before those of a kind, in the order of VTK's arrays: polygons before strips.
    pub(super) fn cells_before(&self, kind: usize) -> u64 {
        const STRIPS: usize = 3;
        let before = |other: &usize| (*other < kind && *other != STRIPS) || (kind == STRIPS && *other == STRIPS + 1);
        (1..self.counts.len()).filter(before).fold(0, |sum, other| sum.saturating_add(self.counts[other]))
    }

    /// An array of a kind of cells.
    pub(super) fn cells(&self, kind: usize, part: usize) -> Option<&DataArray<'a>> {
        self.cells.iter().find(|array| (array.0, array.1) == (kind, part)).map(|array| &array.2)
    }
}

/// The names of the arrays of cells.
const PARTS: [&str; 3] = ["connectivity", "offsets", "types"];

/// The names of the counts of a piece, and of the elements that hold what is counted.
pub(super) const KINDS: [(&str, &str, Shape); 6] = [
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
    pub(super) name: String,
    pub(super) kind: String,
    pub(super) components: u64,
    pub(super) place: Place<'a>,
}

/// Where in the structure an element stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Elsewhere,
    FieldData,
    /// Arrays on points or cells.
    Data(Association),
    /// One of [`KINDS`].
    Kind(usize),
}

pub(super) fn malformed(format: &'static str, problem: impl Into<Problem>) -> ReadError {
    ReadError::malformed(format, problem)
}

/// The value of an attribute, if it is there.
pub(super) fn attribute(element: &BytesStart, name: &str) -> Option<String> {
    // Without a search for duplicates, which takes the square of their number.
    let mut attributes = element.attributes();
    let found = attributes.with_checks(false).flatten().find(|attribute| attribute.key.as_ref() == name.as_bytes())?;
    Some(String::from_utf8_lossy(&found.value).trim().to_owned())
}

impl<'a> Structure<'a> {
    /// Reads the structure. The text of an array is stepped over at once, by a search for the `<` behind it: about a
    /// millisecond in 10 MB.
    pub(super) async fn parse(bytes: &'a [u8], pace: &Pace) -> Result<Self, ReadError> {
        let mut reader = Reader::from_reader(text::without_mark(bytes).trim_ascii_start());
        let start = bytes.len() - text::without_mark(bytes).trim_ascii_start().len();
        let mut file = None;
        let mut section = Section::Elsewhere;
        let room = MemoryBudget::of(bytes.len());
        let mut events = 0;
        loop {
            events += 1;
            if events % NUMBERS == 0 {
                pace.rest(0.0).await;
            }
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
                    room.check_parts(file.format, file.pieces.last().map_or(0, |piece| piece.data.len()))?;
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
        file.ok_or_else(|| malformed("VTP", VtkProblem::NoFile))
    }

    /// What the outermost element says.
    fn begin(element: &BytesStart) -> Result<Self, ReadError> {
        let format = match attribute(element, "type").as_deref() {
            Some("PolyData") => "VTP",
            Some("UnstructuredGrid") => "VTU",
            Some(other) => return Err(no_surface(other)),
            None => return Err(ReadError::VtkKind { kind: Named::Unnamed(Unnamed::NoKind) }),
        };
        Self::of(format, element)
    }

    /// A file of a format, of which nothing is known but what the outermost element says of its encoding.
    pub(super) fn of(format: &'static str, element: &BytesStart) -> Result<Self, ReadError> {
        let compressor = match attribute(element, "compressor").as_deref() {
            None | Some("") => None,
            Some(name) => Some(Compressor::named(name).ok_or_else(|| ReadError::Unsupported {
                format,
                feature: Feature::Compressor { name: text::quoted(name.as_bytes()) },
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
        let array = DataArray::new(self.format, element, inline)?;
        match (section, self.pieces.last_mut()) {
            (Section::FieldData, _) if array.name == "SPACE" => self.space = Some(array),
            (Section::Data(on), Some(piece)) => piece.data.push((on, array)),
            (Section::Kind(0), Some(piece)) => piece.points = piece.points.take().or(Some(array)),
            (Section::Kind(kind), Some(piece)) => {
                let part = PARTS.iter().position(|&part| part == array.name);
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
        let rest = rest.ok_or_else(|| malformed(self.format, VtkProblem::NoUnderscore))?;
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
                Place::Appended(offset.ok_or_else(|| malformed(format, VtkProblem::NoPlace))?)
            }
            Some("binary") => Place::Binary(inline),
            _ => Place::Text(inline, at),
        };
        let name = attribute(element, "Name").unwrap_or_default();
        let name = quick_xml::escape::unescape(&name).map_or_else(|_| name.clone(), Cow::into_owned);
        let components = attribute(element, "NumberOfComponents").and_then(|n| n.parse().ok()).unwrap_or(1);
        Ok(Self { name, kind: attribute(element, "type").unwrap_or_default(), components, place })
    }
}

/// The section that an element begins.
fn section_named(name: &[u8]) -> Option<Section> {
    match name {
        b"FieldData" => Some(Section::FieldData),
        b"PointData" => Some(Section::Data(Association::Point)),
        b"CellData" => Some(Section::Data(Association::Triangle)),
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
    let problem = VtkProblem::Xml;
    ReadError::syntax("VTK", line_of(bytes, at), problem)
}

/// The line that a byte stands in, from 1.
pub(super) fn line_of(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at.min(bytes.len())].iter().filter(|&&byte| byte == b'\n').count()
}
