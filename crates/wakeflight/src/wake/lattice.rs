//! Free vortices of a rotor as segments: filaments, the shed vortices that join them, and the far wake behind both.
//!
//! A full-span wake is a lattice of vortex rings. Ring (panel i, age k) lies between the trailers i and i + 1 and the
//! markers k and k + 1 and has the mean circulation of the two markers, g_k = (G_k + G_(k+1))/2; G, the circulation of the
//! panel when the marker left the blade, is minus the sum of the trailers' strengths from the root to trailer i. Summed,
//! the rings leave trailing segments of the mean strength of their ends and shed segments g_k - g_(k-1), root to tip
//! positive; at the blade g_0 - G_0. No vorticity ends anywhere but at the old end, where the wake that is left out goes on;
//! a far wake behind it has the mean circulation of the last turn and is closed in itself.

use super::choices::{ShedWake, Trailers};
use super::filament::Filaments;
use super::options::WakeOptions;
use super::sink::Sink;
use super::vectors::sum;
use std::f64::consts::TAU;

/// Who looks at the free vortices of one blade.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viewer {
    /// First marker whose trailing vortices are seen: the last of the near wake for the blade itself, else 0.
    pub first: usize,
    /// Least core radius [m].
    pub floor: f64,
}

/// Appends filament `i` from the viewer's first marker on, and the displaced repeats of its last turn (the far wake).
pub(crate) fn push_filament(
    segments: &mut impl Sink,
    options: &WakeOptions,
    filaments: &Filaments,
    i: usize,
    viewer: Viewer,
) {
    let n = filaments.n_segments;
    let m = filaments.marker(i, 0);
    let mut segment = |k: usize, shift: [f64; 3]| {
        let (a, b) = (filaments.position[m + k], filaments.position[m + k + 1]);
        let strength = 0.5 * (filaments.circulation[m + k] + filaments.circulation[m + k + 1]);
        let core = filaments.core_squared[i * n + k].sqrt().max(viewer.floor);
        segments.push(sum(a, shift), sum(b, shift), strength, core);
    };
    for k in viewer.first..n {
        segment(k, [0.0; 3]);
    }
    if options.trailers == Trailers::FullSpan {
        return push_far_trailer(segments, options, filaments, i, viewer);
    }
    for shift in far_wake(options, filaments, i) {
        for k in n - options.steps_per_revolution()..n {
            segment(k, shift);
        }
    }
}

/// Angle [rad] of the segments that the far wake of a lattice is made of.
const FAR_STEP: f64 = 30.0 * TAU / 360.0;

/// Appends the displaced repeats of the last turn of trailer `i` of a lattice, in long segments of the turn's mean
/// circulation: what lies there is felt as a whole, and of constant strength it needs no shed vortices to be closed.
fn push_far_trailer(
    segments: &mut impl Sink,
    options: &WakeOptions,
    free: &Filaments,
    i: usize,
    viewer: Viewer,
) {
    let shifts = far_wake(options, free, i);
    if shifts.is_empty() {
        return;
    }
    let (n, turn, m) = (free.n_segments, options.steps_per_revolution(), free.marker(i, 0));
    let strength = free.circulation[m + n - turn..m + n].iter().sum::<f64>() / turn as f64;
    let core = free.core_squared[(i + 1) * n - 1].sqrt().max(viewer.floor);
    // the longest whole number of steps up to FAR_STEP that divides the turn
    let most = ((FAR_STEP / options.delta_psi() + 1e-9) as usize).max(1);
    let stride = (1..=most).rev().find(|s| turn.is_multiple_of(*s)).unwrap_or(1);
    for shift in shifts {
        for k in (n - turn..n).step_by(stride) {
            let (a, b) = (free.position[m + k], free.position[m + k + stride]);
            segments.push(sum(a, shift), sum(b, shift), strength, core);
        }
    }
}

/// Displacements of the repeats of the last turn: multiples of the mean displacement of the markers over that turn.
fn far_wake(options: &WakeOptions, filaments: &Filaments, i: usize) -> Vec<[f64; 3]> {
    if options.far_wake_turns == 0 {
        return Vec::new();
    }
    let (n, turn, m) = (filaments.n_segments, options.steps_per_revolution(), filaments.marker(i, 0));
    let mut pitch = [0.0; 3];
    for k in n + 1 - turn..=n {
        let (a, b) = (filaments.position[m + k - turn], filaments.position[m + k]);
        for c in 0..3 {
            pitch[c] += (b[c] - a[c]) / turn as f64;
        }
    }
    (1..=options.far_wake_turns).map(|repeat| pitch.map(|s| s * repeat as f64)).collect()
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
