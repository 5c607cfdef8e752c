//! The three-stage Radau IIA method and the transformation that splits its linear system in a real and a complex one.
//!
//! Stages at c = (4 - sqrt 6)/10, (4 + sqrt 6)/10, 1. Order five in the state, L-stable, the last stage is the new state
//! [hairer1996, Sec. IV.8]. Stage increments Z and rates K: Z_i = h sum a_ij K_j, K_i = (1/h) sum (A^-1)_ij Z_j.

use nalgebra::Matrix3;

/// Number of stages.
pub const STAGES: usize = 3;

/// Coefficients of the method.
#[derive(Clone, Debug)]
pub struct Radau {
    /// Where the stages lie in the step.
    pub c: [f64; STAGES],
    /// A.
    pub a: [[f64; STAGES]; STAGES],
    /// A^-1.
    pub inverse: [[f64; STAGES]; STAGES],
    /// Real eigenvalue of A^-1.
    pub real: f64,
    /// Complex eigenvalue of A^-1: real and (positive) imaginary part.
    pub complex: [f64; 2],
    /// T: stages from transformed variables; A^-1 T = T diag(real, [[re, -im], [im, re]]).
    pub t: [[f64; STAGES]; STAGES],
    /// T^-1.
    pub t_inverse: [[f64; STAGES]; STAGES],
}

impl Default for Radau {
    fn default() -> Self {
        let s = 6f64.sqrt();
        let a = Matrix3::new(
            (88.0 - 7.0 * s) / 360.0,
            (296.0 - 169.0 * s) / 1800.0,
            (-2.0 + 3.0 * s) / 225.0,
            (296.0 + 169.0 * s) / 1800.0,
            (88.0 + 7.0 * s) / 360.0,
            (-2.0 - 3.0 * s) / 225.0,
            (16.0 - s) / 36.0,
            (16.0 + s) / 36.0,
            1.0 / 9.0,
        );
        let inverse = a.try_inverse().unwrap_or_else(Matrix3::identity);
        // characteristic polynomial of A^-1 is x^3 - 9 x^2 + 36 x - 60, solved in radicals
        let (k, l) = (3f64.cbrt(), 9f64.cbrt());
        let real = 3.0 + l - k;
        let complex = [3.0 - 0.5 * (l - k), 0.5 * 3f64.sqrt() * (l + k)];
        // eigenvectors: the adjugate's way, from two rows of A^-1 - x, scaled so that the last component is one
        let v = eigenvector(&inverse, real, 0.0);
        let w = eigenvector(&inverse, complex[0], complex[1]);
        // A^-1 (p - i r) = (re + i im)(p - i r) is the action of the block on the columns p, r
        let t = Matrix3::new(v[0][0], w[0][0], w[0][1], v[1][0], w[1][0], w[1][1], v[2][0], w[2][0], w[2][1]);
        let t_inverse = t.try_inverse().unwrap_or_else(Matrix3::identity);
        let rows = |m: Matrix3<f64>| std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
        Self {
            c: [(4.0 - s) / 10.0, (4.0 + s) / 10.0, 1.0],
            a: rows(a),
            inverse: rows(inverse),
            real,
            complex,
            t: rows(t),
            t_inverse: rows(t_inverse),
        }
    }
}

/// Null vector p - i r of m - (re + i im), last component one: pairs (p, r) by row.
fn eigenvector(m: &Matrix3<f64>, re: f64, im: f64) -> [[f64; 2]; 3] {
    use nalgebra::Complex;
    let x = Complex::new(re, im);
    let entry = |i: usize, j: usize| Complex::new(m[(i, j)], 0.0) - if i == j { x } else { Complex::ZERO };
    // rows 0 and 1 times (v0, v1, 1) vanish
    let det = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
    let v0 = (entry(0, 1) * entry(1, 2) - entry(1, 1) * entry(0, 2)) / det;
    let v1 = (entry(1, 0) * entry(0, 2) - entry(0, 0) * entry(1, 2)) / det;
    [[v0.re, -v0.im], [v1.re, -v1.im], [1.0, 0.0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transformation_splits_the_inverse_of_a() {
        let r = Radau::default();
        let [re, im] = r.complex;
        let block = [[r.real, 0.0, 0.0], [0.0, re, -im], [0.0, im, re]];
        for i in 0..3 {
            for j in 0..3 {
                let left: f64 = (0..3).map(|k| r.inverse[i][k] * r.t[k][j]).sum();
                let right: f64 = (0..3).map(|k| r.t[i][k] * block[k][j]).sum();
                assert!((left - right).abs() < 1e-12, "{i} {j}: {left} {right}");
                let unit: f64 = (0..3).map(|k| r.t[i][k] * r.t_inverse[k][j]).sum();
                assert!((unit - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_stages_integrate_polynomials_of_their_degree() {
        // sum a_ij c_j^(k-1) = c_i^k/k for k to 3, and the last row to degree 4 (order five)
        let r = Radau::default();
        for k in 1..=5 {
            for i in 0..3 {
                if k <= 3 || i == 2 {
                    let sum: f64 = (0..3).map(|j| r.a[i][j] * r.c[j].powi(k - 1)).sum();
                    assert!((sum - r.c[i].powi(k) / f64::from(k)).abs() < 1e-14, "{k} {i}");
                }
            }
        }
    }
}
