//! Legacy VTK files of structured points: a grid of points and an array of numbers on them, or on the cells between.
//!
//! The first array of one number each is read, on points before cells.

use super::super::error::ReadError;
use super::super::numbers::Scalar;
use super::super::pace::Pace;
use super::super::problem::{TextProblem, VtiProblem, VtkProblem};
use super::super::text;
use super::array::{Array, Content};
use super::image::{Image, Values};
use super::legacy::begin;
use super::legacy_text::{Cursor, scalar};
use lumen_mesh::task::at_once;

/// What a file says of its grid, and its numbers.
struct Found<'a> {
    size: Option<[f64; 3]>,
    origin: [f64; 3],
    spacing: [f64; 3],
    /// What the arrays that come are on, and how many numbers they have.
    on_cells: bool,
    count: u64,
    array: Option<(Array<'a>, bool)>,
}

/// Reads a file.
pub(crate) fn read<T>(bytes: &[u8], make: impl FnOnce(Image) -> T) -> Result<T, ReadError> {
    let pace = Pace::never();
    let (mut cursor, _) = begin(bytes, &pace)?;
    let mut found = Found { size: None, origin: [0.0; 3], spacing: [1.0; 3], on_cells: false, count: 0, array: None };
    while let Some(word) = cursor.word() {
        found.take(word, &mut cursor)?;
        if found.array.as_ref().is_some_and(|(_, on_cells)| !on_cells) {
            break;
        }
    }
    let problem = |problem: VtiProblem| ReadError::malformed(cursor.label(), problem);
    let size = found.size.ok_or_else(|| problem(VtiProblem::NoPoints))?;
    let (array, on_cells) = found.array.ok_or_else(|| problem(VtiProblem::NoArray))?;
    let values = match array.content {
        Content::Text { text, .. } => Values::Text(text),
        Content::Little(bytes) => Values::Little(bytes),
        Content::Big(bytes) => Values::Big(bytes),
    };
    let direction = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let extent = size.map(|along| [0, along as i64 - 1]);
    let Found { origin, spacing, .. } = found;
    Ok(make(Image { extent, origin, spacing, direction, on_cells, scalar: array.kind, values }))
}

impl<'a> Found<'a> {
    /// Reads what a keyword begins.
    fn take(&mut self, word: &[u8], cursor: &mut Cursor<'a>) -> Result<(), ReadError> {
        match word.to_ascii_lowercase().as_slice() {
            b"dataset" => drop(cursor.word()),
            b"dimensions" => self.size = Some(three(cursor)?),
            b"origin" => self.origin = three(cursor)?,
            b"spacing" | b"aspect_ratio" => self.spacing = three(cursor)?,
            on @ (b"point_data" | b"cell_data") => {
                (self.on_cells, self.count) = (on == b"cell_data", cursor.count()?);
            }
            b"scalars" => {
                let (_, kind) = (cursor.word(), cursor.word().unwrap_or_default());
                let components = match cursor.rest_of_line() {
                    [] => 1,
                    count => text::number(count)
                        .ok_or_else(|| cursor.broken(TextProblem::NoCount { word: text::quoted(count) }))?,
                };
                if cursor.comes(b"LOOKUP_TABLE") {
                    let _ = (cursor.word(), cursor.word());
                }
                self.array(kind, components, self.count, cursor)?;
            }
            b"field" => {
                cursor.word();
                for _ in 0..cursor.count()? {
                    while cursor.comes(b"METADATA") {
                        cursor.skip_metadata();
                    }
                    cursor.word();
                    let (components, tuples) = (cursor.count()?, cursor.count()?);
                    let kind = cursor.word().unwrap_or_default();
                    self.array(kind, components, tuples, cursor)?;
                }
            }
            b"lookup_table" => {
                let (_, rows) = (cursor.word(), cursor.count()?);
                let kind = if cursor.is_binary { Scalar::U8 } else { Scalar::F32 };
                at_once(cursor.numbers(kind, rows.saturating_mul(4)));
            }
            b"metadata" => cursor.skip_metadata(),
            b"vectors" | b"normals" => {
                let (_, kind) = (cursor.word(), cursor.kind()?);
                at_once(cursor.numbers(kind, self.count.saturating_mul(3)));
            }
            _ => return Err(cursor.broken(VtkProblem::NoPart { word: text::quoted(word) })),
        }
        Ok(())
    }

    /// Takes the numbers of an array, if they are one for each point or cell and better than those there are.
    fn array(&mut self, kind: &[u8], components: u64, tuples: u64, cursor: &mut Cursor<'a>) -> Result<(), ReadError> {
        let wanted = components == 1 && tuples == self.count && tuples > 0;
        let is_better = self.array.as_ref().is_none_or(|(_, on_cells)| *on_cells && !self.on_cells);
        match scalar(kind).filter(|_| wanted && is_better && !kind.eq_ignore_ascii_case(b"bit")) {
            Some(scalar) => self.array = Some((at_once(cursor.numbers(scalar, tuples)), self.on_cells)),
            None => at_once(cursor.skip_array(kind, components.saturating_mul(tuples)))?,
        }
        Ok(())
    }
}

fn three(cursor: &mut Cursor) -> Result<[f64; 3], ReadError> {
    let mut found = [0.0; 3];
    for number in &mut found {
        let word = cursor.word().ok_or_else(|| cursor.broken(VtkProblem::EndsAtCount))?;
        *number =
            text::number(word).ok_or_else(|| cursor.broken(TextProblem::NoNumber { word: text::quoted(word) }))?;
    }
    Ok(found)
}
