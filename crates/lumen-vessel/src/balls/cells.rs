//! The box of a surface in cells, and the vertices of its wall in them.

use glam::Vec3;

use lumen_mesh::Bounds;

/// Cells of the grid along the longest side of the surface's box.
const CELLS: f32 = 128.0;

/// A dense grid of cells over the surface's box.
pub(super) struct Grid {
    low: Vec3,
    size: f32,
    counts: [i32; 3],
}

impl Grid {
    pub(super) fn new(bounds: &Bounds) -> Self {
        let low = Vec3::from(bounds.min);
        let extent = Vec3::from(bounds.max) - low;
        let size = (extent.max_element() / CELLS).max(f32::MIN_POSITIVE);
        let counts = extent.to_array().map(|e| (e / size) as i32 + 1);
        Self { low, size, counts }
    }

    pub(super) fn len(&self) -> usize {
        self.counts.iter().map(|&n| n as usize).product()
    }

    pub(super) fn place(&self, p: Vec3) -> [i32; 3] {
        let at = ((p - self.low) / self.size).to_array();
        [0, 1, 2].map(|axis| (at[axis] as i32).clamp(0, self.counts[axis] - 1))
    }

    pub(super) fn cell(&self, [x, y, z]: [i32; 3]) -> usize {
        ((z * self.counts[1] + y) * self.counts[0] + x) as usize
    }

    /// How many cells a ball touches.
    pub(super) fn count_around(&self, centre: Vec3, radius: f32) -> usize {
        let (low, high) = (self.place(centre - Vec3::splat(radius)), self.place(centre + Vec3::splat(radius)));
        (0..3).map(|axis| (high[axis] - low[axis] + 1) as usize).product()
    }

    /// The cells that a ball touches.
    pub(super) fn around(&self, centre: Vec3, radius: f32) -> impl Iterator<Item = usize> + '_ {
        let (low, high) = (self.place(centre - Vec3::splat(radius)), self.place(centre + Vec3::splat(radius)));
        (low[2]..=high[2]).flat_map(move |z| {
            (low[1]..=high[1]).flat_map(move |y| (low[0]..=high[0]).map(move |x| self.cell([x, y, z])))
        })
    }
}

/// The vertices of the wall, cell by cell, and which of them are explained.
pub(super) struct Wall {
    offsets: Vec<u32>,
    order: Vec<u32>,
    pub(super) is_explained: Vec<bool>,
}

impl Wall {
    pub(super) fn new(grid: &Grid, positions: &[Vec3]) -> Self {
        let mut offsets = vec![0u32; grid.len() + 1];
        let cells: Vec<u32> = positions.iter().map(|&p| grid.cell(grid.place(p)) as u32).collect();
        for &cell in &cells {
            offsets[cell as usize + 1] += 1;
        }
        for cell in 0..grid.len() {
            offsets[cell + 1] += offsets[cell];
        }
        let mut cursor = offsets.clone();
        let mut order = vec![0; positions.len()];
        for (v, &cell) in cells.iter().enumerate() {
            order[cursor[cell as usize] as usize] = v as u32;
            cursor[cell as usize] += 1;
        }
        Self { offsets, order, is_explained: vec![false; positions.len()] }
    }

    pub(super) fn explain(&mut self, grid: &Grid, positions: &[Vec3], centre: Vec3, radius: f32) {
        for cell in grid.around(centre, radius) {
            for &v in &self.order[self.offsets[cell] as usize..self.offsets[cell + 1] as usize] {
                if positions[v as usize].distance_squared(centre) <= radius * radius {
                    self.is_explained[v as usize] = true;
                }
            }
        }
    }
}
