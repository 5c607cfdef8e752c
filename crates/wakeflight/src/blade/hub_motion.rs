//! Motion of the hub, and the rigid motion of the blade axes that it carries.

use super::kinematics::BladeAxes;
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::scalar::Real;

/// Motion of the hub, non-rotating hub axes.
#[derive(Clone, Copy, Debug)]
pub struct HubMotion<S> {
    /// Velocity of the hub centre [m/s].
    pub velocity: Vec3<S, Hub>,
    /// Acceleration of the hub centre less gravity [m/s2].
    pub acceleration_less_gravity: Vec3<S, Hub>,
    /// Angular velocity of the airframe [rad/s].
    pub omega: Vec3<S, Hub>,
    /// Angular acceleration of the airframe [rad/s2].
    pub omega_dot: Vec3<S, Hub>,
}

impl HubMotion<f64> {
    /// The same motion without derivatives.
    #[inline(always)]
    pub fn constant<S: Real>(&self) -> HubMotion<S> {
        HubMotion {
            velocity: Vec3::cst(self.velocity.array()),
            acceleration_less_gravity: Vec3::cst(self.acceleration_less_gravity.array()),
            omega: Vec3::cst(self.omega.array()),
            omega_dot: Vec3::cst(self.omega_dot.array()),
        }
    }
}

/// Rigid motion of the blade axes at one instant.
pub(crate) struct Carrier<S> {
    pub(super) velocity: Vec3<S, BladeAxes>,
    pub(super) acceleration: Vec3<S, BladeAxes>,
    pub(super) omega: Vec3<S, BladeAxes>,
    pub(super) omega_dot: Vec3<S, BladeAxes>,
    to_blade: [[S; 3]; 3],
    pub(super) up: Vec3<S, BladeAxes>,
}

impl<S: Real> Carrier<S> {
    /// Blade axes at azimuth `psi`, turned up by `precone`, on a hub in motion `hub`.
    #[inline(always)]
    pub(crate) fn new(hub: &HubMotion<S>, psi: S, precone: f64, rotor_speed: f64) -> Self {
        let (s, c) = psi.sin_cos();
        let (sp, cp) = precone.sin_cos();
        let zero = S::zero();
        let to_blade = [[c * cp, s * cp, S::cst(sp)], [-s, c, zero], [-(c * sp), -(s * sp), S::cst(cp)]];
        let spin: Vec3<S, Hub> = Vec3::cst([0.0, 0.0, rotor_speed]);
        Self {
            velocity: turned(&to_blade, hub.velocity),
            acceleration: turned(&to_blade, hub.acceleration_less_gravity),
            omega: turned(&to_blade, hub.omega + spin),
            omega_dot: turned(&to_blade, hub.omega_dot + hub.omega.cross(spin)),
            up: Vec3::cst([sp, 0.0, cp]),
            to_blade,
        }
    }
    #[inline(always)]
    pub(super) fn to_blade(&self, v: Vec3<S, Hub>) -> Vec3<S, BladeAxes> {
        turned(&self.to_blade, v)
    }
    #[inline(always)]
    pub(super) fn to_hub(&self, v: Vec3<S, BladeAxes>) -> Vec3<S, Hub> {
        let m = &self.to_blade;
        Vec3::new(
            m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z,
            m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
            m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z,
        )
    }
}

// functions instead of closures: a closure would not be compiled for the vectors that its caller runs in

/// Components in blade axes, by the rows of the rotation.
#[inline(always)]
fn turned<S: Real>(m: &[[S; 3]; 3], v: Vec3<S, Hub>) -> Vec3<S, BladeAxes> {
    Vec3::new(
        m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
        m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
        m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z,
    )
}
