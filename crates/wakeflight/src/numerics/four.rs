//! Four real numbers side by side in a vector register: the same equations for four blades at once.
//!
//! No operation is contracted or reordered: each of the four has the bits it would have alone.

use super::scalar::Real;

/// Four numbers that go through equations without branches.
pub trait Four: Real {
    /// From the four.
    fn of(values: [f64; 4]) -> Self;
    /// The four.
    fn values(self) -> [f64; 4];
}

/// Equations to be solved for four at once.
pub trait FourTask {
    /// What it leaves.
    type Output;
    /// Does it; must be `inline(always)` with everything it calls, or narrow code is called from wide.
    fn run<S: Four>(self) -> Self::Output;
}

/// Runs `task` where the machine has registers for four; otherwise hands it back.
#[cfg(not(target_arch = "x86_64"))]
pub fn four_at_once<T: FourTask>(task: T) -> Result<T::Output, T> {
    Err(task)
}

#[cfg(target_arch = "x86_64")]
pub use x86::four_at_once;

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Four, FourTask};
    use crate::numerics::scalar::{OfTwo, Real};
    use crate::numerics::trig;
    use crate::numerics::wide::Known;
    use pulp::bytemuck::cast;
    use pulp::x86::V3;
    use pulp::{Simd, WithSimd, f64x4};
    use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

    /// Private: such numbers exist inside `four_at_once` alone.
    #[derive(Clone, Copy, Debug)]
    struct Quartet(f64x4);

    struct Run<T>(T);
    impl<T: FourTask> WithSimd for Run<T> {
        type Output = T::Output;
        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> T::Output {
            self.0.run::<Quartet>()
        }
    }

    /// Runs `task` where the machine has registers for four; otherwise hands it back.
    pub fn four_at_once<T: FourTask>(task: T) -> Result<T::Output, T> {
        match V3::try_new() {
            Some(simd) => Ok(Simd::vectorize(simd, Run(task))),
            None => Err(task),
        }
    }

    impl Four for Quartet {
        #[inline(always)]
        fn of(values: [f64; 4]) -> Self {
            Self(cast(values))
        }
        #[inline(always)]
        fn values(self) -> [f64; 4] {
            cast(self.0)
        }
    }

    impl Real for Quartet {
        const PLAIN: bool = true;

        #[inline(always)]
        fn cst(value: f64) -> Self {
            Self(V3::known().splat_f64s(value))
        }
        /// Four numbers take no branch together: not a number, so that an equation with one shows.
        #[inline(always)]
        fn re(self) -> f64 {
            f64::NAN
        }
        #[inline(always)]
        fn chain(self, _: f64, _: f64) -> Self {
            Self::cst(f64::NAN)
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            let v = self.values();
            Self::of([v[0].sqrt(), v[1].sqrt(), v[2].sqrt(), v[3].sqrt()])
        }
        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            let (sines, cosines) = trig::sin_cos_of(self.values());
            (Self::of(sines), Self::of(cosines))
        }
        #[inline(always)]
        fn asin(self) -> Self {
            let v = self.values();
            Self::of([v[0].asin(), v[1].asin(), v[2].asin(), v[3].asin()])
        }
        #[inline(always)]
        fn atan2(self, x: Self) -> Self {
            Self::of(trig::atan2_of(self.values(), x.values()))
        }
        #[inline(always)]
        fn of_two<const K: usize, L: OfTwo<K>>(law: &L, a: Self, b: Self) -> [Self; K] {
            let (a, b) = (a.values(), b.values());
            let found = [law.at(a[0], b[0]), law.at(a[1], b[1]), law.at(a[2], b[2]), law.at(a[3], b[3])];
            let mut out = [Self::cst(0.0); K];
            for k in 0..K {
                // the sum with zero is that of the chain rule: the bits of each alone
                out[k] = Self::of([found[0][k][0], found[1][k][0], found[2][k][0], found[3][k][0]]) + 0.0;
            }
            out
        }
    }

    impl Add for Quartet {
        type Output = Self;
        #[inline(always)]
        fn add(self, o: Self) -> Self {
            Self(V3::known().add_f64s(self.0, o.0))
        }
    }
    impl Sub for Quartet {
        type Output = Self;
        #[inline(always)]
        fn sub(self, o: Self) -> Self {
            Self(V3::known().sub_f64s(self.0, o.0))
        }
    }
    impl Mul for Quartet {
        type Output = Self;
        #[inline(always)]
        fn mul(self, o: Self) -> Self {
            Self(V3::known().mul_f64s(self.0, o.0))
        }
    }
    impl Div for Quartet {
        type Output = Self;
        #[inline(always)]
        fn div(self, o: Self) -> Self {
            Self(V3::known().div_f64s(self.0, o.0))
        }
    }
    impl Neg for Quartet {
        type Output = Self;
        #[inline(always)]
        fn neg(self) -> Self {
            Self(V3::known().neg_f64s(self.0))
        }
    }
    impl Add<f64> for Quartet {
        type Output = Self;
        #[inline(always)]
        fn add(self, o: f64) -> Self {
            self + Self::cst(o)
        }
    }
    impl Sub<f64> for Quartet {
        type Output = Self;
        #[inline(always)]
        fn sub(self, o: f64) -> Self {
            self - Self::cst(o)
        }
    }
    impl Mul<f64> for Quartet {
        type Output = Self;
        #[inline(always)]
        fn mul(self, o: f64) -> Self {
            self * Self::cst(o)
        }
    }
    impl Div<f64> for Quartet {
        type Output = Self;
        #[inline(always)]
        fn div(self, o: f64) -> Self {
            self / Self::cst(o)
        }
    }
    impl AddAssign for Quartet {
        #[inline(always)]
        fn add_assign(&mut self, o: Self) {
            *self = *self + o;
        }
    }
    impl SubAssign for Quartet {
        #[inline(always)]
        fn sub_assign(&mut self, o: Self) {
            *self = *self - o;
        }
    }
    impl MulAssign for Quartet {
        #[inline(always)]
        fn mul_assign(&mut self, o: Self) {
            *self = *self * o;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expression<S: Real>(x: S, y: S) -> S {
        let (s, c) = (x * y).sin_cos();
        (s - c * 0.3) / (x.squared() + 1.5).sqrt() + y / (x * 2.0 - 0.1) + (s * 0.5).asin()
    }

    struct Both([f64; 4], [f64; 4]);
    impl FourTask for Both {
        type Output = [f64; 4];
        #[inline(always)]
        fn run<S: Four>(self) -> [f64; 4] {
            expression(S::of(self.0), S::of(self.1)).values()
        }
    }

    #[test]
    fn each_of_four_has_the_bits_it_has_alone() {
        let (x, y) = ([0.7, -1.3, 2.9, 1e-3], [0.1, 5.0, -0.4, 77.0]);
        if let Ok(found) = four_at_once(Both(x, y)) {
            for i in 0..4 {
                assert_eq!(found[i], expression(x[i], y[i]));
            }
        }
    }
}
