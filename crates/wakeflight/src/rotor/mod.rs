//! The rotor: swashplate, lag damper, hub.
pub mod hub;
pub mod lag_damper;
pub mod swashplate;
