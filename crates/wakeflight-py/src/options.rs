//! Options of the inflow models: told to Python, and read from it.

use crate::checks::invalid;
use crate::wake::py_error;
use pyo3::prelude::*;
use serde::Deserialize;
use wakeflight::inflow::AnnularOptions;
use wakeflight::wake::{MarchingOptions, RelaxationOptions, WakeOptions, WakeRotor};

/// Options of one model as Python gives them, group by group.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Given {
    rotor: Option<WakeRotor>,
    wake: WakeOptions,
    relaxation: Option<RelaxationOptions>,
    marching: Option<MarchingOptions>,
    annular: Option<AnnularOptions>,
}

fn read(options_json: &str) -> PyResult<Given> {
    serde_json::from_str(options_json).map_err(|e| invalid(format!("wake options: {e}")))
}

fn demanded<T>(group: Option<T>, name: &str) -> PyResult<T> {
    group.ok_or_else(|| invalid(format!("wake options: those of {name} are missing")))
}

/// Options that both free wakes share, with their rotor.
pub(crate) fn wake_options(options_json: &str) -> PyResult<WakeOptions> {
    let Given { rotor, wake, .. } = read(options_json)?;
    Ok(WakeOptions { rotor: demanded(rotor, "the rotor")?, ..wake })
}

/// Options of relaxation.
pub(crate) fn relaxation_options(options_json: &str) -> PyResult<RelaxationOptions> {
    demanded(read(options_json)?.relaxation, "relaxation")
}

/// Options of marching, for a wake that starts from one of the shared options `of`.
pub(crate) fn marching_options(options_json: &str, of: &WakeOptions) -> PyResult<MarchingOptions> {
    if wake_options(options_json)? != *of {
        return Err(invalid("wake options: not those of the wake that the march starts from"));
    }
    demanded(read(options_json)?.marching, "marching")
}

/// What is told of every option, as JSON: a list of objects, see `wakeflight.options`.
#[pyfunction]
pub fn option_descriptors() -> PyResult<String> {
    let groups = [
        WakeOptions::descriptors(),
        RelaxationOptions::descriptors(),
        MarchingOptions::descriptors(),
        AnnularOptions::descriptors(),
    ];
    serde_json::to_string(&groups.concat()).map_err(invalid)
}

/// Refuses options that do not go together, and with a rotor those that do not go with it.
#[pyfunction]
pub fn check_options(options_json: &str) -> PyResult<()> {
    let given = read(options_json)?;
    let wake = match given.rotor {
        Some(rotor) => WakeOptions { rotor, ..given.wake },
        None => given.wake,
    };
    // without vortices there is nothing that sheds
    let free = given.relaxation.is_some() || given.marching.is_some();
    let shed = if free { wake.check_shed_wake().and_then(|()| wake.check_blade_model()) } else { Ok(()) };
    let checked = given.rotor.map_or_else(|| wake.check_alone().and(shed), |_| wake.validate());
    let relaxation = given.relaxation.map_or(Ok(()), |own| own.validate());
    let marching = given.marching.map_or(Ok(()), |own| own.validate(&wake));
    let annular = given.annular.map_or(Ok(()), |own| own.check());
    checked.and(relaxation).and(marching).and(annular).map_err(py_error)
}
