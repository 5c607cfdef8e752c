//! The chain from the stick to the blades: stick, parallel, series within its authority, mixing, servos.

use super::servos::Servos;
use super::{Sticks, Which};
use serde::{Deserialize, Serialize};

/// An inch [m].
const INCH: f64 = 0.0254;

/// How what a member answers is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// In series, within the authority that all share.
    Series,
    /// In series, by an actuator of its own.
    OwnSeries,
    /// It moves the stick itself, within the stops.
    Parallel,
}

/// What a member answered last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Answer {
    /// Inches by stick.
    pub inches: Sticks,
    /// Sticks on which its own limits held it.
    pub held: Which,
}

/// Everything that what comes depends on, and the seconds that authority, rates and stops held sticks or servos.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Kept {
    /// Answers, held until the next.
    pub answers: Vec<Answer>,
    /// Inches added in series.
    pub series: Sticks,
    /// Inches that parallel members move the stick by.
    pub parallel: Sticks,
    /// Sticks [m] that stand for where the blades have been put.
    pub reached: Sticks,
    /// Where the servos are [rad].
    pub servos: Option<Sticks>,
    /// Seconds.
    pub seconds: [Sticks; 3],
}

/// Controllers and servos of a flight.
#[derive(Clone, Debug)]
pub struct Chain {
    /// How the members count, in their order.
    pub acts: Vec<Acts>,
    /// Most inches of all in series together.
    pub limit: Sticks,
    /// Inches of the aircraft over those the numbers were written for.
    pub scale: Sticks,
    /// Travel [in].
    pub travel: Sticks,
    servos: Option<Servos>,
    kept: Kept,
}

impl Chain {
    /// At rest with the sticks at `trim` [m].
    pub fn new(
        acts: Vec<Acts>,
        [limit, scale, travel]: [Sticks; 3],
        servos: Option<Servos>,
        trim: Sticks,
    ) -> Self {
        let answers = vec![Answer::default(); acts.len()];
        let kept = Kept { answers, reached: trim, servos: servos.as_ref().map(|s| s.at), ..Kept::default() };
        Self { acts, limit, scale, travel, servos, kept }
    }

    /// What comes depends on.
    pub fn kept(&self) -> &Kept {
        &self.kept
    }

    /// Goes on from what was kept of the same chain.
    pub fn recall(&mut self, kept: Kept) {
        if let (Some(servos), Some(at)) = (&mut self.servos, kept.servos) {
            servos.at = at;
        }
        self.kept = kept;
    }

    /// Member `k` has answered.
    pub fn answered(&mut self, k: usize, answer: Answer) {
        if let Some(place) = self.kept.answers.get_mut(k) {
            *place = answer;
        }
    }

    /// Sticks [m] where the hands have them, as parallel members move them.
    pub fn moved(&self, hands: &Sticks) -> Sticks {
        std::array::from_fn(|k| hands[k] + INCH * self.kept.parallel[k])
    }

    /// What is added to the hands [m].
    pub fn offset(&self) -> Sticks {
        std::array::from_fn(|k| INCH * (self.kept.parallel[k] + self.kept.series[k]))
    }

    /// Sticks [m] that reach the blades at the two ends of a piece of `dt` [s] while the hands go from one place to another.
    pub fn advance(&mut self, hands: [Sticks; 2], dt: f64) -> [Sticks; 2] {
        let held = self.sum(&hands[0]);
        self.count(0, held, dt);
        let offset = self.offset();
        let asked = hands.map(|each| std::array::from_fn(|k| each[k] + offset[k]));
        let Some(servos) = &mut self.servos else {
            self.kept.reached = asked[1];
            return asked;
        };
        let [limited, stopped] = servos.advance([&asked[0], &asked[1]], dt);
        let reached = servos.stick();
        self.kept.servos = Some(servos.at);
        self.count(1, limited, dt);
        self.count(2, stopped, dt);
        [std::mem::replace(&mut self.kept.reached, reached), reached]
    }

    fn count(&mut self, kind: usize, held: Which, dt: f64) {
        for (seconds, held) in self.kept.seconds[kind].iter_mut().zip(held) {
            if held {
                *seconds += dt;
            }
        }
    }

    /// Inches of all members, kept; on which sticks a limit held them.
    fn sum(&mut self, hands: &Sticks) -> Which {
        let (mut shared, mut own, mut parallel) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        let mut held = [false; 4];
        for (acts, answer) in self.acts.iter().zip(&self.kept.answers) {
            let total = match acts {
                Acts::Series => &mut shared,
                Acts::OwnSeries => &mut own,
                Acts::Parallel => &mut parallel,
            };
            for k in 0..4 {
                total[k] += answer.inches[k];
                held[k] |= answer.held[k];
            }
        }
        for k in 0..4 {
            let (limit, scale) = (self.limit[k], self.scale[k]);
            let within = shared[k].max(-limit).min(limit);
            held[k] |= within != shared[k];
            self.kept.series[k] = scale * (within + own[k]);
            // the stick goes no further than its stops; where the hands have it already beyond, no further
            let at = hands[k] / INCH;
            let (low, high) = (at.min(0.0), at.max(self.travel[k]));
            self.kept.parallel[k] =
                if parallel[k] == 0.0 { 0.0 } else { (at + scale * parallel[k]).max(low).min(high) - at };
        }
        held
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_stays_within_its_authority_and_parallel_within_the_stops() {
        let acts = vec![Acts::Series, Acts::Series, Acts::OwnSeries, Acts::Parallel];
        let mut chain = Chain::new(acts, [[1.0; 4], [2.0; 4], [10.0; 4]], None, [0.0; 4]);
        let all = |x: f64| Answer { inches: [x, 0.0, 0.0, 0.0], held: [false; 4] };
        for (k, x) in [0.7, 0.6, 0.25, 9.0].into_iter().enumerate() {
            chain.answered(k, all(x));
        }
        let hands = [2.0 * INCH, 0.1, 0.0, 0.0];
        let [from, to] = chain.advance([hands; 2], 0.5);
        // (1 + 0.25) times two in series, 8 left of the travel
        assert!((from[0] / INCH - (2.0 + 2.5 + 8.0)).abs() < 1e-12 && from == to && from[1] == 0.1);
        assert_eq!(chain.kept().seconds[0], [0.5, 0.0, 0.0, 0.0]);
        let mut again = chain.clone();
        again.recall(chain.kept().clone());
        assert_eq!(again.advance([hands; 2], 0.1), chain.advance([hands; 2], 0.1));
    }
}
