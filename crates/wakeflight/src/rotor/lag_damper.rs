//! Hydraulic lag damper: geometry and force.

use crate::numerics::tables::Table;
use serde::Deserialize;

/// Geometry [m, rad] and axial force of the damper; letters as in the aircraft data's drawing.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LagDamper {
    /// Offset a [m].
    pub a: f64,
    /// Offset b [m].
    pub b: f64,
    /// Offset c [m].
    pub c: f64,
    /// Offset d [m].
    pub d: f64,
    /// Pitch-horn radius r [m].
    pub r: f64,
    /// Added to the root pitch [rad].
    pub theta_geo: f64,
    /// Added to the lead angle [rad].
    pub zeta_geo: f64,
    /// Axial force [N] against axial rate [m/s], rates >= 0; the function is odd, held beyond its end.
    pub force: Table,
    /// Hinge spring, neutral at lead = -zeta_geo [N m/rad]; zero when off.
    pub spring_rate: f64,
}
