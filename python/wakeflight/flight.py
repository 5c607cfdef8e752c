# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flight: a manoeuvre flown from a trim, a `Simulation` stepped along its sticks and recorded [ribera2004, Fig. 2]."""

from __future__ import annotations

import time
from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .errors import InputError, NumericalFailure
from .flight_monitors import monitors
from .inflow import InflowModel
from .maneuvers import ROUNDING, Maneuver
from .model import Model
from .monitors import warnings as monitored
from .progress import Progress, Silent
from .recorder import Recorder
from .rotor_speed import CONSTANT, RotorSpeed, unflown
from .simulation import RTOL, Simulation
from .thinning import thinned
from .trim import INCH, Trim
from .views import html_table

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, repr=False)
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

    def _rows(self) -> list[tuple[str, str]]:
        data = self.data
        return [
            ("aircraft", self.start.aircraft.name),
            ("manoeuvre", self.maneuver.name),
            ("inflow, integrator", f"{data.attrs['inflow_model']}, {data.attrs['integrator']}"),
            ("time", f"{float(data.time[-1]):.3f} s, {data.attrs['revolutions']:.2f} revolutions"),
            ("ended", self.failure or "as asked"),
            *(("warning", text) for text in self.warnings),
        ]

    def __repr__(self) -> str:
        """One line."""
        own = f"{self.start.aircraft.name}, {self.maneuver.name}, {self.data.attrs['inflow_model']}"
        return f"<Flight: {own}, {float(self.data.time[-1]):.3f} s{'' if self.finished else ', not finished'}>"

    def _repr_html_(self) -> str:
        """A small table."""
        return html_table("Flight", self._rows())

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


def fly(
    start: Trim,
    maneuver: Maneuver,
    inflow: str | InflowModel | None = None,
    revolutions: float | None = None,
    integrator: str = "ida",
    progress: Progress | Silent | None = None,
    rtol: float = RTOL,
    stabilator: str = "held",
    rotor_speed: RotorSpeed = CONSTANT,
) -> Flight:
    """Fly `maneuver` from `start`.

    integrator: `ida`, variable in step and order, or `fixed`, one step of order five per coupling step: implicit where blades
    bend, explicit where they are rigid.
    rtol: relative tolerance of the solver, its absolute ones go with it.
    stabilator: `held` at its trim incidence, or `scheduled`, following its schedule within the rate of its servo.
    rotor_speed: `constant`, or pairs (time, share of the nominal speed) such as `[("0.5 s", 1.0), ("1.5 s", 0.95)]`, linear
    between them and steady after the last; with dynamic inflow. The tail rotor is geared to the main rotor; a coupling step stays
    a step of azimuth; coefficients and inflow are counted at the nominal speed.

    inflow: name or model, by default time-marching from a trim on a free wake, dynamic from a dynamic one. Wake options that
    depend on the regime (turns kept, far wake, relaxation) stay those of the trimmed condition for the whole flight, whatever
    regime it leads into. revolutions: flown ones, by default the manoeuvre's. A manoeuvre written for another travel or rotor
    speed is flown as `Maneuver.for_aircraft` makes it; the Flight holds it as flown. A numerical failure raises
    `NumericalFailure` whose `partial` is the Flight so far.
    """
    progress = progress or Silent()
    begun = time.perf_counter()
    sim = Simulation.prepared(start, inflow, integrator, rtol, stabilator, rotor_speed)
    model, clock = sim.model, sim.clock
    travel = start.aircraft.stick_travel_in
    maneuver = maneuver.for_aircraft(travel, model.omega)
    n_steps = flown_steps(model, maneuver, revolutions)
    warnings = maneuver.check_travel(start.stick_si / INCH, travel, None, start.aircraft.stick_rate_limit_in)
    warnings += maneuver.check_end(max(clock.time(n_steps), maneuver.duration(model.omega)))
    warnings += unflown(model.rotor_speed, clock.time(n_steps))
    maneuver = thinned(maneuver, clock, n_steps)
    sticks = Sticks(maneuver, start.stick_si)
    for text in maneuver.adapted:
        progress(f"note: {text}")
    warnings += [*start.aircraft.warnings, *(f"trim: {text}" for text in (*start.notes, *monitored(start.monitors)))]
    for text in warnings:
        progress(f"warning: {text}")

    sim.converge(progress)
    recorder = Recorder(sim, maneuver, n_steps)
    progress.phase("flight", n_steps / model.steps_per_revolution)
    failure = None
    try:
        for _ in range(n_steps):
            sim.follow(sticks, recorder.record)
            progress.advance(1 / model.steps_per_revolution, f"t = {sim.t:.2f} s")
        recorder.record(sim.instant(sticks, ends=True))
    except (NumericalFailure, ArithmeticError, np.linalg.LinAlgError) as reason:
        revolution = (recorder.n_recorded - 1) / model.steps_per_revolution
        failure = f"flight of {maneuver.name} stopped in revolution {revolution:.2f}: {reason}"

    if recorder.n_recorded == 0:
        raise NumericalFailure(failure)
    watched = monitors(recorder)
    for text in monitored(watched):
        warnings.append(text)
        progress(f"warning: {text}")
    attributes = {
        "seconds_trim": start.seconds,
        "seconds_convergence": sim.phase.seconds,
        "seconds_wake": sim.seconds["wake"],
        "seconds_dynamics": sim.seconds["dynamics"],
        "seconds_total": start.seconds + time.perf_counter() - begun,
        "integrator": integrator,
        "integration_method": sim.solver.method,
        "blades": "flexible" if start.aircraft.flexible else "rigid",
        **sim.solver.statistics,
    }
    data = recorder.dataset(attributes, watched, warnings, failure)
    flight = Flight(start, maneuver, data, tuple(warnings), failure)
    if failure is not None:
        raise NumericalFailure(failure, partial=flight)
    return flight


def flown_steps(model: Model, maneuver: Maneuver, revolutions: float | None) -> int:
    """Coupling steps of the flight: the revolutions asked for, or as many as last as long as the manoeuvre."""
    if revolutions is None:
        revolutions = maneuver.duration_revolutions(model.omega)
        if model.rotor_speed:
            revolutions = model.clock.steps(0, maneuver.duration(model.omega)) / model.steps_per_revolution
    if not 0 < revolutions <= 10000:
        raise InputError.of("revolutions", revolutions, "must lie above 0 and at most 10000")
    return max(1, round(revolutions * model.steps_per_revolution))
