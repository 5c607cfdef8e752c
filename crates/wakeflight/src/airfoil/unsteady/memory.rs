//! What a section remembers over a coupling step: its states eliminated, F sees the motion alone.
//!
//! At any instant of the step the states are those that follow from the step's start with drives linear in time up to now. They
//! depend on the motion of the instant, exactly and with derivatives, and need no place in y; at the end of the step they are kept.

use super::lag::{Drive, Law, MAX_STATES, States, equilibrium, followed};
use super::model::{Model, of_law};
use super::{Coefficients, Flow, Section};
use crate::numerics::scalar::Real;
use serde::{Deserialize, Serialize};

/// States and drives of a section at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    states: States<f64>,
    /// Input and rate of every drive.
    drives: [[f64; 2]; MAX_STATES],
}

impl Memory {
    fn of<L: Law>(law: &L, section: &Section, flow: &Flow<f64>, states: States<f64>) -> Self {
        let drives = law.drives(section, flow, &states).map(|d| [d.input, d.rate]);
        Self { states, drives }
    }

    /// The states.
    pub fn states(&self) -> &States<f64> {
        &self.states
    }

    fn drives<S: Real>(&self) -> [Drive<S>; MAX_STATES] {
        self.drives.map(|[input, rate]| Drive { input: S::cst(input), rate: S::cst(rate) })
    }
}

impl Model {
    /// Memory of a section at rest in `flow`.
    pub fn at_rest(self, section: &Section, flow: &Flow<f64>) -> Memory {
        of_law!(self, law => Memory::of(law, section, flow, equilibrium(law, section, flow)))
    }

    /// Coefficients `elapsed` [s] after the step's start, in the flow of the instant.
    pub fn remembering<S: Real>(
        self,
        section: &Section,
        memory: &Memory,
        flow: &Flow<S>,
        elapsed: f64,
    ) -> Coefficients<S> {
        of_law!(self, law => {
            let before = memory.states.map(S::cst);
            let states = followed(law, section, &before, &memory.drives(), flow, elapsed);
            law.coefficients(section, flow, &states)
        })
    }

    /// Memory after a step of `elapsed` [s] that ended in `flow`, in which the next one starts.
    pub fn kept(self, section: &Section, memory: &Memory, flow: &Flow<f64>, elapsed: f64) -> Memory {
        of_law!(self, law => {
            let states = followed(law, section, &memory.states, &memory.drives(), flow, elapsed);
            Memory::of(law, section, flow, states)
        })
    }
}
