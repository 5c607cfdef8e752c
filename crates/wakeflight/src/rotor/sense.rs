//! Sense of rotation of a rotor.

use serde::Deserialize;

/// Way a rotor turns, seen against its thrust (a main rotor from above).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Sense {
    /// Counter-clockwise: the blade on the right advances.
    #[default]
    #[serde(rename = "ccw")]
    CounterClockwise,
    /// Clockwise: the blade on the left advances.
    #[serde(rename = "cw")]
    Clockwise,
}
