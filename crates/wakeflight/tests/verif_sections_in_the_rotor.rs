//! Sections that remember on a turning rotor without induction, against the closed forms of thin-airfoil theory at every station.

mod mechanics_support;

use mechanics_support::beam_support::{uh60a, uniform};
use mechanics_support::*;
use std::f64::consts::{PI, TAU};
use wakeflight::airfoil::Airfoil;
use wakeflight::airfoil::unsteady::Model;
use wakeflight::airfoil::unsteady::indicial::JONES;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::memory_rows::MemoryRows;
use wakeflight::blade::model::Discretisation;
use wakeflight::blade::section::Root;
use wakeflight::rotor::circulation::BladeInTime;
use wakeflight::rotor::swashplate::{PitchHarmonic, Rigging};
use wakeflight::system::blades::Controls;
use wakeflight::system::carrier::Stand;
use wakeflight::system::instant::{HeldInflow, HeldMemory, Inputs};
use wakeflight::system::model::{Setting, System};
use wakeflight::trim::equation::Equation;
use wakeflight::trim::path::Path;
use wakeflight::trim::problem::{Inflow, Problem};
use wakeflight::trim::residual::Trim;

const N_STATIONS: usize = 6;

/// Four stiff clamped blades on a stand in hover whose air is slow beside the speed of sound, lift 2 pi alpha unless `airfoil`.
fn hover(model: Model, airfoil: Option<Airfoil>, velocity: [f64; 3], higher: Vec<PitchHarmonic>) -> System {
    let mut properties = uniform(Root::Clamped, 0.4, 8.0, 1e12, 1e12);
    properties.rigid = true;
    let airfoil = airfoil.unwrap_or_else(|| smooth_airfoil(2.0 * PI, 0.0, 0.01, 0.0));
    let mut data = aircraft_data(uh60a(), airfoil).rotor;
    (data.blade, data.lag_damper, data.omega) = (properties, None, 1.0);
    let discretisation = Discretisation {
        n_elements: 4,
        n_modes: 0,
        n_gauss: 8,
        n_stations: N_STATIONS,
        reference_pitch: 0.0,
    };
    let setting = Setting { discretisation, unsteady: model, ..setting(true, 0.0) };
    let mut rotor = setting.rotor(&data, &Rigging::direct()).unwrap();
    rotor.higher = higher;
    System::on_stand(Stand { velocity, rates: [0.0; 3] }, vec![rotor], &setting)
}

fn problem(n: usize, collective: f64, cyclic: f64) -> Problem {
    Problem {
        path: Path { speed: 0.0, flight_path: 0.0, turn_rate: 0.0 },
        free: Vec::new(),
        equations: vec![
            Equation::Collective(collective),
            Equation::LateralCyclic(cyclic),
            Equation::LongitudinalCyclic(0.0),
        ],
        n_harmonics: 0,
        n_azimuths: n,
        inflow: Inflow::Map { inflow: vec![0.0; n * N_STATIONS], mean: 0.0 },
        wash: None,
    }
}

/// Circulation and angle of attack of a blade's passage, station by station: (n, N_STATIONS).
fn passage(system: &System, n: usize, collective: f64, cyclic: f64) -> [Vec<f64>; 2] {
    let problem = problem(n, collective, cyclic);
    let trim = Trim::new(system, &problem).unwrap();
    let psi: Vec<f64> = (0..n).map(|l| TAU * l as f64 / n as f64).collect();
    let still = vec![0.0; n * N_STATIONS];
    // controls theta_0, theta_1c, theta_1s
    let found = trim.passages(&[collective, cyclic, 0.0], &psi, Some(&still), None).unwrap();
    let [.., alpha, _, circulation, _, _] = found.fields;
    [circulation, alpha]
}

/// Cosine and sine of harmonic `m` of column `j` of a map (n, N_STATIONS).
fn harmonic(map: &[f64], j: usize, m: usize) -> [f64; 2] {
    let n = map.len() / N_STATIONS;
    let mut sum = [0.0; 2];
    for l in 0..n {
        let (s, c) = (TAU * (m * l) as f64 / n as f64).sin_cos();
        sum[0] += 2.0 / n as f64 * map[l * N_STATIONS + j] * c;
        sum[1] += 2.0 / n as f64 * map[l * N_STATIONS + j] * s;
    }
    sum
}

/// a/b of numbers cosine - i sine.
fn over(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let size = b[0] * b[0] + b[1] * b[1];
    [(a[0] * b[0] + a[1] * b[1]) / size, (a[0] * b[1] - a[1] * b[0]) / size]
}

/// C(k) = 1 - sum A i k/(b + i k) of Jones's function.
fn jones(k: f64) -> [f64; 2] {
    JONES.a.iter().zip(JONES.b).fold([1.0, 0.0], |[re, im], (a, b)| {
        let d = b * b + k * k;
        [re - a * k * k / d, im - a * k * b / d]
    })
}

fn reduced_frequency(system: &System, j: usize, m: usize) -> f64 {
    let station = &system.main().blade.stations[j];
    m as f64 * station.geometry.chord / (2.0 * station.shapes.x)
}

/// Largest distance of the lift of harmonic pitch at m/rev from C(k) of Jones, over all stations.
fn distance_from_jones(n: usize, m: usize) -> f64 {
    let pitch = vec![PitchHarmonic { order: m, cosine: 0.02, sine: 0.0 }];
    let system = hover(Model::Hgm, None, [0.0; 3], pitch);
    let [circulation, alpha] = passage(&system, n, 0.0, 0.0);
    let mut worst = 0f64;
    for j in 0..N_STATIONS {
        let station = &system.main().blade.stations[j];
        let lift = PI * station.geometry.chord * station.shapes.x * system.main().omega;
        let quasi_steady = harmonic(&alpha, j, m).map(|a| a * lift);
        let found = over(harmonic(&circulation, j, m), quasi_steady);
        let exact = jones(reduced_frequency(&system, j, m));
        worst = worst.max((found[0] - exact[0]).hypot(found[1] - exact[1]));
    }
    worst
}

/// Every station of a rotor whose blades pitch harmonically has Theodorsen's lift at its own reduced frequency, in Jones's
/// approximation; the error falls with the square of the step of azimuth.
#[test]
fn harmonic_pitch_gives_theodorsens_function_at_every_station() {
    for m in [2, 5] {
        let errors = [36, 72, 144].map(|n| distance_from_jones(n, m));
        assert!(errors[2] < 3e-3, "{m}/rev: {errors:?}");
        let order = (errors[0] / errors[2]).log2() / 2.0;
        assert!((1.8..2.2).contains(&order), "{m}/rev: {errors:?}, order {order}");
    }
    // and Theodorsen's own, C(k) at k = 0.1 and 0.3, is within the approximation's two per cent of it
    for (k, exact) in [(0.1, [0.8319, -0.1723]), (0.3, [0.6650, -0.1793])] {
        let found = jones(k);
        assert!((found[0] - exact[0]).hypot(found[1] - exact[1]) < 0.02, "{k}: {found:?}");
    }
}

/// Steps of a flight: inflow held at zero, collective by time, memory kept from step to step; circulation at every station of the
/// first blade at the end.
fn flown(system: &System, n: usize, steps: usize, collective: impl Fn(f64) -> f64) -> Vec<f64> {
    let rotor = system.main();
    let dt = TAU / (n as f64 * rotor.omega);
    let held = || HeldInflow::stations(vec![0.0; 4 * N_STATIONS], 0.0);
    let acting = |t: f64, memory: MemoryRows| Inputs {
        sections: vec![HeldMemory { memory, begun: t }],
        t_start: t,
        ..inputs([collective(t), 0.0, 0.0, 0.0], held())
    };
    let still = vec![0.0; system.layout.len()];
    let problem = problem(n, collective(-1.0), 0.0);
    let trim = Trim::new(system, &problem).unwrap();
    let memory = trim.memory_at(&[collective(-1.0), 0.0, 0.0], 0.0);
    // the states of before in the flow of the first step: pitch may jump
    let mut memory = system.kept_memory(&at(0.0, &still, &still, &acting(0.0, memory)));
    for k in 0..steps {
        let inputs = acting(k as f64 * dt, memory);
        memory = system.kept_memory(&at((k + 1) as f64 * dt, &still, &still, &inputs));
    }
    let t = steps as f64 * dt;
    system.outputs(&at(t, &still, &still, &acting(t, memory))).rotors[0].circulation[..N_STATIONS].to_vec()
}

/// After a step of the collective every station has Wagner's lift at the semichords it has gone, in Jones's approximation.
#[test]
fn a_step_of_pitch_gives_wagners_function_at_every_station() {
    let system = hover(Model::Hgm, None, [0.0; 3], Vec::new());
    let (n, steps, theta) = (36, 3, 0.03);
    let found = flown(&system, n, steps, |t| if t < 0.0 { 0.0 } else { theta });
    for (j, found) in found.iter().enumerate() {
        let station = &system.main().blade.stations[j];
        let speed = station.shapes.x * system.main().omega;
        let s = TAU * steps as f64 / n as f64 * station.shapes.x / (0.5 * station.geometry.chord);
        let wagner: f64 = 1.0 - JONES.a.iter().zip(JONES.b).map(|(a, b)| a * (-b * s).exp()).sum::<f64>();
        // the pitch at the axis and that of the blade at an angle to its path differ by what is of third order
        let quasi_steady = PI * station.geometry.chord * speed * theta;
        assert!((found / quasi_steady / wagner - 1.0).abs() < 2e-3, "{j}: {} {wagner}", found / quasi_steady);
    }
}

/// A flight that goes on from a trim repeats it: the blades in unison, each what the first was at its azimuth.
#[test]
fn a_flight_from_a_trim_repeats_it_and_its_blades_move_in_unison() {
    let stalling = data_files::airfoil("sc1095", 0.002);
    for model in [Model::Attached, Model::Oye, Model::Hgm] {
        let system = hover(model, Some(stalling.clone()), [-2.0, 0.0, 0.0], Vec::new());
        let (n, x) = (36, [0.2, 0.03, 0.0]);
        let problem = problem(n, x[0], x[1]);
        let trim = Trim::new(&system, &problem).unwrap();
        let turn = trim.memory(&x);
        let dt = TAU / (n as f64 * system.main().omega);
        let still = vec![0.0; system.layout.len()];
        let mut memory = trim.memory_at(&x, 0.0);
        for k in 0..n {
            let held = HeldInflow::stations(vec![0.0; 4 * N_STATIONS], 0.0);
            let begun = k as f64 * dt;
            let inputs = Inputs {
                sections: vec![HeldMemory { memory, begun }],
                ..inputs([x[0], x[1], x[2], 0.0], held)
            };
            memory = system.kept_memory(&at(begun + dt, &still, &still, &inputs));
            let now = turn.rows((0..4).map(|b| (k + 1 + b * n / 4) % n));
            let apart = largest_difference(&memory, &now);
            assert!(apart < 1e-11, "{model:?}, step {k}: {apart:e}");
        }
    }
}

fn largest_difference(a: &MemoryRows, b: &MemoryRows) -> f64 {
    assert_eq!(a.shape(), b.shape());
    let pairs = a.iter().zip(b.iter()).flat_map(|(a, b)| a.states().iter().zip(b.states()));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// In a flow that stays a rotor has the loads of its tables, whatever its sections' law.
#[test]
fn a_rotor_in_steady_hover_has_the_loads_of_its_tables() {
    let stalling = data_files::airfoil("sc1095", 0.002);
    for collective in [0.1, 0.35] {
        let loads = |model: Model| {
            let mut system = hover(model, Some(stalling.clone()), [0.0; 3], Vec::new());
            system.rotors[0].blade.precone = 0.06;
            let problem = problem(36, collective, 0.0);
            let trim = Trim::new(&system, &problem).unwrap();
            let still = vec![0.0; N_STATIONS];
            let found = trim.passages(&[collective, 0.0, 0.0], &[0.0], Some(&still), None).unwrap();
            [found.loads[2].clone(), found.loads[3].clone()].concat()
        };
        let tables = loads(Model::QuasiSteady);
        // coned blades too: their turning with the rotor is no pitching
        // (attached flow damps their rate by 1/sqrt(1 - M^2) of what the tables' sections have)
        for (model, allowed) in [(Model::Attached, 1e-5), (Model::Oye, 1e-12), (Model::Hgm, 1e-12)] {
            let e = relative_error(&loads(model), &tables);
            assert!(e < allowed, "{model:?} at {collective}: {e:e}");
        }
    }
}

/// The circulation that the wake is given is that of the sections whose loads act.
#[test]
fn the_circulation_of_the_wake_is_that_of_the_sections() {
    let system = hover(Model::Hgm, None, [-2.0, 0.0, 0.0], Vec::new());
    let (n, x) = (36, [0.1, 0.02, 0.0]);
    let problem = problem(n, x[0], x[1]);
    let trim = Trim::new(&system, &problem).unwrap();
    let memory = trim.memory(&x);
    let [circulation, _] = passage(&system, n, x[0], x[1]);
    let rotor = system.main();
    let hub = system.steady_hub(&vec![0.0; system.layout.len()]);
    let controls = Controls::held([x[0], x[1], x[2], 0.0]);
    for l in 0..n {
        let instant = system.blade_at(TAU * l as f64 / n as f64, ModalMotion::of(&[], &[]), &controls);
        let blade = BladeInTime { instant: &instant, past: memory.periodic(l) };
        let (mut gamma, mut slope) = ([0.0; N_STATIONS], [0.0; N_STATIONS]);
        rotor.section_circulation(system.air, &hub, blade, &[0.0; N_STATIONS], &mut gamma, &mut slope);
        let e = relative_error(&gamma, &circulation[l * N_STATIONS..(l + 1) * N_STATIONS]);
        assert!(e < 1e-12, "{l}: {e:e}");
    }
}

/// Blades without lift in a wind: with yawed drag every element is dragged along the wind it meets, else along its normal part.
#[test]
fn yawed_drag_acts_along_the_whole_wind() {
    let (n, speed, cd) = (24, 3.0, 0.02);
    for yawed in [false, true] {
        let airfoil = smooth_airfoil(0.0, 0.0, cd, 0.0);
        let mut system = hover(Model::QuasiSteady, Some(airfoil), [-speed, 0.0, 0.0], Vec::new());
        system.rotors[0].yawed_drag = yawed;
        let problem = problem(n, 0.0, 0.0);
        let trim = Trim::new(&system, &problem).unwrap();
        let psi: Vec<f64> = (0..n).map(|l| TAU * l as f64 / n as f64).collect();
        let still = vec![0.0; n * N_STATIONS];
        let found = trim.passages(&[0.0; 3], &psi, Some(&still), None).unwrap();
        let rotor = system.main();
        for (psi, force) in psi.iter().zip(found.loads[2].chunks_exact(3)) {
            let (s, c) = psi.sin_cos();
            let mut expected = [0.0; 3];
            for station in &rotor.blade.stations {
                let swept = station.shapes.x * rotor.omega;
                let wind = [speed + swept * s, -swept * c];
                let along = wind[0] * c + wind[1] * s;
                let met = if yawed { wind } else { [wind[0] - along * c, wind[1] - along * s] };
                let drag = 0.5 * system.air.density * station.geometry.chord * station.geometry.width * cd;
                for k in 0..2 {
                    expected[k] += drag * met[0].hypot(met[1]) * met[k];
                }
            }
            let e = relative_error(force, &expected);
            assert!(e < 1e-9, "{yawed}, {psi}: {force:?} {expected:?}");
        }
    }
}
