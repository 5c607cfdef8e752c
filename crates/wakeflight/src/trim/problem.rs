//! What is asked of a trim.

use super::equation::Equation;
use crate::numerics::scalar::Real;
use thiserror::Error;

/// A question that is none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProblemError {
    /// The lists do not match.
    #[error("{unknowns} controls, angles and free parts of the path, but {equations} equations for them")]
    NotSquare {
        /// Unknowns that need an equation.
        unknowns: usize,
        /// Equations given.
        equations: usize,
    },
    /// An equation of flight, or a free path, on a stand.
    #[error("{0} belongs to an airframe in flight: there is none")]
    NoAirframe(&'static str),
    /// A held map of another size.
    #[error("inflow map has {values} values for {n_azimuths} azimuths of {n_stations} stations")]
    Inflow {
        /// Values given.
        values: usize,
        /// Azimuths.
        n_azimuths: usize,
        /// Stations of a blade.
        n_stations: usize,
    },
    /// A vector of unknowns of another length.
    #[error("{given} unknowns, {needed} needed")]
    Unknowns {
        /// Numbers given.
        given: usize,
        /// Numbers needed.
        needed: usize,
    },
    /// No azimuth to average over.
    #[error("no azimuths to average over")]
    NoAzimuths,
    /// An unknown name.
    #[error("'{0}' is no equation of a trim, or not with {1} numbers")]
    Equation(String, usize),
    /// An unknown part of the path.
    #[error("'{0}' is no part of the flight path: speed, flight_path, turn_rate")]
    Path(String),
    /// A flight whose motion is not a number.
    #[error("the flight path has a number that is not finite")]
    NotFinite,
}

/// Steady motion of an airframe through the air.
#[derive(Clone, Copy, Debug, PartialEq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// Inflow in trim.
#[derive(Clone, Debug)]
pub enum Inflow {
    /// Dynamic inflow, constant over the revolution: three unknowns.
    Dynamic,
    /// lambda held at (azimuth, station); and its disk mean.
    Map {
        /// Row-major (n_azimuths, width), positive down; rows as [`held_inflow`](crate::rotor::hub::Rotor::held_inflow) takes them.
        inflow: Vec<f64>,
        /// Disk mean.
        mean: f64,
    },
}

/// A steady condition to trim for.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Motion of an airframe; of what is left free, a number without meaning. Not read on a stand.
    pub path: Path<f64>,
    /// Parts of the path that are unknowns.
    pub free: Vec<PathUnknown>,
    /// Equations for controls, attitude and the free parts of the path.
    pub equations: Vec<Equation>,
    /// Harmonics of the blade motion.
    pub n_harmonics: usize,
    /// Azimuths of the averages and projections.
    pub n_azimuths: usize,
    /// Inflow.
    pub inflow: Inflow,
}

impl Problem {
    /// Whether the states of dynamic inflow are unknowns.
    pub fn is_dynamic(&self) -> bool {
        matches!(self.inflow, Inflow::Dynamic)
    }
}
