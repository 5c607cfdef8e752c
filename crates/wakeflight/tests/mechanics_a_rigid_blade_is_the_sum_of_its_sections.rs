//! A blade that does not bend as one body: the loads of its points and stations one by one, its derivatives, its rates.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use wakeflight::blade::section::BladeProperties;
use wakeflight::system::instant::{HeldInflow, Inputs};
use wakeflight::system::model::{Setting, System};
use wakeflight::system::rates::RigidRates;

const STICK: [f64; 4] = [0.13, 0.14, 0.12, 0.06];

/// Rigid, with precone, pitch-flap coupling, hinge springs and a centre of gravity off the axis.
fn properties() -> BladeProperties {
    let mut properties = uh60a();
    properties.rigid = true;
    properties.precone = 0.05;
    properties.delta3 = 0.2;
    (properties.flap_spring, properties.lag_spring) = (4e4, 3e4);
    for (i, x) in properties.structure.x_cg.iter_mut().enumerate() {
        *x += 0.02 - 0.05 * (i % 3) as f64 / 3.0;
    }
    properties
}

fn aircraft(free_wake: bool) -> System {
    let data = aircraft_data(properties(), smooth_airfoil(6.0, 0.4, 0.01, -0.02));
    let mut d = discretisation(2, 8);
    d.n_modes = 2;
    System::aircraft(&data, &Setting { discretisation: d, ..setting(free_wake, 9.81) }).unwrap()
}

/// Held, from the states, and none.
fn cases() -> Vec<(System, Inputs)> {
    let held: Vec<f64> = (0..60).map(|i| 0.01 + 0.001 * f64::from(i % 17)).collect();
    let stations = HeldInflow::stations(held, 0.02);
    [(aircraft(true), stations), (aircraft(false), HeldInflow::Dynamic), (aircraft(true), HeldInflow::Vacuum)]
        .into_iter()
        .map(|(aircraft, inflow)| {
            let mut inputs = inputs(STICK, inflow);
            inputs.stick_rate = [0.3, -0.2, 0.1, 0.05];
            (aircraft, inputs)
        })
        .collect()
}

fn residual(aircraft: &System, y: &[f64], y_dot: &[f64], inputs: &Inputs) -> Vec<f64> {
    let mut f = vec![f64::NAN; y.len()];
    aircraft.residual(&at(0.4, y, y_dot, inputs), &mut f);
    f
}

#[test]
fn its_loads_are_those_of_points_and_stations_one_by_one() {
    for (whole, inputs) in cases() {
        let mut parts = whole.clone();
        assert!(parts.rotors[0].blade.rigid.take().is_some());
        for seed in 1..20 {
            let (y, y_dot) = random_state(&whole, &mut Random::new(seed));
            let (found, expected) =
                (residual(&whole, &y, &y_dot, &inputs), residual(&parts, &y, &y_dot, &inputs));
            for (i, (f, e)) in found.iter().zip(&expected).enumerate() {
                assert!((f - e).abs() < 1e-9 * (1.0 + e.abs()), "{seed} {i}: {f} {e}");
            }
            let n = y.len();
            let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n * n]);
            whole.jacobian(&at(0.4, &y, &y_dot, &inputs), 1.0, 30.0, &mut a);
            parts.jacobian(&at(0.4, &y, &y_dot, &inputs), 1.0, 30.0, &mut b);
            let largest = b.iter().fold(0f64, |m, v| m.max(v.abs()));
            assert!(a.iter().zip(&b).all(|(f, e)| (f - e).abs() < 1e-11 * largest), "{seed}");
        }
    }
}

#[test]
fn four_at_once_have_the_same_bits() {
    for (aircraft, inputs) in cases() {
        let (y, y_dot) = random_state(&aircraft, &mut Random::new(5));
        let mut at_once = vec![f64::NAN; y.len()];
        aircraft.residual_of_four(&at(0.4, &y, &y_dot, &inputs), &mut at_once);
        assert_eq!(residual(&aircraft, &y, &y_dot, &inputs), at_once);
    }
}

#[test]
fn its_rate_in_closed_form_satisfies_the_equations() {
    for (aircraft, inputs) in cases() {
        let mut rates = RigidRates::new(&aircraft).unwrap();
        for seed in 1..20 {
            let (y, _) = random_state(&aircraft, &mut Random::new(seed));
            let mut rate = vec![f64::NAN; y.len()];
            rates.find(&aircraft, (0.4, &y), &inputs, &mut rate).unwrap();
            let left = residual(&aircraft, &y, &rate, &inputs);
            assert!(left.iter().all(|v| v.abs() < 1e-9), "{seed}: {left:?}");
            let expected = aircraft.consistent_rate(0.4, &y, &inputs).unwrap();
            for (i, (f, e)) in rate.iter().zip(&expected).enumerate() {
                assert!((f - e).abs() < 1e-9 * (1.0 + e.abs()), "{seed} {i}: {f} {e}");
            }
        }
    }
}

#[test]
fn blades_that_bend_have_no_closed_form() {
    let data = aircraft_data(uh60a(), smooth_airfoil(6.0, 0.0, 0.01, 0.0));
    assert!(RigidRates::new(&build(&data, true, 9.81)).is_none());
}
