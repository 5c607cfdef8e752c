//! How close the tip vortices come to the blades, in core radii.

use super::instant::RotorInstant;
use super::options::WakeOptions;

/// Smallest distance between a blade's span (root to tip) and a tip-vortex segment, over the segment's core radius.
///
/// Of a full-span wake the trailers that leave the tips count. Segments of the blade's own vortex that are younger than its near wake are left out: they are released there.
pub fn miss_distance_in_cores(options: &WakeOptions, instant: &RotorInstant) -> f64 {
    let (free, n, n_t) = (&instant.free, options.n_stations, options.trailers_per_blade());
    let mut smallest = f64::INFINITY;
    for blade in 0..options.rotor.n_blades {
        // stations lie on the line of a rigid blade: its two ends are the whole span
        let ends = [instant.edge[blade * (n + 1)], instant.edge[blade * (n + 1) + n]];
        let (low, high) = (ends[0][2].min(ends[1][2]), ends[0][2].max(ends[1][2]));
        for other in 0..options.rotor.n_blades {
            let filament = (other + 1) * n_t - 1;
            let first = if other == blade { options.near_wake_markers().max(1) } else { 0 };
            for k in first..free.n_segments {
                let m = free.marker(filament, k);
                let (a, b) = (free.position[m], free.position[m + 1]);
                let core = free.core_squared[filament * free.n_segments + k].sqrt();
                // far above or below: no need to look closer
                let gap = (a[2].min(b[2]) - high).max(low - a[2].max(b[2]));
                if gap < smallest * core {
                    smallest = smallest.min(segment_distance([a, b], ends) / core);
                }
            }
        }
    }
    smallest
}

/// Smallest distance between two straight segments [m].
fn segment_distance(p: [[f64; 3]; 2], q: [[f64; 3]; 2]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (u, v, w) = (minus(p[1], p[0]), minus(q[1], q[0]), minus(p[0], q[0]));
    let (uu, uv, vv, uw, vw) = (dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w));
    let share = |numerator: f64, squared: f64| {
        if squared > 0.0 { (numerator / squared).clamp(0.0, 1.0) } else { 0.0 }
    };
    // nearest points of the two lines, then held within the segments, one after the other
    let s = share(uv * vw - vv * uw, uu * vv - uv * uv);
    let t = share(uv * s + vw, vv);
    let s = share(uv * t - uw, uu);
    let t = share(uv * s + vw, vv);
    let apart: [f64; 3] = std::array::from_fn(|c| w[c] + s * u[c] - t * v[c]);
    dot(apart, apart).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wake::geometry::BladeGrid;

    #[test]
    fn distances_of_segments_are_those_of_geometry() {
        let x = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        let cases = [
            ([[1.0, -1.0, 0.5], [1.0, 1.0, 0.5]], 0.5),
            ([[3.0, 0.0, 0.0], [4.0, 0.0, 0.0]], 1.0),
            ([[-3.0, 4.0, 0.0], [0.0, 4.0, 0.0]], 4.0),
            ([[3.0, 1.0, 0.0], [5.0, 1.0, 0.0]], 2f64.sqrt()),
            ([[1.0, 2.0, 3.0], [1.0, 2.0, 3.0]], 13f64.sqrt()),
            ([[0.0, 1.0, 1.0], [2.0, 1.0, 1.0]], 2f64.sqrt()),
        ];
        for (q, distance) in cases {
            assert!((segment_distance(x, q) - distance).abs() < 1e-14, "{q:?}");
            assert!((segment_distance(q, x) - distance).abs() < 1e-14, "{q:?}");
        }
    }

    #[test]
    fn a_vortex_laid_above_a_blade_misses_it_by_its_height() {
        let options = WakeOptions::new(2, 8.0, 1.0, 0.4, 0.5, 27.0);
        let mut instant = RotorInstant::new(&options, &BladeGrid::new(&options));
        let n = options.n_stations;
        for (blade, side) in [(0, 1.0), (1, -1.0)] {
            for (j, edge) in instant.edge[blade * (n + 1)..(blade + 1) * (n + 1)].iter_mut().enumerate() {
                *edge = [side * (1.0 + 7.0 * j as f64 / n as f64), 0.0, 0.0];
            }
        }
        let far = [0.0, 0.0, 50.0];
        instant.free.position.fill(far);
        let m = instant.free.marker(0, 20);
        (instant.free.position[m], instant.free.position[m + 1]) = ([5.0, -1.0, 0.3], [5.0, 1.0, 0.3]);
        instant.free.core_squared.fill(0.01);
        assert!((miss_distance_in_cores(&options, &instant) - 3.0).abs() < 1e-9);
    }
}
