//! Azimuth and speed of a rotor as states, turned by a drive or constant over the ground: their rows of F, the reaction on the carrier,
//! the start in balance.

use super::instant::{Acting, Instant};
use super::layout::{Layout, RotorLayout, RotorStates, SpeedStates};
use super::model::System;
use super::rotor_loads::RotorShare;
use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use crate::rotor::drive::{Drive, DriveError, DriveState, clutched};
use crate::rotor::hub::Rotor;
use crate::rotor::speed::RotorSpeed;

impl System {
    /// The same system, its first rotor turned by `drive`: azimuth and speed are states. What is geared to it (closed-form rotors,
    /// accessories) loads it.
    pub fn with_drive(self, drive: Drive) -> Result<Self, DriveError> {
        let first = match drive.governor {
            Some(_) => SpeedStates::Governed,
            None => SpeedStates::Free,
        };
        Ok(self.with_states(RotorSpeed::Free(drive.checked()?), first))
    }

    /// The same system, its first rotor constant in speed over the ground: azimuth and speed about the airframe are states.
    ///
    /// The spin about the shaft that the blades have in inertial space stays what it is where a flight begins: w' = -w_b', with w_b
    /// the rate of the hub's carrier about the shaft, in the sense of the rotor. It is the limit of a drive whose hub has an inertia
    /// without bound; the torque that it takes is the engines', and reacts on the airframe that carries them.
    pub fn over_ground(self) -> Self {
        self.with_states(RotorSpeed::OverGround, SpeedStates::OverGround)
    }

    fn with_states(mut self, turned: RotorSpeed, first: SpeedStates) -> Self {
        self.rotors[0].speed = turned;
        let states = self.layout.rotors.iter().enumerate().map(|(r, l)| RotorStates {
            name: l.name.clone(),
            n_blades: l.n_blades,
            n_modes: l.n_modes,
            dynamic_inflow: l.dynamic_inflow,
            speed: if r == 0 { first } else { l.speed },
        });
        self.layout = Layout::new(self.layout.free, states, self.layout.closed.clone());
        self
    }

    fn drive_state<S: Real, U: Acting<S>>(
        &self,
        r: usize,
        at: &Instant<S, U>,
    ) -> Option<(&Drive, DriveState<S>)> {
        let (rotor, l) = (&self.rotors[r], &self.layout.rotors[r]);
        let (drive, place) = rotor.drive().zip(l.spin())?;
        let [integral, power] = match l.engine() {
            Some(engine) => [at.y[engine.integral], at.y[engine.power]],
            None => [S::zero(), at.inputs.engine.torque.felt() * at.y[place.speed]],
        };
        let (excess, omega_dot) = (at.y[place.speed] - rotor.omega, at.y_dot[place.speed]);
        Some((drive, DriveState { excess, omega_dot, integral, power }))
    }

    /// Torque of the engines on rotor `r`, at its speed [N m], as its clutch passes it on; none where no engine turns it.
    pub fn engine_torque<S: Real, U: Acting<S>>(&self, r: usize, at: &Instant<S, U>) -> Option<S> {
        let (_, state) = self.drive_state(r, at)?;
        Some(clutched(state.power) / (state.excess + self.rotors[r].omega))
    }

    /// Torque [N m] that keeps the speed of a rotor over the ground under a `moment` about its shaft, with what is `geared` to it [W];
    /// below zero it brakes: there is no clutch. None where another law moves the rotor.
    pub(super) fn keeping_torque(
        &self,
        r: usize,
        at: &Instant<f64>,
        (moment, geared): (f64, f64),
    ) -> Option<f64> {
        match self.rotors[r].speed {
            RotorSpeed::OverGround => Some(geared / self.spin(r, at).turning.omega - moment),
            RotorSpeed::Constant | RotorSpeed::Prescribed(_) | RotorSpeed::Free(_) => None,
        }
    }

    /// Rows of azimuth, speed and engines of every rotor that has them; `drawn`: power of what is geared to the first [W].
    pub(super) fn drive_rows<S: Real, U: Acting<S>>(
        &self,
        at: &Instant<S, U>,
        shares: &[RotorShare<S>],
        drawn: S,
        f: &mut [S],
    ) {
        for ((r, _, l), share) in self.each_rotor().zip(shares) {
            let Some(place) = l.spin() else { continue };
            let omega = at.y[place.speed];
            f[place.azimuth] = at.y_dot[place.azimuth] - omega;
            let carrier_dot = self.hub_motion(r, at.y, at.y_dot).omega_dot.z;
            let Some((drive, state)) = self.drive_state(r, at) else {
                f[place.speed] = at.y_dot[place.speed] + carrier_dot;
                continue;
            };
            let geared = if r == 0 { drawn } else { S::zero() };
            let torque = (clutched(state.power) - geared) / omega + share.loads.moment.z;
            let carried = carrier_dot * drive.hub_inertia;
            f[place.speed] = at.y_dot[place.speed] - (torque - carried) / drive.inertia;
            if let (Some(governor), Some(engine)) = (&drive.governor, l.engine()) {
                let [integral, power] = governor.rates(&state, at.inputs.engine.fuel.felt());
                f[engine.integral] = at.y_dot[engine.integral] - integral;
                f[engine.power] = at.y_dot[engine.power] - power;
            }
        }
    }

    /// Moment on the airframe of hubs that change their speed [N m]; none where no speed is a state.
    ///
    /// What is geared to a rotor turns about axes of its own, at speeds of its own: its reaction on the airframe is left out.
    pub(super) fn hub_reaction<S: Real, U>(&self, at: &Instant<S, U>) -> Option<Vec3<S, Body>> {
        let reaction = |(_, rotor, l): (usize, &Rotor, &RotorLayout)| {
            let (drive, place) = rotor.drive().zip(l.spin())?;
            let about_shaft = Vec3::new(S::zero(), S::zero(), -(at.y_dot[place.speed] * drive.hub_inertia));
            Some(rotor.rot_hb::<S>().transposed() * rotor.sense.axial(about_shaft))
        };
        self.each_rotor().filter_map(reaction).reduce(|a, b| a + b)
    }
}

impl Rotor {
    /// Speed and power of the balance, where they are states, into `y`.
    pub(super) fn balanced<S: Real>(&self, l: &RotorLayout, y: &mut [S]) {
        if let Some(place) = l.spin() {
            y[place.speed] = S::cst(self.omega);
        }
        if let (Some(engine), Some(governor)) = (l.engine(), self.drive().and_then(|d| d.governor)) {
            y[engine.power] = S::cst(governor.power);
        }
    }
}
