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
