//! Controllers of a flight: conversions and checks.

use crate::checks::{Array, Row, array, invalid, pack, unpack};
use crate::wind::{PyAir, airframe};
use pyo3::prelude::*;
use wakeflight::control::chain::{Acts, Answer, Chain};
use wakeflight::control::feedback::{Feedback, Law, Term};
use wakeflight::control::filters::{self, Smoothed};
use wakeflight::control::sensed::{Sensed, Signal};
use wakeflight::control::servos::Servos;
use wakeflight::control::{Sticks, Which};

/// State of dx/dt = (u - x)/tau within +-rate after `dt`, from `x`, while u goes from `u0` to `u1`; whether the rate held it.
#[pyfunction]
pub fn limited_lag(x: f64, u0: f64, u1: f64, dt: f64, tau: f64, rate: f64) -> (f64, bool) {
    filters::limited_lag(x, [u0, u1], dt, tau, rate)
}

/// Outputs of a lag [s], a washout [s] or both at samples `u`, each `dt` [s] after the one before, from rest.
#[pyfunction]
#[pyo3(signature = (u, dt, lag=None, washout=None))]
pub fn smoothed(u: Row, dt: Row, lag: Option<f64>, washout: Option<f64>) -> PyResult<Array> {
    let mut filter = Smoothed::new(lag, washout);
    let samples = u.as_slice()?.iter().zip(dt.as_slice()?);
    Ok(array(samples.map(|(&u, &dt)| filter.advance(u, dt)).collect::<Vec<_>>(), &[]))
}

/// The flight at one moment; see `wakeflight.control.Sensors`.
#[pyclass(name = "Sensed", subclass, frozen)]
pub struct PySensed(Sensed);

#[pymethods]
impl PySensed {
    /// Of states `y` over ground at an altitude [m], with the speed of the rotor [rad/s] and the air, where it moves.
    #[new]
    #[pyo3(signature = (y, ground, rotor_speed, air=None))]
    fn new(y: Row, ground: f64, rotor_speed: f64, air: Option<&PyAir>) -> PyResult<Self> {
        let y = airframe(&y)?;
        Ok(Self(Sensed::of(y, ground, rotor_speed, air.map(|air| air.inner.against(y)))))
    }

    #[getter]
    fn u(&self) -> f64 {
        self.0.velocity[0]
    }
    #[getter]
    fn v(&self) -> f64 {
        self.0.velocity[1]
    }
    #[getter]
    fn w(&self) -> f64 {
        self.0.velocity[2]
    }
    #[getter]
    fn p(&self) -> f64 {
        self.0.rates[0]
    }
    #[getter]
    fn q(&self) -> f64 {
        self.0.rates[1]
    }
    #[getter]
    fn r(&self) -> f64 {
        self.0.rates[2]
    }
    #[getter]
    fn north(&self) -> f64 {
        self.0.position[0]
    }
    #[getter]
    fn east(&self) -> f64 {
        self.0.position[1]
    }
    #[getter]
    fn down(&self) -> f64 {
        self.0.position[2]
    }
    #[getter]
    fn rotor_speed(&self) -> f64 {
        self.0.rotor_speed
    }
    /// Altitude above sea level [m].
    #[getter]
    fn altitude(&self) -> f64 {
        self.0.altitude()
    }
    /// Bank, right side down positive [rad].
    #[getter]
    fn roll(&self) -> f64 {
        self.0.roll()
    }
    /// Pitch attitude, nose up positive [rad].
    #[getter]
    fn pitch(&self) -> f64 {
        self.0.pitch()
    }
    /// Heading, nose right positive [rad].
    #[getter]
    fn yaw(&self) -> f64 {
        self.0.yaw()
    }
    /// Speed through the air [m/s].
    #[getter]
    fn airspeed(&self) -> f64 {
        self.0.airspeed()
    }
    /// Angle of the velocity through the air out of the plane of symmetry, from the right positive [rad].
    #[getter]
    fn sideslip(&self) -> f64 {
        self.0.sideslip()
    }
    /// Speed upward [m/s].
    #[getter]
    fn climb_rate(&self) -> f64 {
        self.0.climb_rate()
    }
    /// z of the earth (3,), body axes.
    #[getter]
    fn earth(&self) -> [f64; 3] {
        self.0.down()
    }
}

/// Feedback in a flight; see `wakeflight.control.blocks`.
#[pyclass(name = "Feedback")]
pub struct PyFeedback(Feedback);

#[pymethods]
impl PyFeedback {
    /// Of terms (index of the stick, inches for one of the signal, its name, whether it is an angle), time constants of lag and
    /// washout [s], airspeeds [m/s] from which it works and works fully, whether altitude counts from a path, most inches by stick.
    #[new]
    fn new(
        terms: Vec<(usize, f64, String, bool)>,
        constants: [Option<f64>; 2],
        above: Option<[f64; 2]>,
        path: bool,
        limits: Sticks,
    ) -> PyResult<Self> {
        let term = |(stick, size, name, angle): (usize, f64, String, bool)| match Signal::named(&name) {
            Some(signal) if stick < 4 => Ok(Term { stick, size, signal, angle }),
            _ => Err(invalid(format!("feedback of {name} to stick {stick}: neither may be new"))),
        };
        let terms = terms.into_iter().map(term).collect::<PyResult<_>>()?;
        Ok(Self(Feedback::new(Law { terms, constants, above, path, limits })))
    }

    /// Whether it feeds back the specific force to the right.
    #[getter]
    fn measures(&self) -> bool {
        self.0.measures()
    }

    /// Inches by stick (4,) at time `t` [s]; side_force [m/s2]: of laws that feed it back.
    #[pyo3(signature = (t, sensed, side_force=0.0))]
    fn step(&mut self, t: f64, sensed: &PySensed, side_force: f64) -> Sticks {
        self.0.step(t, &sensed.0, side_force)
    }

    /// Sticks on which its authority held it back in the last call (4,).
    #[getter]
    fn held(&self) -> Which {
        self.0.held()
    }

    /// What its answers to come depend on, exact.
    fn memory(&self) -> PyResult<Vec<u8>> {
        pack(self.0.past())
    }

    /// Goes on from `memory`.
    fn recall(&mut self, memory: &[u8]) -> PyResult<()> {
        self.0.recall(unpack("feedback", memory)?);
        Ok(())
    }
}

/// Servos: time constant [s], largest rate [rad/s], stops [rad], offset [rad], matrix [rad/m] and its inverse, where they are [rad].
type ServoRows = (f64, f64, [[f64; 2]; 4], Sticks, [Sticks; 4], [Sticks; 4], Sticks);

/// Controllers and servos of a flight, summed; see `wakeflight.control.chain`.
#[pyclass(name = "ControlChain")]
pub struct PyChain {
    inner: Chain,
    /// Members that are feedback, the others are asked elsewhere.
    laws: Vec<Option<Py<PyFeedback>>>,
}

#[pymethods]
impl PyChain {
    /// Of members, each with its feedback or none and how it acts: `series`, `own`, `parallel`; authority, scale and travel by stick;
    /// servos; sticks of the trim [m].
    #[new]
    fn new(
        members: Vec<(Option<Py<PyFeedback>>, String)>,
        measures: [Sticks; 3],
        servos: Option<ServoRows>,
        trim: Sticks,
    ) -> PyResult<Self> {
        let servos = servos.map(|(lag, rate, stops, offset, matrix, back, at)| Servos {
            lag,
            rate,
            stops,
            offset,
            matrix,
            back,
            at,
        });
        let (laws, acts): (Vec<_>, Vec<_>) = members.into_iter().unzip();
        let acts = acts.iter().map(|name| match name.as_str() {
            "series" => Ok(Acts::Series),
            "own" => Ok(Acts::OwnSeries),
            "parallel" => Ok(Acts::Parallel),
            _ => Err(invalid(format!("acts = {name}: allowed: series, own, parallel"))),
        });
        let acts = acts.collect::<PyResult<_>>()?;
        Ok(Self { inner: Chain::new(acts, measures, servos, trim), laws })
    }

    /// Asks the feedback of the members `due` at `t` [s]; the first whose answer is not finite.
    fn ask(
        &mut self,
        py: Python<'_>,
        t: f64,
        due: Vec<usize>,
        sensed: &PySensed,
        side_force: f64,
    ) -> Option<usize> {
        due.into_iter().find(|&k| {
            let Some(Some(law)) = self.laws.get(k) else { return false };
            let mut law = law.borrow_mut(py);
            let inches = law.0.step(t, &sensed.0, side_force);
            self.inner.answered(k, Answer { inches, held: law.0.held() });
            !inches.iter().all(|each| each.is_finite())
        })
    }

    /// Member `k` has answered: inches by stick, and sticks on which its own limits held it.
    fn answered(&mut self, k: usize, inches: Sticks, held: Which) {
        self.inner.answered(k, Answer { inches, held });
    }

    /// While the hands go along a straight line for `dt` [s]: sticks [m] as parallel members have moved them where it begins, and
    /// those that reach the blades at its two ends.
    fn advance(&mut self, hands0: Row, hands1: Row, dt: f64) -> PyResult<(Array, Array, Array)> {
        let hands = [four(&hands0)?, four(&hands1)?];
        let [from, to] = self.inner.advance(hands, dt);
        Ok((array(self.inner.moved(&hands[0]), &[]), array(from, &[]), array(to, &[])))
    }

    /// Inches added in series (4,).
    #[getter]
    fn series(&self) -> Array {
        array(self.inner.kept().series, &[])
    }

    /// Inches that parallel members move the stick by (4,).
    #[getter]
    fn parallel(&self) -> Array {
        array(self.inner.kept().parallel, &[])
    }

    /// What is added to the hands (4,) [m].
    #[getter]
    fn offset(&self) -> Array {
        array(self.inner.offset(), &[])
    }

    /// Sticks that stand for where the blades have been put (4,) [m].
    #[getter]
    fn reached(&self) -> Array {
        array(self.inner.kept().reached, &[])
    }

    /// Seconds that authority, rates and stops held (3, 4).
    #[getter]
    fn seconds(&self) -> [Sticks; 3] {
        self.inner.kept().seconds
    }

    /// What comes depends on, but for the feedback; exact.
    fn memory(&self) -> PyResult<Vec<u8>> {
        pack(self.inner.kept())
    }

    /// Goes on from `memory`.
    fn recall(&mut self, memory: &[u8]) -> PyResult<()> {
        self.inner.recall(unpack("control", memory)?);
        Ok(())
    }
}

fn four(row: &Row) -> PyResult<Sticks> {
    let values = row.as_slice()?;
    values.try_into().map_err(|_| invalid(format!("{} sticks, 4 needed", values.len())))
}
