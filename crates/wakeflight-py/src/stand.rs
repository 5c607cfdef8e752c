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
use wakeflight::blade::thin_section::{SectionLift, ThinSection};
use wakeflight::inflow::pitt_peters::{MassFlow, PittPeters};
use wakeflight::integrate::stand::BladeStep;
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::data::RotorData;
use wakeflight::rotor::hub::Rotor;
use wakeflight::rotor::stand::Stand;
use wakeflight::rotor::swashplate::{MovingPitch, PitchHarmonic, Rigging};
use wakeflight::trim::residual::Trim;

/// Rotor of one condition on the stand. Names of the methods it shares with `Aircraft` are the same; y is hub velocity
/// and rates (6), a stick is theta_0, theta_1c, theta_1s.
#[pyclass(name = "Stand", frozen)]
pub struct PyStand {
    pub(crate) inner: Stand,
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
        let rigging = Rigging { matrix: [[0.0; 4]; 4], offset: [0.0; 4], phase: 0.0 };
        let tip_loss_factor = if free_wake { 1.0 } else { data.tip_loss_factor };
        let mut rotor = Rotor::new(&data, rigging, tip_loss_factor, &discretisation).map_err(invalid)?;
        let lift = match blade_model {
            "lifting-line" => None,
            "second-order" => Some(SectionLift::Tables),
            "weissinger" => Some(SectionLift::Tangency { prandtl_glauert: true }),
            "weissinger-incompressible" => Some(SectionLift::Tangency { prandtl_glauert: false }),
            other => return Err(invalid(format!("blade_model = {other}: not a model of the blade"))),
        };
        rotor.thin = lift.map(|lift| ThinSection { lift });
        let air = Air { density, speed_of_sound };
        let mass_flow = if windmill { MassFlow::WindmillBrake } else { MassFlow::Momentum };
        let pitt_peters = PittPeters { mass_flow, ..PittPeters::default() };
        let higher =
            higher.into_iter().map(|(order, cosine, sine)| PitchHarmonic { order, cosine, sine }).collect();
        Ok(Self { inner: Stand { rotor, air, gravity, pitt_peters, higher, velocity, rates } })
    }

    /// Constants of the rotor that the coupling and the results need.
    fn rotor<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let d = rotor_constants(py, &self.inner.rotor)?;
        d.set_item("solidity", self.inner.rotor.solidity())?;
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
        let y = [self.inner.velocity, self.inner.rates].concat();
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
            .map(|row| self.inner.rotor.equivalent_angles(&motion(row.iter().copied(), std::iter::empty())))
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
        let hub = self.inner.hub(hub_velocity, hub_rates);
        let blade = BladeInstant {
            psi,
            modal: motion(q.as_slice()?.iter().copied(), q_dot.as_slice()?.iter().copied()),
            control: self.inner.pitch(stick, psi),
        };
        let lambda = inflow.as_slice()?;
        let (mut gamma, mut slope) = (vec![0.0; lambda.len()], vec![0.0; lambda.len()]);
        self.inner.rotor.section_circulation(self.inner.air, &hub, &blade, lambda, &mut gamma, &mut slope);
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
        let n = stand.rotor.blade.stations.len();
        let held: Option<Vec<f64>> = inflow.map(|map| map.as_array().iter().copied().collect());
        let width = held.as_ref().map_or(n, |map| map.len() / psi.len().max(1));
        if held.as_ref().is_some_and(|map| map.len() != psi.len() * width) || !self.fits(width) {
            return Err(invalid(format!("inflow must have the shape ({}, {n})", psi.len())));
        }
        if held.is_none() && !problem.0.is_dynamic() {
            return Err(invalid("inflow is needed: the problem has none of its own"));
        }
        let head = trim.layout.head(x);
        let [theta_0, theta_1c, theta_1s, _] = head.controls;
        let hub = stand.hub(stand.velocity, stand.rates);
        let passages = psi.iter().enumerate().map(|(row, &azimuth)| {
            let given = match &held {
                Some(map) => stand.rotor.held_inflow(&map[row * width..(row + 1) * width]),
                None => BladeInflow::Disk(head.inflow),
            };
            let control = stand.pitch([theta_0, theta_1c, theta_1s], azimuth);
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
        let width = self.inner.rotor.inflow_width();
        let pitch = MovingPitch { controls, rates: control_rates, higher: &self.inner.higher };
        let passages = psi.iter().zip(motions).enumerate().map(|(row, (&psi, modal))| {
            let control = pitch.at(0.0, psi, self.inner.rotor.omega).into();
            let given = self.inner.rotor.held_inflow(&map[row * width..(row + 1) * width]);
            (BladeInstant { psi, modal, control }, given)
        });
        self.loads(py, &self.inner.hub(velocity, rates), passages)
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
        let hub = self.inner.hub(velocity, rates);
        let psi = psi.as_slice()?.to_vec();
        let motions = self.motions(&motion, psi.len())?;
        let map = self.rows_of_inflow(&inflow, psi.len())?;
        let width = self.inner.rotor.inflow_width();
        let pitch = MovingPitch { controls, rates: control_rates, higher: &self.inner.higher };
        let advanced: Vec<ModalMotion<f64>> = py
            .detach(|| {
                let each = psi.iter().zip(motions).zip(map.chunks_exact(width));
                each.map(|((&psi, motion), inflow)| {
                    BladeStep { stand: &self.inner, hub: &hub, psi, motion, pitch, inflow, step }.advanced()
                })
                .collect::<Result<_, _>>()
            })
            .map_err(|e| PyArithmeticError::new_err(e.to_string()))?;
        let n = self.inner.rotor.blade.n_modes;
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
            let b = stand.rotor.blade_loads(air, hub, psi, &blade.modal, &blade.control, &given);
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
            stand.rotor.blade_air(air, hub, psi, &blade.modal, &blade.control, &given, visit);
        }
        let d = PyDict::new(py);
        let shape = |m, v| Array::from_shape_vec((rows, m), v).map_err(invalid);
        for (name, values) in ["force", "moment", "aero_force", "aero_moment"].into_iter().zip(loads) {
            d.set_item(name, shape(3, values)?.into_pyarray(py))?;
        }
        for (name, values) in FIELDS.into_iter().zip(fields) {
            d.set_item(name, shape(stand.rotor.blade.stations.len(), values)?.into_pyarray(py))?;
        }
        Ok(d)
    }

    /// Motions of `m` blades.
    fn motions(&self, given: &Motion, m: usize) -> PyResult<Vec<ModalMotion<f64>>> {
        let (q, q_dot, q_ddot) = (given.0.as_array(), given.1.as_array(), given.2.as_array());
        let n = self.inner.rotor.blade.n_modes;
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
        let (map, width) = (inflow.as_array(), self.inner.rotor.inflow_width());
        if map.dim() != (m, width) {
            return Err(invalid(format!("inflow must have the shape ({m}, {width})")));
        }
        Ok(map.iter().copied().collect())
    }
}

impl PyStand {
    /// Whether a row of inflow may have this length: one value per station, or two with thin sections.
    fn fits(&self, width: usize) -> bool {
        let n = self.inner.rotor.blade.stations.len();
        width == n || (width == 2 * n && self.inner.rotor.thin.is_some())
    }
}

/// Registers the classes of this file.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyStand>()
}
