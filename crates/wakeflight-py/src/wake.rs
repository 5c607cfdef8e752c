//! Free wakes by themselves: conversions and checks, the GIL released.

use crate::checks::{Array, Row, Table, array, columns, failed, instruction_set, invalid, vectors};
use crate::options::{marching_options, relaxation_options, wake_options};
use pyo3::prelude::*;
use wakeflight::wake::geometry::BladeGrid;
use wakeflight::wake::lifting_surface::{self, ControlLine};
use wakeflight::wake::{self, BladeState, HubMotion, Induction, LinearField, WakeError};

/// Input at fault: ValueError; numerical failure: ArithmeticError.
pub(crate) fn py_error(error: WakeError) -> PyErr {
    if error.is_numerical() { failed(error) } else { invalid(error) }
}

/// Velocity [m/s] and rates [rad/s] of the hub, hub axes.
type Hub = ([f64; 3], [f64; 3]);

fn motion((velocity, rates): Hub) -> HubMotion {
    HubMotion { velocity, rates }
}

/// Matrix N (n_stations, n_stations) [s/m2]: inflow of the near wake of the own blade, lambda_i = sum_j N_ij Gamma_j, and the edges
/// (n_stations + 1) and stations [m] of the bound elements; `blade`: azimuth, flap, lead [rad].
#[pyfunction]
pub fn near_wake_matrix(
    options_json: &str,
    hub: Hub,
    blade: (f64, f64, f64),
) -> PyResult<(Array, Array, Array)> {
    let (options, (psi, flap, lead)) = (wake_options(options_json)?, blade);
    let found = wake::near_wake_matrix(&options, &motion(hub), &BladeState { psi, flap, lead });
    let (matrix, grid) = (found.map_err(py_error)?, BladeGrid::new(&options));
    Ok((array(matrix, &[options.n_stations]), array(grid.edges, &[]), array(grid.stations, &[])))
}

/// Circulation over speed (n) [m] of a flat wing: edges (n + 1), stations, chords (n) [m], angle of attack [rad]; control points at
/// three quarters of the chord (Weissinger) or on the bound line.
#[pyfunction]
pub fn wing_circulation(
    edges: Row,
    stations: Row,
    chords: Row,
    alpha: f64,
    weissinger: bool,
) -> PyResult<Array> {
    let line = if weissinger { ControlLine::ThreeQuarter } else { ControlLine::Quarter };
    let (edges, stations, chords) = (edges.as_slice()?, stations.as_slice()?, chords.as_slice()?);
    let found = lifting_surface::wing_circulation(edges, stations, chords, alpha, line);
    Ok(array(found.map_err(py_error)?, &[]))
}

/// Periodic wake of a steady flight condition.
#[pyclass(module = "wakeflight._core")]
pub struct RelaxationWake(pub(crate) wake::RelaxationWake);

#[pymethods]
impl RelaxationWake {
    /// `prescribed`: velocity at the hub [m/s] and gradient [1/s], hub axes, of a linear field that stands for the induced
    /// velocity of the vortices, for this wake and those marched from it.
    #[new]
    #[pyo3(signature = (options_json, hub, mean_inflow, prescribed=None))]
    fn new(
        options_json: &str,
        hub: Hub,
        mean_inflow: f64,
        prescribed: Option<([f64; 3], [[f64; 3]; 3])>,
    ) -> PyResult<Self> {
        instruction_set()?;
        let (options, own) = (wake_options(options_json)?, relaxation_options(options_json)?);
        let inner = match prescribed {
            None => wake::RelaxationWake::new(options, own, motion(hub), mean_inflow),
            Some((at_origin, gradient)) => LinearField::new(at_origin, gradient).and_then(|field| {
                let field = Induction::Linear(field);
                wake::RelaxationWake::with_field(options, own, motion(hub), mean_inflow, field)
            }),
        };
        inner.map(Self).map_err(py_error)
    }

    /// Hub motion, flap and lead by azimuth (n_azimuths, 2) [rad] and bound circulation (n_azimuths, n_stations) [m2/s].
    fn set_state(&mut self, hub: Hub, blades: Table, circulation: Table) -> PyResult<()> {
        let blades: Vec<_> =
            columns("blades", &blades)?.into_iter().map(|[flap, lead]| (flap, lead)).collect();
        let circulation: Vec<f64> = circulation.as_array().iter().copied().collect();
        self.0.set_state(motion(hub), &blades, &circulation).map_err(py_error)
    }

    /// Does n sweeps; returns their RMS changes (n, 2) over R: all markers, first turn.
    fn sweep(&mut self, py: Python<'_>, n: usize) -> PyResult<Array> {
        let norms = py.detach(|| self.0.sweep(n)).map_err(py_error)?;
        Ok(array(norms.iter().flat_map(|norm| [norm.all, norm.first_turn]).collect::<Vec<_>>(), &[n]))
    }

    /// Inflow at the stations without that of the own near wake (n_azimuths, n_stations).
    fn inflow_far(&mut self, py: Python<'_>) -> Array {
        array(py.detach(|| self.0.inflow_far()), &[self.0.options().steps_per_revolution()])
    }

    /// Velocity (n, 3) [m/s] induced at points (n, 3) [m], blade 1 at the azimuth of row `azimuth_index`.
    fn wake_velocity(&self, py: Python<'_>, points: Table, azimuth_index: usize) -> PyResult<Array> {
        let points = columns("points", &points)?;
        Ok(vectors(py.detach(|| self.0.wake_velocity(&points, azimuth_index)), &[]))
    }

    /// Markers of every trailer, root to tip (n_azimuths, n_trailers, n_segments + 1, 3) [m].
    fn lattice(&self) -> Array {
        vectors(self.0.position().to_vec(), &self.rows())
    }

    /// Core radii of the segments of every trailer (n_azimuths, n_trailers, n_segments) [m].
    fn core_radius(&self) -> Array {
        array(self.0.core_radius(), &self.rows())
    }

    /// Circulation of the trailers released at every azimuth, root to tip (n_azimuths, n_trailers) [m2/s].
    fn released_circulation(&self) -> Array {
        array(self.0.released_circulation(), &self.rows()[..1])
    }
}

impl RelaxationWake {
    fn rows(&self) -> [usize; 2] {
        [self.0.options().steps_per_revolution(), self.0.options().trailers_per_blade()]
    }
}

/// Time-accurate wake.
#[pyclass(module = "wakeflight._core")]
#[derive(Clone)]
pub struct TimeMarchingWake(pub(crate) wake::TimeMarchingWake);

#[pymethods]
impl TimeMarchingWake {
    /// From a periodic wake with blade 1 at row `azimuth_index`, with the marching options of `options_json`.
    #[new]
    fn new(start: &RelaxationWake, azimuth_index: usize, options_json: &str) -> PyResult<Self> {
        let own = marching_options(options_json, start.0.options())?;
        wake::TimeMarchingWake::from_relaxation(&start.0, azimuth_index, own).map(Self).map_err(py_error)
    }

    /// One step of azimuth to the hub motion, the blades (n_blades, 3: psi, flap, lead) [rad] and the bound circulation
    /// (n_blades, n_stations) [m2/s].
    fn step(&mut self, py: Python<'_>, hub: Hub, blades: Table, circulation: Table) -> PyResult<()> {
        let blades = columns("blades", &blades)?.into_iter();
        let blades: Vec<_> = blades.map(|[psi, flap, lead]| BladeState { psi, flap, lead }).collect();
        let circulation: Vec<f64> = circulation.as_array().iter().copied().collect();
        py.detach(|| self.0.step(motion(hub), &blades, &circulation)).map_err(py_error)?;
        Ok(())
    }

    /// Velocity (n, 3) [m/s] induced at points (n, 3) [m].
    fn wake_velocity(&self, py: Python<'_>, points: Table) -> PyResult<Array> {
        let points = columns("points", &points)?;
        Ok(vectors(py.detach(|| self.0.wake_velocity(&points)), &[]))
    }

    /// Markers of every trailer, root to tip (n_blades, n_trailers, n_segments + 1, 3) [m].
    fn lattice(&self) -> Array {
        let options = self.0.options();
        vectors(self.0.position().to_vec(), &[options.rotor.n_blades, options.trailers_per_blade()])
    }

    /// Independent copy.
    fn copy(&self) -> Self {
        self.clone()
    }
}
