//! OBJ (Wavefront 1995): lines of text, of which `v` and `f` make the surface.
//!
//! Three numbers after the coordinates of every vertex are its colour, the array `RGB`, as ZBrush and MeshLab write it.
//! Where faces stand in several groups (`g`, or `o`), their array `Groups` says in which, by the order in which groups are
//! first named, from 1; 0 is before any. Texture coordinates, normals and materials are passed over. The crate `tobj` is not used: it
//! splits the surface by group and material, takes a face of two corners for a line without saying so, and fans
//! concave faces.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;

use glam::DVec3;
use memchr::{memchr_iter, memchr2};

use super::columns::left_out;
use super::error::ReadError;
use super::formats::{Arrays, FileKind, MediaType, Sign, Written};
use super::memory_budget::MemoryBudget;
use super::output::Output;
use super::pace::Pace;
use super::polygons::Faces;
use super::problem::TextProblem;
use super::raw::RawSurface;
use super::text;
use super::unit::Unit;
use super::warnings::ArrayProblem;
use lumen_mesh::arrays::{Association, Scalar, Values};
use lumen_mesh::{Array, Vec3};

/// Lines between two looks at the clock.
const BLOCK: usize = 1 << 14;

/// OBJ in the table of formats.
pub(super) static KIND: FileKind = FileKind {
    label: "OBJ",
    extensions: &["obj"],
    media_types: &[MediaType { name: "model/obj", comment: "Wavefront OBJ surface", extension: "obj", magic: None }],
    unit: Unit::Millimetre,
    axes_in_head: true,
    signs: &[(Sign::Resembles, looks_like)],
    parse: |bytes, _, origin, pace| Box::pin(read(bytes, origin, pace)),
    // Half a vertex and a face in words.
    triangles: |bytes| bytes.len() as u64 / 35,
};

/// OBJ as it is written.
pub(super) static WRITTEN: Written = Written { write: |output| Ok(write(output)), arrays: Arrays::Colour(colour_of) };

/// Whether a text without a telling name has vertices as OBJ writes them among its first lines.
fn looks_like(bytes: &[u8]) -> bool {
    let mut lines = bytes[..bytes.len().min(4096)].split(|&byte| byte == b'\n' || byte == b'\r');
    text::is_text(bytes)
        && lines.any(|line| {
            let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            words.next() == Some(b"v") && (0..3).all(|_| words.next().and_then(text::number::<f32>).is_some())
        })
}

/// Reads a file, with positions relative to an origin.
pub(super) async fn read(bytes: &[u8], origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    if !text::is_text(bytes) {
        return Err(ReadError::malformed("OBJ", TextProblem::NoText));
    }
    let mut lines = Lines { bytes: text::without_mark(bytes), at: 0, line: 1 };
    let mut reader = Reader::new(origin);
    loop {
        let before = lines.at;
        for _ in 0..BLOCK {
            match lines.next() {
                Some((line, row)) => reader.take(line, &row)?,
                None => return reader.surface(bytes.len()),
            }
        }
        pace.rest((lines.at - before) as f64).await;
    }
}

/// What was read so far.
struct Reader {
    origin: DVec3,
    positions: Vec<Vec3>,
    faces: Faces,
    colours: Values,
    /// Whether the colour of a vertex is no number.
    has_spoilt_colour: bool,
    groups: Groups,
    lines: usize,
    points: usize,
    faces_read: usize,
    /// The farthest vertex that a face names, and that face.
    farthest: (u32, usize),
}

impl Reader {
    fn new(origin: DVec3) -> Self {
        Self {
            origin,
            positions: Vec::new(),
            faces: Faces::default(),
            colours: Values::new(Scalar::F32),
            has_spoilt_colour: false,
            groups: Groups::default(),
            lines: 0,
            points: 0,
            faces_read: 0,
            farthest: (0, 0),
        }
    }

    /// Takes a line.
    fn take(&mut self, line: usize, row: &[u8]) -> Result<(), ReadError> {
        let mut words = words(row);
        let syntax = |problem: TextProblem| ReadError::syntax("OBJ", line, problem);
        match words.next() {
            Some(b"v") => {
                let mut coordinates = [0.0; 3];
                for (coordinate, origin) in coordinates.iter_mut().zip(self.origin.to_array()) {
                    let word = words.next().ok_or_else(|| syntax(TextProblem::ShortVertex))?;
                    let broken = || syntax(TextProblem::NoCoordinate { word: text::quoted(word) });
                    *coordinate = text::coordinate(word, origin).ok_or_else(broken)?;
                }
                let colour: [Option<&[u8]>; 3] = std::array::from_fn(|_| words.next());
                if let ([Some(r), Some(g), Some(b)], None) = (colour, words.next()) {
                    self.add_colour([r, g, b]);
                }
                self.positions.push(Vec3::from(coordinates));
            }
            Some(b"f") => {
                self.faces_read += 1;
                for word in words {
                    // A corner is v, v/vt, v//vn or v/vt/vn.
                    let vertex = word.split(|&byte| byte == b'/').next().unwrap_or(word);
                    let broken = || syntax(TextProblem::NoVertex { word: text::quoted(word) });
                    let index: i64 = text::number(vertex).ok_or_else(broken)?;
                    // Negative numbers count back from the vertex read last; positive ones may look ahead.
                    let place =
                        if index < 0 { index.checked_add(self.positions.len() as i64) } else { index.checked_sub(1) };
                    let corner =
                        place.and_then(|place| u32::try_from(place).ok()).ok_or(ReadError::IndexOutOfRange {
                            format: "OBJ",
                            face: self.faces_read,
                            index,
                            vertices: self.positions.len(),
                        })?;
                    self.farthest = self.farthest.max((corner, self.faces_read));
                    self.faces.push_corner(corner);
                }
                self.faces.of_cell(self.groups.present);
                self.faces.finish_face();
            }
            Some(b"g" | b"o") => self.groups.enter(row.trim_ascii().get(1..).unwrap_or_default().trim_ascii()),
            Some(b"l") => self.lines += 1,
            Some(b"p") => self.points += 1,
            _ => {}
        }
        Ok(())
    }

    /// Takes the colour of the next vertex, where all before have one.
    fn add_colour(&mut self, colour: [&[u8]; 3]) {
        match colour.map(text::number::<f32>) {
            [Some(r), Some(g), Some(b)] if self.colours.len() == 3 * self.positions.len() => {
                [r, g, b].iter().for_each(|&part| self.colours.push(f64::from(part)));
            }
            [Some(_), Some(_), Some(_)] => {}
            _ => self.has_spoilt_colour = true,
        }
    }

    /// The surface, once all lines are read, of a file of `file` bytes.
    fn surface(self, file: usize) -> Result<RawSurface, ReadError> {
        let (corner, face) = self.farthest;
        if face > 0 && corner as usize >= self.positions.len() {
            let (index, vertices) = (i64::from(corner) + 1, self.positions.len());
            return Err(ReadError::IndexOutOfRange { format: "OBJ", face, index, vertices });
        }
        let mut raw = RawSurface::of_faces("OBJ", self.positions, &self.faces);
        (raw.has_doubles, raw.origin) = (true, self.origin);
        raw.skipped.lines = self.lines;
        raw.skipped.points = self.points;
        let mut arrays = Vec::new();
        if self.colours.len() == 3 * raw.positions.len() {
            arrays.push(Array::new("RGB", Association::Point, 3, self.colours));
        } else if self.has_spoilt_colour {
            raw.warnings.push(left_out("RGB", ArrayProblem::NoNumber));
        } else if !self.colours.is_empty() {
            raw.warnings.push(left_out("RGB", ArrayProblem::NotEverywhere));
        }
        // The cell of a triangle is its group here.
        if raw.cells.iter().any(|group| raw.cells.first() != Some(group)) {
            let numbers = Values::of(Scalar::I32, (0..=self.groups.numbers.len()).map(|group| group as f64));
            arrays.push(Array::new("Groups", Association::Triangle, 1, numbers));
        }
        raw.carry((arrays, Vec::new()), MemoryBudget::of(file));
        Ok(raw)
    }
}

/// The groups that faces are in.
#[derive(Default)]
struct Groups {
    /// From 1, in the order in which they are first named.
    numbers: BTreeMap<Vec<u8>, u32>,
    /// That of the next face.
    present: u32,
}

impl Groups {
    /// Faces that follow are in the group `name`.
    fn enter(&mut self, name: &[u8]) {
        let next = self.numbers.len() as u32 + 1;
        self.present = match self.numbers.get(name) {
            Some(&number) => number,
            None => *self.numbers.entry(name.to_owned()).or_insert(next),
        };
    }
}

/// The words of a line, up to a comment.
fn words(row: &[u8]) -> impl Iterator<Item = &[u8]> {
    row[..comment(row).unwrap_or(row.len())].split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// Where the comment in a line begins. Windows writes `1.#IND` where there is no number.
fn comment(row: &[u8]) -> Option<usize> {
    memchr_iter(b'#', row).find(|&at| at == 0 || row[at - 1] != b'.')
}

/// The lines of a text with their numbers, joined with the next where they go on there.
///
/// A backslash at the end says so only where numbers are wanted, and only if some follow: names of groups and materials
/// end in one, too, as folders of Windows do.
struct Lines<'a> {
    bytes: &'a [u8],
    /// Where the next one begins: behind the text where there is none.
    at: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    /// The next line of the text, which ends with a line feed, a carriage return or both.
    fn physical(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..)?;
        let length = memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        self.at += length + if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        self.line += 1;
        Some(&rest[..length])
    }

    fn next(&mut self) -> Option<(usize, Cow<'a, [u8]>)> {
        let (number, first) = (self.line, self.physical()?);
        let (mut line, mut part) = (Cow::Borrowed(first), first);
        while let Some(start) = before_backslash(part).filter(|_| wants_numbers(first)) {
            let joined = line.to_mut();
            joined.truncate(joined.len() - (part.len() - start.len()));
            if !self.numbers_follow() {
                break;
            }
            joined.push(b' ');
            part = self.physical().unwrap_or_default();
            joined.extend_from_slice(part);
        }
        Some((number, line))
    }

    /// Whether the next line begins with a number, or says no more than that it goes on itself.
    fn numbers_follow(&self) -> bool {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let first = rest.iter().find(|&&byte| byte != b' ' && byte != b'\t');
        first.is_none_or(|byte| byte.is_ascii_digit() || b"+-.\\\r\n".contains(byte))
    }
}

/// What stands before the backslash at the end of a line, if that is not in a comment.
fn before_backslash(line: &[u8]) -> Option<&[u8]> {
    line.trim_ascii_end().strip_suffix(b"\\").filter(|start| comment(start).is_none())
}

/// Whether a line is one of those that are read as numbers.
fn wants_numbers(line: &[u8]) -> bool {
    matches!(words(line).next(), Some(b"v" | b"f" | b"l" | b"p"))
}

/// The one array that is written, a colour behind the coordinates: the first that can be one.
fn colour_of(arrays: &[Array]) -> Option<&Array> {
    let is_named = |array: &Array| array.name.starts_with("RGB") || array.name.starts_with("COLOR_");
    let has_shape = |array: &Array| array.on == Association::Point && matches!(array.components, 3 | 4);
    arrays.iter().find(|array| is_named(array) && has_shape(array))
}

/// The parts of a vertex's colour, from 0 to 1.
fn colour(array: &Array, vertex: usize) -> [f32; 3] {
    let most = match array.values.scalar() {
        Scalar::U8 => 255.0,
        Scalar::U16 => 65535.0,
        _ => 1.0,
    };
    std::array::from_fn(|part| (array.values.get(vertex * array.components + part) / most) as f32)
}

/// Text with the shortest numbers that read back to the same bits.
fn write(output: &Output) -> Vec<u8> {
    let Output { mesh, normals, axes, .. } = *output;
    let colours = colour_of(output.arrays);
    let mut out = String::with_capacity(mesh.positions.len() * 36 + mesh.triangles.len() * 24);
    // Writing to a String cannot fail.
    let _ = writeln!(out, "# Surface written by Lumen; millimetres{}", axes.said());
    for (v, p) in mesh.positions.iter().enumerate() {
        let _ = write!(out, "v {} {} {}", p.x, p.y, p.z);
        if let Some([r, g, b]) = colours.map(|array| colour(array, v)) {
            let _ = write!(out, " {r} {g} {b}");
        }
        out.push('\n');
    }
    for n in normals.unwrap_or_default() {
        let _ = writeln!(out, "vn {} {} {}", n.x, n.y, n.z);
    }
    for &t in &mesh.triangles {
        let [a, b, c] = t.map(|v| u64::from(v) + 1);
        let _ = if normals.is_some() {
            writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")
        } else {
            writeln!(out, "f {a} {b} {c}")
        };
    }
    out.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::task::at_once;

    fn read(bytes: &[u8]) -> Result<RawSurface, ReadError> {
        at_once(super::read(bytes, DVec3::ZERO, &Pace::never()))
    }

    #[test]
    fn every_way_to_write_a_corner_is_read() {
        let text = "# square\r\nv 0 0 0 1 .5 nan\r\nv 1 0 0\\\r\n 1.0\r\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n\
            o a\ns off\nf 1/1/1 2//1 \\\n 3/1\nf -4 -2 -1\nf 1 2\nl 1 2\np 1\nf 1 2 3 4";
        let raw = read(text.as_bytes()).unwrap();
        assert_eq!(raw.positions, [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]);
        assert_eq!(raw.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 2, 3]]);
        assert_eq!((raw.skipped.short_faces, raw.skipped.lines, raw.skipped.points), (1, 1, 1));
    }

    #[test]
    fn a_backslash_goes_on_only_where_numbers_do() {
        let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        let count = |text: &str| read(format!("{square}{text}").as_bytes()).unwrap().triangles.len();
        for name in ["# C:\\a\\", "g a\\", "o a \\", "usemtl \\", "mtllib C:\\", "s 1\\", "f 1 2 4 # \\", "f 1 2 4\\"] {
            for end in ["\n", "\r\n", "\r", " \n"] {
                let own = usize::from(name.starts_with('f'));
                assert_eq!(count(&format!("{name}{end}f 1 2 3{end}f 1 3 4")), own + 2, "{name:?} {end:?}");
            }
        }
        for end in ["\n", "\r\n", "\r", " \r\n"] {
            assert_eq!(count(&format!("f 1 2\\{end}  3 \\{end}\\{end}4{end}")), 2, "{end:?}");
        }
    }

    #[test]
    fn colours_that_are_no_numbers_or_not_everywhere_are_left_out() {
        let warned = |first: &str, last: &str| {
            let text = format!("v 0 0 0 {first}\nv 1 0 0 0 0 1\nv 0 1 0 {last}\nf 1 2 3");
            let raw = read(text.as_bytes()).unwrap();
            assert_eq!((raw.triangles.len(), raw.arrays.is_empty()), (1, !raw.warnings.is_empty()));
            crate::in_english(&raw.warnings).concat()
        };
        assert_eq!(warned("1 .5 0", "0 0 0"), "");
        assert_eq!(warned("1.#IND 0 0", "0 0 0"), "The array \"RGB\" is left out: it holds what is no number.");
        assert_eq!(warned("0 0 0", "0 0 -nan(ind)"), "The array \"RGB\" is left out: it holds what is no number.");
        assert_eq!(warned("0 0 0", ""), "The array \"RGB\" is left out: not every part of the file has it.");
    }

    #[test]
    fn comments_end_a_line_of_numbers() {
        let raw = read(b"v 0 0 0 # a\nv 1 0 0 #2 3 4\nv 0 1 0#\nf 1 2 3 # 4\nf 3 2 1#").unwrap();
        assert_eq!((raw.triangles, raw.arrays.len()), (vec![[0, 1, 2], [2, 1, 0]], 0));
    }

    #[test]
    fn a_number_sign_belongs_to_the_name_of_a_group() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng Part#1\nf 1 2 3\ng Part#2\nf 3 2 1\n  g Part#1 \nf 2 3 1\n";
        let raw = read(text.as_bytes()).unwrap();
        let groups = &raw.arrays[0];
        assert_eq!((0..3).map(|t| groups.values.get(t)).collect::<Vec<_>>(), [1.0, 2.0, 1.0]);
    }

    #[test]
    fn faces_may_name_vertices_that_come_after_them() {
        let raw = read(b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").unwrap();
        assert_eq!((raw.triangles, raw.positions[2]), (vec![[0, 1, 2]], Vec3::Y));
    }

    #[test]
    fn broken_lines_are_refused_with_their_number() {
        let problem = |text: &str| read(text.as_bytes()).err().unwrap().to_string();
        assert_eq!(problem("v 1 2\n"), "The OBJ file is broken at line 1: a vertex needs three coordinates.");
        assert!(problem("\nv 1 2 x\n").contains("line 2: \"x\" stands where a coordinate should"));
        assert!(problem("v 0 0 0\nf 1 1 one\n").contains("line 2: \"one\" stands where a vertex number should"));
        let refers = "Face 1 of the OBJ file refers to vertex";
        assert_eq!(problem("v 0 0 0\nf 1 1 2"), format!("{refers} 2, but the file has 1 vertices."));
        assert_eq!(problem("v 0 0 0\nf 1 0 1"), format!("{refers} 0, but the file has 1 vertices."));
        assert_eq!(problem("v 0 0 0\nf 1 -2 1"), format!("{refers} -2, but the file has 1 vertices."));
    }

    #[test]
    fn vertices_among_the_first_lines_tell_an_obj() {
        assert!(looks_like(b"# a\ng b\nv 1 2 3\n"));
        assert!(!looks_like(b"v is the fifth Roman numeral\n"));
    }
}
