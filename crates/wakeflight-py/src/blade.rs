//! Blade modes for Python.

use crate::checks::{Array, Named, array, finite, invalid};
use pyo3::prelude::*;
use wakeflight::blade::modes::{self, ShapesAt};
use wakeflight::blade::section::BladeProperties;

/// Natural modes of the rotating blade, ascending by frequency; see `wakeflight::blade::modes::BladeModes`.
#[pyclass(frozen, module = "wakeflight._core")]
pub struct BladeModes(modes::BladeModes);

#[pymethods]
impl BladeModes {
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
        let blade: BladeProperties = serde_json::from_str(properties_json).map_err(invalid)?;
        let found = py.detach(|| modes::BladeModes::new(&blade, omega, reference_pitch, n_elements, n_modes));
        Ok(Self(found.map_err(invalid)?))
    }

    /// Frequencies (n_modes,) [rad/s].
    #[getter]
    fn frequencies(&self) -> Array {
        array(&self.0.frequency[..], &[])
    }

    /// Shares of kinetic energy (n_modes, 3): flap, lag, torsion.
    #[getter]
    fn energy_shares(&self) -> Array {
        let shares: Vec<f64> = self.0.shares.iter().flat_map(|s| [s.flap, s.lag, s.torsion]).collect();
        array(shares, &[self.0.n_modes])
    }

    /// Mass-normalised shapes at stations `x` [m]: v, dv, ddv, w, dw, ddw, phi, dphi, each (n_stations, n_modes).
    fn shapes(&self, x: Vec<f64>) -> PyResult<Named<Array>> {
        let at: Vec<ShapesAt> = finite("x", x)?.into_iter().map(|x| self.0.at(x)).collect();
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
        let all = |of: fn(&ShapesAt) -> &Vec<f64>| at.iter().flat_map(of).copied().collect::<Vec<_>>();
        Ok(columns.map(|(name, of)| (name, array(all(of), &[at.len()]))).into_iter().collect())
    }
}
