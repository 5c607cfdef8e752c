//! Steady motion of an airframe through the air, and what of it is left free.

use super::error::ProblemError;
use crate::numerics::scalar::Real;
use serde::{Deserialize, Serialize};

/// Steady motion of an airframe through the air.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Path<S> {
    /// True airspeed along the flight path [m/s].
    pub speed: S,
    /// Flight-path angle, climb positive [rad].
    pub flight_path: S,
    /// Rate of turn, right positive [rad/s].
    pub turn_rate: S,
}

impl Path<f64> {
    /// The same for the equations.
    pub fn constant<S: Real>(&self) -> Path<S> {
        Path {
            speed: S::cst(self.speed),
            flight_path: S::cst(self.flight_path),
            turn_rate: S::cst(self.turn_rate),
        }
    }
}

/// Part of the path that is left free.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub enum PathUnknown {
    /// Airspeed.
    Speed,
    /// Flight-path angle.
    FlightPath,
    /// Rate of turn.
    TurnRate,
}

impl PathUnknown {
    /// From its name.
    pub fn named(name: &str) -> Result<Self, ProblemError> {
        Ok(match name {
            "speed" => Self::Speed,
            "flight_path" => Self::FlightPath,
            "turn_rate" => Self::TurnRate,
            other => return Err(ProblemError::Path(other.into())),
        })
    }

    /// Name and unit.
    pub fn name(self) -> (&'static str, &'static str) {
        match self {
            Self::Speed => ("speed", "m/s"),
            Self::FlightPath => ("flight_path", "rad"),
            Self::TurnRate => ("turn_rate", "rad/s"),
        }
    }

    /// This part of `path`.
    pub fn of<S>(self, path: &mut Path<S>) -> &mut S {
        match self {
            Self::Speed => &mut path.speed,
            Self::FlightPath => &mut path.flight_path,
            Self::TurnRate => &mut path.turn_rate,
        }
    }
}
