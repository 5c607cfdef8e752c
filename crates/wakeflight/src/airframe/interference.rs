//! Rotor wash and fuselage wash on the airframe's parts.

use crate::numerics::tables::{Grid, Table};
use serde::Deserialize;

/// Interference by tables or by constant factors.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Interference {
    /// Tables of wake skew (rows) and longitudinal flapping (columns) [rad], and of fuselage angles [rad].
    Tables {
        /// Rotor wash on the fuselage, forward.
        ekx_fuselage: Grid,
        /// Rotor wash on the fuselage, down.
        ekz_fuselage: Grid,
        /// Rotor wash on stabilator and fin, forward.
        ekx_tail: Grid,
        /// Rotor wash on stabilator and fin, down.
        ekz_tail: Grid,
        /// Fuselage downwash angle at the stabilator [rad] against angle of attack.
        downwash: Table,
        /// Fuselage sidewash angle at fin and tail rotor [rad] against psi = -sideslip.
        sidewash: Table,
        /// Dynamic pressure ratio at the stabilator against angle of attack.
        q_ratio_stabilator: Table,
        /// Dynamic pressure ratio at fin and tail rotor against psi = -sideslip.
        q_ratio_fin: Table,
    },
    /// Downwash = factor times mean induced velocity; no fuselage wash, q ratio one.
    Factors {
        /// At the fuselage.
        fuselage: f64,
        /// At the stabilator.
        stabilator: f64,
    },
}
