//! Difference stencils of dr/dpsi + dr/dzeta = V/omega on one cell with equal steps of azimuth and age.
//!
//! Corners: A (n+1, k+1) the unknown, B (n, k+1), C (n+1, k), D (n, k), E (n-1, k+1), F (n-1, k), G (n-2, k+1),
//! H (n-2, k), and on the path of the marker before D: I (n-1, k-1). The stencils are linear: they act on positions, or
//! on displacements from the release point, which is constant along a path.
//!
//! On its path a marker follows dr/dpsi = V/omega: one equation in one variable, smooth where differences in azimuth at a fixed
//! age and in age at a fixed azimuth see the turning of the blades.

use super::choices::Scheme;
use super::vectors::mean;

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
    /// (n-1, k-1); none where the marker was released at the level n.
    pub i: Option<[f64; 3]>,
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

/// Second-order backward on the path: 3 A = 4 D - I + 2 step V/omega, V that of A.
///
/// A marker in its first step has the trapezoidal rule, V the mean of D and A, whose error over one step is of third order.
pub fn backward_on_path(cell: &Cell, advance: [f64; 3]) -> [f64; 3] {
    let d = cell.d;
    match cell.i {
        None => central(d, advance),
        Some(i) => std::array::from_fn(|c| (4.0 * d[c] - i[c] + 2.0 * advance[c]) / 3.0),
    }
}

/// Unknown corner of the cell by the scheme; `advance` is step V/omega [m], V of [`corrector_velocity`].
pub fn unknown_corner(scheme: Scheme, cell: &Cell, advance: [f64; 3]) -> [f64; 3] {
    match scheme {
        Scheme::Pcc => central(cell.d, advance),
        Scheme::Pc2b => backward_at_centre(cell, advance),
        Scheme::Bdf2 => backward_at_new_level(cell, advance),
        Scheme::Path2 => backward_on_path(cell, advance),
    }
}

/// V that the scheme takes, of V at D and B (`old`) and at C and A (`new`) [m/s].
pub fn corrector_velocity(scheme: Scheme, cell: &Cell, old: [[f64; 3]; 2], new: [[f64; 3]; 2]) -> [f64; 3] {
    match (scheme, cell.i) {
        (Scheme::Pcc | Scheme::Pc2b, _) => mean(mean(old[0], old[1]), mean(new[0], new[1])),
        (Scheme::Bdf2, _) => mean(new[0], new[1]),
        (Scheme::Path2, Some(_)) => new[1],
        (Scheme::Path2, None) => mean(old[0], new[1]),
    }
}

/// Unknown corner predicted by V at D and B (`old`) [m/s]; `step` is that of azimuth over omega [s].
///
/// On the path by the explicit midpoint, A = I + 2 step V/omega, and in the first step by Euler's rule, V that of D; otherwise
/// by the scheme's own stencil.
pub fn predicted_corner(scheme: Scheme, cell: &Cell, step: f64, old: [[f64; 3]; 2]) -> [f64; 3] {
    match scheme {
        Scheme::Path2 => match cell.i {
            Some(i) => central(i, old[0].map(|v| 2.0 * step * v)),
            None => central(cell.d, old[0].map(|v| step * v)),
        },
        _ => unknown_corner(scheme, cell, mean(old[0], old[1]).map(|v| v * step)),
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
            i: Some(at(-1.0, -1.0)),
        };
        (cell, r(h, h))
    }

    #[test]
    fn every_scheme_is_exact_for_quadratic_motion() {
        // r = psi^2 + 3 psi zeta - 2 zeta^2: second-order formulas have no error; V/omega = 5 psi - zeta
        let h = 0.1;
        let (cell, exact) = cell(|p, z| p * p + 3.0 * p * z - 2.0 * z * z, h);
        let v = |n: f64, k: f64| [5.0 * n * h - k * h, 0.0, 0.0];
        for &scheme in Scheme::ALL {
            let (old, new) = ([v(0.0, 0.0), v(0.0, 1.0)], [v(1.0, 0.0), v(1.0, 1.0)]);
            let velocity = corrector_velocity(scheme, &cell, old, new);
            let a = unknown_corner(scheme, &cell, velocity.map(|v| v * h));
            assert!((a[0] - exact).abs() < 1e-15, "{scheme:?}: {} {exact}", a[0]);
        }
    }

    #[test]
    fn the_first_step_on_a_path_is_exact_for_quadratic_motion() {
        let h = 0.1;
        let (mut cell, exact) = cell(|p, z| (1.0 + p + z).powi(2), h);
        cell.i = None;
        // V/omega = 4 (1 + psi + zeta)
        let v = |at: f64| [4.0 * (1.0 + 2.0 * at * h), 0.0, 0.0];
        let velocity =
            corrector_velocity(Scheme::Path2, &cell, [v(0.0), [f64::NAN; 3]], [[f64::NAN; 3], v(1.0)]);
        let a = unknown_corner(Scheme::Path2, &cell, velocity.map(|v| v * h));
        assert!((a[0] - exact).abs() < 1e-14, "{} {exact}", a[0]);
    }
}
