//! Circulation of the tip vortex from the circulation along the blade.

use super::choices::TipStrength;
use super::geometry::BladeGrid;
use super::options::WakeOptions;

/// Inner end of the range whose mean circulation gives the sign of the crest (fraction of R).
const SIGN_RANGE: f64 = 0.7;

/// Integral of `circulation` dr over the part of the blade outboard of `inner`, and the length of that part.
fn outboard_integral(grid: &BladeGrid, circulation: &[f64], inner: f64) -> (f64, f64) {
    let mut sum = (0.0, 0.0);
    for (edge, gamma) in grid.edges.windows(2).zip(circulation) {
        let width = (edge[1] - edge[0].max(inner)).max(0.0);
        sum.0 += gamma * width;
        sum.1 += width;
    }
    sum
}

/// Circulation of the tip vortex released by a blade with `circulation` (n_stations) [m2/s].
///
/// * `equivalent`: integral of Gamma r dr over integral of r dr, the uniform circulation of equal thrust;
/// * `mean`: mean of Gamma outboard of `tip_strength_inner`;
/// * `max`: crest outboard of `tip_strength_inner`, of the sign that the integral over r > 0.7 R has; 0 if no
///   station has it.
pub fn tip_circulation(options: &WakeOptions, grid: &BladeGrid, circulation: &[f64]) -> f64 {
    let inner = options.tip_strength_inner * options.rotor.radius;
    match options.tip_strength {
        TipStrength::Equivalent => {
            let mut sum = (0.0, 0.0);
            for (edge, gamma) in grid.edges.windows(2).zip(circulation) {
                let moment = 0.5 * (edge[1] * edge[1] - edge[0] * edge[0]);
                sum.0 += gamma * moment;
                sum.1 += moment;
            }
            sum.0 / sum.1
        }
        TipStrength::Mean => {
            let (integral, span) = outboard_integral(grid, circulation, inner);
            integral / span
        }
        TipStrength::Max => {
            let sign = outboard_integral(grid, circulation, SIGN_RANGE * options.rotor.radius).0;
            let outboard =
                grid.stations.iter().zip(circulation).filter(|(r, _)| **r >= inner).map(|(_, g)| *g);
            if sign >= 0.0 { outboard.fold(0.0, f64::max) } else { outboard.fold(0.0, f64::min) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strength(rule: TipStrength, gamma: impl Fn(f64) -> f64) -> f64 {
        let mut options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
        options.tip_strength = rule;
        options.n_stations = 200;
        let grid = BladeGrid::new(&options);
        let circulation: Vec<f64> = grid.stations.iter().map(|r| gamma(*r)).collect();
        tip_circulation(&options, &grid, &circulation)
    }

    #[test]
    fn uniform_circulation_is_the_tip_strength_of_every_rule() {
        for rule in [TipStrength::Equivalent, TipStrength::Max, TipStrength::Mean] {
            assert!((strength(rule, |_| 7.5) - 7.5).abs() < 1e-12);
        }
    }

    #[test]
    fn rules_differ_for_linear_circulation_as_their_integrals_do() {
        // Gamma = r: int r^2 / int r = (2/3)(8^3 - 1)/(8^2 - 1); mean over 4..8 is 6
        assert!((strength(TipStrength::Equivalent, |r| r) - 2.0 / 3.0 * 511.0 / 63.0).abs() < 1e-3);
        // one element straddles 0.5 R
        assert!((strength(TipStrength::Mean, |r| r) - 6.0).abs() < 1e-2);
        assert!((strength(TipStrength::Max, |r| r) - 8.0).abs() < 1e-2);
    }

    #[test]
    fn a_negative_tip_makes_a_negative_tip_vortex() {
        let gamma = |r: f64| if r > 5.5 { -3.0 } else { 9.0 };
        assert_eq!(strength(TipStrength::Max, gamma), -3.0);
    }
}
