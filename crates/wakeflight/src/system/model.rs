//! The system, built from its data for one condition.

use super::carrier::{Carrier, Stand};
use super::data::AircraftData;
use super::layout::{Layout, RotorLayout, RotorStates, SpeedStates};
use crate::airfoil::unsteady::Model;
use crate::airframe::assembly::{Airframe, Parts};
use crate::airframe::mass::{BladesAtHub, MassError};
use crate::airframe::tail_rotor::TailRotor;
use crate::blade::aerodynamics::Air;
use crate::blade::error::BladeError;
use crate::blade::model::Discretisation;
use crate::blade::sections_in_time::SectionLaw;
use crate::blade::thin_section::{SectionLift, ThinSection};
use crate::inflow::pitt_peters::PittPeters;
use crate::rotor::data::RotorData;
use crate::rotor::hub::Rotor;
use crate::rotor::swashplate::Rigging;
use serde::Deserialize;
use thiserror::Error;

/// Standard gravity [m/s2].
pub const GRAVITY: f64 = 9.80665;

/// Why a system cannot be built.
#[derive(Debug, Error)]
pub enum SystemError {
    /// A blade's data or discretisation.
    #[error(transparent)]
    Blade(#[from] BladeError),
    /// The mass properties.
    #[error(transparent)]
    Mass(#[from] MassError),
}

/// Everything F needs that does not change in time: a carrier with its list of rotors, and the air.
#[derive(Clone, Debug)]
pub struct System {
    /// Airframe in free flight, or stand.
    pub carrier: Carrier,
    /// Rotors with blades, in the order of the list.
    pub rotors: Vec<Rotor>,
    /// Rotors in closed form, in the order of the list.
    pub closed: Vec<TailRotor>,
    /// Dynamic inflow model.
    pub pitt_peters: PittPeters,
    /// Air at the altitude of the condition.
    pub air: Air,
    /// Gravity [m/s2].
    pub gravity: f64,
    /// Place of flat ground [m], down from where the flight begins; none out of its effect.
    pub ground: Option<f64>,
    /// Layout of y.
    pub layout: Layout,
}

/// Air, weight and discretisation of a condition.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setting {
    /// Air.
    pub air: Air,
    /// Gravity [m/s2].
    pub gravity: f64,
    /// Whether a free wake gives the inflow: the tip loss is off, the inflow states are out of y.
    pub free_wake: bool,
    /// Elements, modes, stations of the blades.
    pub discretisation: Discretisation,
    /// Law of thin sections, whose circulation is that of the wind at three quarters of the chord; none on a lifting line.
    pub lift: Option<SectionLift>,
    /// How sections on a lifting line answer in time.
    pub unsteady: Model,
    /// Whether drag acts along the whole wind of a section.
    pub yawed_drag: bool,
}

impl System {
    /// An aircraft in free flight.
    pub fn aircraft(data: &AircraftData, setting: &Setting) -> Result<Self, SystemError> {
        let rotors =
            data.rotors().map(|(r, rigging)| setting.rotor(r, rigging)).collect::<Result<Vec<_>, _>>()?;
        let blades: Vec<BladesAtHub> = rotors
            .iter()
            .map(|r| BladesAtHub { hub: r.position, mass: r.n_blades as f64 * r.blade.mass })
            .collect();
        let parts = Parts {
            mass: data.mass.clone(),
            fuselage: data.fuselage.clone(),
            stabilator: data.stabilator.clone(),
            stabilator_schedule: data.stabilator_schedule.clone(),
            fin: data.fin.clone(),
            interference: data.interference.clone(),
            mirrored: data.mirrored,
            accessory_power: data.accessory_power,
        };
        let carrier = Carrier::Airframe(Box::new(Airframe::new(parts, &blades)?));
        Ok(Self::assembled(carrier, rotors, data.tail_rotor.iter().cloned().collect(), setting))
    }

    /// Rotors on a stand.
    pub fn on_stand(stand: Stand, rotors: Vec<Rotor>, setting: &Setting) -> Self {
        Self::assembled(Carrier::Stand(stand), rotors, Vec::new(), setting)
    }

    fn assembled(carrier: Carrier, rotors: Vec<Rotor>, closed: Vec<TailRotor>, setting: &Setting) -> Self {
        let states = rotors.iter().enumerate().map(|(i, r)| RotorStates {
            name: if i == 0 { "main".into() } else { format!("{}", i + 1) },
            n_blades: r.n_blades,
            n_modes: r.blade.n_modes,
            dynamic_inflow: !setting.free_wake,
            speed: SpeedStates::Given,
        });
        let tails = closed.iter().map(|_| "tail".to_string()).collect();
        let layout = Layout::new(carrier.airframe().is_some(), states, tails);
        let (air, gravity) = (setting.air, setting.gravity);
        Self {
            carrier,
            rotors,
            closed,
            pitt_peters: PittPeters::default(),
            air,
            gravity,
            ground: None,
            layout,
        }
    }

    /// The first rotor with blades: the main rotor of a helicopter.
    pub fn main(&self) -> &Rotor {
        &self.rotors[0]
    }

    /// Rotors with blades and where their states live.
    pub fn each_rotor(&self) -> impl Iterator<Item = (usize, &Rotor, &RotorLayout)> {
        self.rotors.iter().zip(&self.layout.rotors).enumerate().map(|(i, (r, l))| (i, r, l))
    }
}

impl Setting {
    /// A rotor discretised; lift ends at the tip loss factor of the data unless a free wake finds where it ends.
    pub fn rotor(&self, data: &RotorData, rigging: &Rigging) -> Result<Rotor, BladeError> {
        let tip_loss_factor = if self.free_wake { 1.0 } else { data.tip_loss_factor };
        let mut rotor = Rotor::new(data, rigging.clone(), tip_loss_factor, &self.discretisation)?;
        rotor.thin = self.lift.map(|lift| ThinSection { lift });
        rotor.yawed_drag = self.yawed_drag;
        rotor.sections =
            if self.lift.is_none() { SectionLaw::of(self.unsteady, &rotor.airfoils) } else { None };
        Ok(rotor)
    }
}
