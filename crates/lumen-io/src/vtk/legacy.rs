//! Legacy VTK files (.vtk) of polygonal data and unstructured grids, text and binary, versions 1.0 to 5.1.
//!
//! Up to version 4.2 each cell stands with its length; from 5.0 on lengths and points are two arrays. Which it is shows at
//! the first word. Then come the arrays on points and cells (`legacy_data.rs`).

use glam::DVec3;

use super::super::axes;
use super::super::error::ReadError;
use super::super::memory_budget::MemoryBudget;
use super::super::numbers::Scalar;
use super::super::pace::Pace;
use super::super::problem::VtkProblem;
use super::super::raw::RawSurface;
use super::super::text;
use super::array::Array;
use super::legacy_data;
use super::legacy_text::Cursor;
use super::no_surface;
use super::surface::{Cells, Lengths, Shape, Surface};

const MAGIC: &[u8] = b"# vtk DataFile";

/// Whether a text begins as legacy VTK files do.
pub(crate) fn is_legacy(text: &[u8]) -> bool {
    text.len() >= MAGIC.len() && text[..MAGIC.len()].eq_ignore_ascii_case(MAGIC)
}

/// What a file holds, as it stands there.
#[derive(Default)]
struct Parts<'a> {
    points: Option<(Array<'a>, u64)>,
    cells: Vec<Cells<'a>>,
    /// Whether arrays on points or cells follow.
    has_data: bool,
}

/// Reads a file, with positions relative to `origin`.
pub(super) async fn read(bytes: &[u8], origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    let (mut cursor, title) = begin(bytes, pace)?;
    let label = cursor.label();
    let room = MemoryBudget::of(bytes.len());
    let parts = Parts::read(&mut cursor, room).await?;
    let mut surface = Surface::new(label, bytes.len(), origin);
    if let Some((points, count)) = &parts.points {
        surface.add_points(points, *count, pace).await?;
    }
    if parts.has_data {
        surface.note_cells();
    }
    for cells in &parts.cells {
        surface.add_cells(cells, pace).await?;
    }
    let counts = [surface.vertices() as u64, parts.cell_count()];
    let columns = legacy_data::read(&mut cursor, counts, room).await?;
    surface.finish(label, axes::stated(title), columns)
}

/// Goes over the first three lines, of which the second is a title.
pub(super) fn begin<'a>(bytes: &'a [u8], pace: &'a Pace) -> Result<(Cursor<'a>, &'a [u8]), ReadError> {
    let mut cursor = Cursor::new(text::without_mark(bytes).trim_ascii_start(), pace);
    cursor.rest_of_line();
    let title = cursor.rest_of_line();
    let encoding = cursor.word().unwrap_or_default();
    cursor.is_binary = encoding.eq_ignore_ascii_case(b"binary");
    if !cursor.is_binary && !encoding.eq_ignore_ascii_case(b"ascii") {
        return Err(cursor.broken(VtkProblem::ThirdLine));
    }
    cursor.rest_of_line();
    Ok((cursor, title))
}

impl<'a> Parts<'a> {
    /// Finds points and cells, up to the first array on either.
    async fn read(cursor: &mut Cursor<'a>, room: MemoryBudget) -> Result<Self, ReadError> {
        let mut parts = Self::default();
        while let Some(word) = cursor.word() {
            room.check_parts(cursor.label(), parts.cells.len())?;
            match word.to_ascii_lowercase().as_slice() {
                b"dataset" => {
                    let kind = cursor.word().unwrap_or_default();
                    if !kind.eq_ignore_ascii_case(b"polydata") && !kind.eq_ignore_ascii_case(b"unstructured_grid") {
                        return Err(no_surface(&String::from_utf8_lossy(kind)));
                    }
                }
                b"points" => {
                    let (count, kind) = (cursor.count()?, cursor.kind()?);
                    parts.points = Some((cursor.numbers(kind, count.saturating_mul(3)).await, count));
                }
                b"vertices" => parts.read_cells(cursor, Shape::Vertices).await?,
                b"lines" => parts.read_cells(cursor, Shape::Lines).await?,
                b"polygons" => parts.read_cells(cursor, Shape::Polygons).await?,
                b"triangle_strips" => parts.read_cells(cursor, Shape::Strips).await?,
                b"cells" => parts.read_cells(cursor, Shape::Typed).await?,
                b"cell_types" => {
                    let count = cursor.count()?;
                    let types = cursor.numbers(Scalar::I32, count).await;
                    if let Some(cells) = parts.cells.last_mut() {
                        cells.types = Some(types);
                    }
                }
                b"field" => skip_field(cursor).await?,
                b"metadata" => cursor.skip_metadata(),
                b"cell_data" | b"point_data" => {
                    cursor.go_back(word);
                    parts.has_data = true;
                    break;
                }
                _ => return Err(cursor.broken(VtkProblem::NoPart { word: text::quoted(word) })),
            }
        }
        if parts.cells.iter().any(|cells| cells.shape == Shape::Typed && cells.types.is_none()) {
            return Err(cursor.broken(VtkProblem::NoTypes));
        }
        parts.number_cells();
        Ok(parts)
    }

    /// Numbers the cells as VTK's arrays have them, whatever the order of the lists in the file.
    fn number_cells(&mut self) {
        let mut first = 0u64;
        for shape in [Shape::Vertices, Shape::Lines, Shape::Polygons, Shape::Strips, Shape::Typed] {
            for cells in self.cells.iter_mut().filter(|cells| cells.shape == shape) {
                cells.first = first;
                first = first.saturating_add(cells.count);
            }
        }
    }

    /// How many cells there are.
    fn cell_count(&self) -> u64 {
        self.cells.iter().fold(0, |sum, cells| sum.saturating_add(cells.count))
    }

    /// Reads a list of cells.
    async fn read_cells(&mut self, cursor: &mut Cursor<'a>, shape: Shape) -> Result<(), ReadError> {
        let (count, size) = (cursor.count()?, cursor.count()?);
        let (count, lengths, points) = if cursor.comes(b"OFFSETS") {
            let bounds = part_of_cells(cursor, "OFFSETS", count).await?;
            let points = part_of_cells(cursor, "CONNECTIVITY", size).await?;
            (count.saturating_sub(1), Lengths::Bounds(bounds), points)
        } else {
            (count, Lengths::Inline, cursor.numbers(Scalar::I32, size).await)
        };
        self.cells.push(Cells { shape, count, first: 0, lengths, points, types: None });
        Ok(())
    }
}

/// Reads one of the two arrays that are cells from version 5.0 on.
async fn part_of_cells<'a>(cursor: &mut Cursor<'a>, name: &'static str, count: u64) -> Result<Array<'a>, ReadError> {
    if !cursor.comes(name.as_bytes()) {
        return Err(cursor.broken(VtkProblem::CellsLack { name }));
    }
    cursor.word();
    let kind = cursor.kind()?;
    if !kind.is_whole() {
        return Err(cursor.broken(VtkProblem::Fractions));
    }
    Ok(cursor.numbers(kind, count).await)
}

/// Steps over field data.
async fn skip_field(cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
    cursor.word();
    let arrays = cursor.count()?;
    for _ in 0..arrays {
        while cursor.comes(b"METADATA") {
            cursor.skip_metadata();
        }
        match cursor.word() {
            None => break,
            Some(b"NULL_ARRAY") => {}
            Some(_) => {
                let (components, tuples) = (cursor.count()?, cursor.count()?);
                let kind = cursor.word().unwrap_or_default();
                cursor.skip_array(kind, components.saturating_mul(tuples)).await?;
            }
        }
    }
    Ok(())
}
