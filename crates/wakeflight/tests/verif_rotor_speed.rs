//! Rigid blades in vacuum on a rotor whose speed changes, against the equations of a turning pendulum.
//!
//! A blade with inertia I and first moment S about coincident hinges at e, speed W(t): in the plane of rotation
//! zeta'' = -W' (1 + (e S/I) cos zeta) - (e S/I) W^2 sin zeta, lead zeta; out of it beta'' = -W^2 (1 + e S/I) beta for small flap.

mod mechanics_support;

use mechanics_support::beam_support::{uh60a, uniform};
use mechanics_support::*;
use wakeflight::blade::model::Discretisation;
use wakeflight::blade::section::Root;
use wakeflight::integrate::explicit::ExplicitStep;
use wakeflight::integrate::fixed::FixedStep;
use wakeflight::rotor::speed::{RotorSpeed, SpeedHistory};
use wakeflight::rotor::swashplate::Rigging;
use wakeflight::system::carrier::Stand;
use wakeflight::system::instant::{HeldInflow, Inputs};
use wakeflight::system::model::{Setting, System};

const RADIUS: f64 = 8.0;
const HINGE: f64 = 0.4;
/// e S/I of a blade of 1 kg/m.
const STIFFENING: f64 = 1.5 * HINGE / (RADIUS - HINGE);
const CORNERS: [(f64, f64); 3] = [(0.05, OMEGA), (0.45, 0.8 * OMEGA), (0.55, 1.02 * OMEGA)];

/// Two rigid blades on a stand without gravity.
fn stand(history: &[(f64, f64)]) -> System {
    let mut properties = uniform(Root::Hinged, HINGE, RADIUS, 1e9, 1e9);
    properties.rigid = true;
    let mut data = aircraft_data(uh60a(), smooth_airfoil(6.0, 0.0, 0.01, 0.0)).rotor;
    (data.blade, data.n_blades, data.lag_damper) = (properties, 2, None);
    let discretisation =
        Discretisation { n_elements: 4, n_modes: 2, n_gauss: 8, n_stations: 5, reference_pitch: 0.0 };
    let setting = Setting { discretisation, ..setting(true, 0.0) };
    let mut rotor = setting.rotor(&data, &Rigging::direct()).unwrap();
    rotor.speed = RotorSpeed::Prescribed(SpeedHistory::new(history).unwrap());
    System::on_stand(Stand { velocity: [0.0; 3], rates: [0.0; 3] }, vec![rotor], &setting)
}

/// Ends of the steps of azimuth to 0.8 s, and of the pieces between corners of the history.
fn stops(system: &System, n: usize) -> Vec<f64> {
    let step = std::f64::consts::TAU / n as f64;
    let mut all: Vec<f64> =
        (1..).map(|k| system.main().time(k as f64 * step)).take_while(|t| *t < 0.8).collect();
    all.extend(CORNERS.map(|(t, _)| t));
    all.sort_by(f64::total_cmp);
    all
}

fn at_start(t: f64) -> Inputs {
    Inputs { t_start: t, stabilator_incidence: 0.0, ..inputs([0.0; 4], HeldInflow::Vacuum) }
}

/// Lead of a blade [rad] at the stops, by the classical method of order four with many steps.
fn pendulum(stops: &[f64]) -> Vec<f64> {
    let speed = |t: f64| {
        let piece = CORNERS.windows(2).find(|w| (w[0].0..w[1].0).contains(&t));
        piece.map_or(if t < CORNERS[0].0 { (CORNERS[0].1, 0.0) } else { (CORNERS[2].1, 0.0) }, |w| {
            let slope = (w[1].1 - w[0].1) / (w[1].0 - w[0].0);
            (w[0].1 + slope * (t - w[0].0), slope)
        })
    };
    let (mut t, mut x) = (0.0, [0.0, 0.0]);
    let mut found = Vec::new();
    for &end in stops {
        let (n, begin) = (200, t);
        let h = (end - begin) / f64::from(n);
        // the rate of the speed is that of the piece, at its ends too
        let slope = speed(0.5 * (begin + end)).1;
        let rate = |t: f64, x: [f64; 2]| {
            let w = speed(t).0;
            [x[1], -slope * (1.0 + STIFFENING * x[0].cos()) - STIFFENING * w * w * x[0].sin()]
        };
        let moved = |x: [f64; 2], k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
        for i in 0..n {
            t = begin + f64::from(i) * h;
            let k1 = rate(t, x);
            let k2 = rate(t + 0.5 * h, moved(x, k1, 0.5 * h));
            let k3 = rate(t + 0.5 * h, moved(x, k2, 0.5 * h));
            let k4 = rate(t + h, moved(x, k3, h));
            x = std::array::from_fn(|c| x[c] + h / 6.0 * (k1[c] + 2.0 * (k2[c] + k3[c]) + k4[c]));
        }
        t = end;
        found.push(x[0]);
    }
    found
}

/// Flap and lead of the first blade [rad].
fn angles(system: &System, y: &[f64]) -> (f64, f64) {
    system.main().equivalent_angles(&system.modal_motion(0, y, y, 0))
}

#[test]
fn lag_answers_the_rate_of_the_speed_as_a_pendulum_does() {
    let system = stand(&CORNERS);
    let n = system.layout.len();
    let (y, atol) = (vec![0.0; n], vec![1e-9; n]);
    let stops = stops(&system, 72);
    let expected = pendulum(&stops);
    let largest = expected.iter().fold(0f64, |m, v| m.max(v.abs()));
    assert!(largest > 0.1, "{largest}");

    let mut implicit = FixedStep::new(&system.layout, 0.0, &y, 1e-9, &atol, 0.1);
    let mut explicit = ExplicitStep::new(&system, 0.0, &y, 1e-9, &atol).unwrap();
    let mut t = 0.0;
    let mut worst = [0f64; 2];
    for (&end, &lead) in stops.iter().zip(&expected) {
        let inputs = at_start(t);
        implicit.prepare(&system, &inputs).unwrap();
        implicit.advance(&system, end, &inputs, 1).unwrap();
        explicit.prepare(&system, &inputs).unwrap();
        explicit.advance(&system, end, &inputs, 1).unwrap();
        for (worst, state) in worst.iter_mut().zip([implicit.state(), explicit.state()]) {
            let (flap, found) = angles(&system, state);
            assert!(flap.abs() < 1e-12);
            *worst = worst.max((found - lead).abs());
        }
        t = end;
    }
    println!("lead to {largest:.3} rad, errors {:.1e} {:.1e}", worst[0], worst[1]);
    assert!(worst.iter().all(|e| *e < 1e-6), "{worst:?}");
}

#[test]
fn the_flap_frequency_follows_the_speed() {
    for share in [0.7, 1.0, 1.1] {
        let system = stand(&[(0.0, share * OMEGA)]);
        let l = system.layout.main();
        let (flap, m) = (system.main().blade.flap_mode, l.n_modes);
        let mut y = vec![0.0; system.layout.len()];
        y[l.modal(0).start + flap] = 1e-3 * per_radian(&system.main().blade, flap);
        let y_dot = system.consistent_rate(0.3, &y, &at_start(0.3)).unwrap();
        let squared = -y_dot[l.modal(0).start + m + flap] / y[l.modal(0).start + flap];
        let expected = (share * OMEGA).powi(2) * (1.0 + STIFFENING);
        assert!((squared / expected - 1.0).abs() < 1e-5, "{share}: {squared} {expected}");
    }
}

/// A steady speed other than the nominal one is the rotor whose nominal speed that is: air, pitch, loads, dynamic inflow.
#[test]
fn a_rotor_off_its_nominal_speed_is_one_of_that_speed() {
    let share = 0.9;
    let data = aircraft_data(uh60a(), smooth_airfoil(6.0, 0.3, 0.01, -0.02));
    let off = changing_speed(on_stand(&data, false), share, 1e-9);
    let mut other = on_stand(&data, false);
    // the modes of the blade stay those of the nominal speed
    other.rotors[0].omega *= share;
    let mut random = Random::new(3);
    let (mut y, mut y_dot) = random_state(&off, &mut random);
    let moving =
        Inputs { stick_rate: [0.2, -0.1, 0.15, 0.05], ..inputs([0.1, 0.12, 0.2, 0.05], HeldInflow::Dynamic) };
    let inflow = off.layout.main().inflow();
    for i in inflow.clone() {
        (y[i], y_dot[i]) = (0.04, 0.0);
    }
    // the same azimuth
    let t = 0.4;
    let same = off.azimuth(0, t, 0) / other.rotors[0].omega;
    let later = |inputs: &Inputs, t: f64| Inputs { t_start: t, ..inputs.clone() };
    let (mut f, mut g) = (vec![0.0; y.len()], vec![0.0; y.len()]);
    off.residual(&at(t, &y, &y_dot, &later(&moving, t)), &mut f);
    for i in inflow.clone() {
        // inflow over its own tip speed
        y[i] /= share;
    }
    other.residual(&at(same, &y, &y_dot, &later(&moving, same)), &mut g);
    for i in inflow {
        g[i] *= share;
    }
    let e = relative_error(&f, &g);
    assert!(e < 1e-9, "{e:.1e}");
}
