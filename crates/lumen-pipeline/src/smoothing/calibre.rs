//! The least pass band at each vertex that leaves its vessel the calibre that it has.
//!
//! Around a round vessel of radius `r` the coordinates of its wall are waves of length `2 pi r`, one around: on edges
//! of length `h` they have the eigenvalue `k = 1 - J0(h / r)` (`pipeline::response`). A filter that stops them draws
//! the vessel shut, one whose pass band holds them leaves it as wide as it is. At an open end the rim is smoothed along
//! itself, where the same wave has `k = 1 - cos(h / r)`.
//!
//! `r` is the width of the vessel at the vertex (`super::super::widths`).

use std::ops::Deref;
use std::sync::Arc;

use crate::settings::Smoothing;
use crate::task::{Budget, Progress, Task};
use lumen_mesh::{Topology, TriMesh, Vec3};

/// By what the pass band is wider than the wave around the vessel needs: waves of half its length pass as well, so that what
/// changes along the vessel (an open end, a fork, a narrow place) does not make it swing.
const MARGIN: f64 = 4.0;
/// Largest part of a radius that an edge may be: beyond it a vessel has no shape to keep.
const COARSEST: f64 = 3.0;
/// Means with the neighbours that the pass bands are evened out by. Filters of other pass bands let even the longest waves
/// through by a hundredth more or less: what differs from vertex to vertex would be seen as roughness, and on `data/real` twice to five times as many triangles
/// run into others without.
const EVEN: usize = 16;
/// Vertices between two looks at the clock.
const VERTICES: usize = 4096;

/// The pass bands of `mesh`, worked out in slices; `M` and `T` are any pointers to a mesh and its topology.
pub struct LeastPassBands<M, T> {
    mesh: M,
    topology: T,
    /// Radius of the vessel at each vertex, in mm.
    widths: Arc<[f32]>,
    bands: Vec<f32>,
    /// Of the pass at work.
    evened: Vec<f32>,
    step: Step,
    next: usize,
}

#[derive(Clone, Copy, PartialEq)]
enum Step {
    Bands,
    Even(usize),
}

impl<M: Deref<Target = TriMesh>, T: Deref<Target = Topology>> LeastPassBands<M, T> {
    /// Of `mesh`, whose vessels have these `widths`, as radii in mm.
    pub fn new(mesh: M, topology: T, widths: Arc<[f32]>) -> Self {
        let count = widths.len();
        let (bands, evened) = (Vec::with_capacity(count), vec![0.0; count]);
        Self { mesh, topology, widths, bands, evened, step: Step::Bands, next: 0 }
    }

    fn at(&self, v: u32) -> Vec3 {
        self.mesh.positions[v as usize]
    }

    /// The next vertices of the step; whether the last step is done.
    fn advance_some(&mut self) -> bool {
        let count = self.widths.len();
        let end = count.min(self.next + VERTICES);
        match self.step {
            Step::Bands => {
                for v in self.next..end {
                    self.bands.push(self.band(v as u32));
                }
            }
            Step::Even(_) => {
                for v in self.next..end {
                    let around = self.topology.neighbours(v as u32);
                    let mean = around.iter().map(|&n| self.bands[n as usize]).sum::<f32>() / around.len().max(1) as f32;
                    self.evened[v] = (self.bands[v] + if around.is_empty() { self.bands[v] } else { mean }) / 2.0;
                }
            }
        }
        self.next = end;
        if end < count {
            return false;
        }
        self.next = 0;
        self.step = match self.step {
            Step::Bands => Step::Even(0),
            Step::Even(pass) => {
                std::mem::swap(&mut self.bands, &mut self.evened);
                if pass + 1 == EVEN {
                    return true;
                }
                Step::Even(pass + 1)
            }
        };
        false
    }

    /// The least pass band at `v`.
    fn band(&self, v: u32) -> f32 {
        let neighbours = self.topology.neighbours(v);
        let squares = neighbours.iter().map(|&n| f64::from(self.at(v).distance_squared(self.at(n))));
        let edge = (squares.sum::<f64>() / neighbours.len().max(1) as f64).sqrt();
        let ratio = (edge / f64::from(self.widths[v as usize])).min(COARSEST);
        let is_rim = self.topology.edge_uses(v).iter().any(|edge| edge.is_boundary());
        let k = if is_rim { 1.0 - libm::cos(ratio) } else { 1.0 - libm::j0(ratio) };
        // Where few vertices stand around a vessel, corners are all that could be smoothed away, and they are its calibre.
        (MARGIN * (1.0 + ratio * ratio) * k).min(*Smoothing::PASS_BAND.end()) as f32
    }
}

impl<M: Deref<Target = TriMesh>, T: Deref<Target = Topology>> Task for LeastPassBands<M, T> {
    type Output = Vec<f32>;

    fn advance(&mut self, budget: Budget) -> Progress<Vec<f32>> {
        while !self.advance_some() {
            if budget.is_spent() {
                return Progress::Working(match self.step {
                    Step::Bands => 0.0,
                    Step::Even(pass) => (1 + pass) as f32 / (1 + EVEN) as f32,
                });
            }
        }
        Progress::Done(std::mem::take(&mut self.bands))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::response::{edge_length, eigenvalue};
    use crate::widths::WidthTask;
    use lumen_mesh::shapes::{square, tube};

    fn bands(mesh: &TriMesh) -> Vec<f32> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let widths = WidthTask::new(mesh, &topology).finish();
        LeastPassBands::new(mesh, &topology, widths.into()).finish()
    }

    #[test]
    fn in_a_tube_it_is_that_of_the_wave_around_it() {
        for radius in [1.5, 3.0, 8.0] {
            let mesh = tube(48, 60, 60.0 * radius * 0.13, |_| radius);
            let k = eigenvalue(2.0 * std::f64::consts::PI * f64::from(radius), edge_length(&mesh));
            let found = bands(&mesh);
            // Away from the rims, whose waves are of another kind.
            let inside = &found[48 * 20..48 * 40];
            let (low, high) =
                inside.iter().fold((f32::MAX, 0.0f32), |(low, high), &band| (low.min(band), high.max(band)));
            assert!(f64::from(low) > 3.0 * k && f64::from(high) < 5.0 * k, "{radius}: {low} to {high}, the wave {k}");
        }
    }

    #[test]
    fn what_is_no_vessel_asks_for_nothing() {
        assert!(bands(&square(20, 10.0, 0.0)).iter().all(|&band| band == 0.0));
    }
}
