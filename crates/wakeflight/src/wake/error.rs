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
    /// Circulation and near wake of a blade do not agree.
    #[error(
        "no circulation found that its near wake allows: blade {blade} at azimuth {azimuth:.1} deg, station {station} at \
         {radius:.3} R, where section and bound circulation differ by {residual:.3e} m2/s (allowed {tolerance:.1e}); \
         circulation there {circulation:.3} m2/s, inflow {inflow:.4} of the tip speed"
    )]
    Circulation {
        /// Blade, or instant where several azimuths of one blade are solved, from 0.
        blade: usize,
        /// Azimuth [deg].
        azimuth: f64,
        /// Station, from 0 at the root.
        station: usize,
        /// Its radius over R.
        radius: f64,
        /// Difference left [m2/s].
        residual: f64,
        /// Difference allowed [m2/s].
        tolerance: f64,
        /// Bound circulation where the search ended [m2/s].
        circulation: f64,
        /// Inflow where the search ended.
        inflow: f64,
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
        matches!(self, WakeError::Diverged { .. } | WakeError::Circulation { .. })
    }
}

/// Checks that every number of `values` is finite.
pub(crate) fn finite(field: &'static str, values: &[f64]) -> Result<(), WakeError> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(WakeError::InputNotFinite { field, index }),
        None => Ok(()),
    }
}

/// Time of a step over that at the nominal speed of the rotor, checked.
pub(crate) fn checked_pace(pace: f64) -> Result<f64, WakeError> {
    if pace.is_finite() && pace > 0.0 {
        return Ok(pace);
    }
    let allowed = "must be finite and above 0".into();
    Err(WakeError::InvalidOption { field: "pace", value: pace.to_string(), allowed })
}

/// Checks the length of an array.
pub(crate) fn length(field: &'static str, found: usize, expected: usize) -> Result<(), WakeError> {
    if found == expected { Ok(()) } else { Err(WakeError::Shape { field, expected, found }) }
}
