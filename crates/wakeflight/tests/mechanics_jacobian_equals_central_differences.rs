//! The exact Jacobian equals central differences of the residual, and F is linear in y_dot.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use wakeflight::airfoil::span::SpanSections;
use wakeflight::airfoil::unsteady::Model;
use wakeflight::blade::hinge::HingeStops;
use wakeflight::rotor::sense::Sense;
use wakeflight::system::instant::{Disturbance, EngineInput, Gust, HeldInflow, Inputs};
use wakeflight::system::model::System;

const STICK: [f64; 4] = [0.13, 0.14, 0.12, 0.06];

fn residual(aircraft: &System, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs) -> Vec<f64> {
    let mut f = vec![0.0; y.len()];
    aircraft.residual(&at(t, y, y_dot, inputs), &mut f);
    f
}

/// Central differences by steps h and h/2, extrapolated.
fn difference(value: impl Fn(f64) -> Vec<f64>, h: f64) -> Vec<f64> {
    let slope =
        |h: f64| -> Vec<f64> { value(h).iter().zip(value(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect() };
    slope(h / 2.0).iter().zip(slope(h)).map(|(fine, coarse)| (4.0 * fine - coarse) / 3.0).collect()
}

/// Largest error of dF/dy and dF/dy_dot, every column over its largest entry.
fn errors(aircraft: &System, inputs: &Inputs, seed: u64) -> [f64; 2] {
    let (t, n) = (0.123, aircraft.layout.len());
    let (y, y_dot) = random_state(aircraft, &mut Random::new(seed));
    let mut worst = [0f64; 2];
    for (which, (a, b)) in [(1.0, 0.0), (0.0, 1.0)].into_iter().enumerate() {
        let mut exact = vec![f64::NAN; n * n];
        aircraft.jacobian(&at(t, &y, &y_dot, inputs), a, b, &mut exact);
        for column in 0..n {
            let at = |h: f64| {
                let (mut y, mut y_dot) = (y.clone(), y_dot.clone());
                y[column] += a * h;
                y_dot[column] += b * h;
                residual(aircraft, t, &y, &y_dot, inputs)
            };
            let size = if which == 0 { y[column].abs() } else { y_dot[column].abs() };
            let h = if which == 0 { 1e-4 } else { 1e-2 } * size.max(0.1);
            let expected = difference(at, h);
            let found: Vec<f64> = (0..n).map(|row| exact[row * n + column]).collect();
            let silent = expected.iter().chain(&found).all(|v| v.abs() < 1e-7);
            // position enters no equation, nor does the tail rotor's inflow without air
            let idle = aircraft.layout.free && (10..13).contains(&column)
                || inputs.vacuum() && aircraft.layout.closed_inflow().contains(&column);
            assert_eq!(silent, which == 0 && idle, "column {column}");
            if !silent {
                let e = relative_error(&found, &expected);
                assert!(e < 1e-6, "d/d{} {column}: {e:.2e}", ["y", "y_dot"][which]);
                worst[which] = worst[which].max(e);
            }
        }
    }
    worst
}

fn cases(smooth: bool) -> Vec<(System, Inputs, &'static str)> {
    let airfoil =
        if smooth { smooth_airfoil(5.7, 0.4, 0.01, -0.02) } else { data_files::airfoil("sc1095", 0.002) };
    let data = aircraft_data(uh60a(), airfoil);
    let mut general = data.clone();
    let mut tip = smooth_airfoil(6.3, 0.1, 0.02, 0.03);
    if !smooth {
        tip = data_files::airfoil("naca0012", 0.001);
    }
    let inner =
        if smooth { smooth_airfoil(5.7, 0.4, 0.01, -0.02) } else { data_files::airfoil("sc1095", 0.002) };
    general.rotor.airfoil = SpanSections::new(vec![2.0, 6.5], false, vec![inner, tip]).unwrap();
    (general.rotor.blade.flap_spring, general.rotor.blade.lag_spring) = (6e4, 9e4);
    // blades lie on them in the states of the tests
    let stops = HingeStops { low: Some(-1e-4), high: Some(1e-4), stiffness: 5e5 };
    (general.rotor.blade.flap_stops, general.rotor.blade.lag_stops) = (Some(stops), Some(stops));
    let general = build(&general, true, 9.80665);
    let (dynamic, held) = (build(&data, false, 9.80665), build(&data, true, 9.80665));
    let mut clockwise = data.clone();
    (clockwise.rotor.rotation, clockwise.rotor.shaft_tilt_lateral) = (Sense::Clockwise, 0.05);
    let mut random = Random::new(8);
    let n = held.main().n_blades * held.main().blade.stations.len();
    let inflow: Vec<f64> = (0..n).map(|_| 0.03 + 0.02 * random.next()).collect();
    let mut moving = inputs(STICK, HeldInflow::Dynamic);
    moving.stick_rate = [0.2, -0.1, 0.15, 0.05];
    let failing = Inputs { engine: EngineInput { torque: 0.0, fuel: 0.3 }, ..moving.clone() };
    let pulled = Inputs { engine: EngineInput { torque: 4e4, fuel: 1.0 }, ..moving.clone() };
    let gust = Gust { at_hub: [0.5, -0.3, 1.2], turn: [0.02, -0.05, 0.01], stations: inflow.clone() };
    let windy = Disturbance { wind: [6.0, -4.0, 1.5], gust: Some(gust), speed: vec![[0.0; 2]] };
    let windy = Inputs { disturbance: Some(windy), ..moving.clone() };
    let mut both = moving.clone();
    both.inflow.push(HeldInflow::Dynamic);
    // sections that remember, 17 ms after a step began in another state
    let mut remembers = |system: &System, model: Model, inputs: &Inputs| {
        let system = in_time(system.clone(), model);
        let inputs = remembering(&system, inputs, 0.106, &mut random);
        (system, inputs)
    };
    let stations = inputs(STICK, HeldInflow::stations(inflow.clone(), 0.03));
    let (attached, attached_inputs) = remembers(&dynamic, Model::Attached, &moving);
    let (oye, oye_inputs) = remembers(&held, Model::Oye, &stations);
    let (hgm, hgm_inputs) = remembers(&general, Model::Hgm, &stations);
    let (turning, turning_inputs) =
        remembers(&changing_speed(on_stand(&data, false), 0.8, 0.3), Model::Hgm, &moving);
    vec![
        (attached, attached_inputs, "attached flow in time, dynamic inflow"),
        (oye, oye_inputs, "separation in time, held station inflow"),
        (hgm, hgm_inputs, "stall in time, two sections along the span"),
        (turning, turning_inputs, "stall in time, a stand, rotor speed falling"),
        (build(&tandem(&data), false, 9.80665), both, "two rotors, the second clockwise"),
        (on_stand(&data, false), moving.clone(), "a stand, dynamic inflow"),
        (changing_speed(dynamic.clone(), 0.8, 0.3), moving.clone(), "rotor speed falling"),
        (dynamic.clone().above_ground(9.0), moving.clone(), "above ground"),
        (dynamic.clone(), windy.clone(), "a gust"),
        (
            driven(dynamic.clone(), true),
            Inputs { engine: failing.engine, ..windy },
            "a gust, rotor speed governed",
        ),
        (driven(dynamic.clone(), true), failing, "rotor speed governed, less fuel"),
        (driven(on_stand(&data, false), false), pulled, "rotor speed free on a stand"),
        (dynamic.clone().over_ground(), moving.clone(), "rotor speed constant over the ground"),
        (build(&clockwise, false, 9.80665).over_ground(), moving.clone(), "the same of a clockwise rotor"),
        (held.clone().over_ground(), inputs(STICK, HeldInflow::Vacuum), "the same in vacuum"),
        (dynamic, moving, "dynamic inflow, sticks moving"),
        (held.clone(), inputs(STICK, HeldInflow::stations(inflow.clone(), 0.03)), "held station inflow"),
        (
            general,
            inputs(STICK, HeldInflow::stations(inflow, 0.03)),
            "hinge springs and stops, two sections along the span",
        ),
        (held, inputs(STICK, HeldInflow::Vacuum), "vacuum"),
    ]
}

/// Section tables without kinks; the tables of fuselage, tail and damper are kinked, the states lie between kinks.
#[test]
fn jacobian_equals_central_differences() {
    for (aircraft, inputs, name) in cases(true) {
        for seed in [5, 6] {
            let e = errors(&aircraft, &inputs, seed);
            println!("{name}: dF/dy {:.1e}, dF/dy_dot {:.1e}", e[0], e[1]);
        }
    }
}

#[test]
fn residual_is_linear_in_the_rates_of_the_state() {
    for smooth in [true, false] {
        for (aircraft, inputs, name) in cases(smooth) {
            let (y, a) = random_state(&aircraft, &mut Random::new(9));
            let (_, b) = random_state(&aircraft, &mut Random::new(10));
            let f = |y_dot: &[f64]| residual(&aircraft, 0.4, &y, y_dot, &inputs);
            let mixed: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 3.0 * a - 2.0 * b).collect();
            let expected: Vec<f64> = f(&a).iter().zip(f(&b)).map(|(a, b)| 3.0 * a - 2.0 * b).collect();
            let mut found = f(&mixed);
            // dynamic inflow is driven by the loads of the air, which feel no acceleration: linear as well
            let e = relative_error(&found, &expected);
            println!("{name}: {e:.1e}");
            assert!(e < 1e-12, "{name}: {e:e}");
            found[0] += 1.0;
            assert!(relative_error(&found, &expected) > 1e-12);
        }
    }
}

/// Lanes of a vector register change no bit of any blade.
#[test]
fn the_residual_of_four_blades_at_once_has_the_same_bits() {
    for (aircraft, inputs, name) in cases(false) {
        let (y, y_dot) = random_state(&aircraft, &mut Random::new(11));
        let one_by_one = residual(&aircraft, 0.4, &y, &y_dot, &inputs);
        let mut at_once = vec![f64::NAN; y.len()];
        aircraft.residual_of_four(&at(0.4, &y, &y_dot, &inputs), &mut at_once);
        assert_eq!(one_by_one, at_once, "{name}");
    }
}

#[test]
fn derivatives_by_what_acts_equal_central_differences() {
    for (aircraft, inputs, name) in cases(true) {
        if inputs.vacuum() {
            continue;
        }
        let (t, (y, y_dot)) = (0.123, random_state(&aircraft, &mut Random::new(12)));
        let slopes = aircraft.input_slopes(&at(t, &y, &y_dot, &inputs)).unwrap();
        let columns = slopes.names.len();
        let driven = aircraft.layout.main().speed.has_engines();
        let stations = inputs.inflow.iter().any(|held| matches!(held, HeldInflow::Stations { .. }));
        let disturbed = slopes.names.iter().position(|(name, _)| name.starts_with("wind_")).unwrap();
        assert!(driven || aircraft.layout.main().spin().is_none() || columns == disturbed + 3);
        assert_eq!(disturbed > 9, stations);
        for (column, (input, _)) in slopes.names.iter().enumerate() {
            let moved = |h: f64| {
                let mut inputs = inputs.clone();
                match column {
                    0..4 => inputs.stick[column] += h,
                    4..8 => inputs.stick_rate[column - 4] += h,
                    8 => inputs.stabilator_incidence += h,
                    _ if column >= disturbed => {
                        let speed = vec![[0.0; 2]; aircraft.rotors.len()];
                        let still = Disturbance { wind: [0.0; 3], gust: None, speed };
                        let mut more = inputs.disturbance.take().unwrap_or(still);
                        match column - disturbed {
                            k @ 0..3 => more.wind[k] += h,
                            3 if driven => inputs.engine.torque += 1e6 * h,
                            4 if driven => inputs.engine.fuel += h,
                            k => more.speed.as_flattened_mut()[k - 3] = h,
                        }
                        inputs.disturbance = Some(more);
                    }
                    _ => {
                        let HeldInflow::Stations { inflow, mean, .. } = &mut inputs.inflow[0] else {
                            panic!()
                        };
                        *inflow.get_mut(column - 9).unwrap_or(mean) += h;
                    }
                }
                residual(&aircraft, t, &y, &y_dot, &inputs)
            };
            let expected = difference(moved, 1e-4);
            let size = if input == "engine_torque" { 1e6 } else { 1.0 };
            let found: Vec<f64> =
                (0..y.len()).map(|row| size * slopes.values[row * columns + column]).collect();
            if expected.iter().chain(&found).all(|v| v.abs() < 1e-7) {
                // a governor has its own torque, a given torque no fuel
                let unused = if aircraft.layout.main().engine().is_some() { "torque" } else { "fuel" };
                assert!(column < disturbed || input.ends_with(unused), "{name}: nothing feels {input}");
                continue;
            }
            let e = relative_error(&found, &expected);
            assert!(e < 1e-6, "{name}, {input}: {e:.2e}");
        }
    }
}
