//! Time-accurate wake: the free filaments advance with the blades, step by step [bhagwat2001].

use super::choices::{Evaluation, Form, Predictor, Scheme};
use super::error::{WakeError, checked_pace, finite, length};
use super::far_wake;
use super::geometry::BladeGrid;
use super::ground::Plane;
use super::instant::RotorInstant;
use super::marker_velocity::{MarkerVelocity, field_before_step};
use super::motion::{BladeState, HubMotion};
use super::options::{MarchingOptions, WakeOptions};
use super::relaxation::{RelaxationWake, tip_rows};
use super::stencils::{Cell, corrector_velocity, predicted_corner, unknown_corner};
use super::vectors::difference;
use super::velocity_field::{FieldWork, InducedVelocity, Induction, Wanted, field_at, point_velocity};
use std::f64::consts::TAU;

mod level;

/// What one step did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// Largest motion of a marker, over R.
    pub max_displacement: f64,
    /// RMS of r(n+1) - 2 r(n) + r(n-1) of the markers, over R: the size of an odd-even mode in time, on top of the
    /// acceleration of the air.
    pub odd_even: f64,
    /// Segment evaluations of the step.
    pub segment_evaluations: u64,
}

/// Free filaments of every blade, marched in time with a fixed step of azimuth.
///
/// dr/dpsi + dr/dzeta = V/omega; one predictor and one corrector per step. Three levels of geometry are kept, and with
/// every marker its circulation and the place of its release.
#[derive(Clone, Debug, serde::Deserialize, serde::Serialize)]
pub struct TimeMarchingWake<F: InducedVelocity = Induction> {
    #[serde(with = "super::options::whole")]
    options: WakeOptions,
    own: MarchingOptions,
    grid: BladeGrid,
    field: F,
    hub: HubMotion,
    mean_inflow: f64,
    blades: Vec<BladeState>,
    instant: RotorInstant,
    /// Place that the unknown is measured from: release of the marker, or the origin in position form.
    carrier: Vec<[f64; 3]>,
    /// Unknown at the levels n, n-1, n-2 (n_blades, n_trailers, n_segments + 1) [m].
    levels: [Vec<[f64; 3]>; 3],
    steps: u64,
    evaluations: u64,
    /// Velocity of the markers at the present level.
    velocity: MarkerVelocity,
    /// Time that the step takes over that of a step at the nominal speed.
    pace: f64,
    /// Whether a step has taken another time.
    uneven: bool,
    /// Ground under the hub at the levels to come, where there is one.
    ground: Option<Plane>,
    #[serde(skip)]
    work: Work,
}

/// What a step is made in; nothing of it outlives the step but its room.
#[derive(Debug, Default)]
struct Work {
    field: FieldWork,
    next: RotorInstant,
    carrier: Vec<[f64; 3]>,
    unknown: Vec<[f64; 3]>,
    at_new: Vec<[f64; 3]>,
}

impl Clone for Work {
    /// Empty: a copy of a wake needs none of it.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl<F: InducedVelocity> TimeMarchingWake<F> {
    /// Starts from a periodic wake with blade 1 at row `azimuth_index`; the past levels are the periodic ones.
    pub fn from_relaxation(
        relaxation: &RelaxationWake<F>,
        azimuth_index: usize,
        own: MarchingOptions,
    ) -> Result<Self, WakeError> {
        let options = relaxation.options;
        own.validate(&options)?;
        if azimuth_index >= options.steps_per_revolution() {
            return Err(WakeError::InvalidOption {
                field: "azimuth_index",
                value: azimuth_index.to_string(),
                allowed: format!("less than steps_per_revolution = {}", options.steps_per_revolution()),
            });
        }
        let (n_k, n_t) = (options.n_segments(), options.trailers_per_blade());
        let instant = relaxation.instant(azimuth_index);
        let mut carrier = Vec::with_capacity(instant.free.position.len());
        let mut levels: [Vec<[f64; 3]>; 3] = Default::default();
        for i in 0..options.rotor.n_blades * n_t {
            let (row, t) = (relaxation.blade_row(azimuth_index, i / n_t), i % n_t);
            let from = |row: usize, k: usize| match options.form {
                Form::Displacement => relaxation.release[relaxation.row(row, k) * n_t + t],
                Form::Position => [0.0; 3],
            };
            for k in 0..=n_k {
                carrier.push(from(row, k));
                for (m, level) in levels.iter_mut().enumerate() {
                    let past = relaxation.row(row, m);
                    level.push(difference(relaxation.position[relaxation.index(past, t, k)], from(past, k)));
                }
            }
        }
        let blades = (0..options.rotor.n_blades)
            .map(|blade| relaxation.blades[relaxation.blade_row(azimuth_index, blade)])
            .collect();
        Ok(TimeMarchingWake {
            grid: relaxation.grid.clone(),
            field: relaxation.field.clone(),
            hub: relaxation.hub,
            mean_inflow: relaxation.mean_inflow,
            blades,
            instant,
            carrier,
            levels,
            steps: 0,
            evaluations: 0,
            velocity: MarkerVelocity::Unknown,
            pace: 1.0,
            uneven: false,
            ground: relaxation.ground,
            work: Work::default(),
            options,
            own,
        })
    }

    /// Time that the steps to come take over that of a step at the nominal speed of the rotor: V/omega with the omega there is,
    /// at the new level, and cores that grow by the time that passes.
    pub fn set_pace(&mut self, pace: f64) -> Result<(), WakeError> {
        self.pace = checked_pace(pace)?;
        self.uneven |= pace != 1.0;
        Ok(())
    }

    /// Ground under the hub where the next step ends; none out of its effect.
    pub fn set_ground(&mut self, ground: Option<Plane>) {
        self.ground = ground;
    }

    /// Advances by one step of azimuth to the given hub motion, blades (n_blades) and bound circulation
    /// (n_blades, n_stations) [m2/s]. On an error the wake is unchanged.
    pub fn step(
        &mut self,
        hub: HubMotion,
        blades: &[BladeState],
        circulation: &[f64],
    ) -> Result<StepReport, WakeError> {
        self.check_input(&hub, blades, circulation)?;
        let mut work = std::mem::take(&mut self.work);
        let report = self.step_in(&mut work, hub.felt(&self.options), blades, circulation);
        self.work = work;
        report
    }

    fn step_in(
        &mut self,
        work: &mut Work,
        hub: HubMotion,
        blades: &[BladeState],
        circulation: &[f64],
    ) -> Result<StepReport, WakeError> {
        let (velocity, mut evaluations) = self.velocity_of_markers(&mut work.field);
        self.shift(work, &hub, blades, circulation);
        let Work { field, next, carrier, unknown, at_new } = work;
        let (options, own) = (&self.options, self.own);

        let step = options.delta_psi() / options.rotor.omega * self.pace;
        far_wake::carry(options, &mut next.far, &self.instant.free, &velocity, &self.hub, step);
        let old = |i: usize| [velocity[i], velocity[i + 1]];

        // predictor: both ends of the segment at the old level
        let predictor = match own.predictor {
            Predictor::Same => own.scheme,
            Predictor::Central => Scheme::Pcc,
        };
        let predicted = |cell: &Cell, i: usize| predicted_corner(predictor, cell, step, old(i));
        self.march(next, carrier, predicted, unknown);
        self.place_markers(next, carrier, unknown);
        self.guard(next)?;

        let wanted = Wanted { markers: Some((&hub, &mut *at_new)), ..Wanted::default() };
        evaluations += field_at(&self.field, options, next, field, wanted);
        let corrected = |cell: &Cell, i: usize| {
            let velocity = corrector_velocity(own.scheme, cell, old(i), [at_new[i], at_new[i + 1]]);
            unknown_corner(own.scheme, cell, velocity.map(|v| v * step))
        };
        self.march(next, carrier, corrected, unknown);
        self.place_markers(next, carrier, unknown);
        let max_displacement = self.guard(next)?;
        let odd_even = self.odd_even(unknown);

        if own.time_filter > 0.0 {
            for i in 0..unknown.len() {
                for c in 0..3 {
                    let second = unknown[i][c] - 2.0 * self.levels[0][i][c] + self.levels[1][i][c];
                    self.levels[0][i][c] += own.time_filter * second;
                }
            }
        }
        self.levels.rotate_right(1);
        std::mem::swap(&mut self.levels[0], unknown);
        std::mem::swap(&mut self.instant, next);
        std::mem::swap(&mut self.carrier, carrier);
        // what the last evaluation saw was the predicted wake
        self.velocity = match self.own.evaluation {
            Evaluation::Pec => MarkerVelocity::Known(std::mem::take(at_new)),
            Evaluation::Pece => MarkerVelocity::Unknown,
        };
        self.hub = hub;
        self.blades.copy_from_slice(blades);
        self.steps += 1;
        self.evaluations += evaluations;
        Ok(StepReport { max_displacement, odd_even, segment_evaluations: evaluations })
    }

    /// Velocity of the markers at the present level [m/s]; the number of segment evaluations that it takes now.
    fn velocity_of_markers(&self, work: &mut FieldWork) -> (Vec<[f64; 3]>, u64) {
        if let Some(known) = self.velocity.found() {
            return (known, 0);
        }
        let mut velocity = Vec::new();
        let wanted = Wanted { markers: Some((&self.hub, &mut velocity)), ..Wanted::default() };
        let evaluations = field_at(&self.field, &self.options, &self.instant, work, wanted);
        (velocity, evaluations)
    }

    /// RMS of the second difference in time of the inner markers along their characteristics, over R.
    fn odd_even(&self, new: &[[f64; 3]]) -> f64 {
        let free = &self.instant.free;
        let mut curvature = 0.0;
        for filament in 0..free.n_filaments {
            let m = free.marker(filament, 0);
            for i in m + 1..m + free.n_segments {
                for c in 0..3 {
                    curvature +=
                        (new[i + 1][c] - 2.0 * self.levels[0][i][c] + self.levels[1][i - 1][c]).powi(2);
                }
            }
        }
        let n_inner = (free.n_filaments * (free.n_segments - 1)) as f64;
        (curvature / n_inner).sqrt() / self.options.rotor.radius
    }

    /// Options that both kinds of free wake share.
    pub fn options(&self) -> &WakeOptions {
        &self.options
    }

    /// Options of marching.
    pub fn own(&self) -> &MarchingOptions {
        &self.own
    }

    /// Radial grid.
    pub fn grid(&self) -> &BladeGrid {
        &self.grid
    }

    /// Markers of every trailer, root to tip (n_blades, n_trailers, n_segments + 1) [m, `_h`].
    pub fn position(&self) -> &[[f64; 3]] {
        &self.instant.free.position
    }

    /// Markers of the tip trailers (n_blades, n_segments + 1) [m, `_h`].
    pub fn tip_position(&self) -> Vec<[f64; 3]> {
        tip_rows(self.position(), self.options.trailers_per_blade(), self.options.n_segments() + 1)
    }

    /// Circulation of the markers (n_blades, n_trailers, n_segments + 1) [m2/s].
    pub fn marker_circulation(&self) -> &[f64] {
        &self.instant.free.circulation
    }

    /// Core radii of the segments (n_blades, n_trailers, n_segments) [m].
    pub fn core_radius(&self) -> Vec<f64> {
        self.instant.free.core_squared.iter().map(|c| c.sqrt()).collect()
    }

    /// Blades at the present level.
    pub fn blades(&self) -> &[BladeState] {
        &self.blades
    }

    /// Rotor and wake at the present level.
    pub fn instant(&self) -> &RotorInstant {
        &self.instant
    }

    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Segment evaluations so far.
    pub fn segment_evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Mean induced inflow v/(omega R) that carries the inboard sheet.
    pub fn set_mean_inflow(&mut self, mean_inflow: f64) -> Result<(), WakeError> {
        finite("mean_inflow", &[mean_inflow])?;
        self.mean_inflow = mean_inflow;
        Ok(())
    }

    /// Bound circulation of the present level (n_blades, n_stations) [m2/s], replaced without advancing the wake.
    pub fn set_circulation(&mut self, circulation: &[f64]) -> Result<(), WakeError> {
        length("circulation", circulation.len(), self.instant.circulation.len())?;
        finite("circulation", circulation)?;
        if self.own.evaluation == Evaluation::Pece {
            self.velocity = MarkerVelocity::Unknown;
        }
        self.instant.circulation.copy_from_slice(circulation);
        for (blade, gamma) in circulation.chunks_exact(self.options.n_stations).enumerate() {
            self.instant.release(&self.options, &self.grid, blade, gamma);
        }
        Ok(())
    }

    /// Induced inflow at the stations without that of the own near wake, -v_z/(omega R) (n_blades, n_stations).
    pub fn inflow_far(&mut self) -> Vec<f64> {
        let mut inflow = Vec::new();
        let wanted = Wanted { stations: Some(&mut inflow), ..Wanted::default() };
        self.evaluations += field_at(&self.field, &self.options, &self.instant, &mut self.work.field, wanted);
        inflow
    }

    /// The same into `inflow`, and in the same pass the velocity that the next step begins with.
    ///
    /// For the last call before a step: [`set_circulation`](Self::set_circulation) makes that velocity void.
    pub fn inflow_far_before_step(&mut self, inflow: &mut Vec<f64>) {
        let (at, work) = ((&self.instant, &self.hub), &mut self.work.field);
        if matches!(self.velocity, MarkerVelocity::Unknown) {
            let (velocity, evaluations) = field_before_step(&self.field, &self.options, at, work, inflow);
            (self.velocity, self.evaluations) = (velocity, self.evaluations + evaluations);
            return;
        }
        let wanted = Wanted { stations: Some(inflow), ..Wanted::default() };
        self.evaluations += field_at(&self.field, &self.options, &self.instant, work, wanted);
    }

    /// Velocity induced at `points` [m/s, `_h`] by rotor and wake; near-wake trailers not included.
    pub fn wake_velocity(&self, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        point_velocity(&self.field, &self.options, &self.instant, points)
    }

    fn check_input(
        &self,
        hub: &HubMotion,
        blades: &[BladeState],
        circulation: &[f64],
    ) -> Result<(), WakeError> {
        hub.validate(&self.options)?;
        length("blades", blades.len(), self.options.rotor.n_blades)?;
        length("circulation", circulation.len(), self.instant.circulation.len())?;
        finite("circulation", circulation)?;
        for (old, new) in self.blades.iter().zip(blades) {
            new.validate()?;
            let ahead = new.psi - old.psi - self.options.delta_psi();
            let off = (ahead + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
            if off.abs() > 1e-6 {
                return Err(WakeError::InvalidOption {
                    field: "blade psi",
                    value: new.psi.to_string(),
                    allowed: format!("one step of {} rad after {}", self.options.delta_psi(), old.psi),
                });
            }
        }
        Ok(())
    }
}
