//! What is outside of a surface, on a sparse grid of points.
//!
//! A point is blocked where it is within a distance of the surface, and outside where a way along the grid's axes leads from
//! the grid's border to it past blocked points. Points stand in blocks of 8 x 8 x 8. Blocks without a blocked point are one
//! number each; of the others each row of points is a byte, each plane a word, and the flood goes through a block by shifts of
//! words.

use glam::{DVec3, Vec3};
use lumen_mesh::task::Yielder;
use lumen_mesh::{TriMesh, distance_to_triangle};
use lumen_volume::{Geometry, Mask};
use std::ops::Range;

/// Points along a block.
const SIDE: usize = 8;
/// Blocks of a grid at most: 64 MB of numbers.
const MOST_BLOCKS: f64 = (1u32 << 24) as f64;
/// Blocks and triangles between two looks at the clock.
const SLICE: usize = 512;
/// A block without a blocked point: not reached, and reached.
const FREE: u32 = u32::MAX;
const OUTSIDE: u32 = u32::MAX - 1;
/// The points of a plane whose first, whose last index is that of the border.
const FIRST_X: u64 = 0x0101_0101_0101_0101;
const LAST_X: u64 = FIRST_X << 7;
const ROW: u64 = 0xff;

/// A bit for each point of a block: a word for each plane, a byte of it for each row.
type Bits = [u64; SIDE];

/// The points of a grid that are outside of a surface.
pub(super) struct Outside {
    /// The place of the first point in mm, and the distance between neighbours.
    origin: DVec3,
    step: f64,
    /// Blocks along x, y, z.
    size: [usize; 3],
    /// For each block [`FREE`], [`OUTSIDE`], or its place in the lists.
    states: Vec<u32>,
    blocked: Vec<Bits>,
    outside: Vec<Bits>,
}

/// What is not outside.
pub(super) struct Inside<'a> {
    pub(super) of: &'a Outside,
    /// The slice that [`Mask::row`] is asked for.
    pub(super) slice: usize,
}

/// The least distance between points at which a grid around a box of this size is not too large.
pub(super) fn least_step(extent: DVec3) -> f64 {
    let volume = |step: f64| (extent / (step * SIDE as f64) + 3.0).to_array().iter().product::<f64>();
    let mut step = 1e-3;
    // What is not finite is never small enough.
    while volume(step) > MOST_BLOCKS && step < 1e6 {
        step *= 1.1;
    }
    step
}

impl Outside {
    /// Of `mesh`, on points `step` mm apart, blocked within `reach` mm. The step is at least [`least_step`].
    pub(super) async fn of(mesh: &TriMesh, step: f64, reach: f64, yielder: &Yielder) -> Self {
        let bounds = mesh.bounds();
        let side = step * SIDE as f64;
        let (low, extent) = (Vec3::from(bounds.min).as_dvec3(), bounds.size().as_dvec3());
        // A block and more of the border holds nothing.
        let origin = low - DVec3::splat(reach + side + step);
        let size = (extent + 2.0 * (reach + step)).to_array().map(|mm| libm::ceil(mm / side) as usize + 3);
        let states = vec![FREE; size.iter().product()];
        let mut grid = Self { origin, step, size, states, blocked: Vec::new(), outside: Vec::new() };
        let mut seen = 0;
        for t in 0..mesh.triangles.len() {
            seen += 1 + grid.block(mesh.corners(t), reach);
            if seen >= SLICE {
                seen = 0;
                yielder.rest(0.7 * t as f32 / mesh.triangles.len() as f32).await;
            }
        }
        grid.outside = vec![[0; SIDE]; grid.blocked.len()];
        grid.flood(yielder).await;
        grid
    }

    /// The grid of all points.
    pub(super) fn geometry(&self) -> Geometry {
        Geometry::upright(self.size.map(|blocks| blocks * SIDE), DVec3::splat(self.step), self.origin)
    }

    /// Whether the point nearest to `p` is outside; what is beyond the grid is.
    pub(super) fn has(&self, p: DVec3) -> bool {
        let [x, y, z] = ((p - self.origin) / self.step).to_array().map(|x| libm::round(x) as i64);
        let is_within = [x, y, z].iter().zip(self.size).all(|(x, blocks)| (0..(blocks * SIDE) as i64).contains(x));
        if !is_within {
            return true;
        }
        let [x, y, z] = [x as usize, y as usize, z as usize];
        match self.states[self.number([x / SIDE, y / SIDE, z / SIDE])] {
            FREE => false,
            OUTSIDE => true,
            of => self.outside[of as usize][z % SIDE] >> (y % SIDE * SIDE + x % SIDE) & 1 == 1,
        }
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    /// Blocks the points within `reach` of a triangle; returns how many blocks were looked at.
    fn block(&mut self, corners: [Vec3; 3], reach: f64) -> usize {
        let places = corners.map(|p| (p.as_dvec3() - self.origin) / self.step);
        let low = places.into_iter().reduce(DVec3::min).unwrap_or_default() - reach / self.step;
        let high = places.into_iter().reduce(DVec3::max).unwrap_or_default() + reach / self.step;
        let (low, high) = (low.to_array().map(|x| libm::ceil(x) as usize), high.to_array().map(|x| x as usize));
        let distance = |place: DVec3| distance_to_triangle((self.origin + place * self.step).as_vec3(), corners);
        // From the middle of a block to its farthest point.
        let to_corner = 0.5 * (SIDE - 1) as f64 * libm::sqrt(3.0) * self.step;
        let of_blocks = |axis: usize| low[axis] / SIDE..=high[axis] / SIDE;
        let mut marks = Vec::new();
        let seen = [0, 1, 2].map(|axis| of_blocks(axis).count()).iter().product();
        for z in of_blocks(2) {
            for y in of_blocks(1) {
                for x in of_blocks(0) {
                    let first = [x * SIDE, y * SIDE, z * SIDE];
                    let middle = DVec3::from(first.map(|i| i as f64 + 0.5 * (SIDE - 1) as f64));
                    let inner = |axis: usize| low[axis].max(first[axis])..(high[axis] + 1).min(first[axis] + SIDE);
                    let is_large = inner(0).len() * inner(1).len() * inner(2).len() > 64;
                    if is_large && distance(middle) > to_corner + reach {
                        continue;
                    }
                    let number = self.number([x, y, z]);
                    let known = self.blocked.get(self.states[number] as usize).copied().unwrap_or_default();
                    let mut bits = known;
                    for (k, j) in inner(2).flat_map(|k| inner(1).map(move |j| (k, j))) {
                        for i in inner(0) {
                            let bit = 1u64 << (j % SIDE * SIDE + i % SIDE);
                            let word = &mut bits[k % SIDE];
                            if *word & bit == 0 && distance(DVec3::new(i as f64, j as f64, k as f64)) <= reach {
                                *word |= bit;
                            }
                        }
                    }
                    if bits != known {
                        marks.push((number, bits));
                    }
                }
            }
        }
        for (number, bits) in marks {
            if self.states[number] == FREE {
                self.states[number] = self.blocked.len() as u32;
                self.blocked.push(bits);
            } else {
                self.blocked[self.states[number] as usize] = bits;
            }
        }
        seen
    }

    /// Goes out from the first block, which is at the border, to all that is outside.
    async fn flood(&mut self, yielder: &Yielder) {
        let [nx, ny, nz] = self.size;
        self.states[0] = OUTSIDE;
        let mut queue = vec![[0usize; 3]];
        let mut done = 0usize;
        while let Some(at) = queue.pop() {
            let from = match self.states[self.number(at)] {
                FREE => continue,
                OUTSIDE => [!0; SIDE],
                of => self.outside[of as usize],
            };
            for (axis, is_up) in [(0, true), (0, false), (1, true), (1, false), (2, true), (2, false)] {
                let mut next = at;
                next[axis] = if is_up { at[axis] + 1 } else { at[axis].wrapping_sub(1) };
                if next[axis] >= [nx, ny, nz][axis] {
                    continue;
                }
                let number = self.number(next);
                match self.states[number] {
                    OUTSIDE => {}
                    FREE => {
                        if across(&from, axis, is_up) != [0; SIDE] {
                            self.states[number] = OUTSIDE;
                            queue.push(next);
                        }
                    }
                    of => {
                        let seeds = across(&from, axis, is_up);
                        if grow(&mut self.outside[of as usize], &self.blocked[of as usize], seeds) {
                            queue.push(next);
                        }
                    }
                }
            }
            done += 1;
            if done.is_multiple_of(SLICE) {
                yielder.rest(0.7 + 0.3 * (done as f32 / (1.5 * self.states.len() as f32)).min(1.0)).await;
            }
        }
    }
}

/// The points next to `from` in the block beside it.
fn across(from: &Bits, axis: usize, is_up: bool) -> Bits {
    let mut seeds = [0; SIDE];
    match (axis, is_up) {
        (2, true) => seeds[0] = from[SIDE - 1],
        (2, false) => seeds[SIDE - 1] = from[0],
        _ => {
            for (seed, word) in seeds.iter_mut().zip(from) {
                *seed = match (axis, is_up) {
                    (0, true) => (word & LAST_X) >> 7,
                    (0, false) => (word & FIRST_X) << 7,
                    (_, true) => word >> 56,
                    (_, false) => (word & ROW) << 56,
                };
            }
        }
    }
    seeds
}

/// Adds to `outside` what can be reached from `seeds` past what is blocked; whether that is anything.
fn grow(outside: &mut Bits, blocked: &Bits, seeds: Bits) -> bool {
    let mut new = seeds;
    let mut has_grown = false;
    loop {
        let mut is_any = false;
        for i in 0..SIDE {
            new[i] &= !blocked[i] & !outside[i];
            outside[i] |= new[i];
            is_any |= new[i] != 0;
        }
        if !is_any {
            return has_grown;
        }
        has_grown = true;
        let from = new;
        for i in 0..SIDE {
            let word = from[i];
            new[i] = (word & !LAST_X) << 1 | (word & !FIRST_X) >> 1 | word << SIDE | word >> SIDE;
            new[i] |= i.checked_sub(1).map_or(0, |below| from[below]) | from.get(i + 1).copied().unwrap_or(0);
        }
    }
}

impl Mask for Inside<'_> {
    const CLOSED: bool = true;

    fn begin_slice(&mut self, k: usize) {
        self.slice = k;
    }

    fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>) {
        let Outside { size, states, outside, .. } = self.of;
        let first = self.of.number([0, j / SIDE, self.slice / SIDE]);
        let begun = runs.len();
        for (x, state) in states[first..first + size[0]].iter().enumerate() {
            let row = match *state {
                OUTSIDE => continue,
                FREE => ROW,
                of => !(outside[of as usize][self.slice % SIDE] >> (j % SIDE * SIDE)) & ROW,
            };
            for i in (0..SIDE).filter(|i| row >> i & 1 == 1) {
                let at = x * SIDE + i;
                match runs[begun..].last_mut().filter(|run| run.end == at) {
                    Some(run) => run.end = at + 1,
                    None => runs.push(at..at + 1),
                }
            }
        }
    }
}
