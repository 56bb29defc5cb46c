//! Smoothing that holds the volume.
//!
//! A low-pass filter takes volume off where the surface is convex on the scale of the filter, and most of it off thin
//! vessels. What is common puts it back evenly: by scaling the surface (Desbrun, Meyer, Schröder and Barr 1999), which
//! moves what was never smoothed, or by one offset along all normals (Kuprat, Khamayseh, George and Larkey 2001 give
//! the exact step), which swells thin vessels. Here it goes back where it was lost:
//!
//! 1. The loss at a vertex is the part of its way `x - S x` along the smoothed surface's normal. Stair-steps are in it;
//!    the same filter takes them out (Tukey's twicing, 1977, along the normals). The result is added.
//! 2. What is still missing, or too much, is little. It is spread evenly over what smoothing moved:
//!    `x = S x + n (loss + m share)`, with a `share` that falls from 1 to 0 where smoothing moved next to nothing. The
//!    volume is a cubic polynomial in `m`; its root next to 0 is the answer.
//!
//! The even part is at most as large as the root mean square of the way; where that does not suffice the surface is left
//! as the filter made it. Vertices that smoothing fixes stay to the bit; those of a boundary loop move in the loop's plane.

use glam::{DVec3, Vec3};

use super::{SmoothingTask, Stencil};
use crate::mesh::{Topology, TriMesh, volume_of};
use crate::pipeline::filter::Filter;
use crate::pipeline::normals::{Weighting, vertex_normals};
use crate::pipeline::settings::Boundary;
use crate::pipeline::task::{Budget, Progress, Task};

/// How near to the volume asked for counts as held, as a part of it.
const TOLERANCE: f64 = 1e-4;

/// The largest `|m|`, in root mean squares of the way.
const MOST: f64 = 1.0;

/// A way of this part of the root mean square has half a share.
const STILL: f64 = 1.0;

/// The surface before smoothing.
pub(super) struct Before<'a> {
    pub mesh: &'a TriMesh,
    pub topology: &'a Topology,
    /// Its boundary, each loop in the direction of its triangles.
    pub loops: &'a [Vec<u32>],
    /// Its volume in mm3.
    pub volume: f64,
}

/// Puts lost volume back, in slices.
pub(super) struct VolumeTask {
    smoothed: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// Filters (loss, length of the way, 0) at each vertex.
    field: SmoothingTask,
}

impl VolumeTask {
    /// Starts from `smoothed`, the result of `filter` on the surface `before`.
    pub(super) fn new(before: &Before, smoothed: Vec<Vec3>, boundary: Boundary, filter: &Filter) -> Self {
        let normals = vertex_normals(&smoothed, &before.mesh.triangles, Weighting::Area);
        let ways = before.mesh.positions.iter().zip(&smoothed).map(|(&x, &s)| x - s);
        let field: Vec<Vec3> = ways.zip(&normals).map(|(way, n)| Vec3::new(way.dot(*n), way.length(), 0.0)).collect();
        let stencil = Stencil::new(&before.mesh.positions, before.topology, boundary);
        Self { field: SmoothingTask::of_field(&field, before.topology, &stencil, filter), smoothed, normals }
    }

    /// The smoothed positions, as they came.
    pub(super) fn into_smoothed(self) -> Vec<Vec3> {
        self.smoothed
    }

    /// Works until `budget` is spent or the volume is held. Gives the positions, and whether they hold it: where they
    /// cannot, they are the smoothed ones.
    pub(super) fn advance(&mut self, before: &Before, budget: Budget) -> Progress<(Vec<Vec3>, bool)> {
        match self.field.advance(budget) {
            Progress::Working(fraction) => Progress::Working(fraction),
            Progress::Done(field) => Progress::Done(self.place(before, &field)),
        }
    }

    fn place(&mut self, before: &Before, field: &[Vec3]) -> (Vec<Vec3>, bool) {
        let smoothed = std::mem::take(&mut self.smoothed);
        let directions = directions(&smoothed, &self.normals, before.loops);
        let origin = before.mesh.bounds().centre().as_dvec3();
        let way = |v: usize| f64::from(field[v].y.max(0.0));
        let typical = (0..field.len()).map(|v| way(v) * way(v)).sum::<f64>() / field.len().max(1) as f64;
        let typical = libm::sqrt(typical);
        let at = |v: usize, m: f64| {
            // Evenly, but for where smoothing moved next to nothing.
            let share = if way(v) > 0.0 { way(v) / (way(v) + typical * STILL) } else { 0.0 };
            smoothed[v].as_dvec3() + directions[v] * (f64::from(field[v].x) + m * typical * share)
        };
        let missing = |at: &dyn Fn(usize) -> DVec3| {
            volume_of(&before.mesh.triangles, before.loops, |v| at(v as usize) - origin) - before.volume
        };
        let values = [-1.0, 0.0, 1.0, 2.0].map(|m| missing(&|v| at(v, m)));
        let Some(m) = nearest_root(values).filter(|m| m.abs() <= MOST) else { return (smoothed, false) };
        // What does not move keeps its bits.
        let moves = |v: usize| directions[v] != DVec3::ZERO && field[v] != Vec3::ZERO;
        let placed = |v: usize| if moves(v) { at(v, m).as_vec3() } else { smoothed[v] };
        let positions: Vec<Vec3> = (0..smoothed.len()).map(placed).collect();
        let is_held = missing(&|v| positions[v].as_dvec3()).abs() <= TOLERANCE * before.volume.abs();
        if is_held { (positions, true) } else { (smoothed, false) }
    }
}

/// The directions in which vertices may move: along their normals, on a loop in its plane.
fn directions(smoothed: &[Vec3], normals: &[Vec3], loops: &[Vec<u32>]) -> Vec<DVec3> {
    let mut directions: Vec<DVec3> = normals.iter().map(|n| n.as_dvec3()).collect();
    let at = |v: u32| smoothed[v as usize].as_dvec3();
    for chain in loops {
        let origin = at(chain[0]);
        let pairs = chain.iter().zip(chain.iter().cycle().skip(1));
        // Newell: the loop's area vector.
        let across = pairs.map(|(&a, &b)| (at(a) - origin).cross(at(b) - origin)).sum::<DVec3>().normalize_or_zero();
        for &v in chain {
            let n = directions[v as usize];
            directions[v as usize] = if across == DVec3::ZERO { DVec3::ZERO } else { n - across * n.dot(across) };
        }
    }
    directions
}

/// The root next to 0 of the cubic polynomial that has these values at -1, 0, 1 and 2, within -2 to 2.
fn nearest_root(values: [f64; 4]) -> Option<f64> {
    if values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let [before, zero, one, two] = values;
    // Newton's forward differences from -1.
    let (d1, d2, d3) = (zero - before, one - 2.0 * zero + before, two - 3.0 * one + 3.0 * zero - before);
    let value = |m: f64| {
        let t = m + 1.0;
        before + t * (d1 + (t - 1.0) / 2.0 * (d2 + (t - 2.0) / 3.0 * d3))
    };
    if zero == 0.0 {
        return Some(0.0);
    }
    const STEPS: i32 = 128;
    let at = |step: i32| 2.0 * f64::from(step) / f64::from(STEPS);
    let crossing = |sign: i32| {
        (1..=STEPS).find(|&step| value(at(sign * step)) * value(at(sign * (step - 1))) <= 0.0).map(|step| (step, sign))
    };
    let (step, sign) = [crossing(1), crossing(-1)].into_iter().flatten().min()?;
    let (mut near, mut far) = (at(sign * (step - 1)), at(sign * step));
    for _ in 0..60 {
        let middle = (near + far) / 2.0;
        if value(middle) * value(near) <= 0.0 { far = middle } else { near = middle }
    }
    Some(far)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_next_to_zero_is_found() {
        let cubic = |m: f64| (m - 0.3) * (m + 0.9) * (m - 1.7);
        let found = nearest_root([-1.0, 0.0, 1.0, 2.0].map(cubic)).unwrap();
        assert!((found - 0.3).abs() < 1e-12, "{found}");
        assert_eq!(nearest_root([0.0; 4]), Some(0.0));
        assert_eq!(nearest_root([1.0; 4]), None);
        assert_eq!(nearest_root([f64::NAN, 1.0, 1.0, 1.0]), None);
    }
}
