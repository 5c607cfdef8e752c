//! Stabilator and fin.

use crate::numerics::tables::Table;
use serde::Deserialize;

/// A lifting surface with its own tables of local angle [rad].
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Reference point from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Area [m2].
    pub area: f64,
    /// Incidence [rad], nose up (stabilator) or built in (fin); where a schedule exists it replaces this.
    pub incidence: f64,
    /// Lift coefficient.
    pub cl: Table,
    /// Drag coefficient.
    pub cd: Table,
}

/// Incidence of a scheduled stabilator; degrees, knots equivalent airspeed, collective per cent.
///
/// incidence = base - clip(V - v1[0], 0, v1[1]) (coll_const + coll_slope (clip(b[0] - c, 0, b[1]) + clip(b[2] - c, 0, b[3])))
///             + v2[2] clip(V - v2[0], 0, v2[1]) + q_gain q + ay term
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilatorSchedule {
    /// Incidence at low speed [deg].
    pub base_deg: f64,
    /// Start and width of the first speed range [kt].
    pub v1_kt: [f64; 2],
    /// Constant slope [deg/kt].
    pub coll_const: f64,
    /// Slope per per cent of collective.
    pub coll_slope: f64,
    /// Breaks in collective [per cent].
    pub coll_breaks_pct: [f64; 4],
    /// Start [kt], width [kt], slope [deg/kt] of the high speed range.
    pub v2: [f64; 3],
    /// Pitch rate gain [deg per deg/s].
    pub q_gain: f64,
    /// Limits of incidence [rad].
    pub limits: [f64; 2],
    /// Servo rate limit [rad/s].
    pub rate_limit: f64,
}
