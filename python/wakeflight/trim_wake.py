# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim on a free wake: trim on the inflow of the wake, wake at the trimmed motion, in turn until both rest."""

from __future__ import annotations

import numpy as np

from . import _core
from .errors import NumericalFailure
from .model import Model, flight_regime
from .progress import Progress, Silent
from .trim_mean import on_mean
from .trim_solve import solve_on_map
from .wake_trim import WakeInTrim, marching_map

CONTROL_TOLERANCE = 1e-3  # rad, change of a pitch control between trims on a free wake
MAX_OUTER = 30  # the last passes halve the change of the controls


def on_relaxation(
    model: Model,
    wake: WakeInTrim,
    x: np.ndarray,
    inflow_map: np.ndarray,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float = CONTROL_TOLERANCE,
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, list[dict[str, float]]]:
    """Trim and wake in turn until the pitch controls rest: problem, unknowns, inflow map, history."""
    history: list[dict[str, float]] = []
    for outer in range(MAX_OUTER):
        before = model.pitch_controls(x[:4])
        problem, x = solve_on_map(model, inflow_map, x, n_harmonics)
        change = float(np.max(np.abs(model.pitch_controls(x[:4]) - before)))
        if outer > 0 and change < control_tolerance and wake.converged:
            history[-1]["control_change"] = change
            return problem, x, inflow_map, history
        wake.converge(problem, x)
        inflow_map = wake.inflow_map
        history.append({**wake.last, "control_change": change})
        progress.advance(1, f"inflow change {wake.last['inflow_change']:.1e}, controls {change:.1e} rad")
    raise NumericalFailure(
        f"trim on the free wake did not settle in {MAX_OUTER} passes: pitch controls still move {change:.2e} rad "
        f"(allowed {control_tolerance:g}), inflow {wake.last['inflow_change']:.2e} of the tip speed "
        f"(allowed {model.inflow.inflow_tolerance:g})"
    )


def on_marching(
    model: Model,
    problem: _core.TrimProblem,
    x: np.ndarray,
    wake: WakeInTrim,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float = CONTROL_TOLERANCE,
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, np.ndarray]:
    """Trim on the time-marching wake: march a revolution at the trimmed motion, trim on its inflow, until controls rest.

    In hover and axial flight, where the wake is not periodic, on its mean inflow.
    """
    if flight_regime(model.aircraft, model.condition) != "forward":
        return on_mean(model, problem, x, wake, n_harmonics, progress, control_tolerance)
    march = wake.marching(model)
    for revolution in range(60):
        inflow_map, circulation = marching_map(march, problem, x)
        before = model.pitch_controls(x[:4])
        problem, x = solve_on_map(model, inflow_map, x, n_harmonics)
        change = float(np.max(np.abs(model.pitch_controls(x[:4]) - before)))
        progress.advance(1, f"marching wake: controls {change:.1e} rad")
        if revolution > 2 and change < 0.1 * control_tolerance:
            wake.counters["wake_segment_evaluations"] += march.segment_evaluations
            wake.last |= {"averaged": 1, "control_change": change}
            return problem, x, inflow_map, circulation
    raise NumericalFailure(f"trim on the time-marching wake did not settle: controls still move {change:.2e} rad")
