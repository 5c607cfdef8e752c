# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flight: a manoeuvre flown from a trim, wake and flight dynamics taking turns [ribera2004, Fig. 2].

1. Trim with the relaxation wake (`trim.py`). 2. Convergence phase: states and controls frozen, the time-marching wake
advanced. 3. The wake gives the inflow at every blade station, held while the solver integrates F(y_dot, y, u; t) = 0 over
one step of azimuth; states, circulation and hub motion go to the wake; the wake advances by one step.
"""

from __future__ import annotations

import copy
import time
from bisect import bisect_left, bisect_right
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from . import _core
from .errors import InputError, NumericalFailure
from .exchange import MarchingExchange, RelaxationExchange
from .inflow import InflowModel, inflow_model, like
from .integrators import INTEGRATORS
from .maneuvers import ROUNDING, Maneuver
from .model import Model, flight_regime
from .monitors import warnings as monitored
from .progress import Progress, Silent
from .recorder import Recorder
from .thinning import thinned
from .trim import INCH, Trim

if TYPE_CHECKING:
    import xarray as xr


RTOL = 1e-5
"""Relative tolerance of the solver that the absolute ones belong to."""


@dataclass(frozen=True)
class Flight:
    """A flown manoeuvre: `data` is its Dataset; a flight that stopped early says why in `failure`."""

    start: Trim
    maneuver: Maneuver
    data: xr.Dataset
    warnings: tuple[str, ...] = ()
    failure: str | None = None

    @property
    def finished(self) -> bool:
        """Whether the flight reached its end."""
        return self.failure is None

    def save(self, path: str | Path) -> Path:
        """Write the Dataset as NetCDF-4."""
        from .results import save

        return save(self.data, path)

    def citation(self) -> str:
        """BibTeX of everything the run used."""
        from .references import bibtex

        keys = {
            *self.start.aircraft.references,
            *self.start.inflow.references,
            *self.maneuver.references,
            "ribera2004",
        }
        return bibtex(sorted(keys))


class Sticks:
    """The pilot's sticks [m] about trim."""

    def __init__(self, maneuver: Maneuver, trim_si: np.ndarray):
        self.maneuver = maneuver
        self.trim_in = trim_si / INCH
        self.corners = sorted(maneuver.corners())

    def at(self, t: float) -> np.ndarray:
        """Positions (4,) [m from the stop] at time `t` [s]."""
        return INCH * self.maneuver.stick(t, self.trim_in)

    def rate(self, t: float) -> np.ndarray:
        """Rates (4,) [m/s] just after time `t` [s]."""
        return INCH * self.maneuver.rate(t + ROUNDING)

    def pieces(self, t0: float, t1: float) -> list[tuple[float, float]]:
        """The interval t0..t1 cut at the corners of the history."""
        first = bisect_right(self.corners, t0 + ROUNDING)
        ends = [t0, *self.corners[first : bisect_left(self.corners, t1 - ROUNDING)], t1]
        return list(zip(ends[:-1], ends[1:], strict=True))


class InflowSource(Protocol):
    """One of the three inflow models in flight."""

    def held(self, step: int) -> tuple[np.ndarray | None, float]:
        """Inflow held over the step that begins (None: the states of y) and its disk mean."""

    def exchange(self, step: int, y: np.ndarray, stick: np.ndarray, stick_rate: np.ndarray) -> None:
        """States have reached `step`: give them to the wake and let it answer."""


class DynamicSource:
    """Dynamic inflow: in the state, nothing to exchange."""

    def held(self, step: int) -> tuple[np.ndarray | None, float]:
        """Nothing is held: the inflow is in y."""
        return None, 0.0

    def exchange(self, step: int, y: np.ndarray, stick: np.ndarray, stick_rate: np.ndarray) -> None:
        """Nothing to do."""


class MarchingSource:
    """Time-marching wake: inflow anew at every step."""

    def __init__(self, exchange: MarchingExchange):
        self.wake = exchange

    def held(self, step: int) -> tuple[np.ndarray, float]:
        """Total inflow at the stations, and its disk mean."""
        return self.wake.held(step)

    def exchange(self, step: int, y: np.ndarray, stick: np.ndarray, stick_rate: np.ndarray) -> None:
        """Advance the wake by the step just flown."""
        self.wake.advance(y, stick, stick_rate)


class RelaxationSource:
    """Relaxation wake: inflow by azimuth, renewed every revolution (or as often as asked)."""

    def __init__(self, exchange: RelaxationExchange):
        self.wake = exchange

    def held(self, step: int) -> tuple[np.ndarray, float]:
        """Inflow of the frozen map over the step, and the map's disk mean."""
        return self.wake.inflow(step), self.wake.model.disk_mean(self.wake.inflow_map)

    def exchange(self, step: int, y: np.ndarray, stick: np.ndarray, stick_rate: np.ndarray) -> None:
        """Remember the blades' motion; where it is due renew the map."""
        self.wake.remember(step, *self.wake.model.modal(y))
        if step % self.wake.update_steps == 0:
            self.wake.renew(y, stick)


@dataclass
class ConvergencePhase:
    """What the convergence phase left: change of inflow per revolution over its mean, thrust, maps before and after."""

    change: list[float] = field(default_factory=list)
    circulation_lift: list[float] = field(default_factory=list)
    before: np.ndarray | None = None
    after: np.ndarray | None = None
    seconds: float = 0.0
    segment_evaluations: int = 0


def fly(
    start: Trim,
    maneuver: Maneuver,
    inflow: str | InflowModel | None = None,
    revolutions: float | None = None,
    integrator: str = "ida",
    progress: Progress | Silent | None = None,
    rtol: float = RTOL,
    stabilator: str = "held",
) -> Flight:
    """Fly `maneuver` from `start`.

    integrator: `ida`, variable in step and order, or `fixed`, one step of order five per coupling step: implicit where blades
    bend, explicit where they are rigid.
    rtol: relative tolerance of the solver, its absolute ones go with it.
    stabilator: `held` at its trim incidence, or `scheduled`, following its schedule within the rate of its servo.

    inflow: name or model, by default time-marching from a trim on a free wake, dynamic from a dynamic one. Wake options that
    depend on the regime (turns kept, far wake, relaxation) stay those of the trimmed condition for the whole flight, whatever
    regime it leads into. revolutions: flown ones, by default the manoeuvre's. A manoeuvre written for another travel or rotor
    speed is flown as `Maneuver.for_aircraft` makes it; the Flight holds it as flown. A numerical failure raises
    `NumericalFailure` whose `partial` is the Flight so far.
    """
    progress = progress or Silent()
    begun = time.perf_counter()
    model = flight_model(start, inflow)
    if integrator not in INTEGRATORS:
        raise InputError.of("integrator", integrator, f"allowed: {', '.join(INTEGRATORS)}")
    if stabilator not in ("held", "scheduled"):
        raise InputError.of("stabilator", stabilator, "allowed: held, scheduled")
    travel = start.aircraft.stick_travel_in
    maneuver = maneuver.for_aircraft(travel, model.omega)
    n_steps = flown_steps(model, maneuver, revolutions)
    delta_t = 2 * np.pi / model.omega / model.steps_per_revolution
    warnings = maneuver.check_travel(start.stick_si / INCH, travel, None, start.aircraft.stick_rate_limit_in)
    warnings += maneuver.check_end(max(n_steps * delta_t, maneuver.duration(model.omega)))
    maneuver = thinned(maneuver, delta_t, n_steps)
    sticks = Sticks(maneuver, start.stick_si)
    for text in maneuver.adapted:
        progress(f"note: {text}")
    warnings += [*start.aircraft.warnings, *(f"trim: {text}" for text in (*start.notes, *monitored(start.monitors)))]
    for text in warnings:
        progress(f"warning: {text}")

    source, phase = inflow_source(model, start, progress)
    solver = INTEGRATORS[integrator](model, rtol, atol_scale=rtol / RTOL)
    recorder = Recorder(model, start, maneuver, source, n_steps)
    seconds = {"wake": 0.0, "dynamics": 0.0}
    progress.phase("flight", n_steps / model.steps_per_revolution)
    y, failure = start.state(0.0), None
    incidence = start.stabilator_incidence
    stick, stick_rate = sticks.at(0.0), sticks.rate(0.0)
    try:
        for step in range(n_steps):
            t = step * delta_t
            held, mean = source.held(step)
            if stabilator == "scheduled" and step > 0:
                incidence = scheduled_incidence(model, incidence, y, stick, delta_t)
            inputs = _core.Inputs(stick, stick_rate, t, held, mean, incidence)
            clock = time.perf_counter()
            y_dot = solver.consistent(t, y, inputs)
            seconds["dynamics"] += time.perf_counter() - clock
            recorder.record(step, t, y, y_dot, inputs, stick, mean, incidence)

            clock = time.perf_counter()
            if step == 0:
                solver.start(t, y, y_dot)
            for t0, t1 in sticks.pieces(t, (step + 1) * delta_t):
                if t0 > t:
                    inputs = coupling_inputs(sticks, t0, held, mean, incidence)
                solver.advance_to(t1, inputs)
            y = solver.state
            seconds["dynamics"] += time.perf_counter() - clock

            t = (step + 1) * delta_t
            stick, stick_rate = sticks.at(t), sticks.rate(t)
            clock = time.perf_counter()
            source.exchange(step + 1, y, stick, stick_rate)
            seconds["wake"] += time.perf_counter() - clock
            progress.advance(1 / model.steps_per_revolution, f"t = {t:.2f} s")
        t = n_steps * delta_t
        held, mean = source.held(n_steps)
        inputs = _core.Inputs(stick, stick_rate, t, held, mean, incidence)
        recorder.record(n_steps, t, y, solver.consistent(t, y, inputs), inputs, stick, mean, incidence)
    except (NumericalFailure, ArithmeticError, np.linalg.LinAlgError) as reason:
        revolution = (recorder.n_recorded - 1) / model.steps_per_revolution
        failure = f"flight of {maneuver.name} stopped in revolution {revolution:.2f}: {reason}"

    if recorder.n_recorded == 0:
        raise NumericalFailure(failure)
    for text in monitored(recorder.monitors):
        warnings.append(text)
        progress(f"warning: {text}")
    attributes = {
        "seconds_trim": start.seconds,
        "seconds_convergence": phase.seconds,
        "seconds_wake": seconds["wake"],
        "seconds_dynamics": seconds["dynamics"],
        "seconds_total": start.seconds + time.perf_counter() - begun,
        "integrator": integrator,
        "integration_method": solver.method,
        "blades": "flexible" if start.aircraft.flexible else "rigid",
        **solver.statistics,
    }
    data = recorder.dataset(attributes, phase, warnings, failure)
    flight = Flight(start, maneuver, data, tuple(warnings), failure)
    if failure is not None:
        raise NumericalFailure(failure, partial=flight)
    return flight


def flight_model(start: Trim, inflow: str | InflowModel | None) -> Model:
    """Model to fly with; it must belong to what the trim was made with.

    What depends on the regime is that of the trimmed condition, and stays so where the manoeuvre leads into another.
    """
    if inflow is None:
        inflow = "dynamic" if start.inflow.is_dynamic else "time-marching"
    trimmed = start.inflow
    chosen = inflow_model(inflow)
    if chosen.is_dynamic != trimmed.is_dynamic:
        needed = "dynamic" if chosen.is_dynamic else "relaxation"
        raise InputError.of("inflow", chosen.name, f"needs a trim with inflow='{needed}', this one used {trimmed.name}")
    if chosen.is_dynamic:
        return start.model
    if isinstance(inflow, str) and not isinstance(trimmed, type(chosen)):
        chosen = like(type(chosen), trimmed)
    elif isinstance(inflow, str):
        chosen = trimmed
    regime = flight_regime(start.aircraft, start.condition)
    chosen = chosen.resolved(regime)
    chosen.check_on(start.aircraft)
    for name, before, now in chosen.unlike(trimmed.resolved(regime), start.aircraft):
        raise InputError.of(name, now, f"must be that of the trim, {before}: trim again with this inflow model")
    return Model.build(start.aircraft, start.condition, chosen)


def flown_steps(model: Model, maneuver: Maneuver, revolutions: float | None) -> int:
    """Coupling steps of the flight."""
    if revolutions is None:
        revolutions = maneuver.duration_revolutions(model.omega)
    if not 0 < revolutions <= 10000:
        raise InputError.of("revolutions", revolutions, "must lie above 0 and at most 10000")
    return max(1, round(revolutions * model.steps_per_revolution))


def coupling_inputs(
    sticks: Sticks, t: float, held: np.ndarray | None, mean: float, stabilator_incidence: float
) -> _core.Inputs:
    """Sticks from `t` on; inflow and stabilator held."""
    return _core.Inputs(sticks.at(t), sticks.rate(t), t, held, mean, stabilator_incidence)


def scheduled_incidence(model: Model, incidence: float, y: np.ndarray, stick: np.ndarray, delta_t: float) -> float:
    """Incidence [rad] after one coupling step toward the schedule, within the rate of the servo."""
    asked = model.core.scheduled_stabilator(float(np.linalg.norm(y[:3])), float(stick[2]), float(y[4]))
    if asked is None:
        return incidence
    wanted, rate = asked
    return incidence + float(np.clip(wanted - incidence, -rate * delta_t, rate * delta_t))


def inflow_source(model: Model, start: Trim, progress: Progress | Silent) -> tuple[InflowSource, ConvergencePhase]:
    """The inflow model at the start of the flight; the time-marching wake after its convergence phase."""
    if model.inflow.is_dynamic:
        return DynamicSource(), ConvergencePhase()
    if model.inflow.is_relaxed:
        relaxed = RelaxationExchange(model, copy.copy(start.wake))
        q, q_dot = model.core.trim_motion(start.problem, start.x, relaxed.n)
        relaxed.trimmed.relaxation = start.wake.relaxation.copy()
        relaxed.trimmed.counters = dict.fromkeys(start.wake.counters, 0)
        for step in range(relaxed.n):
            relaxed.remember(step, q[relaxed.rows(step)], q_dot[relaxed.rows(step)])
        return RelaxationSource(relaxed), ConvergencePhase()
    assert model.inflow.is_marching
    marching = MarchingExchange(model, start.wake)
    return MarchingSource(marching), converge(marching, start, progress)


def converge(marching: MarchingExchange, start: Trim, progress: Progress | Silent) -> ConvergencePhase:
    """Advance the wake at frozen states and controls; the circulation follows the inflow."""
    model = marching.model
    revolutions = model.inflow.convergence_revolutions
    phase = ConvergencePhase(before=start.inflow_map)
    clock = time.perf_counter()
    progress.phase("convergence of the wake", revolutions)
    previous = start.inflow_map
    widths = np.asarray(model.rotor["widths"])
    for _ in range(revolutions):
        records = [marching.frozen_step(start.problem, start.x) for _ in range(model.steps_per_revolution)]
        inflow_map, circulation = marching.periodic_map(records)
        if not np.all(np.isfinite(inflow_map)):
            raise NumericalFailure("convergence phase of the wake left the finite numbers")
        change = np.sqrt(np.mean((inflow_map - previous) ** 2 @ model.area_weights)) / abs(model.disk_mean(inflow_map))
        phase.change.append(float(change))
        phase.circulation_lift.append(float(np.mean(circulation @ (model.stations * widths))))
        if phase.after is None:
            phase.before = inflow_map
        phase.after = previous = inflow_map
        progress.advance(1, f"inflow changes by {change:.1e} of its mean")
    marching.step_index = 0
    phase.seconds = time.perf_counter() - clock
    phase.segment_evaluations = marching.segment_evaluations
    return phase
