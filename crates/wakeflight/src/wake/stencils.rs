//! Difference stencils of dr/dpsi + dr/dzeta = V/omega on one cell with equal steps of azimuth and age.
//!
//! Corners: A (n+1, k+1) the unknown, B (n, k+1), C (n+1, k), D (n, k), E (n-1, k+1), F (n-1, k), G (n-2, k+1),
//! H (n-2, k). The stencils are linear: they act on positions, or on displacements from the release point, which is
//! constant along a characteristic.

use super::choices::Scheme;

/// Known corners of a cell [m].
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// (n, k+1).
    pub b: [f64; 3],
    /// (n+1, k).
    pub c: [f64; 3],
    /// (n, k).
    pub d: [f64; 3],
    /// (n-1, k+1).
    pub e: [f64; 3],
    /// (n-1, k).
    pub f: [f64; 3],
    /// (n-2, k+1).
    pub g: [f64; 3],
    /// (n-2, k).
    pub h: [f64; 3],
}

/// Five-point central [bagai1995]: A = D + step V/omega; `advance` is step V/omega [m], V the mean of the four corners.
pub fn central(d: [f64; 3], advance: [f64; 3]) -> [f64; 3] {
    [d[0] + advance[0], d[1] + advance[1], d[2] + advance[2]]
}

/// Second-order backward in azimuth at the centre of the cell, central in age [bhagwat2001]:
/// 7/4 A = 1/4 C - 3/4 B + 5/4 D + 3/4 (E + F) - 1/4 (G + H) + 2 step V/omega, V the mean of the four corners.
pub fn backward_at_centre(cell: &Cell, advance: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        (0.25 * cell.c[i] - 0.75 * cell.b[i] + 1.25 * cell.d[i] + 0.75 * (cell.e[i] + cell.f[i])
            - 0.25 * (cell.g[i] + cell.h[i])
            + 2.0 * advance[i])
            / 1.75
    })
}

/// Second-order backward in azimuth at the new level, centred in age:
/// 7/4 A = 1/4 C + B + D - 1/4 (E + F) + step V/omega, V the mean of A and C.
pub fn backward_at_new_level(cell: &Cell, advance: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        (0.25 * cell.c[i] + (cell.b[i] + cell.d[i]) - 0.25 * (cell.e[i] + cell.f[i]) + advance[i]) / 1.75
    })
}

/// Unknown corner of the cell by the scheme; `advance` is step V/omega [m].
pub fn unknown_corner(scheme: Scheme, cell: &Cell, advance: [f64; 3]) -> [f64; 3] {
    match scheme {
        Scheme::Pcc => central(cell.d, advance),
        Scheme::Pc2b => backward_at_centre(cell, advance),
        Scheme::Bdf2 => backward_at_new_level(cell, advance),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cell of r(psi, zeta) around (n, k) = (0, 0), and the exact unknown.
    fn cell(r: impl Fn(f64, f64) -> f64, h: f64) -> (Cell, f64) {
        let at = |n: f64, k: f64| [r(n * h, k * h), 0.0, 0.0];
        let cell = Cell {
            b: at(0.0, 1.0),
            c: at(1.0, 0.0),
            d: at(0.0, 0.0),
            e: at(-1.0, 1.0),
            f: at(-1.0, 0.0),
            g: at(-2.0, 1.0),
            h: at(-2.0, 0.0),
        };
        (cell, r(h, h))
    }

    #[test]
    fn every_scheme_is_exact_for_quadratic_motion() {
        // r = psi^2 + 3 psi zeta - 2 zeta^2: second-order formulas have no error; V/omega = 5 psi - zeta
        let h = 0.1;
        let (cell, exact) = cell(|p, z| p * p + 3.0 * p * z - 2.0 * z * z, h);
        let v = |p: f64, z: f64| 5.0 * p - z;
        for scheme in [Scheme::Pcc, Scheme::Pc2b, Scheme::Bdf2] {
            let mean = match scheme {
                Scheme::Bdf2 => v(h, 0.5 * h),
                _ => v(0.5 * h, 0.5 * h),
            };
            let a = unknown_corner(scheme, &cell, [h * mean, 0.0, 0.0]);
            assert!((a[0] - exact).abs() < 1e-15, "{scheme:?}: {} {exact}", a[0]);
        }
    }
}
