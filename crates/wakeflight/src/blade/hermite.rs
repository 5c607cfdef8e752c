//! Interpolation inside one element: cubic Hermite for bending, quadratic for torsion.

/// Values, slopes and curvatures of the four cubic Hermite functions at `s` (0 to 1) of an element of length `h` [m].
///
/// Order: deflection and slope at the inner node, deflection and slope at the outer node.
pub fn cubic(s: f64, h: f64) -> [[f64; 4]; 3] {
    let (s2, s3) = (s * s, s * s * s);
    [
        [1.0 - 3.0 * s2 + 2.0 * s3, h * (s - 2.0 * s2 + s3), 3.0 * s2 - 2.0 * s3, h * (s3 - s2)],
        [6.0 * (s2 - s) / h, 1.0 - 4.0 * s + 3.0 * s2, 6.0 * (s - s2) / h, 3.0 * s2 - 2.0 * s],
        [(12.0 * s - 6.0) / (h * h), (6.0 * s - 4.0) / h, (6.0 - 12.0 * s) / (h * h), (6.0 * s - 2.0) / h],
    ]
}

/// Values and slopes of the three quadratic functions at `s` (0 to 1) of an element of length `h` [m].
///
/// Order: inner node, middle, outer node.
pub fn quadratic(s: f64, h: f64) -> [[f64; 3]; 2] {
    [
        [(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)],
        [(4.0 * s - 3.0) / h, (4.0 - 8.0 * s) / h, (4.0 * s - 1.0) / h],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_and_a_quadratic_are_reproduced_with_their_derivatives() {
        let (a, h, s) = (0.3, 1.7, 0.37);
        let x = a + s * h;
        let f = |x: f64| 2.0 - x + 0.5 * x * x - 0.25 * x.powi(3);
        let df = |x: f64| -1.0 + x - 0.75 * x * x;
        let ddf = |x: f64| 1.0 - 1.5 * x;
        let nodal = [f(a), df(a), f(a + h), df(a + h)];
        let sum = |n: &[f64]| n.iter().zip(nodal).map(|(n, q)| n * q).sum::<f64>();
        let [value, slope, curvature] = cubic(s, h);
        assert!((sum(&value) - f(x)).abs() < 1e-14);
        assert!((sum(&slope) - df(x)).abs() < 1e-14);
        assert!((sum(&curvature) - ddf(x)).abs() < 1e-14);
        let g = |x: f64| 1.0 + 2.0 * x - x * x;
        let nodal = [g(a), g(a + 0.5 * h), g(a + h)];
        let sum = |n: &[f64]| n.iter().zip(nodal).map(|(n, q)| n * q).sum::<f64>();
        let [value, slope] = quadratic(s, h);
        assert!((sum(&value) - g(x)).abs() < 1e-14);
        assert!((sum(&slope) - (2.0 - 2.0 * x)).abs() < 1e-14);
    }
}
