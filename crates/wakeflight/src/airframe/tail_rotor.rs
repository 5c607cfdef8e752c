//! Tail rotor: closed-form thrust with its own inflow.

use serde::Deserialize;

/// Tail rotor properties, SI and radians.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TailRotor {
    /// Hub from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Radius [m].
    pub radius: f64,
    /// Rotor speed [rad/s].
    pub omega: f64,
    /// Solidity.
    pub solidity: f64,
    /// Cant: thrust along (0, cos, -sin) in body axes [rad].
    pub cant: f64,
    /// Twist, root to tip [rad].
    pub twist: f64,
    /// Lift curve slope [1/rad].
    pub lift_curve_slope: f64,
    /// Tip loss factor B.
    pub tip_loss_factor: f64,
    /// Pitch bias [rad].
    pub pitch_bias: f64,
    /// Pitch lost per newton of thrust by coning and delta3 [rad/N]; zero where the data have no coning.
    pub pitch_per_thrust: f64,
    /// Drag polar: d0 + d1 alpha + d2 alpha^2.
    pub cd_polar: [f64; 3],
    /// Thrust factor at rest, thrust factor at and beyond the speed, and that speed [m/s]; quadratic between.
    pub fin_blockage: [f64; 3],
}
