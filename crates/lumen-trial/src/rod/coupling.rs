//! Springs between places far from each other along the rod: a change of low rank of the band matrix A, solved by its Schur
//! complement (Woodbury 1950; Golub and Van Loan, "Matrix computations", section 2.1.4).
//!
//! ```text
//! (A + G K G^T) x = b:   (K^-1 + G^T A^-1 G) z = G^T A^-1 b,   x = A^-1 (b - G z)
//! ```
//!
//! with a column of G for each spring: its derivative by the nodes, and its stiffness in K. `A = L D L^T` is factored anyway,
//! so `G^T A^-1 G` takes half a solution for each spring.

use super::band::PER_NODE;
use super::state::Rod;

/// A spring between two places of a rod.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coupling {
    /// The node at which the edge of each place begins, and derivatives by that node, its angle and the next node.
    pub(crate) pulls: [(usize, [f64; 7]); 2],
    /// N/mm.
    pub(crate) stiffness: f64,
}

/// Working memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Coupled {
    /// `L^-1 G`, spring by spring, its rows by the roots of D.
    halves: Vec<f64>,
    /// The roots of `D^-1`.
    roots: Vec<f64>,
    /// The lower half of the complement, row by row, and its factor.
    complement: Vec<f64>,
    /// `G^T A^-1 b`, then z.
    forces: Vec<f64>,
    /// `G z`, then what that changes.
    change: Vec<f64>,
}

/// The dot product in four lanes.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 4];
    for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        for (lane, (a, b)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += a * b;
        }
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

impl Rod {
    /// The derivatives of a spring, without those of what is fixed: row and value.
    fn pulls(&self, coupling: &Coupling) -> impl Iterator<Item = (usize, f64)> {
        coupling.pulls.into_iter().flat_map(move |(node, pull)| {
            let free = move |&(i, _): &(usize, f64)| {
                let fixed = self.fixed.get(node + i / PER_NODE).copied().unwrap_or_default();
                if i == 3 { !fixed.angle } else { !fixed.position }
            };
            pull.into_iter().enumerate().filter(free).map(move |(i, pull)| (node * PER_NODE + i, pull))
        })
    }

    /// Changes the direction that was solved for without these springs to the one with them.
    pub(super) fn couple(&mut self, couplings: &[Coupling]) {
        let mut memory = std::mem::take(&mut self.coupled);
        let Coupled { halves, roots, complement, forces, change } = &mut memory;
        let rows = self.direction.len() + 2 * PER_NODE;
        roots.clear();
        roots.extend(self.band.pivots().map(f64::sqrt));
        halves.clear();
        halves.resize(couplings.len() * rows, 0.0);
        let begin = |coupling: &Coupling| coupling.pulls[0].0.min(coupling.pulls[1].0);
        for (coupling, half) in couplings.iter().zip(halves.chunks_exact_mut(rows)) {
            self.pulls(coupling).for_each(|(row, pull)| half[row] += pull);
            self.band.substitute(begin(coupling), half);
            half.iter_mut().zip(roots.iter()).for_each(|(half, root)| *half *= root);
        }
        forces.clear();
        let force = |coupling| self.pulls(coupling).map(|(row, pull)| pull * self.direction[row]).sum::<f64>();
        forces.extend(couplings.iter().map(force));
        // By Cholesky's factor, row by row.
        complement.clear();
        for (i, (coupling, half)) in couplings.iter().zip(halves.chunks_exact(rows)).enumerate() {
            let start = complement.len();
            for (j, (other, other_half)) in couplings[..=i].iter().zip(halves.chunks_exact(rows)).enumerate() {
                let from = begin(coupling).max(begin(other)) * PER_NODE;
                let mut entry = dot(&half[from..], &other_half[from..]);
                let above = j * (j + 1) / 2;
                for k in 0..j {
                    entry -= complement[start + k] * complement[above + k];
                }
                complement.push(if j < i {
                    entry / complement[above + j]
                } else {
                    // Rounding cannot make it less than what the spring gives way by.
                    (entry + 1.0 / coupling.stiffness).max(1e-3 / coupling.stiffness).sqrt()
                });
            }
            for k in 0..i {
                forces[i] -= complement[start + k] * forces[k];
            }
            forces[i] /= complement[start + i];
        }
        for i in (0..couplings.len()).rev() {
            for k in i + 1..couplings.len() {
                forces[i] -= complement[k * (k + 1) / 2 + i] * forces[k];
            }
            forces[i] /= complement[i * (i + 1) / 2 + i];
        }
        change.clear();
        change.resize(rows, 0.0);
        for (coupling, force) in couplings.iter().zip(forces.iter()) {
            self.pulls(coupling).for_each(|(row, pull)| change[row] += force * pull);
        }
        self.band.substitute(0, change);
        change.iter_mut().zip(roots.iter()).for_each(|(change, root)| *change *= root * root);
        self.band.substitute_back(change);
        self.direction.iter_mut().zip(change.iter()).for_each(|(way, change)| *way -= change);
        self.coupled = memory;
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::rod::{Fixed, Hessian, Section};
    use lumen_mesh::split_mix::SplitMix64;

    #[test]
    fn a_direction_solves_the_equations_with_the_springs_in_them() {
        let mut random = SplitMix64::new(1);
        let mut random = || random.unit() - 0.5;
        let section = Section {
            length: 1.0,
            cell: 1.0,
            ei: 2.0,
            gj: 1.0,
            ea: 50.0,
            mass: 1e-9,
            drag: 1e-6,
            ..Section::default()
        };
        let positions = (0..30).map(|i| DVec3::new(f64::from(i), 0.3 * random(), 0.3 * random())).collect();
        let mut rod = Rod::new(positions, vec![section; 30], DVec3::Y);
        (28..30).for_each(|i| rod.fixed[i] = Fixed { position: true, angle: true });
        rod.forces = (0..28).map(|i| (i, DVec3::new(random(), random(), random()))).collect();
        rod.assemble(0.002, 0.0, Hessian::Safe);
        // The last two hardly differ, and the first holds what is fixed, too.
        let mut couplings: Vec<Coupling> = [[2, 28], [5, 20], [11, 6], [14, 27], [14, 27]]
            .map(|nodes| Coupling {
                pulls: nodes.map(|node| (node, std::array::from_fn(|i| if i == 3 { 0.0 } else { random() }))),
                stiffness: 4.0,
            })
            .to_vec();
        couplings[4].pulls = couplings[3].pulls;
        couplings[4].stiffness = 100.0;
        let rows = rod.len() * PER_NODE;
        let is_fixed = |row: usize| row >= 28 * PER_NODE;
        rod.begin_change();
        rod.begin_direction();
        let entries: Vec<f64> = (0..rows * rows).map(|entry| rod.band.entry(entry / rows, entry % rows)).collect();
        rod.solve_coupled(Hessian::Safe, &couplings).unwrap();
        for row in (0..rows).filter(|&row| !is_fixed(row)) {
            let mut sum: f64 = (0..rows).map(|column| entries[row * rows + column] * rod.direction[column]).sum();
            for coupling in &couplings {
                let moved: f64 = rod.pulls(coupling).map(|(row, pull)| pull * rod.direction[row]).sum();
                let pull: f64 = rod.pulls(coupling).filter(|pull| pull.0 == row).map(|(_, pull)| pull).sum();
                sum += coupling.stiffness * pull * moved;
            }
            assert!((sum + rod.gradient[row]).abs() < 1e-9, "row {row}: {sum} for {}", -rod.gradient[row]);
        }
        assert!((28 * PER_NODE..rows).all(|row| rod.direction[row] == 0.0));
    }
}
