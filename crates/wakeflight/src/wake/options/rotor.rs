//! What a wake takes from its rotor.

use crate::wake::error::WakeError;
use serde::{Deserialize, Serialize};

/// Numbers of the rotor that its wake needs; they have no default.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WakeRotor {
    /// Number of blades.
    pub n_blades: usize,
    /// Rotor radius [m].
    pub radius: f64,
    /// Inner end of the bound vortex [m].
    pub root_cutout: f64,
    /// Distance of the equivalent hinge from the shaft [m].
    pub hinge_offset: f64,
    /// Reference chord of core radii [m].
    pub chord: f64,
    /// Rotor speed relative to the airframe [rad/s].
    pub omega: f64,
}

impl Default for WakeRotor {
    /// A rotor not known yet: no blades, no numbers. No wake accepts it.
    fn default() -> Self {
        let unknown = f64::NAN;
        Self {
            n_blades: 0,
            radius: unknown,
            root_cutout: unknown,
            hinge_offset: unknown,
            chord: unknown,
            omega: unknown,
        }
    }
}

impl WakeRotor {
    /// Checks every number.
    pub(super) fn validate(&self) -> Result<(), WakeError> {
        let refused = |field, value: String, allowed: &str| {
            Err(WakeError::InvalidOption { field, value, allowed: allowed.to_owned() })
        };
        if self.n_blades == 0 {
            return refused("n_blades", self.n_blades.to_string(), "at least 1");
        }
        for (field, value) in [("radius", self.radius), ("chord", self.chord), ("omega", self.omega)] {
            if !(value.is_finite() && value > 0.0) {
                return refused(field, value.to_string(), "positive");
            }
        }
        for (field, value) in [("root_cutout", self.root_cutout), ("hinge_offset", self.hinge_offset)] {
            if !(0.0..self.radius).contains(&value) {
                return refused(field, value.to_string(), "from 0 to less than the radius");
            }
        }
        Ok(())
    }
}
