//! The exchange with a periodic motion held: it adds nothing to a marching wake that stands alone, to the bit, and the thrust of
//! the blades carries the sheet.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use wakeflight::blade::hub_motion as blade;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::memory_rows::MemoryRows;
use wakeflight::inflow::momentum::momentum_inflow;
use wakeflight::rotor::circulation::{BladeInstant, Course};
use wakeflight::rotor::exchange::{MarchingExchange, Place, SteadyWake, azimuth, row};
use wakeflight::rotor::speed::Turning;
use wakeflight::system::model::System;
use wakeflight::wake::{
    BladeState, HubMotion, MarchingOptions, RelaxationOptions, TimeMarchingWake, WakeOptions, WakeRotor,
};

/// Options of the wake of the rotor of `system`.
fn options(system: &System) -> WakeOptions {
    let rotor = system.main();
    let first = &rotor.blade.stations[0];
    let known = WakeRotor {
        n_blades: rotor.n_blades,
        radius: rotor.blade.radius,
        root_cutout: first.shapes.x - 0.5 * first.geometry.width,
        hinge_offset: rotor.hinge(),
        chord: 0.53,
        omega: rotor.omega,
    };
    WakeOptions { rotor: known, n_stations: rotor.blade.stations.len(), turns: 2.0, ..WakeOptions::default() }
}

/// A blade at every azimuth of a motion with a first harmonic in every mode.
fn periodic(system: &System, n: usize) -> Vec<BladeInstant> {
    let rotor = system.main();
    let modes = 0..rotor.blade.n_modes;
    let amplitude: Vec<f64> =
        modes.map(|i| 0.03 * per_radian(&rotor.blade, i) / (1 + i * i) as f64).collect();
    let motion = |k: usize| {
        let (s, c) = azimuth(k, n).sin_cos();
        let q: Vec<f64> = amplitude.iter().map(|a| a * c).collect();
        let q_dot: Vec<f64> = amplitude.iter().map(|a| -a * s * rotor.omega).collect();
        ModalMotion::of(&q, &q_dot)
    };
    system.periodic_blades(&(0..n).map(motion).collect::<Vec<_>>(), [0.13, 0.14, 0.12, 0.06])
}

/// The rotor on a stand in forward flight, and its relaxed wake for a periodic motion.
struct Relaxed {
    system: System,
    options: WakeOptions,
    blades: Vec<BladeInstant>,
    hub: blade::HubMotion<f64>,
    steady: SteadyWake,
}

impl Relaxed {
    fn new() -> Self {
        let data = aircraft_data(uh60a(), data_files::airfoil("sc1095", 0.002));
        let system = on_stand(&data, true);
        let options = options(&system);
        let n = options.steps_per_revolution();
        let (blades, hub) = (periodic(&system, n), system.steady_hub(&vec![0.0; system.layout.len()]));
        let map = vec![0.03; n * options.n_stations];
        let mut steady = SteadyWake::new(options, RelaxationOptions::default(), false, system.main(), map);
        let turning = Turning::steady(system.main().omega);
        let place = Place {
            rotor: system.main(),
            air: system.air,
            hub: &hub,
            turning,
            gust: &[],
            ground: None,
            airframe: None,
        };
        steady.converge(&place, &blades, 5).unwrap();
        Self { system, options, blades, hub, steady }
    }
}

#[test]
fn the_sheet_is_carried_by_the_thrust_of_the_blades() {
    // the loads of the same blades in the same inflow, by momentum theory; twice the circulation, twice the inflow
    let Relaxed { system, blades, hub, steady, .. } = Relaxed::new();
    let (rotor, width) = (system.main(), steady.width());
    let rows = blades.iter().zip(steady.inflow.chunks_exact(width));
    let passages = rows.map(|(blade, row)| (*blade, rotor.held_inflow(row)));
    let [_, _, aero_force, _] = rotor.passages(system.air, &hub, passages).loads;
    let lift: f64 = aero_force.chunks_exact(3).map(|f| f[2]).sum::<f64>() / blades.len() as f64;
    let disk = std::f64::consts::PI * rotor.blade.radius.powi(2);
    let ct = rotor.n_blades as f64 * lift / (system.air.density * disk * rotor.tip_speed().powi(2));
    let velocity = hub.velocity.array();
    let mu = velocity[0].hypot(velocity[1]) / rotor.tip_speed();
    let carrying = |share: f64| {
        let circulation: Vec<f64> = steady.circulation.iter().map(|gamma| share * gamma).collect();
        rotor.lifting_disk().carrying_inflow(&circulation, velocity)
    };
    let (once, twice) = (carrying(1.0), carrying(2.0));
    assert!(ct > 0.003, "{ct}");
    assert!(
        (once - momentum_inflow(ct, mu * mu, -velocity[2] / rotor.tip_speed())).abs() < 0.03 * once,
        "{ct} {once}"
    );
    assert!((twice - 2.0 * once).abs() < 0.05 * twice, "{once} {twice}");
}

#[test]
fn the_exchange_adds_nothing_to_the_wake_that_stands_alone() {
    let Relaxed { system, options, blades, hub, steady } = Relaxed::new();
    let (rotor, n) = (system.main(), options.steps_per_revolution());
    let place = Place {
        rotor,
        air: system.air,
        hub: &hub,
        turning: Turning::steady(rotor.omega),
        gust: &[],
        ground: None,
        airframe: None,
    };
    let start = steady.wake.as_ref().unwrap();
    // the far inflow of the step before, as it is
    let own = MarchingOptions { extrapolate: false, ..MarchingOptions::default() };
    let marching = || TimeMarchingWake::from_relaxation(start, 0, own).unwrap();
    let (mut exchange, mut alone) = (MarchingExchange::new(marching(), &steady, rotor), marching());

    let wake_hub = HubMotion { velocity: hub.velocity.array(), rates: hub.omega.array() };
    let (mut far, mut gamma) = (exchange.lambda_far.clone(), exchange.circulation.clone());
    // circulation is sought from where it led the blade before: what changes is the way there, and with it the last bits
    let (width, mut passed) = (options.n_stations, steady.circulation.clone());
    let change = |passed: &[f64], step: usize| -> Vec<f64> {
        let at = |step: usize, b: usize| row(step, b, rotor.n_blades, n) * width;
        let of_blade = |b: usize| {
            let (now, ahead) = (at(step, b), at(step + 1, b));
            (0..width).map(move |j| passed[ahead + j] - passed[now + j])
        };
        (0..rotor.n_blades).flat_map(of_blade).collect()
    };
    let mut changes = change(&passed, 0);
    for step in 1..n / 2 {
        let now: Vec<BladeInstant> =
            (0..rotor.n_blades).map(|b| blades[row(step, b, rotor.n_blades, n)]).collect();
        exchange.advance(&place, &now, rotor.nominal_step(n)).unwrap();
        let solved = |far: &[f64], start: &[f64]| {
            let course = Course::steady(&hub);
            rotor
                .circulations(system.air, &options, &course, (&now, &MemoryRows::default()), far, start)
                .unwrap()
                .gamma
        };
        let ahead: Vec<f64> = gamma.iter().zip(&changes).map(|(gamma, change)| gamma + change).collect();
        gamma = solved(&far, &ahead);
        let state = |blade: &BladeInstant| {
            let (flap, lead) = rotor.equivalent_angles(&blade.modal);
            BladeState { psi: blade.psi, flap, lead }
        };
        alone.step(wake_hub, &now.iter().map(state).collect::<Vec<_>>(), &gamma).unwrap();
        far = alone.inflow_far();
        gamma = solved(&far, &gamma);
        assert_eq!(exchange.wake.position(), alone.position(), "step {step}");
        assert_eq!(exchange.circulation, gamma, "step {step}");
        changes = change(&passed, step);
        for (b, gamma) in gamma.chunks_exact(width).enumerate() {
            let k = row(step, b, rotor.n_blades, n) * width;
            passed[k..k + width].copy_from_slice(gamma);
        }
    }
    // something has moved: the wake is not that of the start
    assert_ne!(alone.position(), marching().position());
}
