//! Circulation that a blade gives to its free trailers.

use super::choices::Trailers;
use super::geometry::BladeGrid;
use super::options::WakeOptions;
use super::tip_strength::tip_circulation;

/// Circulation of the panels between the trailers of a full-span wake (n_trailers - 1) [m2/s]: mean over the span of each.
pub fn panel_means(grid: &BladeGrid, circulation: &[f64]) -> Vec<f64> {
    let width = |j: usize| grid.edges[j + 1] - grid.edges[j];
    grid.trailer_edges
        .windows(2)
        .map(|e| match e[1] - e[0] {
            // to the last bit where a panel is one element
            1 => circulation[e[0]],
            _ => {
                let integral: f64 = (e[0]..e[1]).map(|j| circulation[j] * width(j)).sum();
                integral / (grid.edges[e[1]] - grid.edges[e[0]])
            }
        })
        .collect()
}

/// Strengths of the trailers released by a blade with `circulation` (n_stations), root to tip (trailers_per_blade)
/// [m2/s], positive along increasing age.
///
/// Between the panels i and i + 1 it is Gamma_i - Gamma_(i+1); +Gamma_N at the tip, -Gamma_1 at the root: in total zero.
/// A tip vortex alone has the strength of [`tip_circulation`].
pub fn strengths(options: &WakeOptions, grid: &BladeGrid, circulation: &[f64]) -> Vec<f64> {
    match options.trailers {
        Trailers::Tip => vec![tip_circulation(options, grid, circulation)],
        Trailers::FullSpan => {
            let panels = panel_means(grid, circulation);
            let at = |i: usize| panels.get(i).copied().unwrap_or(0.0);
            (0..=panels.len()).map(|i| if i == 0 { -at(0) } else { at(i - 1) - at(i) }).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_trails_is_zero_in_total_and_its_impulse_is_that_of_the_blade() {
        // sum of gamma_i r_i = integral of Gamma dr, whatever the number of trailers
        for n_trailers in [0, 2, 5, 12, 21] {
            let options = WakeOptions {
                trailers: Trailers::FullSpan,
                n_trailers,
                ..WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0)
            };
            let grid = BladeGrid::new(&options);
            let circulation: Vec<f64> = grid.stations.iter().map(|r| r * (8.3 - r)).collect();
            let trailing = strengths(&options, &grid, &circulation);
            assert_eq!(trailing.len(), options.trailers_per_blade());
            assert!(trailing.iter().sum::<f64>().abs() < 1e-13);
            let impulse: f64 =
                trailing.iter().zip(&grid.trailer_edges).map(|(g, e)| g * grid.edges[*e]).sum();
            let integral: f64 =
                circulation.iter().zip(grid.edges.windows(2)).map(|(g, e)| g * (e[1] - e[0])).sum();
            assert!((impulse - integral).abs() < 1e-12 * integral, "{n_trailers}");
        }
    }
}
