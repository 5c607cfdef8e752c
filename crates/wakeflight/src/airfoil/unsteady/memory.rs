//! What a section remembers: its states eliminated, so that whoever asks for its loads gives the motion of the instant alone.
//!
//! Over a coupling step the states follow from those of its start with drives linear in time up to now; in a motion that repeats
//! they lag behind what they follow by what its revolution leaves. Either way they depend on the motion of the instant, with
//! derivatives, and need no place in y.

use super::lag::{Drive, Law, MAX_STATES, States, behind, equilibrium, followed, periodic};
use super::model::{Model, of_law};
use super::{Coefficients, Flow, Section};
use crate::numerics::scalar::{Dual, Real};
use serde::{Deserialize, Serialize};

/// Derivatives by angles of attack, pitch rates and speed.
type D = Dual<5>;

/// States and drives of a section at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    states: States<f64>,
    /// Input and rate of every drive.
    drives: [[f64; 2]; MAX_STATES],
}

/// What is known of the states of a section besides the flow of the instant.
#[derive(Clone, Copy, Debug)]
pub enum Past<'a> {
    /// A step that began `elapsed` [s] ago.
    Step {
        /// Its start.
        memory: &'a Memory,
        /// Time since [s].
        elapsed: f64,
    },
    /// A motion that repeats: the states lag behind what they follow by as much as in this memory of it.
    Periodic(&'a Memory),
}

/// Coefficients that make the loads of a section and its circulation; see [`Coefficients`].
#[derive(Clone, Copy, Debug)]
pub struct Loads<S> {
    /// Lift.
    pub cl: S,
    /// Lift that is circulation.
    pub circulatory: S,
    /// Drag.
    pub cd: S,
    /// Moment about the quarter chord, damping included.
    pub cm: S,
}

impl<S: Real> Loads<S> {
    fn of<T: Copy>(all: &Coefficients<T>, lifted: impl Fn(T) -> S) -> Self {
        Self {
            cl: lifted(all.cl),
            circulatory: lifted(all.circulatory),
            cd: lifted(all.cd),
            cm: lifted(all.cm),
        }
    }
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

    /// How far the states lag behind what they follow.
    fn lags(&self) -> States<f64> {
        std::array::from_fn(|k| self.drives[k][0] - self.states[k])
    }

    fn drives<S: Real>(&self) -> [Drive<S>; MAX_STATES] {
        self.drives.map(|[input, rate]| Drive { input: S::cst(input), rate: S::cst(rate) })
    }
}

impl Past<'_> {
    fn states<L: Law, S: Real>(&self, law: &L, section: &Section, flow: &Flow<S>) -> States<S> {
        match self {
            Self::Step { memory, elapsed } => {
                followed(law, section, &memory.states.map(S::cst), &memory.drives(), flow, *elapsed)
            }
            Self::Periodic(memory) => behind(law, section, &memory.lags(), flow),
        }
    }
}

impl Model {
    /// Memory of a section at rest in `flow`.
    pub fn at_rest(self, section: &Section, flow: &Flow<f64>) -> Memory {
        of_law!(self, law => Memory::of(law, section, flow, equilibrium(law, section, flow)))
    }

    /// Coefficients in the flow of the instant.
    ///
    /// They depend on five numbers: whatever carries derivatives gets them by the chain rule from those by the five.
    pub fn remembering<S: Real>(self, section: &Section, past: Past, flow: &Flow<S>) -> Loads<S> {
        let by = [flow.alpha, flow.alpha_quarter, flow.pitch_rate, flow.turn_rate, flow.speed];
        let [alpha, alpha_quarter, pitch_rate, turn_rate, speed] = by.map(S::re);
        let speed_of_sound = flow.speed_of_sound;
        if S::PLAIN {
            let plain = Flow { alpha, alpha_quarter, pitch_rate, turn_rate, speed, speed_of_sound };
            return Loads::of(&self.coefficients_of(section, past, &plain), S::cst);
        }
        let flow = Flow {
            alpha: D::variable(alpha, 0),
            alpha_quarter: D::variable(alpha_quarter, 1),
            pitch_rate: D::variable(pitch_rate, 2),
            turn_rate: D::variable(turn_rate, 3),
            speed: D::variable(speed, 4),
            speed_of_sound,
        };
        let chained = |found: D| {
            let rest = by[1..].iter().zip(&found.eps[1..]);
            rest.fold(by[0].chain(found.re, found.eps[0]), |sum, (x, slope)| sum + x.chain(0.0, *slope))
        };
        Loads::of(&self.coefficients_of(section, past, &flow), chained)
    }

    #[inline(never)]
    fn coefficients_of<S: Real>(self, section: &Section, past: Past, flow: &Flow<S>) -> Coefficients<S> {
        of_law!(self, law => law.coefficients(section, flow, &past.states(law, section, flow)))
    }

    /// Memory in the flow of the instant, in which a step starts.
    pub fn kept(self, section: &Section, past: Past, flow: &Flow<f64>) -> Memory {
        of_law!(self, law => Memory::of(law, section, flow, past.states(law, section, flow)))
    }

    /// Memory at instants `dt` [s] apart of a flow that repeats.
    pub fn periodic(self, section: &Section, flows: &[Flow<f64>], dt: f64) -> Vec<Memory> {
        of_law!(self, law => {
            let states = periodic(law, section, flows, dt);
            flows.iter().zip(states).map(|(flow, states)| Memory::of(law, section, flow, states)).collect()
        })
    }
}
