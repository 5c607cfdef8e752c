//! Choice of the instruction set when the program runs.

use super::lanes::Roots;
use super::roots::Exact;
use pulp::{Scalar, Simd, WithSimd};

/// Lanes the sums run in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// One point at a time.
    Scalar,
    /// The widest vectors of this machine that need no more than AVX2, NEON or SIMD128.
    Vector,
    /// Eight points at a time with reciprocal roots by estimate and refinement.
    Avx512,
}

impl InstructionSet {
    /// The widest of this machine.
    #[must_use]
    pub fn widest() -> Self {
        if avx512::available() { Self::Avx512 } else { Self::Vector }
    }
}

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

/// Runs `task` on the given lanes; AVX-512 falls back where it is missing.
pub(super) fn run<T: OverLanes>(task: T, instruction_set: InstructionSet) {
    match instruction_set {
        InstructionSet::Scalar => Scalar.vectorize(Plain(task)),
        InstructionSet::Vector => avx512::without(task),
        InstructionSet::Avx512 => avx512::with(task),
    }
}

#[cfg(target_arch = "x86_64")]
mod avx512 {
    use super::{OverLanes, Plain, Scalar, Simd, WithSimd};
    use crate::vortex::roots::Refined;
    use pulp::x86::{V3, V4};

    pub fn available() -> bool {
        V4::is_available()
    }

    pub fn without<T: OverLanes>(task: T) {
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

    pub fn with<T: OverLanes>(task: T) {
        match V4::try_new() {
            Some(simd) => Simd::vectorize(simd, Wide(simd, task)),
            None => without(task),
        }
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod avx512 {
    use super::{OverLanes, Plain};
    use pulp::Arch;

    pub fn available() -> bool {
        false
    }

    pub fn without<T: OverLanes>(task: T) {
        Arch::new().dispatch(Plain(task));
    }

    pub fn with<T: OverLanes>(task: T) {
        without(task);
    }
}
