//! Strain energy of bending and torsion with exact curvatures, and its gradient.
//!
//! U = 1/2 int [EI_flap k_f^2 + EI_lag k_l^2 + GJ k_t^2] dx with the tangent's derivative
//! t' = L' cos B c0 + B' n0 resolved in the pitched section: k_f = t'.n, k_l = t'.c, k_t = phi' + L' sin B.
//! Zero for any rigid motion about the hinge; it contains the bending-torsion coupling of [hodges1974].

use super::MAX_MODES;
use super::kinematics::{StationShapes, combine};
use crate::numerics::scalar::Real;

/// Stiffnesses of a quadrature point, times its weight [N m2 * m].
#[derive(Clone, Copy, Debug)]
pub struct Stiffness {
    /// EI flapwise.
    pub flap: f64,
    /// EI chordwise.
    pub lag: f64,
    /// GJ.
    pub torsion: f64,
}

/// Adds the point's share of dU/dq to `gradient` and returns its share of U; `pitch` = control + twist [rad].
#[inline(always)]
pub fn add_strain_gradient<S: Real>(
    shapes: &StationShapes,
    stiffness: &Stiffness,
    n_modes: usize,
    q: &[S; MAX_MODES],
    pitch: S,
    gradient: &mut [S; MAX_MODES],
) -> S {
    let k = n_modes;
    let (dv, ddv) = (combine(&shapes.v[1], q, k), combine(&shapes.v[2], q, k));
    let (sin_b, ddw) = (combine(&shapes.w[1], q, k), combine(&shapes.w[2], q, k));
    let cos_b = (S::one() - sin_b * sin_b).sqrt();
    let inv_b = S::one() / cos_b;
    let tan_b = sin_b * inv_b;
    let b_s = ddw * inv_b;
    let sin_l = dv * inv_b;
    let inv_l = S::one() / (S::one() - sin_l * sin_l).sqrt();
    let s_s = ddv * inv_b + sin_l * tan_b * b_s;
    let l_s = s_s * inv_l;
    let theta = pitch + combine(&shapes.theta, q, k);
    let (st, ct) = theta.sin_cos();

    let edge = l_s * cos_b;
    let k_f = b_s * ct - edge * st;
    let k_l = edge * ct + b_s * st;
    let k_t = combine(&shapes.dphi, q, k) + l_s * sin_b;
    let m_f = k_f * stiffness.flap;
    let m_l = k_l * stiffness.lag;
    let m_t = k_t * stiffness.torsion;

    for i in 0..k {
        let b_i = inv_b * shapes.w[1][i];
        let b_s_i = inv_b * shapes.w[2][i] + b_s * tan_b * b_i;
        let sin_l_i = inv_b * shapes.v[1][i] + sin_l * tan_b * b_i;
        let s_s_i = inv_b * shapes.v[2][i]
            + ddv * inv_b * tan_b * b_i
            + sin_l_i * tan_b * b_s
            + sin_l * ((tan_b * tan_b + 1.0) * b_i * b_s + tan_b * b_s_i);
        let l_s_i = (s_s_i + l_s * sin_l * inv_l * sin_l_i) * inv_l;
        let edge_i = l_s_i * cos_b - l_s * sin_b * b_i;
        let k_f_i = b_s_i * ct - edge_i * st - k_l * shapes.theta[i];
        let k_l_i = edge_i * ct + b_s_i * st + k_f * shapes.theta[i];
        let k_t_i = l_s_i * sin_b + l_s * cos_b * b_i + shapes.dphi[i];
        gradient[i] += m_f * k_f_i + m_l * k_l_i + m_t * k_t_i;
    }
    (m_f * k_f + m_l * k_l + m_t * k_t) * 0.5
}
