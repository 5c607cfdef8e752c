//! Stall with four states: shed wake, lagged pressure, lagged separation point; smooth, without a stall vortex.
//!
//! Lift lies between attached and separated flow by the separation point; at rest it is the table's, written as the table plus
//! what the difference of the separation points adds, so that it is so to the last bit.

use super::indicial::JONES;
use super::lag::{Drive, Law, MAX_STATES, States};
use super::{Coefficients, DAMPING, Flow, Section};
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// Time constant of the pressure in semichords, T_p [hansen2004].
const PRESSURE_TIME: f64 = 1.7;
/// Time constant of the separation point in semichords, T_f [hansen2004].
const SEPARATION_TIME: f64 = 3.0;
/// Keeps the derivative of the root finite where the flow is fully separated.
const ROOT_FLOOR: f64 = 1e-9;

/// Four states [hansen2004]: shed wake (2), angle of the lagged pressure, separation point.
///
/// DEVIATION: the third state is the angle alpha_F rather than the lift C_l,alpha (alpha_F - alpha_0); the same where the Mach
/// number stays. Drag turns with the angle that the shed wake takes off, not with that of the pitch rate. The table's moment gives
/// way by the table's lift at its arm, not by the lift of the instant: the moment is then that of the lift at its arm.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hgm;

impl Law for Hgm {
    const SOURCES: &'static [&'static str] = &["hansen2004", "jones1940"];
    const NAMES: &'static [&'static str] = &["shed_slow", "shed_fast", "pressure_angle", "separation"];
    const STAGE: &'static [usize] = &[0, 0, 1, 2];

    fn drives<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        states: &States<S>,
    ) -> [Drive<S>; MAX_STATES] {
        let mach = flow.mach();
        let [w1, w2] = JONES.drives(flow, section.chord);
        let slope = section.separation.slope(mach);
        let pressure = JONES.alpha(flow, states) + added_mass_lift(section, flow) / slope;
        let semichords = flow.semichords(section.chord);
        let mut drives = [Drive::none(); MAX_STATES];
        drives[..4].copy_from_slice(&[
            w1,
            w2,
            Drive { input: pressure, rate: semichords / PRESSURE_TIME },
            Drive { input: section.separation.at(states[2], mach).point, rate: semichords / SEPARATION_TIME },
        ]);
        drives
    }

    fn coefficients<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        states: &States<S>,
    ) -> Coefficients<S> {
        let mach = flow.mach();
        let share = flow.engaged();
        let alpha_effective = JONES.alpha(flow, states);
        let (cl, cd, cm) = section.airfoil.coefficients(alpha_effective, mach);
        let table = section.separation.at(alpha_effective, mach);
        let point = states[3];
        let circulatory = cl + (point - table.point) * table.lift_lost * share;
        let (_, cd_0, _) = section.airfoil.coefficients(section.separation.zero_lift(mach), mach);
        let root = |f: S| (f.clamped(0.0, 1.0) + ROOT_FLOOR).sqrt();
        let pressure_drag = (root(table.point) - root(point)) * 0.5 - (table.point - point) * 0.25;
        let arm = |point: S| section.separation.arm(alpha_effective, point, mach);
        let moved = circulatory * arm(point) - cl * arm(table.point);
        // half of it is the damping of the table's quasi-steady flow, half that of the air set in motion
        let damping = (flow.reduced_rate(section.chord) + flow.reduced_turn(section.chord) * share) * DAMPING;
        Coefficients {
            cl: circulatory + added_mass_lift(section, flow),
            circulatory,
            cd: cd + circulatory * (flow.alpha - alpha_effective) + (cd - cd_0) * pressure_drag * share,
            cm: cm + moved * share + damping,
            alpha_effective,
            separation: point,
        }
    }
}

/// Lift of the air set in motion by the pitch rate, pi T_u omega.
fn added_mass_lift<S: Real>(section: &Section, flow: &Flow<S>) -> S {
    flow.reduced_turn(section.chord) * flow.engaged() * (0.5 * PI)
}
