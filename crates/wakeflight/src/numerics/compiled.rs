//! The door to loops over plain numbers that are compiled for the instruction set in use.
//!
//! Products and sums are never contracted and keep their order: every instruction set gives the same bits.

use super::instruction_set::InstructionSet;
use pulp::{Scalar, Simd, WithSimd};

/// Numbers of a block: loops over blocks of this length become a vector or a few, without a rest.
pub const BLOCK: usize = 8;

/// A computation whose loops the compiler turns into vectors; it and what it calls must be inlined.
pub trait Loops {
    /// What it leaves.
    type Output;
    /// Does it.
    fn run(self) -> Self::Output;
}

struct In<T>(T);

impl<T: Loops> WithSimd for In<T> {
    type Output = T::Output;
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> T::Output {
        self.0.run()
    }
}

/// Runs `task`, compiled for the instruction set in use.
#[cfg(target_arch = "x86_64")]
pub fn compiled<T: Loops>(task: T) -> T::Output {
    use pulp::x86::{V3, V4};
    let set = InstructionSet::in_use();
    let wide = if set == InstructionSet::Avx512 { V4::try_new() } else { None };
    let narrow = if set == InstructionSet::Vector { V3::try_new() } else { None };
    if let Some(simd) = wide {
        Simd::vectorize(simd, In(task))
    } else if let Some(simd) = narrow {
        Simd::vectorize(simd, In(task))
    } else {
        Scalar.vectorize(In(task))
    }
}

/// Runs `task`, compiled for the instruction set in use.
#[cfg(not(target_arch = "x86_64"))]
pub fn compiled<T: Loops>(task: T) -> T::Output {
    match InstructionSet::in_use() {
        InstructionSet::Scalar => Scalar.vectorize(In(task)),
        _ => pulp::Arch::new().dispatch(In(task)),
    }
}
