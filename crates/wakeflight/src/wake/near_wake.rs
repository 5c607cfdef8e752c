//! Near wake of a blade: trailers fixed to it, linear in its circulation.

use super::error::WakeError;
use super::geometry::{BladeGrid, BladeLine};
use super::influence::influence;
use super::motion::{BladeState, HubMotion};
use super::options::WakeOptions;
use super::vectors::sum;

/// Matrix N (n_stations, n_stations), row-major [s/m2]: inflow at the stations that the near wake of the own blade adds,
/// lambda_i = sum_j N_ij Gamma_j, lambda = -v_z/(omega R).
///
/// At the boundary of the bound elements j and j + 1 a trailer of strength Gamma_j - Gamma_(j+1) leaves, directed away
/// from the blade; at the tip Gamma_N, at the root -Gamma_1. It lies on the path of the rigid blade (flap and lead of the
/// present azimuth) carried by the wind at the hub, over `near_wake_angle`, in `near_wake_segments` chords. Stations midway between
/// trailers are outside their solid cores; see [`trailer_cores`].
pub fn near_wake_matrix(
    options: &WakeOptions,
    hub: &HubMotion,
    blade: &BladeState,
) -> Result<Vec<f64>, WakeError> {
    options.validate()?;
    hub.validate(options)?;
    blade.validate()?;
    Ok(matrix_of(options, &BladeGrid::new(options), hub, blade))
}

/// The matrix of options, hub and blade that were checked.
pub(super) fn matrix_of(
    options: &WakeOptions,
    grid: &BladeGrid,
    hub: &HubMotion,
    blade: &BladeState,
) -> Vec<f64> {
    if options.near_wake_markers() == 0 {
        return vec![0.0; options.n_stations * options.n_stations];
    }
    let line = BladeLine::new(options, blade);
    let stations: Vec<[f64; 3]> = grid.stations.iter().map(|r| line.at(*r)).collect();
    let lines = trailers(options, grid, hub, blade);
    let mut matrix = influence(&lines, &trailer_cores(grid), &stations, [0.0, 0.0, 1.0], false);
    for value in &mut matrix {
        *value /= options.tip_speed();
    }
    matrix
}

/// Nodes of the near wake's trailers, one per edge of the bound elements, from the blade on [m, `_h`].
pub(super) fn trailers(
    options: &WakeOptions,
    grid: &BladeGrid,
    hub: &HubMotion,
    blade: &BladeState,
) -> Vec<Vec<[f64; 3]>> {
    let wind = hub.wind([0.0; 3]);
    let line = BladeLine::new(options, blade);
    let past: Vec<(BladeLine, [f64; 3])> = (0..=options.near_wake_segments)
        .map(|k| {
            let zeta = options.near_wake_angle * k as f64 / options.near_wake_segments as f64;
            (line.turned_to(blade.psi - zeta), wind.map(|v| v * zeta / options.rotor.omega))
        })
        .collect();
    grid.edges.iter().map(|r| past.iter().map(|(line, blown)| sum(line.at(*r), *blown)).collect()).collect()
}

/// Core of the near wake's trailers over the distance of the nearer station of the bound line.
const CORE_SHARE: f64 = 0.5;

/// Radii of the solid cores of the trailers, one per edge of the bound elements [m]: half the distance from the edge to
/// the nearer station.
///
/// A trailer stands for the sheet that leaves the elements beside it, and that sheet is what a station feels where the
/// wind along the span carries the trailer across it: near the edge of the reverse flow trailers come within a thirtieth
/// of an element of a station, where a line alone induces thirty times what the element's own do and the equation of the
/// circulation has no bounded solution. Inside a strip of width w the velocity grows from its middle as that of a solid
/// core of w/2 does; half of that leaves trailers swept by up to 60 degrees, which stay midway between the stations as
/// lines, as they are.
pub(super) fn trailer_cores(grid: &BladeGrid) -> Vec<f64> {
    let stations = &grid.stations;
    let nearest = |edge: f64| stations.iter().fold(f64::INFINITY, |least, r| least.min((r - edge).abs()));
    grid.edges.iter().map(|edge| CORE_SHARE * nearest(*edge)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options() -> WakeOptions {
        WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0)
    }

    #[test]
    fn lift_brings_downwash_on_the_element_that_carries_it() {
        let n = options().n_stations;
        let matrix = near_wake_matrix(&options(), &HubMotion::default(), &BladeState::default()).unwrap();
        for i in 0..n {
            assert!(matrix[i * n + i] > 0.0);
        }
    }

    #[test]
    fn a_narrow_element_sees_the_two_trailers_at_its_edges() {
        // two semi-infinite-like lines at half a width d/2: v = 2 Gamma/(4 pi d/2), minus what 30 deg leave out
        let options = WakeOptions { n_stations: 40, near_wake_segments: 24, ..options() };
        let n = options.n_stations;
        let matrix = near_wake_matrix(&options, &HubMotion::default(), &BladeState::default()).unwrap();
        let grid = BladeGrid::new(&options);
        let width = grid.edges[31] - grid.edges[30];
        let expected = 1.0 / (std::f64::consts::PI * width) / options.tip_speed();
        assert!((matrix[30 * n + 30] / expected - 1.0).abs() < 0.02);
    }

    #[test]
    fn trailers_blown_along_the_span_induce_no_more_than_a_few_elements_do() {
        // advance ratio 0.3: about psi = 240 deg the wind along the span carries trailers across the inner stations
        let options = options();
        let n = options.n_stations;
        let hub = HubMotion { velocity: [-0.3 * options.tip_speed(), 0.0, 0.0], ..HubMotion::default() };
        let grid = BladeGrid::new(&options);
        for k in 0..360 {
            let blade = BladeState { psi: f64::from(k).to_radians(), ..BladeState::default() };
            let matrix = near_wake_matrix(&options, &hub, &blade).unwrap();
            for i in 0..n {
                let width = grid.edges[i + 1] - grid.edges[i];
                // two endless lines at half the width: 2/(pi w)
                let own = 2.0 / (std::f64::consts::PI * width * options.tip_speed());
                let largest = matrix[i * n..(i + 1) * n].iter().fold(0.0f64, |m, v| m.max(v.abs()));
                assert!(largest < 2.0 * own, "psi {k} deg, station {i}: {}", largest / own);
            }
        }
    }

    #[test]
    fn azimuth_alone_does_not_change_the_near_wake() {
        let at = |psi| {
            near_wake_matrix(&options(), &HubMotion::default(), &BladeState { psi, flap: 0.05, lead: 0.01 })
                .unwrap()
        };
        let (a, b) = (at(0.3), at(2.1));
        let largest = a.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        for (x, y) in a.iter().zip(&b) {
            assert!((x - y).abs() < 1e-11 * largest);
        }
    }
}
