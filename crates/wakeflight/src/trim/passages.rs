//! Passages of the blades of a trimmed motion: loads and air at any azimuth, in the inflow of the trim or one given.

use super::error::ProblemError;
use super::host::Host;
use super::residual::Trim;
use crate::airfoil::unsteady::Memory;
use crate::blade::memory_rows::MemoryRows;
use crate::blade::sections_in_time::BladePast;
use crate::blade::surroundings::BladeInflow;
use crate::rotor::circulation::BladeInstant;
use crate::rotor::passages::Passages;
use crate::rotor::speed::Turning;
use std::f64::consts::TAU;

impl<H: Host> Trim<'_, H> {
    /// At azimuths `psi` [rad] of the motion `x`, in the total inflow given (n, one row of the rotor's inflow each), or in that of
    /// the states where the trim has them; with the memory given (n,) of sections that remember, or that of the trim.
    pub fn passages(
        &self,
        x: &[f64],
        psi: &[f64],
        inflow: Option<&[f64]>,
        memory: Option<&MemoryRows>,
    ) -> Result<Passages, ProblemError> {
        if inflow.is_none() && !self.problem.is_dynamic() {
            return Err(ProblemError::NoInflow);
        }
        let (head, rotor) = (self.layout.head(x), self.host.rotor());
        if let Some(given) = memory
            && !rotor.remembers(given, psi.len())
        {
            return Err(ProblemError::Memory { rows: given.shape()[0], needed: psi.len() });
        }
        let hub = self.host.carried(&head).hub;
        let width = inflow.map_or(0, |map| map.len().checked_div(psi.len()).unwrap_or(0));
        let turning = Turning::steady(rotor.omega);
        let own = if memory.is_none() { self.memory(x) } else { MemoryRows::default() };
        let passages = psi.iter().enumerate().map(|(row, &psi)| {
            let given = match inflow {
                Some(map) => rotor.held_inflow(&map[row * width..(row + 1) * width]),
                None => BladeInflow::Disk(head.inflow),
            };
            let past = match memory {
                Some(given) => given.step(row, 0.0),
                None => self.past(&own, psi),
            };
            let control = rotor.blade_pitch(head.controls, [0.0; 4], psi, turning).into();
            let instant = BladeInstant { psi, modal: self.motion(x, psi), control };
            (instant, given.remembering(rotor.sections_in_time(past)))
        });
        Ok(rotor.passages(self.host.air(), &hub, passages))
    }

    /// Memory of a blade's sections at azimuth `psi` [rad], from the `memory` of the trim at its azimuths.
    pub fn kept_at(&self, x: &[f64], memory: &MemoryRows, psi: f64) -> Vec<Memory> {
        let (head, rotor) = (self.layout.head(x), self.host.rotor());
        let hub = self.host.carried(&head).hub;
        let control = self.host.blade_pitch(&self.host.pitch(head.controls), psi);
        let instant = BladeInstant { psi, modal: self.motion(x, psi), control };
        let inflow = self.inflow(&head, self.azimuth_before(psi).0);
        rotor.kept(self.host.air(), &hub, &instant, &inflow, self.past(memory, psi))
    }

    /// What is known at azimuth `psi` [rad] from the `memory` of the trim at its azimuths.
    pub fn past<'m>(&self, memory: &'m MemoryRows, psi: f64) -> Option<BladePast<'m>> {
        let (row, share) = self.azimuth_before(psi);
        memory.step(row, share * self.host.rotor().nominal_step(self.problem.n_azimuths))
    }

    /// The azimuth of the trim at or before `psi` [rad], and the share of the way to the next one.
    fn azimuth_before(&self, psi: f64) -> (usize, f64) {
        let n = self.problem.n_azimuths;
        let passed = psi / TAU * n as f64;
        // rounding does not lead into the step before
        let row = (passed + 1e-9).floor();
        (row.rem_euclid(n as f64) as usize % n, (passed - row).max(0.0))
    }
}
