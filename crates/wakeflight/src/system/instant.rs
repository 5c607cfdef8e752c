//! Where F is asked: time, state, its rate, and what acts.
//!
//! What acts is plain numbers, or numbers with derivatives where F is differentiated by them.

use crate::blade::held_row::HeldRow;
use crate::blade::memory_rows::MemoryRows;
use crate::blade::surroundings::BladeInflow;
use crate::numerics::scalar::{Dual, Real};
use crate::rotor::hub::Rotor;
use crate::wake::AtParts;
use crate::wind::places::Air;
use serde::{Deserialize, Serialize};

/// A number of what acts, in equations over the scalar `S`.
pub trait Acting<S>: Real {
    /// As a number of the equations.
    fn felt(self) -> S;
    /// A row of held inflow of a blade; with `carried` its change over the step, and the share of it that has passed.
    fn held<'a>(rotor: &Rotor, row: &'a [Self], carried: Option<(&'a [f64], f64)>) -> BladeInflow<'a, S>;
}

impl<S: Real> Acting<S> for f64 {
    #[inline(always)]
    fn felt(self) -> S {
        S::cst(self)
    }
    #[inline(always)]
    fn held<'a>(rotor: &Rotor, row: &'a [f64], carried: Option<(&'a [f64], f64)>) -> BladeInflow<'a, S> {
        rotor.held_inflow(
            carried.map_or(HeldRow::from(row), |(change, share)| HeldRow::carried(row, change, share)),
        )
    }
}

impl<const N: usize> Acting<Dual<N>> for Dual<N> {
    fn felt(self) -> Self {
        self
    }
    /// On a lifting line: thin sections hold two inflows and have no derivatives by them. Numbers of an instant are not carried.
    fn held<'a>(_: &Rotor, row: &'a [Self], _: Option<(&'a [f64], f64)>) -> BladeInflow<'a, Self> {
        BladeInflow::Variable(row)
    }
}

/// How held inflow goes on over a coupling step: linearly in time.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Carried {
    /// How much more it is at the end of the step, like the rows.
    pub change: Vec<f64>,
    /// Start of the step [s], which inputs that begin at a corner of the controls come after.
    pub begun: f64,
    /// Its length [s].
    pub lasts: f64,
}

/// Inflow of a rotor held over a coupling step.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum HeldInflow<U = f64> {
    /// The three states of y.
    Dynamic,
    /// Rows of [`held_inflow`](crate::rotor::hub::Rotor::held_inflow), blade after blade, and the disk mean.
    Stations {
        /// lambda at every station, positive down.
        inflow: Vec<U>,
        /// Disk mean.
        mean: U,
        /// How the rows go on over the step; none where they stay.
        carried: Option<Carried>,
    },
    /// No air.
    Vacuum,
}

/// How a wind that is not the same everywhere differs from that at the body's origin; no derivatives are taken by it.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Gust {
    /// Wind at the hub of the first rotor less that at the origin [m/s], inertial axes.
    pub at_hub: [f64; 3],
    /// Rates at which the air turns about the airframe, body axes [rad/s]: what its gradients are to tail and fin.
    pub turn: [f64; 3],
    /// Wind along the shaft at the blade stations of the first rotor less that at its hub, as inflow, positive down, over the tip speed
    /// (n_blades, n_stations); empty where the wind is the same over the disk, or where it is in the inflow held.
    pub stations: Vec<f64>,
}

/// Air that moves, and speeds of the rotors that derivatives are taken by.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Disturbance<U = f64> {
    /// Velocity of the air [m/s], the same everywhere and always: inertial axes (north, east, down) of an airframe, hub axes of a
    /// stand.
    pub wind: [U; 3],
    /// How it differs from place to place; none where it does not.
    pub gust: Option<Gust>,
    /// What every rotor with blades turns faster than its own speed has it [rad/s], and the rate of that [rad/s2].
    pub speed: Vec<[U; 2]>,
}

/// What the engines of a rotor whose speed is a state are given, held over a coupling step.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub struct EngineInput<U = f64> {
    /// Torque of engines without a governor, at the speed of the rotor [N m]; behind the clutch none of it below zero acts.
    pub torque: U,
    /// Share of the fuel that reaches governed engines: 1 where they run, 0 where they have failed.
    pub fuel: U,
}

impl Default for EngineInput {
    fn default() -> Self {
        Self { torque: 0.0, fuel: 1.0 }
    }
}

/// What the sections of a rotor remember where a coupling step begins.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct HeldMemory {
    /// Memory, blade by blade.
    pub memory: MemoryRows,
    /// Start of the step [s], which inputs that begin at a corner of the controls come after.
    pub begun: f64,
}

/// What acts on the system over one coupling step.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Inputs<U = f64> {
    /// Controls at `t_start`: sticks lateral, longitudinal, collective, pedal [m from the stop] of an airframe; on a stand
    /// theta_0, theta_1c, theta_1s [rad] and nothing.
    pub stick: [U; 4],
    /// Their rates [1/s].
    pub stick_rate: [U; 4],
    /// Start of the step [s].
    pub t_start: f64,
    /// Inflow of every rotor with blades, in the order of the list.
    pub inflow: Vec<HeldInflow<U>>,
    /// Air of the wake at the parts of the airframe [m/s], body axes, held over the step; none where washes act on the mean inflow. No
    /// derivatives are taken by it.
    pub wash: Option<AtParts>,
    /// Memory of the sections of every rotor, in the order of the list; those that remember cannot do without.
    pub sections: Vec<HeldMemory>,
    /// Stabilator incidence [rad].
    pub stabilator_incidence: U,
    /// What the engines of a rotor whose speed is a state are given.
    pub engine: EngineInput<U>,
    /// Wind, and excess speed of the rotors at the azimuths they have, which is none in flight; none in still air.
    pub disturbance: Option<Disturbance<U>>,
}

impl<U> HeldInflow<U> {
    /// Rows that stay, and their disk mean.
    pub fn stations(inflow: Vec<U>, mean: U) -> Self {
        Self::Stations { inflow, mean, carried: None }
    }
}

impl<U: Real> Inputs<U> {
    /// Controls at time `t`.
    #[inline(always)]
    pub fn stick_at(&self, t: f64) -> [U; 4] {
        std::array::from_fn(|i| self.stick[i] + self.stick_rate[i] * (t - self.t_start))
    }

    /// Row of blade `b` of rotor `r` of what a gust adds to the inflow in its states, of which there are `n`.
    pub(super) fn gust_row(&self, r: usize, b: usize, n: usize) -> Option<&[f64]> {
        let gust = self.disturbance.as_ref()?.gust.as_ref()?;
        if r > 0 { None } else { gust.stations.get(b * n..(b + 1) * n) }
    }

    /// Whether there is no air at all.
    pub fn vacuum(&self) -> bool {
        matches!(self.inflow.first(), Some(HeldInflow::Vacuum))
    }
}

impl Inputs {
    /// The same in a wind, `n_stations` on a blade: what it adds to the inflow goes with the states of y, or into the rows held.
    pub fn blown(mut self, air: &Air, n_stations: usize) -> Self {
        let gust = air.stations.as_ref().map(|stations| {
            let at_hub = std::array::from_fn(|i| air.at_hub[i] - air.origin[i]);
            let stations = match self.inflow.first_mut() {
                Some(HeldInflow::Stations { inflow, .. }) => {
                    air.on(n_stations, inflow);
                    Vec::new()
                }
                _ => stations.clone(),
            };
            Gust { at_hub, turn: air.turn, stations }
        });
        self.disturbance = Some(Disturbance { wind: air.origin, gust, speed: vec![[0.0; 2]] });
        self
    }
}

/// The arguments of F.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, S, U = f64> {
    /// Time [s].
    pub t: f64,
    /// State.
    pub y: &'a [S],
    /// Its rate.
    pub y_dot: &'a [S],
    /// What acts.
    pub inputs: &'a Inputs<U>,
}
