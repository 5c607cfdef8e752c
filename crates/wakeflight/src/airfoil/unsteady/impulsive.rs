//! Impulsive loads: the pressure of waves that leave a section whose motion changes, as piston theory has it at first.
//!
//! After a step of upwash w the normal force starts at 4 w a/V^2 and its waves leave with time constants K c/a, matched so
//! that the sum with the circulatory part has the exact initial slope of linear theory [lomax1952, leishman1989].

use super::Flow;
use super::indicial::{Indicial, held_mach};
use super::lag::Drive;
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// Shares of the moment of a step of upwash, A_3 and A_4; that of the circulatory moment by pitch rate is 1.
const MOMENT_SHARES: [f64; 2] = [1.5, -0.5];
/// Their rates b_3 and b_4.
const MOMENT_RATES: [f64; 2] = [0.25, 0.1];
/// Rate of the circulatory moment by pitch rate, b_5.
const CIRCULATORY_MOMENT_RATE: f64 = 0.5;

/// Time constants over c/a.
#[derive(Clone, Copy, Debug)]
pub struct TimeConstants<S> {
    /// Normal force by upwash, K_alpha.
    pub force_upwash: S,
    /// Normal force by pitch rate, K_q.
    pub force_pitch: S,
    /// Moment by upwash, K_alphaM.
    pub moment_upwash: S,
    /// Moment by pitch rate, K_qM.
    pub moment_pitch: S,
}

impl<S: Real> TimeConstants<S> {
    /// At Mach number `mach` with the circulatory part of `indicial` [leishman1989].
    pub fn at(mach: S, indicial: &Indicial) -> Self {
        let left = S::one() - mach;
        let beta_mach2 = (S::one() - mach * mach).sqrt() * mach * mach;
        let one = S::one();
        let slope = PI * indicial.initial_slope();
        let ([a3, a4], [b3, b4]) = (MOMENT_SHARES, MOMENT_RATES);
        Self {
            force_upwash: one / (left + beta_mach2 * slope),
            force_pitch: one / (left + beta_mach2 * (2.0 * slope)),
            moment_upwash: S::cst((a3 * b4 + a4 * b3) / (b3 * b4)) / left,
            moment_pitch: S::cst(7.0) / (left * 15.0 + beta_mach2 * (3.0 * PI * CIRCULATORY_MOMENT_RATE)),
        }
    }
}

/// Normal force and moment coefficients of the impulsive part, and of the moment that follows the pitch rate.
#[derive(Clone, Copy, Debug)]
pub struct Impulse<S> {
    /// Normal force.
    pub cn: S,
    /// Moment about the quarter chord, the lagged circulatory one by pitch rate included.
    pub cm: S,
}

/// What the six states follow: upwash at the quarter chord [m/s] (force, two of the moment), pitch rate [rad/s] (force, moment,
/// circulatory moment).
pub(super) fn drives<S: Real>(flow: &Flow<S>, chord: f64, indicial: &Indicial) -> [Drive<S>; 6] {
    let (upwash, pitch_rate) = inputs(flow);
    let mach = held_mach(flow);
    let k = TimeConstants::at(mach, indicial);
    let waves = S::cst(flow.speed_of_sound / chord);
    let circulatory = flow.semichords(chord) * (S::one() - mach * mach) * CIRCULATORY_MOMENT_RATE;
    [
        Drive { input: upwash, rate: waves / k.force_upwash },
        Drive { input: upwash, rate: waves / (k.moment_upwash * MOMENT_RATES[0]) },
        Drive { input: upwash, rate: waves / (k.moment_upwash * MOMENT_RATES[1]) },
        Drive { input: pitch_rate, rate: waves / k.force_pitch },
        Drive { input: pitch_rate, rate: waves / k.moment_pitch },
        Drive { input: pitch_rate, rate: circulatory },
    ]
}

/// Loads of the six states.
pub(super) fn loads<S: Real>(flow: &Flow<S>, chord: f64, states: &[S]) -> Impulse<S> {
    let (upwash, pitch_rate) = inputs(flow);
    let mach = held_mach(flow);
    let beta = (S::one() - mach * mach).sqrt();
    // 1/(M V): pressures are those of w over the speed of sound
    let by_upwash = S::cst(flow.speed_of_sound) / (flow.speed * flow.speed);
    let by_rate = by_upwash * chord;
    let [a3, a4] = MOMENT_SHARES;
    let cn = by_upwash * (upwash - states[0]) * 4.0 + by_rate * (pitch_rate - states[3]);
    let cm = -(by_upwash * ((upwash - states[1]) * a3 + (upwash - states[2]) * a4))
        - by_rate * (pitch_rate - states[4]) * (7.0 / 12.0)
        - states[5] * chord / (flow.speed * beta) * (PI / 8.0);
    Impulse { cn, cm }
}

/// Upwash at the quarter chord and pitch rate, where the model is engaged.
fn inputs<S: Real>(flow: &Flow<S>) -> (S, S) {
    let share = flow.engaged();
    (flow.speed * flow.alpha_quarter * share, flow.pitch_rate * share)
}
