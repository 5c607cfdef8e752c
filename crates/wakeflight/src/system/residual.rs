//! F(y_dot, y, u; t): forces and moments on the carrier, blade modes, kinematics, inflow.

use super::carrier::{Carrier, gravity_b, wind_b};
use super::instant::{Acting, Instant};
use super::layout::{Layout, body_vector};
use super::model::System;
use super::rotor_loads::{RotorLoads, RotorShare, blade_rows};
use crate::airframe::assembly::{AirLoads, AirMotion, Airframe, RotorEffect};
use crate::airframe::tail_rotor::ClosedFormState;
use crate::numerics::frames::{Body, Vec3, rot_ib};
use crate::numerics::scalar::Real;
use crate::wake::AtParts;

/// All loads on the airframe except its own weight and inertia, body axes about the body origin.
#[derive(Clone, Debug)]
pub struct AirframeLoads<S> {
    /// Force [N].
    pub force: Vec3<S, Body>,
    /// Moment [N m].
    pub moment: Vec3<S, Body>,
    /// Power of the closed-form rotors [W].
    pub closed_power: S,
    /// Rates of the inflow states of the closed-form rotors [1/s].
    pub closed_inflow_rate: Vec<S>,
}

/// What acts on the airframe besides its motion: settings of the tail and the mean inflow of the first rotor.
#[derive(Clone, Debug)]
pub struct Settings<'a, S> {
    /// Mean inflow that the airframe feels.
    pub mean_inflow: S,
    /// Air of the wake at the parts of the airframe [m/s], body axes; none where washes act on the mean inflow.
    pub wash: Option<AtParts>,
    /// Stabilator incidence [rad].
    pub stabilator_incidence: S,
    /// Pitch of the closed-form rotors by the controls [rad].
    pub closed_pitch: S,
    /// Their inflow states.
    pub closed_inflow: &'a [S],
    /// Their speed over the nominal one: they are geared to the first rotor.
    pub closed_speed: S,
    /// Velocity of the air at the origin, body axes [m/s], and the rates at which it turns about it [rad/s]; none where it is still.
    pub wind: Option<[Vec3<S, Body>; 2]>,
}

impl<S: Real> AirframeLoads<S> {
    /// With a moment more, where there is one.
    fn turned_by(self, moment: Option<Vec3<S, Body>>) -> Self {
        match moment {
            Some(more) => Self { moment: self.moment + more, ..self },
            None => self,
        }
    }
}

impl System {
    /// Residual: accelerations [m/s2, rad/s2], rates of the kinematic and inflow states, modal forces.
    pub fn residual<S: Real, U: Acting<S>>(&self, at: &Instant<S, U>, f: &mut [S]) {
        let mut shares = Vec::with_capacity(self.rotors.len());
        for (r, rotor, l) in self.each_rotor() {
            let spin = self.spin(r, at);
            let hub = self.felt_hub(r, at.y, at.inputs, (self.hub_motion(r, at.y, at.y_dot), &spin.turning));
            let mut loads = RotorLoads::zero();
            for b in 0..rotor.n_blades {
                let blade = self.blade_loads(r, at, (&hub, &spin), b);
                blade_rows(l, b, &blade, at, f);
                loads.add(&blade);
            }
            shares.push(RotorShare { loads, beta_1c: self.flap_multiblade(r, spin.psi, at.y)[0] });
        }
        self.shared_rows(at, &shares, f);
    }

    /// The residual, four blades at once; the same bits.
    pub fn residual_of_four(&self, at: &Instant<f64>, f: &mut [f64]) {
        let mut shares = Vec::with_capacity(self.rotors.len());
        for (r, _, l) in self.each_rotor() {
            let spin = self.spin(r, at);
            let hub = self.felt_hub(r, at.y, at.inputs, (self.hub_motion(r, at.y, at.y_dot), &spin.turning));
            let loads = self.rotor_loads(r, at, (&hub, &spin), |b, blade| blade_rows(l, b, blade, at, f));
            shares.push(RotorShare { loads, beta_1c: self.flap_multiblade(r, spin.psi, at.y)[0] });
        }
        self.shared_rows(at, &shares, f);
    }

    /// Rotors, fuselage, tail surfaces and closed-form rotors on the body origin.
    pub fn airframe_loads<S: Real, U: Acting<S>>(
        &self,
        airframe: &Airframe,
        at: &Instant<S, U>,
        shares: &[RotorShare<S>],
    ) -> AirframeLoads<S> {
        if at.inputs.vacuum() {
            return self
                .loads_with(AirLoads::none(self.closed.len()), shares)
                .turned_by(self.hub_reaction(at));
        }
        let pitch = self.main().rigging.pitch(at.inputs.stick_at(at.t).map(Acting::felt));
        let settings = Settings {
            mean_inflow: self.mean_inflow(0, at.y, at.inputs),
            wash: at.inputs.wash,
            stabilator_incidence: at.inputs.stabilator_incidence.felt(),
            closed_pitch: pitch[3],
            closed_inflow: &at.y[self.layout.closed_inflow()],
            closed_speed: self.speed_ratio(0, at),
            wind: at.inputs.disturbance.as_ref().map(|d| {
                let turn = d.gust.as_ref().map_or([0.0; 3], |gust| gust.turn);
                [wind_b(at.y, d.wind.map(Acting::felt)), Vec3::cst(turn)]
            }),
        };
        self.loads_on_airframe(airframe, at.y, shares, &settings).turned_by(self.hub_reaction(at))
    }

    /// Rotor loads and air loads on the body origin, for the motion of the airframe in y.
    pub(super) fn loads_on_airframe<S: Real>(
        &self,
        airframe: &Airframe,
        y: &[S],
        shares: &[RotorShare<S>],
        settings: &Settings<S>,
    ) -> AirframeLoads<S> {
        let mut velocity = body_vector(y, Layout::VELOCITY);
        let mut rates = body_vector(y, Layout::RATES);
        if let Some([wind, turn]) = settings.wind {
            velocity = velocity - wind;
            rates = rates - turn;
        }
        let rotor = self.main();
        let effect = RotorEffect {
            mean_inflow: settings.mean_inflow,
            hub_velocity: rotor.rot_hb::<S>() * (velocity + rates.cross(Vec3::cst(rotor.position))),
            beta_1c: shares[0].beta_1c,
            tip_speed: rotor.tip_speed(),
            wake: settings.wash,
        };
        let motion = AirMotion { velocity, rates, density: self.air.density };
        let closed = self.closed.iter().zip(settings.closed_inflow);
        let (theta, speed_ratio) = (settings.closed_pitch, settings.closed_speed);
        let closed = closed.map(|(rotor, &inflow)| (rotor, ClosedFormState { theta, inflow, speed_ratio }));
        let air = airframe.air_loads(&motion, &effect, settings.stabilator_incidence, closed);
        self.loads_with(air, shares)
    }

    fn loads_with<S: Real>(&self, air: AirLoads<S>, shares: &[RotorShare<S>]) -> AirframeLoads<S> {
        let (mut force, mut moment) = shares[0].loads.on_body(self.main());
        for (rotor, share) in self.rotors.iter().zip(shares).skip(1) {
            let (more_force, more_moment) = share.loads.on_body(rotor);
            force += more_force;
            moment += more_moment;
        }
        AirframeLoads {
            force: force + air.force,
            moment: moment + air.moment,
            closed_power: air.closed_power,
            closed_inflow_rate: air.closed_inflow_rate,
        }
    }

    /// All equations but the blades', given what every rotor brings.
    pub(super) fn shared_rows<S: Real, U: Acting<S>>(
        &self,
        at: &Instant<S, U>,
        shares: &[RotorShare<S>],
        f: &mut [S],
    ) {
        let drawn = match &self.carrier {
            Carrier::Airframe(airframe) => {
                self.airframe_rows(airframe, at, shares, f) + airframe.accessory_power
            }
            Carrier::Stand(_) => S::zero(),
        };
        self.drive_rows(at, shares, drawn, f);
        for ((r, _, l), share) in self.each_rotor().zip(shares) {
            if l.dynamic_inflow {
                let i = l.inflow().start;
                let moved = (self.hub_motion(r, at.y, at.y_dot), &self.spin(r, at).turning);
                let hub = self.felt_hub(r, at.y, at.inputs, moved).velocity;
                let moved = (hub, self.hub_height(r, at.y));
                let rate = self.inflow_rate(r, moved, &share.loads, [at.y[i], at.y[i + 1], at.y[i + 2]]);
                for k in 0..3 {
                    f[i + k] = at.y_dot[i + k] - rate[k];
                }
            }
        }
    }

    /// Balances of the airframe, its attitude and track, the inflow of the closed-form rotors; returns the power of these [W].
    fn airframe_rows<S: Real, U: Acting<S>>(
        &self,
        airframe: &Airframe,
        at: &Instant<S, U>,
        shares: &[RotorShare<S>],
        f: &mut [S],
    ) -> S {
        let (y, y_dot) = (at.y, at.y_dot);
        let velocity = body_vector(y, Layout::VELOCITY);
        let rates = body_vector(y, Layout::RATES);
        let loads = self.airframe_loads(airframe, at, shares);

        let (inertia_force, inertia_moment) = airframe.mass.inertial_residual(
            velocity,
            rates,
            body_vector(y_dot, Layout::VELOCITY),
            body_vector(y_dot, Layout::RATES),
            gravity_b(y, self.gravity),
        );
        let force = (loads.force + inertia_force).array();
        let moment = (loads.moment + inertia_moment).array();
        for i in 0..3 {
            f[i] = force[i] / airframe.gross_mass;
            f[3 + i] = moment[i] / airframe.reference_inertia[i];
        }

        // attitude: q_dot = q (0, omega)/2
        let [p, q, r] = rates.array();
        let [e0, e1, e2, e3] = [y[6], y[7], y[8], y[9]];
        f[6] = y_dot[6] + (e1 * p + e2 * q + e3 * r) * 0.5;
        f[7] = y_dot[7] - (e0 * p + e2 * r - e3 * q) * 0.5;
        f[8] = y_dot[8] - (e0 * q + e3 * p - e1 * r) * 0.5;
        f[9] = y_dot[9] - (e0 * r + e1 * q - e2 * p) * 0.5;
        let track = rot_ib([e0, e1, e2, e3]) * velocity;
        for (i, rate) in track.array().into_iter().enumerate() {
            f[10 + i] = y_dot[10 + i] - rate;
        }
        for (i, rate) in self.layout.closed_inflow().zip(loads.closed_inflow_rate) {
            f[i] = y_dot[i] - rate;
        }
        loads.closed_power
    }
}
