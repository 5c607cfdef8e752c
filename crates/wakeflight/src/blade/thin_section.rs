//! Thin sections of a Weissinger blade: circulation by flow tangency at three quarters of the chord, drag and moment from
//! the tables at the angle that gives the same lift in two dimensions.

use super::aerodynamics::{Air, SectionAir, StationGeometry, section_loads};
use super::kinematics::{BladeAxes, SectionMotion};
use crate::airfoil::Airfoil;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// Mach number beyond which the Prandtl-Glauert factor is held.
const FACTOR_LIMIT: f64 = 0.9;

/// The law of a thin section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinSection {
    /// Angle of attack without lift [rad].
    pub zero_lift: f64,
    /// Whether the circulation is 1/sqrt(1 - M^2) times the incompressible one.
    pub prandtl_glauert: bool,
}

impl ThinSection {
    /// The law of an airfoil: its zero-lift angle at a low Mach number.
    pub fn of(airfoil: &Airfoil, prandtl_glauert: bool) -> Self {
        const LOW_MACH: f64 = 0.3;
        let lift = |alpha: f64| airfoil.coefficients::<f64>(alpha, LOW_MACH).0;
        let (mut low, mut high) = (-15f64.to_radians(), 15f64.to_radians());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if lift(middle) < 0.0 { low = middle } else { high = middle }
        }
        Self { zero_lift: 0.5 * (low + high), prandtl_glauert }
    }

    /// Air loads of a section: `wind` at the quarter chord, `wind_three_quarter` at three quarters (both relative to the
    /// point of the elastic axis, blade axes).
    ///
    /// Gamma = pi c V_n/sqrt(1 - M^2), V_n the speed normal to the zero-lift line at three quarters of the chord;
    /// c_l = 2 Gamma/(V c). The sign changes where the air comes from behind.
    #[allow(clippy::too_many_arguments, reason = "those of a section, and the second wind")]
    pub fn air<S: Real>(
        &self,
        airfoil: &Airfoil,
        air: &Air,
        station: &StationGeometry,
        motion: &SectionMotion<S>,
        wind: Vec3<S, BladeAxes>,
        wind_three_quarter: Vec3<S, BladeAxes>,
        omega: Vec3<S, BladeAxes>,
    ) -> SectionAir<S> {
        let (c, n) = (motion.c, motion.n);
        let spin_n = omega.cross(c).dot(n);
        let wind_c = wind.dot(c);
        let quarter_n = wind.dot(n) - spin_n * station.quarter;
        let three_quarter_n = wind_three_quarter.dot(n) - spin_n * station.three_quarter;
        let speed = (wind_c * wind_c + quarter_n * quarter_n + 1e-12).sqrt();
        let mach = speed / air.speed_of_sound;

        // tangency and the factor are those of the air at three quarters of the chord: circulation depends on it alone
        let (s0, c0) = self.zero_lift.sin_cos();
        let three_quarter_c = wind_three_quarter.dot(c);
        let normal = three_quarter_n * c0 + three_quarter_c * s0;
        let ahead = if three_quarter_c.re() <= 0.0 { 1.0 } else { -1.0 };
        let speed_there =
            (three_quarter_c * three_quarter_c + three_quarter_n * three_quarter_n + 1e-12).sqrt();
        let mach_there = speed_there / air.speed_of_sound;
        let factor = if self.prandtl_glauert && mach_there.re() < FACTOR_LIMIT {
            S::one() / (S::one() - mach_there * mach_there).sqrt()
        } else if self.prandtl_glauert {
            S::cst(1.0 / (1.0 - FACTOR_LIMIT * FACTOR_LIMIT).sqrt())
        } else {
            S::one()
        };
        let circulation = normal * factor * (PI * station.chord * ahead);
        let cl = circulation * 2.0 / (speed * station.chord);
        let alpha = cl / (factor * (2.0 * PI)) + self.zero_lift;
        let (_, cd, cm) = airfoil.coefficients(alpha, mach);
        section_loads(air, station, motion, wind_c, quarter_n, speed, omega, alpha, mach, [cl, cd, cm])
    }
}
