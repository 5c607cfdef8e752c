//! A rotor as the data describe it.

use crate::airfoil::span::SpanSections;
use crate::blade::section::BladeProperties;
use crate::rotor::lag_damper::LagDamper;
use crate::rotor::sense::Sense;
use serde::Deserialize;

/// Main rotor.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotorData {
    /// Number of blades.
    pub n_blades: usize,
    /// Rotor speed [rad/s], positive in the sense of `rotation`.
    pub omega: f64,
    /// Sense of rotation; counter-clockwise where none is given.
    #[serde(default)]
    pub rotation: Sense,
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
    /// Section tables along the span.
    pub airfoil: SpanSections,
    /// Lag damper, where the blade has one.
    pub lag_damper: Option<LagDamper>,
}
