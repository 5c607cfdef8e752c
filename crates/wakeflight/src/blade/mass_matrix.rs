//! Inertia of a blade by the accelerations of hub and modes: what F has of y_dot, without differentiating it.
//!
//! A test motion moves the elastic axis of a section by `shift` and turns it by `turn`. By Newton and Euler the section then
//! carries the momentum m shift + s turn x c and, about its elastic axis, s c x shift + J turn. Modes and turns of the hub
//! are test motions; their momenta summed over the span are the rows of the mass matrix. So is the turn of the rotor, which the
//! swashplate makes a pitch of the blade as well.

use super::MAX_MODES;
use super::hub_motion::{Carrier, HubMotion};
use super::kinematics::{BladeAxes, ModalMotion, PitchMotion, SectionMotion};
use super::model::Blade;
use super::stations::StructuralPoint;
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::scalar::Real;

/// Mass matrix of one blade, hub axes about the hub centre. The loads it passes on are minus these times the accelerations.
#[derive(Clone, Copy, Debug)]
pub struct BladeMass<S> {
    /// Modal forces by modal accelerations (n_modes, n_modes) [1].
    pub own: [[S; MAX_MODES]; MAX_MODES],
    /// Force on the hub by modal accelerations; also modal forces by acceleration of the hub [kg^1/2].
    pub force: [Vec3<S, Hub>; MAX_MODES],
    /// Moment about the hub by modal accelerations; also modal forces by angular acceleration [m kg^1/2].
    pub moment: [Vec3<S, Hub>; MAX_MODES],
    /// First moment about the hub centre [kg m].
    pub first_moment: Vec3<S, Hub>,
    /// Inertia about the hub centre times each hub axis [kg m2].
    pub inertia: [Vec3<S, Hub>; 3],
}

/// What the rate of a rotor's speed does to one blade, hub axes about the hub centre: a column of a mass matrix.
#[derive(Clone, Copy, Debug)]
pub struct TurnMass<S> {
    /// Modal forces [m kg^1/2].
    pub own: [S; MAX_MODES],
    /// Force on the hub [kg m].
    pub force: Vec3<S, Hub>,
    /// Moment about the hub [kg m2].
    pub moment: Vec3<S, Hub>,
}

/// Momentum of a section and angular momentum about its elastic axis.
#[inline(always)]
fn momentum<S: Real>(
    point: &StructuralPoint,
    m: &SectionMotion<S>,
    shift: Vec3<S, BladeAxes>,
    turn: Vec3<S, BladeAxes>,
) -> (Vec3<S, BladeAxes>, Vec3<S, BladeAxes>) {
    let linear = shift.scaled(point.mass) + turn.cross(m.c).scaled(point.first_moment);
    let angular = m.c.cross(shift).scaled(point.first_moment) + point.inertia_times(m, turn);
    (linear, angular)
}

impl Blade {
    /// Mass matrix at azimuth `psi` [rad] in the present deflection and pitch. `pitched`: acceleration of the blade's pitch by the rate
    /// of a speed that is a state; with it what that rate does, modal forces and force and moment on the hub. No branch looks at a
    /// value.
    #[inline(always)]
    pub fn mass_matrix<S: Real>(
        &self,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        pitched: Option<S>,
    ) -> (BladeMass<S>, Option<TurnMass<S>>) {
        let (n, zero) = (self.n_modes, Vec3::zero());
        let still: Vec3<S, Hub> = Vec3::zero();
        let at_rest =
            HubMotion { velocity: still, acceleration_less_gravity: still, omega: still, omega_dot: still };
        let carrier = Carrier::new(&at_rest, psi, self.precone, 0.0);
        // the hub's axes in blade axes: turns about them are test motions
        let axes: [Vec3<S, BladeAxes>; 3] = [
            carrier.to_blade(Vec3::cst([1.0, 0.0, 0.0])),
            carrier.to_blade(Vec3::cst([0.0, 1.0, 0.0])),
            carrier.to_blade(Vec3::cst([0.0, 0.0, 1.0])),
        ];
        let mut own = [[S::zero(); MAX_MODES]; MAX_MODES];
        let (mut force, mut moment) = ([zero; MAX_MODES], [zero; MAX_MODES]);
        let (mut first, mut inertia) = (zero, [zero; 3]);
        let mut turned = TurnMass { own: [S::zero(); MAX_MODES], force: still, moment: still };
        let (mut turned_force, mut turned_moment) = (zero, zero);
        for point in &self.structure {
            let pitch = PitchMotion { theta: control.theta + point.twist, ..*control };
            let m = point.shapes.motion(n, modal, &pitch);
            first += m.position.scaled(point.mass) + m.c.scaled(point.first_moment);
            for k in 0..3 {
                let (linear, angular) = momentum(point, &m, axes[k].cross(m.position), axes[k]);
                inertia[k] += m.position.cross(linear) + angular;
            }
            let mut motions = [(zero, zero); MAX_MODES];
            for i in 0..n {
                motions[i] = m.test_motion(&point.shapes, i);
                let (linear, angular) = momentum(point, &m, motions[i].0, motions[i].1);
                force[i] += linear;
                moment[i] += m.position.cross(linear) + angular;
                for j in 0..=i {
                    own[i][j] += linear.dot(motions[j].0) + angular.dot(motions[j].1);
                }
            }
            if let Some(pitched) = pitched {
                let shaft = axes[2];
                let (linear, angular) = momentum(point, &m, shaft.cross(m.position), shaft + m.t * pitched);
                turned_force += linear;
                turned_moment += m.position.cross(linear) + angular;
                for i in 0..n {
                    turned.own[i] += linear.dot(motions[i].0) + angular.dot(motions[i].1);
                }
            }
        }
        for i in 0..n {
            for j in 0..i {
                own[j][i] = own[i][j];
            }
        }
        let (mut hub_force, mut hub_moment) = ([still; MAX_MODES], [still; MAX_MODES]);
        for i in 0..n {
            hub_force[i] = carrier.to_hub(force[i]);
            hub_moment[i] = carrier.to_hub(moment[i]);
        }
        (turned.force, turned.moment) = (carrier.to_hub(turned_force), carrier.to_hub(turned_moment));
        let mass = BladeMass {
            own,
            force: hub_force,
            moment: hub_moment,
            first_moment: carrier.to_hub(first),
            inertia: [carrier.to_hub(inertia[0]), carrier.to_hub(inertia[1]), carrier.to_hub(inertia[2])],
        };
        (mass, pitched.map(|_| turned))
    }
}
