//! A change of a rod, found search direction by search direction in the quadratic model of what was assembled.

use std::ops::Range;

use glam::DVec3;

use super::band::PER_NODE;
use super::coupling::Coupling;
use super::hessian::Hessian;
use super::state::Rod;

/// The farthest that one search direction moves a node, in mm.
const MAX_MOVE: f64 = 1.0;
/// The largest turn of an edge about its tangent in one search direction, in radians.
const MAX_SPIN: f64 = 0.5;

/// A search direction, as [`Rod::solve`] finds it.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// The part of it that is gone at most, as it may be long.
    pub most: f64,
    /// The largest move of a node in all of it, in mm; infinite when there is no answer.
    pub moved: f64,
    /// The slope of the potential along it, in N mm.
    pub slope: f64,
}

impl Rod {
    /// Makes what was assembled the model in which a change is sought, which begins at none.
    pub fn begin_change(&mut self) {
        std::mem::swap(&mut self.model, &mut self.band);
        self.model_gradient.clone_from(&self.gradient);
        self.change.clear();
        self.change.resize(self.gradient.len(), 0.0);
        self.base.0.clone_from(&self.positions);
        self.base.1.clone_from(&self.spins);
    }

    /// Sets up the model's equations at the change so far, for springs to be added.
    pub fn begin_direction(&mut self) {
        self.band.clone_from(&self.model);
        self.gradient.clone_from(&self.model_gradient);
    }

    /// Solves the equations for the search direction on from the change so far; its move is infinite when there is no
    /// answer. `None` when the matrix is not positive definite, which only that of [`Hessian::Safe`] always is.
    pub fn solve(&mut self, hessian: Hessian) -> Option<Direction> {
        self.solve_coupled(hessian, &[])
    }

    /// The same with springs between far places of the rod, whose forces have been added.
    pub(crate) fn solve_coupled(&mut self, hessian: Hessian, couplings: &[Coupling]) -> Option<Direction> {
        self.direction.clear();
        self.direction.extend(self.gradient.iter().map(|g| -g));
        for (i, fixed) in self.fixed.iter().enumerate() {
            let axes: Range<usize> = if fixed.position { 0..3 } else { 0..0 };
            for row in axes.chain(fixed.angle.then_some(3)) {
                self.band.fix(i, row);
                self.direction[i * PER_NODE + row] = 0.0;
            }
        }
        if !self.band.solve(&mut self.direction) && hessian != Hessian::Safe {
            return None;
        }
        if !couplings.is_empty() {
            self.couple(couplings);
        }
        let mut largest = 0.0f64;
        let mut most = 1.0f64;
        for way in self.direction.chunks_exact(PER_NODE) {
            let (moved, spin) = (DVec3::from_slice(way).length(), way[3].abs());
            if !(moved.is_finite() && spin.is_finite()) {
                return Some(Direction { most: 0.0, moved: f64::INFINITY, slope: 0.0 });
            }
            largest = largest.max(moved);
            most = most.min(MAX_MOVE / moved.max(MAX_MOVE)).min(MAX_SPIN / spin.max(MAX_SPIN));
        }
        let slope = self.direction.iter().zip(&self.gradient).map(|(way, gradient)| way * gradient).sum();
        Some(Direction { most, moved: largest, slope })
    }

    /// The search direction of a node, of the angle of the edge that begins there, and of the next node.
    pub fn direction(&self, node: usize) -> &[f64; 7] {
        self.direction[node * PER_NODE..].first_chunk().unwrap_or(&[0.0; 7])
    }

    /// The change so far, of the same.
    pub fn change(&self, node: usize) -> &[f64; 7] {
        self.change[node * PER_NODE..].first_chunk().unwrap_or(&[0.0; 7])
    }

    /// Goes this part of the search direction in the model. `springs` are those that were added for it: node, derivative,
    /// and by what each changes its force on the whole of it.
    pub fn go(&mut self, part: f64, springs: impl Iterator<Item = (usize, [f64; 7], f64)>) {
        for (change, way) in self.change.iter_mut().zip(&self.direction) {
            *change += part * way;
        }
        // On the whole of it the model with its springs comes to rest.
        for (model, gradient) in self.model_gradient.iter_mut().zip(&self.gradient) {
            *model -= part * gradient;
        }
        for (node, pull, force) in springs {
            for (model, pull) in self.model_gradient[node * PER_NODE..].iter_mut().zip(&pull) {
                *model -= part * force * pull;
            }
        }
    }

    /// The largest move of a node in the change, in mm.
    pub fn largest_move(&self) -> f64 {
        self.change.chunks_exact(PER_NODE).map(|change| DVec3::from_slice(change).length()).fold(0.0, f64::max)
    }

    /// Goes this part of the change that was found last.
    pub fn advance(&mut self, part: f64) {
        for (i, change) in self.change.chunks_exact(PER_NODE).enumerate() {
            self.positions[i] = self.base.0[i] + DVec3::from_slice(change) * part;
            self.spins[i] = self.base.1[i] + change[3] * part;
        }
        self.refresh();
    }
}
