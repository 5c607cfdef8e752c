//! Standard atmosphere, and air that moves of its own.
use crate::checks::{Array, Row, Table, columns, invalid, numbers, vectors};
use pyo3::prelude::*;
use wakeflight::atmosphere::Atmosphere;
use wakeflight::numerics::fourier::FourierField;

/// Density [kg/m3], speed of sound [m/s] and kinematic viscosity [m2/s] at an altitude [m] on a standard day.
#[pyfunction]
pub fn standard_atmosphere(altitude: f64) -> PyResult<(f64, f64, f64)> {
    let air = Atmosphere::standard(altitude).map_err(invalid)?;
    Ok((air.density, air.speed_of_sound, air.viscosity))
}

/// Velocity (n, 3) [m/s] at `points` (n, 3) [m] of modes with wave vectors (m, 3) [rad/m], amplitudes (m, 3) [m/s] and phases (m,)
/// [rad].
#[pyfunction]
pub fn fourier_velocity(points: Table, waves: Table, sizes: Table, phases: Row) -> PyResult<Array> {
    let (waves, sizes) = (columns("waves", &waves)?, columns("sizes", &sizes)?);
    if waves.len() != sizes.len() {
        return Err(invalid(format!("sizes of {} modes, {} needed", sizes.len(), waves.len())));
    }
    let field = FourierField::new(&waves, &sizes, numbers("phases", &phases, waves.len())?);
    let points = columns("points", &points)?;
    let mut velocity = vec![[0.0; 3]; points.len()];
    field.at(&points, &mut velocity);
    Ok(vectors(velocity, &[]))
}
