//! Small dense linear algebra, row by row in blocks of vectors.

use super::compiled::{BLOCK, Loops, compiled};

type Block = [f64; BLOCK];

/// A vector of length `n` in whole blocks.
fn blocks_of(n: usize) -> usize {
    n.div_ceil(BLOCK)
}

/// Adds `factor` times `from` to `to`, block by block.
#[inline(always)]
fn add_scaled(to: &mut [Block], factor: f64, from: &[Block]) {
    for (to, from) in to.iter_mut().zip(from) {
        for (a, b) in to.iter_mut().zip(from) {
            *a += factor * b;
        }
    }
}

/// A matrix that is multiplied by vectors, kept column by column.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    n: usize,
    blocks: Vec<Block>,
}

impl Columns {
    /// Of a `matrix` (n, n), row-major.
    pub fn new(matrix: &[f64], n: usize) -> Self {
        debug_assert_eq!(matrix.len(), n * n);
        let width = blocks_of(n);
        let mut blocks = vec![[0.0; BLOCK]; n * width];
        for (j, column) in blocks.chunks_exact_mut(width.max(1)).enumerate() {
            for (value, row) in column.as_flattened_mut().iter_mut().zip(matrix.chunks_exact(n.max(1))) {
                *value = row[j];
            }
        }
        Self { n, blocks }
    }

    /// The product with `x` (n) added to `base` (n), into `to` (n); terms in the order of the columns.
    pub fn add_product(&self, base: &[f64], x: &[f64], to: &mut [f64]) {
        compiled(Product { columns: self, base, x, to });
    }
}

struct Product<'a> {
    columns: &'a Columns,
    base: &'a [f64],
    x: &'a [f64],
    to: &'a mut [f64],
}

impl Loops for Product<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let width = blocks_of(self.columns.n);
        // rows in blocks: the columns pass by, each block's sums stay in a vector
        for (k, (to, base)) in self.to.chunks_mut(BLOCK).zip(self.base.chunks(BLOCK)).enumerate() {
            let mut sum = [0.0; BLOCK];
            for (column, x) in self.columns.blocks.chunks_exact(width.max(1)).zip(self.x) {
                add_scaled(std::slice::from_mut(&mut sum), *x, std::slice::from_ref(&column[k]));
            }
            for ((to, base), sum) in to.iter_mut().zip(base).zip(sum) {
                *to = base + sum;
            }
        }
    }
}

/// Room for a linear system A x = b.
#[derive(Clone, Debug, Default)]
pub struct LinearSystem {
    n: usize,
    /// Blocks of a row.
    width: usize,
    /// Rows of A, each followed by its b.
    rows: Vec<Block>,
}

/// Blocks of a row that the elimination is compiled for, the widest for up to 255 unknowns (blades have at most 200 stations).
const WIDTHS: [usize; 6] = [1, 2, 3, 4, 8, WIDEST];
const WIDEST: usize = 32;

impl LinearSystem {
    /// For `n` unknowns.
    pub fn new(n: usize) -> Self {
        debug_assert!(n < WIDEST * BLOCK);
        let width = WIDTHS.into_iter().find(|width| width * BLOCK > n).unwrap_or(WIDEST);
        Self { n, width, rows: vec![[0.0; BLOCK]; n * width] }
    }

    /// I - diag(slope) N, whose rows are `near` (n, n), and the right-hand side.
    pub fn set_feedback(&mut self, slope: impl Iterator<Item = f64>, near: &[f64], right: &[f64]) {
        let n = self.n;
        let rows = self.rows.chunks_exact_mut(self.width.max(1)).map(<[Block]>::as_flattened_mut);
        for (i, (((row, slope), near), right)) in
            rows.zip(slope).zip(near.chunks_exact(n.max(1))).zip(right).enumerate()
        {
            for (a, near) in row.iter_mut().zip(near) {
                *a = -slope * near;
            }
            row[i] += 1.0;
            row[n] = *right;
        }
    }

    /// Rows of A and the right-hand side, as `fill` writes them: row index, its n coefficients and the number on the right.
    pub fn set(&mut self, mut fill: impl FnMut(usize, &mut [f64])) {
        let n = self.n;
        for (i, row) in self.rows.chunks_exact_mut(self.width.max(1)).enumerate() {
            fill(i, &mut row.as_flattened_mut()[..=n]);
        }
    }

    /// Solves by elimination with partial pivoting into `x` (n); what was set is used up.
    ///
    /// Returns whether every pivot differs from zero; otherwise `x` holds nothing of use.
    pub fn solve(&mut self, x: &mut [f64]) -> bool {
        self.solve_signed(x).is_some()
    }

    /// The same; returns the sign of the determinant, None where it is zero.
    pub fn solve_signed(&mut self, x: &mut [f64]) -> Option<f64> {
        debug_assert_eq!(x.len(), self.n);
        compiled(Elimination { system: self, x })
    }
}

struct Elimination<'a> {
    system: &'a mut LinearSystem,
    x: &'a mut [f64],
}

impl Loops for Elimination<'_> {
    type Output = Option<f64>;
    #[inline(always)]
    fn run(self) -> Option<f64> {
        let LinearSystem { n, width, rows } = self.system;
        // rows of a length known to the compiler: half the time of loops over any
        match *width {
            1 => eliminate::<1>(*n, rows.as_chunks_mut().0, self.x),
            2 => eliminate::<2>(*n, rows.as_chunks_mut().0, self.x),
            3 => eliminate::<3>(*n, rows.as_chunks_mut().0, self.x),
            4 => eliminate::<4>(*n, rows.as_chunks_mut().0, self.x),
            8 => eliminate::<8>(*n, rows.as_chunks_mut().0, self.x),
            _ => eliminate::<WIDEST>(*n, rows.as_chunks_mut().0, self.x),
        }
    }
}

/// Solves rows of A and b (n) by elimination with partial pivoting into `x` (n); the sign of the determinant.
#[inline(always)]
fn eliminate<const W: usize>(n: usize, rows: &mut [[Block; W]], x: &mut [f64]) -> Option<f64> {
    let mut sign = 1.0;
    let mut pivot = (0, 0.0);
    for (i, row) in rows.iter().enumerate() {
        pivot = larger(pivot, i, row[0][0]);
    }
    for block in 0..W {
        for lane in 0..BLOCK.min(n.saturating_sub(block * BLOCK)) {
            let k = block * BLOCK + lane;
            if pivot.1 == 0.0 {
                return None;
            }
            let (upper, lower) = rows.split_at_mut(k + 1);
            if pivot.0 > 0 {
                sign = -sign;
                std::mem::swap(&mut upper[k], &mut lower[pivot.0 - 1]);
            }
            let first = upper[k];
            sign *= first[block][lane].signum();
            let inverse = 1.0 / first[block][lane];
            // the next pivot is looked for while rows are at hand: the search alone waits for every comparison
            let next = ((k + 1) / BLOCK, (k + 1) % BLOCK);
            pivot = (0, 0.0);
            for (i, row) in lower.iter_mut().enumerate() {
                let factor = row[block][lane] * inverse;
                // what lies left of the pivot in its block is no part of the matrix any more
                add_scaled(&mut row[block..], -factor, &first[block..]);
                pivot = larger(pivot, i, row[next.0][next.1]);
            }
        }
    }
    for k in (0..n).rev() {
        let row = rows[k].as_flattened();
        let known: f64 = row[k + 1..n].iter().zip(&x[k + 1..]).map(|(a, x)| a * x).sum();
        x[k] = (row[n] - known) / row[k];
    }
    Some(sign)
}

/// The larger in size of a pivot found before, with its row, and the one in row `i`; the first of equal ones.
#[inline(always)]
fn larger(before: (usize, f64), i: usize, entry: f64) -> (usize, f64) {
    if entry.abs() > before.1 { (i, entry.abs()) } else { before }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of a fixed pseudo-random sequence.
    fn numbers(n: usize) -> Vec<f64> {
        let mut seed = 1u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 40) as f64 / 8_388_608.0 - 1.0
        };
        (0..n).map(|_| next()).collect()
    }

    fn times(matrix: &[f64], x: &[f64]) -> Vec<f64> {
        matrix.chunks(x.len()).map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
    }

    /// A of the system whose rows are I - diag(1) `near`.
    fn solved(near: &[f64], right: &[f64]) -> Option<Vec<f64>> {
        let n = right.len();
        let (mut system, mut x) = (LinearSystem::new(n), vec![0.0; n]);
        system.set_feedback(std::iter::repeat(1.0), near, right);
        system.solve(&mut x).then_some(x)
    }

    #[test]
    fn systems_that_need_pivots_are_solved() {
        // zeros on the diagonal: without pivoting the first step divides by zero
        for n in [1, 2, 5, 7, 8, 15, 16, 20, 33, 64, 200] {
            let mut near = numbers(n * n);
            if n > 1 {
                (0..n).for_each(|i| near[i * n + i] = 1.0);
            }
            let mut matrix: Vec<f64> = near.iter().map(|v| -v).collect();
            (0..n).for_each(|i| matrix[i * n + i] += 1.0);
            let exact = numbers(n);
            let x = solved(&near, &times(&matrix, &exact)).unwrap();
            for (x, e) in x.iter().zip(&exact) {
                assert!((x - e).abs() < 1e-11, "{n}: {x} {e}");
            }
        }
    }

    #[test]
    fn the_sign_of_the_determinant_comes_with_the_solution() {
        // a cycle of three rows is even, an exchange of two odd; a negative number turns either
        for (rows, sign) in [
            ([[0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [5.0, 0.0, 0.0]], 1.0),
            ([[0.0, 2.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 5.0]], -1.0),
            ([[0.0, 2.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -5.0]], 1.0),
        ] {
            let mut system = LinearSystem::new(3);
            system.set(|i, row| row.copy_from_slice(&[rows[i][0], rows[i][1], rows[i][2], 1.0]));
            assert_eq!(system.solve_signed(&mut [0.0; 3]), Some(sign));
        }
    }

    #[test]
    fn a_singular_system_is_refused() {
        assert_eq!(solved(&[0.0, -2.0, -2.0, -3.0], &[1.0, 1.0]), None);
    }

    #[test]
    fn products_keep_the_order_of_their_terms() {
        for n in [1, 8, 20, 33] {
            let (matrix, x) = (numbers(n * n), numbers(n));
            let mut to = vec![0.0; n];
            Columns::new(&matrix, n).add_product(&vec![0.0; n], &x, &mut to);
            assert_eq!(to, times(&matrix, &x));
        }
    }
}
