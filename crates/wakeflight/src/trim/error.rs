//! Why a problem of trim is none.

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
    /// Passages without an inflow.
    #[error("inflow is needed: the problem has none of its own")]
    NoInflow,
    /// Memory of sections for another number of passages, or missing.
    #[error("sections: memory of {rows} blade instants, {needed} needed")]
    Memory {
        /// Rows given.
        rows: usize,
        /// Rows needed.
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
