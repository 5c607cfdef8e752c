//! Dynamic inflow and momentum theory.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use wakeflight::inflow::pitt_peters::{self, ApparentMass, DiskCondition, MassFlow, PittPeters};

/// Rates (lambda_0, lambda_s, lambda_c) [1/s] of Pitt-Peters inflow at `omega` [rad/s].
///
/// disk: ct, roll and pitch moment coefficients, mu forward, right, down; apparent_mass: "corrected" (128/(75 pi)) or
/// "uncorrected" (8/(3 pi)); mass_flow: "momentum" or "state".
#[pyfunction]
#[pyo3(signature = (inflow, disk, omega, apparent_mass="corrected", mass_flow="momentum"))]
pub fn pitt_peters_rate(
    inflow: [f64; 3],
    disk: [f64; 6],
    omega: f64,
    apparent_mass: &str,
    mass_flow: &str,
) -> PyResult<[f64; 3]> {
    let apparent_mass = match apparent_mass {
        "corrected" => ApparentMass::Corrected,
        "uncorrected" => ApparentMass::Uncorrected,
        other => {
            return Err(PyValueError::new_err(format!("apparent_mass '{other}': corrected or uncorrected")));
        }
    };
    let mass_flow = match mass_flow {
        "momentum" => MassFlow::Momentum,
        "state" => MassFlow::State,
        other => return Err(PyValueError::new_err(format!("mass_flow '{other}': momentum or state"))),
    };
    let [ct, cl, cm, mu_x, mu_y, mu_z] = disk;
    let disk = DiskCondition { ct, cl, cm, mu_x, mu_y, mu_z };
    Ok(PittPeters { apparent_mass, mass_flow }.inflow_dot(inflow, disk, omega))
}

/// Mean induced inflow of momentum theory at `ct`, squared in-plane advance ratio and velocity down along the shaft; of
/// several values the one continued from hover, or the least.
#[pyfunction]
#[pyo3(signature = (ct, mu_squared, mu_z, least=false))]
pub fn momentum_inflow(ct: f64, mu_squared: f64, mu_z: f64, least: bool) -> f64 {
    if least {
        pitt_peters::least_momentum_inflow(ct, mu_squared, mu_z)
    } else {
        pitt_peters::momentum_inflow(ct, mu_squared, mu_z)
    }
}

/// Adds this file's functions to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(pitt_peters_rate, m)?)?;
    m.add_function(wrap_pyfunction!(momentum_inflow, m)?)
}
