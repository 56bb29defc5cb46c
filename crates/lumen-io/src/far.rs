//! Surfaces far from the origin of their coordinates, as those of a scanner's room or of a map.
//!
//! f32 has seven digits. Where the first ones are the same for the whole surface, too few are left for its shape; a file
//! of doubles or of text has them. Such a file is read once more, relative to a place within the surface, in f64.

use glam::DVec3;

use super::Unit;
use super::import::FARTHEST_MM;
use super::raw::RawSurface;
use lumen_mesh::Bounds;

/// Farther from the origin than so many times its size, a surface loses more than six bits of 24 to the way there.
const FAR: f64 = 64.0;

/// The place, in the numbers of `raw`, that its file should be read relative to; `None` where the origin will do, where
/// the file has no more digits, and where the surface is too far away to be one.
pub(super) fn origin_for(raw: &RawSurface, unit: Unit) -> Option<DVec3> {
    let most = Bounds::of_most(&raw.positions);
    let (centre, size) = (most.centre().as_dvec3(), f64::from(most.longest_side()));
    let away = centre.abs().max_element();
    let farthest = FARTHEST_MM / if raw.in_mm { 1.0 } else { unit.to_mm() };
    let is_far = away > FAR * size && away < farthest;
    if !raw.has_doubles || !is_far {
        return None;
    }
    // A round number: a multiple of a power of two that is no larger than the surface. Of a surface that f32 has made a
    // point, of the distance between two f32 there.
    let least = f64::from(f32::EPSILON) * away;
    let step = libm::exp2(libm::floor(libm::log2(size.max(least))));
    Some((centre / step).round() * step)
}

#[cfg(test)]
mod tests {
    use crate::{Format, ImportOptions, Imported, Unit, Warning, read, write};
    use lumen_mesh::shapes::icosphere;
    use lumen_mesh::{TriMesh, Vec3};

    /// A sphere of 4 mm in numbers of 16 digits, `offset` from the origin, as the text of each format.
    fn texts(offset: [f64; 3]) -> Vec<(&'static str, Vec<u8>, TriMesh)> {
        let mesh = icosphere(2, 2.0, Vec3::ZERO);
        let at = |p: &Vec3| {
            p.as_dvec3().to_array().iter().zip(offset).map(|(x, o)| format!("{} ", x + o)).collect::<String>()
        };
        let faces = |first: u32| mesh.triangles.iter().map(move |t| t.map(|v| (v + first).to_string()).join(" "));
        let vertices = mesh.positions.iter().map(at);
        let obj: String =
            vertices.clone().map(|p| format!("v {p}\n")).chain(faces(1).map(|f| format!("f {f}\n"))).collect();
        let header = |encoding: &str| {
            format!(
                "ply\nformat {encoding} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
                 element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                mesh.positions.len(),
                mesh.triangles.len()
            )
        };
        let ply: String = [header("ascii")]
            .into_iter()
            .chain(vertices.map(|p| p + "\n"))
            .chain(faces(0).map(|f| format!("3 {f}\n")))
            .collect();
        let mut binary = header("binary_little_endian").into_bytes();
        for p in &mesh.positions {
            binary.extend(p.as_dvec3().to_array().iter().zip(offset).flat_map(|(x, o)| (x + o).to_le_bytes()));
        }
        for t in &mesh.triangles {
            binary.push(3);
            binary.extend(t.iter().flat_map(|v| v.to_le_bytes()));
        }
        let facets: String = (0..mesh.triangles.len())
            .map(|t| {
                let corners = mesh.corners(t).map(|p| format!("vertex {}", at(&p))).join("\n");
                format!("facet normal 0 0 0\nouter loop\n{corners}\nendloop\nendfacet\n")
            })
            .collect();
        let stl = format!("solid far\n{facets}endsolid far\n");
        vec![
            ("far.obj", obj.into_bytes(), mesh.clone()),
            ("far.ply", ply.into_bytes(), mesh.clone()),
            ("far.ply", binary, mesh.clone()),
            ("far.stl", stl.into_bytes(), mesh),
        ]
    }

    fn imported(bytes: &[u8], name: &str) -> Imported {
        read(bytes, name, &ImportOptions { unit: Some(Unit::Millimetre) }).unwrap()
    }

    #[test]
    fn digits_beyond_those_of_f32_are_not_lost_on_the_way_to_the_origin() {
        for offset in [[3e7, -2e6, 5.25], [1e8, 1e8, 1e8], [0.0, 7e5, 0.0]] {
            for (name, bytes, sphere) in texts(offset) {
                let Imported { mesh, report, .. } = imported(&bytes, name);
                assert_eq!(
                    (mesh.positions.len(), mesh.triangles.len()),
                    (sphere.positions.len(), sphere.triangles.len())
                );
                let moved = mesh.positions.iter().map(|p| p.as_dvec3() - glam::DVec3::from(report.moved_mm));
                let right = |p: glam::DVec3| {
                    sphere.positions.iter().any(|q| (q.as_dvec3() + glam::DVec3::from(offset) - p).length() < 2e-6)
                };
                assert!(moved.into_iter().all(right), "{name}, {offset:?}");
                assert!(
                    report.warnings.iter().any(|warning| matches!(warning, Warning::Moved { .. })),
                    "{:?}",
                    report.warnings
                );
            }
        }
    }

    #[test]
    fn a_surface_not_far_from_the_origin_and_one_of_f32_stay_where_they_are() {
        for (name, bytes, _) in texts([120.0, -90.0, 4.0]) {
            let report = imported(&bytes, name).report;
            assert_eq!(report.moved_mm, [0.0; 3], "{name}");
            assert!((report.bounds_mm.min[0] - 118.0).abs() < 1e-4, "{name}");
        }
        let far = icosphere(2, 2.0, Vec3::new(0.0, 7e5, 0.0));
        for format in [Format::Stl, Format::Ply, Format::Glb] {
            assert_eq!(imported(&write(&far, None, format).unwrap(), "far").report.moved_mm, [0.0; 3]);
        }
    }

    #[test]
    fn one_vertex_far_away_moves_nothing() {
        let mut mesh = icosphere(2, 2.0, Vec3::ZERO);
        mesh.positions[7].x = 1e8;
        let report = imported(&write(&mesh, None, Format::Obj).unwrap(), "stray.obj").report;
        assert_eq!((report.moved_mm, report.bounds_mm.max[0]), ([0.0; 3], 1e8));
    }
}
