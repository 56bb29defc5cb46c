//! The numbers of a VTK XML file, from where its structure says they are.

use std::borrow::Cow;

use super::super::Axes;
use super::super::columns::Columns;
use super::super::error::ReadError;
use super::super::memory_budget::MemoryBudget;
use super::super::numbers::Scalar;
use super::super::pace::{BYTES, Pace};
use super::super::problem::{TextProblem, VtkProblem};
use super::super::text;
use super::super::warnings::ArrayProblem;
use super::array::{Array, Content};
use super::encoded::Encoded;
use super::surface::{Cells, Lengths, Shape, Surface};
use super::xml_structure::{DataArray, KINDS, Piece, Place, Structure, line_of, malformed};
use lumen_mesh::arrays::{Association, Values};

/// The numbers behind the structure.
pub(super) struct Arrays<'a> {
    file: &'a Structure<'a>,
    bytes: &'a [u8],
    /// How many bytes compressed data may still unfold to.
    room: u64,
    pace: &'a Pace,
    /// The byte up to which lines were counted, and its line.
    counted: (usize, usize),
}

impl<'a> Arrays<'a> {
    /// Those of a file of these bytes, whose compressed data may unfold to `room` bytes.
    pub(super) fn new(file: &'a Structure<'a>, bytes: &'a [u8], room: u64, pace: &'a Pace) -> Self {
        Self { file, bytes, room, pace, counted: (0, 1) }
    }

    /// Adds the points and cells of a piece, `first` cells of the file standing before them.
    pub(super) async fn add_piece(
        &mut self,
        piece: &Piece<'a>,
        first: u64,
        surface: &mut Surface,
    ) -> Result<(), ReadError> {
        let [points, kinds @ ..] = piece.counts;
        if let (Some(array), true) = (&piece.points, points > 0) {
            surface.add_points(&self.open(array).await?, points, self.pace).await?;
        }
        for (kind, (&count, &(_, element, shape))) in kinds.iter().zip(&KINDS[1..]).enumerate() {
            if count == 0 {
                continue;
            }
            let missing = || malformed(self.file.format, VtkProblem::NoArrays { element });
            let [connectivity, offsets, types] = [0, 1, 2].map(|part| piece.cells(kind + 1, part));
            let (Some(connectivity), Some(offsets)) = (connectivity, offsets) else { return Err(missing()) };
            if piece.points.is_none() {
                return Err(malformed(self.file.format, VtkProblem::NoPoints));
            }
            if shape == Shape::Typed && types.is_none() {
                return Err(missing());
            }
            // Vertices and lines are only counted.
            let is_surface = !matches!(shape, Shape::Vertices | Shape::Lines);
            let (ends, points) =
                (self.open_cells(offsets, is_surface).await?, self.open_cells(connectivity, is_surface).await?);
            let types = match types {
                Some(types) if shape == Shape::Typed => Some(self.open_cells(types, is_surface).await?),
                _ => None,
            };
            let first = first.saturating_add(piece.cells_before(kind + 1));
            let cells = Cells { shape, count, first, lengths: Lengths::Ends(ends), points, types };
            surface.add_cells(&cells, self.pace).await?;
        }
        Ok(())
    }

    /// The numbers of an array of cells, which must be whole ones; none where they are not of a surface.
    async fn open_cells(&mut self, array: &DataArray<'a>, is_surface: bool) -> Result<Array<'a>, ReadError> {
        if !is_surface {
            return Ok(Array { kind: Scalar::U8, content: Content::Little(Cow::Borrowed(b"")), weight: 0.0 });
        }
        let opened = self.open(array).await?;
        if !opened.kind.is_whole() && !matches!(opened.content, Content::Text { .. }) {
            return Err(malformed(self.file.format, VtkProblem::Fractions));
        }
        Ok(opened)
    }

    /// The numbers of an array.
    pub(super) async fn open(&mut self, array: &DataArray<'a>) -> Result<Array<'a>, ReadError> {
        let format = self.file.format;
        let kind = scalar(&array.kind)
            .ok_or_else(|| malformed(format, TextProblem::NoType { word: text::quoted(array.kind.as_bytes()) }))?;
        let encoding = self.file.encoding;
        let (bytes, left) = match array.place {
            Place::Text(text, at) => {
                // Lines are counted at once, some milliseconds in 40 MB.
                let content = Content::Text { text, line: self.line_of(at) };
                self.pace.rest(0.0).await;
                return Ok(Array { kind, content, weight: 1.0 });
            }
            Place::Binary(text) => match compact(text.trim_ascii(), self.pace).await {
                Cow::Borrowed(text) => encoding.decode(Encoded::Base64(text), &mut self.room, self.pace).await?,
                Cow::Owned(text) => {
                    let decoded = encoding.decode(Encoded::Base64(&text), &mut self.room, self.pace).await?;
                    (Cow::Owned(decoded.0.into_owned()), decoded.1)
                }
            },
            Place::Appended(offset) => {
                let rest = self.file.appended.and_then(|(data, is_base64)| {
                    let rest = data.get(usize::try_from(offset).ok()?..)?;
                    Some(if is_base64 { Encoded::Base64(rest) } else { Encoded::Raw(rest) })
                });
                let rest = rest.ok_or_else(|| malformed(format, VtkProblem::ArrayBeyond))?;
                encoding.decode(rest, &mut self.room, self.pace).await?
            }
        };
        let weight = left / bytes.len().max(1) as f64;
        let content = if encoding.big_endian { Content::Big(bytes) } else { Content::Little(bytes) };
        Ok(Array { kind, content, weight })
    }

    /// The line that a byte stands in, counted on from where that was last asked.
    fn line_of(&mut self, at: usize) -> usize {
        let (from, line) = if at < self.counted.0 { (0, 1) } else { self.counted };
        self.counted = (at, line - 1 + line_of(&self.bytes[from..], at - from));
        self.counted.1
    }

    /// The arrays on points and cells; to be asked for after the surface, so that they take no room from it.
    pub(super) async fn columns(&mut self) -> Result<Columns, ReadError> {
        let (mut columns, structure) = (Columns::default(), self.file);
        for piece in &structure.pieces {
            let counts = [piece.counts[0], piece.cell_count()];
            for (on, array) in &piece.data {
                MemoryBudget::of(self.bytes.len()).check_parts(structure.format, columns.len())?;
                let rows = counts[usize::from(*on == Association::Triangle)];
                match self.values(array, rows.saturating_mul(array.components)).await {
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
    async fn values(&mut self, array: &DataArray<'a>, count: u64) -> Result<Values, ArrayProblem> {
        if array.kind == "String" {
            return Err(ArrayProblem::Text);
        }
        if scalar(&array.kind).is_none() {
            return Err(ArrayProblem::NumberType);
        }
        let opened = self.open(array).await;
        let opened = opened.map_err(|_| ArrayProblem::TooMany)?;
        opened.values(count, self.pace).await
    }

    /// The axes that a string of the field data names.
    pub(super) async fn axes(&mut self, array: &DataArray<'a>) -> Result<Axes, ReadError> {
        let letters = self.open(&DataArray { kind: "UInt8".to_owned(), ..array.clone() }).await?;
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
async fn compact<'a>(text: &'a [u8], pace: &Pace) -> Cow<'a, [u8]> {
    let mut compacted: Option<Vec<u8>> = None;
    for (n, block) in text.chunks(BYTES).enumerate() {
        if compacted.is_none() && block.iter().any(u8::is_ascii_whitespace) {
            compacted = Some(text[..n * BYTES].to_vec());
        }
        if let Some(compacted) = &mut compacted {
            compacted.extend(block.iter().filter(|byte| !byte.is_ascii_whitespace()));
        }
        pace.rest(0.0).await;
    }
    compacted.map_or(Cow::Borrowed(text), Cow::Owned)
}
