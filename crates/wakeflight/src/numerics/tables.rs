//! Tables: linear in one argument, bilinear in two, held at their ends.

use super::scalar::Real;
use serde::Deserialize;

/// Piecewise linear function of one argument, held beyond its ends.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// Arguments, strictly ascending.
    pub x: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
}

/// Bilinear function of two arguments, held beyond its edges.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// First arguments (rows), strictly ascending.
    pub x: Vec<f64>,
    /// Second arguments (columns), strictly ascending.
    pub y: Vec<f64>,
    /// `values[i][j]` at `x[i]`, `y[j]`.
    pub values: Vec<Vec<f64>>,
}

/// Cell index and position in it (0 to 1) of `value` on `axis`; outside, the end with zero derivative.
#[inline(always)]
fn cell<S: Real>(axis: &[f64], value: S) -> (usize, S) {
    let last = axis.len() - 1;
    if last == 0 || value.re() <= axis[0] {
        return (0, S::zero());
    }
    if value.re() >= axis[last] {
        return (last - 1, S::one());
    }
    // a value that is not a number stays one: the first cell, and the caller sees it in the result
    let i = axis.partition_point(|&a| a <= value.re()).saturating_sub(1);
    (i, (value - axis[i]) / (axis[i + 1] - axis[i]))
}

impl Table {
    /// Value at `x`.
    #[inline(always)]
    pub fn at<S: Real>(&self, x: S) -> S {
        let (i, f) = cell(&self.x, x);
        let y0 = self.y[i];
        let y1 = self.y[(i + 1).min(self.y.len() - 1)];
        f * (y1 - y0) + y0
    }
}

impl Grid {
    /// Value at (`x`, `y`).
    #[inline(always)]
    pub fn at<S: Real>(&self, x: S, y: S) -> S {
        let (i, f) = cell(&self.x, x);
        let (j, g) = cell(&self.y, y);
        let i1 = (i + 1).min(self.x.len() - 1);
        let j1 = (j + 1).min(self.y.len() - 1);
        let (v00, v01) = (self.values[i][j], self.values[i][j1]);
        let (v10, v11) = (self.values[i1][j], self.values[i1][j1]);
        let low = g * (v01 - v00) + v00;
        let high = g * (v11 - v10) + v10;
        low + f * (high - low)
    }
    /// Whether (`x`, `y`) lies inside the table.
    pub fn covers(&self, x: f64, y: f64) -> bool {
        let inside = |axis: &[f64], v: f64| v >= axis[0] && v <= axis[axis.len() - 1];
        inside(&self.x, x) && inside(&self.y, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    #[test]
    fn a_bilinear_function_is_reproduced_with_its_derivatives() {
        let x = vec![0.0, 1.0, 3.0];
        let y = vec![-1.0, 2.0];
        let f = |a: f64, b: f64| 1.0 + 2.0 * a - 0.5 * b + 0.25 * a * b;
        let values = x.iter().map(|&a| y.iter().map(|&b| f(a, b)).collect()).collect();
        let grid = Grid { x, y, values };
        let v = grid.at(Dual::<2>::variable(1.7, 0), Dual::<2>::variable(0.4, 1));
        assert!((v.re - f(1.7, 0.4)).abs() < 1e-14);
        assert!((v.eps[0] - (2.0 + 0.25 * 0.4)).abs() < 1e-14);
        assert!((v.eps[1] - (-0.5 + 0.25 * 1.7)).abs() < 1e-14);
        assert!((grid.at(9.0, 9.0) - f(3.0, 2.0)).abs() < 1e-14);
    }
}
