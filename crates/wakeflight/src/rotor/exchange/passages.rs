//! Values at the stations by azimuth, as the blades last passed there; and how they go on over the step that begins.
//!
//! What a blade is about to meet the blade before has just met: from one azimuth to the next a row is taken to change by as
//! much as it did a passage ago. In a wake that repeats itself that is exact, and nothing of it is fed back.

use super::{over_step, row};
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
        let [_, change] = over_step(map, width, step, n_blades);
        Self { map: map.to_vec(), change, width }
    }

    /// The blades have come to their azimuths after `step` steps with `rows` (n_blades, width).
    pub fn keep(&mut self, step: usize, rows: &[f64]) {
        let n_blades = rows.len() / self.width;
        [_, self.change] = over_step(&self.map, self.width, step, n_blades);
        for (b, now) in rows.chunks_exact(self.width).enumerate() {
            let k = row(step, b, n_blades, self.map.len() / self.width) * self.width;
            self.map[k..k + self.width].copy_from_slice(now);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_blades_meet_what_the_blade_before_met_the_change_leads_to_the_next_rows() {
        let (n, n_blades, width) = (12, 4, 2);
        let value = |azimuth: usize, j: usize| ((azimuth % n) as f64 + 0.3 * j as f64).sin();
        let rows = |step: usize| -> Vec<f64> {
            (0..n_blades).flat_map(|b| (0..width).map(move |j| value(row(step, b, n_blades, n), j))).collect()
        };
        let map: Vec<f64> = (0..n).flat_map(|k| (0..width).map(move |j| value(k, j))).collect();
        let mut passages = Passages::new(&map, width, n_blades, 0);
        for step in 0..2 * n {
            let ahead: Vec<f64> =
                rows(step).iter().zip(&passages.change).map(|(now, more)| now + more).collect();
            let off = ahead.iter().zip(rows(step + 1)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-15, "step {step}: {off}");
            passages.keep(step + 1, &rows(step + 1));
        }
    }

    #[test]
    fn a_blade_that_differs_is_felt_by_the_next_alone() {
        let (n, n_blades) = (12, 4);
        let mut passages = Passages::new(&vec![0.0; n], 1, n_blades, 0);
        passages.keep(1, &[0.0, 1.0, 0.0, 0.0]);
        // what is kept is of the blade itself: it goes on as the one before it did
        assert_eq!(passages.change, [0.0; 4]);
        // blade 0 comes to where blade 1 has been a passage of three steps later
        for step in 2..=3 {
            passages.keep(step, &[0.0; 4]);
        }
        assert_eq!(passages.change, [1.0, 0.0, 0.0, 0.0]);
    }
}
