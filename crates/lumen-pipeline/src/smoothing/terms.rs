//! The terms `x_n = T_n(M) x` of a run that is done. With them, another pass band or window costs a sum, not a run.

use glam::Vec3;

use super::gains::{Gain, Gains, Mix, Mixed, Term};
use super::placement::Placement;
use crate::filter::Filter;
use crate::settings::Smoothing;
use lumen_mesh::parallel;

/// Vertices that are summed up at a time: they stay in the cache while term after term goes by.
const TILE: usize = 2048;

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
        self.with_gains(&Gains::of(filter), &[], filter.dc_gain())
    }

    /// The smoothed positions with a pass band of its own at each vertex, as [`super::smooth_varying`] has it.
    ///
    /// # Panics
    /// When the settings ask for more terms than there are.
    pub fn smooth_varying(&self, settings: &Smoothing, pass_bands: &[f32]) -> Vec<Vec3> {
        let (gains, by_vertex) = Gains::varying(settings, pass_bands);
        let mut mixes = vec![Mix::default(); by_vertex.len()];
        self.placement.places.iter().zip(by_vertex).for_each(|(&place, mix)| mixes[place as usize] = mix);
        self.with_gains(&gains, &mixes, 1.0)
    }

    /// `mixes` stand in the order of the blocks.
    fn with_gains(&self, gains: &Gains, mixes: &[Mix], gain: f64) -> Vec<Vec3> {
        let mut first = 0;
        let sums = self.blocks.iter().map(|block| {
            let count = block.len() / (self.degree + 1) / 3;
            let own = mixes.get(first..first + count).unwrap_or_default();
            first += count;
            self.sum(block, gains, own)
        });
        self.placement.place(&sums.collect::<Vec<_>>(), gain)
    }

    fn sum(&self, block: &[f32], gains: &Gains, mixes: &[Mix]) -> Vec<Vec3> {
        let length = block.len() / (self.degree + 1);
        let mut sum = vec![Vec3::ZERO; length / 3];
        parallel::for_each_chunk_mut(&mut sum, TILE, |first, tile| {
            for n in 0..=gains.degree() {
                let term = &block[n * length + 3 * first..][..3 * tile.len()];
                match gains.term(n) {
                    Term::Same(c) => add(tile, term, n == 0, c),
                    Term::Row(row) => add(tile, term, n == 0, Mixed { row, mixes: &mixes[first..] }),
                }
            }
        });
        sum
    }
}

/// Adds a term to the sum, or begins it.
#[inline]
fn add(sum: &mut [Vec3], term: &[f32], begins: bool, gain: impl Gain) {
    for (i, (sum, x)) in sum.iter_mut().zip(term.as_chunks::<3>().0).enumerate() {
        let x = Vec3::from_array(*x) * gain.at(i);
        *sum = if begins { x } else { *sum + x };
    }
}
