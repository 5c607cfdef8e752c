//! What bindings of rotors share.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::rotor::hub::Rotor;

/// Constants of a rotor that the coupling and the results need.
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
    d.set_item("area_weights", r.disk_mean().weights().to_vec())?;
    d.set_item("chords", r.blade.stations.iter().map(|s| s.geometry.chord).collect::<Vec<_>>())?;
    let modes = 0..r.blade.n_modes;
    d.set_item("frequencies", r.blade.modes.frequency[modes.clone()].to_vec())?;
    d.set_item("angle_per_coordinate", modes.map(|i| r.angle_per_coordinate(i)).collect::<Vec<_>>())?;
    d.set_item("tip_flap", r.blade.tip.w[0][..r.blade.n_modes].to_vec())?;
    d.set_item("tip_lead", r.blade.tip.v[0][..r.blade.n_modes].to_vec())?;
    d.set_item("tip_twist", r.blade.tip.theta[..r.blade.n_modes].to_vec())?;
    d.set_item("root_flap_slope", r.blade.root.w[1][..r.blade.n_modes].to_vec())?;
    d.set_item("root_lead_slope", r.blade.root.v[1][..r.blade.n_modes].to_vec())?;
    Ok(d)
}

/// Modal motion from coordinates and rates.
pub fn motion(q: impl Iterator<Item = f64>, q_dot: impl Iterator<Item = f64>) -> ModalMotion<f64> {
    let zero = [0.0; MAX_MODES];
    let mut m = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
    m.q.iter_mut().zip(q).for_each(|(a, b)| *a = b);
    m.q_dot.iter_mut().zip(q_dot).for_each(|(a, b)| *a = b);
    m
}
