//! By how much the surface of a scan would move with another threshold.

use glam::DVec3;

use super::grid::Grid;
use super::selection::Selection;
use lumen_mesh::TriMesh;

/// The most vertices that are asked.
const MOST: usize = 20_000;
/// Steps of a voxel along the gradient, and how many voxels far.
const STEPS: usize = 8;
const FAR: usize = 4;

/// By how many mm the surface of a scan moves outwards at a threshold 10 % lower, and at one 10 % higher; `None` of a mask.
pub fn shifts_mm(grid: &Grid, mesh: &TriMesh, selection: Selection) -> Option<[f64; 2]> {
    let Selection::Threshold(threshold) = selection else { return None };
    let tenth = 0.1 * threshold.abs();
    let shift = |other| shift_mm(grid, mesh, threshold, other);
    shift(threshold - tenth).zip(shift(threshold + tenth)).map(|(lower, higher)| [lower, higher])
}

/// By how many mm the surface at `threshold` moves outwards on average where the threshold is `other`, inwards where negative:
/// from vertices along the gradient to where the values reach it, four voxels at most. `None` without vertices in the grid.
/// `mesh` is in the grid's own coordinates.
pub fn shift_mm(grid: &Grid, mesh: &TriMesh, threshold: f64, other: f64) -> Option<f64> {
    let geometry = grid.geometry();
    let (steps, inverse) = (geometry.steps(), geometry.steps().inverse());
    let (mut sum, mut count) = (0.0, 0);
    for position in mesh.positions.iter().step_by(mesh.positions.len().div_ceil(MOST).max(1)) {
        let at = inverse * (position.as_dvec3() - geometry.origin);
        let Some(outwards) = gradient(grid, at).map(|gradient| -(inverse.transpose() * gradient)) else { continue };
        let along = inverse * outwards.normalize_or_zero();
        let voxel = 1.0 / along.abs().max_element();
        if !voxel.is_finite() {
            continue;
        }
        let sign = if other < threshold { 1.0 } else { -1.0 };
        let step = along * voxel * sign / STEPS as f64;
        let is_passed = |value: f64| (value - other) * sign <= 0.0;
        let mut before = threshold;
        let mut way = (FAR * STEPS) as f64;
        for n in 1..=FAR * STEPS {
            let Some(value) = grid.between(at + step * n as f64) else {
                way = n as f64;
                break;
            };
            if is_passed(value) {
                way = n as f64 - 1.0 + ((before - other) / (before - value)).clamp(0.0, 1.0);
                break;
            }
            before = value;
        }
        sum += sign * way * (steps * (along * voxel)).length() / STEPS as f64;
        count += 1;
    }
    (count > 0).then(|| sum / f64::from(count))
}

/// Differences of values along i, j, k around a place in voxels.
fn gradient(grid: &Grid, at: DVec3) -> Option<DVec3> {
    let last = DVec3::from_array(grid.geometry().size.map(|along| along as f64 - 1.0));
    let along = |axis: DVec3| {
        let (high, low) = ((at + axis * 0.5).min(last), (at - axis * 0.5).max(DVec3::ZERO));
        Some((grid.between(high)? - grid.between(low)?) / (high - low).dot(axis))
    };
    Some(DVec3::new(along(DVec3::X)?, along(DVec3::Y)?, along(DVec3::Z)?)).filter(|gradient| gradient.is_finite())
}
