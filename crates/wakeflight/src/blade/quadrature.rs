//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Points in -1..1 and weights of the `n`-point Gauss-Legendre rule, exact for degree 2n - 1.
///
/// Zeros of the Legendre polynomial by Newton's method; weights 2 / ((1 - x^2) P'(x)^2).
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let mut rule = Vec::with_capacity(n);
    for i in 0..n {
        // ascending first guess
        let mut x = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (value, derivative) = legendre(n, x);
            slope = derivative;
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-15 {
                slope = legendre(n, x).1;
                break;
            }
        }
        rule.push((x, 2.0 / ((1.0 - x * x) * slope * slope)));
    }
    rule
}

/// Points and weights of the `n`-point rule on `from`..`to`.
pub fn gauss_points(n: usize, from: f64, to: f64) -> Vec<(f64, f64)> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    gauss_legendre(n).into_iter().map(|(x, w)| (middle + half * x, half * w)).collect()
}

/// Legendre polynomial of degree `n` and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut now) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
    }
    (now, n as f64 * (x * now - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn n_points_integrate_degree_2n_minus_1_exactly() {
        for n in 1..=8 {
            for degree in 0..2 * n as i32 {
                let sum: f64 = gauss_points(n, 0.5, 2.0).iter().map(|(x, w)| w * x.powi(degree)).sum();
                let k = degree + 1;
                let exact = (2f64.powi(k) - 0.5f64.powi(k)) / f64::from(k);
                assert!((sum / exact - 1.0).abs() < 1e-13, "{n} points, degree {degree}");
            }
        }
    }
}
