# SPDX-License-Identifier: MIT OR Apache-2.0
"""Newton's method for the trim equations, damped by the natural level function [deuflhard2004].

A step counts as one that leads on if the Newton correction of the new point, found with the old derivatives, is shorter: a
measure that neither the units of the equations nor their number change. Its exact derivatives are cheap; what stops a step is
the kinks of section tables, at which derivatives jump.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from ..model import CompiledRotor
from .equations import scales, tolerances

LARGEST_STEP = 30.0
"""Longest correction of one unknown in its scale: 3 in of stick, 30 deg, 0.03 of inflow, 3 deg of a blade harmonic."""
WORTH = 0.1
"""Share of what was missing that a step beyond one that meets the equations must leave at most, to be worth its cost."""
WORTH_IN_TIME = 0.7
"""The same where sections remember: derivatives hold their lags, and each step leaves about the share of lift that lags."""
LEAST_SHARE = 1.0 / 64.0
"""Least share of a correction that is tried."""
ITERATIONS = 40
"""Newton steps of one start at most."""


class Work:
    """Budget of linearisations that all starts of a trim share; residuals cost a twentieth of one."""

    def __init__(self, budget: int):
        self.left = budget

    def spend(self) -> bool:
        """Take one linearisation; whether there was one left."""
        self.left -= 1
        return self.left >= 0


@dataclass(frozen=True)
class Attempt:
    """Where Newton's method ended: unknowns, whether every equation is met there, steps taken."""

    x: np.ndarray
    met: bool
    steps: int


def newton(
    model: CompiledRotor, problem: _core.TrimProblem, x: np.ndarray, work: Work, iterations: int = ITERATIONS
) -> Attempt:
    """Solve the trim equations from `x`; a few more steps than needed bring the residual to rounding."""
    core = model.core
    allowed, scale = tolerances(model, problem), scales(model, problem)
    f = core.trim_residual(problem, x)
    best = (np.inf, x)
    steps = 0
    worth = WORTH_IN_TIME if model.remembers else WORTH
    while steps < iterations and np.all(np.isfinite(f)) and work.spend():
        steps += 1
        level = float(np.max(np.abs(f) / allowed))
        if best[0] <= 1.0 and level > worth * best[0]:
            break  # met, and as near as the kinks of the tables allow
        if level < best[0]:
            best = (level, x)
        if level < 1e-6:
            break
        inverse = inverted(core.trim_jacobian(problem, x) * scale)
        if inverse is None:
            break
        step = -inverse @ f
        length = float(np.linalg.norm(step))
        share = min(1.0, LARGEST_STEP / float(np.max(np.abs(step))))
        while True:
            trial = x + share * step * scale
            f_trial = core.trim_residual(problem, trial)
            if np.all(np.isfinite(f_trial)) and np.linalg.norm(inverse @ f_trial) <= (1.0 - 0.25 * share) * length:
                break
            share *= 0.5
            if share < LEAST_SHARE:
                break
        # a kink may hide the way: the shortest step goes on with new derivatives
        x, f = trial, f_trial
    if np.all(np.isfinite(f)):
        level = float(np.max(np.abs(f) / allowed))
        if level < best[0]:
            best = (level, x)
    level, x = best
    x = model.normalised(x)
    return Attempt(x, level <= 1.0 and model.is_answer(problem, x), steps)


def inverted(jacobian: np.ndarray) -> np.ndarray | None:
    """Inverse of the derivatives; None where they are singular."""
    try:
        inverse = np.linalg.inv(jacobian)
    except np.linalg.LinAlgError:
        return None
    return inverse if np.all(np.isfinite(inverse)) else None
