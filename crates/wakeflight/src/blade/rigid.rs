//! A blade that keeps its shape: one body about its hinge, and stations that share its triad.
//!
//! All structural points turn with the root triad (t, c, n), so that their mass, first moment and inertia about the hinge
//! are constants in it. With a_h the acceleration of the hinge less gravity and w the angular velocity of the triad,
//! force = -(m a_h + w_dot x s + w x (w x s)), moment about the hinge = -(s x a_h + J w_dot + w x J w). The wind grows
//! linearly with the distance from the hinge, and twist turns it by a constant angle. Nothing is left out: the loads are
//! those of the points and stations one by one, to rounding.

use super::MAX_MODES;
use super::aerodynamics::{Strengths, section_flow, section_strengths};
use super::held_row::HeldRow;
use super::hub_loads::Sum;
use super::hub_motion::{Carrier, HubMotion};
use super::kinematics::{BladeAxes, ModalMotion, PitchMotion};
use super::model::Blade;
use super::rigid_body::RigidBlade;
use super::surroundings::{BladeEnvironment, BladeInflow};
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::scalar::Real;

/// Inflow along a straight span.
enum StraightInflow<'a, S> {
    /// At the hinge, and its slope with the distance from it [1/m].
    Linear([S; 2]),
    /// One value per station, held.
    Held(HeldRow<'a>),
    /// One value per station, with derivatives.
    Variable(&'a [S]),
}

impl<'a, S: Real> StraightInflow<'a, S> {
    /// Inflow along the tangent `span` from the hinge; none for thin sections, whose inflow has two lines.
    #[inline(always)]
    fn of(
        blade: &Blade,
        inflow: &BladeInflow<'a, S>,
        carrier: &Carrier<S>,
        span: Vec3<S, BladeAxes>,
    ) -> Option<Self> {
        match inflow {
            BladeInflow::Disk([mean, sine, cosine]) => {
                let hinge = carrier.to_hub(Vec3::cst([blade.root_station, 0.0, 0.0]));
                let span = carrier.to_hub(span);
                Some(Self::Linear([
                    *mean + (*cosine * hinge.x + *sine * hinge.y) / blade.radius,
                    (*cosine * span.x + *sine * span.y) / blade.radius,
                ]))
            }
            BladeInflow::Stations(values) => Some(Self::Held(*values)),
            BladeInflow::Variable(values) => Some(Self::Variable(values)),
            _ => None,
        }
    }

    #[inline(always)]
    fn at(&self, j: usize, length: f64) -> S {
        match self {
            Self::Linear([at_hinge, slope]) => *at_hinge + *slope * length,
            Self::Held(values) => S::cst(values.at(j)),
            Self::Variable(values) => values[j],
        }
    }
}

impl Blade {
    /// Inertia and gravity of a blade that does not bend; adds their virtual work.
    #[inline(always)]
    pub(super) fn rigid_inertia<S: Real>(
        &self,
        body: &RigidBlade,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        work: &mut [S; MAX_MODES],
    ) -> Sum<S> {
        let m = self.root.motion(self.n_modes, modal, control);
        let (w, w_dot) = (carrier.omega, carrier.omega_dot);
        let omega = w + m.omega;
        let omega_dot = w_dot + w.cross(m.omega) + m.omega_dot;
        let hinge = Vec3::cst([self.root_station, 0.0, 0.0]);
        let acceleration = carrier.acceleration + w_dot.cross(hinge) + w.cross(w.cross(hinge));
        let first = body.first(&m);
        let force =
            -(acceleration.scaled(body.mass) + omega_dot.cross(first) + omega.cross(omega.cross(first)));
        let moment = -(first.cross(acceleration)
            + body.inertia_times(&m, omega_dot)
            + omega.cross(body.inertia_times(&m, omega)));
        self.project(&self.root, &m, force, moment, work);
        let mut sum = Sum::new();
        sum.add(hinge, force, moment);
        sum
    }

    /// Air of a blade that does not bend: adds its virtual work and returns its loads on the hub; none where there is no such
    /// blade, or thin sections stand on it.
    #[inline(always)]
    pub(super) fn add_rigid_air<S: Real>(
        &self,
        environment: &BladeEnvironment,
        carrier: &Carrier<S>,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
        work: &mut [S; MAX_MODES],
    ) -> Option<Sum<S>> {
        let body = self.rigid.as_ref().filter(|_| !environment.yawed_drag)?;
        let m = self.root.motion(self.n_modes, modal, control);
        let inflow = StraightInflow::of(self, inflow, carrier, m.t)?;
        let omega = carrier.omega + m.omega;
        let hinge = Vec3::cst([self.root_station, 0.0, 0.0]);
        // wind without inflow at the hinge and its growth along the span, and inflow of one, along c and n
        let (start, growth) = (-(carrier.velocity + carrier.omega.cross(hinge)), -omega.cross(m.t));
        let (start_c, start_n) = (start.dot(m.c), start.dot(m.n));
        let (growth_c, growth_n) = (growth.dot(m.c), growth.dot(m.n));
        let tip_speed = environment.rotor_speed * self.radius;
        let (up_c, up_n) = (carrier.up.dot(m.c) * tip_speed, carrier.up.dot(m.n) * tip_speed);
        let pitch_rate = omega.dot(m.t);

        let zero = S::zero();
        let (mut force_c, mut force_n, mut first_c, mut first_n, mut twisting) =
            (zero, zero, zero, zero, zero);
        for j in 0..self.stations.len() {
            let ([length, sine, cosine], geometry) = (body.stations[j], &self.stations[j].geometry);
            let lambda = inflow.at(j, length);
            let at_c = start_c + growth_c * length - up_c * lambda;
            let at_n = start_n + growth_n * length - up_n * lambda;
            let wind_c = at_c * cosine + at_n * sine;
            let wind_n = at_n * cosine - at_c * sine;
            let quarter_n = wind_n - pitch_rate * geometry.quarter;
            let three_quarter_n = wind_n - pitch_rate * geometry.three_quarter;
            let flow = section_flow(
                environment.airfoils.at(j),
                &environment.air,
                wind_c,
                quarter_n,
                three_quarter_n,
            );
            let coefficients = [flow.cl, flow.cd, flow.cm];
            let Strengths { lift, drag, about_quarter } =
                section_strengths(&environment.air, geometry, flow.speed, pitch_rate, coefficients);
            let along = lift * quarter_n + drag * wind_c;
            let normal = drag * quarter_n - lift * wind_c;
            let (c, n) = (along * cosine - normal * sine, along * sine + normal * cosine);
            force_c += c;
            force_n += n;
            first_c += c * length;
            first_n += n * length;
            twisting += about_quarter + normal * geometry.quarter;
        }
        let force = m.c * force_c + m.n * force_n;
        let moment = m.t * twisting + m.n * first_c - m.c * first_n;
        self.project(&self.root, &m, force, moment, work);
        let mut aero = Sum::new();
        aero.add(hinge, force, moment);
        Some(aero)
    }
}

/// What the accelerations of hub and hinges do to a blade that does not bend, hub axes.
#[derive(Clone, Copy, Debug)]
pub struct RigidInertia {
    /// Mass [kg].
    pub mass: f64,
    /// Hinge from the hub centre [m].
    pub hinge: Vec3<f64, Hub>,
    /// First moment about the hinge [kg m].
    pub first_moment: Vec3<f64, Hub>,
    /// Inertia about the hinge times the three hub axes [kg m2].
    pub inertia: [Vec3<f64, Hub>; 3],
    /// Turn per modal coordinate; as many as there are modes.
    pub turns: [Vec3<f64, Hub>; MAX_MODES],
}

impl Blade {
    /// Inertia at azimuth `psi` [rad] for the present deflection and pitch; none where the blade bends.
    pub fn inertia_about_hinge(
        &self,
        psi: f64,
        modal: &ModalMotion<f64>,
        control: &PitchMotion<f64>,
    ) -> Option<RigidInertia> {
        let body = self.rigid.as_ref()?;
        let still = Vec3::zero();
        let at_rest =
            HubMotion { velocity: still, acceleration_less_gravity: still, omega: still, omega_dot: still };
        let carrier = Carrier::new(&at_rest, psi, self.precone, 0.0);
        let m = self.root.motion(self.n_modes, modal, control);
        let [t, c, n] = [m.t, m.c, m.n].map(|v| carrier.to_hub(v).array());
        let j = &body.inertia;
        let column = |k: usize| {
            let (a, b, d) = (t[k], c[k], n[k]);
            let part = |i: usize| j[i][0] * a + j[i][1] * b + j[i][2] * d;
            let (x, y, z) = (part(0), part(1), part(2));
            Vec3::new(
                t[0] * x + c[0] * y + n[0] * z,
                t[1] * x + c[1] * y + n[1] * z,
                t[2] * x + c[2] * y + n[2] * z,
            )
        };
        let mut turns = [Vec3::zero(); MAX_MODES];
        for (i, turn) in turns.iter_mut().enumerate().take(self.n_modes) {
            *turn = carrier.to_hub(m.test_motion(&self.root, i).1);
        }
        Some(RigidInertia {
            mass: body.mass,
            hinge: carrier.to_hub(Vec3::cst([self.root_station, 0.0, 0.0])),
            first_moment: carrier.to_hub(body.first(&m)),
            inertia: [column(0), column(1), column(2)],
            turns,
        })
    }
}
