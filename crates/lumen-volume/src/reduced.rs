//! A volume at reduced resolution, for a preview that follows a slider.

use std::sync::Arc;

use super::grid::Grid;
use super::samples::{Sample, Samples, with_samples};
use lumen_mesh::task::{Budget, Progress, Task};

/// The most points of a volume that a preview is made of: a surface of these takes some tens of milliseconds.
pub const PREVIEW_POINTS: usize = 4_000_000;

/// The smallest step that leaves no more than [`PREVIEW_POINTS`].
pub fn preview_step(points: usize) -> usize {
    (1..).find(|step: &usize| points / step.pow(3) <= PREVIEW_POINTS).unwrap_or(1)
}

/// Makes a volume of one point for each block of `step` points along each axis: the largest value of the block, so that
/// contrast in a vessel thinner than a block is still seen, if wider than it is. Of a mask the first label of the block that
/// is not 0, for a largest label means nothing.
pub struct Reducing {
    grid: Arc<Grid>,
    step: usize,
    is_mask: bool,
    /// Slices that are done.
    done: usize,
    samples: Samples,
}

impl Reducing {
    /// Before the first slice; a step of 0 is taken for 1.
    pub fn new(grid: Arc<Grid>, step: usize, is_mask: bool) -> Self {
        let samples = Samples::new(grid.samples().sample_type());
        Self { grid, step: step.max(1), is_mask, done: 0, samples }
    }

    fn slice(&mut self) {
        let [nx, ny, nz] = self.grid.geometry().size;
        let (step, grid) = (self.step, &self.grid);
        let outside = grid.stored_for(0.0);
        let planes = self.done * step..nz.min((self.done + 1) * step);
        with_samples!(grid.samples(), values => {
            for j in (0..ny).step_by(step) {
                for i in (0..nx).step_by(step) {
                    let first = values[grid.index([i, j, planes.start])];
                    let rows = planes.clone().flat_map(|k| (j..ny.min(j + step)).map(move |j| [i, j, k]));
                    let mut block = rows.flat_map(|point| {
                        let start = grid.index(point);
                        values[start..start + step.min(nx - i)].iter().copied()
                    });
                    let chosen = if self.is_mask {
                        block.find(|value| value.to_f64() != outside).unwrap_or(first)
                    } else {
                        let is_larger = |a, b| if grid.is_inverted() { a < b } else { a > b };
                        block.fold(first, |a, b| if is_larger(b, a) || a.to_f64().is_nan() { b } else { a })
                    };
                    self.samples.push(chosen.to_f64());
                }
            }
        });
        self.done += 1;
    }
}

impl Task for Reducing {
    type Output = Arc<Grid>;

    fn advance(&mut self, budget: Budget) -> Progress<Arc<Grid>> {
        let slices = self.grid.geometry().size[2].div_ceil(self.step);
        loop {
            self.slice();
            if self.done == slices {
                break;
            }
            if budget.is_spent() {
                return Progress::Working(self.done as f32 / slices as f32);
            }
        }
        let samples = std::mem::replace(&mut self.samples, Samples::U8(Vec::new()));
        Progress::Done(Arc::new(self.grid.coarser(self.step, samples)))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::geometry::Geometry;
    use super::*;

    /// 5 x 4 x 3 points numbered from 0.
    fn numbered() -> Arc<Grid> {
        let geometry = Geometry::upright([5, 4, 3], DVec3::ONE, DVec3::ZERO);
        Arc::new(Grid::new(geometry, Samples::I16((0..60).collect()), 1.0, 0.0).unwrap())
    }

    #[test]
    fn blocks_keep_their_largest_value_and_masks_their_first_label() {
        let scan = Reducing::new(numbered(), 2, false).finish();
        assert_eq!(scan.geometry().size, [3, 2, 2]);
        assert_eq!(scan.geometry().spacing, DVec3::splat(2.0));
        assert_eq!(scan.samples(), &Samples::I16(vec![26, 28, 29, 36, 38, 39, 46, 48, 49, 56, 58, 59]));
        let mask = Reducing::new(numbered(), 2, true).finish();
        assert_eq!(mask.samples(), &Samples::I16(vec![1, 2, 4, 10, 12, 14, 40, 42, 44, 50, 52, 54]));
        assert_eq!(Reducing::new(numbered(), 1, false).finish(), numbered());
    }

    #[test]
    fn the_step_brings_a_volume_down_to_what_a_preview_takes() {
        assert_eq!([1, PREVIEW_POINTS, PREVIEW_POINTS + 8, 512 * 512 * 800].map(preview_step), [1, 1, 2, 4]);
    }
}
