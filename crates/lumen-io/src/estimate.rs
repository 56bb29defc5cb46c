//! How much work a file will be, from its beginning alone: before it is read.

use super::detect::{self, Content};
use super::stl;

/// What a triangle takes at most on its way through import, smoothing and reduction, in bytes: ten million, opened and reduced
/// by 90 %, took 2.8 GB (docs/robustness.md).
const TRIANGLE: u64 = 300;

/// What the file of a surface seems to hold, and take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// Triangles: exactly for binary STL, by what a PLY announces, else by what files of that length usually hold.
    pub triangles: u64,
    /// Memory in bytes for opening and reducing it.
    pub memory: u64,
}

/// The estimate for a file; `None` where its content is none that is read as a surface.
pub fn estimate(bytes: &[u8], name: &str) -> Option<Estimate> {
    let length = bytes.len() as u64;
    let triangles = match detect::detect(bytes, name).ok()? {
        Content::Stl if stl::has_binary_length(bytes) => length / 50,
        // Seven lines of text.
        Content::Stl => length / 250,
        Content::Ply => announced_faces(bytes).unwrap_or(length / 20),
        // Half a vertex and a face in words.
        Content::Obj => length / 35,
        // Half a vertex of three f32, three numbers of 32 bits and, in VTK, how many there are; packed to a third of that.
        Content::Vtk => length / 22,
        Content::Glb | Content::Gltf => length / 18,
        Content::Vtp => length / 7,
    };
    Some(Estimate { triangles, memory: length + TRIANGLE * triangles })
}

/// The faces that the header of a PLY announces; no more than there are bytes for.
fn announced_faces(bytes: &[u8]) -> Option<u64> {
    let head = &bytes[..bytes.len().min(4096)];
    let line = head.split(|&byte| byte == b'\n').find_map(|line| line.strip_prefix(b"element face "))?;
    let faces: u64 = std::str::from_utf8(line).ok()?.trim().parse().ok()?;
    Some(faces.min(bytes.len() as u64 / 4))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, write};
    use lumen_vessel::phantom::{Sample, generate};

    #[test]
    fn files_that_programs_write_are_estimated_to_a_third() {
        let mesh = generate(Sample::Aorta, 20_000).unwrap();
        let triangles = mesh.triangles.len() as f64;
        for format in Format::ALL {
            let bytes = write(&mesh, None, format).unwrap();
            let name = format!("a.{}", format.extension());
            let ratio = estimate(&bytes, &name).unwrap().triangles as f64 / triangles;
            let most = if matches!(format, Format::Stl | Format::Ply) { 1.0001 } else { 1.5 };
            assert!((1.0 / most..=most).contains(&ratio), "{format:?}: {ratio}");
        }
        assert_eq!(estimate(b"Dear colleague", "letter.txt"), None);
        assert_eq!(
            estimate(b"ply\nformat ascii 1.0\nelement face 4000000000\nend_header\n", "a.ply").unwrap().triangles,
            14
        );
    }
}
