//! Springs at the hinges of a blade.

use super::MAX_MODES;
use super::kinematics::{StationShapes, combine};
use crate::numerics::scalar::Real;

/// Springs at the hinges [N m/rad], neutral where the blade points along its undeflected span; zero where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HingeSprings {
    /// About the flap hinge.
    pub flap: f64,
    /// About the lag hinge.
    pub lag: f64,
}

impl HingeSprings {
    /// Adds their virtual work, -K_flap B dB/dq_i - K_lag L dL/dq_i, for the first `n` modal coordinates: B, L flap and lead
    /// angle of the tangent at the hinge with shapes `root`, sin B = w', sin L = v'/cos B.
    #[inline(always)]
    pub(super) fn add_work<S: Real>(
        &self,
        root: &StationShapes,
        n: usize,
        q: &[S; MAX_MODES],
        work: &mut [S; MAX_MODES],
    ) {
        if self.flap == 0.0 && self.lag == 0.0 {
            return;
        }
        let ([_, v, _], [_, w, _]) = (&root.v, &root.w);
        let (sin_b, dv) = (combine(w, q, n), combine(v, q, n));
        let inv_b = S::one() / (S::one() - sin_b * sin_b).sqrt();
        let sin_l = dv * inv_b;
        let inv_l = S::one() / (S::one() - sin_l * sin_l).sqrt();
        let (flap, lag) = (sin_b.asin() * self.flap, sin_l.asin() * self.lag);
        let turned = sin_l * sin_b * inv_b;
        for i in 0..n {
            let b_i = inv_b * w[i];
            let l_i = (inv_b * v[i] + turned * b_i) * inv_l;
            work[i] -= flap * b_i + lag * l_i;
        }
    }
}
