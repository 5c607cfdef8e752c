//! Stall with one state: the separation point follows that of the table, lift lies between attached and separated flow.

use super::lag::{Drive, Law, MAX_STATES, States};
use super::{Coefficients, DAMPING, Flow, Section};
use crate::numerics::scalar::Real;

/// Time constant of the separation point in semichords [branlard2017].
const SEPARATION_TIME: f64 = 6.0;

/// Separation point with one lag [oye1991].
#[derive(Clone, Copy, Debug, Default)]
pub struct Oye;

impl Law for Oye {
    const SOURCES: &'static [&'static str] = &["oye1991", "branlard2017"];
    const NAMES: &'static [&'static str] = &["separation"];
    const STAGE: &'static [usize] = &[0];

    fn drives<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        _states: &States<S>,
    ) -> [Drive<S>; MAX_STATES] {
        let mut drives = [Drive::none(); MAX_STATES];
        drives[0] = Drive {
            input: section.separation.at(flow.alpha, flow.mach()).point,
            rate: flow.semichords(section.chord) / SEPARATION_TIME,
        };
        drives
    }

    fn coefficients<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        states: &States<S>,
    ) -> Coefficients<S> {
        let (cl, cd, cm) = section.airfoil.coefficients(flow.alpha, flow.mach());
        let table = section.separation.at(flow.alpha, flow.mach());
        let cl = cl + (states[0] - table.point) * table.lift_lost * flow.engaged();
        Coefficients {
            cl,
            circulatory: cl,
            cd,
            cm: cm + flow.reduced_rate(section.chord) * DAMPING,
            alpha_effective: flow.alpha,
            separation: states[0],
        }
    }
}
