//! What a run records at an instant: loads, flapping, and the air at every station.

use super::carrier::Carrier;
use super::instant::Instant;
use super::layout::{Layout, body_vector};
use super::model::System;
use super::rotor_loads::RotorShare;
use crate::numerics::frames::{Vec3, rot_ib};

/// Quantities of one instant, SI and radians.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// All loads on the airframe but gravity, body axes, at the body origin [N]; zero on a stand.
    pub force: [f64; 3],
    /// Moment [N m].
    pub moment: [f64; 3],
    /// Power of the closed-form rotors and of the accessories [W].
    pub power: [f64; 2],
    /// Kinetic and potential energy of the airframe without blades, zero height at the start [J].
    pub energy: f64,
    /// Power of all loads on the airframe but gravity, F.v + M.omega [W].
    pub load_power: f64,
    /// Every rotor with blades, in the order of the list.
    pub rotors: Vec<RotorOutputs>,
}

/// Quantities of one rotor at an instant; azimuths and first harmonics count in its sense of rotation.
#[derive(Clone, Debug, Default)]
pub struct RotorOutputs {
    /// Rotor on the hub, hub axes [N].
    pub hub_force: [f64; 3],
    /// Rotor on the hub [N m].
    pub hub_moment: [f64; 3],
    /// Share of the air in the force on the hub [N].
    pub aero_force: [f64; 3],
    /// Share of the air in the moment on the hub [N m].
    pub aero_moment: [f64; 3],
    /// Aerodynamic thrust coefficient along the shaft.
    pub ct: f64,
    /// First flap mode over the blades [rad].
    pub beta_1c: f64,
    /// Sine coefficient [rad].
    pub beta_1s: f64,
    /// Shaft power [W].
    pub power: f64,
    /// Speed [rad/s].
    pub speed: f64,
    /// Torque of the engines at that speed [N m], where it is a state.
    pub engine_torque: Option<f64>,
    /// Azimuth of every blade, 0 to 2 pi [rad].
    pub azimuth: Vec<f64>,
    /// Inflow (n_blades x n_stations), positive down.
    pub inflow: Vec<f64>,
    /// Bound circulation [m2/s].
    pub circulation: Vec<f64>,
    /// Lift coefficient.
    pub cl: Vec<f64>,
    /// Lift coefficient times Mach squared.
    pub cl_m2: Vec<f64>,
    /// Angle of attack [rad].
    pub alpha: Vec<f64>,
    /// Mach number.
    pub mach: Vec<f64>,
}

impl System {
    /// Record of an instant.
    pub fn outputs(&self, at: &Instant<f64>) -> Outputs {
        let (mut rotors, mut shares) = (Vec::new(), Vec::new());
        for r in 0..self.rotors.len() {
            let (outputs, share) = self.rotor_outputs(r, at);
            rotors.push(outputs);
            shares.push(share);
        }
        let mut o = Outputs { rotors, ..Outputs::default() };
        if let Carrier::Airframe(airframe) = &self.carrier {
            let y = at.y;
            let loads = self.airframe_loads(airframe, at, &shares);
            let (velocity, rates) = (body_vector(y, Layout::VELOCITY), body_vector(y, Layout::RATES));
            let mass = &airframe.mass;
            let below = rot_ib([y[6], y[7], y[8], y[9]]) * Vec3::cst(mass.cg);
            o.energy = mass.kinetic_energy(velocity, rates) - mass.mass * self.gravity * (y[12] + below.z);
            o.load_power = loads.force.dot(velocity) + loads.moment.dot(rates);
            o.force = loads.force.array();
            o.moment = loads.moment.array();
            o.power = [loads.closed_power, airframe.accessory_power];
        }
        for (r, share) in shares.iter().enumerate() {
            let geared = if r == 0 { o.power[0] + o.power[1] } else { 0.0 };
            let keeping = self.keeping_torque(r, at, (share.loads.moment.z, geared));
            o.rotors[r].engine_torque = o.rotors[r].engine_torque.or(keeping);
        }
        o
    }

    fn rotor_outputs(&self, r: usize, at: &Instant<f64>) -> (RotorOutputs, RotorShare<f64>) {
        let rotor = &self.rotors[r];
        let spin = self.spin(r, at);
        let hub = self.felt_hub(r, at.y, at.inputs, (self.hub_motion(r, at.y, at.y_dot), &spin.turning));
        let loads = self.rotor_loads(r, at, (&hub, &spin), |_, _| ());
        let [beta_1c, beta_1s] = self.flap_multiblade(r, spin.psi, at.y);
        let sense = rotor.sense;
        let mut o = RotorOutputs {
            hub_force: sense.polar(loads.force).array(),
            hub_moment: sense.axial(loads.moment).array(),
            aero_force: sense.polar(loads.aero_force).array(),
            aero_moment: sense.axial(loads.aero_moment).array(),
            ct: rotor.aero_coefficients(self.air, loads.aero_force, loads.aero_moment)[0],
            beta_1c,
            beta_1s,
            power: -loads.moment.z * spin.turning.omega,
            speed: spin.turning.omega,
            engine_torque: self.engine_torque(r, at),
            ..RotorOutputs::default()
        };
        for b in 0..rotor.n_blades {
            let psi = rotor.azimuth(spin.psi, b);
            o.azimuth.push(psi.rem_euclid(std::f64::consts::TAU));
            let control = self.blade_pitch(r, at.inputs, (at.t, &spin), b);
            let modal = self.modal_motion(r, at.y, at.y_dot, b);
            let inflow = self.blade_inflow(r, (at.t, at.y), at.inputs, b);
            for (air, lambda) in rotor.blade_air(self.air, &hub, psi, &modal, &control, &inflow) {
                o.inflow.push(lambda);
                o.circulation.push(air.circulation);
                o.cl.push(air.cl);
                o.cl_m2.push(air.cl * air.mach * air.mach);
                o.alpha.push(air.alpha);
                o.mach.push(air.mach);
            }
        }
        (o, RotorShare { loads, beta_1c })
    }
}
