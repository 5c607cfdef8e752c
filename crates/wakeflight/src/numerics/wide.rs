//! Dual numbers whose derivatives lie in vector registers, and the door to code compiled for them.
//!
//! The compiler takes an array of derivatives apart and puts few of its operations back into vectors; named vectors make
//! the same equations five times faster. Products and sums are never contracted: every instruction set gives the same bits.

#[cfg(target_arch = "x86_64")]
use super::instruction_set::InstructionSet;
use super::scalar::Real;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use pulp::{Scalar, Simd, WithSimd};
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// Derivative directions carried at once.
pub const DIRECTIONS: usize = 16;
/// The same where there are few.
pub const FEW: usize = DIRECTIONS / 2;

/// A real number with derivatives along `DIRECTIONS` directions that can be set and read one by one.
pub trait Directional: Real {
    /// Sets the derivative along direction `lane`.
    fn set_slope(&mut self, lane: usize, slope: f64);
    /// Derivatives along all directions, zero along those that are not carried.
    fn slopes(&self) -> [f64; DIRECTIONS];
}

/// An instruction set of which a value can be had where none was handed in.
pub trait Known: Simd {
    /// The instruction set.
    fn known() -> Self;
}

impl Known for Scalar {
    #[inline(always)]
    fn known() -> Self {
        Scalar
    }
}

/// Value and derivatives in `K` vectors of the instruction set `S`.
#[derive(Clone, Copy, Debug)]
struct Wide<S: Known, const K: usize> {
    re: f64,
    eps: [S::f64s; K],
}

impl<S: Known, const K: usize> Real for Wide<S, K> {
    #[inline(always)]
    fn cst(value: f64) -> Self {
        Self { re: value, eps: [S::known().splat_f64s(0.0); K] }
    }
    #[inline(always)]
    fn re(self) -> f64 {
        self.re
    }
    #[inline(always)]
    fn chain(self, f: f64, df: f64) -> Self {
        let s = S::known();
        let df = s.splat_f64s(df);
        let mut eps = self.eps;
        for i in 0..K {
            eps[i] = s.mul_f64s(df, eps[i]);
        }
        Self { re: f, eps }
    }
}

impl<S: Known, const K: usize> Directional for Wide<S, K> {
    fn set_slope(&mut self, lane: usize, slope: f64) {
        let lanes: &mut [f64] = cast_slice_mut(&mut self.eps);
        lanes[lane] = slope;
    }
    fn slopes(&self) -> [f64; DIRECTIONS] {
        let lanes: &[f64] = cast_slice(&self.eps);
        std::array::from_fn(|i| lanes.get(i).copied().unwrap_or_default())
    }
}

impl<S: Known, const K: usize> Add for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let s = S::known();
        let mut eps = self.eps;
        for i in 0..K {
            eps[i] = s.add_f64s(eps[i], o.eps[i]);
        }
        Self { re: self.re + o.re, eps }
    }
}
impl<S: Known, const K: usize> Sub for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        let s = S::known();
        let mut eps = self.eps;
        for i in 0..K {
            eps[i] = s.sub_f64s(eps[i], o.eps[i]);
        }
        Self { re: self.re - o.re, eps }
    }
}
impl<S: Known, const K: usize> Mul for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let s = S::known();
        let (x, y) = (s.splat_f64s(self.re), s.splat_f64s(o.re));
        let mut eps = self.eps;
        for i in 0..K {
            eps[i] = s.add_f64s(s.mul_f64s(eps[i], y), s.mul_f64s(x, o.eps[i]));
        }
        Self { re: self.re * o.re, eps }
    }
}
impl<S: Known, const K: usize> Div for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let inverse = 1.0 / o.re;
        let re = self.re * inverse;
        let s = S::known();
        let (value, scale) = (s.splat_f64s(re), s.splat_f64s(inverse));
        let mut eps = self.eps;
        for i in 0..K {
            eps[i] = s.mul_f64s(s.sub_f64s(eps[i], s.mul_f64s(value, o.eps[i])), scale);
        }
        Self { re, eps }
    }
}
impl<S: Known, const K: usize> Neg for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let s = S::known();
        let mut eps = self.eps;
        for i in 0..K {
            eps[i] = s.neg_f64s(eps[i]);
        }
        Self { re: -self.re, eps }
    }
}
impl<S: Known, const K: usize> Add<f64> for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: f64) -> Self {
        Self { re: self.re + o, ..self }
    }
}
impl<S: Known, const K: usize> Sub<f64> for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: f64) -> Self {
        Self { re: self.re - o, ..self }
    }
}
impl<S: Known, const K: usize> Mul<f64> for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        self.chain(self.re * o, o)
    }
}
impl<S: Known, const K: usize> Div<f64> for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: f64) -> Self {
        self * (1.0 / o)
    }
}
impl<S: Known, const K: usize> AddAssign for Wide<S, K> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<S: Known, const K: usize> SubAssign for Wide<S, K> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
impl<S: Known, const K: usize> MulAssign for Wide<S, K> {
    #[inline(always)]
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}

/// Arithmetic on numbers with derivatives, whatever holds them.
pub trait Task {
    /// What it leaves.
    type Output;
    /// Does it; must be `inline(always)` with everything it calls, or narrow code is called from wide.
    fn run<S: Directional>(self) -> Self::Output;
}

/// A task to be done in `K` vectors of `S`, compiled for the instruction set that it is handed to.
struct In<S, const K: usize, T>(T, PhantomData<S>);

impl<R: Known, const K: usize, T: Task> WithSimd for In<R, K, T> {
    type Output = T::Output;
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> T::Output {
        self.0.run::<Wide<R, K>>()
    }
}

/// Runs `task` in the widest instruction set of the machine.
#[cfg(not(target_arch = "x86_64"))]
pub fn differentiate<T: Task>(task: T) -> T::Output {
    Scalar.vectorize(In::<Scalar, DIRECTIONS, T>(task, PhantomData))
}

/// The same of a task that sets no more than `FEW` directions.
#[cfg(not(target_arch = "x86_64"))]
pub fn differentiate_few<T: Task>(task: T) -> T::Output {
    Scalar.vectorize(In::<Scalar, FEW, T>(task, PhantomData))
}

#[cfg(target_arch = "x86_64")]
pub use x86::{differentiate, differentiate_few};

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{DIRECTIONS, FEW, In, InstructionSet, Known, Task};
    use pulp::x86::{V3, V4};
    use pulp::{Scalar, Simd};
    use std::marker::PhantomData;

    #[allow(
        unsafe_code,
        reason = "numbers of this type exist inside `differentiate` alone, which was handed a V3"
    )]
    impl Known for V3 {
        #[inline(always)]
        fn known() -> Self {
            // SAFETY: see the reason above; `Wide` is private and only named below
            unsafe { V3::new_unchecked() }
        }
    }

    #[allow(
        unsafe_code,
        reason = "numbers of this type exist inside `differentiate` alone, which was handed a V4"
    )]
    impl Known for V4 {
        #[inline(always)]
        fn known() -> Self {
            // SAFETY: see the reason above; `Wide` is private and only named below
            unsafe { V4::new_unchecked() }
        }
    }

    /// Runs `task` in the instruction set in use.
    pub fn differentiate<T: Task>(task: T) -> T::Output {
        in_vectors::<{ DIRECTIONS / 8 }, { DIRECTIONS / 4 }, DIRECTIONS, T>(task)
    }

    /// The same of a task that sets no more than `FEW` directions.
    pub fn differentiate_few<T: Task>(task: T) -> T::Output {
        in_vectors::<{ FEW / 8 }, { FEW / 4 }, FEW, T>(task)
    }

    /// In so many vectors of each instruction set.
    fn in_vectors<const WIDE: usize, const NARROW: usize, const ALONE: usize, T: Task>(task: T) -> T::Output {
        let set = InstructionSet::in_use();
        let wide = if set == InstructionSet::Avx512 { V4::try_new() } else { None };
        let narrow = if set == InstructionSet::Vector { V3::try_new() } else { None };
        if let Some(simd) = wide {
            Simd::vectorize(simd, In::<V4, WIDE, T>(task, PhantomData))
        } else if let Some(simd) = narrow {
            Simd::vectorize(simd, In::<V3, NARROW, T>(task, PhantomData))
        } else {
            Scalar.vectorize(In::<Scalar, ALONE, T>(task, PhantomData))
        }
    }
}
