//! Arithmetic on vectors of numbers, one for each point, with the roots of choice.

use super::arithmetic::Arithmetic;
use pulp::Simd;

/// Keeps roots and quotients finite where everything vanishes; reached below lengths of 1e-18 m only.
pub(super) const LEAST_SQUARE: f64 = 1e-300;

/// Square roots of positive numbers.
pub(super) trait Roots<S: Simd>: Copy {
    /// Square root.
    fn sqrt(self, on: Lanes<S, Self>, x: S::f64s) -> S::f64s;
    /// One over the square root.
    fn reciprocal_sqrt(self, on: Lanes<S, Self>, x: S::f64s) -> S::f64s;
}

/// Operations on vectors of `S`, with roots by `R`.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S, R> {
    /// Instruction set.
    pub simd: S,
    roots: R,
}

impl<S: Simd, R: Roots<S>> Lanes<S, R> {
    /// Points of a vector.
    pub const COUNT: usize = S::F64_LANES;

    pub fn new(simd: S, roots: R) -> Self {
        Self { simd, roots }
    }
    #[inline(always)]
    pub fn sub(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.sub_f64s(a, b)
    }
    #[inline(always)]
    pub fn div(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.div_f64s(a, b)
    }
    #[inline(always)]
    pub fn min(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.min_f64s(a, b)
    }
    #[inline(always)]
    pub fn abs(self, a: S::f64s) -> S::f64s {
        self.simd.abs_f64s(a)
    }
    #[inline(always)]
    pub fn greater(self, a: S::f64s, b: S::f64s) -> S::m64s {
        self.simd.greater_than_f64s(a, b)
    }
    #[inline(always)]
    pub fn not_greater(self, a: S::f64s, b: S::f64s) -> S::m64s {
        self.simd.less_than_or_equal_f64s(a, b)
    }
    #[inline(always)]
    pub fn select(self, truth: S::m64s, yes: S::f64s, no: S::f64s) -> S::f64s {
        self.simd.select_f64s(truth, yes, no)
    }
    /// Square root of positive numbers.
    #[inline(always)]
    pub fn sqrt(self, a: S::f64s) -> S::f64s {
        self.roots.sqrt(self, a)
    }
}

impl<S: Simd, R: Roots<S>> Arithmetic for Lanes<S, R> {
    type Vector = S::f64s;
    type Number = f64;
    #[inline(always)]
    fn constant(self, x: f64) -> S::f64s {
        self.simd.splat_f64s(x)
    }
    #[inline(always)]
    fn splat(self, x: f64) -> S::f64s {
        self.simd.splat_f64s(x)
    }
    #[inline(always)]
    fn add(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.add_f64s(a, b)
    }
    #[inline(always)]
    fn mul(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.mul_f64s(a, b)
    }
    #[inline(always)]
    fn mul_add(self, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
        self.simd.mul_add_e_f64s(a, b, c)
    }
    #[inline(always)]
    fn sub_mul(self, c: S::f64s, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.negate_mul_add_e_f64s(a, b, c)
    }
    #[inline(always)]
    fn max(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.simd.max_f64s(a, b)
    }
    #[inline(always)]
    fn reciprocal_sqrt(self, a: S::f64s) -> S::f64s {
        self.roots.reciprocal_sqrt(self, a)
    }
}
