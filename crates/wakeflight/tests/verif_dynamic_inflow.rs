//! Pitt-Peters matrices, gains and eigenvalues (data file D02_pitt_peters.toml) and transients (D03_inflow_steps.toml).

use std::f64::consts::PI;
use wakeflight::inflow::momentum::momentum_inflow;
use wakeflight::inflow::pitt_peters::{ApparentMass, DiskCondition, MassFlow, PittPeters};
use wakeflight::numerics::scalar::{Dual, Real};

fn disk<S: Real>(ct: f64, mu: f64, mu_z: f64) -> DiskCondition<S> {
    let c = S::cst;
    DiskCondition {
        ct: c(ct),
        cl: c(0.0),
        cm: c(0.0),
        mu_x: c(mu),
        mu_y: c(0.0),
        mu_z: c(mu_z),
        height: None,
    }
}

/// -M^-1 V L^-1 per rotor radian: the model's derivative with the mass flow of momentum theory.
fn system(model: PittPeters, at: [f64; 3], ct: f64, mu: f64, mu_z: f64) -> nalgebra::Matrix3<f64> {
    let x: [Dual<3>; 3] = std::array::from_fn(|i| Dual::variable(at[i], i));
    let rate = model.inflow_dot(x, disk(ct, mu, mu_z), 1.0);
    nalgebra::Matrix3::from_fn(|i, j| rate[i].eps[j])
}

struct Case {
    ct: f64,
    mu: f64,
    alpha_deg: f64,
    lambda_total: f64,
    lambda_i: f64,
    v_t: f64,
    v_m: f64,
    l_tilde: [[f64; 3]; 3],
    eig_re: [f64; 3],
    eig_im: [f64; 3],
    steady: [f64; 3],
}

fn cases() -> [Case; 3] {
    [
        Case {
            ct: 0.005,
            mu: 0.0,
            alpha_deg: 0.0,
            lambda_total: 0.05,
            lambda_i: 0.05,
            v_t: 0.05,
            v_m: 0.1,
            l_tilde: [[0.5, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
            eig_re: [-0.44178647, -0.44178647, -0.18407769],
            eig_im: [0.0; 3],
            steady: [0.05, 0.0, 0.0],
        },
        Case {
            ct: 0.007,
            mu: 0.185,
            alpha_deg: 2.0,
            lambda_total: 0.0252060655,
            lambda_i: 0.0187457232,
            v_t: 0.18670925,
            v_m: 0.18923996,
            l_tilde: [[0.5, 0.0, -0.64279210], [0.0, 3.52422382, 0.0], [0.64279210, 0.0, 0.47577618]],
            eig_re: [-0.76762593, -0.76762593, -0.47445144],
            eig_im: [-0.54167613, 0.54167613, 0.0],
            steady: [0.01874572, 0.0, 0.02409921],
        },
        Case {
            ct: 0.0064,
            mu: 0.15,
            alpha_deg: 3.0,
            lambda_total: 0.0288115340,
            lambda_i: 0.0209503671,
            v_t: 0.15274195,
            v_m: 0.15669380,
            l_tilde: [[0.5, 0.0, -0.60834203], [0.0, 3.36522213, 0.0], [0.60834203, 0.0, 0.63477787]],
            eig_re: [-0.63328575, -0.63328575, -0.41141533],
            eig_im: [-0.40643482, 0.40643482, 0.0],
            steady: [0.02095037, 0.0, 0.02548998],
        },
    ]
}

#[test]
fn verif_mean_inflow_static_gains_and_eigenvalues() {
    for c in cases() {
        let mu_z = -c.mu * c.alpha_deg.to_radians().tan();
        let mean: f64 = momentum_inflow(c.ct, c.mu * c.mu, mu_z);
        assert!((mean - c.lambda_i).abs() < 1e-7 && (mean - mu_z - c.lambda_total).abs() < 1e-7);

        let a = system(PittPeters::default(), c.steady, c.ct, c.mu, mu_z);
        // V L^-1 = -M A; L = (V^-1 (-M A))^-1
        let mass = nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(
            128.0 / (75.0 * PI),
            16.0 / (45.0 * PI),
            16.0 / (45.0 * PI),
        ));
        let flow = nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(c.v_t, c.v_m, c.v_m));
        let gain = (-mass * a).try_inverse().unwrap() * flow;
        for i in 0..3 {
            for j in 0..3 {
                let error = (gain[(i, j)] - c.l_tilde[i][j]).abs();
                // the printed V has eight decimals, relative 1e-7 at 0.05
                assert!(error < 1e-6, "{} L{i}{j}: {} {}", c.mu, gain[(i, j)], c.l_tilde[i][j]);
            }
        }

        let mut eigenvalues: Vec<(f64, f64)> = a.complex_eigenvalues().iter().map(|e| (e.re, e.im)).collect();
        eigenvalues.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1)));
        let mut reference: Vec<(f64, f64)> = c.eig_re.into_iter().zip(c.eig_im).collect();
        reference.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1)));
        // the pair's real parts differ by rounding only: compare as sets
        for r in &reference {
            let nearest =
                eigenvalues.iter().map(|e| (e.0 - r.0).hypot(e.1 - r.1)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-7, "{} {r:?}: {eigenvalues:?}", c.mu);
        }

        for rate in PittPeters::default().inflow_dot(c.steady, disk(c.ct, c.mu, mu_z), 1.0) {
            assert!(f64::abs(rate) < 2e-7, "{rate}");
        }
    }
}

#[test]
fn verif_hover_eigenvalues_of_the_small_perturbation() {
    for (apparent_mass, uniform) in
        [(ApparentMass::Corrected, -0.36815539), (ApparentMass::Uncorrected, -0.23562)]
    {
        let model = PittPeters { apparent_mass, mass_flow: MassFlow::State };
        let a = system(model, [0.05, 0.0, 0.0], 0.005, 0.0, 0.0);
        let digits = if apparent_mass == ApparentMass::Corrected { 1e-7 } else { 5e-6 };
        assert!((a[(0, 0)] - uniform).abs() < digits, "{}", a[(0, 0)]);
        assert!((a[(1, 1)] + 0.44178647).abs() < 1e-7 && (a[(2, 2)] + 0.44178647).abs() < 1e-7);
    }
}

/// Classical fourth-order Runge-Kutta.
fn advance<const N: usize>(x: [f64; N], t: f64, h: f64, f: &impl Fn(f64, [f64; N]) -> [f64; N]) -> [f64; N] {
    let add = |k: [f64; N], a: f64| -> [f64; N] { std::array::from_fn(|i| x[i] + a * k[i]) };
    let k1 = f(t, x);
    let k2 = f(t + 0.5 * h, add(k1, 0.5 * h));
    let k3 = f(t + 0.5 * h, add(k2, 0.5 * h));
    let k4 = f(t + h, add(k3, h));
    std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
}

#[test]
fn verif_step_of_thrust_in_hover() {
    for (apparent_mass, reference) in [
        (ApparentMass::Corrected, [0.0456296851, 0.0497221903, 0.0533010366, 0.0546540629, 0.0547715109]),
        (ApparentMass::Uncorrected, [0.0435281344, 0.0470103975, 0.0511809742, 0.0540436139, 0.0547436356]),
    ] {
        let model = PittPeters { apparent_mass, mass_flow: MassFlow::State };
        let f = |_t: f64, x: [f64; 3]| model.inflow_dot(x, disk(0.006, 0.0, 0.0), 1.0);
        let mut x = [(0.003f64 / 2.0).sqrt(), 0.0, 0.0];
        let mut psi = 0.0;
        for (end, value) in [0.5, 1.0, 2.0, 4.0, 8.0].map(|e| e * PI).into_iter().zip(reference) {
            let n = 500;
            let h = (end - psi) / n as f64;
            for _ in 0..n {
                x = advance(x, psi, h, &f);
                psi += h;
            }
            assert!((x[0] - value).abs() < 1e-8, "{psi}: {} {value}", x[0]);
        }
    }
}

#[test]
fn verif_ramps_of_collective_in_hover_with_flapping() {
    let (omega, solidity, slope, lock) = (22.0, 0.0636, 5.73, 8.0);
    let model = PittPeters { apparent_mass: ApparentMass::Uncorrected, mass_flow: MassFlow::State };
    let samples_fast = [
        [0.05, 0.00647337, 0.00484070, 1.447960],
        [0.10, 0.00573679, 0.01266604, 7.135952],
        [0.20, 0.01066351, 0.03171909, 12.211259],
        [0.30, 0.00959284, 0.04988076, 8.836095],
        [0.50, 0.00735330, 0.05858675, 7.556946],
        [1.00, 0.00724174, 0.06015331, 7.405243],
    ];
    let samples_slow = [
        [0.05, 0.00064724, 0.00048526, 0.144793],
        [0.10, 0.00112962, 0.00161554, 0.792977],
        [0.20, 0.00274579, 0.00641711, 2.788771],
        [0.30, 0.00436734, 0.01512971, 4.342315],
        [0.50, 0.00669845, 0.03664263, 6.655204],
        [1.00, 0.00726506, 0.05984348, 7.433944],
    ];
    for (rate_deg, samples, peak) in [(200.0f64, samples_fast, 0.01095023), (20.0, samples_slow, 0.00803242)]
    {
        let theta = |t: f64| (rate_deg * t).min(12.0).to_radians();
        let thrust = |t: f64, lambda: f64, beta_dot: f64| {
            0.5 * solidity * slope * (theta(t) / 3.0 - 0.5 * lambda - beta_dot / (3.0 * omega))
        };
        // lambda, beta, d beta/dt
        let f = |t: f64, x: [f64; 3]| {
            let ct = thrust(t, x[0], x[2]);
            let lambda_dot = model.inflow_dot([x[0], 0.0, 0.0], disk(ct, 0.0, 0.0), omega)[0];
            let moment = lock / 8.0 * (theta(t) - 4.0 / 3.0 * x[0] - x[2] / omega);
            [lambda_dot, x[2], omega * omega * (moment - x[1])]
        };
        let (h, mut x, mut highest) = (1e-4, [0.0; 3], 0.0f64);
        for i in 0..10_000 {
            let t = i as f64 * h;
            x = advance(x, t, h, &f);
            let end = t + h;
            let ct = thrust(end, x[0], x[2]);
            highest = highest.max(ct);
            for s in samples.iter().filter(|s| (s[0] - end).abs() < 0.5 * h) {
                for (value, reference) in [ct, x[0], x[1].to_degrees()].into_iter().zip(&s[1..]) {
                    assert!((value / reference - 1.0).abs() < 1e-3, "{rate_deg} {end}: {value} {reference}");
                }
            }
        }
        assert!((highest / peak - 1.0).abs() < 1e-3, "{highest}");
    }
}
