//! Air that moves of its own, and the places of an aircraft that feel it: conversions and checks.

use crate::checks::{Array, Row, Table, array, columns, invalid, numbers, vectors};
use crate::system::PySystem;
use pyo3::prelude::*;
use wakeflight::numerics::fourier::FourierField;
use wakeflight::wind::kinds::{GustFront, Kind, Wind};
use wakeflight::wind::places::{Air, Places};

/// A wind in closed form; see `wakeflight.wind`.
#[pyclass(name = "Wind", frozen)]
pub struct PyWind(Wind);

#[pymethods]
impl PyWind {
    /// The same everywhere and always [m/s].
    #[staticmethod]
    fn steady(velocity: [f64; 3]) -> Self {
        Self(Kind::Steady(velocity).into())
    }

    /// A gust that begins `ahead` [m] along a unit vector; `falls`: again over the other half of its length [m].
    #[staticmethod]
    fn gust(along: [f64; 3], ahead: f64, length: f64, falls: bool, velocity: [f64; 3]) -> Self {
        Self(Kind::Gust(GustFront { along, ahead, length, falls, velocity }).into())
    }

    /// Modes with wave vectors (m, 3) [rad/m], amplitudes (m, 3) [m/s] and phases (m,) [rad].
    #[staticmethod]
    fn waves(vectors: Table, sizes: Table, phases: Row) -> PyResult<Self> {
        let (vectors, sizes) = (columns("vectors", &vectors)?, columns("sizes", &sizes)?);
        if vectors.len() != sizes.len() {
            return Err(invalid(format!("sizes of {} modes, {} needed", sizes.len(), vectors.len())));
        }
        let phases = numbers("phases", &phases, vectors.len())?;
        Ok(Self(Kind::Waves(FourierField::new(&vectors, &sizes, phases)).into()))
    }

    /// All of them at once; steady ones carry along what is frozen.
    #[staticmethod]
    fn sum(parts: Vec<PyRef<Self>>) -> Self {
        Self(Wind::sum(parts.iter().map(|part| &part.0)))
    }

    /// Velocities (n, 3) [m/s] at `points` (n, 3) [m] and time `t` [s].
    fn at(&self, points: Table, t: f64) -> PyResult<Array> {
        Ok(vectors(self.0.at(&columns("points", &points)?, t), &[]))
    }
}

/// A wind where an aircraft is; see `wakeflight.wind`.
#[pyclass(name = "Air", frozen)]
pub struct PyAir {
    pub(crate) inner: Air,
    /// Stations of a blade.
    pub(crate) n_stations: usize,
}

#[pymethods]
impl PyAir {
    /// The same everywhere [m/s].
    #[new]
    fn new(velocity: [f64; 3]) -> Self {
        Self { inner: Air::uniform(velocity), n_stations: 0 }
    }

    /// At the origin of the body (3,) [m/s], inertial axes.
    #[getter]
    fn origin(&self) -> Array {
        array(self.inner.origin, &[])
    }

    /// At the hub of the main rotor (3,) [m/s], inertial axes.
    #[getter]
    fn at_hub(&self) -> Array {
        array(self.inner.at_hub, &[])
    }

    /// Rates at which it turns about the airframe (3,) [rad/s], body axes.
    #[getter]
    fn turn(&self) -> Array {
        array(self.inner.turn, &[])
    }

    /// Along the shaft at the stations less that at the hub, as inflow, positive down (n_blades, n_stations); None where the air is
    /// the same everywhere.
    #[getter]
    fn stations(&self) -> Option<Array> {
        let stations = self.inner.stations.as_ref()?;
        Some(array(stations.clone(), &[stations.len() / self.n_stations.max(1)]))
    }

    /// Largest component anywhere [m/s]; not a number where one is none.
    #[getter]
    fn largest(&self) -> f64 {
        self.inner.largest
    }

    /// Velocity against it in the states `y` [m/s], body axes.
    fn against(&self, y: Row) -> PyResult<(f64, f64, f64)> {
        Ok(self.inner.against(airframe(&y)?).into())
    }

    /// States with the velocity against it in place of that over ground.
    fn passing(&self, y: Row) -> PyResult<Array> {
        let mut passing = airframe(&y)?.to_vec();
        let against = self.inner.against(&passing);
        passing[..3].copy_from_slice(&against);
        Ok(array(passing, &[]))
    }
}

/// States of an airframe.
pub(crate) fn airframe<'a>(y: &'a Row<'_>) -> PyResult<&'a [f64]> {
    let values = y.as_slice()?;
    if values.len() < 13 {
        Err(invalid(format!("y has {} numbers, 13 needed", values.len())))
    } else {
        Ok(values)
    }
}

/// The places of an aircraft that feel a wind; see `wakeflight.wind`.
#[pyclass(name = "WindPlaces", frozen)]
pub struct PyPlaces(Places);

#[pymethods]
impl PyPlaces {
    /// Of an aircraft with something at `behind` [m], body axes, that feels gradients.
    #[new]
    fn new(system: &PySystem, behind: [f64; 3]) -> Self {
        Self(Places::of(system.inner.main(), behind))
    }

    /// Origin, hub, tail, and the stations blade by blade (3 + n, 3) [m], inertial axes, `ahead` [s] of the states `y`, the first
    /// blade then at `azimuth` [rad].
    fn points(&self, y: Row, azimuth: f64, ahead: f64) -> PyResult<Array> {
        Ok(vectors(self.0.spread(airframe(&y)?, azimuth, ahead).points().collect(), &[]))
    }

    /// What is felt at the states `y` of velocities that were `found` at the points (3 + n, 3) [m/s].
    fn felt(&self, y: Row, found: Table) -> PyResult<PyAir> {
        let found = columns("wind", &found)?;
        if found.len() < 3 {
            return Err(invalid(format!("wind at {} places, 3 needed at least", found.len())));
        }
        Ok(PyAir { inner: self.0.felt(airframe(&y)?, &found), n_stations: self.0.n_stations() })
    }

    /// The same of a `wind` in closed form at time `t` [s].
    fn blown(&self, wind: &PyWind, t: f64, y: Row, azimuth: f64, ahead: f64) -> PyResult<PyAir> {
        let y = airframe(&y)?;
        let found = wind.0.over(&self.0.spread(y, azimuth, ahead), t);
        Ok(PyAir { inner: self.0.felt(y, &found), n_stations: self.0.n_stations() })
    }
}
