//! How close the tip vortices come to the blades, in core radii.

use super::instant::RotorInstant;
use super::options::WakeOptions;
use super::vectors::difference;

/// Smallest distance between a blade's span (root to tip) and a tip-vortex segment, over the segment's core radius.
///
/// Of a full-span wake the trailers that leave the tips count. Segments of the blade's own vortex that are younger than its near wake are left out: they are released there.
pub fn miss_distance_in_cores(options: &WakeOptions, instant: &RotorInstant) -> f64 {
    let (free, n, n_t) = (&instant.free, options.n_stations, options.trailers_per_blade());
    let mut smallest = f64::INFINITY;
    for blade in 0..options.rotor.n_blades {
        // stations lie on the line of a rigid blade: its two ends are the whole span
        let ends = [instant.edge[blade * (n + 1)], instant.edge[blade * (n + 1) + n]];
        let span = Span::new(ends);
        for other in 0..options.rotor.n_blades {
            let filament = (other + 1) * n_t - 1;
            let first = if other == blade { options.near_wake_markers().max(1) } else { 0 };
            let nodes = &free.position[free.marker(filament, first)..=free.marker(filament, free.n_segments)];
            let cores = &free.core_squared[filament * free.n_segments + first..];
            let mut from = span.place(nodes[0]);
            for (ab, core_squared) in nodes.windows(2).zip(cores) {
                let to = span.place(ab[1]);
                // far away: no need to look closer
                if SHORTENED * span.gap_squared(from, to) < smallest * smallest * core_squared {
                    smallest = smallest.min(segment_distance([ab[0], ab[1]], ends) / core_squared.sqrt());
                }
                from = to;
            }
        }
    }
    smallest
}

/// Share of the square of a gap that rounding leaves at least.
const SHORTENED: f64 = 1.0 - 1e-9;

/// The span of a blade and axes along and across it.
struct Span {
    root: [f64; 3],
    length: f64,
    axes: [[f64; 3]; 3],
}

impl Span {
    fn new([root, tip]: [[f64; 3]; 2]) -> Self {
        let along = difference(tip, root);
        let length = dot(along, along).sqrt();
        let axis = along.map(|x| x / length);
        let level = axis[0].hypot(axis[1]);
        let across = if level > 0.0 { [-axis[1] / level, axis[0] / level, 0.0] } else { [0.0, 1.0, 0.0] };
        let up = [-axis[2] * across[1], axis[2] * across[0], axis[0] * across[1] - axis[1] * across[0]];
        Self { root, length, axes: [axis, across, up] }
    }

    /// Coordinates of a point along the axes.
    fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let from_root = difference(point, self.root);
        self.axes.map(|axis| dot(axis, from_root))
    }

    /// Square of the distance of the span from the box about a segment between two places: no more than from the segment.
    fn gap_squared(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        let beyond = |c: usize, end: f64| (a[c].min(b[c]) - end).max(-a[c].max(b[c])).max(0.0);
        let (along, across, up) = (beyond(0, self.length), beyond(1, 0.0), beyond(2, 0.0));
        along * along + across * across + up * up
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Smallest distance between two straight segments [m].
fn segment_distance(p: [[f64; 3]; 2], q: [[f64; 3]; 2]) -> f64 {
    let (u, v, w) = (difference(p[1], p[0]), difference(q[1], q[0]), difference(p[0], q[0]));
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
