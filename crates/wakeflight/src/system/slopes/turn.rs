//! What azimuth and speed, where they are states, add to the derivatives: the lag dampers by the pitch they turn, the blades'
//! inertia by the rate of the speed, the engines by it.

use super::{BladeSlopes, Slopes};
use crate::blade::MAX_MODES;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::mass_matrix::TurnMass;
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

    /// Acceleration of the pitch of four `blades` of rotor `r` by the rate of its speed, where that is a state.
    pub(super) fn pitched_by_turn(
        &self,
        r: usize,
        at: &Instant<f64>,
        blades: [usize; 4],
    ) -> Option<[f64; 4]> {
        type D = Dual<1>;
        let place = self.layout.rotors[r].spin()?;
        let turning = Turning { omega: D::cst(at.y[place.speed]), omega_dot: D::variable(0.0, 0) };
        let spin = Spin { psi: D::cst(at.y[place.azimuth]), turning };
        let pitch = |b: usize| -> PitchMotion<D> { self.blade_pitch(r, at.inputs, (at.t, &spin), b) };
        Some(blades.map(|b| pitch(b).theta_ddot.eps[0]))
    }

    /// The power of the engines by the rate of the speed: changes where they fail.
    pub(super) fn engines_by_turn(&self, at: &Instant<f64>, slopes: &mut Slopes) {
        for (_, rotor, l) in self.each_rotor() {
            let governor = rotor.drive().and_then(|drive| drive.governor);
            if let (Some(place), Some(engine), Some(governor)) = (l.spin(), l.engine(), governor) {
                let slope = -governor.power_by_rate(at.inputs.engine.fuel);
                slopes.alone_dot.set(slopes.place[engine.power], slopes.place[place.speed], slope);
            }
        }
    }
}

impl BladeSlopes {
    /// Keeps what the rate of the speed does to the blade, in the `column` of the speed: the air feels no acceleration.
    pub(super) fn keep_turn(&mut self, column: usize, mass: &TurnMass<f64>) {
        for i in 0..self.n_modes() {
            self.by_shared_dot.set(i, column, -mass.own[i]);
        }
        let on_hub = [mass.force, mass.moment].map(Vec3::array);
        for (k, load) in on_hub.as_flattened().iter().enumerate() {
            self.loads_by_shared_dot.set(k, column, -load);
        }
    }
}
