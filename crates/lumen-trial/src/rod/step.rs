//! A time step of a rod: implicit (backward Euler), as the least of a potential. Elastic energy, loads, and what stands for
//! inertia and drag.

use glam::DVec3;

use super::band::PER_NODE;
use super::hessian::Hessian;
use super::section::Section;
use super::state::Rod;

impl Rod {
    /// Sets up the equations of a step of `dt` seconds at the present positions; an infinite `dt` asks for rest.
    /// `damping` is artificial: drag beyond that of the nodes, in N s/mm each.
    pub fn assemble(&mut self, dt: f64, damping: f64, hessian: Hessian) {
        self.clear_equations();
        self.add_inertia(dt, damping);
        for &(node, force) in &self.forces {
            for axis in 0..3 {
                self.gradient[node * PER_NODE + axis] -= force[axis];
            }
        }
        for &(edge, moment) in &self.moments {
            self.gradient[edge * PER_NODE + 3] -= moment;
        }
        self.add_elasticity(hessian);
    }

    fn add_inertia(&mut self, dt: f64, damping: f64) {
        let inverse = if dt.is_finite() { 1.0 / dt } else { 0.0 };
        for i in 0..self.len() {
            let Section { mass, drag, .. } = self.sections[i];
            let (inertia, drag) = (mass * inverse * inverse, (drag + damping) * inverse);
            let moved = self.positions[i] - self.start[i];
            let way = if dt.is_finite() { self.velocities[i] * dt } else { DVec3::ZERO };
            let force = (moved - way) * inertia + moved * drag;
            for axis in 0..3 {
                self.gradient[i * PER_NODE + axis] += force[axis];
                self.band.add(i, axis, inertia + drag);
            }
        }
        // The last node has no edge.
        self.band.add(self.len() - 1, 3, 1.0);
    }

    /// What a step makes least: elastic energy, loads, and what stands for inertia and drag, in N mm.
    pub fn potential(&self, dt: f64, damping: f64) -> f64 {
        let inverse = if dt.is_finite() { 1.0 / dt } else { 0.0 };
        let motion = |i: usize| {
            let Section { mass, drag, .. } = self.sections[i];
            let moved = self.positions[i] - self.start[i];
            let way = if dt.is_finite() { self.velocities[i] * dt } else { DVec3::ZERO };
            0.5 * (mass * inverse * inverse * (moved - way).length_squared()
                + (drag + damping) * inverse * moved.length_squared())
        };
        let pulled: f64 = self.forces.iter().map(|&(node, force)| force.dot(self.positions[node])).sum();
        let turned: f64 = self.moments.iter().map(|&(edge, moment)| moment * self.spins[edge]).sum();
        self.energy() + (0..self.len()).map(motion).sum::<f64>() - pulled - turned
    }

    /// Goes on from the start of the step for `dt` seconds as in the step before; what is fixed stays.
    pub fn predict(&mut self, dt: f64) {
        for i in (0..self.len()).filter(|&i| !self.fixed[i].position) {
            self.positions[i] = self.start[i] + self.velocities[i] * dt;
        }
        for i in (0..self.len()).filter(|&i| !self.fixed[i].angle) {
            self.spins[i] = self.turns[i] * dt;
        }
        self.refresh();
    }

    /// Ends a time step: what is now becomes the start of the next.
    pub fn finish(&mut self, dt: f64) {
        for i in 0..self.len() {
            let moved = self.positions[i] - self.start[i];
            self.velocities[i] = if dt.is_finite() { moved / dt } else { DVec3::ZERO };
        }
        for i in 1..self.len() - 1 {
            self.twists[i] = self.twist(i);
        }
        for (frame, edge) in self.frames.iter_mut().zip(&self.edges) {
            // Rounding adds up over many steps.
            *frame = [edge.tangent, edge.m1.reject_from_normalized(edge.tangent).normalize_or(edge.m1)];
        }
        self.start.clone_from(&self.positions);
        for (turn, spin) in self.turns.iter_mut().zip(&self.spins) {
            *turn = if dt.is_finite() { spin / dt } else { 0.0 };
        }
        self.spins.fill(0.0);
        self.refresh();
    }

    /// Goes back to the start of the step, where everything stands still.
    pub fn undo(&mut self) {
        self.positions.clone_from(&self.start);
        self.velocities.fill(DVec3::ZERO);
        self.turns.fill(0.0);
        self.spins.fill(0.0);
        self.refresh();
    }
}
