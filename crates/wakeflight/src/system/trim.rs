//! Trim of a system: its controls, and where it flies attitude and path, are unknowns; the balances of its airframe are equations.
//!
//! The periodic motion is that of the first rotor of the list; others with blades have no trim yet.

use super::carrier::{Carrier, gravity_b};
use super::instant::{EngineInput, HeldInflow, Inputs};
use super::layout::{Layout, body_vector};
use super::model::System;
use super::residual::Settings;
use super::rotor_loads::{RotorLoads, RotorShare};
use crate::blade::aerodynamics::Air;
use crate::blade::kinematics::PitchMotion;
use crate::blade::memory_rows::MemoryRows;
use crate::inflow::pitt_peters::PittPeters;
use crate::numerics::frames::{Vec3, quaternion, rot_ib};
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use crate::rotor::swashplate::PitchSeries;
use crate::trim::host::{Balances, Carried, Head, Host, RotorMean};
use crate::trim::residual::Trim;

impl Host for System {
    fn controls(&self) -> &'static [(&'static str, &'static str)] {
        match self.carrier {
            Carrier::Airframe(_) => {
                &[("lateral", "m"), ("longitudinal", "m"), ("collective", "m"), ("pedal", "m")]
            }
            Carrier::Stand(_) => &[("theta_0", "rad"), ("theta_1c", "rad"), ("theta_1s", "rad")],
        }
    }

    fn flies(&self) -> bool {
        self.layout.free
    }

    fn has_tail_rotor(&self) -> bool {
        !self.layout.closed.is_empty()
    }

    fn rotor(&self) -> &Rotor {
        self.main()
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
        self.main().rigging.pitch(controls)
    }

    fn blade_pitch<S: Real>(&self, pitch: &[S; 4], psi: f64) -> PitchMotion<S> {
        let rotor = self.main();
        let [theta_1c, theta_1s, theta_0, _] = *pitch;
        let series = PitchSeries { theta_0, theta_1c, theta_1s, higher: &rotor.higher };
        series.at(psi + rotor.rigging.phase, rotor.omega).into()
    }

    fn carried<S: Real>(&self, head: &Head<S>) -> Carried<S> {
        let mut y = vec![S::zero(); self.layout.len()];
        if self.layout.free {
            let attitude = quaternion(head.roll, head.pitch, head.yaw);
            let (climb, forward) = head.path.flight_path.sin_cos();
            let speed = head.path.speed;
            let velocity =
                rot_ib(attitude).transposed() * Vec3::new(speed * forward, S::zero(), -(speed * climb));
            let (sp, cp) = head.pitch.sin_cos();
            let (sr, cr) = head.roll.sin_cos();
            let turn = head.path.turn_rate;
            y[Layout::VELOCITY].copy_from_slice(&velocity.array());
            y[Layout::RATES].copy_from_slice(&[-(turn * sp), turn * cp * sr, turn * cp * cr]);
            y[Layout::ATTITUDE].copy_from_slice(&attitude);
        }
        let inflow = self.layout.main().inflow();
        for (place, value) in
            inflow.zip(head.inflow).chain(self.layout.closed_inflow().map(|i| (i, head.tail_inflow)))
        {
            y[place] = value;
        }
        for (_, rotor, l) in self.each_rotor() {
            rotor.balanced(l, &mut y);
        }
        let at_rest = vec![S::zero(); y.len()];
        let hub = self.hub_motion(0, &y, &at_rest);
        Carried { y, hub }
    }

    fn hub_height<S: Real>(&self, carried: &Carried<S>) -> Option<S> {
        System::hub_height(self, 0, &carried.y)
    }

    fn balances<S: Real>(
        &self,
        head: &Head<S>,
        carried: &Carried<S>,
        rotor: &RotorMean<S>,
    ) -> Option<Balances<S>> {
        let airframe = self.carrier.airframe()?;
        let y = &carried.y;
        let mut share = RotorShare { loads: RotorLoads::zero(), beta_1c: rotor.beta_1c };
        share.loads.add(rotor.loads);
        let settings = Settings {
            mean_inflow: rotor.inflow,
            wash: rotor.wash,
            stabilator_incidence: self.trim_stabilator(head, y),
            closed_pitch: self.pitch(head.controls)[3],
            closed_inflow: &vec![head.tail_inflow; self.closed.len()],
            closed_speed: S::cst(1.0),
            wind: None,
        };
        let loads = self.loads_on_airframe(airframe, y, &[share], &settings);
        let velocity = body_vector(y, Layout::VELOCITY);
        let rates = body_vector(y, Layout::RATES);
        let gravity = gravity_b(y, self.gravity);
        let (inertia_force, inertia_moment) =
            airframe.mass.inertial_residual(velocity, rates, Vec3::zero(), Vec3::zero(), gravity);
        let force = (loads.force + inertia_force).array();
        let moment = (loads.moment + inertia_moment).array();
        Some(Balances {
            force: std::array::from_fn(|i| force[i] / airframe.gross_mass),
            moment: std::array::from_fn(|i| moment[i] / airframe.reference_inertia[i]),
            velocity,
            other_power: loads.closed_power + airframe.accessory_power,
            tail_inflow_rate: loads.closed_inflow_rate.first().copied().unwrap_or_else(S::zero),
        })
    }
}

impl System {
    /// Stabilator incidence in trim: on its schedule where it has one [rad]; zero on a stand.
    fn trim_stabilator<S: Real>(&self, head: &Head<S>, y: &[S]) -> S {
        let Some(airframe) = self.carrier.airframe() else { return S::zero() };
        airframe.trim_incidence(head.path.speed, self.air.density, head.controls[2], y[4])
    }
}

impl Trim<'_, System> {
    /// State and its rate at time `t` of the trimmed revolution; accelerations of the carrier and attitude rates are left at zero.
    pub fn state(&self, x: &[f64], t: f64) -> (Vec<f64>, Vec<f64>) {
        let system = self.host();
        let l = system.layout.main();
        let mut y = system.carried(&self.layout.head(x)).y;
        let mut y_dot = vec![0.0; y.len()];
        let psi = system.main().turned(t);
        if let Some(place) = l.spin() {
            (y[place.azimuth], y_dot[place.azimuth]) = (psi, system.main().omega);
        }
        for b in 0..l.n_blades {
            let m = self.motion(x, system.main().azimuth(psi, b));
            for (k, (q, s)) in l.modal(b).zip(l.modal_rate(b)).enumerate() {
                (y[q], y[s]) = (m.q[k], m.q_dot[k]);
                (y_dot[q], y_dot[s]) = (m.q_dot[k], m.q_ddot[k]);
            }
        }
        (y, y_dot)
    }

    /// Memory of the sections of every blade at time `t` of the trimmed revolution.
    pub fn memory_at(&self, x: &[f64], t: f64) -> MemoryRows {
        let (system, memory) = (self.host(), self.memory(x));
        if memory.is_empty() {
            return memory;
        }
        let rotor = system.main();
        let psi = |b: usize| rotor.azimuth(rotor.turned(t), b);
        MemoryRows::of((0..rotor.n_blades).map(|b| self.kept_at(x, &memory, psi(b))))
    }

    /// Inputs that hold the trim: controls, stabilator, and the inflow given.
    pub fn inputs(&self, x: &[f64], inflow: HeldInflow) -> Inputs {
        let head = self.layout.head(x);
        let y = self.host().carried(&head).y;
        Inputs {
            stick: head.controls,
            stick_rate: [0.0; 4],
            t_start: 0.0,
            inflow: vec![inflow],
            wash: self.wash(),
            sections: Vec::new(),
            stabilator_incidence: self.host().trim_stabilator(&head, &y),
            engine: EngineInput::default(),
            disturbance: None,
        }
    }
}
