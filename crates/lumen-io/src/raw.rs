//! What a format's file hands over to the import: the triangles as they stand there, with the arrays on them.

use glam::DVec3;

use super::Axes;
use super::columns::left_out;
use super::error::ReadError;
use super::memory_budget::MemoryBudget;
use super::polygons::Faces;
use super::report::Skipped;
use super::warnings::{ArrayProblem, Warning};
use lumen_mesh::arrays::Association;
use lumen_mesh::{Array, Vec3};

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
    /// Bytes of what was packed beyond the file's own, as far as they count for its memory.
    pub(super) unpacked: usize,
    pub(super) polygons: usize,
    pub(super) skipped: Skipped,
    pub(super) warnings: Vec<Warning>,
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
            unpacked: 0,
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
            raw.warnings.push(Warning::Fanned { count: cut.fanned });
        }
        raw
    }

    /// Takes arrays along as far as there is room for them, those of the file's cells to the triangles cut from these, and
    /// says what is left out.
    pub(super) fn carry(&mut self, (arrays, left_out): (Vec<Array>, Vec<Warning>), room: MemoryBudget) {
        self.warnings.extend(left_out);
        let mut bytes = 0;
        for array in arrays {
            let (rows, fits) = match array.on {
                Association::Point => (self.positions.len(), array.len() == self.positions.len()),
                Association::Triangle => {
                    (self.cells.len(), self.cells.iter().all(|&cell| (cell as usize) < array.len()))
                }
            };
            let of_row = array.components as u64 * array.values.scalar().size() as u64;
            let larger = bytes + of_row.saturating_mul(rows.max(array.len()) as u64);
            if !fits {
                self.warnings.push(self::left_out(&array.name, ArrayProblem::OtherLength));
            } else if !room.holds_arrays(self.positions.len(), self.triangles.len(), larger) {
                self.warnings.push(self::left_out(&array.name, ArrayProblem::Memory));
            } else {
                bytes = larger;
                self.arrays.push(if array.on == Association::Point { array } else { array.gathered(&self.cells) });
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
