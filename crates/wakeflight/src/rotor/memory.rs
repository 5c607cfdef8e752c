//! What the sections of a rotor remember: over a coupling step of its blades, and in a periodic motion of one of them.

use super::circulation::BladeInstant;
use super::hub::Rotor;
use crate::airfoil::unsteady::{Flow, Memory, Section};
use crate::blade::aerodynamics::Air;
use crate::blade::hub_motion::HubMotion;
use crate::blade::memory_rows::MemoryRows;
use crate::blade::sections_in_time::{BladePast, SectionLaw};
use crate::blade::surroundings::BladeInflow;

impl Rotor {
    /// Whether `memory` is that of `rows` rows of its stations, or none where sections do not remember.
    pub fn remembers(&self, memory: &MemoryRows, rows: usize) -> bool {
        let needed = if self.sections.is_some() { [rows, self.blade.stations.len()] } else { [0, 0] };
        memory.shape() == needed
    }

    /// Flow at every station of a blade.
    fn flows(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blade: &BladeInstant,
        inflow: &BladeInflow<f64>,
    ) -> Vec<Flow<f64>> {
        let environment = self.environment(air);
        self.blade.flows(environment, hub, blade.psi, &blade.modal, &blade.control, inflow).collect()
    }

    /// Memory of a blade's sections where a step begins, from the `past` that led there; empty where they do not remember.
    pub fn kept(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blade: &BladeInstant,
        inflow: &BladeInflow<f64>,
        past: Option<BladePast>,
    ) -> Vec<Memory> {
        let (Some(law), Some(past)) = (&self.sections, past) else { return Vec::new() };
        let flows = self.flows(air, hub, blade, inflow);
        let kept = flows.iter().enumerate();
        kept.map(|(j, flow)| law.model.kept(&self.section(law, j), past.at(j), flow)).collect()
    }

    /// Memory of a blade at every azimuth (n_azimuths,), `dt` [s] apart, of a motion that repeats in the inflow given there.
    pub fn periodic_memory<'a>(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        (blades, dt): (&[BladeInstant], f64),
        inflow: impl Fn(usize) -> BladeInflow<'a, f64>,
    ) -> MemoryRows {
        let Some(law) = &self.sections else { return MemoryRows::default() };
        let (n, n_stations) = (blades.len(), self.blade.stations.len());
        let flows: Vec<Vec<Flow<f64>>> =
            blades.iter().enumerate().map(|(k, blade)| self.flows(air, hub, blade, &inflow(k))).collect();
        let of_stations: Vec<Vec<Memory>> = (0..n_stations)
            .map(|j| {
                let turn: Vec<Flow<f64>> = flows.iter().map(|row| row[j]).collect();
                law.model.periodic(&self.section(law, j), &turn, dt)
            })
            .collect();
        let rows = (0..n).flat_map(|k| of_stations.iter().map(move |station| station[k]));
        MemoryRows::new(rows.collect(), n_stations)
    }

    fn section<'a>(&'a self, law: &'a SectionLaw, j: usize) -> Section<'a> {
        law.section(j, self.airfoils.at(j), self.blade.stations[j].geometry.chord)
    }
}
