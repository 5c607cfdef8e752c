//! Straight vortex segments: core models and sums over many.
pub mod core;
pub mod induced_velocity;
