//! What a blade passes to its hub, and the sums it is gathered in.

use super::MAX_MODES;
use super::kinematics::BladeAxes;
use crate::numerics::frames::{Hub, Vec3};
use crate::numerics::scalar::Real;

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

/// Force and moment about the hub, blade axes.
pub(super) struct Sum<S> {
    pub(super) force: Vec3<S, BladeAxes>,
    pub(super) moment: Vec3<S, BladeAxes>,
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
