//! The blades' part of F: motion of a hub, pitch and inflow of every blade, loads of a rotor on its hub.

use super::instant::{Acting, HeldInflow, Inputs, Instant};
use super::layout::{RotorLayout, modal_array};
use super::model::System;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::sections_in_time::SectionsInTime;
use crate::blade::surroundings::BladeInflow;
use crate::inflow::pitt_peters::DiskCondition;
use crate::numerics::frames::{Body, Hub, Vec3};
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use crate::rotor::speed::{RotorSpeed, Spin, Turning};

/// Loads of a rotor on its hub, about the hub centre, in the axes its sense of rotation has ([`Sense`](crate::rotor::sense::Sense));
/// `aero_*` the share of the air.
#[derive(Clone, Copy, Debug)]
pub struct RotorLoads<S> {
    /// Force [N].
    pub force: Vec3<S, Hub>,
    /// Moment [N m].
    pub moment: Vec3<S, Hub>,
    /// Share of the air in the force.
    pub aero_force: Vec3<S, Hub>,
    /// Share of the air in the moment.
    pub aero_moment: Vec3<S, Hub>,
}

impl<S: Real> RotorLoads<S> {
    /// No loads.
    pub fn zero() -> Self {
        let none = Vec3::zero();
        Self { force: none, moment: none, aero_force: none, aero_moment: none }
    }

    /// Force [N] and moment about the body origin [N m] of these loads on the hub of `rotor`.
    #[inline(always)]
    pub fn on_body(&self, rotor: &Rotor) -> (Vec3<S, Body>, Vec3<S, Body>) {
        let to_body = rotor.rot_hb::<S>().transposed();
        let force = to_body * rotor.sense.polar(self.force);
        (force, to_body * rotor.sense.axial(self.moment) + Vec3::cst(rotor.position).cross(force))
    }

    /// One blade more.
    pub fn add(&mut self, b: &BladeLoads<S>) {
        self.force += b.force;
        self.moment += b.moment;
        self.aero_force += b.aero_force;
        self.aero_moment += b.aero_moment;
    }
}

/// What a rotor brings to the carrier: its loads, and the flapping that turns its wash.
#[derive(Clone, Copy, Debug)]
pub struct RotorShare<S> {
    /// Loads on the hub.
    pub loads: RotorLoads<S>,
    /// Cosine of the first flap mode over the blades [rad].
    pub beta_1c: S,
}

impl System {
    /// Where rotor `r` is in its turn: read here and nowhere else, of the state where azimuth and speed are states, else of the time.
    #[inline(always)]
    pub fn spin<S: Real, U: Acting<S>>(&self, r: usize, at: &Instant<S, U>) -> Spin<S> {
        match self.layout.rotors[r].spin() {
            Some(place) => Spin {
                psi: at.y[place.azimuth],
                turning: Turning { omega: at.y[place.speed], omega_dot: at.y_dot[place.speed] },
            },
            None => {
                let Turning { omega, omega_dot } = self.turning(r, at.t, at.inputs);
                Spin {
                    psi: S::cst(self.rotors[r].turned(at.t)),
                    turning: Turning { omega: omega.felt(), omega_dot: omega_dot.felt() },
                }
            }
        }
    }

    /// Azimuth [rad] of blade `b` of rotor `r` in the states `y` at time `t`.
    #[inline(always)]
    pub fn azimuth(&self, r: usize, t: f64, y: &[f64], b: usize) -> f64 {
        let rotor = &self.rotors[r];
        rotor.azimuth(
            self.layout.rotors[r].spin().map_or_else(|| rotor.turned(t), |place| y[place.azimuth]),
            b,
        )
    }

    /// Speed of rotor `r` and its rate at time `t`, where they are given.
    #[inline(always)]
    pub fn turning<U: Real>(&self, r: usize, t: f64, inputs: &Inputs<U>) -> Turning<U> {
        let own = self.rotors[r].turning(t, inputs.t_start);
        let (omega, omega_dot) = (U::cst(own.omega), U::cst(own.omega_dot));
        match &inputs.disturbance {
            None => Turning { omega, omega_dot },
            Some(d) => Turning { omega: omega + d.speed[r][0], omega_dot: omega_dot + d.speed[r][1] },
        }
    }

    /// Speed of rotor `r` over its nominal one.
    #[inline(always)]
    pub(super) fn speed_ratio<S: Real, U: Acting<S>>(&self, r: usize, at: &Instant<S, U>) -> S {
        let rotor = &self.rotors[r];
        if matches!(rotor.speed, RotorSpeed::Constant) && at.inputs.disturbance.is_none() {
            return S::cst(1.0);
        }
        self.spin(r, at).turning.omega / rotor.omega
    }

    /// Hub of rotor `r` as its blades feel it, for its motion `hub` with the carrier in still air in the states `y` and for how it
    /// turns.
    #[inline(always)]
    pub fn felt_hub<S: Real, U: Acting<S>>(
        &self,
        r: usize,
        y: &[S],
        inputs: &Inputs<U>,
        (mut hub, turning): (HubMotion<S>, &Turning<S>),
    ) -> HubMotion<S> {
        let rotor = &self.rotors[r];
        if let Some(disturbance) = &inputs.disturbance {
            let mut wind: [S; 3] = disturbance.wind.map(Acting::felt);
            if let (0, Some(gust)) = (r, &disturbance.gust) {
                wind = std::array::from_fn(|i| wind[i] + gust.at_hub[i]);
            }
            let wind = self.carrier.wind_at_hub(rotor, y, wind);
            hub.velocity = hub.velocity - wind;
        } else if matches!(rotor.speed, RotorSpeed::Constant) {
            return hub;
        }
        turning.carried_by(hub, rotor.omega)
    }

    /// Motion of the hub of rotor `r` with its carrier in still air, as its sense of rotation has it.
    #[inline(always)]
    pub fn hub_motion<S: Real>(&self, r: usize, y: &[S], y_dot: &[S]) -> HubMotion<S> {
        self.carrier.hub_motion(&self.rotors[r], y, y_dot, self.gravity)
    }

    /// Pitch of blade `b` of rotor `r` at time `t`, with exact rates.
    #[inline(always)]
    pub fn blade_pitch<S: Real, U: Acting<S>>(
        &self,
        r: usize,
        inputs: &Inputs<U>,
        (t, spin): (f64, &Spin<S>),
        b: usize,
    ) -> PitchMotion<S> {
        let rotor = &self.rotors[r];
        if rotor.speed.is_state() {
            let (stick, rate) = (inputs.stick_at(t).map(Acting::felt), inputs.stick_rate.map(Acting::felt));
            return rotor.blade_pitch(stick, rate, rotor.azimuth(spin.psi, b), spin.turning).into();
        }
        // without the derivatives of the equations: a given speed has none
        let turning = self.turning(r, t, inputs);
        let psi = U::cst(rotor.azimuth(rotor.turned(t), b));
        let p = rotor.blade_pitch(inputs.stick_at(t), inputs.stick_rate, psi, turning);
        PitchMotion { theta: p.theta.felt(), theta_dot: p.theta_dot.felt(), theta_ddot: p.theta_ddot.felt() }
    }

    /// Modal motion of blade `b` of rotor `r`.
    #[inline(always)]
    pub fn modal_motion<S: Real>(&self, r: usize, y: &[S], y_dot: &[S], b: usize) -> ModalMotion<S> {
        let l = &self.layout.rotors[r];
        ModalMotion {
            q: modal_array(y, l.modal(b)),
            q_dot: modal_array(y, l.modal_rate(b)),
            q_ddot: modal_array(y_dot, l.modal_rate(b)),
        }
    }

    /// What is known at time `t` of the states of the sections of blade `b` of rotor `r`, where they remember.
    #[inline(always)]
    pub fn sections_in_time<'a, U>(
        &'a self,
        r: usize,
        t: f64,
        inputs: &'a Inputs<U>,
        b: usize,
    ) -> Option<SectionsInTime<'a>> {
        let held = inputs.sections.get(r)?;
        self.rotors[r].sections_in_time(held.memory.step(b, t - held.begun))
    }

    /// Inflow that blade `b` of rotor `r` feels at time `t`, with what its sections remember.
    #[inline(always)]
    pub fn blade_inflow<'a, S: Real, U: Acting<S>>(
        &'a self,
        r: usize,
        (t, y): (f64, &[S]),
        inputs: &'a Inputs<U>,
        b: usize,
    ) -> BladeInflow<'a, S> {
        let inflow = match &inputs.inflow[r] {
            HeldInflow::Dynamic => {
                let i = self.layout.rotors[r].inflow().start;
                self.disk_inflow(r, [y[i], y[i + 1], y[i + 2]], inputs, b)
            }
            HeldInflow::Stations { inflow, carried, .. } => {
                let width = inflow.len() / self.rotors[r].n_blades;
                let row = b * width..(b + 1) * width;
                let carried = carried.as_ref().map(|on| (&on.change[row.clone()], (t - on.begun) / on.lasts));
                U::held(&self.rotors[r], &inflow[row], carried)
            }
            HeldInflow::Vacuum => BladeInflow::Vacuum,
        };
        inflow.remembering(self.sections_in_time(r, t, inputs, b))
    }

    /// Inflow of blade `b` of rotor `r` by its states, and by a gust.
    #[inline(always)]
    pub(super) fn disk_inflow<'a, S: Real, U: Acting<S>>(
        &self,
        r: usize,
        states: [S; 3],
        inputs: &'a Inputs<U>,
        b: usize,
    ) -> BladeInflow<'a, S> {
        match inputs.gust_row(r, b, self.rotors[r].blade.stations.len()) {
            Some(row) => BladeInflow::DiskAnd(states, row),
            None => BladeInflow::Disk(states),
        }
    }

    /// Loads of blade `b` of rotor `r`.
    #[inline(always)]
    pub fn blade_loads<S: Real, U: Acting<S>>(
        &self,
        r: usize,
        at: &Instant<S, U>,
        (hub, spin): (&HubMotion<S>, &Spin<S>),
        b: usize,
    ) -> BladeLoads<S> {
        let psi = self.rotors[r].azimuth(spin.psi, b);
        let control = self.blade_pitch(r, at.inputs, (at.t, spin), b);
        let modal = self.modal_motion(r, at.y, at.y_dot, b);
        self.rotors[r].blade_loads(
            self.air,
            hub,
            psi,
            &modal,
            &control,
            &self.blade_inflow(r, (at.t, at.y), at.inputs, b),
        )
    }

    /// Loads of all blades of rotor `r`, four at once; `each` sees every blade's.
    pub fn rotor_loads(
        &self,
        r: usize,
        at: &Instant<f64>,
        (hub, spin): (&HubMotion<f64>, &Spin),
        mut each: impl FnMut(usize, &BladeLoads<f64>),
    ) -> RotorLoads<f64> {
        let mut total = RotorLoads::zero();
        let n = self.rotors[r].n_blades;
        for first in (0..n).step_by(4) {
            // fewer than four left: the last stands in for those that are not there
            let blade = |k: usize| (first + k).min(n - 1);
            let poses = std::array::from_fn(|k| {
                (
                    self.rotors[r].azimuth(spin.psi, blade(k)),
                    self.modal_motion(r, at.y, at.y_dot, blade(k)),
                    self.blade_pitch(r, at.inputs, (at.t, spin), blade(k)),
                )
            });
            let inflow = std::array::from_fn(|k| self.blade_inflow(r, (at.t, at.y), at.inputs, blade(k)));
            let loads = self.rotors[r].four_blade_loads(self.air, hub, &poses, &inflow);
            for (b, blade) in (first..n).zip(&loads) {
                each(b, blade);
                total.add(blade);
            }
        }
        total
    }

    /// Cosine and sine of the first flap mode over the blades of rotor `r`, the first at azimuth `psi`, as angles [rad].
    pub fn flap_multiblade<S: Real>(&self, r: usize, psi: S, y: &[S]) -> [S; 2] {
        let (rotor, l) = (&self.rotors[r], &self.layout.rotors[r]);
        let n = rotor.n_blades;
        let (mut cosine, mut sine) = (S::zero(), S::zero());
        // a blade that nothing moves does not flap
        for b in 0..if l.n_modes > 0 { n } else { 0 } {
            let flap = y[l.modal(b).start + rotor.blade.flap_mode] * rotor.flap_per_coordinate();
            let (s, c) = rotor.azimuth(psi, b).sin_cos();
            cosine += flap * (c * 2.0 / n as f64);
            sine += flap * (s * 2.0 / n as f64);
        }
        [cosine, sine]
    }

    /// Mean inflow of rotor `r` that the airframe feels: the state, or the disk mean of the wake.
    pub(super) fn mean_inflow<S: Real, U: Acting<S>>(&self, r: usize, y: &[S], inputs: &Inputs<U>) -> S {
        match &inputs.inflow[r] {
            HeldInflow::Dynamic => y[self.layout.rotors[r].inflow().start],
            HeldInflow::Stations { mean, .. } => mean.felt(),
            HeldInflow::Vacuum => S::zero(),
        }
    }

    /// Rate of the dynamic inflow states lambda_0, lambda_s, lambda_c [1/s] of rotor `r` with its hub at `velocity`, and at `height` above ground
    /// [m].
    ///
    /// All at the nominal speed: times (omega R)^2 the model says M R v_dot + V L^-1 v = T/(rho pi R^2), which knows no speed.
    pub(super) fn inflow_rate<S: Real>(
        &self,
        r: usize,
        (velocity, height): (Vec3<S, Hub>, Option<S>),
        loads: &RotorLoads<S>,
        inflow: [S; 3],
    ) -> [S; 3] {
        let rotor = &self.rotors[r];
        let mu = velocity.scaled(1.0 / rotor.tip_speed());
        let [ct, cl, cm] = rotor.aero_coefficients(self.air, loads.aero_force, loads.aero_moment);
        // the model counts forward and downward speed positive; hub axes point aft and up
        let height = height.map(|z| z / rotor.blade.radius);
        let disk = DiskCondition { ct, cl, cm, mu_x: -mu.x, mu_y: mu.y, mu_z: -mu.z, height };
        self.pitt_peters.inflow_dot(inflow, disk, rotor.omega)
    }
}

/// Rows of the blades of a rotor in F: kinematics of the modal coordinates, and the modal equations.
pub(super) fn blade_rows<S: Real, U>(
    l: &RotorLayout,
    b: usize,
    blade: &BladeLoads<S>,
    at: &Instant<S, U>,
    f: &mut [S],
) {
    let (q, s) = (l.modal(b).start, l.modal_rate(b).start);
    for i in 0..l.n_modes {
        f[q + i] = at.y_dot[q + i] - at.y[s + i];
        f[s + i] = blade.modal[i];
    }
}
