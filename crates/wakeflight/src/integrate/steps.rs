//! Fixed steps behind one door: implicit for blades that bend, explicit for rigid ones.

use super::explicit::{ExplicitFailure, ExplicitMemory, ExplicitStep};
use super::fixed::{Counters, FixedMemory, FixedStep, StepFailure};
use crate::system::instant::Inputs;
use crate::system::model::System;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// One of the methods, with all that it keeps between steps.
#[derive(Clone, Debug)]
pub enum Steps {
    /// Radau IIA.
    Implicit(Box<FixedStep>),
    /// Runge-Kutta.
    Explicit(Box<ExplicitStep>),
}

/// What the steps to come depend on.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum Memory {
    /// Of the implicit method.
    Implicit(FixedMemory),
    /// Of the explicit one.
    Explicit(ExplicitMemory),
}

/// A step that could not be taken.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Stopped {
    /// By the implicit method.
    #[error(transparent)]
    Implicit(#[from] StepFailure),
    /// By the explicit one.
    #[error(transparent)]
    Explicit(#[from] ExplicitFailure),
}

/// A memory that is not of these steps.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NoMemory {
    /// Of another method.
    #[error("integrator: memory of another method")]
    Method,
    /// Of another system.
    #[error("integrator of {found} states, {needed} needed")]
    Size {
        /// States in the memory.
        found: usize,
        /// States of the system.
        needed: usize,
    },
}

impl Steps {
    /// Finds the rate that satisfies F = 0 with `inputs` from now on.
    pub fn prepare(&mut self, system: &System, inputs: &Inputs) -> Result<(), Stopped> {
        match self {
            Self::Implicit(steps) => Ok(steps.prepare(system, inputs)?),
            Self::Explicit(steps) => Ok(steps.prepare(system, inputs)?),
        }
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    pub fn advance(
        &mut self,
        system: &System,
        t1: f64,
        inputs: &Inputs,
        parts: usize,
    ) -> Result<(), Stopped> {
        match self {
            Self::Implicit(steps) => Ok(steps.advance(system, t1, inputs, parts)?),
            Self::Explicit(steps) => Ok(steps.advance(system, t1, inputs, parts)?),
        }
    }

    /// State.
    pub fn state(&self) -> &[f64] {
        match self {
            Self::Implicit(steps) => steps.state(),
            Self::Explicit(steps) => steps.state(),
        }
    }

    /// Its rate.
    pub fn rate(&self) -> &[f64] {
        match self {
            Self::Implicit(steps) => steps.rate(),
            Self::Explicit(steps) => steps.rate(),
        }
    }

    /// Counted work.
    pub fn counters(&self) -> Counters {
        match self {
            Self::Implicit(steps) => steps.counters(),
            Self::Explicit(steps) => steps.counters(),
        }
    }

    /// What the steps to come depend on.
    pub fn memory(&self) -> Memory {
        match self {
            Self::Implicit(steps) => Memory::Implicit(steps.memory()),
            Self::Explicit(steps) => Memory::Explicit(steps.memory()),
        }
    }

    /// Goes on from `memory`, which must be of this method and of `system`.
    pub fn recall(&mut self, system: &System, memory: Memory) -> Result<(), NoMemory> {
        let needed = system.layout.len();
        let found = match &memory {
            Memory::Implicit(memory) => memory.size(),
            Memory::Explicit(memory) => memory.size(),
        };
        if found != needed {
            return Err(NoMemory::Size { found, needed });
        }
        match (self, memory) {
            (Self::Implicit(steps), Memory::Implicit(memory)) => steps.recall(system, memory),
            (Self::Explicit(steps), Memory::Explicit(memory)) => steps.recall(memory),
            (Self::Implicit(_), Memory::Explicit(_)) | (Self::Explicit(_), Memory::Implicit(_)) => {
                return Err(NoMemory::Method);
            }
        }
        Ok(())
    }
}
