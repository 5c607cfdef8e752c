//! Velocity of the expansion of a cell, several points at a time.

use super::harmonics::{N_COEFFICIENTS, VELOCITY_DEGREE};
use crate::vortex::kernel::{Vectors, dot};
use crate::vortex::lanes::{LEAST_SQUARE, Lanes};
use crate::vortex::roots::Roots;
use pulp::Simd;

/// Factor of I_(n-2)^m in the recurrence of I_n^m / (2 n - 1)!!, order after order.
const BACK: [[f64; VELOCITY_DEGREE + 1]; VELOCITY_DEGREE + 1] = {
    let mut back = [[0.0; VELOCITY_DEGREE + 1]; VELOCITY_DEGREE + 1];
    let mut m = 0;
    while m <= VELOCITY_DEGREE {
        let mut n = m + 2;
        while n <= VELOCITY_DEGREE {
            back[m][n] = ((n - 1) * (n - 1) - m * m) as f64 / ((2 * n - 1) * (2 * n - 3)) as f64;
            n += 1;
        }
        m += 1;
    }
    back
};

/// Adds sum over n, m of the coefficients times I_n^m / (2 n - 1)!! about `centre`.
#[inline(always)]
pub(super) fn over_harmonics<S: Simd, R: Roots<S>>(
    on: Lanes<S, R>,
    points: &Vectors<S>,
    centre: &[f64; 3],
    coefficients: &[f64; N_COEFFICIENTS],
    sum: &mut Vectors<S>,
) {
    let separation = [
        on.sub(points[0], on.splat(centre[0])),
        on.sub(points[1], on.splat(centre[1])),
        on.sub(points[2], on.splat(centre[2])),
    ];
    let distance_sq = on.max(dot(on, &separation, &separation), on.splat(LEAST_SQUARE));
    let inverse = on.reciprocal_sqrt(distance_sq);
    let inverse_sq = on.mul(inverse, inverse);
    let x = on.mul(separation[0], inverse_sq);
    let y = on.mul(separation[1], inverse_sq);
    let z = on.mul(separation[2], inverse_sq);

    // order 0 is real
    let (mut before, mut last) = (on.splat(0.0), inverse);
    let mut next = 0;
    for n in 1..=VELOCITY_DEGREE {
        let back = on.mul(on.splat(BACK[0][n]), inverse_sq);
        let value = on.sub_mul(on.mul(z, last), back, before);
        (before, last) = (last, value);
        for axis in 0..3 {
            sum[axis] = on.mul_add(on.splat(coefficients[next + axis]), value, sum[axis]);
        }
        next += 3;
    }

    let (mut top_re, mut top_im) = (inverse, on.splat(0.0));
    for m in 1..=VELOCITY_DEGREE {
        (top_re, top_im) =
            (on.sub_mul(on.mul(x, top_re), y, top_im), on.mul_add(x, top_im, on.mul(y, top_re)));
        let (mut last_re, mut last_im) = (top_re, top_im);
        let (mut before_re, mut before_im) = (on.splat(0.0), on.splat(0.0));
        for n in m..=VELOCITY_DEGREE {
            if n > m {
                let back = on.mul(on.splat(BACK[m][n]), inverse_sq);
                let re = on.sub_mul(on.mul(z, last_re), back, before_re);
                let im = on.sub_mul(on.mul(z, last_im), back, before_im);
                (before_re, before_im) = (last_re, last_im);
                (last_re, last_im) = (re, im);
            }
            for axis in 0..3 {
                sum[axis] = on.mul_add(on.splat(coefficients[next + axis]), last_re, sum[axis]);
                sum[axis] = on.mul_add(on.splat(coefficients[next + 3 + axis]), last_im, sum[axis]);
            }
            next += 6;
        }
    }
}
