//! The system: F, its Jacobian, trim equations, what a run records.

use crate::checks::{
    Array, Named, Room, Row, Table, array, failed, instruction_set, invalid, map, room, sized,
};
use crate::inputs::{PyInputs, SectionMemory, remembered};
use crate::trim::{TrimLayout, TrimProblem};
use numpy::Ix2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use wakeflight::airframe::servo::Scheduled;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::memory_rows::MemoryRows;
use wakeflight::numerics::frames::Vec3;
use wakeflight::rotor::data::RotorData;
use wakeflight::rotor::drive::Drive;
use wakeflight::rotor::passages::FIELDS;
use wakeflight::rotor::speed::{RotorSpeed, SpeedHistory};
use wakeflight::rotor::swashplate::{PitchHarmonic, Rigging};
use wakeflight::system::blades::Controls;
use wakeflight::system::carrier::Stand;
use wakeflight::system::data::AircraftData;
use wakeflight::system::instant::HeldInflow;
use wakeflight::system::model::{Setting, System};

/// One of the things that a run records.
#[derive(IntoPyObject)]
enum Value {
    Number(f64),
    Vector([f64; 3]),
    Numbers(Vec<f64>),
    Array(Array),
}

/// Carrier with its rotors of one condition: an aircraft, or a rotor on a stand.
#[pyclass(name = "System", frozen)]
pub struct PySystem {
    pub(crate) inner: System,
}

#[pymethods]
impl PySystem {
    /// An aircraft in flight, from the JSON of its data and of the setting: air, gravity, free wake, discretisation ...
    #[staticmethod]
    fn aircraft(data_json: &str, setting_json: &str) -> PyResult<Self> {
        instruction_set()?;
        let data: AircraftData = serde_json::from_str(data_json).map_err(invalid)?;
        let setting: Setting = serde_json::from_str(setting_json).map_err(invalid)?;
        Ok(Self { inner: System::aircraft(&data, &setting).map_err(invalid)? })
    }

    /// A rotor on a stand that goes at `motion`, velocity [m/s] and rates [rad/s], hub axes; `higher` harmonics of its pitch
    /// (order, cosine, sine [rad]).
    #[staticmethod]
    fn stand(
        data_json: &str,
        setting_json: &str,
        motion: ([f64; 3], [f64; 3]),
        higher: Vec<(usize, f64, f64)>,
    ) -> PyResult<Self> {
        instruction_set()?;
        let data: RotorData = serde_json::from_str(data_json).map_err(invalid)?;
        let setting: Setting = serde_json::from_str(setting_json).map_err(invalid)?;
        let mut rotor = setting.rotor(&data, &Rigging::direct()).map_err(invalid)?;
        rotor.higher =
            higher.into_iter().map(|(order, cosine, sine)| PitchHarmonic { order, cosine, sine }).collect();
        let (velocity, rates) = motion;
        Ok(Self { inner: System::on_stand(Stand { velocity, rates }, vec![rotor], &setting) })
    }

    /// The same system, its first rotor at a speed linear between `corners`, time [s] and speed [rad/s], steady before and after.
    fn with_rotor_speed(&self, corners: Vec<(f64, f64)>) -> PyResult<Self> {
        let mut inner = self.inner.clone();
        inner.rotors[0].speed = RotorSpeed::Prescribed(SpeedHistory::new(&corners).map_err(invalid)?);
        Ok(Self { inner })
    }

    /// The same system above flat ground, its first hub, with the airframe level, at `height` [m] where a flight begins.
    fn above_ground(&self, height: f64) -> Self {
        Self { inner: self.inner.clone().above_ground(height) }
    }

    /// Least height above ground [m] of the places of the airframe at `y`; None without ground.
    fn least_height(&self, y: Row) -> PyResult<Option<f64>> {
        Ok(self.inner.least_height(self.state("y", &y)?))
    }

    /// The same system, its first rotor turned by a drive, from its JSON: azimuth and speed are states.
    fn with_drive(&self, drive_json: &str) -> PyResult<Self> {
        let drive: Drive = serde_json::from_str(drive_json).map_err(invalid)?;
        Ok(Self { inner: self.inner.clone().with_drive(drive).map_err(invalid)? })
    }

    /// The same system, its first rotor constant in speed over the ground: azimuth and speed are states.
    fn over_ground(&self) -> Self {
        Self { inner: self.inner.clone().over_ground() }
    }

    /// Angle [rad] by which the first blade has turned at time `t` [s].
    fn turned(&self, t: f64) -> f64 {
        self.inner.main().turned(t)
    }

    /// Time [s] at which the first blade has turned by `psi` [rad].
    fn time(&self, psi: f64) -> f64 {
        self.inner.main().time(psi)
    }

    /// Names and units of the states, in order.
    fn state_names(&self) -> Vec<(String, &'static str)> {
        self.inner.layout.names()
    }

    /// Start indices of the parts of y: velocity, rates, attitude, position, per blade modal and modal_rate, inflow, azimuth
    /// with speed and engines, tail.
    fn layout<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (layout, d) = (&self.inner.layout, PyDict::new(py));
        let l = layout.main();
        let span = |r: std::ops::Range<usize>| (r.start, r.end);
        d.set_item("n_blades", l.n_blades)?;
        d.set_item("n_modes", l.n_modes)?;
        d.set_item("modal", (0..l.n_blades).map(|b| span(l.modal(b))).collect::<Vec<_>>())?;
        d.set_item("modal_rate", (0..l.n_blades).map(|b| span(l.modal_rate(b))).collect::<Vec<_>>())?;
        d.set_item("inflow", span(l.inflow()))?;
        d.set_item("turn", span(l.turn()))?;
        d.set_item("tail_inflow", span(layout.closed_inflow()))?;
        d.set_item("size", layout.len())?;
        Ok(d)
    }

    /// Constants of the rotor that the coupling and the results need.
    fn rotor<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (d, r) = (PyDict::new(py), self.inner.main());
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
        d.set_item("root_lead_slope", &r.blade.root.v[1][..n])?;
        Ok(d)
    }

    /// F into `out`.
    fn residual(&self, t: f64, y: Row, y_dot: Row, inputs: &PyInputs, mut out: Room) -> PyResult<()> {
        let out = room(&mut out, self.inner.layout.len())?;
        self.inner.residual_of_four(&self.at(t, &y, &y_dot, inputs)?, out);
        Ok(())
    }

    /// y_dot that satisfies F = 0 at (t, y).
    fn consistent_rate(&self, t: f64, y: Row, inputs: &PyInputs) -> PyResult<Array> {
        let (y, inputs) = (self.state("y", &y)?, inputs.fitting(self)?);
        Ok(array(self.inner.consistent_rate(t, y, inputs).map_err(failed)?, &[]))
    }

    /// a dF/dy + b dF/dy_dot with the weights (a, b) into `out` (n, n).
    fn jacobian(
        &self,
        t: f64,
        y: Row,
        y_dot: Row,
        inputs: &PyInputs,
        weights: (f64, f64),
        mut out: Room<Ix2>,
    ) -> PyResult<()> {
        let n = self.inner.layout.len();
        let out = room(&mut out, n * n)?;
        self.inner.jacobian(&self.at(t, &y, &y_dot, inputs)?, weights.0, weights.1, out);
        Ok(())
    }

    /// dF/du by controls, their rates, stabilator, held inflow, wind, rotor speed: name and unit of every column, entries
    /// (n, columns).
    fn input_slopes(
        &self,
        t: f64,
        y: Row,
        y_dot: Row,
        inputs: &PyInputs,
    ) -> PyResult<(Vec<(String, &'static str)>, Array)> {
        let slopes = self.inner.input_slopes(&self.at(t, &y, &y_dot, inputs)?).map_err(invalid)?;
        Ok((slopes.names, array(slopes.values, &[self.inner.layout.len()])))
    }

    /// Layout of the unknowns and equations of a trim.
    fn trim_layout(&self, problem: &TrimProblem) -> PyResult<TrimLayout> {
        Ok(problem.on(&self.inner)?.layout.into())
    }

    /// Residual of the trim equations.
    fn trim_residual(&self, py: Python<'_>, problem: &TrimProblem, x: Row) -> PyResult<Array> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        let mut f = vec![0.0; x.len()];
        py.detach(|| trim.residual_of_four(x, &mut f));
        Ok(array(f, &[]))
    }

    /// Exact Jacobian of the trim equations (n, n).
    fn trim_jacobian(&self, py: Python<'_>, problem: &TrimProblem, x: Row) -> PyResult<Array> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        let mut j = vec![0.0; x.len() * x.len()];
        py.detach(|| trim.jacobian(x, &mut j));
        Ok(array(j, &[x.len()]))
    }

    /// Modal coordinates and rates (n_azimuths, n_modes) of the periodic motion.
    fn trim_motion(&self, problem: &TrimProblem, x: Row, n_azimuths: usize) -> PyResult<(Array, Array)> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        let (q, q_dot) = trim.motions(x, n_azimuths);
        Ok((array(q, &[n_azimuths]), array(q_dot, &[n_azimuths])))
    }

    /// Airspeed [m/s], flight-path angle [rad], rate of turn [rad/s] of the trimmed flight.
    fn trim_path(&self, problem: &TrimProblem, x: Row) -> PyResult<(f64, f64, f64)> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        let path = trim.layout.head(x).path;
        Ok((path.speed, path.flight_path, path.turn_rate))
    }

    /// State and its rate at time `t` of the trimmed revolution.
    fn trim_state(&self, problem: &TrimProblem, x: Row, t: f64) -> PyResult<(Array, Array)> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        let (y, y_dot) = trim.state(x, t);
        Ok((array(y, &[]), array(y_dot, &[])))
    }

    /// Stabilator incidence in trim [rad].
    fn trim_stabilator(&self, problem: &TrimProblem, x: Row) -> PyResult<f64> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        Ok(trim.inputs(x, HeldInflow::Dynamic).stabilator_incidence)
    }

    /// Stabilator incidence [rad] after `delta_t` [s] on the way from `incidence` toward its schedule at state `y` and collective
    /// stick [m], within the rate of its servo; without a schedule it stays.
    fn followed_incidence(&self, incidence: f64, y: Row, collective: f64, delta_t: f64) -> PyResult<f64> {
        let (Some(airframe), &[u, v, w, _, pitch_rate, ..]) =
            (self.inner.carrier.airframe(), self.state("y", &y)?)
        else {
            return Ok(incidence);
        };
        let density = self.inner.air.density;
        let seen = Scheduled { velocity: [u, v, w], pitch_rate, collective, density };
        Ok(airframe.followed_incidence(incidence, &seen, delta_t))
    }

    /// Hub velocity [m/s] and rates [rad/s], non-rotating hub axes as the rotor's sense has them.
    fn hub(&self, y: Row) -> PyResult<([f64; 3], [f64; 3])> {
        let hub = self.hub_at(&y)?;
        Ok((hub.velocity.array(), hub.omega.array()))
    }

    /// Equivalent rigid flap and lead angles [rad] for modal coordinates (n, n_modes).
    fn equivalent_angles(&self, q: Table) -> PyResult<(Array, Array)> {
        let (rotor, rows) = (self.inner.main(), q.as_array().nrows());
        let motions = self.motions(&(q.clone(), q), rows)?;
        let (flap, lead): (Vec<f64>, Vec<f64>) = motions.iter().map(|m| rotor.equivalent_angles(m)).unzip();
        Ok((array(flap, &[]), array(lead, &[])))
    }

    /// Quasi-steady circulation (n_stations,) [m2/s] of one blade's sections for inflow (n_stations,) and a hub in motion: velocity
    /// [m/s], rates [rad/s]; `blade`: azimuth, modal coordinates and rates.
    fn section_circulation(
        &self,
        hub: ([f64; 3], [f64; 3]),
        stick: Row,
        blade: (f64, Row, Row),
        inflow: Row,
    ) -> PyResult<Array> {
        let (rotor, zero) = (self.inner.main(), Vec3::zero());
        let (velocity, omega) = (Vec3::from_array(hub.0), Vec3::from_array(hub.1));
        let hub = HubMotion { velocity, acceleration_less_gravity: zero, omega, omega_dot: zero };
        let n = rotor.blade.n_modes;
        let modal = ModalMotion::of(sized("q", &blade.1, n)?, sized("q_dot", &blade.2, n)?);
        let blade = self.inner.blade_at(blade.0, modal, &Controls::held(self.controls("stick", &stick)?));
        let lambda = sized("inflow", &inflow, rotor.blade.stations.len())?;
        let (mut gamma, mut slope) = (vec![0.0; lambda.len()], vec![0.0; lambda.len()]);
        rotor.section_circulation(self.inner.air, &hub, (&blade).into(), lambda, &mut gamma, &mut slope);
        Ok(array(gamma, &[]))
    }

    /// Angles of blades at their hinges [rad], flap up and lead forward positive, for modal coordinates (n, n_modes).
    fn hinge_angles(&self, q: Table) -> PyResult<(Array, Array)> {
        let (rotor, rows) = (self.inner.main(), q.as_array().nrows());
        let motions = self.motions(&(q.clone(), q), rows)?;
        let (flap, lead): (Vec<f64>, Vec<f64>) = motions.iter().map(|m| rotor.hinge_angles(m)).unzip();
        Ok((array(flap, &[]), array(lead, &[])))
    }

    /// Lift, drag and moment coefficients of the tables of the stations for angles of attack [rad] and Mach numbers
    /// (rows, n_stations).
    fn section_coefficients(&self, alpha: Table, mach: Table) -> PyResult<[Array; 3]> {
        let (rotor, rows) = (self.inner.main(), alpha.as_array().nrows());
        let n = rotor.blade.stations.len();
        let found =
            rotor.section_coefficients(&map("alpha", &alpha, rows, n)?, &map("mach", &mach, rows, n)?);
        Ok(found.map(|each| array(each, &[rows])))
    }

    /// Memory of sections that remember at time `t` [s] of the trimmed revolution; None where they do not.
    fn trim_sections(&self, problem: &TrimProblem, x: Row, t: f64) -> PyResult<Option<SectionMemory>> {
        let (trim, x) = problem.solved(&self.inner, &x)?;
        Ok(remembered(&trim.memory_at(x, t)))
    }

    /// Loads of one blade on the hub and the air at its stations, for azimuths `psi` (m,) of the periodic motion `x` and total
    /// inflow (m, n_stations), None for the dynamic inflow in `x`: a dictionary of arrays, in the axes of the rotor's sense.
    /// `sections`: memory, (m,) blades together, of sections that remember; None: that of the periodic motion.
    #[pyo3(signature = (problem, x, psi, inflow, sections=None))]
    fn passages(
        &self,
        problem: &TrimProblem,
        x: Row,
        psi: Row,
        inflow: Option<Table>,
        sections: Option<Vec<PyRef<SectionMemory>>>,
    ) -> PyResult<Named<Array>> {
        let ((trim, x), psi) = (problem.solved(&self.inner, &x)?, psi.as_slice()?);
        let held = inflow.map(|given| self.inflow(&given, psi.len())).transpose()?;
        let memory = sections.map(|all| MemoryRows::joined(all.iter().map(|each| &each.0)));
        let found = trim.passages(x, psi, held.as_deref(), memory.as_ref()).map_err(invalid)?;
        let names = ["force", "moment", "aero_force", "aero_moment"].into_iter().chain(FIELDS);
        let values = found.loads.into_iter().chain(found.fields);
        Ok(names.zip(values.map(|each| array(each, &[psi.len()]))).collect())
    }

    /// What a run records at an instant, as a dictionary of floats and arrays.
    fn outputs(&self, t: f64, y: Row, y_dot: Row, inputs: &PyInputs) -> PyResult<Named<Value>> {
        let mut all = self.inner.outputs(&self.at(t, &y, &y_dot, inputs)?);
        let o = all.rotors.swap_remove(0);
        let blades = |values: Vec<f64>| Value::Array(array(values, &[self.inner.main().n_blades]));
        Ok(Named(vec![
            ("force", Value::Vector(all.force)),
            ("moment", Value::Vector(all.moment)),
            ("hub_force", Value::Vector(o.hub_force)),
            ("hub_moment", Value::Vector(o.hub_moment)),
            ("aero_force", Value::Vector(o.aero_force)),
            ("aero_moment", Value::Vector(o.aero_moment)),
            ("ct", Value::Number(o.ct)),
            ("beta_1c", Value::Number(o.beta_1c)),
            ("beta_1s", Value::Number(o.beta_1s)),
            ("power", Value::Vector([o.power, all.power[0], all.power[1]])),
            ("rotor_speed", Value::Number(o.speed)),
            ("engine_torque", Value::Number(o.engine_torque.unwrap_or_default())),
            ("energy", Value::Number(all.energy)),
            ("load_power", Value::Number(all.load_power)),
            ("azimuth", Value::Numbers(o.azimuth)),
            ("inflow", blades(o.inflow)),
            ("circulation", blades(o.circulation)),
            ("cl", blades(o.cl)),
            ("cl_m2", blades(o.cl_m2)),
            ("alpha", blades(o.alpha)),
            ("mach", blades(o.mach)),
        ]))
    }
}
