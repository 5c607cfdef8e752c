//! Sense of rotation: a clockwise rotor is the mirror image of its counter-clockwise twin.
//!
//! The mirror is the plane y = 0 of the hub axes. Motion and air are reflected at the rotor's border, the twin is computed, its
//! loads are reflected back: nothing inside knows. Polar vectors turn their y, axial vectors their x and z; every sign turned
//! is exact, so that a mirrored flight has mirrored results to the last bit.

use crate::blade::hub_motion::HubMotion;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use serde::{Deserialize, Serialize};

/// Way a rotor turns, seen against its thrust (a main rotor from above).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
pub enum Sense {
    /// Counter-clockwise: the blade on the right advances.
    #[default]
    #[serde(rename = "ccw")]
    CounterClockwise,
    /// Clockwise: the blade on the left advances.
    #[serde(rename = "cw")]
    Clockwise,
}

impl Sense {
    /// 1 counter-clockwise, -1 clockwise.
    pub fn hand(self) -> f64 {
        match self {
            Self::CounterClockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }

    /// Velocity, acceleration or force as the twin has it, and back.
    #[inline(always)]
    pub fn polar<S: Real, F>(self, v: Vec3<S, F>) -> Vec3<S, F> {
        match self {
            Self::CounterClockwise => v,
            Self::Clockwise => Vec3::new(v.x, -v.y, v.z),
        }
    }

    /// Angular velocity or moment as the twin has it, and back.
    #[inline(always)]
    pub fn axial<S: Real, F>(self, v: Vec3<S, F>) -> Vec3<S, F> {
        match self {
            Self::CounterClockwise => v,
            Self::Clockwise => Vec3::new(-v.x, v.y, -v.z),
        }
    }

    /// Motion of the hub as the twin has it.
    #[inline(always)]
    pub fn hub_motion<S: Real>(self, hub: HubMotion<S>) -> HubMotion<S> {
        match self {
            Self::CounterClockwise => hub,
            Self::Clockwise => HubMotion {
                velocity: self.polar(hub.velocity),
                acceleration_less_gravity: self.polar(hub.acceleration_less_gravity),
                omega: self.axial(hub.omega),
                omega_dot: self.axial(hub.omega_dot),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::frames::Hub;

    #[test]
    fn a_mirrored_lever_has_a_mirrored_moment() {
        let arm = Vec3::<f64, Hub>::new(0.3, -1.2, 2.1);
        let force = Vec3::<f64, Hub>::new(-4.0, 0.7, 11.0);
        let mirror = Sense::Clockwise;
        let moment = mirror.polar(arm).cross(mirror.polar(force));
        assert_eq!(mirror.axial(arm.cross(force)).array(), moment.array());
        assert_eq!(mirror.polar(mirror.polar(arm)).array(), arm.array());
        assert_eq!(mirror.axial(mirror.axial(arm)).array(), arm.array());
    }
}
