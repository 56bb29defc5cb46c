//! STL, text and binary (3D Systems 1988): triangles without shared vertices.
//!
//! Binary is recognised by its length, `84 + 50 n` bytes for n triangles, before anything else: many writers begin
//! the free text of a binary header with "solid", which the crate `stl_io` takes for text; that is why the format is
//! read here. Writers that do not know the count in advance leave 0, 0xFFFFFFFF, half or double of it in the header; there the
//! length decides, if it is a whole number of facets and those behind the count are like the others. Facet normals serve
//! for nothing else: they are often wrong, and the winding says the same.

use std::cmp::Ordering;

use glam::DVec3;
use lumen_message::messages;

use super::error::{Counted, ReadError, WriteError};
use super::formats::{Arrays, FileKind, MediaType, Sign, Written};
use super::import::FARTHEST_MM;
use super::output::Output;
use super::pace::Pace;
use super::polygons::Faces;
use super::problem::{Problem, TextProblem};
use super::raw::{RawSurface, check_size};
use super::text::{self, Words};
use super::unit::Unit;
use super::warnings::Warning;
use lumen_mesh::Vec3;

/// Facets, or words, between two looks at the clock.
const BLOCK: usize = 1 << 15;
const HEADER: usize = 80;
const FACET: usize = 50;
/// Bytes after the last facet that are no part of a facet that was cut off.
const FEW: usize = 8;
const BINARY: &str = "STL binary";
const ASCII: &str = "STL ascii";

/// STL in the table of formats.
pub(super) static KIND: FileKind = FileKind {
    label: "STL",
    extensions: &["stl"],
    media_types: &[MediaType { name: "model/stl", comment: "STL surface", extension: "stl", magic: None }],
    unit: Unit::Millimetre,
    axes_in_head: true,
    // A binary file may begin with anything at all, "solid" and "ply" included; its length gives it away.
    signs: &[
        (Sign::Sure, has_binary_length),
        (Sign::Begins, |bytes| text::begins_with(bytes, b"solid") && text::is_text(text::beginning(bytes))),
    ],
    parse: |bytes, _, origin, pace| Box::pin(read(bytes, origin, pace)),
    // Seven lines of text take 250 bytes.
    triangles: |bytes| bytes.len() as u64 / if is_binary(bytes) { FACET as u64 } else { 250 },
};

/// STL as it is written.
pub(super) static WRITTEN: Written = Written { write, arrays: Arrays::None };

/// Whether `bytes` are exactly as long as the binary file that their header announces.
pub(super) fn has_binary_length(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|facets| binary_length(facets) == bytes.len() as u64)
}

/// The number of facets that a binary header announces.
fn announced(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(HEADER..)?.first_chunk()?))
}

/// Whether a file that is STL is binary.
fn is_binary(bytes: &[u8]) -> bool {
    has_binary_length(bytes) || !text::is_text(bytes)
}

fn binary_length(facets: u32) -> u64 {
    (HEADER + 4) as u64 + FACET as u64 * u64::from(facets)
}

/// Reads a file of either kind; the text, which may have more digits than f32, with positions relative to an origin.
pub(super) async fn read(bytes: &[u8], origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    if is_binary(bytes) { read_binary(bytes, pace).await } else { read_text(bytes, origin, pace).await }
}

/// The binary form.
async fn read_binary(bytes: &[u8], pace: &Pace) -> Result<RawSurface, ReadError> {
    let cut_short = |what: Counted, announced: u64, found: usize| ReadError::CutShort {
        format: BINARY,
        what,
        announced,
        found: found as u64,
    };
    let announced = announced(bytes).ok_or_else(|| cut_short(Counted::HeaderBytes, 84, bytes.len()))?;
    let body = &bytes[HEADER + 4..];
    let count = facet_count(announced, body, pace)
        .await
        .ok_or_else(|| cut_short(Counted::Triangles, u64::from(announced), body.len() / FACET))?;
    check_size(0, count)?;
    let mut positions = Vec::with_capacity(3 * count);
    let (body, trailing) = body.split_at(FACET * count);
    for block in body.as_chunks::<FACET>().0.chunks(BLOCK) {
        for facet in block {
            positions.extend(corners(facet));
        }
        pace.rest((FACET * block.len()) as f64).await;
    }
    let triangles = (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let mut raw = RawSurface::new(BINARY, positions, triangles);
    match (announced as usize).cmp(&count) {
        Ordering::Less => raw.warnings.push(Warning::StlCount { announced, found: count }),
        Ordering::Equal => {}
        Ordering::Greater => raw.warnings.push(Warning::StlFewer { announced, found: count }),
    }
    if !trailing.is_empty() {
        raw.warnings.push(Warning::StlTrailing { bytes: trailing.len() });
    }
    Ok(raw)
}

/// The normal of a facet and its corners, behind which are two bytes of its own.
fn normal_and_corners(facet: &[u8; FACET]) -> [Vec3; 4] {
    let number = |at: usize| f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]);
    [0, 12, 24, 36].map(|at| Vec3::new(number(at), number(at + 4), number(at + 8)))
}

fn corners(facet: &[u8; FACET]) -> [Vec3; 3] {
    let [_, a, b, c] = normal_and_corners(facet);
    [a, b, c]
}

/// How many facets a body has whose header announces so many; `None` where it is cut short.
async fn facet_count(announced: u32, body: &[u8], pace: &Pace) -> Option<usize> {
    let (whole, rest) = body.as_chunks::<FACET>();
    let found = whole.len();
    let count = usize::try_from(announced).unwrap_or(usize::MAX);
    if count <= found {
        let (first, more) = whole.split_at(count);
        let go_on = count < found && rest.len() <= FEW && are_facets(more, first, pace).await;
        return Some(if go_on { found } else { count });
    }
    // A file that was cut off has fewer facets than it announces, too; seldom half of them, or a negative number.
    let is_no_count = announced > i32::MAX as u32 || count == 2 * found;
    (is_no_count && found > 0 && matches!(rest, b"" | b"\n" | b"\r\n")).then_some(found)
}

/// Whether what stands behind the `first` facets, which are announced, are facets, too: neither text nor padding nor other
/// numbers. Whole numbers, such as those of regions, are denormal as coordinates.
async fn are_facets(more: &[[u8; FACET]], first: &[[u8; FACET]], pace: &Pace) -> bool {
    // The comparison is false for NaN.
    let is_place = |x: f32| f64::from(x.abs()) <= FARTHEST_MM && !x.is_subnormal();
    for block in more.chunks(BLOCK) {
        if !block.iter().flat_map(corners).all(|p| p.to_array().into_iter().all(is_place)) {
            return false;
        }
        pace.rest(0.0).await;
    }
    let [first, more] = [first, more].map(|facets| &facets[..facets.len().min(BLOCK)]);
    if !more.iter().map(corners).any(|[a, b, c]| a != b && b != c && c != a) {
        return false;
    }
    match (have_normals(first), have_normals(more)) {
        (_, Some(true)) => true,
        (Some(true), _) => false,
        _ => first.is_empty() || are_as_large(first, more),
    }
}

/// Whether most stored normals go with the corners, whichever way these turn; `None` where none is stored.
fn have_normals(facets: &[[u8; FACET]]) -> Option<bool> {
    let (mut stored, mut right) = (0, 0);
    for [normal, a, b, c] in facets.iter().map(normal_and_corners) {
        let [normal, across] = [normal, (b - a).cross(c - a)].map(Vec3::as_dvec3);
        if normal != DVec3::ZERO && across != DVec3::ZERO {
            stored += 1;
            // False for NaN.
            right += usize::from(normal.normalize().dot(across.normalize()).abs() > 0.9);
        }
    }
    (stored > 0).then_some(2 * right > stored)
}

/// Whether the boxes around two parts differ in size by no more than a factor of ten.
fn are_as_large(first: &[[u8; FACET]], more: &[[u8; FACET]]) -> bool {
    let [first, more] = [first, more].map(|facets| {
        let places = || facets.iter().flat_map(corners);
        let (low, high) = (places().reduce(Vec3::min), places().reduce(Vec3::max));
        low.zip(high).map_or(0.0, |(low, high)| low.distance(high))
    });
    first <= 10.0 * more && more <= 10.0 * first
}

/// The text form.
async fn read_text(bytes: &[u8], origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    let mut words = Words::new(text::without_mark(bytes), 1);
    let mut solids = Solids { origin, ..Solids::default() };
    loop {
        let before = words.remaining();
        for _ in 0..BLOCK {
            match words.next() {
                Some(word) => solids.take(word, &mut words)?,
                None => return solids.surface(words.line()),
            }
        }
        pace.rest((before - words.remaining()) as f64).await;
    }
}

/// The text form, word by word: `solid`, `facet`, `outer loop`, `vertex`, in any case and with any indenting, any number
/// of solids. Words that are none of these, such as colours, are passed over.
#[derive(Default)]
struct Solids {
    origin: DVec3,
    positions: Vec<Vec3>,
    faces: Faces,
    in_loop: bool,
    in_solid: bool,
    /// Whether any word was one of the format's.
    known: bool,
}

impl Solids {
    /// Takes a word, and what belongs to it.
    fn take(&mut self, word: &[u8], words: &mut Words) -> Result<(), ReadError> {
        let is = |keyword: &[u8]| word.eq_ignore_ascii_case(keyword);
        if is(b"vertex") {
            self.faces.push_corner(self.positions.len() as u32);
            self.positions.push(vertex(words, self.origin)?);
            self.in_loop = true;
        } else if is(b"endloop") || is(b"endfacet") {
            // Some writers leave out one of the two.
            if self.in_loop {
                self.faces.finish_face();
            }
            self.in_loop = false;
        } else if is(b"solid") || is(b"endsolid") {
            // What follows is a name, and a name may be any word; but the whole file may be a single line.
            words.skip_line_until(b"facet", b"normal");
            self.in_solid = is(b"solid");
        } else if is(b"facet") {
            self.in_solid = true;
        } else {
            return Ok(());
        }
        self.known = true;
        Ok(())
    }

    /// The surface, once there is no word left in `line`, the last.
    fn surface(self, line: usize) -> Result<RawSurface, ReadError> {
        if !self.known {
            let problem = StlProblem::NoFacet;
            return Err(ReadError::malformed("STL", problem));
        }
        if self.in_loop {
            let problem = StlProblem::Ends;
            return Err(ReadError::syntax(ASCII, line, problem));
        }
        let mut raw = RawSurface::of_faces(ASCII, self.positions, &self.faces);
        (raw.has_doubles, raw.origin) = (true, self.origin);
        if self.in_solid {
            raw.warnings.push(Warning::StlOpen);
        }
        Ok(raw)
    }
}

/// The three coordinates after the word `vertex`, relative to `origin`.
fn vertex(words: &mut Words, origin: DVec3) -> Result<Vec3, ReadError> {
    let mut coordinates = [0.0; 3];
    for (coordinate, origin) in coordinates.iter_mut().zip(origin.to_array()) {
        let word = words.next();
        *coordinate = word.and_then(|word| text::coordinate(word, origin)).ok_or_else(|| {
            let problem: Problem = match word {
                Some(word) => TextProblem::NoCoordinate { word: text::quoted(word) }.into(),
                None => StlProblem::Ends.into(),
            };
            ReadError::syntax(ASCII, words.line(), problem)
        })?;
    }
    Ok(Vec3::from(coordinates))
}

/// The binary form, with each facet's own normal (zero where it has no area).
fn write(&Output { mesh, axes, .. }: &Output) -> Result<Vec<u8>, WriteError> {
    let bytes = (HEADER + 4) as u64 + FACET as u64 * mesh.triangles.len() as u64;
    let facets = u32::try_from(mesh.triangles.len()).map_err(|_| WriteError::TooLarge { format: "STL", bytes })?;
    let mut out = Vec::with_capacity(bytes as usize);
    out.extend_from_slice(format!("Surface written by Lumen; binary STL; millimetres{}", axes.said()).as_bytes());
    out.resize(HEADER, b' ');
    out.extend_from_slice(&facets.to_le_bytes());
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
        for p in [normal].iter().chain(&corners) {
            out.extend_from_slice(bytemuck::cast_slice(&p.to_array().map(f32::to_le_bytes)));
        }
        out.extend_from_slice(&[0, 0]);
    }
    Ok(out)
}

messages! {
    /// What is wrong in an STL file.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum StlProblem {
        "errors-stl-no-facet" NoFacet => "it is a text without a single \"facet\"",
        "errors-stl-ends" Ends => "the file ends in the middle of a triangle",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Warning;
    use lumen_mesh::TriMesh;
    use lumen_mesh::task::at_once;

    fn read(bytes: &[u8]) -> Result<RawSurface, ReadError> {
        at_once(super::read(bytes, DVec3::ZERO, &Pace::never()))
    }

    const TWO: &str = "SOLID vertex of facets\n Facet Normal 0 0 1\n outer loop\nVERTEX 0 0 0\nvertex 1 0 0\n\
        vertex 0 1e0 0\n endloop endfacet\nendsolid vertex\nsolid\nfacet normal 0 0 0 outer loop\n\
        vertex 5 0 0 vertex 6 0 0 vertex 6 1 0 vertex 5 1 0 endloop endfacet endsolid";

    #[test]
    fn text_of_several_solids_in_any_case_is_read() {
        let raw = read(TWO.as_bytes()).unwrap();
        assert_eq!((raw.positions.len(), raw.triangles.len(), raw.polygons), (7, 3, 1));
        assert_eq!(raw.positions[2], Vec3::Y);
        assert!(raw.warnings.is_empty());
    }

    #[test]
    fn text_of_a_single_line_is_read() {
        let raw = read(TWO.replace('\n', " ").as_bytes()).unwrap();
        assert_eq!((raw.positions.len(), raw.triangles.len(), raw.polygons), (7, 3, 1));
        assert!(raw.warnings.is_empty());
    }

    #[test]
    fn many_solids_in_a_single_line_are_read_at_once() {
        // Gone over to its end at every solid, this line would be 2e12 bytes.
        let solid =
            "solid a facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid ";
        assert_eq!(read(solid.repeat(200_000).as_bytes()).unwrap().triangles.len(), 200_000);
    }

    #[test]
    fn the_length_decides_where_the_count_is_wrong() {
        let mesh = lumen_mesh::shapes::icosphere(2, 10.0, Vec3::ZERO);
        let found = mesh.triangles.len();
        let good = write(&Output::new(&mesh)).unwrap();
        let with = |announced: u32, more: &[u8]| {
            let mut bytes = [&good, more].concat();
            bytes[80..84].copy_from_slice(&announced.to_le_bytes());
            read(&bytes)
        };
        for announced in [0, 1, found as u32 / 2] {
            for more in [&b""[..], b"\n", b"\0\0\0\0"] {
                let raw = with(announced, more).unwrap();
                assert_eq!(raw.triangles.len(), found);
                assert_eq!(raw.warnings[0], Warning::StlCount { announced, found });
                assert_eq!(raw.warnings.len(), 1 + usize::from(!more.is_empty()));
            }
        }
        for announced in [2 * found as u32, u32::MAX] {
            for more in [&b""[..], b"\n", b"\r\n"] {
                let raw = with(announced, more).unwrap();
                assert_eq!(raw.triangles.len(), found);
                assert_eq!(raw.warnings[0], Warning::StlFewer { announced, found });
                assert!(raw.warnings[0].to_string().ends_with("The file may be cut short."));
            }
            assert!(with(announced, b"\0\0\0\0").is_err());
        }
    }

    #[test]
    fn a_file_cut_off_behind_a_facet_is_refused() {
        let mesh = lumen_mesh::shapes::icosphere(2, 10.0, Vec3::ZERO);
        let good = write(&Output::new(&mesh)).unwrap();
        for left in [1, 100, mesh.triangles.len() - 1] {
            for more in 0..=FEW {
                let problem = read(&good[..84 + FACET * left + more]).err().unwrap().to_string();
                assert!(problem.contains("cut short"), "{problem}");
            }
        }
    }

    #[test]
    fn what_stands_behind_the_facets_is_no_facet() {
        let mesh = lumen_mesh::shapes::icosphere(2, 10.0, Vec3::ZERO);
        let found = mesh.triangles.len();
        let good = write(&Output::new(&mesh)).unwrap();
        let regions: Vec<u8> = (0..25 * found as u32).flat_map(|i| (i % 7).to_le_bytes()).collect();
        let values: Vec<u8> = (0..25 * found).flat_map(|i| (i as f32).sin().to_le_bytes()).collect();
        for more in [&[0; 500][..], &[b'x'; 500], &[b'x'; 512], &[0; 30], &regions, &values] {
            let raw = read(&[&good, more].concat()).unwrap();
            let warning = Warning::StlTrailing { bytes: more.len() };
            assert_eq!((raw.triangles.len(), &raw.warnings[..]), (found, &[warning][..]));
        }
    }

    #[test]
    fn facets_without_normals_behind_those_announced_are_facets_of_like_size() {
        let mesh = lumen_mesh::shapes::icosphere(2, 10.0, Vec3::ZERO);
        let mut bytes = write(&Output::new(&mesh)).unwrap();
        bytes[84..].as_chunks_mut::<FACET>().0.iter_mut().for_each(|facet| facet[..12].fill(0));
        let half = mesh.triangles.len() / 2;
        bytes[80..84].copy_from_slice(&(half as u32).to_le_bytes());
        assert_eq!(read(&bytes).unwrap().triangles.len(), 2 * half);
        let values = (0..25 * half).flat_map(|i| (1e-3 * (i as f32).sin()).to_le_bytes());
        let bytes: Vec<u8> = bytes[..84 + FACET * half].iter().copied().chain(values).collect();
        assert_eq!(read(&bytes).unwrap().triangles.len(), half);
    }

    #[test]
    fn broken_text_is_refused_with_its_line() {
        let problem = |text: &str| read(text.as_bytes()).err().unwrap().to_string();
        assert_eq!(
            problem(&TWO.replace("1e0", "1,0")),
            "The STL ascii file is broken at line 6: \"1,0\" stands where a coordinate should."
        );
        assert!(problem(TWO.split(" endloop").next().unwrap()).contains("ends in the middle of a triangle"));
        assert!(problem("Dear colleague, please find enclosed").contains("without a single \"facet\""));
    }

    #[test]
    fn a_binary_that_begins_with_solid_trails_or_ends_early_is_told_apart() {
        let mesh = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
        let mut bytes = write(&Output::new(&mesh)).unwrap();
        bytes[..5].copy_from_slice(b"solid");
        assert!(has_binary_length(&bytes));
        assert_eq!(read(&bytes).unwrap().positions, mesh.positions);
        assert_eq!(f32::from_le_bytes(*bytes[92..].first_chunk().unwrap()), 1.0, "the normal is +z");
        bytes.extend_from_slice(b"etc");
        assert_eq!(read(&bytes).unwrap().warnings, [Warning::StlTrailing { bytes: 3 }]);
        bytes[80..84].copy_from_slice(&60_000_000u32.to_le_bytes());
        assert_eq!(
            read(&bytes[..100]).err().unwrap().to_string(),
            "The STL binary file is cut short: it announces 60000000 triangles and holds 0."
        );
    }
}
