//! Python bindings: conversions only.
use pyo3::prelude::*;

mod aircraft;
mod atmosphere;
mod blade;
mod carrier;
mod checks;
mod exchange;
mod flight;
mod inflow;
mod options;
mod rotor;
mod stand;
mod trim;
mod vortex;
mod wake;

/// The compiled core of wakeflight.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    atmosphere::register(m)?;
    aircraft::register(m)?;
    blade::register(m)?;
    flight::register(m)?;
    exchange::register(m)?;
    stand::register(m)?;
    trim::register(m)?;
    inflow::register(m)?;
    options::register(m)?;
    vortex::register(m)?;
    wake::register(m)?;
    Ok(())
}
