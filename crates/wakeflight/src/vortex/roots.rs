//! Square roots and their reciprocals in several lanes, by the fastest means that is exact to rounding.

use pulp::Simd;

/// Square roots of lanes.
pub(super) trait Roots<S: Simd>: Copy {
    /// Square root of each lane; undefined (but no trap) at zero.
    fn sqrt(self, simd: S, x: S::f64s) -> S::f64s;
    /// One over the square root of each positive, normal lane.
    fn reciprocal_sqrt(self, simd: S, x: S::f64s) -> S::f64s;
}

/// The instructions for root and division.
#[derive(Clone, Copy)]
pub(super) struct Exact;

impl<S: Simd> Roots<S> for Exact {
    #[inline(always)]
    fn sqrt(self, simd: S, x: S::f64s) -> S::f64s {
        simd.sqrt_f64s(x)
    }
    #[inline(always)]
    fn reciprocal_sqrt(self, simd: S, x: S::f64s) -> S::f64s {
        simd.div_f64s(simd.splat_f64s(1.0), simd.sqrt_f64s(x))
    }
}

/// Two Newton steps for 1 / sqrt(x) from an estimate good to 2^-14: 2^-27, then below rounding.
#[inline(always)]
pub(super) fn refined<S: Simd>(simd: S, x: S::f64s, estimate: S::f64s) -> S::f64s {
    let (half, one) = (simd.splat_f64s(0.5), simd.splat_f64s(1.0));
    let mut y = estimate;
    for _ in 0..2 {
        let defect = simd.negate_mul_add_e_f64s(simd.mul_f64s(x, y), y, one);
        y = simd.mul_add_e_f64s(simd.mul_f64s(half, y), defect, y);
    }
    y
}

/// Estimates of AVX-512, refined.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(super) struct Refined;

#[cfg(target_arch = "x86_64")]
impl Roots<pulp::x86::V4> for Refined {
    #[inline(always)]
    fn sqrt(self, simd: pulp::x86::V4, x: pulp::f64x8) -> pulp::f64x8 {
        simd.mul_f64s(x, self.reciprocal_sqrt(simd, x))
    }
    #[inline(always)]
    fn reciprocal_sqrt(self, simd: pulp::x86::V4, x: pulp::f64x8) -> pulp::f64x8 {
        let estimate = simd.avx512f._mm512_rsqrt14_pd(pulp::bytemuck::cast(x));
        refined(simd, x, pulp::bytemuck::cast(estimate))
    }
}

#[cfg(test)]
mod tests {
    use super::refined;
    use pulp::Scalar;

    /// AVX-512 is not everywhere: its refinement, from the worst estimate it may get, on any machine.
    #[test]
    fn two_steps_from_fourteen_bits_reach_rounding() {
        for x in [1e-299, 3e-40, 0.7, 1.0, 1.999, 4.0, 12345.678, 9e200] {
            for error in [-1.0, -0.4, 0.0, 0.7, 1.0] {
                let exact = 1.0 / f64::sqrt(x);
                let y = refined(Scalar::new(), x, exact * (1.0 + error * f64::powi(2.0, -14)));
                assert!((y / exact - 1.0).abs() <= 4.5e-16, "{x} {error}: {:e}", y / exact - 1.0);
            }
        }
    }
}
