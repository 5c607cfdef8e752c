//! What azimuth and speed, where they are states, add to the derivatives: the lag dampers by the pitch they turn, the blades'
//! inertia by the rate of the speed, the engines by it.

use super::{BladeSlopes, Slopes};
use crate::blade::MAX_MODES;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};
use crate::rotor::speed::{Spin, Turning};
use crate::system::instant::Instant;
use crate::system::model::System;

impl System {
    /// Derivatives of the damper of blade `b` by azimuth and speed, through its pitch: on top of those without it.
    pub(super) fn damper_by_turn(
        &self,
        at: &Instant<f64>,
        b: usize,
        slopes: &mut BladeSlopes,
        place: &[usize],
    ) {
        let r = slopes.rotor;
        let Some(spin) = self.layout.rotors[r].spin() else { return };
        type D = Dual<2>;
        let turning =
            Turning { omega: D::variable(at.y[spin.speed], 1), omega_dot: D::cst(at.y_dot[spin.speed]) };
        let turned = Spin { psi: D::variable(at.y[spin.azimuth], 0), turning };
        let control: PitchMotion<D> = self.blade_pitch(r, at.inputs, (at.t, &turned), b);
        let modal = self.modal_motion(r, at.y, at.y_dot, b);
        let modal = ModalMotion {
            q: modal.q.map(D::cst),
            q_dot: modal.q_dot.map(D::cst),
            q_ddot: modal.q_ddot.map(D::cst),
        };
        let mut work = [D::zero(); MAX_MODES];
        self.rotors[r].add_damper(&modal, &control, &mut work);
        for (i, work) in work.iter().enumerate().take(slopes.n_modes()) {
            for (lane, state) in [spin.azimuth, spin.speed].into_iter().enumerate() {
                let column = place[state];
                let with = slopes.by_shared.at(i, column) + work.eps[lane];
                slopes.by_shared.set(i, column, with);
            }
        }
    }

    /// Derivatives by the rate of the speed: loads and modal rows of the blades, whose pitch it accelerates too, and the power.
    pub(super) fn masses_of_turn(&self, at: &Instant<f64>, slopes: &mut Slopes) {
        type D = Dual<1>;
        let mut offset = 0;
        for (r, rotor, l) in self.each_rotor() {
            let (n, blades) = (rotor.n_blades, offset);
            offset += n;
            let Some(place) = l.spin() else { continue };
            let column = slopes.place[place.speed];
            let turning = Turning { omega: D::cst(at.y[place.speed]), omega_dot: D::variable(0.0, 0) };
            let spin = Spin { psi: D::cst(at.y[place.azimuth]), turning };
            for first in (0..n).step_by(4) {
                // fewer than four left: the last stands in for those that are not there
                let blade = |k: usize| (first + k).min(n - 1);
                let pitches: [PitchMotion<D>; 4] =
                    std::array::from_fn(|k| self.blade_pitch(r, at.inputs, (at.t, &spin), blade(k)));
                let poses = std::array::from_fn(|k| {
                    let p = &pitches[k];
                    let control = PitchMotion {
                        theta: p.theta.re,
                        theta_dot: p.theta_dot.re,
                        theta_ddot: p.theta_ddot.re,
                    };
                    let modal = self.modal_motion(r, at.y, at.y, blade(k));
                    (rotor.azimuth(spin.psi.re, blade(k)), modal, control)
                });
                let masses = rotor.four_turn_masses(&poses, pitches.map(|p| p.theta_ddot.eps[0]));
                for (b, mass) in (first..n).zip(&masses) {
                    let blade = &mut slopes.blades[blades + b];
                    for i in 0..blade.n_modes() {
                        blade.by_shared_dot.set(i, column, -mass.own[i]);
                    }
                    // the air feels no acceleration
                    let on_hub = [mass.force, mass.moment].map(Vec3::array);
                    for (k, load) in on_hub.as_flattened().iter().enumerate() {
                        blade.loads_by_shared_dot.set(k, column, -load);
                    }
                }
            }
            if let (Some(engine), Some(governor)) = (l.engine(), rotor.drive().and_then(|d| d.governor)) {
                // changes where engines fail
                let slope = -governor.power_by_rate(at.inputs.engine.fuel);
                slopes.alone_dot.set(slopes.place[engine.power], column, slope);
            }
        }
    }
}
