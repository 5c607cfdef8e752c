//! Wind of a section without inflow: all that its circulation needs of the blade's motion.

use super::aerodynamics::{Air, StationGeometry, section_flow};
use super::kinematics::{BladeAxes, SectionMotion};
use super::sections_in_time::{SectionsInTime, flow_of};
use super::thin_section::ThinSection;
use crate::airfoil::Airfoil;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;

/// Wind of a section without inflow and what inflow takes off it: all that its circulation needs of the blade's motion.
#[derive(Clone, Copy, Debug)]
pub struct SectionWind {
    /// Along the chord [m/s].
    wind_c: f64,
    /// Normal to the chord at the quarter chord [m/s].
    quarter_n: f64,
    /// Normal to the chord at the three-quarter chord [m/s].
    three_quarter_n: f64,
    /// Components of the shaft's direction along c and n, times the tip speed [m/s].
    up: [f64; 2],
    /// Nose-up angular velocity, absolute [rad/s].
    pitch_rate: f64,
    /// The same in the blade's axes [rad/s].
    turn_rate: f64,
    chord: f64,
}

impl SectionWind {
    /// From the wind without inflow, the section's angular velocity and the direction of the shaft.
    pub fn new(
        station: &StationGeometry,
        motion: &SectionMotion<f64>,
        wind: Vec3<f64, BladeAxes>,
        omega: Vec3<f64, BladeAxes>,
        up: Vec3<f64, BladeAxes>,
        tip_speed: f64,
    ) -> Self {
        let wind_n = wind.dot(motion.n);
        let spin_n = omega.cross(motion.c).dot(motion.n);
        Self {
            wind_c: wind.dot(motion.c),
            quarter_n: wind_n - spin_n * station.quarter,
            three_quarter_n: wind_n - spin_n * station.three_quarter,
            up: [up.dot(motion.c) * tip_speed, up.dot(motion.n) * tip_speed],
            pitch_rate: omega.dot(motion.t),
            turn_rate: motion.omega.dot(motion.t),
            chord: station.chord,
        }
    }

    /// Wind at inflow `lambda`: along the chord, normal to it at the quarter and the three-quarter chord.
    fn winds<S: Real>(&self, lambda: S) -> [S; 3] {
        let (along, normal) = (lambda * -self.up[0], lambda * -self.up[1]);
        [along + self.wind_c, normal + self.quarter_n, normal + self.three_quarter_n]
    }

    /// Bound circulation [m2/s] at inflow `lambda`.
    pub fn circulation<S: Real>(&self, airfoil: &Airfoil, air: &Air, lambda: S) -> S {
        let [along, quarter_n, three_quarter_n] = self.winds(lambda);
        let flow = section_flow(airfoil, air, along, quarter_n, three_quarter_n);
        flow.cl * flow.speed * (0.5 * self.chord)
    }

    /// The same of a section that meets the air at three quarters of the chord, at the inflow there.
    pub fn thin_circulation<S: Real>(&self, law: ThinSection, airfoil: &Airfoil, air: &Air, lambda: S) -> S {
        let [along, _, three_quarter_n] = self.winds(lambda);
        law.circulation(airfoil, air, self.chord, [along, three_quarter_n])
    }

    /// The same of station `j` among `sections` that remember.
    pub fn circulation_in_time<S: Real>(
        &self,
        (j, airfoil): (usize, &Airfoil),
        air: &Air,
        sections: &SectionsInTime,
        lambda: S,
    ) -> S {
        let rates = [S::cst(self.pitch_rate), S::cst(self.turn_rate)];
        let flow = flow_of(self.winds(lambda), rates, air.speed_of_sound);
        sections.circulation(j, (airfoil, self.chord), &flow)
    }
}
