//! Velocity induced by many straight segments at many points.

use super::core::Core;

/// Straight segments from `start` to `end`, one entry each.
#[derive(Clone, Debug, Default)]
pub struct Segments {
    /// Start points [m].
    pub start: Vec<[f64; 3]>,
    /// End points [m]; vorticity points from start to end.
    pub end: Vec<[f64; 3]>,
    /// Circulation [m2/s].
    pub circulation: Vec<f64>,
    /// Core radius [m].
    pub core_radius: Vec<f64>,
}

/// Adds to `velocity` the velocity induced at `points` [m/s]; sources in their order for every point, parallel over points.
pub fn add_induced_velocity(points: &[[f64; 3]], segments: &Segments, core: Core, velocity: &mut [[f64; 3]]) {
    let _ = (points, segments, core, velocity);
}
