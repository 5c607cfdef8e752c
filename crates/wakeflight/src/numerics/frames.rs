//! Vectors that know their frame, and the rotations between frames.
//!
//! Adding a hub force to a body force does not compile. The markers cost nothing at run time.

use super::scalar::Real;
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Inertial: north, east, down.
#[derive(Clone, Copy, Debug)]
pub struct Inertial;
/// Airframe: x forward, y right, z down; origin at the nominal gross centre of gravity.
#[derive(Clone, Copy, Debug)]
pub struct Body;
/// Hub, non-rotating (suffix `_h`): x aft, y right, z up along the shaft; origin at the hub centre.
#[derive(Clone, Copy, Debug)]
pub struct Hub;
/// Rotating with one blade: x outboard, y toward the leading edge, z up along the shaft.
#[derive(Clone, Copy, Debug)]
pub struct Rotating;

/// Vector with components in frame `F`.
#[derive(Debug)]
pub struct Vec3<S, F> {
    /// First component.
    pub x: S,
    /// Second component.
    pub y: S,
    /// Third component.
    pub z: S,
    frame: PhantomData<F>,
}

impl<S: Clone, F> Clone for Vec3<S, F> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Self { x: self.x.clone(), y: self.y.clone(), z: self.z.clone(), frame: PhantomData }
    }
}
impl<S: Copy, F> Copy for Vec3<S, F> {}

impl<S: Real, F> Vec3<S, F> {
    /// From components.
    #[inline(always)]
    pub fn new(x: S, y: S, z: S) -> Self {
        Self { x, y, z, frame: PhantomData }
    }
    /// Zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::new(S::zero(), S::zero(), S::zero())
    }
    /// Constant vector (no derivatives).
    #[inline(always)]
    pub fn cst(v: [f64; 3]) -> Self {
        Self::new(S::cst(v[0]), S::cst(v[1]), S::cst(v[2]))
    }
    /// Components as an array.
    #[inline(always)]
    pub fn array(self) -> [S; 3] {
        [self.x, self.y, self.z]
    }
    /// From an array of components.
    #[inline(always)]
    pub fn from_array(v: [S; 3]) -> Self {
        Self::new(v[0], v[1], v[2])
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> S {
        self.x * o.x + self.y * o.y + self.z * o.z
    }
    /// Vector product.
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self::new(self.y * o.z - self.z * o.y, self.z * o.x - self.x * o.z, self.x * o.y - self.y * o.x)
    }
    /// Length; the derivative is infinite at zero.
    #[inline(always)]
    pub fn norm(self) -> S {
        self.dot(self).sqrt()
    }
    /// Times a constant.
    #[inline(always)]
    pub fn scaled(self, k: f64) -> Self {
        Self::new(self.x * k, self.y * k, self.z * k)
    }
}

impl<S: Real, F> Add for Vec3<S, F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}
impl<S: Real, F> Sub for Vec3<S, F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}
impl<S: Real, F> Neg for Vec3<S, F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}
impl<S: Real, F> Mul<S> for Vec3<S, F> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: S) -> Self {
        Self::new(self.x * k, self.y * k, self.z * k)
    }
}
impl<S: Real, F> AddAssign for Vec3<S, F> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

/// Rotation that takes components in `From` to components in `To`: `v_h = rot_hb * v_b`.
#[derive(Debug)]
pub struct Rotation<S, To, From> {
    /// Rows of the matrix.
    pub rows: [[S; 3]; 3],
    frames: PhantomData<(To, From)>,
}

impl<S: Clone, To, From> Clone for Rotation<S, To, From> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Self { rows: self.rows.clone(), frames: PhantomData }
    }
}
impl<S: Copy, To, From> Copy for Rotation<S, To, From> {}

impl<S: Real, To, From> Rotation<S, To, From> {
    /// From the rows of an orthogonal matrix.
    #[inline(always)]
    pub fn from_rows(rows: [[S; 3]; 3]) -> Self {
        Self { rows, frames: PhantomData }
    }
    /// The inverse rotation.
    #[inline(always)]
    pub fn transposed(self) -> Rotation<S, From, To> {
        let r = &self.rows;
        Rotation::from_rows([
            [r[0][0], r[1][0], r[2][0]],
            [r[0][1], r[1][1], r[2][1]],
            [r[0][2], r[1][2], r[2][2]],
        ])
    }
}

impl<S: Real, To, From> Mul<Vec3<S, From>> for Rotation<S, To, From> {
    type Output = Vec3<S, To>;
    #[inline(always)]
    fn mul(self, v: Vec3<S, From>) -> Vec3<S, To> {
        let r = &self.rows;
        Vec3::new(
            r[0][0] * v.x + r[0][1] * v.y + r[0][2] * v.z,
            r[1][0] * v.x + r[1][1] * v.y + r[1][2] * v.z,
            r[2][0] * v.x + r[2][1] * v.y + r[2][2] * v.z,
        )
    }
}

/// Rotation from body to hub axes for a shaft tilted forward and to the right [rad].
///
/// x_h = -(u cos i + w sin i), y_h = v, z_h = u sin i - w cos i for tilt i forward alone
/// (`flight-dynamics`, frames; lateral tilt as the shaft frame of [howlett1981]).
#[inline(always)]
pub fn rot_hb<S: Real>(tilt_forward: f64, tilt_lateral: f64) -> Rotation<S, Hub, Body> {
    let (st, ct) = (-tilt_forward).sin_cos();
    let (sp, cp) = tilt_lateral.sin_cos();
    // shaft frame with z down, then x and z turned round
    let t = [[ct, 0.0, -st], [st * sp, cp, ct * sp], [st * cp, -sp, ct * cp]];
    let c = S::cst;
    Rotation::from_rows([
        [c(-t[0][0]), c(-t[0][1]), c(-t[0][2])],
        [c(t[1][0]), c(t[1][1]), c(t[1][2])],
        [c(-t[2][0]), c(-t[2][1]), c(-t[2][2])],
    ])
}

/// Rotation from hub axes to the rotating axes of a blade at azimuth `psi` (zero aft, counter-clockwise).
pub fn rot_rh<S: Real>(psi: S) -> Rotation<S, Rotating, Hub> {
    let (s, c) = psi.sin_cos();
    let (o, l) = (S::zero(), S::one());
    Rotation::from_rows([[c, s, o], [-s, c, o], [o, o, l]])
}

/// Rotation from body to inertial axes for a quaternion (w, x, y, z), normalised here.
#[inline(always)]
pub fn rot_ib<S: Real>(q: [S; 4]) -> Rotation<S, Inertial, Body> {
    let n = S::one() / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    let [w, x, y, z] = q;
    let one = S::one();
    let two = n * 2.0;
    Rotation::from_rows([
        [one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)],
        [two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x)],
        [two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)],
    ])
}

/// Unit quaternion (w, x, y, z) of 3-2-1 Euler angles [rad].
pub fn quaternion<S: Real>(roll: S, pitch: S, yaw: S) -> [S; 4] {
    let (sr, cr) = (roll * 0.5).sin_cos();
    let (sp, cp) = (pitch * 0.5).sin_cos();
    let (sy, cy) = (yaw * 0.5).sin_cos();
    [
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_shaft_tilt_turns_about_the_lateral_axis_as_specified() {
        let i: f64 = 0.0524;
        let (u, v, w) = (40.0, 3.0, -2.0);
        let v_h = rot_hb::<f64>(i, 0.0) * Vec3::new(u, v, w);
        assert!((v_h.x + (u * i.cos() + w * i.sin())).abs() < 1e-12);
        assert!((v_h.y - v).abs() < 1e-12);
        assert!((v_h.z - (u * i.sin() - w * i.cos())).abs() < 1e-12);
    }

    #[test]
    fn euler_angles_turn_gravity_into_body_axes() {
        let (roll, pitch) = (0.3_f64, -0.2_f64);
        let r = rot_ib(quaternion(roll, pitch, 1.1)).transposed();
        let g = r * Vec3::<f64, Inertial>::new(0.0, 0.0, 1.0);
        assert!((g.x + pitch.sin()).abs() < 1e-14);
        assert!((g.y - roll.sin() * pitch.cos()).abs() < 1e-14);
        assert!((g.z - roll.cos() * pitch.cos()).abs() < 1e-14);
    }

    #[test]
    fn rotations_are_orthogonal() {
        let r = rot_hb::<f64>(0.05, 0.02);
        let v = Vec3::<f64, Body>::new(1.0, 2.0, 3.0);
        let back = r.transposed() * (r * v);
        assert!((back - v).norm() < 1e-14);
    }
}
