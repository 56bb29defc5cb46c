//! What the cells of a VTK file make together: the polygons of all its pieces over one list of points.

use glam::DVec3;

use super::super::Axes;
use super::super::columns::Columns;
use super::super::error::ReadError;
use super::super::import::{RawSurface, count};
use super::super::numbers::Numbers;
use super::super::polygons::Faces;
use super::super::report::Skipped;
use super::super::room::Room;
use super::array::Array;
use crate::mesh::Vec3;

/// What the cells of a list are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Vertices,
    Lines,
    Polygons,
    Strips,
    /// Each says its own: cells of an unstructured grid.
    Typed,
}

/// How long each cell of a list is.
pub(super) enum Lengths<'a> {
    /// It stands before the cell's points.
    Inline,
    /// Where each cell ends in the list of all points.
    Ends(Array<'a>),
    /// The same, after a 0 where the first begins.
    Bounds(Array<'a>),
}

/// A list of cells.
pub(super) struct Cells<'a> {
    pub(super) shape: Shape,
    /// As the file claims it.
    pub(super) count: u64,
    /// The number of the first among all cells of the file, in VTK's order: vertices, lines, polygons, strips.
    pub(super) first: u64,
    pub(super) lengths: Lengths<'a>,
    /// The points of all cells.
    pub(super) points: Array<'a>,
    /// The type of each cell where the shape is [`Shape::Typed`].
    pub(super) types: Option<Array<'a>>,
}

/// The surface as far as it has been read.
pub(super) struct Surface {
    /// The format, for errors.
    format: &'static str,
    origin: DVec3,
    room: Room,
    positions: Vec<Vec3>,
    /// Where the points of the last piece begin.
    base: usize,
    faces: Faces,
    /// Faces read so far, short ones included.
    faces_read: usize,
    /// Whether it is noted which cell a face is of.
    notes_cells: bool,
    has_doubles: bool,
    skipped: Skipped,
    /// Cells of a grid that are neither flat nor lines nor points.
    solids: u64,
}

impl Surface {
    /// Nothing yet, of a file of `file` bytes; points will be relative to `origin`.
    pub(super) fn new(format: &'static str, file: usize, origin: DVec3) -> Self {
        Self {
            format,
            origin,
            room: Room::of(file),
            positions: Vec::new(),
            base: 0,
            faces: Faces::default(),
            faces_read: 0,
            notes_cells: false,
            has_doubles: false,
            skipped: Skipped::default(),
            solids: 0,
        }
    }

    /// Notes which cell each face is of; to be asked for before the first.
    pub(super) fn note_cells(&mut self) {
        self.notes_cells = true;
    }

    /// Adds the points of the next piece, `count` of them as the file claims.
    pub(super) fn add_points(&mut self, array: &Array, count: u64) -> Result<(), ReadError> {
        self.base = self.positions.len();
        self.has_doubles |= array.has_doubles();
        let most = array.most() / 3;
        self.positions.reserve(usize::try_from(count).unwrap_or(most).min(most));
        let mut numbers = array.numbers(self.format);
        let [x, y, z] = self.origin.to_array();
        for n in 0..count {
            let mut next = |origin| numbers.coordinate(array.kind, origin);
            let (Some(x), Some(y), Some(z)) = (next(x), next(y), next(z)) else {
                return Err(self.ended(&mut *numbers, "points", count, n));
            };
            self.positions.push(Vec3::new(x, y, z));
        }
        self.room.check(self.format, self.positions.len(), self.faces.triangles())
    }

    /// Adds cells over the points of the last piece.
    pub(super) fn add_cells(&mut self, cells: &Cells) -> Result<(), ReadError> {
        let count = usize::try_from(cells.count).unwrap_or(usize::MAX);
        match cells.shape {
            Shape::Vertices => self.skipped.points = self.skipped.points.saturating_add(count),
            Shape::Lines => self.skipped.lines = self.skipped.lines.saturating_add(count),
            Shape::Polygons | Shape::Strips | Shape::Typed => self.add_faces(cells)?,
        }
        Ok(())
    }

    fn add_faces(&mut self, cells: &Cells) -> Result<(), ReadError> {
        let (format, kind) = (self.format, cells.points.kind);
        let mut points = cells.points.numbers(format);
        let (mut ends, end_kind) = match &cells.lengths {
            Lengths::Inline => (None, kind),
            Lengths::Ends(array) | Lengths::Bounds(array) => (Some(array.numbers(format)), array.kind),
        };
        if let (Lengths::Bounds(_), Some(bounds)) = (&cells.lengths, &mut ends) {
            bounds.number(end_kind);
        }
        let mut types = cells.types.as_ref().map(|array| (array.numbers(format), array.kind));
        let mut last_end = 0;
        let mut cell = Vec::new();
        for n in 0..cells.count {
            let numbers = ends.as_mut().unwrap_or(&mut points);
            let Some(number) = numbers.number(end_kind) else {
                return Err(self.ended(&mut **numbers, "cells", cells.count, n));
            };
            let length =
                number - if ends.is_some() { std::mem::replace(&mut last_end, number as u64) as f64 } else { 0.0 };
            if !(length >= 0.0 && length.fract() == 0.0) {
                let problem = format!("cell {} has the length {length}", n + 1);
                return Err(ReadError::Malformed { format, problem });
            }
            cell.clear();
            self.faces_read += 1;
            if self.notes_cells {
                // Where 32 bits do not hold it, there is no array with so many tuples either.
                self.faces.of_cell(u32::try_from(cells.first.saturating_add(n)).unwrap_or(u32::MAX));
            }
            // A number makes a triangle at most.
            let most = usize::try_from(length as u64).unwrap_or(usize::MAX).min(cells.points.most());
            self.room.check(format, self.positions.len(), self.faces.triangles() + most)?;
            // A length that is a lie ends with the numbers.
            for _ in 0..length as u64 {
                let Some(number) = points.number(kind) else {
                    return Err(self.ended(&mut *points, "cells", cells.count, n));
                };
                cell.push(self.vertex(number)?);
            }
            match &mut types {
                None => self.add_face(cells.shape, &mut cell),
                Some((types, kind)) => match types.number(*kind) {
                    Some(number) => self.add_typed(number, &mut cell),
                    None => return Err(self.ended(&mut **types, "types of cells", cells.count, n)),
                },
            }
        }
        Ok(())
    }

    fn add_face(&mut self, shape: Shape, cell: &mut [u32]) {
        if shape == Shape::Strips && cell.len() > 3 {
            for (i, three) in cell.windows(3).enumerate() {
                let [a, b, c] = [three[0], three[1], three[2]];
                self.faces.push(&if i % 2 == 0 { [a, b, c] } else { [b, a, c] });
            }
        } else {
            self.faces.push(cell);
        }
    }

    /// Adds a cell of an unstructured grid by the number that VTK has for its type.
    fn add_typed(&mut self, number: f64, cell: &mut [u32]) {
        match number as u32 {
            // An empty cell.
            0 => {}
            1 | 2 => self.skipped.points += 1,
            3 | 4 => self.skipped.lines += 1,
            6 => self.add_face(Shape::Strips, cell),
            8 => {
                // A pixel numbers its corners row by row.
                if cell.len() == 4 {
                    cell.swap(2, 3);
                }
                self.add_face(Shape::Polygons, cell);
            }
            5 | 7 | 9 => self.add_face(Shape::Polygons, cell),
            _ => self.solids += 1,
        }
    }

    /// The vertex that a number stands for, among those of the last piece.
    fn vertex(&self, number: f64) -> Result<u32, ReadError> {
        let vertices = self.positions.len() - self.base;
        // The comparison is false for NaN.
        if number >= 0.0 && number < vertices as f64 && number.fract() == 0.0 {
            return Ok((self.base + number as usize) as u32);
        }
        Err(ReadError::IndexOutOfRange { format: self.format, face: self.faces_read, index: number as i64, vertices })
    }

    /// Why there is no next number.
    fn ended(&self, numbers: &mut dyn Numbers, what: &str, announced: u64, found: u64) -> ReadError {
        let cut_short = ReadError::CutShort { format: self.format, what: what.to_owned(), announced, found };
        numbers.fault().unwrap_or(cut_short)
    }

    /// Vertices so far.
    pub(super) fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// The whole, with what is said about its axes, and with its arrays.
    pub(super) fn finish(self, label: &'static str, axes: Axes, columns: Columns) -> Result<RawSurface, ReadError> {
        let Skipped { lines, points, .. } = self.skipped;
        if self.faces_read == 0 && (lines > 0 || points > 0) {
            let [lines, points] = [count(lines, "line", "lines"), count(points, "point", "points")];
            return Err(ReadError::NoSurface { format: self.format, found: format!("{lines} and {points}") });
        }
        if self.faces.triangles() == 0 && self.solids > 0 {
            return Err(ReadError::VtkKind { kind: "a grid of solid cells".to_owned() });
        }
        let mut raw = RawSurface::of_faces(label, self.positions, &self.faces);
        (raw.has_doubles, raw.origin, raw.axes) = (self.has_doubles, self.origin, axes);
        (raw.skipped.lines, raw.skipped.points) = (lines, points);
        if self.solids > 0 {
            raw.warnings.push(format!("{} solid or curved cells left out: Lumen shows surfaces.", self.solids));
        }
        raw.carry(columns.finish(), self.room);
        Ok(raw)
    }
}
