//! Blades of the first rotor as the exchange with the air takes them: at the instants of a flight, and of a periodic motion.

use super::instant::Instant;
use super::model::System;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::memory_rows::MemoryRows;
use crate::rotor::circulation::BladeInstant;
use crate::rotor::exchange::{azimuth, row};
use crate::rotor::speed::Turning;

/// Controls of a system, and what they change by in a second; those that it has not are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Controls {
    /// Their values [m, or rad on a stand].
    pub stick: [f64; 4],
    /// Their rates [m/s, or rad/s].
    pub rate: [f64; 4],
    /// How the rotor turns; none at its nominal speed.
    pub turning: Option<Turning>,
}

impl Controls {
    /// Controls that do not move.
    pub fn held(stick: [f64; 4]) -> Self {
        Self { stick, ..Self::default() }
    }
}

impl System {
    /// How the first rotor turns in the states `y` after `step` steps of azimuth, of which a revolution has `n`; the rate of a speed
    /// that is a state is left out: no air feels it.
    pub fn turning_after(&self, (step, n): (usize, usize), y: &[f64]) -> Turning {
        let rotor = self.main();
        if let Some(place) = self.layout.main().spin() {
            return Turning::steady(y[place.speed]);
        }
        let reached = |step: usize| rotor.time(std::f64::consts::TAU * step as f64 / n as f64);
        rotor.turning(reached(step), reached(step.saturating_sub(1)))
    }

    /// Motion of the hub in the states `y`, nothing accelerated.
    pub fn steady_hub(&self, y: &[f64]) -> HubMotion<f64> {
        self.hub_motion(0, y, &vec![0.0; y.len()])
    }

    /// Motion of every blade in the states `y` (n_blades,), nothing accelerated.
    pub fn modal_motions(&self, y: &[f64]) -> Vec<ModalMotion<f64>> {
        let still = vec![0.0; y.len()];
        (0..self.main().n_blades).map(|b| self.modal_motion(0, y, &still, b)).collect()
    }

    /// A blade with this motion at azimuth `psi` [rad].
    pub fn blade_at(&self, psi: f64, modal: ModalMotion<f64>, controls: &Controls) -> BladeInstant {
        let rotor = self.main();
        let turning = controls.turning.unwrap_or(Turning::steady(rotor.omega));
        let control = rotor.blade_pitch(controls.stick, controls.rate, psi, turning).into();
        BladeInstant { psi, modal, control }
    }

    /// The blades, of these motions (n_blades,), after `step` steps of azimuth of which a revolution has `n`.
    pub fn blades_after(
        &self,
        (step, n): (usize, usize),
        motions: &[ModalMotion<f64>],
        controls: &Controls,
    ) -> Vec<BladeInstant> {
        let psi = |b: usize| azimuth(row(step, b, motions.len(), n), n);
        motions.iter().enumerate().map(|(b, modal)| self.blade_at(psi(b), *modal, controls)).collect()
    }

    /// A blade at every azimuth of a periodic motion (n_azimuths,) with the controls held.
    pub fn periodic_blades(&self, motions: &[ModalMotion<f64>], stick: [f64; 4]) -> Vec<BladeInstant> {
        let psi = |k: usize| azimuth(k, motions.len());
        let at =
            |(k, modal): (usize, &ModalMotion<f64>)| self.blade_at(psi(k), *modal, &Controls::held(stick));
        motions.iter().enumerate().map(at).collect()
    }

    /// Memory of the sections of the first rotor where the step that follows begins, in dynamic inflow; at the end of a step.
    pub fn kept_memory(&self, at: &Instant<f64>) -> MemoryRows {
        let rotor = self.main();
        let spin = self.spin(0, at);
        let hub = self.felt_hub(0, at.y, at.inputs, (self.hub_motion(0, at.y, at.y_dot), &spin.turning));
        MemoryRows::of((0..rotor.n_blades).map(|b| {
            let psi = self.azimuth(0, at.t, at.y, b);
            let control = self.blade_pitch(0, at.inputs, (at.t, &spin), b);
            let blade = BladeInstant { psi, modal: self.modal_motion(0, at.y, at.y_dot, b), control };
            let inflow = self.blade_inflow(0, (at.t, at.y), at.inputs, b);
            let past = self.sections_in_time(0, at.t, at.inputs, b).map(|sections| sections.past);
            rotor.kept(self.air, &hub, &blade, &inflow, past)
        }))
    }

    /// Pitch at each of `n` azimuths of a revolution with the controls held, at a speed that stays.
    pub fn steady_pitch(&self, n: usize, controls: &Controls) -> Vec<PitchMotion<f64>> {
        let rotor = self.main();
        let turning = Turning::steady(controls.turning.map_or(rotor.omega, |t| t.omega));
        (0..n).map(|k| rotor.blade_pitch(controls.stick, [0.0; 4], azimuth(k, n), turning).into()).collect()
    }
}
