//! Springs and stops at the hinges of a blade.

use super::MAX_MODES;
use super::kinematics::{StationShapes, combine};
use crate::numerics::scalar::Real;
use serde::Deserialize;

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

/// Stops of a hinge: beyond its angles a blade lies on a stiff spring, that pushes it back and never pulls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HingeStops {
    /// Least angle that is free [rad]; none below which nothing stops it.
    pub low: Option<f64>,
    /// Largest [rad].
    pub high: Option<f64>,
    /// Of a stop [N m/rad].
    pub stiffness: f64,
}

impl HingeStops {
    /// Moment on the blade at `angle` [N m].
    #[inline(always)]
    pub fn moment<S: Real>(&self, angle: S) -> S {
        let beyond = |stop: &f64| (angle - *stop) * -self.stiffness;
        match (self.low, self.high) {
            (Some(low), _) if angle.re() < low => beyond(&low),
            (_, Some(high)) if angle.re() > high => beyond(&high),
            _ => S::zero(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    #[test]
    fn a_stop_pushes_back_beyond_its_angle_and_nowhere_else() {
        let stops = HingeStops { low: Some(-0.1), high: Some(0.4), stiffness: 1e6 };
        let at = |angle: f64| {
            let found = stops.moment(Dual::<1>::variable(angle, 0));
            (found.re, found.eps[0])
        };
        assert_eq!((at(0.0), at(-0.1), at(0.4)), ((0.0, 0.0), (0.0, 0.0), (0.0, 0.0)));
        let (below, above) = (at(-0.11), at(0.42));
        assert!((below.0 - 1e4).abs() < 1e-6 && (above.0 + 2e4).abs() < 1e-6);
        assert_eq!((below.1, above.1), (-1e6, -1e6));
        assert_eq!(HingeStops { high: None, ..stops }.moment(3.0), 0.0);
    }
}
