# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim: the verb that finds sticks, attitude, periodic blade motion and inflow of a steady flight condition."""

from __future__ import annotations

import time
from typing import Any

from ..aircraft import Aircraft
from ..arguments import checked
from ..condition import FlightCondition, condition_for, target
from ..errors import NumericalFailure
from ..inflow import DynamicInflow, InflowModel, inflow_model, trim_model
from ..model import Model
from ..progress import Reported, heard, reporting
from ..units import number, whole
from .aircraft import AircraftOnWake, on_marching, on_relaxation
from .equations import INCH, dynamic_map, without_inflow
from .on_wake import Solution
from .results import Trim
from .solve import solve_condition
from .wake import CONTROL_TOLERANCE, WakeInTrim

MOST_HARMONICS = 40
"""Most harmonics of the blades' periodic motion: their instants and equations grow with them."""

CONTROL_TOLERANCES = (1e-12, 1.0)
"""Least and largest tolerance of the pitch controls [rad] between trims on a free wake."""

__all__ = ["INCH", "Trim", "physical", "trim"]


@reporting
@checked
def trim(
    aircraft: Aircraft,
    condition: FlightCondition | None = None,
    inflow: str | InflowModel = "relaxation",
    progress: Reported = None,
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
    progress = heard(progress)
    started = time.perf_counter()
    n_harmonics = whole("n_harmonics", n_harmonics, 0, MOST_HARMONICS)
    control_tolerance = number("control_tolerance", control_tolerance, *CONTROL_TOLERANCES)
    condition = asked_for = condition_for(aircraft, condition)
    chosen = inflow_model(inflow)
    chosen.step(aircraft)
    asked = target(condition, power, collective, free)
    progress.phase("trim", None)

    def told(model: Model, found: Solution) -> Trim:
        """The trim with what was found of the path in its condition, what was asked, and the seconds it took."""
        seconds = time.perf_counter() - started
        own = {"model": model.flown(found.problem, found.x), "seconds": seconds}
        return physical(Trim(**vars(found) | own, asked=asked_for, control_tolerance=control_tolerance))

    # dynamic inflow first: the result itself, or the start of the free wake
    dynamic = chosen if chosen.is_dynamic else DynamicInflow(n_stations=chosen.n_stations)
    simple = Model.build(aircraft, condition, dynamic, asked, n_harmonics)
    problem, x = solve_condition(simple)
    simple = simple.flown(problem, x)
    condition = simple.condition
    progress.advance(1, "dynamic inflow")
    if chosen.is_dynamic:
        return told(simple, Solution(simple, problem, x, *dynamic_map(simple, problem, x)))

    model = Model.build(aircraft, condition, trim_model(chosen), asked, n_harmonics)
    inflow_map, _ = dynamic_map(simple, problem, x, model.steps_per_revolution)
    x = without_inflow(simple, problem, x)
    wake = WakeInTrim(model, inflow_map, steadied=True)
    trimming = AircraftOnWake(model, progress, control_tolerance, start_only=chosen.is_marching)
    found = on_relaxation(trimming, wake, x, inflow_map)
    if chosen.is_marching:
        model = Model.build(aircraft, condition, chosen, asked, n_harmonics)
        found = on_marching(model, found, progress, control_tolerance)
    return told(model, found)


def physical(found: Trim) -> Trim:
    """`found`, unless a monitor says that it is no answer."""
    if found.failures:
        raise NumericalFailure(f"trim: {'; '.join(found.failures)}", partial=found)
    return found
