//! What carries the rotors: an airframe in free flight, or a stand that stays.

use super::layout::{Layout, body_vector};
use crate::airframe::assembly::Airframe;
use crate::blade::hub_motion::HubMotion;
use crate::numerics::frames::{Body, Hub, Inertial, Vec3, rot_ib};
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;

/// A carrier of rotors.
#[derive(Clone, Debug)]
pub enum Carrier {
    /// An airframe in free flight: thirteen states.
    Airframe(Box<Airframe>),
    /// A stand: its motion is given, it has no states.
    Stand(Stand),
}

/// Steady motion of a stand through the air; gravity acts down the shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Velocity of the hub through the air, hub axes (x aft, y right, z up) [m/s].
    pub velocity: [f64; 3],
    /// Angular velocity, hub axes [rad/s].
    pub rates: [f64; 3],
}

impl Carrier {
    /// The airframe, where there is one.
    pub fn airframe(&self) -> Option<&Airframe> {
        match self {
            Self::Airframe(airframe) => Some(airframe),
            Self::Stand(_) => None,
        }
    }

    /// Velocity of a `wind` at the hub of `rotor` as its sense of rotation has it [m/s]; components in inertial axes of an airframe with
    /// the states y, in hub axes of a stand.
    #[inline(always)]
    pub fn wind_at_hub<S: Real>(&self, rotor: &Rotor, y: &[S], wind: [S; 3]) -> Vec3<S, Hub> {
        rotor.sense.polar(match self {
            Self::Airframe(_) => rotor.rot_hb::<S>() * wind_b(y, wind),
            Self::Stand(_) => Vec3::from_array(wind),
        })
    }

    /// A motion of the hub of `rotor` against air that moves with `wind` there.
    pub fn hub_in_wind(
        &self,
        hub: HubMotion<f64>,
        (rotor, y): (&Rotor, &[f64]),
        wind: [f64; 3],
    ) -> HubMotion<f64> {
        HubMotion { velocity: hub.velocity - self.wind_at_hub(rotor, y, wind), ..hub }
    }

    /// Motion of the hub of `rotor` in the states y, with gravity [m/s2] as an acceleration.
    #[inline(always)]
    pub fn hub_motion<S: Real>(&self, rotor: &Rotor, y: &[S], y_dot: &[S], gravity: f64) -> HubMotion<S> {
        match self {
            Self::Airframe(_) => rotor.hub_motion(
                body_vector(y, Layout::VELOCITY),
                body_vector(y, Layout::RATES),
                body_vector(y_dot, Layout::VELOCITY),
                body_vector(y_dot, Layout::RATES),
                gravity_b(y, gravity),
            ),
            Self::Stand(stand) => rotor.sense.hub_motion(HubMotion {
                velocity: Vec3::cst(stand.velocity),
                acceleration_less_gravity: Vec3::cst([0.0, 0.0, gravity]),
                omega: Vec3::cst(stand.rates),
                omega_dot: Vec3::zero(),
            }),
        }
    }
}

/// A wind of inertial components [m/s] in body axes of an airframe with the states y.
#[inline(always)]
pub fn wind_b<S: Real>(y: &[S], wind: [S; 3]) -> Vec3<S, Body> {
    rot_ib([y[6], y[7], y[8], y[9]]).transposed() * Vec3::<S, Inertial>::from_array(wind)
}

/// Gravity [m/s2] in body axes of an airframe with the states y.
#[inline(always)]
pub fn gravity_b<S: Real>(y: &[S], gravity: f64) -> Vec3<S, Body> {
    let q = [y[6], y[7], y[8], y[9]];
    rot_ib(q).transposed() * Vec3::<S, Inertial>::cst([0.0, 0.0, gravity])
}
