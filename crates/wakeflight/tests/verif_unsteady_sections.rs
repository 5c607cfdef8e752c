//! Sections that know time: exact values of linear theory, rest, order of the step, derivatives.

use std::f64::consts::PI;
use wakeflight::airfoil::unsteady::impulsive::TimeConstants;
use wakeflight::airfoil::unsteady::indicial::{BEDDOES, JONES};
use wakeflight::airfoil::unsteady::{Coefficients, Flow, Model, Section, Separation, States};
use wakeflight::airfoil::{Airfoil, AirfoilTables};
use wakeflight::numerics::scalar::{Dual, Real};
use wakeflight::numerics::tables::Grid;

const SOUND: f64 = 340.0;
const CHORD: f64 = 0.5;

fn table(degrees: &[f64], f: impl Fn(f64, f64) -> f64) -> Grid {
    let mach = [0.0, 0.1, 0.3, 0.5, 0.7];
    let x: Vec<f64> = degrees.iter().map(|d| d.to_radians()).collect();
    let values = x.iter().map(|&a| mach.iter().map(|&m| f(a, m)).collect()).collect();
    Grid { x, y: mach.to_vec(), values }
}

/// Linear theory: slope 2 pi/beta, no moment.
fn plate() -> Airfoil {
    let wide: Vec<f64> = (-36..=36).map(|i| 5.0 * i as f64).collect();
    let lift = |a: f64, m: f64| 2.0 * PI * a / (1.0 - m * m).sqrt();
    let nothing = |_: f64, _: f64| 0.0;
    let tables = AirfoilTables {
        cl: table(&wide, lift),
        cd: table(&wide, nothing),
        cm: table(&wide, nothing),
        cd_increment: 0.0,
    };
    Airfoil::new(&tables).unwrap()
}

/// A cambered section that stalls, its coefficients no round numbers.
fn stalling() -> Airfoil {
    let fine: Vec<f64> = (-180..=180).map(|i| i as f64).collect();
    let lift = |a: f64, m: f64| {
        let a = a + 0.011;
        let f = (1.8 - a.abs().to_degrees() / (14.0 - 8.0 * m)).clamp(0.0, 1.0);
        6.1 * (1.0 + 0.4 * m) * (a / 1.2).sin().cos() * a.sin() * (1.0 + f.sqrt()).powi(2) / 4.0
    };
    let tables = AirfoilTables {
        cl: table(&fine, lift),
        cd: table(&fine, |a, m| 0.0083 + 1.7 * a.sin().powi(2) * (1.0 + m)),
        cm: table(&fine, |a, m| -0.013 - 0.4 * a.sin() * a.sin().abs() * (1.0 + 0.3 * m)),
        cd_increment: 0.0,
    };
    Airfoil::new(&tables).unwrap()
}

fn flow<S: Real>(alpha: S, pitch_rate: S, mach: f64) -> Flow<S> {
    let speed = S::cst(mach * SOUND);
    Flow {
        alpha: alpha + pitch_rate * (0.5 * CHORD) / speed,
        alpha_quarter: alpha,
        pitch_rate,
        turn_rate: pitch_rate,
        speed,
        speed_of_sound: SOUND,
    }
}

fn entries(c: &Coefficients<f64>) -> [f64; 4] {
    [c.cl, c.cd, c.cm, c.circulatory]
}

/// Time constants of the impulsive part against their closed forms evaluated by hand [leishman1989].
#[test]
fn impulsive_time_constants_are_the_published_ones() {
    for (mach, expected) in
        [(0.3, [1.23245, 1.08367, 1.42857, 0.64193]), (0.5, [1.28055, 0.94178, 2.0, 0.82157])]
    {
        let k = TimeConstants::at(mach, &BEDDOES);
        let found = [k.force_upwash, k.force_pitch, k.moment_upwash, k.moment_pitch];
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() < 6e-6, "Mach {mach}: {found:?}");
        }
    }
}

/// The pressure of a step is that of piston theory, falls as linear theory says and ends at that of steady flow.
#[test]
fn a_step_of_upwash_starts_and_ends_as_compressible_theory_has_it() {
    let airfoil = plate();
    let separation = Separation::of(&airfoil);
    let section = Section { airfoil: &airfoil, separation: &separation, chord: CHORD };
    let (mach, alpha) = (0.5, 1e-4);
    let at_rest = flow(0.0, 0.0, mach);
    let struck = flow(alpha, 0.0, mach);
    let model = Model::Attached;
    let mut states = model.equilibrium(&section, &at_rest);
    let cn = |states: &States<f64>| {
        let c = model.coefficients(&section, &struck, states);
        (c.cl * alpha.cos() + c.cd * alpha.sin()) / alpha
    };
    assert!((cn(&states) - 8.0).abs() < 1e-6);
    // moment: uniform pressure acts at mid-chord, a quarter behind
    let cm = model.coefficients(&section, &struck, &states).cm / alpha;
    assert!((cm + 2.0).abs() < 1e-6);
    let semichord = 0.5 * CHORD / (mach * SOUND);
    let early = model.advanced(&section, [&struck, &struck], 1e-5 * semichord, &states);
    let slope = (cn(&early) - cn(&states)) / 1e-5;
    assert!((slope + 2.0 * (1.0 - mach) / (mach * mach)).abs() < 1e-3, "{slope}");
    for _ in 0..400 {
        states = model.advanced(&section, [&struck, &struck], semichord, &states);
    }
    assert!((cn(&states) - 7.2552).abs() < 1e-4, "{}", cn(&states));
}

/// Wagner's function after a step and Theodorsen's in harmonic motion, of the constants and of the step.
#[test]
fn the_shed_wake_of_incompressible_flow_is_wagners_within_its_approximation() {
    let airfoil = plate();
    let separation = Separation::of(&airfoil);
    let section = Section { airfoil: &airfoil, separation: &separation, chord: CHORD };
    // nearly at rest: compressibility out of the time constants
    let mach = 1e-3;
    let (before, after) = (flow(0.0, 0.0, mach), flow(1e-3, 0.0, mach));
    let semichord = 0.5 * CHORD / (mach * SOUND);
    let exact = [
        (0.5, 0.5556638689),
        (1.0, 0.6006055984),
        (2.0, 0.6692895643),
        (5.0, 0.7882031665),
        (10.0, 0.8750447121),
        (20.0, 0.93664927),
        (50.0, 0.9767639024),
    ];
    for (s, wagner) in exact {
        let start = Model::Hgm.equilibrium(&section, &before);
        let states = Model::Hgm.advanced(&section, [&after, &after], s * semichord, &start);
        let found = Model::Hgm.coefficients(&section, &after, &states).alpha_effective / 1e-3;
        assert!((found / wagner - 1.0).abs() < 0.015, "{s} semichords: {found} {wagner}");
    }
    // C(k) = 1 - sum A i k/(b + i k): Jones's own numbers at k = 0.1
    let c = |k: f64| {
        JONES.a.iter().zip(JONES.b).fold((1.0, 0.0), |(re, im), (a, b)| {
            let d = b * b + k * k;
            (re - a * k * k / d, im - a * k * b / d)
        })
    };
    assert!((c(0.1).0 - 0.8298).abs() < 1e-4 && (c(0.1).1 + 0.1627).abs() < 1e-4);
}

/// A flow that stays has the table's coefficients, to the last bit but for rounding where states are in cascade.
#[test]
fn at_rest_every_model_is_the_table() {
    let airfoil = stalling();
    let separation = Separation::of(&airfoil);
    let section = Section { airfoil: &airfoil, separation: &separation, chord: CHORD };
    for model in Model::ALL.map(|(_, model)| model) {
        for i in -170..=170 {
            for mach in [0.05, 0.31, 0.62, 0.9] {
                let alpha = (1.0137 * i as f64).to_radians();
                let flow = flow(alpha, 0.0, mach);
                let (cl, cd, cm) = airfoil.coefficients(alpha, mach * SOUND / SOUND);
                let states = model.equilibrium(&section, &flow);
                // and it stays so
                let later = model.advanced(&section, [&flow, &flow], 0.01, &states);
                for x in [states, later] {
                    let c = model.coefficients(&section, &flow, &x);
                    assert_eq!((c.cl, c.cd, c.cm), (cl, cd, cm), "{model:?} {alpha} {mach}");
                }
                assert!(model.rates(&section, &flow, &states).iter().all(|&r| r == 0.0));
            }
        }
    }
}

fn moving(t: f64) -> Flow<f64> {
    let speed = 130.0 + 60.0 * (9.0 * t).sin();
    let (alpha, rate) = (0.12 + 0.14 * (31.0 * t).sin(), 0.14 * 31.0 * (31.0 * t).cos());
    Flow {
        alpha: alpha + 0.5 * rate * CHORD / speed,
        alpha_quarter: alpha,
        pitch_rate: rate,
        turn_rate: rate,
        speed,
        speed_of_sound: SOUND,
    }
}

/// The exponential step and the integrated rates are the same equation: their difference falls with the square of the step.
#[test]
fn the_exponential_step_follows_the_rates_to_second_order() {
    let airfoil = stalling();
    let separation = Separation::of(&airfoil);
    let section = Section { airfoil: &airfoil, separation: &separation, chord: CHORD };
    let end = 0.2;
    for model in [Model::Attached, Model::Oye, Model::Hgm] {
        let start = model.equilibrium(&section, &moving(0.0));
        // Runge and Kutta in steps so fine that their error does not count
        let n = 40_000;
        let h = end / n as f64;
        let mut exact = start;
        for i in 0..n {
            let t = i as f64 * h;
            let at = |t: f64, x: &States<f64>| model.rates(&section, &moving(t), x);
            let add =
                |k: &States<f64>, s: f64| -> States<f64> { std::array::from_fn(|j| exact[j] + s * k[j]) };
            let k1 = at(t, &exact);
            let k2 = at(t + 0.5 * h, &add(&k1, 0.5 * h));
            let k3 = at(t + 0.5 * h, &add(&k2, 0.5 * h));
            let k4 = at(t + h, &add(&k3, h));
            exact = std::array::from_fn(|j| exact[j] + h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]));
        }
        let reference = entries(&model.coefficients(&section, &moving(end), &exact));
        let error = |steps: usize| {
            let dt = end / steps as f64;
            let mut x = start;
            for i in 0..steps {
                let t = i as f64 * dt;
                x = model.advanced(&section, [&moving(t), &moving(t + dt)], dt, &x);
            }
            let found = entries(&model.coefficients(&section, &moving(end), &x));
            found.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let errors = [error(50), error(200), error(800)];
        let order = (errors[0] / errors[2]).log2() / 4.0;
        assert!(order > 1.7, "{model:?}: {errors:?}");
        assert!(errors[2] < 2e-4, "{model:?}: {errors:?}");
    }
}

/// Derivatives by the motion, through a step and through the coefficients, are those of differences.
#[test]
fn derivatives_are_those_of_the_equations() {
    let airfoil = stalling();
    let separation = Separation::of(&airfoil);
    let section = Section { airfoil: &airfoil, separation: &separation, chord: CHORD };
    for model in Model::ALL.map(|(_, model)| model) {
        let start = model.equilibrium(&section, &flow(0.19, 0.0, 0.36));
        fn answer<S: Real>(
            model: Model,
            section: &Section,
            start: &States<f64>,
            alpha: S,
            rate: S,
        ) -> [S; 3] {
            let start: States<S> = start.map(S::cst);
            let (before, after) = (flow(S::cst(0.19), S::cst(0.0), 0.36), flow(alpha, rate, 0.36));
            let states = model.advanced(section, [&before, &after], 4e-3, &start);
            let c = model.coefficients(section, &after, &states);
            [c.cl, c.cd, c.cm]
        }
        let (alpha, rate, h) = (0.2012, 0.7, 1e-6);
        let exact =
            answer(model, &section, &start, Dual::<2>::variable(alpha, 0), Dual::<2>::variable(rate, 1));
        let at = |alpha: f64, rate: f64| answer(model, &section, &start, alpha, rate);
        let (p, q) = (at(alpha + h, rate), at(alpha - h, rate));
        let (r, s) = (at(alpha, rate + h), at(alpha, rate - h));
        for k in 0..3 {
            let (by_alpha, by_rate) = ((p[k] - q[k]) / (2.0 * h), (r[k] - s[k]) / (2.0 * h));
            let scale = by_alpha.abs().max(1.0);
            assert!((exact[k].eps[0] - by_alpha).abs() < 1e-6 * scale, "{model:?} {k}");
            assert!((exact[k].eps[1] - by_rate).abs() < 1e-6 * scale, "{model:?} {k}");
        }
    }
}

/// The air that comes from behind meets the other edge: there the model is the table's, whatever the states.
#[test]
fn in_reversed_flow_states_do_not_act() {
    let airfoil = stalling();
    let separation = Separation::of(&airfoil);
    let section = Section { airfoil: &airfoil, separation: &separation, chord: CHORD };
    for model in Model::ALL.map(|(_, model)| model) {
        let disturbed = model.equilibrium(&section, &flow(0.2, 1.0, 0.3));
        for alpha in [1.06, 2.0, -1.7, 3.1] {
            let flow = flow(alpha, 0.0, 0.2);
            let (cl, cd, cm) = airfoil.coefficients(alpha, flow.mach());
            let c = model.coefficients(&section, &flow, &disturbed);
            assert_eq!((c.cl, c.cd, c.cm), (cl, cd, cm), "{model:?} at {alpha}");
        }
    }
}
