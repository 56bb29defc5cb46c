//! The bytes of a file on their way to the polygons in them.

use glam::DVec3;

use super::axes::{self, Axes};
use super::detect::detect;
use super::error::ReadError;
use super::memory_budget::MemoryBudget;
use super::pace::Pace;
use super::raw::RawSurface;
use super::{ImportOptions, Unit, far, stl, text};
use lumen_mesh::task::Yielder;

/// The polygons in a file, the unit of its numbers and its axes.
pub(super) type Parsed = (RawSurface, Unit, Axes);

/// Parses the bytes of a file.
pub(super) async fn parse(
    bytes: &[u8],
    name: &str,
    options: &ImportOptions,
    yielder: &Yielder,
) -> Result<Parsed, ReadError> {
    let utf8 = if stl::has_binary_length(bytes) { None } else { text::from_utf16(bytes, yielder).await };
    let bytes = utf8.as_deref().unwrap_or(bytes);
    let kind = detect(bytes, name)?;
    let unit = options.unit.unwrap_or(kind.unit);
    let pace = Pace::new(yielder, bytes.len());
    pace.rest(0.0).await;
    let mut raw = (kind.parse)(bytes, unit, DVec3::ZERO, &pace).await?;
    if let Some(origin) = far::origin_for(&raw, unit) {
        // Once more, relative to a place within the surface; never both at once.
        drop(raw);
        pace.begin_again();
        pace.rest(0.0).await;
        raw = (kind.parse)(bytes, unit, origin, &pace).await?;
    }
    MemoryBudget::of(bytes.len().saturating_add(raw.unpacked)).check(
        raw.label,
        raw.positions.len(),
        raw.triangles.len(),
    )?;
    let axes = if kind.axes_in_head { axes::stated(bytes) } else { raw.axes };
    Ok((raw, unit, axes))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::{Imported, read, read_in_slices};
    use lumen_mesh::shapes::icosphere;
    use lumen_mesh::task::{Budget, Progress, Running};
    use lumen_mesh::{TriMesh, Vec3};

    /// A sphere in each format that has room for doubles or STL's facets, `offset` from the origin.
    fn texts(offset: f64) -> (TriMesh, Vec<(&'static str, Vec<u8>)>) {
        let mesh = icosphere(6, 20.0, Vec3::ZERO);
        let at = |v: u32| mesh.positions[v as usize].as_dvec3().to_array().map(|x| x + offset);
        let words = |v: u32| at(v).map(|x| x.to_string()).join(" ");
        let corners = mesh.triangles.as_flattened();
        let count = mesh.positions.len() as u32;
        let header = |encoding: &str| {
            format!(
                "ply\nformat {encoding} 1.0\nelement vertex {count}\nproperty double x\nproperty double y\n\
                 property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
                mesh.triangles.len()
            )
        };
        let mut facets = vec![b' '; 80];
        facets.extend_from_slice(&(mesh.triangles.len() as u32).to_le_bytes());
        for t in &mesh.triangles {
            facets.extend_from_slice(&[0; 12]);
            t.iter().for_each(|&v| facets.extend(at(v).iter().flat_map(|&x| (x as f32).to_le_bytes())));
            facets.extend_from_slice(&[0; 2]);
        }
        let [mut little, mut big] = ["binary_little_endian", "binary_big_endian"].map(|kind| header(kind).into_bytes());
        for x in (0..count).flat_map(at) {
            little.extend_from_slice(&x.to_le_bytes());
            big.extend_from_slice(&x.to_be_bytes());
        }
        for t in &mesh.triangles {
            little.push(3);
            big.push(3);
            little.extend(t.iter().flat_map(|v| v.to_le_bytes()));
            big.extend(t.iter().flat_map(|v| v.to_be_bytes()));
        }
        let (mut solid, mut obj, mut ascii) = ("solid a\n".to_owned(), String::new(), header("ascii"));
        for three in corners.chunks(3) {
            solid += "facet normal 0 0 0\nouter loop\n";
            three.iter().for_each(|&v| solid += &format!("vertex {}\n", words(v)));
            solid += "endloop\nendfacet\n";
        }
        solid += "endsolid a\n";
        for v in 0..count {
            obj += &format!("v {}\n", words(v));
            // A number that the header does not announce: the text is read a second time, row by row.
            ascii += &format!("{} 7\n", words(v));
        }
        let (mut rows, mut ids) = (String::new(), String::new());
        for &[a, b, c] in &mesh.triangles {
            obj += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
            rows += &format!("3 {a} {b} {c}\n");
            ids += &format!("{a} {b} {c}\n");
        }
        ascii += &rows;
        let triangles = mesh.triangles.len();
        let points: String = (0..count).map(|v| words(v) + "\n").collect();
        let ends: String = (1..=triangles).map(|t| format!("{} ", 3 * t)).collect();
        let legacy = format!(
            "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS {count} double\n{points}\
             POLYGONS {triangles} {}\n{rows}",
            4 * triangles
        );
        let array = |kind: &str, name: &str, numbers: &str| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"3\" format=\"ascii\">{numbers}</DataArray>"
            )
        };
        let vtp = format!(
            "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"{count}\" NumberOfPolys=\"{triangles}\">\
             <Points>{}</Points><Polys>{}{}</Polys></Piece></PolyData></VTKFile>",
            array("Float64", "Points", &points),
            array("Int64", "connectivity", &ids),
            array("Int64", "offsets", &ends),
        );
        let files = vec![
            ("a.stl", facets),
            ("text.stl", solid.into_bytes()),
            ("little.ply", little),
            ("big.ply", big),
            ("text.ply", ascii.into_bytes()),
            ("a.obj", obj.into_bytes()),
            ("text.vtk", legacy.into_bytes()),
            ("text.vtp", vtp.into_bytes()),
        ];
        (mesh, files)
    }

    /// What is read in the smallest slices, and the fractions that were told.
    fn in_slices(bytes: Vec<u8>, name: &str) -> (Imported, Vec<f32>) {
        let (bytes, options) = (Arc::new(bytes), ImportOptions::default());
        let mut reading = Running::new(|yielder| async move { read_in_slices(bytes, name, &options, &yielder).await });
        let mut told = Vec::new();
        loop {
            match reading.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(fraction) => told.push(fraction),
                Progress::Done(read) => return (read.unwrap(), told),
            }
        }
    }

    #[test]
    fn texts_in_utf_16_are_read() {
        let (_, files) = texts(0.0);
        for (name, bytes) in files.into_iter().filter(|(name, _)| name.starts_with("text") || *name == "a.obj") {
            let text = format!("\u{feff}{}", String::from_utf8(bytes.clone()).unwrap());
            let options = ImportOptions::default();
            let expected = read(&bytes, name, &options).unwrap();
            for unit in [u16::to_le_bytes, u16::to_be_bytes] {
                let wide: Vec<u8> = text.encode_utf16().flat_map(unit).collect();
                assert_eq!(read(&wide, name, &options).unwrap(), expected, "{name}");
            }
        }
    }

    #[test]
    fn a_file_read_in_slices_is_the_file_read_at_once() {
        for offset in [0.0, 3e7] {
            let (sphere, files) = texts(offset);
            // Far away the text is read once more.
            for (name, bytes) in files.into_iter().filter(|(name, _)| offset == 0.0 || name.starts_with("text")) {
                let whole = read(&bytes, name, &ImportOptions::default()).unwrap();
                let (sliced, told) = in_slices(bytes, name);
                assert_eq!(sliced, whole, "{name}");
                let counts = (sliced.mesh.positions.len(), sliced.mesh.triangles.len());
                assert_eq!(counts, (sphere.positions.len(), sphere.triangles.len()), "{name}");
                assert!(told.windows(2).all(|two| two[0] <= two[1]), "{name}: {told:?}");
                let parsing = told.iter().filter(|&&fraction| fraction > 0.0 && fraction < 0.2).count();
                assert!(parsing >= 2, "{name}: {told:?}");
            }
        }
    }
}
