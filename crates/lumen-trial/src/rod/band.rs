//! A symmetric positive definite band matrix, and its direct solution in linear time: `L D L^T` without pivoting
//! (Golub and Van Loan, "Matrix computations", section 4.3).

use glam::DMat3;

use super::bend::Blocks;

/// The matrix of a rod of `n` nodes has `4 n` rows: the coordinates of a node, then the angle of the edge that begins
/// there. A bend joins three nodes and two angles between them.
pub(super) const PER_NODE: usize = 4;

/// What a row has beside those of its node: the two nodes behind it.
type Row = [f64; 3 * PER_NODE];

/// The rows of a node.
type Block = [Row; PER_NODE];

/// The upper half of a band matrix, node by node: rows begin at the first of their node, so that they are whole vectors
/// side by side.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    /// Those of the matrix, and two of zeros, so that each has as many behind it.
    blocks: Vec<Block>,
}

impl Band {
    /// Makes all of it 0, for this many nodes.
    pub(super) fn reset(&mut self, nodes: usize) {
        self.blocks.clear();
        self.blocks.resize(nodes + 2, [[0.0; 3 * PER_NODE]; PER_NODE]);
    }

    /// Adds to the diagonal.
    #[inline]
    pub(super) fn add(&mut self, node: usize, row: usize, value: f64) {
        self.blocks[node][row][row] += value;
    }

    /// Adds `stiffness g g^T`, where `g` is by a node, its angle and the next node.
    #[inline]
    pub(super) fn add_square(&mut self, node: usize, g: &[f64; 7], stiffness: f64) {
        let Some([own, next]) = self.blocks[node..].first_chunk_mut() else { return };
        let pull: [f64; 8] = std::array::from_fn(|i| if i < 7 { g[i] * stiffness } else { 0.0 });
        for (row, &g) in own.iter_mut().zip(&g[..PER_NODE]) {
            for (entry, pull) in row.iter_mut().zip(&pull) {
                *entry += g * pull;
            }
        }
        for (row, &g) in next.iter_mut().zip(&g[PER_NODE..]) {
            for (entry, pull) in row.iter_mut().zip(&pull[PER_NODE..]) {
                *entry += g * pull;
            }
        }
    }

    /// Adds what the edge from a node to the next is.
    #[inline]
    pub(super) fn add_edge(&mut self, node: usize, stiffness: &DMat3) {
        let Some([own, next]) = self.blocks[node..].first_chunk_mut() else { return };
        for i in 0..3 {
            for j in 0..3 {
                let entry = stiffness.col(j)[i];
                own[i][j] += entry;
                next[i][j] += entry;
                own[i][PER_NODE + j] -= entry;
            }
        }
    }

    /// Adds what a bend is by its three nodes, from this one on, and two angles.
    #[inline]
    pub(super) fn add_bend(&mut self, node: usize, bend: &Blocks) {
        let Blocks { aa, ab, bb, mixed: [[a_by_a, a_by_b], [b_by_a, b_by_b]], angles: [angle_a, both, angle_b] } =
            *bend;
        let Some([own, next, last]) = self.blocks[node..].first_chunk_mut() else { return };
        // A node moves the edge behind it backwards, and the one before it forwards.
        let (before, middle, behind) = (ab - aa, aa - ab - ab.transpose() + bb, ab - bb);
        let (a_middle, b_middle) = (a_by_a - a_by_b, b_by_a - b_by_b);
        for i in 0..3 {
            for j in 0..3 {
                own[i][j] += aa.col(j)[i];
                own[i][4 + j] += before.col(j)[i];
                own[i][8 + j] -= ab.col(j)[i];
                next[i][j] += middle.col(j)[i];
                next[i][4 + j] += behind.col(j)[i];
                last[i][j] += bb.col(j)[i];
            }
            own[i][3] -= a_by_a[i];
            own[i][7] -= b_by_a[i];
            own[3][4 + i] += a_middle[i];
            own[3][8 + i] += a_by_b[i];
            next[i][3] += b_middle[i];
            next[3][4 + i] += b_by_b[i];
        }
        own[3][3] += angle_a;
        own[3][7] += both;
        next[3][3] += angle_b;
    }

    /// Fixes a row of a node to 0 whatever the right-hand side.
    pub(super) fn fix(&mut self, node: usize, row: usize) {
        for (back, block) in self.blocks[..=node].iter_mut().rev().take(3).enumerate() {
            block.iter_mut().for_each(|other| other[back * PER_NODE + row] = 0.0);
        }
        self.blocks[node][row] = [0.0; 3 * PER_NODE];
        self.blocks[node][row][row] = 1.0;
    }

    /// Factors the matrix in place and solves for a right-hand side. A pivot that is not positive, which only rounding can
    /// make, is replaced by a tiny one of its row. Returns whether there was none.
    pub(super) fn solve(&mut self, x: &mut Vec<f64>) -> bool {
        let rows = x.len();
        x.resize(rows + 2 * PER_NODE, 0.0);
        let mut is_definite = true;
        for (i, at) in (0..rows).step_by(PER_NODE).enumerate() {
            let Some([own, next, last]) = self.blocks[i..].first_chunk_mut() else { break };
            let Some(x) = x[at..].first_chunk_mut() else { break };
            is_definite &= eliminate(own, next, last, x);
        }
        self.substitute_back(x);
        x.truncate(rows);
        is_definite
    }

    /// Solves `L y = x` in place once the matrix is factored, where `x` is 0 before a node. Rows end with two nodes of
    /// zeros.
    pub(super) fn substitute(&self, from: usize, x: &mut [f64]) {
        for (block, at) in self.blocks[from..].iter().zip((from * PER_NODE..).step_by(PER_NODE)) {
            let Some(x) = x[at..].first_chunk_mut::<{ 3 * PER_NODE }>() else { break };
            let [l0, l1, l2, l3] = block;
            x[1] -= l0[1] * x[0];
            x[2] -= l0[2] * x[0] + l1[2] * x[1];
            x[3] -= l0[3] * x[0] + l1[3] * x[1] + l2[3] * x[2];
            let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
            for column in PER_NODE..3 * PER_NODE {
                x[column] -= (a * l0[column] + b * l1[column]) + (c * l2[column] + d * l3[column]);
            }
        }
    }

    /// The inverse of each pivot of the factored matrix.
    pub(super) fn pivots(&self) -> impl Iterator<Item = f64> {
        self.blocks.iter().flat_map(|block| [block[0][0], block[1][1], block[2][2], block[3][3]])
    }

    /// Solves `L^T y = x` in place once the matrix is factored. Rows end with two nodes of zeros.
    pub(super) fn substitute_back(&self, x: &mut [f64]) {
        let rows = x.len() - 2 * PER_NODE;
        for (i, at) in (0..rows).step_by(PER_NODE).enumerate().rev() {
            let (block, Some(x)) = (&self.blocks[i], x[at..].first_chunk_mut::<{ 3 * PER_NODE }>()) else { break };
            let behind = block.map(|row| dot::<8>(&row[PER_NODE..], &x[PER_NODE..]));
            x[3] -= behind[3];
            x[2] -= behind[2] + block[2][3] * x[3];
            x[1] -= behind[1] + block[1][3] * x[3] + block[1][2] * x[2];
            x[0] -= behind[0] + block[0][3] * x[3] + block[0][2] * x[2] + block[0][1] * x[1];
        }
    }

    /// An entry.
    #[cfg(test)]
    pub(super) fn entry(&self, row: usize, column: usize) -> f64 {
        let (row, column) = (row.min(column), row.max(column));
        let (node, row) = (row / PER_NODE, row % PER_NODE);
        self.blocks[node][row].get(column - node * PER_NODE).copied().unwrap_or(0.0)
    }
}

/// Takes the rows of a node out of those of the two behind it, and of the right-hand side; what is left of them is `L^T`.
#[inline]
fn eliminate(own: &mut Block, next: &mut Block, last: &mut Block, x: &mut [f64; 3 * PER_NODE]) -> bool {
    let mut is_definite = true;
    let mut pivot = |row: &mut Row, k: usize| {
        if row[k] <= f64::MIN_POSITIVE {
            is_definite = false;
            row[k] = row[k..].iter().fold(1e-12, |most, entry| f64::max(most, entry.abs()));
        }
        let inverse = 1.0 / row[k];
        (*row, row.map(|entry| entry * inverse), inverse)
    };
    let [r0, r1, r2, r3] = own;
    let (u0, mut l0, d0) = pivot(r0, 0);
    subtract::<0, 12>(r1, &u0, l0[1]);
    subtract::<2, 10>(r2, &u0, l0[2]);
    subtract::<2, 10>(r3, &u0, l0[3]);
    let (u1, mut l1, d1) = pivot(r1, 1);
    subtract::<2, 10>(r2, &u1, l1[2]);
    subtract::<2, 10>(r3, &u1, l1[3]);
    let (u2, mut l2, d2) = pivot(r2, 2);
    subtract::<2, 10>(r3, &u2, l2[3]);
    let (u3, mut l3, d3) = pivot(r3, 3);
    x[1] -= l0[1] * x[0];
    x[2] -= l0[2] * x[0] + l1[2] * x[1];
    x[3] -= l0[3] * x[0] + l1[3] * x[1] + l2[3] * x[2];
    let above = [&u0, &u1, &u2, &u3];
    let [n0, n1, n2, n3] = next;
    let parts = |column: usize| [l0[column], l1[column], l2[column], l3[column]];
    shifted::<0, 8, 4>(n0, above, parts(4));
    shifted::<0, 8, 4>(n1, above, parts(5));
    shifted::<2, 6, 4>(n2, above, parts(6));
    shifted::<2, 6, 4>(n3, above, parts(7));
    let [m0, m1, m2, _] = last;
    shifted::<0, 4, 8>(m0, above, parts(8));
    shifted::<0, 4, 8>(m1, above, parts(9));
    shifted::<2, 2, 8>(m2, above, parts(10));
    for column in PER_NODE..3 * PER_NODE {
        let [a, b, c, d] = parts(column);
        x[column] -= (a * x[0] + b * x[1]) + (c * x[2] + d * x[3]);
    }
    [x[0], x[1], x[2], x[3]] = [x[0] * d0, x[1] * d1, x[2] * d2, x[3] * d3];
    // The diagonal, which is 1, keeps what the pivots have become.
    (l0[0], l1[1], l2[2], l3[3]) = (d0, d1, d2, d3);
    *own = [l0, l1, l2, l3];
    is_definite
}

/// Takes a part of another row out of as many entries of a row from `FROM` on.
#[inline(always)]
fn subtract<const FROM: usize, const LANES: usize>(row: &mut Row, above: &Row, part: f64) {
    for k in FROM..FROM + LANES {
        row[k] -= part * above[k];
    }
}

/// Takes parts of four rows, `SHIFT` entries farther on, out of as many entries of a row from `FROM` on.
#[inline(always)]
fn shifted<const FROM: usize, const LANES: usize, const SHIFT: usize>(
    row: &mut Row,
    above: [&Row; 4],
    parts: [f64; 4],
) {
    for k in FROM..FROM + LANES {
        let product = |i: usize| parts[i] * above[i][SHIFT + k];
        row[k] -= (product(0) + product(1)) + (product(2) + product(3));
    }
}

/// The dot product of the first entries.
#[inline(always)]
fn dot<const LANES: usize>(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 2];
    for (a, b) in a[..LANES].chunks_exact(2).zip(b[..LANES].chunks_exact(2)) {
        lanes[0] += a[0] * b[0];
        lanes[1] += a[1] * b[1];
    }
    lanes[0] + lanes[1]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use lumen_mesh::split_mix::SplitMix64;

    #[test]
    fn a_solution_gives_the_right_hand_side_again() {
        let n = 44;
        let mut band = Band::default();
        band.reset(n / 4);
        // Sums of squares of random rows, and a little of the identity, are positive definite.
        let mut random = SplitMix64::new(1);
        let mut random = || random.unit() - 0.5;
        for node in 0..n / 4 - 2 {
            let mut random = || DVec3::from_array(std::array::from_fn(|_| random()));
            for _ in 0..3 {
                let (a, b, by_angle) = (random(), random(), random());
                let outer = |p: DVec3, q: DVec3| DMat3::from_cols(p * q.x, p * q.y, p * q.z);
                let mixed = [[a * by_angle.x, b * by_angle.x], [a * by_angle.y, b * by_angle.y]];
                let angles = [by_angle.x * by_angle.x, by_angle.x * by_angle.y, by_angle.y * by_angle.y];
                band.add_bend(node, &Blocks { aa: outer(a, a), ab: outer(a, b), bb: outer(b, b), mixed, angles });
            }
            let ends = [random(), random(), random()];
            let pull = std::array::from_fn(|i| ends[i / 3][i % 3]);
            band.add_square(node, &pull, 2.0);
        }
        (0..n).for_each(|i| band.add(i / 4, i % 4, 0.01));
        band.fix(1, 1);
        let expected: Vec<f64> = (0..n).map(|i| if i == 5 { 0.0 } else { random() }).collect();
        let mut x: Vec<f64> = (0..n).map(|i| (0..n).map(|j| band.entry(i, j) * expected[j]).sum()).collect();
        assert!(band.solve(&mut x));
        for (i, (x, expected)) in x.iter().zip(&expected).enumerate() {
            assert!((x - expected).abs() < 1e-9, "{i}: {x} for {expected}");
        }
    }
}
