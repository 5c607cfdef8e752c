//! Springs at the hinges of a blade.

use super::MAX_MODES;
use super::kinematics::combine;
use super::model::Blade;
use crate::numerics::scalar::Real;

/// Springs at the hinges [N m/rad], neutral where the blade points along its undeflected span; zero where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HingeSprings {
    /// About the flap hinge.
    pub flap: f64,
    /// About the lag hinge.
    pub lag: f64,
}

impl Blade {
    /// Virtual work of the hinge springs, -K_flap B dB/dq_i - K_lag L dL/dq_i: B, L flap and lead angle of the tangent there,
    /// sin B = w', sin L = v'/cos B.
    #[inline(always)]
    pub(super) fn add_hinge_springs<S: Real>(&self, q: &[S; MAX_MODES], work: &mut [S; MAX_MODES]) {
        let (springs, n) = (&self.hinge_springs, self.n_modes);
        if springs.flap == 0.0 && springs.lag == 0.0 {
            return;
        }
        let ([_, v, _], [_, w, _]) = (&self.root.v, &self.root.w);
        let (sin_b, dv) = (combine(w, q, n), combine(v, q, n));
        let inv_b = S::one() / (S::one() - sin_b * sin_b).sqrt();
        let sin_l = dv * inv_b;
        let inv_l = S::one() / (S::one() - sin_l * sin_l).sqrt();
        let (flap, lag) = (sin_b.asin() * springs.flap, sin_l.asin() * springs.lag);
        let turned = sin_l * sin_b * inv_b;
        for i in 0..n {
            let b_i = inv_b * w[i];
            let l_i = (inv_b * v[i] + turned * b_i) * inv_l;
            work[i] -= flap * b_i + lag * l_i;
        }
    }
}
