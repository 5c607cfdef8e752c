//! What turns a rotor whose speed is a state: engines with a governor, or a torque that is given, behind an overrunning clutch.
//!
//! About the shaft, J the inertia that turns with the rotor but for its blades, which are in the moment M of the rotor on its hub:
//! J w' + J_hub w_b' = Q_engines + M - (P_tail + P_accessories)/w, with w_b the rate of the hub's carrier about the shaft. The
//! engines burn what they burn at a power P_0 in balance less what the governor asks for, and follow with one lag
//! [hilbert1984, Table 3]: tau P' = P_0 - K_1 (w - w_0) - K_2 int(w - w_0) - K_3 w' - P.

use crate::numerics::scalar::Real;
use serde::Deserialize;

/// Time [s] within which the integral of a governor follows a power that the clutch does not pass on: it does not wind up.
const UNWINDING: f64 = 0.2;

/// Drive train of a rotor whose speed is a state.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// Inertia of all that turns with the rotor but its blades, at its speed [kg m2].
    pub inertia: f64,
    /// Share of it that turns about the shaft itself [kg m2].
    pub hub_inertia: f64,
    /// Governed engines; none where their torque is given.
    pub governor: Option<Governor>,
}

/// Engines that hold the nominal speed.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Governor {
    /// Power that the fuel of the balance gives [W].
    pub power: f64,
    /// Power by excess of speed [W s/rad], its integral [W/rad], its rate [W s2/rad].
    pub gains: [f64; 3],
    /// Lag of the power [s].
    pub lag: f64,
}

/// Why a drive cannot turn a rotor.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DriveError {
    /// An inertia that is none.
    #[error(
        "drive: inertia = {inertia} kg m2, of the hub {hub} kg m2: must be finite, above 0, and that of the hub within it"
    )]
    Inertia {
        /// All [kg m2].
        inertia: f64,
        /// Of the hub [kg m2].
        hub: f64,
    },
    /// A governor that is none.
    #[error(
        "drive: governor with power, gains, lag {power} W, {gains:?}, {lag} s: must be finite, gains not negative, that of the \
             integral and the lag above 0"
    )]
    Governor {
        /// Power [W].
        power: f64,
        /// Gains.
        gains: [f64; 3],
        /// Lag [s].
        lag: f64,
    },
}

/// States of a drive and the rate of its speed.
#[derive(Clone, Copy, Debug)]
pub struct DriveState<S> {
    /// Speed over the nominal one [rad/s].
    pub excess: S,
    /// Its rate [rad/s2].
    pub omega_dot: S,
    /// Integral of the excess [rad].
    pub integral: S,
    /// Power of the engines [W].
    pub power: S,
}

impl Drive {
    /// Checked.
    pub fn checked(self) -> Result<Self, DriveError> {
        let (inertia, hub) = (self.inertia, self.hub_inertia);
        if !(inertia.is_finite() && inertia > 0.0 && (0.0..=inertia).contains(&hub)) {
            return Err(DriveError::Inertia { inertia, hub });
        }
        if let Some(Governor { power, gains, lag }) = self.governor {
            let gains_fit = gains.iter().all(|g| g.is_finite() && *g >= 0.0) && gains[1] > 0.0;
            if !(power.is_finite() && gains_fit && lag.is_finite() && lag > 0.0) {
                return Err(DriveError::Governor { power, gains, lag });
            }
        }
        Ok(self)
    }
}

impl Governor {
    /// Rates of the integral [rad/s] and of the power [W/s]; `fuel` is the share of the fuel that reaches the engines.
    #[inline(always)]
    pub fn rates<S: Real>(&self, state: &DriveState<S>, fuel: S) -> [S; 2] {
        let [by_excess, by_integral, by_rate] = self.gains;
        let idle = if state.power.re() < 0.0 { state.power } else { S::zero() };
        let asked =
            state.excess * by_excess + state.integral * by_integral + state.omega_dot * by_rate - self.power;
        [fuel * (state.excess + idle / (by_integral * UNWINDING)), -(fuel * asked + state.power) / self.lag]
    }

    /// Derivative of the rate of the power by that of the speed.
    pub fn power_by_rate(&self, fuel: f64) -> f64 {
        -fuel * self.gains[2] / self.lag
    }
}

/// What an overrunning clutch passes on: engines drive the rotor, the rotor never drives them.
#[inline(always)]
pub fn clutched<S: Real>(given: S) -> S {
    if given.re() > 0.0 { given } else { S::zero() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    /// UH-60A: drive train and rigid blades about the shaft [kg m2], 1.75 hp for a lb/h.
    const INERTIA: f64 = 10921.0;
    const HP: f64 = 745.699_871_582_270_2;

    fn governor() -> Governor {
        Governor { power: 1.36e6, gains: [2000.0, 2500.0, 500.0].map(|k| k * 1.75 * HP), lag: 1.25 }
    }

    /// Excess, integral, power: the closed loop on a rotor whose own torque is Q (w/w_0)^n.
    fn closed_loop(exponent: f64) -> Matrix3<f64> {
        let (g, omega) = (governor(), 27.0);
        let by_speed = -(1.0 + exponent) * g.power / (omega * omega * INERTIA);
        let by_power = 1.0 / (omega * INERTIA);
        let k = g.gains;
        Matrix3::new(
            by_speed,
            0.0,
            by_power, //
            1.0,
            0.0,
            0.0, //
            -(k[0] + k[2] * by_speed) / g.lag,
            -k[1] / g.lag,
            -(1.0 + k[2] * by_power) / g.lag,
        )
    }

    #[test]
    fn the_closed_loop_has_the_eigenvalues_of_its_cubic() {
        for (exponent, (re, im), real) in [(0.0, (-0.5525, 2.2594), -1.636), (2.0, (-0.6815, 2.1639), -1.720)]
        {
            // the rates of this module give the same matrix
            let a = closed_loop(exponent);
            let g = governor();
            for (k, unit) in [[1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
                let size: f64 = unit.iter().sum();
                let omega_dot = a[(0, k)] * size;
                let state =
                    DriveState { excess: unit[0], omega_dot, integral: unit[1], power: g.power + unit[2] };
                let [integral, power] = g.rates(&state, 1.0);
                assert!((integral / size - a[(1, k)]).abs() < 1e-12);
                assert!((power / size / a[(2, k)] - 1.0).abs() < 1e-6);
            }
            let mut found: Vec<_> = a.complex_eigenvalues().iter().copied().collect();
            found.sort_by(|x, y| x.im.total_cmp(&y.im));
            println!("{found:?}");
            assert!((found[2].re - re).abs() < 1e-3 && (found[2].im - im).abs() < 1e-3, "{found:?}");
            assert!((found[1].re - real).abs() < 1e-3 && found[1].im.abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn a_clutch_lets_the_rotor_overrun() {
        assert_eq!((clutched(3.0), clutched(-3.0), clutched(0.0)), (3.0, 0.0, 0.0));
        let g = governor();
        let at = |power| DriveState { excess: 0.0, omega_dot: 0.0, integral: 0.0, power };
        // in balance nothing moves; without fuel the power is gone with its lag
        assert_eq!(g.rates(&at(g.power), 1.0), [0.0, 0.0]);
        assert_eq!(g.rates(&at(g.power), 0.0), [0.0, -g.power / g.lag]);
        assert!(g.rates(&at(-1e5), 1.0)[0] < 0.0);
    }

    #[test]
    fn a_drive_that_turns_nothing_is_refused() {
        let good = Drive { inertia: 1474.0, hub_inertia: 57.0, governor: Some(governor()) };
        assert!(good.clone().checked().is_ok());
        for bad in [
            Drive { inertia: 0.0, ..good.clone() },
            Drive { hub_inertia: 2000.0, ..good.clone() },
            Drive { inertia: f64::NAN, ..good.clone() },
            Drive { governor: Some(Governor { lag: 0.0, ..governor() }), ..good.clone() },
            Drive { governor: Some(Governor { gains: [1.0, 0.0, 1.0], ..governor() }), ..good },
        ] {
            assert!(bad.checked().is_err());
        }
    }
}
