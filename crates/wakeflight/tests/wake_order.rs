//! Order and exactness of the wake solvers in prescribed velocity fields, where the solution is known.

use std::f64::consts::TAU;
use wakeflight::wake::{
    BladeState, Evaluation, Form, HubMotion, MarchingOptions, Predictor, Prescribed, RelaxationOptions,
    RelaxationWake, Scheme, TimeMarchingWake, WakeOptions,
};

type Field = Prescribed<fn([f64; 3]) -> [f64; 3]>;

const RADIUS: f64 = 8.0;
const OMEGA: f64 = 27.0;

fn options(steps: usize, turns: f64) -> WakeOptions {
    WakeOptions {
        azimuth_step: TAU / steps as f64,
        turns,
        n_stations: 5,
        near_wake_angle: 0.0,
        ..WakeOptions::new(4, RADIUS, 0.2 * RADIUS, 0.0, 0.5, OMEGA)
    }
}

fn swirl(p: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = p.map(|c| c / RADIUS);
    [
        OMEGA * RADIUS * 0.03 * (2.0 * x + y).sin(),
        OMEGA * RADIUS * 0.03 * (2.0 * y - z).cos(),
        OMEGA * RADIUS * (-0.02 * (1.5 * x).cos() - 0.02 * (2.0 * y).sin()),
    ]
}

fn nothing(_: [f64; 3]) -> [f64; 3] {
    [0.0; 3]
}

/// Hub velocity from the advance ratio and the velocity of descent (both over the tip speed).
fn hub(mu: f64, descent: f64) -> HubMotion {
    HubMotion { velocity: [-mu * OMEGA * RADIUS, 0.0, -descent * OMEGA * RADIUS], rates: [0.0; 3] }
}

fn periodic(
    options: &WakeOptions,
    hub: HubMotion,
    flap: f64,
    mean_inflow: f64,
    field: Field,
) -> RelaxationWake<Field> {
    let n = options.steps_per_revolution();
    let whole = RelaxationOptions { relaxation: 1.0, ..RelaxationOptions::default() };
    let mut wake = RelaxationWake::with_field(*options, whole, hub, mean_inflow, field).unwrap();
    wake.set_state(hub, &vec![(flap, 0.0); n], &vec![0.0; n * options.n_stations]).unwrap();
    wake
}

fn blades(options: &WakeOptions, step: usize, flap: f64) -> Vec<BladeState> {
    (0..options.rotor.n_blades)
        .map(|b| BladeState {
            psi: TAU
                * (step as f64 / options.steps_per_revolution() as f64
                    + b as f64 / options.rotor.n_blades as f64),
            flap,
            lead: 0.0,
        })
        .collect()
}

fn marched(
    start: &RelaxationWake<Field>,
    own: MarchingOptions,
    hub: HubMotion,
    flap: f64,
    steps: usize,
) -> TimeMarchingWake<Field> {
    let mut wake = TimeMarchingWake::from_relaxation(start, 0, own).unwrap();
    let options = *wake.options();
    let circulation = vec![0.0; options.rotor.n_blades * options.n_stations];
    for n in 1..=steps {
        wake.step(hub, &blades(&options, n, flap), &circulation).unwrap();
    }
    wake
}

/// Markers of a filament released at the azimuths psi - zeta, integrated along their paths with small Runge-Kutta steps.
fn exact_filament(
    options: &WakeOptions,
    psi: f64,
    flap: f64,
    hub: HubMotion,
    field: fn([f64; 3]) -> [f64; 3],
) -> Vec<[f64; 3]> {
    let v = |p: [f64; 3]| -> [f64; 3] {
        let (wind, induced) = (hub.wind(p), field(p));
        std::array::from_fn(|c| (wind[c] + induced[c]) / OMEGA)
    };
    let shifted = |p: [f64; 3], k: [f64; 3], h: f64| -> [f64; 3] { std::array::from_fn(|c| p[c] + h * k[c]) };
    let delta = options.delta_psi();
    (0..=options.n_segments())
        .map(|k| {
            let born = psi - k as f64 * delta;
            let mut p =
                [RADIUS * flap.cos() * born.cos(), RADIUS * flap.cos() * born.sin(), RADIUS * flap.sin()];
            let n = (k as f64 * delta / 0.02).ceil().max(1.0) as usize;
            let h = k as f64 * delta / n as f64;
            for _ in 0..n {
                let k1 = v(p);
                let k2 = v(shifted(p, k1, 0.5 * h));
                let k3 = v(shifted(p, k2, 0.5 * h));
                let k4 = v(shifted(p, k3, h));
                p = std::array::from_fn(|c| p[c] + h / 6.0 * (k1[c] + 2.0 * k2[c] + 2.0 * k3[c] + k4[c]));
            }
            p
        })
        .collect()
}

/// RMS and largest distance of markers, over R.
fn errors(a: &[[f64; 3]], b: &[[f64; 3]]) -> (f64, f64) {
    assert_eq!(a.len(), b.len());
    let squares: Vec<f64> =
        a.iter().zip(b).map(|(p, q)| (0..3).map(|c| (p[c] - q[c]).powi(2)).sum()).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    (mean.sqrt() / RADIUS, squares.iter().fold(0.0f64, |m, s| m.max(*s)).sqrt() / RADIUS)
}

/// Options of marching with a field of the predicted and of the corrected wake in every step.
fn two_fields() -> MarchingOptions {
    MarchingOptions { evaluation: Evaluation::Pece, ..MarchingOptions::default() }
}

enum Solver {
    Relaxation,
    Marching(Scheme, Form),
    OneField(Scheme),
}

/// RMS error over R in the swirling field at `steps` per revolution.
fn swirl_error(solver: &Solver, steps: usize) -> f64 {
    let (hub, flap) = (hub(0.185, -0.015), 0.05);
    let (mut options, mut own) = (options(steps, 3.0), two_fields());
    if let Solver::Marching(scheme, form) = solver {
        (own.scheme, options.form) = (*scheme, *form);
    }
    if let Solver::OneField(scheme) = solver {
        (own.scheme, own.evaluation) = (*scheme, Evaluation::Pec);
    }
    let mut start = periodic(&options, hub, flap, 0.0, Prescribed(swirl as fn([f64; 3]) -> [f64; 3]));
    let exact = |psi: f64| exact_filament(&options, psi, flap, hub, swirl);
    match solver {
        Solver::Relaxation => {
            let norms = start.sweep(40).unwrap();
            assert!(norms.last().unwrap().all < 1e-12, "sweeps did not settle: {:?}", norms.last());
            let all: Vec<[f64; 3]> = (0..steps).flat_map(|l| exact(TAU * l as f64 / steps as f64)).collect();
            errors(start.position(), &all).0
        }
        Solver::Marching(..) | Solver::OneField(..) => {
            let wake = marched(&start, own, hub, flap, 8 * steps);
            let all: Vec<[f64; 3]> = (0..4).flat_map(|b| exact(TAU * b as f64 / 4.0)).collect();
            errors(wake.position(), &all).0
        }
    }
}

/// Errors at 10, 5 and 2.5 deg against those of an independent implementation (5 %), and the observed order.
fn check_order(solver: &Solver, expected: [f64; 3], least_order: f64) {
    let found = [36, 72, 144].map(|steps| swirl_error(solver, steps));
    let order = (found[1] / found[2]).log2();
    println!("errors {found:?}, order {order}");
    assert!(order >= least_order, "order {order}");
    for (f, e) in found.iter().zip(&expected) {
        assert!((f / e - 1.0).abs() < 0.05, "error {f}, {e} expected");
    }
}

#[test]
fn verif_relaxation_is_second_order() {
    check_order(&Solver::Relaxation, [8.85e-3, 2.32e-3, 5.88e-4], 1.9);
}

#[test]
fn verif_central_marching_is_second_order() {
    check_order(&Solver::Marching(Scheme::Pcc, Form::Displacement), [8.83e-3, 2.32e-3, 5.88e-4], 1.9);
}

#[test]
fn verif_pc2b_marching_is_second_order() {
    check_order(&Solver::Marching(Scheme::Pc2b, Form::Displacement), [8.77e-2, 3.42e-2, 1.09e-2], 1.6);
}

#[test]
fn verif_bdf2_marching_is_second_order() {
    check_order(&Solver::Marching(Scheme::Bdf2, Form::Displacement), [8.82e-2, 3.43e-2, 1.10e-2], 1.6);
}

#[test]
fn verif_bdf2_marching_in_positions_is_second_order() {
    check_order(&Solver::Marching(Scheme::Bdf2, Form::Position), [1.32e-1, 4.36e-2, 1.31e-2], 1.6);
}

#[test]
fn verif_backward_on_the_path_is_second_order_with_the_smallest_error_of_that_order() {
    check_order(&Solver::Marching(Scheme::Path2, Form::Displacement), [1.276e-4, 3.204e-5, 8.021e-6], 1.95);
    check_order(&Solver::Marching(Scheme::Path2, Form::Position), [1.276e-4, 3.204e-5, 8.021e-6], 1.95);
}

#[test]
fn verif_one_field_a_step_keeps_the_second_order() {
    for &scheme in Scheme::ALL {
        let both = [36, 72, 144].map(|steps| {
            let at = |solver| swirl_error(&solver, steps);
            [at(Solver::Marching(scheme, Form::Displacement)), at(Solver::OneField(scheme))]
        });
        let order = (both[1][1] / both[2][1]).log2();
        println!("{scheme:?}: errors with two fields, one {both:?}, order {order}");
        assert!(order >= 1.6, "{scheme:?}: order {order}");
        // the second field moves only the predictor
        for [two, one] in both {
            assert!((one / two - 1.0).abs() < 0.01, "{scheme:?}: {one} {two}");
        }
    }
}

/// Contraction and descent V/(omega R) = (-s x, -s y, -lambda): r = (e^(-s zeta) cos(psi - zeta), ..., -lambda zeta).
mod contraction {
    use super::*;

    const STRAIN: f64 = 0.05;
    const DESCENT: f64 = 0.03;

    fn field(p: [f64; 3]) -> [f64; 3] {
        [-STRAIN * OMEGA * p[0], -STRAIN * OMEGA * p[1], -DESCENT * OMEGA * RADIUS]
    }

    fn exact(options: &WakeOptions, psi: f64) -> Vec<[f64; 3]> {
        (0..=options.n_segments())
            .map(|k| {
                let zeta = k as f64 * options.delta_psi();
                let r = RADIUS * (-STRAIN * zeta).exp();
                [r * (psi - zeta).cos(), r * (psi - zeta).sin(), -DESCENT * RADIUS * zeta]
            })
            .collect()
    }

    /// Largest error over R.
    fn error(scheme: Option<(Scheme, Form)>, steps: usize) -> f64 {
        let (mut options, mut own) = (options(steps, 3.0), two_fields());
        if let Some((scheme, form)) = scheme {
            (own.scheme, options.form) = (scheme, form);
        }
        let mut start =
            periodic(&options, hub(0.0, 0.0), 0.0, 0.0, Prescribed(field as fn([f64; 3]) -> [f64; 3]));
        if scheme.is_none() {
            let norms = start.sweep(60).unwrap();
            assert!(norms.last().unwrap().all < 1e-13);
            let all: Vec<[f64; 3]> =
                (0..steps).flat_map(|l| exact(&options, TAU * l as f64 / steps as f64)).collect();
            return errors(start.position(), &all).1;
        }
        let wake = marched(&start, own, hub(0.0, 0.0), 0.0, 6 * steps);
        let all: Vec<[f64; 3]> = (0..4).flat_map(|b| exact(&options, TAU * b as f64 / 4.0)).collect();
        errors(wake.position(), &all).1
    }

    #[test]
    fn verif_contraction_and_descent_are_second_order() {
        let solvers = [
            ("relaxation", None),
            ("pcc", Some((Scheme::Pcc, Form::Displacement))),
            ("pc2b", Some((Scheme::Pc2b, Form::Displacement))),
            ("bdf2", Some((Scheme::Bdf2, Form::Displacement))),
            ("pc2b position", Some((Scheme::Pc2b, Form::Position))),
            ("path2", Some((Scheme::Path2, Form::Displacement))),
        ];
        for (name, scheme) in solvers {
            let found = [36, 72, 144].map(|steps| error(scheme, steps));
            let ratios = [found[0] / found[1], found[1] / found[2]];
            println!("{name}: {found:?}, ratios {ratios:?}, order {}", ratios[1].log2());
            assert!((ratios[1].log2() - 2.0).abs() < 0.15, "{name}: order {}", ratios[1].log2());
            assert!((ratios[0] - 4.0).abs() < 0.5 && (ratios[1] - 4.0).abs() < 0.4, "{name}: {ratios:?}");
        }
    }

    #[test]
    fn verif_contraction_and_descent_at_given_points() {
        // psi, zeta [deg], x, y, z over R for s = 0.05, lambda = 0.03
        let rows = [
            (0, 90, 0.000000000000, -0.924465250376, -0.047123889804),
            (0, 360, 0.730402691049, 0.000000000000, -0.188495559215),
            (60, 720, 0.266744045546, 0.462014239501, -0.376991118431),
            (200, 1080, -0.366161695399, -0.133271958054, -0.565486677646),
        ];
        // the error of second order is removed by extrapolation from two steps
        let at = |steps: usize| {
            let options = options(steps, 3.0);
            let mut wake =
                periodic(&options, hub(0.0, 0.0), 0.0, 0.0, Prescribed(field as fn([f64; 3]) -> [f64; 3]));
            wake.sweep(60).unwrap();
            rows.map(|(psi, zeta, ..)| {
                wake.position()[(psi * steps / 360) * (options.n_segments() + 1) + zeta * steps / 360]
            })
        };
        let (coarse, fine) = (at(36), at(72));
        for (i, (psi, zeta, x, y, z)) in rows.into_iter().enumerate() {
            for (c, exact) in [x, y, z].into_iter().enumerate() {
                let extrapolated = (4.0 * fine[i][c] - coarse[i][c]) / (3.0 * RADIUS);
                assert!((extrapolated - exact).abs() < 2e-6, "psi {psi} zeta {zeta}: {extrapolated} {exact}");
            }
        }
    }
}

/// Wake without induction: every marker is carried by the wind, r = (cos(psi - zeta) + mu zeta, sin(psi - zeta), -lambda zeta).
mod undisturbed {
    use super::*;

    #[test]
    fn verif_undistorted_wake_is_a_carried_helix() {
        // mu, lambda, psi, zeta [deg], x, y, z over R
        let rows: [(f64, f64, usize, usize, f64, f64, f64); 6] = [
            (0.1, 0.03, 0, 180, -0.685840734641, 0.0, -0.094247779608),
            (0.1, 0.03, 180, 720, 0.256637061436, 0.0, -0.376991118431),
            (0.185, 0.025, 90, 450, 2.452986602285, 0.0, -0.196349540849),
            (0.185, 0.025, 180, 720, 1.324778563656, 0.0, -0.314159265359),
            (0.3, 0.038, 0, 360, 2.884955592154, 0.0, -0.238761041673),
            (0.3, 0.038, 90, 450, 3.356194490192, 0.0, -0.298451302091),
        ];
        for (mu, lambda, psi, zeta, x, y, z) in rows {
            let options = options(36, 2.0);
            // descent by the mean induced velocity of the guess, and the same by climbing without induction
            let guess = periodic(
                &options,
                hub(mu, 0.0),
                0.0,
                lambda,
                Prescribed(nothing as fn([f64; 3]) -> [f64; 3]),
            );
            let mut climb = periodic(
                &options,
                hub(mu, -lambda),
                0.0,
                0.0,
                Prescribed(nothing as fn([f64; 3]) -> [f64; 3]),
            );
            climb.sweep(3).unwrap();
            for wake in [guess, climb] {
                let p = wake.position()[psi / 10 * (options.n_segments() + 1) + zeta / 10];
                // the table is printed with 12 decimals
                for (found, exact) in p.iter().zip([x, y, z]) {
                    assert!((found / RADIUS - exact).abs() < 2e-12, "{mu} {psi} {zeta}: {found} {exact}");
                }
            }
        }
    }

    /// Largest deviation from the carried helix after three revolutions, over R.
    fn deviation(scheme: Scheme, form: Form, predictor: Predictor) -> f64 {
        let options = WakeOptions { form, ..options(36, 3.0) };
        let own = MarchingOptions { scheme, predictor, ..two_fields() };
        let hub = hub(0.185, -0.03);
        let start = periodic(&options, hub, 0.05, 0.0, Prescribed(nothing as fn([f64; 3]) -> [f64; 3]));
        let wake = marched(&start, own, hub, 0.05, 108);
        let all: Vec<[f64; 3]> =
            (0..4).flat_map(|b| exact_filament(&options, TAU * b as f64 / 4.0, 0.05, hub, nothing)).collect();
        errors(wake.position(), &all).1
    }

    #[test]
    fn verif_uniform_wind_is_exact_with_displacements() {
        for &scheme in Scheme::ALL {
            for predictor in [Predictor::Same, Predictor::Central] {
                let error = deviation(scheme, Form::Displacement, predictor);
                assert!(error < 1e-12, "{scheme:?} {predictor:?}: {error}");
            }
        }
        // and with positions, where nothing is differenced but along the path of a marker
        for scheme in [Scheme::Pcc, Scheme::Path2] {
            assert!(deviation(scheme, Form::Position, Predictor::Same) < 1e-12, "{scheme:?}");
        }
    }

    #[test]
    fn verif_backward_differences_of_positions_contract_and_delay_the_helix() {
        // one per rev at 10 deg: 0.9918 of the amplitude and 2.7 deg of lag per turn
        let options = WakeOptions { form: Form::Position, ..options(36, 4.0) };
        let own = MarchingOptions { scheme: Scheme::Pc2b, ..two_fields() };
        let start =
            periodic(&options, hub(0.0, -0.03), 0.0, 0.0, Prescribed(nothing as fn([f64; 3]) -> [f64; 3]));
        let wake = marched(&start, own, hub(0.0, -0.03), 0.0, 10 * 36);
        let at = |k: usize| wake.position()[k];
        for turn in 1..=3 {
            let (p, q) = (at(36 * turn), at(36 * (turn + 1)));
            let kept = q[0].hypot(q[1]) / p[0].hypot(p[1]);
            let lag = (q[1].atan2(q[0]) - p[1].atan2(p[0])).to_degrees();
            println!("turn {turn}: amplitude {kept}, lag {lag} deg");
            assert!((kept - 0.9918).abs() < 1e-4 && (lag.abs() - 2.7).abs() < 0.05, "{kept} {lag}");
        }
    }
}
