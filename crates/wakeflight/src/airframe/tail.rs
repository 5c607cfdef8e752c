//! Stabilator and fin.

use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use crate::numerics::tables::Table;
use serde::Deserialize;

/// A lifting surface with its own tables of local angle [rad].
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Reference point from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Area [m2].
    pub area: f64,
    /// Incidence [rad], nose up (stabilator) or built in (fin); where a schedule exists it replaces this.
    pub incidence: f64,
    /// Lift coefficient.
    pub cl: Table,
    /// Drag coefficient.
    pub cd: Table,
}

/// Incidence of a scheduled stabilator; degrees, knots equivalent airspeed, collective per cent.
///
/// incidence = base - clip(V - v1[0], 0, v1[1]) (coll_const + coll_slope (clip(b[0] - c, 0, b[1]) + clip(b[2] - c, 0, b[3])))
///             + v2[2] clip(V - v2[0], 0, v2[1]) + q_gain q + ay term
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilatorSchedule {
    /// Incidence at low speed [deg].
    pub base_deg: f64,
    /// Start and width of the first speed range [kt].
    pub v1_kt: [f64; 2],
    /// Constant slope [deg/kt].
    pub coll_const: f64,
    /// Slope per per cent of collective.
    pub coll_slope: f64,
    /// Breaks in collective [per cent].
    pub coll_breaks_pct: [f64; 4],
    /// Start [kt], width [kt], slope [deg/kt] of the high speed range.
    pub v2: [f64; 3],
    /// Pitch rate gain [deg per deg/s].
    pub q_gain: f64,
    /// Limits of incidence [rad].
    pub limits: [f64; 2],
    /// Servo rate limit [rad/s].
    pub rate_limit: f64,
    /// Stick travel that is 100 per cent of collective [m].
    pub collective_travel: f64,
}

/// Square of a speed that does not matter [m2/s2].
const SMALL_SQUARE: f64 = 1e-12;

impl Surface {
    /// Force of a horizontal surface at `incidence` [rad, trailing edge down +] for its local velocity through the air.
    ///
    /// Lift and drag in the local u-w plane: alpha = atan2(w, u) + incidence, q = rho (u^2 + w^2)/2; tables held beyond
    /// their ends (reversed flow sees the coefficients of flow along the normal).
    pub fn stabilator_force<S: Real>(
        &self,
        velocity: Vec3<S, Body>,
        incidence: S,
        density: f64,
    ) -> Vec3<S, Body> {
        let (u, w) = (velocity.x, velocity.z);
        let alpha = w.atan2(u) + incidence;
        let (cl, cd) = (self.cl.at(alpha), self.cd.at(alpha));
        // one factor of speed is in the direction: no division where the air is at rest
        let pressure = (u * u + w * w + SMALL_SQUARE).sqrt() * (0.5 * density * self.area);
        Vec3::new(pressure * (cl * w - cd * u), S::zero(), -pressure * (cl * u + cd * w))
    }

    /// Force of a vertical surface for its local velocity through the air.
    ///
    /// Along body y -q S cl(beta), drag against the velocity in the u-v plane; beta = atan2(v, u) + built-in incidence,
    /// q = rho (u^2 + v^2)/2.
    pub fn fin_force<S: Real>(&self, velocity: Vec3<S, Body>, density: f64) -> Vec3<S, Body> {
        let (u, v) = (velocity.x, velocity.y);
        let beta = v.atan2(u) + self.incidence;
        let (cl, cd) = (self.cl.at(beta), self.cd.at(beta));
        let speed = (u * u + v * v + SMALL_SQUARE).sqrt();
        let pressure = speed * (0.5 * density * self.area);
        Vec3::new(-pressure * cd * u, -pressure * (cl * speed + cd * v), S::zero())
    }
}

impl StabilatorSchedule {
    /// Commanded incidence [rad] within its limits; equivalent airspeed [kt], collective [per cent], pitch rate [rad/s].
    ///
    /// The lateral-acceleration term of the source is left out.
    pub fn incidence<S: Real>(&self, v_eas_kt: S, collective_pct: S, q: S) -> S {
        let b = self.coll_breaks_pct;
        let below = |start: f64, width: f64| (-collective_pct + start).clamped(0.0, width);
        let slope = (below(b[0], b[1]) + below(b[2], b[3])) * self.coll_slope + self.coll_const;
        let low_speed = (v_eas_kt - self.v1_kt[0]).clamped(0.0, self.v1_kt[1]);
        let high_speed = (v_eas_kt - self.v2[0]).clamped(0.0, self.v2[1]);
        let rate = q * self.q_gain.to_degrees();
        let degrees = -(low_speed * slope) + self.base_deg + high_speed * self.v2[2] + rate;
        (degrees * 1f64.to_radians()).clamped(self.limits[0], self.limits[1])
    }
}
