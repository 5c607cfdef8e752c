//! The exchange with the air, and the steady wake of a trim: conversions and checks, the GIL released.

use crate::checks::{map, numbers, pack, unpack};
use crate::options::{marching_options, relaxation_options, wake_options};
use crate::system::PySystem;
use crate::wake::{RelaxationWake, TimeMarchingWake as PyTimeMarchingWake, py_error};
use crate::wake::{lattice, matrix, vectors};
use numpy::ndarray::Array;
use numpy::{IntoPyArray, PyArray2, PyArray3, PyArray4, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::exchange::{
    Changes, Exchange, MarchingExchange, Place, Reached, RelaxationExchange, SteadyWake, azimuth, row,
};
use wakeflight::wake::TimeMarchingWake;

/// Relaxation wake of a periodic motion with its circulation and inflow; see `wakeflight.trim.wake`.
#[pyclass(name = "SteadyWake", module = "wakeflight._core")]
#[derive(Clone)]
struct PySteadyWake {
    inner: SteadyWake,
}

impl PySteadyWake {
    fn by_azimuth<'py>(&self, py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, values.to_vec(), self.inner.n_azimuths())
    }
}

fn changes<'py>(py: Python<'py>, c: &Changes) -> PyResult<Bound<'py, PyDict>> {
    let d = PyDict::new(py);
    d.set_item("inflow_change", c.inflow)?;
    d.set_item("thrust_change", c.thrust)?;
    d.set_item("first_turn_change", c.first_turn)?;
    Ok(d)
}

#[pymethods]
impl PySteadyWake {
    /// On an inflow map (n_azimuths, n_stations); `steadied`: shorter steps of the geometry are taken where it circles.
    #[new]
    fn new(
        core: &PySystem,
        options_json: &str,
        steadied: bool,
        inflow: PyReadonlyArray2<f64>,
    ) -> PyResult<Self> {
        let options = wake_options(options_json)?;
        options.validate().map_err(py_error)?;
        let own = relaxation_options(options_json)?;
        let inflow = map("inflow", &inflow, options.steps_per_revolution(), options.n_stations)?;
        Ok(Self { inner: SteadyWake::new(options, own, steadied, core.main().0, inflow) })
    }

    /// Iterates wake and circulation for hub motion `y`, sticks, and a periodic blade motion (n_azimuths, n_modes); whether they
    /// came to rest within `most` iterations.
    fn converge(
        &mut self,
        py: Python<'_>,
        core: &PySystem,
        y: PyReadonlyArray1<f64>,
        stick: PyReadonlyArray1<f64>,
        motion: (PyReadonlyArray2<f64>, PyReadonlyArray2<f64>),
        most: usize,
    ) -> PyResult<bool> {
        let (hub, (rotor, air)) = (core.hub_at(y.as_slice()?)?, core.main());
        let blades = core.periodic((&motion.0, &motion.1), self.inner.n_azimuths(), stick.as_slice()?)?;
        let inner = &mut self.inner;
        py.detach(|| inner.converge(&Place { rotor, air, hub: &hub }, &blades, most)).map_err(py_error)
    }

    /// The motion has changed: means of passes before tell nothing of the inflow to come.
    fn forget_means(&mut self) {
        self.inner.forget_means();
    }

    /// Far inflow (n_azimuths, n_stations).
    #[getter]
    fn lambda_far<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_azimuth(py, &self.inner.lambda_far)
    }

    /// Bound circulation (n_azimuths, n_stations) [m2/s].
    #[getter]
    fn circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_azimuth(py, &self.inner.circulation)
    }

    /// Total inflow (n_azimuths, n_stations), of thin sections at both lines of the chord.
    #[getter]
    fn inflow<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_azimuth(py, &self.inner.inflow)
    }

    /// A copy of the wake; None before the first motion.
    #[getter]
    fn relaxation(&self) -> Option<RelaxationWake> {
        self.inner.wake.clone().map(|inner| RelaxationWake { inner })
    }

    /// Whether the last pass ended at rest.
    #[getter]
    fn converged(&self) -> bool {
        self.inner.converged
    }

    /// Changes of the last iteration by name, with its number; empty before the first.
    #[getter]
    fn last<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Some(last) = &self.inner.last else {
            return Ok(PyDict::new(py));
        };
        let d = changes(py, &last.changes)?;
        d.set_item("geometry_change", last.geometry)?;
        d.set_item("iterations", last.number)?;
        Ok(d)
    }

    /// Largest changes in an iteration that count as rest, by name.
    #[getter]
    fn allowed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        changes(py, &self.inner.allowed())
    }

    /// Of a wake that circles: change of the mean of its passes by the last one, and largest distance from the mean in it (rms).
    #[getter]
    fn circling(&self) -> (f64, f64) {
        (self.inner.mean_change, self.inner.wander)
    }

    /// Sweeps, circulations that Newton did not find from the ones before, evaluations of the segment law so far.
    #[getter]
    fn counters(&self) -> (u64, u64, u64) {
        (self.inner.sweeps, self.inner.followed, self.inner.segment_evaluations())
    }

    /// Everything of it, exact.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        pack(py, &self.inner)
    }

    /// From `to_bytes`.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        Ok(Self { inner: unpack("steady wake", bytes)? })
    }
}

type Tips<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);
type Lattice<'py> = (Bound<'py, PyArray4<f64>>, Bound<'py, PyArray3<f64>>);

/// One of the inflow models of a flight, with all that it keeps between exchanges; see `wakeflight.exchange`.
#[pyclass(name = "Exchange", module = "wakeflight._core")]
#[derive(Clone)]
struct PyExchange {
    inner: Exchange,
    n_blades: usize,
    /// Steps in a revolution.
    n: usize,
}

impl PyExchange {
    fn marching_wake(&self) -> PyResult<&MarchingExchange> {
        match &self.inner {
            Exchange::Marching(wake) => Ok(wake),
            Exchange::Dynamic | Exchange::Relaxation(_) => {
                Err(PyValueError::new_err("exchange: its inflow model has no marching wake"))
            }
        }
    }

    fn by_blade<'py>(&self, py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, values.to_vec(), self.n_blades)
    }
}

#[pymethods]
impl PyExchange {
    /// Dynamic inflow of a rotor, `n` steps in a revolution: in the state, nothing to exchange.
    #[staticmethod]
    fn dynamic(core: &PySystem, n: usize) -> Self {
        Self { inner: Exchange::Dynamic, n_blades: core.main().0.n_blades, n }
    }

    /// Relaxation wake from that of a trim and the periodic motion of its blades (n_azimuths, n_modes).
    #[staticmethod]
    fn relaxation(
        core: &PySystem,
        steady: &PySteadyWake,
        motion: (PyReadonlyArray2<f64>, PyReadonlyArray2<f64>),
        options_json: &str,
    ) -> PyResult<Self> {
        let n = steady.inner.n_azimuths();
        let motion = core.motions((&motion.0, &motion.1), n)?;
        let own = relaxation_options(options_json)?;
        let rotor = core.main().0;
        let wake = RelaxationExchange::new(steady.inner.clone(), rotor, &own, &motion);
        Ok(Self { inner: Exchange::Relaxation(Box::new(wake)), n_blades: rotor.n_blades, n })
    }

    /// Marching wake from the periodic one of a trim, blade 1 at azimuth zero.
    #[staticmethod]
    fn marching(core: &PySystem, steady: &PySteadyWake, options_json: &str) -> PyResult<Self> {
        let Some(relaxation) = &steady.inner.wake else {
            return Err(PyValueError::new_err("steady wake: it has not been converged for any motion"));
        };
        let own = marching_options(options_json, relaxation.options())?;
        let wake = TimeMarchingWake::from_relaxation(relaxation, 0, own).map_err(py_error)?;
        let rotor = core.main().0;
        let inner = MarchingExchange::new(wake, &steady.inner, rotor);
        let n = steady.inner.n_azimuths();
        Ok(Self { inner: Exchange::Marching(Box::new(inner)), n_blades: rotor.n_blades, n })
    }

    /// Total inflow held over the step that begins after `step` steps (n_blades, n_stations), of thin sections at both lines of
    /// the chord, None where it is in the state; and its mean over the disk.
    fn held<'py>(&self, py: Python<'py>, step: usize) -> PyResult<(Option<Bound<'py, PyArray2<f64>>>, f64)> {
        let held = self.inner.held(step);
        Ok((held.inflow.map(|values| matrix(py, values, self.n_blades)).transpose()?, held.mean))
    }

    /// States `y` and `sticks`, with their rates, have reached `step`: the air answers. `motion`: modal coordinates and rates (n_blades, n_modes)
    /// that stand for those of `y`.
    #[pyo3(signature = (core, step, y, sticks, motion=None))]
    fn advance(
        &mut self,
        py: Python<'_>,
        core: &PySystem,
        step: usize,
        y: PyReadonlyArray1<f64>,
        sticks: (PyReadonlyArray1<f64>, PyReadonlyArray1<f64>),
        motion: Option<(PyReadonlyArray2<f64>, PyReadonlyArray2<f64>)>,
    ) -> PyResult<()> {
        if matches!(self.inner, Exchange::Dynamic) {
            return Ok(());
        }
        let (y, (rotor, air)) = (y.as_slice()?, core.main());
        if rotor.n_blades != self.n_blades {
            return Err(PyValueError::new_err(format!(
                "rotor of {} blades, exchange of {}",
                rotor.n_blades, self.n_blades
            )));
        }
        let hub = core.hub_at(y)?;
        let (stick, rate) = (sticks.0.as_slice()?, sticks.1.as_slice()?);
        let stick = numbers("stick", stick, stick.len())?;
        let rate = numbers("stick_rate", rate, stick.len())?;
        let modal = match &motion {
            Some((q, q_dot)) => core.motions((q, q_dot), self.n_blades)?,
            None => (0..self.n_blades).map(|b| core.modal(y, b)).collect(),
        };
        let mut blades = Vec::with_capacity(self.n_blades);
        for (b, modal) in modal.into_iter().enumerate() {
            let psi = azimuth(row(step, b, self.n_blades, self.n), self.n);
            blades.push(BladeInstant { psi, modal, control: core.pitch(stick, rate, psi)? });
        }
        let mut steady_pitch = Vec::new();
        if self.inner.renews(step) {
            let still = vec![0.0; stick.len()];
            for k in 0..self.n {
                steady_pitch.push(core.pitch(stick, &still, azimuth(k, self.n))?);
            }
        }
        let inner = &mut self.inner;
        let place = Place { rotor, air, hub: &hub };
        py.detach(|| inner.advance(step, &Reached { place, blades: &blades, steady_pitch: &steady_pitch }))
            .map_err(py_error)
    }

    /// A revolution of a marching wake with hub motion `y`, sticks and a periodic blade motion (n_azimuths, n_modes) held: inflow
    /// and circulation [m2/s] by azimuth, means of all blades' passages.
    fn turn<'py>(
        &mut self,
        py: Python<'py>,
        core: &PySystem,
        y: PyReadonlyArray1<f64>,
        stick: PyReadonlyArray1<f64>,
        motion: (PyReadonlyArray2<f64>, PyReadonlyArray2<f64>),
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>)> {
        let (n, (rotor, air)) = (self.n, core.main());
        let hub = core.hub_at(y.as_slice()?)?;
        let blades = core.periodic((&motion.0, &motion.1), n, stick.as_slice()?)?;
        let Exchange::Marching(wake) = &mut self.inner else {
            return Err(PyValueError::new_err("exchange: its inflow model has no marching wake"));
        };
        let place = Place { rotor, air, hub: &hub };
        let (inflow, circulation) = py.detach(|| wake.turn(&place, &blades)).map_err(py_error)?;
        Ok((matrix(py, inflow, n)?, matrix(py, circulation, n)?))
    }

    /// Counts the steps of a marching wake anew, blade 1 at azimuth zero: a phase before the flight has ended.
    fn restart(&mut self) {
        if let Exchange::Marching(wake) = &mut self.inner {
            wake.restart();
        }
    }

    /// Steps of a marching wake since the start.
    #[getter]
    fn steps(&self) -> PyResult<usize> {
        self.marching_wake().map(MarchingExchange::steps)
    }

    /// What the last exchange saw: largest motion of a marker and odd-even content over R, smallest distance of blade and tip
    /// vortex in core radii.
    #[getter]
    fn monitors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let seen = self
            .inner
            .report()
            .map_or((0.0, 0.0, f64::NAN), |r| (r.max_displacement, r.odd_even, r.miss_distance));
        let d = PyDict::new(py);
        d.set_item("max_displacement", seen.0)?;
        d.set_item("odd_even", seen.1)?;
        d.set_item("vortex_blade_distance", seen.2)?;
        Ok(d)
    }

    /// Counted work by name; empty without a wake.
    #[getter]
    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let d = PyDict::new(py);
        match &self.inner {
            Exchange::Dynamic => {}
            Exchange::Relaxation(wake) => {
                d.set_item("segment_evaluations", wake.steady.segment_evaluations())?;
                d.set_item("unconverged_revolutions", wake.unconverged)?;
                d.set_item("relaxation_updates", wake.updates)?;
                d.set_item("relaxation_iterations", wake.steady.sweeps)?;
            }
            Exchange::Marching(wake) => {
                d.set_item("segment_evaluations", wake.wake.segment_evaluations())?;
                d.set_item("circulation_not_converged", wake.unsolved)?;
                d.set_item("circulation_followed", wake.followed)?;
            }
        }
        Ok(d)
    }

    /// Evaluations of the segment law so far.
    #[getter]
    fn segment_evaluations(&self) -> u64 {
        self.inner.segment_evaluations()
    }

    /// Tip vortices after `step` steps, None without a wake: nodes (n_blades, n_ages, 3) [m], hub axes, their circulation
    /// (n_blades, n_ages) [m2/s], core radii of the segments (n_blades, n_ages - 1) [m].
    fn tips<'py>(&self, py: Python<'py>, step: usize) -> PyResult<Option<Tips<'py>>> {
        let Some(tips) = self.inner.tips(step) else {
            return Ok(None);
        };
        Ok(Some((
            vectors(py, &tips.position, self.n_blades)?,
            matrix(py, tips.circulation, self.n_blades)?,
            matrix(py, tips.core_radius, self.n_blades)?,
        )))
    }

    /// Every free trailer after `step` steps, root to tip, None without a wake: nodes (n_blades, n_trailers, n_ages, 3) [m], hub
    /// axes, and their circulation (n_blades, n_trailers, n_ages) [m2/s].
    fn lattice<'py>(&self, py: Python<'py>, step: usize) -> PyResult<Option<Lattice<'py>>> {
        let Some(all) = self.inner.lattice(step) else {
            return Ok(None);
        };
        let ages = all.circulation.len() / (self.n_blades * all.n_trailers);
        let circulation = Array::from_shape_vec((self.n_blades, all.n_trailers, ages), all.circulation)
            .map_err(|e| PyValueError::new_err(e.to_string()))?;
        let position = lattice(py, &all.position, self.n_blades, all.n_trailers)?;
        Ok(Some((position, circulation.into_pyarray(py))))
    }

    /// A copy of the marching wake.
    fn wake(&self) -> PyResult<PyTimeMarchingWake> {
        Ok(PyTimeMarchingWake { inner: self.marching_wake()?.wake.clone() })
    }

    /// Total inflow that a marching wake gives (n_blades, n_stations), of thin sections at both lines of the chord.
    #[getter]
    fn inflow<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_blade(py, &self.marching_wake()?.inflow)
    }

    /// Bound circulation with a marching wake (n_blades, n_stations) [m2/s].
    #[getter]
    fn circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_blade(py, &self.marching_wake()?.circulation)
    }

    /// Inflow of a marching wake without that of the own near wake (n_blades, n_stations).
    #[getter]
    fn lambda_far<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_blade(py, &self.marching_wake()?.lambda_far)
    }

    /// Everything of it, exact.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        pack(py, &(&self.inner, self.n_blades, self.n))
    }

    /// From `to_bytes`.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        let (inner, n_blades, n) = unpack("exchange", bytes)?;
        Ok(Self { inner, n_blades, n })
    }

    /// Independent copy.
    fn copy(&self) -> Self {
        self.clone()
    }
}

/// Inflow of momentum theory over the tip speed for the thrust of a circulation map (n_azimuths, n_stations) [m2/s] at a hub
/// velocity [m/s], hub axes: it carries the inboard sheet.
#[pyfunction]
fn carrying_inflow(
    core: &PySystem,
    circulation: PyReadonlyArray2<f64>,
    hub_velocity: [f64; 3],
) -> PyResult<f64> {
    let disk = core.main().0.lifting_disk();
    let rows = circulation.as_array().nrows();
    let circulation = map("circulation", &circulation, rows, disk.stations.len())?;
    Ok(disk.carrying_inflow(&circulation, hub_velocity))
}

/// Adds this file's classes to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PySteadyWake>()?;
    m.add_class::<PyExchange>()?;
    m.add_function(wrap_pyfunction!(carrying_inflow, m)?)
}
