//! The surface of a selection, in the coordinates of the patient.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::error::VolumeError;
use super::geometry::Region;
use super::grid::Grid;
use super::marching_cubes::MarchingCubes;
use super::selection::{Selected, Selection};
use super::surface_nets::{Relaxation, surface_nets_in_slices};
use lumen_mesh::TriMesh;
use lumen_mesh::task::{Yielder, at_once};

/// The most triangles that a surface is made of: with what the import stage takes for each, 1.6 GB.
pub const MAX_TRIANGLES: usize = 12_000_000;

/// The most points of a slice, for each of which the way over the grid takes some 22 bytes.
const MAX_OF_A_SLICE: usize = 1 << 26;

/// The surface of a selection: LPS millimetres, triangles counter-clockwise seen from outside, open where the selection meets
/// the faces of the volume or of the box. A vertex lies where values interpolated along its grid edge reach the threshold, or
/// half way for labels. Only what is within `region`, if there is one, is looked at.
///
/// # Errors
/// As [`region_of`], and [`VolumeError::NoSurface`], [`VolumeError::NothingThere`], [`VolumeError::TooManyTriangles`].
pub fn surface(grid: &Arc<Grid>, selection: Selection, region: Option<Region>) -> Result<TriMesh, VolumeError> {
    at_once(surface_in_slices(grid, Cut { region, ..Cut::new(selection) }, &Yielder::never()))
}

/// The part of a volume within a box; all of it without one.
///
/// # Errors
/// [`VolumeError::OutsideBox`] where the box holds no two points along each axis, [`VolumeError::SliceTooLarge`] where
/// a slice of it has more than 67 million.
pub fn region_of(grid: &Grid, region: Option<Region>) -> Result<Region, VolumeError> {
    let geometry = grid.geometry();
    let region = region.unwrap_or_else(|| Region::all(geometry)).within(geometry);
    let region = region.ok_or(VolumeError::OutsideBox { size: geometry.size })?;
    let [i, j, _] = region.size();
    if i.saturating_mul(j) > MAX_OF_A_SLICE {
        return Err(VolumeError::SliceTooLarge { points: i.saturating_mul(j), limit: MAX_OF_A_SLICE });
    }
    Ok(region)
}

/// What a surface is made of, and how.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cut {
    /// What lies inside.
    pub selection: Selection,
    /// Only here.
    pub region: Option<Region>,
    /// Only what is connected to this voxel of the volume, from 0.
    pub seed: Option<[usize; 3]>,
    /// How.
    pub method: Method,
}

/// How a surface is made of voxels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Where values reach the threshold; half way between voxels of a mask.
    #[default]
    MarchingCubes,
    /// Between the voxels of a mask, relaxed within their cells.
    SurfaceNets,
}

impl Method {
    /// What a selection is made by unless another is asked for: surface nets of a mask. On masks of vessels of known radius they
    /// are nearer to it than marching cubes, smoothed or not (docs/scans.md).
    pub fn of(selection: Selection) -> Self {
        if matches!(selection, Selection::Threshold(_)) { Self::MarchingCubes } else { Self::SurfaceNets }
    }
}

impl Cut {
    /// A selection anywhere, by marching cubes.
    pub fn new(selection: Selection) -> Self {
        Self { selection, region: None, seed: None, method: Method::MarchingCubes }
    }

    /// What marching cubes and surface nets ask, and where.
    pub(super) async fn selected(self, grid: &Arc<Grid>, yielder: &Yielder) -> Result<(Selected, Region), VolumeError> {
        let region = region_of(grid, self.region)?;
        let selected = Selected::new(Arc::clone(grid), self.selection, region);
        let Some(seed) = self.seed else { return Ok((selected, region)) };
        if (0..3).any(|axis| !(region.first[axis]..=region.last[axis]).contains(&seed[axis])) {
            return Err(VolumeError::SeedNowhere);
        }
        let seed = std::array::from_fn(|axis| seed[axis] - region.first[axis]);
        Ok((selected.connected_to(seed, yielder).await?, region))
    }
}

/// As [`surface`], of any cut, resting after each layer of cubes.
///
/// # Errors
/// As [`surface`], and [`VolumeError::SeedNowhere`], [`VolumeError::SeedOutside`].
pub async fn surface_in_slices(grid: &Arc<Grid>, cut: Cut, yielder: &Yielder) -> Result<TriMesh, VolumeError> {
    match cut.method {
        Method::MarchingCubes => limited(grid, cut, MAX_TRIANGLES, yielder).await,
        Method::SurfaceNets => Ok(surface_nets_in_slices(grid, cut, Relaxation::default(), yielder).await?.mesh),
    }
}

async fn limited(grid: &Arc<Grid>, cut: Cut, limit: usize, yielder: &Yielder) -> Result<TriMesh, VolumeError> {
    let (selected, region) = cut.selected(grid, yielder).await?;
    let cubes = MarchingCubes::new(&grid.geometry().cropped(&region), selected);
    let mesh = cubes.surface(limit, yielder).await.ok_or(VolumeError::TooManyTriangles { limit })?;
    if mesh.triangles.is_empty() { Err(none_found(grid, region)) } else { Ok(mesh) }
}

/// That all of a part of a volume lies on one side.
pub(super) fn none_found(grid: &Grid, region: Region) -> VolumeError {
    if region == Region::all(grid.geometry()) { VolumeError::NothingThere } else { VolumeError::NoSurface }
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DQuat, DVec3};

    use super::super::geometry::Geometry;
    use super::super::samples::Samples;
    use super::*;
    use lumen_mesh::{Topology, volume};

    const RADIUS: f64 = 12.0;
    const CENTRE: DVec3 = DVec3::new(-40.0, 25.0, 310.0);

    /// A grid whose axes lie obliquely in the patient, its middle in the centre.
    fn oblique(is_left_handed: bool) -> Geometry {
        let turn = DMat3::from_quat(DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7));
        let hand = if is_left_handed { -1.0 } else { 1.0 };
        let direction = turn * DMat3::from_diagonal(DVec3::new(1.0, 1.0, hand));
        let mut geometry =
            Geometry { size: [61, 52, 43], spacing: DVec3::new(0.5, 0.6, 0.75), origin: DVec3::ZERO, direction };
        geometry.origin = CENTRE - geometry.at(30.2, 25.4, 21.3);
        geometry
    }

    /// What a scan of a ball would be: the value falls with the distance, 300 at the wall.
    fn ball(geometry: Geometry, stored: impl Fn(f64) -> i16) -> Samples {
        let [nx, ny, nz] = geometry.size;
        let mut values = Vec::with_capacity(geometry.points());
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let distance = geometry.at(i as f64, j as f64, k as f64).distance(CENTRE);
                    values.push(stored(300.0 - 100.0 * (distance - RADIUS)));
                }
            }
        }
        Samples::I16(values)
    }

    fn surface(grid: Grid, selection: Selection, region: Option<Region>) -> Result<TriMesh, VolumeError> {
        super::surface(&Arc::new(grid), selection, region)
    }

    /// Closed, wound outwards, at its place.
    fn assert_is_the_ball(mesh: &TriMesh, tolerance: f64) {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let counts = topology.edge_counts();
        assert_eq!((counts.boundary, counts.non_manifold, counts.flipped), (0, 0, 0));
        for p in &mesh.positions {
            let error = p.as_dvec3().distance(CENTRE) - RADIUS;
            assert!(error.abs() < tolerance, "{error} mm at {p}");
        }
        let exact = 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3);
        let ratio = volume(mesh, &topology) / exact;
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn an_oblique_ball_lies_where_it_is_whatever_hand_the_axes_are_of() {
        for is_left_handed in [false, true] {
            let geometry = oblique(is_left_handed);
            assert_eq!(geometry.is_left_handed(), is_left_handed);
            let plain = ball(geometry, |value| value as i16);
            let grid = Grid::new(geometry, plain, 1.0, 0.0).unwrap();
            // A chord of a grid edge is at most 0.75^2 / 8 / 12 mm from the arc, rounding to a unit 0.01 mm.
            assert_is_the_ball(&surface(grid, Selection::Threshold(300.0), None).unwrap(), 0.02);
            // The same values, stored upside down in another unit.
            let stored = ball(geometry, |value| (-2.0 * (value - 100.0)) as i16);
            let grid = Grid::new(geometry, stored, -0.5, 100.0).unwrap();
            assert_is_the_ball(&surface(grid, Selection::Threshold(300.0), None).unwrap(), 0.02);
        }
    }

    #[test]
    fn a_label_is_cut_half_way_between_voxels() {
        let geometry = oblique(true);
        let labels = ball(geometry, |value| if value >= 300.0 { 7 } else { 3 });
        let grid = Grid::new(geometry, labels, 0.0, 0.0).unwrap();
        let half_a_voxel = geometry.spacing.max_element() / 2.0;
        assert_is_the_ball(&surface(grid.clone(), Selection::Label(7), None).unwrap(), half_a_voxel + 0.02);
        // Around it the other label is open at the faces of the volume.
        let around = surface(grid.clone(), Selection::Label(3), None).unwrap();
        assert_eq!(around.triangles.len(), surface(grid, Selection::Label(7), None).unwrap().triangles.len());
    }

    #[test]
    fn whole_numbers_that_are_the_threshold_itself_fall_together_nowhere() {
        let geometry = Geometry::upright([12, 12, 12], DVec3::splat(0.5), DVec3::ZERO);
        // A sheet one voxel thick, a rod, and a voxel alone, all at the threshold and nothing above it.
        let is_inside = |i, j, k| {
            k == 2 && (2..9).contains(&i) && j > 2 && j < 9
                || (i, j) == (6, 6) && (4..9).contains(&k)
                || (i, j, k) == (2, 2, 9)
        };
        let values = (0..12 * 12 * 12).map(|n| if is_inside(n % 12, n / 12 % 12, n / 144) { 180 } else { 0 });
        let grid = Grid::new(geometry, Samples::I16(values.collect()), 1.0, 0.0).unwrap();
        let mesh = surface(grid, Selection::Threshold(180.0), None).unwrap();
        let imported = lumen_io::import_mesh(mesh.clone(), "made");
        let report = imported.report;
        assert_eq!((report.degenerate_triangles, report.duplicate_triangles, report.non_manifold_edges), (0, 0, 0));
        assert_eq!(
            (imported.mesh.triangles.len(), report.boundary_edges, report.components),
            (mesh.triangles.len(), 0, 3)
        );
    }

    #[test]
    fn a_slice_for_which_there_is_no_memory_is_refused_before_it_is_begun() {
        let geometry = Geometry::upright([1 << 20, 128, 2], DVec3::ONE, DVec3::ZERO);
        let grid = Grid::new(geometry, Samples::U8(vec![0; 1 << 28]), 1.0, 0.0).unwrap();
        let refused = surface(grid, Selection::Threshold(1.0), None).unwrap_err().to_string();
        assert_eq!(
            refused,
            "A slice has 134217728 voxels, of which 67108864 can be worked on: set a box around the vessels."
        );
    }

    #[test]
    fn a_box_cuts_the_surface_open_and_leaves_it_where_it_is() {
        let geometry = oblique(false);
        let grid = Grid::new(geometry, ball(geometry, |value| value as i16), 1.0, 0.0).unwrap();
        let region = Region { first: [30, 0, 0], last: [60, 51, 42] };
        let half = surface(grid.clone(), Selection::Threshold(300.0), Some(region)).unwrap();
        let topology = Topology::new(half.positions.len(), &half.triangles);
        assert!(topology.edge_counts().boundary > 50);
        let side = geometry.direction.x_axis;
        let cut = geometry.at(30.0, 0.0, 0.0).dot(side);
        for p in &half.positions {
            let p = p.as_dvec3();
            assert!(p.dot(side) > cut - 1e-4 && (p.distance(CENTRE) - RADIUS).abs() < 0.02);
        }
        let outside = Region { first: [61, 0, 0], last: [70, 9, 9] };
        let refused = surface(grid.clone(), Selection::Threshold(300.0), Some(outside)).unwrap_err();
        assert_eq!(refused.to_string(), "The box holds nothing of the volume, which has 61 x 52 x 43 voxels.");
        let corner = Region { first: [0; 3], last: [2; 3] };
        let all_outside = surface(grid.clone(), Selection::Threshold(300.0), Some(corner));
        assert_eq!(all_outside, Err(VolumeError::NoSurface));
        let all_inside = surface(grid, Selection::Threshold(-32_768.0), None);
        assert_eq!(all_inside, Err(VolumeError::NothingThere));
    }

    #[test]
    fn more_triangles_than_can_be_worked_on_are_refused() {
        let geometry = oblique(false);
        let grid = Arc::new(Grid::new(geometry, ball(geometry, |value| value as i16), 1.0, 0.0).unwrap());
        let found = at_once(limited(&grid, Cut::new(Selection::Threshold(300.0)), 1000, &Yielder::never()));
        assert_eq!(found, Err(VolumeError::TooManyTriangles { limit: 1000 }));
    }
}
