//! The terms `x_n = T_n(M) x` of a run that is done. With them, another pass band or window costs a sum, not a run.

use glam::Vec3;

use super::Placement;
use crate::parallel;
use crate::pipeline::filter::Filter;

/// Numbers that are summed up at a time: they stay in the cache while term after term goes by.
const TILE: usize = 3 * 2048;

/// The terms of a surface at one setting of the boundary.
pub struct Terms {
    /// For each strip of the order: `x_0`, `x_1` and so on of its vertices, one after another.
    blocks: Vec<Vec<f32>>,
    degree: usize,
    placement: Placement,
}

impl Terms {
    pub(super) fn new(blocks: Vec<Vec<f32>>, degree: usize, placement: Placement) -> Self {
        Self { blocks, degree, placement }
    }

    /// Bytes that the terms of a run take.
    pub fn bytes(vertices: usize, degree: usize) -> u64 {
        vertices as u64 * (degree as u64 + 1) * 12
    }

    /// The largest number of iterations that they suffice for.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The smoothed positions by another filter, in mm: to the bit what a run of its own gives.
    ///
    /// # Panics
    /// When the filter has more terms than there are.
    pub fn smooth(&self, filter: &Filter) -> Vec<Vec3> {
        let coefficients: Vec<f32> = filter.coefficients.iter().map(|&c| c as f32).collect();
        let sums = self.blocks.iter().map(|block| self.sum(block, &coefficients));
        self.placement.place(&sums.collect::<Vec<_>>(), filter.dc_gain())
    }

    fn sum(&self, block: &[f32], coefficients: &[f32]) -> Vec<Vec3> {
        let length = block.len() / (self.degree + 1);
        let mut sum = vec![Vec3::ZERO; length / 3];
        let numbers: &mut [f32] = bytemuck::cast_slice_mut(&mut sum);
        parallel::for_each_chunk_mut(numbers, TILE, |first, tile| {
            for (n, &c) in coefficients.iter().enumerate() {
                let term = &block[n * length + first..][..tile.len()];
                if n == 0 {
                    tile.iter_mut().zip(term).for_each(|(sum, x)| *sum = x * c);
                } else {
                    tile.iter_mut().zip(term).for_each(|(sum, x)| *sum += x * c);
                }
            }
        });
        sum
    }
}
