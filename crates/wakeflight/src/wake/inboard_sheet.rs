//! Inboard wake: rigid helical filaments that close the circulation inboard of its crest.

use super::geometry::{BladeGrid, BladeLine};
use super::motion::{BladeState, HubMotion};
use super::options::{OUTER_END, WakeOptions};

/// Edges of the equal spans between root cutout and 0.8 R [m].
fn span_edges(options: &WakeOptions) -> Vec<f64> {
    let (inner, outer) = (options.rotor.root_cutout, OUTER_END * options.rotor.radius);
    let n = options.n_sheet;
    (0..=n).map(|i| inner + (outer - inner) * i as f64 / n as f64).collect()
}

/// Release points of the filaments of a blade, the middles of the spans (n_sheet) [m, `_h`].
pub fn release_points(options: &WakeOptions, blade: &BladeState) -> Vec<[f64; 3]> {
    let line = BladeLine::new(options, blade);
    span_edges(options).windows(2).map(|s| line.at(0.5 * (s[0] + s[1]))).collect()
}

/// Circulation between the stations: linear, 0 at the root cutout.
fn interpolated(grid: &BladeGrid, circulation: &[f64], r: f64) -> f64 {
    let (mut r0, mut g0) = (grid.edges[0], 0.0);
    for (station, gamma) in grid.stations.iter().zip(circulation) {
        if r <= *station {
            return g0 + (gamma - g0) * (r - r0) / (station - r0);
        }
        (r0, g0) = (*station, *gamma);
    }
    g0
}

/// Strengths of the filaments of a blade (n_sheet) [m2/s], positive along increasing age.
///
/// Each carries minus the increase of the circulation over its span; the circulation is 0 at the root and that of the
/// tip vortex at 0.8 R, so that the total is -`tip_circulation`.
pub fn strengths(
    options: &WakeOptions,
    grid: &BladeGrid,
    circulation: &[f64],
    tip_circulation: f64,
) -> Vec<f64> {
    let edges = span_edges(options);
    let n = options.n_sheet;
    let at = |i: usize| match i {
        0 => 0.0,
        i if i == n => tip_circulation,
        i => interpolated(grid, circulation, edges[i]),
    };
    (0..n).map(|i| at(i) - at(i + 1)).collect()
}

/// Velocity that carries the sheet [m/s, `_h`]: wind at the hub and `sheet_factor` times the mean induced velocity.
pub fn convection(options: &WakeOptions, hub: &HubMotion, mean_inflow: f64) -> [f64; 3] {
    let wind = hub.wind([0.0; 3]);
    [wind[0], wind[1], wind[2] - options.sheet_factor * mean_inflow * options.tip_speed()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sheet_returns_the_circulation_of_the_tip_vortex() {
        let options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
        let grid = BladeGrid::new(&options);
        let circulation: Vec<f64> = grid.stations.iter().map(|r| r * (8.0 - r)).collect();
        let sheet = strengths(&options, &grid, &circulation, 16.0);
        assert!((sheet.iter().sum::<f64>() + 16.0).abs() < 1e-12);
        assert!(sheet[0] < 0.0);
    }
}
