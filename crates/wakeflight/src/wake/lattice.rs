//! Free vortices of a rotor as segments: filaments, the shed vortices that join them, and the far wake behind both.
//!
//! A full-span wake is a lattice of vortex rings. Ring (panel i, age k) lies between the trailers i and i + 1 and the
//! markers k and k + 1 and has the mean circulation of the two markers, g_k = (G_k + G_(k+1))/2; G, the circulation of the
//! panel when the marker left the blade, is minus the sum of the trailers' strengths from the root to trailer i. Summed,
//! the rings leave trailing segments of the mean strength of their ends and shed segments g_k - g_(k-1), root to tip
//! positive; at the blade g_0 - G_0. No vorticity ends anywhere but at the old end, where the wake that is left out goes on;
//! a far wake behind it has the mean circulation of the last turn and is closed in itself.

use super::choices::{ShedWake, Trailers};
use super::far_wake;
use super::filament::Filaments;
use super::options::WakeOptions;
use super::sink::{Sink, Viewer};

/// Appends filament `i` from the viewer's first marker on, and its far wake.
pub(crate) fn push_filament(
    segments: &mut impl Sink,
    options: &WakeOptions,
    (free, far): (&Filaments, &Filaments),
    i: usize,
    viewer: Viewer,
) {
    let n = free.n_segments;
    let m = free.marker(i, 0);
    for k in viewer.first..n {
        let strength = 0.5 * (free.circulation[m + k] + free.circulation[m + k + 1]);
        let core = free.core_squared[i * n + k].sqrt().max(viewer.floor);
        segments.push(free.position[m + k], free.position[m + k + 1], strength, core);
    }
    far_wake::push(segments, options, (free, far), i, viewer);
}

/// Circulation of the panels of a blade at marker `k` (trailers_per_blade - 1) [m2/s], root to tip.
fn panels<'a>(
    options: &WakeOptions,
    free: &'a Filaments,
    blade: usize,
    k: usize,
) -> impl Iterator<Item = f64> + 'a {
    let n_t = options.trailers_per_blade();
    (blade * n_t..(blade + 1) * n_t - 1).scan(0.0, move |total, i| {
        *total -= free.circulation[free.marker(i, k)];
        Some(*total)
    })
}

/// Strengths of the rings of a blade between the markers `k` and `k` + 1 [m2/s].
fn rings(options: &WakeOptions, free: &Filaments, blade: usize, k: usize) -> Vec<f64> {
    panels(options, free, blade, k)
        .zip(panels(options, free, blade, k + 1))
        .map(|(now, before)| 0.5 * (now + before))
        .collect()
}

/// Appends the shed vortices of a blade, root to tip at every age.
///
/// `own`: seen from that blade's own stations, whose near wake has the present circulation all along. With `beyond` the
/// rings it stands for are one, and what was shed over it is gathered at its end.
pub(crate) fn push_shed(
    segments: &mut impl Sink,
    options: &WakeOptions,
    free: &Filaments,
    blade: usize,
    own: bool,
    viewer: Viewer,
) {
    if options.trailers == Trailers::Tip || options.shed_wake == ShedWake::None {
        return;
    }
    let (n, n_t) = (free.n_segments, options.trailers_per_blade());
    let mut row = |k: usize, newer: &[f64], older: &[f64]| {
        for p in 0..n_t - 1 {
            let i = blade * n_t + p;
            let ends = (free.position[free.marker(i, k)], free.position[free.marker(i + 1, k)]);
            // mean of the trailing segments that meet at the ends
            let age = |i: usize| {
                0.5 * (free.core_squared[i * n + k.saturating_sub(1)]
                    + free.core_squared[i * n + k.min(n - 1)])
            };
            let core = (0.5 * (age(i) + age(i + 1))).sqrt().max(viewer.floor);
            segments.push(ends.0, ends.1, older[p] - newer[p], core);
        }
    };
    let near = if own && options.shed_wake == ShedWake::Beyond { viewer.first } else { 0 };
    let mut newer: Vec<f64> = panels(options, free, blade, 0).collect();
    for k in near..n {
        let older = rings(options, free, blade, k);
        row(k, &newer, &older);
        newer = older;
    }
}

/// Bound circulation of a blade as its wake has it (n_stations) [m2/s]: that of the panel an element belongs to.
pub(crate) fn bound<'a>(
    options: &WakeOptions,
    trailer_edges: &'a [usize],
    free: &'a Filaments,
    blade: usize,
) -> impl Iterator<Item = f64> + 'a {
    panels(options, free, blade, 0)
        .zip(trailer_edges.windows(2))
        .flat_map(|(strength, e)| std::iter::repeat_n(strength, e[1] - e[0]))
}
