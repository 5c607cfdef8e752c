//! What a section remembers over a coupling step: its states eliminated, F sees the motion alone.
//!
//! At any instant of the step the states are those that follow from the step's start with drives linear in time up to now. They
//! depend on the motion of the instant, exactly and with derivatives, and need no place in y; at the end of the step they are kept.

use super::lag::{Drive, Law, MAX_STATES, States, equilibrium, followed};
use super::model::Model;
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
        self.with(Rest { section, flow })
    }

    /// Coefficients `elapsed` [s] after the step's start, in the flow of the instant.
    pub fn remembering<S: Real>(
        self,
        section: &Section,
        memory: &Memory,
        flow: &Flow<S>,
        elapsed: f64,
    ) -> Coefficients<S> {
        self.with(Now { section, memory, flow, elapsed })
    }

    /// Memory after a step of `dt` [s] that ended in `flow`; the next one starts in `ahead`.
    ///
    /// Between the two the inflow that is held jumps. States that follow the motion of the air take the jump with them: a staircase
    /// of inflow sends no waves.
    pub fn kept(
        self,
        section: &Section,
        memory: &Memory,
        flow: &Flow<f64>,
        dt: f64,
    ) -> Memory {
        self.with(Kept { section, memory, flow, dt })
    }
}

/// Something asked of a law.
pub(super) trait Ask {
    /// Answer.
    type Answer;
    /// Asked of a law with states.
    fn of<L: Law>(self, law: &L) -> Self::Answer;
}

struct Rest<'a> {
    section: &'a Section<'a>,
    flow: &'a Flow<f64>,
}

impl Ask for Rest<'_> {
    type Answer = Memory;
    fn of<L: Law>(self, law: &L) -> Memory {
        Memory::of(law, self.section, self.flow, equilibrium(law, self.section, self.flow))
    }
}

struct Now<'a, S> {
    section: &'a Section<'a>,
    memory: &'a Memory,
    flow: &'a Flow<S>,
    elapsed: f64,
}

impl<S: Real> Ask for Now<'_, S> {
    type Answer = Coefficients<S>;
    fn of<L: Law>(self, law: &L) -> Coefficients<S> {
        let before = self.memory.states.map(S::cst);
        let states =
            followed(law, self.section, &before, &self.memory.drives(), self.flow, self.elapsed);
        law.coefficients(self.section, self.flow, &states)
    }
}

struct Kept<'a> {
    section: &'a Section<'a>,
    memory: &'a Memory,
    flow: &'a Flow<f64>,
    dt: f64,
}

impl Ask for Kept<'_> {
    type Answer = Memory;
    fn of<L: Law>(self, law: &L) -> Memory {
        let states =
            followed(law, self.section, &self.memory.states, &self.memory.drives(), self.flow, self.dt);
        Memory::of(law, self.section, self.flow, states)
    }
}
