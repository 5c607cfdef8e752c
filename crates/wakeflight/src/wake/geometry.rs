//! Equivalent rigid blade line: bound elements, stations and release of the tip vortex.

use super::choices::Trailers;
use super::motion::BladeState;
use super::options::WakeOptions;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Radial grid of the bound vortex.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct BladeGrid {
    /// Edges of the bound elements [m], N + 1 values from the root cutout to the radius.
    pub edges: Vec<f64>,
    /// Stations, middles of the elements [m].
    pub stations: Vec<f64>,
    /// Edges that free trailers leave from, root to tip: the tip's alone, or those between the panels of a full-span wake.
    pub trailer_edges: Vec<usize>,
}

impl BladeGrid {
    /// Edges root_cutout + (R - root_cutout) sin(pi j / 2N): elements narrow toward the tip.
    pub fn new(options: &WakeOptions) -> Self {
        let n = options.n_stations;
        let (root, radius) = (options.rotor.root_cutout, options.rotor.radius);
        let mut edges: Vec<f64> =
            (0..=n).map(|j| root + (radius - root) * (PI * j as f64 / (2.0 * n as f64)).sin()).collect();
        // the tip must be the release point of the tip vortex to the last bit
        edges[n] = radius;
        let stations = edges.windows(2).map(|e| 0.5 * (e[0] + e[1])).collect();
        BladeGrid { edges, stations, trailer_edges: trailer_edges(options) }
    }
}

/// Edges that free trailers leave from; panels between them gather whole elements, as equal in number as they divide.
fn trailer_edges(options: &WakeOptions) -> Vec<usize> {
    let (n, panels) = (options.n_stations, options.trailers_per_blade() - 1);
    if panels == 0 {
        return vec![n];
    }
    (0..=panels).map(|i| (i * n + panels / 2) / panels).collect()
}

/// Rigid line of a blade.
///
/// e e_r + (r - e) [cos flap (cos lead e_r + sin lead e_psi) + sin flap e_z]; inboard of the hinge r e_r.
/// e: hinge offset; e_r, e_psi: radial and tangential unit vectors at the blade's azimuth.
#[derive(Clone, Copy, Debug)]
pub struct BladeLine {
    hinge_offset: f64,
    psi: (f64, f64),
    flap: (f64, f64),
    lead: (f64, f64),
}

impl BladeLine {
    /// Of a blade.
    pub fn new(options: &WakeOptions, blade: &BladeState) -> Self {
        BladeLine {
            hinge_offset: options.rotor.hinge_offset,
            psi: blade.psi.sin_cos(),
            flap: blade.flap.sin_cos(),
            lead: blade.lead.sin_cos(),
        }
    }

    /// The same blade at the azimuth `psi` [rad].
    pub fn turned_to(self, psi: f64) -> Self {
        BladeLine { psi: psi.sin_cos(), ..self }
    }

    /// Point at the radius `r` [m, `_h`].
    pub fn at(&self, r: f64) -> [f64; 3] {
        let ((sin_psi, cos_psi), e) = (self.psi, self.hinge_offset);
        if r <= e {
            return [r * cos_psi, r * sin_psi, 0.0];
        }
        let ((sin_flap, cos_flap), (sin_lead, cos_lead)) = (self.flap, self.lead);
        let radial = e + (r - e) * cos_flap * cos_lead;
        let tangential = (r - e) * cos_flap * sin_lead;
        [radial * cos_psi - tangential * sin_psi, radial * sin_psi + tangential * cos_psi, (r - e) * sin_flap]
    }
}

/// Release points of the free trailers of a blade, root to tip (trailers_per_blade) [m, `_h`].
pub fn release_points(options: &WakeOptions, grid: &BladeGrid, blade: &BladeState) -> Vec<[f64; 3]> {
    let radius = |edge: usize| match options.trailers {
        Trailers::Tip => options.release_radius * options.rotor.radius,
        Trailers::FullSpan => grid.edges[edge],
    };
    let line = BladeLine::new(options, blade);
    grid.trailer_edges.iter().map(|edge| line.at(radius(*edge))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leading_blade_is_ahead_in_azimuth() {
        // lead is in the direction of rotation: at the tail (psi = 0) that is to the right
        let options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
        let grid = BladeGrid::new(&options);
        let tip = release_points(&options, &grid, &BladeState { psi: 0.0, flap: 0.05, lead: 0.02 })[0];
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
        assert_eq!(grid.trailer_edges, [20]);
        assert!((grid.edges[10] - (1.0 + 7.0 * 0.5f64.sqrt())).abs() < 1e-14);
    }

    #[test]
    fn panels_gather_whole_elements_from_root_to_tip() {
        let full_span =
            WakeOptions { trailers: Trailers::FullSpan, ..WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0) };
        let edges = |n_trailers| BladeGrid::new(&WakeOptions { n_trailers, ..full_span }).trailer_edges;
        assert_eq!(edges(0), (0..=20).collect::<Vec<_>>());
        for n_trailers in 2..=21 {
            let edges = edges(n_trailers);
            assert_eq!((edges.len(), edges[0], edges[n_trailers - 1]), (n_trailers, 0, 20));
            let widths: Vec<usize> = edges.windows(2).map(|e| e[1] - e[0]).collect();
            let (least, most) = (widths.iter().min().unwrap(), widths.iter().max().unwrap());
            assert!(*least >= 1 && most - least <= 1, "{widths:?}");
        }
    }
}
