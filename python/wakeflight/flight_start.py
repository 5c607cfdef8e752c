# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a flight begins with: the model it is flown with; a marching wake that has converged at frozen states and controls."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np

from .engine import Turning
from .errors import InputError, NumericalFailure
from .exchange import Exchange, exchange_of
from .inflow import InflowModel, inflow_model, like
from .model import Model, flight_regime
from .progress import Progress, Silent
from .trim import Trim


@dataclass
class ConvergencePhase:
    """What the convergence phase left: change of inflow per revolution over its mean, thrust, maps before and after."""

    change: list[float] = field(default_factory=list)
    circulation_lift: list[float] = field(default_factory=list)
    before: np.ndarray | None = None
    after: np.ndarray | None = None
    seconds: float = 0.0
    segment_evaluations: int = 0


def flight_model(start: Trim, inflow: str | InflowModel | None, turned: Turning | None = None) -> Model:
    """Model to fly with, its rotor turned as `turned` says, by default at constant speed."""
    turned = turned or Turning()
    model = _trimmed_model(start, inflow).at_speed(turned.corners)
    if turned.over_ground:
        return model.over_ground()
    if turned.engine is None:
        return model
    return model.driven(start.mean_outputs()["power"], turned.engine.governed)


def _trimmed_model(start: Trim, inflow: str | InflowModel | None) -> Model:
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
    if isinstance(inflow, str):
        chosen = trimmed if trimmed.name == chosen.name else like(type(chosen), trimmed)
    regime = flight_regime(start.aircraft, start.condition)
    if start.condition.height is not None:
        chosen = chosen.above_ground()
    chosen = chosen.resolved(regime)
    chosen.check_on(start.aircraft)
    for name, before, now in chosen.unlike(trimmed.resolved(regime), start.aircraft):
        raise InputError.of(name, now, f"must be that of the trim, {before}: trim again with this inflow model")
    return Model.build(start.aircraft, start.condition, chosen)


def begun(model: Model, start: Trim, progress: Progress | Silent) -> tuple[Exchange, ConvergencePhase]:
    """The exchange at the start of a flight; a marching wake after its convergence phase."""
    n = model.steps_per_revolution
    core, trimmed = model.core, (start.problem, start.x)
    exchange = exchange_of(model, start.wake, lambda: core.trim_motion(*trimmed, n), core.trim_sections(*trimmed, 0.0))
    return exchange, converge(model, exchange, start, progress) if model.inflow.is_marching else ConvergencePhase()


def converge(model: Model, marching: Exchange, start: Trim, progress: Progress | Silent) -> ConvergencePhase:
    """Advance the wake at frozen states and controls; the circulation follows the inflow."""
    revolutions = model.inflow.marching.convergence_revolutions
    phase = ConvergencePhase(before=start.inflow_map)
    clock = time.perf_counter()
    progress.phase("convergence of the wake", revolutions)
    previous = start.inflow_map
    widths = np.asarray(model.rotor["widths"])
    for _ in range(revolutions):
        inflow_map, circulation = marching.turn(start.problem, start.x)
        if not np.all(np.isfinite(inflow_map)):
            raise NumericalFailure("convergence phase of the wake left the finite numbers")
        change = model.disk_rms(inflow_map - previous) / abs(model.disk_mean(inflow_map))
        phase.change.append(float(change))
        phase.circulation_lift.append(float(np.mean(circulation @ (model.stations * widths))))
        if phase.after is None:
            phase.before = inflow_map
        phase.after = previous = inflow_map
        progress.advance(1, f"inflow changes by {change:.1e} of its mean")
    marching.core.restart()
    phase.seconds = time.perf_counter() - clock
    phase.segment_evaluations = marching.segment_evaluations
    return phase
