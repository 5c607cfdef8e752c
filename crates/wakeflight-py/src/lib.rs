//! Python bindings: conversions only.
use pyo3::prelude::*;

mod atmosphere;

/// The compiled core of wakeflight.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    m.add_function(wrap_pyfunction!(atmosphere::standard_atmosphere, m)?)?;
    Ok(())
}
