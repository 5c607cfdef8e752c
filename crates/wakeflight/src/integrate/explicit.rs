//! Fixed explicit steps for blades that do not bend: six stages of order five with a fourth-order companion.
//!
//! Flap and lag near or below once a revolution, inflow and body are slow beside a step of ten degrees, and y_dot is had in
//! closed form: nothing asks for an implicit method. The difference of the two orders guards the step: above `GUARD`
//! weights it is halved, which also catches a step that is too long for the method to be stable [cash1990].

use super::fixed::Counters;
use crate::system::instant::Inputs;
use crate::system::layout::Layout;
use crate::system::model::System;
use crate::system::rates::{NoInertia, RigidRates};
use serde::{Deserialize, Serialize};
use thiserror::Error;

const STAGES: usize = 6;
/// Where the stages lie in the step.
const C: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 3.0 / 5.0, 1.0, 7.0 / 8.0];
/// Rates that a stage takes from those before it.
const A: [[f64; STAGES - 1]; STAGES] = [
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0],
    [3.0 / 10.0, -9.0 / 10.0, 6.0 / 5.0, 0.0, 0.0],
    [-11.0 / 54.0, 5.0 / 2.0, -70.0 / 27.0, 35.0 / 27.0, 0.0],
    [1631.0 / 55296.0, 175.0 / 512.0, 575.0 / 13824.0, 44275.0 / 110592.0, 253.0 / 4096.0],
];
/// Order five.
const B: [f64; STAGES] = [37.0 / 378.0, 0.0, 250.0 / 621.0, 125.0 / 594.0, 0.0, 512.0 / 1771.0];
/// Order four.
const B_LOW: [f64; STAGES] =
    [2825.0 / 27648.0, 0.0, 18575.0 / 48384.0, 13525.0 / 55296.0, 277.0 / 14336.0, 1.0 / 4.0];

/// Most that the two orders may differ in the weights rtol |y| + atol, root mean square.
const GUARD: f64 = 10.0;
/// Most halvings of one step.
const MAX_HALVINGS: u32 = 6;

/// A step that could not be taken.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "fixed explicit step stopped at t = {t:.4} s, azimuth of the first blade {azimuth:.1} deg: {reason}; worst in {state}"
)]
pub struct ExplicitFailure {
    /// Start of the step [s].
    pub t: f64,
    /// Azimuth of the first blade there [deg].
    pub azimuth: f64,
    /// What went wrong.
    pub reason: &'static str,
    /// Name of the state that is not finite, or whose two orders differ most.
    pub state: String,
}

/// Everything that the steps to come depend on, between two steps.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ExplicitMemory {
    t: f64,
    y: Vec<f64>,
    counters: Counters,
}

impl ExplicitMemory {
    /// Size of the state it belongs to.
    pub fn size(&self) -> usize {
        self.y.len()
    }
}

/// Integration with steps that the caller sets, and all the room it needs.
#[derive(Clone, Debug)]
pub struct ExplicitStep {
    layout: Layout,
    rates: RigidRates,
    rtol: f64,
    atol: Vec<f64>,
    t: f64,
    y: Vec<f64>,
    /// Whether the first of `k` is the rate of the present state.
    prepared: bool,
    k: [Vec<f64>; STAGES],
    stage: Vec<f64>,
    difference: Vec<f64>,
    counters: Counters,
}

impl ExplicitStep {
    /// At state `y` and time `t` [s]; `atol` is the absolute tolerance of every state. None where the blades bend.
    pub fn new(system: &System, t: f64, y: &[f64], rtol: f64, atol: &[f64]) -> Option<Self> {
        let n = y.len();
        Some(Self {
            layout: system.layout.clone(),
            rates: RigidRates::new(system)?,
            rtol,
            atol: atol.to_vec(),
            t,
            y: y.to_vec(),
            prepared: false,
            k: std::array::from_fn(|_| vec![0.0; n]),
            stage: vec![0.0; n],
            difference: vec![0.0; n],
            counters: Counters::default(),
        })
    }

    /// State.
    pub fn state(&self) -> &[f64] {
        &self.y
    }
    /// Its rate with the inputs of the last `prepare`.
    pub fn rate(&self) -> &[f64] {
        &self.k[0]
    }
    /// Counted work; nothing is linearised or iterated.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// What the steps to come depend on: every step begins with the rate of its state.
    pub fn memory(&self) -> ExplicitMemory {
        ExplicitMemory { t: self.t, y: self.y.clone(), counters: self.counters }
    }

    /// Goes on from `memory`, of the same aircraft.
    pub fn recall(&mut self, memory: ExplicitMemory) {
        (self.t, self.y, self.counters) = (memory.t, memory.y, memory.counters);
        self.prepared = false;
    }

    /// Finds the rate that satisfies F = 0 with `inputs` from now on.
    pub fn prepare(&mut self, system: &System, inputs: &Inputs) -> Result<(), ExplicitFailure> {
        let found = self.rates.find(system, (self.t, &self.y), inputs, &mut self.k[0]);
        self.counters.residual_evaluations += 1;
        if found.is_err() || !self.k[0].iter().all(|v| v.is_finite()) {
            return Err(self.failure(system, "a rate of state is not finite"));
        }
        self.prepared = true;
        Ok(())
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    pub fn advance(
        &mut self,
        system: &System,
        t1: f64,
        inputs: &Inputs,
        parts: usize,
    ) -> Result<(), ExplicitFailure> {
        let t0 = self.t;
        for part in 1..=parts {
            let end = if part == parts { t1 } else { t0 + (t1 - t0) * part as f64 / parts as f64 };
            self.step(system, end, inputs, 0)?;
        }
        Ok(())
    }

    fn step(
        &mut self,
        system: &System,
        t1: f64,
        inputs: &Inputs,
        halvings: u32,
    ) -> Result<(), ExplicitFailure> {
        if !self.prepared {
            self.prepare(system, inputs)?;
        }
        let h = t1 - self.t;
        let taken = self.stages(system, h, inputs);
        // written so that NaN is refused
        let reason = match taken {
            Ok(()) if self.difference_in_weights() <= GUARD => {
                self.accept(h, t1);
                return Ok(());
            }
            Ok(()) => "orders five and four differ by more than ten times the tolerance",
            Err(NoInertia) => "a stage left the finite numbers",
        };
        if halvings >= MAX_HALVINGS {
            return Err(self.failure(system, reason));
        }
        self.counters.halvings += 1;
        let middle = 0.5 * (self.t + t1);
        self.step(system, middle, inputs, halvings + 1)?;
        self.step(system, t1, inputs, halvings + 1)
    }

    /// Rates at all stages but the first, and the difference of the two orders.
    fn stages(&mut self, system: &System, h: f64, inputs: &Inputs) -> Result<(), NoInertia> {
        for s in 1..STAGES {
            self.stage.copy_from_slice(&self.y);
            add(&mut self.stage, &self.k, &A[s], h);
            let (_, rest) = self.k.split_at_mut(s);
            self.rates.find(system, (self.t + C[s] * h, &self.stage), inputs, &mut rest[0])?;
        }
        self.counters.residual_evaluations += STAGES as u64 - 1;
        self.difference.fill(0.0);
        let weights: [f64; STAGES] = std::array::from_fn(|s| B[s] - B_LOW[s]);
        add(&mut self.difference, &self.k, &weights, h);
        Ok(())
    }

    fn weighted(&self, i: usize) -> f64 {
        self.difference[i] / (self.rtol * self.y[i].abs() + self.atol[i])
    }

    fn difference_in_weights(&self) -> f64 {
        let n = self.y.len();
        // a stand whose blades are held and whose inflow is given has no state
        if n == 0 {
            return 0.0;
        }
        ((0..n).map(|i| self.weighted(i).powi(2)).sum::<f64>() / n as f64).sqrt()
    }

    fn accept(&mut self, h: f64, t1: f64) {
        add(&mut self.y, &self.k, &B, h);
        self.layout.normalise(&mut self.y);
        self.t = t1;
        self.prepared = false;
        self.counters.steps += 1;
    }

    fn failure(&self, system: &System, reason: &'static str) -> ExplicitFailure {
        let size = |i: usize| {
            let v = self.weighted(i).abs();
            if v.is_nan() { f64::INFINITY } else { v }
        };
        let not_finite = |all: &[f64]| all.iter().position(|v| !v.is_finite());
        let worst = not_finite(&self.y)
            .or_else(|| not_finite(&self.k[0]))
            .unwrap_or_else(|| (0..self.y.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0));
        ExplicitFailure {
            t: self.t,
            azimuth: system.azimuth(0, self.t, &self.y, 0).to_degrees().rem_euclid(360.0),
            reason,
            state: system.layout.names().into_iter().nth(worst).map_or_else(String::new, |(name, _)| name),
        }
    }
}

/// to += h sum weights k
fn add(to: &mut [f64], k: &[Vec<f64>; STAGES], weights: &[f64], h: f64) {
    for (rates, weight) in k.iter().zip(weights) {
        if *weight != 0.0 {
            let factor = h * weight;
            for (t, rate) in to.iter_mut().zip(rates) {
                *t += factor * rate;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stages_integrate_polynomials_of_their_degree() {
        for (b, order) in [(B, 5), (B_LOW, 4)] {
            for k in 1..=order {
                let sum: f64 = (0..STAGES).map(|s| b[s] * C[s].powi(k - 1)).sum();
                assert!((sum - 1.0 / f64::from(k)).abs() < 1e-14, "{order} {k}");
            }
        }
        for (row, c) in A.iter().zip(C) {
            assert!((row.iter().sum::<f64>() - c).abs() < 1e-15);
        }
    }
}
