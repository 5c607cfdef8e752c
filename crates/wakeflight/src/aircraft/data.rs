//! The aircraft as the data describe it: every part optional except rotor, rigging and mass.

use crate::airfoil::Airfoil;
use crate::airframe::fuselage::Fuselage;
use crate::airframe::interference::Interference;
use crate::airframe::mass::MassProperties;
use crate::airframe::tail::{StabilatorSchedule, Surface};
use crate::airframe::tail_rotor::TailRotor;
use crate::blade::section::BladeProperties;
use crate::rotor::lag_damper::LagDamper;
use crate::rotor::swashplate::Rigging;
use serde::Deserialize;

/// Main rotor.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotorData {
    /// Number of blades.
    pub n_blades: usize,
    /// Rotor speed [rad/s], counter-clockwise seen from above.
    pub omega: f64,
    /// Hub centre from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Shaft tilt forward [rad].
    pub shaft_tilt_forward: f64,
    /// Shaft tilt to the right [rad].
    pub shaft_tilt_lateral: f64,
    /// Fraction of the radius at which lift ends with dynamic inflow (1 with a free wake).
    pub tip_loss_factor: f64,
    /// Blade.
    pub blade: BladeProperties,
    /// Section tables along the whole span.
    pub airfoil: Airfoil,
    /// Lag damper, where the blade has one.
    pub lag_damper: Option<LagDamper>,
}

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
}
