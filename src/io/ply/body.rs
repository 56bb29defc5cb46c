//! PLY, the Stanford polygon file (Turk 1994): text, and binary of either byte order.
//!
//! A header describes elements with typed properties; of these the `x y z` of `vertex`, the `vertex_indices` of
//! `face` and those of `tristrips` make the surface. Other numbers of `vertex` and `face` are arrays (`ply_arrays.rs`), and
//! everything else is stepped over. The crate `ply-rs-bw` is not used:
//! it wants a structure a row filled property by property, names included, which is slow at a million faces.

use std::mem;

use glam::DVec3;

use super::columns::Columns;
use super::error::ReadError;
use super::import::RawSurface;
use super::numbers::{BinaryNumbers, Numbers, Scalar, TextNumbers};
use super::output::Output;
use super::ply_arrays::{Extras, Written};
use super::polygons::Faces;
use super::room::Room;
use super::text::{self, Words};
use crate::language::Key;
use crate::mesh::Vec3;
use crate::mesh::arrays::On;
use crate::say;
use crate::task::{Budget, Progress};

/// Rows between two looks at the clock.
const BLOCK: u64 = 1 << 14;

impl Scalar {
    /// The type that a header calls `name`.
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }
}

#[derive(Debug, PartialEq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Scalar,
    /// The type of the length, if this is a list.
    pub(super) length: Option<Scalar>,
}

#[derive(Debug, PartialEq)]
struct Element {
    name: String,
    /// As the header claims it: nothing is allocated for it before the bytes are seen.
    count: u64,
    properties: Vec<Property>,
}

impl Element {
    /// What to call many of it.
    fn plural(&self) -> String {
        match self.name.as_str() {
            "vertex" => say!("errors-vertices"),
            "face" => say!("errors-faces"),
            "tristrips" => say!("errors-strips"),
            name => say!("errors-rows", name = text::quoted(name.as_bytes())),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

impl Encoding {
    fn label(self) -> &'static str {
        match self {
            Self::Ascii => "PLY ascii",
            Self::Little => "PLY binary little-endian",
            Self::Big => "PLY binary big-endian",
        }
    }
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
    /// Where the numbers begin, in bytes and in lines.
    body: usize,
    body_line: usize,
}

/// A PLY file on its way to a surface, in slices, with positions relative to an origin.
///
/// White space is white space to a body of text; but where its numbers do not come out even, a header has left out some that
/// stand at the ends of lines (MeshLab once wrote colours so), and taking every row to be a line gets over them.
pub(super) struct Parsing {
    header: Header,
    /// Where the file begins, behind a mark and white space.
    start: usize,
    origin: DVec3,
    body: Body,
    /// What came of a text whose numbers do not come out even: its rows are read once more, as lines.
    uneven: Option<Result<RawSurface, ReadError>>,
}

impl Parsing {
    /// Of `bytes`, which are handed over again with each slice.
    pub(super) fn new(bytes: &[u8], origin: DVec3) -> Result<Self, ReadError> {
        let file = text::without_mark(bytes).trim_ascii_start();
        let header = header(file)?;
        let body = Body::new(&header, file.len(), origin);
        Ok(Self { start: bytes.len() - file.len(), header, origin, body, uneven: None })
    }

    pub(super) fn advance(&mut self, bytes: &[u8], budget: Budget) -> Progress<Result<RawSurface, ReadError>> {
        let Self { header, body, .. } = self;
        let file = &bytes[self.start..];
        let length = file.len() - header.body;
        let numbers = &file[header.body + body.at..];
        let read = match header.encoding {
            Encoding::Little => body.advance(header, &mut BinaryNumbers::<false>::new(numbers), budget),
            Encoding::Big => body.advance(header, &mut BinaryNumbers::<true>::new(numbers), budget),
            Encoding::Ascii => {
                let words = Words::new(numbers, body.line);
                let mut numbers = TextNumbers::new("PLY", words, self.uneven.is_some());
                let read = body.advance(header, &mut numbers, budget);
                body.line = numbers.line();
                match read {
                    Progress::Done(read) => {
                        let is_even = read.is_ok() && numbers.is_at_end();
                        return self.judged(read, is_even, file.len());
                    }
                    working => working,
                }
            }
        };
        match read {
            Progress::Working(_) => Progress::Working(body.at as f32 / length.max(1) as f32),
            done => done,
        }
    }

    /// What comes of a text that was read, or the beginning of another reading of it.
    fn judged(
        &mut self,
        read: Result<RawSurface, ReadError>,
        is_even: bool,
        file: usize,
    ) -> Progress<Result<RawSurface, ReadError>> {
        let told = |read: Result<RawSurface, ReadError>, what: Key| {
            read.map(|mut raw| {
                raw.warnings.push(what.say());
                raw
            })
        };
        Progress::Done(match (self.uneven.take(), is_even) {
            (None, true) => read,
            (None, false) => {
                self.uneven = Some(read);
                self.body = Body::new(&self.header, file, self.origin);
                return Progress::Working(0.0);
            }
            (Some(_), true) => told(read, Key("errors-ply-unannounced")),
            (Some(first), false) => told(first, Key("errors-ply-more-numbers")),
        })
    }
}

fn malformed(problem: String) -> ReadError {
    ReadError::Malformed { format: "PLY", problem }
}

/// Reads the header, which is text in every encoding.
fn header(bytes: &[u8]) -> Result<Header, ReadError> {
    if !bytes.get(..3).is_some_and(|magic| magic.eq_ignore_ascii_case(b"ply")) {
        return Err(malformed(say!("errors-ply-begin")));
    }
    // Old Macintosh files end lines with a carriage return alone; then a line feed after it is a number's byte.
    let ending: &[u8] = match bytes.get(3..5) {
        Some(b"\r\n") => b"\r\n",
        Some([b'\r', _]) => b"\r",
        _ => b"\n",
    };
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let (mut at, mut line) = (0, 0);
    loop {
        let rest = &bytes[at..];
        let Some(length) = rest.windows(ending.len()).position(|part| part == ending) else {
            return Err(malformed(say!("errors-ply-end")));
        };
        at += length + ending.len();
        line += 1;
        let syntax = |problem: String| ReadError::Syntax { format: "PLY", line, problem };
        let row = String::from_utf8_lossy(&rest[..length]);
        // No line that means anything has more.
        let words: Vec<&str> = row.split_ascii_whitespace().take(6).collect();
        let property = |name: &str, kind: &str, length: Option<&str>| {
            let scalar = |kind: &str| {
                let unknown = || syntax(say!("errors-no-type", word = text::quoted(kind.as_bytes())));
                Scalar::named(kind).ok_or_else(unknown)
            };
            Ok(Property { name: name.to_owned(), kind: scalar(kind)?, length: length.map(scalar).transpose()? })
        };
        match words[..] {
            ["end_header"] => break,
            ["format", kind, _version] => {
                encoding = Some(match kind {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::Little,
                    "binary_big_endian" => Encoding::Big,
                    _ => return Err(syntax(say!("errors-ply-encoding", word = text::quoted(kind.as_bytes())))),
                });
            }
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| syntax(say!("errors-no-count", word = text::quoted(count.as_bytes()))))?;
                elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
            }
            ["property", ref rest @ ..] => {
                let element = elements.last_mut().ok_or_else(|| syntax(say!("errors-ply-property-first")))?;
                element.properties.push(match *rest {
                    ["list", length, kind, name] => property(name, kind, Some(length))?,
                    [kind, name] => property(name, kind, None)?,
                    _ => return Err(syntax(say!("errors-ply-property"))),
                });
            }
            // Comments, obj_info and what later versions may add.
            _ => {}
        }
    }
    let encoding = encoding.ok_or_else(|| malformed(say!("errors-ply-no-encoding")))?;
    Ok(Header { encoding, elements, body: at, body_line: line + 1 })
}

/// What an element means to Lumen, with the place of the property that matters.
enum Meaning {
    /// Vertices, with the places of x, y and z.
    Vertices([usize; 3]),
    /// Faces, one list of vertices each.
    Faces(usize),
    /// Triangle strips in one list, -1 between them.
    Strips(usize),
    Other,
}

impl Meaning {
    /// What arrays of the element are on.
    fn on(&self) -> Option<On> {
        match self {
            Self::Vertices(_) => Some(On::Point),
            Self::Faces(_) => Some(On::Triangle),
            Self::Strips(_) | Self::Other => None,
        }
    }
}

fn meaning(element: &Element) -> Result<Meaning, ReadError> {
    let scalar = |name: &str| element.properties.iter().position(|p| p.name == name && p.length.is_none());
    let indices = || {
        let named = |p: &Property| p.name == "vertex_indices" || p.name == "vertex_index";
        element.properties.iter().position(|p| named(p) && p.length.is_some())
    };
    Ok(match element.name.as_str() {
        "vertex" => match (scalar("x"), scalar("y"), scalar("z")) {
            (Some(x), Some(y), Some(z)) => Meaning::Vertices([x, y, z]),
            _ => return Err(malformed(say!("errors-ply-no-xyz"))),
        },
        "face" => indices().map_or(Meaning::Other, Meaning::Faces),
        "tristrips" => indices().map_or(Meaning::Other, Meaning::Strips),
        _ => Meaning::Other,
    })
}

/// The numbers of a file, row by row.
struct Body {
    /// Bytes of it that are read, and the line there.
    at: usize,
    line: usize,
    origin: DVec3,
    room: Room,
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
        let has_extras = |e: &Element| e.name == "face" && Extras::are_in(&e.properties, On::Triangle);
        Self {
            at: 0,
            line: header.body_line,
            origin,
            room: Room::of(file),
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

    /// Reads on with `numbers`, those that are left; the fraction is not told here.
    fn advance(
        &mut self,
        header: &Header,
        numbers: &mut impl Numbers,
        budget: Budget,
    ) -> Progress<Result<RawSurface, ReadError>> {
        let before = numbers.remaining();
        while let Some(element) = header.elements.get(self.element) {
            if let Err(error) = self.read(header.encoding, element, numbers) {
                return Progress::Done(Err(error));
            }
            if budget.is_spent() {
                self.at += before - numbers.remaining();
                return Progress::Working(0.0);
            }
        }
        Progress::Done(Ok(self.surface(header, numbers.remaining())))
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
            let wanted = match meaning {
                Meaning::Faces(list) | Meaning::Strips(list) => Some(list),
                Meaning::Vertices(_) | Meaning::Other => None,
            };
            if row.read(&element.properties, wanted, numbers).is_none() {
                let (format, what) = (encoding.label(), element.plural());
                return Err(match (row.bad_length, numbers.fault()) {
                    (Some(length), _) => malformed(say!("errors-ply-list", length = length.to_string())),
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
    fn surface(&mut self, header: &Header, left: usize) -> RawSurface {
        let label = header.encoding.label();
        let mut raw = RawSurface::of_faces(label, mem::take(&mut self.positions), &mem::take(&mut self.faces));
        (raw.has_doubles, raw.origin) = (has_doubles(header), self.origin);
        raw.carry(mem::take(&mut self.columns).finish(), self.room);
        if header.encoding != Encoding::Ascii && left > 0 {
            raw.warnings.push(say!("errors-ply-trailing", bytes = left.to_string()));
        }
        raw
    }
}

/// Whether coordinates may have more digits than f32.
fn has_doubles(header: &Header) -> bool {
    let vertices = header.elements.iter().filter(|element| element.name == "vertex");
    let is_double = |property: &Property| {
        property.kind == Scalar::F64 && matches!(property.name.to_ascii_lowercase().as_str(), "x" | "y" | "z")
    };
    header.encoding == Encoding::Ascii || vertices.flat_map(|element| &element.properties).any(is_double)
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
    /// Reads a row; `None` where the file ends, or has a fault, before it is whole.
    fn read(&mut self, properties: &[Property], wanted: Option<usize>, numbers: &mut impl Numbers) -> Option<()> {
        self.scalars.clear();
        self.list.clear();
        self.bad_length = None;
        for (place, property) in properties.iter().enumerate() {
            let Some(length) = property.length else {
                if let Some(values) = self.extras.at(place) {
                    values.push(numbers.number(property.kind)?);
                    self.scalars.push(0.0);
                    continue;
                }
                self.scalars.push(numbers.coordinate(property.kind, self.origins[place])?);
                continue;
            };
            self.scalars.push(0.0);
            let length = numbers.number(length)?;
            if !(length >= 0.0 && length.fract() == 0.0) {
                self.bad_length = Some(length);
                return None;
            }
            // A length that is a lie ends with the file.
            if wanted == Some(place) {
                self.list.reserve(numbers.remaining().min(length as usize));
            }
            for _ in 0..length as u64 {
                let value = numbers.number(property.kind)?;
                if wanted == Some(place) {
                    self.list.push(value);
                }
            }
        }
        numbers.end_row();
        Some(())
    }
}

/// The little-endian binary form.
pub(super) fn write(output: &Output) -> Vec<u8> {
    let Output { mesh, normals, axes, .. } = *output;
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let [on_vertices, on_triangles] = [On::Point, On::Triangle].map(|on| Written::on(on, output.arrays));
    let xyz = |names: [&str; 3]| names.map(|name| format!("property float {name}\n")).concat();
    let properties = |arrays: &[Written]| arrays.iter().map(Written::header).collect::<String>();
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment Surface written by Lumen; millimetres{}\n\
         element vertex {vertices}\n{}{}{}element face {triangles}\nproperty list uchar int vertex_indices\n{}end_header\n",
        axes.said(),
        xyz(["x", "y", "z"]),
        normals.map_or(String::new(), |_| xyz(["nx", "ny", "nz"])),
        properties(&on_vertices),
        properties(&on_triangles),
    );
    let mut out = header.into_bytes();
    out.reserve(vertices * if normals.is_some() { 24 } else { 12 } + triangles * 13);
    for (v, position) in mesh.positions.iter().enumerate() {
        for p in [Some(position), normals.map(|normals| &normals[v])].into_iter().flatten() {
            out.extend_from_slice(bytemuck::cast_slice(&p.to_array().map(f32::to_le_bytes)));
        }
        on_vertices.iter().for_each(|array| array.push(v, &mut out));
    }
    for (t, corners) in mesh.triangles.iter().enumerate() {
        out.push(3);
        out.extend_from_slice(bytemuck::cast_slice(&corners.map(u32::to_le_bytes)));
        on_triangles.iter().for_each(|array| array.push(t, &mut out));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Result<RawSurface, ReadError> {
        let mut parsing = Parsing::new(bytes, DVec3::ZERO)?;
        loop {
            if let Progress::Done(read) = parsing.advance(bytes, Budget::UNLIMITED) {
                return read;
            }
        }
    }

    const SQUARE: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement camera 1\nproperty list uchar float view\n\
        element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\nproperty int part\n\
        end_header\n2 0.5 0.5\n255 0 0 0\n255 1 0 0\n0 1 1 0\n0 0 1 0\n4 0 1 2 3 2 .5 .5 7\n2 0 1 0 7\n";

    #[test]
    fn properties_of_no_interest_are_stepped_over() {
        let raw = read(SQUARE.as_bytes()).unwrap();
        assert_eq!(raw.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]);
        assert_eq!((raw.triangles.len(), raw.polygons, raw.skipped.short_faces), (2, 1, 1));
        assert_eq!(read(SQUARE.replace('\n', "\r\n").as_bytes()).unwrap().triangles, raw.triangles);
    }

    #[test]
    fn numbers_that_the_header_forgets_are_passed_over() {
        let text = SQUARE.replace("property int part\n", "");
        let raw = read(text.as_bytes()).unwrap();
        assert_eq!((raw.triangles.len(), raw.warnings.len()), (2, 1));
    }

    #[test]
    fn strips_turn_every_second_triangle() {
        let text = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\n\
            element vertex 5\nproperty float x\nproperty float y\nproperty float z\nend_header\n8 0 1 2 3 -1 2 3 4\n\
            0 0 0 1 0 0 0 1 0 1 1 0 9 9 9\n";
        assert_eq!(read(text.as_bytes()).unwrap().triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
    }

    #[test]
    fn both_byte_orders_are_read() {
        let mut bytes = b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\nproperty short y\n\
            property float z\nelement face 1\nproperty list uint ushort vertex_indices\nend_header\n"
            .to_vec();
        for i in 0..3i16 {
            bytes.extend_from_slice(&f64::from(i).to_be_bytes());
            bytes.extend_from_slice(&(-i).to_be_bytes());
            bytes.extend_from_slice(&0.5f32.to_be_bytes());
        }
        bytes.extend_from_slice(&3u32.to_be_bytes());
        bytes.extend([0u16, 1, 2].iter().flat_map(|v| v.to_be_bytes()));
        let raw = read(&bytes).unwrap();
        assert_eq!((raw.label, raw.positions[2]), ("PLY binary big-endian", Vec3::new(2.0, -2.0, 0.5)));
        assert_eq!(raw.triangles, [[0, 1, 2]]);
    }

    #[test]
    fn lies_are_refused_in_a_sentence() {
        let problem = |from: &str, to: &str| read(SQUARE.replace(from, to).as_bytes()).err().unwrap().to_string();
        assert_eq!(
            problem("vertex 4", "vertex 3000000000"),
            "The PLY ascii file is cut short: it announces 3000000000 vertices and holds 7."
        );
        assert_eq!(
            problem("4 0 1 2 3", "4 0 1 2 -9"),
            "Face 1 of the PLY file refers to vertex -9, but the file has 4 vertices."
        );
        assert!(problem("end_header", "the_end").ends_with("has no \"end_header\"."));
        assert!(problem("float z", "float w").ends_with("its vertices have no x, y and z."));
        assert!(problem("255 1 0 0", "255 one 0 0").contains("line 18: \"one\" stands where a number should"));
        assert!(problem("int vertex_index", "long vertex_index").contains("\"long\" is no type of number"));
        assert!(problem("2 0.5 0.5", "-2 0.5 0.5").contains("a list has the length -2"));
    }
}
