//! Trim: problem, layout, residual, Jacobian, periodic motion, the same for an aircraft and a rotor on a stand.

use crate::checks::invalid;
use crate::checks::{pack, unpack};
use numpy::ndarray::Array;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use wakeflight::trim::equation::Equation;
use wakeflight::trim::host::Host;
use wakeflight::trim::path::{Path, PathUnknown};
use wakeflight::trim::problem::{Inflow, Problem};
use wakeflight::trim::residual::Trim;

/// A steady condition to trim for; see `wakeflight.trim.equations`.
#[pyclass(name = "TrimProblem", frozen)]
pub struct PyTrimProblem(pub(crate) Problem);

#[pymethods]
impl PyTrimProblem {
    /// `path` (speed [m/s], flight path [rad], turn rate [rad/s]) and the names of its free parts; equations (name, numbers);
    /// inflow (n_azimuths, n_stations) or None (dynamic).
    #[new]
    fn new(
        path: [f64; 3],
        free: Vec<String>,
        equations: Vec<(String, Vec<f64>)>,
        n_harmonics: usize,
        n_azimuths: usize,
        inflow: Option<PyReadonlyArray2<f64>>,
        mean_inflow: f64,
    ) -> PyResult<Self> {
        let [speed, flight_path, turn_rate] = path;
        let free = free.iter().map(|name| PathUnknown::named(name)).collect::<Result<_, _>>();
        let equations =
            equations.iter().map(|(name, numbers)| Equation::named(name, numbers)).collect::<Result<_, _>>();
        let inflow = match inflow {
            None => Inflow::Dynamic,
            Some(map) => Inflow::Map { inflow: map.as_array().iter().copied().collect(), mean: mean_inflow },
        };
        Ok(Self(Problem {
            path: Path { speed, flight_path, turn_rate },
            free: free.map_err(invalid)?,
            equations: equations.map_err(invalid)?,
            n_harmonics,
            n_azimuths,
            inflow,
        }))
    }

    /// Everything of it, exact.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        pack(py, &self.0)
    }

    /// From `to_bytes`.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        unpack("trim problem", bytes).map(Self)
    }
}

/// Where the unknowns of a trim are, and the names and units of unknowns and equations.
#[pyclass(name = "TrimLayout", frozen, get_all)]
pub struct PyTrimLayout {
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

/// Layout of `problem` on `host`.
pub fn layout<H: Host>(host: &H, problem: &PyTrimProblem) -> PyResult<PyTrimLayout> {
    let l = Trim::new(host, &problem.0).map_err(invalid)?.layout;
    let h = l.harmonics();
    Ok(PyTrimLayout {
        unknowns: l.unknowns(),
        equations: l.equations(),
        path: l.path(),
        inflow: l.inflow(),
        tail_inflow: l.tail_inflow(),
        modes: (0..=h.n_modes).map(|i| h.mode(i)).collect(),
    })
}

/// Residual of every equation.
pub fn residual<'py, H: Host + Sync>(
    py: Python<'py>,
    host: &H,
    problem: &PyTrimProblem,
    x: &PyReadonlyArray1<f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let trim = Trim::new(host, &problem.0).map_err(invalid)?;
    let x = trim.checked(x.as_slice()?).map_err(invalid)?;
    let mut f = vec![0.0; x.len()];
    py.detach(|| trim.residual_of_four(x, &mut f));
    Ok(f.into_pyarray(py))
}

/// Exact Jacobian (n, n).
pub fn jacobian<'py, H: Host + Sync>(
    py: Python<'py>,
    host: &H,
    problem: &PyTrimProblem,
    x: &PyReadonlyArray1<f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let trim = Trim::new(host, &problem.0).map_err(invalid)?;
    let x = trim.checked(x.as_slice()?).map_err(invalid)?;
    let n = x.len();
    let mut j = vec![0.0; n * n];
    py.detach(|| trim.jacobian(x, &mut j));
    Ok(Array::from_shape_vec((n, n), j).map_err(invalid)?.into_pyarray(py))
}

/// Two arrays (n_azimuths, n_modes).
pub type Motion<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

/// Modal coordinates and rates (n_azimuths, n_modes) of the periodic motion.
pub fn motion<'py, H: Host>(
    py: Python<'py>,
    host: &H,
    problem: &PyTrimProblem,
    x: &PyReadonlyArray1<f64>,
    n_azimuths: usize,
) -> PyResult<Motion<'py>> {
    let trim = Trim::new(host, &problem.0).map_err(invalid)?;
    let x = trim.checked(x.as_slice()?).map_err(invalid)?;
    let n = host.rotor().blade.n_modes;
    let (q, q_dot) = trim.motions(x, n_azimuths);
    let shape = |v| Array::from_shape_vec((n_azimuths, n), v).map_err(invalid);
    Ok((shape(q)?.into_pyarray(py), shape(q_dot)?.into_pyarray(py)))
}

/// Registers the classes of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyTrimProblem>()?;
    m.add_class::<PyTrimLayout>()
}
