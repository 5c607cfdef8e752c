//! Fixed-step integration and the exchange with the time-marching wake: conversions only, the GIL released.

use crate::aircraft::{PyAircraft, PyInputs};
use crate::options::marching_options;
use crate::rotor::motion;
use crate::stand::{PyStand, hub_state};
use crate::wake::{
    RelaxationWake, TimeMarchingWake as PyTimeMarchingWake, flat, marched_lattice, matrix, py_error,
    tip_circulation, tip_core, vectors,
};
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArray3, PyArray4, PyReadonlyArray1, PyReadonlyArray2,
    PyReadwriteArray2,
};
use pyo3::exceptions::{PyArithmeticError, PyValueError};
use pyo3::prelude::*;
use std::f64::consts::TAU;
use wakeflight::aircraft::model::{HeldInflow, Inputs};
use wakeflight::blade::aerodynamics::Air;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::loads::HubMotion;
use wakeflight::integrate::explicit::{ExplicitFailure, ExplicitStep};
use wakeflight::integrate::fixed::{Counters, FixedStep, StepFailure};
use wakeflight::integrate::linearised::Linearised;
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::exchange::MarchingExchange;
use wakeflight::rotor::hub::Rotor;
use wakeflight::rotor::swashplate::MovingPitch;
use wakeflight::wake::TimeMarchingWake;

fn failed(error: StepFailure) -> PyErr {
    PyArithmeticError::new_err(error.to_string())
}

/// Fixed steps of Radau IIA; see `wakeflight.integrators`.
#[pyclass(name = "FixedStep")]
struct PyFixedStep {
    inner: FixedStep,
}

#[pymethods]
impl PyFixedStep {
    /// At state `y` and time `t` [s], with tolerances; `newton_share` of them is what the Newton iteration may leave; dF/dy is
    /// kept over an azimuth of `kept` [rad].
    #[new]
    #[pyo3(signature = (aircraft, t, y, rtol, atol, newton_share, kept=0.0))]
    fn new(
        aircraft: &PyAircraft,
        t: f64,
        y: PyReadonlyArray1<f64>,
        rtol: f64,
        atol: PyReadonlyArray1<f64>,
        newton_share: f64,
        kept: f64,
    ) -> PyResult<Self> {
        let layout = aircraft.inner.layout;
        let solver = FixedStep::new(layout, t, y.as_slice()?, rtol, atol.as_slice()?, newton_share);
        Ok(Self { inner: solver.keeping(kept) })
    }

    /// Linearises at the present state; the rate then satisfies F = 0 with `inputs`.
    fn prepare(&mut self, py: Python<'_>, aircraft: &PyAircraft, inputs: &PyInputs) -> PyResult<()> {
        py.detach(|| self.inner.prepare(&aircraft.inner, &inputs.0)).map_err(failed)
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    fn advance(
        &mut self,
        py: Python<'_>,
        aircraft: &PyAircraft,
        t1: f64,
        inputs: &PyInputs,
        parts: usize,
    ) -> PyResult<()> {
        py.detach(|| self.inner.advance(&aircraft.inner, t1, &inputs.0, parts)).map_err(failed)
    }

    /// State.
    fn state<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.inner.state().to_vec().into_pyarray(py)
    }

    /// Rate of state.
    fn rate<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.inner.rate().to_vec().into_pyarray(py)
    }

    /// Residual evaluations, Jacobians, factorisations, Newton iterations, steps, halvings.
    fn counters(&self) -> (u64, u64, u64, u64, u64, u64) {
        counted(self.inner.counters())
    }
}

fn stopped(error: ExplicitFailure) -> PyErr {
    PyArithmeticError::new_err(error.to_string())
}

/// Fixed explicit steps of an aircraft whose blades do not bend; see `wakeflight.integrators`.
#[pyclass(name = "ExplicitStep")]
struct PyExplicitStep {
    inner: ExplicitStep,
}

#[pymethods]
impl PyExplicitStep {
    /// At state `y` and time `t` [s], with the tolerances that guard the step.
    #[new]
    fn new(
        aircraft: &PyAircraft,
        t: f64,
        y: PyReadonlyArray1<f64>,
        rtol: f64,
        atol: PyReadonlyArray1<f64>,
    ) -> PyResult<Self> {
        let inner = ExplicitStep::new(&aircraft.inner, t, y.as_slice()?, rtol, atol.as_slice()?)
            .ok_or_else(|| PyValueError::new_err("explicit steps: for blades that do not bend"))?;
        Ok(Self { inner })
    }

    /// The rate then satisfies F = 0 with `inputs`.
    fn prepare(&mut self, aircraft: &PyAircraft, inputs: &PyInputs) -> PyResult<()> {
        self.inner.prepare(&aircraft.inner, &inputs.0).map_err(stopped)
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    fn advance(&mut self, aircraft: &PyAircraft, t1: f64, inputs: &PyInputs, parts: usize) -> PyResult<()> {
        self.inner.advance(&aircraft.inner, t1, &inputs.0, parts).map_err(stopped)
    }

    /// State.
    fn state<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.inner.state().to_vec().into_pyarray(py)
    }

    /// Rate of state.
    fn rate<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.inner.rate().to_vec().into_pyarray(py)
    }

    /// Residual evaluations, Jacobians, factorisations, Newton iterations, steps, halvings.
    fn counters(&self) -> (u64, u64, u64, u64, u64, u64) {
        counted(self.inner.counters())
    }
}

fn counted(c: Counters) -> (u64, u64, u64, u64, u64, u64) {
    (c.residual_evaluations, c.jacobians, c.factorisations, c.newton_iterations, c.steps, c.halvings)
}

/// F linearised once for a solver that asks for its derivatives again and again; see `wakeflight.integrators`.
#[pyclass(name = "Linearised")]
struct PyLinearised {
    inner: Linearised,
}

#[pymethods]
impl PyLinearised {
    #[new]
    fn new(aircraft: &PyAircraft) -> Self {
        Self { inner: Linearised::new(aircraft.inner.layout) }
    }

    /// y_dot that satisfies F = 0 at (t, y), from the guess `y_dot`; linearises there (`renew`), or finds dF/dy_dot alone.
    #[allow(clippy::too_many_arguments, reason = "the arguments of F")]
    fn consistent<'py>(
        &mut self,
        py: Python<'py>,
        aircraft: &PyAircraft,
        t: f64,
        y: PyReadonlyArray1<f64>,
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
        renew: bool,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (y, mut rate) = (y.as_slice()?, y_dot.as_slice()?.to_vec());
        let (linear, aircraft) = (&mut self.inner, &aircraft.inner);
        let solved = if renew {
            linear.consistent(aircraft, t, y, &mut rate, &inputs.0)
        } else {
            linear.consistent_by_mass(aircraft, t, y, &mut rate, &inputs.0)
        };
        solved.map_err(|e| PyArithmeticError::new_err(e.to_string()))?;
        Ok(rate.into_pyarray(py))
    }

    /// Linearises at (t, y, y_dot).
    fn renew(
        &mut self,
        aircraft: &PyAircraft,
        t: f64,
        y: PyReadonlyArray1<f64>,
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
    ) -> PyResult<()> {
        self.inner.renew(&aircraft.inner, t, y.as_slice()?, y_dot.as_slice()?, &inputs.0);
        Ok(())
    }

    /// Finds dF/dy_dot at (t, y); dF/dy is left as it was.
    fn renew_mass(
        &mut self,
        aircraft: &PyAircraft,
        t: f64,
        y: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
    ) -> PyResult<()> {
        self.inner.renew_mass(&aircraft.inner, t, y.as_slice()?, &inputs.0);
        Ok(())
    }

    /// dF/dy + c dF/dy_dot of the instant last linearised at, into `out` (n, n).
    fn matrix(&self, c: f64, mut out: PyReadwriteArray2<f64>) -> PyResult<()> {
        self.inner.slopes.dense(1.0, c, out.as_slice_mut()?);
        Ok(())
    }
}

/// Whose rotor it is.
#[derive(FromPyObject)]
enum Core<'py> {
    Aircraft(PyRef<'py, PyAircraft>),
    Stand(PyRef<'py, PyStand>),
}

impl Core<'_> {
    fn rotor(&self) -> (&Rotor, Air) {
        match self {
            Self::Aircraft(a) => (&a.inner.rotor, a.inner.air),
            Self::Stand(s) => (&s.inner.rotor, s.inner.air),
        }
    }

    fn hub(&self, y: &[f64]) -> PyResult<HubMotion<f64>> {
        match self {
            Self::Aircraft(a) => Ok(a.inner.hub_motion(y, &vec![0.0; y.len()])),
            Self::Stand(s) => {
                let (velocity, rates) = hub_state(y)?;
                Ok(s.inner.hub(velocity, rates))
            }
        }
    }

    /// Modal motion of blade `b` in `y`; a stand keeps none there.
    fn modal(&self, y: &[f64], b: usize) -> PyResult<ModalMotion<f64>> {
        match self {
            Self::Aircraft(a) => Ok(a.inner.modal_motion(y, &vec![0.0; y.len()], b)),
            Self::Stand(_) => Err(PyValueError::new_err("motion: needed for a rotor on a stand")),
        }
    }

    fn instant(
        &self,
        stick: &[f64],
        rate: &[f64],
        psi: f64,
        modal: ModalMotion<f64>,
    ) -> PyResult<BladeInstant> {
        let wrong = || PyValueError::new_err(format!("stick has {} numbers", stick.len()));
        let control = match self {
            Self::Aircraft(a) => {
                let inputs = Inputs {
                    stick: stick.try_into().map_err(|_| wrong())?,
                    stick_rate: rate.try_into().map_err(|_| wrong())?,
                    t_start: 0.0,
                    inflow: HeldInflow::Dynamic,
                    stabilator_incidence: 0.0,
                };
                a.inner.blade_pitch(&inputs, 0.0, psi)
            }
            Self::Stand(s) => {
                let controls = stick.try_into().map_err(|_| wrong())?;
                let rates = rate.try_into().map_err(|_| wrong())?;
                MovingPitch { controls, rates, higher: &s.inner.higher }
                    .at(0.0, psi, s.inner.rotor.omega)
                    .into()
            }
        };
        Ok(BladeInstant { psi, modal, control })
    }
}

/// Largest displacement and odd-even content over R, closest vortex in cores, circulation problems not converged.
type Report = (f64, f64, f64, usize);

/// Time-marching wake with its circulation and inflow; see `wakeflight.exchange`.
#[pyclass(name = "MarchingExchange")]
struct PyMarchingExchange {
    inner: MarchingExchange,
}

#[pymethods]
impl PyMarchingExchange {
    /// From a periodic wake with blade 1 at azimuth zero; far inflow, circulation, inflow (n_blades, n_stations), the inflow
    /// of thin sections twice as wide.
    #[new]
    fn new(
        relaxation: &RelaxationWake,
        options_json: &str,
        lambda_far: PyReadonlyArray2<f64>,
        circulation: PyReadonlyArray2<f64>,
        inflow: PyReadonlyArray2<f64>,
    ) -> PyResult<Self> {
        let own = marching_options(options_json, relaxation.inner.options())?;
        let wake = TimeMarchingWake::from_relaxation(&relaxation.inner, 0, own).map_err(py_error)?;
        let start = [lambda_far, circulation, inflow].map(|a| flat(&a));
        let [far, gamma, total] = start;
        Ok(Self { inner: MarchingExchange::new(wake, far, gamma, total) })
    }

    /// Mean induced inflow, over the tip speed, that carries the inboard sheet in the steps that follow.
    fn set_mean_inflow(&mut self, mean_inflow: f64) -> PyResult<()> {
        self.inner.wake.set_mean_inflow(mean_inflow).map_err(py_error)
    }

    /// A copy of the wake as it is now.
    fn snapshot(&self) -> PyTimeMarchingWake {
        PyTimeMarchingWake { inner: self.inner.wake.clone() }
    }

    /// States `y` reached, first blade at step `index` of its revolution: circulation, wake, inflow, circulation.
    /// `motion`: modal coordinates and rates (n_blades, n_modes) that stand for those of `y`.
    #[pyo3(signature = (core, y, stick, stick_rate, index, motion=None))]
    fn advance(
        &mut self,
        py: Python<'_>,
        core: Core<'_>,
        y: PyReadonlyArray1<f64>,
        stick: PyReadonlyArray1<f64>,
        stick_rate: PyReadonlyArray1<f64>,
        index: usize,
        motion: Option<(PyReadonlyArray2<f64>, PyReadonlyArray2<f64>)>,
    ) -> PyResult<Report> {
        let (y, (rotor, air)) = (y.as_slice()?, core.rotor());
        let hub = core.hub(y)?;
        let n = self.inner.wake.options().steps_per_revolution();
        let mut blades = Vec::with_capacity(rotor.n_blades);
        for b in 0..rotor.n_blades {
            let psi = TAU * ((index + b * n / rotor.n_blades) % n) as f64 / n as f64;
            let modal = match &motion {
                Some((q, q_dot)) => {
                    let row = |m: &PyReadonlyArray2<f64>| m.as_array().row(b).to_vec().into_iter();
                    self::motion(row(q), row(q_dot))
                }
                None => core.modal(y, b)?,
            };
            blades.push(core.instant(stick.as_slice()?, stick_rate.as_slice()?, psi, modal)?);
        }
        let inner = &mut self.inner;
        let r = py.detach(|| inner.advance(rotor, air, &hub, &blades)).map_err(py_error)?;
        Ok((r.max_displacement, r.odd_even, r.miss_distance, r.followed))
    }

    /// Total inflow held over the next step (n_blades, n_stations), of thin sections at both lines of the chord.
    fn inflow<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.inner.inflow.clone(), self.inner.wake.options().rotor.n_blades)
    }

    /// Bound circulation (n_blades, n_stations) [m2/s].
    fn circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.inner.circulation.clone(), self.inner.wake.options().rotor.n_blades)
    }

    /// Inflow without that of the own near wake (n_blades, n_stations).
    fn lambda_far<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.inner.lambda_far.clone(), self.inner.wake.options().rotor.n_blades)
    }

    /// Markers (n_blades, n_segments + 1, 3) [m].
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        vectors(py, &self.inner.wake.tip_position(), self.inner.wake.options().rotor.n_blades)
    }

    /// Circulation of the markers (n_blades, n_segments + 1) [m2/s].
    fn marker_circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        tip_circulation(py, &self.inner.wake)
    }

    /// Core radii of the segments (n_blades, n_segments) [m].
    fn core_radius<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        tip_core(py, &self.inner.wake)
    }

    /// Markers of every trailer, root to tip (n_blades, n_trailers, n_segments + 1, 3) [m].
    fn lattice<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray4<f64>>> {
        marched_lattice(py, &self.inner.wake)
    }

    /// Circulation of the markers, trailer after trailer (n_blades, n_trailers (n_segments + 1)) [m2/s].
    fn lattice_circulation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.inner.wake.marker_circulation().to_vec(), self.inner.wake.options().rotor.n_blades)
    }

    /// Segment evaluations so far.
    #[getter]
    fn segment_evaluations(&self) -> u64 {
        self.inner.wake.segment_evaluations()
    }

    /// Circulations that were not solved: the call of `advance` that met one failed.
    #[getter]
    fn unsolved(&self) -> usize {
        self.inner.unsolved
    }

    /// Independent copy.
    fn copy(&self) -> Self {
        Self { inner: self.inner.clone() }
    }
}

/// Registers the classes of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyFixedStep>()?;
    m.add_class::<PyLinearised>()?;
    m.add_class::<PyExplicitStep>()?;
    m.add_class::<PyMarchingExchange>()
}
