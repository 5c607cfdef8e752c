//! Equivalent rigid blade line: bound elements, stations and release of the tip vortex.

use super::options::{BladeState, WakeOptions};
use std::f64::consts::PI;

/// Radial grid of the bound vortex.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeGrid {
    /// Edges of the bound elements [m], N + 1 values from the root cutout to the radius.
    pub edges: Vec<f64>,
    /// Stations, middles of the elements [m].
    pub stations: Vec<f64>,
}

impl BladeGrid {
    /// Edges root_cutout + (R - root_cutout) sin(pi j / 2N): elements narrow toward the tip.
    pub fn new(options: &WakeOptions) -> Self {
        let n = options.n_stations;
        let (root, radius) = (options.root_cutout, options.radius);
        let mut edges: Vec<f64> =
            (0..=n).map(|j| root + (radius - root) * (PI * j as f64 / (2.0 * n as f64)).sin()).collect();
        // the tip must be the release point of the tip vortex to the last bit
        edges[n] = radius;
        let stations = edges.windows(2).map(|e| 0.5 * (e[0] + e[1])).collect();
        BladeGrid { edges, stations }
    }
}

/// Point of the rigid blade line at the radius `r` [m, `_h`].
///
/// e e_r + (r - e) [cos flap (cos lead e_r + sin lead e_psi) + sin flap e_z]; inboard of the hinge r e_r.
/// e: hinge offset; e_r, e_psi: radial and tangential unit vectors at the blade's azimuth.
pub fn blade_point(options: &WakeOptions, blade: &BladeState, r: f64) -> [f64; 3] {
    let (sin_psi, cos_psi) = blade.psi.sin_cos();
    let e = options.hinge_offset;
    if r <= e {
        return [r * cos_psi, r * sin_psi, 0.0];
    }
    let (sin_flap, cos_flap) = blade.flap.sin_cos();
    let (sin_lead, cos_lead) = blade.lead.sin_cos();
    let radial = e + (r - e) * cos_flap * cos_lead;
    let tangential = (r - e) * cos_flap * sin_lead;
    [radial * cos_psi - tangential * sin_psi, radial * sin_psi + tangential * cos_psi, (r - e) * sin_flap]
}

/// Release point of the tip vortex [m, `_h`].
pub fn release_point(options: &WakeOptions, blade: &BladeState) -> [f64; 3] {
    blade_point(options, blade, options.release_radius * options.radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leading_blade_is_ahead_in_azimuth() {
        // lead is in the direction of rotation: at the tail (psi = 0) that is to the right
        let options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
        let tip = release_point(&options, &BladeState { psi: 0.0, flap: 0.05, lead: 0.02 });
        assert!(tip[1] > 0.0 && tip[2] > 0.0);
        assert!((tip[2] - 7.6 * 0.05f64.sin()).abs() < 1e-14);
        assert!((tip[0] - (0.4 + 7.6 * 0.05f64.cos() * 0.02f64.cos())).abs() < 1e-14);
    }

    #[test]
    fn elements_fill_the_blade() {
        let options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
        let grid = BladeGrid::new(&options);
        assert_eq!((grid.edges.len(), grid.stations.len()), (21, 20));
        assert_eq!((grid.edges[0], grid.edges[20]), (1.0, 8.0));
        assert!((grid.edges[10] - (1.0 + 7.0 * 0.5f64.sqrt())).abs() < 1e-14);
    }
}
