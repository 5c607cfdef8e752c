//! Air loads of one section by tables: angle of attack from the 3/4-chord point, pressure and directions from the 1/4-chord point.

use super::kinematics::{BladeAxes, SectionMotion};
use crate::airfoil::Airfoil;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use serde::Deserialize;

/// A blade station: middle of one spanwise element.
#[derive(Clone, Copy, Debug)]
pub struct StationGeometry {
    /// Chord [m].
    pub chord: f64,
    /// Width of the element for drag [m].
    pub width: f64,
    /// Width for lift and moment, cut by the tip loss [m].
    pub lift_width: f64,
    /// Quarter chord ahead of the elastic axis [m].
    pub quarter: f64,
    /// Three-quarter chord ahead of the elastic axis (negative) [m].
    pub three_quarter: f64,
}

/// Density [kg/m3] and speed of sound [m/s].
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Air {
    /// Density.
    pub density: f64,
    /// Speed of sound.
    pub speed_of_sound: f64,
}

/// What a section feels and does, per unit span.
#[derive(Clone, Copy, Debug)]
pub struct SectionAir<S> {
    /// Angle of attack [rad].
    pub alpha: S,
    /// Mach number normal to the span.
    pub mach: S,
    /// Speed normal to the span at the quarter chord [m/s].
    pub speed: S,
    /// Lift coefficient.
    pub cl: S,
    /// Drag coefficient.
    pub cd: S,
    /// Moment coefficient about the quarter chord, nose up positive, without pitch-rate damping.
    pub cm: S,
    /// Bound circulation, positive for upward lift [m2/s].
    pub circulation: S,
    /// Force of the element at the quarter chord [N].
    pub force: Vec3<S, BladeAxes>,
    /// Moment of the element about the elastic axis [N m].
    pub moment: Vec3<S, BladeAxes>,
}

impl<S: Real> SectionAir<S> {
    /// Turns the drag of the table along the whole `wind`, relative to the point of the elastic axis, instead of its part normal to
    /// the span: of a section in yawed flow the boundary layer goes with the air and meets the section at a smaller angle of attack,
    /// whose drag the table has; lift is that of the flow normal to the span.
    pub(super) fn turn_drag(
        &mut self,
        airfoil: &Airfoil,
        air: &Air,
        station: &StationGeometry,
        motion: &SectionMotion<S>,
        wind: Vec3<S, BladeAxes>,
    ) {
        let (c, n, t) = (motion.c, motion.n, motion.t);
        let (along, chordwise) = (wind.dot(t), wind.dot(c));
        let whole = (self.speed * self.speed + along * along).sqrt();
        // the small constant keeps the ratio finite where the air comes along the span alone
        let (of_chord, of_span) = (chordwise * chordwise + 1e-12, along * along);
        let (sin, cos) = self.alpha.sin_cos();
        let yawed = sin.atan2(cos * ((of_chord + of_span) / of_chord).sqrt());
        let (_, cd_yawed, _) = airfoil.coefficients(yawed, self.mach);
        let (_, cd, _) = airfoil.coefficients(self.alpha, self.mach);
        let normal = c * chordwise + n * wind.dot(n);
        let strength = cd_yawed * whole;
        let more = (normal * (strength - cd * self.speed) + t * (strength * along))
            * S::cst(0.5 * air.density * station.chord * station.width);
        self.force += more;
        self.moment += c.cross(more) * S::cst(station.quarter);
    }
}

/// Air loads of a section. `wind` is the velocity of the air relative to the point of the elastic axis,
/// `omega` the section's absolute angular velocity (both blade axes).
#[inline(always)]
pub fn section_air<S: Real>(
    airfoil: &Airfoil,
    air: &Air,
    station: &StationGeometry,
    motion: &SectionMotion<S>,
    wind: Vec3<S, BladeAxes>,
    omega: Vec3<S, BladeAxes>,
) -> SectionAir<S> {
    let (c, n) = (motion.c, motion.n);
    // the chord point at distance d ahead moves with omega x (d c): components along c and n
    let spin = omega.cross(c);
    let (wind_c, wind_n) = (wind.dot(c), wind.dot(n));
    let spin_n = spin.dot(n);
    let quarter_n = wind_n - spin_n * station.quarter;
    let three_quarter_n = wind_n - spin_n * station.three_quarter;

    let flow = section_flow(airfoil, air, wind_c, quarter_n, three_quarter_n);
    section_loads(air, station, motion, omega, [wind_c, quarter_n], &flow)
}

/// Loads of a section from its flow and the wind at the quarter chord along chord and normal.
#[inline(always)]
pub(super) fn section_loads<S: Real>(
    air: &Air,
    station: &StationGeometry,
    motion: &SectionMotion<S>,
    omega: Vec3<S, BladeAxes>,
    [wind_c, quarter_n]: [S; 2],
    flow: &SectionFlow<S>,
) -> SectionAir<S> {
    let &SectionFlow { alpha, speed, mach, cl, cd, cm } = flow;
    let (c, n, t) = (motion.c, motion.n, motion.t);
    let Strengths { lift, drag, about_quarter } =
        section_strengths(air, station, speed, omega.dot(t), [cl, cd, cm]);
    let force = c * (lift * quarter_n + drag * wind_c) + n * (drag * quarter_n - lift * wind_c);
    let moment = t * about_quarter + c.cross(force) * S::cst(station.quarter);

    let circulation = cl * speed * (0.5 * station.chord);
    SectionAir { alpha, mach, speed, cl, cd, cm, circulation, force, moment }
}

/// Lift and drag of an element over the speed [N s/m], its moment about the quarter chord [N m].
pub(super) struct Strengths<S> {
    pub(super) lift: S,
    pub(super) drag: S,
    pub(super) about_quarter: S,
}

/// Strengths of an element at `speed` [m/s] turning nose up at `pitch_rate` [rad/s]; coefficients (cl, cd, cm).
///
/// The moment has the quasi-steady pitch-rate damping of thin-airfoil theory.
#[inline(always)]
pub(super) fn section_strengths<S: Real>(
    air: &Air,
    station: &StationGeometry,
    speed: S,
    pitch_rate: S,
    [cl, cd, cm]: [S; 3],
) -> Strengths<S> {
    let half_rho_c = 0.5 * air.density * station.chord;
    let lift = cl * speed * (half_rho_c * station.lift_width);
    let drag = cd * speed * (half_rho_c * station.width);
    let pitch_damping = pitch_rate
        * speed
        * (-std::f64::consts::PI / 16.0 * air.density * station.chord.powi(3) * station.lift_width);
    let about_quarter =
        cm * speed * speed * (half_rho_c * station.chord * station.lift_width) + pitch_damping;
    Strengths { lift, drag, about_quarter }
}

/// Angle of attack, speed and coefficients of a section.
pub(super) struct SectionFlow<S> {
    pub(super) alpha: S,
    pub(super) speed: S,
    pub(super) mach: S,
    pub(super) cl: S,
    pub(super) cd: S,
    pub(super) cm: S,
}

/// Flow from the wind along the chord and normal to it at the quarter and the three-quarter chord [m/s].
#[inline(always)]
pub(super) fn section_flow<S: Real>(
    airfoil: &Airfoil,
    air: &Air,
    wind_c: S,
    quarter_n: S,
    three_quarter_n: S,
) -> SectionFlow<S> {
    let alpha = three_quarter_n.atan2(-wind_c);
    // the small constant keeps the derivative finite where a section stands still in the air
    let speed = (wind_c * wind_c + quarter_n * quarter_n + 1e-12).sqrt();
    let mach = speed / air.speed_of_sound;
    let (cl, cd, cm) = airfoil.coefficients(alpha, mach);
    SectionFlow { alpha, speed, mach, cl, cd, cm }
}
