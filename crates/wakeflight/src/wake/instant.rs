//! Rotor and wake at one instant: filaments, blades on their lines, bound circulation.

use super::filament::Filaments;
use super::geometry::{BladeGrid, BladeLine};
use super::ground::Plane;
use super::inboard_sheet;
use super::motion::BladeState;
use super::options::WakeOptions;
use super::trailers;
use serde::{Deserialize, Serialize};

/// The rotor and its wake at one instant.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct RotorInstant {
    /// Free filaments, blade after blade, each from root to tip: the tip vortices, or all trailers.
    pub free: Filaments,
    /// What is carried on behind the free filaments.
    pub far: Filaments,
    /// Filaments of the inboard sheet, blade after blade; none without a sheet.
    pub sheet: Filaments,
    /// Edges of the bound elements (n_blades, n_stations + 1) [m, `_h`].
    pub edge: Vec<[f64; 3]>,
    /// Stations (n_blades, n_stations) [m, `_h`].
    pub station: Vec<[f64; 3]>,
    /// Bound circulation (n_blades, n_stations) [m2/s].
    pub circulation: Vec<f64>,
    /// Ground, where there is one.
    pub ground: Option<Plane>,
    /// Edges that the trailers of a blade leave from.
    pub(super) trailer_edges: Vec<usize>,
}

impl RotorInstant {
    /// Blades and empty filaments.
    pub fn new(options: &WakeOptions, grid: &BladeGrid) -> Self {
        RotorInstant {
            free: Filaments::free(options),
            far: Filaments::default(),
            sheet: Filaments::new(options, options.rotor.n_blades * options.sheet_filaments()),
            edge: vec![[0.0; 3]; options.rotor.n_blades * (options.n_stations + 1)],
            station: vec![[0.0; 3]; options.rotor.n_blades * options.n_stations],
            circulation: vec![0.0; options.rotor.n_blades * options.n_stations],
            ground: None,
            trailer_edges: grid.trailer_edges.clone(),
        }
    }

    /// Places blade `i_blade` with its bound circulation (n_stations) [m2/s].
    pub fn place_blade(
        &mut self,
        options: &WakeOptions,
        grid: &BladeGrid,
        i_blade: usize,
        blade: &BladeState,
        circulation: &[f64],
    ) {
        let (n, line) = (options.n_stations, BladeLine::new(options, blade));
        for (j, r) in grid.edges.iter().enumerate() {
            self.edge[i_blade * (n + 1) + j] = line.at(*r);
        }
        for (j, r) in grid.stations.iter().enumerate() {
            self.station[i_blade * n + j] = line.at(*r);
        }
        self.circulation[i_blade * n..(i_blade + 1) * n].copy_from_slice(circulation);
    }

    /// Circulation that blade `i_blade` with the bound circulation `circulation` (n_stations) [m2/s] releases into the first
    /// markers of its filaments.
    pub fn release(&mut self, options: &WakeOptions, grid: &BladeGrid, i_blade: usize, circulation: &[f64]) {
        let n_t = options.trailers_per_blade();
        let strengths = trailers::strengths(options, grid, circulation);
        for (t, strength) in strengths.iter().enumerate() {
            let m = self.free.marker(i_blade * n_t + t, 0);
            self.free.circulation[m] = *strength;
        }
        let n_sheet = options.sheet_filaments();
        if n_sheet > 0 {
            let sheet = inboard_sheet::strengths(options, grid, circulation, strengths[0]);
            for (s, strength) in sheet.into_iter().enumerate() {
                let m = self.sheet.marker(i_blade * n_sheet + s, 0);
                self.sheet.circulation[m] = strength;
            }
        }
    }

    /// Becomes a copy of `other`; room is kept.
    pub fn copy(&mut self, other: &Self) {
        self.free.copy(&other.free);
        self.far.copy(&other.far);
        self.sheet.copy(&other.sheet);
        self.edge.clone_from(&other.edge);
        self.station.clone_from(&other.station);
        self.circulation.clone_from(&other.circulation);
        self.ground = other.ground;
        self.trailer_edges.clone_from(&other.trailer_edges);
    }
}
