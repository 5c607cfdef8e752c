//! Periodic blade motion: mean and harmonics of every mode, and the Galerkin projection of the blade equations on them.

use super::hub::Rotor;
use crate::blade::MAX_MODES;
use crate::blade::aerodynamics::Air;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::surroundings::BladeInflow;
use crate::numerics::scalar::Real;

/// Where mean, cosines and sines of every mode live in a vector of unknowns; the equations are in the same order.
#[derive(Clone, Copy, Debug)]
pub struct Harmonics {
    /// First of them.
    pub start: usize,
    /// Modes.
    pub n_modes: usize,
    /// Harmonics of each.
    pub n_harmonics: usize,
}

impl Harmonics {
    /// Mean, then (cosine, sine) of every harmonic of mode `i`; one past the last mode is the end.
    pub fn mode(&self, i: usize) -> usize {
        self.start + i * (1 + 2 * self.n_harmonics)
    }

    /// Names of them.
    pub fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        for i in 0..self.n_modes {
            names.push(format!("mode_{i}_mean"));
            for k in 1..=self.n_harmonics {
                names.push(format!("mode_{i}_cos_{k}"));
                names.push(format!("mode_{i}_sin_{k}"));
            }
        }
        names
    }

    /// Modal coordinate, rate and acceleration at azimuth `psi` of a rotor turning at `omega` [rad/s].
    pub fn motion<S: Real>(&self, x: &[S], psi: f64, omega: f64) -> ModalMotion<S> {
        let zero = [S::zero(); MAX_MODES];
        let mut m = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
        for i in 0..self.n_modes {
            let start = self.mode(i);
            m.q[i] = x[start];
            for k in 1..=self.n_harmonics {
                let (s, c) = (k as f64 * psi).sin_cos();
                let w = k as f64 * omega;
                let (a, b) = (x[start + 2 * k - 1], x[start + 2 * k]);
                m.q[i] += a * c + b * s;
                m.q_dot[i] += (b * c - a * s) * w;
                m.q_ddot[i] -= (a * c + b * s) * (w * w);
            }
        }
        m
    }
}

/// What a blade is given at one azimuth of the revolution: its pitch and its inflow.
pub type BladeGiven<'a, S> = (PitchMotion<S>, BladeInflow<'a, S>);

/// One blade all the way round, in steady motion of the hub.
#[derive(Clone, Copy, Debug)]
pub struct Revolution<'a, S> {
    /// Air.
    pub air: Air,
    /// Motion of the hub.
    pub hub: &'a HubMotion<S>,
    /// Where the blade's motion is in the unknowns.
    pub harmonics: Harmonics,
    /// Unknowns.
    pub x: &'a [S],
    /// Azimuths it is looked at.
    pub n_azimuths: usize,
}

impl<S: Real> Revolution<'_, S> {
    /// Azimuth number `l` [rad].
    pub fn azimuth(&self, l: usize) -> f64 {
        std::f64::consts::TAU * l as f64 / self.n_azimuths as f64
    }
}

impl Rotor {
    /// Mean loads of all blades over the revolution; the projection of the blade equations on every harmonic, as equivalent
    /// angles [rad], goes to `f`.
    pub fn revolution<'a, S: Real>(
        &self,
        turn: &Revolution<S>,
        given: impl Fn(usize, f64) -> BladeGiven<'a, S>,
        f: &mut [S],
    ) -> BladeLoads<S> {
        let (n, harmonics) = (turn.n_azimuths, &turn.harmonics);
        let mut mean = BladeLoads::zero();
        self.clear(harmonics, f);
        for l in 0..n {
            let psi = turn.azimuth(l);
            let modal = harmonics.motion(turn.x, psi, self.omega);
            let (control, inflow) = given(l, psi);
            let loads = self.blade_loads(turn.air, turn.hub, psi, &modal, &control, &inflow);
            self.add_azimuth(harmonics, (psi, n), &loads, &mut mean, f);
        }
        mean
    }

    /// The same without derivatives, four azimuths at once; the same bits.
    pub fn revolution_of_four<'a>(
        &self,
        turn: &Revolution<f64>,
        given: impl Fn(usize, f64) -> BladeGiven<'a, f64>,
        f: &mut [f64],
    ) -> BladeLoads<f64> {
        let (n, harmonics) = (turn.n_azimuths, &turn.harmonics);
        let mut mean = BladeLoads::zero();
        self.clear(harmonics, f);
        for first in (0..n).step_by(4) {
            let known: [_; 4] = std::array::from_fn(|k| {
                // fewer than four left: the last stands in for those that are not there
                let l = (first + k).min(n - 1);
                let psi = turn.azimuth(l);
                let (control, inflow) = given(l, psi);
                ((psi, harmonics.motion(turn.x, psi, self.omega), control), inflow)
            });
            let (poses, inflow) = (known.map(|(pose, _)| pose), known.map(|(_, inflow)| inflow));
            let loads = self.four_blade_loads(turn.air, turn.hub, &poses, &inflow);
            for (pose, loads) in poses.iter().zip(&loads).take(n - first) {
                self.add_azimuth(harmonics, (pose.0, n), loads, &mut mean, f);
            }
        }
        mean
    }

    fn clear<S: Real>(&self, harmonics: &Harmonics, f: &mut [S]) {
        for row in &mut f[harmonics.mode(0)..harmonics.mode(harmonics.n_modes)] {
            *row = S::zero();
        }
    }

    /// Adds the loads of a blade at `psi` [rad], one of `n` azimuths, to the mean of all blades and the projected equations.
    fn add_azimuth<S: Real>(
        &self,
        harmonics: &Harmonics,
        (psi, n): (f64, usize),
        loads: &BladeLoads<S>,
        mean: &mut BladeLoads<S>,
        f: &mut [S],
    ) {
        let share = self.n_blades as f64 / n as f64;
        mean.force += loads.force.scaled(share);
        mean.moment += loads.moment.scaled(share);
        mean.aero_force += loads.aero_force.scaled(share);
        mean.aero_moment += loads.aero_moment.scaled(share);
        for i in 0..harmonics.n_modes {
            let start = harmonics.mode(i);
            let residual = loads.modal[i] / n as f64;
            f[start] += residual * self.angle_per_modal_force(i, 0);
            for k in 1..=harmonics.n_harmonics {
                let (s, c) = (k as f64 * psi).sin_cos();
                let angle = 2.0 * self.angle_per_modal_force(i, k);
                f[start + 2 * k - 1] += residual * (c * angle);
                f[start + 2 * k] += residual * (s * angle);
            }
        }
    }

    /// Tip deflection of the first flap mode over R - e, per modal coordinate.
    pub fn flap_per_coordinate(&self) -> f64 {
        self.blade.tip.w[0][self.blade.flap_mode] / (self.blade.radius - self.hinge())
    }

    /// Equivalent angle of a harmonic modal force: the answer of the mode at k per revolution, its tip (or twist) as an angle.
    ///
    /// angle/max(omega_i^2, |omega_i^2 - (k Omega)^2|): static below and near resonance.
    pub fn angle_per_modal_force(&self, i: usize, k: usize) -> f64 {
        let stiffness = self.blade.modes.frequency[i].powi(2);
        let dynamic = (stiffness - (k as f64 * self.omega).powi(2)).abs();
        self.angle_per_coordinate(i) / stiffness.max(dynamic)
    }

    /// Largest tip deflection over R - e, or tip twist, per unit of modal coordinate `i`.
    pub fn angle_per_coordinate(&self, i: usize) -> f64 {
        let blade = &self.blade;
        let span = blade.radius - self.hinge();
        (blade.tip.w[0][i].abs() / span).max(blade.tip.v[0][i].abs() / span).max(blade.tip.theta[i].abs())
    }
}
