//! Fixed-step integration and derivatives for a solver from elsewhere: conversions and checks, the GIL released.

use crate::checks::{numbers, pack, sized, unpack};
use crate::system::{PyInputs, PySystem};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadwriteArray2};
use pyo3::exceptions::{PyArithmeticError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use wakeflight::integrate::explicit::{ExplicitFailure, ExplicitMemory, ExplicitStep};
use wakeflight::integrate::fixed::{Counters, FixedMemory, FixedStep, StepFailure};
use wakeflight::integrate::linearised::Linearised;
use wakeflight::system::instant::Instant;

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
    #[pyo3(signature = (system, t, y, rtol, atol, newton_share, kept=0.0))]
    fn new(
        system: &PySystem,
        t: f64,
        y: PyReadonlyArray1<f64>,
        rtol: f64,
        atol: PyReadonlyArray1<f64>,
        newton_share: f64,
        kept: f64,
    ) -> PyResult<Self> {
        let layout = &system.inner.layout;
        let (y, atol) =
            (sized("y", y.as_slice()?, layout.len())?, numbers("atol", atol.as_slice()?, layout.len())?);
        let solver = FixedStep::new(layout, t, y, rtol, atol, newton_share);
        Ok(Self { inner: solver.keeping(kept) })
    }

    /// Linearises at the present state; the rate then satisfies F = 0 with `inputs`.
    fn prepare(&mut self, py: Python<'_>, system: &PySystem, inputs: &PyInputs) -> PyResult<()> {
        let inputs = inputs.fitting(&system.inner)?;
        py.detach(|| self.inner.prepare(&system.inner, inputs)).map_err(failed)
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    fn advance(
        &mut self,
        py: Python<'_>,
        system: &PySystem,
        t1: f64,
        inputs: &PyInputs,
        parts: usize,
    ) -> PyResult<()> {
        let inputs = inputs.fitting(&system.inner)?;
        py.detach(|| self.inner.advance(&system.inner, t1, inputs, parts)).map_err(failed)
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

    /// What the steps to come depend on, exact.
    fn memory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        pack(py, &self.inner.memory())
    }

    /// Goes on from `memory` of the same aircraft.
    fn recall(&mut self, system: &PySystem, memory: &[u8]) -> PyResult<()> {
        let memory: FixedMemory = unpack("integrator", memory)?;
        let n = system.inner.layout.len();
        if memory.size() != n {
            return Err(PyValueError::new_err(format!("integrator of {} states, {n} needed", memory.size())));
        }
        self.inner.recall(&system.inner, memory);
        Ok(())
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
        system: &PySystem,
        t: f64,
        y: PyReadonlyArray1<f64>,
        rtol: f64,
        atol: PyReadonlyArray1<f64>,
    ) -> PyResult<Self> {
        let n = system.inner.layout.len();
        let (y, atol) = (sized("y", y.as_slice()?, n)?, numbers("atol", atol.as_slice()?, n)?);
        let inner = ExplicitStep::new(&system.inner, t, y, rtol, atol)
            .ok_or_else(|| PyValueError::new_err("explicit steps: for blades that do not bend"))?;
        Ok(Self { inner })
    }

    /// The rate then satisfies F = 0 with `inputs`.
    fn prepare(&mut self, system: &PySystem, inputs: &PyInputs) -> PyResult<()> {
        self.inner.prepare(&system.inner, inputs.fitting(&system.inner)?).map_err(stopped)
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    fn advance(&mut self, system: &PySystem, t1: f64, inputs: &PyInputs, parts: usize) -> PyResult<()> {
        self.inner.advance(&system.inner, t1, inputs.fitting(&system.inner)?, parts).map_err(stopped)
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

    /// What the steps to come depend on, exact.
    fn memory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        pack(py, &self.inner.memory())
    }

    /// Goes on from `memory` of the same aircraft.
    fn recall(&mut self, system: &PySystem, memory: &[u8]) -> PyResult<()> {
        let memory: ExplicitMemory = unpack("integrator", memory)?;
        let n = system.inner.layout.len();
        if memory.size() != n {
            return Err(PyValueError::new_err(format!("integrator of {} states, {n} needed", memory.size())));
        }
        self.inner.recall(memory);
        Ok(())
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
    fn new(system: &PySystem) -> Self {
        Self { inner: Linearised::new(&system.inner.layout) }
    }

    /// y_dot that satisfies F = 0 at (t, y), from the guess `y_dot`; linearises there (`renew`), or finds dF/dy_dot alone.
    fn consistent<'py>(
        &mut self,
        py: Python<'py>,
        system: &PySystem,
        at: (f64, PyReadonlyArray1<f64>),
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
        renew: bool,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (linear, system, t) = (&mut self.inner, &system.inner, at.0);
        let (n, inputs) = (system.layout.len(), inputs.fitting(system)?);
        let (y, mut rate) =
            (sized("y", at.1.as_slice()?, n)?, sized("y_dot", y_dot.as_slice()?, n)?.to_vec());
        let solved = if renew {
            linear.consistent(system, (t, y), &mut rate, inputs)
        } else {
            linear.consistent_by_mass(system, (t, y), &mut rate, inputs)
        };
        solved.map_err(|e| PyArithmeticError::new_err(e.to_string()))?;
        Ok(rate.into_pyarray(py))
    }

    /// Linearises at (t, y, y_dot).
    fn renew(
        &mut self,
        system: &PySystem,
        t: f64,
        y: PyReadonlyArray1<f64>,
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
    ) -> PyResult<()> {
        let n = system.inner.layout.len();
        let (y, y_dot) = (sized("y", y.as_slice()?, n)?, sized("y_dot", y_dot.as_slice()?, n)?);
        let at = Instant { t, y, y_dot, inputs: inputs.fitting(&system.inner)? };
        self.inner.renew(&system.inner, &at);
        Ok(())
    }

    /// Finds dF/dy_dot at (t, y); dF/dy is left as it was.
    fn renew_mass(
        &mut self,
        system: &PySystem,
        t: f64,
        y: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
    ) -> PyResult<()> {
        let y = sized("y", y.as_slice()?, system.inner.layout.len())?;
        let at = Instant { t, y, y_dot: y, inputs: inputs.fitting(&system.inner)? };
        self.inner.renew_mass(&system.inner, &at);
        Ok(())
    }

    /// dF/dy + c dF/dy_dot of the instant last linearised at, into `out` (n, n).
    fn matrix(&self, c: f64, mut out: PyReadwriteArray2<f64>) -> PyResult<()> {
        let n = self.inner.slopes.layout().len();
        sized("out", out.as_slice()?, n * n)?;
        self.inner.slopes.dense(1.0, c, out.as_slice_mut()?);
        Ok(())
    }
}

/// Registers the classes of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyFixedStep>()?;
    m.add_class::<PyLinearised>()?;
    m.add_class::<PyExplicitStep>()
}
