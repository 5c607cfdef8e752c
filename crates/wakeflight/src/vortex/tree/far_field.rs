//! Velocity of the expansion of a cell, several points at a time.

use super::harmonics::{N_COEFFICIENTS, VELOCITY_DEGREE};
use crate::vortex::kernel::{Vectors, dot};
use crate::vortex::lanes::{LEAST_SQUARE, Lanes, Roots};
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

    // real and imaginary parts are summed apart, cell by cell: one long chain of additions would set the pace
    let (mut of_re, mut of_im) = ([on.splat(0.0); 3], [on.splat(0.0); 3]);
    let (of_order_0, mut rest) = coefficients.as_chunks::<3>().0.split_at(VELOCITY_DEGREE);
    let (mut before, mut last) = (on.splat(0.0), inverse);
    for n in 1..VELOCITY_DEGREE + 1 {
        let back = on.mul(on.splat(BACK[0][n]), inverse_sq);
        let value = on.sub_mul(on.mul(z, last), back, before);
        (before, last) = (last, value);
        add_product(on, &of_order_0[n - 1], value, &mut of_re);
    }

    let (mut top_re, mut top_im) = (inverse, on.splat(0.0));
    for m in 1..VELOCITY_DEGREE + 1 {
        (top_re, top_im) =
            (on.sub_mul(on.mul(x, top_re), y, top_im), on.mul_add(x, top_im, on.mul(y, top_re)));
        let (mut last_re, mut last_im) = (top_re, top_im);
        let (mut before_re, mut before_im) = (on.splat(0.0), on.splat(0.0));
        let (of_order, others) = rest.split_at(2 * (VELOCITY_DEGREE + 1 - m));
        rest = others;
        for n in m..VELOCITY_DEGREE + 1 {
            if n > m {
                let back = on.mul(on.splat(BACK[m][n]), inverse_sq);
                let re = on.sub_mul(on.mul(z, last_re), back, before_re);
                let im = on.sub_mul(on.mul(z, last_im), back, before_im);
                (before_re, before_im) = (last_re, last_im);
                (last_re, last_im) = (re, im);
            }
            add_product(on, &of_order[2 * (n - m)], last_re, &mut of_re);
            add_product(on, &of_order[2 * (n - m) + 1], last_im, &mut of_im);
        }
    }
    for axis in 0..3 {
        sum[axis] = on.add(sum[axis], on.add(of_re[axis], of_im[axis]));
    }
}

/// Adds `factors` times `value` to the components of `sum`.
#[inline(always)]
fn add_product<S: Simd, R: Roots<S>>(
    on: Lanes<S, R>,
    factors: &[f64; 3],
    value: S::f64s,
    sum: &mut Vectors<S>,
) {
    for axis in 0..3 {
        sum[axis] = on.mul_add(on.splat(factors[axis]), value, sum[axis]);
    }
}
