//! Python bindings: conversions and checks only.
use pyo3::prelude::*;

mod airfoil;
mod atmosphere;
mod blade;
mod carrier;
mod checks;
mod control;
mod exchange;
mod flight;
mod inflow;
mod inputs;
mod options;
mod system;
mod trim;
mod vortex;
mod wake;
mod wind;

/// The compiled core of wakeflight.
#[pymodule]
mod _core {
    #[pymodule_export]
    #[expect(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    use crate::{
        airfoil::{AirfoilCycle, airfoil_cycle, unsteady_models},
        atmosphere::standard_atmosphere,
        blade::BladeModes,
        control::{PyChain, PyFeedback, PySensed, limited_lag, smoothed},
        exchange::{PyExchange, PySteadyWake},
        flight::{FixedStep, Linearised},
        inflow::{descent_inflow, momentum_inflow, pitt_peters_rate},
        inputs::{PyInputs, SectionMemory},
        options::{check_options, option_descriptors},
        system::PySystem,
        trim::{TrimLayout, TrimProblem},
        vortex::{build_commit, induced_velocity, instruction_set, set_threads, threads_used},
        wake::{RelaxationWake, TimeMarchingWake, near_wake_matrix, wing_circulation},
        wind::{PyAir, PyPlaces, PyWind},
    };
}
