//! Equations of motion of a blade by virtual work, and what it passes to the hub.
//!
//! residual_i = sum over sections [f . dr/dq_i + m . d omega/dq_i_dot] - dU/dq_i - damping_i,
//! with the air, gravity and inertia loads f, m of every section in exact kinematics. The six rigid motions of the
//! hub are six more test motions of the same sums: hinge, damper and pitch-link loads act inside and do not appear.

use super::MAX_MODES;
use super::aerodynamics::{SectionAir, section_air};
use super::hub_loads::{BladeLoads, Sum};
use super::hub_motion::{Carrier, HubMotion};
use super::kinematics::{BladeAxes, ModalMotion, PitchMotion, SectionMotion, combine};
use super::model::Blade;
use super::section_wind::SectionWind;
use super::sections_in_time::{Moving, PlainInflow};
use super::stations::{AeroStation, StructuralPoint};
use super::strain::add_strain_gradient;
use super::surroundings::{BladeEnvironment, BladeInflow};
use crate::airfoil::unsteady::Flow;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;

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
            let carrier = Carrier::new(hub, psi, self.precone, environment.rotor_speed);
            self.add_air_loads(environment, &carrier, modal, control, inflow, &mut loads);
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

    /// Adds what the air does to a blade whose axes `carrier` moves.
    #[inline(always)]
    pub(crate) fn add_air_loads<S: Real>(
        &self,
        environment: &BladeEnvironment,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
        loads: &mut BladeLoads<S>,
    ) {
        // numbers with derivatives go station by station: the same loads, half the code to compile
        let straight = if S::PLAIN {
            self.add_rigid_air(environment, carrier, modal, control, inflow, &mut loads.modal)
        } else {
            None
        };
        let aero = match straight {
            Some(aero) => aero,
            None => {
                let mut aero = Sum::new();
                for j in 0..self.stations.len() {
                    let (motion, air) = self.station_air(environment, carrier, modal, control, inflow, j);
                    self.project(&self.stations[j].shapes, &motion, air.force, air.moment, &mut loads.modal);
                    aero.add(motion.position, air.force, air.moment);
                }
                aero
            }
        };
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

    /// Air and inflow of every station; velocities need no accelerations, so `modal.q_ddot` is ignored.
    #[inline(always)]
    pub fn air<S: Real>(
        &self,
        environment: BladeEnvironment,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
    ) -> impl Iterator<Item = (SectionAir<S>, S)> {
        let carrier = Carrier::new(hub, psi, self.precone, environment.rotor_speed);
        (0..self.stations.len()).map(move |j| {
            let (motion, air) = self.station_air(&environment, &carrier, modal, control, inflow, j);
            (air, self.inflow_at(inflow, &carrier, &motion, j))
        })
    }

    /// Flow of every station, as sections in time take it; velocities need no accelerations, so `modal.q_ddot` is ignored.
    pub fn flows<'a>(
        &'a self,
        environment: BladeEnvironment<'a>,
        hub: &HubMotion<f64>,
        psi: f64,
        modal: &'a ModalMotion<f64>,
        control: &'a PitchMotion<f64>,
        inflow: &'a BladeInflow<'a, f64>,
    ) -> impl Iterator<Item = Flow<f64>> {
        let carrier = Carrier::new(hub, psi, self.precone, environment.rotor_speed);
        self.stations.iter().enumerate().map(move |(j, station)| {
            let (motion, wind, omega) = self.station_wind(&environment, &carrier, modal, control, inflow, j);
            let moving = Moving { geometry: &station.geometry, motion: &motion, wind, omega };
            moving.flow(environment.air.speed_of_sound)
        })
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
            + point.inertia_times(&m, omega_dot)
            + omega.cross(point.inertia_times(&m, omega)));
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
        let (m, wind, omega) = self.station_wind(environment, carrier, modal, control, inflow, j);
        let tip_speed = environment.rotor_speed * self.radius;
        let (airfoil, air, geometry) =
            (environment.airfoils.at(j), &environment.air, &self.stations[j].geometry);
        let thin = match inflow {
            BladeInflow::TwoLines { law, quarter, three_quarter } => {
                let more = (three_quarter.at(j) - quarter.at(j)) * tip_speed;
                Some((law, wind - carrier.up.scaled(more)))
            }
            _ => None,
        };
        let mut found = match (thin, inflow) {
            (None, BladeInflow::InTime { sections, .. }) => {
                sections.air(j, (airfoil, air), &Moving { geometry, motion: &m, wind, omega })
            }
            (None, _) => section_air(airfoil, air, geometry, &m, wind, omega),
            (Some((law, behind)), _) => law.air(airfoil, air, geometry, &m, [wind, behind], omega),
        };
        if environment.yawed_drag {
            found.turn_drag(airfoil, air, geometry, &m, wind);
        }
        (m, found)
    }

    /// Motion of a station, wind relative to its elastic axis with the inflow in it, and absolute angular velocity.
    #[inline(always)]
    fn station_wind<S: Real>(
        &self,
        environment: &BladeEnvironment,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
        j: usize,
    ) -> (SectionMotion<S>, Vec3<S, BladeAxes>, Vec3<S, BladeAxes>) {
        let station: &AeroStation = &self.stations[j];
        let pitch = PitchMotion { theta: control.theta + station.twist, ..*control };
        let m = station.shapes.motion(self.n_modes, modal, &pitch);
        let lambda = self.inflow_at(inflow, carrier, &m, j);
        let tip_speed = environment.rotor_speed * self.radius;
        let wind = -(carrier.velocity + carrier.omega.cross(m.position) + m.velocity)
            - carrier.up * (lambda * tip_speed);
        let omega = carrier.omega + m.omega;
        (m, wind, omega)
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
            BladeInflow::Disk([mean, sine, cosine])
            | BladeInflow::InTime { inflow: PlainInflow::Disk([mean, sine, cosine]), .. } => {
                let place = carrier.to_hub(m.position);
                *mean + (*cosine * place.x + *sine * place.y) / self.radius
            }
            BladeInflow::DiskAnd([mean, sine, cosine], more)
            | BladeInflow::InTime { inflow: PlainInflow::DiskAnd([mean, sine, cosine], more), .. } => {
                let place = carrier.to_hub(m.position);
                *mean + (*cosine * place.x + *sine * place.y) / self.radius + more[j]
            }
            BladeInflow::DiskAndEach([mean, sine, cosine], more) => {
                let place = carrier.to_hub(m.position);
                *mean + (*cosine * place.x + *sine * place.y) / self.radius + more[j]
            }
            BladeInflow::Stations(values)
            | BladeInflow::InTime { inflow: PlainInflow::Stations(values), .. } => S::cst(values.at(j)),
            BladeInflow::Variable(values)
            | BladeInflow::InTime { inflow: PlainInflow::Variable(values), .. } => values[j],
            BladeInflow::TwoLines { quarter, .. } => S::cst(quarter.at(j)),
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
