//! The scalar of every equation: `f64`, or a dual number that carries exact derivatives.

use super::trig;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// `K` functions of two numbers.
pub trait OfTwo<const K: usize> {
    /// Value and derivatives by the first and the second number, of each function.
    fn at(&self, a: f64, b: f64) -> [[f64; 3]; K];
}

/// A real number, possibly with derivatives. Branches look at `re()` only.
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// Whether it carries no derivatives: worth a path of its own through equations asked for again and again.
    const PLAIN: bool = false;

    /// A constant: derivatives zero.
    fn cst(value: f64) -> Self;
    /// The value without derivatives.
    fn re(self) -> f64;
    /// Function with value `f` and derivative `df` at `self.re()` (chain rule).
    fn chain(self, f: f64, df: f64) -> Self;

    /// 0
    #[inline(always)]
    fn zero() -> Self {
        Self::cst(0.0)
    }
    /// 1
    #[inline(always)]
    fn one() -> Self {
        Self::cst(1.0)
    }
    /// Square root; derivative at zero is infinite, callers keep away from it.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.re().sqrt();
        self.chain(root, 0.5 / root)
    }
    /// Sine and cosine.
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = trig::sin_cos(self.re());
        (self.chain(s, c), self.chain(c, -s))
    }
    /// Arcsine.
    #[inline(always)]
    fn asin(self) -> Self {
        let x = self.re();
        self.chain(x.asin(), 1.0 / (1.0 - x * x).sqrt())
    }
    /// Arctangent of y/x with the quadrant of (x, y); `self` is y.
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let (yr, xr) = (self.re(), x.re());
        let squared = xr * xr + yr * yr;
        if squared == 0.0 {
            return Self::cst(trig::atan2(yr, xr));
        }
        // d = (x dy - y dx)/(x^2 + y^2): built from the two chain rules
        self.chain(trig::atan2(yr, xr), xr / squared) + x.chain(0.0, -yr / squared)
    }
    /// Functions of `a` and `b` (chain rule).
    #[inline(always)]
    fn of_two<const K: usize, L: OfTwo<K>>(law: &L, a: Self, b: Self) -> [Self; K] {
        let found = law.at(a.re(), b.re());
        let mut out = [Self::zero(); K];
        for k in 0..K {
            let [value, by_a, by_b] = found[k];
            out[k] = a.chain(value, by_a) + b.chain(0.0, by_b);
        }
        out
    }
    /// Tangent.
    #[inline(always)]
    fn tan(self) -> Self {
        let t = self.re().tan();
        self.chain(t, 1.0 + t * t)
    }
    /// Exponential.
    #[inline(always)]
    fn exp(self) -> Self {
        let e = self.re().exp();
        self.chain(e, e)
    }
    /// Absolute value (derivative +1 at zero).
    #[inline(always)]
    fn abs(self) -> Self {
        if self.re() < 0.0 { -self } else { self }
    }
    /// Square.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
    /// The value kept between two constants; outside, the derivative is zero.
    #[inline(always)]
    fn clamped(self, low: f64, high: f64) -> Self {
        if self.re() < low {
            Self::cst(low)
        } else if self.re() > high {
            Self::cst(high)
        } else {
            self
        }
    }
}

impl Real for f64 {
    const PLAIN: bool = true;

    #[inline(always)]
    fn cst(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn re(self) -> f64 {
        self
    }
    #[inline(always)]
    fn chain(self, f: f64, _df: f64) -> Self {
        f
    }
}

/// Dual number with `N` derivative directions: value and gradient.
#[derive(Clone, Copy, Debug)]
pub struct Dual<const N: usize> {
    /// Value.
    pub re: f64,
    /// Derivatives along the `N` seeded directions.
    pub eps: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// Variable with value `re` that is direction `direction`.
    pub fn variable(re: f64, direction: usize) -> Self {
        let mut eps = [0.0; N];
        eps[direction] = 1.0;
        Self { re, eps }
    }
}

impl<const N: usize> Real for Dual<N> {
    #[inline(always)]
    fn cst(value: f64) -> Self {
        Self { re: value, eps: [0.0; N] }
    }
    #[inline(always)]
    fn re(self) -> f64 {
        self.re
    }
    #[inline(always)]
    fn chain(self, f: f64, df: f64) -> Self {
        Self { re: f, eps: self.eps.map(|e| df * e) }
    }
}

macro_rules! dual_op {
    ($trait:ident, $fn:ident, |$a:ident, $b:ident| $re:expr, |$i:ident| $eps:expr) => {
        impl<const N: usize> $trait for Dual<N> {
            type Output = Self;
            #[inline(always)]
            fn $fn(self, other: Self) -> Self {
                let ($a, $b) = (self, other);
                let mut eps = [0.0; N];
                for $i in 0..N {
                    eps[$i] = $eps;
                }
                Self { re: $re, eps }
            }
        }
    };
}
dual_op!(Add, add, |a, b| a.re + b.re, |i| a.eps[i] + b.eps[i]);
dual_op!(Sub, sub, |a, b| a.re - b.re, |i| a.eps[i] - b.eps[i]);
dual_op!(Mul, mul, |a, b| a.re * b.re, |i| a.eps[i] * b.re + a.re * b.eps[i]);

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.re;
        let re = self.re * inverse;
        let mut eps = [0.0; N];
        for (i, e) in eps.iter_mut().enumerate() {
            *e = (self.eps[i] - re * other.eps[i]) * inverse;
        }
        Self { re, eps }
    }
}
impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, eps: self.eps.map(|e| -e) }
    }
}
impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self { re: self.re + other, eps: self.eps }
    }
}
impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self { re: self.re - other, eps: self.eps }
    }
}
impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self { re: self.re * other, eps: self.eps.map(|e| e * other) }
    }
}
impl<const N: usize> Div<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: f64) -> Self {
        self * (1.0 / other)
    }
}
impl<const N: usize> AddAssign for Dual<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<const N: usize> SubAssign for Dual<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
impl<const N: usize> MulAssign for Dual<N> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expression<S: Real>(x: S, y: S) -> S {
        let (s, c) = (x * y).sin_cos();
        (s + c.exp()) / (x.squared() + 1.5).sqrt() - y.atan2(x) + (x * 0.3).asin() * y.tan()
    }

    #[test]
    fn dual_derivatives_equal_central_differences() {
        let (x, y) = (0.7, -0.4);
        let value = expression(Dual::<2>::variable(x, 0), Dual::<2>::variable(y, 1));
        let h = 1e-6;
        let dx = (expression(x + h, y) - expression(x - h, y)) / (2.0 * h);
        let dy = (expression(x, y + h) - expression(x, y - h)) / (2.0 * h);
        assert!((value.re - expression(x, y)).abs() < 1e-15);
        assert!((value.eps[0] - dx).abs() < 1e-9);
        assert!((value.eps[1] - dy).abs() < 1e-9);
    }
}
