//! A rotor whose azimuth and speed are states: against one whose speed is given, and against the closed form of blades that lag
//! on a hub that is free to turn.

mod mechanics_support;

use mechanics_support::beam_support::{uh60a, uniform};
use mechanics_support::*;
use wakeflight::blade::model::Discretisation;
use wakeflight::blade::section::Root;
use wakeflight::integrate::fixed::FixedStep;
use wakeflight::rotor::drive::Drive;
use wakeflight::rotor::swashplate::Rigging;
use wakeflight::system::carrier::Stand;
use wakeflight::system::instant::{EngineInput, HeldInflow, Inputs};
use wakeflight::system::model::{Setting, System};

const RADIUS: f64 = 8.0;
const HINGE: f64 = 0.4;
const INERTIA: f64 = 300.0;

/// Two rigid blades of 1 kg/m without dampers, on a stand without gravity, turned by a given torque.
fn free_hub() -> System {
    let mut properties = uniform(Root::Hinged, HINGE, RADIUS, 1e9, 1e9);
    properties.rigid = true;
    let mut data = aircraft_data(uh60a(), smooth_airfoil(6.0, 0.0, 0.01, 0.0)).rotor;
    (data.blade, data.n_blades, data.lag_damper) = (properties, 2, None);
    let discretisation =
        Discretisation { n_elements: 4, n_modes: 2, n_gauss: 8, n_stations: 5, reference_pitch: 0.0 };
    let setting = Setting { discretisation, ..setting(true, 0.0) };
    let rotor = setting.rotor(&data, &Rigging::direct()).unwrap();
    let system = System::on_stand(Stand { velocity: [0.0; 3], rates: [0.0; 3] }, vec![rotor], &setting);
    system.with_drive(Drive { inertia: INERTIA, hub_inertia: 20.0, governor: None }).unwrap()
}

fn pulled(torque: f64) -> Inputs {
    Inputs {
        stabilator_incidence: 0.0,
        engine: EngineInput { torque, fuel: 1.0 },
        ..inputs([0.0; 4], HeldInflow::Vacuum)
    }
}

/// First flapless: the mode in which both blades lag together turns the hub back, J_t = J + N (m e^2 + 2 e S + I),
/// (I - N (I + e S)^2/J_t) zeta'' + e S W^2 zeta = 0, W' = -N (I + e S) zeta''/J_t.
#[test]
fn blades_that_lag_together_turn_a_free_hub_back() {
    let system = free_hub();
    let (l, place) = (system.layout.main().clone(), system.layout.main().spin().unwrap());
    let length = RADIUS - HINGE;
    let (s, i) = (length * length / 2.0, length.powi(3) / 3.0);
    let coupled = 2.0 * (i + HINGE * s);
    let total = INERTIA + 2.0 * (length * HINGE * HINGE + 2.0 * HINGE * s + i);
    let rotor = system.main();
    let lag = 1 - rotor.blade.flap_mode;
    let mut y = vec![0.0; system.layout.len()];
    (y[place.azimuth], y[place.speed]) = (0.7, OMEGA);
    for b in 0..2 {
        y[l.modal(b).start + lag] = 1e-4 * per_radian(&rotor.blade, lag);
    }
    let y_dot = system.consistent_rate(0.0, &y, &pulled(0.0)).unwrap();
    let ratio = y_dot[l.modal_rate(0).start + lag] / y[l.modal(0).start + lag];
    let expected = -HINGE * s * OMEGA * OMEGA / (i - coupled * coupled / 2.0 / total);
    assert!((ratio / expected - 1.0).abs() < 1e-6, "{ratio} {expected}");
    // far from the mode on a hub that is held
    assert!((expected / (-HINGE * s * OMEGA * OMEGA / i)) > 1.5);
    let (_, lead) = rotor.equivalent_angles(&system.modal_motion(0, &y, &y, 0));
    let turned = -coupled / total * expected * lead;
    assert!((y_dot[place.speed] / turned - 1.0).abs() < 1e-5, "{} {turned}", y_dot[place.speed]);
    assert_eq!(y_dot[place.azimuth], OMEGA);
}

/// A torque on a rotor in vacuum whose blades trail straight: J_t W' = Q; and its work is the energy of all.
#[test]
fn a_torque_spins_the_rotor_up_and_a_clutch_never_slows_it() {
    let system = free_hub();
    let place = system.layout.main().spin().unwrap();
    let n = system.layout.len();
    let mut y = vec![0.0; n];
    y[place.speed] = OMEGA;
    let held = system.consistent_rate(0.0, &y, &pulled(-500.0)).unwrap();
    assert!(held[place.speed].abs() < 1e-9);
    let (mut t, mut solver) = (0.0, FixedStep::new(&system.layout, 0.0, &y, 1e-9, &vec![1e-9; n], 0.1));
    let inputs = pulled(200.0);
    for _ in 0..400 {
        t += 0.01;
        solver.prepare(&system, &inputs).unwrap();
        solver.advance(&system, t, &inputs, 1).unwrap();
    }
    // angular momentum about the shaft, of hub and blades that lag by zeta: the torque's impulse
    let (l, length) = (system.layout.main(), RADIUS - HINGE);
    let (first, second) = (length * length / 2.0, length.powi(3) / 3.0);
    let lag = 1 - system.main().blade.flap_mode;
    let scale = per_radian(&system.main().blade, lag);
    let momentum = |y: &[f64]| {
        let blade = |b: usize| {
            let (zeta, rate) = (y[l.modal(b).start + lag] / scale, y[l.modal_rate(b).start + lag] / scale);
            let omega = y[place.speed];
            length * HINGE * HINGE * omega
                + first * HINGE * (2.0 * omega + rate) * zeta.cos()
                + second * (omega + rate)
        };
        INERTIA * y[place.speed] + blade(0) + blade(1)
    };
    let gained = momentum(solver.state()) - momentum(&y);
    assert!((gained / (200.0 * t) - 1.0).abs() < 1e-4, "{gained} {}", 200.0 * t);
    assert!(solver.state()[place.azimuth] > OMEGA * t + 1.0);
}

/// Azimuth and speed given by the clock or read from y: the same blades, airframe and inflow.
#[test]
fn a_state_of_speed_means_what_a_history_of_speed_means() {
    let data = aircraft_data(uh60a(), smooth_airfoil(6.0, 0.3, 0.01, -0.02));
    let (share, t, seconds) = (0.9, 0.2, 0.4);
    let given = changing_speed(build(&data, false, 9.80665), share, seconds);
    let free = driven(build(&data, false, 9.80665), true);
    let moving =
        Inputs { stick_rate: [0.2, -0.1, 0.15, 0.05], ..inputs([0.1, 0.12, 0.2, 0.05], HeldInflow::Dynamic) };
    let (y, y_dot) = random_state(&given, &mut Random::new(4));
    let turn = free.layout.main().turn();
    let lifted = |v: &[f64], values: [f64; 4]| [&v[..turn.start], &values, &v[turn.start..]].concat();
    let rotor = given.main();
    let turning = rotor.turning(t, 0.0);
    let z = lifted(&y, [rotor.turned(t), turning.omega, 0.0, 1e6]);
    let z_dot = lifted(&y_dot, [turning.omega, turning.omega_dot, 0.0, 0.0]);
    let (mut f, mut g) = (vec![0.0; y.len()], vec![0.0; z.len()]);
    given.residual(&at(t, &y, &y_dot, &moving), &mut f);
    free.residual(&at(t, &z, &z_dot, &moving), &mut g);
    // but for what the hub itself does to the airframe as it slows down
    let reaction = -57.0 * turning.omega_dot / given.carrier.airframe().unwrap().reference_inertia[2];
    let yaw = g[5] - f[5];
    let shaft = given.main().rot_hb::<f64>().transposed();
    assert!((yaw / reaction / shaft_z(&shaft) - 1.0).abs() < 1e-6, "{yaw} {reaction}");
    for (i, row) in f.iter().enumerate().filter(|(i, _)| !(3..6).contains(i)) {
        let same = g[if i < turn.start { i } else { i + 4 }];
        assert!((row - same).abs() <= 1e-12 * row.abs().max(1.0), "row {i}: {row} {same}");
    }
}

/// Component along body z of the shaft.
fn shaft_z(
    to_body: &wakeflight::numerics::frames::Rotation<
        f64,
        wakeflight::numerics::frames::Body,
        wakeflight::numerics::frames::Hub,
    >,
) -> f64 {
    (*to_body * wakeflight::numerics::frames::Vec3::new(0.0, 0.0, 1.0)).z
}
