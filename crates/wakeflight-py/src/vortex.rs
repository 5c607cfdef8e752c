//! Induced velocity of vortex filaments.
use crate::checks::{self, Array, Row, Table, columns, invalid, vectors};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use serde::Deserialize;
use wakeflight::vortex::core::{Core, CoreDistance};
use wakeflight::vortex::curvature::add_curvature_velocity;
use wakeflight::vortex::induced_velocity::Filaments;
use wakeflight::vortex::threads;
use wakeflight::vortex::tree::{Method, add_filaments_velocity_by};

/// Law of a segment, and how the sum is taken.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Law {
    core: Core,
    core_distance: CoreDistance,
    method: Method,
    curvature_correction: bool,
}

/// Velocity (n, 3) [m/s] at `points` (n, 3) [m] of filaments of `n_nodes` nodes each, one after the other in `nodes` (m, 3) [m];
/// segments: circulation [m2/s] and core radius [m]; the law as JSON: core, core_distance, method,
/// curvature_correction.
#[pyfunction]
pub fn induced_velocity(
    py: Python<'_>,
    points: Table,
    nodes: Table,
    n_nodes: PyReadonlyArray1<i64>,
    segments: (Row, Row),
    law_json: &str,
) -> PyResult<Array> {
    let law: Law = serde_json::from_str(law_json).map_err(invalid)?;
    threads::threads().map_err(invalid)?;
    checks::instruction_set()?;
    let points = columns("points", &points)?;
    let filaments = Filaments {
        n_nodes: n_nodes
            .as_array()
            .iter()
            .map(|&n| usize::try_from(n))
            .collect::<Result<_, _>>()
            .map_err(invalid)?,
        nodes: columns("nodes", &nodes)?,
        circulation: segments.0.as_array().to_vec(),
        core_radius: segments.1.as_array().to_vec(),
    };
    if !filaments.belong_together() {
        return Err(invalid("n_nodes, nodes, circulation and core_radius do not belong together"));
    }
    let velocity = py.detach(|| {
        let mut velocity = vec![[0.0; 3]; points.len()];
        add_filaments_velocity_by(
            law.method,
            &points,
            &filaments,
            law.core,
            law.core_distance,
            &mut velocity,
        );
        if law.curvature_correction {
            add_curvature_velocity(&points, &filaments, &mut velocity);
        }
        velocity
    });
    Ok(vectors(velocity, &[]))
}

/// Sets the number of threads of the sums; results do not depend on it.
#[pyfunction]
pub fn set_threads(n: i64) -> PyResult<()> {
    threads::set_threads(usize::try_from(n).unwrap_or(0)).map_err(invalid)
}

/// Number of threads of the sums: as set, else of WAKEFLIGHT_THREADS, else one per processor.
#[pyfunction(name = "threads")]
pub fn threads_used() -> PyResult<usize> {
    threads::threads().map_err(invalid)
}

/// Commit that was built, `unknown` outside a checkout.
#[pyfunction]
pub fn build_commit() -> &'static str {
    env!("WAKEFLIGHT_COMMIT")
}

/// Name of the instruction set that sums and derivatives run on.
#[pyfunction]
pub fn instruction_set() -> PyResult<&'static str> {
    checks::instruction_set()
}
