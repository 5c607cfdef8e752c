//! What can go wrong in the wake, in words.

use thiserror::Error;

/// Errors of the free wake.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WakeError {
    /// An option has a value that is not allowed.
    #[error("{field} = {value}: {allowed}")]
    InvalidOption {
        /// Name of the option.
        field: &'static str,
        /// Its value.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// An array has the wrong length.
    #[error("{field} has {found} values, {expected} expected")]
    Shape {
        /// Name of the array.
        field: &'static str,
        /// Length needed.
        expected: usize,
        /// Length given.
        found: usize,
    },
    /// An input is not a finite number.
    #[error("{field} is not finite at index {index}")]
    InputNotFinite {
        /// Name of the array.
        field: &'static str,
        /// First bad entry.
        index: usize,
    },
    /// A marker left the range of numbers, or moved further in one step than the guard allows.
    #[error(
        "wake marker {marker} of filament {filament} moved {displacement} R in one step (limit {limit} R), step {step}"
    )]
    Diverged {
        /// Filament (blade, or azimuth row in relaxation), from 0.
        filament: usize,
        /// Marker, from 0 at the blade.
        marker: usize,
        /// Displacement over the radius; NaN if the position is not finite.
        displacement: f64,
        /// Limit over the radius.
        limit: f64,
        /// Step (time marching) or sweep (relaxation), from 1.
        step: u64,
    },
}

impl WakeError {
    /// Whether the failure is numerical; otherwise the input was at fault.
    pub fn is_numerical(&self) -> bool {
        matches!(self, WakeError::Diverged { .. })
    }
}

/// Checks that every number of `values` is finite.
pub(crate) fn finite(field: &'static str, values: &[f64]) -> Result<(), WakeError> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(WakeError::InputNotFinite { field, index }),
        None => Ok(()),
    }
}

/// Checks the length of an array.
pub(crate) fn length(field: &'static str, found: usize, expected: usize) -> Result<(), WakeError> {
    if found == expected { Ok(()) } else { Err(WakeError::Shape { field, expected, found }) }
}
