//! OBJ (Wavefront 1995): lines of text, of which `v` and `f` make the surface.
//!
//! Texture coordinates, normals, groups, materials and colours are passed over. The crate `tobj` is not used: it
//! splits the surface by group and material, takes a face of two corners for a line without saying so, and fans
//! concave faces.

use std::borrow::Cow;
use std::fmt::Write as _;

use glam::DVec3;

use super::error::ReadError;
use super::import::RawSurface;
use super::polygons::Faces;
use super::text;
use crate::mesh::{TriMesh, Vec3};

/// Whether a text without a telling name has vertices as OBJ writes them among its first lines.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let mut lines = bytes[..bytes.len().min(4096)].split(|&byte| byte == b'\n');
    text::is_text(bytes)
        && lines.any(|line| {
            let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            words.next() == Some(b"v") && (0..3).all(|_| words.next().and_then(text::number::<f32>).is_some())
        })
}

/// Reads an OBJ file, with positions relative to `origin`.
pub(super) fn read(bytes: &[u8], origin: DVec3) -> Result<RawSurface, ReadError> {
    if !text::is_text(bytes) {
        let problem = "it should be a text and is not".to_owned();
        return Err(ReadError::Malformed { format: "OBJ", problem });
    }
    let mut positions: Vec<Vec3> = Vec::new();
    let mut faces = Faces::default();
    let (mut lines, mut points, mut faces_read) = (0, 0, 0);
    // The farthest vertex that a face names, and that face.
    let mut farthest = (0, 0);
    for (line, row) in logical_lines(text::without_mark(bytes)) {
        let mut words = row.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let syntax = |problem: String| ReadError::Syntax { format: "OBJ", line, problem };
        match words.next() {
            Some(b"v") => {
                let mut coordinates = [0.0; 3];
                for (coordinate, origin) in coordinates.iter_mut().zip(origin.to_array()) {
                    let word = words.next().ok_or_else(|| syntax("a vertex needs three coordinates".to_owned()))?;
                    let broken = || syntax(format!("{} stands where a coordinate should", text::quoted(word)));
                    *coordinate = text::coordinate(word, origin).ok_or_else(broken)?;
                }
                positions.push(Vec3::from(coordinates));
            }
            Some(b"f") => {
                faces_read += 1;
                for word in words {
                    // A corner is v, v/vt, v//vn or v/vt/vn.
                    let vertex = word.split(|&byte| byte == b'/').next().unwrap_or(word);
                    let broken = || syntax(format!("{} stands where a vertex number should", text::quoted(word)));
                    let index: i64 = text::number(vertex).ok_or_else(broken)?;
                    // Negative numbers count back from the vertex read last; positive ones may look ahead.
                    let place =
                        if index < 0 { index.checked_add(positions.len() as i64) } else { index.checked_sub(1) };
                    let corner =
                        place.and_then(|place| u32::try_from(place).ok()).ok_or(ReadError::IndexOutOfRange {
                            format: "OBJ",
                            face: faces_read,
                            index,
                            vertices: positions.len(),
                        })?;
                    farthest = farthest.max((corner, faces_read));
                    faces.push_corner(corner);
                }
                faces.finish_face();
            }
            Some(b"l") => lines += 1,
            Some(b"p") => points += 1,
            _ => {}
        }
    }
    let (corner, face) = farthest;
    if face > 0 && corner as usize >= positions.len() {
        let (index, vertices) = (i64::from(corner) + 1, positions.len());
        return Err(ReadError::IndexOutOfRange { format: "OBJ", face, index, vertices });
    }
    let mut raw = RawSurface::of_faces("OBJ", positions, &faces);
    (raw.has_doubles, raw.origin) = (true, origin);
    raw.skipped.lines = lines;
    raw.skipped.points = points;
    Ok(raw)
}

/// The lines of a text with their numbers from 1, those that end in a backslash joined with the next.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut physical = bytes.split(|&byte| byte == b'\n').zip(1..);
    std::iter::from_fn(move || {
        let (first, number) = physical.next()?;
        let mut line = Cow::Borrowed(first);
        while let Some(start) = line.trim_ascii_end().strip_suffix(b"\\") {
            let length = start.trim_ascii_end().len();
            let joined = line.to_mut();
            joined.truncate(length);
            joined.push(b' ');
            joined.extend_from_slice(physical.next().map_or(b"", |(next, _)| next));
        }
        Some((number, line))
    })
}

/// Text with the shortest numbers that read back to the same bits.
pub(super) fn write(mesh: &TriMesh, normals: Option<&[Vec3]>) -> Vec<u8> {
    let mut out = String::with_capacity(mesh.positions.len() * 36 + mesh.triangles.len() * 24);
    out.push_str("# Surface written by Lumen; millimetres\n");
    // Writing to a String cannot fail.
    for p in &mesh.positions {
        let _ = writeln!(out, "v {} {} {}", p.x, p.y, p.z);
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

    fn read(bytes: &[u8]) -> Result<RawSurface, ReadError> {
        super::read(bytes, DVec3::ZERO)
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
