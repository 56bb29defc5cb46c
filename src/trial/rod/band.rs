//! A symmetric positive definite band matrix, and its direct solution in linear time: `L D L^T` without pivoting
//! (Golub and Van Loan, "Matrix computations", section 4.3).

/// Entries beside the diagonal: a bend joins three nodes of three coordinates and two angles between them.
pub(super) const HALF: usize = 10;

/// The matrix of a rod of `n` nodes has `4 n` rows: the coordinates of a node, then the angle of the edge that begins
/// there.
pub(super) const PER_NODE: usize = 4;

/// A row from its diagonal on; one lane more, so that rows are a whole number of vectors.
type Row = [f64; HALF + 2];

/// The upper half of a band matrix.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    rows: Vec<Row>,
}

impl Band {
    /// Makes all of it 0, with this many rows.
    pub(super) fn reset(&mut self, rows: usize) {
        self.rows.clear();
        self.rows.resize(rows, [0.0; HALF + 2]);
    }

    /// Adds to one entry; `row <= column <= row + HALF`.
    #[inline]
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column - row] += value;
    }

    /// Adds `stiffness g g^T`, where `g` begins at row `first`.
    #[inline]
    pub(super) fn add_square<const N: usize>(&mut self, first: usize, g: &[f64; N], stiffness: f64) {
        for (i, &a) in g.iter().enumerate() {
            let (row, a) = (&mut self.rows[first + i], a * stiffness);
            for (entry, &b) in row.iter_mut().zip(&g[i..]) {
                *entry += a * b;
            }
        }
    }

    /// Holds a row to 0 whatever the right-hand side.
    pub(super) fn hold(&mut self, row: usize) {
        for back in 1..=HALF.min(row) {
            self.rows[row - back][back] = 0.0;
        }
        self.rows[row] = [0.0; HALF + 2];
        self.rows[row][0] = 1.0;
    }

    /// Factors the matrix in place. A pivot that is not positive, which only rounding can make, is replaced by a tiny
    /// one of its row. Returns whether there was none.
    pub(super) fn factor(&mut self) -> bool {
        let mut is_definite = true;
        for i in 0..self.rows.len() {
            let (done, rest) = self.rows.split_at_mut(i + 1);
            let pivot_row = &mut done[i];
            if pivot_row[0] <= f64::MIN_POSITIVE {
                is_definite = false;
                pivot_row[0] = pivot_row.iter().fold(1e-12, |most, entry| f64::max(most, entry.abs()));
            }
            let inverse = 1.0 / pivot_row[0];
            let pivot_row = *pivot_row;
            for (r, row) in rest.iter_mut().enumerate().take(HALF) {
                let part = pivot_row[r + 1] * inverse;
                if part == 0.0 {
                    continue;
                }
                for (entry, &above) in row.iter_mut().zip(&pivot_row[r + 1..=HALF]) {
                    *entry -= part * above;
                }
            }
            // From here on the row is that of L^T, but for the diagonal, which stays D.
            for entry in &mut done[i][1..] {
                *entry *= inverse;
            }
        }
        is_definite
    }

    /// Solves for a right-hand side, in place; after [`Self::factor`].
    pub(super) fn solve(&self, x: &mut [f64]) {
        let n = self.rows.len();
        for i in 0..n {
            let value = x[i];
            for (entry, &part) in x[i + 1..].iter_mut().zip(&self.rows[i][1..=HALF]) {
                *entry -= part * value;
            }
            x[i] = value / self.rows[i][0];
        }
        for i in (0..n).rev() {
            let sum: f64 = x[i + 1..].iter().zip(&self.rows[i][1..=HALF]).map(|(&x, &part)| part * x).sum();
            x[i] -= sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_gives_the_right_hand_side_again() {
        let n = 43;
        let mut band = Band::default();
        band.reset(n);
        // Sums of squares of random rows, and a little of the identity, are positive definite.
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        };
        for first in 0..n - HALF {
            let g: [f64; HALF + 1] = std::array::from_fn(|_| random());
            band.add_square(first, &g, 3.0);
        }
        (0..n).for_each(|i| band.add(i, i, 0.01));
        band.hold(5);
        let full = |band: &Band, i: usize, j: usize| {
            let (a, b) = (i.min(j), i.max(j));
            if b - a <= HALF { band.rows[a][b - a] } else { 0.0 }
        };
        let expected: Vec<f64> = (0..n).map(|i| if i == 5 { 0.0 } else { random() }).collect();
        let mut x: Vec<f64> = (0..n).map(|i| (0..n).map(|j| full(&band, i, j) * expected[j]).sum()).collect();
        assert!(band.factor());
        band.solve(&mut x);
        for (i, (x, expected)) in x.iter().zip(&expected).enumerate() {
            assert!((x - expected).abs() < 1e-9, "{i}: {x} for {expected}");
        }
    }
}
