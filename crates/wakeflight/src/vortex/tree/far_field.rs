//! Velocity of the expansion of a cell, several points at a time.

use super::harmonics::{N_COEFFICIENTS, VELOCITY_DEGREE};
use crate::vortex::arithmetic::Arithmetic;

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

/// Adds sum over n <= `HIGHEST` and m of the coefficients times I_n^m / (2 n - 1)!! at `separation` from the centre, whose square is
/// at least `least_square`.
#[inline(always)]
pub(super) fn over_harmonics<A: Arithmetic, const HIGHEST: usize>(
    on: A,
    separation: &[A::Vector; 3],
    least_square: f64,
    coefficients: &[A::Number; N_COEFFICIENTS],
    sum: &mut [A::Vector; 3],
) {
    let [x, y, z] = *separation;
    let distance_sq = on.mul_add(x, x, on.mul_add(y, y, on.mul(z, z)));
    let inverse = on.reciprocal_sqrt(on.max(distance_sq, on.constant(least_square)));
    let inverse_sq = on.mul(inverse, inverse);
    let x = on.mul(x, inverse_sq);
    let y = on.mul(y, inverse_sq);
    let z = on.mul(z, inverse_sq);

    // real and imaginary parts are summed apart, cell by cell: one long chain of additions would set the pace
    let (mut of_re, mut of_im) = ([on.constant(0.0); 3], [on.constant(0.0); 3]);
    let (of_order_0, mut rest) = coefficients.as_chunks::<3>().0.split_at(VELOCITY_DEGREE);
    let (mut before, mut last) = (on.constant(0.0), inverse);
    for n in 1..HIGHEST + 1 {
        let back = on.mul(on.constant(BACK[0][n]), inverse_sq);
        let value = on.sub_mul(on.mul(z, last), back, before);
        (before, last) = (last, value);
        add_product(on, &of_order_0[n - 1], value, &mut of_re);
    }

    let (mut top_re, mut top_im) = (inverse, on.constant(0.0));
    for m in 1..HIGHEST + 1 {
        (top_re, top_im) =
            (on.sub_mul(on.mul(x, top_re), y, top_im), on.mul_add(x, top_im, on.mul(y, top_re)));
        let (mut last_re, mut last_im) = (top_re, top_im);
        let (mut before_re, mut before_im) = (on.constant(0.0), on.constant(0.0));
        let (of_order, others) = rest.split_at(2 * (VELOCITY_DEGREE + 1 - m));
        rest = others;
        for n in m..HIGHEST + 1 {
            if n > m {
                let back = on.mul(on.constant(BACK[m][n]), inverse_sq);
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
fn add_product<A: Arithmetic>(on: A, factors: &[A::Number; 3], value: A::Vector, sum: &mut [A::Vector; 3]) {
    for axis in 0..3 {
        sum[axis] = on.mul_add(on.splat(factors[axis]), value, sum[axis]);
    }
}
