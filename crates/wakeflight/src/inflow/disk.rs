//! Means over the rotor disk, with the one area weight that belongs to blade stations, and the momentum of a circulation.

use super::momentum::momentum_inflow;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Means of maps by azimuth and station: what stands at a station counts by its element's share of the disk's area.
///
/// In a revolution the element of width w about r sweeps 2 pi r w. The disk inboard of the root cutout has no stations and is
/// no part of any mean.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DiskMean {
    weights: Vec<f64>,
}

impl DiskMean {
    /// Of stations, middles of elements of these widths, both in one unit.
    pub fn new(stations: &[f64], widths: &[f64]) -> Self {
        let area: Vec<f64> = stations.iter().zip(widths).map(|(r, w)| r * w).collect();
        let whole = pairwise_sum(&area);
        Self { weights: area.iter().map(|a| a / whole).collect() }
    }

    /// Shares of the area (n_stations,), summing to one.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Area mean of a map (n_azimuths, n_stations) at equal steps of azimuth; values of a row beyond the stations are left out.
    pub fn of(&self, map: &[f64], width: usize) -> f64 {
        mean_of_rows(map, width, &self.weights)
    }

    /// Root of the area mean of the squares of a map (n_azimuths, n_stations).
    pub fn rms(&self, map: &[f64]) -> f64 {
        let squares: Vec<f64> = map.iter().map(|v| v * v).collect();
        self.of(&squares, self.weights.len()).sqrt()
    }
}

/// Rotor of a circulation map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LiftingDisk {
    /// Number of blades.
    pub n_blades: usize,
    /// Rotor speed [rad/s].
    pub omega: f64,
    /// Radius [m].
    pub radius: f64,
    /// Stations (n_stations,) [m].
    pub stations: Vec<f64>,
    /// Widths of their elements (n_stations,) [m].
    pub widths: Vec<f64>,
}

impl LiftingDisk {
    /// Integral of circulation times radius, mean over azimuth [m4/s]: thrust but for constant factors.
    pub fn thrust_integral(&self, circulation: &[f64]) -> f64 {
        let weights: Vec<f64> = self.stations.iter().zip(&self.widths).map(|(r, w)| r * w).collect();
        mean_of_rows(circulation, weights.len(), &weights)
    }

    /// Inflow of momentum theory over the tip speed for the thrust of a circulation map (n_azimuths, n_stations) [m2/s]: it
    /// carries the inboard sheet.
    ///
    /// Thrust by Kutta-Joukowski from the speed along the chord of a blade without flapping, Omega r + V sin psi; hub velocity
    /// [m/s] in hub axes.
    pub fn carrying_inflow(&self, circulation: &[f64], hub_velocity: [f64; 3]) -> f64 {
        let n = circulation.len() / self.stations.len();
        let turning: Vec<f64> =
            self.stations.iter().zip(&self.widths).map(|(r, w)| self.omega * r * w).collect();
        let lift: Vec<f64> = circulation
            .chunks_exact(self.stations.len())
            .enumerate()
            .map(|(k, gamma)| {
                let psi = TAU * k as f64 / n as f64;
                let across = hub_velocity[1] * psi.cos() - hub_velocity[0] * psi.sin();
                product(gamma, &turning) + across * product(gamma, &self.widths)
            })
            .collect();
        let tip_speed = self.omega * self.radius;
        let disk = PI * self.radius.powi(2) * tip_speed.powi(2);
        let ct = self.n_blades as f64 * (pairwise_sum(&lift) / n as f64) / disk;
        let mu = hub_velocity[0].hypot(hub_velocity[1]) / tip_speed;
        momentum_inflow(ct, mu * mu, -hub_velocity[2] / tip_speed)
    }
}

fn mean_of_rows(map: &[f64], width: usize, weights: &[f64]) -> f64 {
    let rows: Vec<f64> = map.chunks_exact(width).map(|row| product(&row[..weights.len()], weights)).collect();
    pairwise_sum(&rows) / rows.len() as f64
}

/// Sum of products in four interleaved sums, each term rounded once: the order is part of the answer.
fn product(values: &[f64], weights: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let whole = values.len() - values.len() % 4;
    for (v, w) in values[..whole].chunks_exact(4).zip(weights.chunks_exact(4)) {
        for lane in 0..4 {
            sums[lane] = f64::mul_add(v[lane], w[lane], sums[lane]);
        }
    }
    let sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
    values[whole..].iter().zip(&weights[whole..]).fold(sum, |sum, (v, w)| f64::mul_add(*v, *w, sum))
}

/// Sum of fewer than 129 values in eight interleaved sums, more by halves: its error grows with the logarithm of their number.
fn pairwise_sum(values: &[f64]) -> f64 {
    let n = values.len();
    if n < 8 {
        return values.iter().fold(0.0, |sum, v| sum + v);
    }
    if n > 128 {
        let half = n / 2 - (n / 2) % 8;
        return pairwise_sum(&values[..half]) + pairwise_sum(&values[half..]);
    }
    let mut s: [f64; 8] = std::array::from_fn(|k| values[k]);
    let whole = n - n % 8;
    for eight in values[8..whole].chunks_exact(8) {
        for k in 0..8 {
            s[k] += eight[k];
        }
    }
    let sum = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
    values[whole..].iter().fold(sum, |sum, v| sum + v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_what_is_constant_is_that_constant() {
        for n in [3, 8, 20, 22] {
            let stations: Vec<f64> = (0..n).map(|j| (j as f64 + 0.5) / n as f64).collect();
            let disk = DiskMean::new(&stations, &vec![1.0 / n as f64; n]);
            assert!((disk.weights().iter().sum::<f64>() - 1.0).abs() < 1e-14);
            for azimuths in [4, 7, 36, 300] {
                assert!((disk.of(&vec![0.05; n * azimuths], n) - 0.05).abs() < 1e-16);
                assert!((disk.rms(&vec![-0.05; n * azimuths]) - 0.05).abs() < 1e-16);
            }
        }
    }

    #[test]
    fn a_row_counts_by_its_stations_alone() {
        let disk = DiskMean::new(&[0.3, 0.9], &[0.4, 0.2]);
        let map = [1.0, 2.0, 70.0, 80.0, 3.0, 4.0, 90.0, 100.0];
        assert!((disk.of(&map, 4) - disk.of(&[1.0, 2.0, 3.0, 4.0], 2)).abs() < 1e-15);
    }

    #[test]
    fn the_carrying_inflow_of_a_hover_is_that_of_its_thrust() {
        // uniform circulation: C_T = N_b Gamma Omega R^2/2 (1 - cutout^2) / (pi R^2 (Omega R)^2)
        let (n, radius, omega, gamma): (usize, f64, f64, f64) = (200, 8.0, 27.0, 30.0);
        let widths = vec![radius / n as f64; n];
        let stations: Vec<f64> = (0..n).map(|j| (j as f64 + 0.5) * radius / n as f64).collect();
        let disk = LiftingDisk { n_blades: 4, omega, radius, stations, widths };
        let ct = 4.0 * gamma / (2.0 * PI * omega * radius * radius);
        let found = disk.carrying_inflow(&vec![gamma; 12 * n], [0.0; 3]);
        assert!((found - (0.5 * ct).sqrt()).abs() < 1e-6 * found, "{found}");
    }
}
