//! A pair along a straight change of the rod. It joins two places far from each other along the rod, so it is no part of the
//! band matrix: a search direction takes it in as a change of low rank ([`Coupling`]).

use crate::rod::{Coupling, Rod};

/// A pair along a straight change of the rod.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// The node at which the edge of each place begins, and the derivatives of the gap by it, its angle and the next node.
    pulls: [(usize, [f64; 7]); 2],
    /// What presses, in N; open where it is less than 0.
    force: f64,
    /// The penalty in N/mm.
    penalty: f64,
    /// By what the force changes on the whole search direction.
    change: f64,
    /// Whether the search direction was found with it.
    is_added: bool,
}

#[inline]
fn dot(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Link {
    /// A pair by the derivatives of its gap, what presses in N and the penalty in N/mm.
    pub(super) fn new(pulls: [(usize, [f64; 7]); 2], force: f64, penalty: f64) -> Self {
        Self { pulls, force, penalty, change: 0.0, is_added: false }
    }

    /// Adds what it presses with to the equations of the next search direction. Returns the stiffness that goes with it.
    pub(crate) fn add(&mut self, rod: &mut Rod) -> Option<Coupling> {
        self.is_added = self.force > 0.0;
        if !self.is_added {
            return None;
        }
        for (node, pull) in &self.pulls {
            rod.add_spring(*node, pull, -self.force, 0.0);
        }
        Some(Coupling { pulls: self.pulls, stiffness: self.penalty })
    }

    /// Notes how it changes along the search direction that was found.
    pub(crate) fn look_ahead(&mut self, rod: &Rod) {
        let moved: f64 = self.pulls.iter().map(|(node, pull)| dot(pull, rod.direction(*node))).sum();
        self.change = -self.penalty * moved;
    }

    /// The slope of its energy by the part of the direction, at a part.
    pub(crate) fn slope(&self, part: f64) -> f64 {
        (self.force + part * self.change).max(0.0) * self.change / self.penalty
    }

    /// By what the slope would change on the whole direction if it stayed as it was added.
    pub(crate) fn added(&self) -> f64 {
        if self.is_added { self.change * self.change / self.penalty } else { 0.0 }
    }

    /// What it changes by on the direction if it was added for it: node, derivative, force.
    pub(crate) fn changed(&self) -> impl Iterator<Item = (usize, [f64; 7], f64)> {
        let force = -self.change;
        self.is_added.then_some(self.pulls).into_iter().flatten().map(move |(node, pull)| (node, pull, force))
    }

    /// Goes a part of the direction. Returns whether it opened or closed there.
    pub(crate) fn go(&mut self, part: f64) -> bool {
        let before = self.force > 0.0;
        self.force += part * self.change;
        (self.force > 0.0) != before
    }
}
