//! Passages of the blades of a trimmed motion: loads and air at any azimuth, in the inflow of the trim or one given.

use super::error::ProblemError;
use super::host::Host;
use super::residual::Trim;
use crate::blade::surroundings::BladeInflow;
use crate::rotor::circulation::BladeInstant;
use crate::rotor::passages::Passages;
use crate::rotor::speed::Turning;

impl<H: Host> Trim<'_, H> {
    /// At azimuths `psi` [rad] of the motion `x`, in the total inflow given (n, one row of the rotor's inflow each), or in that of
    /// the states where the trim has them.
    pub fn passages(&self, x: &[f64], psi: &[f64], inflow: Option<&[f64]>) -> Result<Passages, ProblemError> {
        if inflow.is_none() && !self.problem.is_dynamic() {
            return Err(ProblemError::NoInflow);
        }
        let (head, rotor) = (self.layout.head(x), self.host.rotor());
        let hub = self.host.carried(&head).hub;
        let width = inflow.map_or(0, |map| map.len().checked_div(psi.len()).unwrap_or(0));
        let turning = Turning::steady(rotor.omega);
        let passages = psi.iter().enumerate().map(|(row, &psi)| {
            let given = match inflow {
                Some(map) => rotor.held_inflow(&map[row * width..(row + 1) * width]),
                None => BladeInflow::Disk(head.inflow),
            };
            let control = rotor.blade_pitch(head.controls, [0.0; 4], psi, turning).into();
            (BladeInstant { psi, modal: self.motion(x, psi), control }, given)
        });
        Ok(rotor.passages(self.host.air(), &hub, passages))
    }
}
