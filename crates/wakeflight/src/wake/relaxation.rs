//! Periodic wake of a steady flight condition by pseudo-implicit predictor-corrector relaxation [bagai1995].

use super::error::{WakeError, checked_pace, finite, length};
use super::far_wake;
use super::filament::{Filaments, aged_cores, distance, stretched_core_squared};
use super::geometry::{BladeGrid, release_points};
use super::ground::Plane;
use super::inboard_sheet;
use super::initial;
use super::instant::RotorInstant;
use super::motion::{BladeState, HubMotion};
use super::options::{RelaxationOptions, WakeOptions};
use super::trailers;
use super::vectors::sum;
use super::velocity_field::{
    FieldWork, InducedVelocity, Induction, VortexSegments, Wanted, field_at, point_velocity,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

mod sweep;

/// RMS change of the markers in one sweep, over R.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norms {
    /// All markers.
    pub all: f64,
    /// Markers of the first turn.
    pub first_turn: f64,
}

/// Free filaments periodic in azimuth: one surface r(psi, zeta) for each trailer of a blade, serving every blade.
///
/// dr/dpsi + dr/dzeta = V/omega, five-point central differences in both; blade b at azimuth index l uses row
/// l + b n_azimuths/n_blades. Rows are the azimuths psi_l = l delta_psi, l = 0 ... steps_per_revolution - 1.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct RelaxationWake<F: InducedVelocity = Induction> {
    #[serde(with = "super::options::whole")]
    pub(crate) options: WakeOptions,
    /// Share of a new geometry taken in a sweep.
    relaxation: f64,
    /// Time that a step of azimuth takes over that at the nominal speed.
    pace: f64,
    /// Whether it has been another.
    uneven: bool,
    /// Ground under the hub, where there is one.
    pub(crate) ground: Option<Plane>,
    pub(crate) grid: BladeGrid,
    pub(crate) field: F,
    pub(crate) hub: HubMotion,
    pub(crate) mean_inflow: f64,
    /// Blade at every azimuth.
    pub(crate) blades: Vec<BladeState>,
    /// Bound circulation (n_azimuths, n_stations) [m2/s].
    pub(crate) circulation: Vec<f64>,
    /// Circulation released (n_azimuths, n_trailers) [m2/s].
    released: Vec<f64>,
    sheet_strength: Vec<f64>,
    sheet_release: Vec<[f64; 3]>,
    /// Release points (n_azimuths, n_trailers) [m, `_h`].
    pub(crate) release: Vec<[f64; 3]>,
    /// Markers (n_azimuths, n_trailers, n_segments + 1) [m, `_h`].
    pub(crate) position: Vec<[f64; 3]>,
    core_squared: Vec<f64>,
    sweeps: u64,
    evaluations: u64,
    #[serde(skip)]
    work: FieldWork,
}

impl RelaxationWake {
    /// Rigid guess of the geometry for a hub motion and a mean induced inflow v/(omega R) (momentum theory); blades
    /// without flap and circulation until [`set_state`](Self::set_state).
    pub fn new(
        options: WakeOptions,
        own: RelaxationOptions,
        hub: HubMotion,
        mean_inflow: f64,
    ) -> Result<Self, WakeError> {
        let field = Induction::Vortices(VortexSegments::new(&options));
        Self::with_field(options, own, hub, mean_inflow, field)
    }
}

impl<F: InducedVelocity> RelaxationWake<F> {
    /// Same with the induced velocity from `field`.
    pub fn with_field(
        options: WakeOptions,
        own: RelaxationOptions,
        hub: HubMotion,
        mean_inflow: f64,
        field: F,
    ) -> Result<Self, WakeError> {
        options.validate()?;
        own.validate()?;
        hub.validate(&options)?;
        finite("mean_inflow", &[mean_inflow])?;
        let n_psi = options.steps_per_revolution();
        let (n_k, n_t, n_sheet) =
            (options.n_segments(), options.trailers_per_blade(), options.sheet_filaments());
        let aged: Vec<f64> = (0..n_t).flat_map(|t| aged_cores(&options, options.release_core(t))).collect();
        let mut wake = RelaxationWake {
            grid: BladeGrid::new(&options),
            field,
            hub,
            mean_inflow,
            blades: vec![BladeState::default(); n_psi],
            circulation: vec![0.0; n_psi * options.n_stations],
            released: vec![0.0; n_psi * n_t],
            sheet_strength: vec![0.0; n_psi * n_sheet],
            sheet_release: vec![[0.0; 3]; n_psi * n_sheet],
            release: vec![[0.0; 3]; n_psi * n_t],
            position: vec![[0.0; 3]; n_psi * n_t * (n_k + 1)],
            core_squared: aged.repeat(n_psi),
            sweeps: 0,
            evaluations: 0,
            work: FieldWork::default(),
            relaxation: own.relaxation,
            pace: 1.0,
            uneven: false,
            ground: None,
            options,
        };
        wake.place(&vec![(0.0, 0.0); n_psi]);
        wake.restart();
        Ok(wake)
    }

    /// Time that a step of azimuth takes over that at the nominal speed of the rotor: frozen over the revolution.
    pub fn set_pace(&mut self, pace: f64) -> Result<(), WakeError> {
        self.pace = checked_pace(pace)?;
        self.uneven |= pace != 1.0;
        Ok(())
    }

    /// Ground under the hub; none out of its effect.
    pub fn set_ground(&mut self, ground: Option<Plane>) {
        self.ground = ground;
    }

    /// New flight condition: hub motion, flap and lead of the blade at every azimuth [rad], and its bound circulation
    /// (n_azimuths, n_stations) [m2/s].
    ///
    /// The geometry is kept (moved with its release points); before the first sweep it is the rigid guess.
    pub fn set_state(
        &mut self,
        hub: HubMotion,
        blades_by_azimuth: &[(f64, f64)],
        circulation: &[f64],
    ) -> Result<(), WakeError> {
        let (n_psi, n_r) = (self.options.steps_per_revolution(), self.options.n_stations);
        hub.validate(&self.options)?;
        length("blades_by_azimuth", blades_by_azimuth.len(), n_psi)?;
        length("circulation", circulation.len(), n_psi * n_r)?;
        if let Some(index) = blades_by_azimuth.iter().position(|b| !(b.0.is_finite() && b.1.is_finite())) {
            return Err(WakeError::InputNotFinite { field: "blades_by_azimuth", index });
        }
        finite("circulation", circulation)?;
        self.hub = hub.felt(&self.options);
        self.circulation.copy_from_slice(circulation);
        let (n_t, n_sheet) = (self.options.trailers_per_blade(), self.options.sheet_filaments());
        for (l, gamma) in circulation.chunks_exact(n_r).enumerate() {
            let strengths = trailers::strengths(&self.options, &self.grid, gamma);
            if n_sheet > 0 {
                let sheet = inboard_sheet::strengths(&self.options, &self.grid, gamma, strengths[0]);
                self.sheet_strength[l * n_sheet..(l + 1) * n_sheet].copy_from_slice(&sheet);
            }
            self.released[l * n_t..(l + 1) * n_t].copy_from_slice(&strengths);
        }
        let before = self.release.clone();
        self.place(blades_by_azimuth);
        if self.sweeps == 0 {
            self.restart();
            return Ok(());
        }
        for l in 0..n_psi {
            for t in 0..n_t {
                for k in 0..=self.options.n_segments() {
                    let born = self.row(l, k) * n_t + t;
                    let (old, new) = (before[born], self.release[born]);
                    let i = self.index(l, t, k);
                    for c in 0..3 {
                        self.position[i][c] += new[c] - old[c];
                    }
                }
                let i = self.index(l, t, 0);
                self.position[i] = self.release[l * n_t + t];
            }
        }
        Ok(())
    }

    /// Mean induced inflow v/(omega R) that carries the inboard sheet.
    pub fn set_mean_inflow(&mut self, mean_inflow: f64) -> Result<(), WakeError> {
        finite("mean_inflow", &[mean_inflow])?;
        self.mean_inflow = mean_inflow;
        Ok(())
    }

    /// Relaxation factor of the sweeps, more than 0, up to 1.
    pub fn set_relaxation(&mut self, relaxation: f64) -> Result<(), WakeError> {
        RelaxationOptions { relaxation, ..RelaxationOptions::default() }.validate()?;
        self.relaxation = relaxation;
        Ok(())
    }

    /// Does `n` sweeps and returns the change of each. Not converging is no error; positions that are not finite are,
    /// and leave the geometry as it was before that sweep.
    pub fn sweep(&mut self, n: usize) -> Result<Vec<Norms>, WakeError> {
        (0..n).map(|_| self.sweep_once()).collect()
    }

    /// Options.
    pub fn options(&self) -> &WakeOptions {
        &self.options
    }

    /// Radial grid.
    pub fn grid(&self) -> &BladeGrid {
        &self.grid
    }

    /// Markers of every trailer, root to tip (n_azimuths, n_trailers, n_segments + 1) [m, `_h`].
    pub fn position(&self) -> &[[f64; 3]] {
        &self.position
    }

    /// Markers of the tip trailer (n_azimuths, n_segments + 1) [m, `_h`].
    pub fn tip_position(&self) -> Vec<[f64; 3]> {
        tip_rows(&self.position, self.options.trailers_per_blade(), self.options.n_segments() + 1)
    }

    /// Core radii of the segments (n_azimuths, n_trailers, n_segments) [m].
    pub fn core_radius(&self) -> Vec<f64> {
        self.core_squared.iter().map(|c| c.sqrt()).collect()
    }

    /// Circulation of the trailers released at every azimuth, root to tip (n_azimuths, n_trailers) [m2/s].
    pub fn released_circulation(&self) -> &[f64] {
        &self.released
    }

    /// Segment evaluations so far.
    pub fn segment_evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Sweeps so far.
    pub fn sweeps(&self) -> u64 {
        self.sweeps
    }

    /// Induced inflow at the stations without that of the own near wake, -v_z/(omega R) (n_azimuths, n_stations).
    pub fn inflow_far(&mut self) -> Vec<f64> {
        let (n_psi, n_r) = (self.options.steps_per_revolution(), self.options.n_stations);
        let (mut inflow, mut lambda) = (vec![0.0; n_psi * n_r], Vec::new());
        let far = self.far_of(&self.position);
        for l in 0..n_psi / self.options.rotor.n_blades {
            let instant = self.instant_of(l, &self.position, &self.core_squared, &far);
            let wanted = Wanted { stations: Some(&mut lambda), ..Wanted::default() };
            self.evaluations += field_at(&self.field, &self.options, &instant, &mut self.work, wanted);
            for (blade, values) in lambda.chunks_exact(n_r).enumerate() {
                let row = self.blade_row(l, blade);
                inflow[row * n_r..(row + 1) * n_r].copy_from_slice(values);
            }
        }
        inflow
    }

    /// Velocity induced at `points` [m/s, `_h`] by rotor and wake with blade 1 at the azimuth of row `azimuth_index`
    /// (periodic); near-wake trailers not included.
    pub fn wake_velocity(&self, points: &[[f64; 3]], azimuth_index: usize) -> Vec<[f64; 3]> {
        point_velocity(&self.field, &self.options, &self.instant(azimuth_index), points)
    }

    /// Rotor and wake with blade 1 at the azimuth of row `azimuth_index` (periodic).
    pub fn instant(&self, azimuth_index: usize) -> RotorInstant {
        self.instant_of(
            azimuth_index % self.options.steps_per_revolution(),
            &self.position,
            &self.core_squared,
            &self.far_of(&self.position),
        )
    }

    /// Index of marker `k` of trailer `t` of row `l`.
    pub(crate) fn index(&self, l: usize, t: usize, k: usize) -> usize {
        (l * self.options.trailers_per_blade() + t) * (self.options.n_segments() + 1) + k
    }

    /// Row `k` steps before row `l`.
    pub(crate) fn row(&self, l: usize, k: usize) -> usize {
        let n = self.options.steps_per_revolution();
        (l + n - k % n) % n
    }

    /// Row of blade `blade` when blade 1 is at row `l`.
    pub(crate) fn blade_row(&self, l: usize, blade: usize) -> usize {
        let n = self.options.steps_per_revolution();
        (l + blade * (n / self.options.rotor.n_blades)) % n
    }

    /// Azimuth of row `l` [rad].
    fn azimuth(&self, l: usize) -> f64 {
        TAU * l as f64 / self.options.steps_per_revolution() as f64
    }

    /// Puts the blade at every azimuth.
    fn place(&mut self, flap_lead: &[(f64, f64)]) {
        let (n_t, n_sheet) = (self.options.trailers_per_blade(), self.options.sheet_filaments());
        for (l, (flap, lead)) in flap_lead.iter().enumerate() {
            let blade = BladeState { psi: self.azimuth(l), flap: *flap, lead: *lead };
            self.blades[l] = blade;
            let points = release_points(&self.options, &self.grid, &blade);
            self.release[l * n_t..(l + 1) * n_t].copy_from_slice(&points);
            if n_sheet > 0 {
                let points = inboard_sheet::release_points(&self.options, &blade);
                self.sheet_release[l * n_sheet..(l + 1) * n_sheet].copy_from_slice(&points);
            }
        }
    }

    /// Sets the geometry to the rigid guess.
    fn restart(&mut self) {
        let delta = self.options.delta_psi();
        let n_t = self.options.trailers_per_blade();
        for l in 0..self.options.steps_per_revolution() {
            for t in 0..n_t {
                for k in 0..=self.options.n_segments() {
                    let release = self.release[self.row(l, k) * n_t + t];
                    let (i, zeta) = (self.index(l, t, k), k as f64 * delta);
                    self.position[i] =
                        initial::tip_vortex(&self.options, &self.hub, self.mean_inflow, release, zeta);
                }
            }
        }
        self.core_squared = self.cores(&self.position);
    }

    /// Squares of the core radii that belong to a geometry.
    fn cores(&self, position: &[[f64; 3]]) -> Vec<f64> {
        let (n_k, n_t) = (self.options.n_segments(), self.options.trailers_per_blade());
        let mut cores = self.core_squared.clone();
        if !self.options.core_stretching {
            if self.uneven {
                let options =
                    WakeOptions { core_growth: self.options.core_growth * self.pace, ..self.options };
                let aged = |t: usize| aged_cores(&options, options.release_core(t));
                cores = (0..n_t).flat_map(aged).collect::<Vec<_>>().repeat(options.steps_per_revolution());
            }
            return cores;
        }
        let span = |l: usize, t: usize, k: usize| {
            distance(position[self.index(l, t, k)], position[self.index(l, t, k + 1)])
        };
        for k in 1..n_k {
            for l in 0..self.options.steps_per_revolution() {
                let past = self.row(l, 1);
                for t in 0..n_t {
                    cores[(l * n_t + t) * n_k + k] = stretched_core_squared(
                        &self.options,
                        self.options.release_core(t),
                        cores[(past * n_t + t) * n_k + k - 1],
                        [span(past, t, k - 1), span(l, t, k)],
                        self.pace,
                    );
                }
            }
        }
        cores
    }

    /// Far wake (n_azimuths, n_trailers) that goes on behind a geometry.
    fn far_of(&self, position: &[[f64; 3]]) -> Filaments {
        let step = self.options.delta_psi() / self.options.rotor.omega * self.pace;
        far_wake::periodic(&self.options, &self.hub, position, &self.released, step)
    }

    /// Rotor and wake at row `l` with a given geometry and its far wake.
    fn instant_of(
        &self,
        l: usize,
        position: &[[f64; 3]],
        core_squared: &[f64],
        far: &Filaments,
    ) -> RotorInstant {
        let options = &self.options;
        let (n_k, n_t) = (options.n_segments(), options.trailers_per_blade());
        let (n_r, n_sheet) = (options.n_stations, options.sheet_filaments());
        let carry = inboard_sheet::convection(options, &self.hub, self.mean_inflow);
        let mut instant = RotorInstant::new(options, &self.grid);
        instant.ground = self.ground;
        if far.n_segments > 0 {
            (instant.far.n_filaments, instant.far.n_segments) =
                (options.rotor.n_blades * n_t, far.n_segments);
        }
        for blade in 0..options.rotor.n_blades {
            let row = self.blade_row(l, blade);
            if far.n_segments > 0 {
                let of_row = far.marker(row * n_t, 0)..far.marker((row + 1) * n_t, 0);
                instant.far.position.extend_from_slice(&far.position[of_row.clone()]);
                instant.far.circulation.extend_from_slice(&far.circulation[of_row]);
            }
            instant.place_blade(
                options,
                &self.grid,
                blade,
                &self.blades[row],
                &self.circulation[row * n_r..(row + 1) * n_r],
            );
            let (from, to) = (self.index(row, 0, 0), instant.free.marker(blade * n_t, 0));
            let (markers, cores) = (n_t * (n_k + 1), n_t * n_k);
            instant.free.position[to..to + markers].copy_from_slice(&position[from..from + markers]);
            instant.free.core_squared[blade * cores..(blade + 1) * cores]
                .copy_from_slice(&core_squared[row * cores..(row + 1) * cores]);
            for k in 0..=n_k {
                let born = self.row(row, k);
                for t in 0..n_t {
                    let m = instant.free.marker(blade * n_t + t, k);
                    instant.free.circulation[m] = self.released[born * n_t + t];
                }
                let age = k as f64 * options.delta_psi() / options.rotor.omega * self.pace;
                for s in 0..n_sheet {
                    let m = instant.sheet.marker(blade * n_sheet + s, k);
                    instant.sheet.position[m] =
                        sum(self.sheet_release[born * n_sheet + s], carry.map(|v| v * age));
                    instant.sheet.circulation[m] = self.sheet_strength[born * n_sheet + s];
                }
            }
        }
        instant
    }
}

/// Last of every `n_trailers` rows of `length` values: what belongs to the trailers that leave the tips.
pub fn tip_rows<T: Copy>(values: &[T], n_trailers: usize, length: usize) -> Vec<T> {
    values.chunks_exact(length).skip(n_trailers - 1).step_by(n_trailers).flatten().copied().collect()
}
