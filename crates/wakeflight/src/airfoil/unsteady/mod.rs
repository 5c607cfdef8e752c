//! Sections that know time: attached unsteady flow and stall as first-order lags in cascade.
//!
//! Every state X follows what drives it, X' = (u - X)/T; a drive depends on the flow and on states of earlier stages alone.
//! One law of each model serves the rates (implicit integration) and the exponential step (drives linear over it); at rest every
//! state is its drive and the coefficients are those of the table.

pub mod attached;
pub mod cycle;
pub mod hgm;
pub mod impulsive;
pub mod indicial;
pub mod lag;
pub mod memory;
pub mod model;
pub mod oye;
pub mod separation;

pub use cycle::{Cycle, CycleError, Motion, Oscillation};
pub use lag::{MAX_STATES, States};
pub use memory::{Memory, Past};
pub use model::Model;
pub use separation::Separation;

use super::Airfoil;
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// A section of a blade with what was found from its table.
#[derive(Clone, Copy, Debug)]
pub struct Section<'a> {
    /// Its table.
    pub airfoil: &'a Airfoil,
    /// Separation found from the table.
    pub separation: &'a Separation,
    /// Chord [m].
    pub chord: f64,
}

/// What a section feels at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Flow<S> {
    /// Angle of attack at three quarters of the chord [rad].
    pub alpha: S,
    /// Angle of attack at the quarter chord [rad].
    pub alpha_quarter: S,
    /// Nose-up angular velocity, absolute [rad/s].
    pub pitch_rate: S,
    /// The same relative to axes that go round with the blade [rad/s]: of what turns with the rotor the centripetal acceleration
    /// takes off what its rate adds to that of the air.
    pub turn_rate: S,
    /// Speed normal to the span [m/s], above 0.
    pub speed: S,
    /// Speed of sound [m/s].
    pub speed_of_sound: f64,
}

impl<S: Real> Flow<S> {
    /// Mach number normal to the span.
    pub fn mach(&self) -> S {
        self.speed / self.speed_of_sound
    }

    /// Semichords travelled per second [1/s].
    fn semichords(&self, chord: f64) -> S {
        self.speed * (2.0 / chord)
    }

    /// Pitch rate over the speed, c omega/V.
    fn reduced_rate(&self, chord: f64) -> S {
        self.pitch_rate * chord / self.speed
    }

    /// Rate of pitch in the blade's axes over the speed, c omega/V.
    fn reduced_turn(&self, chord: f64) -> S {
        self.turn_rate * chord / self.speed
    }

    /// Share of the unsteady model: all up to 45 deg, none beyond 60 deg and in reversed flow, whose edges are exchanged.
    fn engaged(&self) -> S {
        let (full, none) = (PI / 4.0, PI / 3.0);
        let x = ((-self.alpha.abs() + none) / (none - full)).clamped(0.0, 1.0);
        x * x * (x * -2.0 + 3.0)
    }
}

/// Coefficients of a section, all that acts on it included.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<S> {
    /// Lift.
    pub cl: S,
    /// Lift that is circulation: without what the acceleration of the air adds.
    pub circulatory: S,
    /// Drag.
    pub cd: S,
    /// Moment about the quarter chord, nose up positive, damping by the pitch rate included.
    pub cm: S,
    /// Angle of attack that the shed wake leaves [rad].
    pub alpha_effective: S,
    /// Separation point as a share of the chord, 1 where the flow is attached; of the table where no state holds it.
    pub separation: S,
}

/// Quasi-steady damping of thin-airfoil theory: moment coefficient over the reduced pitch rate.
const DAMPING: f64 = -PI / 8.0;
