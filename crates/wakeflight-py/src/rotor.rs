//! What of a rotor the coupling and the results need.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use wakeflight::rotor::hub::Rotor;

/// Its constants by name.
pub fn rotor_constants<'py>(py: Python<'py>, r: &Rotor) -> PyResult<Bound<'py, PyDict>> {
    let d = PyDict::new(py);
    d.set_item("omega", r.omega)?;
    d.set_item("radius", r.blade.radius)?;
    d.set_item("hinge_offset", r.hinge())?;
    d.set_item("n_blades", r.n_blades)?;
    d.set_item("rigid", r.blade.rigid.is_some())?;
    d.set_item("solidity", r.solidity())?;
    d.set_item("hand", r.sense.hand())?;
    d.set_item("flap_mode", r.blade.flap_mode)?;
    d.set_item("flap_per_coordinate", r.flap_per_coordinate())?;
    d.set_item("blade_mass", r.blade.mass)?;
    d.set_item("stations", r.blade.stations.iter().map(|s| s.shapes.x).collect::<Vec<_>>())?;
    d.set_item("widths", r.blade.stations.iter().map(|s| s.geometry.width).collect::<Vec<_>>())?;
    d.set_item("area_weights", r.disk_mean().weights())?;
    d.set_item("chords", r.blade.stations.iter().map(|s| s.geometry.chord).collect::<Vec<_>>())?;
    let n = r.blade.n_modes;
    d.set_item("angle_per_coordinate", (0..n).map(|i| r.angle_per_coordinate(i)).collect::<Vec<_>>())?;
    d.set_item("frequencies", &r.blade.modes.frequency[..n])?;
    d.set_item("tip_flap", &r.blade.tip.w[0][..n])?;
    d.set_item("tip_lead", &r.blade.tip.v[0][..n])?;
    d.set_item("tip_twist", &r.blade.tip.theta[..n])?;
    d.set_item("root_flap_slope", &r.blade.root.w[1][..n])?;
    d.set_item("root_lead_slope", &r.blade.root.v[1][..n])?;
    Ok(d)
}
