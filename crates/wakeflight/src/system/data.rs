//! The aircraft as the data describe it: every part optional except rotor, rigging and mass.

use crate::airframe::fuselage::Fuselage;
use crate::airframe::interference::Interference;
use crate::airframe::mass::MassProperties;
use crate::airframe::tail::{StabilatorSchedule, Surface};
use crate::airframe::tail_rotor::TailRotor;
pub use crate::rotor::data::RotorData;
use crate::rotor::swashplate::Rigging;
use serde::Deserialize;

/// Aircraft in SI units and radians; positions from the nominal gross centre of gravity.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AircraftData {
    /// Main rotor.
    pub rotor: RotorData,
    /// Sticks to blade pitch.
    pub rigging: Rigging,
    /// Mass and inertia.
    pub mass: MassProperties,
    /// Fuselage.
    pub fuselage: Option<Fuselage>,
    /// Horizontal tail.
    pub stabilator: Option<Surface>,
    /// Its schedule.
    pub stabilator_schedule: Option<StabilatorSchedule>,
    /// Vertical tail.
    pub fin: Option<Surface>,
    /// Tail rotor.
    pub tail_rotor: Option<TailRotor>,
    /// Rotor and fuselage wash.
    pub interference: Option<Interference>,
    /// Power of accessories [W].
    pub accessory_power: f64,
    /// Rotors with blades beyond the first.
    #[serde(default)]
    pub further_rotors: Vec<RiggedRotor>,
    /// Whether the air loads of airframe and closed-form rotors are those of the mirror image of their data.
    #[serde(default)]
    pub mirrored: bool,
}

/// A rotor with blades and what the sticks do to it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RiggedRotor {
    /// Rotor.
    pub rotor: RotorData,
    /// Sticks to blade pitch.
    pub rigging: Rigging,
}

impl AircraftData {
    /// Rotors with blades, in the order of the list, each with its rigging.
    pub fn rotors(&self) -> impl Iterator<Item = (&RotorData, &Rigging)> {
        let further = self.further_rotors.iter().map(|r| (&r.rotor, &r.rigging));
        std::iter::once((&self.rotor, &self.rigging)).chain(further)
    }
}
