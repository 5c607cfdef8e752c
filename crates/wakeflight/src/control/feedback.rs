//! Feedback of signals, as they differ from where a flight began, behind filters, within an authority.

use super::filters::Smoothed;
use super::sensed::{Sensed, Signal};
use super::{Sticks, Which};
use serde::{Deserialize, Serialize};

/// One feedback.
#[derive(Clone, Copy, Debug)]
pub struct Term {
    /// Index of the stick it moves.
    pub stick: usize,
    /// Inches for one of the signal, sign included.
    pub size: f64,
    /// What it feeds back.
    pub signal: Signal,
    /// Whether that is an angle, whose deviation counts the short way round.
    pub angle: bool,
}

/// What feedback is made of.
#[derive(Clone, Debug, Default)]
pub struct Law {
    /// Its terms.
    pub terms: Vec<Term>,
    /// Time constants of lag and washout of every signal [s].
    pub constants: [Option<f64>; 2],
    /// Airspeeds [m/s] from which it works, and works fully; none: always.
    pub above: Option<[f64; 2]>,
    /// Whether altitude counts from the straight path of the beginning instead of from its altitude.
    pub path: bool,
    /// Most inches to either side, stick by stick.
    pub limits: Sticks,
}

/// What its answers to come depend on.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Past {
    /// Time of the last call; none before the first.
    t: Option<f64>,
    begun: f64,
    /// Signals and climb rate of the beginning.
    reference: Vec<f64>,
    climb: f64,
    filters: Vec<Smoothed>,
    held: Which,
}

/// Feedback in a flight.
#[derive(Clone, Debug, Default)]
pub struct Feedback {
    law: Law,
    past: Past,
}

impl Feedback {
    /// At rest.
    pub fn new(law: Law) -> Self {
        let [lag, washout] = law.constants;
        let filters = vec![Smoothed::new(lag, washout); law.terms.len()];
        Self { law, past: Past { filters, ..Past::default() } }
    }

    /// Inches by stick at time `t` [s]; `side_force`: specific force to the right [m/s2], of laws that feed it back.
    pub fn step(&mut self, t: f64, sensed: &Sensed, side_force: f64) -> Sticks {
        let (law, past) = (&self.law, &mut self.past);
        let signals = law.terms.iter().map(|term| sensed.signal(term.signal, side_force));
        if past.t.is_none() {
            (past.begun, past.t) = (t, Some(t));
            (past.reference, past.climb) = (signals.clone().collect(), sensed.climb_rate());
        }
        let dt = t - past.t.replace(t).unwrap_or(t);
        let share =
            law.above.map_or(1.0, |[none, all]| ((sensed.airspeed() - none) / (all - none)).clamp(0.0, 1.0));
        let ahead = past.climb * (t - past.begun);
        let mut moved = [0.0; 4];
        for (((term, signal), rest), filter) in
            law.terms.iter().zip(signals).zip(&past.reference).zip(&mut past.filters)
        {
            let mut change = signal - rest;
            if law.path && term.signal == Signal::Altitude {
                change -= ahead;
            }
            if term.angle {
                change = short_way(change);
            }
            moved[term.stick] += term.size * share * filter.advance(change, dt);
        }
        past.held = std::array::from_fn(|k| moved[k].abs() > law.limits[k]);
        // a number that is none stays one
        std::array::from_fn(|k| if past.held[k] { law.limits[k].copysign(moved[k]) } else { moved[k] })
    }

    /// Whether it feeds back the specific force to the right.
    pub fn measures(&self) -> bool {
        self.law.terms.iter().any(|term| term.signal == Signal::SideForce)
    }

    /// Sticks on which its authority held it back in the last call.
    pub fn held(&self) -> Which {
        self.past.held
    }

    /// What its answers to come depend on.
    pub fn past(&self) -> &Past {
        &self.past
    }

    /// Goes on from `past`, of the same law.
    pub fn recall(&mut self, past: Past) {
        self.past = past;
    }
}

/// An angle [rad] less the nearest whole number of turns.
fn short_way(angle: f64) -> f64 {
    let turns = (angle / std::f64::consts::TAU).round_ties_even();
    if turns == 0.0 { angle } else { turns.mul_add(-std::f64::consts::TAU, angle) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feedback_is_counted_from_its_beginning_within_its_authority() {
        let term = |stick, size, signal, angle| Term { stick, size, signal, angle };
        let law = Law {
            terms: vec![term(0, -1.0, Signal::Roll, true), term(3, -2.0, Signal::R, false)],
            limits: [f64::INFINITY, 1.0, 1.0, 0.5],
            ..Law::default()
        };
        let mut feedback = Feedback::new(law);
        let at = |roll: f64, r: f64| {
            let y = [40.0, 0.0, 0.0, 0.0, 0.0, r, (0.5 * roll).cos(), (0.5 * roll).sin(), 0.0, 0.0];
            Sensed::of(&[&y[..], &[0.0; 3]].concat(), 0.0, 27.0, None)
        };
        assert_eq!(feedback.step(0.0, &at(3.0, 0.1), 0.0), [0.0; 4]);
        let found = feedback.step(0.01, &at(-3.0, 1.0), 0.0);
        assert!((found[0] - (6.0 - std::f64::consts::TAU)).abs() < 1e-14);
        assert_eq!((found[3], feedback.held()), (-0.5, [false, false, false, true]));
    }
}
