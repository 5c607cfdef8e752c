//! One sweep: velocity of the geometry and of the predicted one, their mean taken along the characteristics.

use super::{Norms, RelaxationWake};
use crate::wake::error::WakeError;
use crate::wake::stencils;
use crate::wake::velocity_field::{InducedVelocity, Wanted, field_at};

impl<F: InducedVelocity> RelaxationWake<F> {
    /// Velocity over omega of every marker of a geometry (n_azimuths, n_trailers, n_segments + 1) [m].
    fn velocity(&mut self, position: &[[f64; 3]], core_squared: &[f64]) -> Vec<[f64; 3]> {
        let n_t = self.options.trailers_per_blade();
        let markers = n_t * (self.options.n_segments() + 1);
        let mut velocity = vec![[0.0; 3]; position.len()];
        let mut at_instant = Vec::new();
        let far = self.far_of(position);
        for l in 0..self.options.steps_per_revolution() / self.options.rotor.n_blades {
            let instant = self.instant_of(l, position, core_squared, &far);
            let wanted = Wanted { markers: Some((&self.hub, &mut at_instant)), ..Wanted::default() };
            self.evaluations += field_at(&self.field, &self.options, &instant, &mut self.work, wanted);
            for blade in 0..self.options.rotor.n_blades {
                let to = self.index(self.blade_row(l, blade), 0, 0);
                let from = instant.free.marker(blade * n_t, 0);
                for i in 0..markers {
                    velocity[to + i] = at_instant[from + i].map(|v| v / self.options.rotor.omega * self.pace);
                }
            }
        }
        velocity
    }

    /// Geometry from a velocity field: every marker advanced along its characteristic.
    fn advanced(&self, velocity: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let (step, n_t) = (self.options.delta_psi(), self.options.trailers_per_blade());
        let mut position = vec![[0.0; 3]; self.position.len()];
        for (i, release) in self.release.iter().enumerate() {
            position[self.index(0, i, 0)] = *release;
        }
        for k in 1..=self.options.n_segments() {
            for l in 0..self.options.steps_per_revolution() {
                let past = self.row(l, 1);
                for t in 0..n_t {
                    let (a, b) = (self.index(l, t, k), self.index(past, t, k));
                    let (c, d) = (self.index(l, t, k - 1), self.index(past, t, k - 1));
                    let advance: [f64; 3] = std::array::from_fn(|i| {
                        step * 0.25 * (velocity[a][i] + velocity[b][i] + velocity[c][i] + velocity[d][i])
                    });
                    position[a] = stencils::central(position[d], advance);
                }
            }
        }
        position
    }

    pub(super) fn sweep_once(&mut self) -> Result<Norms, WakeError> {
        let position = std::mem::take(&mut self.position);
        let core_squared = std::mem::take(&mut self.core_squared);
        let mut velocity = self.velocity(&position, &core_squared);
        self.position = position;
        self.core_squared = core_squared;

        let predicted = self.advanced(&velocity);
        self.check(&predicted)?;
        let predicted_core = self.cores(&predicted);
        let at_predicted = self.velocity(&predicted, &predicted_core);
        // pseudo-implicit: the predicted geometry enters with half weight
        for (v, p) in velocity.iter_mut().zip(&at_predicted) {
            for c in 0..3 {
                v[c] = 0.5 * (v[c] + p[c]);
            }
        }
        let corrected = self.advanced(&velocity);
        self.check(&corrected)?;

        let n_k = self.options.n_segments();
        let first = self.options.steps_per_revolution();
        let (mut all, mut first_turn) = (0.0, 0.0);
        for (i, new) in corrected.iter().enumerate() {
            let k = i % (n_k + 1);
            let mut change = 0.0;
            for c in 0..3 {
                // blades may have moved since the last sweep: the release points follow them fully
                let weight = if k == 0 { 1.0 } else { self.relaxation };
                let delta = weight * (new[c] - self.position[i][c]);
                self.position[i][c] = if k == 0 { new[c] } else { self.position[i][c] + delta };
                change += delta * delta;
            }
            all += change;
            if k <= first {
                first_turn += change;
            }
        }
        self.core_squared = self.cores(&self.position);
        self.sweeps += 1;
        let lines = self.release.len() as f64;
        Ok(Norms {
            all: (all / (lines * (n_k + 1) as f64)).sqrt() / self.options.rotor.radius,
            first_turn: (first_turn / (lines * (first + 1) as f64)).sqrt() / self.options.rotor.radius,
        })
    }

    /// Refuses a geometry that is not finite.
    fn check(&self, position: &[[f64; 3]]) -> Result<(), WakeError> {
        match position.iter().position(|p| p.iter().any(|v| !v.is_finite())) {
            None => Ok(()),
            Some(i) => Err(WakeError::Diverged {
                filament: i / (self.options.n_segments() + 1),
                marker: i % (self.options.n_segments() + 1),
                displacement: f64::NAN,
                limit: f64::INFINITY,
                step: self.sweeps + 1,
            }),
        }
    }
}
