//! The aircraft, built from its data for one condition.

use super::data::AircraftData;
use super::state::Layout;
use crate::airframe::assembly::{Airframe, Parts};
use crate::airframe::mass::MassError;
use crate::blade::aerodynamics::Air;
use crate::blade::error::BladeError;
use crate::blade::kinematics::PitchMotion;
use crate::blade::model::Discretisation;
use crate::inflow::pitt_peters::PittPeters;
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Standard gravity [m/s2].
pub const GRAVITY: f64 = 9.80665;

/// Why an aircraft cannot be built.
#[derive(Debug, Error)]
pub enum AircraftError {
    /// The blade's data or discretisation.
    #[error(transparent)]
    Blade(#[from] BladeError),
    /// The mass properties.
    #[error(transparent)]
    Mass(#[from] MassError),
}

/// Everything F needs that does not change in flight.
#[derive(Clone, Debug)]
pub struct Aircraft {
    /// Main rotor.
    pub rotor: Rotor,
    /// Airframe.
    pub airframe: Airframe,
    /// Dynamic inflow model.
    pub pitt_peters: PittPeters,
    /// Air at the altitude of the condition.
    pub air: Air,
    /// Gravity [m/s2].
    pub gravity: f64,
    /// Layout of y.
    pub layout: Layout,
}

/// Inflow of the main rotor held over a coupling step.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum HeldInflow {
    /// The three states of y.
    Dynamic,
    /// Station by station, blade after blade (n_blades x n_stations), and the disk mean.
    Stations {
        /// lambda at every station, positive down.
        inflow: Vec<f64>,
        /// Disk mean.
        mean: f64,
    },
    /// No air.
    Vacuum,
}

/// What acts on the aircraft over one coupling step.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Inputs {
    /// Sticks at `t_start`: lateral, longitudinal, collective, pedal [m from the stop].
    pub stick: [f64; 4],
    /// Their rates [m/s].
    pub stick_rate: [f64; 4],
    /// Start of the step [s].
    pub t_start: f64,
    /// Main-rotor inflow.
    pub inflow: HeldInflow,
    /// Stabilator incidence [rad].
    pub stabilator_incidence: f64,
}

impl Inputs {
    /// Sticks at time `t` [m].
    pub fn stick_at(&self, t: f64) -> [f64; 4] {
        std::array::from_fn(|i| self.stick[i] + self.stick_rate[i] * (t - self.t_start))
    }
}

impl Aircraft {
    /// Build from data; `free_wake` switches the tip loss off and the inflow states out of y.
    pub fn new(
        data: &AircraftData,
        air: Air,
        discretisation: &Discretisation,
        free_wake: bool,
        gravity: f64,
    ) -> Result<Self, AircraftError> {
        let r = &data.rotor;
        let tip_loss_factor = if free_wake { 1.0 } else { r.tip_loss_factor };
        let rotor = Rotor::new(r, data.rigging.clone(), tip_loss_factor, discretisation)?;
        let layout = Layout {
            n_blades: r.n_blades,
            n_modes: rotor.blade.n_modes,
            dynamic_inflow: !free_wake,
            tail_rotor: data.tail_rotor.is_some(),
        };
        let parts = Parts {
            mass: data.mass.clone(),
            fuselage: data.fuselage.clone(),
            stabilator: data.stabilator.clone(),
            stabilator_schedule: data.stabilator_schedule.clone(),
            fin: data.fin.clone(),
            tail_rotor: data.tail_rotor.clone(),
            interference: data.interference.clone(),
            accessory_power: data.accessory_power,
        };
        let airframe = Airframe::new(parts, r.position, r.n_blades, rotor.blade.mass)?;
        Ok(Self { rotor, airframe, pitt_peters: PittPeters::default(), air, gravity, layout })
    }

    /// Blade pitch from the swashplate at azimuth `psi` and time `t`, with exact rates.
    #[inline(always)]
    pub fn blade_pitch<S: Real>(&self, inputs: &Inputs, t: f64, psi: f64) -> PitchMotion<S> {
        let p = self.rotor.rigging.blade_pitch(inputs.stick_at(t), inputs.stick_rate, psi, self.rotor.omega);
        PitchMotion {
            theta: S::cst(p.theta),
            theta_dot: S::cst(p.theta_dot),
            theta_ddot: S::cst(p.theta_ddot),
        }
    }
}
