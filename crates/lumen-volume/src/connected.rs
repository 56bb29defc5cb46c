//! What of a selection is connected to a seed: bone that reaches the threshold and touches the vessel nowhere stays out.
//!
//! Voxels are connected through their faces, as the surface of marching cubes connects them. Rows are filled run by run
//! (Smith 1979, *Tint fill*). A bit for each voxel is kept.

use super::error::VolumeError;
use super::geometry::Geometry;
use super::selection::Selected;
use lumen_mesh::task::Yielder;

/// Runs between two looks at the clock.
const BLOCK: usize = 1 << 12;

/// A set of voxels.
pub(super) struct Bits(Vec<u64>);

impl Bits {
    pub(super) fn has(&self, n: usize) -> bool {
        self.0[n / 64] >> (n % 64) & 1 == 1
    }

    fn add(&mut self, n: usize) {
        self.0[n / 64] |= 1 << (n % 64);
    }
}

impl Geometry {
    /// The voxel next to a place in mm; `None` where that is beyond the outermost by more than half a voxel.
    pub fn voxel_at(&self, place: glam::DVec3) -> Option<[usize; 3]> {
        let along = (self.steps().inverse() * (place - self.origin)).to_array().map(libm::round);
        let is_in = (0..3).all(|axis| (0.0..self.size[axis] as f64).contains(&along[axis]));
        is_in.then(|| along.map(|along| along as usize))
    }
}

/// The voxels of a selection that are connected to `seed`, a voxel of its region, from 0. Rests now and then.
///
/// # Errors
/// [`VolumeError::SeedOutside`] where the seed is not of the selection.
pub(super) async fn connected(selected: &Selected, seed: [usize; 3], yielder: &Yielder) -> Result<Bits, VolumeError> {
    let [nx, ny, nz] = selected.size();
    if !selected.is_inside(seed) {
        return Err(VolumeError::SeedOutside { value: selected.value(seed) });
    }
    let mut bits = Bits(vec![0; (nx * ny * nz).div_ceil(64)]);
    let mut waiting = vec![seed];
    let mut runs = 0;
    while let Some([i, j, k]) = waiting.pop() {
        let row = (k * ny + j) * nx;
        if bits.has(row + i) {
            continue;
        }
        let start = (0..i).rev().take_while(|&i| selected.is_inside([i, j, k])).last().unwrap_or(i);
        let end = (i + 1..nx).find(|&i| !selected.is_inside([i, j, k])).unwrap_or(nx);
        (start..end).for_each(|i| bits.add(row + i));
        let beside = [(j.wrapping_sub(1), k), (j + 1, k), (j, k.wrapping_sub(1)), (j, k + 1)];
        for (j, k) in beside.into_iter().filter(|&(j, k)| j < ny && k < nz) {
            let mut is_open = false;
            for i in start..end {
                let is_new = !bits.has((k * ny + j) * nx + i) && selected.is_inside([i, j, k]);
                if is_new && !is_open {
                    waiting.push([i, j, k]);
                }
                is_open = is_new;
            }
        }
        runs += 1;
        if runs % BLOCK == 0 {
            yielder.rest(0.0).await;
        }
    }
    Ok(bits)
}
