//! Trim of the aircraft: its sticks, attitude and path are unknowns, the balances of its airframe are equations.

use super::model::{Aircraft, HeldInflow, Inputs};
use super::residual::RotorLoads;
use super::state::{Layout, body_vector};
use crate::blade::aerodynamics::Air;
use crate::blade::kinematics::PitchMotion;
use crate::inflow::pitt_peters::PittPeters;
use crate::numerics::frames::{Vec3, quaternion, rot_ib};
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use crate::rotor::swashplate::PitchSeries;
use crate::trim::host::{Balances, Carried, Head, Host, RotorMean};
use crate::trim::residual::Trim;

impl Host for Aircraft {
    fn controls(&self) -> &'static [(&'static str, &'static str)] {
        &[("lateral", "m"), ("longitudinal", "m"), ("collective", "m"), ("pedal", "m")]
    }

    fn flies(&self) -> bool {
        true
    }

    fn has_tail_rotor(&self) -> bool {
        self.layout.tail_rotor
    }

    fn rotor(&self) -> &Rotor {
        &self.rotor
    }

    fn air(&self) -> Air {
        self.air
    }

    fn pitt_peters(&self) -> &PittPeters {
        &self.pitt_peters
    }

    fn gravity(&self) -> f64 {
        self.gravity
    }

    fn pitch<S: Real>(&self, controls: [S; 4]) -> [S; 4] {
        self.rotor.rigging.pitch(controls)
    }

    fn blade_pitch<S: Real>(&self, pitch: &[S; 4], psi: f64) -> PitchMotion<S> {
        let series = PitchSeries { theta_0: pitch[2], theta_1c: pitch[0], theta_1s: pitch[1], higher: &[] };
        series.at(psi + self.rotor.rigging.phase, self.rotor.omega).into()
    }

    fn carried<S: Real>(&self, head: &Head<S>) -> Carried<S> {
        let attitude = quaternion(head.roll, head.pitch, head.yaw);
        let (climb, forward) = head.path.flight_path.sin_cos();
        let speed = head.path.speed;
        let velocity =
            rot_ib(attitude).transposed() * Vec3::new(speed * forward, S::zero(), -(speed * climb));
        let (sp, cp) = head.pitch.sin_cos();
        let (sr, cr) = head.roll.sin_cos();
        let turn = head.path.turn_rate;
        let mut y = vec![S::zero(); self.layout.len()];
        y[Layout::VELOCITY].copy_from_slice(&velocity.array());
        y[Layout::RATES].copy_from_slice(&[-(turn * sp), turn * cp * sr, turn * cp * cr]);
        y[Layout::ATTITUDE].copy_from_slice(&attitude);
        let places = self.layout.inflow().chain(self.layout.tail_inflow());
        let n = self.layout.inflow().len();
        for (place, value) in places.zip(head.inflow.into_iter().take(n).chain([head.tail_inflow])) {
            y[place] = value;
        }
        let at_rest = vec![S::zero(); y.len()];
        let hub = self.hub_motion(&y, &at_rest);
        Carried { y, hub }
    }

    fn balances<S: Real>(
        &self,
        head: &Head<S>,
        carried: &Carried<S>,
        rotor: &RotorMean<S>,
    ) -> Option<Balances<S>> {
        let y = &carried.y;
        let share = RotorLoads::sum(std::slice::from_ref(rotor.loads));
        let loads = self.loads_on_airframe(
            y,
            &share,
            rotor.inflow,
            rotor.beta_1c,
            self.trim_stabilator(head, y[4]),
            self.rotor.rigging.pitch(head.controls)[3],
            head.tail_inflow,
        );
        let velocity = body_vector(y, Layout::VELOCITY);
        let rates = body_vector(y, Layout::RATES);
        let (inertia_force, inertia_moment) = self.airframe.mass.inertial_residual(
            velocity,
            rates,
            Vec3::zero(),
            Vec3::zero(),
            self.gravity_b(y),
        );
        let force = (loads.force + inertia_force).array();
        let moment = (loads.moment + inertia_moment).array();
        Some(Balances {
            force: std::array::from_fn(|i| force[i] / self.airframe.gross_mass),
            moment: std::array::from_fn(|i| moment[i] / self.airframe.reference_inertia[i]),
            velocity,
            other_power: loads.tail_rotor_power + self.airframe.accessory_power,
            tail_inflow_rate: loads.tail_inflow_rate,
        })
    }
}

impl Aircraft {
    /// Stabilator incidence in trim: on its schedule where it has one [rad].
    fn trim_stabilator<S: Real>(&self, head: &Head<S>, pitch_rate: S) -> S {
        self.airframe.trim_incidence(head.path.speed, self.air.density, head.controls[2], pitch_rate)
    }
}

impl Trim<'_, Aircraft> {
    /// State and its rate at time `t` of the trimmed revolution; body accelerations and attitude rates are left at zero.
    pub fn state(&self, x: &[f64], t: f64) -> (Vec<f64>, Vec<f64>) {
        let aircraft = self.host();
        let mut y = aircraft.carried(&self.layout.head(x)).y;
        let mut y_dot = vec![0.0; y.len()];
        for b in 0..aircraft.rotor.n_blades {
            let m = self.motion(x, aircraft.rotor.azimuth(aircraft.rotor.omega * t, b));
            for (k, (q, s)) in aircraft.layout.modal(b).zip(aircraft.layout.modal_rate(b)).enumerate() {
                (y[q], y[s]) = (m.q[k], m.q_dot[k]);
                (y_dot[q], y_dot[s]) = (m.q_dot[k], m.q_ddot[k]);
            }
        }
        (y, y_dot)
    }

    /// Inputs that hold the trim: sticks, stabilator, and the inflow given.
    pub fn inputs(&self, x: &[f64], inflow: HeldInflow) -> Inputs {
        let head = self.layout.head(x);
        let y = self.host().carried(&head).y;
        Inputs {
            stick: head.controls,
            stick_rate: [0.0; 4],
            t_start: 0.0,
            inflow,
            stabilator_incidence: self.host().trim_stabilator(&head, y[4]),
        }
    }
}
