//! Blade pitch from the pilot's sticks.

use serde::Deserialize;

/// Linear rigging: (theta_1c, theta_1s, theta_0, theta_tr) = offset + matrix (lateral, longitudinal, collective, pedal).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rigging {
    /// Rows theta_1c, theta_1s, theta_0, theta_tr [rad/m].
    pub matrix: [[f64; 4]; 4],
    /// Pitch with all sticks at zero [rad].
    pub offset: [f64; 4],
    /// Swashplate phase D: theta = theta_0 + theta_1c cos(psi + D) + theta_1s sin(psi + D) [rad].
    pub phase: f64,
}
