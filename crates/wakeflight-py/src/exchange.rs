//! The exchange with the air, and the steady wake of a trim: conversions and checks, the GIL released.

use crate::checks::{Array, Motion, Named, Row, Table, array, invalid, map, pack, unpack, vectors};
use crate::inputs::{PyInputs, SectionMemory, remembered};
use crate::options::{marching_options, relaxation_options, wake_options};
use crate::system::PySystem;
use crate::wake::{RelaxationWake, TimeMarchingWake, py_error};
use crate::wind::PyAir;
use pyo3::prelude::*;
use wakeflight::rotor::exchange::{
    Exchange, MarchingExchange, Place, Reached, RelaxationExchange, SteadyWake,
};
use wakeflight::system::instant::Instant;
use wakeflight::wake;

/// Relaxation wake of a periodic motion with its circulation and inflow; see `wakeflight.trim.wake`.
#[pyclass(name = "SteadyWake", module = "wakeflight._core")]
pub struct PySteadyWake(SteadyWake);

#[pymethods]
impl PySteadyWake {
    /// On an inflow map (n_azimuths, n_stations); `steadied`: shorter steps of the geometry are taken where it circles.
    #[new]
    fn new(core: &PySystem, options_json: &str, steadied: bool, inflow: Table) -> PyResult<Self> {
        let (options, own) = (wake_options(options_json)?, relaxation_options(options_json)?);
        options.validate().map_err(py_error)?;
        let inflow = map("inflow", &inflow, options.steps_per_revolution(), options.n_stations)?;
        Ok(Self(SteadyWake::new(options, own, steadied, core.inner.main(), inflow)))
    }

    /// Iterates wake and circulation for hub motion `y`, sticks, and a periodic blade motion (n_azimuths, n_modes), at most `most`
    /// times.
    fn converge(
        &mut self,
        py: Python<'_>,
        core: &PySystem,
        y: Row,
        stick: Row,
        motion: Motion,
        most: usize,
    ) -> PyResult<()> {
        let (hub, motions) = (core.hub_at(&y)?, core.motions(&motion, self.0.n_azimuths())?);
        let blades = core.inner.periodic_blades(&motions, core.controls("stick", &stick)?);
        let place = core.place(&hub, &y)?;
        py.detach(|| self.0.converge(&place, &blades, most)).map_err(py_error)?;
        Ok(())
    }

    /// The motion has changed: means of passes before tell nothing of the inflow to come.
    fn forget_means(&mut self) {
        self.0.forget_means();
    }

    /// Bound circulation (n_azimuths, n_stations) [m2/s].
    #[getter]
    fn circulation(&self) -> Array {
        array(&self.0.circulation[..], &[self.0.n_azimuths()])
    }

    /// Total inflow (n_azimuths, n_stations), of thin sections at both lines of the chord.
    #[getter]
    fn inflow(&self) -> Array {
        array(&self.0.inflow[..], &[self.0.n_azimuths()])
    }

    /// A copy of the wake; None before the first motion.
    #[getter]
    fn relaxation(&self) -> Option<RelaxationWake> {
        self.0.wake.clone().map(RelaxationWake)
    }

    /// Air at fuselage, stabilator, fin and tail rotor of the airframe of `core` (4, 3) [m/s], body axes, mean over the passage of a
    /// blade; None where they do not feel the wake.
    fn wash(&self, core: &PySystem) -> Option<Array> {
        self.0.wash().map(|wash| vectors(core.inner.washed(&wash).to_vec(), &[]))
    }

    /// Whether the last pass ended at rest.
    #[getter]
    fn converged(&self) -> bool {
        self.0.converged
    }

    /// Changes of the last iteration by name; empty before the first.
    #[getter]
    fn last(&self) -> Named<f64> {
        self.0.last.iter().flat_map(|last| last.named()).collect()
    }

    /// Largest changes in an iteration that count as rest, by name.
    #[getter]
    fn allowed(&self) -> Named<f64> {
        self.0.allowed().named().into_iter().collect()
    }

    /// Of a wake that circles: standard error of the mean of its passes, and largest distance from it in the last one (rms).
    #[getter]
    fn circling(&self) -> (f64, f64) {
        (self.0.mean_error, self.0.wander)
    }

    /// Sweeps, circulations that Newton did not find from the ones before, evaluations of the segment law so far.
    #[getter]
    fn counters(&self) -> (u64, u64, u64) {
        (self.0.sweeps, self.0.followed, self.0.segment_evaluations())
    }

    /// Everything of it, exact.
    fn to_bytes(&self) -> PyResult<Vec<u8>> {
        pack(&self.0)
    }

    /// From `to_bytes`.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        unpack("steady wake", bytes).map(Self)
    }
}

/// One of the inflow models of a flight, with all that it keeps between exchanges; see `wakeflight.exchange`.
#[pyclass(name = "Exchange", module = "wakeflight._core")]
#[derive(Clone)]
pub struct PyExchange {
    inner: Exchange,
    n_blades: usize,
    /// Steps in a revolution.
    n: usize,
}

fn no_marching() -> PyErr {
    invalid("exchange: its inflow model has no marching wake")
}

impl PyExchange {
    fn marched(&self) -> PyResult<&MarchingExchange> {
        self.inner.marching().ok_or_else(no_marching)
    }

    fn by_blade(&self, values: &[f64]) -> Array {
        array(values, &[self.n_blades])
    }
}

#[pymethods]
impl PyExchange {
    /// Dynamic inflow of a rotor, `n` steps in a revolution: in the state, nothing to exchange; memory of sections that remember.
    #[staticmethod]
    #[pyo3(signature = (core, n, sections=None))]
    fn dynamic(core: &PySystem, n: usize, sections: Option<PyRef<SectionMemory>>) -> PyResult<Self> {
        let (rotor, memory) = (core.inner.main(), sections.map_or_else(Default::default, |s| s.0.clone()));
        if !rotor.remembers(&memory, rotor.n_blades) {
            let [rows, stations] = memory.shape();
            return Err(invalid(format!(
                "sections: memory of ({rows}, {stations}) is not that of the rotor"
            )));
        }
        Ok(Self { inner: Exchange::Dynamic(memory), n_blades: rotor.n_blades, n })
    }

    /// Relaxation wake from that of a trim and the periodic motion of its blades (n_azimuths, n_modes).
    #[staticmethod]
    fn relaxation(
        core: &PySystem,
        steady: &PySteadyWake,
        motion: Motion,
        options_json: &str,
    ) -> PyResult<Self> {
        let (n, rotor) = (steady.0.n_azimuths(), core.inner.main());
        let (motions, own) = (core.motions(&motion, n)?, relaxation_options(options_json)?);
        let wake = RelaxationExchange::new(steady.0.clone(), rotor, &own, &motions);
        Ok(Self { inner: Exchange::Relaxation(Box::new(wake)), n_blades: rotor.n_blades, n })
    }

    /// Marching wake from the periodic one of a trim, blade 1 at azimuth zero.
    #[staticmethod]
    fn marching(core: &PySystem, steady: &PySteadyWake, options_json: &str) -> PyResult<Self> {
        let Some(relaxation) = &steady.0.wake else {
            return Err(invalid("steady wake: it has not been converged for any motion"));
        };
        let (own, rotor) = (marching_options(options_json, relaxation.options())?, core.inner.main());
        let wake = wake::TimeMarchingWake::from_relaxation(relaxation, 0, own).map_err(py_error)?;
        let inner = Exchange::Marching(Box::new(MarchingExchange::new(wake, &steady.0, rotor)));
        Ok(Self { inner, n_blades: rotor.n_blades, n: steady.0.n_azimuths() })
    }

    /// Total inflow held over the step that begins after `step` steps (n_blades, n_stations), of thin sections at both lines of
    /// the chord, None where it is in the state; its mean over the disk; how much more it is at the end of the step, None where it stays.
    fn held(&self, step: usize) -> (Option<Array>, f64, Option<Array>) {
        let held = self.inner.held(step);
        let [inflow, change] =
            [held.inflow, held.change].map(|rows| rows.map(|v| array(v, &[self.n_blades])));
        (inflow, held.mean, change)
    }

    /// Air at fuselage, stabilator, fin and tail rotor of the airframe of `core` over the step that begins (4, 3) [m/s], body axes, mean
    /// over the last passage of a blade, of a marching wake with `turn` over the last revolution; None where they do not feel the
    /// wake.
    #[pyo3(signature = (core, turn=false))]
    fn wash(&self, core: &PySystem, turn: bool) -> Option<Array> {
        let found = match self.inner.marching() {
            Some(wake) if turn => wake.wash_of_turn(),
            _ => self.inner.wash(),
        };
        found.map(|wash| vectors(core.inner.washed(&wash).to_vec(), &[]))
    }

    /// Memory of sections that remember where the step begins; None where they do not.
    #[getter]
    fn sections(&self) -> Option<SectionMemory> {
        remembered(self.inner.memory())
    }

    /// States `y` and `sticks`, with their rates, have reached `step`: the air answers. `motion`: modal coordinates and rates
    /// (n_blades, n_modes) that stand for those of `y`. `flown`: end and begin of the step [s], what acted at its end, and the wind
    /// there; a step of azimuth at the nominal speed in still air where nothing was flown.
    #[pyo3(signature = (core, step, y, sticks, motion=None, flown=None))]
    fn advance(
        &mut self,
        core: &PySystem,
        step: usize,
        y: Row,
        sticks: (Row, Row),
        motion: Option<Motion>,
        flown: Option<(f64, f64, PyRef<PyInputs>, Option<PyRef<PyAir>>)>,
    ) -> PyResult<()> {
        if let Exchange::Dynamic(memory) = &mut self.inner {
            if let (Some((t, _, inputs, _)), false) = (&flown, memory.is_empty()) {
                let y = core.state("y", &y)?;
                let still = vec![0.0; y.len()];
                let at = Instant { t: *t, y, y_dot: &still, inputs: inputs.fitting(core)? };
                *memory = core.inner.kept_memory(&at);
            }
            return Ok(());
        }
        let (system, n, found) = (&core.inner, self.n, core.inner.main().n_blades);
        if found != self.n_blades {
            return Err(invalid(format!("rotor of {found} blades, exchange of {}", self.n_blades)));
        }
        let (mut hub, mut controls) = (core.hub_at(&y)?, core.moving(&sticks)?);
        let turning = system.turning_after((step, n), core.state("y", &y)?);
        controls.turning = Some(turning);
        let motions = match &motion {
            Some(given) => core.motions(given, self.n_blades)?,
            None => system.modal_motions(core.state("y", &y)?),
        };
        let blades = &system.blades_after((step, n), &motions, &controls);
        let renewed = self.inner.renews(step);
        let steady_pitch = &if renewed { system.steady_pitch(n, &controls) } else { Vec::new() };
        let mut elapsed = system.main().nominal_step(n);
        let mut wind = None;
        if let Some((end, begun, _, air)) = flown {
            (elapsed, wind) = (end - begun, air);
        }
        let mut gust: &[f64] = &[];
        if let Some(air) = &wind {
            let felt = &air.inner;
            hub = system.carrier.hub_in_wind(hub, (system.main(), core.state("y", &y)?), felt.at_hub);
            gust = felt.stations.as_deref().unwrap_or_default();
            let needed = found * system.main().blade.stations.len();
            if !gust.is_empty() && gust.len() != needed {
                return Err(invalid(format!("wind at {} blade stations, {needed} needed", gust.len())));
            }
        }
        let place = Place { turning, gust, ..core.place(&hub, &y)? };
        let reached = Reached { place, blades, steady_pitch, elapsed };
        y.py().detach(|| self.inner.advance(step, &reached)).map_err(py_error)
    }

    /// A revolution of a marching wake with hub motion `y`, sticks and a periodic blade motion (n_azimuths, n_modes) held: inflow
    /// and circulation [m2/s] by azimuth, means of all blades' passages.
    fn turn(
        &mut self,
        py: Python<'_>,
        core: &PySystem,
        y: Row,
        stick: Row,
        motion: Motion,
    ) -> PyResult<(Array, Array)> {
        let (n, hub) = (self.n, core.hub_at(&y)?);
        let blades = core.inner.periodic_blades(&core.motions(&motion, n)?, core.controls("stick", &stick)?);
        let wake = self.inner.marching_mut().ok_or_else(no_marching)?;
        let place = core.place(&hub, &y)?;
        let (inflow, circulation) = py.detach(|| wake.turn(&place, &blades)).map_err(py_error)?;
        Ok((array(inflow, &[n]), array(circulation, &[n])))
    }

    /// Counts the steps of a marching wake anew, blade 1 at azimuth zero: a phase before the flight has ended.
    fn restart(&mut self) {
        if let Some(wake) = self.inner.marching_mut() {
            wake.restart();
        }
    }

    /// Steps of a marching wake since the start.
    #[getter]
    fn steps(&self) -> PyResult<usize> {
        self.marched().map(MarchingExchange::steps)
    }

    /// What the last exchange saw: largest motion of a marker and odd-even content over R, smallest distance of blade and tip
    /// vortex in core radii.
    #[getter]
    fn monitors(&self) -> Named<f64> {
        self.inner.monitors().into_iter().collect()
    }

    /// Counted work by name; empty without a wake.
    #[getter]
    fn counters(&self) -> Named<u64> {
        Named(self.inner.counters())
    }

    /// Every free trailer after `step` steps, root to tip, None without a wake: nodes (n_blades, n_trailers, n_ages, 3) [m], hub
    /// axes, their circulation (n_blades, n_trailers, n_ages) [m2/s], core radii of the segments (n_blades, n_trailers, n_ages - 1)
    /// [m].
    fn lattice(&self, step: usize) -> Option<(Array, Array, Array)> {
        let all = self.inner.lattice(step)?;
        let rows = [self.n_blades, all.n_trailers];
        Some((vectors(all.position, &rows), array(all.circulation, &rows), array(all.core_radius, &rows)))
    }

    /// A copy of the marching wake.
    fn wake(&self) -> PyResult<TimeMarchingWake> {
        Ok(TimeMarchingWake(self.marched()?.wake.clone()))
    }

    /// Total inflow that a marching wake gives (n_blades, n_stations), of thin sections at both lines of the chord.
    #[getter]
    fn inflow(&self) -> PyResult<Array> {
        Ok(self.by_blade(&self.marched()?.inflow))
    }

    /// Bound circulation with a marching wake (n_blades, n_stations) [m2/s].
    #[getter]
    fn circulation(&self) -> PyResult<Array> {
        Ok(self.by_blade(&self.marched()?.circulation))
    }

    /// Inflow of a marching wake without that of the own near wake (n_blades, n_stations).
    #[getter]
    fn lambda_far(&self) -> PyResult<Array> {
        Ok(self.by_blade(&self.marched()?.lambda_far))
    }

    /// Everything of it, exact.
    fn to_bytes(&self) -> PyResult<Vec<u8>> {
        pack(&(&self.inner, self.n_blades, self.n))
    }

    /// From `to_bytes`.
    #[staticmethod]
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        let (inner, n_blades, n) = unpack("exchange", bytes)?;
        Ok(Self { inner, n_blades, n })
    }

    /// Independent copy.
    fn copy(&self) -> Self {
        self.clone()
    }
}
