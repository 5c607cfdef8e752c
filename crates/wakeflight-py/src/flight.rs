//! Fixed-step integration and derivatives for a solver from elsewhere: conversions and checks, the GIL released.

use crate::checks::{Array, Room, Row, array, failed, invalid, numbers, pack, room, unpack};
use crate::inputs::PyInputs;
use crate::system::PySystem;
use numpy::Ix2;
use pyo3::prelude::*;
use wakeflight::integrate::steps::Steps;
use wakeflight::integrate::{explicit, fixed, linearised};

/// Fixed steps: Radau IIA, or explicit ones for blades that do not bend; see `wakeflight.integrators`.
#[pyclass]
pub struct FixedStep(Steps);

#[pymethods]
impl FixedStep {
    /// Radau IIA at state `y` and time `t` [s], with tolerances; `newton_share` of them is what the Newton iteration may leave;
    /// dF/dy is kept over an azimuth of `kept` [rad].
    #[new]
    #[pyo3(signature = (system, t, y, rtol, atol, newton_share, kept=0.0))]
    fn new(
        system: &PySystem,
        t: f64,
        y: Row,
        rtol: f64,
        atol: Row,
        newton_share: f64,
        kept: f64,
    ) -> PyResult<Self> {
        let (y, atol) = (system.state("y", &y)?, numbers("atol", &atol, system.inner.layout.len())?);
        let solver = fixed::FixedStep::new(&system.inner.layout, t, y, rtol, atol, newton_share);
        Ok(Self(Steps::Implicit(Box::new(solver.keeping(kept)))))
    }

    /// Explicit steps, with the tolerances that guard them.
    #[staticmethod]
    fn explicit(system: &PySystem, t: f64, y: Row, rtol: f64, atol: Row) -> PyResult<Self> {
        let (y, atol) = (system.state("y", &y)?, numbers("atol", &atol, system.inner.layout.len())?);
        let solver = explicit::ExplicitStep::new(&system.inner, t, y, rtol, atol);
        let solver = solver.ok_or_else(|| invalid("explicit steps: for blades that do not bend"))?;
        Ok(Self(Steps::Explicit(Box::new(solver))))
    }

    /// The rate then satisfies F = 0 with `inputs`; implicit steps linearise at the present state.
    fn prepare(&mut self, py: Python<'_>, system: &PySystem, inputs: &PyInputs) -> PyResult<()> {
        let inputs = inputs.fitting(system)?;
        py.detach(|| self.0.prepare(&system.inner, inputs)).map_err(failed)
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
        let inputs = inputs.fitting(system)?;
        py.detach(|| self.0.advance(&system.inner, t1, inputs, parts)).map_err(failed)
    }

    /// State.
    fn state(&self) -> Array {
        array(self.0.state(), &[])
    }

    /// Rate of state.
    fn rate(&self) -> Array {
        array(self.0.rate(), &[])
    }

    /// Residual evaluations, Jacobians, factorisations, Newton iterations, steps, halvings.
    fn counters(&self) -> [u64; 6] {
        self.0.counters().all()
    }

    /// What the steps to come depend on, exact.
    fn memory(&self) -> PyResult<Vec<u8>> {
        pack(&self.0.memory())
    }

    /// Goes on from `memory` of the same aircraft.
    fn recall(&mut self, system: &PySystem, memory: &[u8]) -> PyResult<()> {
        self.0.recall(&system.inner, unpack("integrator", memory)?).map_err(invalid)
    }
}

/// F linearised once for a solver that asks for its derivatives again and again; see `wakeflight.integrators`.
#[pyclass]
pub struct Linearised(linearised::Linearised);

#[pymethods]
impl Linearised {
    #[new]
    fn new(system: &PySystem) -> Self {
        Self(linearised::Linearised::new(&system.inner.layout))
    }

    /// y_dot that satisfies F = 0 at (t, y), from the guess `y_dot`; finds dF/dy_dot there, and dF/dy (`whole`) or leaves that.
    fn consistent(
        &mut self,
        system: &PySystem,
        at: (f64, Row),
        y_dot: Row,
        inputs: &PyInputs,
        whole: bool,
    ) -> PyResult<Array> {
        let (y, mut rate) = (system.state("y", &at.1)?, system.state("y_dot", &y_dot)?.to_vec());
        let (system, inputs) = (&system.inner, inputs.fitting(system)?);
        self.0.consistent(system, (at.0, y), &mut rate, inputs, whole).map_err(failed)?;
        Ok(array(rate, &[]))
    }

    /// Finds dF/dy_dot at (t, y, y_dot), and dF/dy (`whole`) or leaves that as it was.
    fn renew(
        &mut self,
        system: &PySystem,
        at: (f64, Row),
        y_dot: Row,
        inputs: &PyInputs,
        whole: bool,
    ) -> PyResult<()> {
        self.0.renew(&system.inner, &system.at(at.0, &at.1, &y_dot, inputs)?, whole);
        Ok(())
    }

    /// dF/dy + c dF/dy_dot of the instant last linearised at, into `out` (n, n).
    fn matrix(&self, c: f64, mut out: Room<Ix2>) -> PyResult<()> {
        let n = self.0.slopes.layout().len();
        self.0.slopes.dense(1.0, c, room(&mut out, n * n)?);
        Ok(())
    }
}
