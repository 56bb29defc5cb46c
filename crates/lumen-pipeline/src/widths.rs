//! How wide the vessel is at each vertex of its wall, as one radius that varies smoothly along the surface.
//!
//! The radius is the inner ball's at the vertex (`mesh::inner_ball`), as the median of its ring, several times over,
//! for on rough surfaces many vertices have bad normals. From a thin vessel it grows by no more than the way along the
//! surface: so it has no jumps, and a narrow place counts for the surface beside it. Where no wall of a piece faces
//! another the radius is infinite.

use std::ops::Deref;
use std::sync::Arc;

use super::narrowest::ring_median;
use super::shape::ShapeTask;
use super::task::{Budget, Progress, Task};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh};

/// By what the radius may grow from vertex to vertex: of the edge between them.
const SLOPE: f32 = 1.0;
/// Vertices between two looks at the clock.
const VERTICES: usize = 4096;
/// Medians that are taken of medians: what is left of a bad ball is two rings wide at most.
const MEDIANS: usize = 4;
/// Sweeps at most: each goes all the way in one direction.
const SWEEPS: usize = 12;

/// The radii of a surface in mm, found in slices; `M` and `T` are any pointers to a mesh and its topology.
pub(super) struct WidthTask<M, T> {
    mesh: M,
    topology: T,
    balls: ShapeTask<M, T>,
    /// Of the pass before.
    radii: Vec<f32>,
    widths: Vec<f32>,
    step: Step,
    next: usize,
    has_changed: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Step {
    Balls,
    Medians(usize),
    Sweep(usize),
    Done,
}

impl<M, T> WidthTask<M, T>
where
    M: Deref<Target = TriMesh> + Clone + Sync,
    T: Deref<Target = Topology> + Clone + Sync,
{
    /// Of `mesh`, whose adjacency is `topology`.
    pub(super) fn new(mesh: M, topology: T) -> Self {
        Self {
            balls: ShapeTask::radii_only(mesh.clone(), topology.clone()),
            mesh,
            topology,
            radii: Vec::new(),
            widths: Vec::new(),
            step: Step::Balls,
            next: 0,
            has_changed: false,
        }
    }

    /// Uses an index of the surface that is there already.
    #[must_use]
    pub(super) fn with_index(mut self, index: Option<Arc<SurfaceIndex>>) -> Self {
        if let Some(index) = index {
            self.balls = self.balls.with_index(self.mesh.clone(), index);
        }
        self
    }

    /// The index of the surface, once it is built.
    pub(super) fn index(&self) -> Option<&Arc<SurfaceIndex>> {
        self.balls.index()
    }

    /// The next vertices of a pass over all.
    fn advance_some(&mut self) {
        let count = self.radii.len();
        let end = count.min(self.next + VERTICES);
        if let Step::Sweep(sweep) = self.step {
            for i in self.next..end {
                self.relax(if sweep % 2 == 0 { i } else { count - 1 - i });
            }
        } else {
            let mut ring = Vec::new();
            for v in self.next..end {
                self.widths.push(ring_median(&self.topology, &self.radii, v as u32, &mut ring));
            }
        }
        self.next = end;
        if end < count {
            return;
        }
        self.next = 0;
        self.step = match self.step {
            Step::Medians(pass) if pass + 1 < MEDIANS => {
                self.radii = std::mem::take(&mut self.widths);
                self.widths.reserve_exact(count);
                Step::Medians(pass + 1)
            }
            Step::Medians(_) => Step::Sweep(0),
            Step::Sweep(sweep) if std::mem::take(&mut self.has_changed) && sweep + 1 < SWEEPS => Step::Sweep(sweep + 1),
            _ => Step::Done,
        };
    }

    /// Lowers the width at `v` to what its neighbours leave it.
    fn relax(&mut self, v: usize) {
        let p = self.mesh.positions[v];
        let reach = |&n: &u32| self.widths[n as usize] + SLOPE * p.distance(self.mesh.positions[n as usize]);
        let least = self.topology.neighbours(v as u32).iter().map(reach).fold(f32::INFINITY, f32::min);
        if least < self.widths[v] {
            self.widths[v] = least;
            self.has_changed = true;
        }
    }
}

impl<M, T> Task for WidthTask<M, T>
where
    M: Deref<Target = TriMesh> + Clone + Sync,
    T: Deref<Target = Topology> + Clone + Sync,
{
    type Output = Vec<f32>;

    fn advance(&mut self, budget: Budget) -> Progress<Vec<f32>> {
        loop {
            match self.step {
                Step::Balls => match self.balls.advance(budget) {
                    Progress::Working(fraction) => return Progress::Working(0.8 * fraction),
                    Progress::Done(measured) => {
                        self.radii = measured.balls.radii;
                        self.widths.reserve_exact(self.radii.len());
                        self.step = Step::Medians(0);
                    }
                },
                Step::Medians(_) | Step::Sweep(_) => self.advance_some(),
                Step::Done => return Progress::Done(std::mem::take(&mut self.widths)),
            }
            if self.step != Step::Done && budget.is_spent() {
                return Progress::Working(match self.step {
                    Step::Medians(pass) => 0.8 + 0.05 * pass as f32 / MEDIANS as f32,
                    Step::Sweep(sweep) => 0.85 + 0.15 * sweep as f32 / SWEEPS as f32,
                    Step::Balls | Step::Done => 0.8,
                });
            }
        }
    }
}
