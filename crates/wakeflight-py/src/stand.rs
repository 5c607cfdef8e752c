//! The isolated rotor on a stand: conversions only.

use crate::aircraft::invalid;
use crate::rotor::{motion, rotor_constants};
use crate::trim::{self, PyTrimLayout, PyTrimProblem};
use numpy::ndarray::Array;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyArithmeticError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use wakeflight::blade::aerodynamics::{Air, SectionAir};
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::loads::{BladeInflow, HubMotion};
use wakeflight::blade::model::Discretisation;
use wakeflight::blade::thin_section::SectionLift;
use wakeflight::inflow::pitt_peters::MassFlow;
use wakeflight::integrate::stand::BladeStep;
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::data::RotorData;
use wakeflight::rotor::swashplate::{PitchHarmonic, Rigging};
use wakeflight::system::carrier::{Carrier, Stand};
use wakeflight::system::model::{Setting, System};
use wakeflight::trim::residual::Trim;

/// Rotor of one condition on the stand. Names of the methods it shares with `Aircraft` are the same; y is hub velocity
/// and rates (6), a stick is theta_0, theta_1c, theta_1s.
#[pyclass(name = "Stand", frozen)]
pub struct PyStand {
    pub(crate) inner: System,
}

/// Controls theta_0, theta_1c, theta_1s as a system has them.
pub(crate) fn four([a, b, c]: [f64; 3]) -> [f64; 4] {
    [a, b, c, 0.0]
}

/// Motion of a hub that goes steadily at a velocity [m/s] and rates [rad/s], hub axes, with the weight of `system`.
pub(crate) fn hub_motion(system: &System, velocity: [f64; 3], rates: [f64; 3]) -> HubMotion<f64> {
    let carrier = Carrier::Stand(Stand { velocity, rates });
    carrier.hub_motion(system.main(), &[], &[], system.gravity)
}

pub(crate) fn hub_state(y: &[f64]) -> PyResult<([f64; 3], [f64; 3])> {
    match y {
        [u, v, w, p, q, r] => Ok(([*u, *v, *w], [*p, *q, *r])),
        _ => Err(invalid(format!("hub motion has {} numbers, 6 needed", y.len()))),
    }
}

#[pymethods]
impl PyStand {
    /// From the JSON of the rotor data, air, weight, discretisation; `free_wake` switches the tip loss off, `thin_sections`
    /// (with or without the Prandtl-Glauert factor) makes the blade a Weissinger one, `windmill` has dynamic inflow take the
    /// windmill brake state in descent; velocity [m/s] and rates [rad/s] of the hub through the air, hub axes.
    #[new]
    #[allow(clippy::too_many_arguments, reason = "the fields of the discretisation")]
    fn new(
        data_json: &str,
        density: f64,
        speed_of_sound: f64,
        gravity: f64,
        free_wake: bool,
        n_elements: usize,
        n_modes: usize,
        n_gauss: usize,
        n_stations: usize,
        reference_pitch: f64,
        higher: Vec<(usize, f64, f64)>,
        blade_model: &str,
        windmill: bool,
        velocity: [f64; 3],
        rates: [f64; 3],
    ) -> PyResult<Self> {
        let data: RotorData = serde_json::from_str(data_json).map_err(invalid)?;
        let discretisation = Discretisation { n_elements, n_modes, n_gauss, n_stations, reference_pitch };
        let lift = match blade_model {
            "lifting-line" => None,
            "second-order" => Some(SectionLift::Tables),
            "weissinger" => Some(SectionLift::Tangency { prandtl_glauert: true }),
            "weissinger-incompressible" => Some(SectionLift::Tangency { prandtl_glauert: false }),
            other => return Err(invalid(format!("blade_model = {other}: not a model of the blade"))),
        };
        let mass_flow = if windmill { MassFlow::WindmillBrake } else { MassFlow::Momentum };
        let air = Air { density, speed_of_sound };
        let setting = Setting { air, gravity, free_wake, discretisation, lift, mass_flow };
        let mut rotor = setting.rotor(&data, &Rigging::direct()).map_err(invalid)?;
        rotor.higher =
            higher.into_iter().map(|(order, cosine, sine)| PitchHarmonic { order, cosine, sine }).collect();
        Ok(Self { inner: System::on_stand(Stand { velocity, rates }, vec![rotor], &setting) })
    }

    /// Constants of the rotor that the coupling and the results need.
    fn rotor<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let d = rotor_constants(py, &self.inner.main())?;
        d.set_item("solidity", self.inner.main().solidity())?;
        Ok(d)
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
    ) -> PyResult<trim::Motion<'py>> {
        trim::motion(py, &self.inner, problem, &x, n_azimuths)
    }

    /// Hub motion (6): what the exchange calls the state. The motion is steady: there is no rate.
    fn trim_state<'py>(
        &self,
        py: Python<'py>,
        problem: &PyTrimProblem,
        x: PyReadonlyArray1<f64>,
        t: f64,
    ) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let _ = (problem, x, t);
        let (velocity, rates) = self.motion();
        let y = [velocity, rates].concat();
        (y.into_pyarray(py), vec![0.0; 6].into_pyarray(py))
    }

    /// Hub velocity [m/s] and rates [rad/s] of y.
    fn hub(&self, y: PyReadonlyArray1<f64>) -> PyResult<([f64; 3], [f64; 3])> {
        hub_state(y.as_slice()?)
    }

    /// Equivalent rigid flap and lead angles [rad] for modal coordinates (n, n_modes).
    #[allow(clippy::type_complexity, reason = "two arrays")]
    fn equivalent_angles<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<f64>,
    ) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let (flap, lead): (Vec<f64>, Vec<f64>) = q
            .as_array()
            .rows()
            .into_iter()
            .map(|row| self.inner.main().equivalent_angles(&motion(row.iter().copied(), std::iter::empty())))
            .unzip();
        (flap.into_pyarray(py), lead.into_pyarray(py))
    }

    /// Circulation [m2/s] of one blade's sections and its slope by inflow, for inflow (n_stations,).
    #[allow(clippy::too_many_arguments, clippy::type_complexity, reason = "the motion of a blade")]
    fn section_circulation<'py>(
        &self,
        py: Python<'py>,
        hub_velocity: [f64; 3],
        hub_rates: [f64; 3],
        stick: [f64; 3],
        psi: f64,
        q: PyReadonlyArray1<f64>,
        q_dot: PyReadonlyArray1<f64>,
        inflow: PyReadonlyArray1<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let hub = hub_motion(&self.inner, hub_velocity, hub_rates);
        let blade = BladeInstant {
            psi,
            modal: motion(q.as_slice()?.iter().copied(), q_dot.as_slice()?.iter().copied()),
            control: self.inner.main().blade_pitch(four(stick), [0.0; 4], psi).into(),
        };
        let lambda = inflow.as_slice()?;
        let (mut gamma, mut slope) = (vec![0.0; lambda.len()], vec![0.0; lambda.len()]);
        self.inner.main().section_circulation(self.inner.air, &hub, &blade, lambda, &mut gamma, &mut slope);
        Ok((gamma.into_pyarray(py), slope.into_pyarray(py)))
    }

    /// Loads of one blade on the hub (hub axes) and the air at its stations, for azimuths `psi` (m,) of the periodic motion
    /// `x` and total inflow (m, n_stations), None for the dynamic inflow in `x`: a dictionary of arrays.
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
        let stand = &self.inner;
        let psi = psi.as_slice()?;
        let n = stand.main().blade.stations.len();
        let held: Option<Vec<f64>> = inflow.map(|map| map.as_array().iter().copied().collect());
        let width = held.as_ref().map_or(n, |map| map.len() / psi.len().max(1));
        if held.as_ref().is_some_and(|map| map.len() != psi.len() * width) || !self.fits(width) {
            return Err(invalid(format!("inflow must have the shape ({}, {n})", psi.len())));
        }
        if held.is_none() && !problem.0.is_dynamic() {
            return Err(invalid("inflow is needed: the problem has none of its own"));
        }
        let head = trim.layout.head(x);
        let (velocity, rates) = self.motion();
        let hub = hub_motion(stand, velocity, rates);
        let passages = psi.iter().enumerate().map(|(row, &azimuth)| {
            let given = match &held {
                Some(map) => stand.main().held_inflow(&map[row * width..(row + 1) * width]),
                None => BladeInflow::Disk(head.inflow),
            };
            let control = stand.main().blade_pitch(head.controls, [0.0; 4], azimuth).into();
            (BladeInstant { psi: azimuth, modal: trim.motion(x, azimuth), control }, given)
        });
        self.loads(py, &hub, passages)
    }

    /// The same for blades at azimuths `psi` (m,) with a motion of their own (m, n_modes), pitch controls that move at the
    /// given rates, and held inflow.
    #[allow(clippy::too_many_arguments, reason = "the motion of the blades")]
    fn blade_passages<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<f64>,
        psi: PyReadonlyArray1<f64>,
        motion: Motion<'py>,
        controls: [f64; 3],
        control_rates: [f64; 3],
        inflow: PyReadonlyArray2<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (velocity, rates) = hub_state(y.as_slice()?)?;
        let psi = psi.as_slice()?;
        let motions = self.motions(&motion, psi.len())?;
        let map = self.rows_of_inflow(&inflow, psi.len())?;
        let width = self.inner.main().inflow_width();
        let passages = psi.iter().zip(motions).enumerate().map(|(row, (&psi, modal))| {
            let control = self.inner.main().blade_pitch(four(controls), four(control_rates), psi).into();
            let given = self.inner.main().held_inflow(&map[row * width..(row + 1) * width]);
            (BladeInstant { psi, modal, control }, given)
        });
        self.loads(py, &hub_motion(&self.inner, velocity, rates), passages)
    }

    /// Blades (m) after a step of time [s]: modal coordinates, rates and accelerations (m, n_modes); azimuths `psi` and
    /// `motion` at its start, pitch controls that move at the given rates from there on, inflow held.
    #[allow(clippy::too_many_arguments, reason = "the motion of the blades")]
    fn advance_blades<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<f64>,
        psi: PyReadonlyArray1<f64>,
        motion: Motion<'py>,
        controls: [f64; 3],
        control_rates: [f64; 3],
        inflow: PyReadonlyArray2<f64>,
        step: f64,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 3]> {
        let (velocity, rates) = hub_state(y.as_slice()?)?;
        let hub = hub_motion(&self.inner, velocity, rates);
        let psi = psi.as_slice()?.to_vec();
        let motions = self.motions(&motion, psi.len())?;
        let map = self.rows_of_inflow(&inflow, psi.len())?;
        let width = self.inner.main().inflow_width();
        let controls = [four(controls), four(control_rates)];
        let (rotor, air) = (self.inner.main(), self.inner.air);
        let advanced: Vec<ModalMotion<f64>> = py
            .detach(|| {
                let each = psi.iter().zip(motions).zip(map.chunks_exact(width));
                each.map(|((&psi, motion), inflow)| {
                    BladeStep { rotor, air, hub: &hub, psi, motion, controls, inflow, step }.advanced()
                })
                .collect::<Result<_, _>>()
            })
            .map_err(|e| PyArithmeticError::new_err(e.to_string()))?;
        let n = self.inner.main().blade.n_modes;
        let gathered = |part: fn(&ModalMotion<f64>) -> &[f64]| {
            let values: Vec<f64> = advanced.iter().flat_map(|m| part(m)[..n].iter().copied()).collect();
            Array::from_shape_vec((psi.len(), n), values).map_err(invalid).map(|a| a.into_pyarray(py))
        };
        Ok([gathered(|m| &m.q)?, gathered(|m| &m.q_dot)?, gathered(|m| &m.q_ddot)?])
    }
}

/// Modal coordinates, rates and accelerations (m, n_modes).
type Motion<'py> = (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>);

impl PyStand {
    /// Loads on the hub and air at the stations of blades at their instants, with their inflow.
    fn loads<'py, 'a>(
        &self,
        py: Python<'py>,
        hub: &HubMotion<f64>,
        passages: impl Iterator<Item = (BladeInstant, BladeInflow<'a, f64>)>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let stand = &self.inner;
        let mut loads: [Vec<f64>; 4] = Default::default();
        const FIELDS: [&str; 8] = ["cl", "cd", "cm", "alpha", "mach", "circulation", "speed", "inflow"];
        let mut fields: [Vec<f64>; 8] = Default::default();
        let mut rows = 0;
        for (blade, given) in passages {
            rows += 1;
            let (air, psi) = (stand.air, blade.psi);
            let b = stand.main().blade_loads(air, hub, psi, &blade.modal, &blade.control, &given);
            for (all, one) in loads.iter_mut().zip([b.force, b.moment, b.aero_force, b.aero_moment]) {
                all.extend(one.array());
            }
            let visit = |_: usize, air: &SectionAir<f64>, lambda: f64| {
                let values =
                    [air.cl, air.cd, air.cm, air.alpha, air.mach, air.circulation, air.speed, lambda];
                for (field, value) in fields.iter_mut().zip(values) {
                    field.push(value);
                }
            };
            stand.main().blade_air(air, hub, psi, &blade.modal, &blade.control, &given, visit);
        }
        let d = PyDict::new(py);
        let shape = |m, v| Array::from_shape_vec((rows, m), v).map_err(invalid);
        for (name, values) in ["force", "moment", "aero_force", "aero_moment"].into_iter().zip(loads) {
            d.set_item(name, shape(3, values)?.into_pyarray(py))?;
        }
        for (name, values) in FIELDS.into_iter().zip(fields) {
            d.set_item(name, shape(stand.main().blade.stations.len(), values)?.into_pyarray(py))?;
        }
        Ok(d)
    }

    /// Motions of `m` blades.
    fn motions(&self, given: &Motion, m: usize) -> PyResult<Vec<ModalMotion<f64>>> {
        let (q, q_dot, q_ddot) = (given.0.as_array(), given.1.as_array(), given.2.as_array());
        let n = self.inner.main().blade.n_modes;
        if [q.dim(), q_dot.dim(), q_ddot.dim()].iter().any(|&d| d != (m, n)) {
            return Err(invalid(format!("motion must have the shape ({m}, {n}) three times")));
        }
        let row = |k: usize| {
            let mut modal = motion(q.row(k).iter().copied(), q_dot.row(k).iter().copied());
            modal.q_ddot.iter_mut().zip(q_ddot.row(k)).for_each(|(a, &v)| *a = v);
            modal
        };
        Ok((0..m).map(row).collect())
    }

    /// Held inflow of `m` blades, row by row.
    fn rows_of_inflow(&self, inflow: &PyReadonlyArray2<f64>, m: usize) -> PyResult<Vec<f64>> {
        let (map, width) = (inflow.as_array(), self.inner.main().inflow_width());
        if map.dim() != (m, width) {
            return Err(invalid(format!("inflow must have the shape ({m}, {width})")));
        }
        Ok(map.iter().copied().collect())
    }
}

impl PyStand {
    /// Velocity [m/s] and rates [rad/s] of the hub.
    fn motion(&self) -> ([f64; 3], [f64; 3]) {
        match self.inner.carrier {
            Carrier::Stand(Stand { velocity, rates }) => (velocity, rates),
            Carrier::Airframe(_) => ([0.0; 3], [0.0; 3]),
        }
    }

    /// Whether a row of inflow may have this length: one value per station, or two with thin sections.
    fn fits(&self, width: usize) -> bool {
        let n = self.inner.main().blade.stations.len();
        width == n || (width == 2 * n && self.inner.main().thin.is_some())
    }
}

/// Registers the classes of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyStand>()
}
