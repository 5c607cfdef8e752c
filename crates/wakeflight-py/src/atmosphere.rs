//! Standard atmosphere.
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use wakeflight::atmosphere::Atmosphere;

/// Density [kg/m3], speed of sound [m/s] and kinematic viscosity [m2/s] at an altitude [m] on a standard day.
#[pyfunction]
pub fn standard_atmosphere(altitude: f64) -> PyResult<(f64, f64, f64)> {
    let air = Atmosphere::standard(altitude).map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok((air.density, air.speed_of_sound, air.viscosity))
}

/// Registers the functions of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(standard_atmosphere, m)?)
}
