//! The import stage: what every surface goes through, whichever format it came in.
//!
//! In this order: coordinates are checked, coincident vertices welded, triangles that repeat a vertex dropped, unused
//! vertices left out, numbers turned into mm, windings made to agree, inward components turned. Welding comes before
//! the change of unit, because rounding to f32 after a multiplication can make two places one.
//!
//! The stage rests now and then: for a surface of ten million triangles it takes longer than the reading of its bytes.

use std::mem;

use glam::DVec3;

use super::error::ReadError;
use super::raw::{RawSurface, check_size};
use super::report::{ImportReport, Imported};
use super::warnings::{Warning, warnings};
use super::weld::weld;
use super::{Axes, Unit};
use lumen_mesh::arrays::infos;
use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{Array, Components, EdgeCounts, Topology, TriMesh, components, measures, winding};

/// Farther out than this, in mm, nothing is a place in a body, and squares near the end of f32's range.
pub(super) const FARTHEST_MM: f64 = 1e9;

/// Takes a surface from a file through the stage; fails where nothing of it has a place or an area.
pub(super) async fn import_file(
    raw: RawSurface,
    unit: Unit,
    axes: Axes,
    yielder: &Yielder,
) -> Result<Imported, ReadError> {
    let format = raw.label;
    if raw.triangles.is_empty() {
        return Err(ReadError::NoTriangles { format, vertices: raw.positions.len() });
    }
    check_size(raw.positions.len(), raw.triangles.len())?;
    let scale = if raw.in_mm { 1.0 } else { unit.to_mm() };
    for &v in raw.triangles.as_flattened() {
        for x in raw.positions[v as usize].to_array() {
            let value = f64::from(x) * scale;
            // NaN is in no range.
            if !(-FARTHEST_MM..=FARTHEST_MM).contains(&value) {
                return Err(ReadError::Coordinate { vertex: v as usize + 1, value });
            }
        }
    }
    let imported = import(raw, unit, axes, yielder).await;
    if imported.mesh.triangles.is_empty() {
        return Err(ReadError::AllDegenerate { format, triangles: imported.report.triangles });
    }
    Ok(imported)
}

/// Takes a surface that was made, not read, through the same stage; its positions are in mm, its axes the patient's as
/// DICOM has them.
///
/// # Panics
/// When an index of `mesh` is out of range.
pub fn import_mesh(mesh: TriMesh, format_label: &str) -> Imported {
    at_once(import_made(mesh, format_label.to_owned(), Axes::Lps, Vec::new(), &Yielder::never()))
}

/// Takes the arrays of another program through the same stage, as if a file held them in this unit.
///
/// # Errors
/// [`ReadError`] where a coordinate is no place, or nothing has an area.
///
/// # Panics
/// When an index of `mesh` is out of range.
pub async fn import_arrays(mesh: TriMesh, unit: Unit, yielder: &Yielder) -> Result<Imported, ReadError> {
    import_file(RawSurface::new("arrays", mesh.positions, mesh.triangles), unit, Axes::Unknown, yielder).await
}

/// As [`import_mesh`], in these axes, resting now and then. The warnings on what it was made of stand before those on the
/// surface.
///
/// # Panics
/// When an index of `mesh` is out of range.
pub async fn import_made(
    mesh: TriMesh,
    format: String,
    axes: Axes,
    warnings: Vec<Warning>,
    yielder: &Yielder,
) -> Imported {
    let raw = RawSurface::new("", mesh.positions, mesh.triangles);
    let mut imported = import(raw, Unit::Millimetre, Axes::Lps, yielder).await;
    (imported.report.format, imported.report.axes) = (format, axes);
    imported.report.warnings.splice(..0, warnings);
    imported
}

/// The stage itself. Welding rests between blocks, each of the other steps is one piece.
async fn import(mut raw: RawSurface, unit: Unit, axes: Axes, yielder: &Yielder) -> Imported {
    let triangles = raw.triangles.len();
    let lists = (mem::take(&mut raw.positions), mem::take(&mut raw.triangles), mem::take(&mut raw.arrays));
    let import = Import { raw, triangles, unit, axes };
    let (mesh, arrays) = weld(lists.0, lists.1, lists.2, &yielder.part(0.0..0.5)).await;
    yielder.rest(0.5).await;
    let oriented = import.orient(mesh, arrays);
    yielder.rest(0.8).await;
    import.measure(oriented)
}

/// A surface in the stage.
struct Import {
    /// The surface, without its lists, which went on to the steps.
    raw: RawSurface,
    /// Triangles in the file.
    triangles: usize,
    unit: Unit,
    axes: Axes,
}

/// A surface whose windings agree as far as they can.
struct Oriented {
    mesh: TriMesh,
    arrays: Vec<Array>,
    topology: Topology,
    pieces: Components,
    /// Edges as they were before.
    edges: EdgeCounts,
    duplicate_triangles: usize,
    /// Whether the windings of a piece agree.
    orientable: Vec<bool>,
    reoriented_triangles: usize,
}

impl Import {
    /// Turns triangles until neighbours agree.
    fn orient(&self, mut mesh: TriMesh, arrays: Vec<Array>) -> Oriented {
        if !self.raw.in_mm && self.unit.to_mm() != 1.0 {
            for p in &mut mesh.positions {
                *p = (p.as_dvec3() * self.unit.to_mm()).as_vec3();
            }
        }
        let mut topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let pieces = components(mesh.positions.len(), &mesh.triangles);
        let edges = topology.edge_counts();
        let duplicate_triangles = duplicates(&mesh.triangles, &topology);

        // Without a flip there is nothing to reverse: every pair of neighbours agrees.
        let (mut orientable, mut reoriented_triangles) = (vec![true; pieces.count()], 0);
        if edges.flipped > 0 {
            let result = winding::make_consistent(&mut mesh.triangles, &topology, &pieces);
            (orientable, reoriented_triangles) = (result.orientable, result.reversed);
            topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        }
        Oriented { mesh, arrays, topology, pieces, edges, duplicate_triangles, orientable, reoriented_triangles }
    }

    /// Turns pieces outward, and measures.
    fn measure(self, oriented: Oriented) -> Imported {
        let Oriented { mut mesh, arrays, mut topology, pieces, edges, duplicate_triangles, orientable, .. } = oriented;
        let components_turned = winding::turn_outward(&mut mesh, &topology, &pieces, &orientable);
        if components_turned > 0 {
            topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        }
        let measured = measures(&mesh, &topology);
        let largest = pieces.largest().map_or(0, |piece| pieces.triangle_counts[piece as usize] as usize);
        let scale = if self.raw.in_mm { 1.0 } else { self.unit.to_mm() };
        let mut report = ImportReport {
            format: self.raw.label.to_owned(),
            unit: self.unit,
            unit_by_size: false,
            scale_to_mm: self.unit.to_mm(),
            axes: self.axes,
            triangles: self.triangles,
            vertices: mesh.positions.len(),
            polygons_triangulated: self.raw.polygons,
            degenerate_triangles: self.triangles - mesh.triangles.len(),
            duplicate_triangles,
            components: pieces.count(),
            largest_component_triangles: largest,
            boundary_edges: edges.boundary,
            non_manifold_edges: edges.non_manifold,
            winding_flips: edges.flipped,
            reoriented_triangles: oriented.reoriented_triangles,
            components_turned,
            orientable: orientable.iter().all(|&orientable| orientable),
            area_mm2: measured.area_mm2,
            volume_mm3: measured.volume_mm3,
            bounds_mm: mesh.bounds(),
            moved_mm: ((DVec3::ZERO - self.raw.origin) * scale).to_array(),
            threshold: None,
            skipped: self.raw.skipped,
            arrays: infos(&arrays),
            warnings: self.raw.warnings,
        };
        let mut told = warnings(&report);
        report.warnings.append(&mut told);
        Imported { mesh, arrays, report }
    }
}

/// Triangles over the same three vertices as an earlier one.
fn duplicates(triangles: &[[u32; 3]], topology: &Topology) -> usize {
    let mut found = 0;
    let mut others: Vec<(u32, u32)> = Vec::new();
    for v in 0..topology.vertex_count() as u32 {
        others.clear();
        for &t in topology.triangles(v) {
            let [a, b, c] = triangles[t as usize];
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            // Each triangle is looked at from its lowest vertex alone.
            if low == v {
                others.push((a ^ b ^ c ^ low ^ high, high));
            }
        }
        others.sort_unstable();
        found += others.windows(2).filter(|pair| pair[0] == pair[1]).count();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Warning, in_english};
    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::tube;

    fn import(raw: RawSurface, unit: Unit, axes: Axes) -> Result<Imported, ReadError> {
        at_once(import_file(raw, unit, axes, &Yielder::never()))
    }

    /// Ten triangle corners of a tetrahedron of the given size, not welded, one triangle turned over, with a
    /// duplicate, a degenerate triangle and a vertex that nothing uses.
    fn soup(size: f32) -> RawSurface {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let order = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 2, 3, 0, 0, 1];
        let mut positions: Vec<Vec3> = order.iter().map(|&v| corners[v] * size).collect();
        positions.push(Vec3::splat(-7.0 * size));
        RawSurface::new("soup", positions, (0..5).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
    }

    #[test]
    fn a_soup_becomes_an_oriented_surface_with_its_faults_counted() {
        let Imported { mesh, report, .. } = import(soup(4.0), Unit::Centimetre, Axes::Unknown).unwrap();
        assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::Y * 40.0, Vec3::X * 40.0, Vec3::Z * 40.0]);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [2, 1, 3], [0, 3, 1]]);
        assert_eq!((report.triangles, report.degenerate_triangles, report.winding_flips), (5, 1, 3));
        assert_eq!((report.reoriented_triangles, report.components_turned, report.orientable), (1, 0, true));
        assert!((report.volume_mm3.unwrap() - 64000.0 / 6.0).abs() < 1e-9);
        assert_eq!(report.bounds_mm.max, [40.0; 3]);
        assert_eq!(
            in_english(&report.warnings),
            ["1 triangle with a repeated vertex dropped.", "1 triangle turned over to agree with the neighbours."]
        );
    }

    #[test]
    fn duplicates_are_counted_whatever_their_winding_and_kept() {
        let mesh =
            TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2], [1, 0, 2], [2, 0, 1]] };
        let imported = import_mesh(mesh.clone(), "made");
        assert_eq!(imported.report.duplicate_triangles, 2);
        assert_eq!((imported.mesh, imported.report.format.as_str()), (mesh, "made"));
    }

    #[test]
    fn an_unusual_size_is_told_with_the_units_that_would_fit() {
        let warnings = |size, unit| in_english(&import(soup(size), unit, Axes::Unknown).unwrap().report.warnings);
        assert_eq!(
            warnings(0.2, Unit::Millimetre)[0],
            "The surface is 0.346 mm from corner to corner, which is unusual for vessels: its numbers may be in m (346 mm)."
        );
        assert!(warnings(3e-7, Unit::Millimetre)[0].ends_with("check its unit of length."));
        // In cm it would be 520 mm long and 84 mm wide.
        assert!(warnings(30.0, Unit::Metre)[0].ends_with("its numbers may be in mm (52.0 mm)."));
    }

    #[test]
    fn vessels_that_are_too_thin_or_too_wide_for_their_unit_are_told() {
        // An aorta of 12 mm, 24 cm long.
        let warnings = |part: f32, unit| {
            let aorta = tube(32, 120, 240.0 * part, |_| 6.0 * part);
            let raw = RawSurface::new("tube", aorta.positions, aorta.triangles);
            in_english(&import(raw, unit, Axes::Unknown).unwrap().report.warnings)
        };
        assert_eq!(
            warnings(0.1, Unit::Millimetre),
            [
                "Its vessels are 1.196 mm wide on average, which is unusual: the numbers of the file may be in cm (12.0 mm)."
            ]
        );
        assert!(warnings(1e-3, Unit::Millimetre)[0].ends_with("its numbers may be in m (241 mm)."));
        assert!(warnings(1.0, Unit::Centimetre)[0].ends_with("its numbers may be in mm (241 mm)."));
        for (part, unit) in [(1.0, Unit::Millimetre), (0.1, Unit::Centimetre), (1e-3, Unit::Metre)] {
            assert!(warnings(part, unit).is_empty(), "{:?}", warnings(part, unit));
        }
        for sample in lumen_vessel::phantom::Sample::ALL {
            let made = lumen_vessel::phantom::generate(sample, 20_000).unwrap();
            assert!(
                import_mesh(made, "sample").report.warnings.iter().all(|warning| !matches!(warning, Warning::Size(_)))
            );
        }
    }

    #[test]
    fn a_piece_of_small_vessels_is_told_with_its_other_unit_and_stays_in_its_own() {
        // Pieces of cerebral arteries, 1.4 to 3.5 mm wide, and the same numbers as those of an aorta in cm; the last is as
        // long beside its width as no small piece.
        for (radius, length, is_small) in
            [(0.7, 6.0, true), (1.0, 10.0, true), (1.75, 14.0, true), (1.55, 19.5, true), (0.88, 24.0, false)]
        {
            let part = tube(32, 120, length, |_| radius);
            let raw = RawSurface::new("tube", part.positions, part.triangles);
            let report = import(raw, Unit::Millimetre, Axes::Unknown).unwrap().report;
            let told = in_english(&report.warnings).concat();
            assert!(told.contains("in cm (") && told.contains("a piece of small vessels, or") == is_small, "{told}");
            assert_eq!(report.unit_by_size(), (!is_small).then_some(Unit::Centimetre), "{radius} {length}");
        }
    }

    #[test]
    fn a_tree_of_the_heart_or_the_brain_keeps_its_unit() {
        // Arteries of 2.4 and 1.6 mm, a tree of 100 mm and one of 60; an aorta of 12 mm in cm is no longer than 45.
        for (radius, length, is_told) in [(1.2, 100.0, false), (0.8, 60.0, false), (0.6, 45.0, true)] {
            let part = tube(32, 120, length, |_| radius);
            let raw = RawSurface::new("tube", part.positions, part.triangles);
            let report = import(raw, Unit::Millimetre, Axes::Unknown).unwrap().report;
            assert_eq!(report.unusual_size().is_some(), is_told, "{radius} {length}");
        }
    }

    #[test]
    fn two_places_stay_two_where_the_change_of_unit_rounds_them_to_one() {
        let near = (0..10_000).map(|i| 1.7 + i as f32 * f32::EPSILON).find(|x| x * 10.0 == x.next_up() * 10.0);
        let [one, other] = [near.unwrap(), near.unwrap().next_up()].map(|x| Vec3::new(x, 0.0, 0.0));
        let positions = vec![one, Vec3::Y, Vec3::Z, other, Vec3::NEG_Y, Vec3::NEG_Z];
        let raw = RawSurface::new("soup", positions, vec![[0, 1, 2], [3, 4, 5]]);
        let Imported { mesh, report, .. } = import(raw, Unit::Centimetre, Axes::Unknown).unwrap();
        assert_eq!((report.vertices, report.components, mesh.positions[0]), (6, 2, mesh.positions[3]));
    }

    #[test]
    fn numbers_that_are_no_places_are_refused() {
        for bad in [f32::NAN, f32::INFINITY, -1e30] {
            let mut raw = soup(40.0);
            raw.positions[4].y = bad;
            let error = import(raw, Unit::Millimetre, Axes::Unknown).unwrap_err();
            assert!(matches!(error, ReadError::Coordinate { vertex: 5, .. }), "{error}");
        }
    }

    #[test]
    fn nothing_to_show_is_said_so() {
        let points = RawSurface::new("soup", vec![Vec3::X; 3], Vec::new());
        assert_eq!(
            import(points, Unit::Metre, Axes::Unknown),
            Err(ReadError::NoTriangles { format: "soup", vertices: 3 })
        );
        let flat = RawSurface::new("soup", vec![Vec3::X; 3], vec![[0, 1, 2]]);
        assert_eq!(
            import(flat, Unit::Metre, Axes::Unknown),
            Err(ReadError::AllDegenerate { format: "soup", triangles: 1 })
        );
    }
}
