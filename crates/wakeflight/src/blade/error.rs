//! What can be wrong with the data of a blade, by name.

/// Why a blade has no modes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BladeError {
    /// A number outside what is allowed.
    #[error("blade.{field} = {value}: {allowed}")]
    Value {
        /// Field of the blade's data or argument of the call.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// An entry of a list outside what is allowed.
    #[error("blade.{field}[{index}] = {value}: {allowed}")]
    Entry {
        /// List.
        field: &'static str,
        /// Position in the list.
        index: usize,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Lists of one table differ in length, or are empty.
    #[error("blade.{field} has {found} entries, expected {expected} (at least 1)")]
    Length {
        /// List.
        field: &'static str,
        /// Its entries.
        found: usize,
        /// Entries of the table's first list.
        expected: usize,
    },
    /// The blades of a rotor that turns clockwise.
    #[error("rotor.rotation = cw: only counter-clockwise rotors (ccw) can be simulated")]
    Clockwise,
    /// The structural table leaves part of the blade open.
    #[error("blade.structure leaves {from} m to {to} m open, within root_station..radius")]
    NotCovered {
        /// Inner end of the hole [m].
        from: f64,
        /// Outer end [m].
        to: f64,
    },
    /// More modes than the elements have.
    #[error("{asked} modes asked, {n_elements} elements give {available}")]
    TooManyModes {
        /// Asked for.
        asked: usize,
        /// Elements.
        n_elements: usize,
        /// What these give.
        available: usize,
    },
    /// The straight blade is not in stable equilibrium: the square of a frequency is negative.
    #[error("mode {mode} diverges: frequency squared is {frequency_squared} (rad/s)^2")]
    Diverges {
        /// Number of the mode, from 0.
        mode: usize,
        /// Its eigenvalue [rad^2/s^2].
        frequency_squared: f64,
    },
    /// The eigenvalue solver gave up.
    #[error("eigenvalue problem of the blade not solved: {reason}")]
    NotSolved {
        /// At which step.
        reason: &'static str,
    },
}
