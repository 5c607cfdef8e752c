//! A section by itself, in harmonic motion.

use crate::checks::{failed, invalid};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use serde::Deserialize;
use wakeflight::airfoil::span::SpanSections;
use wakeflight::airfoil::unsteady::{Coefficients, Cycle, CycleError, Model, Motion, Oscillation};

/// Names of the models of a section in time.
#[pyfunction]
pub fn unsteady_models() -> Vec<&'static str> {
    Model::ALL.map(|(name, _)| name).to_vec()
}

/// What is asked, as Python gives it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    sections: SpanSections,
    station: f64,
    model: Model,
    mean: f64,
    amplitude: f64,
    reduced_frequency: f64,
    mach: f64,
    pitch_axis: Option<f64>,
    steps: usize,
}

/// A cycle that repeats.
#[pyclass(frozen)]
pub struct AirfoilCycle {
    cycle: Cycle,
    model: Model,
}

/// Cycle of a section, as JSON tells it: sections along the span, station [m], model, mean and amplitude [rad], reduced
/// frequency, Mach number, pitch axis (null: plunge), steps.
#[pyfunction]
pub fn airfoil_cycle(py: Python<'_>, asked_json: &str) -> PyResult<AirfoilCycle> {
    let asked: Asked = serde_json::from_str(asked_json).map_err(invalid)?;
    let airfoils = asked.sections.at([asked.station]);
    let oscillation = Oscillation {
        mean: asked.mean,
        amplitude: asked.amplitude,
        reduced_frequency: asked.reduced_frequency,
        mach: asked.mach,
        motion: asked.pitch_axis.map_or(Motion::Plunge, |axis| Motion::Pitch { axis }),
        steps: asked.steps,
    };
    match py.detach(|| Cycle::of(airfoils.at(0), asked.model, &oscillation)) {
        Ok(cycle) => Ok(AirfoilCycle { cycle, model: asked.model }),
        Err(error @ CycleError::Value { .. }) => Err(invalid(error)),
        Err(error) => Err(failed(error)),
    }
}

impl AirfoilCycle {
    fn column<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Coefficients<f64>) -> f64,
    ) -> Bound<'py, PyArray1<f64>> {
        self.cycle.coefficients.iter().map(of).collect::<Vec<_>>().into_pyarray(py)
    }
}

#[pymethods]
impl AirfoilCycle {
    /// Phase (steps,) [rad].
    #[getter]
    fn phase<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.cycle.phase.clone().into_pyarray(py)
    }

    /// Pitch or plunge angle (steps,) [rad].
    #[getter]
    fn alpha<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.cycle.alpha.clone().into_pyarray(py)
    }

    /// Lift coefficient (steps,).
    #[getter]
    fn cl<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |c| c.cl)
    }

    /// Lift coefficient that is circulation (steps,).
    #[getter]
    fn cl_circulatory<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |c| c.circulatory)
    }

    /// Drag coefficient (steps,).
    #[getter]
    fn cd<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |c| c.cd)
    }

    /// Moment coefficient about the quarter chord (steps,).
    #[getter]
    fn cm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |c| c.cm)
    }

    /// Normal force coefficient (steps,).
    #[getter]
    fn cn<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.cycle.cn.clone().into_pyarray(py)
    }

    /// Angle of attack that the shed wake leaves (steps,) [rad].
    #[getter]
    fn alpha_effective<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |c| c.alpha_effective)
    }

    /// Separation point over the chord (steps,).
    #[getter]
    fn separation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |c| c.separation)
    }

    /// Names of the model's states.
    #[getter]
    fn state_names(&self) -> Vec<&'static str> {
        self.model.state_names().to_vec()
    }

    /// Keys of the model's sources.
    #[getter]
    fn sources(&self) -> Vec<&'static str> {
        self.model.sources().to_vec()
    }

    /// States (steps, n_states).
    #[getter]
    fn states<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let n = self.model.state_names().len();
        let rows: Vec<f64> = self.cycle.states.iter().flat_map(|x| x[..n].iter().copied()).collect();
        rows.into_pyarray(py).reshape([self.cycle.states.len(), n])
    }

    /// Work of the air on the section in a cycle, over rho V^2 c^2/2 per span.
    #[getter]
    fn work(&self) -> f64 {
        self.cycle.work
    }

    /// Cycles until the states repeated.
    #[getter]
    fn cycles(&self) -> usize {
        self.cycle.cycles
    }
}
