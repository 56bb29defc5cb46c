//! How the sums of a filter, which stand strip by strip, become positions of the surface.

use glam::{Vec3, Vec4};

use lumen_mesh::parallel;

/// How sums become positions of the surface.
pub(super) struct Placement {
    /// The place of each vertex in the order.
    pub(super) places: Vec<u32>,
    pub(super) centre: Vec3,
    /// The vertices that stay, and where.
    pub(super) fixed: Vec<(u32, Vec3)>,
}

/// Vertices that are placed at a time.
const PLACED: usize = 1 << 14;

/// A sum, relative to the middle of the surface.
pub(super) trait Sum: Copy + Sync {
    fn xyz(self) -> Vec3;
}

impl Sum for Vec3 {
    fn xyz(self) -> Vec3 {
        self
    }
}

impl Sum for Vec4 {
    fn xyz(self) -> Vec3 {
        self.truncate()
    }
}

impl Placement {
    /// The positions that `sums` mean; they stand strip by strip. `gain` is `f(0)`, by which VTK multiplies what
    /// stays; 1 for a normalised filter.
    pub(super) fn place<S: Sum, B: AsRef<[S]> + Sync>(&self, sums: &[B], gain: f64) -> Vec<Vec3> {
        let is_normalised = (gain - 1.0).abs() < 1e-9;
        let scaled = |p: Vec3| if is_normalised { p } else { (p.as_dvec3() * gain).as_vec3() };
        let offset = scaled(self.centre);
        let mut ends: Vec<usize> = sums.iter().map(|sums| sums.as_ref().len()).collect();
        for i in 1..ends.len() {
            ends[i] += ends[i - 1];
        }
        let mut positions = vec![Vec3::ZERO; self.places.len()];
        parallel::for_each_chunk_mut(&mut positions, PLACED, |first, chunk| {
            for (position, &place) in chunk.iter_mut().zip(&self.places[first..]) {
                let strip = ends.partition_point(|&end| end <= place as usize);
                let sums = sums[strip].as_ref();
                *position = sums[place as usize + sums.len() - ends[strip]].xyz() + offset;
            }
        });
        for &(v, p) in &self.fixed {
            positions[v as usize] = scaled(p);
        }
        positions
    }
}
