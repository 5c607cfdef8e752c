//! Equations of motion of a blade by virtual work, and what it passes to the hub.
//!
//! residual_i = sum over sections [f . dr/dq_i + m . d omega/dq_i_dot] - dU/dq_i - damping_i,
//! with the air, gravity and inertia loads f, m of every section in exact kinematics. The six rigid motions of the
//! hub are six more test motions of the same sums: hinge, damper and pitch-link loads act inside and do not appear.

use super::MAX_MODES;
use super::aerodynamics::{Air, SectionAir, section_air};
use super::kinematics::{BladeAxes, ModalMotion, PitchMotion, SectionMotion, combine};
use super::model::{AeroStation, Blade, StructuralPoint};
use super::strain::add_strain_gradient;
use crate::airfoil::Airfoil;
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::scalar::Real;

/// Motion of the hub, non-rotating hub axes.
#[derive(Clone, Copy, Debug)]
pub struct HubMotion<S> {
    /// Velocity of the hub centre [m/s].
    pub velocity: Vec3<S, Hub>,
    /// Acceleration of the hub centre less gravity [m/s2].
    pub acceleration_less_gravity: Vec3<S, Hub>,
    /// Angular velocity of the airframe [rad/s].
    pub omega: Vec3<S, Hub>,
    /// Angular acceleration of the airframe [rad/s2].
    pub omega_dot: Vec3<S, Hub>,
}

impl HubMotion<f64> {
    /// The same motion without derivatives.
    pub fn constant<S: Real>(&self) -> HubMotion<S> {
        HubMotion {
            velocity: Vec3::cst(self.velocity.array()),
            acceleration_less_gravity: Vec3::cst(self.acceleration_less_gravity.array()),
            omega: Vec3::cst(self.omega.array()),
            omega_dot: Vec3::cst(self.omega_dot.array()),
        }
    }
}

/// Induced inflow of a blade, positive down (v_i / tip speed).
#[derive(Clone, Copy, Debug)]
pub enum BladeInflow<'a, S> {
    /// lambda_0 + (lambda_c x_h + lambda_s y_h)/R at the section's place: lambda_0, lambda_s, lambda_c.
    Disk([S; 3]),
    /// One value per station, held.
    Stations(&'a [f64]),
    /// One value per station, with derivatives.
    Variable(&'a [S]),
    /// No air at all.
    Vacuum,
}

/// Sums over one blade, hub axes, about the hub centre.
#[derive(Clone, Copy, Debug)]
pub struct BladeLoads<S> {
    /// Residual of the modal equations (mass-normalised modes) [N kg^-1/2].
    pub modal: [S; MAX_MODES],
    /// Force on the hub [N].
    pub force: Vec3<S, Hub>,
    /// Moment on the hub [N m].
    pub moment: Vec3<S, Hub>,
    /// Share of the air in the force.
    pub aero_force: Vec3<S, Hub>,
    /// Share of the air in the moment.
    pub aero_moment: Vec3<S, Hub>,
}

/// What surrounds a blade and turns it.
#[derive(Clone, Copy, Debug)]
pub struct BladeEnvironment<'a> {
    /// Section tables.
    pub airfoil: &'a Airfoil,
    /// Air.
    pub air: Air,
    /// Rotor speed [rad/s].
    pub rotor_speed: f64,
}

/// Rigid motion of the blade axes at one instant.
struct Carrier<S> {
    velocity: Vec3<S, BladeAxes>,
    acceleration: Vec3<S, BladeAxes>,
    omega: Vec3<S, BladeAxes>,
    omega_dot: Vec3<S, BladeAxes>,
    to_blade: [[S; 3]; 3],
    up: Vec3<S, BladeAxes>,
}

impl<S: Real> Carrier<S> {
    /// Blade axes at azimuth `psi`, turned up by `precone`, on a hub in motion `hub`.
    fn new(hub: &HubMotion<S>, psi: S, precone: f64, rotor_speed: f64) -> Self {
        let (s, c) = psi.sin_cos();
        let (sp, cp) = precone.sin_cos();
        let zero = S::zero();
        let to_blade = [[c * cp, s * cp, S::cst(sp)], [-s, c, zero], [-(c * sp), -(s * sp), S::cst(cp)]];
        let turn = |v: Vec3<S, Hub>| {
            let row = |r: &[S; 3]| r[0] * v.x + r[1] * v.y + r[2] * v.z;
            Vec3::new(row(&to_blade[0]), row(&to_blade[1]), row(&to_blade[2]))
        };
        let spin: Vec3<S, Hub> = Vec3::cst([0.0, 0.0, rotor_speed]);
        Self {
            velocity: turn(hub.velocity),
            acceleration: turn(hub.acceleration_less_gravity),
            omega: turn(hub.omega + spin),
            omega_dot: turn(hub.omega_dot + hub.omega.cross(spin)),
            up: Vec3::cst([sp, 0.0, cp]),
            to_blade,
        }
    }
    fn to_hub(&self, v: Vec3<S, BladeAxes>) -> Vec3<S, Hub> {
        let m = &self.to_blade;
        let column = |j: usize| m[0][j] * v.x + m[1][j] * v.y + m[2][j] * v.z;
        Vec3::new(column(0), column(1), column(2))
    }
}

/// Force and moment about the hub, blade axes.
struct Sum<S> {
    force: Vec3<S, BladeAxes>,
    moment: Vec3<S, BladeAxes>,
}

impl<S: Real> Sum<S> {
    fn new() -> Self {
        Self { force: Vec3::zero(), moment: Vec3::zero() }
    }
    fn add(&mut self, position: Vec3<S, BladeAxes>, force: Vec3<S, BladeAxes>, moment: Vec3<S, BladeAxes>) {
        self.force += force;
        self.moment += position.cross(force) + moment;
    }
}

impl Blade {
    /// Residual of the modal equations and hub loads at azimuth `psi` [rad].
    pub fn loads<S: Real>(
        &self,
        environment: &BladeEnvironment,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
    ) -> BladeLoads<S> {
        let carrier = Carrier::new(hub, psi, self.precone, environment.rotor_speed);
        let mut work = [S::zero(); MAX_MODES];
        let mut inertial = Sum::new();
        for point in &self.structure {
            let (motion, force, moment) = self.inertial_loads(point, &carrier, modal, control);
            self.project(&point.shapes, &motion, force, moment, &mut work);
            inertial.add(motion.position, force, moment);
            let mut gradient = [S::zero(); MAX_MODES];
            let pitch = control.theta + point.twist;
            add_strain_gradient(
                &point.shapes,
                &point.stiffness,
                self.n_modes,
                &modal.q,
                pitch,
                &mut gradient,
            );
            for i in 0..self.n_modes {
                work[i] -= gradient[i];
            }
        }
        let mut aero = Sum::new();
        if !matches!(inflow, BladeInflow::Vacuum) {
            for j in 0..self.stations.len() {
                let (motion, air) = self.station_air(environment, &carrier, modal, control, inflow, j);
                self.project(&self.stations[j].shapes, &motion, air.force, air.moment, &mut work);
                aero.add(motion.position, air.force, air.moment);
            }
        }
        self.add_root_loads(modal, &mut work);
        let (aero_force, aero_moment) = (carrier.to_hub(aero.force), carrier.to_hub(aero.moment));
        BladeLoads {
            modal: work,
            force: carrier.to_hub(inertial.force) + aero_force,
            moment: carrier.to_hub(inertial.moment) + aero_moment,
            aero_force,
            aero_moment,
        }
    }

    /// Air at every station; velocities need no accelerations, so `modal.q_ddot` is ignored.
    pub fn air<S: Real>(
        &self,
        environment: &BladeEnvironment,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
        mut each: impl FnMut(usize, &SectionAir<S>, S),
    ) {
        let carrier = Carrier::new(hub, psi, self.precone, environment.rotor_speed);
        for j in 0..self.stations.len() {
            let (motion, air) = self.station_air(environment, &carrier, modal, control, inflow, j);
            let lambda = self.inflow_at(inflow, &carrier, &motion, j);
            each(j, &air, lambda);
        }
    }

    fn inertial_loads<S: Real>(
        &self,
        point: &StructuralPoint,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
    ) -> (SectionMotion<S>, Vec3<S, BladeAxes>, Vec3<S, BladeAxes>) {
        let pitch = PitchMotion { theta: control.theta + point.twist, ..*control };
        let m = point.shapes.motion(self.n_modes, modal, &pitch);
        let (w, w_dot) = (carrier.omega, carrier.omega_dot);
        let omega = w + m.omega;
        let omega_dot = w_dot + w.cross(m.omega) + m.omega_dot;
        let acceleration = carrier.acceleration
            + w_dot.cross(m.position)
            + w.cross(w.cross(m.position))
            + w.cross(m.velocity).scaled(2.0)
            + m.acceleration;
        // acceleration of the chord vector: the centre of gravity sits on it
        let chord_acceleration = omega_dot.cross(m.c) + omega.cross(omega.cross(m.c));
        let force = -(acceleration.scaled(point.mass) + chord_acceleration.scaled(point.first_moment));
        // angular momentum about the elastic axis, principal axes t, c, n
        let inertia = |v: Vec3<S, BladeAxes>| {
            m.t * (v.dot(m.t) * point.inertia[0])
                + m.c * (v.dot(m.c) * point.inertia[1])
                + m.n * (v.dot(m.n) * point.inertia[2])
        };
        let moment = -(m.c.cross(acceleration).scaled(point.first_moment)
            + inertia(omega_dot)
            + omega.cross(inertia(omega)));
        (m, force, moment)
    }

    fn station_air<S: Real>(
        &self,
        environment: &BladeEnvironment,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
        j: usize,
    ) -> (SectionMotion<S>, SectionAir<S>) {
        let station: &AeroStation = &self.stations[j];
        let pitch = PitchMotion { theta: control.theta + station.twist, ..*control };
        let m = station.shapes.motion(self.n_modes, modal, &pitch);
        let lambda = self.inflow_at(inflow, carrier, &m, j);
        let tip_speed = environment.rotor_speed * self.radius;
        let wind = -(carrier.velocity + carrier.omega.cross(m.position) + m.velocity)
            - carrier.up * (lambda * tip_speed);
        let omega = carrier.omega + m.omega;
        let air = section_air(environment.airfoil, &environment.air, &station.geometry, &m, wind, omega);
        (m, air)
    }

    fn inflow_at<S: Real>(
        &self,
        inflow: &BladeInflow<S>,
        carrier: &Carrier<S>,
        m: &SectionMotion<S>,
        j: usize,
    ) -> S {
        match inflow {
            BladeInflow::Disk([mean, sine, cosine]) => {
                let place = carrier.to_hub(m.position);
                *mean + (*cosine * place.x + *sine * place.y) / self.radius
            }
            BladeInflow::Stations(values) => S::cst(values[j]),
            BladeInflow::Variable(values) => values[j],
            BladeInflow::Vacuum => S::zero(),
        }
    }

    fn project<S: Real>(
        &self,
        shapes: &super::kinematics::StationShapes,
        motion: &SectionMotion<S>,
        force: Vec3<S, BladeAxes>,
        moment: Vec3<S, BladeAxes>,
        work: &mut [S; MAX_MODES],
    ) {
        for (i, total) in work.iter_mut().enumerate().take(self.n_modes) {
            let (shift, turn) = motion.test_motion(shapes, i);
            *total += force.dot(shift) + moment.dot(turn);
        }
    }

    /// Pitch-link spring and structural damping.
    fn add_root_loads<S: Real>(&self, modal: &ModalMotion<S>, work: &mut [S; MAX_MODES]) {
        let wind_up = combine(&self.root_twist, &modal.q, self.n_modes);
        for i in 0..self.n_modes {
            work[i] -=
                wind_up * (self.control_stiffness * self.root_twist[i]) + modal.q_dot[i] * self.damping[i];
        }
    }
}
