//! Equations of motion of a blade by virtual work, and what it passes to the hub.
//!
//! residual_i = sum over sections [f . dr/dq_i + m . d omega/dq_i_dot] - dU/dq_i - damping_i,
//! with the air, gravity and inertia loads f, m of every section in exact kinematics. The six rigid motions of the
//! hub are six more test motions of the same sums: hinge, damper and pitch-link loads act inside and do not appear.

use super::MAX_MODES;
use super::aerodynamics::{Air, SectionAir, SectionWind, section_air};
use super::kinematics::{BladeAxes, ModalMotion, PitchMotion, SectionMotion, combine};
use super::model::{AeroStation, Blade, StructuralPoint};
use super::strain::add_strain_gradient;
use super::thin_section::ThinSection;
use crate::airfoil::span::StationAirfoils;
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
    #[inline(always)]
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
    /// Thin sections: one value per station at three quarters of the chord, with derivatives.
    ThreeQuarter {
        /// Law of the sections.
        law: ThinSection,
        /// Inflow.
        inflow: &'a [S],
    },
    /// Thin sections, held: inflow at the quarter chord turns the lift, that at three quarters makes it.
    TwoLines {
        /// Law of the sections.
        law: ThinSection,
        /// Inflow at the quarter chord.
        quarter: &'a [f64],
        /// Inflow at three quarters, less that of the section's own bound vortex in two dimensions.
        three_quarter: &'a [f64],
    },
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

impl<S: Real> BladeLoads<S> {
    /// Loads without their derivatives.
    pub fn values(&self) -> BladeLoads<f64> {
        let plain = |v: Vec3<S, Hub>| Vec3::new(v.x.re(), v.y.re(), v.z.re());
        BladeLoads {
            modal: std::array::from_fn(|i| self.modal[i].re()),
            force: plain(self.force),
            moment: plain(self.moment),
            aero_force: plain(self.aero_force),
            aero_moment: plain(self.aero_moment),
        }
    }
    /// No loads.
    pub fn zero() -> Self {
        Self {
            modal: [S::zero(); MAX_MODES],
            force: Vec3::zero(),
            moment: Vec3::zero(),
            aero_force: Vec3::zero(),
            aero_moment: Vec3::zero(),
        }
    }
}

/// What surrounds a blade and turns it.
#[derive(Clone, Copy, Debug)]
pub struct BladeEnvironment<'a> {
    /// Section table of every station.
    pub airfoils: &'a StationAirfoils,
    /// Air.
    pub air: Air,
    /// Rotor speed [rad/s].
    pub rotor_speed: f64,
}

/// Rigid motion of the blade axes at one instant.
pub(super) struct Carrier<S> {
    pub(super) velocity: Vec3<S, BladeAxes>,
    pub(super) acceleration: Vec3<S, BladeAxes>,
    pub(super) omega: Vec3<S, BladeAxes>,
    pub(super) omega_dot: Vec3<S, BladeAxes>,
    to_blade: [[S; 3]; 3],
    pub(super) up: Vec3<S, BladeAxes>,
}

impl<S: Real> Carrier<S> {
    /// Blade axes at azimuth `psi`, turned up by `precone`, on a hub in motion `hub`.
    #[inline(always)]
    pub(super) fn new(hub: &HubMotion<S>, psi: S, precone: f64, rotor_speed: f64) -> Self {
        let (s, c) = psi.sin_cos();
        let (sp, cp) = precone.sin_cos();
        let zero = S::zero();
        let to_blade = [[c * cp, s * cp, S::cst(sp)], [-s, c, zero], [-(c * sp), -(s * sp), S::cst(cp)]];
        let spin: Vec3<S, Hub> = Vec3::cst([0.0, 0.0, rotor_speed]);
        Self {
            velocity: turned(&to_blade, hub.velocity),
            acceleration: turned(&to_blade, hub.acceleration_less_gravity),
            omega: turned(&to_blade, hub.omega + spin),
            omega_dot: turned(&to_blade, hub.omega_dot + hub.omega.cross(spin)),
            up: Vec3::cst([sp, 0.0, cp]),
            to_blade,
        }
    }
    #[inline(always)]
    pub(super) fn to_blade(&self, v: Vec3<S, Hub>) -> Vec3<S, BladeAxes> {
        turned(&self.to_blade, v)
    }
    #[inline(always)]
    pub(super) fn to_hub(&self, v: Vec3<S, BladeAxes>) -> Vec3<S, Hub> {
        let m = &self.to_blade;
        Vec3::new(
            m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z,
            m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
            m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z,
        )
    }
}

// functions instead of closures: a closure would not be compiled for the vectors that its caller runs in

/// Components in blade axes, by the rows of the rotation.
#[inline(always)]
fn turned<S: Real>(m: &[[S; 3]; 3], v: Vec3<S, Hub>) -> Vec3<S, BladeAxes> {
    Vec3::new(
        m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
        m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
        m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z,
    )
}

/// Inertia about the principal axes t, c, n, times `v`.
#[inline(always)]
pub(super) fn inertia_times<S: Real>(
    inertia: &[f64; 3],
    m: &SectionMotion<S>,
    v: Vec3<S, BladeAxes>,
) -> Vec3<S, BladeAxes> {
    m.t * (v.dot(m.t) * inertia[0]) + m.c * (v.dot(m.c) * inertia[1]) + m.n * (v.dot(m.n) * inertia[2])
}

/// Force and moment about the hub, blade axes.
pub(super) struct Sum<S> {
    force: Vec3<S, BladeAxes>,
    moment: Vec3<S, BladeAxes>,
}

impl<S: Real> Sum<S> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { force: Vec3::zero(), moment: Vec3::zero() }
    }
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        position: Vec3<S, BladeAxes>,
        force: Vec3<S, BladeAxes>,
        moment: Vec3<S, BladeAxes>,
    ) {
        self.force += force;
        self.moment += position.cross(force) + moment;
    }
}

impl Blade {
    /// Residual of the modal equations and hub loads at azimuth `psi` [rad].
    #[inline(always)]
    pub fn loads<S: Real>(
        &self,
        environment: &BladeEnvironment,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
    ) -> BladeLoads<S> {
        let mut loads = self.structure_loads(environment.rotor_speed, hub, psi, modal, control);
        if !matches!(inflow, BladeInflow::Vacuum) {
            self.add_air_loads(environment, hub, psi, modal, control, inflow, &mut loads);
        }
        loads
    }

    /// Inertia, gravity, strain, damping and the root spring: everything but the air. No branch looks at a value.
    #[inline(always)]
    pub fn structure_loads<S: Real>(
        &self,
        rotor_speed: f64,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
    ) -> BladeLoads<S> {
        let mut loads = self.inertia(rotor_speed, hub, psi, modal, control);
        if self.rigid.is_none() {
            self.add_strain(modal, control, &mut loads.modal);
        }
        self.add_root_loads(modal, &mut loads.modal);
        loads
    }

    /// Adds what the air does.
    #[inline(always)]
    pub fn add_air_loads<S: Real>(
        &self,
        environment: &BladeEnvironment,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
        loads: &mut BladeLoads<S>,
    ) {
        let carrier = Carrier::new(hub, psi, self.precone, environment.rotor_speed);
        let mut aero = Sum::new();
        // numbers with derivatives go station by station: the same loads, half the code to compile
        let done = if S::PLAIN {
            self.add_rigid_air(environment, &carrier, modal, control, inflow, &mut loads.modal, &mut aero)
        } else {
            false
        };
        if !done {
            for j in 0..self.stations.len() {
                let (motion, air) = self.station_air(environment, &carrier, modal, control, inflow, j);
                self.project(&self.stations[j].shapes, &motion, air.force, air.moment, &mut loads.modal);
                aero.add(motion.position, air.force, air.moment);
            }
        }
        (loads.aero_force, loads.aero_moment) = (carrier.to_hub(aero.force), carrier.to_hub(aero.moment));
        loads.force += loads.aero_force;
        loads.moment += loads.aero_moment;
    }

    /// Inertia and gravity alone: all that depends on accelerations.
    #[inline(always)]
    pub fn inertia<S: Real>(
        &self,
        rotor_speed: f64,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
    ) -> BladeLoads<S> {
        let carrier = Carrier::new(hub, psi, self.precone, rotor_speed);
        let mut work = [S::zero(); MAX_MODES];
        let inertial = self.add_inertia(&carrier, modal, control, &mut work);
        BladeLoads {
            modal: work,
            force: carrier.to_hub(inertial.force),
            moment: carrier.to_hub(inertial.moment),
            aero_force: Vec3::zero(),
            aero_moment: Vec3::zero(),
        }
    }

    #[inline(always)]
    fn add_inertia<S: Real>(
        &self,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        work: &mut [S; MAX_MODES],
    ) -> Sum<S> {
        if let Some(body) = &self.rigid {
            return self.rigid_inertia(body, carrier, modal, control, work);
        }
        let mut sum = Sum::new();
        for point in &self.structure {
            let (motion, force, moment) = self.inertial_loads(point, carrier, modal, control);
            self.project(&point.shapes, &motion, force, moment, work);
            sum.add(motion.position, force, moment);
        }
        sum
    }

    #[inline(always)]
    fn add_strain<S: Real>(
        &self,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        work: &mut [S; MAX_MODES],
    ) {
        let mut gradient = [S::zero(); MAX_MODES];
        for point in &self.structure {
            let pitch = control.theta + point.twist;
            add_strain_gradient(
                &point.shapes,
                &point.stiffness,
                self.n_modes,
                &modal.q,
                pitch,
                &mut gradient,
            );
        }
        for i in 0..self.n_modes {
            work[i] -= gradient[i];
        }
    }

    /// Air at every station; velocities need no accelerations, so `modal.q_ddot` is ignored.
    #[inline(always)]
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

    /// Wind of every station without inflow, into `winds`.
    pub fn section_winds(
        &self,
        rotor_speed: f64,
        hub: &HubMotion<f64>,
        psi: f64,
        modal: &ModalMotion<f64>,
        control: &PitchMotion<f64>,
        winds: &mut Vec<SectionWind>,
    ) {
        let carrier = Carrier::new(hub, psi, self.precone, rotor_speed);
        winds.clear();
        winds.extend(self.stations.iter().map(|station| {
            let pitch = PitchMotion { theta: control.theta + station.twist, ..*control };
            let m = station.shapes.motion(self.n_modes, modal, &pitch);
            let wind = -(carrier.velocity + carrier.omega.cross(m.position) + m.velocity);
            let omega = carrier.omega + m.omega;
            SectionWind::new(&station.geometry, &m, wind, omega, carrier.up, rotor_speed * self.radius)
        }));
    }

    #[inline(always)]
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
        // angular momentum about the elastic axis
        let moment = -(m.c.cross(acceleration).scaled(point.first_moment)
            + inertia_times(&point.inertia, &m, omega_dot)
            + omega.cross(inertia_times(&point.inertia, &m, omega)));
        (m, force, moment)
    }

    #[inline(always)]
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
        let (airfoil, air, geometry) = (environment.airfoils.at(j), &environment.air, &station.geometry);
        let thin = match inflow {
            BladeInflow::ThreeQuarter { law, .. } => Some((law, wind)),
            BladeInflow::TwoLines { law, quarter, three_quarter } => {
                let more = (three_quarter[j] - quarter[j]) * tip_speed;
                Some((law, wind - carrier.up.scaled(more)))
            }
            _ => None,
        };
        let air = match thin {
            None => section_air(airfoil, air, geometry, &m, wind, omega),
            Some((law, behind)) => law.air(airfoil, air, geometry, &m, wind, behind, omega),
        };
        (m, air)
    }

    #[inline(always)]
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
            BladeInflow::ThreeQuarter { inflow, .. } => inflow[j],
            BladeInflow::TwoLines { quarter, .. } => S::cst(quarter[j]),
            BladeInflow::Vacuum => S::zero(),
        }
    }

    #[inline(always)]
    pub(super) fn project<S: Real>(
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

    /// Pitch-link spring, hinge springs and structural damping.
    #[inline(always)]
    fn add_root_loads<S: Real>(&self, modal: &ModalMotion<S>, work: &mut [S; MAX_MODES]) {
        let wind_up = combine(&self.root_twist, &modal.q, self.n_modes);
        for i in 0..self.n_modes {
            work[i] -=
                wind_up * (self.control_stiffness * self.root_twist[i]) + modal.q_dot[i] * self.damping[i];
        }
        self.hinge_springs.add_work(&self.root, self.n_modes, &modal.q, work);
    }
}
