//! F(y_dot, y, u; t): forces and moments on the whole aircraft, blade modes, kinematics, inflow.

use super::model::{Aircraft, HeldInflow, Inputs};
use super::state::{Layout, body_vector, modal_array};
use crate::airframe::assembly::{RotorEffect, TailControls};
use crate::blade::kinematics::ModalMotion;
use crate::blade::loads::{BladeInflow, BladeLoads, HubMotion};
use crate::inflow::pitt_peters::DiskCondition;
use crate::numerics::frames::{Body, Hub, Inertial, Vec3, rot_ib};
use crate::numerics::scalar::Real;

/// Loads of the rotor on the airframe, hub axes about the hub centre; `aero_*` the share of the air.
#[derive(Clone, Copy, Debug)]
pub struct RotorLoads<S> {
    /// Force [N].
    pub force: Vec3<S, Hub>,
    /// Moment [N m].
    pub moment: Vec3<S, Hub>,
    /// Share of the air in the force.
    pub aero_force: Vec3<S, Hub>,
    /// Share of the air in the moment.
    pub aero_moment: Vec3<S, Hub>,
}

impl<S: Real> RotorLoads<S> {
    /// Sum over blades.
    pub fn sum(blades: &[BladeLoads<S>]) -> Self {
        let mut total = Self {
            force: Vec3::zero(),
            moment: Vec3::zero(),
            aero_force: Vec3::zero(),
            aero_moment: Vec3::zero(),
        };
        for b in blades {
            total.add(b);
        }
        total
    }

    /// One blade more.
    pub fn add(&mut self, b: &BladeLoads<S>) {
        self.force += b.force;
        self.moment += b.moment;
        self.aero_force += b.aero_force;
        self.aero_moment += b.aero_moment;
    }
}

/// All loads on the airframe except its own weight and inertia, body axes about the body origin.
#[derive(Clone, Copy, Debug)]
pub struct AirframeLoads<S> {
    /// Force [N].
    pub force: Vec3<S, Body>,
    /// Moment [N m].
    pub moment: Vec3<S, Body>,
    /// Tail-rotor power [W].
    pub tail_rotor_power: S,
    /// Rate of the tail-rotor inflow state [1/s].
    pub tail_inflow_rate: S,
}

impl Aircraft {
    /// Residual at time `t`: accelerations [m/s2, rad/s2], rates of the kinematic and inflow states, modal forces.
    pub fn residual<S: Real>(&self, t: f64, y: &[S], y_dot: &[S], inputs: &Inputs, f: &mut [S]) {
        let l = &self.layout;
        let hub = self.hub_motion(y, y_dot);
        let mut rotor = RotorLoads::sum(&[]);
        for b in 0..self.rotor.n_blades {
            let blade = self.blade_loads(t, y, y_dot, inputs, &hub, b);
            let (q, s) = (l.modal(b).start, l.modal_rate(b).start);
            for i in 0..l.n_modes {
                f[q + i] = y_dot[q + i] - y[s + i];
                f[s + i] = blade.modal[i];
            }
            rotor.add(&blade);
        }
        let beta_1c = self.flap_multiblade(t, y)[0];
        self.body_rows(t, y, y_dot, inputs, &rotor, beta_1c, f);
    }

    /// The residual, four blades at once; the same bits.
    pub fn residual_of_four(&self, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs, f: &mut [f64]) {
        let l = &self.layout;
        let hub = self.hub_motion(y, y_dot);
        let rotor = self.rotor_loads(t, y, y_dot, inputs, &hub, |b, blade| {
            let (q, s) = (l.modal(b).start, l.modal_rate(b).start);
            for i in 0..l.n_modes {
                f[q + i] = y_dot[q + i] - y[s + i];
                f[s + i] = blade.modal[i];
            }
        });
        let beta_1c = self.flap_multiblade(t, y)[0];
        self.body_rows(t, y, y_dot, inputs, &rotor, beta_1c, f);
    }

    /// Loads of all blades, four at once; `each` sees every blade's.
    pub fn rotor_loads(
        &self,
        t: f64,
        y: &[f64],
        y_dot: &[f64],
        inputs: &Inputs,
        hub: &HubMotion<f64>,
        mut each: impl FnMut(usize, &BladeLoads<f64>),
    ) -> RotorLoads<f64> {
        let mut rotor = RotorLoads::sum(&[]);
        let n = self.rotor.n_blades;
        for first in (0..n).step_by(4) {
            // fewer than four left: the last stands in for those that are not there
            let blade = |k: usize| (first + k).min(n - 1);
            let poses = std::array::from_fn(|k| {
                let psi = self.rotor.azimuth(self.rotor.omega * t, blade(k));
                (psi, self.modal_motion(y, y_dot, blade(k)), self.blade_pitch::<f64>(inputs, t, psi))
            });
            let inflow = std::array::from_fn(|k| self.blade_inflow(y, inputs, blade(k)));
            let loads = self.rotor.four_blade_loads(self.air, hub, &poses, &inflow);
            for (b, blade) in (first..n).zip(&loads) {
                each(b, blade);
                rotor.add(blade);
            }
        }
        rotor
    }

    /// Gravity in body axes [m/s2].
    #[inline(always)]
    pub fn gravity_b<S: Real>(&self, y: &[S]) -> Vec3<S, Body> {
        let q = [y[6], y[7], y[8], y[9]];
        rot_ib(q).transposed() * Vec3::<S, Inertial>::cst([0.0, 0.0, self.gravity])
    }

    /// Motion of the hub.
    #[inline(always)]
    pub fn hub_motion<S: Real>(&self, y: &[S], y_dot: &[S]) -> HubMotion<S> {
        self.rotor.hub_motion(
            body_vector(y, Layout::VELOCITY),
            body_vector(y, Layout::RATES),
            body_vector(y_dot, Layout::VELOCITY),
            body_vector(y_dot, Layout::RATES),
            self.gravity_b(y),
        )
    }

    /// Modal motion of blade `b`.
    #[inline(always)]
    pub fn modal_motion<S: Real>(&self, y: &[S], y_dot: &[S], b: usize) -> ModalMotion<S> {
        let l = &self.layout;
        ModalMotion {
            q: modal_array(y, l.modal(b)),
            q_dot: modal_array(y, l.modal_rate(b)),
            q_ddot: modal_array(y_dot, l.modal_rate(b)),
        }
    }

    /// Loads of blade `b`.
    #[inline(always)]
    pub fn blade_loads<S: Real>(
        &self,
        t: f64,
        y: &[S],
        y_dot: &[S],
        inputs: &Inputs,
        hub: &HubMotion<S>,
        b: usize,
    ) -> BladeLoads<S> {
        let psi = self.rotor.azimuth(self.rotor.omega * t, b);
        let control = self.blade_pitch(inputs, t, psi);
        let modal = self.modal_motion(y, y_dot, b);
        self.rotor.blade_loads(self.air, hub, psi, &modal, &control, &self.blade_inflow(y, inputs, b))
    }

    /// Inflow that blade `b` feels.
    #[inline(always)]
    pub fn blade_inflow<'a, S: Real>(&self, y: &[S], inputs: &'a Inputs, b: usize) -> BladeInflow<'a, S> {
        match &inputs.inflow {
            HeldInflow::Dynamic => {
                let i = self.layout.inflow().start;
                BladeInflow::Disk([y[i], y[i + 1], y[i + 2]])
            }
            HeldInflow::Stations { inflow, .. } => {
                let n = self.rotor.blade.stations.len();
                BladeInflow::Stations(&inflow[b * n..(b + 1) * n])
            }
            HeldInflow::Vacuum => BladeInflow::Vacuum,
        }
    }

    /// Cosine coefficient of the first flap mode over the blades, as an angle [rad].
    pub fn flap_multiblade<S: Real>(&self, t: f64, y: &[S]) -> [S; 2] {
        let n = self.rotor.n_blades;
        let (mut cosine, mut sine) = (S::zero(), S::zero());
        for b in 0..n {
            let flap =
                y[self.layout.modal(b).start + self.rotor.blade.flap_mode] * self.rotor.flap_per_coordinate();
            let (s, c) = self.rotor.azimuth(self.rotor.omega * t, b).sin_cos();
            cosine += flap * (2.0 * c / n as f64);
            sine += flap * (2.0 * s / n as f64);
        }
        [cosine, sine]
    }

    /// Mean inflow that the airframe feels: the state, or the disk mean of the wake.
    fn mean_inflow<S: Real>(&self, y: &[S], inputs: &Inputs) -> S {
        match &inputs.inflow {
            HeldInflow::Dynamic => y[self.layout.inflow().start],
            HeldInflow::Stations { mean, .. } => S::cst(*mean),
            HeldInflow::Vacuum => S::zero(),
        }
    }

    /// Rotor, fuselage, tail surfaces and tail rotor on the body origin.
    pub fn airframe_loads<S: Real>(
        &self,
        t: f64,
        y: &[S],
        inputs: &Inputs,
        rotor: &RotorLoads<S>,
        beta_1c: S,
    ) -> AirframeLoads<S> {
        if matches!(inputs.inflow, HeldInflow::Vacuum) {
            let to_body = self.rotor.rot_hb::<S>().transposed();
            let hub_force = to_body * rotor.force;
            let hub_moment = to_body * rotor.moment + Vec3::cst(self.rotor.position).cross(hub_force);
            let zero = S::zero();
            return AirframeLoads {
                force: hub_force,
                moment: hub_moment,
                tail_rotor_power: zero,
                tail_inflow_rate: zero,
            };
        }
        let theta_tr = self.rotor.rigging.pitch(inputs.stick_at(t).map(S::cst))[3];
        let tail_inflow = if self.layout.tail_rotor { y[self.layout.tail_inflow().start] } else { S::zero() };
        let incidence = S::cst(inputs.stabilator_incidence);
        self.loads_on_airframe(
            y,
            rotor,
            self.mean_inflow(y, inputs),
            beta_1c,
            incidence,
            theta_tr,
            tail_inflow,
        )
    }

    /// Rotor loads and air loads on the body origin.
    #[allow(clippy::too_many_arguments, reason = "everything the airframe feels")]
    pub(super) fn loads_on_airframe<S: Real>(
        &self,
        y: &[S],
        rotor: &RotorLoads<S>,
        mean_inflow: S,
        beta_1c: S,
        stabilator_incidence: S,
        theta_tr: S,
        tail_inflow: S,
    ) -> AirframeLoads<S> {
        let to_body = self.rotor.rot_hb::<S>().transposed();
        let arm = Vec3::cst(self.rotor.position);
        let hub_force = to_body * rotor.force;
        let hub_moment = to_body * rotor.moment + arm.cross(hub_force);
        let velocity = body_vector(y, Layout::VELOCITY);
        let rates = body_vector(y, Layout::RATES);
        let effect = RotorEffect {
            mean_inflow,
            hub_velocity: self.rotor.rot_hb::<S>() * (velocity + rates.cross(arm)),
            beta_1c,
            tip_speed: self.rotor.tip_speed(),
        };
        let controls = TailControls { stabilator_incidence, theta_tr, tail_inflow };
        let a = self.airframe.air_loads(velocity, rates, &effect, &controls, self.air.density);
        AirframeLoads {
            force: hub_force + a.force,
            moment: hub_moment + a.moment,
            tail_rotor_power: a.tail_rotor_power,
            tail_inflow_rate: a.tail_inflow_rate,
        }
    }

    /// All equations but the blades', given the loads of the rotor and its flapping `beta_1c` [rad].
    #[allow(clippy::too_many_arguments, reason = "the arguments of F and what the blades bring")]
    pub(super) fn body_rows<S: Real>(
        &self,
        t: f64,
        y: &[S],
        y_dot: &[S],
        inputs: &Inputs,
        rotor: &RotorLoads<S>,
        beta_1c: S,
        f: &mut [S],
    ) {
        let l = &self.layout;
        let velocity = body_vector(y, Layout::VELOCITY);
        let rates = body_vector(y, Layout::RATES);
        let loads = self.airframe_loads(t, y, inputs, rotor, beta_1c);

        // balance of forces and moments on the airframe
        let (inertia_force, inertia_moment) = self.airframe.mass.inertial_residual(
            velocity,
            rates,
            body_vector(y_dot, Layout::VELOCITY),
            body_vector(y_dot, Layout::RATES),
            self.gravity_b(y),
        );
        let force = (loads.force + inertia_force).array();
        let moment = (loads.moment + inertia_moment).array();
        for i in 0..3 {
            f[i] = force[i] / self.airframe.gross_mass;
            f[3 + i] = moment[i] / self.airframe.reference_inertia[i];
        }

        // attitude: q_dot = q (0, omega)/2
        let [p, q, r] = rates.array();
        let [e0, e1, e2, e3] = [y[6], y[7], y[8], y[9]];
        f[6] = y_dot[6] + (e1 * p + e2 * q + e3 * r) * 0.5;
        f[7] = y_dot[7] - (e0 * p + e2 * r - e3 * q) * 0.5;
        f[8] = y_dot[8] - (e0 * q + e3 * p - e1 * r) * 0.5;
        f[9] = y_dot[9] - (e0 * r + e1 * q - e2 * p) * 0.5;
        let track = rot_ib([e0, e1, e2, e3]) * velocity;
        for (i, rate) in track.array().into_iter().enumerate() {
            f[10 + i] = y_dot[10 + i] - rate;
        }

        // inflow
        if l.dynamic_inflow {
            let i = l.inflow().start;
            let rate = self.inflow_rate(velocity, rates, rotor, [y[i], y[i + 1], y[i + 2]]);
            for k in 0..3 {
                f[i + k] = y_dot[i + k] - rate[k];
            }
        }
        if l.tail_rotor {
            let i = l.tail_inflow().start;
            f[i] = y_dot[i] - loads.tail_inflow_rate;
        }
    }

    /// Rate of the dynamic inflow states lambda_0, lambda_s, lambda_c [1/s].
    pub(super) fn inflow_rate<S: Real>(
        &self,
        velocity: Vec3<S, Body>,
        rates: Vec3<S, Body>,
        rotor: &RotorLoads<S>,
        inflow: [S; 3],
    ) -> [S; 3] {
        let mu = (self.rotor.rot_hb::<S>() * (velocity + rates.cross(Vec3::cst(self.rotor.position))))
            .scaled(1.0 / self.rotor.tip_speed());
        let [ct, cl, cm] = self.aero_coefficients(rotor);
        // the model counts forward and downward speed positive; hub axes point aft and up
        let disk = DiskCondition { ct, cl, cm, mu_x: -mu.x, mu_y: mu.y, mu_z: -mu.z };
        self.pitt_peters.inflow_dot(inflow, disk, self.rotor.omega)
    }

    /// C_T, C_L (right side down +), C_M (nose up +) of the air loads.
    pub fn aero_coefficients<S: Real>(&self, rotor: &RotorLoads<S>) -> [S; 3] {
        self.rotor.aero_coefficients(self.air, rotor.aero_force, rotor.aero_moment)
    }
}
