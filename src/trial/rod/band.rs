//! A symmetric positive definite band matrix, and its direct solution in linear time: `L D L^T` without pivoting
//! (Golub and Van Loan, "Matrix computations", section 4.3).

use super::bend::Blocks;

/// Entries beside the diagonal: a bend joins three nodes of three coordinates and two angles between them.
pub(super) const HALF: usize = 10;

/// The matrix of a rod of `n` nodes has `4 n` rows: the coordinates of a node, then the angle of the edge that begins
/// there.
pub(super) const PER_NODE: usize = 4;

/// A row from its diagonal on; one lane more, always 0, so that rows are a whole number of vectors.
type Row = [f64; HALF + 2];

/// The upper half of a band matrix.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    /// Those of the matrix, and `HALF` of zeros, so that each has as many below it.
    rows: Vec<Row>,
}

impl Band {
    /// Makes all of it 0, with this many rows.
    pub(super) fn reset(&mut self, rows: usize) {
        self.rows.clear();
        self.rows.resize(rows + HALF, [0.0; HALF + 2]);
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

    /// Adds what a bend is by its three nodes and two angles; the first coordinate is row `first`.
    #[inline]
    pub(super) fn add_blocks(&mut self, first: usize, blocks: &Blocks) {
        let Blocks { aa, ab, bb, mixed: [[a_by_a, a_by_b], [b_by_a, b_by_b]], angles: [angle_a, both, angle_b] } = *blocks;
        let Some(rows) = self.rows[first..].first_chunk_mut::<{ HALF + 1 }>() else { return };
        // A node moves the edge behind it backwards, and the one before it forwards.
        let (before, middle, behind) = (ab - aa, aa - ab - ab.transpose() + bb, ab - bb);
        let (a_middle, b_middle) = (a_by_a - a_by_b, b_by_a - b_by_b);
        for i in 0..3 {
            for j in i..3 {
                rows[i][j - i] += aa.col(j)[i];
                rows[4 + i][j - i] += middle.col(j)[i];
                rows[8 + i][j - i] += bb.col(j)[i];
            }
            rows[i][3 - i] -= a_by_a[i];
            rows[i][7 - i] -= b_by_a[i];
            rows[3][1 + i] += a_middle[i];
            rows[3][5 + i] += a_by_b[i];
            rows[4 + i][3 - i] += b_middle[i];
            rows[7][1 + i] += b_by_b[i];
            for j in 0..3 {
                rows[i][4 + j - i] += before.col(j)[i];
                rows[i][8 + j - i] -= ab.col(j)[i];
                rows[4 + i][4 + j - i] += behind.col(j)[i];
            }
        }
        rows[3][0] += angle_a;
        rows[3][4] += both;
        rows[7][0] += angle_b;
    }

    /// An entry.
    #[cfg(test)]
    pub(super) fn entry(&self, row: usize, column: usize) -> f64 {
        let (row, column) = (row.min(column), row.max(column));
        self.rows[row].get(column - row).copied().unwrap_or(0.0)
    }

    /// Holds a row to 0 whatever the right-hand side.
    pub(super) fn hold(&mut self, row: usize) {
        for back in 1..=HALF.min(row) {
            self.rows[row - back][back] = 0.0;
        }
        self.rows[row] = [0.0; HALF + 2];
        self.rows[row][0] = 1.0;
    }

    /// Factors the matrix in place and solves for a right-hand side. A pivot that is not positive, which only rounding can
    /// make, is replaced by a tiny one of its row. Returns whether there was none.
    pub(super) fn solve(&mut self, x: &mut Vec<f64>) -> bool {
        let n = x.len();
        x.resize(n + HALF, 0.0);
        let mut is_definite = true;
        for i in 0..n {
            let (Some((row, below)), Some((&mut value, rest))) = (self.rows[i..].split_first_mut(), x[i..].split_first_mut())
            else {
                break;
            };
            if row[0] <= f64::MIN_POSITIVE {
                is_definite = false;
                row[0] = row.iter().fold(1e-12, |most, entry| f64::max(most, entry.abs()));
            }
            let above = *row;
            let inverse = 1.0 / above[0];
            // From here on the row is that of L^T.
            *row = above.map(|entry| entry * inverse);
            if let Some([r1, r2, r3, r4, r5, r6, r7, r8, r9, r10]) = below.first_chunk_mut() {
                subtract::<10>(r1, &above[1..], row[1]);
                subtract::<10>(r2, &above[2..], row[2]);
                subtract::<8>(r3, &above[3..], row[3]);
                subtract::<8>(r4, &above[4..], row[4]);
                subtract::<6>(r5, &above[5..], row[5]);
                subtract::<6>(r6, &above[6..], row[6]);
                subtract::<4>(r7, &above[7..], row[7]);
                subtract::<4>(r8, &above[8..], row[8]);
                subtract::<2>(r9, &above[9..], row[9]);
                subtract::<2>(r10, &above[10..], row[10]);
            }
            subtract::<HALF>(rest, &row[1..], value);
            x[i] = value * inverse;
        }
        for i in (0..n).rev() {
            let (row, Some(x)) = (&self.rows[i], x[i..].first_chunk_mut::<{ HALF + 1 }>()) else { break };
            // The entries that were found last come last, so that one row need not wait for the other.
            let mut sums = [0.0; 2];
            for k in (3..HALF).step_by(2) {
                sums[0] += row[k] * x[k];
                sums[1] += row[k + 1] * x[k + 1];
            }
            x[0] = (x[0] - (sums[0] + sums[1]) - row[2] * x[2]) - row[1] * x[1];
        }
        x.truncate(n);
        is_definite
    }
}

/// `row -= part above`, in this many lanes: a number that the compiler knows.
#[inline(always)]
fn subtract<const LANES: usize>(row: &mut [f64], above: &[f64], part: f64) {
    if let (Some(row), Some(above)) = (row.first_chunk_mut::<LANES>(), above.first_chunk::<LANES>()) {
        for (entry, above) in row.iter_mut().zip(above) {
            *entry -= part * above;
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
        let expected: Vec<f64> = (0..n).map(|i| if i == 5 { 0.0 } else { random() }).collect();
        let mut x: Vec<f64> = (0..n).map(|i| (0..n).map(|j| band.entry(i, j) * expected[j]).sum()).collect();
        assert!(band.solve(&mut x));
        for (i, (x, expected)) in x.iter().zip(&expected).enumerate() {
            assert!((x - expected).abs() < 1e-9, "{i}: {x} for {expected}");
        }
    }
}
