//! Straight vortex segments: core models and sums over many.
pub mod core;
pub mod curvature;
pub mod induced_velocity;
