//! Square roots and their reciprocals, by the fastest means that is exact to rounding.

use super::lanes::{Lanes, Roots};
use crate::vortex::arithmetic::Arithmetic;
use pulp::Simd;

/// The instructions for root and division.
#[derive(Clone, Copy)]
pub(super) struct Exact;

impl<S: Simd> Roots<S> for Exact {
    #[inline(always)]
    fn sqrt(self, on: Lanes<S, Self>, x: S::f64s) -> S::f64s {
        on.simd.sqrt_f64s(x)
    }
    #[inline(always)]
    fn reciprocal_sqrt(self, on: Lanes<S, Self>, x: S::f64s) -> S::f64s {
        on.div(on.splat(1.0), self.sqrt(on, x))
    }
}

/// One Newton step for 1 / sqrt(x); an error e of the estimate becomes 3/2 e^2.
#[inline(always)]
fn newton_step<S: Simd, R: Roots<S>>(on: Lanes<S, R>, half_x: S::f64s, estimate: S::f64s) -> S::f64s {
    let half_defect = on.sub_mul(on.splat(0.5), on.mul(half_x, estimate), estimate);
    on.mul_add(estimate, half_defect, estimate)
}

/// 1 / sqrt(x) from an estimate good to 2^-14: one step to 2^-27, one below rounding.
#[inline(always)]
fn refined_reciprocal<S: Simd, R: Roots<S>>(on: Lanes<S, R>, x: S::f64s, estimate: S::f64s) -> S::f64s {
    let half_x = on.mul(on.splat(0.5), x);
    newton_step(on, half_x, newton_step(on, half_x, estimate))
}

/// sqrt(x) from the same estimate: one step for the reciprocal, one for x times it.
#[inline(always)]
fn refined_root<S: Simd, R: Roots<S>>(on: Lanes<S, R>, x: S::f64s, estimate: S::f64s) -> S::f64s {
    let reciprocal = newton_step(on, on.mul(on.splat(0.5), x), estimate);
    let root = on.mul(x, reciprocal);
    let half_defect = on.sub_mul(on.splat(0.5), on.mul(on.splat(0.5), root), reciprocal);
    on.mul_add(root, half_defect, root)
}

/// Estimates of AVX-512, refined.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(super) struct Refined;

#[cfg(target_arch = "x86_64")]
mod avx512 {
    use super::{Lanes, Refined, Roots, refined_reciprocal, refined_root};
    use pulp::bytemuck::cast;
    use pulp::f64x8;
    use pulp::x86::V4;

    impl Roots<V4> for Refined {
        #[inline(always)]
        fn sqrt(self, on: Lanes<V4, Self>, x: f64x8) -> f64x8 {
            refined_root(on, x, cast(on.simd.avx512f._mm512_rsqrt14_pd(cast(x))))
        }
        #[inline(always)]
        fn reciprocal_sqrt(self, on: Lanes<V4, Self>, x: f64x8) -> f64x8 {
            refined_reciprocal(on, x, cast(on.simd.avx512f._mm512_rsqrt14_pd(cast(x))))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Exact, Lanes, refined_reciprocal, refined_root};
    use pulp::Scalar;

    /// AVX-512 is not everywhere: its refinement, from the worst estimates it may start with, on any machine.
    #[test]
    fn two_steps_from_fourteen_bits_reach_rounding() {
        let on = Lanes::<Scalar, Exact>::new(Scalar::new(), Exact);
        for x in [1e-299, 3e-40, 0.7, 1.0, 1.999, 4.0, 12345.678, 9e200] {
            for error in [-1.0, -0.4, 0.0, 0.7, 1.0] {
                let exact = f64::sqrt(x);
                let estimate = (1.0 + error * f64::powi(2.0, -14)) / exact;
                let reciprocal = refined_reciprocal(on, x, estimate);
                assert!(
                    (reciprocal * exact - 1.0).abs() <= 6e-16,
                    "{x} {error}: {:e}",
                    reciprocal * exact - 1.0
                );
                let root = refined_root(on, x, estimate);
                assert!((root / exact - 1.0).abs() <= 4.5e-16, "{x} {error}: {:e}", root / exact - 1.0);
            }
        }
    }
}
