//! The sums on the lanes of an instruction set.

use super::lanes::Roots;
use super::roots::Exact;
use crate::numerics::instruction_set::InstructionSet;
use pulp::{Scalar, Simd, WithSimd};

/// A computation on the lanes of any instruction set.
pub(super) trait OverLanes {
    /// Runs on lanes of `S` with roots by `R`; must be inlined.
    fn run<S: Simd, R: Roots<S>>(self, simd: S, roots: R);
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
pub(super) fn run<T: OverLanes>(task: T, instruction_set: InstructionSet) {
    match instruction_set {
        InstructionSet::Scalar => Scalar.vectorize(Plain(task)),
        InstructionSet::Vector => wide::vector(task),
        InstructionSet::Avx512 => wide::avx512(task),
    }
}

#[cfg(target_arch = "x86_64")]
mod wide {
    use super::{OverLanes, Plain, Scalar, Simd, WithSimd};
    use crate::vortex::roots::Refined;
    use pulp::x86::{V3, V4};

    pub fn vector<T: OverLanes>(task: T) {
        match V3::try_new() {
            Some(simd) => Simd::vectorize(simd, Plain(task)),
            None => Scalar.vectorize(Plain(task)),
        }
    }

    /// The task with the token of its instruction set, which `WithSimd` would only hand over as some `Simd`.
    struct Wide<T>(V4, T);

    impl<T: OverLanes> WithSimd for Wide<T> {
        type Output = ();
        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) {
            self.1.run(self.0, Refined);
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
