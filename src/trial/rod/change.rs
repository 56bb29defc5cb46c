//! A change of a rod, found way by way in the quadratic model of what was assembled.

use std::ops::Range;

use glam::DVec3;

use super::band::PER_NODE;
use super::{Hessian, Rod};

/// The farthest that one way moves a node, in mm.
const MOST_WAY: f64 = 1.0;
/// The largest turn of an edge about its tangent in one way, in radians.
const MOST_SPIN: f64 = 0.5;

/// A way on, as [`Rod::solve`] finds it.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// The part of it that is gone at most, as it may be long.
    pub part: f64,
    /// The largest move of a node in all of it, in mm; infinite when there is no answer.
    pub moved: f64,
    /// The slope of the potential along it, in N mm.
    pub slope: f64,
}

impl Rod {
    /// Makes what was assembled the model in which a change is sought, which begins at none.
    pub fn begin_change(&mut self) {
        std::mem::swap(&mut self.model, &mut self.band);
        self.residual.clone_from(&self.gradient);
        self.change.clear();
        self.change.resize(self.gradient.len(), 0.0);
        self.base.0.clone_from(&self.positions);
        self.base.1.clone_from(&self.spins);
    }

    /// Sets up the model's equations at the change so far, for springs to be added.
    pub fn begin_way(&mut self) {
        self.band.clone_from(&self.model);
        self.gradient.clone_from(&self.residual);
    }

    /// Solves the equations for the way on from the change so far. Returns the part of it that is gone at most, as it may
    /// be long, the largest move of a node in it in mm, and the slope of the potential along it; an infinite move when
    /// there is no answer. `None` when the matrix is not positive definite, which only that of [`Hessian::Safe`] always is.
    pub fn solve(&mut self, hessian: Hessian) -> Option<Way> {
        self.way.clear();
        self.way.extend(self.gradient.iter().map(|g| -g));
        for (i, held) in self.held.iter().enumerate() {
            let axes: Range<usize> = if held.position { 0..3 } else { 0..0 };
            for row in axes.chain(held.angle.then_some(3)) {
                self.band.hold(i, row);
                self.way[i * PER_NODE + row] = 0.0;
            }
        }
        if !self.band.solve(&mut self.way) && hessian != Hessian::Safe {
            return None;
        }
        let mut largest = 0.0f64;
        let mut part = 1.0f64;
        for way in self.way.chunks_exact(PER_NODE) {
            let (moved, spin) = (DVec3::from_slice(way).length(), way[3].abs());
            if !(moved.is_finite() && spin.is_finite()) {
                return Some(Way { part: 0.0, moved: f64::INFINITY, slope: 0.0 });
            }
            largest = largest.max(moved);
            part = part.min(MOST_WAY / moved.max(MOST_WAY)).min(MOST_SPIN / spin.max(MOST_SPIN));
        }
        let slope = self.way.iter().zip(&self.gradient).map(|(way, gradient)| way * gradient).sum();
        Some(Way { part, moved: largest, slope })
    }

    /// The way of a node, of the angle of the edge that begins there, and of the next node.
    pub fn way(&self, node: usize) -> &[f64; 7] {
        self.way[node * PER_NODE..].first_chunk().unwrap_or(&[0.0; 7])
    }

    /// The change so far, of the same.
    pub fn change(&self, node: usize) -> &[f64; 7] {
        self.change[node * PER_NODE..].first_chunk().unwrap_or(&[0.0; 7])
    }

    /// Goes this part of the way in the model. `springs` are those that were added for it: node, derivative, and by
    /// what each changes its force on the whole way.
    pub fn go(&mut self, part: f64, springs: impl Iterator<Item = (usize, [f64; 7], f64)>) {
        for (change, way) in self.change.iter_mut().zip(&self.way) {
            *change += part * way;
        }
        // On the whole way the model with its springs comes to rest.
        for (residual, gradient) in self.residual.iter_mut().zip(&self.gradient) {
            *residual -= part * gradient;
        }
        for (node, pull, force) in springs {
            for (residual, pull) in self.residual[node * PER_NODE..].iter_mut().zip(&pull) {
                *residual -= part * force * pull;
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
