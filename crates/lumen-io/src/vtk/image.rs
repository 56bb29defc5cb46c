//! VTK's XML files of image data (.vti): a grid of points and an array of numbers on them, or on the cells between.
//!
//! Of the arrays the one is read that the file calls its scalars, else the first of one number a point; of those on points
//! before those on cells. A file in pieces is not read.

use std::borrow::Cow;

use quick_xml::Reader;
use quick_xml::events::Event;

use super::super::error::{Feature, ReadError};
use super::super::numbers::Scalar;
use super::super::pace::Pace;
use super::super::problem::VtiProblem;
use super::super::text;
use super::array::Content;
use super::xml_arrays::Arrays;
use super::xml_structure::{DataArray, Structure, attribute, broken, inline_text, malformed};
use lumen_mesh::task::at_once;

const FORMAT: &str = "VTI";

/// What a file says of its grid, and its numbers.
pub(crate) struct Image<'a> {
    /// First and last point along i, j, k.
    pub(crate) extent: [[i64; 2]; 3],
    /// The place of the point numbered 0, 0, 0, which the grid need not have.
    pub(crate) origin: [f64; 3],
    pub(crate) spacing: [f64; 3],
    /// The matrix from the grid's axes to space, row by row.
    pub(crate) direction: [f64; 9],
    /// Whether the numbers are of the cells.
    pub(crate) on_cells: bool,
    pub(crate) scalar: Scalar,
    pub(crate) values: Values<'a>,
}

/// Numbers as text, or as bytes of one order or the other.
pub(crate) enum Values<'a> {
    Text(&'a [u8]),
    Little(Cow<'a, [u8]>),
    Big(Cow<'a, [u8]>),
}

/// What is known of the grid while the structure is read.
#[derive(Default)]
struct Found<'a> {
    whole: Option<[[i64; 2]; 3]>,
    pieces: usize,
    /// What the arrays that come are on.
    on: Option<On>,
    scalars: Option<String>,
    /// The array to read, and what speaks for it.
    array: Option<(DataArray<'a>, Claim)>,
}

/// Points or cells, the better one last.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum On {
    Cells,
    Points,
}

/// What speaks for an array: that the file calls it its scalars, then what it is on.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Claim {
    is_named: bool,
    on: On,
}

/// Reads a file, whose compressed data may unfold to `room` bytes.
pub(crate) fn read<'a, T>(bytes: &'a [u8], room: u64, make: impl FnOnce(Image) -> T) -> Result<T, ReadError> {
    let start = bytes.len() - text::without_mark(bytes).trim_ascii_start().len();
    let mut reader = Reader::from_reader(&bytes[start..]);
    let (mut file, mut found) = (None::<Structure<'a>>, Found::default());
    let (mut origin, mut spacing) = ([0.0; 3], [1.0; 3]);
    let mut direction = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    loop {
        let event = reader.read_event().map_err(|_| broken(bytes, start + reader.error_position() as usize))?;
        let (element, is_open) = match event {
            Event::Start(element) => (element, true),
            Event::Empty(element) => (element, false),
            Event::End(element) => {
                if matches!(element.name().as_ref(), b"PointData" | b"CellData") {
                    found.on = None;
                }
                continue;
            }
            Event::Eof => break,
            _ => continue,
        };
        let name = element.name();
        let Some(file) = &mut file else {
            if name.as_ref() == b"VTKFile" {
                file = Some(Structure::of(FORMAT, &element)?);
            }
            continue;
        };
        match name.as_ref() {
            b"ImageData" => {
                found.whole = attribute(&element, "WholeExtent").and_then(|text| extent(&text));
                let set = |name, values: &mut [f64]| match attribute(&element, name) {
                    Some(text) => fill(&text, values).ok_or_else(|| malformed(FORMAT, VtiProblem::Wrong { name })),
                    None => Ok(()),
                };
                set("Origin", &mut origin)?;
                set("Spacing", &mut spacing)?;
                set("Direction", &mut direction)?;
            }
            b"Piece" => {
                found.pieces += 1;
                let piece = attribute(&element, "Extent").and_then(|text| extent(&text));
                if found.pieces > 1 || piece.is_some_and(|piece| Some(piece) != found.whole) {
                    return Err(ReadError::Unsupported { format: FORMAT, feature: Feature::Pieces });
                }
            }
            on @ (b"PointData" | b"CellData") => {
                let on = if on == b"PointData" { On::Points } else { On::Cells };
                (found.on, found.scalars) = (is_open.then_some(on), attribute(&element, "Scalars"));
            }
            b"DataArray" => {
                let inline = if is_open { inline_text(&mut reader, bytes, start)? } else { (&b""[..], 0) };
                let is_one = attribute(&element, "NumberOfComponents").is_none_or(|n| n == "1");
                let is_named = found.scalars.is_some() && attribute(&element, "Name") == found.scalars;
                if let Some(on) = found.on.filter(|_| is_one) {
                    let claim = Claim { is_named, on };
                    if found.array.as_ref().is_none_or(|(_, best)| *best < claim) {
                        found.array = Some((DataArray::new(FORMAT, &element, inline)?, claim));
                    }
                }
            }
            b"AppendedData" => {
                let rest = bytes.get(start + reader.buffer_position() as usize..).unwrap_or_default();
                file.append(&element, rest)?;
                break;
            }
            _ => {}
        }
    }
    let file = file.ok_or_else(|| malformed(FORMAT, VtiProblem::NoElement { name: "VTKFile" }))?;
    let extent = found.whole.ok_or_else(|| malformed(FORMAT, VtiProblem::NoPoints))?;
    let (array, Claim { on, .. }) = found.array.ok_or_else(|| malformed(FORMAT, VtiProblem::NoArray))?;
    let pace = Pace::never();
    let opened = at_once(Arrays::new(&file, bytes, room, &pace).open(&array))?;
    let values = match opened.content {
        Content::Text { text, .. } => Values::Text(text),
        Content::Little(bytes) => Values::Little(bytes),
        Content::Big(bytes) => Values::Big(bytes),
    };
    let on_cells = on == On::Cells;
    Ok(make(Image { extent, origin, spacing, direction, on_cells, scalar: opened.kind, values }))
}

/// Fills `values` from the words of a text; `None` where there are not as many.
fn fill(text: &str, values: &mut [f64]) -> Option<()> {
    let mut words = text.split_ascii_whitespace();
    for value in values {
        *value = words.next()?.parse().ok()?;
    }
    words.next().is_none().then_some(())
}

/// First and last point along each axis.
fn extent(text: &str) -> Option<[[i64; 2]; 3]> {
    let mut ends = [0.0; 6];
    fill(text, &mut ends)?;
    let [a, b, c, d, e, f] = ends.map(|end| end as i64);
    Some([[a, b], [c, d], [e, f]])
}
