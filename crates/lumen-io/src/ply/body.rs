//! What stands behind the header of a PLY file: rows of numbers, element by element.

use std::mem;

use glam::DVec3;

use super::super::columns::Columns;
use super::super::error::ReadError;
use super::super::memory_budget::MemoryBudget;
use super::super::numbers::Numbers;
use super::super::pace::Pace;
use super::super::polygons::Faces;
use super::super::problem::PlyProblem;
use super::super::raw::RawSurface;
use super::super::warnings::Warning;
use super::arrays::Extras;
use super::header::{Element, Encoding, Header, Meaning, Property, has_doubles, meaning};
use super::malformed;
use lumen_mesh::Vec3;
use lumen_mesh::arrays::Association;

/// Rows between two looks at the clock.
const BLOCK: u64 = 1 << 14;

/// Reads the `numbers` of a file of so many bytes, row by row, with positions relative to an origin.
pub(super) async fn read(
    header: &Header,
    file: usize,
    origin: DVec3,
    numbers: &mut impl Numbers,
    pace: &Pace,
) -> Result<RawSurface, ReadError> {
    let mut body = Body::new(header, file, origin);
    while let Some(element) = header.elements.get(body.element) {
        let before = numbers.remaining();
        body.read(header.encoding, element, numbers)?;
        pace.rest((before - numbers.remaining()) as f64).await;
    }
    Ok(body.surface(header, numbers.remaining()))
}

/// What was read so far.
struct Body {
    origin: DVec3,
    room: MemoryBudget,
    /// An index beyond this can stand for no vertex, and may be too large to be kept as one.
    claimed: u64,
    /// The element that is read, and how many of its rows are.
    element: usize,
    rows: u64,
    row: Row,
    positions: Vec<Vec3>,
    faces: Faces,
    columns: Columns,
    /// Faces and strips so far; which of them a triangle is of is noted where it matters.
    cells: u32,
    notes_cells: bool,
}

impl Body {
    /// Of a file of `file` bytes.
    fn new(header: &Header, file: usize, origin: DVec3) -> Self {
        let vertices = header.elements.iter().filter(|e| e.name == "vertex");
        let has_extras = |e: &Element| e.name == "face" && Extras::are_in(&e.properties, Association::Triangle);
        Self {
            origin,
            room: MemoryBudget::of(file),
            claimed: vertices.map(|e| e.count).fold(0, u64::saturating_add),
            element: 0,
            rows: 0,
            row: Row::default(),
            positions: Vec::new(),
            faces: Faces::default(),
            columns: Columns::default(),
            cells: 0,
            notes_cells: header.elements.iter().any(has_extras),
        }
    }

    /// Reads the next rows of an element, and goes on to the next one after its last.
    fn read(&mut self, encoding: Encoding, element: &Element, numbers: &mut impl Numbers) -> Result<(), ReadError> {
        let meaning = meaning(element)?;
        if element.properties.is_empty() {
            self.element += 1;
            return Ok(());
        }
        if self.rows == 0 {
            self.begin(element, &meaning, numbers.remaining());
        }
        let claimed = self.claimed;
        let Self { row, positions, faces, .. } = self;
        let end = element.count.min(self.rows.saturating_add(BLOCK));
        for n in self.rows..end {
            let needed: &[usize] = match &meaning {
                Meaning::Vertices(places) => places,
                Meaning::Faces(list) | Meaning::Strips(list) => std::slice::from_ref(list),
                Meaning::Other => &[],
            };
            if row.read(&element.properties, needed, numbers).is_none() {
                let (format, what) = (encoding.label(), element.plural());
                return Err(match (row.bad_length, numbers.fault()) {
                    (Some(length), _) => malformed(PlyProblem::ListLength { length }),
                    (None, Some(fault)) => fault,
                    (None, None) => ReadError::CutShort { format, what, announced: element.count, found: n },
                });
            }
            let index = |value: f64| {
                // The comparison is false for NaN; fractions are no indices.
                if value >= 0.0 && value < claimed.min(u64::from(u32::MAX)) as f64 && value.fract() == 0.0 {
                    return Ok(value as u32);
                }
                Err(ReadError::IndexOutOfRange {
                    format: "PLY",
                    face: n as usize + 1,
                    index: value as i64,
                    vertices: usize::try_from(claimed).unwrap_or(usize::MAX),
                })
            };
            // A number makes a triangle at most.
            self.room.check(encoding.label(), positions.len(), faces.triangles() + row.list.len())?;
            if self.notes_cells && matches!(meaning, Meaning::Faces(_) | Meaning::Strips(_)) {
                faces.of_cell(self.cells);
                self.cells = self.cells.saturating_add(1);
            }
            match meaning {
                Meaning::Vertices(places) => positions.push(Vec3::from(places.map(|place| row.scalars[place]))),
                Meaning::Faces(_) => {
                    for &value in &row.list {
                        faces.push_corner(index(value)?);
                    }
                    faces.finish_face();
                }
                Meaning::Strips(_) => {
                    for strip in row.list.split(|&value| value == -1.0) {
                        for (i, three) in strip.windows(3).enumerate() {
                            let [a, b, c] = [index(three[0])?, index(three[1])?, index(three[2])?];
                            faces.push(&if i % 2 == 0 { [a, b, c] } else { [b, a, c] });
                        }
                    }
                }
                Meaning::Other => {}
            }
        }
        self.rows = end;
        if end == element.count {
            self.end(element, &meaning);
        }
        Ok(())
    }

    /// Makes room for an element, of whose numbers and those after it `remaining` bytes are left.
    fn begin(&mut self, element: &Element, meaning: &Meaning, remaining: usize) {
        // Every number takes a byte at least.
        let most = remaining / element.properties.len();
        let rows = element.count.min(most as u64);
        self.row.extras = Extras::new(&element.properties, meaning.on(), rows, self.room, &mut self.columns);
        self.row.origins = vec![0.0; element.properties.len()];
        if let Meaning::Vertices(places) = meaning {
            places.iter().zip(self.origin.to_array()).for_each(|(&place, origin)| self.row.origins[place] = origin);
            self.positions.reserve(rows as usize);
        }
    }

    /// Puts the arrays of an element to those before, and goes on to the next.
    fn end(&mut self, element: &Element, meaning: &Meaning) {
        let count = element.count as usize;
        if let Some(on) = meaning.on() {
            mem::take(&mut self.row.extras).add_to(&mut self.columns, on, &element.properties);
        }
        match meaning {
            Meaning::Vertices(_) => self.columns.end_part(count, 0),
            Meaning::Faces(_) | Meaning::Strips(_) => self.columns.end_part(0, count),
            Meaning::Other => {}
        }
        (self.element, self.rows) = (self.element + 1, 0);
    }

    /// The surface, once all is read and so many bytes are left.
    fn surface(self, header: &Header, left: usize) -> RawSurface {
        let label = header.encoding.label();
        let mut raw = RawSurface::of_faces(label, self.positions, &self.faces);
        (raw.has_doubles, raw.origin) = (has_doubles(header), self.origin);
        raw.carry(self.columns.finish(), self.room);
        if header.encoding != Encoding::Ascii && left > 0 {
            raw.warnings.push(Warning::PlyTrailing { bytes: left });
        }
        raw
    }
}

/// One row of an element.
#[derive(Default)]
struct Row {
    /// What each property is read relative to.
    origins: Vec<f64>,
    /// The value of each property; 0 for a list.
    scalars: Vec<f32>,
    /// The values of the one list that is wanted.
    list: Vec<f64>,
    /// What else is kept, of all rows.
    extras: Extras,
    /// A length that no list can have, where one stopped the row.
    bad_length: Option<f64>,
}

impl Row {
    /// Reads a row; `None` where the file ends, or a property that is needed has a fault, before it is whole.
    fn read(&mut self, properties: &[Property], needed: &[usize], numbers: &mut impl Numbers) -> Option<()> {
        self.scalars.clear();
        self.list.clear();
        self.bad_length = None;
        for (place, property) in properties.iter().enumerate() {
            let Some(length) = property.length else {
                if let Some(values) = self.extras.at(place) {
                    match numbers.number(property.kind) {
                        Some(value) => values.push(value),
                        None if numbers.pass_over() => self.extras.spoil(place),
                        None => return None,
                    }
                    self.scalars.push(0.0);
                    continue;
                }
                self.scalars.push(match numbers.coordinate(property.kind, self.origins[place]) {
                    Some(value) => value,
                    None if !needed.contains(&place) && numbers.pass_over() => 0.0,
                    None => return None,
                });
                continue;
            };
            self.scalars.push(0.0);
            let length = numbers.number(length)?;
            if !(length >= 0.0 && length.fract() == 0.0) {
                self.bad_length = Some(length);
                return None;
            }
            let is_needed = needed.contains(&place);
            // A length that is a lie ends with the file.
            if is_needed {
                self.list.reserve(numbers.remaining().min(length as usize));
            }
            for _ in 0..length as u64 {
                match numbers.number(property.kind) {
                    Some(value) if is_needed => self.list.push(value),
                    Some(_) => {}
                    None if !is_needed && numbers.pass_over() => {}
                    None => return None,
                }
            }
        }
        numbers.end_row();
        Some(())
    }
}
