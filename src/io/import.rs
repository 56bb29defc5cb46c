//! The import stage: what every surface goes through, whichever format it came in.
//!
//! In this order: coordinates are checked, coincident vertices welded, triangles that repeat a vertex dropped, unused
//! vertices left out, numbers turned into mm, windings made to agree, inward components turned. Welding comes before
//! the change of unit, because rounding to f32 after a multiplication can make two places one.

use glam::DVec3;

use super::columns::left_out;
use super::error::ReadError;
use super::polygons::Faces;
use super::report::{ImportReport, Imported, Skipped};
use super::room::Room;
use super::size::length;
use super::weld::welded;
use super::{Axes, Unit, winding};
use crate::mesh::arrays::{On, infos};
use crate::mesh::{Array, Topology, TriMesh, Vec3, components, measures};

/// What is said of a surface whose windings cannot be made to agree.
pub const NO_INSIDE: &str = "The surface has no inside and outside (its triangles cannot be made to agree).";

/// Farther out than this, in mm, nothing is a place in a body, and squares near the end of f32's range.
pub(super) const FARTHEST_MM: f64 = 1e9;

/// What a format's file hands over: the triangles as they stand there.
pub(super) struct RawSurface {
    /// What the file is, in full: "STL binary".
    pub(super) label: &'static str,
    /// Positions, in the file's unit unless `in_mm`.
    pub(super) positions: Vec<Vec3>,
    /// Vertices of each triangle; all in range.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Whether the file may have more digits than f32.
    pub(super) has_doubles: bool,
    /// What the positions are relative to, where the file has more digits than f32 (`far`).
    pub(super) origin: DVec3,
    /// What the file says about its axes.
    pub(super) axes: Axes,
    /// Whether the positions are in mm already, as those of a glTF scene, whose transforms take the unit with them.
    pub(super) in_mm: bool,
    pub(super) polygons: usize,
    pub(super) skipped: Skipped,
    pub(super) warnings: Vec<String>,
    /// The cell of the file that each triangle is of, where its format has such.
    pub(super) cells: Vec<u32>,
    /// A tuple for each position or each triangle.
    pub(super) arrays: Vec<Array>,
}

impl RawSurface {
    /// A surface of triangles alone.
    pub(super) fn new(label: &'static str, positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        let (skipped, warnings) = (Skipped::default(), Vec::new());
        let origin = DVec3::ZERO;
        let (has_doubles, in_mm, axes) = (false, false, Axes::Unknown);
        let (cells, arrays) = (Vec::new(), Vec::new());
        Self {
            label,
            positions,
            triangles,
            has_doubles,
            origin,
            axes,
            in_mm,
            polygons: 0,
            skipped,
            warnings,
            cells,
            arrays,
        }
    }

    /// A surface of polygons, whose corners must be in range.
    pub(super) fn of_faces(label: &'static str, positions: Vec<Vec3>, faces: &Faces) -> Self {
        let cut = faces.triangulate(&positions);
        let mut raw = Self::new(label, positions, cut.triangles);
        raw.polygons = cut.polygons;
        raw.cells = faces.cells();
        raw.skipped.short_faces = faces.short;
        if cut.fanned > 0 {
            raw.warnings.push(format!(
                "{} could not be cut into triangles without folding, having no area or crossing itself.",
                count(cut.fanned, "polygon", "polygons")
            ));
        }
        raw
    }

    /// Takes arrays along as far as there is room for them, those of the file's cells to the triangles cut from these, and
    /// says what is left out.
    pub(super) fn carry(&mut self, (arrays, left_out): (Vec<Array>, Vec<String>), room: Room) {
        self.warnings.extend(left_out);
        let mut bytes = 0;
        for array in arrays {
            let (rows, fits) = match array.on {
                On::Point => (self.positions.len(), array.len() == self.positions.len()),
                On::Triangle => (self.cells.len(), self.cells.iter().all(|&cell| (cell as usize) < array.len())),
            };
            let of_row = array.components as u64 * array.values.scalar().size() as u64;
            let larger = bytes + of_row.saturating_mul(rows.max(array.len()) as u64);
            if !fits {
                self.warnings.push(self::left_out(&array.name, "it has another length than the surface"));
            } else if !room.holds_arrays(self.positions.len(), self.triangles.len(), larger) {
                let why = "it would take more memory than a file of this size is given";
                self.warnings.push(self::left_out(&array.name, why));
            } else {
                bytes = larger;
                self.arrays.push(if array.on == On::Point { array } else { array.gathered(&self.cells) });
            }
        }
    }
}

/// Refuses more vertices or triangle corners than 32 bits can number.
pub(super) fn check_size(vertices: usize, triangles: usize) -> Result<(), ReadError> {
    let limit = u64::from(u32::MAX);
    let corners = (vertices as u64).max(3 * triangles as u64);
    if corners > limit { Err(ReadError::TooLarge { corners, limit }) } else { Ok(()) }
}

/// Takes a surface from a file through the stage.
pub(super) fn import(raw: RawSurface, unit: Unit, axes: Axes) -> Result<Imported, ReadError> {
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
    let imported = assemble(raw, unit, axes);
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
    let mut imported = assemble(RawSurface::new("", mesh.positions, mesh.triangles), Unit::Millimetre, Axes::Lps);
    imported.report.format = format_label.to_owned();
    imported
}

/// The stage itself.
fn assemble(raw: RawSurface, unit: Unit, axes: Axes) -> Imported {
    let triangles = raw.triangles.len();
    let scale = if raw.in_mm { 1.0 } else { unit.to_mm() };
    let (mut mesh, arrays) = welded(raw.positions, raw.triangles, &raw.arrays);
    drop(raw.arrays);
    let degenerate_triangles = triangles - mesh.triangles.len();
    if scale != 1.0 {
        for p in &mut mesh.positions {
            *p = (p.as_dvec3() * scale).as_vec3();
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
    let components_turned = winding::turn_outward(&mut mesh, &topology, &pieces, &orientable);
    if components_turned > 0 {
        topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    }

    let measured = measures(&mesh, &topology);
    let largest = pieces.largest().map_or(0, |piece| pieces.triangle_counts[piece as usize] as usize);
    let mut report = ImportReport {
        format: raw.label.to_owned(),
        unit,
        scale_to_mm: unit.to_mm(),
        axes,
        triangles,
        vertices: mesh.positions.len(),
        polygons_triangulated: raw.polygons,
        degenerate_triangles,
        duplicate_triangles,
        components: pieces.count(),
        largest_component_triangles: largest,
        boundary_edges: edges.boundary,
        non_manifold_edges: edges.non_manifold,
        winding_flips: edges.flipped,
        reoriented_triangles,
        components_turned,
        orientable: orientable.iter().all(|&orientable| orientable),
        area_mm2: measured.area_mm2,
        volume_mm3: measured.volume_mm3,
        bounds_mm: mesh.bounds(),
        moved_mm: ((DVec3::ZERO - raw.origin) * scale).to_array(),
        skipped: raw.skipped,
        arrays: infos(&arrays),
        warnings: raw.warnings,
    };
    warn(&mut report);
    Imported { mesh, arrays, report }
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

/// Puts into sentences what a user should hear about.
fn warn(report: &mut ImportReport) {
    let mut sentences = Vec::new();
    sentences.extend(report.unusual_size().map(|found| found.sentence));
    if report.moved_mm != [0.0; 3] {
        let [x, y, z] = report.moved_mm.map(length);
        sentences.push(format!(
            "The surface lies far from the origin of its coordinates: it was moved by ({x}, {y}, {z}) mm to keep its detail, and is saved there."
        ));
    }
    let skipped = report.skipped;
    let mut tell = |n: usize, one: &str, many: &str, rest: &str| {
        if n > 0 {
            sentences.push(format!("{} {rest}", count(n, one, many)));
        }
    };
    tell(report.degenerate_triangles, "triangle", "triangles", "with a repeated vertex dropped.");
    tell(report.duplicate_triangles, "triangle", "triangles", "present twice; kept.");
    tell(skipped.short_faces, "face", "faces", "of fewer than three corners left out.");
    tell(skipped.lines, "line", "lines", "left out: Lumen shows surfaces.");
    tell(skipped.points, "point", "points", "left out: Lumen shows surfaces.");
    tell(report.reoriented_triangles, "triangle", "triangles", "turned over to agree with the neighbours.");
    tell(report.components_turned, "piece", "pieces", "found inside out and turned.");
    tell(report.non_manifold_edges, "edge", "edges", "where more than two triangles meet; left as in the file.");
    if !report.orientable {
        sentences.push(NO_INSIDE.to_owned());
    }
    report.warnings.append(&mut sentences);
}

pub(super) fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::tube;

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
            report.warnings,
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
        let warnings = |size, unit| import(soup(size), unit, Axes::Unknown).unwrap().report.warnings;
        assert_eq!(
            warnings(0.2, Unit::Millimetre)[0],
            "The surface is 0.346 mm across, which is unusual for vessels: its numbers may be in m (346 mm)."
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
            import(RawSurface::new("tube", aorta.positions, aorta.triangles), unit, Axes::Unknown)
                .unwrap()
                .report
                .warnings
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
        for sample in crate::phantom::Sample::ALL {
            let made = crate::phantom::generate(sample, 20_000).unwrap();
            assert!(import_mesh(made, "sample").report.warnings.iter().all(|text| !text.contains("unusual")));
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
