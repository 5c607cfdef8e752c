//! What fixes the lateral degree of freedom of a flight.

use super::host::Head;
use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use serde::{Deserialize, Serialize};

/// Bank and sideslip as given, in shares of one equation.
///
/// Sideslip is the angle of the wind in the plane of the nose: atan2(v, u) where the flight is fast and flat, minus the heading
/// against the track where it is slow or steep (u and v then tell of climb and attitude, not of a direction), blended between
/// by the share of the horizontal speed.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Convention {
    /// Bank angle [rad].
    pub bank: f64,
    /// Sideslip, wind from the right positive [rad].
    pub sideslip: f64,
    /// Share of the bank in the equation, the rest is the sideslip's: 1 with the heading free, 0 with the nose on the wind.
    pub bank_share: f64,
}

/// Horizontal speed [m/s] below which a heading tells more than a sideslip.
const SLOW: f64 = 3.0;

impl Convention {
    /// What is missing to it [rad], for the velocity in body axes [m/s].
    pub(super) fn residual<S: Real>(&self, head: &Head<S>, velocity: Vec3<S, Body>) -> S {
        let (climb, forward) = head.path.flight_path.sin_cos();
        let (rise, along) = (head.path.speed * climb, head.path.speed * forward);
        let share = smooth_step(flatness(rise, along) * 2.0 - 0.5);
        // direction of flight seen from the nose: by the heading, and by the wind
        let (sin, cos) = head.yaw.sin_cos();
        let (mut ahead, mut right) = (cos, -sin);
        if share.re() > 0.0 {
            ahead += (velocity.x / along - ahead) * share;
            right += (velocity.y / along - right) * share;
        }
        let (s, c) = self.sideslip.sin_cos();
        let slip = (right * c - ahead * s).atan2(ahead * c + right * s);
        (head.roll - self.bank) * self.bank_share + slip * (1.0 - self.bank_share)
    }
}

/// Square of the horizontal speed over that of speed and `SLOW`.
fn flatness<S: Real>(rise: S, along: S) -> S {
    let (r, a) = (rise.re(), along.re());
    let total = a * a + r * r + SLOW * SLOW;
    let flat = a * a / total;
    along.chain(flat, 2.0 * a * (1.0 - flat) / total) + rise.chain(0.0, -2.0 * r * flat / total)
}

/// 0 up to 0, 1 from 1 on, with continuous slope.
fn smooth_step<S: Real>(x: S) -> S {
    let at = x.re().clamp(0.0, 1.0);
    x.chain(at * at * (3.0 - 2.0 * at), 6.0 * at * (1.0 - at))
}
