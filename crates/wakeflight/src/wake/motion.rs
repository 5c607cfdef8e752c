//! Motion of the hub and of a blade, as the wake needs them.

use super::choices::FarWake;
use super::error::{WakeError, finite};
use super::options::WakeOptions;
use serde::{Deserialize, Serialize};

/// Motion of the hub, components along `_h`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct HubMotion {
    /// Velocity of the hub through the air [m/s].
    pub velocity: [f64; 3],
    /// Angular velocity of the airframe [rad/s].
    pub rates: [f64; 3],
}

impl HubMotion {
    /// Motion as the free filaments feel it: without rates where the options leave them out.
    pub(crate) fn felt(self, options: &WakeOptions) -> Self {
        if options.rates { self } else { HubMotion { rates: [0.0; 3], ..self } }
    }

    /// Velocity of the air relative to the hub axes at `point` without induction: -velocity - rates x point [m/s].
    pub fn wind(&self, point: [f64; 3]) -> [f64; 3] {
        let (v, w, r) = (self.velocity, self.rates, point);
        [
            -v[0] - (w[1] * r[2] - w[2] * r[1]),
            -v[1] - (w[2] * r[0] - w[0] * r[2]),
            -v[2] - (w[0] * r[1] - w[1] * r[0]),
        ]
    }

    /// Refuses components that are not finite, and a wind across a far wake that is a cylinder.
    pub(crate) fn validate(&self, options: &WakeOptions) -> Result<(), WakeError> {
        finite("hub velocity", &self.velocity)?;
        finite("hub rates", &self.rates)?;
        let across = self.velocity[0].hypot(self.velocity[1]) / options.tip_speed();
        if options.far_wake == FarWake::Cylinder && (across > 0.01 || self.velocity[2] < 0.0) {
            return Err(WakeError::InvalidOption {
                field: "far_wake",
                value: "cylinder".into(),
                allowed: "in hover and climb only, repeat elsewhere".into(),
            });
        }
        Ok(())
    }
}

/// Azimuth of a blade and its equivalent rigid angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct BladeState {
    /// Azimuth [rad], zero aft, positive in the direction of rotation (toward +y).
    pub psi: f64,
    /// Flap [rad], up positive.
    pub flap: f64,
    /// Lead [rad], forward positive.
    pub lead: f64,
}

impl BladeState {
    /// Refuses angles that are not finite.
    pub(crate) fn validate(&self) -> Result<(), WakeError> {
        finite("blade psi, flap, lead", &[self.psi, self.flap, self.lead])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nose_up_rate_blows_from_below_behind_the_hub() {
        // q > 0 is a rotation about +y (right): relative wind up at x > 0 (aft); roll right, p > 0, is about -x
        let pitch = HubMotion { velocity: [0.0; 3], rates: [0.0, 0.1, 0.0] };
        assert!(pitch.wind([5.0, 0.0, 0.0])[2] > 0.0);
        let roll = HubMotion { velocity: [0.0; 3], rates: [-0.1, 0.0, 0.0] };
        assert!(roll.wind([0.0, 5.0, 0.0])[2] > 0.0);
    }
}
