//! Sine, cosine and the angle of a direction, without branches: several side by side in vector registers, each with the bits it has
//! alone, on every instruction set and system.
//!
//! Within 2 units in the last place of the exact value (tested against the standard library's).

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// Added and taken off again, rounds what is below 2^51 to a whole number, which the last bits of the sum then hold.
pub const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// pi/2 in three parts of falling size, the first two of 33 bits: their products with a number of quarters are exact.
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
/// Largest angle [rad] whose quarters are few enough for that; beyond it the standard library's sine is taken.
const LARGEST: f64 = 1e5;

/// Coefficients of (sin r - r)/r^3 and of (cos r - 1 + r^2/2)/r^4 in powers of r^2, enough for |r| < pi/4.
const SINE: [f64; 7] = series(3);
const COSINE: [f64; 7] = series(4);

/// The power series whose first term belongs to the power `first`.
const fn series<const N: usize>(first: usize) -> [f64; N] {
    let mut all = [if first == 3 { -1.0 / 6.0 } else { 1.0 / 24.0 }; N];
    let mut n = 1;
    while n < N {
        let order = (2 * n + first) as f64;
        all[n] = -all[n - 1] / (order * (order - 1.0));
        n += 1;
    }
    all
}

/// Coefficients of (atan(z)/z - 1)/z^2 in powers of z^2 up to tan^2(pi/8), interpolated where a Chebyshev polynomial of order 11 is zero:
/// wrong by 7e-18 of atan(z)/z at most.
const ARC: [f64; 11] = [
    -0.333_333_333_333_333_3,
    0.199_999_999_999_955_2,
    -0.142_857_142_846_665_42,
    0.111_111_110_152_563_61,
    -0.090_909_045_781_239_03,
    0.076_921_831_908_260_87,
    -0.066_645_114_473_819_48,
    0.058_581_489_128_022_1,
    -0.050_854_497_379_402_6,
    0.039_231_658_295_587_19,
    -0.019_176_887_119_062_26,
];
/// tan(pi/8)
const EIGHTH: f64 = 0.414_213_562_373_095_03;

/// Value of a polynomial, lowest power first.
#[inline(always)]
fn polynomial<const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    let mut sum = coefficients[N - 1];
    for n in (0..N - 1).rev() {
        sum = sum * x + coefficients[n];
    }
    sum
}

/// `a` where `first`, otherwise `b`: by bits, for a choice of numbers may become a branch.
#[inline(always)]
fn chosen(first: bool, a: f64, b: f64) -> f64 {
    let mask = 0u64.wrapping_sub(u64::from(first));
    f64::from_bits((a.to_bits() & mask) | (b.to_bits() & !mask))
}

/// Sine and cosine of an angle from those of what is beyond its nearest quarter of a turn; the last bits of `sum` hold that quarter.
#[inline(always)]
pub fn turned(sine: f64, cosine: f64, sum: f64) -> (f64, f64) {
    let (s, c) = (sine.to_bits(), cosine.to_bits());
    // an odd quarter swaps the two; the second and third turn the sine, the first and second the cosine
    let quarter = sum.to_bits();
    let swapped = (s ^ c) & 0u64.wrapping_sub(quarter & 1);
    let sine = f64::from_bits((s ^ swapped) ^ ((quarter & 2) << 62));
    let cosine = f64::from_bits((c ^ swapped) ^ ((quarter.wrapping_add(1) & 2) << 62));
    (sine, cosine)
}

/// Sines and cosines of angles [rad].
#[inline(always)]
pub fn sin_cos_of<const N: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
    let mut largest: f64 = 0.0;
    for k in 0..N {
        let x = angles[k];
        largest = largest.max(x.abs());
        let sum = x * (2.0 * FRAC_1_PI) + ROUNDING;
        let quarters = sum - ROUNDING;
        let r = ((x - quarters * QUARTER[0]) - quarters * QUARTER[1]) - quarters * QUARTER[2];
        let squared = r * r;
        let sine = r + r * (squared * polynomial(&SINE, squared));
        let cosine = (1.0 - 0.5 * squared) + squared * (squared * polynomial(&COSINE, squared));
        (sines[k], cosines[k]) = turned(sine, cosine, sum);
    }
    if largest > LARGEST {
        for k in 0..N {
            if angles[k].abs() > LARGEST {
                (sines[k], cosines[k]) = angles[k].sin_cos();
            }
        }
    }
    (sines, cosines)
}

/// Angles [rad] of the directions (x, y), from -pi to pi.
#[inline(always)]
pub fn atan2_of<const N: usize>(y: [f64; N], x: [f64; N]) -> [f64; N] {
    let mut angles = [0.0; N];
    for k in 0..N {
        let (rise, run) = (y[k].abs(), x[k].abs());
        let steep = rise > run;
        let (low, high) = (chosen(steep, run, rise), chosen(steep, rise, run));
        // beyond pi/8 the angle from pi/4
        let far = low > EIGHTH * high;
        let over = chosen(far, low - high, low);
        let under = chosen(far, low + high, high);
        let z = over / chosen(under == 0.0, 1.0, under);
        let squared = z * z;
        let arc = chosen(far, FRAC_PI_4, 0.0) + (z + z * (squared * polynomial(&ARC, squared)));
        let arc = chosen(steep, FRAC_PI_2 - arc, arc);
        let arc = chosen(x[k].is_sign_negative(), PI - arc, arc);
        angles[k] = arc.copysign(y[k]);
    }
    angles
}

/// Sine and cosine of an angle [rad].
#[inline(always)]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    let ([sine], [cosine]) = sin_cos_of([angle]);
    (sine, cosine)
}

/// Angle [rad] of the direction (x, y), from -pi to pi.
#[inline(always)]
pub fn atan2(y: f64, x: f64) -> f64 {
    let [angle] = atan2_of([y], [x]);
    angle
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of either sign between 1e-9 and 1e6, and some that lie on edges.
    fn numbers() -> Vec<f64> {
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / 9_007_199_254_740_992.0
        };
        let edges = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            EIGHTH,
            FRAC_PI_4,
            FRAC_PI_2,
            PI,
            -PI,
            100.0 * PI,
            LARGEST,
            1e300,
            -1e300,
            1e-300,
        ];
        let drawn = (0..20_000).map(|_| {
            let size = 10f64.powf(-9.0 + 15.0 * random());
            if random() < 0.5 { size } else { -size }
        });
        edges
            .into_iter()
            .chain(drawn.collect::<Vec<_>>())
            .chain((-50..50).map(|k| f64::from(k) * FRAC_PI_4))
            .collect()
    }

    /// Units in the last place of `b` between the two.
    fn apart(a: f64, b: f64) -> f64 {
        if a == b { 0.0 } else { (a - b).abs() / (f64::from_bits(b.abs().to_bits() + 1) - b.abs()) }
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_standard_library_to_the_last_places() {
        for x in numbers() {
            let ((s, c), (sine, cosine)) = (sin_cos(x), x.sin_cos());
            assert!(apart(s, sine) <= 2.0 && apart(c, cosine) <= 2.0, "{x}: {s} {sine}, {c} {cosine}");
            let (s, c) = sin_cos(-x);
            assert_eq!((-s, c), sin_cos(x), "{x}");
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }

    #[test]
    fn angles_of_directions_are_those_of_the_standard_library_to_the_last_places() {
        let all = numbers();
        for (y, x) in all.iter().zip(all.iter().rev()).chain(all.iter().zip(all.iter())) {
            let (found, known) = (atan2(*y, *x), y.atan2(*x));
            assert!(apart(found, known) <= 2.0, "{y} {x}: {found} {known}");
            assert_eq!(found.is_sign_negative(), known.is_sign_negative(), "{y} {x}");
        }
        for (y, x) in
            [(0.0, 0.0), (-0.0, 0.0), (0.0, -0.0), (-0.0, -0.0), (0.0, -2.0), (3.0, 0.0), (-3.0, -0.0)]
        {
            assert_eq!(atan2(y, x).to_bits(), f64::atan2(y, x).to_bits(), "{y} {x}");
        }
    }

    #[test]
    fn what_is_no_number_stays_none() {
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
        assert!(atan2(f64::NAN, 1.0).is_nan() && atan2(1.0, f64::NAN).is_nan());
    }

    #[test]
    fn each_of_several_has_the_bits_it_has_alone() {
        for x in numbers().chunks_exact(4) {
            let x = [x[0], x[1], x[2], x[3]];
            let (sines, cosines) = sin_cos_of(x);
            let angles = atan2_of(x, [x[3], x[0], x[1], x[2]]);
            for k in 0..4 {
                assert_eq!((sines[k], cosines[k]), sin_cos(x[k]));
                assert_eq!(angles[k], atan2(x[k], x[(k + 3) % 4]));
            }
        }
    }
}
