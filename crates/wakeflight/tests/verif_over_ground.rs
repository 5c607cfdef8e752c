//! A rotor constant in speed over the ground: what yaws is the airframe alone, and the speed about it is what the yaw leaves.

mod mechanics_support;

use mechanics_support::beam_support::uniform;
use mechanics_support::*;
use nalgebra::{DMatrix, DVector};
use wakeflight::blade::model::Discretisation;
use wakeflight::blade::section::Root;
use wakeflight::integrate::fixed::FixedStep;
use wakeflight::numerics::frames::Vec3;
use wakeflight::rotor::sense::Sense;
use wakeflight::system::instant::HeldInflow;
use wakeflight::system::layout::Layout;
use wakeflight::system::model::{Setting, System};

const RADIUS: f64 = 8.0;
const HINGE: f64 = 0.4;
const BLADES: usize = 4;
const IZZ: f64 = 49888.677;

/// An airframe below four rigid blades of 1 kg/m with `n_modes` hinges, no air, no gravity; the hub above the origin.
fn aircraft(n_modes: usize, sense: Sense, tilt: [f64; 2]) -> System {
    let mut properties = uniform(Root::Hinged, HINGE, RADIUS, 1e9, 1e9);
    properties.rigid = true;
    let mut data = aircraft_data(properties, smooth_airfoil(6.0, 0.0, 0.01, 0.0));
    (data.rotor.n_blades, data.rotor.lag_damper, data.rotor.rotation) = (BLADES, None, sense);
    (data.rotor.position, data.rotor.shaft_tilt_forward, data.rotor.shaft_tilt_lateral) =
        ([0.0, 0.0, -2.3], tilt[0], tilt[1]);
    data.rigging = collective_rigging();
    data.mass.inertia[3] = 0.0;
    (data.tail_rotor, data.accessory_power) = (None, 0.0);
    let discretisation =
        Discretisation { n_elements: 4, n_modes, n_gauss: 8, n_stations: 5, reference_pitch: 0.0 };
    System::aircraft(&data, &Setting { discretisation, ..setting(true, 0.0) }).unwrap()
}

/// Rates of the state that a yaw moment of 1 N m on the airframe adds.
fn by_yaw_moment(system: &System, y: &[f64]) -> Vec<f64> {
    let n = y.len();
    let inputs = inputs([0.0; 4], HeldInflow::Vacuum);
    let mut mass = vec![0.0; n * n];
    system.jacobian(&at(0.0, y, &vec![0.0; n], &inputs), 0.0, 1.0, &mut mass);
    let mut acts = DVector::zeros(n);
    acts[5] = -1.0 / system.carrier.airframe().unwrap().reference_inertia[2];
    DMatrix::from_row_slice(n, n, &mass).lu().solve(&acts).unwrap().as_slice().to_vec()
}

/// Blades that nothing moves: about the airframe they turn with it, over the ground they do not.
#[test]
fn a_yaw_moment_turns_the_airframe_alone() {
    let blades = BLADES as f64 * (RADIUS.powi(3) - HINGE.powi(3)) / 3.0;
    for (sense, hand) in [(Sense::CounterClockwise, 1.0), (Sense::Clockwise, -1.0)] {
        let given = aircraft(0, sense, [0.0; 2]);
        let free = given.clone().over_ground();
        let place = free.layout.main().spin().unwrap();
        let mut y = vec![0.0; given.layout.len()];
        (y[5], y[6]) = (0.4, 1.0);
        let mut z = vec![0.0; free.layout.len()];
        (z[5], z[6], z[place.azimuth], z[place.speed]) = (0.4, 1.0, 0.7, OMEGA);
        let [held, over_ground] = [by_yaw_moment(&given, &y), by_yaw_moment(&free, &z)];
        assert!((held[5] * (IZZ + blades) - 1.0).abs() < 1e-9, "{}", 1.0 / held[5]);
        assert!((over_ground[5] * IZZ - 1.0).abs() < 1e-12, "{}", 1.0 / over_ground[5]);
        // nose right is against a counter-clockwise rotor: about the airframe it turns faster
        assert!((over_ground[place.speed] - hand * over_ground[5]).abs() < 1e-18);
    }
}

/// What the spin over the ground keeps, a flight of 4 s with a tilted shaft in every attitude and blades that flap and lag.
#[test]
fn the_speed_about_the_airframe_is_what_its_rate_about_the_shaft_leaves() {
    for sense in [Sense::CounterClockwise, Sense::Clockwise] {
        let system = aircraft(2, sense, [0.1, 0.07]).over_ground();
        let (l, place, n) = (system.layout.main(), system.layout.main().spin().unwrap(), system.layout.len());
        let mut y = vec![0.0; n];
        (y[3], y[4], y[5], y[6], y[place.speed]) = (0.5, -0.3, 0.8, 1.0, OMEGA);
        y[l.modal(1).start] = 0.02 * per_radian(&system.main().blade, 0);
        let about_shaft = |y: &[f64]| system.hub_motion(0, y, &vec![0.0; n]).omega.z;
        // by hand: the shaft in body axes
        let shaft = system.main().rot_hb::<f64>().transposed() * Vec3::new(0.0, 0.0, 1.0);
        let hand = sense.hand();
        let expected = hand * shaft.dot(wakeflight::system::layout::body_vector(&y, Layout::RATES));
        assert!((about_shaft(&y) - expected).abs() < 1e-15);
        let spin = y[place.speed] + about_shaft(&y);
        let inputs = inputs([0.0; 4], HeldInflow::Vacuum);
        let (mut t, mut solver) = (0.0, FixedStep::new(&system.layout, 0.0, &y, 1e-9, &vec![1e-9; n], 0.1));
        let mut most = 0f64;
        for _ in 0..400 {
            t += 0.01;
            solver.prepare(&system, &inputs).unwrap();
            solver.advance(&system, t, &inputs, 1).unwrap();
            let y = solver.state();
            most = most.max((y[place.speed] - OMEGA).abs());
            let kept = y[place.speed] + about_shaft(y);
            assert!((kept / spin - 1.0).abs() < 1e-9, "{t}: {kept} {spin}");
        }
        // the airframe tumbles: it was not for nothing
        assert!(most > 0.1, "{most}");
        // what keeps the speed is the moment that the airframe feels about the shaft
        let y = solver.state().to_vec();
        let rate = system.consistent_rate(t, &y, &inputs).unwrap();
        let rotor = system.outputs(&at(t, &y, &rate, &inputs)).rotors.swap_remove(0);
        assert!((rotor.engine_torque.unwrap() + hand * rotor.hub_moment[2]).abs() < 1e-9);
    }
}
