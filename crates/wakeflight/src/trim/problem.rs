//! What is asked of a trim.

use super::equation::Equation;
use super::path::{Path, PathUnknown};
use crate::wake::AtParts;
use serde::{Deserialize, Serialize};

/// Inflow in trim.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum Inflow {
    /// Dynamic inflow, constant over the revolution: three unknowns.
    Dynamic,
    /// lambda held at (azimuth, station); and its disk mean.
    Map {
        /// Row-major (n_azimuths, width), positive down; rows as [`held_inflow`](crate::rotor::hub::Rotor::held_inflow) takes them.
        inflow: Vec<f64>,
        /// Disk mean.
        mean: f64,
    },
}

/// A steady condition to trim for.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Problem {
    /// Motion of an airframe; of what is left free, a number without meaning. Not read on a stand.
    pub path: Path<f64>,
    /// Parts of the path that are unknowns.
    pub free: Vec<PathUnknown>,
    /// Equations for controls, attitude and the free parts of the path.
    pub equations: Vec<Equation>,
    /// Harmonics of the blade motion.
    pub n_harmonics: usize,
    /// Azimuths of the averages and projections.
    pub n_azimuths: usize,
    /// Inflow.
    pub inflow: Inflow,
    /// Air of the wake at the parts of the airframe [m/s], body axes; none where washes act on the mean inflow.
    pub wash: Option<AtParts>,
}

impl Problem {
    /// Whether the states of dynamic inflow are unknowns.
    pub fn is_dynamic(&self) -> bool {
        matches!(self.inflow, Inflow::Dynamic)
    }
}
