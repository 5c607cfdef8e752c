//! Velocity induced by many straight segments at many points.

use super::core::{Core, CoreDistance};
use rayon::prelude::*;

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
    add_segments_velocity(points, segments, core, CoreDistance::Line, velocity);
}

/// Same with a choice of the distance in the core factor (n = 2 profile, or no core).
pub fn add_segments_velocity(
    points: &[[f64; 3]],
    segments: &Segments,
    core: Core,
    distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    let n = segments.start.len();
    velocity.par_iter_mut().zip(points).with_min_len(16).for_each(|(v, &p)| {
        for i in 0..n {
            let (a, b) = (segments.start[i], segments.end[i]);
            let r1 = [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
            let r2 = [p[0] - b[0], p[1] - b[1], p[2] - b[2]];
            let l = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            let dot = |u: [f64; 3], w: [f64; 3]| u[0] * w[0] + u[1] * w[1] + u[2] * w[2];
            let c = [r1[1] * r2[2] - r1[2] * r2[1], r1[2] * r2[0] - r1[0] * r2[2], r1[0] * r2[1] - r1[1] * r2[0]];
            let (c2, l2, d) = (dot(c, c), dot(l, l), dot(r1, r2));
            let (s1, s2) = (dot(r1, r1), dot(r2, r2));
            if s1 < 1e-24 || s2 < 1e-24 || l2 < 1e-24 || c2 == 0.0 {
                continue;
            }
            let (n1, n2) = (s1.sqrt(), s2.sqrt());
            let s = if d <= 0.0 { n1 * n2 - d } else { c2 / (n1 * n2 + d) };
            let rc = if core == Core::Singular { 0.0 } else { segments.core_radius[i] };
            let rc4 = rc * rc * rc * rc;
            // core factor over c^2: 1 / sqrt(c^4 + rc^4 l^4)
            let factor = match distance {
                CoreDistance::Line => 1.0 / (c2 * c2 + rc4 * l2 * l2).sqrt(),
                CoreDistance::Segment => {
                    let h2 = if dot(r1, l) < 0.0 { s1 } else if dot(r2, l) > 0.0 { s2 } else { c2 / l2 };
                    h2 / (h2 * h2 + rc4).sqrt() / c2
                }
            };
            let k = segments.circulation[i] / (4.0 * std::f64::consts::PI) * (n1 + n2) / (n1 * n2) * s * factor;
            v[0] += k * c[0];
            v[1] += k * c[1];
            v[2] += k * c[2];
        }
    });
}
