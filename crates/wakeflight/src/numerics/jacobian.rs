//! Exact dense Jacobian of a square system by dual numbers.

use super::scalar::{Dual, Real};

/// Derivative directions carried at once: few, because the compiler unrolls all of F for each of them.
const LANES: usize = 4;

/// Dual number of the evaluations that `dense_jacobian` asks for.
pub type Direction = Dual<LANES>;

/// d residual/dx at `x`, row-major (n, n) into `out`; `residual(x, f)` fills f.
pub fn dense_jacobian(x: &[f64], mut residual: impl FnMut(&[Direction], &mut [Direction]), out: &mut [f64]) {
    let n = x.len();
    let mut f = vec![Direction::zero(); n];
    let mut column = 0;
    while column < n {
        let width = LANES.min(n - column);
        let mut x_s: Vec<Direction> = x.iter().map(|&v| Direction::cst(v)).collect();
        for lane in 0..width {
            x_s[column + lane].eps[lane] = 1.0;
        }
        residual(&x_s, &mut f);
        for (row, value) in f.iter().enumerate() {
            out[row * n + column..row * n + column + width].copy_from_slice(&value.eps[..width]);
        }
        column += width;
    }
}
