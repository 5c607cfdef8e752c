//! Ground under an airframe.

use super::layout::Layout;
use super::model::System;
use crate::numerics::frames::{Body, Inertial, Vec3, rot_ib};
use crate::numerics::scalar::Real;
use crate::wake::Plane;

impl System {
    /// The same above flat ground, with the hub of the first rotor, the airframe level, at `height` [m] where the flight begins.
    pub fn above_ground(mut self, height: f64) -> Self {
        self.ground = Some(height + self.main().position[2]);
        self
    }

    /// Height of the hub of rotor `r` above ground [m] in the states `y`; none where there is none, or for a stand.
    #[inline(always)]
    pub fn hub_height<S: Real>(&self, r: usize, y: &[S]) -> Option<S> {
        let ground = self.ground.filter(|_| self.layout.free)?;
        let hub = rot_ib([y[6], y[7], y[8], y[9]]) * Vec3::cst(self.rotors[r].position);
        Some(-(y[Layout::POSITION.end - 1] + hub.z) + ground)
    }

    /// Ground under the first rotor as its wake has it, in the states `y`.
    pub fn ground_plane(&self, y: &[f64]) -> Option<Plane> {
        let height = self.hub_height(0, y)?;
        let rotor = self.main();
        let up: Vec3<f64, Inertial> = Vec3::new(0.0, 0.0, -1.0);
        let normal = rotor.rot_hb::<f64>() * (rot_ib([y[6], y[7], y[8], y[9]]).transposed() * up);
        Some(Plane::new(rotor.sense.polar(normal).array(), height))
    }

    /// Least height above ground [m] of the places of the airframe: its origin, tail rotor, tail surfaces.
    pub fn least_height(&self, y: &[f64]) -> Option<f64> {
        let ground = self.ground?;
        let airframe = self.carrier.airframe()?;
        let turn = rot_ib([y[6], y[7], y[8], y[9]]);
        let down = y[Layout::POSITION.end - 1];
        let places = airframe.places().chain(self.closed.iter().map(|rotor| rotor.position));
        Some(
            places
                .map(|place| ground - down - (turn * airframe.hand.polar(Vec3::<f64, Body>::cst(place))).z)
                .fold(f64::INFINITY, f64::min),
        )
    }
}
