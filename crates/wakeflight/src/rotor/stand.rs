//! An isolated rotor on a stand that moves steadily through the air.

use super::hub::Rotor;
use super::swashplate::{PitchHarmonic, PitchSeries};
use crate::blade::aerodynamics::Air;
use crate::blade::kinematics::PitchMotion;
use crate::blade::loads::HubMotion;
use crate::inflow::pitt_peters::PittPeters;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;

/// Rotor, air, weight and motion of a stand.
#[derive(Clone, Debug)]
pub struct Stand {
    /// The rotor; its rigging is not used: pitch is that of the blade at its own azimuth.
    pub rotor: Rotor,
    /// Air.
    pub air: Air,
    /// Gravity, down the shaft [m/s2].
    pub gravity: f64,
    /// Dynamic inflow model.
    pub pitt_peters: PittPeters,
    /// Higher-harmonic pitch.
    pub higher: Vec<PitchHarmonic>,
    /// Velocity of the hub through the air, hub axes (x aft, y right, z up) [m/s].
    pub velocity: [f64; 3],
    /// Angular velocity of the stand, hub axes [rad/s].
    pub rates: [f64; 3],
}

impl Stand {
    /// Motion of the hub at a velocity [m/s] and rates [rad/s], hub axes; weight included as an acceleration.
    pub fn hub(&self, velocity: [f64; 3], rates: [f64; 3]) -> HubMotion<f64> {
        HubMotion {
            velocity: Vec3::from_array(velocity),
            acceleration_less_gravity: Vec3::from_array([0.0, 0.0, self.gravity]),
            omega: Vec3::from_array(rates),
            omega_dot: Vec3::zero(),
        }
    }

    /// Pitch of the blade at azimuth `psi` for controls theta_0, theta_1c, theta_1s.
    pub fn pitch<S: Real>(&self, controls: [S; 3], psi: f64) -> PitchMotion<S> {
        let [theta_0, theta_1c, theta_1s] = controls;
        PitchSeries { theta_0, theta_1c, theta_1s, higher: &self.higher }.at(psi, self.rotor.omega).into()
    }
}
