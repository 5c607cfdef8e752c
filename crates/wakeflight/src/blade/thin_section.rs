//! Sections that meet the air at three quarters of the chord, where the blade's own bound line is felt.
//!
//! Weissinger: thin sections, circulation by flow tangency, drag and moment from the tables at the angle that gives the
//! same lift in two dimensions. Second-order lifting line: lift, drag and moment from the tables at the angle there.

use super::aerodynamics::{Air, SectionAir, SectionFlow, StationGeometry, section_loads};
use super::kinematics::{BladeAxes, SectionMotion};
use crate::airfoil::Airfoil;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use serde::Deserialize;
use std::f64::consts::PI;

/// Mach number beyond which the Prandtl-Glauert factor is held.
const FACTOR_LIMIT: f64 = 0.9;

/// Where the lift of a section comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SectionLift {
    /// Flow tangency of a thin section.
    Tangency {
        /// Whether the circulation is 1/sqrt(1 - M^2) times the incompressible one.
        prandtl_glauert: bool,
    },
    /// The tables, at the angle of attack and the Mach number of three quarters of the chord [johnson1986].
    Tables,
}

/// The law of a section that meets the air at three quarters of the chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinSection {
    /// Where the lift comes from.
    pub lift: SectionLift,
}

impl ThinSection {
    /// Air loads of a section in two winds, at the quarter chord and at three quarters (both relative to the point of the
    /// elastic axis, blade axes).
    ///
    /// Tangency: Gamma = pi c V_n/sqrt(1 - M^2), V_n the speed normal to the zero-lift line at three quarters of the chord.
    /// Tables: Gamma = c V c_l/2 of the air there. c_l = 2 Gamma/(V c) of the speed V at the quarter chord, whose air gives
    /// lift and drag their directions. The sign changes where the air comes from behind.
    pub fn air<S: Real>(
        &self,
        airfoil: &Airfoil,
        air: &Air,
        station: &StationGeometry,
        motion: &SectionMotion<S>,
        [wind, wind_three_quarter]: [Vec3<S, BladeAxes>; 2],
        omega: Vec3<S, BladeAxes>,
    ) -> SectionAir<S> {
        let (c, n) = (motion.c, motion.n);
        let spin_n = omega.cross(c).dot(n);
        let wind_c = wind.dot(c);
        let quarter_n = wind.dot(n) - spin_n * station.quarter;
        let three_quarter_n = wind_three_quarter.dot(n) - spin_n * station.three_quarter;
        let speed = speed_of([wind_c, quarter_n]);
        let mach = speed / air.speed_of_sound;

        let three_quarter_c = wind_three_quarter.dot(c);
        let there = [three_quarter_c, three_quarter_n];
        let SectionLift::Tangency { prandtl_glauert } = self.lift else {
            let (alpha, speed_there, (cl, cd, cm)) = from_tables(airfoil, air, there);
            let cl = cl * speed_there / speed;
            let flow = SectionFlow { alpha, speed, mach, cl, cd, cm };
            return section_loads(air, station, motion, omega, [wind_c, quarter_n], &flow);
        };
        let (circulation, factor) = from_tangency(airfoil, air, station.chord, prandtl_glauert, there);
        let cl = circulation * 2.0 / (speed * station.chord);
        let alpha = cl / (factor * (2.0 * PI)) + airfoil.zero_lift();
        let (_, cd, cm) = airfoil.coefficients(alpha, mach);
        let flow = SectionFlow { alpha, speed, mach, cl, cd, cm };
        section_loads(air, station, motion, omega, [wind_c, quarter_n], &flow)
    }

    /// Bound circulation [m2/s] by the wind at three quarters of the chord alone: along the chord and normal to it [m/s].
    pub fn circulation<S: Real>(&self, airfoil: &Airfoil, air: &Air, chord: f64, there: [S; 2]) -> S {
        match self.lift {
            SectionLift::Tangency { prandtl_glauert } => {
                from_tangency(airfoil, air, chord, prandtl_glauert, there).0
            }
            SectionLift::Tables => {
                let (_, speed, (cl, ..)) = from_tables(airfoil, air, there);
                cl * speed * (0.5 * chord)
            }
        }
    }
}

/// Speed [m/s] of a wind along and normal to the chord; the small constant keeps its derivative finite in still air.
fn speed_of<S: Real>([along, normal]: [S; 2]) -> S {
    (along * along + normal * normal + 1e-12).sqrt()
}

/// Angle of attack [rad], speed [m/s] and the coefficients there (cl, cd, cm).
fn from_tables<S: Real>(airfoil: &Airfoil, air: &Air, [along, normal]: [S; 2]) -> (S, S, (S, S, S)) {
    let (alpha, speed) = (normal.atan2(-along), speed_of([along, normal]));
    (alpha, speed, airfoil.coefficients(alpha, speed / air.speed_of_sound))
}

/// Circulation [m2/s] by flow tangency, and the factor of compressibility in it.
fn from_tangency<S: Real>(
    airfoil: &Airfoil,
    air: &Air,
    chord: f64,
    prandtl_glauert: bool,
    [along, normal]: [S; 2],
) -> (S, S) {
    let (s0, c0) = airfoil.zero_lift().sin_cos();
    let mach = speed_of([along, normal]) / air.speed_of_sound;
    let ahead = if along.re() <= 0.0 { 1.0 } else { -1.0 };
    let factor = if prandtl_glauert && mach.re() < FACTOR_LIMIT {
        S::one() / (S::one() - mach * mach).sqrt()
    } else if prandtl_glauert {
        S::cst(1.0 / (1.0 - FACTOR_LIMIT * FACTOR_LIMIT).sqrt())
    } else {
        S::one()
    };
    let zero_lift_normal = normal * c0 + along * s0;
    (zero_lift_normal * factor * (PI * chord * ahead), factor)
}
