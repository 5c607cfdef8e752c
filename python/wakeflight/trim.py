# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim: the verb that finds sticks, attitude, periodic blade motion and inflow of a steady flight condition."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from . import _core
from .aircraft import Aircraft
from .condition import FlightCondition, condition_for, target
from .errors import NumericalFailure
from .inflow import DynamicInflow, InflowModel, inflow_model, trim_model
from .model import Model
from .monitors import Monitor, failures, warnings
from .progress import Progress, Silent
from .trim_equations import INCH, dynamic_map, residual_norms, without_inflow
from .trim_limits import windmill
from .trim_solve import solve_condition
from .trim_wake import CONTROL_TOLERANCE, on_marching, on_relaxation
from .units import STANDARD_GRAVITY
from .views import html_table
from .wake_trim import WakeInTrim

KNOT = 0.514444  # m/s


@dataclass(frozen=True, repr=False)
class Trim:
    """A trimmed flight; angles in rad, SI, sticks in inches from the stop."""

    model: Model
    problem: _core.TrimProblem
    x: np.ndarray
    inflow_map: np.ndarray  # (n_azimuths, n_stations), total induced inflow, positive down
    circulation: np.ndarray  # (n_azimuths, n_stations) [m2/s]
    wake: WakeInTrim | None
    seconds: float
    history: list[dict[str, float]] = field(default_factory=list)
    counters: dict[str, int] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    """What is to be said of the way to it: a wake that rests in the mean alone."""

    def __getstate__(self) -> dict[str, Any]:
        """The equations by value; monitors are found again."""
        state = {name: value for name, value in self.__dict__.items() if name != "monitors"}
        return state | {"problem": self.problem.to_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """The equations made again."""
        self.__dict__.update(state | {"problem": _core.TrimProblem.from_bytes(state["problem"])})

    def __repr__(self) -> str:
        """One line."""
        c = self.condition
        own = f"{self.aircraft.name}, {c.speed / KNOT:.1f} kt, flight path {np.degrees(c.flight_path):.2f} deg"
        return f"<Trim: {own}, {self.inflow.name}>"

    def _repr_html_(self) -> str:
        """A small table."""
        deg = np.degrees
        rows = [
            ("aircraft", self.aircraft.name),
            ("speed, flight path", f"{self.condition.speed / KNOT:.1f} kt, {deg(self.condition.flight_path):.2f} deg"),
            ("inflow", self.inflow.name),
            ("sticks", ", ".join(f"{name} {value:.2f}" for name, value in self.stick.items()) + " in"),
            ("roll, pitch", f"{deg(self.roll):.2f}, {deg(self.pitch):.2f} deg"),
            *((name, f"{deg(value):.2f} deg") for name, value in self.pitch_controls.items()),
            *(("warning", text) for text in self.warnings),
        ]
        return html_table("Trim", rows)

    @property
    def aircraft(self) -> Aircraft:
        """The aircraft."""
        return self.model.aircraft

    @property
    def condition(self) -> FlightCondition:
        """The condition."""
        return self.model.condition

    @property
    def inflow(self) -> InflowModel:
        """The inflow model."""
        return self.model.inflow

    @property
    def stick_si(self) -> np.ndarray:
        """Lateral, longitudinal, collective, pedal [m from the stop]."""
        return self.x[:4].copy()

    @property
    def stick(self) -> dict[str, float]:
        """Sticks by name [inches from the stop]."""
        names = ("lateral", "longitudinal", "collective", "pedal")
        return dict(zip(names, (self.x[:4] / INCH).tolist(), strict=True))

    @property
    def roll(self) -> float:
        """Bank, right side down positive [rad]."""
        return float(self.x[4])

    @property
    def pitch(self) -> float:
        """Pitch attitude, nose up positive [rad]."""
        return float(self.x[5])

    @property
    def yaw(self) -> float:
        """Heading against the track, nose right positive [rad]."""
        return float(self.x[6])

    @property
    def speed(self) -> float:
        """True airspeed [m/s], as given or found."""
        return self.condition.speed

    @property
    def flight_path(self) -> float:
        """Flight-path angle, climb positive [rad], as given or found."""
        return self.condition.flight_path

    @property
    def rate_of_descent(self) -> float:
        """Rate of descent [m/s], negative in climb."""
        return float(-self.speed * np.sin(self.flight_path))

    @property
    def turn_rate(self) -> float:
        """Rate of turn, to the right positive [rad/s], as given or found."""
        return self.condition.turn_rate

    @property
    def load_factor(self) -> float:
        """Resultant of all loads but gravity over the weight: sqrt(1 + (turn rate x horizontal speed/g)^2)."""
        return float(np.hypot(1.0, self.turn_rate * self.speed * np.cos(self.flight_path) / STANDARD_GRAVITY))

    @property
    def pitch_controls(self) -> dict[str, float]:
        """Blade pitch theta_1c, theta_1s, theta_0 and tail-rotor pitch theta_tr [rad]."""
        return dict(zip(("theta_1c", "theta_1s", "theta_0", "theta_tr"), self._controls(), strict=True))

    def _controls(self) -> list[float]:
        return self.model.pitch_controls(self.x[:4]).tolist()

    @property
    def theta_1c(self) -> float:
        """Lateral cyclic [rad]."""
        return self._controls()[0]

    @property
    def theta_1s(self) -> float:
        """Longitudinal cyclic [rad]."""
        return self._controls()[1]

    @property
    def theta_0(self) -> float:
        """Collective pitch at the root [rad]."""
        return self._controls()[2]

    @property
    def theta_tr(self) -> float:
        """Tail-rotor pitch without bias [rad]."""
        return self._controls()[3]

    @property
    def residuals(self) -> dict[str, float]:
        """Largest residual of each kind: linear [m/s2], angular [rad/s2], blade harmonics [rad], inflow [-]."""
        return residual_norms(self.model, self.problem, self.x)

    @property
    def stabilator_incidence(self) -> float:
        """Incidence of the stabilator, trailing edge down positive [rad]."""
        return self.model.core.trim_stabilator(self.problem, self.x)

    @cached_property
    def monitors(self) -> tuple[Monitor, ...]:
        """What is watched of this trim, each with its values and what it says."""
        from .trim_monitors import monitors

        return monitors(self)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful in the aircraft's data, and what lies beyond a limit of aircraft or model."""
        return (*self.aircraft.warnings, *self.notes, *warnings(self.monitors))

    @property
    def failures(self) -> tuple[str, ...]:
        """What lies beyond physics: a trim that has any is raised in a `NumericalFailure`, not returned."""
        return failures(self.monitors)

    def state(self, t: float = 0.0) -> np.ndarray:
        """State y of the trimmed revolution at time `t` [s]."""
        return self.model.core.trim_state(self.problem, self.x, t)[0]

    def inputs(self, t: float = 0.0) -> _core.Inputs:
        """Sticks and inflow that hold the trim, for the blades' azimuths at `t` [s]."""
        return trim_inputs(self, t)

    def mean_outputs(self) -> dict[str, Any]:
        """Loads, power and coefficients averaged over a revolution."""
        from .trim_results import mean_outputs

        return mean_outputs(self)

    def to_dataset(self):
        """The trim as an xarray Dataset."""
        from .trim_results import to_dataset

        return to_dataset(self)

    def table(self) -> str:
        """The trim as a table to print."""
        from .trim_results import table

        return table(self)


def trim(
    aircraft: Aircraft,
    condition: FlightCondition | None = None,
    inflow: str | InflowModel = "relaxation",
    progress: Progress | Silent | None = None,
    n_harmonics: int = 8,
    control_tolerance: float = CONTROL_TOLERANCE,
    *,
    power: Any = None,
    collective: Any = None,
    free: str | None = None,
) -> Trim:
    """Trim `aircraft` in `condition` (default: the aircraft's own) with an inflow model.

    power: of the engines ("0 hp" is autorotation): main rotor, tail rotor and accessories, no losses between. collective: blade
    pitch theta_0 at the root. With one of them a part of the condition's path is found, and its value there is where the search
    begins: free = `flight_path` (speed as given) or `speed` (path as given). What was found stands in `.flight_path`,
    `.rate_of_descent`, `.speed`, and in the trim's condition.
    n_harmonics: harmonics of the blades' periodic motion. control_tolerance: change of a pitch control [rad] between trims on a
    free wake at which they rest.

    Raises `InputError` for bad input and `NumericalFailure`, saying what limits, where no trim is found; also where what was
    found is beyond physics, with the trim as `partial`. What is beyond a limit of aircraft or model stands in `.warnings`.
    """
    progress = progress or Silent()
    started = time.perf_counter()
    condition = condition_for(aircraft, condition)
    chosen = inflow_model(inflow)
    chosen.step(aircraft)
    asked = target(condition, power, collective, free)
    progress.phase("trim", None)

    # dynamic inflow first: the result itself, or the start of the free wake
    dynamic = chosen if chosen.is_dynamic else DynamicInflow(n_stations=chosen.n_stations)
    simple = Model.build(aircraft, condition, dynamic, asked)
    problem, x = solve_condition(simple, n_harmonics)
    simple = simple.flown(problem, x)
    condition = simple.condition
    progress.advance(1, "dynamic inflow")
    if chosen.is_dynamic:
        none = windmill(simple, problem, x)
        if none is not None:
            raise NumericalFailure(none)
        inflow_map, circulation = dynamic_map(simple, problem, x)
        return physical(Trim(simple, problem, x, inflow_map, circulation, None, time.perf_counter() - started))

    model = Model.build(aircraft, condition, trim_model(chosen), asked)
    inflow_map, _ = dynamic_map(simple, problem, x, model.steps_per_revolution)
    x = without_inflow(simple, problem, x)
    wake = WakeInTrim(model, inflow_map, steadied=True)
    marching = chosen.is_marching
    found = on_relaxation(model, wake, x, inflow_map, n_harmonics, progress, control_tolerance, start_only=marching)
    if marching:
        model = Model.build(aircraft, condition, chosen, asked)
        found = on_marching(model, found, wake, n_harmonics, progress, control_tolerance)
    return physical(
        Trim(
            model.flown(found.problem, found.x),
            found.problem,
            found.x,
            found.inflow_map,
            found.circulation,
            wake,
            time.perf_counter() - started,
            found.history,
            dict(wake.counters),
            found.notes,
        )
    )


def physical(found: Trim) -> Trim:
    """`found`, unless a monitor says that it is no answer."""
    if found.failures:
        raise NumericalFailure(f"trim: {'; '.join(found.failures)}", partial=found)
    return found


def trim_inputs(start: Trim, t: float) -> _core.Inputs:
    """Inputs that hold the trim at time `t`: the map at each blade's azimuth, or the inflow states."""
    model = start.model
    if model.inflow.is_dynamic:
        return _core.Inputs(start.x[:4], np.zeros(4), 0.0, None, 0.0, start.stabilator_incidence)
    n = start.inflow_map.shape[0]
    first = round(model.omega * t / (2 * np.pi) * n)
    rows = [(first + b * n // model.n_blades) % n for b in range(model.n_blades)]
    mean = model.disk_mean(start.inflow_map)
    return _core.Inputs(start.x[:4], np.zeros(4), 0.0, start.inflow_map[rows], mean, start.stabilator_incidence)
