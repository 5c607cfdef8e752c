//! The relaxation wake of a periodic motion taken as steady, with the circulation and the inflow that belong to it.
//!
//! Circulation and near wake are solved together at every azimuth; the inflow of everything else is relaxed:
//! lambda_far <- lambda_far + omega_lambda (lambda_far of the wake - lambda_far) [ribera2004].

use super::{Place, row};
use crate::blade::memory_rows::MemoryRows;
use crate::inflow::disk::{DiskMean, LiftingDisk};
use crate::rotor::circulation::{BladeInTime, BladeInstant};
use crate::rotor::hub::Rotor;
use crate::wake::airframe::mean_at_parts;
use crate::wake::{AtParts, RelaxationOptions, RelaxationWake, WakeError, WakeOptions};
use serde::{Deserialize, Serialize};

/// Growth of the change of inflow over its least, at which a smaller share of each change is taken.
const DIVERGING: f64 = 2.0;
/// Least share of a change of inflow that is taken.
const LEAST_SHARE: f64 = 0.05;
/// Change of the first turn's geometry over R in a sweep below which it counts as settled.
const FIRST_TURN_TOLERANCE: f64 = 1e-3;
/// Relative change of thrust in an iteration below which it counts as settled.
const THRUST_TOLERANCE: f64 = 1e-3;
/// Iterations without a tenth of progress after which smaller steps of the geometry are taken.
const PATIENCE: usize = 10;
/// Least share of the relaxation asked for that is taken.
const LEAST_RELAXATION: f64 = 0.25;
/// Iterations of a pass that are not part of its mean.
const SETTLING: usize = 5;
/// Passes whose means are averaged at most: they scatter by several tolerances, the mean of eight moves by an eighth of that.
const PASSES_OF_MEAN: usize = 8;
/// Passes from which their scatter tells the error of their mean.
const LEAST_PASSES_OF_MEAN: usize = 4;

/// Changes of an iteration, or the largest of them that count as rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Changes {
    /// Inflow over the tip speed, rms.
    pub inflow: f64,
    /// Thrust, relative.
    pub thrust: f64,
    /// Geometry of the first turn over R in a sweep.
    pub first_turn: f64,
}

/// What the last iteration did.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Iteration {
    /// Its changes.
    pub changes: Changes,
    /// Change of the whole geometry over R in the last sweep.
    pub geometry: f64,
    /// Which one of its pass it was, from 1.
    pub number: usize,
}

/// Relaxation wake, circulation by azimuth and inflow by azimuth of a periodic motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SteadyWake {
    #[serde(with = "crate::wake::options::whole")]
    options: WakeOptions,
    own: RelaxationOptions,
    /// Whether shorter steps of the geometry are taken where it circles.
    steadied: bool,
    disk: LiftingDisk,
    area: DiskMean,
    /// The wake; none before the first motion is known.
    pub wake: Option<RelaxationWake>,
    /// Far inflow (n_azimuths, n_stations) over the tip speed.
    pub lambda_far: Vec<f64>,
    /// Bound circulation (n_azimuths, n_stations) [m2/s].
    pub circulation: Vec<f64>,
    /// Total inflow (n_azimuths, n_stations), thin sections twice as wide.
    pub inflow: Vec<f64>,
    /// Air at the parts of the airframe with the first blade at every azimuth of a passage [m/s, `_h`]; empty where they do not feel the
    /// wake.
    pub at_parts: Vec<AtParts>,
    /// Memory of sections that remember, of the periodic motion last seen; by azimuth.
    pub memory: MemoryRows,
    /// Whether the last pass ended at rest.
    pub converged: bool,
    /// The last iteration.
    pub last: Option<Iteration>,
    /// Share of the relaxation asked for; the tolerances of what a sweep changes shrink with it.
    step_share: f64,
    /// Of a wake that circles: mean far inflow of each of the last passes,
    pass_means: Vec<Vec<f64>>,
    /// the standard error of their mean (rms), infinite where the wake does not circle or passes are few,
    pub mean_error: f64,
    /// and the largest distance from the mean in it (rms).
    pub wander: f64,
    /// Sweeps so far.
    pub sweeps: u64,
    /// Circulations so far that Newton did not find from the ones before.
    pub followed: u64,
}

impl SteadyWake {
    /// On an inflow map (n_azimuths, n_stations) from elsewhere; `steadied`: shorter steps of the geometry where it circles.
    pub fn new(
        options: WakeOptions,
        own: RelaxationOptions,
        steadied: bool,
        rotor: &Rotor,
        inflow: Vec<f64>,
    ) -> Self {
        Self {
            options,
            own,
            steadied,
            disk: rotor.lifting_disk(),
            area: rotor.disk_mean(),
            wake: None,
            lambda_far: inflow.clone(),
            circulation: vec![0.0; inflow.len()],
            inflow,
            at_parts: Vec::new(),
            memory: MemoryRows::default(),
            converged: false,
            last: None,
            step_share: 1.0,
            pass_means: Vec::new(),
            mean_error: f64::INFINITY,
            wander: f64::INFINITY,
            sweeps: 0,
            followed: 0,
        }
    }

    /// Azimuths of the maps.
    pub fn n_azimuths(&self) -> usize {
        self.circulation.len() / self.disk.stations.len()
    }

    /// Numbers of a row of the inflow.
    pub fn width(&self) -> usize {
        self.inflow.len() / self.n_azimuths()
    }

    /// Mean of the inflow over the disk.
    pub fn mean_inflow(&self) -> f64 {
        self.area.of(&self.inflow, self.width())
    }

    /// Air at the parts of the airframe, mean over a passage of a blade [m/s, `_h`]; none where they do not feel the wake.
    pub fn wash(&self) -> Option<AtParts> {
        (!self.at_parts.is_empty()).then(|| mean_at_parts(self.at_parts.iter()))
    }

    /// Air at the parts of the airframe over a passage of a blade.
    fn pass_the_airframe(&mut self, place: &Place) {
        let (Some(airframe), Some(wake)) = (self.options.washed(place.airframe), &self.wake) else { return };
        self.at_parts.clear();
        for l in 0..self.n_azimuths() / self.disk.n_blades {
            self.at_parts.push(airframe.mean(|points| wake.wake_velocity(points, l)));
        }
    }

    /// Evaluations of the segment law so far.
    pub fn segment_evaluations(&self) -> u64 {
        self.wake.as_ref().map_or(0, RelaxationWake::segment_evaluations)
    }

    /// The motion has changed: means of passes before tell nothing of the inflow to come.
    pub fn forget_means(&mut self) {
        self.pass_means.clear();
    }

    /// Largest changes in an iteration that count as rest.
    ///
    /// Geometry and inflow move in proportion to the step that is taken of the geometry: less of it is no rest.
    pub fn allowed(&self) -> Changes {
        Changes {
            inflow: self.step_share * self.own.inflow_tolerance,
            thrust: THRUST_TOLERANCE,
            first_turn: self.step_share * FIRST_TURN_TOLERANCE,
        }
    }

    /// Iterates wake and circulation for a periodic motion, the blade at every azimuth (n_azimuths,), at most `most` times;
    /// whether they came to rest.
    pub fn converge(
        &mut self,
        place: &Place,
        blades: &[BladeInstant],
        most: usize,
    ) -> Result<bool, WakeError> {
        self.remember(place, blades);
        if self.wake.is_none() {
            let mean = self.mean_inflow();
            self.wake = Some(RelaxationWake::new(self.options, self.own, place.wake_hub(), mean)?);
            // before there is a wake, the map given serves as total inflow
            self.sections_at_the_map(place, blades);
        } else {
            self.solve(place, blades)?;
        }
        let angles: Vec<(f64, f64)> =
            blades.iter().map(|b| place.rotor.equivalent_angles(&b.modal)).collect();
        let mut thrust = self.disk.thrust_integral(&self.circulation);
        self.converged = false;
        let (mut share, mut least) = (self.own.inflow_relaxation, f64::INFINITY);
        let (mut missing, mut since) = (f64::INFINITY, 0);
        let mut passed: Vec<Vec<f64>> = Vec::new();
        for iteration in 0..most {
            let (change, geometry, first_turn) = self.sweep(place, &angles)?;
            let rms = self.area.rms(&change);
            // a wake at low thrust stays in the disk, and inflow and circulation overshoot: take less of each change
            if rms > DIVERGING * least {
                (share, least) = ((0.5 * share).max(LEAST_SHARE), rms);
            }
            least = least.min(rms);
            for (far, change) in self.lambda_far.iter_mut().zip(&change) {
                *far += share * change;
            }
            self.solve(place, blades)?;
            let before = std::mem::replace(&mut thrust, self.disk.thrust_integral(&self.circulation));
            let nothing = 1e-6 * (self.disk.omega * self.disk.radius) * self.disk.radius.powi(2);
            let thrust_change = (thrust - before).abs() / thrust.abs().max(nothing);
            let changes = Changes { inflow: rms, thrust: thrust_change, first_turn };
            self.last = Some(Iteration { changes, geometry, number: iteration + 1 });
            let now = changes.over(&self.allowed());
            if now < 1.0 {
                self.converged = true;
                break;
            }
            (missing, since) = if now < 0.9 * missing { (now, 0) } else { (missing, since + 1) };
            if self.steadied && since >= PATIENCE && self.step_share > LEAST_RELAXATION {
                // rolled-up wakes circle about their answer: shorter steps of the geometry bring them to it
                self.shorten_steps()?;
                (missing, since) = (f64::INFINITY, 0);
            } else if self.steadied && self.step_share == LEAST_RELAXATION && iteration >= SETTLING {
                passed.push(self.lambda_far.clone());
            }
        }
        (self.mean_error, self.wander) = (f64::INFINITY, f64::INFINITY);
        if passed.len() >= PATIENCE && !self.converged {
            self.take_mean(&passed);
            self.solve(place, blades)?;
        }
        self.pass_the_airframe(place);
        Ok(self.converged)
    }

    /// Sweeps the wake at the present circulation: change of the far inflow, of the geometry and of its first turn.
    fn sweep(&mut self, place: &Place, angles: &[(f64, f64)]) -> Result<(Vec<f64>, f64, f64), WakeError> {
        let hub = place.wake_hub();
        let carrying = self.disk.carrying_inflow(&self.circulation, hub.velocity);
        let Some(wake) = self.wake.as_mut() else {
            return Ok((vec![0.0; self.lambda_far.len()], 0.0, 0.0));
        };
        wake.set_pace(place.pace())?;
        wake.set_ground(place.ground);
        wake.set_state(hub, angles, &self.circulation)?;
        wake.set_mean_inflow(carrying)?;
        let norms = wake.sweep(self.own.sweeps)?;
        self.sweeps += norms.len() as u64;
        let (geometry, first_turn) = norms.last().map_or((0.0, 0.0), |n| (n.all, n.first_turn));
        let mut far = wake.inflow_far();
        add_upwash(wake, place, &mut far);
        Ok((far.iter().zip(&self.lambda_far).map(|(a, b)| a - b).collect(), geometry, first_turn))
    }

    fn shorten_steps(&mut self) -> Result<(), WakeError> {
        self.step_share = (0.5 * self.step_share).max(LEAST_RELAXATION);
        match self.wake.as_mut() {
            Some(wake) => wake.set_relaxation(self.step_share * self.own.relaxation),
            None => Ok(()),
        }
    }

    /// Holds the mean of the far inflows that a pass went through.
    fn take_mean(&mut self, passed: &[Vec<f64>]) {
        let mean = mean_of(passed);
        let apart =
            |a: &[f64], b: &[f64]| self.area.rms(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>());
        self.wander = passed.iter().map(|each| apart(each, &mean)).fold(0.0, f64::max);
        self.pass_means.push(mean);
        if self.pass_means.len() > PASSES_OF_MEAN {
            self.pass_means.remove(0);
        }
        self.lambda_far = mean_of(&self.pass_means);
        let passes = self.pass_means.len();
        if passes >= LEAST_PASSES_OF_MEAN {
            let squares: f64 = self.pass_means.iter().map(|each| apart(each, &self.lambda_far).powi(2)).sum();
            self.mean_error = (squares / (passes * (passes - 1)) as f64).sqrt();
        }
    }

    /// The first circulation has no near wake: sections at the inflow of the map.
    fn sections_at_the_map(&mut self, place: &Place, blades: &[BladeInstant]) {
        let n = self.disk.stations.len();
        let mut slope = vec![0.0; n];
        let rows = self.lambda_far.chunks_exact(n).zip(self.circulation.chunks_exact_mut(n));
        let hub = place.blade_hub();
        for (k, (instant, (lambda, circulation))) in blades.iter().zip(rows).enumerate() {
            let blade = BladeInTime { instant, past: self.memory.periodic(k) };
            place.rotor.section_circulation(place.air, &hub, blade, lambda, circulation, &mut slope);
        }
        self.inflow.clone_from(&self.lambda_far);
    }

    /// Circulation and near wake together at every azimuth.
    fn solve(&mut self, place: &Place, blades: &[BladeInstant]) -> Result<(), WakeError> {
        let (far, start) = (&self.lambda_far, &self.circulation);
        let known = (blades, &self.memory);
        let all = place.rotor.circulations(place.air, &self.options, &place.course(), known, far, start)?;
        (self.circulation, self.inflow) = (all.gamma, all.inflow);
        self.followed += all.followed as u64;
        self.remember(place, blades);
        Ok(())
    }

    /// Memory of the sections in the inflow as it is.
    fn remember(&mut self, place: &Place, blades: &[BladeInstant]) {
        let (rotor, width) = (place.rotor, self.width());
        let row = |k: usize| rotor.held_inflow(&self.inflow[k * width..(k + 1) * width]);
        let step = rotor.nominal_step(blades.len()) * place.pace();
        self.memory = rotor.periodic_memory(place.air, &place.blade_hub(), (blades, step), row);
    }
}

impl Iteration {
    /// By name.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.changes.named().into_iter().chain([("geometry_change", self.geometry)])
    }
}

impl Changes {
    /// By name.
    pub fn named(&self) -> [(&'static str, f64); 3] {
        [
            ("inflow_change", self.inflow),
            ("thrust_change", self.thrust),
            ("first_turn_change", self.first_turn),
        ]
    }

    /// Largest ratio to what is `allowed`, below one at rest; not a number where one of them is not.
    pub fn over(&self, allowed: &Self) -> f64 {
        let ratios = [
            self.inflow / allowed.inflow,
            self.thrust / allowed.thrust,
            self.first_turn / allowed.first_turn,
        ];
        let worse = |most: f64, r: f64| if most.is_nan() || most > r { most } else { r };
        ratios.into_iter().fold(f64::NEG_INFINITY, worse)
    }
}

/// Adds to the far inflow by azimuth what the body of the fuselage does.
fn add_upwash(wake: &RelaxationWake, place: &Place, far: &mut [f64]) {
    let (options, hub) = (wake.options(), place.wake_hub());
    if options.body(place.airframe).is_none() {
        return;
    }
    let (n_blades, n, n_stations) =
        (options.rotor.n_blades, options.steps_per_revolution(), options.n_stations);
    let mut inflow = vec![0.0; n_blades * n_stations];
    for l in 0..n / n_blades {
        inflow.fill(0.0);
        options.add_upwash(place.airframe, &hub, &wake.instant(l), &mut inflow);
        for (b, upwash) in inflow.chunks_exact(n_stations).enumerate() {
            let k = row(l, b, n_blades, n) * n_stations;
            far[k..k + n_stations].iter_mut().zip(upwash).for_each(|(v, up)| *v += up);
        }
    }
}

/// Mean of arrays of one length.
fn mean_of(all: &[Vec<f64>]) -> Vec<f64> {
    let mut sum = all[0].clone();
    for each in &all[1..] {
        for (s, v) in sum.iter_mut().zip(each) {
            *s += v;
        }
    }
    sum.iter().map(|s| s / all.len() as f64).collect()
}
