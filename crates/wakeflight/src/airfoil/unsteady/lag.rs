//! First-order lags in cascade: rates, the exponential step and the equilibrium of any law made of them.

use super::{Coefficients, Flow, Section};
use crate::numerics::scalar::Real;

/// Most states of a law.
pub const MAX_STATES: usize = 8;

/// States of a section; a law uses the first ones.
pub type States<S> = [S; MAX_STATES];

/// What a state follows, and how fast: X' = rate (input - X).
#[derive(Clone, Copy, Debug)]
pub struct Drive<S> {
    /// Where the state would come to rest.
    pub input: S,
    /// Inverse of the time constant [1/s].
    pub rate: S,
}

impl<S: Real> Drive<S> {
    /// Of a state that does not exist.
    pub(super) fn none() -> Self {
        Self { input: S::zero(), rate: S::zero() }
    }
}

/// A model of a section in time.
pub trait Law {
    /// Keys of its sources.
    const SOURCES: &'static [&'static str];
    /// Name of each state.
    const NAMES: &'static [&'static str];
    /// Stage of each state, ascending from 0: its drive depends on states of earlier stages alone.
    const STAGE: &'static [usize];

    /// What each state follows.
    fn drives<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        states: &States<S>,
    ) -> [Drive<S>; MAX_STATES];

    /// Coefficients of the section.
    fn coefficients<S: Real>(&self, section: &Section, flow: &Flow<S>, states: &States<S>)
    -> Coefficients<S>;
}

/// Rates of the states [1/s of each].
pub fn rates<S: Real>(law: &impl Law, section: &Section, flow: &Flow<S>, states: &States<S>) -> States<S> {
    let drives = law.drives(section, flow, states);
    std::array::from_fn(|k| drives[k].rate * (drives[k].input - states[k]))
}

/// States at which nothing changes in a flow that stays.
pub fn equilibrium<L: Law, S: Real>(law: &L, section: &Section, flow: &Flow<S>) -> States<S> {
    let mut states = [S::zero(); MAX_STATES];
    for stage in 0..stages::<L>() {
        let drives = law.drives(section, flow, &states);
        for k in of_stage::<L>(stage) {
            states[k] = drives[k].input;
        }
    }
    states
}

/// States after `dt` [s], from those before it; the flow before and after, between them drives are linear in time.
///
/// Exact for a drive linear in time at constant speed; for a cascade and for speeds that vary the error of a step is of the
/// third order, that of a time of the second.
pub fn advanced<L: Law, S: Real>(
    law: &L,
    section: &Section,
    [before, after]: [&Flow<S>; 2],
    dt: f64,
    states: &States<S>,
) -> States<S> {
    followed(law, section, states, &law.drives(section, before, states), after, dt)
}

/// States `dt` [s] after they were `states` under the drives `old`, in the flow `after`.
pub fn followed<L: Law, S: Real>(
    law: &L,
    section: &Section,
    states: &States<S>,
    old: &[Drive<S>; MAX_STATES],
    after: &Flow<S>,
    dt: f64,
) -> States<S> {
    let mut new = *states;
    for stage in 0..stages::<L>() {
        let drives = law.drives(section, after, &new);
        for k in of_stage::<L>(stage) {
            let z = (old[k].rate + drives[k].rate) * (0.5 * dt);
            let (decay, ramp) = decay_and_ramp(z);
            // what has not arrived yet decays, and the ramp adds to it; zero at rest, to the last bit
            let behind = (old[k].input - states[k]) * decay + (drives[k].input - old[k].input) * ramp;
            new[k] = drives[k].input - behind;
        }
    }
    new
}

/// States that lag behind what they follow by `lags`.
pub fn behind<L: Law, S: Real>(law: &L, section: &Section, lags: &States<f64>, flow: &Flow<S>) -> States<S> {
    let mut states = [S::zero(); MAX_STATES];
    for stage in 0..stages::<L>() {
        let drives = law.drives(section, flow, &states);
        for k in of_stage::<L>(stage) {
            states[k] = drives[k].input - S::cst(lags[k]);
        }
    }
    states
}

/// States at instants `dt` [s] apart of a flow that repeats: the steps of [`followed`], closed to a turn.
pub fn periodic<L: Law>(law: &L, section: &Section, flows: &[Flow<f64>], dt: f64) -> Vec<States<f64>> {
    let n = flows.len();
    let mut states = vec![[0.0; MAX_STATES]; n];
    let mut drives = Vec::with_capacity(n);
    for stage in 0..stages::<L>() {
        drives.clear();
        drives.extend(flows.iter().zip(&states).map(|(flow, x)| law.drives(section, flow, x)));
        for k in of_stage::<L>(stage) {
            let step = |l: usize, lag: f64| {
                let (old, new) = (&drives[l][k], &drives[(l + 1) % n][k]);
                let (decay, ramp) = decay_and_ramp((old.rate + new.rate) * (0.5 * dt));
                lag * decay + (new.input - old.input) * ramp
            };
            // a turn is linear in the lag it begins with: what it adds, over the share of it that is forgotten
            let turned = (0..n).map(|l| drives[l][k].rate * dt).sum::<f64>();
            let added = (0..n).fold(0.0, |lag, l| step(l, lag));
            let forgotten = -(-turned).exp_m1();
            let mut lag = if forgotten > 0.0 { added / forgotten } else { 0.0 };
            for l in 0..n {
                states[l][k] = drives[l][k].input - lag;
                lag = step(l, lag);
            }
        }
    }
    states
}

fn stages<L: Law>() -> usize {
    L::STAGE.last().map_or(0, |last| last + 1)
}

fn of_stage<L: Law>(stage: usize) -> impl Iterator<Item = usize> {
    (0..L::STAGE.len()).filter(move |&k| L::STAGE[k] == stage)
}

/// exp(-z) and (1 - exp(-z))/z.
fn decay_and_ramp<S: Real>(z: S) -> (S, S) {
    let decay = (-z).exp();
    let ramp = if z.re().abs() < 1e-3 {
        S::one() - z * (S::cst(0.5) - z * (S::cst(1.0 / 6.0) - z * (1.0 / 24.0)))
    } else {
        (S::one() - decay) / z
    };
    (decay, ramp)
}
