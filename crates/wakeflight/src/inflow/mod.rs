//! Inflow models that have states.
pub mod pitt_peters;
