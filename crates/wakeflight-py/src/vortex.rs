//! Induced velocity of vortex filaments.
use crate::checks;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use wakeflight::vortex::core::{Core, CoreDistance};
use wakeflight::vortex::induced_velocity::Filaments;
use wakeflight::vortex::threads;
use wakeflight::vortex::tree::{Method, add_filaments_velocity_by};

/// Adds the functions of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(induced_velocity, m)?)?;
    m.add_function(wrap_pyfunction!(set_threads, m)?)?;
    m.add_function(wrap_pyfunction!(instruction_set, m)?)
}

fn core_named(name: &str) -> PyResult<Core> {
    Ok(match name {
        "singular" => Core::Singular,
        "scully" => Core::Scully,
        "vatistas2" => Core::Vatistas2,
        "rankine" => Core::Rankine,
        "lamb_oseen" => Core::LambOseen,
        "rosenhead_moore" => Core::RosenheadMoore,
        _ => return Err(PyValueError::new_err(format!("core = {name}: no such core model"))),
    })
}

fn core_distance_named(name: &str) -> PyResult<CoreDistance> {
    match name {
        "line" => Ok(CoreDistance::Line),
        "segment" => Ok(CoreDistance::Segment),
        _ => Err(PyValueError::new_err(format!("core_distance = {name}: allowed are line, segment"))),
    }
}

fn method_named(name: &str, tolerance: f64) -> PyResult<Method> {
    match name {
        "direct" => Ok(Method::Direct),
        "tree" => Ok(Method::Tree { tolerance }),
        "auto" => Ok(Method::Auto { tolerance }),
        _ => Err(PyValueError::new_err(format!("method = {name}: allowed are direct, tree, auto"))),
    }
}

fn vectors(name: &str, array: &PyReadonlyArray2<f64>) -> PyResult<Vec<[f64; 3]>> {
    let array = array.as_array();
    if array.ncols() != 3 {
        return Err(PyValueError::new_err(format!("{name}: shape {:?}, needed is (n, 3)", array.shape())));
    }
    Ok(array.rows().into_iter().map(|row| [row[0], row[1], row[2]]).collect())
}

/// Velocity (n, 3) [m/s] at `points` (n, 3) [m] of the filaments whose nodes are `nodes[offsets[i]:offsets[i + 1]]`.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
fn induced_velocity<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    nodes: PyReadonlyArray2<'py, f64>,
    filament_offsets: PyReadonlyArray1<'py, i64>,
    circulation: PyReadonlyArray1<'py, f64>,
    core_radius: PyReadonlyArray1<'py, f64>,
    core: &str,
    core_distance: &str,
    method: &str,
    tolerance: f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (core, core_distance) = (core_named(core)?, core_distance_named(core_distance)?);
    let method = method_named(method, tolerance)?;
    threads::threads().map_err(|e| PyValueError::new_err(e.to_string()))?;
    checks::instruction_set()?;
    let points = vectors("points", &points)?;
    let nodes = vectors("nodes", &nodes)?;
    let offsets = filament_offsets.as_array();
    let n_nodes: Vec<usize> = offsets
        .iter()
        .zip(offsets.iter().skip(1))
        .map(|(a, b)| usize::try_from(b - a).unwrap_or(0))
        .collect();
    let filaments = Filaments {
        n_nodes,
        nodes,
        circulation: circulation.as_array().to_vec(),
        core_radius: core_radius.as_array().to_vec(),
    };
    let n_segments: usize = filaments.n_nodes.iter().map(|n| n.saturating_sub(1)).sum();
    let consistent = filaments.n_nodes.iter().sum::<usize>() == filaments.nodes.len()
        && filaments.circulation.len() == n_segments
        && filaments.core_radius.len() == n_segments;
    if !consistent {
        return Err(PyValueError::new_err(
            "filament_offsets, nodes, circulation and core_radius do not belong together",
        ));
    }
    let velocity = py.detach(|| {
        let mut velocity = vec![[0.0; 3]; points.len()];
        add_filaments_velocity_by(method, &points, &filaments, core, core_distance, &mut velocity);
        velocity
    });
    let shape = [velocity.len(), 3];
    let flat = velocity.into_flattened().into_pyarray(py);
    numpy::PyArrayMethods::reshape(&flat, shape)
}

/// Sets the number of threads of the sums; results do not depend on it.
#[pyfunction]
fn set_threads(n: i64) -> PyResult<()> {
    let n = usize::try_from(n).unwrap_or(0);
    threads::set_threads(n).map_err(|e| PyValueError::new_err(e.to_string()))
}

/// Name of the instruction set that sums and derivatives run on.
#[pyfunction]
fn instruction_set() -> PyResult<&'static str> {
    checks::instruction_set()
}
