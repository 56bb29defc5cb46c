//! How much work a file will be, from its beginning alone: before it is read.

use super::detect::detect;

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
    let triangles = (detect(bytes, name).ok()?.triangles)(bytes);
    Some(Estimate { triangles, memory: length + TRIANGLE * triangles })
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
