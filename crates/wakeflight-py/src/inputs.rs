//! What acts on the system over a coupling step: controls, held inflow, engines, wind, memory of the sections.

use crate::checks::{Table, columns, invalid, pack};
use crate::wind::PyAir;
use pyo3::prelude::*;
use wakeflight::blade::memory_rows::MemoryRows;
use wakeflight::system::instant::{Carried, EngineInput, HeldInflow, HeldMemory, Inputs};
use wakeflight::wake::airframe::{AtParts, PARTS};

/// Memory of sections that remember, blade by blade, where a coupling step begins; see `wakeflight.exchange`.
#[pyclass(frozen)]
pub struct SectionMemory(pub(crate) MemoryRows);

#[pymethods]
impl SectionMemory {
    /// Everything of it, exact.
    fn to_bytes(&self) -> PyResult<Vec<u8>> {
        pack(&self.0)
    }
}

/// Memory for Python; None where sections do not remember.
pub(crate) fn remembered(memory: &MemoryRows) -> Option<SectionMemory> {
    (!memory.is_empty()).then(|| SectionMemory(memory.clone()))
}

/// What acts on the system over one coupling step; see `wakeflight.flight`.
#[pyclass(name = "Inputs", frozen)]
pub struct PyInputs(pub(crate) Inputs);

#[pymethods]
impl PyInputs {
    /// Sticks [m] and rates [m/s] at `t_start` [s]; inflow (n_blades, n_stations), None for the states of y.
    #[new]
    #[pyo3(signature = (stick, stick_rate, t_start, inflow, mean_inflow, stabilator_incidence, vacuum=false))]
    fn new(
        stick: [f64; 4],
        stick_rate: [f64; 4],
        t_start: f64,
        inflow: Option<Table>,
        mean_inflow: f64,
        stabilator_incidence: f64,
        vacuum: bool,
    ) -> PyResult<Self> {
        let inflow = match (inflow, vacuum) {
            (_, true) => HeldInflow::Vacuum,
            (None, false) => HeldInflow::Dynamic,
            (Some(map), false) => HeldInflow::stations(map.as_array().iter().copied().collect(), mean_inflow),
        };
        Ok(Self(Inputs {
            stick,
            stick_rate,
            t_start,
            inflow: vec![inflow],
            wash: None,
            sections: Vec::new(),
            stabilator_incidence,
            engine: EngineInput::default(),
            disturbance: None,
        }))
    }

    /// The same with inflow that is `change` (n_blades, n_stations) more at the end of the coupling step, which begins at `begun` [s] and
    /// lasts `lasts` [s].
    fn carried(&self, change: Table, begun: f64, lasts: f64) -> PyResult<Self> {
        if !(begun.is_finite() && lasts.is_finite() && lasts > 0.0) {
            return Err(invalid(format!(
                "step of {lasts} s from {begun} s: a finite length above zero needed"
            )));
        }
        let mut inputs = self.0.clone();
        let change: Vec<f64> = change.as_array().iter().copied().collect();
        match inputs.inflow.first_mut() {
            Some(HeldInflow::Stations { inflow, carried, .. }) if inflow.len() == change.len() => {
                *carried = Some(Carried { change, begun, lasts });
                Ok(Self(inputs))
            }
            _ => Err(invalid("change of the inflow: as many numbers as inflow is held of needed")),
        }
    }

    /// The same with engines, torque of those without a governor [N m] and share of the fuel of those with one, and in a wind.
    #[pyo3(signature = (engines=None, air=None))]
    fn under(&self, engines: Option<(f64, f64)>, air: Option<&PyAir>) -> Self {
        let mut inputs = self.0.clone();
        if let Some((torque, fuel)) = engines {
            inputs.engine = EngineInput { torque, fuel };
        }
        Self(match air {
            Some(air) => inputs.blown(&air.inner, air.n_stations),
            None => inputs,
        })
    }

    /// The same with the air of the wake at fuselage, stabilator, fin and tail rotor (4, 3) [m/s], body axes, in place of washes.
    fn washed(&self, wash: Table) -> PyResult<Self> {
        Ok(Self(Inputs { wash: Some(at_parts(&wash)?), ..self.0.clone() }))
    }

    /// The same with the memory of sections that remember, from the begin of the coupling step at `begun` [s].
    fn remembering(&self, sections: &SectionMemory, begun: f64) -> Self {
        Self(Inputs { sections: vec![HeldMemory { memory: sections.0.clone(), begun }], ..self.0.clone() })
    }
}

/// Air at the parts of an airframe (4, 3).
pub(crate) fn at_parts(wash: &Table) -> PyResult<AtParts> {
    let rows = columns("wash", wash)?;
    rows.try_into()
        .map_err(|rows: Vec<[f64; 3]>| invalid(format!("wash: {} parts, {} needed", rows.len(), PARTS.len())))
}
