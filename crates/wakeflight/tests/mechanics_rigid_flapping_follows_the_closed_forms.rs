//! Coning and first-harmonic flapping of a rigid untwisted blade with lift slope 2 pi, against the closed forms of small
//! angles, in hover with hinge offset and in forward flight with a central hinge; the rest shrinks with the angles.

mod mechanics_support;

use mechanics_support::beam_support::uniform;
use mechanics_support::*;
use nalgebra::{Complex, SMatrix, SVector};
use std::f64::consts::TAU;
use wakeflight::airfoil::span::StationAirfoils;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::aerodynamics::Air;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::blade::model::{Blade, Discretisation};
use wakeflight::blade::section::Root;
use wakeflight::blade::surroundings::{BladeEnvironment, BladeInflow};
use wakeflight::numerics::frames::Vec3;
use wakeflight::numerics::scalar::{Dual, Real};

const RADIUS: f64 = 8.0;

struct Case {
    hinge: f64,
    cutout: f64,
    chord: f64,
    lock: f64,
    /// Speed over tip speed, along the disk.
    mu: f64,
    /// theta_0, theta_1c, theta_1s, lambda.
    controls: [f64; 4],
}

impl Case {
    fn blade(&self) -> Blade {
        let mut p = uniform(Root::Hinged, self.hinge, RADIUS, 1e9, 1e9);
        p.structure.gj = vec![1e9];
        p.control_stiffness = 1e9;
        p.chord.y = vec![self.chord];
        p.root_cutout = self.cutout;
        let d =
            Discretisation { n_elements: 4, n_modes: 2, n_gauss: 8, n_stations: 400, reference_pitch: 0.0 };
        Blade::new(&p, OMEGA, 1.0, &d).unwrap()
    }
    /// Flap inertia of 1 kg/m about the hinge.
    fn inertia(&self) -> f64 {
        (RADIUS - self.hinge).powi(3) / 3.0
    }
    /// rho c a/2 that gives the Lock number, as density: the chord is free.
    fn density(&self) -> f64 {
        self.lock * self.inertia() / (TAU * self.chord * RADIUS.powi(4))
    }
    fn scaled(&self, k: f64) -> Self {
        Self { controls: self.controls.map(|c| k * c), ..*self }
    }

    /// beta_0, beta_1c, beta_1s by Newton on the mean and first harmonics of the flap equation, lag held.
    fn flapping(&self) -> [f64; 3] {
        type D = Dual<3>;
        let blade = self.blade();
        let airfoils = StationAirfoils::uniform(smooth_airfoil(TAU, 0.0, 0.0, 0.0), blade.stations.len());
        let air = Air { density: self.density(), speed_of_sound: 340.0 };
        let environment =
            BladeEnvironment { airfoils: &airfoils, air, rotor_speed: OMEGA, yawed_drag: false };
        let mut hub = hub_at_rest::<D>();
        hub.velocity = Vec3::cst([-self.mu * OMEGA * RADIUS, 0.0, 0.0]);
        let flap = blade.flap_mode;
        assert!(blade.modes.shares[flap].flap > 0.9999);
        let per_angle = (RADIUS - self.hinge) / blade.tip.w[0][flap];
        let mut x = SVector::<f64, 3>::zeros();
        let [t0, tc, ts, lambda] = self.controls;
        for _ in 0..6 {
            let mut rows = [D::zero(); 3];
            let v: [D; 3] = std::array::from_fn(|i| D::variable(x[i], i));
            for l in 0..24 {
                let psi = TAU * f64::from(l) / 24.0;
                let (s, c) = psi.sin_cos();
                let mut modal = modal_at([D::zero(); MAX_MODES]);
                modal.q[flap] = (v[0] + v[1] * c + v[2] * s) * per_angle;
                modal.q_dot[flap] = (v[2] * c - v[1] * s) * (OMEGA * per_angle);
                modal.q_ddot[flap] = -(v[1] * c + v[2] * s) * (OMEGA * OMEGA * per_angle);
                let cyclic = tc * c + ts * s;
                let control = PitchMotion {
                    theta: D::cst(t0 + cyclic),
                    theta_dot: D::cst(OMEGA * (ts * c - tc * s)),
                    theta_ddot: D::cst(-OMEGA * OMEGA * cyclic),
                };
                let inflow = BladeInflow::Disk([D::cst(lambda), D::zero(), D::zero()]);
                let f = Self::flap_residual(&blade, &environment, &hub, psi, &modal, &control, &inflow);
                rows[0] += f;
                rows[1] += f * c;
                rows[2] += f * s;
            }
            let matrix = SMatrix::<f64, 3, 3>::from_fn(|i, j| rows[i].eps[j]);
            x -= matrix.lu().solve(&SVector::<f64, 3>::from_fn(|i, _| rows[i].re)).unwrap();
        }
        x.into()
    }

    fn flap_residual(
        blade: &Blade,
        environment: &BladeEnvironment,
        hub: &HubMotion<Dual<3>>,
        psi: f64,
        modal: &ModalMotion<Dual<3>>,
        control: &PitchMotion<Dual<3>>,
        inflow: &BladeInflow<Dual<3>>,
    ) -> Dual<3> {
        blade.loads(environment, hub, Dual::cst(psi), modal, control, inflow).modal[blade.flap_mode]
    }

    /// Hover: (K - I) b + k i D b - k c/2 J1 b = k (theta J2 + i c/2 theta J1), per Omega^2, with
    /// J_n = int r^n (r - e) dr, D = int r (r - e)^2 dr, K = I (1 + 3 e/(2 (R - e))); the chord terms are the pitch
    /// rate at three quarters of the chord.
    fn closed_form_hover(&self) -> [f64; 3] {
        let (e, from) = (self.hinge, self.cutout);
        let power = |n: i32| (RADIUS.powi(n + 1) - from.powi(n + 1)) / f64::from(n + 1);
        let j = |n: i32| power(n + 1) - e * power(n);
        let damping = power(3) - 2.0 * e * power(2) + e * e * power(1);
        let k = 0.5 * self.density() * self.chord * TAU;
        let stiffness = self.inertia() * (1.0 + 1.5 * e / (RADIUS - e));
        let half = 0.5 * self.chord;
        let [t0, tc, ts, lambda] = self.controls;
        let cone = k * (t0 * j(2) - lambda * RADIUS * j(1)) / (stiffness - k * half * j(1));
        let theta = Complex::new(tc, -ts);
        let i = Complex::i();
        let beta = theta * (Complex::from(j(2)) + i * half * j(1)) * k
            / (Complex::from(stiffness - self.inertia() - k * half * j(1)) + i * k * damping);
        [cone, beta.re, -beta.im]
    }

    /// Forward flight with a central hinge, no reversed flow outboard of the cutout, chord term neglected; A_n = int x^n dx.
    fn closed_form_forward(&self) -> [f64; 3] {
        let x0 = self.cutout / RADIUS;
        let a = |n: i32| (1.0 - x0.powi(n + 1)) / f64::from(n + 1);
        let ([t0, tc, ts, lambda], mu) = (self.controls, self.mu);
        let cone = 0.5 * self.lock * (t0 * (a(3) + mu * mu * a(1) / 2.0) + (ts * mu - lambda) * a(2));
        let quarter = mu * mu * a(1) / 4.0;
        let cosine =
            -(ts * (a(3) + 3.0 * quarter) + 2.0 * mu * a(2) * t0 - lambda * mu * a(1)) / (a(3) - quarter);
        let sine = tc - cone * mu * a(2) / (a(3) + quarter);
        [cone, cosine, sine]
    }
}

/// Largest errors with full and with a quarter of the controls.
fn errors(case: &Case, closed: impl Fn(&Case) -> [f64; 3]) -> [f64; 2] {
    [1.0, 0.25].map(|k| {
        let case = case.scaled(k);
        let (found, expected) = (case.flapping(), closed(&case));
        let degrees = |x: [f64; 3]| x.map(f64::to_degrees);
        println!("    found {:.4?} closed form {:.4?} deg", degrees(found), degrees(expected));
        relative_error(&found, &expected)
    })
}

#[test]
fn hover_flapping_with_hinge_offset_follows_the_closed_form() {
    for hinge in [0.0, 0.4, 1.2] {
        let case =
            Case { hinge, cutout: 1.3, chord: 0.5, lock: 8.0, mu: 0.0, controls: [0.08, 0.02, -0.03, 0.03] };
        let e = errors(&case, Case::closed_form_hover);
        println!("hinge at {hinge} m: {:.2e}, with a quarter of the controls {:.2e}", e[0], e[1]);
        assert!(e[0] < 0.01 && e[1] < 0.0005, "{e:?}");
        // only the square of the angles is left
        assert!(e[1] < e[0] / 8.0, "{e:?}");
    }
}

#[test]
fn the_tip_path_plane_follows_the_swashplate_ninety_degrees_later() {
    // with a central hinge the pitch rate over the chord cancels: cyclic and flapping are the same motion
    for chord in [0.5, 0.05] {
        let controls = [0.0, 0.02, 0.0, 0.0];
        let case = Case { hinge: 0.0, cutout: 0.1, chord, lock: 8.0, mu: 0.0, controls };
        let [_, cosine, sine] = case.flapping();
        let late = sine.atan2(cosine).to_degrees();
        println!("chord {chord} m: {late:.3} deg later, gain {:.5}", sine.hypot(cosine) / 0.02);
        assert!((late - 90.0).abs() < 0.05);
        assert!((sine.hypot(cosine) / 0.02 - 1.0).abs() < 1e-4);
    }
}

#[test]
fn forward_flapping_follows_the_closed_form() {
    for mu in [0.1, 0.15] {
        let case = Case {
            hinge: 0.0,
            cutout: 0.2 * RADIUS,
            chord: 0.0005,
            lock: 8.0,
            mu,
            controls: [0.1, 0.02, -0.03, 0.03],
        };
        let e = errors(&case, Case::closed_form_forward);
        println!("mu {mu}: {:.2e}, with a quarter of the controls {:.2e}", e[0], e[1]);
        assert!(e[0] < 0.01 && e[1] < 0.0005, "{e:?}");
        assert!(e[1] < e[0] / 5.0, "{e:?}");
    }
}
