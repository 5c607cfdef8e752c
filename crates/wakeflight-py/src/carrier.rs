//! What meets the air: controls, hub motion, blade motion of a system, checked on their way to the exchange.

use crate::checks::{Motion, Row, Table, invalid, map, numbers, sized};
use crate::inputs::PyInputs;
use crate::system::PySystem;
use pyo3::prelude::*;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::memory_rows::MemoryRows;
use wakeflight::rotor::exchange::Place;
use wakeflight::rotor::speed::Turning;
use wakeflight::system::blades::Controls;
use wakeflight::system::instant::{HeldInflow, Inputs, Instant};
use wakeflight::trim::host::Host;

impl PyInputs {
    /// The inputs, which must have an inflow for every rotor of `system`, of its stations.
    pub fn fitting(&self, system: &PySystem) -> PyResult<&Inputs> {
        let (found, needed) = (self.0.inflow.len(), system.inner.rotors.len());
        if found != needed {
            return Err(invalid(format!("inflow of {found} rotors, {needed} needed")));
        }
        if let Some(d) = &self.0.disturbance {
            let (found, rotors) =
                (d.gust.as_ref().map_or(0, |gust| gust.stations.len()), &system.inner.rotors);
            let needed = rotors[0].n_blades * rotors[0].blade.stations.len();
            if found != 0 && found != needed {
                return Err(invalid(format!("wind at {found} blade stations, {needed} needed")));
            }
            if rotors.len() > d.speed.len() {
                return Err(invalid("wind: for one rotor with blades"));
            }
        }
        let none = MemoryRows::default();
        for (held, (r, rotor, l)) in self.0.inflow.iter().zip(system.inner.each_rotor()) {
            let memory = self.0.sections.get(r).map_or(&none, |held| &held.memory);
            if !matches!(held, HeldInflow::Vacuum) && !rotor.remembers(memory, rotor.n_blades) {
                let [rows, stations] = memory.shape();
                let asked = if rotor.sections.is_some() {
                    format!("({}, {}) needed", rotor.n_blades, rotor.blade.stations.len())
                } else {
                    "but those of this rotor do not remember".into()
                };
                return Err(invalid(format!("sections: memory of ({rows}, {stations}), {asked}")));
            }
            let needed = rotor.n_blades * rotor.inflow_width();
            match held {
                HeldInflow::Stations { inflow, .. } if inflow.len() != needed => {
                    return Err(invalid(format!("inflow has {} numbers, {needed} needed", inflow.len())));
                }
                HeldInflow::Dynamic if !l.dynamic_inflow => {
                    return Err(invalid("inflow: needed, there are no inflow states"));
                }
                _ => {}
            }
        }
        Ok(&self.0)
    }
}

impl PySystem {
    /// Where F is asked.
    pub fn at<'a>(
        &self,
        t: f64,
        y: &'a Row,
        y_dot: &'a Row,
        inputs: &'a PyInputs,
    ) -> PyResult<Instant<'a, f64>> {
        let (y, y_dot) = (self.state("y", y)?, self.state("y_dot", y_dot)?);
        Ok(Instant { t, y, y_dot, inputs: inputs.fitting(self)? })
    }

    /// A state, or its rate; whether it is finite is for the solver to say.
    pub fn state<'a>(&self, name: &str, y: &'a Row) -> PyResult<&'a [f64]> {
        sized(name, y, self.inner.layout.len())
    }

    /// Rotor, air and ground at `y`, with a motion of the hub, at the nominal speed.
    pub fn place<'a>(&'a self, hub: &'a HubMotion<f64>, y: &Row) -> PyResult<Place<'a>> {
        let (rotor, ground) = (self.inner.main(), self.inner.ground_plane(self.state("y", y)?));
        let turning = Turning::steady(rotor.omega);
        let airframe = self.inner.airframe_in_wake();
        Ok(Place { rotor, air: self.inner.air, hub, turning, gust: &[], ground, airframe })
    }

    /// Motion of the hub at `y`.
    pub fn hub_at(&self, y: &Row) -> PyResult<HubMotion<f64>> {
        Ok(self.inner.steady_hub(numbers("y", y, self.inner.layout.len())?))
    }

    /// Controls, of which there must be as many as the system has.
    pub fn controls(&self, name: &str, given: &Row) -> PyResult<[f64; 4]> {
        let given = numbers(name, given, self.inner.controls().len())?;
        Ok(std::array::from_fn(|i| given.get(i).copied().unwrap_or(0.0)))
    }

    /// Controls and their rates.
    pub fn moving(&self, (stick, rate): &(Row, Row)) -> PyResult<Controls> {
        Ok(Controls {
            stick: self.controls("stick", stick)?,
            rate: self.controls("stick_rate", rate)?,
            turning: None,
        })
    }

    /// Motion of blades (rows, n_modes).
    pub fn motions(&self, (q, q_dot): &Motion, rows: usize) -> PyResult<Vec<ModalMotion<f64>>> {
        let n = self.inner.main().blade.n_modes;
        let (q, q_dot) = (map("q", q, rows, n)?, map("q_dot", q_dot, rows, n)?);
        let row = |k: usize| k * n..(k + 1) * n;
        Ok((0..rows).map(|k| ModalMotion::of(&q[row(k)], &q_dot[row(k)])).collect())
    }

    /// Total inflow (rows, n_stations), of thin sections also twice as wide.
    pub fn inflow(&self, table: &Table, rows: usize) -> PyResult<Vec<f64>> {
        let (rotor, width) = (self.inner.main(), table.as_array().ncols());
        let n = if width == rotor.inflow_width() { width } else { rotor.blade.stations.len() };
        map("inflow", table, rows, n)
    }
}
