//! The stabilator in flight: its schedule, followed within the rate of its servo.

use super::assembly::Airframe;

/// What the schedule of a stabilator sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheduled {
    /// Velocity of the body through the air [m/s].
    pub velocity: [f64; 3],
    /// Pitch rate [rad/s].
    pub pitch_rate: f64,
    /// Collective stick [m].
    pub collective: f64,
    /// Density [kg/m3].
    pub density: f64,
}

impl Airframe {
    /// Incidence [rad] after `delta_t` [s] on the way from `incidence` toward the schedule; without one it stays.
    pub fn followed_incidence(&self, incidence: f64, seen: &Scheduled, delta_t: f64) -> f64 {
        let Some(schedule) = &self.stabilator_schedule else {
            return incidence;
        };
        let speed = seen.velocity.iter().fold(0.0, |sum, v| f64::mul_add(*v, *v, sum)).sqrt();
        let wanted = self.trim_incidence(speed, seen.density, seen.collective, seen.pitch_rate);
        let most = (schedule.rate_limit * delta_t).abs();
        incidence + (wanted - incidence).clamp(-most, most)
    }
}
