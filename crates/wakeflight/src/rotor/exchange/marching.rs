//! The exchange between flight dynamics and the time-marching wake at the end of a coupling step.
//!
//! Circulation from the motion and the far inflow, the wake one step further, the far inflow anew, the circulation again:
//! one call, with the near wakes of the blades found once.

use super::passages::Passages;
use super::{Held, Lattice, Place, SteadyWake, over_step, row, steps_of};
use crate::blade::memory_rows::MemoryRows;
use crate::inflow::disk::{DiskMean, LiftingDisk};
use crate::rotor::circulation::{BladeInstant, PlacedBlade};
use crate::rotor::hub::Rotor;
use crate::vortex::threads::share;
use crate::wake::airframe::mean_at_parts;
use crate::wake::miss_distance::miss_distance_in_cores;
use crate::wake::{AtParts, BladeState, InboardWake, Route, TimeMarchingWake, WakeError};
use serde::{Deserialize, Serialize};

/// What an exchange saw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExchangeReport {
    /// Largest motion of a marker in the step, over R.
    pub max_displacement: f64,
    /// Odd-even content in time of the markers, over R.
    pub odd_even: f64,
    /// Smallest distance between blade and tip vortex, in core radii.
    pub miss_distance: f64,
    /// Circulations that Newton did not find from the last ones: see [`Route`].
    pub followed: usize,
}

/// Time-marching wake and the circulation and inflow that belong to it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MarchingExchange {
    /// The wake.
    pub wake: TimeMarchingWake,
    /// Far inflow at the stations (n_blades, n_stations).
    pub lambda_far: Vec<f64>,
    far_held: Vec<f64>,
    /// Bound circulation (n_blades, n_stations) [m2/s].
    pub circulation: Vec<f64>,
    /// Total inflow held over the next step (n_blades, n_stations), with thin sections at both lines of the chord.
    pub inflow: Vec<f64>,
    /// Memory of sections that remember where the step begins, blade by blade.
    pub memory: MemoryRows,
    /// Circulations that were not solved; the exchange that met one failed.
    pub unsolved: usize,
    /// Circulations so far that Newton did not find from the ones before.
    pub followed: usize,
    /// What the last exchange saw.
    pub report: Option<ExchangeReport>,
    /// Steps of azimuth since the start.
    step: usize,
    disk: LiftingDisk,
    area: DiskMean,
    /// Inflow, far inflow and circulation at the latest passage of every azimuth.
    passages: Passages,
    passed_far: Passages,
    passed_circulation: Passages,
    /// Air at the parts of the airframe after each step of the last revolution [m/s, `_h`], by the number of the step; empty where they do
    /// not feel the wake.
    at_parts: Vec<AtParts>,
    /// The map that is held, where one is, and the steps that it is held for.
    held_map: Vec<f64>,
    hold: Option<usize>,
    /// Time since the step began [s].
    #[serde(skip)]
    elapsed: f64,
    #[serde(skip)]
    blades: Vec<BladeInstant>,
    #[serde(skip)]
    states: Vec<BladeState>,
    #[serde(skip)]
    placed: Vec<PlacedBlade>,
}

impl MarchingExchange {
    /// `wake`, started from the periodic one of `start` with blade 1 at azimuth zero.
    pub fn new(wake: TimeMarchingWake, start: &SteadyWake, rotor: &Rotor) -> Self {
        let (n, n_stations, width) = (start.n_azimuths(), wake.options().n_stations, start.width());
        let rows = |map: &[f64], width: usize| -> Vec<f64> {
            let at = |b: usize| row(0, b, rotor.n_blades, n) * width;
            (0..rotor.n_blades).flat_map(|b| map[at(b)..at(b) + width].iter().copied()).collect()
        };
        let lambda_far = rows(&start.lambda_far, n_stations);
        Self {
            hold: wake.own().update_interval.map(|interval| steps_of(interval, n)),
            wake,
            far_held: lambda_far.clone(),
            lambda_far,
            circulation: rows(&start.circulation, n_stations),
            inflow: rows(&start.inflow, width),
            memory: start.memory.rows((0..rotor.n_blades).map(|b| row(0, b, rotor.n_blades, n))),
            unsolved: 0,
            followed: 0,
            report: None,
            step: 0,
            disk: rotor.lifting_disk(),
            area: rotor.disk_mean(),
            passages: Passages::new(&start.inflow, width, rotor.n_blades, 0),
            passed_far: Passages::new(&start.lambda_far, n_stations, rotor.n_blades, 0),
            passed_circulation: Passages::new(&start.circulation, n_stations, rotor.n_blades, 0),
            at_parts: start.at_parts.repeat(rotor.n_blades),
            held_map: start.inflow.clone(),
            elapsed: 0.0,
            blades: Vec::new(),
            states: Vec::new(),
            placed: Vec::new(),
        }
    }

    /// Steps of azimuth since the start.
    pub fn steps(&self) -> usize {
        self.step
    }

    /// Counts steps anew from here, blade 1 at azimuth zero: a phase before the flight has ended.
    pub fn restart(&mut self) {
        self.step = 0;
        self.held_map.clone_from(&self.passages.map);
    }

    /// Inflow over the step that begins, and the mean over the disk.
    ///
    /// The mean is that of the latest passage of every azimuth: over the blades' present azimuths alone it would swing by n
    /// per revolution.
    pub(super) fn held(&self, step: usize) -> Held {
        let width = self.inflow.len() / self.disk.n_blades;
        let carried = self.wake.own().extrapolate.then(|| self.passages.change.clone());
        let (inflow, change, map) = if self.hold.is_some() {
            let [inflow, change] = over_step(&self.held_map, width, step, self.disk.n_blades);
            (inflow, Some(change), &self.held_map)
        } else {
            (self.inflow.clone(), carried, &self.passages.map)
        };
        Held { inflow: Some(inflow), change, mean: self.area.of(map, width) }
    }

    /// The blades have reached the next step, `elapsed` [s] after the last: circulation, wake, far inflow, circulation.
    pub fn advance(&mut self, at: &Place, blades: &[BladeInstant], elapsed: f64) -> Result<(), WakeError> {
        self.step += 1;
        self.elapsed = elapsed;
        let hub = at.wake_hub();
        if self.wake.options().inboard_wake == InboardWake::Sheet {
            self.wake
                .set_mean_inflow(self.disk.carrying_inflow(&self.passed_circulation.map, hub.velocity))?;
        }
        self.wake.set_pace(at.pace())?;
        self.wake.set_ground(at.ground);
        self.place(at, blades)?;
        let mut followed = self.solve(at, true)?;
        let step = self.wake.step(hub, &self.states, &self.circulation)?;
        self.find_far(at, self.wake.own().recorrect == 0);
        followed += self.solve(at, false)?;
        for pass in 0..self.wake.own().recorrect {
            self.wake.set_circulation(&self.circulation)?;
            self.find_far(at, pass + 1 == self.wake.own().recorrect);
            followed += self.solve(at, false)?;
        }
        self.memory = self.kept(at);
        self.report = Some(ExchangeReport {
            max_displacement: step.max_displacement,
            odd_even: step.odd_even,
            miss_distance: miss_distance_in_cores(self.wake.options(), self.wake.instant()),
            followed,
        });
        self.followed += followed;
        self.keep_passages();
        self.pass_the_airframe(at);
        Ok(())
    }

    /// Air at the parts of the airframe over the step that begins, mean over the last passage of a blade [m/s, `_h`]; none where they do
    /// not feel the wake.
    pub fn wash(&self) -> Option<AtParts> {
        let n = self.at_parts.len();
        let last = (0..n / self.disk.n_blades).map(|back| &self.at_parts[(self.step + n - back) % n]);
        (n > 0).then(|| mean_at_parts(last))
    }

    /// The same, mean over the last revolution.
    pub fn wash_of_turn(&self) -> Option<AtParts> {
        (!self.at_parts.is_empty()).then(|| mean_at_parts(self.at_parts.iter()))
    }

    /// Air at the parts of the airframe as the step ends.
    fn pass_the_airframe(&mut self, at: &Place) {
        let Some(airframe) = self.wake.options().washed(at.airframe) else { return };
        let n = self.at_parts.len();
        if let Some(sample) = self.at_parts.get_mut(self.step % n.max(1)) {
            *sample = airframe.mean(|points| self.wake.wake_velocity(points));
        }
    }

    /// A revolution with the hub, sticks and the motion of a blade at every azimuth (n_azimuths,) held: inflow and circulation by
    /// azimuth, means of all blades' passages.
    pub fn turn(&mut self, at: &Place, periodic: &[BladeInstant]) -> Result<(Vec<f64>, Vec<f64>), WakeError> {
        let (n, n_blades) = (periodic.len(), self.disk.n_blades);
        let mut inflow = vec![0.0; self.passages.map.len()];
        let mut circulation = vec![0.0; self.passed_circulation.map.len()];
        let mut blades = Vec::with_capacity(n_blades);
        for _ in 0..n {
            let rows: Vec<usize> = (0..n_blades).map(|b| row(self.step + 1, b, n_blades, n)).collect();
            blades.clear();
            blades.extend(rows.iter().map(|&k| periodic[k]));
            self.advance(at, &blades, at.rotor.nominal_step(n))?;
            add_rows(&mut inflow, &rows, &self.inflow);
            add_rows(&mut circulation, &rows, &self.circulation);
        }
        for map in [&mut inflow, &mut circulation] {
            map.iter_mut().for_each(|v| *v /= n_blades as f64);
        }
        Ok((inflow, circulation))
    }

    /// Inflow and circulation of the blades enter the maps at their azimuths.
    fn keep_passages(&mut self) {
        self.passages.keep(self.step, &self.inflow);
        self.passed_far.keep(self.step, &self.lambda_far);
        self.passed_circulation.keep(self.step, &self.circulation);
        if self.hold.is_some_and(|every| self.step.is_multiple_of(every)) {
            self.held_map.clone_from(&self.passages.map);
        }
    }

    pub(super) fn lattice(&self) -> Lattice {
        Lattice {
            n_trailers: self.wake.options().trailers_per_blade(),
            position: self.wake.position().to_vec(),
            circulation: self.wake.marker_circulation().to_vec(),
            core_radius: self.wake.core_radius(),
        }
    }

    /// Blades at their azimuths, and their near wakes.
    fn place(&mut self, at: &Place, blades: &[BladeInstant]) -> Result<(), WakeError> {
        let (rotor, hubs) = (at.rotor, (&at.blade_hub(), &at.near_hub()));
        self.blades.clear();
        self.blades.extend_from_slice(blades);
        self.states.clear();
        self.states.extend(blades.iter().map(|blade| {
            let (flap, lead) = rotor.equivalent_angles(&blade.modal);
            BladeState { psi: blade.psi, flap, lead }
        }));
        let mut placed: Vec<Option<Result<PlacedBlade, WakeError>>> = blades.iter().map(|_| None).collect();
        let options = self.wake.options();
        share(blades.iter().zip(&self.states).zip(&mut placed), |((blade, state), placed)| {
            *placed = Some(rotor.placed(at.air, options, hubs, blade, state));
        });
        self.placed.clear();
        for placed in placed.into_iter().flatten() {
            self.placed.push(placed?);
        }
        Ok(())
    }

    /// Far inflow of the wake as it is; with the `last` before the next step goes the velocity of its markers.
    fn find_far(&mut self, at: &Place, last: bool) {
        if last {
            self.wake.inflow_far_before_step(&mut self.lambda_far);
        } else {
            self.lambda_far = self.wake.inflow_far();
        }
        let (options, instant) = (self.wake.options(), self.wake.instant());
        options.add_upwash(at.airframe, &at.wake_hub(), instant, &mut self.lambda_far);
    }

    /// Circulation and total inflow of every blade; `before`: the far inflow is that of the step before, to be carried on, and the
    /// circulation is sought from where it led the blade before.
    fn solve(&mut self, at: &Place, before: bool) -> Result<usize, WakeError> {
        self.far_held.copy_from_slice(&self.lambda_far);
        if before {
            add_to(&mut self.circulation, &self.passed_circulation.change);
        }
        if before && self.wake.own().extrapolate {
            add_to(&mut self.far_held, &self.passed_far.change);
        }
        // the sections feel a gust as they feel inflow; what is kept is induced
        for (held, gust) in self.far_held.iter_mut().zip(at.gust) {
            *held += gust;
        }
        let n = self.wake.options().n_stations;
        let mut outcomes: Vec<Result<bool, WakeError>> = vec![Ok(true); self.blades.len()];
        let (memory, elapsed) = (&self.memory, self.elapsed);
        let given = self.blades.iter().zip(&self.placed).zip(self.far_held.chunks(n)).enumerate();
        let width = at.rotor.inflow_width();
        let kept = self.circulation.chunks_mut(n).zip(self.inflow.chunks_mut(width)).zip(&mut outcomes);
        share(given.zip(kept), |((b, ((instant, blade), far)), ((circulation, inflow), outcome))| {
            let blade = (blade, memory.step(b, elapsed));
            let solution = at.rotor.blade_circulation(at.air, blade, far, circulation);
            *outcome = solution.and_then(|found| at.rotor.solved(found, b, instant.psi)).map(|solution| {
                circulation.copy_from_slice(&solution.gamma);
                inflow.copy_from_slice(&solution.inflow);
                solution.found_by == Some(Route::Newton)
            });
        });
        take_off(&mut self.inflow, at.gust, (width, n));
        self.unsolved += outcomes.iter().filter(|o| matches!(o, Err(WakeError::Circulation { .. }))).count();
        outcomes.into_iter().try_fold(0, |followed, outcome| Ok(followed + usize::from(!outcome?)))
    }

    /// Memory of the sections in the inflow found for the present, in which the next step begins.
    fn kept(&self, at: &Place) -> MemoryRows {
        let hub = at.blade_hub();
        let rows = self.blades.iter().zip(self.inflow.chunks(at.rotor.inflow_width())).enumerate();
        MemoryRows::of(rows.map(|(b, (blade, row))| {
            let past = self.memory.step(b, self.elapsed);
            at.rotor.kept(at.air, &hub, blade, &at.rotor.held_inflow(row), past)
        }))
    }
}

fn add_to(values: &mut [f64], more: &[f64]) {
    values.iter_mut().zip(more).for_each(|(v, more)| *v += more);
}

/// Takes a gust (n_blades, n) off rows of inflow of `width`, of thin sections at both lines of the chord.
fn take_off(inflow: &mut [f64], gust: &[f64], (width, n): (usize, usize)) {
    for (row, gust) in inflow.chunks_exact_mut(width).zip(gust.chunks_exact(n)) {
        row.iter_mut().zip(gust.iter().cycle()).for_each(|(v, g)| *v -= g);
    }
}

/// Adds the values of the blades to their rows of a map.
fn add_rows(map: &mut [f64], rows: &[usize], values: &[f64]) {
    let width = values.len() / rows.len();
    for (&k, blade) in rows.iter().zip(values.chunks_exact(width)) {
        add_to(&mut map[k * width..(k + 1) * width], blade);
    }
}
