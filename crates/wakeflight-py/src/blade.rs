//! Blade modes for Python.

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use wakeflight::blade::modes::{BladeModes, ShapesAt};
use wakeflight::blade::section::BladeProperties;

/// Natural modes of the rotating blade; see `wakeflight::blade::modes::BladeModes`.
#[pyclass(name = "BladeModes", frozen, module = "wakeflight._core")]
pub struct PyBladeModes {
    modes: BladeModes,
}

fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pymethods]
impl PyBladeModes {
    /// Modes of the blade described by `properties_json` (SI) at rotor speed [rad/s] and root pitch [rad].
    #[new]
    fn new(
        py: Python<'_>,
        properties_json: &str,
        omega: f64,
        reference_pitch: f64,
        n_elements: usize,
        n_modes: usize,
    ) -> PyResult<Self> {
        let properties: BladeProperties = serde_json::from_str(properties_json).map_err(refused)?;
        let modes = py
            .detach(|| BladeModes::new(&properties, omega, reference_pitch, n_elements, n_modes))
            .map_err(refused)?;
        Ok(Self { modes })
    }

    /// Number of modes.
    #[getter]
    fn n_modes(&self) -> usize {
        self.modes.n_modes
    }

    /// Rotor speed [rad/s].
    #[getter]
    fn omega(&self) -> f64 {
        self.modes.omega
    }

    /// Root pitch of the eigenproblem [rad].
    #[getter]
    fn reference_pitch(&self) -> f64 {
        self.modes.reference_pitch
    }

    /// Whether no mode kept is mostly torsion.
    #[getter]
    fn no_torsion(&self) -> bool {
        self.modes.no_torsion
    }

    /// Frequencies (n_modes,) [rad/s], ascending.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.modes.frequency)
    }

    /// Frequencies (n_modes,) [1/rev], ascending; refused for a rotor at rest.
    #[getter]
    fn frequencies_per_rev<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let omega = self.modes.omega.abs();
        if omega == 0.0 {
            return Err(refused("frequencies_per_rev: omega is 0, read frequencies"));
        }
        Ok(PyArray1::from_iter(py, self.modes.frequency.iter().map(|frequency| frequency / omega)))
    }

    /// Shares of kinetic energy (n_modes, 3): flap, lag, torsion.
    #[getter]
    fn energy_shares<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> = self.modes.shares.iter().map(|s| vec![s.flap, s.lag, s.torsion]).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// Tip deflections of the mass-normalised shapes (n_modes, 3): lead [m], flap [m], twist [rad].
    #[getter]
    fn tip_deflections<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> = self.modes.tip.iter().map(|t| vec![t.v, t.w, t.phi]).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// Mass-normalised shapes at stations `x` [m]: v, dv, ddv, w, dw, ddw, phi, dphi, each (n_stations, n_modes).
    fn shapes<'py>(&self, py: Python<'py>, x: Vec<f64>) -> PyResult<Bound<'py, PyDict>> {
        if let Some(bad) = x.iter().find(|x| !x.is_finite()) {
            return Err(refused(format!("x holds {bad}: finite stations [m]")));
        }
        let at: Vec<ShapesAt> = x.into_iter().map(|x| self.modes.at(x)).collect();
        let out = PyDict::new(py);
        let columns: [(&str, fn(&ShapesAt) -> &Vec<f64>); 8] = [
            ("v", |s| &s.v),
            ("dv", |s| &s.dv),
            ("ddv", |s| &s.ddv),
            ("w", |s| &s.w),
            ("dw", |s| &s.dw),
            ("ddw", |s| &s.ddw),
            ("phi", |s| &s.phi),
            ("dphi", |s| &s.dphi),
        ];
        for (name, column) in columns {
            let rows: Vec<Vec<f64>> = at.iter().map(|s| column(s).clone()).collect();
            out.set_item(name, PyArray2::from_vec2(py, &rows)?)?;
        }
        Ok(out)
    }
}

/// Adds this file's classes to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyBladeModes>()
}
