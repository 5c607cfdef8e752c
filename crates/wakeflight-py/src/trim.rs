//! Trim: problem and layout, the same for an aircraft and a rotor on a stand.

use crate::checks::{Array, Row, Table, invalid, pack, unpack, vectors};
use crate::inputs::at_parts;
use pyo3::prelude::*;
use wakeflight::system::model::System;
use wakeflight::trim::equation::Equation;
use wakeflight::trim::path::{Path, PathUnknown};
use wakeflight::trim::problem::{Inflow, Problem};
use wakeflight::trim::residual::Trim;

/// A steady condition to trim for; see `wakeflight.trim.equations`.
#[pyclass(frozen)]
pub struct TrimProblem(Problem);

#[pymethods]
impl TrimProblem {
    /// `path` (speed [m/s], flight path [rad], turn rate [rad/s]) and the names of its free parts; equations (name, numbers);
    /// inflow (n_azimuths, n_stations) or None (dynamic).
    #[new]
    fn new(
        path: [f64; 3],
        free: Vec<String>,
        equations: Vec<(String, Vec<f64>)>,
        n_harmonics: usize,
        n_azimuths: usize,
        inflow: Option<Table>,
        mean_inflow: f64,
    ) -> PyResult<Self> {
        let [speed, flight_path, turn_rate] = path;
        let free = free.iter().map(|name| PathUnknown::named(name)).collect::<Result<_, _>>();
        let equations = equations.iter().map(|(name, numbers)| Equation::named(name, numbers));
        let inflow = inflow.map_or(Inflow::Dynamic, |map| Inflow::Map {
            inflow: map.as_array().iter().copied().collect(),
            mean: mean_inflow,
        });
        Ok(Self(Problem {
            path: Path { speed, flight_path, turn_rate },
            free: free.map_err(invalid)?,
            equations: equations.collect::<Result<_, _>>().map_err(invalid)?,
            n_harmonics,
            n_azimuths,
            inflow,
            wash: None,
        }))
    }

    /// The same with the air of the wake at fuselage, stabilator, fin and tail rotor (4, 3) [m/s], body axes, in place of washes.
    fn washed(&self, wash: Table) -> PyResult<Self> {
        Ok(Self(Problem { wash: Some(at_parts(&wash)?), ..self.0.clone() }))
    }

    /// That air (4, 3); None where washes act.
    #[getter]
    fn wash(&self) -> Option<Array> {
        self.0.wash.map(|wash| vectors(wash.to_vec(), &[]))
    }

    /// Everything of it, exact.
    fn to_bytes(&self) -> PyResult<Vec<u8>> {
        pack(&self.0)
    }

    /// From `to_bytes`.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        unpack("trim problem", bytes).map(Self)
    }
}

impl TrimProblem {
    /// The problem on a system.
    pub fn on<'a>(&'a self, system: &'a System) -> PyResult<Trim<'a, System>> {
        Trim::new(system, &self.0).map_err(invalid)
    }

    /// The same with its unknowns.
    pub fn solved<'a>(&'a self, system: &'a System, x: &'a Row) -> PyResult<(Trim<'a, System>, &'a [f64])> {
        let trim = self.on(system)?;
        let x = trim.checked(x.as_slice()?).map_err(invalid)?;
        Ok((trim, x))
    }
}

/// Where the unknowns of a trim are, and the names and units of unknowns and equations.
#[pyclass(frozen, get_all)]
pub struct TrimLayout {
    /// Name and unit of every unknown.
    unknowns: Vec<(String, &'static str)>,
    /// Name of every equation, unit of its residual.
    equations: Vec<(String, &'static str)>,
    /// First of the free parts of the flight path.
    path: usize,
    /// First of the states of dynamic inflow.
    inflow: usize,
    /// Inflow of the tail rotor, where it has one; else the first blade mode.
    tail_inflow: usize,
    /// First unknown of every blade mode, and the number of unknowns.
    modes: Vec<usize>,
}

impl From<wakeflight::trim::layout::Layout> for TrimLayout {
    fn from(l: wakeflight::trim::layout::Layout) -> Self {
        let h = l.harmonics();
        Self {
            unknowns: l.unknowns(),
            equations: l.equations(),
            path: l.path(),
            inflow: l.inflow(),
            tail_inflow: l.tail_inflow(),
            modes: (0..=h.n_modes).map(|i| h.mode(i)).collect(),
        }
    }
}
