//! Arithmetic on vectors of single-precision numbers, one for each point, and the instruction sets it runs on.

use crate::numerics::instruction_set::InstructionSet;
use crate::vortex::arithmetic::Arithmetic;
use pulp::{Scalar, Simd, WithSimd};

/// Twice one over the square root of positive, finite numbers.
pub(in crate::vortex) trait Root<S: Simd>: Copy {
    /// To some units of the last place.
    fn twice_reciprocal_sqrt(self, on: Lanes<S, Self>, x: S::f32s) -> S::f32s;
}

/// Operations on vectors of `S`, with roots by `R`.
#[derive(Clone, Copy)]
pub(in crate::vortex) struct Lanes<S, R> {
    simd: S,
    root: R,
}

impl<S: Simd, R: Root<S>> Lanes<S, R> {
    /// Points of a vector.
    pub const COUNT: usize = S::F32_LANES;

    pub fn new(simd: S, root: R) -> Self {
        Self { simd, root }
    }
    #[inline(always)]
    pub fn sub(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.simd.sub_f32s(a, b)
    }
    #[inline(always)]
    pub fn min(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.simd.min_f32s(a, b)
    }
    #[inline(always)]
    pub fn abs(self, a: S::f32s) -> S::f32s {
        self.simd.abs_f32s(a)
    }
    #[inline(always)]
    pub fn greater(self, a: S::f32s, b: S::f32s) -> S::m32s {
        self.simd.greater_than_f32s(a, b)
    }
    #[inline(always)]
    pub fn select(self, truth: S::m32s, yes: S::f32s, no: S::f32s) -> S::f32s {
        self.simd.select_f32s(truth, yes, no)
    }
    /// Twice one over the square root of positive numbers: a Newton step gives it in one operation less.
    #[inline(always)]
    pub fn twice_reciprocal_sqrt(self, a: S::f32s) -> S::f32s {
        self.root.twice_reciprocal_sqrt(self, a)
    }
}

impl<S: Simd, R: Root<S>> Arithmetic for Lanes<S, R> {
    type Vector = S::f32s;
    type Number = f32;
    #[inline(always)]
    fn constant(self, x: f64) -> S::f32s {
        self.simd.splat_f32s(x as f32)
    }
    #[inline(always)]
    fn splat(self, x: f32) -> S::f32s {
        self.simd.splat_f32s(x)
    }
    #[inline(always)]
    fn add(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.simd.add_f32s(a, b)
    }
    #[inline(always)]
    fn mul(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.simd.mul_f32s(a, b)
    }
    #[inline(always)]
    fn mul_add(self, a: S::f32s, b: S::f32s, c: S::f32s) -> S::f32s {
        self.simd.mul_add_e_f32s(a, b, c)
    }
    #[inline(always)]
    fn sub_mul(self, c: S::f32s, a: S::f32s, b: S::f32s) -> S::f32s {
        self.simd.negate_mul_add_e_f32s(a, b, c)
    }
    #[inline(always)]
    fn max(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.simd.max_f32s(a, b)
    }
    #[inline(always)]
    fn reciprocal_sqrt(self, a: S::f32s) -> S::f32s {
        self.simd.mul_f32s(self.simd.splat_f32s(0.5), self.root.twice_reciprocal_sqrt(self, a))
    }
}

/// The instructions for root and division.
#[derive(Clone, Copy)]
pub(super) struct Exact;

impl<S: Simd> Root<S> for Exact {
    #[inline(always)]
    fn twice_reciprocal_sqrt(self, on: Lanes<S, Self>, x: S::f32s) -> S::f32s {
        on.simd.div_f32s(on.splat(2.0), on.simd.sqrt_f32s(x))
    }
}

/// Twice one Newton step for 1 / sqrt(x), y (3 - x y^2); an error e of the estimate becomes 3/2 e^2.
#[inline(always)]
fn refined<S: Simd, R: Root<S>>(on: Lanes<S, R>, x: S::f32s, estimate: S::f32s) -> S::f32s {
    on.mul(estimate, on.sub_mul(on.splat(3.0), on.mul(x, estimate), estimate))
}

/// A computation on the lanes of any instruction set.
pub(in crate::vortex) trait OverLanes {
    /// Runs on lanes of `S` with roots by `R`; must be inlined.
    fn run<S: Simd, R: Root<S>>(self, simd: S, root: R);
}

/// With the instructions for root and division.
struct Plain<T>(T);

impl<T: OverLanes> WithSimd for Plain<T> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.0.run(simd, Exact);
    }
}

/// Runs `task` on the given lanes; a set that is missing falls back to the next narrower one.
pub(in crate::vortex) fn run<T: OverLanes>(task: T, instruction_set: InstructionSet) {
    match instruction_set {
        InstructionSet::Scalar => Scalar.vectorize(Plain(task)),
        InstructionSet::Vector => wide::vector(task),
        InstructionSet::Avx512 => wide::avx512(task),
    }
}

#[cfg(target_arch = "x86_64")]
mod wide {
    use super::{Lanes, OverLanes, Plain, Root, Scalar, Simd, WithSimd, refined};
    use pulp::bytemuck::cast;
    use pulp::x86::{V3, V4};
    use pulp::{f32x8, f32x16};

    /// From the estimate of the instruction set, good to 1.5 2^-12 (AVX) or 2^-14 (AVX-512).
    #[derive(Clone, Copy)]
    struct Refined;

    impl Root<V3> for Refined {
        #[inline(always)]
        fn twice_reciprocal_sqrt(self, on: Lanes<V3, Self>, x: f32x8) -> f32x8 {
            refined(on, x, on.simd.approx_reciprocal_sqrt_f32x8(x))
        }
    }

    impl Root<V4> for Refined {
        #[inline(always)]
        fn twice_reciprocal_sqrt(self, on: Lanes<V4, Self>, x: f32x16) -> f32x16 {
            refined(on, x, cast(on.simd.avx512f._mm512_rsqrt14_ps(cast(x))))
        }
    }

    /// The task with the token of its instruction set, which `WithSimd` would only hand over as some `Simd`.
    struct Wide<S, T>(S, T);

    impl<S: Simd, T: OverLanes> WithSimd for Wide<S, T>
    where
        Refined: Root<S>,
    {
        type Output = ();
        #[inline(always)]
        fn with_simd<Same: Simd>(self, _: Same) {
            self.1.run(self.0, Refined);
        }
    }

    pub fn vector<T: OverLanes>(task: T) {
        match V3::try_new() {
            Some(simd) => Simd::vectorize(simd, Wide(simd, task)),
            None => Scalar.vectorize(Plain(task)),
        }
    }

    pub fn avx512<T: OverLanes>(task: T) {
        match V4::try_new() {
            Some(simd) => Simd::vectorize(simd, Wide(simd, task)),
            None => vector(task),
        }
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod wide {
    use super::{OverLanes, Plain};
    use pulp::Arch;

    pub fn vector<T: OverLanes>(task: T) {
        Arch::new().dispatch(Plain(task));
    }

    pub fn avx512<T: OverLanes>(task: T) {
        vector(task);
    }
}

#[cfg(test)]
mod tests {
    use super::{Exact, Lanes, refined};
    use pulp::Scalar;

    /// AVX-512 is not everywhere: the refinement from the worst estimates that either set starts with, on any machine.
    #[test]
    fn one_step_from_twelve_bits_leaves_four_units_of_the_last_place_one_from_fourteen_two() {
        let on = Lanes::<Scalar, Exact>::new(Scalar::new(), Exact);
        for x in [1e-36f32, 3e-20, 0.7, 1.0, 1.999, 4.0, 12345.678, 9e35] {
            let exact = 1.0 / f64::from(x).sqrt();
            for (largest, allowed) in [(1.5 * f64::powi(2.0, -12), 3.4e-7), (f64::powi(2.0, -14), 1.3e-7)] {
                for error in [-1.0, -0.4, 0.0, 0.7, 1.0] {
                    let estimate = ((1.0 + error * largest) * exact) as f32;
                    let found = f64::from(refined(on, x, estimate)) / (2.0 * exact) - 1.0;
                    assert!(found.abs() <= allowed, "{x} {error}: {found:e}");
                }
            }
        }
    }
}
