# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flight: a manoeuvre flown from a trim, a `Simulation` stepped along its sticks and recorded [ribera2004, Fig. 2]."""

from __future__ import annotations

import time
from bisect import bisect_left, bisect_right
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .arguments import checked
from .control import augmentation
from .engine import Engine, planned
from .errors import GroundContact, InputError, Interrupted, NumericalFailure
from .flight_folder import Kept, RunFolder
from .flight_input import Asked, FlightInput, Plan
from .flight_monitors import monitors
from .inflow import InflowModel
from .integrators import RTOL
from .interruption import asked, deferred
from .interruption import text as text_of
from .maneuvers import ROUNDING, Maneuver
from .model import Model
from .monitors import warnings as monitored
from .perturbation import offsets_of
from .progress import Progress, Reported, Silent, heard, reporting
from .recorder import Recorder, keeps_sheets
from .rotor_speed import CONSTANT, RotorSpeed, unflown
from .simulation import Simulation
from .sticks import LONGEST_FLIGHT
from .thinning import thinned
from .trim import INCH, Trim
from .units import whole
from .views import html_table
from .wind import wind_of

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


@reporting
@checked
def fly(
    start: Trim,
    maneuver: Maneuver,
    inflow: str | InflowModel | None = None,
    revolutions: float | None = None,
    integrator: str = "ida",
    progress: Reported = None,
    rtol: float = RTOL,
    stabilator: str = "held",
    rotor_speed: RotorSpeed | Engine = CONSTANT,
    control: Any = None,
    actuators: Any = None,
    out: str | Path | None = None,
    wind: Any = None,
    perturb: Any = None,
    wakes_per_revolution: int = 4,
) -> Flight:
    """Fly `maneuver` from `start`.

    integrator: `ida`, variable in step and order, or `fixed`, one step of order five per coupling step: implicit where blades
    bend, explicit where they are rigid.
    rtol: relative tolerance of the solver, its absolute ones go with it.
    stabilator: `held` at its trim incidence, or `scheduled`, following its schedule within the rate of its servo.
    rotor_speed: `constant`, or pairs (time, share of the nominal speed) such as `[("0.5 s", 1.0), ("1.5 s", 0.95)]`, linear
    between them and steady after the last; `constant-over-ground`, constant in inertial space instead of about the airframe, so
    that a yawing airframe does not turn the rotor with it; `governed`, azimuth and speed as states, held by the engines'
    governor; `free`, the same with the torque of the trim; or an `Engine`, such as `wf.GovernedEngine(failure="1 s")`. The tail
    rotor is geared to the main rotor; a coupling step stays a step of azimuth, so that times are not equidistant; coefficients
    and inflow are counted at the nominal speed. The flight has the revolutions that its duration has at the speed it begins at.
    control: what is between sticks and blades: a `wf.Controller`, a list of them or a `wf.Augmentation`; None is the manoeuvre's
    own, where its file has one; an empty list: nothing. actuators: servos behind the mixing unit, `generic` or `wf.Servos(...)`.
    perturb: states the flight begins with beside those of the trim, `{"q": "2 deg/s", "pitch": "1 deg", "u": "1 m/s"}`.
    wakes_per_revolution: how often the vortices are kept; a divisor of the steps of a revolution, all of them at the most.

    wind: `wf.SteadyWind`, `wf.Gust`, `wf.Dryden`, `wf.VonKarman`, `wf.WindField`, several of them in a list, or a function of
    points (n, 3) [m] and time [s] in inertial axes that gives the velocity of the air there (n, 3) [m/s]; held over a coupling
    step. The speed of the trim is that through the air. A wake is carried by the wind at the hub.

    inflow: name or model, by default time-marching from a trim on a free wake, dynamic from a dynamic one. Wake options that
    depend on the regime (turns kept, far wake, relaxation) stay those of the trimmed condition for the whole flight, whatever
    regime it leads into. revolutions: flown ones, by default the manoeuvre's. A manoeuvre written for another travel or rotor
    speed is flown as `Maneuver.for_aircraft` makes it; the Flight holds it as flown. A numerical failure raises
    `NumericalFailure` whose `partial` is the Flight so far.

    out: a folder to which rows go as they are flown, with a checkpoint every second, and `run.nc` at the end: whatever stops the
    flight, `resume` goes on from there, and memory does not grow with its length.
    """
    progress = heard(progress)
    maneuver = maneuver.for_aircraft(start.aircraft.stick_travel_in, start.model.omega)
    made = augmentation(maneuver.control if control is None else control, actuators)
    speed = planned(rotor_speed)
    plan = Plan(
        replace(maneuver, control=None),
        inflow,
        revolutions,
        integrator,
        rtol,
        stabilator,
        speed,
        made,
        wind=wind_of(wind),
        perturb=offsets_of(perturb),
        wakes_per_revolution=whole("wakes_per_revolution", wakes_per_revolution, 1, 720),
    )
    given = FlightInput.of(start.aircraft, Asked.of(start), plan)
    flying = Flying(start, given, progress)
    if out is None:
        return flying.go()
    with RunFolder(out) as folder:
        note = folder.begin(given)
        if note:
            progress(f"note: {note}")
        folder.keep_trim(start)
        return flying.go(folder)


class Flying:
    """A flight that has been checked and is ready to go, from its start or from a moment that was kept."""

    def __init__(self, start: Trim, given: FlightInput, progress: Progress | Silent):
        """Check what is flown; tell what is doubtful."""
        self.start, self.given, self.progress = start, given, progress
        self._begun = time.perf_counter()
        plan = given.plan
        self.sim = Simulation.prepared(
            start,
            plan.inflow,
            plan.integrator,
            plan.rtol,
            plan.stabilator,
            plan.rotor_speed,
            plan.control,
            plan.wind,
            plan.perturb,
        )
        model, clock = self.sim.model, self.sim.clock
        self.sim.wakes_per_revolution = wakes_kept(plan.wakes_per_revolution, model)
        travel = start.aircraft.stick_travel_in
        maneuver = plan.maneuver.for_aircraft(travel, model.omega).about(start.stick_si / INCH)
        self.n_steps = n_steps = flown_steps(model, maneuver, plan.revolutions)
        warnings = maneuver.check_travel(start.stick_si / INCH, travel, None, start.aircraft.stick_rate_limit_in)
        warnings += maneuver.check_end(max(clock.time(n_steps), maneuver.duration(model.omega)))
        warnings += unflown(model.rotor_speed, clock.time(n_steps))
        self.maneuver = maneuver = thinned(maneuver, clock, n_steps)
        for text in maneuver.adapted:
            progress(f"note: {text}")
        warnings += [
            *start.aircraft.warnings,
            *(f"trim: {text}" for text in (*start.notes, *monitored(start.monitors))),
        ]
        for text in warnings:
            progress(f"warning: {text}")
        self.warnings = warnings
        self.keeps_sheets = plan.lattice and keeps_sheets(model, n_steps, self.sim.wake_steps)

    def go(self, folder: RunFolder | None = None, kept: Kept | None = None) -> Flight:
        """Fly. folder: where the flight is kept; kept: the moment from which it goes on."""
        sim, progress, n_steps = self.sim, self.progress, self.n_steps
        if kept is None or kept.phase is None:
            sim.converge(progress)
            if self.given.plan.begin is not None:
                sim.restore(self.given.plan.begin)
            if folder is not None:
                folder.keep_start(self.start, Kept(sim.snapshot(), sim.phase, sim.seconds))
        if kept is not None:
            sim.go_on(kept.snapshot, kept.phase, kept.seconds)
        recorder = self._recorder(folder, kept)
        sticks = Sticks(self.maneuver, self.start.stick_si)
        per_revolution = sim.model.steps_per_revolution
        progress.phase("flight", (n_steps - sim.steps) / per_revolution)
        failure, signalled, ending = None, None, NumericalFailure
        try:
            with deferred():
                while sim.steps < n_steps and signalled is None:
                    sim.follow(sticks, recorder.record)
                    progress.advance(1 / per_revolution, f"t = {sim.t:.2f} s")
                    if folder is not None:
                        folder.beat(sim)
                    signalled = asked()
            if signalled is None:
                recorder.record(sim.last(sticks))
        except GroundContact as reason:
            failure, ending = f"flight of {self.maneuver.name} ended: {reason}", GroundContact
        except (NumericalFailure, ArithmeticError, np.linalg.LinAlgError) as reason:
            revolution = max(recorder.n_recorded - 1, 0) / per_revolution
            failure = f"flight of {self.maneuver.name} stopped in revolution {revolution:.2f}: {reason}"
        if signalled is not None:
            at = f"t = {sim.t:.4f} s, revolution {sim.steps / per_revolution:.2f}"
            failure = f"flight of {self.maneuver.name} {text_of(signalled)} at {at}"
            if folder is not None:
                folder.beat(sim, last=True)

        if recorder.n_recorded == 0:
            raise NumericalFailure(failure or "nothing was flown")
        flight = self.flight(recorder, failure)
        if folder is not None:
            folder.save(flight.data, ended=signalled is None)
        if signalled is not None:
            raise Interrupted(failure or "", signalled, partial=flight)
        if failure is not None:
            raise ending(failure, partial=flight)
        return flight

    def _recorder(self, folder: RunFolder | None, kept: Kept | None) -> Recorder:
        lattice = self.given.plan.lattice
        if folder is None:
            return Recorder(self.sim, self.maneuver, self.n_steps, lattice=lattice)
        rows, wakes = (0, 0) if kept is None else (kept.rows, kept.wakes)
        logs = folder.rows(self.sim, rows), folder.wakes(wakes)
        return Recorder(self.sim, self.maneuver, self.n_steps, *logs, n_recorded=rows, lattice=lattice)

    def flight(self, recorder: Recorder, failure: str | None) -> Flight:
        """What was recorded as a Flight."""
        sim, start, warnings = self.sim, self.start, list(self.warnings)
        recorder.read()
        watched = monitors(recorder)
        for text in monitored(watched):
            warnings.append(text)
            self.progress(f"warning: {text}")
        seconds = dict(sim.seconds)
        flown_before = sum(self.sim.seconds_before.values())
        attributes = {
            "seconds_trim": start.seconds,
            "seconds_convergence": sim.phase.seconds,
            "seconds_wake": seconds["wake"],
            "seconds_dynamics": seconds["dynamics"],
            "seconds_total": start.seconds + flown_before + time.perf_counter() - self._begun,
            "integrator": self.given.plan.integrator,
            "integration_method": sim.solver.method,
            "integrator_schedule": sim.solver.schedule,
            "blades": "flexible" if start.aircraft.flexible else "rigid",
            **sim.solver.statistics,
            "input": self.given.text,
        }
        data = recorder.dataset(attributes, watched, warnings, failure)
        return Flight(start, self.maneuver, data, tuple(warnings), failure)


def wakes_kept(asked: int, model: Model) -> int:
    """Wakes kept of a revolution, if they come at steps of it."""
    steps = model.steps_per_revolution
    if asked != 4 and steps % asked:
        allowed = [n for n in range(1, steps + 1) if steps % n == 0]
        raise InputError.of(
            "wakes_per_revolution", asked, f"must divide the {steps} steps: {', '.join(map(str, allowed))}"
        )
    return asked


def flown_steps(model: Model, maneuver: Maneuver, revolutions: float | None) -> int:
    """Coupling steps of the flight: the revolutions asked for, or as many as last as long as the manoeuvre."""
    if revolutions is None:
        revolutions = maneuver.duration_revolutions(model.omega)
        if model.rotor_speed:
            revolutions = model.clock.steps(0, maneuver.duration(model.omega)) / model.steps_per_revolution
    if not 0 < revolutions <= LONGEST_FLIGHT:
        raise InputError.of("revolutions", revolutions, f"must lie above 0 and at most {LONGEST_FLIGHT}")
    return max(1, round(revolutions * model.steps_per_revolution))
