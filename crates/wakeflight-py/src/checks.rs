//! What bindings check of what Python gives, and the exact form in which Python keeps state.

use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::{Deserialize, Serialize};
use wakeflight::numerics::instruction_set::InstructionSet;

/// Bad input, in Python.
pub fn invalid(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Name of the instruction set in use; what was asked for must be on this machine.
pub fn instruction_set() -> PyResult<&'static str> {
    InstructionSet::chosen().map(InstructionSet::name).map_err(invalid)
}

/// `values`, which must be `n` numbers; whether they are finite is for the solver to say.
pub fn sized<'a>(name: &str, values: &'a [f64], n: usize) -> PyResult<&'a [f64]> {
    if values.len() == n {
        return Ok(values);
    }
    Err(PyValueError::new_err(format!("{name} has {} numbers, {n} needed", values.len())))
}

/// `values`, which must be `n` finite numbers.
pub fn numbers<'a>(name: &str, values: &'a [f64], n: usize) -> PyResult<&'a [f64]> {
    match sized(name, values, n)?.iter().position(|v| !v.is_finite()) {
        Some(i) => Err(PyValueError::new_err(format!("{name} is not finite at index {i}"))),
        None => Ok(values),
    }
}

/// Copy, row by row, of a map that must be (rows, columns) finite numbers.
pub fn map(name: &str, array: &PyReadonlyArray2<'_, f64>, rows: usize, columns: usize) -> PyResult<Vec<f64>> {
    let view = array.as_array();
    if view.dim() != (rows, columns) {
        let (r, c) = view.dim();
        return Err(PyValueError::new_err(format!(
            "{name} has the shape ({r}, {c}), ({rows}, {columns}) needed"
        )));
    }
    let values: Vec<f64> = view.iter().copied().collect();
    numbers(name, &values, rows * columns)?;
    Ok(values)
}

/// `value` with every number exact: MessagePack with named fields.
pub fn pack<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = rmp_serde::to_vec_named(value).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(PyBytes::new(py, &bytes))
}

/// What was packed.
pub fn unpack<'a, T: Deserialize<'a>>(what: &str, bytes: &'a [u8]) -> PyResult<T> {
    rmp_serde::from_slice(bytes).map_err(|e| PyValueError::new_err(format!("{what}: cannot be read: {e}")))
}
