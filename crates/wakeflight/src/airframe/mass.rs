//! Mass properties of the airframe without its blades.

use serde::Deserialize;

/// Airframe without blades: gross less blades, about its own centre of gravity.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MassProperties {
    /// Gross mass, blades included [kg].
    pub gross_mass: f64,
    /// Inertia of the airframe without blades about its own centre of gravity: Ixx, Iyy, Izz, Ixz [kg m2].
    pub inertia: [f64; 4],
}
