//! What a run records at an instant: loads, flapping, and the air at every station.

use super::model::{Aircraft, Inputs};
use super::state::{Layout, body_vector};
use crate::numerics::frames::{Vec3, rot_ib};

/// Quantities of one instant, SI and radians.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// All loads on the airframe but gravity, body axes, at the body origin [N].
    pub force: [f64; 3],
    /// Moment [N m].
    pub moment: [f64; 3],
    /// Rotor on the hub, hub axes [N].
    pub hub_force: [f64; 3],
    /// Rotor on the hub [N m].
    pub hub_moment: [f64; 3],
    /// Aerodynamic thrust coefficient along the shaft.
    pub ct: f64,
    /// First flap mode over the blades [rad].
    pub beta_1c: f64,
    /// Sine coefficient [rad].
    pub beta_1s: f64,
    /// Main rotor, tail rotor, accessories [W].
    pub power: [f64; 3],
    /// Kinetic and potential energy of the airframe without blades, zero height at the start [J].
    pub energy: f64,
    /// Power of all loads on the airframe but gravity, F.v + M.omega [W].
    pub load_power: f64,
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

impl Aircraft {
    /// Record of the state (y, y_dot) at time `t`.
    pub fn outputs(&self, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs) -> Outputs {
        let hub = self.hub_motion(y, y_dot);
        let n_blades = self.rotor.n_blades;
        let rotor = self.rotor_loads(t, y, y_dot, inputs, &hub, |_, _| ());
        let [beta_1c, beta_1s] = self.flap_multiblade(t, y);
        let loads = self.airframe_loads(t, y, inputs, &rotor, beta_1c);
        let (velocity, rates) = (body_vector(y, Layout::VELOCITY), body_vector(y, Layout::RATES));
        let mass = &self.airframe.mass;
        let below = rot_ib([y[6], y[7], y[8], y[9]]) * Vec3::cst(mass.cg);
        let mut o = Outputs {
            energy: mass.kinetic_energy(velocity, rates) - mass.mass * self.gravity * (y[12] + below.z),
            load_power: loads.force.dot(velocity) + loads.moment.dot(rates),
            force: Vec3::array(loads.force),
            moment: Vec3::array(loads.moment),
            hub_force: Vec3::array(rotor.force),
            hub_moment: Vec3::array(rotor.moment),
            ct: self.aero_coefficients(&rotor)[0],
            beta_1c,
            beta_1s,
            power: [
                -rotor.moment.z * self.rotor.omega,
                loads.tail_rotor_power,
                self.airframe.accessory_power,
            ],
            ..Outputs::default()
        };
        for b in 0..n_blades {
            let psi = self.rotor.azimuth(self.rotor.omega * t, b);
            o.azimuth.push(psi.rem_euclid(std::f64::consts::TAU));
            let control = self.blade_pitch(inputs, t, psi);
            let modal = self.modal_motion(y, y_dot, b);
            let inflow = self.blade_inflow(y, inputs, b);
            self.rotor.blade_air(self.air, &hub, psi, &modal, &control, &inflow, |_, air, lambda| {
                o.inflow.push(lambda);
                o.circulation.push(air.circulation);
                o.cl.push(air.cl);
                o.cl_m2.push(air.cl * air.mach * air.mach);
                o.alpha.push(air.alpha);
                o.mach.push(air.mach);
            });
        }
        o
    }
}
