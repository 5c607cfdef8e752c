//! An isolated rotor on a stand: hub motion given, pitch controls given or found for thrust, flapping, moments, torque.
//!
//! Unknowns: theta_0, theta_1c, theta_1s, dynamic inflow where that is the model, and per mode the mean and harmonics of
//! its periodic motion. Equations: three of `ControlEquation`, the inflow equations with the loads averaged over a
//! revolution, and every harmonic of the blade equations.

use super::circulation::BladeInstant;
use super::hub::Rotor;
use super::periodic::Harmonics;
use super::swashplate::{PitchHarmonic, PitchSeries};
use crate::blade::aerodynamics::Air;
use crate::blade::kinematics::PitchMotion;
use crate::blade::loads::{BladeInflow, BladeLoads, HubMotion};
use crate::inflow::pitt_peters::{DiskCondition, PittPeters};
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::jacobian::dense_jacobian;
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// Rotor, air and weight on a stand; the hub axes do not turn unless the problem says so.
#[derive(Clone, Debug)]
pub struct Stand {
    /// The rotor; its rigging is not used: pitch is that of the blade at its own azimuth.
    pub rotor: Rotor,
    /// Air.
    pub air: Air,
    /// Gravity, down the shaft [m/s2].
    pub gravity: f64,
    /// Dynamic inflow model.
    pub pitt_peters: PittPeters,
}

/// One equation that a pitch control is found from; loads are means over a revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlEquation {
    /// theta_0 given [rad].
    Collective(f64),
    /// theta_1c given [rad].
    LateralCyclic(f64),
    /// theta_1s given [rad].
    LongitudinalCyclic(f64),
    /// Aerodynamic thrust along the shaft given [N].
    Thrust(f64),
    /// Aerodynamic torque about the shaft given, what the drive must supply [N m].
    Torque(f64),
    /// Cosine of the first flap mode given [rad].
    FlapCosine(f64),
    /// Sine of the first flap mode given [rad].
    FlapSine(f64),
    /// Hub rolling moment given, right side down positive [N m].
    HubRoll(f64),
    /// Hub pitching moment given, nose up positive [N m].
    HubPitch(f64),
}

/// Inflow of the problem.
#[derive(Clone, Debug)]
pub enum StandInflow {
    /// Three states of dynamic inflow, constant over the revolution.
    Dynamic,
    /// lambda held, row-major (n_azimuths, n_stations), positive down; rows as `Rotor::held_inflow` takes them.
    Map(Vec<f64>),
}

/// A steady condition on the stand.
#[derive(Clone, Debug)]
pub struct StandProblem {
    /// Velocity of the hub through the air, hub axes (x aft, y right, z up) [m/s].
    pub velocity: [f64; 3],
    /// Angular velocity of the stand, hub axes [rad/s].
    pub rates: [f64; 3],
    /// What the three pitch controls are found from.
    pub controls: [ControlEquation; 3],
    /// Higher-harmonic pitch.
    pub higher: Vec<PitchHarmonic>,
    /// Harmonics of the blade motion.
    pub n_harmonics: usize,
    /// Azimuths of the averages and projections.
    pub n_azimuths: usize,
    /// Inflow.
    pub inflow: StandInflow,
}

/// Where each unknown lives in x; the rows of the residual are in the same order.
#[derive(Clone, Copy, Debug)]
pub struct StandLayout {
    dynamic_inflow: bool,
    n_modes: usize,
    n_harmonics: usize,
}

impl StandLayout {
    /// Pitch controls theta_0, theta_1c, theta_1s come first.
    pub const N_CONTROLS: usize = 3;

    /// Dynamic inflow lambda_0, lambda_s, lambda_c.
    pub fn inflow(&self) -> usize {
        Self::N_CONTROLS
    }

    /// Blade motion.
    pub fn harmonics(&self) -> Harmonics {
        let start = self.inflow() + if self.dynamic_inflow { 3 } else { 0 };
        Harmonics { start, n_modes: self.n_modes, n_harmonics: self.n_harmonics }
    }

    /// Number of unknowns, never zero.
    #[allow(clippy::len_without_is_empty, reason = "there are always the controls")]
    pub fn len(&self) -> usize {
        self.harmonics().mode(self.n_modes)
    }
}

impl Stand {
    /// Layout of the unknowns.
    pub fn layout(&self, problem: &StandProblem) -> StandLayout {
        StandLayout {
            dynamic_inflow: matches!(problem.inflow, StandInflow::Dynamic),
            n_modes: self.rotor.blade.n_modes,
            n_harmonics: problem.n_harmonics,
        }
    }

    /// Names of the equations.
    pub fn equations(&self, problem: &StandProblem) -> Vec<String> {
        let name = |equation: &ControlEquation| match equation {
            ControlEquation::Collective(_) => "collective",
            ControlEquation::LateralCyclic(_) => "lateral_cyclic",
            ControlEquation::LongitudinalCyclic(_) => "longitudinal_cyclic",
            ControlEquation::Thrust(_) => "thrust",
            ControlEquation::Torque(_) => "torque",
            ControlEquation::FlapCosine(_) => "beta_1c",
            ControlEquation::FlapSine(_) => "beta_1s",
            ControlEquation::HubRoll(_) => "hub_roll",
            ControlEquation::HubPitch(_) => "hub_pitch",
        };
        let mut names: Vec<String> = problem.controls.iter().map(|e| name(e).to_string()).collect();
        let layout = self.layout(problem);
        if layout.dynamic_inflow {
            names.extend(["inflow_0", "inflow_1s", "inflow_1c"].map(String::from));
        }
        names.extend(layout.harmonics().equations());
        names
    }

    /// Motion of the hub, weight included as an acceleration.
    pub fn hub(&self, velocity: [f64; 3], rates: [f64; 3]) -> HubMotion<f64> {
        HubMotion {
            velocity: Vec3::from_array(velocity),
            acceleration_less_gravity: Vec3::from_array([0.0, 0.0, self.gravity]),
            omega: Vec3::from_array(rates),
            omega_dot: Vec3::zero(),
        }
    }

    /// Pitch of the blade at azimuth `psi` for controls theta_0, theta_1c, theta_1s.
    pub fn pitch<S: Real>(&self, controls: [S; 3], higher: &[PitchHarmonic], psi: f64) -> PitchMotion<S> {
        let [theta_0, theta_1c, theta_1s] = controls;
        PitchSeries { theta_0, theta_1c, theta_1s, higher }.at(psi, self.rotor.omega).into()
    }

    /// Blade of the solution `x` at azimuth `psi`.
    pub fn instant(&self, problem: &StandProblem, x: &[f64], psi: f64) -> BladeInstant {
        let modal = self.layout(problem).harmonics().motion(x, psi, self.rotor.omega);
        BladeInstant { psi, modal, control: self.pitch([x[0], x[1], x[2]], &problem.higher, psi) }
    }

    /// Residual: control equations (angles [rad], loads over solidity as coefficients), inflow equilibrium, blade
    /// harmonics as equivalent angles [rad].
    pub fn residual<S: Real>(&self, problem: &StandProblem, x: &[S], f: &mut [S]) {
        let layout = self.layout(problem);
        let hub = self.hub(problem.velocity, problem.rates).constant();
        let controls = [x[0], x[1], x[2]];
        let i = layout.inflow();
        let given = |l: usize, psi: f64| {
            let inflow = match &problem.inflow {
                StandInflow::Dynamic => BladeInflow::Disk([x[i], x[i + 1], x[i + 2]]),
                StandInflow::Map(map) => {
                    let width = map.len() / problem.n_azimuths;
                    self.rotor.held_inflow(&map[l * width..(l + 1) * width])
                }
            };
            (self.pitch(controls, &problem.higher, psi), inflow)
        };
        let mean =
            self.rotor.revolution(self.air, &hub, &layout.harmonics(), x, problem.n_azimuths, given, f);
        for (row, equation) in f.iter_mut().zip(&problem.controls) {
            *row = self.control_residual(equation, &layout, x, &mean);
        }
        if layout.dynamic_inflow {
            let rate = self.inflow_rate(hub.velocity, &mean, [x[i], x[i + 1], x[i + 2]]);
            for k in 0..3 {
                f[i + k] = rate[k] / self.rotor.omega;
            }
        }
    }

    /// Exact Jacobian of the residual, row-major.
    pub fn jacobian(&self, problem: &StandProblem, x: &[f64], out: &mut [f64]) {
        dense_jacobian(x, |x, f| self.residual(problem, x, f), out);
    }

    /// Blade area over disk area.
    pub fn solidity(&self) -> f64 {
        let blade = &self.rotor.blade;
        let area: f64 = blade.stations.iter().map(|s| s.geometry.chord * s.geometry.width).sum();
        self.rotor.n_blades as f64 * area / (PI * blade.radius * blade.radius)
    }

    fn control_residual<S: Real>(
        &self,
        equation: &ControlEquation,
        layout: &StandLayout,
        x: &[S],
        mean: &BladeLoads<S>,
    ) -> S {
        let radius = self.rotor.blade.radius;
        let force_scale =
            self.air.density * PI * radius * radius * self.rotor.tip_speed().powi(2) * self.solidity();
        let moment_scale = force_scale * radius;
        let flap = layout.harmonics().mode(self.rotor.blade.flap_mode);
        let beta = |k: usize| x[flap + k] * self.rotor.flap_per_coordinate();
        match *equation {
            ControlEquation::Collective(value) => x[0] - value,
            ControlEquation::LateralCyclic(value) => x[1] - value,
            ControlEquation::LongitudinalCyclic(value) => x[2] - value,
            ControlEquation::Thrust(value) => (mean.aero_force.z - value) / force_scale,
            ControlEquation::Torque(value) => (-mean.aero_moment.z - value) / moment_scale,
            ControlEquation::FlapCosine(value) => beta(1) - value,
            ControlEquation::FlapSine(value) => beta(2) - value,
            ControlEquation::HubRoll(value) => (-mean.moment.x - value) / moment_scale,
            ControlEquation::HubPitch(value) => (mean.moment.y - value) / moment_scale,
        }
    }

    /// Rate of the dynamic inflow states lambda_0, lambda_s, lambda_c [1/s].
    fn inflow_rate<S: Real>(&self, velocity: Vec3<S, Hub>, mean: &BladeLoads<S>, inflow: [S; 3]) -> [S; 3] {
        let mu = velocity.scaled(1.0 / self.rotor.tip_speed());
        let [ct, cl, cm] = self.rotor.aero_coefficients(self.air, mean.aero_force, mean.aero_moment);
        // the model counts forward and downward speed positive; hub axes point aft and up
        let disk = DiskCondition { ct, cl, cm, mu_x: -mu.x, mu_y: mu.y, mu_z: -mu.z };
        self.pitt_peters.inflow_dot(inflow, disk, self.rotor.omega)
    }
}
