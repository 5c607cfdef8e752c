//! Speed of a rotor in time: constant, a prescribed history, or a state; its azimuth is the integral of it.
//!
//! Whatever is counted without dimension (inflow over the tip speed, coefficients, blade modes) is counted at the nominal speed
//! of the rotor, which does not change. Blades turn at the nominal speed about a hub that carries what the rotor turns faster:
//! with excess e and rate w_dot of the speed about the shaft k, a hub with the rates w of the carrier moves for its blades at
//! w + e k and accelerates at w' + w x e k + w_dot k. Their kinematics then are those of the speed itself, exactly.

use super::drive::Drive;
use crate::blade::hub_motion::HubMotion;
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::scalar::Real;
use thiserror::Error;

/// Times nearer than this are one [s]: a step that begins at a corner of a history belongs to the piece that follows.
const ROUNDING: f64 = 1e-9;

/// Speed of a rotor and its rate at an instant, positive in the rotor's sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning<S = f64> {
    /// Speed [rad/s].
    pub omega: S,
    /// Its rate [rad/s2].
    pub omega_dot: S,
}

impl<S: Real> Turning<S> {
    /// At a speed that stays.
    pub fn steady(omega: f64) -> Self {
        Self { omega: S::cst(omega), omega_dot: S::zero() }
    }

    /// The hub as blades that turn at `nominal` [rad/s] about it feel it.
    #[inline(always)]
    pub fn carried_by(&self, hub: HubMotion<S>, nominal: f64) -> HubMotion<S> {
        let excess: Vec3<S, Hub> = Vec3::new(S::zero(), S::zero(), self.omega - nominal);
        let faster: Vec3<S, Hub> = Vec3::new(S::zero(), S::zero(), self.omega_dot);
        HubMotion {
            omega: hub.omega + excess,
            omega_dot: hub.omega_dot + hub.omega.cross(excess) + faster,
            ..hub
        }
    }
}

/// Where a rotor is in its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin<S = f64> {
    /// Azimuth of the first blade [rad].
    pub psi: S,
    /// Speed and its rate.
    pub turning: Turning<S>,
}

impl Spin {
    /// Without derivatives.
    #[inline(always)]
    pub fn constant<S: Real>(&self) -> Spin<S> {
        let Turning { omega, omega_dot } = self.turning;
        Spin {
            psi: S::cst(self.psi),
            turning: Turning { omega: S::cst(omega), omega_dot: S::cst(omega_dot) },
        }
    }
}

/// How the speed of a rotor goes in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum RotorSpeed {
    /// The nominal one.
    #[default]
    Constant,
    /// A history.
    Prescribed(SpeedHistory),
    /// Azimuth and speed are states that a drive moves.
    Free(Drive),
    /// They are states, and the rotor keeps what it turns at over the ground, whatever its carrier does.
    OverGround,
}

impl RotorSpeed {
    /// Whether azimuth and speed are states.
    #[inline(always)]
    pub fn is_state(&self) -> bool {
        match self {
            Self::Constant | Self::Prescribed(_) => false,
            Self::Free(_) | Self::OverGround => true,
        }
    }
}

/// Why a history of rotor speed cannot be followed.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpeedError {
    /// No corner.
    #[error("rotor_speed: must have at least one corner (time s, speed rad/s)")]
    Empty,
    /// A speed that is none.
    #[error("rotor_speed = {omega} rad/s at {t} s: must be finite and above 0")]
    Speed {
        /// When [s].
        t: f64,
        /// What was given [rad/s].
        omega: f64,
    },
    /// Times that do not ascend.
    #[error("rotor_speed: {t} s after {before} s: times must be finite and ascend strictly")]
    Time {
        /// Corner before [s].
        before: f64,
        /// What was given [s].
        t: f64,
    },
}

/// Where a piece of a history begins.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    t: f64,
    /// Azimuth of the first blade [rad].
    psi: f64,
    omega: f64,
    /// Rate of the speed from here on [rad/s2].
    slope: f64,
}

/// A speed that is piecewise linear in time, steady before its first corner and after its last.
///
/// The azimuth of the first blade is its exact integral, zero at time zero of a speed that was always that of the first corner.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedHistory {
    corners: Vec<Corner>,
}

impl SpeedHistory {
    /// Through `corners`, time [s] and speed [rad/s].
    pub fn new(corners: &[(f64, f64)]) -> Result<Self, SpeedError> {
        let mut found: Vec<Corner> = Vec::with_capacity(corners.len());
        for &(t, omega) in corners {
            if !(omega.is_finite() && omega > 0.0) {
                return Err(SpeedError::Speed { t, omega });
            }
            let mut psi = omega * t;
            if let Some(last) = found.last_mut() {
                let length = t - last.t;
                if !(length.is_finite() && length > 0.0) {
                    return Err(SpeedError::Time { before: last.t, t });
                }
                last.slope = (omega - last.omega) / length;
                psi = last.psi + 0.5 * (last.omega + omega) * length;
            } else if !t.is_finite() {
                return Err(SpeedError::Time { before: f64::NEG_INFINITY, t });
            }
            found.push(Corner { t, psi, omega, slope: 0.0 });
        }
        if found.is_empty() {
            return Err(SpeedError::Empty);
        }
        Ok(Self { corners: found })
    }

    /// The piece that a quantity lies in by how many corners it has passed; before the first the speed is steady.
    fn piece(&self, passed: usize) -> Corner {
        match passed {
            0 => Corner { slope: 0.0, ..self.corners[0] },
            k => self.corners[k - 1],
        }
    }

    fn at(&self, t: f64) -> Corner {
        self.piece(self.corners.partition_point(|c| c.t <= t))
    }

    /// Azimuth of the first blade [rad] at time `t` [s].
    pub fn azimuth(&self, t: f64) -> f64 {
        let c = self.at(t);
        let past = t - c.t;
        c.psi + past * (c.omega + 0.5 * c.slope * past)
    }

    /// Time [s] at which the first blade has turned by `psi` [rad].
    pub fn time(&self, psi: f64) -> f64 {
        let c = self.piece(self.corners.partition_point(|c| c.psi <= psi));
        let past = psi - c.psi;
        // the root that does not cancel; the speed there is above zero, so that it is real
        c.t + 2.0 * past / (c.omega + (c.omega * c.omega + 2.0 * c.slope * past).max(0.0).sqrt())
    }

    /// Speed and its rate at time `t` of a step that began at `begin` [s]: at a corner where the step ends the rate is that of
    /// the piece it ends.
    pub fn turning(&self, t: f64, begin: f64) -> Turning {
        let c = self.at(t);
        let step = self.at(begin + ROUNDING);
        Turning { omega: c.omega + c.slope * (t - c.t), omega_dot: step.slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [(f64, f64); 4] = [(0.2, 27.0), (0.7, 24.0), (0.9, 28.5), (1.4, 28.5)];

    #[test]
    fn azimuth_is_the_integral_of_speed_and_time_its_inverse() {
        let history = SpeedHistory::new(&CORNERS).unwrap();
        assert_eq!(history.azimuth(0.1), 27.0 * 0.1);
        let steps = 20_000;
        let h = 1.7 / steps as f64;
        let mut psi = 0.0;
        for k in 0..steps {
            let t = k as f64 * h;
            psi += h * history.turning(t + 0.5 * h, t).omega;
            assert!((history.azimuth(t + h) - psi).abs() < 1e-6);
            assert!((history.time(history.azimuth(t)) - t).abs() < 1e-14);
        }
    }

    #[test]
    fn at_a_corner_the_rate_is_that_of_the_step() {
        let history = SpeedHistory::new(&CORNERS).unwrap();
        let (ends, begins) = (history.turning(0.7, 0.65), history.turning(0.7, 0.7));
        assert_eq!((ends.omega, begins.omega), (24.0, 24.0));
        assert!((ends.omega_dot + 6.0).abs() < 1e-12 && (begins.omega_dot - 22.5).abs() < 1e-12);
        // rounding of where steps begin does not turn a step into one of the piece before
        assert_eq!(history.turning(0.71, 0.7 - 1e-12).omega_dot, begins.omega_dot);
        assert_eq!(history.turning(0.1, 0.1), Turning::steady(27.0));
        assert_eq!(history.turning(2.0, 1.9), Turning::steady(28.5));
    }

    #[test]
    fn a_history_that_cannot_be_followed_is_refused() {
        let refused = |corners: &[(f64, f64)]| SpeedHistory::new(corners).unwrap_err().to_string();
        assert!(refused(&[]).contains("at least one"));
        assert!(refused(&[(0.0, 27.0), (1.0, 0.0)]).contains("0 rad/s at 1 s"));
        assert!(refused(&[(0.0, f64::NAN)]).contains("finite"));
        assert!(refused(&[(0.0, 27.0), (0.0, 26.0)]).contains("ascend"));
        assert!(refused(&[(f64::NAN, 27.0)]).contains("ascend"));
    }
}
