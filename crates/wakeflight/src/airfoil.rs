//! Section coefficients by angle of attack and Mach number.

use crate::numerics::tables::Grid;
use serde::Deserialize;

/// Tables of one airfoil; rows angle of attack [rad] over -pi..pi, columns Mach number.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Airfoil {
    /// Lift coefficient.
    pub cl: Grid,
    /// Drag coefficient.
    pub cd: Grid,
    /// Moment coefficient about the quarter chord, nose up positive.
    pub cm: Grid,
    /// Added to every drag coefficient.
    pub cd_increment: f64,
}
