//! Python bindings: conversions only.
use pyo3::prelude::*;

mod aircraft;
mod atmosphere;
mod blade;
mod vortex;

/// The compiled core of wakeflight.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    m.add_function(wrap_pyfunction!(atmosphere::standard_atmosphere, m)?)?;
    m.add_class::<aircraft::PyAircraft>()?;
    m.add_class::<aircraft::PyInputs>()?;
    m.add_class::<aircraft::PyTrimProblem>()?;
    m.add_class::<blade::BladeModes>()?;
    vortex::register(m)?;
    Ok(())
}
