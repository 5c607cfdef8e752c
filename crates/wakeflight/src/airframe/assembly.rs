//! Air loads of the whole airframe on the body origin, with rotor wash and tail interference.

use super::fuselage::Fuselage;
use super::interference::{FuselageWash, Interference, RotorWash};
use super::mass::{AirframeMass, BladesAtHub, MassError, MassProperties};
use super::tail::{StabilatorSchedule, Surface};
use super::tail_rotor::{ClosedFormState, TailRotor};
use crate::numerics::frames::{Body, Hub, Vec3};
use crate::numerics::scalar::Real;
use crate::rotor::sense::Sense;
use crate::wake::AtParts;

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
    /// Washes.
    pub interference: Option<Interference>,
    /// Accessory power [W].
    pub accessory_power: f64,
    /// Clockwise: the air loads are those of the mirror image of the parts.
    pub hand: Sense,
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
    /// Nominal tip speed [m/s].
    pub tip_speed: f64,
    /// Air of its wake at the parts [m/s], body axes, in place of the washes; none where these act.
    pub wake: Option<AtParts>,
}

/// Motion of the airframe through the air, body axes.
#[derive(Clone, Copy, Debug)]
pub struct AirMotion<S> {
    /// Velocity of the origin [m/s].
    pub velocity: Vec3<S, Body>,
    /// Rates [rad/s].
    pub rates: Vec3<S, Body>,
    /// Density [kg/m3].
    pub density: f64,
}

/// Air loads on the body origin.
#[derive(Clone, Debug)]
pub struct AirLoads<S: Copy> {
    /// Force [N].
    pub force: Vec3<S, Body>,
    /// Moment [N m].
    pub moment: Vec3<S, Body>,
    /// Power of closed-form rotors [W].
    pub closed_power: S,
    /// Rates of their inflow [1/s].
    pub closed_inflow_rate: Vec<S>,
}

impl<S: Real> AirLoads<S> {
    /// No air, with `n_closed` closed-form rotors at rest.
    pub fn none(n_closed: usize) -> Self {
        Self {
            force: Vec3::zero(),
            moment: Vec3::zero(),
            closed_power: S::zero(),
            closed_inflow_rate: vec![S::zero(); n_closed],
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
    /// Washes.
    pub interference: Option<Interference>,
    /// Accessory power [W].
    pub accessory_power: f64,
    /// Whether the parts are those of the mirror image.
    pub mirrored: bool,
}

impl Airframe {
    /// Places that the data give: the origin, and the tail surfaces [m], body axes.
    pub fn places(&self) -> impl Iterator<Item = [f64; 3]> {
        let surfaces = self.stabilator.iter().chain(&self.fin).map(|surface| surface.position);
        std::iter::once([0.0; 3]).chain(surfaces)
    }

    /// Assemble; the blades' mass is taken out at the hubs.
    pub fn new(parts: Parts, blades: &[BladesAtHub]) -> Result<Self, MassError> {
        let mass = AirframeMass::new(&parts.mass, blades)?;
        let [ixx, iyy, izz, _] = parts.mass.inertia;
        Ok(Self {
            mass,
            gross_mass: parts.mass.gross_mass,
            reference_inertia: [ixx, iyy, izz],
            fuselage: parts.fuselage,
            stabilator: parts.stabilator,
            stabilator_schedule: parts.stabilator_schedule,
            fin: parts.fin,
            interference: parts.interference,
            accessory_power: parts.accessory_power,
            hand: if parts.mirrored { Sense::Clockwise } else { Sense::CounterClockwise },
        })
    }

    /// Air loads of fuselage, tail surfaces and closed-form rotors, each of these with its state.
    pub fn air_loads<'a, S: Real>(
        &self,
        motion: &AirMotion<S>,
        rotor: &RotorEffect<S>,
        stabilator_incidence: S,
        closed: impl ExactSizeIterator<Item = (&'a TailRotor, ClosedFormState<S>)>,
    ) -> AirLoads<S> {
        let (velocity, rates) = (self.hand.polar(motion.velocity), self.hand.axial(motion.rates));
        let density = motion.density;
        let mut total = AirLoads::none(0);
        total.closed_inflow_rate.reserve(closed.len());
        let swing = |position: [f64; 3]| rates.cross(Vec3::cst(position));
        let of_wake = rotor.wake.as_ref().map(|air| RotorWash::of_wake(air, self.hand));
        let by_tables = || {
            self.interference.as_ref().map(|i| {
                let mu = rotor.hub_velocity.scaled(1.0 / rotor.tip_speed);
                // hub axes: x aft and z up; the wash maps count forward speed and speed along the shaft downward
                i.rotor_wash(rotor.mean_inflow, -mu.x, -mu.z, rotor.beta_1c, rotor.tip_speed)
            })
        };
        let wash = of_wake.or_else(by_tables);

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
            total.add(stabilator.position, stabilator.stabilator_force(local, stabilator_incidence, density));
        }
        if let Some(fin) = &self.fin {
            let mut local = fuselage_wash.at_fin(velocity) + swing(fin.position);
            if let Some(w) = &wash {
                local += w.fin;
            }
            total.add(fin.position, fin.fin_force(local, density));
        }
        for (tail_rotor, state) in closed {
            let mut local = fuselage_wash.at_tail_rotor(velocity) + swing(tail_rotor.position);
            if let Some(w) = wash.as_ref().and_then(|w| w.tail_rotor) {
                local += w;
            }
            let loads = tail_rotor.evaluate(local, state, density, velocity.x);
            total.add(tail_rotor.position, loads.force);
            total.closed_power += loads.power;
            total.closed_inflow_rate.push(loads.lambda_i_dot);
        }
        total.force = self.hand.polar(total.force);
        total.moment = self.hand.axial(total.moment);
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
