//! Dynamic inflow and momentum theory.

use crate::checks::invalid;
use pyo3::prelude::*;
use wakeflight::inflow::pitt_peters::{DiskCondition, PittPeters};
use wakeflight::inflow::{descent, momentum};

/// Rates (lambda_0, lambda_s, lambda_c) [1/s] of Pitt-Peters inflow at `omega` [rad/s].
///
/// disk: ct, roll and pitch moment coefficients, mu forward, right, down; model as JSON: `apparent_mass` "corrected" (128/(75 pi))
/// or "uncorrected" (8/(3 pi)), `mass_flow` "momentum" or "state", the first where it is left out.
#[pyfunction]
#[pyo3(signature = (inflow, disk, omega, model_json="{}"))]
pub fn pitt_peters_rate(
    inflow: [f64; 3],
    disk: [f64; 6],
    omega: f64,
    model_json: &str,
) -> PyResult<[f64; 3]> {
    let model: PittPeters = serde_json::from_str(model_json).map_err(invalid)?;
    let [ct, cl, cm, mu_x, mu_y, mu_z] = disk;
    Ok(model.inflow_dot(inflow, DiskCondition { ct, cl, cm, mu_x, mu_y, mu_z, height: None }, omega))
}

/// Mean induced inflow of momentum theory at `ct`, squared in-plane advance ratio and velocity down along the shaft; of
/// several values the one continued from hover.
#[pyfunction]
pub fn momentum_inflow(ct: f64, mu_squared: f64, mu_z: f64) -> f64 {
    momentum::momentum_inflow(ct, mu_squared, mu_z)
}

/// Mean induced inflow that dynamic inflow takes: momentum theory, in descent the curve of tests.
#[pyfunction]
pub fn descent_inflow(ct: f64, mu_squared: f64, mu_z: f64) -> f64 {
    descent::descent_inflow(ct, mu_squared, mu_z)
}
