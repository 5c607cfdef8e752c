//! Values at the stations by azimuth, as the blades last passed there; and how they go on over the step that begins.
//!
//! What a blade is about to meet the blade before has just met: from one azimuth to the next a row is taken to change by as
//! much as it did a passage ago. In a wake that repeats itself that is exact, and nothing of it is fed back.

use super::row;
use serde::{Deserialize, Serialize};

/// Rows of the latest passage of every azimuth.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Passages {
    /// (n_azimuths, width).
    pub map: Vec<f64>,
    /// From the blades' azimuths to the next, of the passages before (n_blades, width).
    pub change: Vec<f64>,
    width: usize,
}

impl Passages {
    /// Of the periodic `map` (n_azimuths, width), the blades `step` steps after their start.
    pub fn new(map: &[f64], width: usize, n_blades: usize, step: usize) -> Self {
        let mut new = Self { map: map.to_vec(), change: vec![0.0; n_blades * width], width };
        new.go_on(step, n_blades);
        new
    }

    /// The blades have come to their azimuths after `step` steps with `rows` (n_blades, width).
    pub fn keep(&mut self, step: usize, rows: &[f64]) {
        let n_blades = rows.len() / self.width;
        self.go_on(step, n_blades);
        for (b, now) in rows.chunks_exact(self.width).enumerate() {
            let k = row(step, b, n_blades, self.map.len() / self.width) * self.width;
            self.map[k..k + self.width].copy_from_slice(now);
        }
    }

    /// The change from `step` to the next, of the rows in the map.
    fn go_on(&mut self, step: usize, n_blades: usize) {
        let n = self.map.len() / self.width;
        let at = |step: usize, b: usize| &self.map[row(step, b, n_blades, n) * self.width..][..self.width];
        for (b, change) in self.change.chunks_exact_mut(self.width).enumerate() {
            for ((change, now), ahead) in change.iter_mut().zip(at(step, b)).zip(at(step + 1, b)) {
                *change = ahead - now;
            }
        }
    }
}
