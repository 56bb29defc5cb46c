//! The elastic energy of a rod, and its first and second derivatives: the equations.

use glam::{DMat3, DVec3};

use super::band::PER_NODE;
use super::bend::{Blocks, Slopes, curvature_slopes};
use super::frame::Strain;
use super::hessian::Hessian;
use super::section::Section;
use super::state::Rod;

impl Rod {
    /// Elastic energy in N mm.
    pub fn energy(&self) -> f64 {
        let stretch = |i: usize| {
            let section = &self.sections[i];
            let strain = self.edges[i].length / section.length - 1.0;
            0.5 * section.ea * section.length * strain * strain
        };
        let bend = |i: usize| {
            let section = &self.sections[i];
            let [r1, r2] = section.rest;
            let Strain { towards, across, twist, squared, .. } = self.strains[i];
            let bend = squared - 2.0 * (r1 * towards + r2 * across) + r1 * r1 + r2 * r2;
            0.5 / section.cell * (section.ei * bend + section.gj * twist * twist)
        };
        (0..self.len() - 1).map(stretch).sum::<f64>() + (1..self.len() - 1).map(bend).sum::<f64>()
    }

    /// Begins the equations anew: no energy yet.
    pub(super) fn clear_equations(&mut self) {
        let rows = self.len() * PER_NODE;
        self.band.reset(self.positions.len());
        self.gradient.clear();
        self.gradient.resize(rows, 0.0);
    }

    /// Works out the elastic part of the gradient anew from node `first + 2` on, for [`Self::reaction_force`] and
    /// [`Self::reaction_moment`] there.
    pub fn assemble_from(&mut self, first: usize) {
        self.clear_equations();
        (first..self.edges.len()).for_each(|i| self.add_stretch(i, Hessian::Safe));
        (first.max(1)..self.edges.len()).for_each(|i| self.add_bend(i, Hessian::Safe));
    }

    /// Adds the elastic energy to the equations.
    pub(super) fn add_elasticity(&mut self, hessian: Hessian) {
        (0..self.edges.len()).for_each(|i| self.add_stretch(i, hessian));
        (1..self.edges.len()).for_each(|i| self.add_bend(i, hessian));
    }

    fn add_stretch(&mut self, i: usize, hessian: Hessian) {
        let Section { length, ea, .. } = self.sections[i];
        let edge = self.edges[i];
        let tension = ea * (edge.length / length - 1.0);
        let t = edge.tangent;
        let first = i * PER_NODE;
        let pull = t * tension;
        for (axis, pull) in pull.to_array().into_iter().enumerate() {
            self.gradient[first + axis] -= pull;
            self.gradient[first + PER_NODE + axis] += pull;
        }
        // Under tension it is stiff across, too, and under pressure it gives way.
        let across = if tension > 0.0 || hessian != Hessian::Safe { tension / edge.length } else { 0.0 };
        let along = t * (ea / length - across);
        let stiffness = DMat3::from_cols(along * t.x, along * t.y, along * t.z);
        self.band.add_edge(i, &(stiffness + DMat3::from_diagonal(DVec3::splat(across))));
    }

    fn add_bend(&mut self, i: usize, hessian: Hessian) {
        let (section, strain) = (self.sections[i], self.strains[i]);
        let (a, b) = (self.edges[i - 1], self.edges[i]);
        let slopes = Slopes::new(&a, &b, &strain);
        let (bend, twist) = (section.ei / section.cell, section.gj / section.cell * strain.twist);
        let mut by_edges = [0, 1].map(|e| slopes.bent[e] * bend + slopes.twisted[e] * twist);
        let mut by_angles = [-twist, twist];
        if section.rest != [0.0; 2] {
            for ((by_edge, by_angle), rest) in curvature_slopes(&a, &b, &strain).into_iter().zip(section.rest) {
                by_edges = [0, 1].map(|e| by_edges[e] - by_edge[e] * (bend * rest));
                by_angles = [0, 1].map(|e| by_angles[e] - by_angle[e] * (bend * rest));
            }
        }
        let first = (i - 1) * PER_NODE;
        let [before, behind] = by_edges;
        let middle = before - behind;
        let [angle_a, angle_b] = by_angles;
        let pulls = [
            -before.x, -before.y, -before.z, angle_a, middle.x, middle.y, middle.z, angle_b, behind.x, behind.y,
            behind.z,
        ];
        for (entry, pull) in self.gradient[first..].iter_mut().zip(pulls) {
            *entry += pull;
        }
        self.band.add_bend(i - 1, &Blocks::new(&a, &b, &section, &strain, &slopes, hessian));
    }

    /// Adds a spring to the equations: `pull` is its derivative by positions and angle of node `node` and by the position
    /// of the next, `force` what it pulls with along that, `stiffness` its stiffness.
    pub fn add_spring(&mut self, node: usize, pull: &[f64; 7], force: f64, stiffness: f64) {
        let first = node * PER_NODE;
        for (entry, pull) in self.gradient[first..].iter_mut().zip(pull) {
            *entry += force * pull;
        }
        self.band.add_square(node, pull, stiffness);
    }

    /// The reaction of a fixed node: what it takes to keep it where it is, in N, as the gradient of all that was assembled.
    pub fn reaction_force(&self, node: usize) -> DVec3 {
        DVec3::from_slice(&self.gradient[node * PER_NODE..node * PER_NODE + 3])
    }

    /// The reaction of a fixed angle: the moment that it takes to keep an edge's frame, in N mm about the tangent.
    pub fn reaction_moment(&self, edge: usize) -> f64 {
        self.gradient[edge * PER_NODE + 3]
    }
}
