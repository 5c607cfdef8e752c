# SPDX-License-Identifier: MIT OR Apache-2.0
"""A trimmed revolution of an aircraft: what holds it at an instant, what its equations put out there."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _core
from ..model import Model


def rows_of(model: Model, n: int, first: int) -> list[int]:
    """Azimuth index of every blade, of `n` azimuths, where that of the first is `first`."""
    return [(first + b * n // model.n_blades) % n for b in range(model.n_blades)]


def inputs(
    model: Model, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None, t: float
) -> _core.Inputs:
    """Sticks and inflow that hold the trim at `t` [s]: the map at each blade's azimuth, None where inflow is a state.

    Between its rows it is linear, as a flight has it.
    """
    held, mean = None, 0.0
    if inflow_map is not None:
        n = inflow_map.shape[0]
        steps = model.omega * t / (2 * np.pi) * n
        here = round(steps)
        held, beyond = inflow_map[rows_of(model, n, here)], steps - here
        if abs(beyond) > 1e-9:
            there = inflow_map[rows_of(model, n, here + (1 if beyond > 0.0 else -1))]
            held = held + abs(beyond) * (there - held)
        mean = model.disk_mean(inflow_map)
    acting = _core.Inputs(x[:4], np.zeros(4), 0.0, held, mean, model.core.trim_stabilator(problem, x))
    if problem.wash is not None:
        acting = acting.washed(problem.wash)
    sections = model.core.trim_sections(problem, x, t)
    return acting if sections is None else acting.remembering(sections, t)


def instants(
    model: Model, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None
) -> list[tuple[list[int], dict[str, Any]]]:
    """Outputs over the angle between two blades: every azimuth is passed once; with the azimuth index of every blade."""
    n = model.steps_per_revolution if inflow_map is None else inflow_map.shape[0]
    records = []
    for k in range(n // model.n_blades):
        t = 2 * np.pi * k / n / model.omega
        y, y_dot = model.core.trim_state(problem, x, t)
        records.append(
            (rows_of(model, n, k), model.core.outputs(t, y, y_dot, inputs(model, problem, x, inflow_map, t)))
        )
    return records
