//! Exact kinematics of a deflected section: position, triad, rates and test motions.
//!
//! The tangent turns by lag, then flap; pitch comes last, about the tangent:
//! sin B = w', sin L = v'/cos B, t = (cos B cos L, cos B sin L, sin B), c0 = (-sin L, cos L, 0), n0 = t x c0,
//! c = c0 cos theta + n0 sin theta, n = n0 cos theta - c0 sin theta.
//! Angular velocity relative to the rotating blade axes: L_dot e_z - B_dot c0 + theta_dot t.
//! The span shortens by l (1 - sqrt(1 - S/l)) + int k_A^2 theta_tw' phi' dx, S = int [v'^2 + w'^2 + k_A^2 phi'^2] dx over
//! the length l inboard: exact for a blade that turns rigidly about its hinge, second order in bending and twist.
//! DEVIATION: the usual S/2 lets the span grow by l sin^4/8 under a rigid turn; centrifugal force then overcomes the
//! small lag stiffness of an articulated blade near 22 deg of lag, which a stalled rotor reaches in a roll reversal.

use super::MAX_MODES;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;

/// Blade axes: the rotating axes turned by the precone; x along the undeflected span.
#[derive(Clone, Copy, Debug)]
pub struct BladeAxes;

/// Modal shapes and their derivatives by span at one station, and the foreshortening form inboard of it.
#[derive(Clone, Debug)]
pub struct StationShapes {
    /// Station [m] from the hub centre.
    pub x: f64,
    /// Length inboard of it, from hinge or clamp [m].
    pub length: f64,
    /// Lead displacement per modal coordinate, and its slope and curvature.
    pub v: [[f64; MAX_MODES]; 3],
    /// Flap displacement, slope, curvature.
    pub w: [[f64; MAX_MODES]; 3],
    /// Pitch angle (elastic twist and pitch-flap coupling) and elastic twist rate by span.
    pub theta: [f64; MAX_MODES],
    /// phi'.
    pub dphi: [f64; MAX_MODES],
    /// Quadratic form of the foreshortening: int (v'v' + w'w' + k_A^2 phi'phi') dx.
    pub shortening: [[f64; MAX_MODES]; MAX_MODES],
    /// Linear form of the foreshortening: int k_A^2 theta_tw' phi' dx.
    pub shortening_twist: [f64; MAX_MODES],
}

/// Modal coordinates with two time derivatives.
#[derive(Clone, Copy, Debug)]
pub struct ModalMotion<S> {
    /// Coordinates.
    pub q: [S; MAX_MODES],
    /// First time derivatives.
    pub q_dot: [S; MAX_MODES],
    /// Second time derivatives.
    pub q_ddot: [S; MAX_MODES],
}

impl ModalMotion<f64> {
    /// Of coordinates and rates, one for each mode there is; not accelerated.
    pub fn of(q: &[f64], q_dot: &[f64]) -> Self {
        let filled = |values: &[f64]| std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0));
        Self { q: filled(q), q_dot: filled(q_dot), q_ddot: [0.0; MAX_MODES] }
    }
}

/// A pitch angle with two time derivatives [rad, rad/s, rad/s2].
#[derive(Clone, Copy, Debug)]
pub struct PitchMotion<S> {
    /// Angle.
    pub theta: S,
    /// Rate.
    pub theta_dot: S,
    /// Acceleration.
    pub theta_ddot: S,
}

/// Geometry and motion of a section relative to the blade axes.
#[derive(Clone, Copy, Debug)]
pub struct SectionMotion<S> {
    /// Elastic axis [m].
    pub position: Vec3<S, BladeAxes>,
    /// Its velocity relative to the blade axes [m/s].
    pub velocity: Vec3<S, BladeAxes>,
    /// Its acceleration relative to the blade axes [m/s2].
    pub acceleration: Vec3<S, BladeAxes>,
    /// Tangent of the span.
    pub t: Vec3<S, BladeAxes>,
    /// Chord direction at zero pitch.
    pub c0: Vec3<S, BladeAxes>,
    /// Chord direction, toward the leading edge.
    pub c: Vec3<S, BladeAxes>,
    /// Normal of the chord, upward.
    pub n: Vec3<S, BladeAxes>,
    /// Angular velocity relative to the blade axes [rad/s].
    pub omega: Vec3<S, BladeAxes>,
    /// Its time derivative in blade axes [rad/s2].
    pub omega_dot: Vec3<S, BladeAxes>,
    angles: Angles<S>,
    shortening_gradient: [S; MAX_MODES],
}

#[derive(Clone, Copy, Debug)]
struct Angles<S> {
    sin_b: S,
    cos_b: S,
    sin_l: S,
    cos_l: S,
    dv: S,
    b_dot: S,
    l_dot: S,
}

/// Sum over modes of shape times coordinate.
#[inline(always)]
pub(crate) fn combine<S: Real>(shape: &[f64], q: &[S], n_modes: usize) -> S {
    let mut sum = S::zero();
    for i in 0..n_modes {
        sum += q[i] * shape[i];
    }
    sum
}

impl StationShapes {
    /// Motion of the section for modal coordinates `m` and total pitch without elastic part `pitch` (control + twist).
    #[inline(always)]
    pub fn motion<S: Real>(
        &self,
        n_modes: usize,
        m: &ModalMotion<S>,
        pitch: &PitchMotion<S>,
    ) -> SectionMotion<S> {
        let k = n_modes;
        // foreshortening u = -[l (1 - sqrt(1 - S/l)) + c.q], S = q.U q over the length l, with its rates
        let mut slopes = [S::zero(); MAX_MODES];
        let (mut sum, mut sum_dot, mut sum_ddot) = (S::zero(), S::zero(), S::zero());
        let (mut u, mut u_dot, mut u_ddot) = (S::zero(), S::zero(), S::zero());
        for i in 0..k {
            slopes[i] = combine(&self.shortening[i], &m.q, k);
            let slope_dot = combine(&self.shortening[i], &m.q_dot, k);
            sum += m.q[i] * slopes[i];
            sum_dot += m.q_dot[i] * slopes[i] * 2.0;
            sum_ddot += (m.q_ddot[i] * slopes[i] + m.q_dot[i] * slope_dot) * 2.0;
            u += m.q[i] * self.shortening_twist[i];
            u_dot += m.q_dot[i] * self.shortening_twist[i];
            u_ddot += m.q_ddot[i] * self.shortening_twist[i];
        }
        let mut gradient = [S::zero(); MAX_MODES];
        for i in 0..k {
            gradient[i] = S::cst(self.shortening_twist[i]);
        }
        if self.length > 0.0 {
            let root = (S::one() - sum / self.length).sqrt();
            let half = S::cst(0.5) / root;
            u += (S::one() - root) * self.length;
            u_dot += half * sum_dot;
            u_ddot += half * (sum_ddot + sum_dot * sum_dot / (root * root) * (0.5 / self.length));
            for i in 0..k {
                gradient[i] += half * slopes[i] * 2.0;
            }
        }
        let position =
            Vec3::new(S::cst(self.x) - u, combine(&self.v[0], &m.q, k), combine(&self.w[0], &m.q, k));
        let velocity = Vec3::new(-u_dot, combine(&self.v[0], &m.q_dot, k), combine(&self.w[0], &m.q_dot, k));
        let acceleration =
            Vec3::new(-u_ddot, combine(&self.v[0], &m.q_ddot, k), combine(&self.w[0], &m.q_ddot, k));

        // flap angle B and lead angle L with rates
        let (dv, dv_dot, dv_ddot) = (
            combine(&self.v[1], &m.q, k),
            combine(&self.v[1], &m.q_dot, k),
            combine(&self.v[1], &m.q_ddot, k),
        );
        let (sin_b, dw_dot, dw_ddot) = (
            combine(&self.w[1], &m.q, k),
            combine(&self.w[1], &m.q_dot, k),
            combine(&self.w[1], &m.q_ddot, k),
        );
        let cos_b = (S::one() - sin_b * sin_b).sqrt();
        let inv_b = S::one() / cos_b;
        let b_dot = dw_dot * inv_b;
        let b_ddot = (dw_ddot + sin_b * b_dot * b_dot) * inv_b;
        let tan_b = sin_b * inv_b;
        let sin_l = dv * inv_b;
        let cos_l = (S::one() - sin_l * sin_l).sqrt();
        let s_dot = dv_dot * inv_b + sin_l * tan_b * b_dot;
        let s_ddot = dv_ddot * inv_b
            + dv_dot * inv_b * tan_b * b_dot * 2.0
            + sin_l * (tan_b * b_ddot + b_dot * b_dot * (tan_b * tan_b * 2.0 + 1.0));
        let l_dot = s_dot / cos_l;
        let l_ddot = (s_ddot + sin_l * l_dot * l_dot) / cos_l;

        // triad
        let t = Vec3::new(cos_b * cos_l, cos_b * sin_l, sin_b);
        let c0 = Vec3::new(-sin_l, cos_l, S::zero());
        let n0 = t.cross(c0);
        let theta = pitch.theta + combine(&self.theta, &m.q, k);
        let theta_dot = pitch.theta_dot + combine(&self.theta, &m.q_dot, k);
        let theta_ddot = pitch.theta_ddot + combine(&self.theta, &m.q_ddot, k);
        let (st, ct) = theta.sin_cos();
        let c = c0 * ct + n0 * st;
        let n = n0 * ct - c0 * st;

        // angular velocity and acceleration relative to the blade axes
        let e_z = Vec3::cst([0.0, 0.0, 1.0]);
        let swing = e_z * l_dot - c0 * b_dot;
        let omega = swing + t * theta_dot;
        let c0_dot = Vec3::new(-(cos_l * l_dot), -(sin_l * l_dot), S::zero());
        let omega_dot =
            e_z * l_ddot - c0 * b_ddot - c0_dot * b_dot + t * theta_ddot + swing.cross(t) * theta_dot;

        SectionMotion {
            position,
            velocity,
            acceleration,
            t,
            c0,
            c,
            n,
            omega,
            omega_dot,
            angles: Angles { sin_b, cos_b, sin_l, cos_l, dv, b_dot, l_dot },
            shortening_gradient: gradient,
        }
    }
}

impl<S: Real> SectionMotion<S> {
    /// Change of position with modal coordinate `i`, and change of angular velocity with its rate.
    #[inline(always)]
    pub fn test_motion(&self, shapes: &StationShapes, i: usize) -> (Vec3<S, BladeAxes>, Vec3<S, BladeAxes>) {
        let a = &self.angles;
        let shift = Vec3::new(-self.shortening_gradient[i], S::cst(shapes.v[0][i]), S::cst(shapes.w[0][i]));
        let (b_i, l_i) = self.angle_gradient(shapes, i);
        let turn = Vec3::new(
            a.sin_l * b_i + self.t.x * shapes.theta[i],
            -(a.cos_l * b_i) + self.t.y * shapes.theta[i],
            l_i + self.t.z * shapes.theta[i],
        );
        (shift, turn)
    }

    /// Derivatives of flap angle B and lead angle L by modal coordinate `i`.
    #[inline(always)]
    pub fn angle_gradient(&self, shapes: &StationShapes, i: usize) -> (S, S) {
        let a = &self.angles;
        let inv_b = S::one() / a.cos_b;
        let b_i = inv_b * shapes.w[1][i];
        let l_i = (inv_b * shapes.v[1][i] + a.dv * a.sin_b * inv_b * inv_b * b_i) / a.cos_l;
        (b_i, l_i)
    }

    /// Flap angle B and lead angle L of the tangent [rad].
    #[inline(always)]
    pub fn tangent_angles(&self) -> (S, S) {
        (self.angles.sin_b.asin(), self.angles.sin_l.asin())
    }

    /// Rates of flap angle and lead angle [rad/s].
    #[inline(always)]
    pub fn angle_rates(&self) -> (S, S) {
        (self.angles.b_dot, self.angles.l_dot)
    }
}
