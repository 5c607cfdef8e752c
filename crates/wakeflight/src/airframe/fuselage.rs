//! Fuselage forces and moments from tables.

use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use crate::numerics::tables::Grid;
use serde::Deserialize;

/// Loads over dynamic pressure against angle of attack (rows) and sideslip (columns) [rad]; m2 and m3.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fuselage {
    /// Reference point from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Drag [m2].
    pub drag: Grid,
    /// Lift [m2].
    pub lift: Grid,
    /// Pitching moment [m3].
    pub pitching: Grid,
    /// Side force [m2].
    pub side: Grid,
    /// Rolling moment [m3].
    pub rolling: Grid,
    /// Yawing moment [m3].
    pub yawing: Grid,
}

/// Loads of the fuselage and the flow angles they were read at.
#[derive(Clone, Copy, Debug)]
pub struct FuselageLoads<S: Copy> {
    /// Force [N].
    pub force: Vec3<S, Body>,
    /// Moment about the reference point [N m].
    pub moment: Vec3<S, Body>,
    /// Angle of attack, rotor wash included [rad], within -pi/2..pi/2.
    pub alpha: S,
    /// Sideslip, rotor wash included [rad], within -pi/2..pi/2, positive with wind from the right.
    pub beta: S,
}

/// Speed that does not matter [m/s]: keeps angles and their derivatives finite where the air is at rest.
const SMALL_SPEED: f64 = 1e-3;

impl Fuselage {
    /// Loads for the velocity of the reference point relative to the air, rotor wash included [m/s].
    ///
    /// alpha = atan(w/|u|), beta = atan(v/sqrt(u^2 + w^2)), q = rho V^2/2; force = T (-q (D, Y, L)),
    /// moment = T (q (R, -M, N)), T = rows (ca cb, ca sb, -sa), (sb, -cb, 0), (sa cb, sa sb, ca) [howlett1981].
    /// DEVIATION: with u < 0 the drag opposes the velocity (the source's T, built with |u|, would push the aircraft along
    /// in rearward flight); the other loads are those of forward flight at the same angles. Continuous at u = 0.
    pub fn loads<S: Real>(&self, velocity: Vec3<S, Body>, density: f64) -> FuselageLoads<S> {
        let Vec3 { x: u, y: v, z: w, .. } = velocity;
        let small = SMALL_SPEED * SMALL_SPEED;
        let forward = (u * u + small).sqrt();
        let in_plane = (u * u + w * w + small).sqrt();
        let speed = (u * u + v * v + w * w + small).sqrt();
        let (ca, sa) = (forward / in_plane, w / in_plane);
        let (cb, sb) = (in_plane / speed, v / speed);
        let alpha = w.atan2(forward);
        let beta = v.atan2(in_plane);

        let q = speed.squared() * (0.5 * density);
        let drag = velocity * (speed * self.drag.at(alpha, beta) * (-0.5 * density));
        let side = Vec3::new(ca * sb, -cb, sa * sb);
        let lift = Vec3::new(-sa, S::zero(), ca);
        let force = drag - side * (q * self.side.at(alpha, beta)) - lift * (q * self.lift.at(alpha, beta));
        let stream = Vec3::new(ca * cb, sb, sa * cb);
        let moment = stream * (q * self.rolling.at(alpha, beta)) - side * (q * self.pitching.at(alpha, beta))
            + lift * (q * self.yawing.at(alpha, beta));
        FuselageLoads { force, moment, alpha, beta }
    }
}
