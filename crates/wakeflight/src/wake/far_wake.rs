//! What goes on behind the free filaments.
//!
//! In a periodic wake the last turn is repeated: what left the rotor a revolution earlier lies where the last turn does,
//! displaced by what a marker moves in a revolution. In a wake that marches in time the same is a wake that is carried: a
//! marker that reaches the end of its filament goes on with the air of the hub's motion and the mean induced velocity of
//! the last turn of all trailers of its kind. So what lies far below is what was released then, and strength and
//! displacement of the last turn reach it at the speed of the flow; repeats would put them everywhere at once.
//!
//! Of a lattice the far wake is felt as a whole: segments of up to `FAR_STEP` with the mean circulation of a turn, and no core
//! smaller than half of their length at the tip, so that neighbours overlap. What is finer it does not hold, and thin cores would
//! let such long segments pass markers and blades as vortices that are not there.

use super::choices::Trailers;
use super::filament::Filaments;
use super::motion::HubMotion;
use super::options::WakeOptions;
use super::sink::{Sink, Viewer};
use super::vectors::sum;
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

/// Mean displacement of the markers of the last turn of filament `i` in a revolution [m].
fn pitch(options: &WakeOptions, free: &Filaments, i: usize) -> [f64; 3] {
    let (n, turn, m) = (free.n_segments, options.steps_per_revolution(), free.marker(i, 0));
    let mut pitch = [0.0; 3];
    for k in n + 1 - turn..=n {
        let (a, b) = (free.position[m + k - turn], free.position[m + k]);
        for c in 0..3 {
            pitch[c] += (b[c] - a[c]) / turn as f64;
        }
    }
    pitch
}

/// The far wake of a periodic wake as filaments that can be carried on: the last turn of each, repeated.
pub(super) fn repeated(options: &WakeOptions, free: &Filaments) -> Filaments {
    let (n, turn) = (free.n_segments, options.steps_per_revolution());
    let mut far = Filaments {
        n_filaments: free.n_filaments,
        n_segments: options.far_wake_turns * turn,
        ..Filaments::default()
    };
    if far.n_segments == 0 {
        return Filaments::default();
    }
    for i in 0..free.n_filaments {
        let (m, pitch) = (free.marker(i, 0), pitch(options, free, i));
        let mean = entering(options, free, i);
        far.position.push(free.position[m + n]);
        far.circulation.push(mean);
        for k in 0..far.n_segments {
            let at = m + n - turn + 1 + k % turn;
            let turns = (k / turn + 1) as f64;
            far.position.push(sum(free.position[at], pitch.map(|p| p * turns)));
            far.circulation.push(if options.trailers == Trailers::Tip { free.circulation[at] } else { mean });
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

/// Appends the far wake of filament `i`: that which is carried, or the repeats of the last turn.
pub(super) fn push(
    segments: &mut impl Sink,
    options: &WakeOptions,
    (free, far): (&Filaments, &Filaments),
    i: usize,
    viewer: Viewer,
) {
    let (n, m, stride) = (free.n_segments, free.marker(i, 0), stride(options));
    if far.n_segments > 0 {
        let (first, core) = (far.marker(i, 0), core(options, free, i, viewer));
        for k in (first..first + far.n_segments).step_by(stride) {
            let strength = 0.5 * (far.circulation[k] + far.circulation[k + stride]);
            segments.push(far.position[k], far.position[k + stride], strength, core);
        }
        return;
    }
    if options.far_wake_turns == 0 {
        return;
    }
    let (turn, pitch) = (options.steps_per_revolution(), pitch(options, free, i));
    let mean = entering(options, free, i);
    let whole = core(options, free, i, viewer);
    for repeat in 1..=options.far_wake_turns {
        let shift = pitch.map(|p| p * repeat as f64);
        for k in (n - turn..n).step_by(stride) {
            let (a, b) = (free.position[m + k], free.position[m + k + stride]);
            let (strength, core) = match options.trailers {
                Trailers::Tip => (
                    0.5 * (free.circulation[m + k] + free.circulation[m + k + 1]),
                    free.core_squared[i * n + k].sqrt().max(viewer.floor),
                ),
                Trailers::FullSpan => (mean, whole),
            };
            segments.push(sum(a, shift), sum(b, shift), strength, core);
        }
    }
}
