//! Python bindings: conversions only.
use pyo3::prelude::*;

mod airfoil;
mod atmosphere;
mod blade;
mod carrier;
mod checks;
mod exchange;
mod flight;
mod inflow;
mod options;
mod rotor;
mod system;
mod trim;
mod vortex;
mod wake;

/// The compiled core of wakeflight.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    airfoil::register(m)?;
    atmosphere::register(m)?;
    system::register(m)?;
    blade::register(m)?;
    flight::register(m)?;
    exchange::register(m)?;
    trim::register(m)?;
    inflow::register(m)?;
    options::register(m)?;
    vortex::register(m)?;
    wake::register(m)?;
    Ok(())
}
