//! Whose rotor meets the air: an aircraft's or a stand's.

use crate::aircraft::PyAircraft;
use crate::checks::{map, numbers};
use crate::rotor::motion;
use crate::stand::{PyStand, four, hub_motion, hub_state};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use wakeflight::blade::aerodynamics::Air;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::blade::loads::HubMotion;
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::exchange::azimuth;
use wakeflight::rotor::hub::Rotor;

/// Whose rotor it is.
#[derive(FromPyObject)]
pub enum Core<'py> {
    Aircraft(PyRef<'py, PyAircraft>),
    Stand(PyRef<'py, PyStand>),
}

impl Core<'_> {
    /// Rotor and air.
    pub fn rotor(&self) -> (&Rotor, Air) {
        match self {
            Self::Aircraft(a) => (a.inner.main(), a.inner.air),
            Self::Stand(s) => (s.inner.main(), s.inner.air),
        }
    }

    /// Motion of the hub at `y`.
    pub fn hub(&self, y: &[f64]) -> PyResult<HubMotion<f64>> {
        match self {
            Self::Aircraft(a) => {
                let y = numbers("y", y, a.inner.layout.len())?;
                Ok(a.inner.hub_motion(0, y, &vec![0.0; y.len()]))
            }
            Self::Stand(s) => {
                let (velocity, rates) = hub_state(numbers("y", y, y.len())?)?;
                Ok(hub_motion(&s.inner, velocity, rates))
            }
        }
    }

    /// Modal motion of blade `b` in `y`; a stand keeps none there.
    pub fn modal(&self, y: &[f64], b: usize) -> PyResult<ModalMotion<f64>> {
        match self {
            Self::Aircraft(a) => Ok(a.inner.modal_motion(0, y, &vec![0.0; y.len()], b)),
            Self::Stand(_) => Err(PyValueError::new_err("motion: needed for a rotor on a stand")),
        }
    }

    /// Pitch of a blade at azimuth `psi` with sticks and their rates.
    pub fn pitch(&self, stick: &[f64], rate: &[f64], psi: f64) -> PyResult<PitchMotion<f64>> {
        let wrong =
            || PyValueError::new_err(format!("stick has {} numbers, its rate {}", stick.len(), rate.len()));
        let (controls, rates) = match self {
            Self::Aircraft(_) => {
                (stick.try_into().map_err(|_| wrong())?, rate.try_into().map_err(|_| wrong())?)
            }
            Self::Stand(_) => {
                (four(stick.try_into().map_err(|_| wrong())?), four(rate.try_into().map_err(|_| wrong())?))
            }
        };
        Ok(self.rotor().0.blade_pitch(controls, rates, psi).into())
    }

    /// Modal motion by rows of coordinates and rates (rows, n_modes).
    pub fn motions(
        &self,
        (q, q_dot): (&PyReadonlyArray2<'_, f64>, &PyReadonlyArray2<'_, f64>),
        rows: usize,
    ) -> PyResult<Vec<ModalMotion<f64>>> {
        let n = self.rotor().0.blade.n_modes;
        let (q, q_dot) = (map("q", q, rows, n)?, map("q_dot", q_dot, rows, n)?);
        let at = |values: &[f64], k: usize| values[k * n..(k + 1) * n].to_vec().into_iter();
        Ok((0..rows).map(|k| motion(at(&q, k), at(&q_dot, k))).collect())
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
