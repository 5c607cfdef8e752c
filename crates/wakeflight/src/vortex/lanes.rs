//! Arithmetic on `B` vectors at once: independent work that hides the latency of roots and products.

use super::roots::Roots;
use pulp::Simd;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

/// One number for each of `B * S::F64_LANES` points.
pub(super) type Block<S, const B: usize> = [<S as Simd>::f64s; B];

/// Operations on blocks: lanes of `S`, roots by `R`.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S, R, const B: usize> {
    simd: S,
    roots: R,
}

/// One truth for each point.
type Truth<S, const B: usize> = [<S as Simd>::m64s; B];

impl<S: Simd, R: Roots<S>, const B: usize> Lanes<S, R, B> {
    /// Points of a block.
    pub const COUNT: usize = B * S::F64_LANES;

    pub fn new(simd: S, roots: R) -> Self {
        Self { simd, roots }
    }
    #[inline(always)]
    pub fn splat(self, x: f64) -> Block<S, B> {
        [self.simd.splat_f64s(x); B]
    }
    #[inline(always)]
    pub fn add(self, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.add_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn sub(self, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.sub_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn mul(self, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.mul_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn div(self, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.div_f64s(a[i], b[i]))
    }
    /// a b + c.
    #[inline(always)]
    pub fn mul_add(self, a: Block<S, B>, b: Block<S, B>, c: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.mul_add_e_f64s(a[i], b[i], c[i]))
    }
    /// c - a b.
    #[inline(always)]
    pub fn sub_mul(self, c: Block<S, B>, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.negate_mul_add_e_f64s(a[i], b[i], c[i]))
    }
    #[inline(always)]
    pub fn max(self, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.max_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn min(self, a: Block<S, B>, b: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.min_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn abs(self, a: Block<S, B>) -> Block<S, B> {
        a.map(|a| self.simd.abs_f64s(a))
    }
    #[inline(always)]
    pub fn greater(self, a: Block<S, B>, b: Block<S, B>) -> Truth<S, B> {
        std::array::from_fn(|i| self.simd.greater_than_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn not_greater(self, a: Block<S, B>, b: Block<S, B>) -> Truth<S, B> {
        std::array::from_fn(|i| self.simd.less_than_or_equal_f64s(a[i], b[i]))
    }
    #[inline(always)]
    pub fn select(self, truth: Truth<S, B>, yes: Block<S, B>, no: Block<S, B>) -> Block<S, B> {
        std::array::from_fn(|i| self.simd.select_f64s(truth[i], yes[i], no[i]))
    }
    /// Square root of positive numbers.
    #[inline(always)]
    pub fn sqrt(self, a: Block<S, B>) -> Block<S, B> {
        self.roots.sqrt(self, a)
    }
    /// One over the square root of positive numbers.
    #[inline(always)]
    pub fn reciprocal_sqrt(self, a: Block<S, B>) -> Block<S, B> {
        self.roots.reciprocal_sqrt(self, a)
    }
    /// Any function of two numbers, one point after the other.
    #[inline(always)]
    pub fn each(self, a: Block<S, B>, b: Block<S, B>, f: impl Fn(f64, f64) -> f64) -> Block<S, B> {
        let mut result = a;
        let others: &[f64] = cast_slice(&b);
        let own: &mut [f64] = cast_slice_mut(&mut result);
        for (x, y) in own.iter_mut().zip(others) {
            *x = f(*x, *y);
        }
        result
    }
    /// The vectors themselves, one result for each.
    #[inline(always)]
    pub fn map(self, a: Block<S, B>, f: impl Fn(S, S::f64s) -> S::f64s) -> Block<S, B> {
        a.map(|a| f(self.simd, a))
    }
}
