//! The numbers of a VTK XML file, from where its structure says they are.

use std::borrow::Cow;

use super::super::Axes;
use super::super::columns::Columns;
use super::super::error::ReadError;
use super::super::numbers::Scalar;
use super::super::room::Room;
use super::super::text;
use super::array::{Array, Content};
use super::encoded::Encoded;
use super::surface::{Cells, Lengths, Shape, Surface};
use super::xml::{DataArray, KINDS, Piece, Place, Structure, line_of, malformed};
use crate::mesh::arrays::{On, Values};

/// The numbers behind the structure.
pub(super) struct Arrays<'a> {
    file: &'a Structure<'a>,
    bytes: &'a [u8],
    /// How many bytes compressed data may still unfold to.
    room: u64,
}

impl<'a> Arrays<'a> {
    /// Those of a file of these bytes, whose compressed data may unfold to `room` bytes.
    pub(super) fn new(file: &'a Structure<'a>, bytes: &'a [u8], room: u64) -> Self {
        Self { file, bytes, room }
    }

    /// Adds the points and cells of a piece, `first` cells of the file standing before them.
    pub(super) fn add_piece(&mut self, piece: &Piece<'a>, first: u64, surface: &mut Surface) -> Result<(), ReadError> {
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
            let first = first.saturating_add(piece.cells_before(kind + 1));
            surface.add_cells(&Cells { shape, count, first, lengths: Lengths::Ends(ends), points, types })?;
        }
        Ok(())
    }

    /// The numbers of an array, which must be whole ones.
    fn open_whole(&mut self, array: &DataArray<'a>) -> Result<Array<'a>, ReadError> {
        let opened = self.open(array)?;
        if !opened.kind.is_whole() && !matches!(opened.content, Content::Text { .. }) {
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

    /// The arrays on points and cells; to be asked for after the surface, so that they take no room from it.
    pub(super) fn columns(&mut self) -> Result<Columns, ReadError> {
        let (mut columns, structure) = (Columns::default(), self.file);
        for piece in &structure.pieces {
            let counts = [piece.counts[0], piece.cell_count()];
            for (on, array) in &piece.data {
                Room::of(self.bytes.len()).check_parts(structure.format, columns.len())?;
                let rows = counts[usize::from(*on == On::Triangle)];
                match self.values(array, rows.saturating_mul(array.components)) {
                    // The components are no more than the numbers there are.
                    Ok(values) => columns.add(*on, &array.name, array.components as usize, values),
                    Err(why) => columns.leave_out(&array.name, why),
                }
            }
            let [points, cells] = counts.map(|count| usize::try_from(count).unwrap_or(usize::MAX));
            columns.end_part(points, cells);
        }
        Ok(columns)
    }

    /// The numbers of an array on points or cells, or why they cannot be had.
    fn values(&mut self, array: &DataArray<'a>, count: u64) -> Result<Values, &'static str> {
        if array.kind == "String" {
            return Err("it holds text");
        }
        if scalar(&array.kind).is_none() {
            return Err("its numbers are of a type that is not read");
        }
        let opened = self.open(array).map_err(|_| "its data are damaged, or too many for a file of this size")?;
        opened.values(count)
    }

    /// The axes that a string of the field data names.
    pub(super) fn axes(&mut self, array: &DataArray<'a>) -> Result<Axes, ReadError> {
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
