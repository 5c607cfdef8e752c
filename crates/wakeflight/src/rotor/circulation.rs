//! Bound circulation and near wake solved together, at every exchange between wake and flight dynamics.
//!
//! Held: the far inflow, the motion of blade and hub. Solved: Gamma_i = Gamma_section_i(lambda_far_i + sum_j N_ij Gamma_j).

use super::hub::Rotor;
use crate::blade::aerodynamics::{Air, SectionWind};
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::loads::HubMotion;
use crate::numerics::scalar::Dual;
use crate::wake::{
    BladeState, CirculationSolution, HubMotion as WakeHub, WakeError, WakeOptions, near_wake_matrix,
    solve_circulation,
};

/// Circulation of several blade instants, each solved with its near wake.
#[derive(Clone, Debug, Default)]
pub struct Circulations {
    /// Bound circulation (n_instants, n_stations) [m2/s].
    pub gamma: Vec<f64>,
    /// Total induced inflow that belongs to it (n_instants, n_stations).
    pub inflow: Vec<f64>,
    /// Largest residual [m2/s].
    pub residual: f64,
    /// Instants that did not converge.
    pub not_converged: usize,
}

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

impl Rotor {
    /// Circulation [m2/s] at every station for inflow `lambda`, and its derivative by the inflow there.
    pub fn section_circulation(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blade: &BladeInstant,
        lambda: &[f64],
        circulation: &mut [f64],
        slope: &mut [f64],
    ) {
        self.circulation_of(air, &self.section_winds(hub, blade), lambda, circulation, slope);
    }

    fn section_winds(&self, hub: &HubMotion<f64>, blade: &BladeInstant) -> Vec<SectionWind> {
        let mut winds = Vec::with_capacity(self.blade.stations.len());
        self.blade.section_winds(self.omega, hub, blade.psi, &blade.modal, &blade.control, &mut winds);
        winds
    }

    fn circulation_of(
        &self,
        air: Air,
        winds: &[SectionWind],
        lambda: &[f64],
        circulation: &mut [f64],
        slope: &mut [f64],
    ) {
        for (j, wind) in winds.iter().enumerate() {
            // a station's circulation depends on its own inflow alone
            let gamma = wind.circulation(&self.airfoil, &air, Dual::<1>::variable(lambda[j], 0));
            (circulation[j], slope[j]) = (gamma.re, gamma.eps[0]);
        }
    }

    /// Circulation and total inflow of one blade for the held far inflow and the near-wake matrix (n, n).
    pub fn blade_circulation(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blade: &BladeInstant,
        lambda_far: &[f64],
        near_wake: &[f64],
        start: &[f64],
    ) -> Result<CirculationSolution, WakeError> {
        let radius = self.blade.radius;
        // slopes are kept between -3 c and 0 (per tip speed): beyond stall the sign would turn Newton away
        let floor: Vec<f64> =
            self.blade.stations.iter().map(|s| -3.0 * s.geometry.chord * self.tip_speed()).collect();
        // the motion of the sections does not change while the circulation is sought
        let winds = self.section_winds(hub, blade);
        solve_circulation(
            lambda_far,
            near_wake,
            |lambda, circulation, slope| self.circulation_of(air, &winds, lambda, circulation, slope),
            start,
            &floor,
            1e-8 * self.omega * radius * radius,
        )
    }

    /// Circulation and near wake of several blade instants for held far inflow; `lambda_far` and `start` row by row.
    pub fn circulations(
        &self,
        air: Air,
        options: &WakeOptions,
        hub: &HubMotion<f64>,
        instants: &[BladeInstant],
        lambda_far: &[f64],
        start: &[f64],
    ) -> Result<Circulations, WakeError> {
        let n = self.blade.stations.len();
        let wake_hub = WakeHub { velocity: hub.velocity.array(), rates: hub.omega.array() };
        let mut all = Circulations::default();
        for (i, blade) in instants.iter().enumerate() {
            let (flap, lead) = self.equivalent_angles(&blade.modal);
            let matrix = near_wake_matrix(options, &wake_hub, &BladeState { psi: blade.psi, flap, lead })?;
            let row = i * n..(i + 1) * n;
            let solution =
                self.blade_circulation(air, hub, blade, &lambda_far[row.clone()], &matrix, &start[row])?;
            all.residual = all.residual.max(solution.residual);
            all.not_converged += usize::from(!solution.converged);
            all.gamma.extend(solution.gamma);
            all.inflow.extend(solution.inflow);
        }
        Ok(all)
    }
}
