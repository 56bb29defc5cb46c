//! What the cells of a VTK file make together: the polygons of all its pieces over one list of points.

use std::mem;
use std::ops::Range;

use glam::DVec3;

use super::super::Axes;
use super::super::columns::Columns;
use super::super::error::{Counted, Elements, Named, ReadError, Unnamed};
use super::super::memory_budget::MemoryBudget;
use super::super::numbers::{Numbers, Scalar};
use super::super::pace::{NUMBERS, Pace};
use super::super::polygons::Faces;
use super::super::problem::VtkProblem;
use super::super::raw::RawSurface;
use super::super::report::Skipped;
use super::super::warnings::Warning;
use super::array::Array;
use lumen_mesh::Vec3;

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

/// Numbers of a list of cells, and the number that is next.
struct Stream<'a> {
    numbers: Box<dyn Numbers + Send + 'a>,
    kind: Scalar,
    weight: f64,
}

impl<'a> Stream<'a> {
    fn new(array: &'a Array, format: &'static str) -> Self {
        Self { numbers: array.numbers(format), kind: array.kind, weight: array.weight }
    }

    fn next(&mut self) -> Option<f64> {
        self.numbers.number(self.kind)
    }

    /// Bytes of the file that are left.
    fn left(&self) -> f64 {
        self.weight * self.numbers.remaining() as f64
    }
}

/// A list of cells that is being read.
struct Begun<'a> {
    points: Stream<'a>,
    /// Where the cells end, if it does not stand before their points.
    ends: Option<Stream<'a>>,
    types: Option<Stream<'a>>,
    last_end: u64,
    /// The cell under way: its number in the list, the vertices that are there, and how many are not, once it is known.
    at: u64,
    cell: Vec<u32>,
    missing: Option<u64>,
}

impl<'a> Begun<'a> {
    fn new(cells: &'a Cells<'a>, format: &'static str) -> Self {
        let mut ends = match &cells.lengths {
            Lengths::Inline => None,
            Lengths::Ends(array) | Lengths::Bounds(array) => Some(Stream::new(array, format)),
        };
        if let (Lengths::Bounds(_), Some(bounds)) = (&cells.lengths, &mut ends) {
            bounds.next();
        }
        let types = cells.types.as_ref().map(|array| Stream::new(array, format));
        let points = Stream::new(&cells.points, format);
        Self { points, ends, types, last_end: 0, at: 0, cell: Vec::new(), missing: None }
    }

    /// Bytes of the file that are left.
    fn left(&self) -> f64 {
        [Some(&self.points), self.ends.as_ref(), self.types.as_ref()].into_iter().flatten().map(Stream::left).sum()
    }
}

/// The surface as far as it has been read.
pub(super) struct Surface {
    /// The format, for errors.
    format: &'static str,
    origin: DVec3,
    room: MemoryBudget,
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
    /// Cells of a grid that are neither faces nor lines nor points.
    solids: u64,
    /// Faces of a grid that are curved.
    curved: usize,
}

impl Surface {
    /// Nothing yet, of a file of `file` bytes; points will be relative to `origin`.
    pub(super) fn new(format: &'static str, file: usize, origin: DVec3) -> Self {
        Self {
            format,
            origin,
            room: MemoryBudget::of(file),
            positions: Vec::new(),
            base: 0,
            faces: Faces::default(),
            faces_read: 0,
            notes_cells: false,
            has_doubles: false,
            skipped: Skipped::default(),
            solids: 0,
            curved: 0,
        }
    }

    /// Notes which cell each face is of; to be asked for before the first.
    pub(super) fn note_cells(&mut self) {
        self.notes_cells = true;
    }

    /// Adds the points of the next piece, `count` of them as the file claims.
    pub(super) async fn add_points(&mut self, array: &Array<'_>, count: u64, pace: &Pace) -> Result<(), ReadError> {
        self.base = self.positions.len();
        self.has_doubles |= array.has_doubles();
        let most = array.most() / 3;
        self.positions.reserve(usize::try_from(count).unwrap_or(most).min(most));
        let mut numbers = array.numbers(self.format);
        let mut read = 0;
        while read < count {
            let before = numbers.remaining();
            // Of three numbers each.
            let end = count.min(read.saturating_add(NUMBERS as u64 / 3));
            self.take_points(&mut *numbers, array.kind, read..end, count)?;
            read = end;
            pace.rest(array.weight * (before - numbers.remaining()) as f64).await;
        }
        self.room.check(self.format, self.positions.len(), self.faces.triangles())
    }

    /// Adds points of the last piece: those of these numbers among `count`.
    fn take_points(
        &mut self,
        numbers: &mut dyn Numbers,
        kind: Scalar,
        block: Range<u64>,
        count: u64,
    ) -> Result<(), ReadError> {
        let [x, y, z] = self.origin.to_array();
        for n in block {
            let mut next = |origin| numbers.coordinate(kind, origin);
            let (Some(x), Some(y), Some(z)) = (next(x), next(y), next(z)) else {
                return Err(self.ended(numbers, Counted::Points, count, n));
            };
            self.positions.push(Vec3::new(x, y, z));
        }
        Ok(())
    }

    /// Adds cells over the points of the last piece.
    pub(super) async fn add_cells(&mut self, cells: &Cells<'_>, pace: &Pace) -> Result<(), ReadError> {
        let count = usize::try_from(cells.count).unwrap_or(usize::MAX);
        match cells.shape {
            Shape::Vertices => self.skipped.points = self.skipped.points.saturating_add(count),
            Shape::Lines => self.skipped.lines = self.skipped.lines.saturating_add(count),
            Shape::Polygons | Shape::Strips | Shape::Typed => {
                let mut begun = Begun::new(cells, self.format);
                let mut is_whole = false;
                while !is_whole {
                    let before = begun.left();
                    is_whole = self.take_faces(cells, &mut begun)?;
                    pace.rest(before - begun.left()).await;
                }
            }
        }
        Ok(())
    }

    /// Reads the next numbers of a list; whether that was the last of it.
    fn take_faces(&mut self, cells: &Cells, begun: &mut Begun) -> Result<bool, ReadError> {
        let mut work = 0;
        while begun.at < cells.count {
            let mut missing = match begun.missing.take() {
                Some(missing) => missing,
                None if work >= NUMBERS => return Ok(false),
                None => self.begin_cell(cells, begun)?,
            };
            work += 1;
            // A length that is a lie ends with the numbers.
            while missing > 0 {
                if work >= NUMBERS {
                    begun.missing = Some(missing);
                    return Ok(false);
                }
                let Some(number) = begun.points.next() else {
                    return Err(self.ended(&mut *begun.points.numbers, Counted::Cells, cells.count, begun.at));
                };
                begun.cell.push(self.vertex(number)?);
                missing -= 1;
                work += 1;
            }
            match &mut begun.types {
                None => self.add_face(cells.shape, &mut begun.cell),
                Some(types) => match types.next() {
                    Some(number) => self.add_typed(number, &mut begun.cell),
                    None => {
                        return Err(self.ended(&mut *types.numbers, Counted::CellTypes, cells.count, begun.at));
                    }
                },
            }
            begun.at += 1;
        }
        Ok(true)
    }

    /// Reads how many vertices the next cell has.
    fn begin_cell(&mut self, cells: &Cells, begun: &mut Begun) -> Result<u64, ReadError> {
        let format = self.format;
        let Begun { points, ends, last_end, .. } = begun;
        let starts_anew = ends.is_none();
        let stream = ends.as_mut().unwrap_or(points);
        let Some(number) = stream.next() else {
            return Err(self.ended(&mut *stream.numbers, Counted::Cells, cells.count, begun.at));
        };
        let length = number - if starts_anew { 0.0 } else { mem::replace(last_end, number as u64) as f64 };
        if !(length >= 0.0 && length.fract() == 0.0) {
            let problem = VtkProblem::CellLength { cell: begun.at + 1, length };
            return Err(ReadError::malformed(format, problem));
        }
        begun.cell.clear();
        self.faces_read += 1;
        if self.notes_cells {
            // Where 32 bits do not hold it, there is no array with so many tuples either.
            self.faces.of_cell(u32::try_from(cells.first.saturating_add(begun.at)).unwrap_or(u32::MAX));
        }
        // A number makes a triangle at most.
        let most = usize::try_from(length as u64).unwrap_or(usize::MAX).min(cells.points.most());
        self.room.check(format, self.positions.len(), self.faces.triangles() + most)?;
        Ok(length as u64)
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
            3 | 4 | 21 | 35 | 68 | 75 => self.skipped.lines += 1,
            6 => self.add_face(Shape::Strips, cell),
            8 => {
                // A pixel numbers its corners row by row.
                if cell.len() == 4 {
                    cell.swap(2, 3);
                }
                self.add_face(Shape::Polygons, cell);
            }
            5 | 7 | 9 => self.add_face(Shape::Polygons, cell),
            // Quadratic and biquadratic, of Lagrange and of Bezier.
            22 | 34 | 69 | 76 => self.add_curved(3, cell),
            23 | 28 | 30 | 70 | 77 => self.add_curved(4, cell),
            36 => self.add_curved(cell.len() / 2, cell),
            _ => self.solids += 1,
        }
    }

    /// Adds a curved face, whose corners stand before the points between them.
    fn add_curved(&mut self, corners: usize, cell: &mut [u32]) {
        self.curved += 1;
        let corners = corners.min(cell.len());
        self.add_face(Shape::Polygons, &mut cell[..corners]);
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
    fn ended(&self, numbers: &mut dyn Numbers, what: Counted, announced: u64, found: u64) -> ReadError {
        let cut_short = || ReadError::CutShort { format: self.format, what, announced, found };
        numbers.fault().unwrap_or_else(cut_short)
    }

    /// Vertices so far.
    pub(super) fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// The whole, with what is said about its axes, and with its arrays.
    pub(super) fn finish(self, label: &'static str, axes: Axes, columns: Columns) -> Result<RawSurface, ReadError> {
        let Skipped { lines, points, .. } = self.skipped;
        if self.faces_read == 0 && (lines > 0 || points > 0) {
            let (lines, points) = (Elements::Lines { count: lines }, Elements::Points { count: points });
            return Err(ReadError::NoSurface { format: self.format, lines, points });
        }
        if self.faces.triangles() == 0 && self.solids > 0 {
            return Err(ReadError::VtkKind { kind: Named::Unnamed(Unnamed::Solids) });
        }
        let mut raw = RawSurface::of_faces(label, self.positions, &self.faces);
        (raw.has_doubles, raw.origin, raw.axes) = (self.has_doubles, self.origin, axes);
        (raw.skipped.lines, raw.skipped.points) = (lines, points);
        if self.solids > 0 {
            raw.warnings.push(Warning::SolidCells { cells: self.solids });
        }
        if self.curved > 0 {
            raw.warnings.push(Warning::CurvedCells { count: self.curved });
        }
        raw.carry(columns.finish(), self.room);
        Ok(raw)
    }
}
