//! One chordwise row of bound vortices with trailers, of a blade and of a fixed wing.
//!
//! Lifting line: control points on the bound line itself, which induces nothing there. Weissinger: control points at
//! three quarters of the chord, where the bound line's own induction enters; that of an infinite line, 1/(pi c), is what
//! a thin section already carries in its 2 pi slope and is taken away.

use super::circulation::solve_circulation;
use super::error::WakeError;
use super::geometry::BladeGrid;
use super::influence::influence;
use super::motion::{BladeState, HubMotion};
use super::near_wake::{trailer_cores, trailers};
use super::options::WakeOptions;
use std::f64::consts::PI;

/// Point between two trailers, `along` [m] from their first nodes.
fn between(inner: &[[f64; 3]], outer: &[[f64; 3]], along: f64) -> [f64; 3] {
    let at = |nodes: &[[f64; 3]]| {
        let mut left = along;
        for ends in nodes.windows(2) {
            let d: [f64; 3] = std::array::from_fn(|c| ends[1][c] - ends[0][c]);
            let length = d.iter().map(|v| v * v).sum::<f64>().sqrt();
            if left <= length {
                return std::array::from_fn(|c| ends[0][c] + d[c] * left / length);
            }
            left -= length;
        }
        nodes[nodes.len() - 1]
    };
    let (a, b) = (at(inner), at(outer));
    std::array::from_fn(|c| 0.5 * (a[c] + b[c]))
}

/// Matrix of a blade after Weissinger (n_stations, n_stations), row-major [s/m2]: inflow at three quarters of the chord
/// that near wake and own bound line add, less that of an infinite bound line; lambda_i = sum_j N_ij Gamma_j.
///
/// `chords` (n_stations) [m]. The control points lie half a chord behind the bound line on the way of the air, midway
/// between the two trailers of their element.
/// DEVIATION: bound line, trailers and control points lie in the plane of the unpitched blade; pitch turns the chord in
/// the kinematics, not in this geometry (an error of the order of the pitch squared).
/// Where the air comes from behind (reverse flow) the model has no meaning.
pub fn weissinger_matrix(
    options: &WakeOptions,
    hub: &HubMotion,
    blade: &BladeState,
    chords: &[f64],
) -> Result<Vec<f64>, WakeError> {
    options.validate()?;
    hub.validate(options)?;
    blade.validate()?;
    let n = options.n_stations;
    super::error::length("chords", chords.len(), n)?;
    let grid = BladeGrid::new(options);
    let lines = trailers(options, &grid, hub, blade);
    let control: Vec<[f64; 3]> = (0..n).map(|j| between(&lines[j], &lines[j + 1], 0.5 * chords[j])).collect();
    let mut matrix = influence(&lines, &trailer_cores(&grid), &control, [0.0, 0.0, 1.0], true);
    for (i, chord) in chords.iter().enumerate() {
        matrix[i * n + i] -= 1.0 / (PI * chord);
    }
    for value in &mut matrix {
        *value /= options.tip_speed();
    }
    Ok(matrix)
}

/// Which line of the chord carries the control points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlLine {
    /// Lifting line: the quarter chord.
    Quarter,
    /// Weissinger: three quarters of the chord.
    ThreeQuarter,
}

/// Circulation over speed (n) [m] of a flat wing with a straight quarter-chord line and a straight wake.
///
/// `edges` (n + 1), `stations` (n) of the control points between them [m], along the span, ascending; `chords` (n) [m];
/// `alpha` [rad]. Sections of slope 2 pi: Gamma = pi c (V sin alpha - w). Lift coefficient: 2 sum Gamma dy/(V S).
/// Edges -b/2 cos(pi j/n) with stations -b/2 cos(pi (j + 1/2)/n) converge far faster than middles of the elements.
pub fn wing_circulation(
    edges: &[f64],
    stations: &[f64],
    chords: &[f64],
    alpha: f64,
    line: ControlLine,
) -> Result<Vec<f64>, WakeError> {
    let n = chords.len();
    super::error::length("edges", edges.len(), n + 1)?;
    super::error::length("stations", stations.len(), n)?;
    super::error::finite("edges", edges)?;
    super::error::finite("stations", stations)?;
    super::error::finite("chords", chords)?;
    super::error::finite("alpha", &[alpha])?;
    let span = edges[n] - edges[0];
    // wind along +x, span along +y, so that a vortex from -y to +y has the air pushed down behind it
    let lines: Vec<Vec<[f64; 3]>> =
        edges.iter().map(|y| vec![[0.0, *y, 0.0], [1e4 * span, *y, 0.0]]).collect();
    let weissinger = line == ControlLine::ThreeQuarter;
    let control: Vec<[f64; 3]> =
        (0..n).map(|j| [if weissinger { 0.5 * chords[j] } else { 0.0 }, stations[j], 0.0]).collect();
    let mut matrix = influence(&lines, &vec![0.0; n + 1], &control, [0.0, 0.0, 1.0], weissinger);
    if weissinger {
        for (i, chord) in chords.iter().enumerate() {
            matrix[i * n + i] -= 1.0 / (PI * chord);
        }
    }
    let section = |wash: &[f64], gamma: &mut [f64], slope: &mut [f64]| {
        for i in 0..n {
            gamma[i] = PI * chords[i] * (alpha.sin() - wash[i]);
            slope[i] = -PI * chords[i];
        }
    };
    let floor: Vec<f64> = chords.iter().map(|c| -4.0 * c).collect();
    let solution = solve_circulation(&vec![0.0; n], &matrix, section, &vec![0.0; n], &floor, 1e-12 * span)?;
    Ok(solution.gamma)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges in cosine spacing and the lift coefficient of a wing.
    fn lift(n: usize, span: f64, chord: impl Fn(f64) -> f64, alpha: f64, line: ControlLine) -> f64 {
        let place = |angle: f64| -0.5 * span * (PI * angle / n as f64).cos();
        let edges: Vec<f64> = (0..=n).map(|j| place(j as f64)).collect();
        let stations: Vec<f64> = (0..n).map(|j| place(j as f64 + 0.5)).collect();
        let chords: Vec<f64> = stations.iter().map(|y| chord(*y)).collect();
        let gamma = wing_circulation(&edges, &stations, &chords, alpha, line).unwrap();
        let (mut force, mut area) = (0.0, 0.0);
        for (j, e) in edges.windows(2).enumerate() {
            force += 2.0 * gamma[j] * (e[1] - e[0]);
            area += chords[j] * (e[1] - e[0]);
        }
        force / area
    }

    #[test]
    fn verif_weissinger_wings_have_the_known_lift() {
        let alpha = 5.7106f64.to_radians();
        let slope = |ratio: f64| lift(40, ratio, |_| 1.0, alpha, ControlLine::ThreeQuarter) / alpha;
        assert!((slope(6.0) - 4.1743).abs() < 1e-4, "{}", slope(6.0));
        assert!((slope(12.0) - 4.9948).abs() < 1e-4, "{}", slope(12.0));
        let ellipse = |y: f64| (1.0 - (y / 2.5).powi(2)).sqrt();
        let elliptic = lift(40, 5.0, ellipse, alpha, ControlLine::ThreeQuarter);
        assert!((elliptic - 0.4441).abs() < 2e-4, "{elliptic}");
    }

    #[test]
    fn verif_lifting_line_wings_have_the_known_lift() {
        let alpha = 0.1f64;
        let slope = |ratio: f64| lift(40, ratio, |_| 1.0, alpha, ControlLine::Quarter) / alpha.sin();
        assert!((slope(6.0) / 4.53042499 - 1.0).abs() < 3e-4, "{}", slope(6.0));
        assert!((slope(10.0) / 5.04679085 - 1.0).abs() < 3e-4, "{}", slope(10.0));
        // 2 pi sin(alpha)/(1 + 2/AR); the published 0.4765 has alpha for its sine
        let ellipse = |y: f64| (1.0 - (y / 2.5).powi(2)).sqrt();
        let alpha = 5.7106f64.to_radians();
        let elliptic = lift(40, 5.0, ellipse, alpha, ControlLine::Quarter);
        let exact = 2.0 * PI * alpha.sin() / (1.0 + 2.0 / (20.0 / PI));
        assert!((elliptic / exact - 1.0).abs() < 3e-4, "{elliptic} {exact}");
    }

    #[test]
    fn verif_a_long_wing_is_two_dimensional() {
        // 2-D limit c_l = 2 pi sin(alpha) at mid-span
        let n = 81;
        let place = |angle: f64| -500.0 * (PI * angle / n as f64).cos();
        let edges: Vec<f64> = (0..=n).map(|j| place(j as f64)).collect();
        let stations: Vec<f64> = (0..n).map(|j| place(j as f64 + 0.5)).collect();
        let gamma =
            wing_circulation(&edges, &stations, &vec![1.0; n], 0.1, ControlLine::ThreeQuarter).unwrap();
        assert!((gamma[n / 2] / (PI * 0.1f64.sin()) - 1.0).abs() < 5e-3, "{}", gamma[n / 2]);
    }
}
