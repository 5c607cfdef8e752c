//! Symmetries of F: heading, numbering of the blades, and in vacuum any uniform motion change nothing.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use wakeflight::numerics::frames::{Inertial, Vec3, rot_ib};
use wakeflight::system::instant::{HeldInflow, Inputs};
use wakeflight::system::model::System;

fn residual(aircraft: &System, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs) -> Vec<f64> {
    let mut f = vec![0.0; y.len()];
    aircraft.residual(&at(t, y, y_dot, inputs), &mut f);
    f
}

fn aircraft(free_wake: bool) -> System {
    build(&aircraft_data(uh60a(), data_files::airfoil("sc1095", 0.002)), free_wake, 9.80665)
}

const STICK: [f64; 4] = [0.13, 0.14, 0.12, 0.06];

/// A turn of `angle` to the right of quaternion and track.
fn turned(x: &[f64], angle: f64) -> Vec<f64> {
    let mut out = x.to_vec();
    let (s, c) = (0.5 * angle).sin_cos();
    let [w, a, b, d] = [x[6], x[7], x[8], x[9]];
    out[6..10].copy_from_slice(&[c * w - s * d, c * a - s * b, c * b + s * a, c * d + s * w]);
    let (s, c) = angle.sin_cos();
    (out[10], out[11]) = (c * x[10] - s * x[11], s * x[10] + c * x[11]);
    out
}

#[test]
fn heading_changes_nothing() {
    let aircraft = aircraft(false);
    let inputs = inputs(STICK, HeldInflow::Dynamic);
    let (y, y_dot) = random_state(&aircraft, &mut Random::new(13));
    let f = residual(&aircraft, 0.2, &y, &y_dot, &inputs);
    for angle in [0.3, 1.9, -2.8] {
        let found = residual(&aircraft, 0.2, &turned(&y, angle), &turned(&y_dot, angle), &inputs);
        // the kinematic rows turn with the heading, all others stay
        let e = relative_error(&found, &turned(&f, angle));
        println!("heading {angle}: {e:.1e}");
        assert!(e < 1e-15, "{e:e}");
        assert!(relative_error(&found[6..13], &f[6..13]) > 1e-3);
    }
}

/// A quarter of a revolution later every blade stands where the next one stood.
#[test]
fn a_shift_by_the_blade_spacing_renumbers_the_blades() {
    for free_wake in [false, true] {
        let aircraft = aircraft(free_wake);
        let l = aircraft.layout.main();
        let n = aircraft.main().blade.stations.len();
        let mut random = Random::new(14);
        let map: Vec<f64> = (0..4 * n).map(|_| 0.03 + 0.02 * random.next()).collect();
        let renumbered: Vec<f64> = (0..4 * n).map(|k| map[(k + n) % (4 * n)]).collect();
        let held = |inflow: Vec<f64>| HeldInflow::stations(inflow, 0.03);
        let (before, after) = if free_wake {
            (inputs(STICK, held(map)), inputs(STICK, held(renumbered)))
        } else {
            (inputs(STICK, HeldInflow::Dynamic), inputs(STICK, HeldInflow::Dynamic))
        };
        let (y, y_dot) = random_state(&aircraft, &mut random);
        let shift = |x: &[f64]| {
            let mut out = x.to_vec();
            for b in 0..4 {
                let (to, from) = (l.modal(b).start, l.modal((b + 1) % 4).start);
                out[to..to + 2 * l.n_modes].copy_from_slice(&x[from..from + 2 * l.n_modes]);
            }
            out
        };
        let quarter = std::f64::consts::FRAC_PI_2 / OMEGA;
        let f = residual(&aircraft, 0.2, &y, &y_dot, &before);
        let found = residual(&aircraft, 0.2 + quarter, &shift(&y), &shift(&y_dot), &after);
        let e = relative_error(&found, &shift(&f));
        println!("free wake {free_wake}: {e:.1e}");
        assert!(e < 1e-15, "{e:e}");
        assert!(relative_error(&found, &f) > 1e-3);
    }
}

/// Without air the laws of motion are the same in every uniformly moving frame.
#[test]
fn uniform_motion_changes_nothing_in_vacuum() {
    let aircraft = conservative_aircraft(uh60a(), 9.80665);
    let inputs = inputs([0.0, 0.0, 0.3, 0.0], HeldInflow::Vacuum);
    let (y, mut y_dot) = random_state(&aircraft, &mut Random::new(15));
    // attitude must turn as the rates say for the added velocity to keep its inertial direction
    let f = residual(&aircraft, 0.2, &y, &y_dot, &inputs);
    for i in 6..10 {
        y_dot[i] -= f[i];
    }
    let f = residual(&aircraft, 0.2, &y, &y_dot, &inputs);
    let added = rot_ib([y[6], y[7], y[8], y[9]]).transposed() * Vec3::<f64, Inertial>::new(70.0, -30.0, 15.0);
    let turn = Vec3::new(y[3], y[4], y[5]).cross(added);
    let (mut moving, mut moving_dot) = (y.clone(), y_dot.clone());
    for (i, (v, a)) in added.array().into_iter().zip(turn.array()).enumerate() {
        moving[i] += v;
        moving_dot[i] -= a;
    }
    let drift = [70.0, -30.0, 15.0];
    for i in 0..3 {
        moving_dot[10 + i] += drift[i];
    }
    let found = residual(&aircraft, 0.2, &moving, &moving_dot, &inputs);
    let e = relative_error(&found, &f);
    println!("uniform motion: {e:.1e}");
    assert!(e < 1e-15, "{e:e}");
}
