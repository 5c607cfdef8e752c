//! Primary servos: what carries the mixed commands of all sticks to the blades.

use super::filters::limited_lag;
use super::{Sticks, Which};

/// Four servos, all alike, behind the mixing unit, and where they are [rad].
///
/// The equations of motion take sticks: where servos stand is told as the sticks that would put them there.
#[derive(Clone, Debug)]
pub struct Servos {
    /// Time constant [s].
    pub lag: f64,
    /// Largest rate [rad/s].
    pub rate: f64,
    /// Lower and upper stops [rad].
    pub stops: [[f64; 2]; 4],
    /// Rigging: pitch at sticks at their stop [rad].
    pub offset: Sticks,
    /// Rigging: pitch by stick [rad/m].
    pub matrix: [Sticks; 4],
    /// Its inverse.
    pub back: [Sticks; 4],
    /// Where they are.
    pub at: Sticks,
}

fn times(matrix: &[Sticks; 4], v: &Sticks) -> Sticks {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * v[3])
}

impl Servos {
    /// Pitch that sticks [m] ask for [rad].
    pub fn asked(&self, stick: &Sticks) -> Sticks {
        let mixed = times(&self.matrix, stick);
        std::array::from_fn(|k| self.offset[k] + mixed[k])
    }

    /// Sticks [m] that stand for where they are.
    pub fn stick(&self) -> Sticks {
        times(&self.back, &std::array::from_fn(|k| self.at[k] - self.offset[k]))
    }

    /// While the commanded sticks [m] go along a straight line for `dt` [s]; which met their rate, which a stop.
    pub fn advance(&mut self, stick: [&Sticks; 2], dt: f64) -> [Which; 2] {
        let asked = stick.map(|each| self.asked(each));
        let mut met = [[false; 4]; 2];
        for k in 0..4 {
            let (free, limited) =
                limited_lag(self.at[k], [asked[0][k], asked[1][k]], dt, self.lag, self.rate);
            let [low, high] = self.stops[k];
            self.at[k] = free.max(low).min(high);
            (met[0][k], met[1][k]) = (limited, self.at[k] != free);
        }
        met
    }
}
