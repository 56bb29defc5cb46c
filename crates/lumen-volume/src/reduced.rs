//! A volume at reduced resolution, for a preview that follows a slider.

use super::grid::Grid;
use super::samples::{Sample, Samples, with_samples};
use lumen_mesh::task::Yielder;

/// The most points of a volume that a preview is made of: a surface of these takes some tens of milliseconds.
pub const PREVIEW_POINTS: usize = 4_000_000;

/// The smallest step that leaves no more than [`PREVIEW_POINTS`].
pub fn preview_step(points: usize) -> usize {
    (1..).find(|step: &usize| points / step.pow(3) <= PREVIEW_POINTS).unwrap_or(1)
}

/// A volume of one point for each block of `step` points along each axis (0 is taken for 1): the largest value of the block, so
/// that contrast in a vessel thinner than a block is still seen, if wider than it is. Of a mask the first label of the block
/// that is not 0, for a largest label means nothing. Rests after each slice.
pub async fn reduced_in_slices(grid: &Grid, step: usize, is_mask: bool, yielder: &Yielder) -> Grid {
    let step = step.max(1);
    let slices = grid.geometry().size[2].div_ceil(step);
    let mut samples = Samples::new(grid.samples().sample_type());
    for slice in 0..slices {
        reduce_slice(grid, step, is_mask, slice, &mut samples);
        yielder.rest((slice + 1) as f32 / slices as f32).await;
    }
    grid.coarser(step, samples)
}

/// Adds a slice of the reduced volume.
fn reduce_slice(grid: &Grid, step: usize, is_mask: bool, slice: usize, samples: &mut Samples) {
    let [nx, ny, nz] = grid.geometry().size;
    let [low, high] = grid.stored_for_label(0.0);
    let planes = slice * step..nz.min((slice + 1) * step);
    with_samples!(grid.samples(), values => {
        for j in (0..ny).step_by(step) {
            for i in (0..nx).step_by(step) {
                let first = values[grid.index([i, j, planes.start])];
                let rows = planes.clone().flat_map(|k| (j..ny.min(j + step)).map(move |j| [i, j, k]));
                let mut block = rows.flat_map(|point| {
                    let start = grid.index(point);
                    values[start..start + step.min(nx - i)].iter().copied()
                });
                let chosen = if is_mask {
                    block.find(|value| !(low..=high).contains(&value.to_f64())).unwrap_or(first)
                } else {
                    let is_larger = |a, b| if grid.is_inverted() { a < b } else { a > b };
                    block.fold(first, |a, b| if is_larger(b, a) || a.to_f64().is_nan() { b } else { a })
                };
                samples.push(chosen.to_f64());
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::geometry::Geometry;
    use super::*;
    use lumen_mesh::task::at_once;

    /// 5 x 4 x 3 points numbered from 0.
    fn numbered() -> Grid {
        let geometry = Geometry::upright([5, 4, 3], DVec3::ONE, DVec3::ZERO);
        Grid::new(geometry, Samples::I16((0..60).collect()), 1.0, 0.0).unwrap()
    }

    fn reduced(step: usize, is_mask: bool) -> Grid {
        at_once(reduced_in_slices(&numbered(), step, is_mask, &Yielder::never()))
    }

    #[test]
    fn blocks_keep_their_largest_value_and_masks_their_first_label() {
        let scan = reduced(2, false);
        assert_eq!(scan.geometry().size, [3, 2, 2]);
        assert_eq!(scan.geometry().spacing, DVec3::splat(2.0));
        assert_eq!(scan.samples(), &Samples::I16(vec![26, 28, 29, 36, 38, 39, 46, 48, 49, 56, 58, 59]));
        let mask = reduced(2, true);
        assert_eq!(mask.samples(), &Samples::I16(vec![1, 2, 4, 10, 12, 14, 40, 42, 44, 50, 52, 54]));
        assert_eq!(reduced(1, false), numbered());
    }

    #[test]
    fn the_step_brings_a_volume_down_to_what_a_preview_takes() {
        assert_eq!([1, PREVIEW_POINTS, PREVIEW_POINTS + 8, 512 * 512 * 800].map(preview_step), [1, 1, 2, 4]);
    }
}
