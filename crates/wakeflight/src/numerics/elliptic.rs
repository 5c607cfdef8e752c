//! Complete elliptic integrals.

use std::f64::consts::FRAC_PI_2;

/// Bulirsch's complete elliptic integral, the integral over 0..pi/2 of
/// (a cos^2 + b sin^2) / ((cos^2 + p sin^2) sqrt(cos^2 + kc^2 sin^2)) [bulirsch1965].
///
/// `kc` > 0: complementary modulus, `p` > 0. With m = 1 - kc^2: K(m) = cel(kc, 1, 1, 1), E(m) = cel(kc, 1, 1, kc^2),
/// Pi(n, m) = cel(kc, 1 - n, 1, 1).
pub fn cel(kc: f64, p: f64, a: f64, b: f64) -> f64 {
    // Landen's transformation repeated; the error is the square of the last relative difference
    const DIFFERENCE: f64 = 1e-8;
    let mut k = kc;
    let (mut e, mut m) = (kc, 1.0);
    let mut p = p.sqrt();
    let (mut a, mut b) = (a, b / p);
    loop {
        let f = a;
        a += b / p;
        let g = e / p;
        b = 2.0 * (b + f * g);
        p += g;
        let g = m;
        m += k;
        if (g - k).abs() <= g * DIFFERENCE {
            return FRAC_PI_2 * (b + a * m) / (m * (m + p));
        }
        k = 2.0 * e.sqrt();
        e = k * m;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral by the midpoint rule, which converges fast for a periodic integrand.
    fn by_points(kc: f64, p: f64, a: f64, b: f64) -> f64 {
        let n = 4000;
        let h = FRAC_PI_2 / f64::from(n);
        (0..n)
            .map(|i| {
                let (s, c) = ((f64::from(i) + 0.5) * h).sin_cos();
                let (s, c) = (s * s, c * c);
                (a * c + b * s) / ((c + p * s) * (c + kc * kc * s).sqrt())
            })
            .sum::<f64>()
            * h
    }

    #[test]
    fn agrees_with_the_integral() {
        for kc in [0.02, 0.3, 0.8, 1.0] {
            for (p, a, b) in [(1.0, 1.0, 1.0), (1.0, 1.0, kc * kc), (0.01, 1.0, 1.0), (1.0, -1.0, 1.0)] {
                let (found, expected) = (cel(kc, p, a, b), by_points(kc, p, a, b));
                assert!(
                    (found - expected).abs() < 1e-12 * (1.0 + expected.abs()),
                    "{kc} {p}: {found} {expected}"
                );
            }
        }
        assert!((cel(1.0, 1.0, 1.0, 1.0) - FRAC_PI_2).abs() < 1e-15);
    }
}
