//! Floquet multipliers of one blade about its periodic motion, hub held, inflow frozen, with the lag damper: all inside
//! the unit circle at 80 kt and in hover; without the quasi-steady pitch-rate moment torsion would leave it.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use std::f64::consts::{PI, TAU};
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::blade::surroundings::BladeInflow;
use wakeflight::numerics::frames::Vec3;
use wakeflight::numerics::jacobian::{Direction, dense_jacobian};
use wakeflight::numerics::scalar::Real;
use wakeflight::system::model::System;

const N: usize = 5;
const HARMONICS: usize = 5;
/// Mean, cosines and sines of every mode, then collective and cyclic.
const UNKNOWNS: usize = N * (1 + 2 * HARMONICS) + 3;
const AZIMUTHS: usize = 48;
/// Modal coordinates, their rates and accelerations.
const MOTION: usize = 3 * N;

struct Trimmed {
    aircraft: System,
    mu: f64,
    lambda: f64,
    x: SVector<f64, UNKNOWNS>,
}

fn motion<S: Real>(x: &[S], psi: f64) -> (ModalMotion<S>, PitchMotion<S>) {
    let mut modal = modal_at([S::zero(); MAX_MODES]);
    for i in 0..N {
        let own = &x[i * (1 + 2 * HARMONICS)..];
        modal.q[i] = own[0];
        for k in 1..=HARMONICS {
            let (s, c) = (k as f64 * psi).sin_cos();
            let (a, b, w) = (own[2 * k - 1], own[2 * k], k as f64 * OMEGA);
            modal.q[i] += a * c + b * s;
            modal.q_dot[i] += (b * c - a * s) * w;
            modal.q_ddot[i] += (a * c + b * s) * (-w * w);
        }
    }
    let [t0, tc, ts] = [x[UNKNOWNS - 3], x[UNKNOWNS - 2], x[UNKNOWNS - 1]];
    let (s, c) = psi.sin_cos();
    let cyclic = tc * c + ts * s;
    let pitch = PitchMotion {
        theta: t0 + cyclic,
        theta_dot: (ts * c - tc * s) * OMEGA,
        theta_ddot: cyclic * (-OMEGA * OMEGA),
    };
    (modal, pitch)
}

impl Trimmed {
    fn hub<S: Real>(&self) -> HubMotion<S> {
        let mut hub = hub_at_rest();
        hub.velocity = Vec3::cst([-self.mu * self.aircraft.main().tip_speed(), 0.0, 0.0]);
        hub.acceleration_less_gravity = Vec3::cst([0.0, 0.0, 9.80665]);
        hub
    }

    /// Periodic motion with the thrust of 16 000 lb and no first-harmonic flapping of the first flap mode.
    fn new(mu: f64) -> Self {
        let data = aircraft_data(uh60a(), data_files::airfoil("sc1095", 0.002));
        let aircraft = build(&data, false, 9.80665);
        let rotor = aircraft.main();
        let weight = data.mass.gross_mass * 9.80665;
        let disk = PI * rotor.blade.radius.powi(2);
        let ct = weight / (AIR.density * disk * rotor.tip_speed().powi(2));
        // momentum theory, disk along the flight path
        let mut lambda = (ct / 2.0).sqrt();
        for _ in 0..50 {
            lambda = 0.5 * (lambda + ct / (2.0 * mu.hypot(lambda)));
        }
        let mut x = SVector::<f64, UNKNOWNS>::zeros();
        x[UNKNOWNS - 3] = 0.25;
        let mut trimmed = Self { aircraft, mu, lambda, x };
        for _ in 0..30 {
            let (mut rows, mut slopes) = (vec![0.0; UNKNOWNS], vec![0.0; UNKNOWNS * UNKNOWNS]);
            trimmed.equations(trimmed.x.as_slice(), weight, &mut rows);
            dense_jacobian(trimmed.x.as_slice(), |x, f| trimmed.equations(x, weight, f), &mut slopes);
            let matrix = DMatrix::from_row_slice(UNKNOWNS, UNKNOWNS, &slopes);
            let step = matrix.lu().solve(&DVector::from_vec(rows)).unwrap();
            // the kinks of the tables ask for some care
            let scale = (0.5 / step.amax().max(1e-300)).min(1.0);
            trimmed.x -= SVector::<f64, UNKNOWNS>::from_fn(|i, _| scale * step[i]);
            if step.amax() < 1e-9 {
                return trimmed;
            }
        }
        panic!("no periodic motion found");
    }

    fn equations<S: Real>(&self, x: &[S], weight: f64, rows: &mut [S]) {
        let rotor = self.aircraft.main();
        rows.fill(S::zero());
        let inflow = BladeInflow::Disk([S::cst(self.lambda), S::zero(), S::zero()]);
        for l in 0..AZIMUTHS {
            let psi = TAU * l as f64 / AZIMUTHS as f64;
            let (modal, pitch) = motion(x, psi);
            let loads = rotor.blade_loads(AIR, &self.hub(), S::cst(psi), &modal, &pitch, &inflow);
            for i in 0..N {
                let first = i * (1 + 2 * HARMONICS);
                rows[first] += loads.modal[i];
                for k in 1..=HARMONICS {
                    let (s, c) = (k as f64 * psi).sin_cos();
                    rows[first + 2 * k - 1] += loads.modal[i] * c;
                    rows[first + 2 * k] += loads.modal[i] * s;
                }
            }
            rows[UNKNOWNS - 3] += loads.aero_force.z * (4.0 / weight / AZIMUTHS as f64);
        }
        rows[UNKNOWNS - 3] = rows[UNKNOWNS - 3] - 1.0;
        let flap = rotor.blade.flap_mode * (1 + 2 * HARMONICS);
        (rows[UNKNOWNS - 2], rows[UNKNOWNS - 1]) = (x[flap + 1], x[flap + 2]);
    }

    /// d(delta q, delta q_dot)/dt = A (delta q, delta q_dot) at azimuth `psi`.
    fn matrix(&self, psi: f64, damper: bool, pitch_rate_moment: bool) -> SMatrix<f64, 10, 10> {
        let rotor = self.aircraft.main();
        let (at, control) = motion(self.x.as_slice(), psi);
        let motion: [f64; MOTION] = std::array::from_fn(|k| [at.q, at.q_dot, at.q_ddot][k / N][k % N]);
        let mut without = rotor.clone();
        if !damper {
            without.lag_damper = None;
        }
        let mut slopes = [0.0; MOTION * MOTION];
        let rows = |x: &[Direction], f: &mut [Direction]| {
            let part = |first: usize| {
                std::array::from_fn::<Direction, MAX_MODES, _>(|i| {
                    if i < N { x[first + i] } else { Direction::zero() }
                })
            };
            let modal = ModalMotion { q: part(0), q_dot: part(N), q_ddot: part(2 * N) };
            let cst = Direction::cst;
            let pitch = PitchMotion {
                theta: cst(control.theta),
                theta_dot: cst(control.theta_dot),
                theta_ddot: cst(control.theta_ddot),
            };
            let inflow = BladeInflow::Disk([cst(self.lambda), cst(0.0), cst(0.0)]);
            let loads = without.blade_loads(AIR, &self.hub(), cst(psi), &modal, &pitch, &inflow);
            f[..N].copy_from_slice(&loads.modal[..N]);
            if !pitch_rate_moment {
                self.take_pitch_rate_moment_off(psi, &modal, &pitch, f);
            }
        };
        dense_jacobian(&motion, rows, &mut slopes);
        let block = |first: usize| SMatrix::<f64, N, N>::from_fn(|i, j| slopes[i * MOTION + first + j]);
        let inverse = (-block(10)).try_inverse().unwrap();
        let (stiffness, damping) = (inverse * block(0), inverse * block(5));
        SMatrix::from_fn(|i, j| match (i < N, j < N) {
            (true, _) => f64::from(u8::from(j == i + N)),
            (false, true) => stiffness[(i - N, j)],
            (false, false) => damping[(i - N, j - N)],
        })
    }

    /// Adds the work of +(pi/16) rho |U| c^3 (omega t), which the air loads hold with the other sign.
    fn take_pitch_rate_moment_off<S: Real>(
        &self,
        psi: f64,
        modal: &ModalMotion<S>,
        pitch: &PitchMotion<S>,
        rows: &mut [S],
    ) {
        let rotor = self.aircraft.main();
        let (s, c) = psi.sin_cos();
        let forward = self.mu * rotor.tip_speed();
        let velocity = Vec3::cst([-forward * c, forward * s, 0.0]);
        let spin = Vec3::cst([0.0, 0.0, OMEGA]);
        for station in &rotor.blade.stations {
            let g = &station.geometry;
            let m = station.shapes.motion(
                N,
                modal,
                &PitchMotion { theta: pitch.theta + station.twist, ..*pitch },
            );
            let down = Vec3::cst([0.0, 0.0, self.lambda * rotor.tip_speed()]);
            let wind = -(velocity + spin.cross(m.position) + m.velocity + down);
            let rate = (spin + m.omega).dot(m.t);
            let (along, normal) = (wind.dot(m.c), wind.dot(m.n) - rate * g.quarter);
            let speed = (along * along + normal * normal + 1e-12).sqrt();
            let moment = m.t * (rate * speed * (PI / 16.0 * AIR.density * g.chord.powi(3) * g.lift_width));
            for (i, row) in rows.iter_mut().enumerate().take(N) {
                *row += moment.dot(m.test_motion(&station.shapes, i).1);
            }
        }
    }

    /// Absolute values of the multipliers, ascending, with `n` Runge-Kutta steps.
    fn multipliers(&self, n: usize, damper: bool, pitch_rate_moment: bool) -> Vec<f64> {
        let h = TAU / OMEGA / n as f64;
        let a: Vec<_> =
            (0..=2 * n).map(|k| self.matrix(PI * k as f64 / n as f64, damper, pitch_rate_moment)).collect();
        let mut y = SMatrix::<f64, 10, 10>::identity();
        for k in 0..n {
            let k1 = a[2 * k] * y;
            let k2 = a[2 * k + 1] * (y + k1 * (h / 2.0));
            let k3 = a[2 * k + 1] * (y + k2 * (h / 2.0));
            let k4 = a[2 * k + 2] * (y + k3 * h);
            y += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        }
        let mut found: Vec<f64> = y.complex_eigenvalues().iter().map(|m| m.norm()).collect();
        assert!(found.iter().all(|m| m.is_finite()));
        found.sort_by(f64::total_cmp);
        found
    }
}

#[test]
fn floquet_multipliers_lie_inside_the_unit_circle() {
    for mu in [0.0, 0.185] {
        let t = Trimmed::new(mu);
        let [t0, tc, ts] = [3, 2, 1].map(|k| t.x[UNKNOWNS - k].to_degrees());
        println!("mu {mu}: lambda {:.4}, theta_0 {t0:.2}, theta_1c {tc:.2}, theta_1s {ts:.2} deg", t.lambda);
        let found = t.multipliers(400, true, true);
        let fine = t.multipliers(800, true, true);
        println!(
            "    multipliers {fine:.3?}, change by halving the step {:.1e}",
            relative_error(&found, &fine)
        );
        // in forward flight the linear equations jump where a section passes a kink of its tables: first order in the step
        assert!(relative_error(&found, &fine) < 5e-3);
        assert!(fine.iter().all(|m| *m < 1.0), "{fine:?}");
        println!("    without lag damper {:.3?}", t.multipliers(400, false, true));
        let undamped = t.multipliers(400, true, false);
        println!("    without pitch-rate moment {undamped:.3?}");
        // the torsion mode lives on that moment
        assert!(undamped[9] > 1.0);
    }
}
