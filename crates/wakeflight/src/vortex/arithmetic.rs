//! Operations that vectors of either precision have: what both sums use, and all that an expansion is written in.

/// Operations on vectors of numbers, one for each point.
pub(super) trait Arithmetic: Copy {
    /// Numbers of several points.
    type Vector: Copy;
    /// One number.
    type Number: Copy;
    /// The same number, known to double precision, for all points.
    fn constant(self, x: f64) -> Self::Vector;
    /// The same number for all points.
    fn splat(self, x: Self::Number) -> Self::Vector;
    /// a + b.
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// a b.
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// a b + c.
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector;
    /// c - a b.
    fn sub_mul(self, c: Self::Vector, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// The larger.
    fn max(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// One over the square root of positive numbers.
    fn reciprocal_sqrt(self, a: Self::Vector) -> Self::Vector;
}
