//! The exchange between flight dynamics and the time-marching wake at the end of a coupling step.
//!
//! Circulation from the motion and the far inflow, the wake one step further, the far inflow anew, the circulation again:
//! one call, with the near wakes of the blades found once.

use super::circulation::{BladeInstant, NearWake};
use super::hub::Rotor;
use crate::blade::aerodynamics::Air;
use crate::blade::loads::HubMotion;
use crate::vortex::threads::share;
use crate::wake::miss_distance::miss_distance_in_cores;
use crate::wake::{
    BladeState, CirculationSolution, HubMotion as WakeHub, Route, TimeMarchingWake, WakeError,
};

/// What an exchange saw.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// Rotor, air and motion of the hub at the exchange.
struct Place<'a> {
    rotor: &'a Rotor,
    air: Air,
    hub: &'a HubMotion<f64>,
}

impl Place<'_> {
    fn solved(
        &self,
        b: usize,
        blade: &BladeInstant,
        far: &[f64],
        near: &NearWake,
        start: &[f64],
    ) -> Result<CirculationSolution, WakeError> {
        let solution = self.rotor.blade_circulation(self.air, self.hub, blade, far, near, start)?;
        self.rotor.solved(solution, b, blade.psi)
    }
}

/// Time-marching wake and the circulation and inflow that belong to it.
#[derive(Clone, Debug)]
pub struct MarchingExchange {
    /// The wake.
    pub wake: TimeMarchingWake,
    /// Far inflow at the stations (n_blades, n_stations).
    pub lambda_far: Vec<f64>,
    before: Option<Vec<f64>>,
    far_held: Vec<f64>,
    /// Bound circulation (n_blades, n_stations) [m2/s].
    pub circulation: Vec<f64>,
    /// Total inflow held over the next step (n_blades, n_stations), with thin sections at both lines of the chord.
    pub inflow: Vec<f64>,
    /// Circulations that were not solved; the exchange that met one failed.
    pub unsolved: usize,
    blades: Vec<BladeInstant>,
    states: Vec<BladeState>,
    near_wakes: Vec<NearWake>,
}

impl MarchingExchange {
    /// From a wake with its far inflow, circulation and total inflow.
    pub fn new(
        wake: TimeMarchingWake,
        lambda_far: Vec<f64>,
        circulation: Vec<f64>,
        inflow: Vec<f64>,
    ) -> Self {
        Self {
            wake,
            far_held: lambda_far.clone(),
            lambda_far,
            before: None,
            circulation,
            inflow,
            unsolved: 0,
            blades: Vec::new(),
            states: Vec::new(),
            near_wakes: Vec::new(),
        }
    }

    /// The blades have reached the next step, the hub in motion `hub`.
    pub fn advance(
        &mut self,
        rotor: &Rotor,
        air: Air,
        hub: &HubMotion<f64>,
        blades: &[BladeInstant],
    ) -> Result<ExchangeReport, WakeError> {
        let wake_hub = WakeHub { velocity: hub.velocity.array(), rates: hub.omega.array() };
        self.place(rotor, blades, &wake_hub)?;
        let at = Place { rotor, air, hub };
        let mut followed = self.solve(&at, true)?;
        let step = self.wake.step(wake_hub, &self.states, &self.circulation)?;
        self.renew_far(self.wake.own().recorrect == 0);
        followed += self.solve(&at, false)?;
        for pass in 0..self.wake.own().recorrect {
            self.wake.set_circulation(&self.circulation)?;
            self.find_far(pass + 1 == self.wake.own().recorrect);
            followed += self.solve(&at, false)?;
        }
        if self.wake.own().extrapolate {
            self.hold_extrapolated(&at)?;
        }
        Ok(ExchangeReport {
            max_displacement: step.max_displacement,
            odd_even: step.odd_even,
            miss_distance: miss_distance_in_cores(self.wake.options(), self.wake.instant()),
            followed,
        })
    }

    /// Blades at their azimuths, and their near wakes.
    fn place(&mut self, rotor: &Rotor, blades: &[BladeInstant], hub: &WakeHub) -> Result<(), WakeError> {
        self.blades.clear();
        self.blades.extend_from_slice(blades);
        self.states.clear();
        self.near_wakes.clear();
        for blade in blades {
            let (flap, lead) = rotor.equivalent_angles(&blade.modal);
            let state = BladeState { psi: blade.psi, flap, lead };
            self.near_wakes.push(rotor.near_wake(self.wake.options(), hub, &state)?);
            self.states.push(state);
        }
        Ok(())
    }

    fn renew_far(&mut self, last: bool) {
        let before = self.before.get_or_insert_default();
        std::mem::swap(before, &mut self.lambda_far);
        self.find_far(last);
    }

    /// Far inflow of the wake as it is; with the `last` before the next step goes the velocity of its markers.
    fn find_far(&mut self, last: bool) {
        if last {
            self.wake.inflow_far_before_step(&mut self.lambda_far);
        } else {
            self.lambda_far = self.wake.inflow_far();
        }
    }

    /// Far inflow `steps` ahead, linear in azimuth from its last two values.
    fn far_ahead(&mut self, steps: f64) {
        self.far_held.copy_from_slice(&self.lambda_far);
        if let (true, Some(before)) = (self.wake.own().extrapolate, &self.before) {
            for (held, old) in self.far_held.iter_mut().zip(before) {
                *held += steps * (*held - old);
            }
        }
    }

    /// Circulation and total inflow of every blade; `ahead`: with the far inflow carried on to the present azimuth.
    fn solve(&mut self, at: &Place, ahead: bool) -> Result<usize, WakeError> {
        self.far_ahead(if ahead { 1.0 } else { 0.0 });
        let n = self.wake.options().n_stations;
        let mut outcomes: Vec<Result<bool, WakeError>> = vec![Ok(true); self.blades.len()];
        let given = self.blades.iter().zip(&self.near_wakes).zip(self.far_held.chunks(n)).enumerate();
        let width = at.rotor.inflow_width();
        let kept = self.circulation.chunks_mut(n).zip(self.inflow.chunks_mut(width)).zip(&mut outcomes);
        share(given.zip(kept), |((b, ((blade, near), far)), ((circulation, inflow), outcome))| {
            *outcome = at.solved(b, blade, far, near, circulation).map(|solution| {
                circulation.copy_from_slice(&solution.gamma);
                inflow.copy_from_slice(&solution.inflow);
                solution.found_by == Some(Route::Newton)
            });
        });
        self.unsolved += outcomes.iter().filter(|o| matches!(o, Err(WakeError::Circulation { .. }))).count();
        outcomes.into_iter().try_fold(0, |followed, outcome| Ok(followed + usize::from(!outcome?)))
    }

    /// Total inflow half a step ahead; circulation of the wake stays that of the present.
    fn hold_extrapolated(&mut self, at: &Place) -> Result<(), WakeError> {
        self.far_ahead(0.5);
        let (n, width) = (self.wake.options().n_stations, at.rotor.inflow_width());
        for (b, (blade, near)) in self.blades.iter().zip(&self.near_wakes).enumerate() {
            let span = b * n..(b + 1) * n;
            let solution =
                at.solved(b, blade, &self.far_held[span.clone()], near, &self.circulation[span])?;
            self.inflow[b * width..(b + 1) * width].copy_from_slice(&solution.inflow);
        }
        Ok(())
    }
}
