//! Numbers that carry their gradient and Hessian: exact second variations without algebra by hand.

use std::ops::{Add, Mul, Neg, Sub};

/// Value, gradient and Hessian with respect to `N` variables (Taylor number of second order).
#[derive(Clone, Copy, Debug)]
pub struct Jet<const N: usize> {
    /// Value.
    pub value: f64,
    /// First derivatives.
    pub gradient: [f64; N],
    /// Second derivatives.
    pub hessian: [[f64; N]; N],
}

impl<const N: usize> Jet<N> {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self { value, gradient: [0.0; N], hessian: [[0.0; N]; N] }
    }
    /// Variable number `i` with value `value`.
    pub fn variable(value: f64, i: usize) -> Self {
        let mut jet = Self::constant(value);
        jet.gradient[i] = 1.0;
        jet
    }
    /// Function with value `f`, first derivative `df` and second derivative `ddf` at `self.value`.
    pub fn chain(self, f: f64, df: f64, ddf: f64) -> Self {
        let mut out = Self::constant(f);
        for i in 0..N {
            out.gradient[i] = df * self.gradient[i];
            for j in 0..N {
                out.hessian[i][j] = df * self.hessian[i][j] + ddf * self.gradient[i] * self.gradient[j];
            }
        }
        out
    }
    /// Square root.
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root, -0.25 / (root * self.value))
    }
    /// Reciprocal.
    pub fn recip(self) -> Self {
        let r = 1.0 / self.value;
        self.chain(r, -r * r, 2.0 * r * r * r)
    }
    /// Sine and cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }
    /// Square.
    pub fn squared(self) -> Self {
        self * self
    }
}

impl<const N: usize> Add for Jet<N> {
    type Output = Self;
    fn add(mut self, o: Self) -> Self {
        self.value += o.value;
        for i in 0..N {
            self.gradient[i] += o.gradient[i];
            for j in 0..N {
                self.hessian[i][j] += o.hessian[i][j];
            }
        }
        self
    }
}
impl<const N: usize> Neg for Jet<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}
impl<const N: usize> Sub for Jet<N> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl<const N: usize> Mul<f64> for Jet<N> {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        self.chain(k * self.value, k, 0.0)
    }
}
impl<const N: usize> Mul for Jet<N> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let mut out = Self::constant(self.value * o.value);
        for i in 0..N {
            out.gradient[i] = self.gradient[i] * o.value + self.value * o.gradient[i];
            for j in 0..N {
                out.hessian[i][j] = self.hessian[i][j] * o.value
                    + self.gradient[i] * o.gradient[j]
                    + self.gradient[j] * o.gradient[i]
                    + self.value * o.hessian[i][j];
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivatives_equal_central_differences_of_first() {
        let f = |x: f64, y: f64| {
            let (x, y) = (Jet::<2>::variable(x, 0), Jet::<2>::variable(y, 1));
            let (s, c) = (x * y).sin_cos();
            s * (x.squared() + Jet::constant(1.5)).sqrt() - (c + Jet::constant(3.0)).recip() * y
        };
        let (x, y, h) = (0.7, -0.4, 1e-5);
        let at = f(x, y);
        for i in 0..2 {
            let gradient_x = (f(x + h, y).gradient[i] - f(x - h, y).gradient[i]) / (2.0 * h);
            let gradient_y = (f(x, y + h).gradient[i] - f(x, y - h).gradient[i]) / (2.0 * h);
            assert!((at.hessian[i][0] - gradient_x).abs() < 1e-9);
            assert!((at.hessian[i][1] - gradient_y).abs() < 1e-9);
        }
        let slope = (f(x + h, y).value - f(x - h, y).value) / (2.0 * h);
        assert!((at.gradient[0] - slope).abs() < 1e-9);
    }
}
