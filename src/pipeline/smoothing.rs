//! Windowed-sinc smoothing of a surface: Taubin, Zhang and Golub, "Optimal surface smoothing as filter design" (1996).
//!
//! With uniform (umbrella) weights, `K x_i = x_i - mean of x_i's neighbours` and `M = I - K/2`, the filtered surface
//! is `sum of c_n T_n(M) x` (`super::filter` has the `c_n`), evaluated by the Chebyshev recurrence
//!
//! ```text
//! x_0 = x,   x_1 = (x_0 + mean(x_0)) / 2,   x_{n+1} = x_n + mean(x_n) - x_{n-1}
//! ```
//!
//! in as many passes over the neighbours as there are iterations. Boundary vertices see the two neighbours along
//! their loop only; vertices on non-manifold edges, and those where several loops meet, stay where they are.
//! Positions are kept relative to the middle of the surface in f32, four lanes a vertex.

use glam::Vec3;

use super::filter::Filter;
use super::settings::Boundary;
use super::task::{Budget, Progress, Task};
use crate::mesh::Topology;

/// Vertices between two looks at the clock.
const CHUNK: usize = 16 * 1024;

/// Which vertices pull on which. One that stays is its own only neighbour: then `mean(x) = x`, and the recurrence keeps
/// it where it is for those that it pulls on.
struct Stencil {
    offsets: Vec<u32>,
    neighbours: Vec<u32>,
    /// One over the number of neighbours.
    weights: Vec<f32>,
}

/// A smoothing run in slices.
pub struct SmoothingTask {
    stencil: Stencil,
    input: Vec<Vec3>,
    centre: Vec3,
    coefficients: Vec<f32>,
    /// `f(0)`, by which VTK multiplies what stays; 1 for a normalised filter.
    gain: f64,
    /// `x_{n-1}`, overwritten by `x_{n+1}`.
    previous: Vec<[f32; 4]>,
    current: Vec<[f32; 4]>,
    sum: Vec<[f32; 4]>,
    /// The pass under way: it computes `x_pass` from 1 on.
    pass: usize,
    /// The first vertex of the pass that is not done.
    vertex: usize,
}

impl SmoothingTask {
    /// Starts smoothing `positions` (mm) with `filter`; `topology` is that of the surface.
    pub fn new(positions: &[Vec3], topology: &Topology, boundary: Boundary, filter: &Filter) -> Self {
        let centre = crate::mesh::Bounds::of(positions).centre();
        let current: Vec<[f32; 4]> = positions.iter().map(|&p| (p - centre).extend(0.0).to_array()).collect();
        let c0 = filter.coefficients[0] as f32;
        Self {
            stencil: Stencil::new(positions, topology, boundary),
            input: positions.to_vec(),
            centre,
            coefficients: filter.coefficients.iter().map(|&c| c as f32).collect(),
            gain: filter.dc_gain(),
            previous: current.clone(),
            sum: current.iter().map(|p| p.map(|x| x * c0)).collect(),
            current,
            pass: 1,
            vertex: 0,
        }
    }

    /// One pass over the vertices `from..to`.
    fn pass(&mut self, from: usize, to: usize) {
        // x_1 is half of what the recurrence gives with x_{-1} = 0.
        let (scale, keep) = if self.pass == 1 { (0.5, 0.0) } else { (1.0, 1.0) };
        let c = self.coefficients[self.pass];
        let Stencil { offsets, neighbours, weights } = &self.stencil;
        for v in from..to {
            let mut mean = [0.0f32; 4];
            for &n in &neighbours[offsets[v] as usize..offsets[v + 1] as usize] {
                let x = self.current[n as usize];
                for lane in 0..4 {
                    mean[lane] += x[lane];
                }
            }
            let (x, old, weight) = (self.current[v], self.previous[v], weights[v]);
            let (next, sum) = (&mut self.previous[v], &mut self.sum[v]);
            for lane in 0..4 {
                next[lane] = (x[lane] + mean[lane] * weight) * scale - old[lane] * keep;
                sum[lane] += next[lane] * c;
            }
        }
    }

    fn result(&self) -> Vec<Vec3> {
        let normalised = (self.gain - 1.0).abs() < 1e-9;
        let offset = (self.centre.as_dvec3() * self.gain).as_vec3();
        let place = |v: usize| {
            if !self.stencil.stays(v) {
                let [x, y, z, _] = self.sum[v];
                Vec3::new(x, y, z) + if normalised { self.centre } else { offset }
            } else if normalised {
                self.input[v]
            } else {
                (self.input[v].as_dvec3() * self.gain).as_vec3()
            }
        };
        (0..self.input.len()).map(place).collect()
    }
}

impl Task for SmoothingTask {
    type Output = Vec<Vec3>;

    fn advance(&mut self, budget: Budget) -> Progress<Vec<Vec3>> {
        let (count, degree) = (self.input.len(), self.coefficients.len() - 1);
        while count > 0 && self.pass <= degree {
            let end = (self.vertex + CHUNK).min(count);
            self.pass(self.vertex, end);
            self.vertex = end;
            if end == count {
                std::mem::swap(&mut self.previous, &mut self.current);
                self.pass += 1;
                self.vertex = 0;
            }
            if budget.is_spent() && self.pass <= degree {
                let done = (self.pass - 1) as f32 + self.vertex as f32 / count as f32;
                return Progress::Working(done / degree as f32);
            }
        }
        Progress::Done(self.result())
    }
}

/// The smoothed positions of a surface.
pub fn smooth(positions: &[Vec3], topology: &Topology, boundary: Boundary, filter: &Filter) -> Vec<Vec3> {
    SmoothingTask::new(positions, topology, boundary, filter).finish()
}

impl Stencil {
    fn new(positions: &[Vec3], topology: &Topology, boundary: Boundary) -> Self {
        let count = topology.vertex_count();
        let mut offsets = Vec::with_capacity(count + 1);
        let mut neighbours: Vec<u32> = Vec::with_capacity(topology.neighbour_lists().len());
        let mut weights = Vec::with_capacity(count);
        offsets.push(0);
        for v in 0..count as u32 {
            let start = neighbours.len();
            let uses = topology.edge_uses(v);
            if uses.iter().any(|edge| edge.is_non_manifold()) {
                // stays
            } else if uses.iter().any(|edge| edge.is_boundary()) {
                let ends = topology.neighbours(v).iter().zip(uses).filter(|(_, edge)| edge.is_boundary());
                neighbours.extend(ends.map(|(&n, _)| n));
                let stays = match neighbours[start..] {
                    [a, b] => boundary == Boundary::Vtk15 && turns_by_15_degrees(positions, a, v, b),
                    _ => true,
                };
                if stays {
                    neighbours.truncate(start);
                }
            } else {
                neighbours.extend_from_slice(topology.neighbours(v));
            }
            if neighbours.len() == start {
                neighbours.push(v);
            }
            weights.push(1.0 / (neighbours.len() - start) as f32);
            offsets.push(neighbours.len() as u32);
        }
        Self { offsets, neighbours, weights }
    }
}

impl Stencil {
    /// Whether vertex `v` stays.
    fn stays(&self, v: usize) -> bool {
        self.neighbours[self.offsets[v] as usize..self.offsets[v + 1] as usize] == [v as u32]
    }
}

/// Whether the way a -> v -> b turns by more than 15 degrees.
fn turns_by_15_degrees(positions: &[Vec3], a: u32, v: u32, b: u32) -> bool {
    const COS_15: f64 = 0.965_925_826_289_068_3;
    let at = |i: u32| positions[i as usize].as_dvec3();
    let (incoming, outgoing) = (at(v) - at(a), at(b) - at(v));
    let lengths = incoming.length() * outgoing.length();
    lengths > 0.0 && incoming.dot(outgoing) < COS_15 * lengths
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::settings::Smoothing;

    /// A flat n x n grid of quads split in two, spacing 1 mm.
    fn grid(n: u32, z: impl Fn(u32, u32) -> f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let at = |x: u32, y: u32| y * (n + 1) + x;
        let positions = (0..=n).flat_map(|y| (0..=n).map(move |x| (x, y)));
        let triangles = (0..n).flat_map(|y| (0..n).map(move |x| (x, y))).flat_map(|(x, y)| {
            let (a, b, c, d) = (at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
            [[a, b, c], [a, c, d]]
        });
        (positions.map(|(x, y)| Vec3::new(x as f32, y as f32, z(x, y))).collect(), triangles.collect())
    }

    #[test]
    fn the_origin_does_not_matter() {
        let (positions, triangles) = grid(20, |x, y| ((x * 7 + y * 3) % 5) as f32 * 0.2);
        let topology = Topology::new(positions.len(), &triangles);
        for window in crate::pipeline::settings::Window::ALL {
            let filter = Filter::new(&Smoothing { window, ..Smoothing::default() });
            let here = smooth(&positions, &topology, Boundary::Loop, &filter);
            // A shift that f32 holds exactly, so that nothing but the filter can differ.
            let shifted: Vec<Vec3> = positions.iter().map(|&p| p + 512.0).collect();
            let there = smooth(&shifted, &topology, Boundary::Loop, &filter);
            let worst = here.iter().zip(&there).map(|(a, b)| (*a + 512.0 - *b).length()).fold(0.0, f32::max);
            assert!(worst < 2e-4, "{window:?} moved by {worst} mm"); // three ulp at 512
        }
    }

    #[test]
    fn slices_give_what_one_run_gives() {
        let (positions, triangles) = grid(150, |x, y| ((x * 7 + y * 3) % 5) as f32 * 0.2);
        let topology = Topology::new(positions.len(), &triangles);
        let filter = Filter::new(&Smoothing { iterations: 7, ..Smoothing::default() });
        let whole = smooth(&positions, &topology, Boundary::Loop, &filter);
        let mut task = SmoothingTask::new(&positions, &topology, Boundary::Loop, &filter);
        let mut slices = 0;
        let sliced = loop {
            match task.advance(Budget::new(std::time::Duration::ZERO)) {
                Progress::Working(fraction) => assert!((0.0..=1.0).contains(&fraction)),
                Progress::Done(result) => break result,
            }
            slices += 1;
        };
        assert!(slices >= 7);
        assert_eq!(whole, sliced);
    }

    #[test]
    fn vertices_on_a_non_manifold_edge_stay_to_the_bit() {
        let positions = vec![Vec3::X * 0.1, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Z];
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
        let topology = Topology::new(5, &triangles);
        let filter = Filter::new(&Smoothing::default());
        let smoothed = smooth(&positions, &topology, Boundary::Loop, &filter);
        assert_eq!(smoothed[..2], positions[..2]);
        // The others are pulled between them: a filter of unit gain keeps them near.
        assert!(smoothed.iter().all(|p| p.length() < 2.0), "{smoothed:?}");
    }
}
