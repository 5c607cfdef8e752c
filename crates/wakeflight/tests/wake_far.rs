//! The far wake of a marching wake: carried by the flow, with what was released then.

mod wake_cases;

use std::f64::consts::TAU;
use wake_cases::*;
use wakeflight::wake::{
    BladeState, Induction, LinearField, RelaxationWake, TimeMarchingWake, Trailers, WakeOptions,
};

/// Induced velocity, the same everywhere [m/s].
const INDUCED: [f64; 3] = [0.0, 0.0, -9.0];

fn far_options() -> WakeOptions {
    WakeOptions {
        trailers: Trailers::FullSpan,
        n_trailers: 3,
        turns: 2.0,
        far_wake_turns: 2,
        azimuth_step: TAU / 24.0,
        ..options()
    }
}

/// Blades `step` steps after the start.
fn blades(options: &WakeOptions, step: usize) -> Vec<BladeState> {
    let n = options.rotor.n_blades;
    (0..n)
        .map(|b| BladeState {
            psi: TAU * b as f64 / n as f64 + step as f64 * options.delta_psi(),
            ..BladeState::default()
        })
        .collect()
}

/// Marches the periodic wake of a prescribed induced velocity, its circulation `gamma` of the step.
fn marched(options: &WakeOptions, steps: usize, gamma: impl Fn(usize) -> f64) -> TimeMarchingWake<Induction> {
    let hub = hub(0.1, 0.0, 0.0, 0.0, 0.0);
    let field = Induction::Linear(LinearField::new(INDUCED, [[0.0; 3]; 3]).unwrap());
    let n = options.steps_per_revolution();
    let mut periodic = RelaxationWake::with_field(*options, own(options), hub, 0.04, field).unwrap();
    periodic.set_state(hub, &vec![(0.0, 0.0); n], &vec![gamma(0); n * options.n_stations]).unwrap();
    settle(&mut periodic, 1e-13, 200);
    let mut wake = TimeMarchingWake::from_relaxation(&periodic, 0, two_fields()).unwrap();
    for step in 1..=steps {
        let strength = vec![gamma(step); options.rotor.n_blades * options.n_stations];
        wake.step(hub, &blades(options, step), &strength).unwrap();
    }
    wake
}

#[test]
fn verif_a_carried_far_wake_lies_where_the_flow_takes_it() {
    // in a flow that is the same everywhere every marker lies at its release plus the time since, and far ones do too
    let options = far_options();
    let (steps, n) = (60, options.steps_per_revolution());
    let wake = marched(&options, steps, |_| 20.0);
    let flow: Vec<f64> =
        hub(0.1, 0.0, 0.0, 0.0, 0.0).wind([0.0; 3]).iter().zip(INDUCED).map(|(w, v)| w + v).collect();
    let far = &wake.instant().far;
    assert_eq!(far.n_segments, 2 * n);
    let mut largest: f64 = 0.0;
    for filament in 0..far.n_filaments {
        for k in 0..=far.n_segments {
            let age = (options.n_segments() + k) as f64 * options.delta_psi();
            let blade = filament / options.trailers_per_blade();
            let (sin, cos) = (blades(&options, steps)[blade].psi - age).sin_cos();
            // the tip of the blade then, which lies at zero azimuth aft
            let tip = [RADIUS * cos, RADIUS * sin, 0.0];
            if filament % options.trailers_per_blade() + 1 < options.trailers_per_blade() {
                continue;
            }
            let found = far.position[far.marker(filament, k)];
            for c in 0..3 {
                largest = largest.max((found[c] - tip[c] - flow[c] * age / OMEGA).abs() / RADIUS);
            }
        }
    }
    println!("largest distance {largest:.1e} R");
    assert!(largest < 1e-9, "{largest}");
}

#[test]
fn verif_a_wake_marched_from_a_periodic_one_keeps_its_far_wake_and_its_inflow() {
    // forward flight, fast enough for the marched wake to repeat itself
    let options = WakeOptions { far_wake_turns: 4, core_growth: 1e-3, ..far_options() };
    let (hub, ct, n) = (hub(0.1, 0.0, 0.0, 0.0, 0.0), 0.0065, options.steps_per_revolution());
    let mut periodic = relaxation(&options, hub, ct, 0.03);
    settle(&mut periodic, 1e-9, 600);
    let at_rest = harmonics(periodic.grid(), &periodic.clone().inflow_far());
    let near = WakeOptions { far_wake_turns: 0, ..options };
    let mut without = relaxation(&near, hub, ct, 0.03);
    settle(&mut without, 1e-9, 600);
    let alone = harmonics(without.grid(), &without.clone().inflow_far());

    let mut wake = TimeMarchingWake::from_relaxation(&periodic, 0, two_fields()).unwrap();
    let mut marched = [0.0; 3];
    for turn in 0..12 {
        let (map, _) = revolution(&mut wake, hub, ct, turn * n);
        marched = harmonics(wake.grid(), &map);
    }
    let (off, far) = ((marched[0] - at_rest[0]) / at_rest[0], (at_rest[0] - alone[0]) / at_rest[0]);
    let (here, there) = (&periodic.instant(0).far, &wake.instant().far);
    let apart = here
        .position
        .iter()
        .zip(&there.position)
        .map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt() / RADIUS);
    let apart = apart.fold(0.0, f64::max);
    // repeats of the last turn, displaced by what a marker moves in a revolution, would lie elsewhere
    let free = &periodic.instant(0).free;
    let (length, repeats) = (options.n_segments(), options.far_wake_turns as f64);
    let repeated = (0..free.n_filaments).map(|i| {
        let (m, last) = (free.marker(i, 0), there.position[there.marker(i, there.n_segments)]);
        let off = |c: usize| {
            let moved = |k: usize| free.position[m + k][c] - free.position[m + k - n][c];
            let pitch = (length + 1 - n..=length).map(moved).sum::<f64>() / n as f64;
            free.position[m + length][c] + repeats * pitch - last[c]
        };
        (0..3).map(|c| off(c).powi(2)).sum::<f64>().sqrt() / RADIUS
    });
    let repeated = repeated.fold(0.0, f64::max);
    println!("inflow {at_rest:?}, marched {marched:?}: off by {off:.1e}; the far wake's share {far:.3}");
    println!("far wakes apart {apart:.1e} R, repeats {repeated:.1e} R");
    assert!(far.abs() > 0.02, "{far}");
    assert!(off.abs() < 2e-3, "{off}");
    assert!(apart < 0.1 && repeated > 2.0 * apart, "{apart} {repeated}");
}

#[test]
fn what_is_released_reaches_the_far_wake_when_the_flow_brings_it() {
    let options = far_options();
    let (n, free) = (options.steps_per_revolution(), options.n_segments());
    let tip = options.trailers_per_blade() - 1;
    // the tip vortices from then on are a tenth stronger
    let strengths = |steps: usize| {
        let wake = marched(&options, steps, |step| if step > 0 { 22.0 } else { 20.0 });
        let far = &wake.instant().far;
        let m = far.marker(tip, 0);
        (far.circulation[m], far.circulation[m + far.n_segments])
    };
    let (begins, ends) = strengths(0);
    assert_eq!(begins, ends);
    // nothing of it in the last free turn yet
    assert_eq!(strengths(free - n), (begins, ends));
    let (entered, old) = strengths(free + 1);
    assert!((entered / begins - 1.1).abs() < 1e-12 && old == ends, "{entered} {old}");
    let (_, arrived) = strengths(free + options.far_wake_turns * n + 1);
    assert!((arrived / ends - 1.1).abs() < 1e-12, "{arrived}");
}
