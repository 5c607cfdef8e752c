//! Standard atmosphere.
use crate::checks::invalid;
use pyo3::prelude::*;
use wakeflight::atmosphere::Atmosphere;

/// Density [kg/m3], speed of sound [m/s] and kinematic viscosity [m2/s] at an altitude [m] on a standard day.
#[pyfunction]
pub fn standard_atmosphere(altitude: f64) -> PyResult<(f64, f64, f64)> {
    let air = Atmosphere::standard(altitude).map_err(invalid)?;
    Ok((air.density, air.speed_of_sound, air.viscosity))
}
