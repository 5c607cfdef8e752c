//! Bound circulation and near wake solved together, at every exchange between wake and flight dynamics.
//!
//! Held: the far inflow, the motion of blade and hub. Solved: Gamma_i = Gamma_section_i(lambda_far_i + sum_j N_ij Gamma_j).

use super::model::Aircraft;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::loads::{BladeInflow, HubMotion};
use crate::numerics::scalar::{Dual, Real};
use crate::wake::{CirculationSolution, WakeError, solve_circulation};

/// A blade at one instant.
#[derive(Clone, Copy, Debug)]
pub struct BladeInstant {
    /// Azimuth [rad].
    pub psi: f64,
    /// Modal motion; accelerations are not used.
    pub modal: ModalMotion<f64>,
    /// Pitch from the swashplate.
    pub control: PitchMotion<f64>,
}

impl Aircraft {
    /// Circulation [m2/s] at every station for inflow `lambda`, and its derivative by the inflow there.
    pub fn section_circulation(
        &self,
        hub: &HubMotion<f64>,
        blade: &BladeInstant,
        lambda: &[f64],
        circulation: &mut [f64],
        slope: &mut [f64],
    ) {
        type D = Dual<1>;
        // a station's circulation depends on its own inflow alone: one direction serves all
        let inflow: Vec<D> = lambda.iter().map(|&l| D::variable(l, 0)).collect();
        let constant = |m: [f64; crate::blade::MAX_MODES]| m.map(D::cst);
        let modal = ModalMotion {
            q: constant(blade.modal.q),
            q_dot: constant(blade.modal.q_dot),
            q_ddot: constant(blade.modal.q_ddot),
        };
        let c = &blade.control;
        let control = PitchMotion {
            theta: D::cst(c.theta),
            theta_dot: D::cst(c.theta_dot),
            theta_ddot: D::cst(c.theta_ddot),
        };
        self.rotor.blade_air(
            self.air,
            &hub.constant(),
            blade.psi,
            &modal,
            &control,
            &BladeInflow::Variable(&inflow),
            |j, air, _| {
                circulation[j] = air.circulation.re;
                slope[j] = air.circulation.eps[0];
            },
        );
    }

    /// Circulation and total inflow of one blade for the held far inflow and the near-wake matrix (n, n).
    pub fn blade_circulation(
        &self,
        hub: &HubMotion<f64>,
        blade: &BladeInstant,
        lambda_far: &[f64],
        near_wake: &[f64],
        start: &[f64],
    ) -> Result<CirculationSolution, WakeError> {
        let radius = self.rotor.blade.radius;
        // slopes are kept between -3 c and 0 (per tip speed): beyond stall the sign would turn Newton away
        let floor: Vec<f64> = self
            .rotor
            .blade
            .stations
            .iter()
            .map(|s| -3.0 * s.geometry.chord * self.rotor.tip_speed())
            .collect();
        solve_circulation(
            lambda_far,
            near_wake,
            |lambda, circulation, slope| self.section_circulation(hub, blade, lambda, circulation, slope),
            start,
            &floor,
            1e-8 * self.rotor.omega * radius * radius,
        )
    }
}
