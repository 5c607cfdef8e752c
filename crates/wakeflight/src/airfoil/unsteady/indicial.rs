//! Circulatory lift after a step: what the shed wake takes off the angle of attack.
//!
//! Upwash at three quarters of the chord, w = V alpha, is lagged rather than its angle, so that a change of speed sheds
//! vorticity too [hansen2004]; with constant speed the two are the same.

use super::lag::Drive;
use super::{Flow, States};
use crate::numerics::scalar::Real;

/// Constants of phi(s) = 1 - A_1 exp(-b_1 beta^2 s) - A_2 exp(-b_2 beta^2 s), s in semichords.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indicial {
    /// A_1, A_2.
    pub a: [f64; 2],
    /// b_1, b_2.
    pub b: [f64; 2],
}

/// Wagner's function of incompressible flow, within 1.2 per cent [jones1940].
pub const JONES: Indicial = Indicial { a: [0.165, 0.335], b: [0.0455, 0.3] };

/// Compressible flow; right only together with the impulsive part [leishman1989].
pub const BEDDOES: Indicial = Indicial { a: [0.3, 0.7], b: [0.14, 0.53] };

/// Mach number beyond which time constants are held: small disturbances no longer describe the flow.
pub const MACH_LIMIT: f64 = 0.75;

impl Indicial {
    /// A_1 b_1 + A_2 b_2.
    pub fn initial_slope(&self) -> f64 {
        self.a[0] * self.b[0] + self.a[1] * self.b[1]
    }

    /// What the two states of the shed wake follow: the upwash at three quarters of the chord [m/s].
    pub(super) fn drives<S: Real>(&self, flow: &Flow<S>, chord: f64) -> [Drive<S>; 2] {
        let input = upwash(flow);
        let rate = flow.semichords(chord) * beta_squared(flow);
        self.b.map(|b| Drive { input, rate: rate * b })
    }

    /// Angle of attack that the shed wake leaves [rad]; `states`: the lagged upwash, first two entries.
    pub(super) fn alpha<S: Real>(&self, flow: &Flow<S>, states: &States<S>) -> S {
        let w = upwash(flow);
        let missing = (w - states[0]) * self.a[0] + (w - states[1]) * self.a[1];
        flow.alpha - missing * flow.engaged() / flow.speed
    }
}

fn upwash<S: Real>(flow: &Flow<S>) -> S {
    flow.speed * flow.alpha * flow.engaged()
}

/// 1 - M^2, the Mach number held at its limit.
pub(super) fn beta_squared<S: Real>(flow: &Flow<S>) -> S {
    let mach = held_mach(flow);
    S::one() - mach * mach
}

/// Mach number held at its limit.
pub(super) fn held_mach<S: Real>(flow: &Flow<S>) -> S {
    flow.mach().clamped(0.0, MACH_LIMIT)
}
