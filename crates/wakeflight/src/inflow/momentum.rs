//! Mean induced inflow of momentum theory.

use crate::numerics::scalar::Real;

/// Square of an inflow ratio that does not matter: keeps roots differentiable where nothing moves.
pub(super) const TINY: f64 = 1e-20;

/// Mean induced inflow of momentum theory, lambda_0 = CT/(2 sqrt(mu^2 + (lambda_0 - mu_z)^2)), down positive.
///
/// Solved to rounding on values by Newton kept inside a bracket, then one Newton step in `S`, which makes the
/// derivatives exact. In steep descent, where several roots exist, the search starts from the side of the largest.
pub fn momentum_inflow<S: Real>(ct: S, mu_squared: S, mu_z: S) -> S {
    let root = momentum_root(ct.re(), mu_squared.re(), mu_z.re());
    let total = -mu_z + root;
    let speed = (mu_squared + total.squared() + TINY).sqrt();
    let residual = speed * (2.0 * root) - ct;
    let slope = slope(root, mu_squared.re(), mu_z.re());
    // at a fold (or with no thrust and no motion) the derivative does not exist
    if slope.abs() < 1e-9 { S::cst(root) } else { -residual / slope + root }
}

fn slope(root: f64, mu_squared: f64, mu_z: f64) -> f64 {
    let total = root - mu_z;
    let speed = (mu_squared + total * total + TINY).sqrt();
    2.0 * speed + 2.0 * root * total / speed
}

fn momentum_root(ct: f64, mu_squared: f64, mu_z: f64) -> f64 {
    if ct < 0.0 {
        return -momentum_root(-ct, mu_squared, -mu_z);
    }
    let residual = |x: f64| 2.0 * x * (mu_squared + (x - mu_z).powi(2) + TINY).sqrt() - ct;
    let mut low = 0.0;
    let mut high = mu_z.max(0.0) + (0.5 * ct).sqrt();
    let mut x = high;
    for _ in 0..100 {
        let r = residual(x);
        if r > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - r / slope(x, mu_squared, mu_z);
        // bisection wherever Newton leaves the bracket (or is not a number)
        let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-16 + 4.0 * f64::EPSILON * x.abs() {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn momentum_inflow_solves_its_equation_everywhere() {
        for ct in [-0.004, 1e-6, 0.003, 0.0066, 0.012] {
            for mu in [0.0, 0.01, 0.05, 0.185, 0.4] {
                for mu_z in [-0.1, -0.01, 0.0, 0.03, 0.06, 0.12, 0.3] {
                    let x: f64 = momentum_inflow(ct, mu * mu, mu_z);
                    let residual = 2.0 * x * (mu * mu + (x - mu_z).powi(2)).sqrt() - ct;
                    assert!(residual.abs() < 1e-12, "{ct} {mu} {mu_z}: {residual}");
                }
            }
        }
        assert!((momentum_inflow(0.005, 0.0, 0.0) - 0.05_f64).abs() < 1e-12);
        assert_eq!(momentum_inflow(0.0, 0.0, 0.0), 0.0);
    }
}
