//! A rotor off its nominal speed: markers are carried for the time that a step of azimuth takes, cores grow by it.

mod wake_cases;

use std::f64::consts::TAU;
use wake_cases::{RADIUS, blades, hub, options, relaxation, two_fields};
use wakeflight::wake::{TimeMarchingWake, WakeOptions};

const PACE: f64 = 1.12;

/// Without circulation a marker goes with the wind from where it was released: r = release + V zeta/omega.
fn carried(options: &WakeOptions, step: usize, pace: f64) -> Vec<[f64; 3]> {
    let velocity = hub(0.1, -0.03, 0.0, 0.0, 0.0).velocity;
    let mut all = Vec::new();
    for blade in blades(options, step) {
        for k in 0..=options.n_segments() {
            let zeta = k as f64 * options.delta_psi();
            let (s, c) = (blade.psi - zeta).sin_cos();
            let age = zeta / options.rotor.omega * pace;
            all.push([RADIUS * c - velocity[0] * age, RADIUS * s - velocity[1] * age, -velocity[2] * age]);
        }
    }
    all
}

fn farthest(found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max);
    found.iter().zip(expected).map(apart).fold(0.0, f64::max)
}

#[test]
fn markers_and_cores_know_how_long_a_step_takes() {
    for stretching in [false, true] {
        let options = WakeOptions { turns: 1.0, core_stretching: stretching, core_growth: 2e-5, ..options() };
        let moving = hub(0.1, -0.03, 0.0, 0.0, 0.0);
        let mut start = relaxation(&options, moving, 0.0, 0.0);
        // a new wake is a guess
        wake_cases::settle(&mut start, 1e-12, 200);
        let mut wake = TimeMarchingWake::from_relaxation(&start, 0, two_fields()).unwrap();
        let still = vec![0.0; options.rotor.n_blades * options.n_stations];
        let n = options.n_segments();
        // as long as no step has taken another time nothing is told of it
        for step in 1..=3 {
            wake.set_pace(1.0).unwrap();
            wake.step(moving, &blades(&options, step), &still).unwrap();
        }
        assert!(farthest(wake.position(), &carried(&options, 3, 1.0)) < 1e-9);
        let before = wake.core_radius();
        // the corner that the change of pace leaves in the history of every age runs out of the wake
        for step in 4..=3 * n {
            wake.set_pace(PACE).unwrap();
            wake.step(moving, &blades(&options, step), &still).unwrap();
        }
        let off = farthest(wake.position(), &carried(&options, 3 * n, PACE));
        assert!(off < 1e-9, "{off:.1e}");
        assert!(farthest(wake.position(), &carried(&options, 3 * n, 1.0)) > 0.1);
        let grown: Vec<f64> = wake.core_radius().iter().map(|r| r * r).collect();
        let growth = options.core_growth * RADIUS * RADIUS * TAU / options.steps_per_revolution() as f64;
        let last = grown[n - 1] - grown[0];
        if !stretching {
            assert!((last / (growth * (n - 1) as f64 * PACE) - 1.0).abs() < 1e-9, "{last}");
        }
        assert!(grown[n - 1] > before[n - 1].powi(2));
        assert!(wake.set_pace(f64::NAN).is_err() && wake.set_pace(0.0).is_err());
    }
}

#[test]
fn a_periodic_wake_holds_the_pace_over_its_revolution() {
    let options = WakeOptions { turns: 1.0, ..options() };
    let moving = hub(0.1, -0.03, 0.0, 0.0, 0.0);
    let mut wake = relaxation(&options, moving, 0.0, 0.0);
    wake.set_pace(PACE).unwrap();
    wake_cases::settle(&mut wake, 1e-12, 200);
    let marched = TimeMarchingWake::from_relaxation(&wake, 0, two_fields()).unwrap();
    let off = farthest(marched.position(), &carried(&options, 0, PACE));
    assert!(off < 1e-8, "{off:.1e}");
}
