//! The system: F, its Jacobian, trim equations, what a run records.

use crate::checks::{invalid, map, sized};
use crate::rotor::{motion, rotor_constants};
use crate::trim::{self, Motion, PyTrimLayout, PyTrimProblem};
use numpy::ndarray::Array;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use numpy::{PyReadwriteArray1, PyReadwriteArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use wakeflight::airframe::servo::Scheduled;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::surroundings::BladeInflow;
use wakeflight::numerics::frames::Vec3;
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::data::RotorData;
use wakeflight::rotor::passages::FIELDS;
use wakeflight::rotor::swashplate::{PitchHarmonic, Rigging};
use wakeflight::system::carrier::Stand;
use wakeflight::system::data::AircraftData;
use wakeflight::system::instant::{HeldInflow, Inputs, Instant};
use wakeflight::system::model::{Setting, System};
use wakeflight::trim::host::Host;
use wakeflight::trim::residual::Trim;

/// What acts on the system over one coupling step; see `wakeflight.flight`.
#[pyclass(name = "Inputs", frozen)]
pub struct PyInputs(pub(crate) Inputs);

#[pymethods]
impl PyInputs {
    /// Sticks [m] and rates [m/s] at `t_start` [s]; inflow (n_blades, n_stations), None for the states of y.
    #[new]
    #[pyo3(signature = (stick, stick_rate, t_start, inflow, mean_inflow, stabilator_incidence, vacuum=false))]
    fn new(
        stick: [f64; 4],
        stick_rate: [f64; 4],
        t_start: f64,
        inflow: Option<PyReadonlyArray2<f64>>,
        mean_inflow: f64,
        stabilator_incidence: f64,
        vacuum: bool,
    ) -> PyResult<Self> {
        let inflow = match (inflow, vacuum) {
            (_, true) => HeldInflow::Vacuum,
            (None, false) => HeldInflow::Dynamic,
            (Some(map), false) => {
                HeldInflow::Stations { inflow: map.as_array().iter().copied().collect(), mean: mean_inflow }
            }
        };
        Ok(Self(Inputs { stick, stick_rate, t_start, inflow: vec![inflow], stabilator_incidence }))
    }
}

impl PyInputs {
    /// The inputs, which must have an inflow for every rotor of `system`, of its stations.
    pub(crate) fn fitting(&self, system: &System) -> PyResult<&Inputs> {
        let (found, needed) = (self.0.inflow.len(), system.rotors.len());
        if found != needed {
            return Err(invalid(format!("inflow of {found} rotors, {needed} needed")));
        }
        for (held, (_, rotor, l)) in self.0.inflow.iter().zip(system.each_rotor()) {
            let needed = rotor.n_blades * rotor.inflow_width();
            match held {
                HeldInflow::Stations { inflow, .. } if inflow.len() != needed => {
                    return Err(invalid(format!("inflow has {} numbers, {needed} needed", inflow.len())));
                }
                HeldInflow::Dynamic if !l.dynamic_inflow => {
                    return Err(invalid("inflow: needed, there are no inflow states"));
                }
                _ => {}
            }
        }
        Ok(&self.0)
    }
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
        let data: RotorData = serde_json::from_str(data_json).map_err(invalid)?;
        let setting: Setting = serde_json::from_str(setting_json).map_err(invalid)?;
        let mut rotor = setting.rotor(&data, &Rigging::direct()).map_err(invalid)?;
        rotor.higher =
            higher.into_iter().map(|(order, cosine, sine)| PitchHarmonic { order, cosine, sine }).collect();
        let (velocity, rates) = motion;
        Ok(Self { inner: System::on_stand(Stand { velocity, rates }, vec![rotor], &setting) })
    }

    /// Names and units of the states, in order.
    fn state_names(&self) -> Vec<(String, &'static str)> {
        self.inner.layout.names()
    }

    /// Start indices of the parts of y: velocity, rates, attitude, position, per blade modal and modal_rate, inflow, tail.
    fn layout<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (layout, d) = (&self.inner.layout, PyDict::new(py));
        let l = layout.main();
        let span = |r: std::ops::Range<usize>| (r.start, r.end);
        d.set_item("n_blades", l.n_blades)?;
        d.set_item("n_modes", l.n_modes)?;
        d.set_item("modal", (0..l.n_blades).map(|b| span(l.modal(b))).collect::<Vec<_>>())?;
        d.set_item("modal_rate", (0..l.n_blades).map(|b| span(l.modal_rate(b))).collect::<Vec<_>>())?;
        d.set_item("inflow", span(l.inflow()))?;
        d.set_item("tail_inflow", span(layout.closed_inflow()))?;
        d.set_item("size", layout.len())?;
        Ok(d)
    }

    /// Constants of the rotor that the coupling and the results need.
    fn rotor<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        rotor_constants(py, self.inner.main())
    }

    /// F into `out`.
    fn residual(
        &self,
        t: f64,
        y: PyReadonlyArray1<f64>,
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
        mut out: PyReadwriteArray1<f64>,
    ) -> PyResult<()> {
        let n = self.inner.layout.len();
        let (y, y_dot) = (sized("y", y.as_slice()?, n)?, sized("y_dot", y_dot.as_slice()?, n)?);
        sized("out", out.as_slice()?, n)?;
        let at = Instant { t, y, y_dot, inputs: inputs.fitting(&self.inner)? };
        self.inner.residual_of_four(&at, out.as_slice_mut()?);
        Ok(())
    }

    /// y_dot that satisfies F = 0 at (t, y).
    fn consistent_rate<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        y: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let rate = self
            .inner
            .consistent_rate(
                t,
                sized("y", y.as_slice()?, self.inner.layout.len())?,
                inputs.fitting(&self.inner)?,
            )
            .map_err(|e| pyo3::exceptions::PyArithmeticError::new_err(e.to_string()))?;
        Ok(rate.into_pyarray(py))
    }

    /// a dF/dy + b dF/dy_dot into `out` (n, n).
    #[allow(clippy::too_many_arguments, reason = "the arguments of F and the two weights")]
    fn jacobian(
        &self,
        t: f64,
        y: PyReadonlyArray1<f64>,
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
        a: f64,
        b: f64,
        mut out: PyReadwriteArray2<f64>,
    ) -> PyResult<()> {
        let n = self.inner.layout.len();
        let (y, y_dot) = (sized("y", y.as_slice()?, n)?, sized("y_dot", y_dot.as_slice()?, n)?);
        sized("out", out.as_slice()?, n * n)?;
        let at = Instant { t, y, y_dot, inputs: inputs.fitting(&self.inner)? };
        self.inner.jacobian(&at, a, b, out.as_slice_mut()?);
        Ok(())
    }

    /// Layout of the unknowns and equations of a trim.
    fn trim_layout(&self, problem: &PyTrimProblem) -> PyResult<PyTrimLayout> {
        trim::layout(&self.inner, problem)
    }

    /// Residual of the trim equations.
    fn trim_residual<'py>(
        &self,
        py: Python<'py>,
        problem: &PyTrimProblem,
        x: PyReadonlyArray1<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        trim::residual(py, &self.inner, problem, &x)
    }

    /// Exact Jacobian of the trim equations (n, n).
    fn trim_jacobian<'py>(
        &self,
        py: Python<'py>,
        problem: &PyTrimProblem,
        x: PyReadonlyArray1<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        trim::jacobian(py, &self.inner, problem, &x)
    }

    /// Modal coordinates and rates (n_azimuths, n_modes) of the periodic motion.
    fn trim_motion<'py>(
        &self,
        py: Python<'py>,
        problem: &PyTrimProblem,
        x: PyReadonlyArray1<f64>,
        n_azimuths: usize,
    ) -> PyResult<Motion<'py>> {
        trim::motion(py, &self.inner, problem, &x, n_azimuths)
    }

    /// Airspeed [m/s], flight-path angle [rad], rate of turn [rad/s] of the trimmed flight.
    fn trim_path(&self, problem: &PyTrimProblem, x: PyReadonlyArray1<f64>) -> PyResult<(f64, f64, f64)> {
        let trim = Trim::new(&self.inner, &problem.0).map_err(invalid)?;
        let path = trim.layout.head(trim.checked(x.as_slice()?).map_err(invalid)?).path;
        Ok((path.speed, path.flight_path, path.turn_rate))
    }

    /// State and its rate at time `t` of the trimmed revolution.
    fn trim_state<'py>(
        &self,
        py: Python<'py>,
        problem: &PyTrimProblem,
        x: PyReadonlyArray1<f64>,
        t: f64,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let trim = Trim::new(&self.inner, &problem.0).map_err(invalid)?;
        let (y, y_dot) = trim.state(trim.checked(x.as_slice()?).map_err(invalid)?, t);
        Ok((y.into_pyarray(py), y_dot.into_pyarray(py)))
    }

    /// Stabilator incidence in trim [rad].
    fn trim_stabilator(&self, problem: &PyTrimProblem, x: PyReadonlyArray1<f64>) -> PyResult<f64> {
        let trim = Trim::new(&self.inner, &problem.0).map_err(invalid)?;
        let x = trim.checked(x.as_slice()?).map_err(invalid)?;
        Ok(trim.inputs(x, HeldInflow::Dynamic).stabilator_incidence)
    }

    /// Stabilator incidence [rad] after `delta_t` [s] on the way from `incidence` toward its schedule at state `y` and collective
    /// stick [m], within the rate of its servo; without a schedule it stays.
    fn followed_incidence(
        &self,
        incidence: f64,
        y: PyReadonlyArray1<f64>,
        collective: f64,
        delta_t: f64,
    ) -> PyResult<f64> {
        let y = y.as_slice()?;
        let y = sized("y", y, self.inner.layout.len())?;
        let (Some(airframe), &[u, v, w, _, pitch_rate, ..]) = (self.inner.carrier.airframe(), y) else {
            return Ok(incidence);
        };
        let density = self.inner.air.density;
        let seen = Scheduled { velocity: [u, v, w], pitch_rate, collective, density };
        Ok(airframe.followed_incidence(incidence, &seen, delta_t))
    }

    /// Hub velocity [m/s] and rates [rad/s], non-rotating hub axes as the rotor's sense has them.
    fn hub(&self, y: PyReadonlyArray1<f64>) -> PyResult<([f64; 3], [f64; 3])> {
        let hub = self.hub_at(y.as_slice()?)?;
        Ok((hub.velocity.array(), hub.omega.array()))
    }

    /// Equivalent rigid flap and lead angles [rad] for modal coordinates (n, n_modes).
    fn equivalent_angles<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let (rotor, rows) = (self.inner.main(), q.as_array().nrows());
        let n = rotor.blade.n_modes;
        let q = map("q", &q, rows, n)?;
        let angles = |k: usize| {
            rotor.equivalent_angles(&motion(q[k * n..(k + 1) * n].iter().copied(), std::iter::empty()))
        };
        let (flap, lead): (Vec<f64>, Vec<f64>) = (0..rows).map(angles).unzip();
        Ok((flap.into_pyarray(py), lead.into_pyarray(py)))
    }

    /// Circulation and near wake solved together for a set of blade instants.
    ///
    /// psi (m,), motion q and q_dot (m, n_modes), far inflow and start (m, n_stations); sticks with their rates. Returns circulation,
    /// total inflow (m, n_stations; of thin sections twice as wide), largest residual [m2/s], number that Newton did not find.
    #[allow(clippy::type_complexity, reason = "arrays")]
    fn solve_circulation<'py>(
        &self,
        py: Python<'py>,
        wake_options: &str,
        y: PyReadonlyArray1<f64>,
        sticks: (PyReadonlyArray1<f64>, PyReadonlyArray1<f64>),
        psi: PyReadonlyArray1<f64>,
        motion: (PyReadonlyArray2<f64>, PyReadonlyArray2<f64>),
        maps: (PyReadonlyArray2<f64>, PyReadonlyArray2<f64>),
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, f64, usize)> {
        let options = crate::options::wake_options(wake_options)?;
        let (hub, psi) = (self.hub_at(y.as_slice()?)?, psi.as_slice()?);
        let rotor = self.inner.main();
        let (m, n) = (psi.len(), rotor.blade.stations.len());
        let (stick, rate) = (sticks.0.as_slice()?, sticks.1.as_slice()?);
        let mut instants = Vec::with_capacity(m);
        for (&psi, modal) in psi.iter().zip(self.motions((&motion.0, &motion.1), m)?) {
            instants.push(BladeInstant { psi, modal, control: self.pitch(stick, rate, psi)? });
        }
        let (far, start) = (map("lambda_far", &maps.0, m, n)?, map("start", &maps.1, m, n)?);
        let all = py
            .detach(|| rotor.circulations(self.inner.air, &options, &hub, &instants, &far, &start))
            .map_err(crate::wake::py_error)?;
        let shape = |columns, v| Array::from_shape_vec((m, columns), v).map_err(invalid);
        let (gamma, inflow) = (shape(n, all.gamma)?, shape(rotor.inflow_width(), all.inflow)?);
        Ok((gamma.into_pyarray(py), inflow.into_pyarray(py), all.residual, all.followed))
    }

    /// Circulation [m2/s] of one blade's sections and its slope by inflow, for inflow (n_stations,) and a hub in motion: velocity
    /// [m/s], rates [rad/s]; `blade`: azimuth, modal coordinates and rates.
    #[allow(clippy::type_complexity, reason = "arrays")]
    fn section_circulation<'py>(
        &self,
        py: Python<'py>,
        hub: ([f64; 3], [f64; 3]),
        stick: PyReadonlyArray1<f64>,
        blade: (f64, PyReadonlyArray1<f64>, PyReadonlyArray1<f64>),
        inflow: PyReadonlyArray1<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let (rotor, stick) = (self.inner.main(), stick.as_slice()?);
        let zero = Vec3::zero();
        let (velocity, omega) = (Vec3::from_array(hub.0), Vec3::from_array(hub.1));
        let hub = HubMotion { velocity, acceleration_less_gravity: zero, omega, omega_dot: zero };
        let (psi, q, q_dot) = (blade.0, blade.1.as_slice()?, blade.2.as_slice()?);
        let n = rotor.blade.n_modes;
        let (q, q_dot) = (sized("q", q, n)?, sized("q_dot", q_dot, n)?);
        let modal = motion(q.iter().copied(), q_dot.iter().copied());
        let blade = BladeInstant { psi, modal, control: self.pitch(stick, &vec![0.0; stick.len()], psi)? };
        let lambda = sized("inflow", inflow.as_slice()?, rotor.blade.stations.len())?;
        let (mut gamma, mut slope) = (vec![0.0; lambda.len()], vec![0.0; lambda.len()]);
        rotor.section_circulation(self.inner.air, &hub, &blade, lambda, &mut gamma, &mut slope);
        Ok((gamma.into_pyarray(py), slope.into_pyarray(py)))
    }

    /// Loads of one blade on the hub and the air at its stations, for azimuths `psi` (m,) of the periodic motion `x` and total
    /// inflow (m, n_stations), None for the dynamic inflow in `x`: a dictionary of arrays, in the axes of the rotor's sense.
    fn passages<'py>(
        &self,
        py: Python<'py>,
        problem: &PyTrimProblem,
        x: PyReadonlyArray1<f64>,
        psi: PyReadonlyArray1<f64>,
        inflow: Option<PyReadonlyArray2<f64>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let trim = Trim::new(&self.inner, &problem.0).map_err(invalid)?;
        let x = trim.checked(x.as_slice()?).map_err(invalid)?;
        let (rotor, psi) = (self.inner.main(), psi.as_slice()?);
        let n = rotor.blade.stations.len();
        let width = inflow.as_ref().map_or(n, |map| map.as_array().ncols());
        if width != n && width != rotor.inflow_width() {
            return Err(invalid(format!("inflow must have the shape ({}, {n})", psi.len())));
        }
        let held = inflow.map(|given| map("inflow", &given, psi.len(), width)).transpose()?;
        if held.is_none() && !problem.0.is_dynamic() {
            return Err(invalid("inflow is needed: the problem has none of its own"));
        }
        let head = trim.layout.head(x);
        let hub = self.inner.carried(&head).hub;
        let passages = psi.iter().enumerate().map(|(row, &azimuth)| {
            let given = match &held {
                Some(map) => rotor.held_inflow(&map[row * width..(row + 1) * width]),
                None => BladeInflow::Disk(head.inflow),
            };
            let control = rotor.blade_pitch(head.controls, [0.0; 4], azimuth).into();
            (BladeInstant { psi: azimuth, modal: trim.motion(x, azimuth), control }, given)
        });
        let found = rotor.passages(self.inner.air, &hub, passages);
        let d = PyDict::new(py);
        let shape = |m, v| Array::from_shape_vec((psi.len(), m), v).map_err(invalid);
        for (name, values) in ["force", "moment", "aero_force", "aero_moment"].into_iter().zip(found.loads) {
            d.set_item(name, shape(3, values)?.into_pyarray(py))?;
        }
        for (name, values) in FIELDS.into_iter().zip(found.fields) {
            d.set_item(name, shape(n, values)?.into_pyarray(py))?;
        }
        Ok(d)
    }

    /// What a run records at an instant, as a dictionary of floats and arrays.
    fn outputs<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        y: PyReadonlyArray1<f64>,
        y_dot: PyReadonlyArray1<f64>,
        inputs: &PyInputs,
    ) -> PyResult<Bound<'py, PyDict>> {
        let n = self.inner.layout.len();
        let (y, y_dot) = (sized("y", y.as_slice()?, n)?, sized("y_dot", y_dot.as_slice()?, n)?);
        let at = Instant { t, y, y_dot, inputs: inputs.fitting(&self.inner)? };
        let mut all = self.inner.outputs(&at);
        let o = all.rotors.swap_remove(0);
        let n_blades = self.inner.main().n_blades;
        let d = PyDict::new(py);
        d.set_item("force", all.force)?;
        d.set_item("moment", all.moment)?;
        d.set_item("hub_force", o.hub_force)?;
        d.set_item("hub_moment", o.hub_moment)?;
        d.set_item("aero_force", o.aero_force)?;
        d.set_item("aero_moment", o.aero_moment)?;
        d.set_item("ct", o.ct)?;
        d.set_item("beta_1c", o.beta_1c)?;
        d.set_item("beta_1s", o.beta_1s)?;
        d.set_item("power", [o.power, all.power[0], all.power[1]])?;
        d.set_item("energy", all.energy)?;
        d.set_item("load_power", all.load_power)?;
        d.set_item("azimuth", o.azimuth)?;
        let fields = [
            ("inflow", o.inflow),
            ("circulation", o.circulation),
            ("cl", o.cl),
            ("cl_m2", o.cl_m2),
            ("alpha", o.alpha),
            ("mach", o.mach),
        ];
        for (name, values) in fields {
            let n = values.len() / n_blades;
            d.set_item(
                name,
                Array::from_shape_vec((n_blades, n), values).map_err(invalid)?.into_pyarray(py),
            )?;
        }
        Ok(d)
    }
}

/// Registers the classes of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PySystem>()?;
    m.add_class::<PyInputs>()
}
