//! Python bindings: conversions only.
use pyo3::prelude::*;

mod wake;

/// The compiled core of wakeflight.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    wake::register(m)?;
    Ok(())
}
