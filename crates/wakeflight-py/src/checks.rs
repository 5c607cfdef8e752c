//! What crosses the border: arrays from Python with what is checked of them, arrays to Python, state in its exact form.

use numpy::ndarray::{ArrayD, Dimension};
use numpy::{IntoPyArray, Ix1, Ix2, PyArrayDyn, PyReadonlyArray, PyReadwriteArray};
use pyo3::exceptions::{PyArithmeticError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use serde::{Deserialize, Serialize};
use wakeflight::numerics::instruction_set::InstructionSet;

/// Numbers from Python, in a row.
pub type Row<'py> = PyReadonlyArray<'py, f64, Ix1>;
/// Rows of numbers from Python.
pub type Table<'py> = PyReadonlyArray<'py, f64, Ix2>;
/// Room in Python for numbers in a row, or in rows.
pub type Room<'py, D = Ix1> = PyReadwriteArray<'py, f64, D>;
/// Modal coordinates and their rates, a row for each blade instant.
pub type Motion<'py> = (Table<'py>, Table<'py>);

/// Bad input, in Python.
pub fn invalid(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Name of the instruction set in use; what was asked for must be on this machine.
pub fn instruction_set() -> PyResult<&'static str> {
    InstructionSet::chosen().map(InstructionSet::name).map_err(invalid)
}

/// A numerical failure, in Python.
pub fn failed(error: impl std::fmt::Display) -> PyErr {
    PyArithmeticError::new_err(error.to_string())
}

/// The numbers of `row`, which must be `n`; whether they are finite is for the solver to say.
pub fn sized<'a>(name: &str, row: &'a Row<'_>, n: usize) -> PyResult<&'a [f64]> {
    let values = row.as_slice()?;
    if values.len() == n {
        return Ok(values);
    }
    Err(invalid(format!("{name} has {} numbers, {n} needed", values.len())))
}

/// The numbers of `out` to be filled, which must be `n`.
pub fn room<'a, D: Dimension>(out: &'a mut Room<'_, D>, n: usize) -> PyResult<&'a mut [f64]> {
    let values = out.as_slice_mut()?;
    let found = values.len();
    if found == n { Ok(values) } else { Err(invalid(format!("out has {found} numbers, {n} needed"))) }
}

/// `values`, all of which must be finite.
pub fn finite<V: AsRef<[f64]>>(name: &str, values: V) -> PyResult<V> {
    match values.as_ref().iter().position(|v| !v.is_finite()) {
        Some(i) => Err(invalid(format!("{name} is not finite at index {i}"))),
        None => Ok(values),
    }
}

/// The numbers of `row`, which must be `n`, all finite.
pub fn numbers<'a>(name: &str, row: &'a Row<'_>, n: usize) -> PyResult<&'a [f64]> {
    finite(name, sized(name, row, n)?)
}

/// Copy, row by row, of a table that must be (rows, columns) finite numbers.
pub fn map(name: &str, table: &Table<'_>, rows: usize, columns: usize) -> PyResult<Vec<f64>> {
    let view = table.as_array();
    if view.dim() != (rows, columns) {
        let (r, c) = view.dim();
        return Err(invalid(format!("{name} has the shape ({r}, {c}), ({rows}, {columns}) needed")));
    }
    finite(name, view.iter().copied().collect())
}

/// Copy, row by row, of a table that must have N columns.
pub fn columns<const N: usize>(name: &str, table: &Table<'_>) -> PyResult<Vec<[f64; N]>> {
    let view = table.as_array();
    if view.ncols() != N {
        return Err(invalid(format!("{name} has {} columns, {N} needed", view.ncols())));
    }
    Ok(view.rows().into_iter().map(|row| std::array::from_fn(|c| row[c])).collect())
}

/// An array for Python: numbers in row-major order and its shape.
pub struct Array(Vec<f64>, Vec<usize>);

/// Array (lead ..., n).
pub fn array(values: impl Into<Vec<f64>>, lead: &[usize]) -> Array {
    let values = values.into();
    let n = values.len().checked_div(lead.iter().product()).unwrap_or(0);
    Array(values, [lead, &[n]].concat())
}

/// Array (lead ..., n, 3).
pub fn vectors(values: Vec<[f64; 3]>, lead: &[usize]) -> Array {
    let n = values.len().checked_div(lead.iter().product()).unwrap_or(0);
    Array(values.into_flattened(), [lead, &[n, 3]].concat())
}

impl<'py> IntoPyObject<'py> for Array {
    type Target = PyArrayDyn<f64>;
    type Output = Bound<'py, Self::Target>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        Ok(ArrayD::from_shape_vec(self.1, self.0).map_err(invalid)?.into_pyarray(py))
    }
}

/// Values by name, in Python a dictionary.
pub struct Named<T>(pub Vec<(&'static str, T)>);

impl<T> FromIterator<(&'static str, T)> for Named<T> {
    fn from_iter<I: IntoIterator<Item = (&'static str, T)>>(pairs: I) -> Self {
        Self(pairs.into_iter().collect())
    }
}

impl<'py, T: IntoPyObject<'py>> IntoPyObject<'py> for Named<T> {
    type Target = PyDict;
    type Output = Bound<'py, PyDict>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        self.0.into_py_dict(py)
    }
}

/// `value` with every number exact: MessagePack with named fields.
pub fn pack(value: &impl Serialize) -> PyResult<Vec<u8>> {
    rmp_serde::to_vec_named(value).map_err(invalid)
}

/// What was packed.
pub fn unpack<'a, T: Deserialize<'a>>(what: &str, bytes: &'a [u8]) -> PyResult<T> {
    rmp_serde::from_slice(bytes).map_err(|e| invalid(format!("{what}: cannot be read: {e}")))
}
