//! Free wake: conversions only.

use crate::checks::instruction_set;
use crate::options::{marching_options, relaxation_options, wake_options};
use numpy::ndarray::Array;
use numpy::{Element, IntoPyArray, PyArray2, PyArray3, PyArray4, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyArithmeticError, PyValueError};
use pyo3::prelude::*;
use wakeflight::wake::lifting_surface::{ControlLine, wing_circulation as wing_circulation_of};
use wakeflight::wake::{self, BladeState, HubMotion, Induction, LinearField, StepReport, WakeError};

/// Input at fault: ValueError; numerical failure: ArithmeticError.
pub(crate) fn py_error(error: WakeError) -> PyErr {
    if error.is_numerical() {
        PyArithmeticError::new_err(error.to_string())
    } else {
        PyValueError::new_err(error.to_string())
    }
}

/// Copy of an array of any memory layout in row-major order.
fn row_major<const N: usize>(name: &str, array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; N]>> {
    let view = array.as_array();
    if view.ncols() != N {
        return Err(PyValueError::new_err(format!("{name} has {} columns, {N} expected", view.ncols())));
    }
    Ok(view.rows().into_iter().map(|row| std::array::from_fn(|c| row[c])).collect())
}

pub(crate) fn flat(array: &PyReadonlyArray2<'_, f64>) -> Vec<f64> {
    array.as_array().iter().copied().collect()
}

/// (n, m) array from row-major values.
pub(crate) fn matrix<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    rows: usize,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let columns = values.len().checked_div(rows).unwrap_or(0);
    let array =
        Array::from_shape_vec((rows, columns), values).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(array.into_pyarray(py))
}

/// (n, m, 3) array from row-major vectors.
pub(crate) fn vectors<'py>(
    py: Python<'py>,
    values: &[[f64; 3]],
    rows: usize,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let columns = values.len().checked_div(rows).unwrap_or(0);
    let array = Array::from_shape_vec((rows, columns, 3), values.as_flattened().to_vec())
        .map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(array.into_pyarray(py))
}

/// (n, m, l, 3) array from row-major vectors.
pub(crate) fn lattice<'py>(
    py: Python<'py>,
    values: &[[f64; 3]],
    rows: usize,
    columns: usize,
) -> PyResult<Bound<'py, PyArray4<f64>>> {
    let depth = values.len().checked_div(rows * columns).unwrap_or(0);
    let array = Array::from_shape_vec((rows, columns, depth, 3), values.as_flattened().to_vec())
        .map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(array.into_pyarray(py))
}

/// Every trailer of a marched wake (n_blades, n_trailers, n_segments + 1, 3) [m].
pub(crate) fn marched_lattice<'py>(
    py: Python<'py>,
    wake: &wake::TimeMarchingWake,
) -> PyResult<Bound<'py, PyArray4<f64>>> {
    let options = wake.options();
    lattice(py, wake.position(), options.rotor.n_blades, options.trailers_per_blade())
}

/// Circulation of the markers of the tip trailers of a marched wake (n_blades, n_segments + 1) [m2/s].
pub(crate) fn tip_circulation<'py>(
    py: Python<'py>,
    wake: &wake::TimeMarchingWake,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let options = wake.options();
    let length = options.n_segments() + 1;
    let tips = wake::tip_rows(wake.marker_circulation(), options.trailers_per_blade(), length);
    matrix(py, tips, options.rotor.n_blades)
}

/// Core radii of the segments of the tip trailers of a marched wake (n_blades, n_segments) [m].
pub(crate) fn tip_core<'py>(
    py: Python<'py>,
    wake: &wake::TimeMarchingWake,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let options = wake.options();
    let tips = wake::tip_rows(&wake.core_radius(), options.trailers_per_blade(), options.n_segments());
    matrix(py, tips, options.rotor.n_blades)
}

/// Matrix N (n_stations, n_stations) [s/m2]: inflow of the near wake of the own blade, lambda_i = sum_j N_ij Gamma_j.
#[pyfunction]
fn near_wake_matrix<'py>(
    py: Python<'py>,
    options_json: &str,
    hub_velocity: [f64; 3],
    hub_rates: [f64; 3],
    psi: f64,
    flap: f64,
    lead: f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let options = wake_options(options_json)?;
    let hub = HubMotion { velocity: hub_velocity, rates: hub_rates };
    let values = py
        .detach(|| wake::near_wake_matrix(&options, &hub, &BladeState { psi, flap, lead }))
        .map_err(py_error)?;
    matrix(py, values, options.n_stations)
}

/// Circulation over speed (n) [m] of a flat wing: edges (n + 1), stations, chords (n) [m], angle of attack [rad]; control points at
/// three quarters of the chord (Weissinger) or on the bound line.
#[pyfunction]
fn wing_circulation<'py>(
    py: Python<'py>,
    edges: PyReadonlyArray1<'_, f64>,
    stations: PyReadonlyArray1<'_, f64>,
    chords: PyReadonlyArray1<'_, f64>,
    alpha: f64,
    weissinger: bool,
) -> PyResult<Bound<'py, numpy::PyArray1<f64>>> {
    let line = if weissinger { ControlLine::ThreeQuarter } else { ControlLine::Quarter };
    let gamma = wing_circulation_of(edges.as_slice()?, stations.as_slice()?, chords.as_slice()?, alpha, line)
        .map_err(py_error)?;
    Ok(gamma.into_pyarray(py))
}

/// Periodic wake of a steady flight condition.
#[pyclass(module = "wakeflight._core")]
#[derive(Clone)]
pub(crate) struct RelaxationWake {
    pub(crate) inner: wake::RelaxationWake,
}

#[pymethods]
impl RelaxationWake {
    /// `prescribed`: velocity at the hub [m/s] and gradient [1/s], hub axes, of a linear field that stands for the induced
    /// velocity of the vortices, for this wake and those marched from it.
    #[new]
    #[pyo3(signature = (options_json, hub_velocity, hub_rates, mean_inflow, prescribed=None))]
    fn new(
        options_json: &str,
        hub_velocity: [f64; 3],
        hub_rates: [f64; 3],
        mean_inflow: f64,
        prescribed: Option<([f64; 3], [[f64; 3]; 3])>,
    ) -> PyResult<Self> {
        instruction_set()?;
        let (options, own) = (wake_options(options_json)?, relaxation_options(options_json)?);
        let hub = HubMotion { velocity: hub_velocity, rates: hub_rates };
        let inner = match prescribed {
            None => wake::RelaxationWake::new(options, own, hub, mean_inflow),
            Some((at_origin, gradient)) => LinearField::new(at_origin, gradient).and_then(|field| {
                wake::RelaxationWake::with_field(options, own, hub, mean_inflow, Induction::Linear(field))
            }),
        };
        Ok(Self { inner: inner.map_err(py_error)? })
    }

    /// Hub motion, flap and lead (n_azimuths) [rad] and bound circulation (n_azimuths, n_stations) [m2/s].
    fn set_state(
        &mut self,
        py: Python<'_>,
        hub_velocity: [f64; 3],
        hub_rates: [f64; 3],
        flap: PyReadonlyArray1<'_, f64>,
        lead: PyReadonlyArray1<'_, f64>,
        circulation: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<()> {
        let (flap, lead) = (flap.as_array(), lead.as_array());
        if flap.len() != lead.len() {
            return Err(PyValueError::new_err(format!(
                "flap has {} values, lead {}",
                flap.len(),
                lead.len()
            )));
        }
        let blades: Vec<(f64, f64)> = flap.iter().copied().zip(lead.iter().copied()).collect();
        let circulation = flat(&circulation);
        let hub = HubMotion { velocity: hub_velocity, rates: hub_rates };
        py.detach(|| self.inner.set_state(hub, &blades, &circulation)).map_err(py_error)
    }

    /// Does n sweeps; returns their RMS changes (n, 2) over R: all markers, first turn.
    fn sweep<'py>(&mut self, py: Python<'py>, n: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let norms = py.detach(|| self.inner.sweep(n)).map_err(py_error)?;
        matrix(py, norms.iter().flat_map(|norm| [norm.all, norm.first_turn]).collect(), n)
    }

    /// Inflow at the stations without that of the own near wake (n_azimuths, n_stations).
    fn inflow_far<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = py.detach(|| self.inner.inflow_far());
        matrix(py, values, self.inner.options().steps_per_revolution())
    }

    /// Velocity (n, 3) [m/s] induced at points (n, 3) [m], blade 1 at the azimuth of row `azimuth_index`.
    fn wake_velocity<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'_, f64>,
        azimuth_index: usize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points: Vec<[f64; 3]> = row_major("points", &points)?;
        let velocity = py.detach(|| self.inner.wake_velocity(&points, azimuth_index));
        matrix(py, velocity.as_flattened().to_vec(), velocity.len())
    }

    /// Markers of the tip trailer (n_azimuths, n_segments + 1, 3) [m].
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        vectors(py, &self.inner.tip_position(), self.inner.options().steps_per_revolution())
    }

    /// Markers of every trailer, root to tip (n_azimuths, n_trailers, n_segments + 1, 3) [m].
    fn lattice<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray4<f64>>> {
        let options = self.inner.options();
        lattice(py, self.inner.position(), options.steps_per_revolution(), options.trailers_per_blade())
    }

    /// Core radii of the segments of the tip trailer (n_azimuths, n_segments) [m].
    fn core_radius<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let options = self.inner.options();
        let cores =
            wake::tip_rows(&self.inner.core_radius(), options.trailers_per_blade(), options.n_segments());
        matrix(py, cores, options.steps_per_revolution())
    }

    /// Circulation of the tip trailer released at every azimuth (n_azimuths) [m2/s].
    fn tip_circulation(&self) -> Vec<f64> {
        let n_trailers = self.inner.options().trailers_per_blade();
        wake::tip_rows(self.inner.released_circulation(), n_trailers, 1)
    }

    /// Circulation of the trailers released at every azimuth, root to tip (n_azimuths, n_trailers) [m2/s].
    fn released_circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.inner.released_circulation().to_vec(), self.inner.options().steps_per_revolution())
    }

    /// Radii of the stations (n_stations) [m].
    fn stations(&self) -> Vec<f64> {
        self.inner.grid().stations.clone()
    }

    /// Edges of the bound elements (n_stations + 1) [m].
    fn edges(&self) -> Vec<f64> {
        self.inner.grid().edges.clone()
    }

    /// Segment evaluations so far.
    #[getter]
    fn segment_evaluations(&self) -> u64 {
        self.inner.segment_evaluations()
    }

    /// Sweeps so far.
    #[getter]
    fn sweeps(&self) -> u64 {
        self.inner.sweeps()
    }

    /// Independent copy.
    fn copy(&self) -> Self {
        self.clone()
    }
}

/// What one step did: largest motion of a marker and odd-even monitor (over R), segment evaluations.
type Report = (f64, f64, u64);

/// Time-accurate wake.
#[pyclass(module = "wakeflight._core")]
#[derive(Clone)]
pub(crate) struct TimeMarchingWake {
    pub(crate) inner: wake::TimeMarchingWake,
}

#[pymethods]
impl TimeMarchingWake {
    /// Starts from a periodic wake with blade 1 at row `azimuth_index`, with the marching options of `options_json`.
    #[staticmethod]
    fn from_relaxation(
        relaxation: &RelaxationWake,
        azimuth_index: usize,
        options_json: &str,
    ) -> PyResult<Self> {
        let own = marching_options(options_json, relaxation.inner.options())?;
        let inner = wake::TimeMarchingWake::from_relaxation(&relaxation.inner, azimuth_index, own);
        Ok(Self { inner: inner.map_err(py_error)? })
    }

    /// One step of azimuth to the hub motion, the blades (n_blades, 3: psi, flap, lead) [rad] and the bound circulation
    /// (n_blades, n_stations) [m2/s]. Returns (max_displacement, odd_even, segment_evaluations).
    fn step(
        &mut self,
        py: Python<'_>,
        hub_velocity: [f64; 3],
        hub_rates: [f64; 3],
        blades: PyReadonlyArray2<'_, f64>,
        circulation: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Report> {
        let hub = HubMotion { velocity: hub_velocity, rates: hub_rates };
        let blades: Vec<BladeState> = row_major::<3>("blades", &blades)?
            .into_iter()
            .map(|[psi, flap, lead]| BladeState { psi, flap, lead })
            .collect();
        let circulation = flat(&circulation);
        let StepReport { max_displacement, odd_even, segment_evaluations } =
            py.detach(|| self.inner.step(hub, &blades, &circulation)).map_err(py_error)?;
        Ok((max_displacement, odd_even, segment_evaluations))
    }

    /// Inflow at the stations without that of the own near wake (n_blades, n_stations).
    fn inflow_far<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = py.detach(|| self.inner.inflow_far());
        matrix(py, values, self.inner.options().rotor.n_blades)
    }

    /// Velocity (n, 3) [m/s] induced at points (n, 3) [m].
    fn wake_velocity<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points: Vec<[f64; 3]> = row_major("points", &points)?;
        let velocity = py.detach(|| self.inner.wake_velocity(&points));
        matrix(py, velocity.as_flattened().to_vec(), velocity.len())
    }

    /// Markers of the tip trailers (n_blades, n_segments + 1, 3) [m].
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        vectors(py, &self.inner.tip_position(), self.inner.options().rotor.n_blades)
    }

    /// Markers of every trailer, root to tip (n_blades, n_trailers, n_segments + 1, 3) [m].
    fn lattice<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray4<f64>>> {
        marched_lattice(py, &self.inner)
    }

    /// Circulation of the markers of the tip trailers (n_blades, n_segments + 1) [m2/s].
    fn marker_circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        tip_circulation(py, &self.inner)
    }

    /// Core radii of the segments of the tip trailers (n_blades, n_segments) [m].
    fn core_radius<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        tip_core(py, &self.inner)
    }

    /// Segment evaluations so far.
    #[getter]
    fn segment_evaluations(&self) -> u64 {
        self.inner.segment_evaluations()
    }

    /// Steps so far.
    #[getter]
    fn steps(&self) -> u64 {
        self.inner.steps()
    }

    /// Independent copy.
    fn copy(&self) -> Self {
        self.clone()
    }
}

/// Adds the wake to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<RelaxationWake>()?;
    m.add_class::<TimeMarchingWake>()?;
    m.add_function(wrap_pyfunction!(wing_circulation, m)?)?;
    m.add_function(wrap_pyfunction!(near_wake_matrix, m)?)
}
