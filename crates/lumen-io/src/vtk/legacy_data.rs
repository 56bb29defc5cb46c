//! The arrays of a legacy VTK file: what stands behind `POINT_DATA` and `CELL_DATA`.
//!
//! Each attribute is a keyword with a name, a type and its numbers: `SCALARS` (of up to four components, with the name of
//! a colour table), `VECTORS`, `NORMALS`, `TEXTURE_COORDINATES`, `TENSORS`, the two kinds of ids, `COLOR_SCALARS`, and
//! `FIELD`, which holds any number of arrays. Names have their odd characters as `%20`. Normals are made anew, and colour
//! tables and texture coordinates mean nothing here: they are stepped over. Where something is not understood the
//! arrays up to there are kept, as the surface is already whole.

use super::super::columns::Columns;
use super::super::error::ReadError;
use super::super::memory_budget::MemoryBudget;
use super::super::numbers::Scalar;
use super::super::text::quoted;
use super::super::warnings::ArrayProblem;
use super::legacy_text::{Cursor, scalar};
use lumen_mesh::arrays::Association;

/// Reads the arrays on so many points and cells.
pub(super) async fn read(cursor: &mut Cursor<'_>, counts: [u64; 2], room: MemoryBudget) -> Result<Columns, ReadError> {
    let mut data = Data { columns: Columns::default(), on: Association::Point, counts };
    while let Some(word) = cursor.word() {
        room.check_parts(cursor.label(), data.columns.len())?;
        if data.attribute(word, cursor).await.is_none() {
            data.columns.leave_out(&String::from_utf8_lossy(word), ArrayProblem::NotUnderstood);
            break;
        }
    }
    let [points, cells] = data.counts.map(|count| usize::try_from(count).unwrap_or(usize::MAX));
    data.columns.end_part(points, cells);
    Ok(data.columns)
}

struct Data {
    columns: Columns,
    /// What the attributes are on.
    on: Association,
    /// Points and cells of the surface.
    counts: [u64; 2],
}

impl Data {
    /// Reads what a keyword begins; `None` where it is not understood.
    async fn attribute(&mut self, word: &[u8], cursor: &mut Cursor<'_>) -> Option<()> {
        match word.to_ascii_lowercase().as_slice() {
            b"point_data" => self.begin(Association::Point, cursor),
            b"cell_data" => self.begin(Association::Triangle, cursor),
            b"scalars" => {
                let (name, kind) = (name(cursor)?, cursor.word()?);
                let components = match cursor.rest_of_line() {
                    [] => 1,
                    word => std::str::from_utf8(word).ok()?.parse().ok()?,
                };
                if !cursor.comes(b"LOOKUP_TABLE") {
                    return None;
                }
                cursor.word();
                cursor.word()?;
                self.array(&name, kind, components, cursor).await
            }
            b"color_scalars" => {
                let (name, components) = (name(cursor)?, cursor.count().ok()?);
                // As bytes in binary, as parts of 1 in text.
                let kind: &[u8] = if cursor.is_binary { b"unsigned_char" } else { b"float" };
                self.array(&name, kind, components, cursor).await
            }
            b"lookup_table" => {
                let (_, rows) = (cursor.word()?, cursor.count().ok()?);
                let kind = if cursor.is_binary { Scalar::U8 } else { Scalar::F32 };
                cursor.numbers(kind, rows.saturating_mul(4)).await;
                Some(())
            }
            b"normals" => {
                let (_, kind) = (cursor.word()?, cursor.kind().ok()?);
                cursor.numbers(kind, self.count().saturating_mul(3)).await;
                Some(())
            }
            b"texture_coordinates" => {
                let (_, components, kind) = (cursor.word()?, cursor.count().ok()?, cursor.kind().ok()?);
                cursor.numbers(kind, self.count().saturating_mul(components)).await;
                Some(())
            }
            b"vectors" => self.named(3, cursor).await,
            b"tensors" => self.named(9, cursor).await,
            b"tensors6" => self.named(6, cursor).await,
            b"global_ids" | b"pedigree_ids" | b"edge_flags" => self.named(1, cursor).await,
            b"field" => self.field(cursor).await,
            b"metadata" => {
                cursor.skip_metadata();
                Some(())
            }
            _ => None,
        }
    }

    /// How many tuples an array has.
    fn count(&self) -> u64 {
        self.counts[usize::from(self.on == Association::Triangle)]
    }

    fn begin(&mut self, on: Association, cursor: &mut Cursor) -> Option<()> {
        self.on = on;
        (cursor.count().ok()? == self.count()).then_some(())
    }

    /// A name, a type, and so many components of each tuple.
    async fn named(&mut self, components: u64, cursor: &mut Cursor<'_>) -> Option<()> {
        let (name, kind) = (name(cursor)?, cursor.word()?);
        self.array(&name, kind, components, cursor).await
    }

    /// The arrays of a field.
    async fn field(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        cursor.word()?;
        let arrays = cursor.count().ok()?;
        for _ in 0..arrays {
            // An array of nothing takes no block of numbers.
            cursor.pace.rest(0.0).await;
            while cursor.comes(b"METADATA") {
                cursor.skip_metadata();
            }
            if cursor.comes(b"NULL_ARRAY") {
                cursor.word();
                continue;
            }
            let name = name(cursor)?;
            let (components, tuples, kind) = (cursor.count().ok()?, cursor.count().ok()?, cursor.word()?);
            if tuples == self.count() {
                self.array(&name, kind, components, cursor).await?;
            } else {
                cursor.skip_array(kind, components.saturating_mul(tuples)).await.ok()?;
                self.columns.leave_out(&name, ArrayProblem::OtherLength);
            }
        }
        Some(())
    }

    /// The numbers of an array.
    async fn array(&mut self, name: &str, kind: &[u8], components: u64, cursor: &mut Cursor<'_>) -> Option<()> {
        let count = components.saturating_mul(self.count());
        match scalar(kind).filter(|_| !kind.eq_ignore_ascii_case(b"bit")) {
            Some(scalar) => match cursor.numbers(scalar, count).await.values(count, cursor.pace).await {
                // No more than the numbers that are there.
                Ok(values) => self.columns.add(self.on, name, components as usize, values),
                Err(why) => self.columns.leave_out(name, why),
            },
            None => {
                cursor.skip_array(kind, count).await.ok()?;
                self.columns.leave_out(name, ArrayProblem::OfType { kind: quoted(kind) });
            }
        }
        Some(())
    }
}

/// A name without its `%20`.
fn name(cursor: &mut Cursor) -> Option<String> {
    let word = cursor.word()?;
    let mut bytes = Vec::with_capacity(word.len());
    let mut rest = word;
    while let [first, after @ ..] = rest {
        let code = after.get(..2).filter(|_| *first == b'%').and_then(|code| std::str::from_utf8(code).ok());
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    Some(String::from_utf8_lossy(&bytes).into_owned())
}
