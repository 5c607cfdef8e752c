//! Trim: one list of unknowns and one list of equations for a rotor on whatever carries it, an airframe or a stand.
//!
//! Unknowns: controls; attitude and the part of the flight path left free, where an airframe flies; inflow states; mean and
//! harmonics of the periodic motion of every blade mode. Equations: those of [`equation::Equation`], as many as there are
//! controls, angles of attitude and free parts of the path; equilibrium of the inflow states with the loads averaged over a
//! revolution; every harmonic of the blade equations.
pub mod convention;
pub mod equation;
pub mod error;
pub mod host;
pub mod jacobian;
pub mod layout;
pub mod passages;
pub mod path;
pub mod problem;
pub mod residual;
