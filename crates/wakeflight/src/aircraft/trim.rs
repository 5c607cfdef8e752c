//! Trim as algebraic equations: revolution-averaged balances, flight path, periodic blade motion by Galerkin projection.
//!
//! Unknowns: four sticks, roll, pitch, heading against the track, dynamic inflow, tail-rotor inflow, and per mode the
//! mean and the first harmonics of its periodic motion. Equations: three force and three moment balances, the lateral
//! convention, the inflow equations with the loads averaged, and every harmonic of the blade equations.

use super::model::{Aircraft, HeldInflow, Inputs};
use super::residual::RotorLoads;
use super::state::Layout;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::loads::{BladeInflow, BladeLoads, HubMotion};
use crate::numerics::frames::{Body, Vec3, quaternion, rot_ib};
use crate::numerics::scalar::Real;
use crate::rotor::periodic::Harmonics;
use crate::rotor::swashplate::PitchSeries;
use serde::{Deserialize, Serialize};

/// What fixes the lateral degree of freedom: bank and sideslip as given, in shares of one equation.
///
/// Sideslip is the angle of the wind in the plane of the nose: atan2(v, u) where the flight is fast and flat, minus the heading
/// against the track where it is slow or steep (u and v then tell of climb and attitude, not of a direction), blended between
/// by the share of the horizontal speed.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Convention {
    /// Bank angle [rad].
    pub bank: f64,
    /// Sideslip, wind from the right positive [rad].
    pub sideslip: f64,
    /// Share of the bank in the equation, the rest is the sideslip's: 1 with the heading free, 0 with the nose on the wind.
    pub bank_share: f64,
}

/// Horizontal speed [m/s] below which a heading tells more than a sideslip.
const SLOW: f64 = 3.0;

/// Inflow in trim.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum TrimInflow {
    /// Dynamic inflow, constant over the revolution.
    Dynamic,
    /// lambda at (azimuth, station), held; and its disk mean.
    Map {
        /// Row-major (n_azimuths, n_stations), positive down.
        inflow: Vec<f64>,
        /// Disk mean.
        mean: f64,
    },
}

/// A steady flight condition to trim for.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct TrimProblem {
    /// True airspeed along the flight path [m/s].
    pub speed: f64,
    /// Flight-path angle, climb positive [rad].
    pub flight_path: f64,
    /// Rate of turn, right positive [rad/s].
    pub turn_rate: f64,
    /// What fixes the lateral degree of freedom.
    pub convention: Convention,
    /// Harmonics of the blade motion.
    pub n_harmonics: usize,
    /// Azimuths of the averages and projections.
    pub n_azimuths: usize,
    /// Inflow.
    pub inflow: TrimInflow,
}

/// What is missing to the lateral convention [rad], for the velocity in body axes [m/s], roll and heading against the track.
fn convention_residual<S: Real>(problem: &TrimProblem, velocity: Vec3<S, Body>, roll: S, yaw: S) -> S {
    let Convention { bank, sideslip, bank_share } = problem.convention;
    let (climb, forward) = problem.flight_path.sin_cos();
    let (rise, along) = (problem.speed * climb, problem.speed * forward);
    let flat = along * along / (along * along + rise * rise + SLOW * SLOW);
    let share = smooth_step(2.0 * flat - 0.5);
    // direction of flight seen from the nose: by the heading, and by the wind
    let (sin, cos) = yaw.sin_cos();
    let (mut ahead, mut right) = (cos, -sin);
    if share > 0.0 {
        ahead += (velocity.x / along - ahead) * share;
        right += (velocity.y / along - right) * share;
    }
    let (s, c) = sideslip.sin_cos();
    let slip = (right * c - ahead * s).atan2(ahead * c + right * s);
    (roll - bank) * bank_share + slip * (1.0 - bank_share)
}

/// 0 up to 0, 1 from 1 on, with continuous slope.
fn smooth_step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Where each unknown lives in x; the rows of the residual are in the same order.
#[derive(Clone, Copy, Debug)]
pub struct TrimLayout {
    n_modes: usize,
    n_harmonics: usize,
    dynamic_inflow: bool,
    tail_rotor: bool,
}

impl TrimLayout {
    /// Roll, pitch, heading against the track start here; sticks are 0..4.
    pub const ATTITUDE: usize = 4;
    /// Start of the inflow unknowns.
    pub fn inflow(&self) -> usize {
        7
    }
    /// Tail-rotor inflow.
    pub fn tail_inflow(&self) -> usize {
        7 + if self.dynamic_inflow { 3 } else { 0 }
    }
    /// Blade motion.
    pub fn harmonics(&self) -> Harmonics {
        Harmonics {
            start: self.tail_inflow() + usize::from(self.tail_rotor),
            n_modes: self.n_modes,
            n_harmonics: self.n_harmonics,
        }
    }
    /// Mean, cosines, sines of mode `i`: 1 + 2 n_harmonics unknowns.
    pub fn mode(&self, i: usize) -> usize {
        self.harmonics().mode(i)
    }
    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.mode(self.n_modes)
    }
    /// Never empty.
    pub fn is_empty(&self) -> bool {
        false
    }
    /// Name of every equation.
    pub fn equations(&self) -> Vec<String> {
        let mut names: Vec<String> =
            ["force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z", "convention"]
                .map(String::from)
                .to_vec();
        if self.dynamic_inflow {
            names.extend(["inflow_0", "inflow_1s", "inflow_1c"].map(String::from));
        }
        if self.tail_rotor {
            names.push("tail_rotor_inflow".into());
        }
        names.extend(self.harmonics().equations());
        names
    }
}

impl Aircraft {
    /// Layout of the trim unknowns.
    pub fn trim_layout(&self, problem: &TrimProblem) -> TrimLayout {
        TrimLayout {
            n_modes: self.layout.n_modes,
            n_harmonics: problem.n_harmonics,
            dynamic_inflow: matches!(problem.inflow, TrimInflow::Dynamic),
            tail_rotor: self.layout.tail_rotor,
        }
    }

    /// Modal coordinate, rate and acceleration at azimuth `psi` from the harmonics in `x`.
    pub fn periodic_motion<S: Real>(&self, layout: &TrimLayout, x: &[S], psi: f64) -> ModalMotion<S> {
        layout.harmonics().motion(x, psi, self.rotor.omega)
    }

    /// Body velocity and rates for attitude unknowns in `x`, as the first six states with the attitude behind them.
    pub fn trim_body_state<S: Real>(&self, problem: &TrimProblem, x: &[S]) -> Vec<S> {
        let a = TrimLayout::ATTITUDE;
        let (roll, pitch, yaw) = (x[a], x[a + 1], x[a + 2]);
        let attitude = quaternion(roll, pitch, yaw);
        let (climb, forward) = problem.flight_path.sin_cos();
        let velocity =
            rot_ib(attitude).transposed() * Vec3::cst([problem.speed * forward, 0.0, -problem.speed * climb]);
        let (sp, cp) = pitch.sin_cos();
        let (sr, cr) = roll.sin_cos();
        let turn = S::cst(problem.turn_rate);
        let mut y = vec![S::zero(); self.layout.len()];
        y[..3].copy_from_slice(&velocity.array());
        y[3..6].copy_from_slice(&[-(turn * sp), turn * cp * sr, turn * cp * cr]);
        y[6..10].copy_from_slice(&attitude);
        y
    }

    /// Stabilator incidence in trim: on its schedule where it has one [rad].
    pub fn trim_stabilator<S: Real>(&self, problem: &TrimProblem, collective: S, pitch_rate: S) -> S {
        self.airframe.trim_incidence(problem.speed, self.air.density, collective, pitch_rate)
    }

    /// Body state with the inflow states of the unknowns in it, and the motion of the hub.
    pub(super) fn trim_hub_state<S: Real>(
        &self,
        problem: &TrimProblem,
        layout: &TrimLayout,
        x: &[S],
    ) -> (Vec<S>, HubMotion<S>) {
        let mut y = self.trim_body_state(problem, x);
        let y_dot = vec![S::zero(); y.len()];
        if layout.dynamic_inflow && self.layout.dynamic_inflow {
            let i = self.layout.inflow().start;
            y[i..i + 3].copy_from_slice(&x[layout.inflow()..layout.inflow() + 3]);
        }
        if layout.tail_rotor {
            y[self.layout.tail_inflow().start] = x[layout.tail_inflow()];
        }
        let hub = self.hub_motion(&y, &y_dot);
        (y, hub)
    }

    /// Residual of the trim equations: m/s2, rad/s2, convention [rad], inflow equilibrium, blade harmonics as equivalent
    /// angles [rad].
    pub fn trim_residual<S: Real>(&self, problem: &TrimProblem, x: &[S], f: &mut [S]) {
        let layout = self.trim_layout(problem);
        let (y, hub) = self.trim_hub_state(problem, &layout, x);
        let pitch = self.rotor.rigging.pitch([x[0], x[1], x[2], x[3]]);
        let given =
            |l: usize, psi: f64| (self.cyclic_pitch(&pitch, psi), self.trim_blade_inflow(problem, &y, l));
        let mean =
            self.rotor.revolution(self.air, &hub, &layout.harmonics(), x, problem.n_azimuths, given, f);
        self.trim_balances(problem, &layout, x, &y, &mean, f);
    }

    /// The same, four azimuths at once; the same bits.
    pub fn trim_residual_of_four(&self, problem: &TrimProblem, x: &[f64], f: &mut [f64]) {
        let layout = self.trim_layout(problem);
        let (y, hub) = self.trim_hub_state(problem, &layout, x);
        let pitch = self.rotor.rigging.pitch([x[0], x[1], x[2], x[3]]);
        let given =
            |l: usize, psi: f64| (self.cyclic_pitch(&pitch, psi), self.trim_blade_inflow(problem, &y, l));
        let harmonics = layout.harmonics();
        let mean = self.rotor.revolution_of_four(self.air, &hub, &harmonics, x, problem.n_azimuths, given, f);
        self.trim_balances(problem, &layout, x, &y, &mean, f);
    }

    /// Averaged balances, lateral convention, inflow equilibrium.
    pub(super) fn trim_balances<S: Real>(
        &self,
        problem: &TrimProblem,
        layout: &TrimLayout,
        x: &[S],
        y: &[S],
        mean: &BladeLoads<S>,
        f: &mut [S],
    ) {
        let rotor = RotorLoads::sum(std::slice::from_ref(mean));
        // the first harmonic of the flap mode is what the blades share as beta_1c
        let flap = layout.mode(self.rotor.blade.flap_mode);
        let beta_1c =
            if layout.n_harmonics > 0 { x[flap + 1] * self.rotor.flap_per_coordinate() } else { S::zero() };
        let mean_inflow = match &problem.inflow {
            TrimInflow::Dynamic => x[layout.inflow()],
            TrimInflow::Map { mean, .. } => S::cst(*mean),
        };
        let tail_inflow = if layout.tail_rotor { x[layout.tail_inflow()] } else { S::zero() };
        let stick = [x[0], x[1], x[2], x[3]];
        let loads = self.trim_airframe_loads(problem, y, &rotor, mean_inflow, beta_1c, stick, tail_inflow);
        let velocity = super::state::body_vector(y, Layout::VELOCITY);
        let rates = super::state::body_vector(y, Layout::RATES);
        let (inertia_force, inertia_moment) = self.airframe.mass.inertial_residual(
            velocity,
            rates,
            Vec3::zero(),
            Vec3::zero(),
            self.gravity_b(y),
        );
        let force = (loads.force + inertia_force).array();
        let moment = (loads.moment + inertia_moment).array();
        for i in 0..3 {
            f[i] = force[i] / self.airframe.gross_mass;
            f[3 + i] = moment[i] / self.airframe.reference_inertia[i];
        }
        let (roll, yaw) = (x[TrimLayout::ATTITUDE], x[TrimLayout::ATTITUDE + 2]);
        f[6] = convention_residual(problem, velocity, roll, yaw);
        if layout.dynamic_inflow {
            let i = layout.inflow();
            let rate = self.inflow_rate(velocity, rates, &rotor, [x[i], x[i + 1], x[i + 2]]);
            for k in 0..3 {
                f[i + k] = rate[k] / self.rotor.omega;
            }
        }
        if layout.tail_rotor {
            f[layout.tail_inflow()] = loads.tail_inflow_rate / self.rotor.omega;
        }
    }

    #[allow(clippy::too_many_arguments, reason = "everything the airframe feels")]
    fn trim_airframe_loads<S: Real>(
        &self,
        problem: &TrimProblem,
        y: &[S],
        rotor: &RotorLoads<S>,
        mean_inflow: S,
        beta_1c: S,
        stick: [S; 4],
        tail_inflow: S,
    ) -> super::residual::AirframeLoads<S> {
        let incidence = self.trim_stabilator(problem, stick[2], y[4]);
        self.loads_on_airframe(
            y,
            rotor,
            mean_inflow,
            beta_1c,
            incidence,
            self.rotor.rigging.pitch(stick)[3],
            tail_inflow,
        )
    }

    /// Blade pitch with exact rates for steady pitch controls (theta_1c, theta_1s, theta_0, theta_tr).
    pub(super) fn cyclic_pitch<S: Real>(&self, pitch: &[S; 4], psi: f64) -> PitchMotion<S> {
        let series = PitchSeries { theta_0: pitch[2], theta_1c: pitch[0], theta_1s: pitch[1], higher: &[] };
        series.at(psi + self.rotor.rigging.phase, self.rotor.omega).into()
    }

    fn trim_blade_inflow<'a, S: Real>(
        &self,
        problem: &'a TrimProblem,
        y: &[S],
        l: usize,
    ) -> BladeInflow<'a, S> {
        match &problem.inflow {
            TrimInflow::Dynamic => {
                let i = self.layout.inflow().start;
                BladeInflow::Disk([y[i], y[i + 1], y[i + 2]])
            }
            TrimInflow::Map { inflow, .. } => {
                let n = self.rotor.blade.stations.len();
                BladeInflow::Stations(&inflow[l * n..(l + 1) * n])
            }
        }
    }

    /// State and its rate at time `t` of the trimmed revolution; body accelerations and attitude rates are left at zero.
    pub fn trim_state(&self, problem: &TrimProblem, x: &[f64], t: f64) -> (Vec<f64>, Vec<f64>) {
        let layout = self.trim_layout(problem);
        let mut y = self.trim_body_state(problem, x);
        let mut y_dot = vec![0.0; y.len()];
        for b in 0..self.rotor.n_blades {
            let m = self.periodic_motion(&layout, x, self.rotor.azimuth(self.rotor.omega * t, b));
            for (k, (q, s)) in self.layout.modal(b).zip(self.layout.modal_rate(b)).enumerate() {
                (y[q], y[s]) = (m.q[k], m.q_dot[k]);
                (y_dot[q], y_dot[s]) = (m.q_dot[k], m.q_ddot[k]);
            }
        }
        if layout.dynamic_inflow && self.layout.dynamic_inflow {
            let i = self.layout.inflow().start;
            y[i..i + 3].copy_from_slice(&x[layout.inflow()..layout.inflow() + 3]);
        }
        if layout.tail_rotor {
            y[self.layout.tail_inflow().start] = x[layout.tail_inflow()];
        }
        (y, y_dot)
    }

    /// Inputs that hold the trim: sticks, stabilator, and the inflow given.
    pub fn trim_inputs(&self, problem: &TrimProblem, x: &[f64], inflow: HeldInflow) -> Inputs {
        let y = self.trim_body_state(problem, x);
        Inputs {
            stick: [x[0], x[1], x[2], x[3]],
            stick_rate: [0.0; 4],
            t_start: 0.0,
            inflow,
            stabilator_incidence: self.trim_stabilator(problem, x[2], y[4]),
        }
    }
}
