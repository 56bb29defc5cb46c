//! The triangles of a wall in a uniform grid of cells.

use glam::DVec3;

use super::segment::segment_to_triangle;

/// Most cells.
const CELLS: f64 = 4e6;
/// Most cells that triangles are listed in.
const LISTED: f64 = 3e7;

#[derive(Clone, Debug)]
pub(super) struct Wall {
    triangles: Vec<[DVec3; 3]>,
    low: DVec3,
    size: f64,
    counts: [i64; 3],
    offsets: Vec<u32>,
    lists: Vec<u32>,
}

impl Wall {
    pub(super) fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let corners = || triangles.iter().flatten().copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let extent = (corners().fold(DVec3::NEG_INFINITY, DVec3::max) - low).max(DVec3::ZERO);
        let count = triangles.len().max(1) as f64;
        let mean =
            triangles.iter().map(|&[a, b, c]| (a.max(b).max(c) - a.min(b).min(c)).max_element()).sum::<f64>() / count;
        let mut wall = Self { triangles, low, size: mean, counts: [1; 3], offsets: Vec::new(), lists: Vec::new() };
        loop {
            let axis = |e: f64| (e / wall.size).floor() + 1.0;
            let cells = axis(extent.x) * axis(extent.y) * axis(extent.z);
            if wall.triangles.is_empty() || wall.size <= 0.0 || cells.is_nan() {
                (wall.size, wall.counts) = (1.0, [1; 3]);
                break;
            }
            wall.counts = extent.to_array().map(|e| axis(e) as i64);
            if cells <= CELLS && wall.listed() <= LISTED {
                break;
            }
            wall.size *= 1.3;
        }
        wall.list();
        wall
    }

    fn listed(&self) -> f64 {
        let cells = |triangle: &[DVec3; 3]| {
            let [low, high] = self.range(triangle);
            (0..3).map(|axis| (high[axis] - low[axis] + 1) as f64).product::<f64>()
        };
        self.triangles.iter().map(cells).sum()
    }

    fn list(&mut self) {
        let cells = self.counts.iter().product::<i64>() as usize;
        let mut offsets = vec![0u32; cells + 1];
        for triangle in &self.triangles {
            self.each_cell(self.range(triangle), |cell| offsets[cell + 1] += 1);
        }
        for cell in 0..cells {
            offsets[cell + 1] += offsets[cell];
        }
        let mut cursor = offsets.clone();
        let mut lists = vec![0u32; offsets[cells] as usize];
        for (t, triangle) in self.triangles.iter().enumerate() {
            self.each_cell(self.range(triangle), |cell| {
                lists[cursor[cell] as usize] = t as u32;
                cursor[cell] += 1;
            });
        }
        (self.offsets, self.lists) = (offsets, lists);
    }

    fn range(&self, [a, b, c]: &[DVec3; 3]) -> [[i64; 3]; 2] {
        [a.min(*b).min(*c), a.max(*b).max(*c)].map(|p| self.place(p))
    }

    fn place(&self, p: DVec3) -> [i64; 3] {
        let at = ((p - self.low) / self.size).to_array();
        [0, 1, 2].map(|axis| (at[axis].floor() as i64).clamp(0, self.counts[axis] - 1))
    }

    fn each_cell(&self, [low, high]: [[i64; 3]; 2], mut visit: impl FnMut(usize)) {
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    visit(((z * self.counts[1] + y) * self.counts[0] + x) as usize);
                }
            }
        }
    }

    /// Distance of the segment from `p` to `q` from the wall, infinite where it is more than `farthest`.
    pub(super) fn distance(&self, p: DVec3, q: DVec3, farthest: f64) -> f64 {
        let reach = DVec3::splat(farthest);
        let range = [p.min(q) - reach, p.max(q) + reach].map(|corner| self.place(corner));
        let mut least = f64::INFINITY;
        self.each_cell(range, |cell| {
            for &t in &self.lists[self.offsets[cell] as usize..self.offsets[cell + 1] as usize] {
                least = least.min(segment_to_triangle(p, q, self.triangles[t as usize]));
            }
        });
        if least <= farthest { least } else { f64::INFINITY }
    }

    /// Distance of a point from the wall; infinite without one.
    pub(super) fn clearance(&self, p: DVec3) -> f64 {
        let mut farthest = self.size;
        let out = (self.low - p).max(p - self.low - DVec3::from(self.counts.map(|n| n as f64)) * self.size);
        farthest += out.max(DVec3::ZERO).length();
        let most = 4.0 * farthest + self.size * self.counts.iter().sum::<i64>() as f64;
        while farthest <= most && !self.triangles.is_empty() {
            let found = self.distance(p, p, farthest);
            if found.is_finite() {
                return found;
            }
            farthest *= 2.0;
        }
        f64::INFINITY
    }
}
