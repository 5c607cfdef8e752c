//! Python bindings: conversions and checks only.
use pyo3::prelude::*;

mod atmosphere;
mod blade;
mod carrier;
mod checks;
mod exchange;
mod flight;
mod inflow;
mod options;
mod rotor;
mod system;
mod trim;
mod vortex;
mod wake;

/// The compiled core of wakeflight.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::atmosphere::standard_atmosphere;
    #[pymodule_export]
    use crate::blade::BladeModes;
    #[pymodule_export]
    use crate::exchange::{PyExchange, PySteadyWake, carrying_inflow};
    #[pymodule_export]
    use crate::flight::{FixedStep, Linearised};
    #[pymodule_export]
    use crate::inflow::{momentum_inflow, pitt_peters_rate};
    #[pymodule_export]
    use crate::options::{check_options, option_descriptors};
    #[pymodule_export]
    use crate::system::{PyInputs, PySystem};
    #[pymodule_export]
    use crate::trim::{TrimLayout, TrimProblem};
    #[pymodule_export]
    use crate::vortex::{induced_velocity, set_threads};
    #[pymodule_export]
    use crate::wake::{RelaxationWake, TimeMarchingWake, near_wake_matrix, wing_circulation};

    #[pymodule_export]
    #[expect(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
