//! Blades on a stand in time: one step of Radau IIA on the equations of a blade, its accelerations the unknowns.

use super::radau::{Radau, STAGES};
use crate::blade::MAX_MODES;
use crate::blade::aerodynamics::Air;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::loads::HubMotion;
use crate::numerics::jacobian::dense_jacobian;
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use nalgebra::{DMatrix, DVector};
use thiserror::Error;

/// Most Newton iterations of a step.
const MAX_ITERATIONS: usize = 20;
/// Change of the accelerations over their size at which Newton ends.
const TOLERANCE: f64 = 1e-10;

/// A step that could not be taken.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("a blade's motion was not found in the step from azimuth {azimuth:.1} deg")]
pub struct BladeStepFailure {
    /// Azimuth of the blade at the start [deg].
    pub azimuth: f64,
}

/// A blade at the start of a step and what acts on it.
#[derive(Clone, Copy, Debug)]
pub struct BladeStep<'a> {
    /// The rotor.
    pub rotor: &'a Rotor,
    /// Air.
    pub air: Air,
    /// Motion of the hub, steady.
    pub hub: &'a HubMotion<f64>,
    /// Azimuth [rad].
    pub psi: f64,
    /// Modal motion; the accelerations are a first guess.
    pub motion: ModalMotion<f64>,
    /// Controls at the start of the step, and their rates [1/s].
    pub controls: [[f64; 4]; 2],
    /// Inflow held, a row of [`held_inflow`](crate::rotor::hub::Rotor::held_inflow).
    pub inflow: &'a [f64],
    /// Length of the step [s].
    pub step: f64,
}

impl BladeStep<'_> {
    /// Modal motion at the end of the step.
    ///
    /// Stages: q_i = q + c_i h q_dot + h^2 sum (A^2)_ij K_j, q_dot_i = q_dot + h sum a_ij K_j with the accelerations K_j that
    /// meet the blade's equations there; the last stage is the end.
    pub fn advanced(&self) -> Result<ModalMotion<f64>, BladeStepFailure> {
        let n = self.rotor.blade.n_modes;
        if n == 0 {
            return Ok(self.motion);
        }
        let failure = BladeStepFailure { azimuth: self.psi.to_degrees() };
        let method = Radau::default();
        let mut k: Vec<f64> = (0..STAGES).flat_map(|_| self.motion.q_ddot[..n].to_vec()).collect();
        let mut f = vec![0.0; k.len()];
        let mut jacobian = vec![0.0; k.len() * k.len()];
        let frequency = self.rotor.omega;
        for _ in 0..MAX_ITERATIONS {
            self.residual(&method, &k, &mut f);
            dense_jacobian(&k, |k, f| self.residual(&method, k, f), &mut jacobian);
            let slopes = DMatrix::from_row_slice(k.len(), k.len(), &jacobian);
            let change = slopes.lu().solve(&DVector::from_column_slice(&f)).ok_or(failure)?;
            k.iter_mut().zip(&change).for_each(|(k, d)| *k -= d);
            let end = self.stage(&method, &k, STAGES - 1);
            let size =
                (0..n).fold(0.0f64, |m, i| m.max(k[i].abs()).max(frequency * frequency * end.q[i].abs()));
            if !k.iter().all(|v| v.is_finite()) {
                break;
            }
            if change.amax() <= TOLERANCE * size + f64::MIN_POSITIVE {
                return Ok(end);
            }
        }
        Err(failure)
    }

    /// Motion at stage `i` for the accelerations `k` (stages x modes).
    fn stage<S: Real>(&self, method: &Radau, k: &[S], i: usize) -> ModalMotion<S> {
        let (n, h) = (k.len() / STAGES, self.step);
        let zero = [S::zero(); MAX_MODES];
        let mut m = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
        for mode in 0..n {
            m.q[mode] = S::cst(self.motion.q[mode] + method.c[i] * h * self.motion.q_dot[mode]);
            m.q_dot[mode] = S::cst(self.motion.q_dot[mode]);
            m.q_ddot[mode] = k[i * n + mode];
            for j in 0..STAGES {
                let twice: f64 = (0..STAGES).map(|l| method.a[i][l] * method.a[l][j]).sum();
                m.q[mode] += k[j * n + mode] * (h * h * twice);
                m.q_dot[mode] += k[j * n + mode] * (h * method.a[i][j]);
            }
        }
        m
    }

    /// Residual of the blade's equations at every stage.
    fn residual<S: Real>(&self, method: &Radau, k: &[S], f: &mut [S]) {
        let rotor = self.rotor;
        let n = k.len() / STAGES;
        let hub = self.hub.constant();
        for i in 0..STAGES {
            let t = method.c[i] * self.step;
            let psi = self.psi + rotor.omega * t;
            let [controls, rates] = self.controls;
            let moved = std::array::from_fn(|i| controls[i] + rates[i] * t);
            let at = rotor.blade_pitch(moved, rates, psi);
            let control = PitchMotion {
                theta: S::cst(at.theta),
                theta_dot: S::cst(at.theta_dot),
                theta_ddot: S::cst(at.theta_ddot),
            };
            let inflow = rotor.held_inflow(self.inflow);
            let motion = self.stage(method, k, i);
            let loads = rotor.blade_loads(self.air, &hub, psi, &motion, &control, &inflow);
            f[i * n..(i + 1) * n].copy_from_slice(&loads.modal[..n]);
        }
    }
}
