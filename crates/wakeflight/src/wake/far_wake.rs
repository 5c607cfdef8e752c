//! What goes on behind the free filaments.
//!
//! A marker that reaches the end of its filament is carried on with the air of the hub's motion and the mean induced velocity of
//! the last turn of all trailers of its kind. So what lies far below is what was released then, and strength and displacement of
//! the last turn reach it at the speed of the flow. A periodic wake has the far wake of the wake that marches into it: where the
//! last turn was repeated instead, displaced by what a marker moves in a revolution (from the turn before to the last), the two
//! wakes differed by 4 % of the inflow at 20 kt.
//!
//! Of a lattice the far wake is felt as a whole: segments of up to `FAR_STEP` with the mean circulation of a turn, and no core
//! smaller than half of their length at the tip, so that neighbours overlap. What is finer it does not hold, and thin cores would
//! let such long segments pass markers and blades as vortices that are not there.

use super::choices::Trailers;
use super::filament::Filaments;
use super::motion::HubMotion;
use super::options::WakeOptions;
use super::sink::{Sink, Viewer};
use super::vectors::difference;
use std::f64::consts::TAU;

/// Angle [rad] of the segments that the far wake of a lattice is made of.
const FAR_STEP: f64 = 30.0 * TAU / 360.0;

/// Markers between the ends of a segment of the far wake: one of a tip vortex; of a lattice, whose far wake is felt as a
/// whole, the longest whole number of steps up to `FAR_STEP` that divides the turn.
fn stride(options: &WakeOptions) -> usize {
    if options.trailers == Trailers::Tip {
        return 1;
    }
    let turn = options.steps_per_revolution();
    let most = ((FAR_STEP / options.delta_psi() + 1e-9) as usize).max(1);
    (1..=most).rev().find(|s| turn.is_multiple_of(*s)).unwrap_or(1)
}

/// Core radius of the far wake of filament `i` as the viewer sees it [m].
fn core(options: &WakeOptions, free: &Filaments, i: usize, viewer: Viewer) -> f64 {
    let aged = free.core_squared[(i + 1) * free.n_segments - 1].sqrt().max(viewer.floor);
    match options.trailers {
        Trailers::Tip => aged,
        Trailers::FullSpan => {
            aged.max(0.5 * stride(options) as f64 * options.delta_psi() * options.rotor.radius)
        }
    }
}

/// Circulation that filament `i` has in the far wake where it begins [m2/s]: of a lattice the mean of the last turn, which
/// needs no shed vortices to be closed as long as it stays what it is.
fn entering(options: &WakeOptions, free: &Filaments, i: usize) -> f64 {
    let (n, turn, m) = (free.n_segments, options.steps_per_revolution(), free.marker(i, 0));
    match options.trailers {
        Trailers::Tip => free.circulation[m + n],
        Trailers::FullSpan => free.circulation[m + n - turn..m + n].iter().sum::<f64>() / turn as f64,
    }
}

/// The far wake of a periodic wake, by row (n_azimuths, n_trailers): every marker lies where that of the row before is carried in
/// a step of `time` [s].
///
/// `position`: free markers (n_azimuths, n_trailers, n_segments + 1) [m]; `released`: circulation of the trailers that left at
/// every azimuth (n_azimuths, n_trailers) [m2/s]. What the markers of a kind drift by over the last turn, in the mean of all
/// azimuths, is the mean velocity there.
pub(super) fn periodic(
    options: &WakeOptions,
    hub: &HubMotion,
    position: &[[f64; 3]],
    released: &[f64],
    time: f64,
) -> Filaments {
    let (n, turn, n_t) = (options.n_segments(), options.steps_per_revolution(), options.trailers_per_blade());
    let n_far = options.far_wake_turns * turn;
    if n_far == 0 {
        return Filaments::default();
    }
    let mut far = Filaments {
        n_filaments: turn * n_t,
        n_segments: n_far,
        position: vec![[0.0; 3]; turn * n_t * (n_far + 1)],
        circulation: vec![0.0; turn * n_t * (n_far + 1)],
        ..Filaments::default()
    };
    let before = |l: usize, k: usize| (l + turn - k % turn) % turn;
    let share = 1.0 / (turn * turn) as f64;
    for t in 0..n_t {
        let free = |l: usize, k: usize| position[(l * n_t + t) * (n + 1) + k];
        let (mut drift, mut middle) = ([0.0; 3], [0.0; 3]);
        for l in 0..turn {
            for c in 0..3 {
                drift[c] += (free(l, n)[c] - free(l, n - turn)[c]) * share;
                middle[c] += (n + 1 - turn..=n).map(|k| free(l, k)[c]).sum::<f64>() * share;
            }
        }
        let induced = difference(drift, hub.wind(middle).map(|w| w * time));
        let mean = (0..turn).map(|l| released[l * n_t + t]).sum::<f64>() / turn as f64;
        for k in 0..=n_far {
            for l in 0..turn {
                let m = far.marker(l * n_t + t, k);
                far.position[m] = if k == 0 {
                    free(l, n)
                } else {
                    let from = far.position[far.marker(before(l, 1) * n_t + t, k - 1)];
                    let wind = hub.wind(from);
                    std::array::from_fn(|c| from[c] + wind[c] * time + induced[c])
                };
                far.circulation[m] = match options.trailers {
                    Trailers::Tip => released[before(l, n + k) * n_t + t],
                    Trailers::FullSpan => mean,
                };
            }
        }
    }
    far
}

/// Carries the far wake on by a step of `time` [s]: `old` free filaments with the velocity of their markers relative to the
/// hub axes [m/s] at the level that the step begins with.
pub(super) fn carry(
    options: &WakeOptions,
    far: &mut Filaments,
    old: &Filaments,
    velocity: &[[f64; 3]],
    hub: &HubMotion,
    time: f64,
) {
    if far.n_segments == 0 {
        return;
    }
    let (n, turn, n_t) = (old.n_segments, options.steps_per_revolution(), options.trailers_per_blade());
    for t in 0..n_t {
        let of_kind = || (t..old.n_filaments).step_by(n_t);
        let mut induced = [0.0; 3];
        let share = 1.0 / (of_kind().count() * turn) as f64;
        for i in of_kind() {
            for k in n + 1 - turn..=n {
                let m = old.marker(i, k);
                let wind = hub.wind(old.position[m]);
                for c in 0..3 {
                    induced[c] += (velocity[m][c] - wind[c]) * share;
                }
            }
        }
        for i in of_kind() {
            let (m, last) = (far.marker(i, 0), far.n_segments);
            for k in (0..last).rev() {
                let from = far.position[m + k];
                let wind = hub.wind(from);
                far.position[m + k + 1] = std::array::from_fn(|c| from[c] + (wind[c] + induced[c]) * time);
            }
            far.circulation.copy_within(m..m + last, m + 1);
        }
    }
}

/// Joins the far wake to the ends of the free filaments of its level.
pub(super) fn join(options: &WakeOptions, far: &mut Filaments, free: &Filaments) {
    if far.n_segments == 0 {
        return;
    }
    for i in 0..free.n_filaments {
        let m = far.marker(i, 0);
        far.position[m] = free.position[free.marker(i, free.n_segments)];
        far.circulation[m] = entering(options, free, i);
    }
}

/// Appends the far wake of filament `i`.
pub(super) fn push(
    segments: &mut impl Sink,
    options: &WakeOptions,
    (free, far): (&Filaments, &Filaments),
    i: usize,
    viewer: Viewer,
) {
    if far.n_segments == 0 {
        return;
    }
    let (first, stride, core) = (far.marker(i, 0), stride(options), core(options, free, i, viewer));
    for k in (first..first + far.n_segments).step_by(stride) {
        let strength = 0.5 * (far.circulation[k] + far.circulation[k + stride]);
        segments.push(far.position[k], far.position[k + stride], strength, core);
    }
}
