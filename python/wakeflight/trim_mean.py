# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim on a marching wake in hover and axial flight, which does not become periodic: on its mean inflow, as on the stand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import _core
from .errors import NumericalFailure
from .model import Model, flight_regime
from .progress import Progress, Silent
from .regime import REVOLUTIONS
from .trim_solve import solve_on_map
from .wake_trim import PERIODIC, WakeInTrim, marching_map

if TYPE_CHECKING:
    Maps = list[tuple[np.ndarray, np.ndarray]]

MAX_REVOLUTIONS = 60
"""Revolutions marched at most."""


def on_mean(
    model: Model,
    problem: _core.TrimProblem,
    x: np.ndarray,
    wake: WakeInTrim,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float,
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, np.ndarray]:
    """Problem, unknowns, mean inflow and circulation maps of a trim on the later half of the revolutions marched.

    Revolution after revolution the controls are renewed on the mean of the last inflow and of the one used before, so that the
    unsteadiness of the wake is not taken for a change of condition. From as many revolutions on as the stand marches, the trim
    on their later half counts once the trims on its two quarters are twice `control_tolerance` apart or less: that is what the
    mean is uncertain by. Ends early where the wake is periodic after all, as in a climb.
    """
    least = REVOLUTIONS[flight_regime(model.aircraft, model.condition)][0]
    march, maps, held, uncertain = wake.marching(model), [], None, np.inf
    for revolution in range(1, MAX_REVOLUTIONS + 1):
        maps.append(marching_map(march, problem, x))
        held = maps[-1][0] if held is None else 0.5 * (held + maps[-1][0])
        before = model.pitch_controls(x[:4])
        problem, x = solve_on_map(model, held, x, n_harmonics)
        change = float(np.max(np.abs(model.pitch_controls(x[:4]) - before)))
        progress.advance(1, f"marching wake: controls {change:.1e} rad")
        averaged = 0
        # a small change of controls alone is not enough: the wake leaves its periodic solution slowly
        if revolution > 3 and change < 0.01 * control_tolerance and moved(model, maps) < PERIODIC:
            averaged, uncertain = 1, change
        elif revolution >= least:
            averaged = 2 * (revolution // 4)
            quarters = (maps[-averaged : -(averaged // 2)], maps[-(averaged // 2) :])
            first, second = (model.pitch_controls(on_maps(model, each, x, n_harmonics)[1][:4]) for each in quarters)
            uncertain = 0.5 * float(np.max(np.abs(second - first)))
        if averaged and uncertain < control_tolerance:
            wake.counters["wake_segment_evaluations"] += march.segment_evaluations
            wake.last |= {"averaged": averaged, "control_change": uncertain}
            return on_maps(model, maps[-averaged:], x, n_harmonics)
    raise NumericalFailure(
        f"trim on the time-marching wake did not settle in {MAX_REVOLUTIONS} revolutions: the wake is not periodic and its "
        f"means leave the pitch controls uncertain by {uncertain:.2e} rad (allowed {control_tolerance:g})"
    )


def moved(model: Model, maps: Maps) -> float:
    """Change of inflow in the last revolution over its mean."""
    change = maps[-1][0] - maps[-2][0]
    return float(np.sqrt(np.mean(change**2 @ model.area_weights))) / abs(model.disk_mean(maps[-1][0]))


def on_maps(
    model: Model, maps: Maps, x: np.ndarray, n_harmonics: int
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, np.ndarray]:
    """Trim on the mean of the inflow maps of several revolutions: problem, unknowns, mean inflow and circulation."""
    inflow_map, circulation = (np.mean(each, axis=0) for each in zip(*maps, strict=True))
    return *solve_on_map(model, inflow_map, x, n_harmonics), inflow_map, circulation
