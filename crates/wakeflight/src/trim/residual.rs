//! The trim equations: revolution-averaged balances and loads, periodic blade motion by Galerkin projection.

use super::equation::Equation;
use super::error::ProblemError;
use super::host::{Carried, Head, Host, RotorMean};
use super::layout::Layout;
use super::problem::{Inflow, Problem};
use crate::blade::hub_loads::BladeLoads;
use crate::blade::kinematics::ModalMotion;
use crate::blade::memory_rows::MemoryRows;
use crate::blade::surroundings::BladeInflow;
use crate::inflow::pitt_peters::DiskCondition;
use crate::numerics::scalar::Real;
use crate::rotor::circulation::BladeInstant;
use crate::rotor::periodic::{BladeGiven, Revolution};
use crate::wake::AtParts;
use std::f64::consts::{PI, TAU};

/// A problem on a host.
#[derive(Debug)]
pub struct Trim<'a, H> {
    pub(super) host: &'a H,
    pub(super) problem: &'a Problem,
    /// Layout of its unknowns and equations.
    pub layout: Layout,
}

impl<'a, H: Host> Trim<'a, H> {
    /// Refuses what does not fit together.
    pub fn new(host: &'a H, problem: &'a Problem) -> Result<Self, ProblemError> {
        let layout = Layout::of(host, problem)?;
        if let Inflow::Map { inflow, .. } = &problem.inflow {
            let (n_azimuths, n_stations) = (problem.n_azimuths, host.rotor().blade.stations.len());
            let values = inflow.len();
            let width = values / n_azimuths;
            // thin sections may have two values per station
            let fits = width == n_stations || (width == 2 * n_stations && host.rotor().thin.is_some());
            if !fits || values != width * n_azimuths {
                return Err(ProblemError::Inflow { values, n_azimuths, n_stations });
            }
        }
        Ok(Self { host, problem, layout })
    }

    /// What carries the rotor.
    pub fn host(&self) -> &'a H {
        self.host
    }

    /// Refuses a vector of unknowns of another length.
    pub fn checked<'x>(&self, x: &'x [f64]) -> Result<&'x [f64], ProblemError> {
        let (given, needed) = (x.len(), self.layout.len());
        if given == needed { Ok(x) } else { Err(ProblemError::Unknowns { given, needed }) }
    }

    /// Modal coordinates, rates and accelerations at azimuth `psi` [rad].
    pub fn motion<S: Real>(&self, x: &[S], psi: f64) -> ModalMotion<S> {
        self.layout.harmonics().motion(x, psi, self.host.rotor().omega)
    }

    /// Modal coordinates and rates at `n_azimuths` azimuths of a revolution, row-major (n_azimuths, n_modes).
    pub fn motions(&self, x: &[f64], n_azimuths: usize) -> (Vec<f64>, Vec<f64>) {
        let n = self.host.rotor().blade.n_modes;
        let (mut q, mut q_dot) = (Vec::new(), Vec::new());
        for l in 0..n_azimuths {
            let m = self.motion(x, TAU * l as f64 / n_azimuths as f64);
            q.extend_from_slice(&m.q[..n]);
            q_dot.extend_from_slice(&m.q_dot[..n]);
        }
        (q, q_dot)
    }

    /// Residual of every equation in the units of [`Layout::equations`]; inflow states by their rates over the rotor speed, loads
    /// over solidity as coefficients, blade harmonics as equivalent angles.
    pub fn residual<S: Real>(&self, x: &[S], f: &mut [S]) {
        let head = self.layout.head(x);
        let carried = self.host.carried(&head);
        let pitch = self.host.pitch(head.controls);
        let memory = self.memory(&x.iter().map(|v| v.re()).collect::<Vec<_>>());
        let given = |l: usize, psi: f64| self.given(&head, &pitch, &memory, (l, psi));
        let mean = self.host.rotor().revolution(&self.revolution(&carried, x), given, f);
        self.head_rows(&head, &carried, x, &mean, f);
    }

    /// The same, four azimuths at once; the same bits.
    pub fn residual_of_four(&self, x: &[f64], f: &mut [f64]) {
        let head = self.layout.head(x);
        let carried = self.host.carried(&head);
        let pitch = self.host.pitch(head.controls);
        let memory = self.memory(x);
        let given = |l: usize, psi: f64| self.given(&head, &pitch, &memory, (l, psi));
        let mean = self.host.rotor().revolution_of_four(&self.revolution(&carried, x), given, f);
        self.head_rows(&head, &carried, x, &mean, f);
    }

    pub(super) fn revolution<'s, S: Real>(&self, carried: &'s Carried<S>, x: &'s [S]) -> Revolution<'s, S> {
        Revolution {
            air: self.host.air(),
            hub: &carried.hub,
            harmonics: self.layout.harmonics(),
            x,
            n_azimuths: self.problem.n_azimuths,
        }
    }

    fn given<'s, S: Real>(
        &'s self,
        head: &Head<S>,
        pitch: &[S; 4],
        memory: &'s MemoryRows,
        (l, psi): (usize, f64),
    ) -> BladeGiven<'s, S> {
        let sections = self.host.rotor().sections_in_time(memory.periodic(l));
        (self.host.blade_pitch(pitch, psi), self.inflow(head, l).remembering(sections))
    }

    /// Air of the wake at the parts of the airframe, where it is given.
    pub fn wash(&self) -> Option<AtParts> {
        self.problem.wash
    }

    /// Inflow at azimuth `l`.
    pub(super) fn inflow<S: Real>(&self, head: &Head<S>, l: usize) -> BladeInflow<'a, S> {
        match &self.problem.inflow {
            Inflow::Dynamic => BladeInflow::Disk(head.inflow),
            Inflow::Map { inflow, .. } => self.host.rotor().held_inflow(self.row(inflow, l)),
        }
    }

    /// Memory of the sections of a blade at every azimuth of the motion `x`, which repeats; empty where they do not remember.
    pub fn memory(&self, x: &[f64]) -> MemoryRows {
        let rotor = self.host.rotor();
        if rotor.sections.is_none() {
            return MemoryRows::default();
        }
        let (head, n) = (self.layout.head(x), self.problem.n_azimuths);
        let (pitch, hub) = (self.host.pitch(head.controls), self.host.carried(&head).hub);
        let blades: Vec<BladeInstant> = (0..n)
            .map(|l| {
                let psi = TAU * l as f64 / n as f64;
                let control = self.host.blade_pitch(&pitch, psi);
                BladeInstant { psi, modal: self.motion(x, psi), control }
            })
            .collect();
        let known = (&blades[..], rotor.nominal_step(n));
        rotor.periodic_memory(self.host.air(), &hub, known, |l| self.inflow(&head, l))
    }

    /// Held inflow at azimuth `l`.
    pub(super) fn row<'m>(&self, map: &'m [f64], l: usize) -> &'m [f64] {
        let width = map.len() / self.problem.n_azimuths;
        &map[l * width..(l + 1) * width]
    }

    /// The listed equations and those of the inflow, given the mean loads of all blades.
    pub(super) fn head_rows<S: Real>(
        &self,
        head: &Head<S>,
        carried: &Carried<S>,
        x: &[S],
        mean: &BladeLoads<S>,
        f: &mut [S],
    ) {
        let (layout, rotor) = (&self.layout, self.host.rotor());
        // the first harmonic of the flap mode is what the blades share as beta_1c, beta_1s
        let flap = layout.harmonics().mode(rotor.blade.flap_mode);
        let beta = |k: usize| {
            let known = layout.harmonics().n_harmonics > 0 && rotor.blade.n_modes > 0;
            if known { x[flap + k] * rotor.flap_per_coordinate() } else { S::zero() }
        };
        let inflow = match &self.problem.inflow {
            Inflow::Dynamic => head.inflow[0],
            Inflow::Map { mean, .. } => S::cst(*mean),
        };
        let share = RotorMean { loads: mean, beta_1c: beta(1), inflow, wash: self.problem.wash };
        let balances = self.host.balances(head, carried, &share);
        let pitch = self.host.pitch(head.controls);
        let radius = rotor.blade.radius;
        let force_scale =
            self.host.air().density * PI * radius * radius * rotor.tip_speed().powi(2) * rotor.solidity();
        let moment_scale = force_scale * radius;
        for (row, equation) in f.iter_mut().zip(&self.problem.equations) {
            *row = match (*equation, &balances) {
                (Equation::Force(i), Some(b)) => b.force[i],
                (Equation::Moment(i), Some(b)) => b.moment[i],
                (Equation::Convention(convention), Some(b)) => convention.residual(head, b.velocity),
                (Equation::LoadFactor { load_factor, side }, _) => {
                    let across = head.path.turn_rate * head.path.speed * head.path.flight_path.sin_cos().1;
                    across / self.host.gravity() - side * (load_factor * load_factor - 1.0).max(0.0).sqrt()
                }
                (Equation::Power(value), others) => {
                    let other = others.map_or(S::zero(), |b| b.other_power);
                    (mean.moment.z * -rotor.omega + other - value) / (force_scale * rotor.tip_speed())
                }
                (Equation::Collective(value), _) => pitch[2] - value,
                (Equation::LateralCyclic(value), _) => pitch[0] - value,
                (Equation::LongitudinalCyclic(value), _) => pitch[1] - value,
                (Equation::Thrust(value), _) => (mean.aero_force.z - value) / force_scale,
                (Equation::Torque(value), _) => (-mean.aero_moment.z - value) / moment_scale,
                (Equation::FlapCosine(value), _) => beta(1) - value,
                (Equation::FlapSine(value), _) => beta(2) - value,
                (Equation::HubRoll(value), _) => (-mean.moment.x - value) / moment_scale,
                (Equation::HubPitch(value), _) => (mean.moment.y - value) / moment_scale,
                // a layout on a stand refuses them
                (Equation::Force(_) | Equation::Moment(_) | Equation::Convention(_), None) => S::zero(),
            };
        }
        if layout.has_inflow() {
            let mu = carried.hub.velocity.scaled(1.0 / rotor.tip_speed());
            let [ct, cl, cm] = rotor.aero_coefficients(self.host.air(), mean.aero_force, mean.aero_moment);
            // the model counts forward and downward speed positive; hub axes point aft and up
            let height = self.host.hub_height(carried).map(|z| z / rotor.blade.radius);
            let disk = DiskCondition { ct, cl, cm, mu_x: -mu.x, mu_y: mu.y, mu_z: -mu.z, height };
            let rate = self.host.pitt_peters().inflow_dot(head.inflow, disk, rotor.omega);
            for k in 0..3 {
                f[layout.inflow() + k] = rate[k] / rotor.omega;
            }
        }
        if let (true, Some(b)) = (layout.has_tail_inflow(), &balances) {
            f[layout.tail_inflow()] = b.tail_inflow_rate / rotor.omega;
        }
    }
}
