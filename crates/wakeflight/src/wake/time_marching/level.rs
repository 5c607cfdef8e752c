//! The new level of a step: what travels moves on, blades release anew, markers advance and are looked at.

use super::{TimeMarchingWake, Work};
use crate::wake::choices::Form;
use crate::wake::error::WakeError;
use crate::wake::far_wake;
use crate::wake::filament::{aged_core_squared, distance, distance_squared, stretched_core_squared};
use crate::wake::geometry::release_points;
use crate::wake::inboard_sheet;
use crate::wake::instant::RotorInstant;
use crate::wake::motion::{BladeState, HubMotion};
use crate::wake::stencils::Cell;
use crate::wake::vectors::{difference, mean, sum};
use crate::wake::velocity_field::InducedVelocity;

/// Largest motion of a marker in one step, over R.
const LARGEST_DISPLACEMENT: f64 = 0.5;

impl<F: InducedVelocity> TimeMarchingWake<F> {
    /// Registers of the new level: everything that travels with the markers moves on by one, the blades release anew.
    /// Markers are still those of the old level.
    pub(super) fn shift(&self, work: &mut Work, hub: &HubMotion, blades: &[BladeState], circulation: &[f64]) {
        let Work { next, carrier, .. } = work;
        let options = &self.options;
        let (n_k, n_t) = (options.n_segments(), options.trailers_per_blade());
        let (n_r, n_sheet) = (options.n_stations, options.sheet_filaments());
        next.copy(&self.instant);
        next.ground = self.ground;
        carrier.clone_from(&self.carrier);
        let old_carry = inboard_sheet::convection(options, &self.hub, self.mean_inflow);
        let new_carry = inboard_sheet::convection(options, hub, self.mean_inflow);
        let drift =
            mean(old_carry, new_carry).map(|v| v * options.delta_psi() / options.rotor.omega * self.pace);
        for (blade, state) in blades.iter().enumerate() {
            let gamma = &circulation[blade * n_r..(blade + 1) * n_r];
            next.place_blade(options, &self.grid, blade, state, gamma);
            for (t, release) in release_points(options, &self.grid, state).into_iter().enumerate() {
                let m = next.free.marker(blade * n_t + t, 0);
                next.free.circulation.copy_within(m..m + n_k, m + 1);
                carrier.copy_within(m..m + n_k, m + 1);
                carrier[m] = match options.form {
                    Form::Displacement => release,
                    Form::Position => [0.0; 3],
                };
                next.free.position[m] = release;
            }
            if n_sheet > 0 {
                for (s, point) in inboard_sheet::release_points(options, state).into_iter().enumerate() {
                    let m = next.sheet.marker(blade * n_sheet + s, 0);
                    next.sheet.circulation.copy_within(m..m + n_k, m + 1);
                    for k in (1..=n_k).rev() {
                        next.sheet.position[m + k] = sum(self.instant.sheet.position[m + k - 1], drift);
                    }
                    next.sheet.position[m] = point;
                }
            }
            next.release(options, &self.grid, blade, gamma);
        }
    }

    /// Unknown at the new level into `new`; `corner` gives that of a cell whose marker k is the one of the index.
    pub(super) fn march(
        &self,
        next: &RotorInstant,
        carrier: &[[f64; 3]],
        corner: impl Fn(&Cell, usize) -> [f64; 3],
        new: &mut Vec<[f64; 3]>,
    ) {
        let [now, past, older] = &self.levels;
        new.resize(now.len(), [0.0; 3]);
        let first = |filament: usize| next.free.marker(filament, 0);
        for m in (0..next.free.n_filaments).map(first) {
            new[m] = difference(next.free.position[m], carrier[m]);
        }
        // age by age: along a filament each cell waits for the one before, the filaments do not wait for each other
        for k in 0..self.options.n_segments() {
            for m in (0..next.free.n_filaments).map(first) {
                let i = m + k;
                let cell = Cell {
                    b: now[i + 1],
                    c: new[i],
                    d: now[i],
                    e: past[i + 1],
                    f: past[i],
                    g: older[i + 1],
                    h: older[i],
                    i: (k > 0).then(|| past[i - 1]),
                };
                new[i + 1] = corner(&cell, i);
            }
        }
    }

    /// Positions and cores of the new level from its unknown.
    pub(super) fn place_markers(&self, next: &mut RotorInstant, carrier: &[[f64; 3]], unknown: &[[f64; 3]]) {
        let n_k = self.options.n_segments();
        for (i, position) in next.free.position.iter_mut().enumerate() {
            if i % (n_k + 1) != 0 {
                *position = sum(carrier[i], unknown[i]);
            }
        }
        far_wake::join(&self.options, &mut next.far, &next.free);
        let old = &self.instant.free;
        if !self.options.core_stretching {
            // at one pace the age tells the core, which then stays with its place on the filament
            if self.uneven {
                let r2 = self.options.rotor.radius.powi(2);
                let growth = self.options.core_growth * r2 * self.options.delta_psi() * self.pace;
                for row in 0..old.n_filaments {
                    for k in (row * n_k + 1..(row + 1) * n_k).rev() {
                        next.free.core_squared[k] = old.core_squared[k - 1] + growth;
                    }
                }
            }
            return;
        }
        for filament in 0..old.n_filaments {
            let release = self.options.release_core(filament % self.options.trailers_per_blade());
            next.free.core_squared[filament * n_k] = aged_core_squared(&self.options, release, 0);
            for k in 1..n_k {
                next.free.core_squared[filament * n_k + k] = stretched_core_squared(
                    &self.options,
                    release,
                    old.core_squared[filament * n_k + k - 1],
                    [old.segment_length(filament, k - 1), next.free.segment_length(filament, k)],
                    self.pace,
                );
            }
        }
    }

    /// Largest motion of a marker over R; an error beyond the limit or if a position is not finite.
    pub(super) fn guard(&self, next: &RotorInstant) -> Result<f64, WakeError> {
        let radius = self.options.rotor.radius;
        let (mut largest, mut finite) = (0.0f64, true);
        for filament in 0..next.free.n_filaments {
            let m = next.free.marker(filament, 0);
            let n = self.options.n_segments();
            let markers = &next.free.position[m + 1..=m + n];
            for (marker, before) in markers.iter().zip(&self.instant.free.position[m..m + n]) {
                let squared = distance_squared(*marker, *before);
                // the larger of a number and what is none is the number
                finite &= !squared.is_nan();
                largest = largest.max(squared);
            }
        }
        // roots keep the order: one does for all
        let displacement = largest.sqrt() / radius;
        if finite && displacement <= LARGEST_DISPLACEMENT {
            return Ok(displacement);
        }
        match self.too_far(next) {
            None => Ok(displacement),
            Some((filament, marker, displacement)) => {
                let (limit, step) = (LARGEST_DISPLACEMENT, self.steps + 1);
                Err(WakeError::Diverged { filament, marker, displacement, limit, step })
            }
        }
    }

    /// The first marker that has moved beyond the limit: filament, marker and motion over R.
    fn too_far(&self, next: &RotorInstant) -> Option<(usize, usize, f64)> {
        let n = self.options.n_segments();
        let markers = (0..next.free.n_filaments).flat_map(|filament| (1..=n).map(move |k| (filament, k)));
        let mut moved = markers.map(|(filament, k)| {
            let m = next.free.marker(filament, k);
            let motion = distance(next.free.position[m], self.instant.free.position[m - 1]);
            (filament, k, motion / self.options.rotor.radius)
        });
        moved.find(|(.., motion)| motion.is_nan() || *motion > LARGEST_DISPLACEMENT)
    }
}
