//! What meets the air: rotor, hub motion, blades of a system as the exchange and the circulation take them.

use crate::checks::{invalid, map, numbers};
use crate::rotor::motion;
use crate::system::PySystem;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use wakeflight::blade::aerodynamics::Air;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::exchange::azimuth;
use wakeflight::rotor::hub::Rotor;
use wakeflight::trim::host::Host;

impl PySystem {
    /// First rotor, and air.
    pub fn main(&self) -> (&Rotor, Air) {
        (self.inner.main(), self.inner.air)
    }

    /// Motion of the hub at `y`.
    pub fn hub_at(&self, y: &[f64]) -> PyResult<HubMotion<f64>> {
        let y = numbers("y", y, self.inner.layout.len())?;
        Ok(self.inner.hub_motion(0, y, &vec![0.0; y.len()]))
    }

    /// Modal motion of blade `b` in `y`.
    pub fn modal(&self, y: &[f64], b: usize) -> ModalMotion<f64> {
        self.inner.modal_motion(0, y, &vec![0.0; y.len()], b)
    }

    /// Pitch of a blade at azimuth `psi` with controls and their rates.
    pub fn pitch(&self, stick: &[f64], rate: &[f64], psi: f64) -> PyResult<PitchMotion<f64>> {
        let needed = self.inner.controls().len();
        if stick.len() != needed || rate.len() != needed {
            let (found, rates) = (stick.len(), rate.len());
            return Err(invalid(format!("stick has {found} numbers, its rate {rates}; {needed} needed")));
        }
        let four = |v: &[f64]| std::array::from_fn(|i| v.get(i).copied().unwrap_or(0.0));
        Ok(self.inner.main().blade_pitch(four(stick), four(rate), psi).into())
    }

    /// Modal motion by rows of coordinates and rates (rows, n_modes).
    pub fn motions(
        &self,
        (q, q_dot): (&PyReadonlyArray2<'_, f64>, &PyReadonlyArray2<'_, f64>),
        rows: usize,
    ) -> PyResult<Vec<ModalMotion<f64>>> {
        let n = self.inner.main().blade.n_modes;
        let (q, q_dot) = (map("q", q, rows, n)?, map("q_dot", q_dot, rows, n)?);
        let row = |k: usize| k * n..(k + 1) * n;
        Ok((0..rows).map(|k| motion(q[row(k)].iter().copied(), q_dot[row(k)].iter().copied())).collect())
    }

    /// A blade at each of `n` azimuths of a periodic motion (n, n_modes), the sticks held.
    pub fn periodic(
        &self,
        motion: (&PyReadonlyArray2<'_, f64>, &PyReadonlyArray2<'_, f64>),
        n: usize,
        stick: &[f64],
    ) -> PyResult<Vec<BladeInstant>> {
        let still = vec![0.0; numbers("stick", stick, stick.len())?.len()];
        let mut blades = Vec::with_capacity(n);
        for (k, modal) in self.motions(motion, n)?.into_iter().enumerate() {
            let psi = azimuth(k, n);
            blades.push(BladeInstant { psi, modal, control: self.pitch(stick, &still, psi)? });
        }
        Ok(blades)
    }
}
