//! What azimuth and speed, where they are states, add to the derivatives: the lag dampers by the pitch they turn, the blades'
//! inertia by the rate of the speed, the engines by it.

use super::{BladeSlopes, N_LOADS, Slopes};
use crate::blade::MAX_MODES;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::surroundings::BladeInflow;
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
        let mut first = 0;
        for (r, rotor, l) in self.each_rotor() {
            let blades = first..first + rotor.n_blades;
            first = blades.end;
            let Some(place) = l.spin() else { continue };
            let column = slopes.place[place.speed];
            let y: Vec<D> = at.y[self.layout.carrier()].iter().map(|&v| D::cst(v)).collect();
            let still = vec![D::zero(); y.len()];
            let turning = Turning { omega: D::cst(at.y[place.speed]), omega_dot: D::variable(0.0, 0) };
            let spin = Spin { psi: D::cst(at.y[place.azimuth]), turning };
            let hub = turning.carried_by(self.hub_motion(r, &y, &still), rotor.omega);
            for (b, blade) in slopes.blades[blades].iter_mut().enumerate() {
                let control: PitchMotion<D> = self.blade_pitch(r, at.inputs, (at.t, &spin), b);
                let modal = self.modal_motion(r, at.y, at.y, b);
                let modal = ModalMotion {
                    q: modal.q.map(D::cst),
                    q_dot: modal.q_dot.map(D::cst),
                    q_ddot: [D::zero(); MAX_MODES],
                };
                let psi = rotor.azimuth(spin.psi, b);
                // the air feels no acceleration
                let loads = rotor.undamped_loads(self.air, &hub, psi, &modal, &control, &BladeInflow::Vacuum);
                for i in 0..blade.n_modes() {
                    blade.by_shared_dot.set(i, column, loads.modal[i].eps[0]);
                }
                let on_hub = [loads.force, loads.moment].map(Vec3::array);
                for (k, load) in on_hub.as_flattened().iter().enumerate().take(N_LOADS) {
                    blade.loads_by_shared_dot.set(k, column, load.eps[0]);
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
