//! Where the wall of the vessel around a seed is: half way between the values in the vessel and around it.
//!
//! An edge that a scanner blurs evenly lies where the value is half way between both sides. From the seed go 98 rays. On each
//! the first place is looked for around which the mean of two voxels is below the threshold, and the values two to four voxels beyond it are those of the background;
//! the values from the seed to two voxels before it are those of the vessel. The next threshold is half way between the medians
//! of both over the rays (Ridler and Calvard 1978, on the rays instead of the whole histogram), until it stays. The first is as
//! near to the vessel's value as noise allows, so that the first edge is found and not that of the lung behind it. Rays along the
//! vessel or into bone are few, and a median does not mind them.
//!
//! In vessels of less than two voxels' radius neither the vessel's own value nor the background's is in the scan.

use glam::{DMat3, DVec3};

use super::grid::Grid;

/// How far a ray goes, in mm.
const REACH_MM: f64 = 60.0;
/// Samples of a ray in a voxel.
const STEPS: usize = 4;
/// Samples that the blur of an edge reaches to either side.
const BLUR: usize = 2 * STEPS;
/// The most rounds.
const ROUNDS: usize = 30;

/// A threshold, and the values that it lies half way between.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct HalfWay {
    /// Half way.
    pub threshold: f64,
    /// In the vessel.
    pub vessel: f64,
    /// Around it.
    pub background: f64,
}

/// The threshold for the vessel around `seed`, a voxel of the grid from 0; `None` where nothing there is brighter than what is
/// around it.
pub fn half_way(grid: &Grid, seed: [usize; 3]) -> Option<HalfWay> {
    let rays = rays(grid, seed);
    let near: Vec<f64> = rays.iter().flat_map(|ray| ray.iter().take(STEPS + 1).copied()).collect();
    let bright = median(near.clone())?;
    let noise = median(near.iter().map(|value| (value - bright).abs()).collect())?;
    let mut around: Vec<f64> = rays.iter().flatten().copied().collect();
    around.sort_unstable_by(f64::total_cmp);
    let dark = around[around.len() / 5];
    let mut found =
        HalfWay { threshold: bright - (6.0 * noise).max(0.1 * (bright - dark)), vessel: bright, background: dark };
    for _ in 0..ROUNDS {
        let (mut inside, mut outside) = (Vec::new(), Vec::new());
        for ray in &rays {
            // One voxel of noise is no edge.
            let is_below = |two: &[f64]| two.iter().sum::<f64>() < found.threshold * BLUR as f64;
            let Some(edge) = ray.windows(BLUR).position(is_below).map(|first| first + BLUR / 2) else { continue };
            inside.extend(mean(&ray[..edge.saturating_sub(BLUR).max(1)]));
            outside.extend(ray.get(edge + BLUR..edge + 2 * BLUR).and_then(mean));
        }
        // Most rays leave the vessel.
        if 2 * outside.len() < rays.len() {
            return None;
        }
        let (vessel, background) = (median(inside)?, median(outside)?);
        let last = found.threshold;
        found = HalfWay { threshold: (vessel + background) / 2.0, vessel, background };
        if (found.threshold - last).abs() < 1e-3 * (vessel - background).abs() {
            break;
        }
    }
    (found.vessel - found.background > 4.0 * noise).then_some(found)
}

/// The values along rays from a voxel, to the face of the grid or as far as a ray goes.
fn rays(grid: &Grid, seed: [usize; 3]) -> Vec<Vec<f64>> {
    let steps = grid.geometry().steps();
    let from = DVec3::from_array(seed.map(|along| along as f64));
    directions()
        .map(|direction| {
            let (step, length_mm) = voxel_along(steps, direction);
            let samples = (REACH_MM / length_mm) as usize * STEPS;
            (0..samples).map_while(|n| grid.between(from + step * (n as f64 / STEPS as f64))).collect()
        })
        .collect()
}

/// In voxels, and its length in mm: the way in a direction to where one of the indices is another by one.
fn voxel_along(steps: DMat3, direction: DVec3) -> (DVec3, f64) {
    let along = steps.inverse() * direction.normalize();
    let length_mm = 1.0 / along.abs().max_element();
    (along * length_mm, length_mm)
}

/// 98 directions: to the points of a cube's faces, five along each edge.
fn directions() -> impl Iterator<Item = DVec3> {
    let all = (-2..=2).flat_map(|x| (-2..=2).flat_map(move |y| (-2..=2).map(move |z| [x, y, z])));
    all.filter(|at: &[i32; 3]| at.iter().any(|along| along.abs() == 2)).map(|at| DVec3::from_array(at.map(f64::from)))
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
#[path = "half_way/tests.rs"]
mod tests;
