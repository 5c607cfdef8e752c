//! Fuselage forces and moments from tables.

use crate::numerics::tables::Grid;
use serde::Deserialize;

/// Loads over dynamic pressure against angle of attack (rows) and sideslip (columns) [rad]; m2 and m3.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fuselage {
    /// Reference point from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Drag [m2].
    pub drag: Grid,
    /// Lift [m2].
    pub lift: Grid,
    /// Pitching moment [m3].
    pub pitching: Grid,
    /// Side force [m2].
    pub side: Grid,
    /// Rolling moment [m3].
    pub rolling: Grid,
    /// Yawing moment [m3].
    pub yawing: Grid,
}
