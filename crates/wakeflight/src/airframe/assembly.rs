//! Air loads of the whole airframe on the body origin, with rotor wash and tail interference.

use super::fuselage::Fuselage;
use super::interference::{FuselageWash, Interference};
use super::mass::{AirframeMass, MassError, MassProperties};
use super::tail::{StabilatorSchedule, Surface};
use super::tail_rotor::TailRotor;
use crate::numerics::frames::{Body, Hub, Vec3};
use crate::numerics::scalar::Real;

/// Density at sea level of the standard atmosphere [kg/m3].
const SEA_LEVEL_DENSITY: f64 = 1.225;
/// One knot [m/s].
const KNOT: f64 = 1852.0 / 3600.0;

/// Parts of the airframe; each optional.
#[derive(Clone, Debug)]
pub struct Airframe {
    /// Mass of the airframe without blades.
    pub mass: AirframeMass,
    /// Gross mass [kg]: turns forces into accelerations of the whole aircraft.
    pub gross_mass: f64,
    /// Moments of inertia Ixx, Iyy, Izz that turn moments into angular accelerations [kg m2].
    pub reference_inertia: [f64; 3],
    /// Fuselage.
    pub fuselage: Option<Fuselage>,
    /// Horizontal tail.
    pub stabilator: Option<Surface>,
    /// Its schedule.
    pub stabilator_schedule: Option<StabilatorSchedule>,
    /// Vertical tail.
    pub fin: Option<Surface>,
    /// Tail rotor.
    pub tail_rotor: Option<TailRotor>,
    /// Washes.
    pub interference: Option<Interference>,
    /// Accessory power [W].
    pub accessory_power: f64,
}

/// What the main rotor does to the airframe's air.
#[derive(Clone, Copy, Debug)]
pub struct RotorEffect<S: Copy> {
    /// Mean inflow, positive down (v_i / tip speed).
    pub mean_inflow: S,
    /// Velocity of the hub [m/s].
    pub hub_velocity: Vec3<S, Hub>,
    /// Longitudinal flapping, disk forward-down positive [rad].
    pub beta_1c: S,
    /// Tip speed [m/s].
    pub tip_speed: f64,
}

/// Settings of the tail.
#[derive(Clone, Copy, Debug)]
pub struct TailControls<S> {
    /// Stabilator incidence [rad].
    pub stabilator_incidence: S,
    /// Tail-rotor pitch from the pedal [rad].
    pub theta_tr: S,
    /// Tail-rotor inflow.
    pub tail_inflow: S,
}

/// Air loads on the body origin.
#[derive(Clone, Copy, Debug)]
pub struct AirLoads<S: Copy> {
    /// Force [N].
    pub force: Vec3<S, Body>,
    /// Moment [N m].
    pub moment: Vec3<S, Body>,
    /// Tail-rotor power [W].
    pub tail_rotor_power: S,
    /// Rate of the tail-rotor inflow [1/s].
    pub tail_inflow_rate: S,
}

impl<S: Real> AirLoads<S> {
    fn none() -> Self {
        Self {
            force: Vec3::zero(),
            moment: Vec3::zero(),
            tail_rotor_power: S::zero(),
            tail_inflow_rate: S::zero(),
        }
    }
    fn add(&mut self, position: [f64; 3], force: Vec3<S, Body>) {
        self.force += force;
        self.moment += Vec3::cst(position).cross(force);
    }
}

/// The airframe's parts before assembly.
#[derive(Clone, Debug)]
pub struct Parts {
    /// Mass and inertia.
    pub mass: MassProperties,
    /// Fuselage.
    pub fuselage: Option<Fuselage>,
    /// Horizontal tail.
    pub stabilator: Option<Surface>,
    /// Its schedule.
    pub stabilator_schedule: Option<StabilatorSchedule>,
    /// Vertical tail.
    pub fin: Option<Surface>,
    /// Tail rotor.
    pub tail_rotor: Option<TailRotor>,
    /// Washes.
    pub interference: Option<Interference>,
    /// Accessory power [W].
    pub accessory_power: f64,
}

impl Airframe {
    /// Assemble; the blades' mass is taken out at the hub.
    pub fn new(parts: Parts, hub: [f64; 3], n_blades: usize, blade_mass: f64) -> Result<Self, MassError> {
        let mass = AirframeMass::new(&parts.mass, hub, n_blades, blade_mass)?;
        let [ixx, iyy, izz, _] = parts.mass.inertia;
        Ok(Self {
            mass,
            gross_mass: parts.mass.gross_mass,
            reference_inertia: [ixx, iyy, izz],
            fuselage: parts.fuselage,
            stabilator: parts.stabilator,
            stabilator_schedule: parts.stabilator_schedule,
            fin: parts.fin,
            tail_rotor: parts.tail_rotor,
            interference: parts.interference,
            accessory_power: parts.accessory_power,
        })
    }

    /// Air loads for body velocity [m/s] and rates [rad/s].
    pub fn air_loads<S: Real>(
        &self,
        velocity: Vec3<S, Body>,
        rates: Vec3<S, Body>,
        rotor: &RotorEffect<S>,
        controls: &TailControls<S>,
        density: f64,
    ) -> AirLoads<S> {
        let mut total = AirLoads::none();
        let swing = |position: [f64; 3]| rates.cross(Vec3::cst(position));
        let wash = self.interference.as_ref().map(|i| {
            let mu = rotor.hub_velocity.scaled(1.0 / rotor.tip_speed);
            // hub axes: x aft and z up; the wash maps count forward speed and speed along the shaft downward
            i.rotor_wash(rotor.mean_inflow, -mu.x, -mu.z, rotor.beta_1c, rotor.tip_speed)
        });

        let mut fuselage_wash = FuselageWash::none();
        if let Some(fuselage) = &self.fuselage {
            let mut local = velocity + swing(fuselage.position);
            if let Some(w) = &wash {
                local += w.fuselage;
            }
            let loads = fuselage.loads(local, density);
            total.add(fuselage.position, loads.force);
            total.moment += loads.moment;
            if let Some(i) = &self.interference {
                fuselage_wash = i.fuselage_wash(loads.alpha, loads.beta);
            }
        }
        if let Some(stabilator) = &self.stabilator {
            let mut local = fuselage_wash.at_stabilator(velocity) + swing(stabilator.position);
            if let Some(w) = &wash {
                local += w.stabilator;
            }
            total.add(
                stabilator.position,
                stabilator.stabilator_force(local, controls.stabilator_incidence, density),
            );
        }
        if let Some(fin) = &self.fin {
            let mut local = fuselage_wash.at_fin(velocity) + swing(fin.position);
            if let Some(w) = &wash {
                local += w.fin;
            }
            total.add(fin.position, fin.fin_force(local, density));
        }
        if let Some(tail_rotor) = &self.tail_rotor {
            let local = fuselage_wash.at_tail_rotor(velocity) + swing(tail_rotor.position);
            let loads =
                tail_rotor.evaluate(local, controls.theta_tr, controls.tail_inflow, density, velocity.x);
            total.add(tail_rotor.position, loads.force);
            total.tail_rotor_power = loads.power;
            total.tail_inflow_rate = loads.lambda_i_dot;
        }
        total
    }

    /// Stabilator incidence in trim: the schedule at this true airspeed, or the fixed incidence [rad].
    pub fn trim_incidence<S: Real>(&self, speed: S, density: f64, collective: S, pitch_rate: S) -> S {
        match (&self.stabilator_schedule, &self.stabilator) {
            (Some(schedule), _) => {
                let root = (density / SEA_LEVEL_DENSITY).sqrt();
                let equivalent = speed.chain(speed.re() * root / KNOT, root / KNOT);
                schedule.incidence(equivalent, collective * (100.0 / schedule.collective_travel), pitch_rate)
            }
            (None, Some(surface)) => S::cst(surface.incidence),
            (None, None) => S::zero(),
        }
    }
}
