//! Attached unsteady flow: the shed wake and the impulsive loads of compressible flow, on the section's own table.
//!
//! DEVIATION: the source's C_N = C_N,alpha alpha_E is the table at alpha_E, so that a flow at rest has the table's coefficients.

use super::indicial::BEDDOES;
use super::lag::{Drive, Law, MAX_STATES, States};
use super::{Coefficients, DAMPING, Flow, Section, impulsive};
use crate::numerics::scalar::Real;

/// Attached flow in eight states [leishman1989].
#[derive(Clone, Copy, Debug, Default)]
pub struct Attached;

impl Law for Attached {
    const SOURCES: &'static [&'static str] = &["leishman1989", "lomax1952"];
    const NAMES: &'static [&'static str] = &[
        "shed_slow",
        "shed_fast",
        "impulse_upwash",
        "impulse_moment_slow",
        "impulse_moment_fast",
        "impulse_pitch",
        "impulse_moment_pitch",
        "shed_moment_pitch",
    ];
    const STAGE: &'static [usize] = &[0; 8];

    fn drives<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        _states: &States<S>,
    ) -> [Drive<S>; MAX_STATES] {
        let [w1, w2] = BEDDOES.drives(flow, section.chord);
        let [i1, i2, i3, i4, i5, i6] = impulsive::drives(flow, section.chord, &BEDDOES);
        [w1, w2, i1, i2, i3, i4, i5, i6]
    }

    fn coefficients<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        states: &States<S>,
    ) -> Coefficients<S> {
        let alpha_effective = BEDDOES.alpha(flow, states);
        let (circulatory, cd, cm) = section.airfoil.coefficients(alpha_effective, flow.mach());
        let impulse = impulsive::loads(flow, section.chord, &states[2..]);
        let share = flow.engaged();
        let (sin, cos) = flow.alpha.sin_cos();
        let cn = impulse.cn * share;
        let plain = flow.reduced_rate(section.chord) * DAMPING;
        Coefficients {
            cl: circulatory + cn * cos,
            circulatory,
            // lift is normal to the air that the shed wake turns
            cd: cd + circulatory * (flow.alpha - alpha_effective) + cn * sin,
            cm: cm + impulse.cm * share + plain * (S::one() - share),
            alpha_effective,
            separation: section.separation.at(alpha_effective, flow.mach()).point,
        }
    }
}
